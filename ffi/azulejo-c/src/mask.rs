//! Blue-noise masks: ranks of the pixels of a tile, for halftones and for random numbers of pixels.

use std::ffi::c_void;
use std::time::Instant;

use azulejo_core::mask::{Image, Mask, Options, Pixels, create};

use crate::boundary::{Out, array, call, check_pointer, check_size, rows, write};
use crate::context::azulejo_context;
use crate::growing::{self, Growing, Output, growing};
use crate::handles::{self, handle};
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_mask_create.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_mask_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The number of independent masks, 1 to 64; default 1.
    pub channels: u32,
    /// The pixels along x, 2 to 1024, or to 64 if depth is above 1; has no default.
    pub width: usize,
    /// The pixels along y, 2 to 1024, or to 64 if depth is above 1; has no default.
    pub height: usize,
    /// The pixels along z, 1 to 64; default 1: a mask of the plane.
    pub depth: usize,
    /// Another seed gives another mask; default 0.
    pub seed: u64,
    /// The standard deviation of the filter in pixels, 0.5 to 4; default 1.5.
    pub sigma: f64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_mask_options requires sigma {
    channels: 1,
    width: 0,
    height: 0,
    depth: 1,
    seed: 0,
    sigma: 1.5,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_options_init(
    options: *mut azulejo_mask_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// The report of azulejo_mask_create.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_mask_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The pixels of a channel.
    pub pixels: u64,
    /// The moves that made the random initial patterns of all channels even.
    pub moves: u64,
    /// Wall time in seconds.
    pub seconds: f64,
}

growing!(azulejo_mask_report requires pixels { reserved: 0, pixels: 0, moves: 0, seconds: 0.0 });

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_report_init(
    report: *mut azulejo_mask_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

impl azulejo_mask_options {
    fn request(&self) -> Options {
        Options::new(self.width, self.height)
            .depth(self.depth)
            .channels(self.channels as usize)
            .seed(self.seed)
            .sigma(self.sigma)
    }
}

/// A blue-noise mask: a torus in each channel of which every pixel has a rank of its own.
pub struct azulejo_mask {
    mask: Mask,
}

handle!(azulejo_mask);

/// Makes a blue-noise mask by void and cluster (Ulichney 1993). The pixels whose ranks are below
/// any number are spread evenly over the torus and without a pattern. A mask of space has this in
/// all three axes together, not in slices.
///
/// O(pixels * (s + log(pixels))) time for each channel, s being the pixels within six sigma of one,
/// about 400 in the plane and 6,000 in space; 16 bytes per pixel and channel, which threads share.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_create(
    context: *const azulejo_context,
    options: *const azulejo_mask_options,
    out: *mut *mut azulejo_mask,
    report: *mut azulejo_mask_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, output) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let start = Instant::now();
        let watch = Watch::new(options.progress, options.progress_user);
        let (mask, report) = context.run(watch, |context, progress| create(context, &options.request(), progress))?;
        if let Some(output) = output {
            output.write(azulejo_mask_report {
                pixels: report.pixels,
                moves: report.moves,
                seconds: start.elapsed().as_secs_f64(),
                ..azulejo_mask_report::DEFAULT
            });
        }
        Ok(azulejo_mask { mask })
    })
}

/// The pixels along the axis 0, 1 or 2: the width, height or depth. 0 for other axes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_size(mask: *const azulejo_mask, axis: u32) -> usize {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mask", mask) }.and_then(|mask| mask.mask.size.get(axis as usize).copied()).unwrap_or(0)
}

/// The number of channels.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_channels(mask: *const azulejo_mask) -> usize {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mask", mask) }.map_or(0, |mask| mask.mask.channels)
}

/// The ranks of all pixels, channel by channel; in a channel x grows first, then y, then z. Each
/// number from 0 to width * height * depth - 1 occurs once in a channel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_ranks(mask: *const azulejo_mask) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("mask", mask) }.map_or(std::ptr::null(), |mask| array(&mask.mask.ranks))
}

/// Writes the ranks as numbers in (0, 1), in the same order: (rank + 0.5) / (width * height *
/// depth), rounded to a float.
///
/// out: channels * width * height * depth numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_values(mask: *const azulejo_mask, out: *mut f32) -> azulejo_status {
    call(|| {
        // SAFETY: handed on from the caller.
        let mask = unsafe { handles::get("mask", mask) }?;
        check_pointer("out", out)?;
        // SAFETY: handed on from the caller.
        unsafe { write(out, &mask.mask.values()) };
        Ok(())
    })
}

/// Dithers an image to few levels by ordered dithering. A number v becomes one of the levels beside
/// v * (levels - 1), the upper one where the fraction exceeds 1 - t, t being the mask's number at
/// the pixel. The mask is repeated over the image, and its channels over those of the image.
///
/// image: the numbers of all pixels, 0 to 1, those of one pixel after each other; x grows first,
/// then y, then z. Light adds up only where numbers are linear, unlike those of sRGB.
///
/// depth: 1 for an image of the plane.
///
/// channels: the numbers of a pixel, at least 1.
///
/// levels: 2 to 256.
///
/// out: for each number its level, 0 to levels - 1, in the same order.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_dither(
    mask: *const azulejo_mask,
    image: *const f32,
    width: usize,
    height: usize,
    depth: usize,
    channels: usize,
    levels: u32,
    out: *mut u8,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { dither(mask, image, [width, height, depth], channels, levels, Pixels::Floats, out) }
}

/// azulejo_mask_dither for an image of numbers from 0 to 255.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_dither_bytes(
    mask: *const azulejo_mask,
    image: *const u8,
    width: usize,
    height: usize,
    depth: usize,
    channels: usize,
    levels: u32,
    out: *mut u8,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { dither(mask, image, [width, height, depth], channels, levels, Pixels::Bytes, out) }
}

/// Dithers numbers of either type.
///
/// # Safety
/// As the calls; `image` and `out` have a number for each channel of each pixel.
unsafe fn dither<'a, T: 'a>(
    mask: *const azulejo_mask,
    image: *const T,
    size: [usize; 3],
    channels: usize,
    levels: u32,
    pixels: impl Fn(&'a [T]) -> Pixels<'a>,
    out: *mut u8,
) -> azulejo_status {
    call(|| {
        // SAFETY: handed on from the caller.
        let mask = unsafe { handles::get("mask", mask) }?;
        let numbers = size.into_iter().try_fold(channels, usize::checked_mul);
        let numbers = numbers.ok_or_else(|| {
            Failure::too_large("image", format!("{size:?} pixels of {channels} channels exceed memory"))
        })?;
        // SAFETY: handed on from the caller.
        let image = unsafe { rows::<T, 1>("image", image, "image", numbers) }?.as_flattened();
        if numbers > 0 {
            check_pointer("out", out)?;
            check_size("out", numbers, Some(numbers))?;
        }
        let levels = mask.mask.dither(&Image { size, channels, pixels: pixels(image) }, levels as usize)?;
        if numbers > 0 {
            // SAFETY: handed on from the caller.
            unsafe { write(out, &levels) };
        }
        Ok(())
    })
}

/// Frees the mask with its ranks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_free(mask: *mut azulejo_mask) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("mask", mask) };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let options = azulejo_mask_options { width: 7, height: 9, ..azulejo_mask_options::DEFAULT };
        assert_eq!(options.request(), Options::new(7, 9));
    }
}
