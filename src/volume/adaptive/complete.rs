//! A set of a domain where radii vary, from its options to its samples.

use crate::error::Result;
use crate::job::{Context, Progress};
use crate::memory;
use crate::plane::{Lattice, float_spacing};
use crate::points::{Domain, Points, finest_radius};
use crate::volume::adaptive::blocks::{Blocks, check_largest};
use crate::volume::adaptive::field::{RadiusField, Source};
use crate::volume::adaptive::ground::Ground;
use crate::volume::adaptive::options::Radius;
use crate::volume::adaptive::set::maximal;
use crate::volume::body::Body;

/// The most bytes of memory that a sample takes, with its position and radius in the result.
const BYTES_PER_SAMPLE: f64 = 90.0;

/// The most bytes of the grid and the voxels of a block, which each thread has, without and for each sample in and around the
/// block; and the least number of samples for which another thread is of use.
const BYTES_PER_THREAD: f64 = (4 << 20) as f64;
const BYTES_PER_STANDING: f64 = 450.0;
const SAMPLES_PER_THREAD: f64 = 1000.0;

/// The share of the call that its blocks take.
const BLOCKS: f64 = 0.02;

/// A set of a domain, or of a body in it, with its least radius and the largest that there can be.
pub fn complete(
    context: &Context,
    domain: &Domain<3>,
    radius: Radius,
    body: Option<&Body>,
    seed: u64,
    progress: Option<&Progress>,
) -> Result<(Points<3>, [f64; 2])> {
    domain.check()?;
    let source = Source::new(domain, radius)?;
    // Radii that floats do not allow are refused by their own name.
    let finest = finest_radius(float_spacing(domain.min.iter().chain(&domain.max)));
    let lattice = &Lattice::of_any_size(domain, finest)?;
    let field = &RadiusField::new(&source, lattice)?;
    let held = memory::available().map_or(f64::INFINITY, |bytes| bytes / BYTES_PER_SAMPLE);
    let limit = f64::from(u32::MAX).min(held);
    if body.is_none() {
        check_largest(lattice, field, limit)?;
    }
    let samples = context.run(progress, |job| {
        let blocks = Blocks::new(&job.part(0.0, BLOCKS), lattice, field, seed, limit)?;
        // A body has the share of its box that it would have with one radius.
        let radius = blocks.mean_radius(lattice);
        let expected = body.map_or(blocks.expected, |body| body.expected_samples(radius).min(blocks.expected));
        let threads = (context.num_threads() as f64).min(expected / SAMPLES_PER_THREAD).max(1.0);
        let per_thread = BYTES_PER_THREAD + blocks.most_standing * BYTES_PER_STANDING;
        let bytes = expected * BYTES_PER_SAMPLE + threads * per_thread;
        memory::require(bytes, source.argument(), &format!("about {expected:.0} samples"))?;
        let ground = Ground { lattice, field, solid: body.map(Body::solid) };
        maximal(&job.part(BLOCKS, 1.0), ground, &blocks)
    })?;
    let mut points = Points::from(samples.iter().map(|ball| lattice.position(ball.centre)).collect::<Vec<_>>());
    points.radii = samples.iter().map(|ball| ball.radius * lattice.unit()).collect();
    let covering_radius = field.bounds[1] * lattice.unit();
    let radius = points.radii.iter().copied().fold(covering_radius, f64::min);
    Ok((points, [radius, covering_radius]))
}
