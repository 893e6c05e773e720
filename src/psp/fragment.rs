//! The geometry of what is covered: parts of triangles, the slices and sixteenths that they are cut into, and the
//! normals that decide which samples cover them.
//!
//! *Slices.* Parts of a triangle's own shape would suffice for a well-shaped one. A needle, though, becomes needles of
//! half its length, two of them side by side: n² parts where n are enough. So a triangle that is longer than high is
//! sliced first, across its longest edge, into slices that are about as long as they are high.
//!
//! *Sixteenths.* Lines parallel to the three edges cut a fragment into four by four congruent parts of its own shape:
//! ten that stand as it does, then six turned over. They have fifteen corners, counted along the rows of five, four,
//! three, two and one. A sixteenth is known to be covered when all of its corners are in one ball.

use glam::{DVec2, DVec3};

use crate::error::{Error, Result};
use crate::mesh::{Mesh, exact};
use crate::psp::fill::extent::Extent;

/// A part of a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fragment {
    pub triangle: u32,
    /// Barycentrics `(u, v)` of the corners.
    pub corners: [[f64; 2]; 3],
}

/// The geometry of a fragment in space.
#[derive(Clone, Copy)]
pub struct Shape {
    pub corners: [DVec3; 3],
    pub centre: DVec3,
    /// The corner opposite the longest edge.
    pub apex: usize,
    /// The length of the longest edge.
    pub longest: f64,
}

impl Fragment {
    pub fn whole(triangle: u32) -> Self {
        Self { triangle, corners: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] }
    }

    /// The area: that of the whole triangle, times the share of its barycentrics.
    pub fn area(&self, mesh: &Mesh) -> f64 {
        mesh.triangle_area(self.triangle) * self.share()
    }

    /// The share of the area of its triangle.
    pub fn share(&self) -> f64 {
        let [a, b, c] = self.corners.map(DVec2::from_array);
        (b - a).perp_dot(c - a).abs()
    }

    /// The barycentrics of the point with barycentrics `(s, t)` in the fragment.
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let [a, b, c] = self.corners;
        std::array::from_fn(|axis| (1.0 - s - t) * a[axis] + s * b[axis] + t * c[axis])
    }

    /// The box around it, rounded to floats.
    pub fn extent(&self, mesh: &Mesh) -> Extent {
        Extent::of(self.corners.map(|corner| mesh.point_exact(self.triangle, corner).as_vec3().to_array()))
    }

    #[inline]
    pub fn shape(&self, mesh: &Mesh) -> Shape {
        let [a, b, c] = mesh.exact_corners(self.triangle);
        let at = |[u, v]: [f64; 2]| (1.0 - u - v) * a + u * b + v * c;
        let [p, q, r] = self.corners;
        Shape::of([at(p), at(q), at(r)])
    }

    /// The parts of its own shape that lines parallel to its edges cut it into, `count` along each edge.
    pub fn parts(&self, count: u32) -> impl Iterator<Item = Self> {
        let at = move |x: u32, y: u32| self.at([x, y].map(|x| f64::from(x) / f64::from(count)));
        (0..count).flat_map(move |y| (0..count - y).map(move |x| (x, y))).flat_map(move |(x, y)| {
            let standing = Self { corners: [at(x, y), at(x + 1, y), at(x, y + 1)], ..*self };
            let turned = || Self { corners: [at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)], ..*self };
            [Some(standing), (x + y + 1 < count).then(turned)].into_iter().flatten()
        })
    }

    /// The number of parts of its own shape along each of its edges that makes them no longer than `longest`.
    pub fn count_up_to(&self, mesh: &Mesh, longest: f64) -> u32 {
        (self.shape(mesh).longest / longest).ceil().max(1.0) as u32
    }

    /// The parts of its own shape that are no longer than `longest`.
    pub fn parts_up_to(&self, mesh: &Mesh, longest: f64) -> impl Iterator<Item = Self> {
        self.parts(self.count_up_to(mesh, longest))
    }

    /// One of the sixteen parts.
    pub fn sixteenth(&self, index: usize) -> Self {
        let [a, b, c] = SIXTEENTHS[index];
        let at = |[s, t]: [f64; 2]| self.at([0.25 * s, 0.25 * t]);
        Self { corners: [at(a), at(b), at(c)], ..*self }
    }
}

impl Shape {
    #[inline]
    fn of(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let opposite = [b.distance_squared(c), c.distance_squared(a), a.distance_squared(b)];
        let apex = (1..3).fold(0, |best, i| if opposite[i] > opposite[best] { i } else { best });
        let centre = (a + b + c) / 3.0;
        Self { corners, centre, apex, longest: opposite[apex].sqrt() }
    }

    /// The largest distance of its points from its centre.
    pub fn extent(&self) -> f64 {
        let squared = self.corners.map(|corner| self.centre.distance_squared(corner));
        squared[0].max(squared[1]).max(squared[2]).sqrt()
    }
}

/// Appends a triangle in slices no shorter than `shortest`, or as a whole if it is not much longer than that or high.
///
/// The height on the longest edge makes two right triangles. Each is sliced parallel to the height, which gives one
/// triangle at the tip and quadrilaterals, cut in two. Slices that meet have the same corners, bit for bit.
pub fn slice(mesh: &Mesh, triangle: u32, shortest: f64, slices: &mut Vec<Fragment>) {
    let whole = Fragment::whole(triangle);
    let shape = whole.shape(mesh);
    let length = shortest.max(2.0 * mesh.triangle_area(triangle) / shape.longest);
    if shape.longest <= 2.0 * length {
        slices.push(whole);
        return;
    }
    let [apex, p, q] = [0, 1, 2].map(|step| (shape.apex + step) % 3);
    let [top, start, end] = [apex, p, q].map(|corner| exact(mesh.corners(triangle)[corner]));
    let foot = ((top - start).dot(end - start) / (end - start).length_squared()).clamp(0.0, 1.0);

    let top = whole.corners[apex];
    let foot_point = between(whole.corners[p], whole.corners[q], foot);
    for (tip, share) in [(whole.corners[p], foot), (whole.corners[q], 1.0 - foot)] {
        let count = (share * shape.longest / length).ceil();
        for i in 0..count as u32 {
            let [near, far] = [i, i + 1].map(|i| f64::from(i) / count);
            let along_edge = |share| between(tip, foot_point, share);
            let along_slope = |share| between(tip, top, share);
            slices.push(Fragment { corners: [along_edge(near), along_edge(far), along_slope(far)], ..whole });
            if i > 0 {
                slices.push(Fragment { corners: [along_edge(near), along_slope(far), along_slope(near)], ..whole });
            }
        }
    }
}

/// The point at a share of the distance; exact at both ends.
fn between(from: [f64; 2], to: [f64; 2], share: f64) -> [f64; 2] {
    std::array::from_fn(|axis| (1.0 - share) * from[axis] + share * to[axis])
}

/// The number of sixteenths that are oriented like the fragment. They come first.
pub const STANDING: usize = 10;

/// The corners of the sixteenths in quarters of the fragment's edges.
pub const SIXTEENTHS: [[[f64; 2]; 3]; 16] = {
    let mut corners = [[[0.0; 2]; 3]; 16];
    let (mut index, mut turned) = (0, STANDING);
    let mut row = 0;
    while row < 4 {
        let mut column = 0;
        while column + row < 4 {
            let (x, y) = (column as f64, row as f64);
            corners[index] = [[x, y], [x + 1.0, y], [x, y + 1.0]];
            index += 1;
            if column + row < 3 {
                corners[turned] = [[x + 1.0, y + 1.0], [x, y + 1.0], [x + 1.0, y]];
                turned += 1;
            }
            column += 1;
        }
        row += 1;
    }
    corners
};

/// The fifteen corners in shares of the fragment's edges, one edge after the other, and the last one twice.
pub const CORNERS: [[f32; 16]; 2] = {
    let mut corners = [[0.0; 16], [1.0; 16]];
    let (mut index, mut row) = (0, 0);
    while row < 5 {
        let mut column = 0;
        while column + row < 5 {
            corners[0][index] = 0.25 * column as f32;
            corners[1][index] = 0.25 * row as f32;
            index += 1;
            column += 1;
        }
        row += 1;
    }
    corners
};

/// Corners in shares of the fragment's edges, of which each sixteenth has one or more: the three inside, and one for
/// each of the sixteenths at the fragment's own corners.
pub const PIERCING: [[f64; 2]; 6] = [[0.25, 0.25], [0.5, 0.25], [0.25, 0.5], [0.25, 0.0], [0.75, 0.25], [0.0, 0.75]];

/// The piercing corners, one edge after the other, in eight lanes: the first one again in the last two.
pub const PIERCING_BY_EDGE: [[f64; 8]; 2] = {
    let mut corners = [[0.0; 8]; 2];
    let mut lane = 0;
    while lane < 8 {
        let corner = PIERCING[if lane < PIERCING.len() { lane } else { 0 }];
        corners[0][lane] = corner[0];
        corners[1][lane] = corner[1];
        lane += 1;
    }
    corners
};

/// The numbers of the first, second and third corners of the sixteenths.
pub const CORNERS_OF_SIXTEENTHS: [[i32; 16]; 3] = {
    let mut numbers = [[0; 16]; 3];
    let mut index = 0;
    while index < 48 {
        let [column, row] = SIXTEENTHS[index / 3][index % 3];
        let (column, row) = (column as i32, row as i32);
        numbers[index % 3][index / 3] = row * (11 - row) / 2 + column;
        index += 1;
    }
    numbers
};

/// The covered sixteenths, gathered ball by ball. Bit `5·row + column` is the sixteenth whose lowest corner, or whose
/// missing corner for those turned over, is the one in this row and column.
#[derive(Default)]
pub struct Cover {
    standing: u32,
    turned: u32,
}

impl Cover {
    /// Adds the sixteenths of which all three corners are in a ball, given the fifteen corners that are.
    #[inline(always)]
    pub fn add(&mut self, corners: u16) {
        let corners = u32::from(corners);
        // Rows of five bits each.
        let here = corners & 0x1ff | (corners & 0xe00) << 1 | (corners & 0x3000) << 3 | (corners & 0x4000) << 6;
        let (right, above) = (here >> 1, here >> 5);
        self.standing |= here & right & above;
        self.turned |= right & above & (above >> 1);
    }

    /// A bit for each sixteenth, in the order of [`SIXTEENTHS`].
    #[inline(always)]
    pub fn sixteenths(&self) -> u16 {
        let (s, t) = (self.standing, self.turned);
        let standing = s & 0xf | (s >> 5 & 7) << 4 | (s >> 10 & 3) << 7 | (s >> 15 & 1) << 9;
        let turned = t & 7 | (t >> 5 & 3) << 3 | (t >> 10 & 1) << 5;
        (standing | turned << STANDING) as u16
    }
}

/// The normal of all samples where normals do not matter.
pub const NO_NORMAL: [f32; 3] = [0.0; 3];

/// Samples on triangles whose normals have a smaller cosine ignore each other, unless the normals are the same; with
/// -1, none do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing(f64);

impl Facing {
    /// No sample ignores others.
    pub const ANY: Self = Self(-1.0);

    /// Refuses a value that is not a cosine.
    pub fn new(cosine: f64) -> Result<Self> {
        if (-1.0..=1.0).contains(&cosine) {
            Ok(Self(cosine))
        } else {
            Err(Error::invalid("cosine", format!("{cosine:?} is not in -1..=1")))
        }
    }

    /// True if normals matter at all.
    #[inline(always)]
    pub fn asks_normals(self) -> bool {
        self.0 > -1.0
    }

    /// The normal of a triangle, where normals matter.
    #[inline(always)]
    pub fn normal(self, mesh: &Mesh, triangle: u32) -> [f32; 3] {
        if self.asks_normals() { mesh.normal(triangle) } else { NO_NORMAL }
    }

    /// True if two samples with these normals matter to each other. Those of one triangle always do: the square of a
    /// rounded normal can be below a cosine of 1, and such a triangle would be sampled without end.
    pub fn sees(self, a: [f32; 3], b: [f32; 3]) -> bool {
        !self.asks_normals() || a == b || exact(a).dot(exact(b)) >= self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Well-shaped triangles and needles of every kind: flat, acute, right.
    fn triangles() -> Vec<Mesh> {
        let third = [[0.3, 0.8, 0.1], [0.5, 1e-6, 0.0], [0.999, 1e-4, 1e-4], [0.0, 1e-7, 1e-7], [1e-5, 0.05, 0.0]];
        let mesh = |third| Mesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], third], vec![[0, 1, 2]]).unwrap();
        third.into_iter().map(mesh).collect()
    }

    fn all_pieces(mesh: &Mesh, longest: f64) -> Vec<Fragment> {
        let mut slices = Vec::new();
        slice(mesh, 0, longest, &mut slices);
        slices.iter().flat_map(|slice| slice.parts_up_to(mesh, longest)).collect()
    }

    #[test]
    fn pieces_are_short_and_make_up_the_triangle() {
        for mesh in triangles() {
            for longest in [2.0, 0.3, 0.01] {
                let pieces = all_pieces(&mesh, longest);
                assert!(pieces.iter().all(|piece| piece.shape(&mesh).longest <= longest * (1.0 + 1e-9)));
                let area: f64 = pieces.iter().map(|piece| piece.area(&mesh)).sum();
                assert!((area / mesh.area() - 1.0).abs() < 1e-9, "{area} of {}", mesh.area());
            }
        }
    }

    #[test]
    fn a_needle_has_as_many_pieces_as_it_is_long() {
        for mesh in &triangles()[1..] {
            for longest in [1e-2, 1e-3, 1e-4] {
                let expected = 1.0 / longest + mesh.area() / (longest * longest);
                let count = all_pieces(mesh, longest).len() as f64;
                assert!((0.5..12.0).contains(&(count / expected)), "{count} of about {expected}");
            }
        }
    }

    #[test]
    fn each_sixteenth_has_a_piercing_corner() {
        for corners in SIXTEENTHS {
            assert!(corners.iter().any(|corner| PIERCING.contains(&corner.map(|quarters| 0.25 * quarters))));
        }
        assert!(PIERCING.iter().all(|&piercing| {
            let others: Vec<_> = PIERCING.into_iter().filter(|&other| other != piercing).collect();
            SIXTEENTHS.iter().any(|corners| !corners.iter().any(|c| others.contains(&c.map(|q| 0.25 * q))))
        }));
    }

    /// Every set of corners, against the corners of each sixteenth.
    #[test]
    fn a_sixteenth_is_covered_when_its_corners_are_in_one_ball() {
        let corner = |[x, y]: [f64; 2]| {
            let place = |i: &usize| [CORNERS[0][*i], CORNERS[1][*i]].map(f64::from) == [0.25 * x, 0.25 * y];
            (0..15).find(place).unwrap()
        };
        let needed = SIXTEENTHS.map(|corners| corners.iter().fold(0, |bits, &c| bits | 1u16 << corner(c)));
        let expected = |corners: u16| (0..16).fold(0, |all, i| all | u16::from(corners & needed[i] == needed[i]) << i);
        for corners in 0..1 << 15 {
            let mut cover = Cover::default();
            cover.add(corners);
            assert_eq!(cover.sixteenths(), expected(corners), "{corners:b}");
            cover.add(0x7fff ^ corners);
            assert_eq!(cover.sixteenths(), expected(corners) | expected(0x7fff ^ corners));
        }
    }
}
