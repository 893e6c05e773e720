//! A maximal Poisson-disk set on a mesh, as text: position, normal, triangle and barycentrics of each sample.
//!
//! ```sh
//! cargo run --release --example mesh -- bunny.obj 20000 > samples.txt      # OBJ, PLY or STL; about how many samples
//! ```

use std::env;
use std::error::Error;
use std::io::{self, BufWriter, Write};
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, psp};

/// Samples per squared radius of a maximal set on a plane; curved surfaces have a few per cent less.
const DENSITY: f64 = 0.69656;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [path, count] = arguments.as_slice() else {
        return Err("usage: mesh MESH COUNT".into());
    };
    let mesh = Arc::new(Mesh::load(path)?);
    let radius = (DENSITY * mesh.area() / count.parse::<f64>()?).sqrt();

    let context = Context::new(0)?;
    let (samples, report) = psp::sample(&context, &mesh, &psp::Options::new(radius), None)?;
    eprintln!("{} samples, none closer than {radius}, in {:.3} s", samples.len(), report.seconds);

    let mut out = BufWriter::new(io::stdout().lock());
    for i in 0..samples.len() {
        let ([x, y, z], [nx, ny, nz]) = (samples.positions[i], samples.normals[i]);
        // The attribute of vertices a, b, c is (1 - u - v) a + u b + v c at the sample.
        let (triangle, [u, v]) = (samples.triangles[i], samples.barycentrics[i]);
        writeln!(out, "{x} {y} {z} {nx} {ny} {nz} {triangle} {u} {v}")?;
    }
    out.flush()?;
    Ok(())
}
