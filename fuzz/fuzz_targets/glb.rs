//! Binary glTF files: parsed, and what is a mesh is sampled.

#![no_main]

use azulejo_fuzz::files;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| files::load_and_sample("glb", bytes));
