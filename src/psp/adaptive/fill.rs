//! Rounds of darts into what is uncovered, as in `psp/fill.rs`, where the radius varies.

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::adaptive::coverage::{Coverage, Open};
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::radius::Field;
use crate::psp::adaptive::room::{Dot, Room, Rule, end_of_octave};
use crate::psp::adaptive::set::{Place, Set};
use crate::psp::coverage::{Fragment, Shape};
use crate::psp::fill::float_spacing;
use crate::psp::pieces::pieces;
use crate::psp::samples::Sample;
use crate::rng::{Draw, Rng};

/// The pieces that the search begins with, in local radii.
const PIECE: f64 = 2.0;
/// At how many fragments a block may look for each of its pieces and samples. Slopes of 1 take about a hundred, of 30 a
/// thousand: a caller who states a far steeper one would wait for hours.
const LOOKS: u64 = 1 << 12;

/// A maximal set, and how many darts it took.
pub(super) fn fill(job: &Job, mesh: &Mesh, field: &Field, quota: &Quota, rule: Rule, seed: u64) -> Result<(Set, u64)> {
    let mut set = Set::new(mesh, seed);
    let bounds = |fragment: &Fragment, shape: &Shape| field.bounds(fragment, shape, field.all());
    let longest = |fragment: &Fragment, shape: &Shape| {
        if quota.is_exceeded() { f64::INFINITY } else { PIECE * bounds(fragment, shape).scale() }
    };
    let place = |fragment: &Fragment, shape: &Shape| {
        quota.take(1);
        set.place(shape.centre, bounds(fragment, shape).largest)
    };
    let pieces = pieces(&job.part(0.05, 0.2), mesh, longest, place)?;
    field.check()?;
    quota.check(field.argument())?;
    let darts = set.grow(&job.part(0.2, 1.0), mesh, rule, &pieces, |place, room, pieces| {
        let field = field.apart();
        let filled = fill_block(mesh, &field, quota, seed, place, room, pieces);
        field.check()?;
        quota.check(field.argument()).map(|()| filled)
    })?;
    Ok((set, darts))
}

/// The samples that a block needs to be covered, with their radii, and how many darts that took.
fn fill_block(
    mesh: &Mesh,
    field: &Field,
    quota: &Quota,
    seed: u64,
    place: Place,
    room: &mut Room,
    pieces: &mut dyn Iterator<Item = &Fragment>,
) -> (Vec<(Sample, f64)>, u64) {
    let mut rng = Rng::at(seed, Draw::Adaptive, &place.key());
    let (unit, spacing) = (end_of_octave(place.octave), float_spacing(mesh));
    let (mut open, mut next) = (Vec::new(), Vec::new());
    let mut coverage = Coverage::new(mesh, field, room, unit, spacing, 0);
    pieces.for_each(|piece| {
        coverage.looks += LOOKS;
        coverage.search(piece, &mut open);
    });
    let mut looks = coverage.looks;
    let (mut accepted, mut darts) = (Vec::new(), 0);
    while !open.is_empty() && !field.has_failed() && !quota.is_exceeded() {
        let known = accepted.len();
        darts += open.len() as u64;
        for patch in in_order_of_arrival(mesh, &open, &mut rng) {
            let sample = dart(mesh, patch, spacing, &mut rng);
            let radius = field.at_within(&sample, patch.bounds);
            let dot = Dot { position: sample.position, radius, normal: mesh.normal(sample.triangle) };
            if !room.rejects(&dot) {
                room.add(dot);
                accepted.push((sample, radius));
            }
        }
        let new = (accepted.len() - known) as u64;
        quota.take(new);
        // A dart into the centre of a patch decides about all of it.
        let mut coverage = Coverage::new(mesh, field, room, unit, spacing, looks + LOOKS * new);
        open.iter().filter(|patch| patch.longest > spacing).for_each(|patch| coverage.refine(patch, &mut next));
        looks = coverage.looks;
        std::mem::swap(&mut open, &mut next);
        next.clear();
    }
    (accepted, darts)
}

/// Darts that rain on the surface as densely as samples will stand hit a patch after a waiting time Exp(1) / (area / r²).
fn in_order_of_arrival<'a>(mesh: &Mesh, open: &'a [Open], rng: &mut Rng) -> Vec<&'a Open> {
    let arrival = |Open { fragment, parts, bounds, .. }: &Open, rng: &mut Rng| {
        let area = fragment.area(mesh) * f64::from(parts.count_ones());
        -(1.0 - rng.unit()).ln() / area * (bounds.scale() * bounds.scale())
    };
    let mut order: Vec<_> = open.iter().map(|open| (arrival(open, rng), open)).collect();
    order.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    order.into_iter().map(|(_, open)| open).collect()
}

/// A patch's dart, uniform in its open sixteenths (in its centre, if it is no longer than `spacing`).
fn dart(mesh: &Mesh, patch: &Open, spacing: f64, rng: &mut Rng) -> Sample {
    let place = if patch.longest <= spacing {
        patch.fragment.at([1.0 / 3.0; 2])
    } else {
        let skipped = rng.below(patch.parts.count_ones().into());
        let rest = (0..skipped).fold(patch.parts, |parts, _| parts & (parts - 1));
        let [mut s, mut t] = [rng.unit(), rng.unit()];
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        patch.fragment.sixteenth(rest.trailing_zeros() as usize).at([s, t])
    };
    Sample::new(mesh, patch.fragment.triangle, round_barycentrics(place))
}
