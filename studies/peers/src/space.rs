//! The peers in space: the unit cube, and the inside of a mesh. `azulejo-studies volume` judges them.

use std::error::Error;
use std::path::Path;

use azulejo::Interior;
use azulejo::mesh::Mesh;
use rand_08::SeedableRng as _;

use crate::native::{Run, flat};
use crate::timing::timed;

/// The attempts around each sample, as Bridson 2007 proposes.
const ATTEMPTS: usize = 30;

pub fn fast_poisson(radius: f64) -> Run {
    flat(timed(|| fast_poisson::Poisson3D::new().with_dimensions([1.0; 3], radius).with_seed(1).generate()))
}

/// A set of the box around a mesh, without the samples outside of it.
pub fn fast_poisson_inside(mesh: &Path, radius: f64) -> Result<Run, Box<dyn Error>> {
    let mesh = Mesh::load(mesh)?;
    let (low, high) = mesh.bounds();
    let size = std::array::from_fn(|axis| f64::from(high[axis] - low[axis]));
    let interior = Interior::of(&mesh);
    Ok(flat(timed(|| {
        let points = fast_poisson::Poisson3D::new().with_dimensions(size, radius).with_seed(1).generate();
        let moved = points.into_iter().map(|point| std::array::from_fn(|axis| point[axis] + f64::from(low[axis])));
        moved.filter(|point: &[f64; 3]| interior.contains(point.map(|x| x as f32))).collect::<Vec<[f64; 3]>>()
    })))
}

pub fn poisson_diskus(radius: f64) -> Run {
    let mut random = rand_08::rngs::StdRng::seed_from_u64(1);
    flat(timed(|| poisson_diskus::bridson_rng(&[1.0; 3], radius, ATTEMPTS, false, &mut random).expect("a cube")))
}

/// Its radius is that of disks that do not overlap: half of what it is elsewhere.
pub fn poisson<A>(radius: f64, algorithm: A) -> Run
where
    A: poisson::algorithm::Creator<f64, nalgebra::Vector3<f64>>,
{
    use rand_06::SeedableRng as _;
    let random = rand_06::rngs::SmallRng::seed_from_u64(1);
    let builder = poisson::Builder::<f64, nalgebra::Vector3<f64>>::with_radius(radius / 2.0, poisson::Type::Normal);
    let generated = || builder.build(random, algorithm).generate();
    flat(timed(|| generated().iter().map(|point| [point.x, point.y, point.z]).collect::<Vec<[f64; 3]>>()))
}
