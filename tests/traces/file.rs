//! A recorded trace: a mesh, rays, and the hits that Embree reported. One item a line, floats as short as they can be
//! and still be read back exactly:
//!
//! ```text
//! v x y z
//! f vertex vertex vertex
//! r origin.. direction..
//! h triangle u v t          (of the ray above)
//! ```

use std::fmt::Write;
use std::path::PathBuf;
use std::str::FromStr;

use azulejo::trace::{Hit, Ray};

use super::meshes::Mesh;

pub struct Trace {
    pub mesh: Mesh,
    pub rays: Vec<Ray>,
    /// Sorted by ray.
    pub hits: Vec<Hit>,
}

fn path(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "traces", &format!("{name}.trace")].iter().collect()
}

fn numbers<T: FromStr, const N: usize>(words: &[&str]) -> [T; N] {
    let numbers: Vec<T> = words.iter().map(|word| word.parse().ok().expect("a number")).collect();
    numbers.try_into().ok().expect("as many numbers as the item has")
}

impl Trace {
    pub fn load(name: &str) -> Self {
        let text = std::fs::read_to_string(path(name)).expect("a recorded trace");
        let mesh = Mesh { positions: Vec::new(), triangles: Vec::new() };
        let mut trace = Self { mesh, rays: Vec::new(), hits: Vec::new() };
        for line in text.lines() {
            let words: Vec<_> = line.split(' ').collect();
            match words[0] {
                "v" => trace.mesh.positions.push(numbers(&words[1..])),
                "f" => trace.mesh.triangles.push(numbers(&words[1..])),
                "r" => trace.rays.push(Ray { origin: numbers(&words[1..4]), direction: numbers(&words[4..]) }),
                "h" => {
                    let [triangle] = numbers(&words[1..2]);
                    let [u, v, t] = numbers(&words[2..]);
                    trace.hits.push(Hit { ray: trace.rays.len() as u32 - 1, triangle, uv: [u, v], t });
                }
                other => panic!("an item {other:?} in a trace"),
            }
        }
        trace
    }

    pub fn save(&self, name: &str) {
        let mut text = String::new();
        let mut line = |item: char, numbers: &[&dyn std::fmt::Display]| {
            text.push(item);
            numbers.iter().for_each(|number| write!(text, " {number}").unwrap());
            text.push('\n');
        };
        self.mesh.positions.iter().for_each(|[x, y, z]| line('v', &[x, y, z]));
        self.mesh.triangles.iter().for_each(|[a, b, c]| line('f', &[a, b, c]));
        for (index, Ray { origin: [x, y, z], direction: [a, b, c] }) in self.rays.iter().enumerate() {
            line('r', &[x, y, z, a, b, c]);
            let hits = self.hits.iter().filter(|hit| hit.ray == index as u32);
            hits.for_each(|hit| line('h', &[&hit.triangle, &hit.uv[0], &hit.uv[1], &hit.t]));
        }
        std::fs::write(path(name), text).expect("a file beside the test");
    }
}
