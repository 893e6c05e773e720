//! Blue-noise masks.

use azulejo::mask::{Options, create};

use crate::answer::{Answer, call};

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
    call(|context| {
        let (mask, _) = create(context, &options.seed(seed).sigma(sigma), None)?;
        Ok(Answer::default().and(mask.ranks))
    })
}
