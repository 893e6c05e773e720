//! The calls from the module to JavaScript: the callbacks of `index.js`, which catch what those of the caller throw.

use std::ops::ControlFlow;

use azulejo::Progress;

/// The module that `index.js` gives to this one, as it is called by WebAssembly.
#[cfg(target_family = "wasm")]
mod imports {
    #[link(wasm_import_module = "azulejo")]
    unsafe extern "C" {
        pub safe fn progress(done: f64) -> i32;
        pub safe fn visit(samples: *const [f32; 2], count: usize) -> i32;
    }
}

/// Elsewhere the crate is compiled to be checked, but there is no one to ask.
#[cfg(not(target_family = "wasm"))]
mod imports {
    pub fn progress(_: f64) -> i32 {
        1
    }

    pub fn visit(_: *const [f32; 2], _: usize) -> i32 {
        1
    }
}

fn flow(goes_on: i32) -> ControlFlow<()> {
    if goes_on == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Tells the fraction that is done, and asks whether to go on.
pub(crate) fn progress(done: f64) -> ControlFlow<()> {
    flow(imports::progress(done))
}

/// The progress of a part of a call, which goes from one fraction of it to another.
pub(crate) fn part(progress: Option<&Progress>, from: f64, to: f64) -> impl Fn(f64) -> ControlFlow<()> {
    move |done| progress.map_or(ControlFlow::Continue(()), |tell| tell(from + (to - from) * done))
}

/// Passes samples of a stream on, which JavaScript copies, and asks whether to go on.
pub(crate) fn visit(samples: &[[f32; 2]]) -> ControlFlow<()> {
    flow(imports::visit(samples.as_ptr(), samples.len()))
}
