//! The promises of a merged set, from the definitions.

use azulejo::Domain;
use azulejo::kdrt::MergeOptions;

use crate::common::pieces::Part;
use crate::common::{distance, find_conflict, find_gap, float_spacing};

fn bits(sample: [f32; 2]) -> [u32; 2] {
    sample.map(f32::to_bits)
}

/// The promise that is broken, of those that hold whatever is given; if none is, how many samples of each piece went. `counts`
/// are those that were kept, eliminated and inserted, as they are reported.
pub fn fault(
    options: &MergeOptions,
    parts: &[Part],
    fixed: &[[f32; 2]],
    samples: &[[f32; 2]],
    counts: [usize; 3],
) -> Result<Vec<usize>, String> {
    let MergeOptions { radius, domain, .. } = *options;
    let inside =
        |sample: &[f32; 2]| (0..2).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(sample[axis])));
    if let Some(sample) = samples.iter().find(|sample| !inside(sample)) {
        return Err(format!("{sample:?} is outside of {domain:?}"));
    }
    if let Some(conflict) = find_conflict(&domain, radius, samples) {
        return Err(format!("conflict: {conflict:?}"));
    }
    if let Some(gap) = find_gap(&domain, radius + 6.0 * float_spacing(&domain), samples) {
        return Err(format!("uncovered: {gap:?}"));
    }
    if samples.len() < fixed.len() || (0..fixed.len()).any(|i| bits(samples[i]) != bits(fixed[i])) {
        return Err("the fixed points are not the first samples".into());
    }
    let [kept, eliminated, inserted] = counts;
    let given: usize = parts.iter().map(|part| part.samples.len()).sum();
    if kept + eliminated != given || fixed.len() + kept + inserted != samples.len() {
        return Err(format!("counts of {given} given and {} samples: {counts:?}", samples.len()));
    }
    let (owners, gone) = owners(parts, fixed, samples, kept)?;
    no_elimination_without_need(options, samples, &owners, &gone, parts.len())?;
    let went = |i| gone.iter().filter(|(owner, _)| *owner == i).count();
    Ok((0..parts.len()).map(went).collect())
}

/// The piece of each fixed point, which has none, and kept sample; and the samples that went, with theirs. Those kept follow
/// each other as they were given.
#[expect(clippy::type_complexity)]
fn owners(
    parts: &[Part],
    fixed: &[[f32; 2]],
    samples: &[[f32; 2]],
    kept: usize,
) -> Result<(Vec<Option<usize>>, Vec<(usize, [f32; 2])>), String> {
    let mut kept = samples[fixed.len()..fixed.len() + kept].iter().peekable();
    let mut owners = vec![None; fixed.len()];
    let mut gone = Vec::new();
    for (i, part) in parts.iter().enumerate() {
        for &sample in &part.samples {
            match kept.next_if(|&&kept| bits(kept) == bits(sample)) {
                Some(_) => owners.push(Some(i)),
                None => gone.push((i, sample)),
            }
        }
    }
    match kept.next() {
        None => Ok((owners, gone)),
        Some(sample) => Err(format!("{sample:?} is not a kept sample, or not in its place")),
    }
}

/// Samples that went stand against one that is kept (of their own piece only over the seam of a torus: the piece has no other
/// conflict), and no two pieces against each other both ways.
fn no_elimination_without_need(
    options: &MergeOptions,
    samples: &[[f32; 2]],
    owners: &[Option<usize>],
    gone: &[(usize, [f32; 2])],
    pieces: usize,
) -> Result<(), String> {
    let mut wins = vec![vec![false; pieces]; pieces];
    for &(loser, sample) in gone {
        let rivals = owners.iter().zip(samples);
        let rivals = rivals.filter(|(_, other)| distance(&options.domain, sample, **other) < options.radius);
        let winners: Vec<_> = rivals.map(|(owner, _)| *owner).collect();
        match winners[..] {
            [] => return Err(format!("{sample:?} went without need")),
            // If a fixed point is among several, it alone may be the reason.
            [Some(winner)] if winner != loser => wins[winner][loser] = true,
            _ => {}
        }
    }
    match (0..pieces).flat_map(|i| (0..i).map(move |j| (i, j))).find(|&(i, j)| wins[i][j] && wins[j][i]) {
        None => Ok(()),
        Some((i, j)) => Err(format!("{i} and {j} eliminate each other's samples")),
    }
}

/// The distance of a sample to the sides of its piece; negative outside of it.
fn border(part: &Part, sample: [f32; 2]) -> f64 {
    let Domain { min, max, .. } = part.rectangle;
    let sides = (0..2).flat_map(|axis| [f64::from(sample[axis]) - min[axis], max[axis] - f64::from(sample[axis])]);
    sides.fold(f64::INFINITY, f64::min)
}

/// A change elsewhere than at the seams and at fixed points, where pieces are maximal, if there is one.
pub fn fault_of_seams(
    options: &MergeOptions,
    parts: &[Part],
    fixed: &[[f32; 2]],
    samples: &[[f32; 2]],
) -> Option<String> {
    let MergeOptions { radius, domain, .. } = *options;
    let kept: Vec<[u32; 2]> = samples.iter().map(|&sample| bits(sample)).collect();
    let mut gone = Vec::new();
    for part in parts {
        for &sample in part.samples.iter().filter(|&&sample| !kept.contains(&bits(sample))) {
            let near_fixed = fixed.iter().any(|&fixed| distance(&domain, sample, fixed) < radius);
            if !near_fixed && border(part, sample) >= radius {
                return Some(format!("{sample:?} of the interior went"));
            }
            gone.push(sample);
        }
    }
    let given: Vec<[f32; 2]> = parts.iter().flat_map(|part| part.samples.iter().copied()).collect();
    let is_seam = |sample: [f32; 2]| {
        let inside = parts.iter().find(|part| border(part, sample) > 0.0);
        inside.is_none_or(|part| border(part, sample) < radius)
            || gone.iter().any(|&gone| distance(&domain, sample, gone) < radius)
    };
    let new = samples.iter().filter(|sample| !given.contains(sample) && !fixed.contains(sample));
    new.copied().find(|&sample| !is_seam(sample)).map(|sample| format!("{sample:?} is new in the interior"))
}
