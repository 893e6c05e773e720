//! The filling of a rectangle with samples of several classes at once: darts at the uncovered voxels of each class,
//! which are cut until none is left, as in the flat quadtree (`plane/quadtree.rs`).
//!
//! A class has *exclusion disks*: those in which samples of any class, and given samples, allow none of its own. They
//! have all radii, so no grid of cells of one sample each can find them. Instead the rectangle is cut into cells, and
//! each cell knows for each class the disks that meet it, or that one covers it.
//!
//! # Exactness
//! The centre of a sample's disk is a lattice point and its squared radius an integer below 2^53. Squared distances
//! in `f64` are exact where they are below that, and where they are not, rounding keeps them above it: so the tests of
//! points and rectangles are exact, and one is enough. The disks of given samples are anywhere; rounding is monotone,
//! so the points of a rectangle that lies in one lie in it too, and filling ends.

use crate::math::square;
use crate::plane::{Disk, Rect, darts};
use crate::rng::Rng;

/// The number of cells of a row that a word has bits for.
const BITS: usize = u64::BITS as usize;

/// A disk in which a class has no sample: the points nearer to a place than a radius.
#[derive(Clone, Copy)]
pub struct ExclusionDisk {
    centre: [f64; 2],
    square: f64,
    radius: f64,
}

impl ExclusionDisk {
    /// The points whose squared distance from a lattice point is below a threshold.
    pub fn around(point: [i32; 2], threshold: i64) -> Self {
        let square = threshold as f64;
        Self { centre: point.map(f64::from), square, radius: square.sqrt() }
    }

    /// The disk of a given sample.
    pub fn of_given(disk: &Disk) -> Self {
        Self { centre: disk.centre, square: disk.radius * disk.radius, radius: disk.radius }
    }

    /// True if a lattice point lies in the disk.
    #[inline(always)]
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let [dx, dy] = [x - self.centre[0], y - self.centre[1]];
        dx * dx + dy * dy < self.square
    }
}

/// A cell for one class.
#[derive(Default)]
struct Slot {
    /// True if one disk covers the cell.
    is_covered: bool,
    /// The disks that meet the cell, if none covers it.
    disks: Vec<ExclusionDisk>,
}

/// A part of a cell that may be uncovered for a class.
#[derive(Clone, Copy)]
struct Voxel {
    rect: Rect,
    slot: u32,
}

/// A rectangle that is being filled, and the memory, which is reused for the next.
#[derive(Default)]
pub struct ClassFilling {
    /// The starts of the columns (axis 0) and rows (axis 1) of cells, and the end of the last.
    edges: [Vec<i32>; 2],
    /// The cells of the first class by rows, those of the next class, and so on.
    slots: Vec<Slot>,
    /// The slots that are not covered: for each class and row of cells, words with a bit for each cell.
    open: Vec<u64>,
    /// The number of slots that are not covered.
    left: usize,
    /// The parts that may be uncovered, in squares no wider than `width`.
    voxels: Vec<Voxel>,
    width: i32,
    /// The number of darts until the voxels are cut again.
    darts: usize,
    /// Working memory for the next level's voxels.
    next: Vec<Voxel>,
    /// Working memory for the squared distances from a disk's centre to columns: the nearest and the farthest.
    squares: Vec<[f64; 2]>,
}

impl ClassFilling {
    /// Begins with a rectangle of lattice points and a number of classes, whose samples are all at least a radius apart
    /// within each class.
    #[inline(always)]
    pub fn begin(&mut self, rect: &Rect, classes: usize, radius: f64) {
        // So wide that two points of a cell conflict within a class.
        let widest = radius * std::f64::consts::FRAC_1_SQRT_2 * (1.0 - 1e-9);
        for (axis, edges) in self.edges.iter_mut().enumerate() {
            let (first, length) = (i64::from(rect.min[axis]), i64::from(rect.length(axis)));
            let count = (length as f64 / widest).ceil().max(1.0) as i64;
            edges.clear();
            edges.extend((0..=count).map(|index| (first + length * index / count) as i32));
        }
        let [columns, rows] = self.counts();
        for slot in &mut self.slots {
            slot.is_covered = false;
            slot.disks.clear();
        }
        self.slots.resize_with(classes * columns * rows, Slot::default);
        self.left = self.slots.len();
        self.open.clear();
        for _ in 0..classes * rows {
            self.open.extend((0..columns).step_by(BITS).map(|first| u64::MAX >> (BITS - (columns - first).min(BITS))));
        }
    }

    /// True if every class is covered.
    #[inline(always)]
    pub fn is_covered(&self) -> bool {
        self.left == 0
    }

    /// The approximate number of bytes that a cell takes for each class.
    pub const BYTES_PER_CELL: f64 = 275.0;

    #[inline(always)]
    fn counts(&self) -> [usize; 2] {
        [0, 1].map(|axis: usize| self.edges[axis].len() - 1)
    }

    /// Excludes a disk for the samples of a class, given by its number in the filling.
    #[inline(always)]
    pub fn exclude(&mut self, class: usize, disk: &ExclusionDisk) {
        let (columns, rows) = (self.met(0, disk), self.met(1, disk));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let squares = |edges: &[i32], centre: f64| {
            let (first, last) = (f64::from(edges[0]), f64::from(edges[1] - 1));
            let (nearest, farthest) = ((first - centre).max(centre - last).max(0.0), farthest(centre, first, last));
            [nearest * nearest, farthest * farthest]
        };
        self.squares.clear();
        let edges = &self.edges[0][columns.start..columns.end + 1];
        self.squares.extend(edges.windows(2).map(|edges| squares(edges, disk.centre[0])));
        let [width, height] = self.counts();
        let words = width.div_ceil(BITS);
        for row in rows {
            let [nearest_y, farthest_y] = squares(&self.edges[1][row..row + 2], disk.centre[1]);
            let slots = &mut self.slots[(class * height + row) * width..][..width];
            let open = &mut self.open[(class * height + row) * words..][..words];
            let met = columns.start / BITS..(columns.end - 1) / BITS + 1;
            for (word, open) in met.clone().zip(&mut open[met]) {
                let mut bits = *open & between(columns.start, columns.end, word);
                while bits != 0 {
                    let column = word * BITS + bits.trailing_zeros() as usize;
                    bits &= bits - 1;
                    let [nearest_x, farthest_x] = self.squares[column - columns.start];
                    if nearest_x + nearest_y >= disk.square {
                        continue;
                    }
                    if farthest_x + farthest_y < disk.square {
                        slots[column].is_covered = true;
                        *open &= !(1 << (column % BITS));
                        self.left -= 1;
                    } else {
                        slots[column].disks.push(*disk);
                    }
                }
            }
        }
    }

    /// The columns (axis 0) or rows (axis 1) that a disk may meet.
    #[inline(always)]
    fn met(&self, axis: usize, disk: &ExclusionDisk) -> std::ops::Range<usize> {
        let edges = &self.edges[axis];
        let (count, first) = ((edges.len() - 1) as f64, f64::from(edges[0]));
        let per_point = count / (f64::from(edges[edges.len() - 1]) - first);
        let from = (disk.centre[axis] - disk.radius - first) * per_point;
        let to = (disk.centre[axis] + disk.radius - first + 1.0) * per_point;
        // For numbers that are not negative a conversion rounds down; `floor` would be a function call.
        if from < count && to >= 0.0 { from as usize..to.min(count - 1.0) as usize + 1 } else { 0..0 }
    }

    /// Starts to fill the part that the disks leave, with so many darts for each uncovered cell before any is cut.
    /// After that, [`darts()`] gives their number.
    #[inline(always)]
    pub fn open(&mut self, darts: usize) {
        let [width, height] = self.counts();
        let (edges, voxels) = (&self.edges, &mut self.voxels);
        let longest = |axis: usize| edges[axis].windows(2).map(|edges| edges[1] - edges[0]).max().unwrap_or(0);
        self.width = longest(0).max(longest(1));
        voxels.clear();
        voxels.extend((0..).zip(&self.slots).filter(|(_, slot)| !slot.is_covered).map(|(index, _)| {
            let (x, y) = (index as usize % width, index as usize / width % height);
            let rect = Rect { min: [edges[0][x], edges[1][y]], max: [edges[0][x + 1], edges[1][y + 1]] };
            Voxel { rect, slot: index }
        }));
        self.darts = darts * self.voxels.len();
    }

    /// Throws darts until one lies in no disk of its class: a new sample, with the number of the class, whose disks are
    /// to be put in before the next call. None when everything is covered.
    ///
    /// A dart falls with the same probability on each lattice point that may be uncovered, of any class.
    #[inline(always)]
    pub fn next_sample(&mut self, rng: &mut Rng) -> Option<(usize, [i32; 2])> {
        loop {
            let sample = self.next_before_cut(rng);
            if sample.is_some() || self.voxels.is_empty() {
                return sample;
            }
            self.cut();
            self.darts = darts(self.voxels.len());
        }
    }

    /// [`ClassFilling::next_sample`], but also None when no darts are left before the next cut.
    #[inline(always)]
    pub fn next_before_cut(&mut self, rng: &mut Rng) -> Option<(usize, [i32; 2])> {
        while self.darts > 0 {
            self.darts -= 1;
            let Voxel { rect, slot } = self.voxels[rng.below(self.voxels.len() as u64) as usize];
            let Slot { is_covered, disks } = &self.slots[slot as usize];
            if *is_covered {
                continue;
            }
            let [x, y] = rng.pair_below(self.width as u32);
            let point = [rect.min[0] + x as i32, rect.min[1] + y as i32];
            if rect.contains(point) && !disks.iter().any(|disk| disk.holds(point.map(f64::from))) {
                let [width, height] = self.counts();
                return Some((slot as usize / (width * height), point));
            }
        }
        None
    }

    /// Cuts the voxels in sixteen and drops those that one disk covers. Single lattice points are not cut.
    #[inline(always)]
    fn cut(&mut self) {
        let width = (self.width + 3) / 4;
        self.next.clear();
        for &Voxel { rect, slot } in &self.voxels {
            let Slot { is_covered, disks } = &self.slots[slot as usize];
            if *is_covered {
                continue;
            }
            let mut open = open_parts(disks, &rect, width);
            while open != 0 {
                let part = open.trailing_zeros() as i32;
                open &= open - 1;
                let min = [rect.min[0] + part % 4 * width, rect.min[1] + part / 4 * width];
                let max = [0, 1].map(|axis: usize| (min[axis] + width).min(rect.max[axis]));
                self.next.push(Voxel { rect: Rect { min, max }, slot });
            }
        }
        self.width = width;
        std::mem::swap(&mut self.voxels, &mut self.next);
    }
}

/// The bits of a word, of those of a row, that stand for the cells from a first one to before an end. At least one is
/// set.
#[inline(always)]
fn between(first: usize, end: usize, word: usize) -> u64 {
    let [from, to] = [first, end].map(|cell| cell.saturating_sub(word * BITS).min(BITS));
    (u64::MAX >> (BITS - to)) & (u64::MAX << from)
}

/// The distance along an axis from a centre to the farthest of the points from `first` to `last`.
#[inline(always)]
fn farthest(centre: f64, first: f64, last: f64) -> f64 {
    (centre - first).max(last - centre)
}

/// The sixteenths of a voxel, four by four of the given width from its corner on: bit `4·row + column` says that this
/// one is not empty and no disk covers it.
#[inline(always)]
fn open_parts(disks: &[ExclusionDisk], voxel: &Rect, width: i32) -> u16 {
    let first = |axis: usize, part: usize| voxel.min[axis] + part as i32 * width;
    let last = |axis: usize, part: usize| (first(axis, part) + width).min(voxel.max[axis]) - 1;
    let ends: [[[f64; 4]; 2]; 2] = std::array::from_fn(|axis| {
        [
            std::array::from_fn(|part| f64::from(first(axis, part))),
            std::array::from_fn(|part| f64::from(last(axis, part))),
        ]
    });
    // The distance by which the farthest corner of each part lies outside the disk that it is deepest in.
    let mut outside = [[f64::MAX; 4]; 4];
    for disk in disks {
        let squares: [[f64; 4]; 2] = std::array::from_fn(|axis| {
            let [first, last] = &ends[axis];
            std::array::from_fn(|part| square(farthest(disk.centre[axis], first[part], last[part])))
        });
        for row in 0..4 {
            for column in 0..4 {
                let beyond = squares[0][column] + squares[1][row] - disk.square;
                // Two branches that vectors have as one instruction.
                outside[row][column] = if beyond < outside[row][column] { beyond } else { outside[row][column] };
            }
        }
    }
    let mut open = 0;
    for part in 0..16 {
        let is_empty =
            (0..2).any(|axis| last(axis, [part % 4, part / 4][axis]) < first(axis, [part % 4, part / 4][axis]));
        open |= u16::from(!is_empty && outside[part / 4][part % 4] >= 0.0) << part;
    }
    open
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Draw;

    /// The farthest lattice point of a rectangle from a disk's centre, and the nearest, by a loop over all.
    fn squares(disk: &ExclusionDisk, rect: &Rect) -> [f64; 2] {
        let mut found = [f64::MAX, 0.0];
        for (y, x) in (rect.min[1]..rect.max[1]).flat_map(|y| (rect.min[0]..rect.max[0]).map(move |x| (y, x))) {
            let square = (f64::from(x) - disk.centre[0]).powi(2) + (f64::from(y) - disk.centre[1]).powi(2);
            found = [found[0].min(square), found[1].max(square)];
        }
        found
    }

    /// Circles of samples and of given ones, of any size, in and around a rectangle.
    fn random_disk(rng: &mut Rng, rect: &Rect) -> ExclusionDisk {
        let place =
            |axis: usize, rng: &mut Rng| rect.min[axis] - 50 + rng.below((rect.length(axis) + 100) as u64) as i32;
        let radius = 300f64.powf(rng.unit());
        let point = [place(0, rng), place(1, rng)];
        if rng.below(2) == 0 {
            return ExclusionDisk::around(point, (radius * radius).ceil() as i64);
        }
        ExclusionDisk::of_given(&Disk { centre: point.map(|x| f64::from(x) + rng.unit()), radius })
    }

    /// Rectangles of more cells than a word has bits, and of one.
    const RECTANGLES: [([i32; 2], f64); 4] = [([900, 60], 10.0), ([100, 130], 25.3), ([7, 300], 3.0), ([40, 30], 1e6)];

    #[test]
    fn cells_know_what_loops_over_their_points_know() {
        let mut rng = Rng::at(0, Draw::Probe, &[]);
        let (mut filling, mut covered) = (ClassFilling::default(), [0; 2]);
        for round in 0..40 {
            let (size, radius) = RECTANGLES[round % 4];
            let min = [0, 1].map(|_| rng.below(2000) as i32 - 1000);
            let rect = Rect { min, max: [min[0] + size[0], min[1] + size[1]] };
            filling.begin(&rect, 2, radius);
            let [width, height] = filling.counts();
            let disks: Vec<_> = (0..12).map(|_| (rng.below(2) as usize, random_disk(&mut rng, &rect))).collect();
            disks.iter().for_each(|(class, disk)| filling.exclude(*class, disk));
            let mut left = 0;
            for (index, slot) in filling.slots.iter().enumerate() {
                let (class, x, y) = (index / (width * height), index % width, index / width % height);
                let [columns, rows] = [&filling.edges[0][x..x + 2], &filling.edges[1][y..y + 2]];
                let cell = Rect { min: [columns[0], rows[0]], max: [columns[1], rows[1]] };
                let of_class = disks.iter().filter(|(of, _)| *of == class).map(|(_, disk)| disk);
                let is_covered = of_class.clone().any(|disk| squares(disk, &cell)[1] < disk.square);
                assert_eq!(slot.is_covered, is_covered);
                left += usize::from(!is_covered);
                covered[usize::from(is_covered)] += 1;
                if !is_covered {
                    // The nearest place may lie between lattice points only in disks around such places.
                    let meets = |disk: &&ExclusionDisk| squares(disk, &cell)[0] < disk.square;
                    let known = |disk: &ExclusionDisk| slot.disks.iter().any(|other| other.centre == disk.centre);
                    assert!(of_class.filter(meets).all(known));
                }
            }
            assert_eq!(filling.left, left);
        }
        assert!(covered.into_iter().all(|count| count > 1000), "{covered:?}");
    }

    /// Every lattice point of a filled filling, for each class.
    #[test]
    fn a_rectangle_is_filled_until_every_point_lies_in_a_disk() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let mut filling = ClassFilling::default();
        for round in 0..40 {
            let (size, radius) = RECTANGLES[round % 4];
            let rect = Rect { min: [-20, 3], max: [size[0] - 20, size[1] + 3] };
            filling.begin(&rect, 2, radius);
            let mut disks: Vec<_> = (0..6).map(|_| (rng.below(2) as usize, random_disk(&mut rng, &rect))).collect();
            disks.iter().for_each(|(class, disk)| filling.exclude(*class, disk));
            filling.open(2);
            // The classes keep half a radius from each other.
            let squares = [radius * radius, 0.25 * radius * radius].map(|square| square.ceil() as i64);
            while let Some((class, point)) = filling.next_sample(&mut rng) {
                let place = point.map(f64::from);
                assert!(rect.contains(point));
                assert!(!disks.iter().any(|(of, disk)| *of == class && disk.holds(place)));
                for other in 0..2 {
                    let disk = ExclusionDisk::around(point, squares[usize::from(other != class)]);
                    filling.exclude(other, &disk);
                    disks.push((other, disk));
                }
            }
            for [x, y] in (rect.min[1]..rect.max[1]).flat_map(|y| (rect.min[0]..rect.max[0]).map(move |x| [x, y])) {
                let holds = |class| disks.iter().any(|(of, disk)| *of == class && disk.holds([x, y].map(f64::from)));
                assert!(holds(0) && holds(1), "{x} {y} is left");
            }
        }
    }

    #[test]
    fn first_samples_are_even_over_classes_and_points() {
        let (mut rng, mut filling) = (Rng::at(2, Draw::Probe, &[]), ClassFilling::default());
        let mut histogram = [[0u32; 61]; 2];
        for _ in 0..61_000 {
            filling.begin(&Rect { min: [0; 2], max: [61, 9] }, 2, 30.0);
            filling.open(2);
            // Cut once or twice first: no point may be preferred at any level.
            (0..rng.below(3)).for_each(|_| filling.cut());
            filling.darts = usize::MAX;
            let (class, [x, _]) = filling.next_sample(&mut rng).unwrap();
            histogram[class][x as usize] += 1;
        }
        let chi2: f64 = histogram.iter().flatten().map(|&count| (f64::from(count) - 500.0).powi(2) / 500.0).sum();
        assert!((chi2 - 121.0).abs() < 5.0 * 242f64.sqrt(), "chi2 {chi2} of 121");
    }
}
