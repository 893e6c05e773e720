//! The meshes of the sums.

use std::f64::consts::TAU;

use azulejo::Result;
use azulejo::mesh::Mesh;
use libm::{cos, sin};

/// A torus of radii 1 and 0.4 around z with a normal for each vertex; an open one lacks a row of its quads.
pub fn torus(columns: u32, rows: u32, is_open: bool) -> Result<Mesh> {
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
        let around_hole = TAU * f64::from(column) / f64::from(columns);
        let around_tube = TAU * f64::from(row) / f64::from(rows);
        let (east, north) = (cos(around_hole), sin(around_hole));
        let radius = 1.0 + 0.4 * cos(around_tube);
        positions.push([radius * east, radius * north, 0.4 * sin(around_tube)].map(|x| x as f32));
        normals.push([cos(around_tube) * east, cos(around_tube) * north, sin(around_tube)].map(|x| x as f32));
        if is_open && row == 0 {
            continue;
        }
        let vertex = |column: u32, row: u32| (column % columns) * rows + row % rows;
        let (near, far) = (vertex(column, row), vertex(column + 1, row + 1));
        triangles.extend([[near, vertex(column + 1, row), far], [near, far, vertex(column, row + 1)]]);
    }
    Mesh::new(positions, triangles)?.with_normals(normals, None)
}

/// 300 triangles that hang together nowhere, with corners at random, every third of them near the plane z = 0.
pub fn soup() -> Result<Mesh> {
    let vertex = |i: u32| {
        let unit = |axis: u32| {
            let hash = i.wrapping_mul(2_654_435_761u32.wrapping_mul(axis + 1)).wrapping_mul(40_503);
            (hash >> 16) as f32 / 65_536.0
        };
        [unit(0), unit(1), if i.is_multiple_of(3) { 1e-5 } else { unit(2) }]
    };
    Mesh::new((0..900).map(vertex).collect(), (0..300).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}
