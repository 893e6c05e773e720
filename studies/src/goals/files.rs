//! Files of meshes that are read.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use azulejo::mesh::Mesh;
use azulejo::{Error, Result};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::timing::in_turns;

/// Seconds for the dragon's file, and MB of an OBJ file per second.
const SECONDS: f64 = 0.1;
const RATE: f64 = 100.0;

pub fn section(study: &Study) -> Result<String> {
    let about = "The files are in the system's cache; reading checks the mesh as well. The OBJ file is that of the same mesh, with \
        as many digits as its floats need.";
    let mut rows = Vec::new();
    let mut obj = |name: &str, mesh: &Mesh| {
        let path = std::env::temp_dir().join(format!("azulejo-goals-{}.obj", std::process::id()));
        let megabytes = write_obj(mesh, &path)? as f64 / 1e6;
        let measured = in_turns(study.effort.rounds, &[&|| Ok(Mesh::load(&path)?.triangles().len())]);
        fs::remove_file(&path).map_err(|source| Error::Io { path, source })?;
        let rates = measured?[0].seconds.iter().map(|seconds| megabytes / seconds).collect::<Vec<_>>();
        rows.push(Row::new(
            format!("{name}: an OBJ file of {megabytes:.1} MB, read per second"),
            Figure::of_rounds(rates),
            "MB/s",
            Goal::AtLeast(RATE),
        ));
        Ok(())
    };
    let Some(dragon) = &study.dragon else {
        obj(study.small.0, &study.small.1)?;
        return Ok(rows_in("Files of meshes", about, &rows));
    };
    obj("dragon", &dragon.mesh)?;
    let measured = in_turns(study.effort.rounds, &[&|| Ok(Mesh::load(&dragon.path)?.triangles().len())])?;
    let format = dragon.path.extension().unwrap_or_default().to_string_lossy().to_uppercase();
    rows.push(Row::new(
        format!("dragon: its {format} file"),
        Figure::time(&measured[0], 1.0),
        "s",
        Goal::AtMost(SECONDS),
    ));
    Ok(rows_in("Files of meshes", about, &rows))
}

/// Writes a mesh as an OBJ file; returns its size in bytes.
fn write_obj(mesh: &Mesh, path: &Path) -> Result<usize> {
    let mut text = String::new();
    mesh.positions().iter().for_each(|[x, y, z]| _ = writeln!(text, "v {x} {y} {z}"));
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|vertex| vertex + 1);
        _ = writeln!(text, "f {a} {b} {c}");
    }
    fs::write(path, &text).map_err(|source| Error::Io { path: path.into(), source })?;
    Ok(text.len())
}
