//! Filling where the radius varies: octave by octave and cube by cube, by the rain of `psp/rain.rs`.

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::adaptive::cover::GradedCover;
use crate::psp::adaptive::field::RadiusField;
use crate::psp::adaptive::grids::{ConflictRule, end_of_octave};
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::set::AdaptiveSet;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::patches::PatchSearch;
use crate::psp::pieces::pieces;
use crate::psp::rain::{Rained, rain};
use crate::psp::samples::Sample;
use crate::rng::{Draw, Rng};

/// The pieces that the search begins with, in local radii.
const PIECE: f64 = 2.0;

/// A maximal set, and how many darts it took.
pub(super) fn fill(
    job: &Job,
    mesh: &Mesh,
    field: &RadiusField,
    quota: &Quota,
    rule: ConflictRule,
    seed: u64,
) -> Result<(AdaptiveSet, u64)> {
    let mut set = AdaptiveSet::new(mesh, seed);
    let bounds = |fragment: &Fragment, shape: &Shape| field.bounds(fragment, shape, field.all());
    let longest = |fragment: &Fragment, shape: &Shape| {
        if quota.is_exceeded() { f64::INFINITY } else { PIECE * bounds(fragment, shape).scale() }
    };
    let cube = |fragment: &Fragment, shape: &Shape| {
        quota.take(1);
        set.cube(shape.centre, bounds(fragment, shape).largest)
    };
    let pieces = pieces(&job.part(0.05, 0.2), mesh, longest, cube)?;
    field.check()?;
    quota.check(field.argument())?;
    let darts = set.grow(&job.part(0.2, 1.0), mesh, rule, &pieces, |cube, grids, pieces| {
        let field = field.apart();
        let test = GradedCover::new(mesh, &field, quota, grids, end_of_octave(cube.octave));
        let rained = fill_cube(mesh, test, Rng::at(seed, Draw::Adaptive, &cube.key()), pieces);
        field.check()?;
        quota.check(field.argument()).map(|()| (rained.accepted, rained.darts))
    })?;
    Ok((set, darts))
}

/// The samples that a cube needs to be covered, with their radii, and how many darts that took.
fn fill_cube(
    mesh: &Mesh,
    test: GradedCover,
    rng: Rng,
    pieces: &mut dyn Iterator<Item = &Fragment>,
) -> Rained<(Sample, f64)> {
    let mut search = PatchSearch { mesh, test, finest: mesh.float_spacing() };
    let mut patches = Vec::new();
    pieces.for_each(|piece| {
        search.test.allow_looks();
        search.search(piece, &mut patches);
    });
    rain(search, patches, rng)
}
