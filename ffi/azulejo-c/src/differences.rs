//! Differential domain analysis of samples on meshes.

use azulejo_core::analysis::differential::{self, Differences, surface_differences};

use crate::boundary::{self, Out, array, check_pointer, rows};
use crate::context::azulejo_context;
use crate::handles::{self, handle};
use crate::mesh::{SurfaceSet, azulejo_mesh};
use crate::status::{Failure, azulejo_status};

/// The cells per side of the grid of azulejo_differences_density.
pub const AZULEJO_DIFFERENCES_SIZE: u32 = 128;
/// The extent of the grid from the difference 0 along both axes, in mean spacings.
pub const AZULEJO_DIFFERENCES_GRID_REACH: u32 = 4;
/// The shells of equal width of azulejo_differences_radial.
pub const AZULEJO_DIFFERENCES_SHELLS: u32 = 512;
/// The distance at which the last shell ends, in mean spacings.
pub const AZULEJO_DIFFERENCES_REACH: u32 = 8;

const _: () = {
    assert!(differential::GRID_SIZE == AZULEJO_DIFFERENCES_SIZE as usize);
    assert!(differential::GRID_REACH == AZULEJO_DIFFERENCES_GRID_REACH as f64);
    assert!(differential::REACH == AZULEJO_DIFFERENCES_REACH as f64);
    assert!(differential::REACH / differential::SHELL_WIDTH == AZULEJO_DIFFERENCES_SHELLS as f64);
};

/// The distribution p(d) of the differences d of all pairs of samples on a mesh, or of several sets
/// (Wei and Wang 2011): the density of other samples at an offset from a sample, over the mean
/// density. 1 for a Poisson process. Its Fourier transform takes the place of the power spectrum.
///
/// The offset of a pair is projected onto the tangent plane of its first sample and keeps its
/// straight length. Lengths are in mean spacings, sqrt(area / count), frequencies in their inverse.
pub struct azulejo_differences {
    differences: Differences,
    density: Vec<f64>,
    radial: Vec<f64>,
}

handle!(azulejo_differences);

impl From<Differences> for azulejo_differences {
    fn from(differences: Differences) -> Self {
        let radial = differences.radial().iter().map(|shell| shell.density).collect();
        Self { density: differences.density(), radial, differences }
    }
}

/// Measures the differences of samples on a mesh, divided by those with random points of it, so
/// that boundaries, curvature and sheets nearby cancel (Davis and Peebles 1983). O(count) time.
///
/// mesh: must have area that its mask does not leave out.
///
/// positions: the samples, x y z each, at least 2.
///
/// normals: those of the samples' triangles, x y z each, as azulejo_points_normals returns them.
///
/// direction: three numbers, not all 0, whose projection on the tangent plane is the x axis.
///
/// seed: selects the random points, two per sample.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_create(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    positions: *const f32,
    normals: *const f32,
    count: usize,
    direction: *const f64,
    seed: u64,
    out: *mut *mut azulejo_differences,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
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

/// Combines the differences of `count` sets of one kind, at least 1. Their noise decreases with the
/// square root of it. O(count) time and memory, on the calling thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_mean(
    differences: *const *const azulejo_differences,
    count: usize,
    out: *mut *mut azulejo_differences,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let differences = unsafe { handles::all("differences", "count", differences, count) }?;
        let all: Vec<_> = differences.iter().map(|one| one.differences.clone()).collect();
        Ok(Differences::together(&all)?.into())
    })
}

/// p(d): AZULEJO_DIFFERENCES_SIZE squared numbers, row by row from the lowest offset; 0 where not
/// even random points have a pair. The offset 0 is in the middle, where four cells meet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_density(differences: *const azulejo_differences) -> *const f64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("differences", differences) }
        .map_or(std::ptr::null(), |differences| array(&differences.density))
}

/// The radial mean of p(d), the radial distribution function: AZULEJO_DIFFERENCES_SHELLS numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_radial(differences: *const azulejo_differences) -> *const f64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("differences", differences) }
        .map_or(std::ptr::null(), |differences| array(&differences.radial))
}

/// The radial mean of the power spectrum, by Hankel transform of the radial mean of p(d) - 1; 1 for
/// a Poisson process. Its resolution is one over AZULEJO_DIFFERENCES_REACH. O(count) time.
///
/// frequencies: `count` frequencies from -32 to 32.
///
/// out: receives the power at each, `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_power(
    differences: *const azulejo_differences,
    frequencies: *const f64,
    count: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let differences = unsafe { handles::get("differences", differences) }?;
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

/// Frees the differences.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_differences_free(differences: *mut azulejo_differences) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("differences", differences) };
}
