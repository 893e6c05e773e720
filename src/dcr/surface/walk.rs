//! Walking on the surface: straight on, from triangle to triangle, as if each were turned about the common edge into the
//! plane of the one before (Polthier and Schmies 1998, "Straightest geodesics on polyhedral surfaces").
//!
//! Nothing but the shapes of triangles is used, each laid into the plane for itself. So triangles may turn their other
//! side to their neighbour, and those without area are crossed as easily as any.

use glam::{DVec2, DVec3};

use super::sheet::Sheet;

/// Who crosses more edges than this in one step stays in the triangle that was reached.
const MOST_EDGES: u32 = 10_000;

/// The share of the way to a border that is gone: a sample on the border itself would be its own mirror image.
const SHORT_OF_BORDER: f64 = 0.99;

/// A triangle in the plane: the first corner at 0, the second on the x axis, the third above it. Lengths in spacings.
#[derive(Clone, Copy)]
pub(super) struct Flat {
    corners: [DVec2; 3],
    /// The plane's axes in space.
    axes: [DVec3; 2],
}

/// A place on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    pub(super) triangle: u32,
    /// Barycentrics u and v.
    pub(super) uv: DVec2,
}

/// Where a walk ends.
#[derive(Clone, Copy)]
pub(super) struct End {
    pub(super) place: Place,
    /// The way as it is seen in the last triangle: of the same length, or where a border was met what led along it.
    pub(super) way: DVec2,
}

impl Flat {
    pub(super) fn new(sheet: &Sheet, triangle: u32, spacing: f64) -> Self {
        let [a, b, c] = sheet.mesh.exact_corners(triangle);
        let (ab, ac) = ((b - a) / spacing, (c - a) / spacing);
        let length = ab.length();
        let (x, cross) = (ab / length, ab.cross(ac));
        let corners = [DVec2::ZERO, DVec2::new(length, 0.0), DVec2::new(ac.dot(x), cross.length() / length)];
        Self { corners, axes: [x, cross.cross(x).normalize_or_zero()] }
    }

    /// The unit normal; zero for a triangle without area.
    pub(super) fn normal(&self) -> DVec3 {
        self.axes[0].cross(self.axes[1])
    }

    /// A vector of space as it is seen in the triangle's plane: turned into it without losing its length.
    pub(super) fn turned(&self, offset: DVec3) -> DVec2 {
        let seen = DVec2::new(offset.dot(self.axes[0]), offset.dot(self.axes[1]));
        seen.normalize_or_zero() * offset.length()
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

    /// Start and direction of an edge.
    fn edge(&self, k: u32) -> (DVec2, DVec2) {
        let (from, to) = (self.corners[k as usize], self.corners[(k as usize + 1) % 3]);
        (from, to - from)
    }

    /// The edge through which a way leads out of the triangle, and when, if it does. `entry` is the edge on which it began.
    fn exit(&self, point: DVec2, way: DVec2, entry: Option<u32>) -> Option<(u32, f64)> {
        let times = (0..3).filter(|&k| Some(k) != entry).filter_map(|k| {
            let (from, along) = self.edge(k);
            let outwards = way.perp_dot(along);
            (outwards > 0.0).then(|| (k, (along.perp_dot(point - from) / outwards).max(0.0)))
        });
        times.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|exit| exit.1 < 1.0)
    }
}

/// Goes from a place, which has area around it, along `way`, which is in the plane of its triangle and in spacings.
pub(super) fn walk(sheet: &Sheet, spacing: f64, start: Place, way: DVec2) -> End {
    let mut triangle = start.triangle;
    let mut flat = Flat::new(sheet, triangle, spacing);
    let (mut point, mut direction, mut left, mut entry) = (flat.point(start.uv), way, 1.0, None);
    for _ in 0..MOST_EDGES {
        let Some((k, time)) = flat.exit(point, direction * left, entry) else {
            point += direction * left;
            break;
        };
        let (from, edge) = flat.edge(k);
        let length = edge.length();
        let (along, outwards) = (direction.dot(edge) / length, direction.perp_dot(edge) / length);
        let Some((other, onward)) = straightest(sheet, spacing, &flat, 3 * triangle + k) else {
            point += direction * (left * time * SHORT_OF_BORDER);
            direction = along * edge / length;
            break;
        };
        let share = ((point + direction * (left * time) - from).dot(edge) / (length * length)).clamp(0.0, 1.0);
        let alike = sheet.run_alike(3 * triangle + k, other);
        (triangle, flat, entry) = (other / 3, onward, Some(other % 3));
        let (from, edge) = flat.edge(other % 3);
        let ahead = edge / edge.length();
        point = from + edge * if alike { share } else { 1.0 - share };
        direction = ahead * if alike { along } else { -along } + outwards * ahead.perp();
        left *= 1.0 - time;
    }
    match flat.barycentrics(point) {
        Some(uv) => End { place: Place { triangle, uv }, way: direction },
        None => End { place: start, way: DVec2::ZERO },
    }
}

/// The half-edge on the other side of an edge, and its triangle: where there are several, the one that turns least.
fn straightest(sheet: &Sheet, spacing: f64, flat: &Flat, edge: u32) -> Option<(u32, Flat)> {
    let inwards = |flat: &Flat, edge: u32| {
        let across = flat.edge(edge % 3).1.perp().normalize();
        across.x * flat.axes[0] + across.y * flat.axes[1]
    };
    let others = sheet.across(edge).map(|other| (other, Flat::new(sheet, other / 3, spacing)));
    let mut others = others.map(|(other, onward)| (inwards(flat, edge).dot(inwards(&onward, other)), other, onward));
    let first = others.next()?;
    let best = others.fold(first, |best, other| if other.0 < best.0 { other } else { best });
    Some((best.1, best.2))
}
