//! Algorithms 3 and 4 (thesis §2.3.3): conflicts are eliminated, and the circumcentres of samples inserted that lie in
//! gaps.
//!
//! Left open by the thesis, and done so here: samples are visited tile by tile; the conflict area is the margin of a
//! tile and what lies within 2r of the border of its block; the test buffer of line 16 is that around p; a sample that is
//! a gap detector once remains one.

use super::grid::Grid;
use super::tiles::Laid;

/// A set, and how it came about.
pub struct Conquered {
    /// First those of the tiles, then `inserted` new ones.
    pub samples: Vec<[f32; 2]>,
    pub inserted: usize,
    pub eliminated: usize,
    /// Samples in the conflict area.
    pub processed: usize,
    /// Iterations of the second loop, the last of which inserts nothing.
    pub iterations: usize,
}

/// Algorithm 4.
pub fn eliminate_and_insert(tiles: &[Vec<Laid>], radius: f64) -> Conquered {
    let mut grid = Grid::new(radius);
    let mut conflict_area = Vec::new();
    for laid in tiles.iter().flatten() {
        let index = grid.insert(laid.place);
        if laid.depth < 2.0 * radius {
            conflict_area.push(index);
        }
    }
    let tiled = grid.len();
    let mut is_detector = vec![false; tiled];
    for &pivot in &conflict_area {
        if !grid.is_valid(pivot) {
            continue;
        }
        is_detector[pivot] = true;
        let conflicts: Vec<_> = grid.near(grid.place(pivot), 1).map(|(index, _)| index).collect();
        for conflict in conflicts.into_iter().filter(|&index| index != pivot) {
            grid.eliminate(conflict);
            let buffer: Vec<_> = grid.near(grid.place(conflict), 2).map(|(index, _)| index).collect();
            buffer.iter().for_each(|&index| is_detector[index] = true);
            detect_and_insert(&mut grid, &buffer, pivot, radius);
            is_detector.resize(grid.len(), true);
        }
    }
    let mut iterations = 0;
    loop {
        let before = grid.len();
        let detectors: Vec<_> = (0..before).filter(|&index| grid.is_valid(index) && is_detector[index]).collect();
        for detector in detectors {
            let buffer: Vec<_> = grid.near(grid.place(detector), 4).map(|(index, _)| index).collect();
            detect_and_insert(&mut grid, &buffer, detector, radius);
        }
        is_detector.resize(grid.len(), true);
        iterations += 1;
        if grid.len() == before {
            break;
        }
    }
    let valid = |indices: std::ops::Range<usize>| indices.filter(|&index| grid.is_valid(index)).map(|i| grid.place(i));
    let mut samples: Vec<_> = valid(0..tiled).collect();
    let eliminated = tiled - samples.len();
    samples.extend(valid(tiled..grid.len()));
    let inserted = samples.len() + eliminated - tiled;
    Conquered { samples, inserted, eliminated, processed: conflict_area.len(), iterations }
}

/// Algorithm 3: the circumcentre of `pivot` and every two samples of the buffer is inserted if it lies in a gap.
fn detect_and_insert(grid: &mut Grid, buffer: &[usize], pivot: usize, radius: f64) {
    let place = grid.place(pivot);
    let offsets: Vec<_> = buffer
        .iter()
        .filter(|&&index| index != pivot)
        .map(|&index| super::grid::offset(place, grid.place(index)))
        .collect();
    for (i, &m) in offsets.iter().enumerate() {
        for &n in &offsets[..i] {
            let Some([x, y]) = circumcentre(m, n) else { continue };
            // Nearer it is covered by the pivot; farther it is none of a gap that the buffer shows.
            if !(radius * radius..16.0 * radius * radius).contains(&(x * x + y * y)) {
                continue;
            }
            // Most are well covered by a sample of the buffer: seen without the grid.
            let is_covered = |&[mx, my]: &[f64; 2]| (mx - x) * (mx - x) + (my - y) * (my - y) < 0.999 * radius * radius;
            if offsets.iter().any(is_covered) {
                continue;
            }
            let centre = [f64::from(place[0]) + x, f64::from(place[1]) + y].map(|x| x.rem_euclid(1.0) as f32);
            let centre = centre.map(|x| if x < 1.0 { x } else { 0.0 });
            if grid.is_gap(centre) {
                grid.insert(centre);
            }
        }
    }
}

/// The centre of the circle through the origin and two other places.
fn circumcentre([mx, my]: [f64; 2], [nx, ny]: [f64; 2]) -> Option<[f64; 2]> {
    let double = 2.0 * (mx * ny - my * nx);
    let [m, n] = [mx * mx + my * my, nx * nx + ny * ny];
    (double != 0.0).then(|| [(ny * m - my * n) / double, (mx * n - nx * m) / double])
}

#[cfg(test)]
mod tests {
    use azulejo::analysis::coverage::covering_radius_2d;
    use azulejo::analysis::spacing::smallest_distance_2d;
    use azulejo::{Boundary, Context, Domain};

    use super::super::divide::building_blocks;
    use super::super::tiles::Pattern;
    use super::*;

    #[test]
    fn a_circumcentre_is_as_far_from_all_three() {
        let [x, y] = circumcentre([2.0, 0.0], [0.5, 3.0]).unwrap();
        let to = |place: [f64; 2]| (place[0] - x).hypot(place[1] - y);
        assert!((to([0.0; 2]) - to([2.0, 0.0])).abs() < 1e-12 && (to([0.0; 2]) - to([0.5, 3.0])).abs() < 1e-12);
        assert_eq!(circumcentre([1.0, 1.0], [2.0, 2.0]), None);
    }

    #[test]
    fn the_thesis_makes_maximal_sets() {
        let (context, radius, torus) = (Context::new(1).unwrap(), 0.02, Domain::unit(Boundary::Periodic));
        for seed in 0..3 {
            let pattern = Pattern::new(&context, radius, 25.0, seed).unwrap();
            let tiles = pattern.lay(&building_blocks(6.0 * radius, seed), radius, seed);
            let all = tiles.iter().map(Vec::len).sum::<usize>();
            let made = eliminate_and_insert(&tiles, radius);
            assert!(smallest_distance_2d(&context, &torus, &made.samples, None).unwrap() >= radius);
            // Circumcentres are rounded to floats: what they leave is as small.
            let covering = covering_radius_2d(&context, &torus, &made.samples, None).unwrap();
            assert!(covering < radius * (1.0 + 1e-4), "{}", covering / radius);
            assert_eq!(made.samples.len(), all - made.eliminated + made.inserted);
            assert!(made.iterations > 1 && made.inserted > 0 && made.processed > made.eliminated);
        }
    }
}
