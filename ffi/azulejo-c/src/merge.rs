//! Merging: independently made sets on adjacent rectangles, and points that must stay, become one
//! maximal set.

use std::ffi::c_void;

use azulejo_core::kdrt::{self, MergeOptions, MergeReport, Piece};

use crate::boundary::{Out, check_reserved, flag, rows};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, elements, growing};
use crate::handles;
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_kdrt_merge.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_merge_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// As in azulejo_kdrt_options: above 0, and at least 64 float spacings. It has no default.
    pub radius: f64,
    /// The lower corner of the domain, x y; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner, as in azulejo_plane_set; default 1 1.
    pub domain_max: [f64; 2],
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// 1: the pieces are maximal sets of this radius, at least farther than it from their edges.
    /// Then only their seams are tested: the same set in less time. Default 0.
    pub maximal_pieces: u32,
    /// Must be 0.
    pub reserved: u32,
}

growing!(azulejo_kdrt_merge_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    maximal_pieces: 0,
    reserved: 0,
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_merge_options_init(
    options: *mut azulejo_kdrt_merge_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// A set that was made independently, such as by azulejo_kdrt_sample or _sample_window.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_merge_piece {
    /// The samples, x y each, with min <= x < max, none closer than the radius; maximal or not.
    pub positions: *const f32,
    /// The number of samples.
    pub count: usize,
    /// The lower corner of the piece's rectangle, x y.
    pub min: [f64; 2],
    /// The upper corner, above the lower one on both axes.
    pub max: [f64; 2],
}

/// The fate of the samples of the pieces.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_merge_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The samples of the pieces that are in the result.
    pub kept: u64,
    /// The samples of the pieces that are not.
    pub eliminated: u64,
    /// The new samples.
    pub inserted: u64,
}

growing!(azulejo_kdrt_merge_report requires kept { reserved: 0, kept: 0, eliminated: 0, inserted: 0 });

impl From<MergeReport> for azulejo_kdrt_merge_report {
    fn from(report: MergeReport) -> Self {
        let MergeReport { kept, eliminated, inserted, .. } = report;
        Self { kept: kept as u64, eliminated: eliminated as u64, inserted: inserted as u64, ..Self::DEFAULT }
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_merge_report_init(
    report: *mut azulejo_kdrt_merge_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Merges sets of samples on rectangles that do not overlap, and points that must stay, into one
/// maximal, conflict-free set of the domain (thesis section 2.4.4). Only the seams change.
///
/// Whatever no sample covers is filled: where a piece is not maximal, where there is no piece, and
/// the whole domain if nothing is given. A sample of a piece is removed only if it is closer than
/// the radius to a fixed point or to a sample that stays of another piece or, across a seam, of its
/// own; which one depends on the seed and the order of the pieces. Of maximal pieces, new samples
/// lie within the radius of a removed sample or of the edge of a piece.
///
/// pieces: `piece_count` rectangles in the domain. piece_size: sizeof(azulejo_kdrt_merge_piece).
///
/// fixed: `fixed_count` points that must stay, no two of them closer than the radius.
///
/// out: all fixed points, then the kept samples piece by piece, both in their order and bit for bit
/// as given, then the new ones.
///
/// O(samples) time and memory, and at most O(piece_count^2) time for the rectangles. A periodic
/// domain narrower than about 10 radii is filled on one thread.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for rectangles that overlap or leave the domain,
/// samples outside theirs, and two samples of one piece (of `maximal_pieces` only near edges) or
/// two fixed points that are closer than the radius (the message has their indices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_merge(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_merge_options,
    pieces: *const azulejo_kdrt_merge_piece,
    piece_count: usize,
    piece_size: usize,
    fixed: *const f32,
    fixed_count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_kdrt_merge_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, pieces, fixed, report) = unsafe {
            let fixed = rows::<f32, 2>("fixed", fixed, "fixed_count", fixed_count)?;
            (
                growing::read("options", options)?,
                read(pieces, piece_count, piece_size)?,
                fixed,
                Output::optional("report", report)?,
            )
        };
        let domain = domain(options.domain_min, options.domain_max, options.boundary)?;
        check_reserved(options.reserved)?;
        let maximal_pieces = flag("maximal_pieces", options.maximal_pieces)?;
        let request =
            MergeOptions::new(options.radius).domain(domain).seed(options.seed).maximal_pieces(maximal_pieces);
        let watch = Watch::new(options.progress, options.progress_user);
        let (merged, done) =
            context.run(watch, |context, progress| kdrt::merge(context, &request, &pieces, fixed, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::plane(merged))
    })
}

/// The caller's pieces as the core wants them.
///
/// # Safety
/// Unless the checks fail, `pieces` leads to `count` pieces of `size` bytes and each of them to its
/// samples, which are not changed during `'a`.
unsafe fn read<'a>(
    pieces: *const azulejo_kdrt_merge_piece,
    count: usize,
    size: usize,
) -> Result<Vec<Piece<'a>>, Failure> {
    // SAFETY: handed on from the caller; integers, floats and a pointer that is checked below.
    let pieces = unsafe { elements(["pieces", "piece_count", "piece_size"], pieces, count, size) }?;
    let read = |(i, piece): (usize, azulejo_kdrt_merge_piece)| {
        let [positions, count] = ["positions", "count"].map(|field| format!("pieces: [{i}].{field}"));
        // SAFETY: handed on from the caller.
        let samples = unsafe { rows::<f32, 2>(&positions, piece.positions, &count, piece.count) }?;
        Ok(Piece { samples, min: piece.min, max: piece.max })
    };
    pieces.into_iter().enumerate().map(read).collect()
}
