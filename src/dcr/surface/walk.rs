//! Walking on the surface: straight on, from triangle to triangle, as if each were turned about the common edge into
//! the plane of the one before (Polthier and Schmies 1998, "Straightest geodesics on polyhedral surfaces").
//!
//! Nothing but the shapes of triangles is used, each laid into the plane separately. So neighbours may face opposite
//! sides, and triangles without area are crossed like any other.

use glam::{DVec2, DVec3};

use crate::dcr::surface::connected::ConnectedMesh;
use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::simd::Position;

/// A sample that crosses more edges than this in one step stays in the triangle that it has reached.
const MOST_EDGES: u32 = 10_000;

/// The fraction of the distance to a boundary that is walked: a sample on the boundary would be its own mirror image.
const SHORT_OF_BORDER: f64 = 0.99;

/// A triangle in the plane: the first corner at 0, the second on the x axis, the third above it. Lengths are in
/// spacings.
#[derive(Clone, Copy)]
pub struct FlatTriangle {
    corners: [DVec2; 3],
    /// The plane's axes in space.
    axes: [DVec3; 2],
}

/// A point of the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfacePoint {
    pub triangle: u32,
    /// Barycentrics u and v.
    pub uv: DVec2,
}

impl SurfacePoint {
    /// Its position in space, in the floats in which samples are returned.
    pub fn position(self, mesh: &Mesh) -> DVec3 {
        exact(mesh.point(self.triangle, round_barycentrics(self.uv.into())))
    }

    /// Its position, ready for vectors.
    pub fn rounded(self, mesh: &Mesh) -> Position {
        let [x, y, z] = mesh.point(self.triangle, round_barycentrics(self.uv.into()));
        [x, y, z, 0.0]
    }
}

/// The end of a walk.
#[derive(Clone, Copy)]
pub struct WalkEnd {
    pub place: SurfacePoint,
    /// The displacement in the plane of the last triangle: of the same length, or where a boundary was met its
    /// component along the boundary.
    pub displacement: DVec2,
    /// True if the last triangle faces the opposite side to the first.
    pub is_turned: bool,
}

impl FlatTriangle {
    pub fn new(mesh: &ConnectedMesh, triangle: u32, spacing: f64) -> Self {
        let [a, b, c] = mesh.mesh.exact_corners(triangle);
        let (ab, ac) = ((b - a) / spacing, (c - a) / spacing);
        let length = ab.length();
        let (x, cross) = (ab / length, ab.cross(ac));
        let corners = [DVec2::ZERO, DVec2::new(length, 0.0), DVec2::new(ac.dot(x), cross.length() / length)];
        Self { corners, axes: [x, cross.cross(x).normalize_or_zero()] }
    }

    /// The unit normal; zero for a triangle without area.
    pub fn normal(&self) -> DVec3 {
        self.axes[0].cross(self.axes[1])
    }

    /// The plane's axes in space.
    pub fn axes(&self) -> [DVec3; 2] {
        self.axes
    }

    /// The barycentrics that a displacement by 1 along each axis adds.
    pub fn steps(&self) -> [DVec2; 2] {
        let [_, b, c] = self.corners;
        [DVec2::new(1.0 / b.x, 0.0), DVec2::new(-c.x / (b.x * c.y), 1.0 / c.y)]
    }

    fn point(&self, uv: DVec2) -> DVec2 {
        uv.x * self.corners[1] + uv.y * self.corners[2]
    }

    /// The barycentrics of a point; none in a triangle without area.
    fn barycentrics(&self, point: DVec2) -> Option<DVec2> {
        let [_, b, c] = self.corners;
        (c.y > 0.0).then(|| {
            let v = (point.y / c.y).clamp(0.0, 1.0);
            DVec2::new(((point.x - v * c.x) / b.x).clamp(0.0, 1.0 - v), v)
        })
    }

    /// The start and the direction of an edge.
    fn edge(&self, k: u32) -> (DVec2, DVec2) {
        let (from, to) = (self.corners[k as usize], self.corners[(k as usize + 1) % 3]);
        (from, to - from)
    }

    /// The edge through which a path from a point leads out of the triangle, and the fraction of the path before it, if
    /// it does. `entry` is the edge on which it began.
    fn exit(&self, point: DVec2, path: DVec2, entry: Option<u32>) -> Option<(u32, f64)> {
        let time = |k: u32| {
            let (from, along) = self.edge(k);
            let outwards = path.perp_dot(along);
            (outwards > 0.0).then(|| (k, (along.perp_dot(point - from) / outwards).max(0.0)))
        };
        let exit = match entry {
            None => (0..3).filter_map(time).min_by(|a, b| a.1.total_cmp(&b.1)),
            // Past the corner that faces the entry, on one side or the other: that is known even without area.
            Some(k) => {
                let is_right = path.perp_dot(self.corners[(k as usize + 2) % 3] - point) > 0.0;
                time((if is_right { k + 1 } else { k + 2 }) % 3)
            }
        };
        exit.filter(|exit| exit.1 < 1.0)
    }
}

/// Walks from a point, in a triangle with area, by a displacement, which is in the plane of its triangle and in
/// spacings.
pub fn walk(mesh: &ConnectedMesh, spacing: f64, start: SurfacePoint, displacement: DVec2) -> WalkEnd {
    let mut triangle = start.triangle;
    let mut flat = FlatTriangle::new(mesh, triangle, spacing);
    let (mut point, mut direction, mut left, mut entry) = (flat.point(start.uv), displacement, 1.0, None);
    let mut is_turned = false;
    for _ in 0..MOST_EDGES {
        let Some((k, time)) = flat.exit(point, direction * left, entry) else {
            point += direction * left;
            break;
        };
        let (from, edge) = flat.edge(k);
        let length = edge.length();
        let (along, outwards) = (direction.dot(edge) / length, direction.perp_dot(edge) / length);
        let Some((other, onward)) = straightest(mesh, spacing, &flat, 3 * triangle + k) else {
            point += direction * (left * time * SHORT_OF_BORDER);
            direction = along * edge / length;
            break;
        };
        let share = ((point + direction * (left * time) - from).dot(edge) / (length * length)).clamp(0.0, 1.0);
        let alike = mesh.run_alike(3 * triangle + k, other);
        is_turned ^= alike;
        (triangle, flat, entry) = (other / 3, onward, Some(other % 3));
        let (from, edge) = flat.edge(other % 3);
        let ahead = edge / edge.length();
        point = from + edge * if alike { share } else { 1.0 - share };
        direction = ahead * if alike { along } else { -along } + outwards * ahead.perp();
        left *= 1.0 - time;
    }
    match flat.barycentrics(point) {
        Some(uv) => WalkEnd { place: SurfacePoint { triangle, uv }, displacement: direction, is_turned },
        None => WalkEnd { place: start, displacement: DVec2::ZERO, is_turned: false },
    }
}

/// The half-edge on the other side of an edge, and its triangle: where there are several, the one that turns least.
fn straightest(mesh: &ConnectedMesh, spacing: f64, flat: &FlatTriangle, edge: u32) -> Option<(u32, FlatTriangle)> {
    let inwards = |flat: &FlatTriangle, edge: u32| {
        let across = flat.edge(edge % 3).1.perp().normalize();
        across.x * flat.axes[0] + across.y * flat.axes[1]
    };
    let mut others = mesh.across(edge).map(|other| (other, FlatTriangle::new(mesh, other / 3, spacing)));
    let (other, onward) = others.next()?;
    if mesh.across(edge).nth(1).is_none() {
        return Some((other, onward));
    }
    let bend = |(other, onward): (u32, FlatTriangle)| (inwards(flat, edge).dot(inwards(&onward, other)), other, onward);
    let mut others = others.map(bend);
    let first = bend((other, onward));
    let straightest = others.by_ref().fold(first, |least, other| if other.0 < least.0 { other } else { least });
    Some((straightest.1, straightest.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};

    const SPACING: f64 = 0.25;

    /// A square of side 8 around the origin in irregular triangles, some of them turned over, rolled up around the y
    /// axis with this curvature.
    fn rolled_square(curvature: f32) -> Mesh {
        let side = 17;
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let mut coordinate = |i: u32| {
            if i.is_multiple_of(side - 1) { i as f32 / 2.0 } else { (i as f32 + 0.6 * rng.unit() as f32) / 2.0 }
        };
        let places: Vec<[f32; 2]> =
            (0..side * side).map(|i| [coordinate(i % side), coordinate(i / side)].map(|x| x - 4.0)).collect();
        let rolled = |&[x, y]: &[f32; 2]| match curvature {
            0.0 => [x, y, 0.0],
            _ => [(curvature * x).sin() / curvature, y, (curvature * x).cos() / curvature],
        };
        let quads = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| y * side + x));
        let triangles = quads.flat_map(|a| [[a, a + 1, a + side + 1], [a, a + side, a + side + 1]]);
        Mesh::new(places.iter().map(rolled).collect(), triangles.collect()).unwrap()
    }

    /// A displacement along the plane of a triangle, there and in spacings.
    fn along(flat: &FlatTriangle, displacement: DVec3) -> DVec2 {
        DVec2::from_array(flat.axes().map(|axis| displacement.dot(axis))) / SPACING
    }

    fn at(mesh: &Mesh, place: SurfacePoint) -> DVec3 {
        mesh.point_exact(place.triangle, place.uv.into())
    }

    #[test]
    fn in_the_plane_walks_are_straight_lines() {
        let mesh = rolled_square(0.0);
        let connected = ConnectedMesh::new(&mesh).unwrap();
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut inside, mut stopped) = (0, 0);
        for _ in 0..2000 {
            let start = SurfacePoint { triangle: rng.below(512) as u32, uv: DVec2::new(rng.unit(), rng.unit()) / 2.0 };
            let displacement = DVec3::new(rng.unit() - 0.5, rng.unit() - 0.5, 0.0) * 10.0;
            let flat = FlatTriangle::new(&connected, start.triangle, SPACING);
            let end = walk(&connected, SPACING, start, along(&flat, displacement));
            let (from, to) = (at(&mesh, start), at(&mesh, end.place));
            let expected = from + displacement;
            if expected.abs().max_element() < 4.0 {
                assert!(to.distance(expected) < 1e-9, "from {from} to {to}, not {expected}");
                assert!((end.displacement.length() - displacement.length() / SPACING).abs() < 1e-9);
                inside += 1;
            } else {
                // The boundary is met at this fraction of the walk.
                let share = (0..2)
                    .map(|axis| (4.0 * displacement[axis].signum() - from[axis]) / displacement[axis])
                    .fold(1.0, f64::min);
                assert!((to - from).cross(displacement).length() < 1e-9 && to.abs().max_element() < 4.0);
                let gone = (to - from).length() / displacement.length();
                assert!(gone <= share && gone > 0.98 * share - 0.01, "{gone} of {share}");
                stopped += 1;
            }
        }
        assert!(inside > 500 && stopped > 200, "{inside} {stopped}");
    }

    #[test]
    fn on_a_roll_walks_are_those_of_the_plane_rolled_up() {
        let (mesh, plane) = (rolled_square(0.7), rolled_square(0.0));
        // The mesh is made of chords: its plane is that of its own edges.
        let (connected, flat_connected) = (ConnectedMesh::new(&mesh).unwrap(), ConnectedMesh::new(&plane).unwrap());
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for _ in 0..500 {
            let start = SurfacePoint { triangle: rng.below(512) as u32, uv: DVec2::new(rng.unit(), rng.unit()) / 2.0 };
            let displacement = DVec2::from_angle(rng.unit() * 7.0) * 4.0;
            let [end, flat_end] = [&connected, &flat_connected].map(|mesh| walk(mesh, SPACING, start, displacement));
            let back = walk(&connected, SPACING, end.place, -end.displacement);
            if (end.displacement.length() - 4.0).abs() < 1e-9 {
                assert!(at(&mesh, back.place).distance(at(&mesh, start)) < 1e-9, "the walk back ends elsewhere");
            }
            // Triangles differ from those of the plane by the distance of chords from the cylinder.
            let near = at(&plane, end.place).distance(at(&plane, flat_end.place));
            assert!(near < 0.1, "{near}");
        }
    }

    #[test]
    fn triangles_without_area_are_crossed_and_no_walk_ends_there() {
        // A square whose upper half ends on an edge with one vertex more: the triangle between has no area.
        let positions =
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, -1.0, 0.0], [0.5, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let triangles = vec![[2, 1, 0], [0, 1, 3], [0, 3, 4], [3, 1, 5], [3, 5, 4]];
        let mesh = Mesh::new(positions, triangles).unwrap();
        let connected = ConnectedMesh::new(&mesh).unwrap();
        let start = SurfacePoint { triangle: 0, uv: DVec2::new(0.3, 0.4) };
        let flat = FlatTriangle::new(&connected, 0, SPACING);
        for length in [0.1, 0.5, 0.9] {
            let displacement = DVec3::new(0.1, length, 0.0);
            let end = walk(&connected, SPACING, start, along(&flat, displacement));
            assert!(at(&mesh, end.place).distance(at(&mesh, start) + displacement) < 1e-9);
            assert!(mesh.triangle_area(end.place.triangle) > 0.0);
        }
    }
}
