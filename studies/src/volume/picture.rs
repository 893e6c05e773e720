//! The picture of the page: a slab of a set inside of the mesh.

use azulejo::volume::{InsideOptions, Surface, sample_inside};
use azulejo::{Result, mesh::Mesh};

use azulejo_cli::draw::canvas::{Canvas, Rect};
use azulejo_cli::draw::palette::{COBALT, Colour, SERIES, SLATE};
use azulejo_cli::draw::plot::{Axis, Panel};
use azulejo_cli::output::Output;

use super::Scene;
use super::goals::radius;
use super::tables::places_inside;
use crate::chart::dots;

/// The colour of samples of the surface.
const OF_SURFACE: Colour = SERIES[1];
/// The width of the picture in pixels, and its margin.
const WIDTH: f32 = 900.0;
const MARGIN: f32 = 40.0;
/// The radius of a disc, in radii of the set: discs of the same height do not overlap.
const DISC: f64 = 0.3;

/// The slab that is drawn.
pub struct Slab {
    pub samples: usize,
    pub radius: f64,
    /// Samples of the slab, inside and on the surface.
    pub inside: usize,
    pub surface: usize,
}

/// Draws the samples within half a radius of the middle of the mesh along z, with the outline of the mesh there.
pub fn draw(scene: &Scene, output: &Output) -> Result<Slab> {
    let mesh = &scene.mesh.1;
    let (low, high) = mesh.bounds();
    let extent = [0, 1, 2].map(|axis| f64::from(high[axis] - low[axis]));
    let share = places_inside(scene, 2)?.len() as f64 / scene.effort.probes as f64;
    let radius = radius(share * extent.iter().product::<f64>(), scene.effort.pictured);
    let options = InsideOptions::new(radius).surface(Surface::First).seed(1);
    let (points, report) = sample_inside(&scene.one, mesh, &options, None)?;
    let middle = f64::from(low[2]) + 0.5 * extent[2];
    let of_slab = |points: &[[f32; 3]]| -> Vec<[f64; 2]> {
        let all = points.iter().map(|point| point.map(f64::from));
        all.filter(|[.., z]| (z - middle).abs() <= 0.5 * radius).map(|[x, y, _]| [x, y]).collect()
    };
    // Samples of the surface come first.
    let (surface, inside) = points.positions.split_at(report.surface_samples);
    let (surface, inside) = (of_slab(surface), of_slab(inside));
    let (x, y) = (range(low[0], high[0], radius), range(low[1], high[1], radius));
    let width = WIDTH - 2.0 * MARGIN;
    let rect = Rect { x: MARGIN, y: MARGIN, width, height: width * ((y[1] - y[0]) / (x[1] - x[0])) as f32 };
    let mut canvas = Canvas::new(WIDTH, rect.bottom() + MARGIN, WIDTH as u32);
    let panel = Panel { rect, x: Axis::linear("", x, 0), y: Axis::linear("", y, 0) };
    panel.ground(&mut canvas, false);
    let outline = outline(mesh, middle).into_iter().map(|ends| ends.map(|end| panel.place(end)));
    canvas.segments(outline, 1.2, SLATE, rect);
    let disc = (DISC * radius / (x[1] - x[0])) as f32 * width;
    dots(&mut canvas, &panel, inside.iter().copied(), disc, COBALT);
    dots(&mut canvas, &panel, surface.iter().copied(), disc, OF_SURFACE);
    panel.axes(&mut canvas);
    canvas.write(output)?;
    Ok(Slab { samples: points.len(), radius, inside: inside.len(), surface: surface.len() })
}

/// A range with a margin.
fn range(low: f32, high: f32, margin: f64) -> [f64; 2] {
    [f64::from(low) - margin, f64::from(high) + margin]
}

/// The lines in which triangles cross the plane of this z.
fn outline(mesh: &Mesh, z: f64) -> Vec<[[f64; 2]; 2]> {
    let crossing = |triangle: u32| {
        let corners = mesh.corners(triangle).map(|corner| corner.map(f64::from));
        let on_edge = |edge: usize| {
            let [a, b] = [corners[edge], corners[(edge + 1) % 3]];
            let (from, to) = (a[2] - z, b[2] - z);
            let at = from / (from - to);
            ((from < 0.0) != (to < 0.0)).then(|| [0, 1].map(|axis| a[axis] + at * (b[axis] - a[axis])))
        };
        let ends: Vec<[f64; 2]> = (0..3).filter_map(on_edge).collect();
        <[[f64; 2]; 2]>::try_from(ends).ok()
    };
    (0..mesh.triangles().len() as u32).filter_map(crossing).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::scenes::sphere;

    #[test]
    fn the_outline_of_a_sphere_is_a_circle() {
        let sphere = sphere().unwrap();
        let lines = outline(&sphere, 0.01);
        let [low, high] = [sphere.bounds().0[0], sphere.bounds().1[0]].map(f64::from);
        let radius = 0.5 * (high - low);
        let expected = (radius * radius - 1e-4).sqrt();
        assert!(lines.len() > 300);
        assert!(lines.as_flattened().iter().all(|[x, y]| (x.hypot(*y) / expected - 1.0).abs() < 1e-2));
        let length: f64 = lines.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length / (std::f64::consts::TAU * expected) - 1.0).abs() < 1e-2, "{length}");
    }
}
