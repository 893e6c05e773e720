//! The speed of tracing rays like those of an iteration, by `azulejo::trace` and by Embree alone.

use std::time::Instant;

use azulejo::mesh::Mesh;
use azulejo::trace::{Ray, Scene};
use azulejo::{Boundary, Context, Domain, kdrt};
use glam::DVec3;
use rayon::prelude::*;

use crate::bare::{Bare, Packets};

/// Rays per task, as in `psp`.
const CHUNK: usize = 4096;
/// Attempts, of which the fastest counts.
const ATTEMPTS: usize = 5;
/// The most rays: they are all held at once.
const MOST_RAYS: usize = 4_000_000;

/// Rays per second through a mesh, on the threads of a context: by `azulejo::trace`, and by Embree alone.
pub fn rates(context: &Context, mesh: &Mesh, radius: f64) -> [f64; 2] {
    let (low, high) = mesh.bounds();
    let (low, high) = (DVec3::from_array(low.map(f64::from)), DVec3::from_array(high.map(f64::from)));
    let (centre, scale) = (0.5 * (low + high), (high - low).length().recip());
    let normalise = |p: &[f32; 3]| ((DVec3::from_array(p.map(f64::from)) - centre) * scale).as_vec3().to_array();
    let positions: Vec<_> = mesh.positions().iter().map(normalise).collect();
    let rays = rays(context, 0.5 * scale * (high - low), radius * scale);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(context.num_threads()).build().expect("threads");

    let scene = Scene::new(&positions, mesh.triangles(), context.num_threads()).expect("a scene");
    let trace = || {
        let hits = |rays: &[Ray]| {
            let mut hits = Vec::with_capacity(2 * rays.len());
            scene.all_hits(rays, &mut hits);
            hits.len() as u64
        };
        rays.par_chunks(CHUNK).map(hits).sum::<u64>()
    };
    let bare = Bare::new(&positions, mesh.triangles());
    let mut packets = Packets::new(scene.packet_width(), &rays);
    let (mut traced, mut alone) = (f64::INFINITY, f64::INFINITY);
    pool.install(|| {
        for _ in 0..ATTEMPTS {
            let start = Instant::now();
            let found = trace();
            traced = traced.min(start.elapsed().as_secs_f64());
            let start = Instant::now();
            let expected = bare.count_hits(&mut packets);
            alone = alone.min(start.elapsed().as_secs_f64());
            // The last packet is filled up, and Embree may meet a triangle twice.
            assert!(found.abs_diff(expected) < 1000 + expected / 1000, "{found} and {expected} hits");
        }
    });
    [traced, alone].map(|seconds| rays.len() as f64 / seconds)
}

/// Three orthogonal projectors, askew; those of their rays that meet the box, near ones together.
fn rays(context: &Context, half_box: DVec3, radius: f64) -> Vec<Ray> {
    let side = (1.0 / radius).clamp(8.0, 2390.0);
    let domain = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic };
    let options = kdrt::Options::new(1.0).domain(domain).seed(1);
    let mut points = kdrt::sample(context, &options, None).expect("a pattern").positions;
    points.sort_by_cached_key(|point| {
        let [x, y] = point.map(|x| (f64::from(x) / side * 65536.0) as u32);
        (0..16).fold(0u32, |key, bit| key | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1))
    });
    let frame = glam::DMat3::from_quat(glam::DQuat::from_xyzw(0.3, -0.2, 0.5, 0.8).normalize());
    let repetitions = (1.0 / (radius * side)).ceil() as u32;
    let mut rays = Vec::new();
    for axis in 0..3 {
        let [right, up, forward] = [1, 2, 0].map(|step| frame.col((axis + step) % 3));
        for (column, row) in (0..repetitions).flat_map(|row| (0..repetitions).map(move |column| (column, row))) {
            let corner = [column, row].map(|step| f64::from(step) * side);
            let on_plane = points.iter().map(|point| {
                let [x, y] = [0, 1].map(|axis| (f64::from(point[axis]) + corner[axis]) * radius - 0.5);
                x * right + y * up
            });
            let meets_box = on_plane.filter(|&point| {
                let (a, b) = ((-half_box - point) / forward, (half_box - point) / forward);
                a.min(b).max_element() <= a.max(b).min_element()
            });
            rays.extend(meets_box.map(|point| Ray {
                origin: (point - forward).as_vec3().to_array(),
                direction: forward.as_vec3().to_array(),
            }));
        }
    }
    rays.truncate(MOST_RAYS);
    rays
}
