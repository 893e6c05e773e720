//! `azulejo draw points`: samples, power spectrum, radial mean and anisotropy on one page.

use std::path::PathBuf;

use azulejo::{Context, Domain, Result};
use clap::Args;

use super::PictureArgs;
use super::canvas::{Canvas, Rect};
use super::panels;
use super::spectra::{FREQUENCY_LIMIT, Windows};
use crate::domain::{DomainArgs, OF_OR_AROUND};
use crate::formats::{Input, blame};
use crate::output::Output;
use crate::progress::watched;

/// The page and its panels.
const PAGE: [f32; 2] = [1600.0, 1150.0];
const SAMPLES: Rect = Rect { x: 110.0, y: 76.0, width: 640.0, height: 640.0 };
const SPECTRUM: Rect = Rect { x: 870.0, y: 76.0, width: 640.0, height: 640.0 };
const SCALE: Rect = Rect { x: 1526.0, y: 76.0, width: 14.0, height: 640.0 };
const RADIAL: Rect = Rect { x: 110.0, y: 850.0, width: 640.0, height: 220.0 };
const ANISOTROPY: Rect = Rect { x: 870.0, y: 850.0, width: 640.0, height: 220.0 };

#[derive(Args)]
#[command(mut_arg("domain", |domain| domain.help(OF_OR_AROUND)))]
pub(crate) struct Points {
    /// The samples: a .ply, .npy, .csv, .xyz or .raw file.
    #[arg(value_name = "SAMPLES")]
    input: PathBuf,
    #[command(flatten)]
    format: Input,
    #[command(flatten)]
    picture: PictureArgs,
    #[command(flatten)]
    domain: DomainArgs,
}

impl Points {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        let output = self.picture.open()?;
        let instead = "azulejo draw surface draws them on their mesh";
        let set = self.format.read_plane(&self.input, instead)?;
        let domain = self.domain.of_or_around(&set);
        draw(context, &domain, &set.points, self.picture.size, &output).map_err(|error| blame(&self.input, error))?;
        self.picture.report(&output);
        Ok(())
    }
}

/// Draws the page of a set, `pixels` wide.
pub fn draw(context: &Context, domain: &Domain, points: &[[f32; 2]], pixels: u32, output: &Output) -> Result<()> {
    let windows = Windows::of(domain, points.len());
    let spectrum = watched("spectrum", |progress| windows.spectrum(context, points, progress))?;

    let mut canvas = Canvas::new(PAGE[0], PAGE[1], pixels);
    panels::samples(&mut canvas, SAMPLES, &windows, points);
    panels::spectrum(&mut canvas, SPECTRUM, &spectrum, &windows.remark());
    panels::power_scale(&mut canvas, SCALE);
    let [x, y] = spectrum.frequency_step();
    let annuli = spectrum.radial(x.max(y))?;
    let annuli: Vec<_> = annuli.into_iter().filter(|annulus| annulus.frequency <= FREQUENCY_LIMIT).collect();
    panels::radial_mean(&mut canvas, RADIAL, &annuli);
    panels::anisotropy(&mut canvas, ANISOTROPY, &annuli, windows.domains.len());
    canvas.write(output)
}
