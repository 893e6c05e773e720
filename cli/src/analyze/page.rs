//! The output of `analyze`.

use std::path::Path;

use azulejo::mesh::Mesh;
use azulejo::{Boundary, Domain};
use serde_json::{Value, json};

use super::Set;
use super::figures::{object, table};
use super::plane::{self, NEAREST_BINS, NEAREST_REACH};
use super::{space, surface};
use crate::formats::set::{PlaneSet, SampleSet};
use crate::text::{grouped, rounded};

/// A short description of the sets.
fn title<Points>(sets: &[Set<Points>]) -> String {
    match sets {
        [set] => set.path.display().to_string(),
        _ => format!("{} sets, the first of {}", sets.len(), sets[0].path.display()),
    }
}

fn boundary<const D: usize>(domain: &Domain<D>) -> &'static str {
    match domain.boundary {
        Boundary::Periodic => "periodic",
        Boundary::Bounded => "bounded",
    }
}

/// A domain by the ranges of its axes.
fn ranges<const D: usize>(domain: &Domain<D>) -> String {
    let range = |axis: usize| format!("{} to {}", rounded(domain.min[axis], 6), rounded(domain.max[axis], 6));
    let axes = (0..D).map(|axis| format!("{} {}, ", ["x", "y", "z"][axis], range(axis)));
    axes.collect::<String>() + boundary(domain)
}

pub fn plane_table(domain: &Domain, sets: &[Set<PlaneSet>], measured: &plane::Measured) -> String {
    let (rows, classes) = (table(&measured.rows, sets.len()), measured.classes.text(sets.len()));
    format!("{}: {}\n\n{rows}{classes}", title(sets), ranges(domain))
}

pub fn space_table(domain: &Domain<3>, sets: &[Set<SampleSet>], measured: &space::Measured) -> String {
    let (rows, classes) = (table(&measured.rows, sets.len()), measured.classes.text(sets.len()));
    format!("{}: {}\n\n{rows}{classes}", title(sets), ranges(domain))
}

pub fn space_json(domain: &Domain<3>, sets: &[Set<SampleSet>], measured: &space::Measured) -> String {
    printed(&json!({
        "files": files(sets),
        "domain": { "min": domain.min, "max": domain.max, "boundary": boundary(domain) },
        "figures": object(&measured.rows),
        "classes": measured.classes.json(),
    }))
}

pub fn surface_table(path: &Path, mesh: &Mesh, sets: &[Set<SampleSet>], measured: &surface::Measured) -> String {
    let (area, triangles) = (rounded(mesh.area(), 4), grouped(mesh.triangles().len()));
    let rows = table(&measured.rows, sets.len());
    let missing = if measured.differences.is_none() {
        "\nNo normals in the files: the differences of the samples are not measured.\n"
    } else {
        ""
    };
    let classes = measured.classes.text(sets.len());
    let about = format!("{}: on {} of {triangles} triangles, area {area}", title(sets), path.display());
    format!("{about}\n\n{rows}{missing}{classes}")
}

fn files<Points>(sets: &[Set<Points>]) -> Vec<String> {
    sets.iter().map(|set| set.path.display().to_string()).collect()
}

/// JSON on one line.
fn printed(value: &Value) -> String {
    format!("{value}\n")
}

pub fn plane_json(domain: &Domain, sets: &[Set<PlaneSet>], measured: &plane::Measured) -> String {
    let annuli = measured.annuli.iter();
    let radial = annuli.map(|annulus| json!([annulus.frequency, annulus.power, annulus.anisotropy]));
    let distribution = measured.distribution.as_ref().map(|distribution| {
        let pairs = std::iter::zip(distribution.distances(), distribution.density());
        pairs.map(|(distance, density)| json!([distance, density])).collect::<Vec<_>>()
    });
    let middle = |bin: usize| (bin as f64 + 0.5) * NEAREST_REACH / NEAREST_BINS as f64;
    let nearest = measured.nearest.iter().enumerate().map(|(bin, share)| json!([middle(bin), share]));
    printed(&json!({
        "files": files(sets),
        "domain": { "min": domain.min, "max": domain.max, "boundary": boundary(domain) },
        "figures": object(&measured.rows),
        "classes": measured.classes.json(),
        "radial": { "columns": ["frequency / √density", "power", "anisotropy"], "rows": radial.collect::<Vec<_>>() },
        "distances": { "columns": ["distance / d_max", "density of pairs"], "rows": distribution },
        "nearest": { "columns": ["distance / d_max", "share of points"], "rows": nearest.collect::<Vec<_>>() },
    }))
}

pub fn surface_json(path: &Path, mesh: &Mesh, sets: &[Set<SampleSet>], measured: &surface::Measured) -> String {
    let radial = measured.differences.as_ref().map(surface::Measured::power);
    let distances = measured.differences.as_ref().map(|differences| {
        let shells = differences.radial();
        shells.iter().map(|shell| json!([shell.distance, shell.density])).collect::<Vec<_>>()
    });
    printed(&json!({
        "files": files(sets),
        "mesh": { "file": path.display().to_string(), "triangles": mesh.triangles().len(), "area": mesh.area() },
        "figures": object(&measured.rows),
        "classes": measured.classes.json(),
        "radial": { "columns": ["frequency / √density", "power"], "rows": radial },
        "distances": { "columns": ["distance / mean spacing", "density of pairs"], "rows": distances },
    }))
}
