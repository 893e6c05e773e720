//! The figures of a report of a relaxed set, held against its pairs and against pieces of the domain.

use azulejo::Domain;
use azulejo::dcr::Report;

use crate::common;

/// A figure of a report that is not true, if there is one.
pub fn fault(domain: &Domain, relaxed: &[[f32; 2]], report: &Report) -> Option<String> {
    let [width, height] = [0, 1].map(|axis| domain.max[axis] - domain.min[axis]);
    let d_max = (2.0 * width * height / (3f64.sqrt() * relaxed.len() as f64)).sqrt();
    let smallest = report.smallest_distance;
    let apart = |radius: f64| common::find_conflict(domain, radius, relaxed).is_none();
    let within = |radius: f64| common::find_gap(domain, radius, relaxed).is_none();
    if (report.rho - smallest / d_max).abs() > 1e-9 {
        Some(format!("{} is not the quotient of {smallest} and {d_max}", report.rho))
    } else if !apart(smallest * (1.0 - 1e-12)) || apart(smallest * (1.0 + 1e-12)) {
        Some(format!("{smallest} is not the smallest distance"))
    } else if !within(report.relative_covering_radius * d_max * (1.0 + 1e-6) + common::float_spacing(domain)) {
        Some(format!("holes are larger: {report:?}"))
    } else if within(report.relative_covering_radius * d_max * (1.0 - 1e-6) - common::float_spacing(domain)) {
        Some(format!("holes are smaller: {report:?}"))
    } else {
        None
    }
}
