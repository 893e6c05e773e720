//! The promises of a set in progressive order, checked for every sample and for some of its prefixes. Slow: O(n²).

use azulejo::mesh::Mesh;
use azulejo::{Order, Points};
pub use surface_oracle::conflict;

use crate::common::surface_oracle;
use crate::common::tolerance::tolerance;
use crate::common::triangle::distance;

/// True if every place of a mesh is within a distance of one of the positions.
pub fn covers(mesh: &Mesh, positions: &[[f32; 3]], within: f64) -> bool {
    let samples = Points { positions: positions.to_vec(), ..Points::<3>::default() };
    surface_oracle::gap(mesh, &samples, within, tolerance(mesh)).is_none()
}

/// The largest ratio of the covering radius to the last rank that a prefix may have. Ranks are rounded down.
fn largest_ratio(quotient: f64, prefix: usize) -> f64 {
    if prefix < Order::FIRST_COUNT { quotient.powi(2).max(2.0) * (1.0 + 1e-6) } else { quotient }
}

/// The fault in the order of some samples, if there is one: in the ranks, the distances of each sample from those
/// before it, or the covering radius of the first `prefixes` samples.
pub fn disorder(mesh: &Mesh, samples: &Points<3>, quotient: f64, prefixes: &[usize]) -> Option<String> {
    let Points { positions, ranks, .. } = samples;
    if ranks.len() != positions.len() || ranks.first().is_some_and(|rank| *rank != f32::INFINITY) {
        return Some(format!("{} ranks for {} samples, from {:?} on", ranks.len(), positions.len(), ranks.first()));
    }
    for i in 1..ranks.len() {
        let nearest = positions[..i].iter().map(|&p| distance(p, positions[i])).fold(f64::INFINITY, f64::min);
        if ranks[i] > ranks[i - 1] || f64::from(ranks[i]) > nearest {
            return Some(format!("{i}: rank {} after {}, {nearest} from the nearest", ranks[i], ranks[i - 1]));
        }
    }
    prefixes.iter().filter(|&&prefix| prefix > 1 && prefix <= ranks.len()).find_map(|&prefix| {
        let bound = largest_ratio(quotient, prefix) * f64::from(ranks[prefix - 1]);
        let is_covered = covers(mesh, &positions[..prefix], bound);
        (!is_covered).then(|| format!("the first {prefix} do not cover within {bound}"))
    })
}
