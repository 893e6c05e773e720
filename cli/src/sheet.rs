//! A flat mesh as dark as a table of numbers, for adaptive sampling.

use azulejo::mesh::Mesh;
use azulejo::{MAXIMAL_DENSITY, Result};

/// A flat mesh with a vertex for each number of a table, and the radii that make about `dots` samples in all. Numbers
/// below `lightest` are drawn as if they were equal to it; triangles whose corners are all white are left out.
pub fn sheet(darkness: &[f64], columns: usize, lightest: f64, dots: f64) -> Result<(Mesh, Vec<f32>)> {
    let rows = darkness.len() / columns;
    let place = |i: usize| [(i % columns) as f32, (i / columns) as f32, 0.0];
    let ink: f64 = darkness.iter().sum();
    let radius = |&dark: &f64| (MAXIMAL_DENSITY * ink / (dots * dark.max(lightest))).sqrt() as f32;
    let squares = (0..rows - 1).flat_map(|y| (0..columns - 1).map(move |x| y * columns + x));
    let triangles = squares.flat_map(|a| [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]);
    let triangles = triangles.filter(|triangle| triangle.iter().any(|&vertex| darkness[vertex] > 0.0));
    let triangles = triangles.map(|triangle| triangle.map(|vertex| vertex as u32)).collect();
    let mesh = Mesh::new((0..darkness.len()).map(place).collect(), triangles)?;
    Ok((mesh, darkness.iter().map(radius).collect()))
}
