//! The generalised winding number of any triangles.
//!
//! Source: Barill et al. 2018, "Fast winding numbers for soups and clouds". The winding number at a point is the solid angle of
//! all triangles seen from there, over 4π: 1 inside of a closed surface whose triangles face outwards, 0 outside, and between
//! the two near holes. Triangles of a node that is far away count by its dipole and the first moment of that (their order 1).
//!
//! Departures: the boundary of each part of the surface is closed by *fans*, triangles with one corner in common. The winding
//! number of the surface with its fans is the sum of crossings of a ray; only that of the fans, which is taken away, asks a tree
//! of angles. So a large mesh with small holes costs little more than a closed one, and loose triangles are their own fans.
//! Where there are few fans, all of their angles are summed wherever the tree leaves the side open.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::interior::crossing::side_of_plane;
use crate::interior::tree::{CHILDREN, Tree};
use crate::math::atan2;
use crate::mesh::{Mesh, exact};

/// A node is far if it is this many times farther than its radius: at first, and for numbers right to about 1/1000.
const FAR: f64 = 3.0;
const FAR_TO_BE_PRECISE: f64 = 8.0;

/// The whole sphere.
const SPHERE: f64 = 2.0 * TAU;

/// Up to so many fans are summed without the tree where its number is this near to the border, and then right to the last.
const FEW: usize = 2048;
const CLOSE: f64 = 0.05;
const CLOSE_IF_PRECISE: f64 = 0.005;
pub const ERROR_OF_FEW: f64 = 1e-6;

/// The cosine of half an angle, of a point in the plane of the triangle, is less than this on an edge.
const ON_EDGE: f64 = 1e-12;

/// The triangles of a node.
#[derive(Clone, Debug, Default)]
struct Moments {
    /// The centroid by areas.
    centre: DVec3,
    /// No triangle reaches farther from the centre.
    radius: f64,
    area: f64,
    /// The sum of the triangles' areas along their normals.
    dipole: DVec3,
    /// The columns of the sum of areas along normals by the distances of centroids from the centre: one column per axis of the
    /// normal.
    first: [DVec3; 3],
}

/// The fans of a surface by their angles.
#[derive(Debug)]
pub struct Fans {
    pub tree: Tree,
    /// The moments of the tree's nodes, by its levels.
    moments: Vec<Vec<Moments>>,
}

impl Fans {
    /// The fans of the boundary edges of a mesh (`sides.rs`).
    pub fn new(mesh: &Mesh, boundary: &[[u32; 2]]) -> Self {
        // Edges that are connected have the first vertex of any in common.
        let mut parents = BTreeMap::new();
        for &[from, to] in boundary {
            let [from, to] = [root(&mut parents, from), root(&mut parents, to)];
            parents.insert(from.max(to), from.min(to));
        }
        let place = |vertex: u32| mesh.positions()[vertex as usize];
        let triangle = |&[from, to]: &[u32; 2]| [root(&mut parents, from), from, to].map(place);
        Self::of(&boundary.iter().map(triangle).collect::<Vec<_>>())
    }

    /// Triangles as fans.
    fn of(triangles: &[[[f32; 3]; 3]]) -> Self {
        // Those at the first corner of a boundary have no area.
        let has_area = |[a, b, c]: &&[[f32; 3]; 3]| a != b && b != c && c != a;
        let triangles: Vec<_> = triangles.iter().filter(has_area).copied().collect();
        let (tree, _) = Tree::new(&triangles);
        let mut moments: Vec<Vec<Moments>> = Vec::new();
        for level in 0..tree.levels() {
            let below = moments.last();
            let node = |node: usize| {
                let children = |count: usize| CHILDREN * node..(CHILDREN * (node + 1)).min(count);
                let of: Vec<Moments> = match below {
                    None => children(tree.corners.len()).map(|t| of_triangle(&tree.corners[t])).collect(),
                    Some(below) => below[children(below.len())].to_vec(),
                };
                sum(&of, tree.node_box(level, node))
            };
            let nodes = (0..tree.nodes(level)).map(node).collect();
            moments.push(nodes);
        }
        Self { tree, moments }
    }

    /// True if numbers beside the border are sums of all fans.
    pub fn are_few(&self) -> bool {
        self.tree.corners.len() <= FEW
    }

    /// The winding number of the fans at a point: the sum of all where the tree's, right to an error, leaves something open.
    pub fn number_if(&self, place: [f32; 3], is_open: impl Fn(f64, f64) -> bool) -> f64 {
        let number = self.at(place, FAR);
        if self.are_few() && is_open(number, CLOSE) { self.sum(place) } else { number }
    }

    /// The sum of all solid angles: half of each is the argument of a complex number, and their product has the sum.
    fn sum(&self, place: [f32; 3]) -> f64 {
        let (mut product, mut turns, mut halves) = ([1.0, 0.0], 0, 0);
        for corners in &self.tree.corners {
            let [cosine, volume] = half_angle(place, corners);
            let side = side_of_plane(place, corners);
            if volume == 0.0 || side == 0 {
                // In the plane of the triangle, which may be half of the sphere on the side that crossings see.
                halves -= if cosine < 0.0 { side } else { 0 };
                continue;
            }
            let size = cosine.abs() + volume;
            let ([x, y], [u, v]) = (product, [cosine / size, -f64::from(side) * volume / size]);
            // Not -0, whose argument would be another one.
            product = [x * u - y * v, x * v + y * u + 0.0];
            // Beyond half a turn the product appears on the other side.
            if y >= 0.0 && v > 0.0 && product[1] < 0.0 {
                turns += 1;
            } else if y < 0.0 && v < 0.0 && product[1] >= 0.0 {
                turns -= 1;
            }
            let length = product[0].abs() + product[1].abs();
            product = product.map(|x| x / length);
        }
        (f64::from(turns) * TAU + f64::from(halves) * 0.5 * TAU + atan2(product[1], product[0])) / TAU
    }

    /// The winding number of the fans at a point, to about 1/1000: the sum of all, if they are few, where that leaves something open.
    pub fn precise_number_if(&self, place: [f32; 3], is_open: impl Fn(f64, f64) -> bool) -> f64 {
        let number = self.at(place, FAR_TO_BE_PRECISE);
        if self.are_few() && is_open(number, CLOSE_IF_PRECISE) { self.sum(place) } else { number }
    }

    /// The winding number of the fans at a point, by the tree.
    fn at(&self, place: [f32; 3], far: f64) -> f64 {
        let (point, mut angle) = (exact(place), 0.0);
        let mut stack = vec![(self.moments.len() - 1, 0)];
        while let Some((level, node)) = stack.pop() {
            let moments = &self.moments[level][node];
            let away = moments.centre - point;
            let distance = away.length();
            if distance > far * moments.radius {
                angle += moments.angle(away, distance);
            } else if level > 0 {
                stack.extend(
                    (CHILDREN * node..(CHILDREN * (node + 1)).min(self.moments[level - 1].len()))
                        .map(|n| (level - 1, n)),
                );
            } else {
                for triangle in CHILDREN * node..(CHILDREN * (node + 1)).min(self.tree.corners.len()) {
                    angle += solid_angle(place, &self.tree.corners[triangle]);
                }
            }
        }
        angle / SPHERE
    }
}

impl Moments {
    /// The solid angle from a point far away; `away` leads from there to the centre.
    fn angle(&self, away: DVec3, distance: f64) -> f64 {
        let cubed = distance * distance * distance;
        // The derivatives of away / |away|³ along x by the normal's axis.
        let [x, y, z] = self.first;
        let along = x.dot(away) * away.x + y.dot(away) * away.y + z.dot(away) * away.z;
        (self.dipole.dot(away) + x.x + y.y + z.z - 3.0 * along / (distance * distance)) / cubed
    }
}

fn of_triangle(corners: &[[f32; 3]; 3]) -> Moments {
    let [a, b, c] = corners.map(exact);
    let dipole = (b - a).cross(c - a) / 2.0;
    Moments { centre: (a + b + c) / 3.0, area: dipole.length(), dipole, ..Moments::default() }
}

/// The moments of several together, in a box.
fn sum(parts: &[Moments], hull: [[f32; 3]; 2]) -> Moments {
    let area: f64 = parts.iter().map(|part| part.area).sum();
    let [low, high] = hull.map(exact);
    let weighted = parts.iter().map(|part| part.centre * part.area).sum::<DVec3>();
    let centre = if area > 0.0 { weighted / area } else { (low + high) / 2.0 };
    let mut total = Moments { centre, area, ..Moments::default() };
    for part in parts {
        let offset = part.centre - centre;
        total.dipole += part.dipole;
        for axis in 0..3 {
            total.first[axis] += part.first[axis] + offset * part.dipole[axis];
        }
    }
    total.radius = (centre - low).abs().max((centre - high).abs()).length();
    total
}

/// The solid angle of a triangle seen from a point: van Oosterom and Strackee 1983. Its sign is that of the side on which the
/// point lies as crossings see it, so that what is taken away beside a fan is what was added.
fn solid_angle(point: [f32; 3], corners: &[[f32; 3]; 3]) -> f64 {
    let [cosine, volume] = half_angle(point, corners);
    -f64::from(side_of_plane(point, corners)) * 2.0 * atan2(volume, cosine)
}

/// Half of the solid angle, without its sign, as the argument of a complex number.
fn half_angle(point: [f32; 3], corners: &[[f32; 3]; 3]) -> [f64; 2] {
    let [a, b, c] = corners.map(|corner| exact(corner) - exact(point));
    let lengths = [a.length(), b.length(), c.length()];
    let cosine =
        lengths[0] * lengths[1] * lengths[2] + a.dot(b) * lengths[2] + b.dot(c) * lengths[0] + c.dot(a) * lengths[1];
    let (volume, size) = (a.dot(b.cross(c)).abs(), lengths[0] * lengths[1] * lengths[2]);
    if volume == 0.0 && size > 0.0 && cosine.abs() <= ON_EDGE * size {
        // On an edge, where the triangle fills a quarter of the sphere, whose half is a quarter of a turn.
        return [0.0, size];
    }
    [cosine, volume]
}

/// The first vertex of all that are connected with one.
fn root(parents: &mut BTreeMap<u32, u32>, mut vertex: u32) -> u32 {
    while let Some(&parent) = parents.get(&vertex)
        && parent != vertex
    {
        let above = parents.get(&parent).copied().unwrap_or(parent);
        parents.insert(vertex, above);
        vertex = parent;
    }
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// A sphere of radius 1 from the south pole up to a height, of equal steps of the angles.
    fn bowl(steps: u32, height: f64) -> Vec<[[f32; 3]; 3]> {
        let end = (height + 1.0).clamp(0.0, 2.0);
        let place = |i: u32, j: u32| {
            let (z, turn) =
                (end * f64::from(j) / f64::from(steps) - 1.0, TAU * f64::from(i % steps) / f64::from(steps));
            let across = (1.0 - z * z).max(0.0).sqrt();
            [across * turn.cos(), across * turn.sin(), z].map(|x| x as f32)
        };
        let quad = |i: u32, j: u32| {
            let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        (0..steps * steps).flat_map(|n| quad(n % steps, n / steps)).collect()
    }

    fn soup(count: u32) -> Vec<[[f32; 3]; 3]> {
        let mut rng = Rng::at(7, Draw::Probe, &[]);
        let mut place = |size: f32| [0; 3].map(|_: i32| size * (rng.unit() as f32 - 0.5));
        let triangle = |_| {
            let centre = place(2.0);
            [0; 3].map(|_: i32| std::array::from_fn(|k| centre[k] + place(0.3)[k]))
        };
        (0..count).map(triangle).collect()
    }

    fn all(triangles: &[[[f32; 3]; 3]], point: [f32; 3]) -> f64 {
        let angle = |corners: &[[f32; 3]; 3]| solid_angle(point, corners);
        triangles.iter().map(angle).sum::<f64>() / SPHERE
    }

    #[test]
    fn winding_numbers_are_the_sums_of_all_solid_angles() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for (triangles, error) in
            [(bowl(30, 1.0), 0.015), (bowl(30, 0.3), 0.01), (soup(60), 0.001), (soup(2000), 0.002)]
        {
            let fans = Fans::of(&triangles);
            let mut worst: f64 = 0.0;
            for probe in 0..400 {
                let mut point = [0; 3].map(|_: i32| 3.0 * rng.unit() as f32 - 1.5);
                if probe % 4 == 0 {
                    // A corner, and a point on an edge.
                    let [a, b, _] = triangles[probe % triangles.len()];
                    point = if probe % 8 == 0 { a } else { [0, 1, 2].map(|k| 0.5 * (a[k] + b[k])) };
                } else {
                    worst = worst.max((fans.at(point, FAR) - all(&triangles, point)).abs());
                }
                assert!((fans.sum(point) - all(&triangles, point)).abs() < 1e-11, "{point:?}");
            }
            assert!(worst < error, "{worst}");
        }
        let sphere = bowl(40, 1.0);
        assert!((all(&sphere, [0.1, 0.2, 0.3]) - 1.0).abs() < 1e-6 && all(&sphere, [1.0, 1.0, 0.3]).abs() < 1e-6);
    }
}
