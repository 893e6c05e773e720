//! Blue-noise masks, by void and cluster (R. Ulichney, *The void-and-cluster method for dither array generation*, SPIE
//! 1913, 1993).
//!
//! A mask is a torus of pixels with a rank each, of which every one occurs once. The pixels below any rank are spread
//! evenly and without a pattern: their spectrum has hardly any power at low frequencies. So an image that is compared
//! with the mask pixel by pixel, the mask repeated like a tile, becomes a halftone (`dither.rs`), and renderers take from
//! it the random numbers of a pixel, so that the error of neighbours differs.
//!
//! A mask of several pixels in depth is one of space: its patterns are blue noise in all three axes together. Its slices
//! are *not* masks of the plane, and a sequence of them is no spatiotemporal mask.
//!
//! The method chooses pixels one after another, so that a channel is made by one thread; threads share the channels.
//! Energies are integers (`energy.rs`) and the extreme is found by a tree (`tournament.rs`).

mod dither;
mod energy;
mod ranking;
mod tournament;

use crate::check;
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::setters::setters;

use energy::Size;
use ranking::Ranking;

pub use dither::{Image, Pixels};

/// The bytes that a pixel of a channel takes while its rank is looked for.
const BYTES_PER_PIXEL: f64 = 15.5;

/// The most pixels of a plane along an axis, and of a mask of space.
const MOST: [usize; 2] = [1024, 64];

/// The most channels.
const MOST_CHANNELS: usize = 64;

/// The changes of a pattern between two reports of progress.
const CHANGES: usize = 4096;

/// Size, channels, and randomness of a mask.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The pixels along x: 2 to 1,024, and up to 64 if `depth` is above 1.
    pub width: usize,
    /// The pixels along y: 2 to 1,024, and up to 64 if `depth` is above 1.
    pub height: usize,
    /// The pixels along z: 1, a mask of the plane, or up to 64, one of space.
    pub depth: usize,
    /// The number of independent masks of this size: 1 to 64. A channel does not depend on how many there are.
    pub channels: usize,
    /// The seed of all random numbers.
    pub seed: u64,
    /// The standard deviation of the Gaussian by which voids and clusters are found, in pixels: 0.5 to 4. The paper
    /// advises 1.5.
    pub sigma: f64,
}

impl Options {
    /// A mask of the plane with one channel.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, depth: 1, channels: 1, seed: 0, sigma: 1.5 }
    }

    /// Refuses options out of range.
    fn check(&self) -> Result<()> {
        let most = MOST[usize::from(self.depth > 1)];
        check::range("depth", self.depth, 1..=MOST[1])?;
        check::range("width", self.width, 2..=most)?;
        check::range("height", self.height, 2..=most)?;
        check::range("channels", self.channels, 1..=MOST_CHANNELS)?;
        check::range("sigma", self.sigma, 0.5..=4.0)
    }
}

setters!(Options { width: usize, height: usize, depth: usize, channels: usize, seed: u64, sigma: f64 });

/// The ranks of a torus of pixels.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mask {
    /// The pixels along x, y and z; the last is 1 for a mask of the plane.
    pub size: [usize; 3],
    /// The number of channels.
    pub channels: usize,
    /// The ranks of the first channel, then those of the others. In a channel x grows first, then y, then z. Each rank
    /// from 0 to the number of pixels - 1 occurs once in a channel.
    pub ranks: Vec<u32>,
}

/// The work that a mask took.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The pixels of a channel.
    pub pixels: u64,
    /// The moves of pixels that made the random initial patterns even, in all channels.
    pub moves: u64,
}

impl Mask {
    /// The mask of ranks that were kept, in the order of [`ranks`](Self::ranks).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] (`ranks`) for none, for another number than that of the
    /// pixels of all channels, and for a rank that is not below the number of pixels of a channel.
    pub fn from_ranks(size: [usize; 3], channels: usize, ranks: Vec<u32>) -> Result<Self> {
        let [width, height, depth] = size;
        let numbers = size.into_iter().try_fold(channels, usize::checked_mul);
        if ranks.is_empty() || numbers != Some(ranks.len()) {
            let reason =
                format!("{} are not those of {width} x {height} x {depth} pixels in {channels} channels", ranks.len());
            return Err(Error::invalid("ranks", reason));
        }
        let mask = Self { size, channels, ranks };
        match mask.ranks.iter().position(|&rank| rank as usize >= mask.pixels()) {
            Some(i) => {
                Err(Error::invalid("ranks", format!("[{i}] is {}, not below {} pixels", mask.ranks[i], mask.pixels())))
            }
            None => Ok(mask),
        }
    }

    /// The pixels of a channel.
    pub fn pixels(&self) -> usize {
        self.size.iter().product()
    }

    /// The ranks of a channel.
    ///
    /// # Panics
    /// If there is no such channel.
    pub fn channel(&self, channel: usize) -> &[u32] {
        &self.ranks[channel * self.pixels()..][..self.pixels()]
    }

    /// All ranks as numbers in (0, 1), in the same order: (rank + 0.5) / pixels, rounded to a float. They are uniform.
    pub fn values(&self) -> Vec<f32> {
        let pixels = self.pixels() as f32;
        self.ranks.iter().map(|&rank| (rank as f32 + 0.5) / pixels).collect()
    }

    /// The value of a place of the plane, or of space, over which the mask is repeated: that of a pixel in
    /// [`values`](Self::values).
    ///
    /// # Panics
    /// If there is no such channel.
    pub fn threshold(&self, channel: usize, place: [usize; 3]) -> f32 {
        let [x, y, z]: Size = std::array::from_fn(|axis| place[axis] % self.size[axis]);
        let rank = self.channel(channel)[(z * self.size[1] + y) * self.size[0] + x];
        (rank as f32 + 0.5) / self.pixels() as f32
    }
}

/// A blue-noise mask by void and cluster.
///
/// The same options give the same ranks, for every number of threads and on every processor. Threads share the channels;
/// one channel is made by one thread.
///
/// O(n (s + log n)) time for each channel of n pixels, where s is the number of pixels within about six `sigma` of one:
/// some 400 in the plane and 6,000 in space. 16 bytes of memory per pixel and channel.
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range;
/// [`Error::TooLarge`] beyond the available memory (`channels`);
/// [`Error::Cancelled`].
///
/// ```
/// use azulejo::{Context, mask};
///
/// let options = mask::Options::new(32, 32).seed(1);
/// let (mask, _) = mask::create(&Context::new(0)?, &options, None)?;
/// let mut ranks = mask.channel(0).to_vec();
/// ranks.sort_unstable();
/// assert!(ranks.into_iter().eq(0..1024));
/// # Ok::<(), azulejo::Error>(())
/// ```
pub fn create(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<(Mask, Report)> {
    options.check()?;
    let (size, channels) = ([options.width, options.height, options.depth], options.channels);
    let pixels: usize = size.iter().product();
    let what = format!("{channels} masks of {pixels} pixels");
    memory::require((pixels * channels) as f64 * BYTES_PER_PIXEL, "channels", &what)?;
    context.run(progress, |job| {
        let mut ranks = vec![0; pixels * channels];
        let moves = rank(job, options, size, &mut ranks)?;
        Ok((Mask { size, channels, ranks }, Report { pixels: pixels as u64, moves }))
    })
}

/// Writes the ranks of all channels, and returns the moves of their initial patterns.
fn rank(job: &Job, options: &Options, size: Size, ranks: &mut [u32]) -> Result<u64> {
    let pixels = size.iter().product();
    let channels: Vec<_> = ranks.chunks_exact_mut(pixels).enumerate().collect();
    let start = |(channel, ranks)| Ranking::new(size, options.sigma, options.seed, channel as u64, ranks);
    let mut rankings = job.part(0.0, 0.0).map_each(channels, start)?;
    // The channels go on side by side, so that the caller hears of them between.
    loop {
        let done = rankings.iter().map(Ranking::share).fold(1.0, f64::min);
        let now = job.part(done, done);
        now.report(0.0)?;
        let ended = now.map_each(rankings.iter_mut().collect(), |ranking| ranking.advance(CHANGES))?;
        if ended.into_iter().all(|ended| ended) {
            return Ok(rankings.iter().map(Ranking::moves).sum());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(options: &Options) -> Mask {
        create(&Context::new(1).unwrap(), options, None).unwrap().0
    }

    #[test]
    fn kept_ranks_make_the_same_mask() {
        let mask = made(&Options::new(6, 5).channels(2));
        assert_eq!(Mask::from_ranks(mask.size, 2, mask.ranks.clone()).unwrap(), mask);
        let refused =
            |size, channels, ranks: &[u32]| Mask::from_ranks(size, channels, ranks.to_vec()).unwrap_err().to_string();
        assert!(refused(mask.size, 1, &mask.ranks).starts_with("ranks: 60 are not those of 6 x 5 x 1 pixels in 1 "));
        assert!(refused([usize::MAX; 3], 2, &mask.ranks).starts_with("ranks: 60 are not"));
        assert!(refused([0; 3], 1, &[]).starts_with("ranks: 0 are not"));
        assert_eq!(refused([2, 1, 1], 1, &[1, 2]), "ranks: [1] is 2, not below 2 pixels");
    }

    #[test]
    fn channels_are_masks_of_their_own() {
        let options = Options::new(20, 14).seed(5);
        let [three, one] = [3, 1].map(|channels| made(&options.channels(channels)));
        assert_eq!(three.channel(0), one.channel(0));
        assert!(three.channel(1) != one.channel(0) && three.channel(2) != three.channel(1));
        assert_ne!(made(&options.seed(6)), one);
        for channel in 0..3 {
            let mut ranks = three.channel(channel).to_vec();
            ranks.sort_unstable();
            assert!(ranks.into_iter().eq(0..280));
        }
    }

    #[test]
    fn values_are_ranks_in_the_open_unit_interval() {
        let mask = made(&Options::new(3, 5).depth(2).channels(2));
        let values = mask.values();
        assert!(values.iter().zip(&mask.ranks).all(|(&value, &rank)| value == ((f64::from(rank) + 0.5) / 30.0) as f32));
        assert_eq!(mask.threshold(1, [3 + 2, 4, 2 * 7 + 1]), values[30 + 15 + 4 * 3 + 2]);
        let largest = Mask { size: [1024, 1024, 1], channels: 1, ranks: vec![(1 << 20) - 1; 1 << 20] };
        assert!(largest.threshold(0, [0; 3]) < 1.0);
    }
}
