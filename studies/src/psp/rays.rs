//! Rays per second (thesis table 3.1): patterns projected along the axes through a scene, without what follows.

use std::time::Instant;

use azulejo::trace::{Ray, Scene as Tracer};
use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY, Result, kdrt};
use glam::Vec3;

use super::scenes::Scene;
use azulejo_cli::draw::rows;

/// Points are put in order by squares of this many mean spacings, whose points fill about one packet.
const TILE: f64 = 4.0;
/// Rays of a task.
const TASK: usize = 4096;

/// The result of tracing some rays.
pub struct Rays {
    pub rays: usize,
    /// All hits on the rays.
    pub hits: usize,
    /// Rays per second to their first hit, as the thesis counts, and to all of them.
    pub closest: f64,
    pub all: f64,
}

impl Rays {
    /// About `count` rays along each axis.
    pub fn measure(context: &Context, scene: &Scene, count: f64) -> Result<Self> {
        let (low, high) = scene.mesh.bounds();
        let (low, high) = (Vec3::from(low), Vec3::from(high));
        let scale = (high - low).length().recip();
        let place = |position: &[f32; 3]| ((Vec3::from(*position) - 0.5 * (low + high)) * scale).to_array();
        let positions: Vec<_> = scene.mesh.positions().iter().map(place).collect();
        let tracer = Tracer::new(&positions, scene.mesh.triangles(), context.num_threads())?;
        let half = 0.5 * scale * (high - low);
        let mut rays = Vec::new();
        for axis in 0..3 {
            rays.extend(along(context, axis, half, count)?);
        }
        let width = tracer.packet_width();
        let (closest, _) = timed(context, &rays, |rays| {
            tracer.closest_hits_in_packets(width, rays).iter().filter(|hit| hit.is_some()).count()
        })?;
        let (all, hits) = timed(context, &rays, |rays| {
            let mut hits = Vec::with_capacity(2 * rays.len());
            tracer.all_hits(rays, &mut hits);
            hits.len()
        })?;
        Ok(Self { rays: rays.len(), hits, closest: rays.len() as f64 / closest, all: rays.len() as f64 / all })
    }
}

/// Rays along an axis through a box around the origin, from a planar pattern that covers its shadow.
fn along(context: &Context, axis: usize, half: Vec3, count: f64) -> Result<Vec<Ray>> {
    let [x, y] = [1, 2].map(|step| (axis + step) % 3);
    // Even the shadow of a flat mesh has some width.
    let reach = [x, y].map(|axis| f64::from(half[axis]).max(1e-3));
    let domain = Domain { min: reach.map(|reach| -reach), max: reach, boundary: Boundary::Bounded };
    let radius = (MAXIMAL_DENSITY * domain.area() / count).sqrt();
    let options = kdrt::Options::new(radius).domain(domain).seed(1);
    let mut points = kdrt::sample(context, &options, None)?.positions;
    let tile = TILE * (domain.area() / count).sqrt();
    points.sort_by_cached_key(|point| {
        let [column, row] = point.map(|x| (f64::from(x) / tile).floor() as i64);
        (row, column)
    });
    let ray = |point: [f32; 2]| {
        let (mut origin, mut direction) = ([0.0; 3], [0.0; 3]);
        (origin[axis], origin[x], origin[y], direction[axis]) = (-1.0, point[0], point[1], 1.0);
        Ray { origin, direction }
    };
    Ok(points.into_iter().map(ray).collect())
}

/// The least seconds of three attempts on all threads, and the sum of what the tasks count.
fn timed(context: &Context, rays: &[Ray], task: impl Fn(&[Ray]) -> usize + Sync) -> Result<(f64, usize)> {
    let tasks: Vec<_> = rays.chunks(TASK).collect();
    let (mut least, mut count) = (f64::INFINITY, 0);
    for _ in 0..3 {
        let start = Instant::now();
        let quiet = |_| std::ops::ControlFlow::Continue(());
        let counts = rows::in_parallel(context.num_threads(), tasks.len(), &quiet, |i| task(tasks[i]))?;
        (least, count) = (least.min(start.elapsed().as_secs_f64()), counts.iter().sum());
    }
    Ok((least, count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_through_a_box_are_counted_with_all_their_hits() {
        let scene = super::super::scenes::scenes(None, None, 8).unwrap().0.remove(0);
        let rays = Rays::measure(&Context::new(2).unwrap(), &scene, 3000.0).unwrap();
        assert!((8000..10_000).contains(&rays.rays), "{}", rays.rays);
        // Each ray meets at least the two walls of the hall.
        assert!(rays.hits > 2 * rays.rays - 100 && rays.closest > 0.0 && rays.all > 0.0);
    }
}
