//! Blue-noise masks.

use azulejo::mask::{Image, Options, Pixels, create};
use azulejo::{Context, Result};

use super::list::{List, little_endian};

/// Adds the sums; those of small masks are the same calls with an eighth of the pixels along an axis.
pub fn sums(context: &Context, is_small: bool, list: &mut List) -> Result<()> {
    let scale = |pixels: usize| if is_small { pixels.div_ceil(8) } else { pixels };
    for (name, options) in [
        ("square", Options::new(scale(128), scale(128)).channels(2).seed(91)),
        ("of odd sides", Options::new(scale(201), scale(77)).seed(92).sigma(1.9)),
        ("narrow", Options::new(2, scale(1024)).seed(93)),
        ("of space", Options::new(scale(32), scale(24)).depth(scale(20)).seed(94)),
    ] {
        let (mask, _) = create(context, &options, None)?;
        list.bytes(&format!("mask {name}"), &little_endian(&mask.ranks, u32::to_le_bytes));
        let image: Vec<f32> = (0..60 * 50 * 3).map(|i| (i * 37 % 1000) as f32 / 999.0).collect();
        let image = Image { size: [60, 50, 1], channels: 3, pixels: Pixels::Floats(&image) };
        list.bytes(&format!("mask {name}, dithered"), &mask.dither(&image, 5)?);
    }
    Ok(())
}
