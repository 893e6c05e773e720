//! Sets of a hundred thousand samples on a mesh, which are filled by many cubes on several threads: maximal by proof, not by
//! random probes.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Points, psp};

use crate::common::meshes;
use crate::common::surface_oracle as oracle;
use crate::common::tolerance::tolerance;

const RADIUS: f64 = 0.01;

fn sample(threads: usize, mesh: &Arc<Mesh>, options: psp::Options) -> Points<3> {
    psp::sample(&Context::new(threads).unwrap(), mesh, &options, None).unwrap().0
}

fn gap(mesh: &Mesh, samples: &Points<3>) -> Option<[f64; 3]> {
    oracle::gap(mesh, samples, RADIUS, tolerance(mesh))
}

fn torus() -> Arc<Mesh> {
    let (positions, triangles) = meshes::fine_torus(300, 150);
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

#[test]
fn a_hundred_thousand_samples_conflict_nowhere_and_leave_no_gap_on_any_number_of_threads() {
    let mesh = torus();
    let options = psp::Options::new(RADIUS).projected(false);
    let mut samples = sample(1, &mesh, options);
    assert!(samples.len() > 100_000, "{}", samples.len());
    assert_eq!(oracle::misplaced(&mesh, &samples), None);
    assert_eq!(oracle::conflict(&samples, RADIUS), None);
    assert_eq!(gap(&mesh, &samples), None);
    assert!(samples == sample(4, &mesh, options), "depends on the number of threads");

    // The oracles notice one sample of all that is missing, and one that is moved.
    let last = samples.positions.pop().unwrap();
    assert!(gap(&mesh, &samples).is_some());
    samples.positions.push(last);
    samples.positions[1] = last.map(|x| x + (0.4 * RADIUS) as f32);
    assert!(oracle::conflict(&samples, RADIUS).is_some());
}

/// Projected samples first, then the fill of what they leave: by default.
#[test]
fn a_hundred_thousand_samples_of_which_most_are_projected_leave_no_gap() {
    let mesh = torus();
    let options = psp::Options::new(RADIUS).seed(1);
    let (mut samples, report) = psp::sample(&Context::new(2).unwrap(), &mesh, &options, None).unwrap();
    assert!(samples.len() > 100_000, "{}", samples.len());
    assert!(report.iterations == 1 && report.darts < 2 * report.samples, "{report:?}");
    assert!(samples == sample(1, &mesh, options), "depends on the number of threads");
    assert_eq!(oracle::misplaced(&mesh, &samples), None);
    assert_eq!(oracle::conflict(&samples, RADIUS), None);
    assert_eq!(gap(&mesh, &samples), None);
    samples.positions.swap_remove(0);
    assert!(gap(&mesh, &samples).is_some());
}

/// Few large triangles that cross each other, so that samples keep others away from surface that is far from theirs.
#[test]
fn a_hundred_thousand_samples_of_a_soup_leave_no_gap() {
    let (positions, triangles) = meshes::random_soup(6, 60);
    let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
    let radius = (0.66 * mesh.area() / 100_000.0).sqrt();
    let mut samples = sample(2, &mesh, psp::Options::new(radius));
    assert!(samples.len() > 100_000, "{}", samples.len());
    assert_eq!(oracle::misplaced(&mesh, &samples), None);
    assert_eq!(oracle::conflict(&samples, radius), None);
    assert_eq!(oracle::gap(&mesh, &samples, radius, tolerance(&mesh)), None);
    samples.positions.pop();
    assert!(oracle::gap(&mesh, &samples, radius, tolerance(&mesh)).is_some());
}
