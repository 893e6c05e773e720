//! A hundred thousand samples whose radius varies: maximal by proof, not by random probes.

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Radius};
use azulejo::{Context, Points};

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::Field;
use crate::common::meshes;
use crate::common::tolerance::tolerance;

#[test]
fn a_hundred_thousand_samples_whose_radii_vary_leave_no_gap() {
    let (positions, triangles) = meshes::fine_torus(300, 150);
    let mesh = Mesh::new(positions, triangles).unwrap();
    let (low, high) = mesh.bounds();
    let radius = |position: &[f32; 3]| 0.007 + 0.006 * (position[0] - low[0]) / (high[0] - low[0]);
    let radii: Vec<f32> = mesh.positions().iter().map(radius).collect();
    let options = adaptive::Options::new(Radius::PerVertex(&radii));
    let (mut samples, _) = adaptive::sample(&Context::new(2).unwrap(), &mesh, &options, None).unwrap();
    let field = Field::PerVertex(&radii);
    assert!(samples.len() > 100_000, "{}", samples.len());
    assert_eq!(oracle::wrong_radius(&mesh, &field, &samples, &samples.radii), None);
    assert_eq!(oracle::conflict(&samples, &samples.radii, -1.0), None);
    // The radius changes by less than a hundredth of the way.
    let tolerance = 1.01 * tolerance(&mesh);
    let gap = |samples: &Points<3>| oracle::gap(&mesh, &field, samples, &samples.radii, -1.0, tolerance);
    assert_eq!(gap(&samples), None);
    samples.positions[1] = samples.positions[0].map(|x| x + 0.001);
    assert!(oracle::conflict(&samples, &samples.radii, -1.0).is_some());
    assert!(gap(&samples).is_some());
}
