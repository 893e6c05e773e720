//! `azulejo draw surface`: a mesh with its samples painted on it, whole and in two details.

use std::path::PathBuf;

use azulejo::{Context, Progress, Result};
use clap::Args;
use glam::Vec2;

use super::PictureArgs;
use super::camera::Window;
use super::canvas::{Align, Canvas, Rect, Style};
use super::detail::most_interesting;
use super::palette::{COBALT, INK, SLATE};
use super::render::render;
use super::stage::Stage;
use crate::formats::Input;
use crate::input;
use crate::output::Output;
use crate::progress::watched;
use crate::text::grouped;

/// The page and its panels.
const PAGE: [f32; 2] = [1600.0, 986.0];
const WHOLE: Rect = Rect { x: 40.0, y: 86.0, width: 1078.0, height: 860.0 };
const DETAILS: [Rect; 2] = [
    Rect { x: 1142.0, y: 86.0, width: 418.0, height: 418.0 },
    Rect { x: 1142.0, y: 528.0, width: 418.0, height: 418.0 },
];

/// Half the side of the closer detail, in radii: some hundred samples.
const CLOSE: f32 = 13.0;

#[derive(Args)]
pub(crate) struct Surface {
    /// The mesh: OBJ, PLY, STL, OFF or GLB.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,
    /// The samples: a .ply, .npy, .csv, .xyz or .raw file.
    #[arg(value_name = "SAMPLES")]
    samples: PathBuf,
    #[command(flatten)]
    format: Input,
    #[command(flatten)]
    picture: PictureArgs,
    /// Leave out faces that are turned away from the camera: one looks into a hall whose walls face inwards.
    #[arg(long)]
    cutaway: bool,
}

impl Surface {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        let output = self.picture.open()?;
        let mesh = input::mesh(&self.mesh)?;
        let samples = self.format.read_samples(&self.samples, mesh.origin())?.positions;
        let name = self.mesh.file_stem().unwrap_or_default().to_string_lossy();
        let stage = Stage::new(context, &mesh, &samples, self.cutaway)?;
        picture(context, &name, &stage, self.picture.size, &output)?;
        self.picture.report(&output);
        Ok(())
    }
}

/// Draws a mesh with its samples, `pixels` wide.
pub fn picture(context: &Context, name: &str, stage: &Stage, pixels: u32, output: &Output) -> Result<()> {
    let windows = windows(stage);
    let mut canvas = Canvas::new(PAGE[0], PAGE[1], pixels);
    watched("light", |progress| draw_views(&mut canvas, stage, &windows, context.num_threads(), progress))?;
    let [samples, triangles] = stage.counts.map(grouped);
    let counts = format!("{samples} samples on {triangles} triangles");
    let style = Style { size: 22.0, colour: SLATE, align: Align::Right, upwards: false };
    let end = PAGE[0] - WHOLE.x;
    canvas.text(&counts, [end, 58.0], style);
    let free = end - canvas.length(&counts, style.size) - 40.0 - WHOLE.x;
    let style = Style { size: 30.0, colour: INK, align: Align::Left, ..style };
    canvas.text(&canvas.shortened(name, style.size, free), [WHOLE.x, 58.0], style);
    canvas.write(output)
}

/// The whole object, a detail of it, and a detail of that: each step closer by about the same factor.
fn windows(stage: &Stage) -> [Window; 3] {
    let whole = stage.camera.window_on(stage.positions(), WHOLE.width / WHOLE.height, 0.04);
    let widest = whole.half.min_element();
    let close = (CLOSE * stage.radius / stage.camera.eye.length()).min(widest / 4.0);
    let middle = (close * widest).sqrt().min(widest / 2.5);
    let middle = most_interesting(stage, &whole, middle);
    [whole, middle, most_interesting(stage, &middle, close)]
}

fn draw_views(
    canvas: &mut Canvas,
    stage: &Stage,
    windows: &[Window; 3],
    num_threads: usize,
    progress: &Progress,
) -> Result<()> {
    let views = [WHOLE, DETAILS[0], DETAILS[1]];
    let areas = views.map(|rect| (rect.width * rect.height) as f64);
    let mut done = 0.0;
    for ((rect, window), area) in views.into_iter().zip(windows).zip(areas) {
        let share = area / areas.iter().sum::<f64>();
        let pixels = [rect.width, rect.height].map(|length| (length * canvas.scale()).round().max(1.0) as usize);
        let image = render(stage, &windows[0], window, pixels, num_threads, &|part| progress(done + share * part))?;
        canvas.image(&image, pixels[0], rect);
        done += share;
    }
    // Each detail is framed where it is and where it comes from.
    for step in 0..2 {
        canvas.frame(DETAILS[step], 3.0, COBALT);
        canvas.frame(place(&windows[step + 1], &windows[step], views[step]), 2.0, COBALT);
    }
    Ok(())
}

/// The rectangle of a window of the image plane in the view of a larger one.
fn place(window: &Window, outer: &Window, view: Rect) -> Rect {
    let size = Vec2::new(view.width, view.height);
    let corner = Vec2::new(window.centre.x - window.half.x, window.centre.y + window.half.y);
    let offset = (corner - outer.at(0.0, 0.0)) * Vec2::new(1.0, -1.0) / (2.0 * outer.half) * size;
    let [width, height] = (window.half / outer.half * size).to_array();
    Rect { x: view.x + offset.x, y: view.y + offset.y, width, height }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_detail_lies_where_its_window_does() {
        let outer = Window { centre: Vec2::new(1.0, 2.0), half: Vec2::new(4.0, 2.0) };
        let view = Rect { x: 100.0, y: 50.0, width: 800.0, height: 400.0 };
        assert_eq!(place(&outer, &outer, view), view);
        let upper_right = Window { centre: Vec2::new(4.0, 3.0), half: Vec2::ONE };
        assert_eq!(place(&upper_right, &outer, view), Rect { x: 700.0, y: 50.0, width: 200.0, height: 200.0 });
    }

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn each_window_lies_within_the_one_before() {
        let [whole, middle, close] = windows(&crate::draw::stage::tests::square([10.0, 5.0, 7.0]));
        for (inner, outer) in [(middle, whole), (close, middle)] {
            assert!(((inner.centre - outer.centre).abs() + inner.half).cmple(outer.half).all());
        }
        assert_eq!(close.half.x, close.half.y);
    }
}
