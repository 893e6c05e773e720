//! Points for the tests of kept meshes: random sets, random moves as far as a mesh allows, and sets without a mesh.

use glam::Vec2;

use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// Random places of the torus that a domain is or is mirrored on, and the torus. The images come after the points.
pub(in crate::dcr) fn random_places(boundary: Boundary, width: f64, count: usize) -> (Torus, Vec<TorusPoint>) {
    let torus = Torus::new(Domain { min: [0.0; 2], max: [width, 1.0], boundary }, count);
    let mut rng = Rng::at(3, Draw::Probe, &[count as u64]);
    let points: Vec<_> = (0..count).map(|_| [rng.unit() * width, rng.unit()].map(|x| x as f32)).collect();
    let places = torus.with_images(&torus.enter(&points, 0));
    (torus, places)
}

/// Moves the first `count` points as far as their triangles allow, and their images with them. `offsets` gives those of
/// the neighbours of a point, counter-clockwise.
pub(in crate::dcr) fn wander(
    torus: &Torus,
    places: &mut Vec<TorusPoint>,
    count: usize,
    offsets: impl Fn(usize) -> Vec<Vec2>,
    rng: &mut Rng,
) {
    let clearance = |point: usize| {
        let ring = offsets(point);
        let height = |(a, b): (&Vec2, &Vec2)| a.perp_dot(*b) / a.length().max(b.length()).max(a.distance(*b));
        ring.iter().zip(ring.iter().cycle().skip(1)).map(height).fold(f32::INFINITY, f32::min)
    };
    let clearances: Vec<f32> = (0..count).map(clearance).collect();
    let moved = |(&place, clearance): (&TorusPoint, f32)| {
        torus.moved(place, Vec2::from_angle(rng.unit() as f32 * 6.3) * 0.45 * clearance)
    };
    let points: Vec<TorusPoint> = places[..count].iter().zip(clearances).map(moved).collect();
    *places = torus.with_images(&points);
}

/// Sets of the unit torus, and whether they have a mesh: a few points, a set with a large hole, and one without.
pub(in crate::dcr) fn with_and_without_mesh() -> [(Torus, Vec<TorusPoint>, bool); 3] {
    let mut rng = Rng::at(4, Draw::Probe, &[]);
    [(5, 1.0, false), (500, 0.5, false), (500, 1.0, true)].map(|(count, part, has_mesh)| {
        let points: Vec<_> = (0..count).map(|_| [rng.unit() * part, rng.unit() * part].map(|x| x as f32)).collect();
        let torus = Torus::new(Domain::unit(Boundary::Periodic), count);
        let places = torus.enter(&points, 0);
        (torus, places, has_mesh)
    })
}
