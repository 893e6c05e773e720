//! Tests against Embree traces: recorded rays and their hits, replayed one by one, in packets of each width and through
//! the filter, on whichever Embree is installed; and an oracle that needs no Embree.
//!
//! The traces were recorded with Embree 3.13.5, by single rays, with
//! `cargo test -p azulejo-conformance --test embree_traces record -- --ignored`.
//!
//! Two Embrees, or two widths, need not agree in the last bits: what rounding may do to a hit is what the oracle says.
//! That also settles rays through edges and vertices: a hit that rounding can hide may be missing, and one that rounding
//! can make may be there.

mod traces;

use azulejo::trace::{Hit, Ray, Scene};
use azulejo::{Error, Result};
use traces::file::Trace;
use traces::meshes::{self, Mesh};
use traces::oracle::Meeting;

const WIDTHS: [usize; 4] = [1, 4, 8, 16];
const NAMES: [&str; 5] = ["sphere", "torus", "soup", "slivers", "degenerate"];

fn recorded_mesh(name: &str) -> Mesh {
    match name {
        "sphere" => meshes::sphere(),
        "torus" => meshes::torus(),
        "soup" => meshes::soup(60, 0.8, 1),
        "slivers" => meshes::slivers(),
        _ => meshes::degenerate(),
    }
}

/// Rays of all kinds.
fn hard_rays(mesh: &Mesh, count: usize, seed: u64) -> Vec<Ray> {
    [meshes::rays(count / 2, seed), meshes::rays_at_edges(mesh, count - count / 2, seed)].concat()
}

fn scene(mesh: &Mesh) -> Scene {
    Scene::new(&mesh.positions, &mesh.triangles, 1).unwrap()
}

fn all_hits(scene: &Scene, width: usize, rays: &[Ray]) -> Vec<Hit> {
    let mut hits = Vec::new();
    scene.all_hits_in_packets(width, rays, &mut hits);
    hits
}

fn meeting(mesh: &Mesh, ray: &Ray, triangle: u32) -> Option<Meeting> {
    Meeting::of(ray, mesh.corners(triangle))
}

/// True for a hit that the oracle allows.
fn right(mesh: &Mesh, ray: &Ray, hit: &Hit) -> bool {
    meeting(mesh, ray, hit.triangle).is_some_and(|meeting| meeting.possible() && meeting.is(hit))
}

/// True for a hit that the oracle demands.
fn certain(mesh: &Mesh, ray: &Ray, hit: &Hit) -> bool {
    meeting(mesh, ray, hit.triangle).is_some_and(|meeting| meeting.certain())
}

fn of_ray(hits: &[Hit], ray: usize) -> &[Hit] {
    let from = |ray: usize| hits.partition_point(|hit| (hit.ray as usize) < ray);
    &hits[from(ray)..from(ray + 1)]
}

/// Each certain hit of the oracle must be there, each hit must be possible, where the oracle says, and in order.
fn assert_oracle_agrees(mesh: &Mesh, rays: &[Ray], hits: &[Hit]) {
    assert!(hits.is_sorted_by(|a, b| (a.ray, a.t, a.triangle) < (b.ray, b.t, b.triangle)));
    for (index, ray) in rays.iter().enumerate() {
        let hits = of_ray(hits, index);
        for hit in hits {
            assert!(hit.t > 0.0, "{hit:?}");
            assert!(right(mesh, ray, hit), "{ray:?}: {hit:?}, but {:?}", meeting(mesh, ray, hit.triangle));
            assert_eq!(hits.iter().filter(|other| other.triangle == hit.triangle).count(), 1, "{ray:?}");
        }
        for triangle in 0..mesh.triangles.len() as u32 {
            let meeting = meeting(mesh, ray, triangle);
            let found = hits.iter().any(|hit| hit.triangle == triangle);
            assert!(
                found || !meeting.is_some_and(|meeting| meeting.certain()),
                "{ray:?} misses {triangle}: {meeting:?}"
            );
        }
    }
}

#[test]
fn the_oracle_notices_hits_that_are_missing_invented_or_moved() {
    let Trace { mesh, rays, hits } = Trace::load("soup");
    assert_oracle_agrees(&mesh, &rays, &hits);
    let notices = |change: &dyn Fn(&mut Vec<Hit>)| {
        let mut changed = hits.clone();
        change(&mut changed);
        std::panic::catch_unwind(|| assert_oracle_agrees(&mesh, &rays, &changed)).is_err()
    };
    let ray = |hit: &Hit| &rays[hit.ray as usize];
    let sure: Vec<usize> = (0..hits.len()).filter(|&i| certain(&mesh, ray(&hits[i]), &hits[i])).collect();
    assert!(sure.len() > hits.len() / 2);
    for &i in sure.iter().step_by(sure.len() / 10) {
        let beside = (hits[i].triangle + 1) % mesh.triangles.len() as u32;
        assert!(notices(&|hits| _ = hits.remove(i)));
        assert!(notices(&|hits| hits.insert(i, hits[i])));
        assert!(notices(&|hits| hits[i].triangle = beside));
        assert!(notices(&|hits| hits[i].t *= 1.001));
    }
}

#[test]
#[ignore = "rewrites the recorded traces"]
fn record() {
    for (seed, name) in NAMES.into_iter().enumerate() {
        let mesh = recorded_mesh(name);
        let rays = hard_rays(&mesh, 160, seed as u64);
        let hits = all_hits(&scene(&mesh), 1, &rays);
        assert_oracle_agrees(&mesh, &rays, &hits);
        Trace { mesh, rays, hits }.save(name);
    }
}

/// True if a replayed hit is the recorded one: both differ from the truth by rounding.
fn same(meeting: &Meeting, a: &Hit, b: &Hit) -> bool {
    ((a.t - b.t) as f64).abs() <= 2.0 * meeting.t_error
        && (0..2).all(|i| ((a.uv[i] - b.uv[i]) as f64).abs() <= 2.0 * meeting.uv_error)
}

#[test]
fn every_width_finds_the_recorded_hits() {
    for name in NAMES {
        let Trace { mesh, rays, hits: recorded } = Trace::load(name);
        assert!(rays.len() >= 160 && recorded.len() >= rays.len(), "{name}: {} hits", recorded.len());
        let scene = scene(&mesh);
        for width in WIDTHS {
            let hits = all_hits(&scene, width, &rays);
            assert_oracle_agrees(&mesh, &rays, &hits);
            for hit in &recorded {
                let index = hit.ray as usize;
                let meeting = meeting(&mesh, &rays[index], hit.triangle).unwrap();
                let replayed = of_ray(&hits, index).iter().find(|replayed| replayed.triangle == hit.triangle);
                let found = replayed.map_or(!meeting.certain(), |replayed| same(&meeting, hit, replayed));
                assert!(found, "{name}, width {width}, {:?}: {hit:?}, but {replayed:?}", rays[index]);
            }
        }
    }
}

#[test]
fn every_width_finds_the_first_of_the_recorded_hits() {
    for name in NAMES {
        let Trace { mesh, rays, hits: recorded } = Trace::load(name);
        let scene = scene(&mesh);
        for width in WIDTHS {
            let closest = scene.closest_hits_in_packets(width, &rays);
            assert_eq!(closest.len(), rays.len());
            for (index, (ray, closest)) in rays.iter().zip(closest).enumerate() {
                let first = of_ray(&recorded, index).iter().find(|hit| certain(&mesh, ray, hit));
                let Some(closest) = closest else {
                    assert_eq!(first, None, "{name}, width {width}, {ray:?}");
                    continue;
                };
                assert_eq!(closest.ray as usize, index);
                assert!(right(&mesh, ray, &closest), "{name}, width {width}, {ray:?}: {closest:?}");
                let Some(first) = first else { continue };
                let t_error = meeting(&mesh, ray, first.triangle).unwrap().t_error;
                let passed = (closest.t - first.t) as f64 > 2.0 * t_error;
                assert!(!passed, "{name}, width {width}, {ray:?}: {closest:?}, but {first:?}");
            }
        }
        assert_eq!(scene.closest_hits(&rays), scene.closest_hits_in_packets(1, &rays));
    }
}

#[test]
fn the_oracle_agrees_on_random_soups() {
    for (seed, (count, size)) in [(1, 1.0), (20, 1.0), (300, 0.5), (2000, 0.1)].into_iter().enumerate() {
        let mesh = meshes::soup(count, size, 100 + seed as u64);
        let rays = hard_rays(&mesh, 2000, seed as u64);
        let scene = scene(&mesh);
        let mut hits = Vec::new();
        scene.all_hits(&rays, &mut hits);
        assert!(hits.len() > 100, "{count} triangles: {} hits", hits.len());
        assert_oracle_agrees(&mesh, &rays, &hits);
    }
}

/// Rays from inside a closed surface leave it, whatever edge or vertex they pass through.
#[test]
fn a_closed_surface_has_no_cracks() {
    let mesh = meshes::torus();
    let scene = scene(&mesh);
    let origin = [0.7, 0.01, 0.02];
    let aimed = |target: [f32; 3]| Ray { origin, direction: std::array::from_fn(|axis| target[axis] - origin[axis]) };
    let parts = (0..=8).map(|part| part as f32 / 8.0);
    let edges = mesh.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let rays: Vec<Ray> = edges
        .flat_map(|edge| parts.clone().map(move |part| (edge.map(|vertex| vertex as usize), part)))
        .map(|([a, b], part)| (mesh.positions[a], mesh.positions[b], part))
        .map(|(a, b, part)| aimed(std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))))
        .collect();
    for width in WIDTHS {
        let hits = all_hits(&scene, width, &rays);
        for (index, ray) in rays.iter().enumerate() {
            assert!(!of_ray(&hits, index).is_empty(), "width {width}: {ray:?} escapes");
        }
    }
}

/// The other rays of its packet can decide only whether a ray meets an edge, never where it meets a triangle.
#[test]
fn rays_may_be_cut_into_any_chunks() {
    let mesh = meshes::soup(500, 0.3, 7);
    let rays = hard_rays(&mesh, 3000, 8);
    let scene = scene(&mesh);
    for width in WIDTHS {
        let whole = all_hits(&scene, width, &rays);
        let certain = |hits: &[Hit]| -> Vec<Hit> {
            hits.iter().filter(|hit| certain(&mesh, &rays[hit.ray as usize], hit)).copied().collect()
        };
        for size in [1, 3, 16, 37, 160, 1000] {
            let mut hits = Vec::new();
            for (index, chunk) in rays.chunks(size).enumerate() {
                let before = hits.len();
                scene.all_hits_in_packets(width, chunk, &mut hits);
                hits[before..].iter_mut().for_each(|hit| hit.ray += (index * size) as u32);
            }
            assert!(certain(&hits) == certain(&whole), "width {width}, chunks of {size}");
            // The same packets: the same hits.
            assert!(size % width != 0 || hits == whole, "width {width}, chunks of {size}");
        }
    }
}

/// Embree's rounding can give such a triangle an area, and its hits barycentrics that mean nothing.
#[test]
fn triangles_without_area_are_never_hit() {
    let mut mesh = meshes::soup(200, 0.5, 15);
    // Few enough bits for the middle of an edge to be exact.
    mesh.positions.iter_mut().flatten().for_each(|x| *x = (*x * 1048576.0).round() / 1048576.0);
    let middles = mesh.triangles.iter().map(|&[a, b, _]| {
        let [a, b] = [a, b].map(|vertex| mesh.positions[vertex as usize]);
        std::array::from_fn(|axis| (a[axis] + b[axis]) / 2.0)
    });
    let positions: Vec<[f32; 3]> = mesh.positions.iter().copied().chain(middles).collect();
    let flattened = |(i, &[a, b, c]): (usize, &[u32; 3])| [[a, b, a], [b, b, c], [c, c, c], [a, 600 + i as u32, b]];
    let triangles = mesh.triangles.iter().enumerate().flat_map(flattened).collect();
    let mesh = Mesh { positions, triangles };
    let scene = scene(&mesh);
    for width in WIDTHS {
        assert_eq!(all_hits(&scene, width, &hard_rays(&mesh, 20_000, 16)), []);
    }
}

#[test]
fn threads_share_a_scene() {
    let mesh = meshes::soup(500, 0.3, 9);
    let rays = hard_rays(&mesh, 5000, 10);
    let scene = Scene::new(&mesh.positions, &mesh.triangles, 2).unwrap();
    let expected = all_hits(&scene, scene.packet_width(), &rays);
    std::thread::scope(|scope| {
        let threads = [(); 4].map(|_| scope.spawn(|| all_hits(&scene, scene.packet_width(), &rays)));
        for thread in threads {
            assert!(thread.join().unwrap() == expected);
        }
    });
}

#[test]
fn a_scene_does_not_depend_on_the_threads_that_build_it() {
    let mesh = meshes::soup(20_000, 0.05, 11);
    let rays = hard_rays(&mesh, 5000, 12);
    let expected = all_hits(&scene(&mesh), 16, &rays);
    for threads in [0, 2, 4] {
        let scene = Scene::new(&mesh.positions, &mesh.triangles, threads).unwrap();
        assert!(all_hits(&scene, 16, &rays) == expected, "{threads} threads");
    }
}

#[test]
fn rays_that_cannot_be_traced_hit_nothing_and_leave_the_others_alone() {
    let mesh = meshes::soup(100, 0.8, 13);
    let scene = scene(&mesh);
    let good = meshes::rays(64, 14);
    let bad: Vec<Ray> = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38]
        .into_iter()
        .flat_map(|bad| {
            (0..6).map(move |component| {
                let mut ray = Ray { origin: [0.0; 3], direction: [1.0; 3] };
                if component < 3 {
                    ray.origin[component] = bad
                } else {
                    ray.direction[component - 3] = bad
                }
                ray
            })
        })
        .filter(|ray| ray.direction.iter().all(|x| !x.is_finite() || *x == 1.0))
        .chain([Ray { origin: [0.0; 3], direction: [0.0; 3] }, Ray { origin: [0.0; 3], direction: [-0.0; 3] }])
        .collect();
    let mixed: Vec<Ray> = (0..64).flat_map(|i| [good[i], bad[i % bad.len()]]).collect();
    for width in WIDTHS {
        let mut hits = all_hits(&scene, width, &mixed);
        assert!(hits.iter().all(|hit| hit.ray % 2 == 0));
        hits.iter_mut().for_each(|hit| hit.ray /= 2);
        assert_eq!(hits, all_hits(&scene, width, &good));
        let closest = scene.closest_hits_in_packets(width, &mixed);
        assert!(closest.iter().skip(1).step_by(2).all(Option::is_none));
    }
    assert_eq!(all_hits(&scene, 16, &bad), []);
}

#[test]
fn directions_may_have_any_length() {
    let corners = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 3.0, 1.0]];
    let scene = Scene::new(&corners, &[[0, 1, 2]], 1).unwrap();
    for length in [1e-37, 1e-20, 0.25, 1.0, 3.0, 1e20, 1e37] {
        let ray = Ray { origin: [0.5, 0.25, 0.0], direction: [0.0, 0.0, length] };
        for width in WIDTHS {
            let hits = all_hits(&scene, width, &[ray]);
            let Hit { t, uv: [u, v], .. } = hits[0];
            assert!((t * length - 1.0).abs() < 1e-6 && (u - 0.375).abs() < 1e-6 && (v - 0.3125).abs() < 1e-6);
            assert_eq!(scene.closest_hits_in_packets(width, &[ray]), [Some(hits[0])]);
        }
    }
}

#[test]
fn hits_are_appended_and_empty_calls_are_fine() {
    let corners = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 3.0, 1.0]];
    let up = Ray { origin: [0.0; 3], direction: [0.0, 0.0, 1.0] };
    let scene = Scene::new(&corners, &[[0, 1, 2]], 1).unwrap();
    assert!([4, 8, 16].contains(&scene.packet_width()));
    let mut hits = Vec::new();
    scene.all_hits(&[up], &mut hits);
    scene.all_hits(&[], &mut hits);
    scene.all_hits(&[up], &mut hits);
    assert_eq!(hits.len(), 2);
    for empty in [Scene::new(&[], &[], 1).unwrap(), Scene::new(&corners, &[], 1).unwrap()] {
        hits.clear();
        empty.all_hits(&[up; 5], &mut hits);
        assert_eq!(hits, []);
        assert_eq!(empty.closest_hits(&[up; 5]), [None; 5]);
    }
}

#[test]
fn bad_triangles_are_refused_by_name() {
    fn refused(argument: &str, scene: Result<Scene>) {
        let error = scene.err().expect("an error");
        assert!(matches!(error, Error::InvalidArgument { argument: name, .. } if name == argument), "{error}");
    }
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.1e18] {
        for axis in 0..3 {
            let mut corners = corners;
            corners[1][axis] = bad;
            refused("positions", Scene::new(&corners, &[[0, 1, 2]], 1));
            // Also where no triangle uses it.
            refused("positions", Scene::new(&corners, &[], 1));
        }
    }
    for bad in [3, u32::MAX] {
        for corner in 0..3 {
            let mut triangle = [0, 1, 2];
            triangle[corner] = bad;
            refused("triangles", Scene::new(&corners, &[[0, 1, 2], triangle], 1));
        }
    }
    refused("triangles", Scene::new(&[], &[[0, 0, 0]], 1));
}
