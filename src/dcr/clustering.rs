//! Clustered sets: far denser in some places than wanted, and sparser in others.
//!
//! On meshes and where the density varies, no Fourier transform can level a cluster (`torus/waves.rs`). There clustered
//! sets are redistributed: random points that have the density wanted are thrown, and both are sorted along a Z-curve.
//! The point of each rank goes to the random point of that rank. So points that were near each other mostly stay so.
//! The same points distinguish clustered sets from others, in the cells of the quadtree or octree that the curve passes
//! through.

/// A set is clustered if points and random points in a cell differ in number by more than this times the square root of
/// the latter. If `n` points belong in a square of `√n` spacings, its points have to move by four spacings to get
/// there. Random sets differ by 1.4 times the root, root mean square.
pub const EXCESS: f64 = 16.0;

/// The number also differs by more than this fraction: large sets may vary a little in density.
const LEAST: f64 = 0.25;

/// The least number of random points assumed in a cell.
const FEWEST: usize = 16;

/// True if points are clustered in a cell or in a part of it. Given are their sorted places along the curve and those
/// of the random points; in this cell they differ only in the lowest `bits`, which are those of `AXES` coordinates.
/// `excess` is [`EXCESS`] or another factor of the square root.
pub fn is_clustered<const AXES: u32>(points: &[u64], random: &[u64], bits: u32, excess: f64) -> bool {
    let difference = points.len().abs_diff(random.len()) as f64;
    let expected = random.len().max(FEWEST) as f64;
    if difference > (excess * expected.sqrt()).max(LEAST * expected) {
        return true;
    }
    if bits == 0 || points.len().max(random.len()) as f64 <= excess * (FEWEST as f64).sqrt() {
        return false;
    }
    let bits = bits - AXES;
    let (mut points, mut random) = (points, random);
    (1..=1 << AXES).any(|end| {
        let is_before = |&place: &u64| place >> bits & ((1 << AXES) - 1) < end;
        let (own, others) = points.split_at(points.partition_point(is_before));
        let (wanted, rest) = random.split_at(random.partition_point(is_before));
        (points, random) = (others, rest);
        is_clustered::<AXES>(own, wanted, bits, excess)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};

    const BITS: u32 = 40;

    /// Sorted random places, those below `share` of the curve `density` times as dense as the rest.
    fn places(count: usize, seed: u64, share: f64, density: f64) -> Vec<u64> {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        let lower = share * density / (share * density + 1.0 - share);
        let mut place = || match rng.unit() < lower {
            true => rng.unit() * share,
            false => share + rng.unit() * (1.0 - share),
        };
        let mut places: Vec<u64> = (0..count).map(|_| (place() * (1u64 << BITS) as f64) as u64).collect();
        places.sort_unstable();
        places
    }

    #[test]
    fn clusters_are_told_from_random_sets() {
        for count in [0, 1, 10, 100, 1000, 10_000, 100_000] {
            for seed in 0..20 {
                let [points, random] = [0, 1].map(|k| places(count, 2 * seed + k, 0.5, 1.0));
                assert!(!is_clustered::<2>(&points, &random, BITS, EXCESS), "{count} {seed}");
            }
        }
        let random = places(10_000, 1, 0.5, 1.0);
        let differ = |share, density| {
            let points = places(10_000, 2, share, density);
            let is = is_clustered::<2>(&points, &random, BITS, EXCESS);
            // The mirror image along the curve is as clustered.
            let turned = |all: &[u64]| all.iter().rev().map(|place| (1 << BITS) - 1 - place).collect::<Vec<_>>();
            assert_eq!(is_clustered::<2>(&turned(&points), &turned(&random), BITS, EXCESS), is);
            is
        };
        for (share, density) in [(1e-9, 1e12), (1e-3, 20.0), (0.1, 5.0), (0.25, 0.1), (0.5, 3.0)] {
            assert!(differ(share, density), "{share} {density}");
        }
        for (share, density) in [(1e-3, 3.0), (0.5, 1.1)] {
            assert!(!differ(share, density), "{share} {density}");
        }
    }
}
