//! The promises of sets of several classes, over all pairs and all places.

use azulejo::{Classes, Domain, Points};

use crate::common::disks::{distance, find_gap};
use crate::common::float_spacing;

/// Positions, with a clearance for each class, row by row.
pub type Set = (Vec<[f32; 2]>, Vec<f64>);

/// The fault in a set around given samples, if there is one.
pub fn fault(domain: &Domain, classes: &Classes, given: &Set, set: &Points<2>) -> Option<String> {
    let inside = |sample: &[f32; 2]| {
        (0..2).all(|axis| domain.min[axis] <= f64::from(sample[axis]) && f64::from(sample[axis]) < domain.max[axis])
    };
    if let Some(sample) = set.positions.iter().find(|sample| !inside(sample)) {
        return Some(format!("{sample:?} is outside of {domain:?}"));
    }
    let count = classes.count();
    let all: Vec<_> = std::iter::zip(&set.positions, &set.classes).map(|(&s, &class)| (s, class as usize)).collect();
    for (i, &(a, class)) in all.iter().enumerate() {
        let conflict = all[..i].iter().find(|&&(b, other)| distance(domain, a, b) < classes.radius(class, other));
        if let Some(conflict) = conflict {
            return Some(format!("{a:?} of {class} conflicts with {conflict:?}"));
        }
        // A distance is computed with an error of its own where the period is rounded.
        let clearance = |index: usize| given.1[index * count + class] * (1.0 - 1e-15);
        let is_near = |&index: &usize| distance(domain, a, given.0[index]) < clearance(index);
        if let Some(index) = (0..given.0.len()).find(is_near) {
            return Some(format!("{a:?} of {class} is too near to {:?}", given.0[index]));
        }
    }
    let tolerance = if given.0.is_empty() { 3.0 } else { 6.0 } * float_spacing(domain);
    (0..count).find_map(|class| {
        let samples = all.iter().map(|&(sample, other)| (sample, classes.radius(class, other)));
        let given = given.0.iter().enumerate().map(|(index, &place)| (place, given.1[index * count + class]));
        let gap = find_gap(domain, samples.chain(given), tolerance, float_spacing(domain) / 16.0);
        gap.map(|gap| format!("{gap:?} can take another sample of {class}"))
    })
}
