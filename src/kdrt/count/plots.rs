//! Plots: the domain cut into rectangles of which each can be changed without regard to the others.
//!
//! The samples in the *hole* of a plot are taken out and others put in. What is uncovered then lies within r of the
//! hole, and what decides about it within 2r: the hole is that far from the edges of its plot, unless nothing lies
//! beyond.

use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::points::Boundary;
use crate::rng::Rng;

/// The shortest side of a plot between two cuts in reaches: a hole of 2 and the 2 on each side of it.
const SIDE: i32 = 6;

/// How one axis is cut, from a random place on.
struct Cuts {
    size: i32,
    reach: i32,
    /// Regular plots; a bounded axis has one more, cut in two by its edge.
    count: i32,
    offset: i32,
    /// Whether the axis closes to a circle, of which plots are parts.
    is_circle: bool,
    /// Whether the axis is a circle too short to be cut: one plot that meets itself.
    is_uncut_circle: bool,
}

/// The part of an axis that a plot has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The first lattice point; beyond the end of a circle its first points follow.
    pub start: i32,
    pub length: i32,
    /// The first point of the hole and the one after the last, counted from `start`.
    pub hole: [i32; 2],
    /// Whether the last point is next to the first.
    pub is_circle: bool,
}

impl Cuts {
    fn new(size: i32, boundary: Boundary, reach: i32, rng: &mut Rng) -> Self {
        let count = size / (SIDE * reach);
        let periodic = boundary == Boundary::Periodic;
        Self {
            size,
            reach,
            count: count.max(1),
            offset: if count > 0 { rng.below((size / count) as u64) as i32 } else { 0 },
            is_circle: periodic && count > 0,
            is_uncut_circle: periodic && count == 0,
        }
    }

    /// How many plots there are along the axis; some may be empty.
    fn len(&self) -> i32 {
        if self.is_circle { self.count } else { self.count + 1 }
    }

    /// Where a regular plot begins, counted from the offset.
    fn edge(&self, index: i32) -> i32 {
        (i64::from(self.size) * i64::from(index) / i64::from(self.count)) as i32
    }

    /// The plot that a lattice point lies in.
    fn index(&self, point: i32) -> i32 {
        let from_offset =
            i64::from(if self.is_circle { (point - self.offset).rem_euclid(self.size) } else { point - self.offset });
        let regular = (((from_offset + 1) * i64::from(self.count) - 1).div_euclid(i64::from(self.size))) as i32;
        if self.is_circle { regular } else { regular + 1 }
    }

    fn span(&self, index: i32) -> Span {
        let margin = 2 * self.reach;
        if self.is_circle {
            let length = self.edge(index + 1) - self.edge(index);
            let start = self.offset + self.edge(index);
            return Span { start, length, hole: [margin, length - margin], is_circle: false };
        }
        let [start, end] = [index - 1, index].map(|index| (self.offset + self.edge(index)).clamp(0, self.size));
        let length = end - start;
        let first = if start == 0 { 0 } else { margin };
        let last = if end == self.size { length } else { length - margin };
        Span { start, length, hole: [first, last], is_circle: self.is_uncut_circle }
    }
}

/// The plots of a domain in one round.
pub struct Plots {
    axes: [Cuts; 2],
}

/// A plot; its own lattice points count from its corner.
pub struct Plot {
    pub axes: [Span; 2],
    size: [i32; 2],
}

impl Plots {
    /// Cuts the domain at places of `rng`'s choice.
    pub fn new(lattice: &Lattice, mut rng: Rng) -> Self {
        Self { axes: lattice.size.map(|size| Cuts::new(size, lattice.boundary, lattice.separation.reach, &mut rng)) }
    }

    /// The number of plots.
    pub fn len(&self) -> usize {
        self.axes.iter().map(|axis| axis.len() as usize).product()
    }

    /// The number of the plot that a lattice point lies in.
    pub fn holding(&self, point: [i32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis: usize| self.axes[axis].index(point[axis]) as usize);
        row * self.axes[0].len() as usize + column
    }

    /// A plot by its number.
    pub fn get(&self, plot: usize) -> Plot {
        let columns = self.axes[0].len() as usize;
        let index = [plot % columns, plot / columns];
        Plot {
            axes: [0, 1].map(|axis: usize| self.axes[axis].span(index[axis] as i32)),
            size: [0, 1].map(|axis: usize| self.axes[axis].size),
        }
    }
}

impl Plot {
    /// The lattice points of the hole.
    pub fn hole(&self) -> Rect {
        Rect { min: self.axes.map(|axis| axis.hole[0]), max: self.axes.map(|axis| axis.hole[1]) }
    }

    /// A lattice point of the domain, counted from the plot's corner.
    pub fn inward(&self, point: [i32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| (point[axis] - self.axes[axis].start).rem_euclid(self.size[axis]))
    }

    /// A lattice point of the plot as one of the domain.
    pub fn outward(&self, point: [i32; 2]) -> [i32; 2] {
        std::array::from_fn(|axis| (point[axis] + self.axes[axis].start).rem_euclid(self.size[axis]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Domain;
    use crate::rng::Draw;

    fn lattices() -> Vec<Lattice> {
        let extents = [[1.0, 1.0], [0.3, 12.0], [0.05, 40.0], [0.59, 0.61], [0.6, 0.02]];
        let lattice = |(boundary, extent): (Boundary, [f64; 2])| {
            let domain = Domain { min: [16.0, -3.0], max: [16.0 + extent[0], extent[1] - 3.0], boundary };
            Lattice::new(&domain, 0.1).unwrap()
        };
        let boundaries = [Boundary::Periodic, Boundary::Bounded];
        boundaries.into_iter().flat_map(|boundary| extents.map(|extent| (boundary, extent))).map(lattice).collect()
    }

    #[test]
    fn every_lattice_point_lies_in_one_plot_and_comes_back() {
        for lattice in lattices() {
            for round in 0..20 {
                let plots = Plots::new(&lattice, Rng::at(0, Draw::Probe, &[round]));
                let inside = |plot: &Plot| Rect { min: [0; 2], max: plot.axes.map(|axis| axis.length) };
                let area = |rect: Rect| i64::from(rect.length(0)) * i64::from(rect.length(1));
                let areas: i64 = (0..plots.len()).map(|plot| area(inside(&plots.get(plot)))).sum();
                assert_eq!(areas, area(lattice.rect()));
                let mut rng = Rng::at(1, Draw::Probe, &[round]);
                for _ in 0..200 {
                    let point = lattice.size.map(|size| rng.below(size as u64) as i32);
                    let plot = plots.get(plots.holding(point));
                    assert!(inside(&plot).contains(plot.inward(point)));
                    assert_eq!(plot.outward(plot.inward(point)), point);
                }
                for plot in (0..plots.len()).filter(|&plot| !inside(&plots.get(plot)).is_empty()) {
                    let [first, last] = [[0; 2], plots.get(plot).axes.map(|axis| axis.length - 1)];
                    let held = [first, last].map(|corner| plots.holding(plots.get(plot).outward(corner)));
                    assert_eq!(held, [plot; 2]);
                }
            }
        }
    }

    /// From the definition: whatever of the domain is within two reaches of the hole lies in the plot. On a circle that
    /// is not cut the plot is everything.
    #[test]
    fn holes_are_two_reaches_away_from_other_plots() {
        for lattice in lattices() {
            for round in 0..20 {
                let plots = Plots::new(&lattice, Rng::at(0, Draw::Probe, &[round]));
                for plot in (0..plots.len()).map(|plot| plots.get(plot)).filter(|plot| !plot.hole().is_empty()) {
                    for (span, size) in std::iter::zip(plot.axes, lattice.size) {
                        let decides =
                            [span.hole[0] - 2 * lattice.separation.reach, span.hole[1] + 2 * lattice.separation.reach];
                        let begins = decides[0] >= 0 || lattice.boundary == Boundary::Bounded && span.start == 0;
                        let ends = decides[1] <= span.length
                            || lattice.boundary == Boundary::Bounded && span.start + span.length == size;
                        let is_all = span.is_circle && span.length == size && span.hole == [0, size];
                        assert!(is_all || begins && ends, "{span:?} of {size}");
                    }
                }
            }
        }
    }

    /// Places that no round could change would have to stay as they are.
    #[test]
    fn every_place_is_in_some_hole() {
        for lattice in lattices() {
            let mut rng = Rng::at(2, Draw::Probe, &[]);
            for _ in 0..50 {
                let point = lattice.size.map(|size| rng.below(size as u64) as i32);
                let in_a_hole = (0..200).any(|round| {
                    let plots = Plots::new(&lattice, Rng::at(3, Draw::Probe, &[round]));
                    let plot = plots.get(plots.holding(point));
                    plot.hole().contains(plot.inward(point))
                });
                assert!(in_a_hole, "{point:?} of {:?}, {:?}", lattice.size, lattice.boundary);
            }
        }
    }
}
