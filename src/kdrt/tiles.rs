//! The tiles in which samples of an edited set of the plane are kept and gaps are filled, and the regions that meet them.
//!
//! On a torus everything is meant with its images: a region meets a position if its box has an image of it, and its ball
//! has one. Tiles are regular and 12 to 24 radii wide. Their counts are even there, so that the parities of columns and
//! rows go on across the seam; an axis that is shorter than two tiles is one tile, which meets its own images.

use crate::plane::{Lattice, Rect};
use crate::points::{Boundary, Domain};
use crate::region::Region;

/// The widest tile, in radii.
const WIDEST: f64 = 24.0;

/// A tile, by its column and row.
pub type Tile = [i32; 2];

/// The tiles of a domain.
pub struct Tiles {
    pub domain: Domain,
    pub lattice: Lattice,
    /// The number of columns and rows.
    counts: [i32; 2],
}

impl Tiles {
    /// The tiles of a domain with its lattice.
    pub fn new(domain: Domain, lattice: Lattice) -> Self {
        let counts = lattice.size.map(|size| {
            let tiles = f64::from(size) / (WIDEST * lattice.radius);
            match lattice.boundary {
                Boundary::Bounded => (tiles.ceil() as i32).max(1),
                Boundary::Periodic if tiles < 2.0 => 1,
                Boundary::Periodic => 2 * (tiles / 2.0).ceil() as i32,
            }
        });
        Self { domain, lattice, counts }
    }

    /// True if the domain is a torus.
    pub fn is_periodic(&self) -> bool {
        self.domain.boundary == Boundary::Periodic
    }

    /// The axes along which a tile is the whole of a torus.
    pub fn wraps(&self) -> [bool; 2] {
        self.counts.map(|count| self.is_periodic() && count == 1)
    }

    /// The tile of a position of the domain; of another one, one that is not there.
    pub fn at(&self, position: [f64; 2]) -> Tile {
        std::array::from_fn(|axis| {
            let tile = ((position[axis] - self.domain.min[axis]) / self.side(axis)).floor() as i32;
            // Rounding may lead beyond the last one.
            if position[axis] < self.domain.max[axis] { tile.min(self.counts[axis] - 1) } else { tile }
        })
    }

    /// The period of a torus along an axis.
    pub fn period(&self, axis: usize) -> Option<f64> {
        self.is_periodic().then(|| self.domain.extent()[axis])
    }

    /// The distance along an axis from a coordinate to the nearest image of an interval.
    pub fn gap(&self, axis: usize, x: f64, [low, high]: [f64; 2]) -> f64 {
        match self.period(axis) {
            Some(period) if high - low >= period => 0.0,
            Some(period) => {
                let after = x - low - period * ((x - low) / period).floor();
                (after - (high - low)).max(0.0).min(period - after)
            }
            None => (low - x).max(x - high).max(0.0),
        }
    }

    /// True if an interval along an axis, or an image of it, meets a region's box and the span of its ball.
    fn is_touched(&self, region: &Region, axis: usize, [low, high]: [f64; 2]) -> bool {
        let (min, max) = (region.min[axis], region.max[axis]);
        let meets_box = match self.period(axis) {
            Some(period) => ((min - high) / period).ceil() <= ((max - low) / period).floor(),
            None => low <= max && min <= high,
        };
        meets_box && self.gap(axis, region.centre[axis], [low, high]) <= region.radius
    }

    /// True if a rectangle, given by its lowest and its highest coordinates, meets a region's box and its ball.
    pub fn touches(&self, region: &Region, [low, high]: [[f32; 2]; 2]) -> bool {
        let along = |axis: usize| [f64::from(low[axis]), f64::from(high[axis])];
        let gap = |axis: usize| self.gap(axis, region.centre[axis], along(axis));
        let [x, y, z] = [gap(0), gap(1), region.centre[2]];
        (0..2).all(|axis| self.is_touched(region, axis, along(axis)))
            && (region.min[2]..=region.max[2]).contains(&0.0)
            && x * x + y * y + z * z <= region.radius * region.radius
    }

    /// The tiles that may have positions in a region.
    pub fn touched_by(&self, region: &Region) -> Vec<Tile> {
        let of_axis = |axis: usize| -> Vec<i32> {
            let (min, side) = (self.domain.min[axis], self.side(axis));
            // Wider by what a lattice point or rounding can lie beyond.
            let margin = 1e-9 * side + 2.0 * self.lattice.unit();
            let ends = |tile: i32| [tile, tile + 1].map(|edge| min + side * f64::from(edge));
            let is_touched = |&tile: &i32| {
                let [low, high] = ends(tile);
                self.is_touched(region, axis, [low - margin, high + margin])
            };
            (0..self.counts[axis]).filter(is_touched).collect()
        };
        let (columns, rows) = (of_axis(0), of_axis(1));
        rows.into_iter().flat_map(|y| columns.iter().map(move |&x| [x, y])).collect()
    }

    /// The width (axis 0) or height (axis 1) of the tiles, in the units of the domain.
    fn side(&self, axis: usize) -> f64 {
        self.domain.extent()[axis] / f64::from(self.counts[axis])
    }

    /// The lattice points of a tile.
    pub fn rect(&self, tile: Tile) -> Rect {
        let edge = |axis: usize, tile: i32| {
            (i64::from(self.lattice.size[axis]) * i64::from(tile) / i64::from(self.counts[axis])) as i32
        };
        Rect { min: [0, 1].map(|axis| edge(axis, tile[axis])), max: [0, 1].map(|axis| edge(axis, tile[axis] + 1)) }
    }

    /// A tile and those around it, on a torus each with the translation to its image there.
    pub fn around(&self, tile: Tile) -> impl Iterator<Item = (Tile, [i32; 2])> {
        let along = move |axis: usize| {
            (tile[axis] - 1..=tile[axis] + 1).filter_map(move |index| {
                let (count, turn) = (self.counts[axis], index.div_euclid(self.counts[axis]));
                let is_there = turn == 0 || self.is_periodic();
                is_there.then(|| (index - turn * count, turn * self.lattice.size[axis]))
            })
        };
        along(1).flat_map(move |(y, up)| along(0).map(move |(x, right)| ([x, y], [right, up])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    fn tiles(size: [f64; 2], boundary: Boundary) -> Tiles {
        let domain = Domain { min: [-0.3, 1.7], max: [size[0] - 0.3, size[1] + 1.7], boundary };
        Tiles::new(domain, Lattice::new(&domain, 0.01).unwrap())
    }

    const SIZES: [[f64; 2]; 4] = [[2.0, 1.0], [0.479, 0.481], [0.2, 3.0], [0.005, 0.24]];

    #[test]
    fn tiles_are_12_to_24_radii_wide_and_partition_the_lattice() {
        for (size, boundary) in
            SIZES.into_iter().flat_map(|size| [(size, Boundary::Periodic), (size, Boundary::Bounded)])
        {
            let tiles = tiles(size, boundary);
            let (mut area, radius) = (0, tiles.lattice.radius);
            for tile in tiles.touched_by(&Region::EVERYWHERE) {
                let rect = tiles.rect(tile);
                area += i64::from(rect.length(0)) * i64::from(rect.length(1));
                for axis in 0..2 {
                    let (width, is_alone) = (f64::from(rect.length(axis)) / radius, tiles.counts[axis] == 1);
                    let widest = if tiles.wraps()[axis] { 48.0 } else { 24.0 };
                    assert!(width <= widest + 0.01 && (is_alone || width >= 11.99), "{width}");
                    assert!(boundary == Boundary::Bounded || is_alone || tiles.counts[axis] % 2 == 0);
                }
            }
            assert_eq!(area, tiles.lattice.size.into_iter().map(i64::from).product::<i64>());
        }
    }

    /// Each position is in a tile that a region at it touches, and the tiles around one hold all that is near it.
    #[test]
    fn positions_lie_in_tiles_that_are_found() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        for (size, boundary) in
            SIZES.into_iter().flat_map(|size| [(size, Boundary::Periodic), (size, Boundary::Bounded)])
        {
            let tiles = tiles(size, boundary);
            for _ in 0..2_000 {
                let point = tiles.lattice.size.map(|size| rng.below(size as u64) as i32);
                let position = tiles.lattice.position(point);
                let tile = tiles.at(position.map(f64::from));
                let turns = |axis: usize| if tiles.is_periodic() { rng_turn(point[axis]) } else { 0.0 };
                let centre = [0, 1].map(|axis| f64::from(position[axis]) + turns(axis) * tiles.domain.extent()[axis]);
                let region = Region::ball([centre[0], centre[1], 0.0], 1e-6);
                assert!(tiles.touched_by(&region).contains(&tile) && tiles.touches(&region, [position; 2]));
                // A point near it, perhaps of an image, as it is seen from there.
                let reach = tiles.lattice.separation.reach;
                let near = [0, 1].map(|axis| {
                    // Of images on a torus narrower than the radius the nearest counts.
                    let reach = reach.min(tiles.lattice.size[axis] / 2);
                    point[axis] + rng.below(2 * reach as u64 + 1) as i32 - reach
                });
                let own = [0, 1].map(|axis| near[axis].rem_euclid(tiles.lattice.size[axis]));
                let of = tiles.at(tiles.lattice.position(own).map(f64::from));
                if tiles.is_periodic() || tiles.lattice.rect().contains(near) {
                    let shift = [0, 1].map(|axis| near[axis] - own[axis]);
                    let home =
                        tiles.touched_by(&Region::EVERYWHERE).into_iter().find(|&t| tiles.rect(t).contains(point));
                    assert!(tiles.around(home.unwrap()).any(|found| found == (of, shift)), "{near:?} from {point:?}");
                }
            }
        }
    }

    /// A number of turns, from -2 to 2.
    fn rng_turn(seed: i32) -> f64 {
        f64::from(seed % 5 - 2)
    }

    /// Rectangles and regions of all kinds, against points of the rectangle and their images.
    #[test]
    fn a_region_touches_what_holds_an_image_of_one_of_its_points() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let mut seen = [0; 2];
        for round in 0..20_000 {
            let boundary = if round % 2 == 0 { Boundary::Periodic } else { Boundary::Bounded };
            let tiles = tiles([2.0, 1.0], boundary);
            let turns = if tiles.is_periodic() { -8..=8 } else { 0..=0 };
            let mut place = |from: f64, width: f64| from + width * rng.unit();
            let position = [place(-0.3, 2.0) as f32, place(1.7, 1.0) as f32];
            let low = [place(-2.0, 5.0), place(0.0, 5.0), -1.0];
            let high = [low[0] + place(0.0, 1.5), low[1] + place(0.0, 1.5), 1.0];
            let centre = [place(-2.0, 5.0), place(0.0, 5.0), 0.2];
            let ball = Region { centre, radius: place(0.3, 0.8), ..Region::EVERYWHERE };
            let region = match round % 3 {
                0 => Region::cuboid(low, high),
                1 => ball,
                _ => Region { min: low, max: high, ..ball },
            };
            let images = || {
                let [width, height] = tiles.domain.extent();
                let shifts = turns.clone().flat_map(|y| turns.clone().map(move |x| [f64::from(x), f64::from(y)]));
                shifts.map(move |[x, y]| [f64::from(position[0]) + x * width, f64::from(position[1]) + y * height, 0.0])
            };
            let in_box = |p: [f64; 3]| (0..3).all(|axis| (region.min[axis]..=region.max[axis]).contains(&p[axis]));
            let square = |p: [f64; 3]| (0..3).map(|axis| (p[axis] - region.centre[axis]).powi(2)).sum::<f64>();
            let is_in = images().any(in_box) && images().any(|p| square(p) <= region.radius * region.radius);
            assert_eq!(tiles.touches(&region, [position; 2]), is_in, "{region:?} and {position:?}");
            // A rectangle around the position, clipped to the domain.
            let by = place(0.0, 0.2) as f32;
            let ends =
                |axis: usize, min: f32, max: f32| [(position[axis] - by).max(min), (position[axis] + by).min(max)];
            let (x, y) = (ends(0, -0.3, 1.6999), ends(1, 1.7, 2.6999));
            assert!(!is_in || tiles.touches(&region, [[x[0], y[0]], [x[1], y[1]]]));
            seen[usize::from(is_in)] += 1;
        }
        assert!(seen[0] > 2_000 && seen[1] > 2_000, "{seen:?}");
    }
}
