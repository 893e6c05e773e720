//! Sets of a hundred thousand samples on a mesh, which are filled by many cubes on several threads: maximal by proof, not by
//! random probes.

#[path = "common/meshes.rs"]
#[allow(dead_code)]
mod meshes;
#[path = "common/surface_oracle.rs"]
mod oracle;
#[path = "common/tolerance.rs"]
mod tolerance;

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, SurfaceSamples, psp};
use tolerance::tolerance;

const RADIUS: f64 = 0.01;

fn sample(threads: usize, mesh: &Arc<Mesh>, options: psp::Options) -> SurfaceSamples {
    psp::sample(&Context::new(threads).unwrap(), mesh, &options, None).unwrap().0
}

fn gap(mesh: &Mesh, samples: &SurfaceSamples) -> Option<[f64; 3]> {
    oracle::gap(mesh, samples, RADIUS, tolerance(mesh))
}

#[test]
fn a_hundred_thousand_samples_conflict_nowhere_and_leave_no_gap_on_any_number_of_threads() {
    let (positions, triangles) = meshes::fine_torus(300, 150);
    let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
    let options = psp::Options::new(RADIUS);
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
