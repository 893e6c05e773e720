//! A picture in four inks, each a class whose density is that of an image.

use azulejo::{Context, Progress, Result};

use super::Effort;
use azulejo_cli::output::Output;
use azulejo_cli::stipple::darkness::Darkness;
use azulejo_cli::stipple::drawing::Drawing;
use azulejo_cli::stipple::inks;

/// Width and height of the image, in pixels.
const SIZE: [usize; 2] = [480, 270];

/// The light of a value in a picture.
const GAMMA: f64 = 2.2;

/// A ball: its centre, its radius in heights of the image, and its colour.
struct Ball {
    centre: [f64; 2],
    radius: f64,
    colour: [f64; 3],
}

const BALLS: [Ball; 4] = [
    Ball { centre: [0.36, 0.55], radius: 0.34, colour: [0.85, 0.12, 0.1] },
    Ball { centre: [0.86, 0.36], radius: 0.26, colour: [0.95, 0.75, 0.1] },
    Ball { centre: [1.2, 0.66], radius: 0.25, colour: [0.08, 0.45, 0.2] },
    Ball { centre: [1.5, 0.34], radius: 0.2, colour: [0.1, 0.2, 0.7] },
];

/// The direction of the light.
const LIGHT: [f64; 3] = [-0.48, -0.64, 0.6];

/// Balls in the light, on paper that is darker at the bottom.
fn light([x, y]: [f64; 2]) -> [f64; 3] {
    for Ball { centre, radius, colour } in &BALLS {
        let [u, v] = [(x - centre[0]) / radius, (y - centre[1]) / radius];
        let depth = 1.0 - u * u - v * v;
        if depth <= 0.0 {
            continue;
        }
        let normal = [u, v, depth.sqrt()];
        let cosine: f64 = normal.iter().zip(LIGHT).map(|(n, l)| n * l).sum();
        let shine = cosine.max(0.0).powi(40);
        return colour.map(|share| (share * (0.08 + 0.92 * cosine.max(0.0)) + 0.8 * shine).min(1.0));
    }
    [0.97 - 0.25 * y, 0.97 - 0.2 * y, 0.97 - 0.12 * y]
}

/// Draws the balls with so many dots.
pub fn draw(context: &Context, effort: &Effort, output: &Output, progress: &Progress) -> Result<()> {
    let [width, height] = SIZE;
    let place = |pixel: usize| [pixel % width, pixel / width].map(|x| (x as f64 + 0.5) / height as f64);
    let lights: Vec<[f64; 3]> = (0..width * height).map(|pixel| light(place(pixel))).collect();
    let separations = Darkness::inks(&lights, width);
    let (dots, radius) = inks::dots(context, &separations, effort.dots, 0, progress)?;
    Drawing { size: SIZE, dots: &dots.centres, inks: &dots.inks, radius }.write_png(effort.pixels, GAMMA, output)
}
