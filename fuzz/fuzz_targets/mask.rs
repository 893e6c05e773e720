//! Masks of all sizes: the ranks of each channel are all numbers once, and dithering follows them.

#![no_main]

use std::ptr::null_mut;

use azulejo_c::mask::*;
use azulejo_fuzz::calls::{Patience, accepted, array, context, create, report};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(20) } else { u32::MAX });
    let side = |input: &mut Input| if input.one_in(32) { input.any::<u16>() } else { input.below(20) as u16 };
    let options = azulejo_mask_options {
        width: side(&mut input).into(),
        height: side(&mut input).into(),
        depth: if input.one_in(4) { input.below(6) as usize } else { 1 },
        channels: if input.one_in(4) { input.below(4) } else { 1 },
        seed: input.any(),
        sigma: if input.one_in(4) { input.number() } else { 1.5 },
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        ..report(azulejo_mask_options_init)
    };
    if [options.width, options.height, options.depth].into_iter().fold(options.channels as usize, usize::saturating_mul)
        > 5000
    {
        return; // more pixels than can be ranked in the time that a fuzz target has
    }
    // SAFETY: the options have the size in their `struct_size`.
    let mask = create(|out| unsafe { azulejo_mask_create(context(), &options, out, null_mut()) });
    let Some(mask) = mask else { return };
    let channels = mask.read(azulejo_mask_channels);
    // SAFETY: the mask lives, and has three axes.
    let pixels: usize = (0..3).map(|axis| unsafe { azulejo_mask_size(mask.get(), axis) }).product();
    assert_eq!((pixels, channels), (options.width * options.height * options.depth, options.channels as usize));
    // SAFETY: the header says how long they are.
    let ranks = unsafe { array(mask.read(azulejo_mask_ranks), pixels * channels) };
    for channel in ranks.chunks(pixels) {
        let mut sorted = channel.to_vec();
        sorted.sort_unstable();
        assert!(sorted.iter().zip(0..).all(|(&rank, number)| rank == number), "{channel:?}");
    }
    let mut values = vec![f32::NAN; pixels * channels];
    // SAFETY: as long as that.
    assert!(accepted(unsafe { azulejo_mask_values(mask.get(), values.as_mut_ptr()) }));
    for (&rank, &value) in ranks.iter().zip(&values) {
        assert!((f64::from(value) * pixels as f64 - f64::from(rank) - 0.5).abs() < 0.01, "{value} of rank {rank}");
    }
    // An image of one tone and channel has its share of ones.
    let tone = input.below(1001) as f32 / 1000.0;
    let image = vec![tone; pixels];
    let mut levels = vec![9u8; pixels];
    let size = [options.width, options.height, options.depth];
    let (from, out) = (image.as_ptr(), levels.as_mut_ptr());
    // SAFETY: both arrays have a number for each pixel.
    let dithered = unsafe { azulejo_mask_dither(mask.get(), from, size[0], size[1], size[2], 1, 2, out) };
    assert!(accepted(dithered));
    let ones: f64 = levels.iter().copied().map(f64::from).sum();
    assert!((ones - f64::from(tone) * pixels as f64).abs() <= 1.0, "{ones} ones at {tone}");
});
