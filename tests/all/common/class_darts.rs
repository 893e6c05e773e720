//! Random sequential placement of several classes by its definition: each sample lies anywhere, of any class, with equal
//! probability for all places that those before it leave.

use azulejo::{Classes, Domain};

use crate::common::distance;
use crate::common::sets::Random;

/// A square in which samples of a class may have places left.
type Cell = (usize, [f64; 2]);

/// The class and place of each sample. Places smaller than a thousandth of the radii may be left.
pub fn darts(domain: &Domain, classes: &Classes, random: &mut Random) -> Vec<(usize, [f32; 2])> {
    let smallest = classes.radii().iter().copied().filter(|&radius| radius > 0.0).fold(f64::INFINITY, f64::min);
    let side = domain.max[0] - domain.min[0];
    let count = (side / (0.5 * smallest)).ceil();
    let mut width = side / count;
    let places = (0..(count * count) as usize).map(|i| [i as f64 % count, (i as f64 / count).floor()]);
    let corners = places.map(|place| [0, 1].map(|axis| domain.min[axis] + width * place[axis]));
    let mut cells: Vec<Cell> =
        corners.flat_map(|corner| (0..classes.count()).map(move |class| (class, corner))).collect();
    let mut samples: Vec<(usize, [f32; 2])> = Vec::new();
    while width > 1e-3 * smallest && !cells.is_empty() {
        for _ in 0..3 * cells.len() {
            let (class, corner) =
                cells[((f64::from(random.unit()) * cells.len() as f64) as usize).min(cells.len() - 1)];
            let dart = corner.map(|x| (x + width * f64::from(random.unit())) as f32);
            if samples.iter().all(|&(other, sample)| distance(domain, dart, sample) >= classes.radius(class, other)) {
                samples.push((class, dart));
            }
        }
        width /= 2.0;
        let quarters = |&(class, [x, y]): &Cell| {
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[i, j]| (class, [x + i * width, y + j * width]))
        };
        // What is wholly within the radius of a sample has no place left.
        let is_open = |&(class, corner): &Cell| {
            let middle = corner.map(|x| (x + width / 2.0) as f32);
            let is_within = |&(other, sample): &(usize, [f32; 2])| {
                distance(domain, middle, sample) + 0.7072 * width < classes.radius(class, other)
            };
            !samples.iter().any(is_within)
        };
        cells = cells.iter().flat_map(quarters).filter(is_open).collect();
    }
    samples
}
