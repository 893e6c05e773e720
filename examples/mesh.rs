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
use azulejo::{Context, MAXIMAL_DENSITY, psp};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [path, count] = arguments.as_slice() else {
        return Err("usage: mesh MESH COUNT".into());
    };
    let mesh = Arc::new(Mesh::load(path)?);
    // The radius of so many samples on a plane of the same area; a curved surface takes a few per cent less.
    let radius = (MAXIMAL_DENSITY * mesh.area() / count.parse::<f64>()?).sqrt();

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
