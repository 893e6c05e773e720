//! The exact integer lattice on which all sampling of the plane happens, and that of cuboids (`D` = 3).
//!
//! Rounding is where Poisson-disk samplers lose their guarantee: a set that keeps its radius in `f64` does not keep it
//! once its points are stored as `f32`. Here nothing is rounded. The lattice consists of the multiples of one power of
//! two, `unit`, the float spacing at the domain's largest coordinate, so every lattice point *is* an `f32`, and squared
//! distances between lattice points are integers.
//!
//! # Guarantees
//! Two points *conflict* when their squared distance is below `threshold` = ceil(r² / unit²), so points without
//! conflict are at least r apart, in `f64`, computed from the returned floats by any formula that rounds each operation
//! correctly. A set is *maximal* when every lattice point of the domain conflicts with one of its points. A point of
//! the domain between lattice points is at most one unit per axis from one of them, and on a torus the distance across
//! the seam is at most one unit per axis longer than on the lattice (see [`Lattice::new`]): no point of the domain is
//! farther than r + 2·sqrt(2)·unit, below **r + 3 float spacings** at the largest coordinate, from all samples. In space
//! it is r + 2·sqrt(3)·unit, below **r + 3.5 float spacings**.

use crate::error::{Error, Result};
use crate::math::{hypot, scalbn};
use crate::plane::rect::Rect;
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY, check_radius, check_resolution};

/// The largest number of samples of one call.
const MAX_SAMPLES: f64 = u32::MAX as f64;

/// A lattice whose unit follows from the radius has less than so many units in it, and at least half as many.
const FINEST: f64 = 512.0;

/// The most units of such a lattice along an axis: differences of coordinates, to images too, are below 2^31.
const WIDEST: f64 = (1 << 29) as f64;

/// The largest coordinate of such a lattice, in units: sums of coordinates are exact in `f64`.
const FARTHEST: f64 = (1u64 << 50) as f64;

/// The least distance of two lattice points for a radius.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Separation {
    /// Points whose squared distance is below this conflict.
    pub threshold: i64,
    /// The largest distance along one axis at which points can conflict.
    pub reach: i32,
}

impl Separation {
    /// The separation for a radius in lattice units.
    pub fn new(radius: f64) -> Self {
        // The factor covers the rounding of the squares here and in the user's own check.
        let threshold = (radius * radius * (1.0 + 1e-14)).ceil() as i64;
        Self { threshold, reach: (threshold - 1).max(0).isqrt() as i32 }
    }
}

/// The lattice of a domain, with the radius in its units.
#[derive(Clone, Debug)]
pub(crate) struct Lattice<const D: usize = 2> {
    unit: f64,
    /// The coordinates of the first lattice point; the sum `origin + j * unit` is exact for every lattice point `j`.
    origin: [f64; D],
    /// Lattice points per axis; on a torus also the period.
    pub size: [i32; D],
    pub boundary: Boundary,
    /// The radius in lattice units.
    pub radius: f64,
    /// The separation that the radius requires of two lattice points.
    pub separation: Separation,
}

impl<const D: usize> Lattice<D> {
    /// The lattice of `domain` for `radius`.
    ///
    /// A torus has an integer period, the user's rounded down: distances in the user's period are never smaller,
    /// and less than one unit per axis larger. In the user's own `f64` arithmetic this holds as well, because
    /// rounding is monotone and the distances on the lattice are floats.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a domain or radius out of range, when no float lies in the domain, and when
    /// floats are too coarse for the radius.
    pub fn of_any_size(domain: &Domain<D>, radius: f64) -> Result<Self> {
        domain.check()?;
        check_radius(radius)?;
        let unit = float_spacing(domain.min.iter().chain(&domain.max));
        check_resolution("radius", radius, unit, "the domain's largest coordinate")?;
        Self::with_unit(domain, unit).map(|lattice| lattice.with_radius(radius))
    }

    /// The lattice of the multiples of a unit, with an arbitrary radius.
    fn with_unit(domain: &Domain<D>, unit: f64) -> Result<Self> {
        let (mut origin, mut size) = ([0.0; D], [0; D]);
        for axis in 0..D {
            (origin[axis], size[axis]) = axis_points(domain, axis, unit)?;
        }
        Ok(Self { unit, origin, size, boundary: domain.boundary, radius: 0.0, separation: Separation::new(0.0) })
    }

    /// The same lattice with another radius, in the units of the domain.
    pub fn with_radius(&self, radius: f64) -> Self {
        // No two lattice points are as far apart as 2^26, so a longer radius has the same effect and would only
        // overflow.
        let radius = (radius / self.unit).min((1 << 26) as f64);
        Self { radius, separation: Separation::new(radius), ..self.clone() }
    }

    /// A square torus of points of this lattice, or a cubic one, with the same radius.
    pub fn square_torus(&self, side: i32) -> Self {
        Self { size: [side; D], boundary: Boundary::Periodic, ..self.clone() }
    }

    /// The domain in lattice points.
    pub fn rect(&self) -> Rect<D> {
        Rect { min: [0; D], max: self.size }
    }

    /// The coordinates of a lattice point of the domain: exact.
    pub fn position(&self, point: [i32; D]) -> [f32; D] {
        std::array::from_fn(|axis| self.coordinate(axis, point[axis]) as f32)
    }

    /// One coordinate of the lattice points with this number along an axis: exact.
    pub fn coordinate(&self, axis: usize, point: i32) -> f64 {
        self.origin[axis] + f64::from(point) * self.unit
    }

    /// The length of a unit.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The position in lattice units; on a torus wrapped into the first period.
    pub fn place(&self, domain: &Domain<D>, position: [f32; D]) -> [f64; D] {
        std::array::from_fn(|axis| {
            let mut x = f64::from(position[axis]);
            if self.boundary == Boundary::Periodic {
                let (min, extent) = (domain.min[axis], domain.extent()[axis]);
                x -= extent * ((x - min) / extent).floor();
            }
            (x - self.origin[axis]) / self.unit
        })
    }

    /// The number of units by which distances across the seam of a torus can be shorter than on the lattice.
    pub fn short(&self, domain: &Domain<D>) -> f64 {
        let short = |axis: usize| (domain.extent()[axis] / self.unit - f64::from(self.size[axis])).max(0.0);
        if self.boundary == Boundary::Bounded {
            return 0.0;
        }
        (1..D).fold(short(0), |sum, axis| hypot(sum, short(axis)))
    }

    /// The length whose square is given in lattice units: the distance in `f64` of two returned floats.
    pub fn length(&self, square: i64) -> f64 {
        (square as f64).sqrt() * self.unit
    }
}

impl Lattice {
    /// The lattice of `domain` for `radius`, if the whole of it can be sampled in one call.
    ///
    /// # Errors
    /// Those of [`Lattice::of_any_size`] and [`estimate`].
    pub fn new(domain: &Domain, radius: f64) -> Result<Self> {
        domain.check()?;
        estimate(domain.extent(), radius)?;
        Self::of_any_size(domain, radius)
    }

    /// The lattice of a `domain` that need not lie on floats: its unit follows from the radius, which is 256 to 512
    /// units. So it is up to 2^29 units wide and high, a million radii and more, wherever it lies. A torus has an integer
    /// period as in [`Lattice::of_any_size`].
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a domain or radius out of range, and for a domain that is wider or higher or so far
    /// from 0 that its coordinates are not exact in `f64`.
    pub fn of_radius(domain: &Domain, radius: f64) -> Result<Self> {
        domain.check()?;
        check_radius(radius)?;
        let mut unit = float_spacing([radius].iter());
        while radius / unit >= FINEST {
            unit *= 2.0;
        }
        check_resolution("radius", radius, unit, "0")?;
        for (axis, side) in domain.extent().into_iter().enumerate() {
            let (most, farthest) = (WIDEST * unit, FARTHEST * unit);
            if side > most || domain.min[axis].abs().max(domain.max[axis].abs()) > farthest {
                let reason = format!(
                    "[{axis}] is {}, above domain_min {}: with radius {radius:?} the sides are at most {most:?}, and the \
                     coordinates {farthest:?}",
                    domain.max[axis], domain.min[axis]
                );
                return Err(Error::invalid("domain_max", reason));
            }
        }
        Self::with_unit(domain, unit).map(|lattice| lattice.with_radius(radius))
    }

    /// The same lattice points with coordinates that begin at one of them, so that those of the first 2^24 from there on
    /// are floats.
    pub fn seen_from(&self, point: [i32; 2]) -> Self {
        Self { origin: point.map(|x| -f64::from(x) * self.unit), ..self.clone() }
    }

    /// The same lattice with a radius that is longer by a number of units.
    pub fn widened(&self, units: f64) -> Self {
        let radius = self.radius + units;
        Self { radius, separation: Separation::new(radius), ..self.clone() }
    }

    /// The approximate number of samples of a maximal set; at least one. On a bounded domain, whose disks lie partly
    /// outside, this is the number for a domain wider by half a radius on each side.
    pub fn expected_samples(&self) -> f64 {
        let beyond = if self.boundary == Boundary::Bounded { 1.0 } else { 0.0 };
        let [width, height] = self.size.map(|size| f64::from(size) / self.radius + beyond);
        (MAXIMAL_DENSITY * width * height).max(1.0)
    }

    /// The lattice points of a part of the domain, and perhaps the next ones beyond its boundaries.
    pub fn points_in(&self, part: &Domain) -> Rect {
        // The quotients are rounded, but not across an integer: the first lattice point from `x` on is the integer
        // below them or the next one.
        let point = |axis: usize, x: [f64; 2]| ((x[axis] - self.origin[axis]) / self.unit).floor() as i32;
        let rect = Rect {
            min: std::array::from_fn(|axis| point(axis, part.min)),
            max: std::array::from_fn(|axis| point(axis, part.max) + 1),
        };
        rect.intersection(&self.rect())
    }

    /// The parts of the domain whose points, or on a torus images of them, lie in `rect`, each with the displacement of
    /// these images. Some may be empty.
    pub fn parts(&self, rect: &Rect) -> impl Iterator<Item = ([i32; 2], Rect)> {
        let (rect, size, all) = (*rect, self.size, self.rect());
        let turns =
            move |axis: usize| rect.min[axis].div_euclid(size[axis])..=(rect.max[axis] - 1).div_euclid(size[axis]);
        let turns = turns(1).flat_map(move |y| turns(0).map(move |x| [x * size[0], y * size[1]]));
        turns.map(move |turn| (turn, rect.translated(turn.map(|x| -x)).intersection(&all)))
    }

    /// The approximate number of samples of a maximal set in `rect`.
    pub fn samples_in(&self, rect: &Rect) -> f64 {
        MAXIMAL_DENSITY * (f64::from(rect.length(0)) / self.radius) * (f64::from(rect.length(1)) / self.radius)
    }

    /// A lattice point at most one unit per axis away from any point of `domain`, which is this lattice's; on a torus
    /// perhaps across the seam. Away from the domain's boundary it is half a unit.
    pub fn nearest(&self, domain: &Domain, point: [f32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| {
            let place = (f64::from(point[axis]) - self.origin[axis]) / self.unit;
            let period = (self.boundary == Boundary::Periodic).then(|| domain.extent()[axis] / self.unit);
            nearest_on_axis(place, self.size[axis], period)
        })
    }

    /// The number of the first lattice point along an axis that is not below a coordinate; `size` if there is none.
    pub fn first_from(&self, axis: usize, x: f64) -> i32 {
        let mut point = ((x - self.origin[axis]) / self.unit).ceil().clamp(0.0, f64::from(self.size[axis])) as i32;
        // The quotient is rounded.
        while point > 0 && self.coordinate(axis, point - 1) >= x {
            point -= 1;
        }
        while point < self.size[axis] && self.coordinate(axis, point) < x {
            point += 1;
        }
        point
    }

    /// The lattice point with these coordinates, which must be those of one: the inverse of [`Lattice::position`].
    pub fn point(&self, position: [f32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| ((f64::from(position[axis]) - self.origin[axis]) / self.unit) as i32)
    }
}

/// The index of the lattice point nearest to `place`, which lies in an axis of `size` lattice points. Both `place` and
/// `period`, of a torus, are in units; the first lattice point is at 0.
fn nearest_on_axis(place: f64, size: i32, period: Option<f64>) -> i32 {
    let last = f64::from(size - 1);
    match period {
        // Over the seam, between the last lattice point and the first one's image.
        Some(period) if place < 0.0 || place > last => {
            let place = if place < 0.0 { place + period } else { place };
            if place - last < period - place { size - 1 } else { 0 }
        }
        _ => place.round().clamp(0.0, last) as i32,
    }
}

/// The approximate number of samples of a part of a maximal set, given its width and height.
///
/// # Errors
/// [`Error::InvalidArgument`] for a radius out of range, [`Error::TooLarge`] for more than about 2^32 samples.
pub(crate) fn estimate([width, height]: [f64; 2], radius: f64) -> Result<f64> {
    check_radius(radius)?;
    let samples = MAXIMAL_DENSITY * (width / radius) * (height / radius);
    if samples > MAX_SAMPLES {
        let reason = format!("{radius:?} asks for about {samples:.2e} samples, above the limit of {MAX_SAMPLES:.2e}");
        return Err(Error::too_large("radius", reason));
    }
    Ok(samples)
}

/// The spacing of floats at the largest of the coordinates: a power of two whose multiples up to there are `f32`.
pub fn float_spacing<'a>(coordinates: impl Iterator<Item = &'a f64>) -> f64 {
    let largest = coordinates.fold(0.0, |largest: f64, x| largest.max(x.abs()));
    // A float has 24 bits of mantissa; the finest is 2^-149.
    let mut exponent = -149 + 24;
    while scalbn(1.0, exponent) < largest {
        exponent += 1;
    }
    scalbn(1.0, exponent - 24)
}

/// The coordinate of an axis's first lattice point, and the number of points.
fn axis_points<const D: usize>(domain: &Domain<D>, axis: usize, unit: f64) -> Result<(f64, i32)> {
    let (min, max) = (domain.min[axis], domain.max[axis]);
    if let (first, Some(inside)) = multiples(min, max, unit) {
        let count = match domain.boundary {
            Boundary::Bounded => inside,
            // An axis shorter than a unit has one lattice point, which is at distance zero from its images.
            Boundary::Periodic => (domain.extent()[axis] / unit).floor().clamp(1.0, inside),
        };
        return Ok((first, count as i32));
    }
    // An axis that lies between two multiples of the unit of the longer axis: any float in it will do.
    match multiples(min, max, float_spacing([min, max].iter())) {
        (first, Some(_)) => Ok((first, 1)),
        (_, None) => {
            let reason = format!("[{axis}] is {max:?}: no float lies between it and domain_min {min:?}");
            Err(Error::invalid("domain_max", reason))
        }
    }
}

/// The first multiple of `unit` that is not below `min` and the number of them below `max`, if there are any.
fn multiples(min: f64, max: f64, unit: f64) -> (f64, Option<f64>) {
    // The quotients are exact, unless they underflow; then the comparison corrects the first multiple.
    let mut first = (min / unit).ceil();
    if first * unit < min {
        first += 1.0;
    }
    let count = (max / unit).ceil() - first;
    (first * unit, (count > 0.0).then_some(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    fn lattice(min: [f64; 2], max: [f64; 2], boundary: Boundary, radius: f64) -> Result<Lattice> {
        Lattice::new(&Domain { min, max, boundary }, radius)
    }

    /// The corners of unusual domains: every lattice point is a float of the domain and no lattice point is missing.
    #[test]
    fn lattice_points_are_exactly_the_floats_of_the_domain_at_one_spacing() {
        let tiny = f64::from(f32::from_bits(1));
        let intervals = [
            (0.0, 1.0),
            (-1.0, 1.0),
            (0.1, 0.7),
            (-3.3, -1.1),
            (1e6, 1e6 + 3.0),
            (1e-20, 1.0),
            (-1e-300, 1e-3),
            (1e-300, 3e38),
            (-(f32::MAX as f64), f32::MAX as f64),
            (0.0, 1e-40),
            (-5.0 * tiny, 6.0 * tiny),
        ];
        for (min, max) in intervals {
            for boundary in [Boundary::Periodic, Boundary::Bounded] {
                let extent = max - min;
                let radius = min.abs().max(max.abs()).max(64.0 * tiny);
                let lattice = lattice([min; 2], [max; 2], boundary, radius).unwrap();
                for point in [0, 1, lattice.size[0] / 2, lattice.size[0] - 2, lattice.size[0] - 1] {
                    let exact = lattice.origin[0] + f64::from(point) * lattice.unit;
                    assert_eq!(f64::from(lattice.position([point, 0])[0]), exact, "{min} {max}");
                    assert!(min <= exact && exact < max, "{min} <= {exact} < {max}");
                    assert_eq!(lattice.point(lattice.position([point, 0])), [point, 0]);
                }
                let [below, above] = [-1, lattice.size[0]].map(|j| lattice.origin[0] + f64::from(j) * lattice.unit);
                assert!(below < min);
                match boundary {
                    Boundary::Bounded => assert!(above >= max),
                    Boundary::Periodic => {
                        let lost = extent - f64::from(lattice.size[0]) * lattice.unit;
                        assert!((-1e-15 * extent..lattice.unit * 1.001).contains(&lost), "{min} {max}: {lost}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_threshold_is_the_first_square_that_keeps_the_radius() {
        for radius in [0.013, 0.25, 2e-5, 3.0 / 7.0, 0.5f64.powi(9)] {
            let lattice = lattice([0.0; 2], [1.0; 2], Boundary::Bounded, radius).unwrap();
            let length = |d2: i64| (d2 as f64).sqrt() * lattice.unit;
            assert!(length(lattice.separation.threshold) >= radius);
            assert!(length(lattice.separation.threshold - 2) < radius);
            assert!(i64::from(lattice.separation.reach).pow(2) < lattice.separation.threshold);
            assert!(i64::from(lattice.separation.reach + 1).pow(2) >= lattice.separation.threshold);
        }
    }

    #[test]
    fn a_radius_beyond_every_distance_makes_everything_conflict() {
        let lattice = lattice([-1.0; 2], [1.0; 2], Boundary::Bounded, 1e300).unwrap();
        let diagonal: i64 = lattice.size.iter().map(|&size| i64::from(size).pow(2)).sum();
        assert!(lattice.separation.threshold > diagonal);
    }

    /// A thin domain far from the multiples of the long axis's unit: its own floats are used.
    #[test]
    fn an_axis_between_two_lattice_points_has_one_of_its_floats() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let lattice = lattice([0.1, 0.0], [0.10000002, 20.0], boundary, 0.3).unwrap();
            assert_eq!(lattice.size[0], 1);
            let [x, y] = lattice.position([0, 5]);
            assert_eq!((x, f64::from(y)), (0.1f32, 5.0 * lattice.unit));
        }
    }

    /// Parts whose edges are on a lattice point, next to it, or anywhere.
    #[test]
    fn the_points_of_a_part_are_those_that_lie_in_it() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for (min, size) in [([1.0, -0.3], [40.0, 29.3]), ([-16.7, 3.0], [31.9, 0.4]), ([0.0, -1.0], [25.5, 30.0])] {
            let unit = f64::from(f32::EPSILON);
            let max = [0, 1].map(|axis: usize| min[axis] + size[axis] * unit);
            let lattice = lattice(min, max, Boundary::Bounded, 100.0).unwrap();
            for _ in 0..300 {
                let mut edge = |axis: usize| {
                    let x = min[axis] + rng.unit() * size[axis] * unit;
                    let on = (x / unit).round() * unit;
                    [x, on, on.next_up(), on.next_down()][rng.below(4) as usize].clamp(min[axis], max[axis])
                };
                let corners = [0, 1].map(|_| [edge(0), edge(1)]);
                let [min, max] =
                    [f64::min, f64::max].map(|pick| [0, 1].map(|axis| pick(corners[0][axis], corners[1][axis])));
                let part = Domain { min, max, boundary: Boundary::Bounded };
                let found = lattice.points_in(&part);
                for point in (0..lattice.size[1]).flat_map(|y| (0..lattice.size[0]).map(move |x| [x, y])) {
                    let inside = part.contains(lattice.position(point));
                    assert!(!inside || found.contains(point), "{part:?}: {point:?} is missing");
                    assert!(inside || !found.grown(-1).contains(point), "{part:?}: {point:?} is too far outside");
                }
            }
        }
    }

    /// Any floats of unusual domains, including those next to the boundaries.
    #[test]
    fn the_nearest_lattice_point_is_at_most_a_unit_away_per_axis() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let intervals = [
            (0.0, 1.0),
            (-0.3, 0.7),
            (0.1, 0.100001),
            (1e-30, 3.0),
            (0.1, 0.10000002),
            (-5e-324, 1e-45),
            (-3e38, 2e38),
        ];
        for ((min, max), boundary) in
            intervals.into_iter().flat_map(|i| [(i, Boundary::Periodic), (i, Boundary::Bounded)])
        {
            // The second axis is one unit and a half wide, so that it loses the most on a torus.
            let unit = float_spacing([min, max].iter());
            let domain = Domain { min: [min; 2], max: [max, min + 1.5 * unit], boundary };
            let radius = 1e3 * (unit + min.abs() + max.abs());
            let lattice = Lattice::of_any_size(&domain, radius).unwrap();
            let edges = [min as f32, max as f32].map(|x| [x.next_down(), x, x.next_up()]).concat();
            let inner = (0..500).map(|_| (min + rng.unit() * (max - min)) as f32).collect::<Vec<_>>();
            let xs = edges.iter().chain(&inner);
            for point in xs.flat_map(|&x| edges.iter().map(move |&y| [x, y])).filter(|&point| domain.contains(point)) {
                let nearest = lattice.nearest(&domain, point);
                assert!(lattice.rect().contains(nearest));
                let position = lattice.position(nearest);
                for axis in 0..2 {
                    let along = (f64::from(point[axis]) - f64::from(position[axis])).abs();
                    let around = if boundary == Boundary::Periodic { domain.extent()[axis] - along } else { along };
                    assert!(
                        along.min(around) <= unit * (1.0 + 1e-9),
                        "{point:?} of {domain:?} is far from {position:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn refusals_name_the_argument_and_the_values() {
        let refusal = |min: f64, max: f64, radius: f64| {
            lattice([min, 0.0], [max, 1.0], Boundary::Bounded, radius).unwrap_err().to_string()
        };
        assert_eq!(refusal(0.0, 1.0, f64::NAN), "radius: NaN is not a positive finite number");
        assert!(refusal(0.0, 1.0, 8.346e-7).contains("about 1.00e12 samples"));
        let spacing = refusal(1e6, 1e6 + 1.0, 0.01);
        assert!(spacing.starts_with("radius: 0.01 is below 4.0, 64 times the float spacing 0.0625"), "{spacing}");
        let narrow = refusal(1.00000001, 1.00000002, 0.1);
        assert_eq!(narrow, "domain_max: [0] is 1.00000002: no float lies between it and domain_min 1.00000001");
        assert!(refusal(1.0, 1.0, 0.1).starts_with("domain_max: [0] is 1, not above"));
        // Domains whose area underflows would be no estimate at all.
        assert!(matches!(
            lattice([0.0; 2], [1e-300; 2], Boundary::Bounded, 1e-200),
            Err(Error::InvalidArgument { argument: "domain_max", .. })
        ));
    }

    #[test]
    fn the_density_is_the_one_of_the_jamming_limit() {
        assert!((MAXIMAL_DENSITY - 0.69656).abs() < 1e-5);
    }
}
