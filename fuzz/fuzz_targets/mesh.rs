//! Arrays of all kinds become meshes, with normals and masks of all kinds, and are sampled and deformed.

#![no_main]

use azulejo_fuzz::input::Input;
use azulejo_fuzz::{arrays, deformed, surface};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let Some(mesh) = arrays::mesh(&mut input) else { return };
    surface::sample(&mesh, &mut input);
    deformed::deform(&mesh, &mut input);
});
