//! Small meshes about the unit box, and rays that try them where they are difficult.

use std::f64::consts::TAU;

use azulejo::trace::Ray;

pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.triangles[triangle as usize].map(|vertex| self.positions[vertex as usize])
    }
}

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    /// Uniform in `-1..1`.
    fn signed(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    pub fn vector(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| self.signed())
    }
}

fn plus(a: [f32; 3], b: [f32; 3], factor: f32) -> [f32; 3] {
    std::array::from_fn(|axis| a[axis] + factor * b[axis])
}

/// A closed surface over a grid of `columns` by `rows` that wraps around along both.
fn wrapped(columns: u32, rows: u32, point: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let at = |column: u32, row: u32| column % columns + columns * (row % rows);
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    Mesh {
        positions: cells
            .clone()
            .map(|(x, y)| point(x as f64 / columns as f64, y as f64 / rows as f64).map(|x| x as f32))
            .collect(),
        triangles: cells
            .flat_map(|(x, y)| {
                let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect(),
    }
}

pub fn torus() -> Mesh {
    wrapped(16, 8, |x, y| {
        let ring = 0.7 + 0.3 * (TAU * y).cos();
        [ring * (TAU * x).cos(), ring * (TAU * x).sin(), 0.3 * (TAU * y).sin()]
    })
}

/// The grid goes from pole to pole and back on the other side: each triangle is there twice, those at the poles almost
/// without area.
pub fn sphere() -> Mesh {
    wrapped(12, 12, |x, y| {
        let (around, down) = (TAU * x, TAU * y);
        [around.cos() * down.sin(), around.sin() * down.sin(), down.cos()]
    })
}

/// `count` triangles of edges up to 2 `size`.
pub fn soup(count: u32, size: f32, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let corners = (0..count).flat_map(|_| {
        let centre = random.vector();
        [(); 3].map(|_| plus(centre, random.vector(), size))
    });
    Mesh { positions: corners.collect(), triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}

/// Triangles of length 1 and width 1e-2 to 1e-5, among triangles that share their long edges.
pub fn slivers() -> Mesh {
    let mut random = Random(3);
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
    for i in 0..40u32 {
        let (a, along, aside) = (random.vector(), random.vector(), random.vector());
        let width = 0.1f32.powi(2 + (i % 4) as i32);
        let corners = [a, plus(a, along, 1.0), plus(plus(a, along, 0.5), aside, width), plus(a, aside, -0.5)];
        mesh.positions.extend(corners);
        mesh.triangles.extend([[4 * i, 4 * i + 1, 4 * i + 2], [4 * i + 1, 4 * i, 4 * i + 3]]);
    }
    mesh
}

/// Triangles with corners in common, on one line, or equal to another triangle, among good ones.
pub fn degenerate() -> Mesh {
    let mut mesh = soup(30, 0.8, 4);
    for i in (0..30).step_by(3) {
        let [a, b, c] = mesh.triangles[i];
        let middle = mesh.positions.len() as u32;
        let half = plus([0.0; 3], mesh.positions[a as usize], 0.5);
        mesh.positions.push(plus(half, mesh.positions[b as usize], 0.5));
        mesh.triangles.extend([[a, a, b], [c, c, c], [a, middle, b], [a, b, c], [c, b, a]]);
    }
    mesh
}

fn toward(origin: [f32; 3], target: [f32; 3], speed: f32) -> Ray {
    Ray { origin, direction: plus(target, origin, -1.0).map(|x| speed * x) }
}

/// Rays from about the mesh through random points, among them parallel ones, and directions of all lengths.
pub fn rays(count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    let ray = |i: usize| {
        let origin = plus([0.0; 3], random.vector(), 2.0);
        match i % 4 {
            0 => Ray { origin, direction: [0.0, 0.0, -origin[2].signum()] },
            1 => toward(origin, random.vector(), if i % 8 == 1 { 1e-6 } else { 1e6 }),
            _ => toward(origin, random.vector(), 1.0),
        }
    };
    (0..count).map(ray).collect()
}

/// Rays at the vertices and edges of a mesh: rounding decides what they hit.
pub fn rays_at_edges(mesh: &Mesh, count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    let ray = |i: usize| {
        let origin = plus([0.0; 3], random.vector(), 2.0);
        let corners = mesh.corners((i / 3 % mesh.triangles.len()) as u32);
        let [a, b] = [corners[i / 9 % 3], corners[(i / 9 + 1) % 3]];
        match i % 3 {
            0 => toward(origin, a, 1.0),
            1 => toward(origin, plus(plus([0.0; 3], a, 0.5), b, 0.5), 1.0),
            // Along an axis: vertices are met exactly, and so are the faces of boxes in the hierarchy.
            _ => Ray { origin: plus(a, [0.0, 0.0, 3.0], 1.0), direction: [0.0, 0.0, -1.0] },
        }
    };
    (0..count).map(ray).collect()
}
