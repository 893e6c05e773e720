//! The domain in units of the reference spacing, and the copies of points beyond its boundary.

use glam::DVec2;

use crate::math::{direction, rounded_down, rounded_up};
use crate::points::{Boundary, Domain};
use crate::rng::{Draw, Rng};

/// The distance by which points are moved out of a degenerate arrangement, in spacings: enough for the forces to
/// resolve it before the motion seems to end, too little to be visible.
const PARTING: f64 = 1e-3;

/// The width, in spacings, of the strips along which points are ordered.
const STRIP: f64 = 4.0;

/// Points of a bounded domain keep this distance from its boundary, in spacings, so that none falls on its mirror
/// image.
const INSET: f64 = 1e-6;

/// A domain whose lower corner is the origin and whose unit of length is the reference spacing.
///
/// The reference spacing is `d_max = sqrt(2 A / (sqrt(3) N))`, the distance of `N` points in hexagonal arrangement on
/// the area `A`; in a strip narrower than that it is the width of the strip, which no set on the torus can exceed.
#[derive(Clone, Copy)]
pub struct Frame {
    domain: Domain,
    spacing: f64,
    in_d_max: f64,
    size: DVec2,
}

/// A point, or a copy of one beyond the boundary.
#[derive(Clone, Copy)]
pub struct Site {
    pub position: DVec2,
    /// The point.
    pub source: u32,
    /// Per axis: 0 for the point itself, -1 and 1 for its copy beyond the lower and the upper side.
    pub side: [i8; 2],
}

impl Site {
    /// True if this is a point of the domain and not a copy.
    pub fn is_original(&self) -> bool {
        self.side == [0, 0]
    }
}

impl Frame {
    /// The frame of `count` points.
    pub fn new(domain: Domain, count: usize) -> Self {
        let extent = DVec2::from_array(domain.extent());
        let d_max = domain.hexagonal_distance(count);
        let spacing = d_max.min(extent.min_element());
        Self { domain, spacing, in_d_max: spacing / d_max, size: extent / spacing }
    }

    pub fn boundary(&self) -> Boundary {
        self.domain.boundary
    }

    /// The unit of length.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The unit of length over `d_max`: 1, but less in a strip that is thinner than `d_max`.
    pub fn in_d_max(&self) -> f64 {
        self.in_d_max
    }

    /// Width and height, at least 1 each.
    pub fn size(&self) -> DVec2 {
        self.size
    }

    /// Points of the domain in the units of the frame.
    pub fn enter(&self, points: &[[f32; 2]]) -> Vec<DVec2> {
        let min = DVec2::from_array(self.domain.min);
        points.iter().map(|&[x, y]| self.fold((DVec2::new(x.into(), y.into()) - min) / self.spacing)).collect()
    }

    /// Breaks the symmetry of degenerate arrangements, whose forces have no direction or none that leads out of a line:
    /// moves all but the first of coincident points, and all points of a set that lies on one line.
    pub fn part(&self, positions: &mut [DVec2], seed: u64) {
        let parted = if lie_on_a_line(positions) { (0..positions.len() as u32).collect() } else { repeated(positions) };
        for i in parted {
            let mut rng = Rng::at(seed, Draw::Part, &[i.into()]);
            let (angle, length) = (std::f64::consts::TAU * rng.unit(), PARTING * (1.0 + rng.unit()));
            positions[i as usize] = self.fold(positions[i as usize] + length * direction(angle));
        }
    }

    /// Moves a point that has left the domain back: around the torus, or reflected by the boundary.
    pub fn fold(&self, position: DVec2) -> DVec2 {
        let axis = |x: f64, length: f64| match self.domain.boundary {
            // Rounding can turn a small negative remainder into the length itself.
            Boundary::Periodic if (0.0..length).contains(&x) => x,
            Boundary::Periodic => Some(x.rem_euclid(length)).filter(|&x| x < length).unwrap_or(0.0),
            Boundary::Bounded if (INSET..=length - INSET).contains(&x) => x,
            Boundary::Bounded => {
                let x = x.rem_euclid(2.0 * length);
                x.min(2.0 * length - x).clamp(INSET, length - INSET)
            }
        };
        DVec2::new(axis(position.x, self.size.x), axis(position.y, self.size.y))
    }

    /// The offset from one point to another, the shortest on a torus.
    pub fn offset(&self, from: DVec2, to: DVec2) -> DVec2 {
        match self.domain.boundary {
            Boundary::Bounded => to - from,
            Boundary::Periodic => {
                let offset = to - from;
                if offset.abs().cmplt(0.5 * self.size).all() {
                    return offset;
                }
                offset - self.size * (offset / self.size).round()
            }
        }
    }

    /// The points, in their order, and after them every copy that lies within `margin` of the domain.
    ///
    /// Copies are translated by a period, or mirrored by the boundary (thesis, Fig. 4.12 (b)). There is at most one ring
    /// of copies, which along an axis no longer than the margin is whole: also of points that were nudged out of the
    /// domain.
    pub fn sites(&self, positions: impl Iterator<Item = DVec2> + Clone, margin: f64) -> Vec<Site> {
        let copy = |axis: usize, x: f64, side: i8| {
            let length = self.size[axis];
            let margin = if margin < length { margin } else { f64::INFINITY };
            let x = match self.domain.boundary {
                Boundary::Periodic => x + f64::from(side) * length,
                Boundary::Bounded if side == 0 => x,
                Boundary::Bounded => f64::from(1 + side) * length - x,
            };
            (-margin..=length + margin).contains(&x).then_some(x)
        };
        let site = |(source, position)| Site { position, source, side: [0, 0] };
        let originals = (0..).zip(positions).map(site);
        let mut sites: Vec<Site> = originals.clone().collect();
        for Site { position, source, .. } in originals {
            for side in [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]] {
                if let (Some(x), Some(y)) = (copy(0, position.x, side[0]), copy(1, position.y, side[1])) {
                    sites.push(Site { position: DVec2::new(x, y), source, side });
                }
            }
        }
        sites
    }

    /// The point in the user's domain, with `min <= x < max` whatever the rounding.
    pub fn leave(&self, position: DVec2) -> [f32; 2] {
        std::array::from_fn(|axis| {
            let (min, max) = (self.domain.min[axis], self.domain.max[axis]);
            let x = (min + position[axis] * self.spacing) as f32;
            let (first, last) = (rounded_up(min), last_float_below(max));
            match self.domain.boundary {
                // A coordinate that rounds up to the upper side is, on the torus, at the lower one.
                Boundary::Periodic if x > last => first,
                _ => x.clamp(first, last),
            }
        })
    }
}

/// An order in which consecutive points are close to each other, so that neighbours share cache lines.
pub fn along_strips(positions: &[DVec2]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    let key = |i: u32| ((positions[i as usize].y / STRIP).floor(), positions[i as usize].x);
    order.sort_unstable_by(|&i, &j| {
        let ((strip_i, x_i), (strip_j, x_j)) = (key(i), key(j));
        strip_i.total_cmp(&strip_j).then(x_i.total_cmp(&x_j)).then(i.cmp(&j))
    });
    order
}

/// The points that coincide with one before them.
fn repeated(positions: &[DVec2]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    let at = |i: u32| positions[i as usize];
    order.sort_unstable_by(|&i, &j| at(i).x.total_cmp(&at(j).x).then(at(i).y.total_cmp(&at(j).y)).then(i.cmp(&j)));
    order.windows(2).filter(|pair| at(pair[0]) == at(pair[1])).map(|pair| pair[1]).collect()
}

/// True if no point is farther from some line than the distance by which points are separated.
fn lie_on_a_line(positions: &[DVec2]) -> bool {
    let offsets = || positions.iter().map(|&position| position - positions[0]);
    let Some(end) = offsets().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())) else { return true };
    offsets().all(|offset| end.perp_dot(offset).abs() <= PARTING * end.length())
}

/// The largest float below a number.
fn last_float_below(max: f64) -> f32 {
    let down = rounded_down(max);
    if f64::from(down) < max { down } else { down.next_down() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(boundary: Boundary) -> Frame {
        Frame::new(Domain { min: [-2.0, 1.0], max: [1.0, 3.0], boundary }, 24)
    }

    #[test]
    fn points_that_leave_come_back() {
        let size = frame(Boundary::Periodic).size();
        let out = DVec2::new(-0.25, size.y + 0.5);
        assert!(frame(Boundary::Periodic).fold(out).distance(DVec2::new(size.x - 0.25, 0.5)) < 1e-12);
        assert!(frame(Boundary::Bounded).fold(out).distance(DVec2::new(0.25, size.y - 0.5)) < 1e-12);
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for x in [-1e-300, -1e-17, 0.0, 1e-17, size.x, -size.x, 1e9, -1e9] {
                let folded = frame(boundary).fold(DVec2::new(x, x));
                assert!(folded.cmpge(DVec2::ZERO).all() && folded.cmplt(size).all(), "{x}: {folded}");
            }
        }
    }

    #[test]
    fn points_return_to_where_they_came_from() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let points = [[-1.9, 1.1], [0.3, 2.9999], [0.99, 1.5]];
            let entered = frame(boundary).enter(&points);
            assert_eq!(entered.iter().map(|&position| frame(boundary).leave(position)).collect::<Vec<_>>(), points);
        }
    }

    #[test]
    fn what_rounds_to_the_boundary_stays_inside() {
        for [min, max] in [[0.0, 1.0], [0.1, 0.7], [-1.0, 0.0], [-1e-45, 1e-45], [100.3, 100.4]] {
            for boundary in [Boundary::Periodic, Boundary::Bounded] {
                let frame = Frame::new(Domain { min: [min; 2], max: [max; 2], boundary }, 3);
                for position in [DVec2::ZERO, frame.size(), frame.size() * (1.0 - 1e-12)] {
                    let left = frame.leave(position);
                    assert!(left.iter().all(|&x| (min..max).contains(&f64::from(x))), "{left:?} of {min} to {max}");
                }
            }
        }
    }

    #[test]
    fn a_whole_ring_has_eight_copies_of_each_point() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let frame = frame(boundary);
            let point = DVec2::new(0.5, 0.75);
            let sites = frame.sites([point].into_iter(), f64::INFINITY);
            assert_eq!(sites.len(), 9);
            assert!(sites[0].is_original() && sites[0].position == point);
            assert!(sites[1..].iter().all(|site| !site.is_original() && site.source == 0));
            let left = sites.iter().find(|site| site.side == [-1, 0]).unwrap();
            let expected = if boundary == Boundary::Periodic { point.x - frame.size().x } else { -point.x };
            assert_eq!(left.position, DVec2::new(expected, point.y));
            // The only copy within 0.6 is the one beyond a vertical boundary.
            assert_eq!(frame.sites([point].into_iter(), 0.6).len(), 2);
            assert_eq!(frame.sites([point].into_iter(), 0.4).len(), 1);
            let nudged = frame.size() + 1e-7;
            assert_eq!(frame.sites([nudged].into_iter(), f64::INFINITY).len(), 9);
        }
    }

    #[test]
    fn coincident_points_and_lines_are_parted_and_nothing_else() {
        let frame = frame(Boundary::Bounded);
        let corner = [DVec2::new(1.0, 1.0), DVec2::new(2.0, 1.0), DVec2::new(1.0, 2.0)];
        let mut positions = corner;
        frame.part(&mut positions, 1);
        assert_eq!(positions, corner);

        let mut doubled = [corner[0], corner[1], corner[0], corner[2], corner[0]];
        frame.part(&mut doubled, 1);
        assert_eq!([doubled[0], doubled[1], doubled[3]], corner);
        let apart = [doubled[2].distance(corner[0]), doubled[4].distance(corner[0]), doubled[2].distance(doubled[4])];
        assert!(apart[..2].iter().all(|distance| (PARTING..2.0 * PARTING).contains(distance)) && apart[2] > 0.0);

        let line = [DVec2::new(1.0, 1.0), DVec2::new(1.5, 1.5), DVec2::new(2.0, 2.0)];
        let mut parted = line;
        frame.part(&mut parted, 1);
        assert!(std::iter::zip(line, parted).all(|(before, after)| before != after));
    }
}
