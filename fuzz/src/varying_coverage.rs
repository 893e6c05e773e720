//! Whether sets whose radii vary cover a mesh: by bisection, as plainly as can be.

use azulejo_c::mesh::*;

use crate::calls::{Arrays, array};
use crate::surface::{Corners, Given};

type Place = [f64; 3];

/// What covers a place of radius `r` up to `own + share * r` from the centre.
#[derive(Clone, Copy)]
pub(crate) struct Ball {
    centre: Place,
    own: f64,
    share: f64,
}

impl Ball {
    /// Up to the mean of both radii.
    pub fn of_samples(set: &Arrays) -> Vec<Self> {
        let (positions, _) = set.positions.as_chunks::<3>();
        let ball = |(position, radius): (&[f32; 3], &f64)| Self {
            centre: position.map(f64::from),
            own: radius / 2.0,
            share: 0.5,
        };
        positions.iter().zip(set.radii).map(ball).collect()
    }

    /// Up to their clearances.
    pub fn of_given(given: &Given) -> Vec<Self> {
        let clearances = given.clearances.iter().flatten();
        let ball = |(position, &own): (&[f32; 3], &f64)| Self { centre: position.map(f64::from), own, share: 0.0 };
        given.positions.iter().zip(clearances).map(ball).filter(|ball| ball.own > 0.0).collect()
    }
}

/// Values at the vertices of a mesh, linear between them, and the radius at a value, which rises or falls with it.
pub(crate) struct Field<'a> {
    pub at_vertices: &'a [f64],
    pub radius: fn(f64) -> f64,
}

/// A part of a triangle: its corners, and the values there.
type Part = [(Place, f64); 3];

/// Every place is covered, up to what the header allows: six float spacings and what the radius changes over them, and
/// 2^-22 of the largest difference of radii on a triangle. Meshes with a mask are left out, since it is not known here.
pub(crate) fn check_covered(mesh: &azulejo_mesh, corners: &Corners, field: &Field, balls: &[Ball]) {
    // SAFETY: the header says how long the array is; the mesh is borrowed.
    let indices = unsafe { array(azulejo_mesh_indices(Some(mesh)), 3 * azulejo_mesh_triangle_count(Some(mesh))) };
    let area: f64 = corners.0.iter().map(area).sum();
    if area > (1.0 + 1e-6) * azulejo_mesh_area(Some(mesh)) {
        return;
    }
    let spacing = 6.0 * corners.largest_coordinate() * f64::from(f32::EPSILON);
    for (places, vertices) in corners.0.iter().zip(indices.as_chunks::<3>().0) {
        let part: Part = std::array::from_fn(|i| (places[i], field.at_vertices[vertices[i] as usize]));
        let height = 2.0 * self::area(places) / longest(&part);
        if height > 0.0 {
            let radii = part.map(|(_, value)| (field.radius)(value));
            let change = radii.into_iter().fold(0.0, f64::max) - least(field, &part);
            let tolerance = spacing * (1.0 + change / height) + change * 2f64.powi(-22);
            let gap = gap(field, &part, balls, tolerance);
            assert!(gap.is_none(), "{gap:?} on {part:?} is not covered");
        }
    }
}

/// A place that is not covered.
fn gap(field: &Field, part: &Part, balls: &[Ball], tolerance: f64) -> Option<Place> {
    let (least, longest, corner) = (least(field, part), longest(part), part[0].0);
    let covers = |ball: &Ball| {
        part.iter().all(|corner| distance(corner.0, ball.centre) <= ball.own + ball.share * least + tolerance)
    };
    if balls.iter().any(covers) {
        return None;
    }
    if longest <= tolerance / 64.0 {
        return Some(corner);
    }
    let largest = part.iter().map(|corner| (field.radius)(corner.1)).fold(0.0, f64::max);
    let touches = |ball: &&Ball| distance(corner, ball.centre) <= ball.own + ball.share * largest + longest + tolerance;
    let balls: Vec<_> = balls.iter().filter(touches).copied().collect();
    halves(part).iter().find_map(|half| gap(field, half, &balls, tolerance))
}

/// No place of a part has a smaller radius.
fn least(field: &Field, part: &Part) -> f64 {
    part.iter().map(|corner| (field.radius)(corner.1)).fold(f64::INFINITY, f64::min)
}

/// The two parts on both sides of the longest edge's middle.
fn halves(part: &Part) -> [Part; 2] {
    let apex = (0..3).max_by(|&i, &j| opposite(part, i).total_cmp(&opposite(part, j))).expect("three edges");
    let [a, b, c] = [0, 1, 2].map(|i| part[(apex + i) % 3]);
    let middle = (std::array::from_fn(|axis| (b.0[axis] + c.0[axis]) / 2.0), (b.1 + c.1) / 2.0);
    [[a, b, middle], [a, middle, c]]
}

/// The edge that a corner is not on.
fn opposite(part: &Part, corner: usize) -> f64 {
    distance(part[(corner + 1) % 3].0, part[(corner + 2) % 3].0)
}

fn longest(part: &Part) -> f64 {
    (0..3).map(|corner| opposite(part, corner)).fold(0.0, f64::max)
}

fn distance(a: Place, b: Place) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

fn area(&[a, b, c]: &[Place; 3]) -> f64 {
    let [e, f] = [b, c].map(|place| -> Place { std::array::from_fn(|axis| place[axis] - a[axis]) });
    let cross = |i: usize, j: usize| (e[i] * f[j] - e[j] * f[i]).powi(2);
    (cross(1, 2) + cross(2, 0) + cross(0, 1)).sqrt() / 2.0
}
