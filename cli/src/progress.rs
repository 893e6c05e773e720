//! Progress bars, on terminals only.

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::time::Duration;

use azulejo::Result;
use indicatif::{ProgressBar, ProgressStyle};

const STEPS: u64 = 1000;

/// The progress of a part of the work, between two shares of the whole.
pub fn part(progress: &azulejo::Progress, from: f64, to: f64) -> impl Fn(f64) -> ControlFlow<()> {
    move |done| progress(from + (to - from) * done)
}

/// Runs `work` under a progress bar on the standard error, if that is a terminal (indicatif hides it otherwise).
pub fn watched<T>(what: impl Into<Cow<'static, str>>, work: impl FnOnce(&azulejo::Progress) -> Result<T>) -> Result<T> {
    let style = ProgressStyle::with_template("{msg:>12} {wide_bar:.blue} {percent:>3} %  {elapsed}")
        .expect("the template is well formed");
    let bar = ProgressBar::new(STEPS).with_style(style).with_message(what);
    bar.enable_steady_tick(Duration::from_millis(200));
    let result = work(&|done| {
        bar.set_position((done * STEPS as f64) as u64);
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    result
}
