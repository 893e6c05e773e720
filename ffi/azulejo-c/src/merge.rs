//! Merging: independently made sets on adjacent rectangles, and points that must stay, become one maximal set.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::kdrt::{self, MergeOptions, MergeReport, Piece};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_kdrt_merge.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_merge_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    pub boundary: i32,
    /// The smallest distance between two samples, that of the pieces. Above 0; there is no default.
    pub radius: f64,
    /// The lower corner of the domain, x y; 0 0 by default.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    pub domain_max: [f64; 2],
    /// Any number; another seed gives another set.
    pub seed: u64,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
}

options!(azulejo_merge_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_merge_options_init(
    options: *mut azulejo_merge_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// A set of samples that was made by itself, such as by azulejo_kdrt_sample on a bounded domain or by
/// azulejo_kdrt_sample_window. It has no struct_size and never grows.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_merge_piece {
    /// The samples, x y each, in min <= x < max, no two of them closer than the radius; read during the call only. Any
    /// floats will do, and they need not be maximal. NULL if there are none.
    pub xy: *const f32,
    /// How many there are.
    pub count: usize,
    /// The lower corner of the piece's rectangle, x y.
    pub min: [f64; 2],
    /// The upper corner, above the lower one on both axes.
    pub max: [f64; 2],
}

/// What became of the samples of the pieces. The result has first the fixed points, then those kept, then the inserted
/// ones.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_merge_report {
    /// Samples of the pieces that are in the result.
    pub kept: u64,
    /// Samples of the pieces that are not.
    pub eliminated: u64,
    /// New samples.
    pub inserted: u64,
    /// Zeros, for later versions.
    pub reserved: [u32; 10],
}

impl From<MergeReport> for azulejo_merge_report {
    fn from(report: MergeReport) -> Self {
        let MergeReport { kept, eliminated, inserted, .. } = report;
        Self { kept: kept as u64, eliminated: eliminated as u64, inserted: inserted as u64, reserved: [0; 10] }
    }
}

/// Glues sets of samples on rectangles that do not overlap, and points that must stay, into one maximal, conflict-free
/// set of the domain (thesis section 2.4.4). Only the seams change.
///
/// Conflict-free and maximal as in the conventions, but maximal up to 6 times the spacing of floats; whatever no sample
/// covers is filled, also where a piece is not maximal, where there is no piece, and the whole domain if there is
/// nothing. A sample of a piece goes only if it is closer than the radius to a fixed point, or to a sample that stays of
/// another piece or, over the seam of a periodic domain, of its own; which one goes depends on the seed and the places of
/// the pieces in the array. If the pieces are maximal as azulejo_kdrt_sample makes them, new samples lie within the radius
/// of a sample that went or of the border of a piece's rectangle.
///
/// pieces: `piece_count` of them, in the domain; NULL if there are none.
///
/// fixed: the points that must stay, x y each, in domain_min <= x < domain_max, no two of them closer than the radius;
/// `fixed_count` of them; NULL if there are none.
///
/// out: the samples, x y each, to be freed with azulejo_points_free: first all fixed points, then the samples of the
/// pieces that are kept, piece by piece, both in the order and with the bits that they were given; then new ones.
///
/// report: what became of the pieces, or NULL.
///
/// O(samples) time with all threads of the context, and O(piece_count^2) at most. A periodic domain narrower than about
/// 10 radii is filled on one thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for rectangles that overlap or leave the domain, samples outside of
/// their rectangle, two samples of one piece or two fixed points that are closer than the radius (the message has their
/// indices), and where floats are too coarse to carry the radius; AZULEJO_ERROR_TOO_LARGE; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_merge(
    context: Option<&azulejo_context>,
    options: *const azulejo_merge_options,
    pieces: *const azulejo_merge_piece,
    piece_count: usize,
    fixed: *const f32,
    fixed_count: usize,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_merge_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let (options, pieces, fixed) = unsafe {
            let fixed = rows::<f32, 2>("fixed", fixed, "fixed_count", fixed_count)?;
            (options::read(options)?, read(pieces, piece_count)?, fixed)
        };
        let domain = domain(options.domain_min, options.domain_max, options.boundary)?;
        let request = MergeOptions::new(options.radius).domain(domain).seed(options.seed);
        let watch = Watch::new(options.progress, options.progress_user);
        let (merged, done) =
            context.run(watch, |context, progress| kdrt::merge(context, &request, &pieces, fixed, progress))?;
        report.map(|report| report.write(done.into()));
        Ok(azulejo_points::plane(merged))
    })
}

/// The caller's pieces as the core wants them.
///
/// # Safety
/// Unless the checks fail, `pieces` leads to `count` pieces and each of them to its samples, which nobody changes during
/// `'a`.
unsafe fn read<'a>(pieces: *const azulejo_merge_piece, count: usize) -> Result<Vec<Piece<'a>>, Failure> {
    // SAFETY: handed on from the caller.
    let pieces = unsafe { rows::<azulejo_merge_piece, 1>("pieces", pieces, "piece_count", count) }?;
    let read = |(i, &[piece]): (usize, &[azulejo_merge_piece; 1])| {
        let [xy, count] = ["xy", "count"].map(|field| format!("pieces: [{i}].{field}"));
        // SAFETY: handed on from the caller.
        let samples = unsafe { rows::<f32, 2>(&xy, piece.xy, &count, piece.count) }?;
        Ok(Piece { samples, min: piece.min, max: piece.max })
    };
    pieces.iter().enumerate().map(read).collect()
}
