//! The cells of a block of a tiled cuboid that may be open: the shape that is filled there (`tiling.rs`).

use crate::plane::Rect;
use crate::simd::Lanes;
use crate::volume::grid::{Grid, Touched};
use crate::volume::search::Centre;
use crate::volume::shape::{Shape, Voxels};
use crate::volume::voxels::Voxel;

/// The places of a region that may be open.
pub struct Exposed {
    /// The part of the region that they lie in; empty if there are none.
    pub extent: Rect<3>,
    /// The parts of leaves that are deeper inside than a reach.
    inside: Vec<Rect<3>>,
    /// The eliminated points whose balls may have places in the region, with their images.
    eliminated: Vec<Centre>,
    /// The exposed cells: a row along x has a word, with a bit for each.
    rows: Vec<u64>,
}

impl Exposed {
    /// The places of a region that lie in none of some boxes, or in the balls of eliminated points.
    pub fn new(region: &Rect<3>, inside: Vec<Rect<3>>, eliminated: Vec<Centre>, reach: i32) -> Self {
        Self { extent: extent(region, &inside, &eliminated, reach), inside, eliminated, rows: Vec::new() }
    }
}

/// The part of a region that may be open: a box around all that lies in none of the boxes, and around the balls of eliminated
/// points. Empty if there is nothing.
fn extent(region: &Rect<3>, inside: &[Rect<3>], eliminated: &[Centre], reach: i32) -> Rect<3> {
    let mut part = *region;
    // Slices at the ends that lie in one box are cut off, until none does.
    while !part.is_empty() {
        let before = part;
        for axis in 0..3 {
            let crosses =
                |rect: &&Rect<3>| (0..3).all(|k| k == axis || rect.min[k] <= part.min[k] && part.max[k] <= rect.max[k]);
            let (mut min, mut max) = (part.min[axis], part.max[axis]);
            for rect in inside.iter().filter(crosses) {
                min = if rect.min[axis] <= min { min.max(rect.max[axis]) } else { min };
                max = if rect.max[axis] >= max { max.min(rect.min[axis]) } else { max };
            }
            (part.min[axis], part.max[axis]) = (min, max);
        }
        if part == before {
            break;
        }
    }
    for &centre in eliminated {
        let ball = Rect { min: centre.map(|x| x - reach), max: centre.map(|x| x + reach + 1) }.intersection(region);
        if !ball.is_empty() {
            part = if part.is_empty() { ball } else { part.hull(&ball) };
        }
    }
    part
}

/// The bits of a range of columns.
fn bits(columns: std::ops::Range<usize>) -> u64 {
    let below = |column: usize| if column >= 64 { u64::MAX } else { (1 << column) - 1 };
    below(columns.end) & !below(columns.start)
}

impl Shape for Exposed {
    fn begin(&mut self, grid: &Grid) {
        let [columns, rows, layers] = grid.counts();
        debug_assert!(columns <= 64);
        self.rows.clear();
        self.rows.resize(rows * layers, bits(0..columns));
        for rect in &self.inside {
            let [xs, ys, zs] = grid.cells_within(rect);
            let closed = bits(xs);
            for row in zs.flat_map(|z| ys.clone().map(move |y| z * rows + y)) {
                self.rows[row] &= !closed;
            }
        }
        for &centre in &self.eliminated {
            let Some(Touched { rows: [ys, zs], .. }) = grid.touched(centre) else { continue };
            for (z, y) in zs.flat_map(|z| ys.clone().map(move |y| (z, y))) {
                self.rows[z * rows + y] |= bits(grid.touched_columns(centre, y, z));
            }
        }
    }

    #[inline(always)]
    fn needs(&self, grid: &Grid, ball: Centre) -> bool {
        let Some(Touched { columns, rows: [ys, zs] }) = grid.touched(ball) else { return false };
        let (columns, [_, rows, _]) = (bits(columns), grid.counts());
        zs.into_iter().any(|z| self.rows[z * rows..][ys.clone()].iter().any(|row| row & columns != 0))
    }

    #[inline(always)]
    fn cells<L: Lanes>(&mut self, _: L, grid: &Grid, mut open: Vec<Voxel>) -> Voxels {
        let [_, rows, _] = grid.counts();
        open.retain(|voxel| {
            let [x, y, z] = grid.place(voxel.cell.into());
            self.rows[usize::from(z) * rows + usize::from(y)] >> x & 1 == 1
        });
        Voxels { inside: open, cut: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Separation;
    use crate::rng::{Draw, Rng};
    use crate::volume::search::square;

    fn random_box(rng: &mut Rng, longest: u64) -> Rect<3> {
        let min: Centre = std::array::from_fn(|_| rng.below(60) as i32 - 15);
        Rect { min, max: min.map(|x| x + 1 + rng.below(longest) as i32) }
    }

    /// Every lattice point of a region that may be open lies in its extent and in an exposed cell, and the balls that cover
    /// points of these cells are needed.
    #[test]
    fn what_may_be_open_is_exposed_and_its_balls_are_needed() {
        let (mut grid, mut left) = (Grid::default(), 0);
        let separation = Separation::new(8.0);
        let covers = |ball: Centre, point: Centre| square(ball, point) < separation.threshold;
        for seed in 0..400 {
            let mut rng = Rng::at(seed, Draw::Probe, &[]);
            let whole = random_box(&mut rng, 40);
            let inside: Vec<_> = (0..seed % 5).map(|_| random_box(&mut rng, 70)).collect();
            let eliminated: Vec<_> = (0..rng.below(3)).map(|_| random_box(&mut rng, 1).min).collect();
            let mut exposed = Exposed::new(&whole, inside.clone(), eliminated.clone(), separation.reach);
            let region = exposed.extent;
            assert!(region.is_empty() || region.intersection(&whole) == region);
            if !region.is_empty() {
                grid.reset(&region, 8.0, separation, &[]);
                exposed.begin(&grid);
            }
            let balls: Vec<_> = (0..20).map(|_| random_box(&mut rng, 1).min).collect();
            let levels = if region.is_empty() { Vec::new() } else { grid.levels() };
            let mut cells = vec![None; if region.is_empty() { 0 } else { grid.cells() }];
            for (cell, is_exposed) in cells.iter_mut().enumerate() {
                let [x, y, z] = grid.place(cell).map(usize::from);
                *is_exposed = (exposed.rows[z * grid.counts()[1] + y] >> x & 1 == 1)
                    .then(|| grid.points(&levels[0], Voxel::cell(cell)));
            }
            for z in whole.min[2]..whole.max[2] {
                for (y, x) in
                    (whole.min[1]..whole.max[1]).flat_map(|y| (whole.min[0]..whole.max[0]).map(move |x| (y, x)))
                {
                    let point = [x, y, z];
                    let may_be_open = !inside.iter().any(|rect| rect.contains(point))
                        || eliminated.iter().any(|&ball| covers(ball, point));
                    if may_be_open {
                        assert!(region.contains(point));
                        let local = std::array::from_fn(|axis| point[axis] - region.min[axis]);
                        assert!(cells.iter().flatten().any(|cell| cell.contains(local)), "{point:?} {seed}");
                        for &ball in balls.iter().filter(|&&ball| covers(ball, point)) {
                            assert!(exposed.needs(&grid, ball));
                        }
                    } else if !region.contains(point) {
                        left += 1;
                    }
                }
            }
        }
        assert!(left > 100_000, "{left}");
    }
}
