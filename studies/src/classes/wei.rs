//! Multi-class dart throwing after Wei 2010, "Multi-class blue noise sampling", §4: what the library's sets are
//! compared with. Written from the paper's description, on the unit torus and on one thread.
//!
//! Each dart is of the class that has the smallest share of the samples that it should have. A dart that conflicts may
//! take the place of the samples in its way, if its class could not be served otherwise for long, and all of them are
//! of classes of smaller own radii. Wei also asks that these have no smaller share; none has, as the dart's class has
//! the smallest. It ends after a number of darts, so its sets are not maximal.

use azulejo::Classes;

use super::mixes::density;

/// Darts that fail in a row before a dart may take the place of others, per sample that the class has.
const PATIENCE: f64 = 10.0;

/// Darts for each sample that there would be if all classes had theirs alone.
const DARTS: f64 = 100.0;

/// The samples of each class.
pub fn sample(classes: &Classes, seed: u64) -> Vec<Vec<[f32; 2]>> {
    let count = classes.count();
    let mut grids: Vec<Grid> = (0..count).map(|class| Grid::new(widest(classes, class))).collect();
    // The wanted share of each class, up to a common factor: its number of samples when it is alone.
    let wanted: Vec<f64> = (0..count).map(|class| density(classes.own(class))).collect();
    let mut failed = vec![0.0; count];
    let mut random = Random(seed);
    for _ in 0..(DARTS * wanted.iter().sum::<f64>()) as u64 {
        let rate = |class: usize| grids[class].count as f64 / wanted[class];
        let class = (0..count).min_by(|&a, &b| rate(a).total_cmp(&rate(b))).unwrap_or(0);
        let dart = [random.unit(), random.unit()];
        let is_patient = failed[class] < PATIENCE * (1 + grids[class].count) as f64;
        let conflicts = (0..count)
            .flat_map(|other| grids[other].within(dart, classes.radius(class, other)).map(move |place| (other, place)));
        // A single one is enough where no dart may take its place.
        let conflicts: Vec<(usize, Place)> = conflicts.take(if is_patient { 1 } else { usize::MAX }).collect();
        let yields = |other: usize| classes.own(other) < classes.own(class);
        if !conflicts.is_empty() && (is_patient || !conflicts.iter().all(|&(other, _)| yields(other))) {
            failed[class] += 1.0;
            continue;
        }
        // From the last place of a cell to the first, as taking one out moves the last.
        conflicts.iter().rev().for_each(|&(other, place)| grids[other].remove(place));
        grids[class].insert(dart);
        failed[class] = 0.0;
    }
    grids.into_iter().map(|grid| grid.cells.concat()).collect()
}

/// The largest distance that a sample of a class keeps from others.
fn widest(classes: &Classes, class: usize) -> f64 {
    (0..classes.count()).map(|other| classes.radius(class, other)).fold(0.0, f64::max)
}

/// A sample: its cell, and its place there.
type Place = (usize, usize);

/// The samples of a class, in cells no narrower than any distance that is asked for.
struct Grid {
    side: usize,
    cells: Vec<Vec<[f32; 2]>>,
    count: usize,
}

impl Grid {
    fn new(reach: f64) -> Self {
        let side = (1.0 / reach) as usize;
        // With fewer than three cells a side the neighbours on both sides would be the same.
        let side = if side < 3 { 1 } else { side };
        Self { side, cells: vec![Vec::new(); side * side], count: 0 }
    }

    fn place(&self, point: [f32; 2]) -> [usize; 2] {
        point.map(|x| ((f64::from(x) * self.side as f64) as usize).min(self.side - 1))
    }

    /// The samples that are nearer than `distance`, by cell and place.
    fn within(&self, point: [f32; 2], distance: f64) -> impl Iterator<Item = Place> {
        let [column, row] = self.place(point);
        let side = self.side;
        let steps = if side == 1 { 0..1 } else { side - 1..side + 2 };
        let cells =
            steps.clone().flat_map(move |i| steps.clone().map(move |j| ((row + i) % side, (column + j) % side)));
        cells.map(move |(row, column)| row * side + column).flat_map(move |cell| {
            let near = move |sample: &[f32; 2]| square(point, *sample) < distance * distance;
            let samples = self.cells[cell].iter().enumerate();
            samples.filter(move |(_, sample)| near(sample)).map(move |(place, _)| (cell, place))
        })
    }

    fn insert(&mut self, point: [f32; 2]) {
        let [column, row] = self.place(point);
        self.cells[row * self.side + column].push(point);
        self.count += 1;
    }

    fn remove(&mut self, (cell, place): Place) {
        self.cells[cell].swap_remove(place);
        self.count -= 1;
    }
}

/// The squared distance of two places on the torus.
fn square(a: [f32; 2], b: [f32; 2]) -> f64 {
    let along = |axis: usize| {
        let offset = (f64::from(a[axis]) - f64::from(b[axis])).abs();
        offset.min(1.0 - offset)
    };
    along(0).powi(2) + along(1).powi(2)
}

/// Random numbers (SplitMix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    /// From 0 to below 1.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_samples_are_nearer_than_the_distance_of_their_classes() {
        for own in [&[0.05, 0.05][..], &[0.1, 0.05, 0.025], &[0.4]] {
            let classes = Classes::of_radii(own, 1.0).unwrap();
            let samples = sample(&classes, 3);
            let all: Vec<_> =
                (0..).zip(&samples).flat_map(|(class, set)| set.iter().map(move |p| (class, *p))).collect();
            for (i, &(a, p)) in all.iter().enumerate() {
                for &(b, q) in &all[..i] {
                    assert!(square(p, q) >= classes.radius(a, b).powi(2), "{own:?}: {p:?} {q:?}");
                }
            }
            assert!(samples.iter().all(|set| !set.is_empty()), "{own:?}");
        }
    }

    #[test]
    fn classes_have_equal_shares_of_what_they_should_have() {
        let classes = Classes::of_radii(&[0.08, 0.04, 0.02], 1.0).unwrap();
        let shares: Vec<_> = sample(&classes, 1)
            .iter()
            .zip(0..)
            .map(|(set, class)| set.len() as f64 * classes.own(class).powi(2))
            .collect();
        assert!(shares.iter().all(|share| (0.3..0.7).contains(share)), "{shares:?}");
    }
}
