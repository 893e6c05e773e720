//! The coverage of a mesh, also where radii vary: by plain bisection.

use azulejo_c::mesh::*;

use crate::calls::{Arrays, Owned, array};
use crate::surface::{Corners, Given};

type Place = [f64; 3];

/// A ball that covers positions of radius `r` up to `own + share * r` from its centre.
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

    /// Up to a distance for each.
    pub fn of_positions(positions: &[[f32; 3]], own: impl Fn(usize) -> f64) -> Vec<Self> {
        let ball =
            |(i, position): (usize, &[f32; 3])| Self { centre: position.map(f64::from), own: own(i), share: 0.0 };
        positions.iter().enumerate().map(ball).filter(|ball| ball.own > 0.0).collect()
    }

    /// Up to their clearances, or to the radius.
    pub fn of_given(given: &Given, radius: f64) -> Vec<Self> {
        Self::of_positions(&given.positions, |i| given.clearances.as_ref().map_or(radius, |clearances| clearances[i]))
    }
}

/// The radius on a mesh, as the caller knows it.
pub(crate) enum Field<'a> {
    /// It matters only to those of radii that vary.
    None,
    /// Values at the vertices of a mesh, linear between them, and the radius at a value, which rises or falls with it.
    AtVertices { values: &'a [f64], radius: fn(f64) -> f64 },
    /// A function, and the slope that it promises.
    Function { at: &'a dyn Fn(Place) -> f64, slope: f64 },
}

/// A part of a triangle: its corners, and the values there.
type Part = [(Place, f64); 3];

impl Field<'_> {
    fn part(&self, places: &[Place; 3], vertices: &[u32; 3]) -> Part {
        std::array::from_fn(|i| match self {
            Self::None => (places[i], 0.0),
            Self::AtVertices { values, .. } => (places[i], values[vertices[i] as usize]),
            Self::Function { at, .. } => (places[i], at(places[i])),
        })
    }

    fn middle(&self, b: (Place, f64), c: (Place, f64)) -> (Place, f64) {
        let place = std::array::from_fn(|axis| (b.0[axis] + c.0[axis]) / 2.0);
        match self {
            Self::Function { at, .. } => (place, at(place)),
            _ => (place, (b.1 + c.1) / 2.0),
        }
    }

    /// No place of a part has a radius below the first or above the second.
    fn range(&self, part: &Part) -> [f64; 2] {
        let (radius, change): (fn(f64) -> f64, _) = match self {
            Self::None => (|_| 0.0, 0.0),
            Self::AtVertices { radius, .. } => (*radius, 0.0),
            Self::Function { slope, .. } => (|radius| radius, slope * longest(part)),
        };
        let radii = part.map(|(_, value)| radius(value));
        [radii.into_iter().fold(f64::INFINITY, f64::min) - change, radii.into_iter().fold(0.0, f64::max) + change]
    }

    /// The tolerance of the header on a triangle: six float spacings, the change of the radius over them, and 2^-22 of
    /// the largest difference of radii on the triangle.
    fn tolerance(&self, part: &Part, height: f64, spacing: f64) -> f64 {
        match self {
            Self::Function { slope, .. } => spacing * (1.0 + slope),
            _ => {
                let [least, largest] = self.range(part);
                spacing * (1.0 + (largest - least) / height) + (largest - least) * 2f64.powi(-22)
            }
        }
    }
}

/// A place that is not covered, of those triangles that are to be. Meshes with a mask of their own are left out, since
/// it is not known here.
pub(crate) fn uncovered(
    mesh: &Owned<azulejo_mesh>,
    corners: &Corners,
    field: &Field,
    balls: &[Ball],
    is_asked: impl Fn(usize) -> bool,
) -> Option<Place> {
    // SAFETY: the header says how long the array is; the mesh is borrowed.
    let indices = unsafe { array(mesh.read(azulejo_mesh_indices), 3 * mesh.read(azulejo_mesh_triangle_count)) };
    if corners.0.iter().map(area).sum::<f64>() > (1.0 + 1e-6) * mesh.read(azulejo_mesh_area) {
        return None;
    }
    let spacing = 6.0 * corners.largest_coordinate() * f64::from(f32::EPSILON);
    let triangles = corners.0.iter().zip(indices.as_chunks::<3>().0).enumerate();
    triangles.filter(|(triangle, _)| is_asked(*triangle)).find_map(|(_, (places, vertices))| {
        let part = field.part(places, vertices);
        let height = 2.0 * area(places) / longest(&part);
        (height > 0.0).then(|| gap(field, &part, balls, field.tolerance(&part, height, spacing))).flatten()
    })
}

/// A place that is not covered.
fn gap(field: &Field, part: &Part, balls: &[Ball], tolerance: f64) -> Option<Place> {
    let ([least, largest], longest, corner) = (field.range(part), longest(part), part[0].0);
    let covers = |ball: &Ball| {
        part.iter().all(|corner| distance(corner.0, ball.centre) <= ball.own + ball.share * least + tolerance)
    };
    if balls.iter().any(covers) {
        return None;
    }
    if longest <= tolerance / 64.0 {
        return Some(corner);
    }
    let touches = |ball: &&Ball| distance(corner, ball.centre) <= ball.own + ball.share * largest + longest + tolerance;
    let balls: Vec<_> = balls.iter().filter(touches).copied().collect();
    halves(field, part).iter().find_map(|half| gap(field, half, &balls, tolerance))
}

/// The two parts on both sides of the longest edge's middle.
fn halves(field: &Field, part: &Part) -> [Part; 2] {
    let apex = (0..3).max_by(|&i, &j| opposite(part, i).total_cmp(&opposite(part, j))).expect("three edges");
    let [a, b, c] = [0, 1, 2].map(|i| part[(apex + i) % 3]);
    let middle = field.middle(b, c);
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

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.1015;

    /// The unit square of two triangles, and samples of a lattice that just cover it.
    fn square() -> (Corners, Vec<[f32; 3]>) {
        let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let step = 1.0 / 7.0f32;
        let samples = (0..49).map(|i| [(i % 7) as f32 * step + step / 2.0, (i / 7) as f32 * step + step / 2.0, 0.0]);
        (Corners(vec![[a, b, c], [a, c, d]]), samples.collect())
    }

    fn first_gap(field: &Field, corners: &Corners, balls: &[Ball]) -> Option<Place> {
        let vertices = [[0, 1, 2], [0, 2, 3]];
        let part = |i: usize| field.part(&corners.0[i], &vertices[i]);
        (0..2).find_map(|i| gap(field, &part(i), balls, 1e-6))
    }

    #[test]
    fn a_sample_that_is_missing_or_moved_leaves_a_gap() {
        let (corners, samples) = square();
        let balls = |samples: &[[f32; 3]]| Ball::of_positions(samples, |_| RADIUS);
        assert_eq!(first_gap(&Field::None, &corners, &balls(&samples)), None);
        for index in 0..samples.len() {
            let (mut fewer, mut moved) = (samples.clone(), samples.clone());
            fewer.remove(index);
            moved[index][1] += 0.01;
            moved[index][0] -= 0.01;
            assert!(first_gap(&Field::None, &corners, &balls(&fewer)).is_some(), "{index} is missing");
            assert!(first_gap(&Field::None, &corners, &balls(&moved)).is_some(), "{index} is moved");
        }
    }

    #[test]
    fn a_sample_that_is_missing_leaves_a_gap_where_radii_vary() {
        let (corners, samples) = square();
        let ramp = |[x, _, _]: Place| RADIUS * (1.0 + 0.2 * x);
        let values: Vec<f64> = [0.0, 1.0, 1.0, 0.0].map(|x| ramp([x, 0.0, 0.0])).to_vec();
        let balls = |samples: &[[f32; 3]]| -> Vec<Ball> {
            let ball = |&position: &[f32; 3]| {
                let centre = position.map(f64::from);
                Ball { centre, own: ramp(centre) / 2.0, share: 0.5 }
            };
            samples.iter().map(ball).collect()
        };
        let fields = [
            Field::AtVertices { values: &values, radius: |radius| radius },
            Field::Function { at: &ramp, slope: 0.2 * RADIUS },
        ];
        for field in &fields {
            assert_eq!(first_gap(field, &corners, &balls(&samples)), None);
            for index in 0..samples.len() {
                let mut fewer = samples.clone();
                fewer.remove(index);
                assert!(first_gap(field, &corners, &balls(&fewer)).is_some(), "{index} is missing");
            }
        }
    }
}
