//! Domains and point containers.

use crate::error::{Error, Result};
use crate::math::cbrt;
use crate::{centred, check};

pub(crate) use crate::check::{finest_radius, radius as check_radius, resolution as check_resolution};

/// N·r² of an unbiased maximal set of N samples on an area of 1, 0.69656: the jamming limit of random sequential
/// placement, 0.5470735 (Zhang and Torquato 2013), is the share of the area that disks of *diameter* r cover.
pub const MAXIMAL_DENSITY: f64 = 0.5470735 * 4.0 / std::f64::consts::PI;

/// N·r³ of an unbiased maximal set of N samples in a volume of 1, 0.73364: the jamming limit in space, 0.38413 (Zhang and
/// Torquato 2013), is the share of the volume that balls of diameter r fill.
pub const MAXIMAL_DENSITY_IN_SPACE: f64 = 0.38413 * 6.0 / std::f64::consts::PI;

/// The behaviour of a domain at its boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// The domain is a torus: distances wrap with the period `max - min`.
    Periodic,
    /// The domain ends there: only points inside it count, and they alone cover it.
    Bounded,
}

/// The least length of the sides of a domain, far below the smallest float: its area must not be 0.
const SHORTEST_SIDE: f64 = 1e-100;

/// The largest ratio of the sides of a domain, 2^100: spade refuses larger coordinates than 2^201.
const LARGEST_ASPECT: f64 = (1u128 << 100) as f64;

/// An axis-aligned rectangle of the plane, or a cuboid of space if `D` is 3; its samples lie in `min <= x < max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain<const D: usize = 2> {
    /// The lower corner.
    pub min: [f64; D],
    /// The upper corner, above `min` on all axes.
    pub max: [f64; D],
    /// The behaviour at the boundary.
    pub boundary: Boundary,
}

impl<const D: usize> Domain<D> {
    /// The unit square or cube.
    pub fn unit(boundary: Boundary) -> Self {
        Self { min: [0.0; D], max: [1.0; D], boundary }
    }

    /// The lengths of the sides.
    pub fn extent(&self) -> [f64; D] {
        std::array::from_fn(|axis| self.max[axis] - self.min[axis])
    }

    /// The domain relative to an origin, and that origin: on each axis whose coordinates exceed `ratio` times the longest
    /// side it is near the middle of the domain, 0 on all others. Both corners are moved exactly. Floats are then as fine
    /// as if the domain began at 0: of a square metre 4,650 km from the origin they would keep no more than its halves.
    pub fn centred(&self, ratio: f64) -> (Self, [f64; D]) {
        let extent = self.extent().into_iter().fold(0.0, f64::max);
        let origin = std::array::from_fn(|axis| {
            let (min, max) = (self.min[axis], self.max[axis]);
            let is_far = min.abs().max(max.abs()) > ratio * extent && extent > 0.0;
            if is_far { centred::origin(min, max, extent) } else { 0.0 }
        });
        (self.relative_to(origin), origin)
    }

    /// The domain relative to an origin.
    pub fn relative_to(&self, origin: [f64; D]) -> Self {
        let moved = |corner: [f64; D]| std::array::from_fn(|axis| corner[axis] - origin[axis]);
        Self { min: moved(self.min), max: moved(self.max), boundary: self.boundary }
    }

    /// The vector from `from` to `to`; on a torus the shortest of its images.
    pub fn offset(&self, from: [f64; D], to: [f64; D]) -> [f64; D] {
        let extent = self.extent();
        std::array::from_fn(|axis| {
            let d = to[axis] - from[axis];
            match self.boundary {
                Boundary::Bounded => d,
                Boundary::Periodic => {
                    let turns = d / extent[axis];
                    // Most differences need no turn, and rounding is a function call in builds for generic processors.
                    if turns.abs() < 0.5 { d } else { d - extent[axis] * turns.round() }
                }
            }
        })
    }

    /// True if a sample lies in `min <= x < max`.
    pub(crate) fn contains(&self, sample: [f32; D]) -> bool {
        (0..D).all(|axis| (self.min[axis]..self.max[axis]).contains(&f64::from(sample[axis])))
    }

    /// Refuses a domain that is not a rectangle or cuboid of finite `f32` coordinates, and one that is too thin.
    pub(crate) fn check(&self) -> Result<()> {
        for axis in 0..D {
            let (min, max) = (self.min[axis], self.max[axis]);
            for (argument, value) in [("domain_min", min), ("domain_max", max)] {
                if value.is_nan() || value.abs() > f32::MAX as f64 {
                    return Err(Error::invalid(argument, format!("[{axis}] is {value}, not a finite float")));
                }
            }
            if min >= max {
                return Err(Error::invalid("domain_max", format!("[{axis}] is {max}, not above domain_min {min}")));
            }
        }
        let extent = self.extent();
        let shortest = extent.into_iter().fold(f64::INFINITY, f64::min);
        let longest = extent.into_iter().fold(0.0, f64::max);
        let sides = || extent.map(|side| format!("{side:e}")).join(" by ");
        if shortest < SHORTEST_SIDE {
            let all = if D == 2 { "both" } else { "all" };
            let reason = format!("the domain is {}; {all} sides are at least {SHORTEST_SIDE:e}", sides());
            return Err(Error::invalid("domain_max", reason));
        }
        if longest > LARGEST_ASPECT * shortest {
            let (one, other) = if D == 2 { ("one", "the other") } else { ("a", "another") };
            let reason = format!("the domain is {}; {one} side is at most 2^100 times {other}", sides());
            return Err(Error::invalid("domain_max", reason));
        }
        Ok(())
    }

    /// Refuses an invalid domain, and points (`positions`) outside it.
    pub(crate) fn check_set(&self, points: &[[f32; D]]) -> Result<()> {
        self.check()?;
        self.check_points(points)
    }

    /// Refuses points (`positions`) that do not lie in `min <= x < max`, and more of them than can be indexed.
    pub(crate) fn check_points(&self, points: &[[f32; D]]) -> Result<()> {
        check::indexable("positions", "points", points.len())?;
        match points.iter().position(|&point| !self.contains(point)) {
            None => Ok(()),
            Some(index) => {
                let (place, Self { min, max, .. }) = (points[index].map(|x| x.to_string()).join(", "), self);
                let reason = format!("point {index} is ({place}), outside the domain {min:?} to {max:?}");
                Err(Error::invalid("positions", reason))
            }
        }
    }

    /// The area or volume.
    pub(crate) fn content(&self) -> f64 {
        self.extent().into_iter().product()
    }

    /// The side of cells of which no more than about `limit` fill the domain, nor more along one axis or two of it.
    pub(crate) fn cell_side(&self, limit: f64) -> f64 {
        let mut sides = self.extent();
        sides.sort_unstable_by(|a, b| b.total_cmp(a));
        let (mut content, mut side) = (1.0, 0.0);
        for (length, root) in sides.into_iter().zip([|x| x, f64::sqrt, cbrt]) {
            content *= length;
            side = f64::max(side, root(content / limit));
        }
        side
    }
}

impl Domain {
    /// The area.
    pub fn area(&self) -> f64 {
        self.content()
    }

    /// The distance of neighbours if `count` points stood in hexagonal arrangement on the area:
    /// `d_max = sqrt(2 A / (sqrt(3) N))`. (The thesis's `r_max` of §1.4 is a disk radius, half of it.)
    pub fn hexagonal_distance(&self, count: usize) -> f64 {
        (2.0 * self.area() / (3f64.sqrt() * count as f64)).sqrt()
    }
}

impl Domain<3> {
    /// The volume.
    pub fn volume(&self) -> f64 {
        self.content()
    }

    /// The distance of neighbours if `count` points stood in the densest packing of the volume, face-centred cubic:
    /// `d_max = cbrt(sqrt(2) V / N)`.
    pub fn packed_distance(&self, count: usize) -> f64 {
        cbrt(2f64.sqrt() * self.volume() / count as f64)
    }
}

/// Samples of the plane (`D` = 2) or of space (3), with all that is known of them: entry `i` of each vector belongs to
/// sample `i`. A vector is empty where its field does not apply.
#[derive(Clone, Debug, PartialEq)]
pub struct Points<const D: usize> {
    /// Positions. On a mesh they are recomputed from the barycentrics in `f64` and rounded once.
    pub positions: Vec<[f32; D]>,
    /// On a mesh: unit normals of the triangles, counter-clockwise front.
    pub normals: Vec<[f32; 3]>,
    /// On a mesh: the triangle that each sample lies on.
    pub triangles: Vec<u32>,
    /// On a mesh: `(u, v)`; the position is `(1 - u - v) * a + u * b + v * c` of the triangle's vertices, as in Embree.
    pub barycentrics: Vec<[f32; 2]>,
    /// On a mesh that carries normals of its own, given with it or read from its file: these, interpolated to the
    /// samples ([`Mesh::interpolated_normal`](crate::mesh::Mesh::interpolated_normal)).
    pub interpolated_normals: Vec<[f32; 3]>,
    /// In progressive order ([`Order::Progressive`](crate::Order::Progressive)) the rank of each sample, a distance:
    /// the samples up to this one are at least this far apart. Ranks never rise; the first is infinite. Where radii
    /// vary, ranks are the factors of the radii ([`adaptive::sample`](crate::psp::adaptive::sample)).
    pub ranks: Vec<f32>,
    /// The class of each sample, in a set of several [`Classes`](crate::Classes).
    pub classes: Vec<u32>,
    /// The radius of each sample, where radii vary ([`adaptive::sample`](crate::psp::adaptive::sample)).
    pub radii: Vec<f64>,
    /// The id of each sample, in an [`EditableSet`](crate::psp::EditableSet).
    pub ids: Vec<u64>,
    /// The instance that each sample stands on ([`sample_instances`](crate::psp::sample_instances)).
    pub instances: Vec<u32>,
}

impl<const D: usize> Default for Points<D> {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            normals: Vec::new(),
            triangles: Vec::new(),
            barycentrics: Vec::new(),
            interpolated_normals: Vec::new(),
            ranks: Vec::new(),
            classes: Vec::new(),
            radii: Vec::new(),
            ids: Vec::new(),
            instances: Vec::new(),
        }
    }
}

impl<const D: usize> From<Vec<[f32; D]>> for Points<D> {
    /// Samples of which only positions are known.
    fn from(positions: Vec<[f32; D]>) -> Self {
        Self { positions, ..Self::default() }
    }
}

impl<const D: usize> Points<D> {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// True if there is no sample.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }
}
