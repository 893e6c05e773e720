//! Shapes made of patches, each a grid of quads. The tests of the library have theirs from here, too.

use std::f64::consts::TAU;

/// Vertices and triangles.
pub type Soup = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// A grid of `columns` x `rows` quads over the unit square of parameters, each cut in two.
pub fn patch(columns: u32, rows: u32, place: impl Fn(f64, f64) -> [f64; 3]) -> Soup {
    let mut soup = Soup::default();
    for row in 0..=rows {
        for column in 0..=columns {
            soup.0.push(place(column as f64 / columns as f64, row as f64 / rows as f64).map(|x| x as f32));
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            soup.1.extend([[a, b, c], [a, c, d]]);
        }
    }
    soup
}

/// A sphere of radius 1, of `around` quads around it and half as many from pole to pole, where triangles have no area.
pub fn sphere(around: u32) -> Soup {
    patch(around, around / 2, |u, v| {
        let ((sin, cos), (height, width)) = ((TAU * u).sin_cos(), (TAU / 2.0 * (v - 0.5)).sin_cos());
        [width * cos, width * sin, height]
    })
}

/// A torus of radii 1 and 0.4, of these numbers of quads around the hole and around the tube.
pub fn torus(around_hole: u32, around_tube: u32) -> Soup {
    patch(around_hole, around_tube, |u, v| {
        let ((sin, cos), (height, width)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
        [(1.0 + 0.4 * width) * cos, (1.0 + 0.4 * width) * sin, 0.4 * height]
    })
}

/// A closed hall, 4 by 2 and 1 high, with two rows of columns, arches between them and drapes along the walls: many
/// surfaces behind one another in every direction. `detail` is the number of quads around a column.
pub fn hall(detail: u32) -> Soup {
    let plain = |origin: [f64; 3], u: [f64; 3], v: [f64; 3]| {
        patch(detail, detail, move |s, t| std::array::from_fn(|axis| origin[axis] + s * u[axis] + t * v[axis]))
    };
    let (length, width, height) = ([4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
    let mut parts = Vec::new();
    for (u, v, w) in [(length, width, height), (width, height, length), (height, length, width)] {
        parts.extend([plain([0.0; 3], u, v), plain(w, v, u)]);
    }
    for y in [0.6, 1.4] {
        for x in (1..8).map(|i| 0.5 * f64::from(i)) {
            parts.push(patch(detail, 2 * detail, |u, v| {
                let ((sin, cos), radius) = ((TAU * u).sin_cos(), 0.06 + 0.02 * (TAU * v).cos().powi(4));
                [x + radius * cos, y + radius * sin, 0.6 * v]
            }));
        }
        for x in (1..7).map(|i| 0.5 * f64::from(i) + 0.25) {
            parts.push(patch(detail, detail, |u, v| {
                let ((sin, cos), (side, out)) = ((TAU / 2.0 * u).sin_cos(), (TAU * v).sin_cos());
                let radius = 0.25 + 0.04 * out;
                [x + radius * cos, y + 0.04 * side, 0.6 + radius * sin]
            }));
        }
    }
    for (y, x) in [0.1, 1.9].into_iter().flat_map(|y| (0..5).map(move |i| (y, 0.2 + 0.75 * f64::from(i)))) {
        parts.push(patch(4 * detail, detail, |u, v| {
            // Their fronts face the hall, as the fronts of the walls do.
            let u = if y < 1.0 { 1.0 - u } else { u };
            [x + 0.6 * u, y + 0.03 * (1.5 - v) * (8.0 * TAU * u).sin(), 0.9 * v]
        }));
    }
    join(parts)
}

/// All of several soups.
pub fn join(soups: impl IntoIterator<Item = Soup>) -> Soup {
    let mut all = Soup::default();
    for (positions, triangles) in soups {
        let first = all.0.len() as u32;
        all.0.extend(positions);
        all.1.extend(triangles.iter().map(|triangle| triangle.map(|index| first + index)));
    }
    all
}
