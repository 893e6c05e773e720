//! Arrays of all kinds become meshes, with normals and masks of all kinds, and are sampled by density,
//! in progressive order, and with several classes.

#![no_main]

use azulejo_fuzz::input::Input;
use azulejo_fuzz::{arrays, surface};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let Some(mesh) = arrays::mesh(&mut input) else { return };
    surface::sample_kinds(&mesh, &mut input);
});
