//! What a report says of a relaxed set, by all pairs and by cutting the domain into pieces.

use azulejo::Domain;
use azulejo::dcr::Report;

use crate::common::{self, sets};

/// What of a report is not true, if anything is not.
pub fn fault(domain: &Domain, relaxed: &[[f32; 2]], report: &Report) -> Option<String> {
    let [width, height] = [0, 1].map(|axis| domain.max[axis] - domain.min[axis]);
    let d_max = (2.0 * width * height / (3f64.sqrt() * relaxed.len() as f64)).sqrt();
    let smallest = sets::nearest_distances(domain, relaxed).into_iter().fold(f64::INFINITY, f64::min);
    let within = |radius: f64| common::find_gap(domain, radius, relaxed).is_none();
    if (report.rho - smallest / d_max).abs() > 1e-9 || (report.smallest_distance / smallest - 1.0).abs() > 1e-12 {
        Some(format!("the smallest distance is {smallest}: {report:?}"))
    } else if !within(report.coverage * d_max * (1.0 + 1e-6) + common::float_spacing(domain)) {
        Some(format!("holes are larger: {report:?}"))
    } else if within(report.coverage * d_max * (1.0 - 1e-6) - common::float_spacing(domain)) {
        Some(format!("holes are smaller: {report:?}"))
    } else {
        None
    }
}
