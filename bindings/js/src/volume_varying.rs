//! Sets of cuboids, and of the inside of meshes, whose radius varies.

use azulejo::volume::adaptive::{InsideOptions, Options, Radius, sample, sample_inside};
use azulejo::{Boundary, Domain};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::mesh::Handle;

/// The options of a set, as JavaScript lays them out.
#[repr(C)]
pub struct VaryingVolumeOptions {
    min: [f64; 3],
    max: [f64; 3],
    bounded: f64,
    size: [f64; 3],
    tolerance: f64,
}

/// The samples; their radii; the least of these and the largest on the grid.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_adaptive_sample(
    mesh: Option<&Handle>,
    options: &VaryingVolumeOptions,
    seed: u64,
    values: *const f32,
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let values = unsafe { rows(values, count) };
    let &VaryingVolumeOptions { min, max, bounded, size, tolerance } = options;
    call(|context, progress| {
        let radius = Radius::Grid { values, size: size.map(|along| along as usize) };
        let (mut samples, report) = match mesh {
            None => {
                let boundary = if bounded == 0.0 { Boundary::Periodic } else { Boundary::Bounded };
                let request = Options::new(radius).domain(Domain { min, max, boundary }).seed(seed);
                sample(context, &request, progress)?
            }
            Some(mesh) => {
                let request = InsideOptions::new(radius).tolerance(tolerance).seed(seed);
                sample_inside(context, &mesh.0, &request, progress)?
            }
        };
        let radii = std::mem::take(&mut samples.radii);
        Ok(Answer::default().and(samples.positions).and(radii).and(vec![report.radius, report.covering_radius]))
    })
}
