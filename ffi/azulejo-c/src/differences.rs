//! Differential domain analysis of samples on meshes.

use std::mem::MaybeUninit;

use azulejo_core::analysis::differential::{self, Differences, surface_differences};

use crate::boundary::{self, array, check_pointer, required, rows};
use crate::context::azulejo_context;
use crate::mesh::{SurfaceSet, azulejo_mesh};
use crate::status::{Failure, azulejo_status};

/// The grid of azulejo_differences_density has so many cells per side ...
pub const AZULEJO_DIFFERENCES_SIZE: u32 = 128;
/// ... and reaches so far from the difference 0 along both axes, in mean spacings.
pub const AZULEJO_DIFFERENCES_GRID_REACH: u32 = 4;
/// azulejo_differences_radial has so many shells of equal width ...
pub const AZULEJO_DIFFERENCES_SHELLS: u32 = 512;
/// ... out to this distance, in mean spacings.
pub const AZULEJO_DIFFERENCES_REACH: u32 = 8;

const _: () = {
    assert!(differential::GRID_SIZE == AZULEJO_DIFFERENCES_SIZE as usize);
    assert!(differential::GRID_REACH == AZULEJO_DIFFERENCES_GRID_REACH as f64);
    assert!(differential::REACH == AZULEJO_DIFFERENCES_REACH as f64);
    assert!(differential::REACH / differential::SHELL_WIDTH == AZULEJO_DIFFERENCES_SHELLS as f64);
};

/// The distribution p(d) of the differences d of all pairs of samples on a mesh, or of several sets (Wei and Wang 2011,
/// "Differential domain analysis for non-uniform sampling"): the density of other samples at an offset from a sample, over
/// the mean density. 1 for a Poisson process. Its Fourier transform is the power spectrum, which a surface has no other
/// way to have. Never changes.
///
/// The offset of a pair is projected onto the tangent plane of its first sample and keeps its straight length. Lengths are
/// in mean spacings, sqrt(area / count), and frequencies in units of one over it.
pub struct azulejo_differences {
    differences: Differences,
    density: Vec<f64>,
    radial: Vec<f64>,
}

impl From<Differences> for azulejo_differences {
    fn from(differences: Differences) -> Self {
        let radial = differences.radial().iter().map(|shell| shell.density).collect();
        Self { density: differences.density(), radial, differences }
    }
}

/// Measures the differences of samples on a mesh. They are divided by those with random points of the mesh, so that
/// borders, curvature and other sheets near by cancel (Davis and Peebles 1983).
///
/// mesh: has to have some area that its mask does not leave out.
///
/// positions: the samples, x y z each; `count` of them, at least 2.
///
/// normals: the normal of the triangle of each sample, x y z each, as azulejo_points_normals gives them; `count` of them.
///
/// direction: three numbers, not all 0: along its projection onto the tangent plane points the x axis of the offsets.
///
/// seed: selects the random points, two for each sample.
///
/// out: the differences, to be freed with azulejo_differences_free.
///
/// O(count) time for samples that are spread evenly, about 600 pairs for each.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_create(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    positions: *const f32,
    normals: *const f32,
    count: usize,
    direction: *const f64,
    seed: u64,
    out: Option<&mut MaybeUninit<Box<azulejo_differences>>>,
) -> azulejo_status {
    boundary::create(out, || {
        // SAFETY: handed on from the caller.
        let (set, normals, direction) = unsafe {
            (
                SurfaceSet::read(context, mesh, positions, count)?,
                rows::<f32, 3>("normals", normals, "count", count)?,
                rows::<f64, 3>("direction", direction, "direction", 1)?[0],
            )
        };
        let differences = set.run(|context, mesh, positions, progress| {
            surface_differences(context, mesh, positions, normals, direction, seed, progress)
        })?;
        Ok(differences.into())
    })
}

/// Takes the differences of sets of one kind together. Noise fades with the square root of their number.
///
/// differences: `count` of them, at least 1.
///
/// out: all of them, to be freed with azulejo_differences_free; those given stay the caller's.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_mean(
    differences: *const *const azulejo_differences,
    count: usize,
    out: Option<&mut MaybeUninit<Box<azulejo_differences>>>,
) -> azulejo_status {
    boundary::create(out, || {
        // SAFETY: handed on from the caller.
        let differences = unsafe { boundary::handles("differences", differences, count) }?;
        let all: Vec<_> = differences.iter().map(|one| one.differences.clone()).collect();
        Ok(Differences::together(&all)?.into())
    })
}

/// p(d), AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not even random points have a
/// pair. The offset 0 is in the middle, where four cells meet. NULL for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_differences_density(differences: Option<&azulejo_differences>) -> *const f64 {
    differences.map_or(std::ptr::null(), |differences| array(&differences.density))
}

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers. NULL for NULL.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_differences_radial(differences: Option<&azulejo_differences>) -> *const f64 {
    differences.map_or(std::ptr::null(), |differences| array(&differences.radial))
}

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for a Poisson process. Seen
/// through a blur of one over AZULEJO_DIFFERENCES_REACH.
///
/// frequencies: `count` frequencies of at most 32, in units of one over the mean spacing; may be NULL if there is none.
///
/// out: the power at each, `count` numbers; may be NULL if there is none.
///
/// O(count) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_power(
    differences: Option<&azulejo_differences>,
    frequencies: *const f64,
    count: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        let differences = required("differences", differences)?;
        // SAFETY: handed on from the caller.
        let frequencies = unsafe { rows::<f64, 1>("frequencies", frequencies, "count", count) }?.as_flattened();
        let range = -MAX_FREQUENCY..=MAX_FREQUENCY;
        if let Some(i) = frequencies.iter().position(|frequency| !range.contains(frequency)) {
            let reason = format!("[{i}] is {}, not in {range:?}", frequencies[i]);
            return Err(Failure::invalid("frequencies", reason));
        }
        if count > 0 {
            check_pointer("out", out.cast_const())?;
            // SAFETY: one number for each of the caller's frequencies.
            unsafe { boundary::write(out, &differences.differences.power(frequencies)) };
        }
        Ok(())
    })
}

/// Half of the frequency of the shells, beyond which nothing is known.
const MAX_FREQUENCY: f64 = 32.0;

/// Frees the differences. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_differences_free(differences: Option<Box<azulejo_differences>>) {
    boundary::free(differences);
}
