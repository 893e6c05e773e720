//! What a report says of a relaxed set, by all pairs and by cutting the domain into pieces.

use azulejo::Domain;
use azulejo::dcr::Report;

use crate::{common, sets};

pub fn check(domain: &Domain, relaxed: &[[f32; 2]], report: &Report) {
    let [width, height] = [0, 1].map(|axis| domain.max[axis] - domain.min[axis]);
    let d_max = (2.0 * width * height / (3f64.sqrt() * relaxed.len() as f64)).sqrt();
    let smallest = sets::nearest_distances(domain, relaxed).into_iter().fold(f64::INFINITY, f64::min);
    assert!((report.rho - smallest / d_max).abs() < 1e-9, "{smallest}: {report:?}");
    let within = |radius: f64| common::find_gap(domain, radius, relaxed).is_none();
    assert!(within(report.coverage * d_max * 1.0001 + common::float_spacing(domain)), "{report:?}");
    assert!(!within(report.coverage * d_max * 0.999), "{report:?}");
}
