//! Meshes against those that spade builds of all points at once, and eight points at a time against one by one.

use glam::Vec2;

use crate::dcr::ground::constraints::Force;
use crate::dcr::ground::wandering::{self, random_places, with_and_without_mesh};
use crate::dcr::uniform::flip_mesh::*;
use crate::job::Context;
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// What spade makes of all points at once.
fn anew(job: &Job, torus: &Torus, places: &[TorusPoint]) -> (FlipMesh, f64) {
    let delaunay = Delaunay::new(job, &torus.frame, torus.nudged(places).into_iter()).unwrap();
    let mesh = FlipMesh::of_delaunay(job, torus, places, &delaunay).unwrap().expect("there is a mesh");
    (mesh, delaunay.coverage())
}

/// The rings, each from its least neighbour on.
fn rings(mesh: &FlipMesh) -> Vec<Vec<u32>> {
    let turned = |point: usize| {
        let mut ring = mesh.rings.ring(point).to_vec();
        let least = (0..ring.len()).min_by_key(|&k| ring[k]).unwrap();
        ring.rotate_left(least);
        ring
    };
    (0..mesh.rings.len()).map(turned).collect()
}

fn offsets(mesh: &FlipMesh, places: &[TorusPoint], point: usize) -> Vec<Vec2> {
    mesh.rings.ring(point).iter().map(|&other| mesh.torus.offset_f32(places[point], places[other as usize])).collect()
}

/// Points wander; after every repair the mesh is a torus, locally Delaunay, and what spade builds from nothing.
#[test]
fn repaired_meshes_are_those_that_are_built_anew() {
    let context = Context::new(1).unwrap();
    for (boundary, width, count) in
        [(Boundary::Periodic, 1.0, 600), (Boundary::Periodic, 3.0, 9000), (Boundary::Bounded, 1.5, 300)]
    {
        let (torus, mut places) = random_places(boundary, width, count);
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        context
            .run(None, |job| {
                let (mut mesh, _) = anew(job, &torus, &places);
                let mut flipped = 0;
                for _ in 0..25 {
                    wander(&mesh, &mut places, count, &mut rng);
                    let before = rings(&mesh);
                    assert!(mesh.repair(job, &places)?, "a triangle turned over");
                    flipped += usize::from(before != rings(&mesh));
                    assert!((0..places.len()).all(|point| mesh.rings.agree(point)));
                    assert!(is_delaunay(&mut mesh, &places));
                    let (built, coverage) = anew(job, &torus, &places);
                    // The corners of a mirrored rectangle lie on one circle: there spade may take the other diagonal.
                    if boundary == Boundary::Periodic {
                        assert!(rings(&mesh) == rings(&built));
                    }
                    assert!((mesh.coverage(job, &places)? - coverage).abs() < 1e-5);
                }
                assert!(flipped > 10);
                Ok(())
            })
            .unwrap();
    }
}

/// Moves the points as far as their triangles allow, and their images with them.
fn wander(mesh: &FlipMesh, places: &mut Vec<TorusPoint>, count: usize, rng: &mut Rng) {
    let before = places.clone();
    wandering::wander(&mesh.torus, places, count, |point| offsets(mesh, &before, point), rng);
}

fn is_delaunay(mesh: &mut FlipMesh, places: &[TorusPoint]) -> bool {
    let edges: Vec<Edge> = (0..places.len())
        .flat_map(|point| mesh.rings.ring(point).iter().map(move |&other| [point as u32, other]))
        .collect();
    let torus = mesh.torus;
    let whole = mesh.rings.patches(places.len()).next().unwrap();
    edges.into_iter().all(|[p, q]| {
        let [r, s] = whole.apices([p, q]).unwrap();
        !must_flip(&torus, [p, q, r, s].map(|point| places[point as usize]))
    })
}

/// Tile by tile, and with flips patch by patch, meshes are the same as those of all points at once, for any threads.
#[test]
fn meshes_are_the_same_by_tiles_and_by_threads() {
    let (torus, mut places) = random_places(Boundary::Periodic, 1.0, 50_000);
    let (one, four) = (Context::new(1).unwrap(), Context::new(4).unwrap());
    let mut whole = one.run(None, |job| Ok(anew(job, &torus, &places).0)).unwrap();
    assert!(one.run(None, |job| tiles::triangulate(job, &torus, &places)).unwrap().is_some());
    let build = |context: &Context| context.run(None, |job| FlipMesh::new(job, &torus, &places)).unwrap().unwrap();
    let (mut alone, mut together) = (build(&one), build(&four));
    assert!(rings(&alone) == rings(&whole) && rings(&together) == rings(&whole));
    wander(&whole, &mut places, 50_000, &mut Rng::at(5, Draw::Probe, &[]));
    let before = rings(&whole);
    for (mesh, context) in [(&mut whole, &one), (&mut alone, &one), (&mut together, &four)] {
        assert!(context.run(None, |job| mesh.repair(job, &places)).unwrap());
    }
    assert!(before != rings(&whole) && mesh_slots(&alone) == mesh_slots(&together));
}

/// The slots as they are: the threads must not even turn a ring.
fn mesh_slots(mesh: &FlipMesh) -> Vec<Vec<u32>> {
    (0..mesh.rings.len()).map(|point| mesh.rings.ring(point).to_vec()).collect()
}

/// Records what points gather.
#[derive(Default)]
struct Record {
    forces: Vec<(Vec2, f32)>,
    violated: Vec<usize>,
    is_unsound: bool,
}

impl Visitor for Record {
    fn visit(&mut self, _: &Rings, points: Range<usize>, gathered: &Gathered) {
        let force =
            |lane: usize| (Vec2::new(gathered.force[0][lane], gathered.force[1][lane]), gathered.clearance[lane]);
        self.forces.extend((0..points.len()).map(force));
        self.violated.extend(gathered.violated(points.len()).map(|lane| points.start + lane));
        self.is_unsound |= !gathered.are_sound(points.len());
    }
}

/// Eight points at a time gather to the bit what each gathers alone, at any level of vectors.
#[test]
fn vectors_change_nothing() {
    let context = Context::new(1).unwrap();
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
        let (torus, places) = random_places(boundary, 1.0, 1003);
        let mesh = context.run(None, |job| Ok(anew(job, &torus, &places).0)).unwrap();
        let constraints = Constraints { conflict_radius: 0.862, coverage_radius: 0.66, push: 0.4, pull: 0.2 };
        for level in Level::available() {
            let mut record = Record::default();
            mesh.gather(level, &places, &constraints, 0..places.len(), &mut record);
            assert!(!record.is_unsound && record.forces.len() == places.len());
            for (point, &(sum, clearance)) in record.forces.iter().enumerate() {
                let alone: Force = constraints.force(&offsets(&mesh, &places, point));
                assert!((sum, clearance) == (alone.sum, alone.clearance), "{level:?}, {point}: {sum} {}", alone.sum);
                let violated = is_violated(&mesh, &places, point);
                assert_eq!(record.violated.contains(&point), violated, "{level:?}, {point}");
            }
        }
    }
}

/// Whether another point is closer than 0.85, or a triangle wider than 0.67.
fn is_violated(mesh: &FlipMesh, places: &[TorusPoint], point: usize) -> bool {
    let offsets = offsets(mesh, places, point);
    let own = mesh.torus.image_distances(places[point]);
    let is_own = |offset: &Vec2| offset.to_array() == [own[0], 0.0] || offset.to_array() == [0.0, own[1]];
    let wide = |(a, b): (&Vec2, &Vec2)| a.length() * b.length() * a.distance(*b) / (2.0 * a.perp_dot(*b)) > 0.67;
    let pairs = || offsets.iter().zip(offsets.iter().cycle().skip(1));
    offsets.iter().any(|offset| offset.length() < 0.85 && !is_own(offset)) || pairs().any(wide)
}

#[test]
fn few_points_and_large_holes_have_no_mesh_and_turned_triangles_end_one() {
    let context = Context::new(1).unwrap();
    for (torus, mut places, has_mesh) in with_and_without_mesh() {
        context
            .run(None, |job| {
                let mesh = FlipMesh::new(job, &torus, &places)?;
                assert_eq!(mesh.is_some(), has_mesh);
                if let Some(mut mesh) = mesh {
                    places.swap(0, 250);
                    assert!(!mesh.repair(job, &places)?);
                }
                Ok(())
            })
            .unwrap();
    }
}

/// A point with more neighbours than there are slots is in no mesh.
#[test]
fn hubs_have_no_mesh() {
    let torus = Torus::new(Domain::unit(Boundary::Periodic), 1000);
    let ring = (0..100).map(|i| glam::DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 100.0) * 0.1 + 0.5);
    let mut rng = Rng::at(4, Draw::Probe, &[]);
    let others = (0..400).map(|_| glam::DVec2::new(rng.unit(), rng.unit()));
    let others = others.filter(|point| point.distance(glam::DVec2::splat(0.5)) > 0.11);
    let points = ring.chain(others).chain([glam::DVec2::splat(0.5)]).map(|point| point.as_vec2().to_array());
    let places = torus.enter(&points.collect::<Vec<_>>(), 0);
    let mesh = Context::new(1).unwrap().run(None, |job| FlipMesh::new(job, &torus, &places)).unwrap();
    assert!(mesh.is_none());
}
