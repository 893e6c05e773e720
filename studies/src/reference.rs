//! Samplers that others are compared with: random, jittered and Halton points of the unit square.

/// A stream of random numbers in [0, 1), multiples of 2^-24: SplitMix64 (Steele, Lea and Flood 2014).
pub fn stream(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    }
}

/// Independent uniform points: white noise.
pub fn random(count: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut unit = stream(seed);
    (0..count).map(|_| [unit(), unit()]).collect()
}

/// A random point in each of `side` by `side` equal cells (Cook 1986, "Stochastic sampling in computer graphics").
pub fn jittered(side: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut unit = stream(seed);
    let mut place = |cell: usize| ((cell as f64 + f64::from(unit())) / side as f64) as f32;
    // A sum that rounds to 1 belongs to the other side of the torus.
    let mut point = |i: usize| [place(i % side), place(i / side)].map(|x| if x < 1.0 { x } else { 0.0 });
    (0..side * side).map(&mut point).collect()
}

/// The part of Halton's sequence of the bases 2 and 3 that begins at `first` (Halton 1960, "On the efficiency of certain
/// quasi-random sequences of points in evaluating multi-dimensional integrals").
pub fn halton(first: u64, count: usize) -> Vec<[f32; 2]> {
    (first..).take(count).map(|index| [2, 3].map(|base| radical_inverse(base, index))).collect()
}

/// The digits of a number mirrored at the point, as a float below 1.
fn radical_inverse(base: u64, mut index: u64) -> f32 {
    let (mut inverse, mut weight) = (0.0, 1.0 / base as f64);
    while index > 0 {
        inverse += (index % base) as f64 * weight;
        weight /= base as f64;
        index /= base;
    }
    (inverse as f32).min(1.0f32.next_down())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halton_points_are_those_of_the_definition() {
        let expected = [[0.0, 0.0], [1.0 / 2.0, 1.0 / 3.0], [1.0 / 4.0, 2.0 / 3.0], [3.0 / 4.0, 1.0 / 9.0]];
        assert_eq!(halton(0, 4), expected);
        assert_eq!(halton(2, 2), expected[2..]);
        assert!(radical_inverse(2, u64::MAX) < 1.0);
    }

    #[test]
    fn each_cell_of_a_jittered_set_has_its_point() {
        for (i, [x, y]) in jittered(20, 3).into_iter().enumerate() {
            assert_eq!([(x * 20.0) as usize, (y * 20.0) as usize], [i % 20, i / 20]);
        }
        assert_ne!(jittered(20, 3), jittered(20, 4));
    }

    #[test]
    fn random_points_fill_the_square_evenly() {
        let points = random(16_000, 5);
        let mut cells = [0; 16];
        points.iter().for_each(|[x, y]| cells[(x * 4.0) as usize + 4 * (y * 4.0) as usize] += 1);
        let chi2: f64 = cells.iter().map(|&n| (f64::from(n) - 1000.0).powi(2) / 1000.0).sum();
        assert!(chi2 < 45.0, "chi2 of 15 degrees of freedom: {chi2}");
        assert!(points == random(16_000, 5) && points != random(16_000, 6));
    }
}
