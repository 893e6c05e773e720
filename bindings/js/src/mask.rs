//! Blue-noise masks.

use azulejo::Error;
use azulejo::mask::{Image, Mask, Options, Pixels, create};

use crate::answer::{Answer, call};
use crate::memory::rows;

/// The ranks of all channels of a mask.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mask_create(
    width: u32,
    height: u32,
    depth: u32,
    channels: u32,
    seed: u64,
    sigma: f64,
) -> i32 {
    let options = Options::new(width as usize, height as usize).depth(depth as usize).channels(channels as usize);
    call(|context, progress| {
        let (mask, _) = create(context, &options.seed(seed).sigma(sigma), progress)?;
        Ok(Answer::default().and(mask.ranks))
    })
}

/// The levels of an image.
///
/// # Safety
/// `ranks` is valid for reads of `rank_count` numbers, and `values` for `count`: bytes, or floats.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mask_dither(
    width: usize,
    height: usize,
    depth: usize,
    channels: usize,
    ranks: *const u32,
    rank_count: usize,
    image_width: usize,
    image_height: usize,
    image_depth: usize,
    image_channels: usize,
    levels: usize,
    is_bytes: i32,
    values: *const u8,
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let ranks = unsafe { rows(ranks, rank_count) };
    let pixels = match is_bytes {
        // SAFETY: guaranteed by the caller.
        0 => Pixels::Floats(unsafe { rows(values.cast(), count) }),
        // SAFETY: likewise.
        _ => Pixels::Bytes(unsafe { rows(values, count) }),
    };
    call(|_, _| {
        let mask = Mask::from_ranks([width, height, depth], channels, ranks.to_vec())?;
        let image = Image { size: [image_width, image_height, image_depth], channels: image_channels, pixels };
        let dithered = mask.dither(&image, levels).map_err(|error| match error {
            // JavaScript's name for the numbers of the image.
            Error::InvalidArgument { argument: "image", reason } => {
                Error::InvalidArgument { argument: "values", reason }
            }
            other => other,
        });
        Ok(Answer::default().and(dithered?))
    })
}
