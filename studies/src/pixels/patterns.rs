//! Samples of the pixels of an image.

use azulejo::dcr::{Neighbourhood, Options, relax};
use azulejo::kdrt::DEFAULT_LEAF_SIZE;
use azulejo::{Boundary, Context, Domain, Result};

use crate::dcr::sets::Start;
use crate::kdrt::Sampler;
use crate::reference::{jittered, random, stream};

/// A sampler of pixels.
#[derive(Clone, Copy, PartialEq)]
pub enum Pattern {
    Random,
    /// One sample in each of as many cells of the pixel.
    Stratified,
    /// Sobol's (0,2)-sequence, scrambled as by Owen in each pixel.
    Sobol,
    /// One KDRT set of the unit torus, moved along it at random in each pixel; the same relaxed.
    Tile,
    RelaxedTile,
    /// One KDRT set over the image, of so many samples in a pixel on average; the same relaxed.
    Image,
    RelaxedImage,
}

pub const PATTERNS: [Pattern; 7] = [
    Pattern::Random,
    Pattern::Stratified,
    Pattern::Sobol,
    Pattern::Tile,
    Pattern::RelaxedTile,
    Pattern::Image,
    Pattern::RelaxedImage,
];

impl Pattern {
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Stratified => "stratified",
            Self::Sobol => "Sobol, Owen-scrambled",
            Self::Tile => "KDRT tile",
            Self::RelaxedTile => "DCR tile",
            Self::Image => "KDRT image",
            Self::RelaxedImage => "DCR image",
        }
    }

    /// The samples of each pixel of a square image, from its lower left corner on.
    pub fn sample(self, context: &Context, side: usize, count: usize, seed: u64) -> Result<Vec<Vec<[f64; 2]>>> {
        let pixels = (side * side) as u64;
        let each = |samples: &dyn Fn(u64) -> Vec<[f64; 2]>| (seed * pixels..(seed + 1) * pixels).map(samples).collect();
        let exact = |samples: Vec<[f32; 2]>| samples.into_iter().map(|sample| sample.map(f64::from)).collect();
        let torus = Domain::unit(Boundary::Periodic);
        Ok(match self {
            Self::Random => each(&|seed| exact(random(count, seed))),
            Self::Stratified => each(&|seed| exact(jittered(count.isqrt(), seed))),
            Self::Sobol => each(&|seed| sobol(count, seed)),
            Self::Tile => moved(&Start::Kdrt.points(context, torus, count, seed)?, side, seed),
            Self::RelaxedTile => moved(&relaxed(context, &random(count, seed), seed)?, side, seed),
            Self::Image => in_pixels(&image(context, side, count, seed)?, side),
            Self::RelaxedImage => in_pixels(&relaxed(context, &image(context, side, count, seed)?, seed)?, side),
        })
    }
}

/// A KDRT set of the unit torus with about so many samples for each pixel.
fn image(context: &Context, side: usize, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
    Sampler::Leaves(DEFAULT_LEAF_SIZE).sample(context, (side * side * count) as f64, seed)
}

/// Points of the unit torus after DCR with its defaults.
fn relaxed(context: &Context, points: &[[f32; 2]], seed: u64) -> Result<Vec<[f32; 2]>> {
    let options = Options::new(Domain::unit(Boundary::Periodic), Neighbourhood::Delaunay).seed(seed);
    Ok(relax(context, &options, points, None)?.0)
}

/// A set of the unit torus for each pixel, moved at random.
fn moved(tile: &[[f32; 2]], side: usize, seed: u64) -> Vec<Vec<[f64; 2]>> {
    let mut unit = stream(seed);
    let mut pixel = |_| {
        let shift = [unit(), unit()].map(f64::from);
        tile.iter().map(|sample| [0, 1].map(|axis: usize| (f64::from(sample[axis]) + shift[axis]).fract())).collect()
    };
    (0..side * side).map(&mut pixel).collect()
}

/// The samples of an image by pixels. A pixel without any takes the one that is nearest to its middle.
fn in_pixels(image: &[[f32; 2]], side: usize) -> Vec<Vec<[f64; 2]>> {
    let length = side as f64;
    let place = |sample: &[f32; 2]| sample.map(|x| f64::from(x) * length);
    let mut pixels = vec![Vec::new(); side * side];
    for [x, y] in image.iter().map(place) {
        pixels[x as usize + side * y as usize].push([x.fract(), y.fract()]);
    }
    for (number, pixel) in pixels.iter_mut().enumerate().filter(|(_, pixel)| pixel.is_empty()) {
        let middle = [number % side, number / side].map(|i| i as f64 + 0.5);
        // From the middle, the short way along the torus.
        let from = |sample| {
            [0, 1].map(|axis: usize| (place(sample)[axis] - middle[axis] + 1.5 * length) % length - length / 2.0)
        };
        let nearest = image.iter().map(from).min_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        pixel.extend(nearest.map(|offset| offset.map(|x| x + 0.5)));
    }
    pixels
}

/// The first points of the (0,2)-sequence of Sobol, with an Owen scrambling of each coordinate by hashes (Burley 2020,
/// "Practical hash-based Owen scrambling"; the second coordinate as by Kollig and Keller 2002).
fn sobol(count: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut unit = stream(seed);
    let seeds = [0; 2].map(|_: u32| ((unit() * 65_536.0) as u32) << 16 | (unit() * 65_536.0) as u32);
    let point = |index: u32| {
        let (mut second, mut column, mut left) = (0u32, 1u32 << 31, index);
        while left != 0 {
            second ^= column * (left & 1);
            column ^= column >> 1;
            left >>= 1;
        }
        let digits = [index.reverse_bits(), second];
        [0, 1].map(|axis: usize| f64::from(scrambled(digits[axis], seeds[axis])) * 0.5f64.powi(32))
    };
    (0..count as u32).map(point).collect()
}

/// A number each bit of which is inverted or not, as the bits above it and the seed decide.
fn scrambled(digits: u32, seed: u32) -> u32 {
    let factors = [0x6c50_b47cu32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6];
    let mix = |mixed: u32, factor: u32| mixed ^ mixed.wrapping_mul(factor);
    factors.into_iter().fold(digits.reverse_bits().wrapping_add(seed), mix).reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scrambled_points_are_one_in_each_elementary_interval() {
        for (seed, log) in [(1, 2), (2, 4), (3, 6), (4, 8)] {
            let points = sobol(1 << log, seed);
            for wide in 0..=log {
                let mut cells = vec![0; 1 << log];
                for &[x, y] in &points {
                    let (column, row) = (x * f64::from(1 << wide), y * f64::from(1 << (log - wide)));
                    cells[column as usize + (row as usize) * (1 << wide)] += 1;
                }
                assert!(cells.iter().all(|&points| points == 1), "{wide} of {log}: {cells:?}");
            }
            assert_ne!(points, sobol(1 << log, seed + 10));
        }
    }

    #[test]
    fn every_pattern_has_its_samples_in_every_pixel_and_covers_it_evenly() {
        let context = Context::new(1).unwrap();
        for pattern in PATTERNS {
            let pixels = pattern.sample(&context, 16, 16, 7).unwrap();
            let samples: Vec<_> = pixels.iter().flatten().collect();
            let is_exact = !matches!(pattern, Pattern::Image | Pattern::RelaxedImage);
            assert!(pixels.len() == 256 && (!is_exact || pixels.iter().all(|pixel| pixel.len() == 16)));
            assert!(samples.len().abs_diff(4096) < 100, "{}: {}", pattern.name(), samples.len());
            for axis in 0..2 {
                let mean = samples.iter().map(|sample| sample[axis]).sum::<f64>() / samples.len() as f64;
                // Of random samples the error is 0.0045.
                assert!((mean - 0.5).abs() < 0.02, "{}: {mean}", pattern.name());
            }
        }
    }

    #[test]
    fn an_empty_pixel_takes_the_nearest_sample() {
        let pixels = in_pixels(&[[0.1, 0.1], [0.9, 0.4]], 2);
        assert_eq!(pixels[0].len(), 1);
        // Below one of the upper pixels, and around the torus above the other.
        let near = |found: &[[f64; 2]], expected: [f64; 2]| {
            assert!(
                found.len() == 1 && (found[0][0] - expected[0]).hypot(found[0][1] - expected[1]) < 1e-6,
                "{found:?}"
            );
        };
        near(&pixels[3], [0.8, -0.2]);
        near(&pixels[2], [0.2, 1.2]);
    }
}
