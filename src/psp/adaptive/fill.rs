//! Filling where the radius varies: octave by octave and cube by cube, each as a surface of one radius is filled.

use glam::DVec3;

use crate::error::Result;
use crate::index::Weights;
use crate::job::Job;
use crate::math::square;
use crate::mesh::Mesh;
use crate::psp::adaptive::bounds::RadiusBounds;
use crate::psp::adaptive::dot::Dot;
use crate::psp::adaptive::field::RadiusField;
use crate::psp::adaptive::grid::Grid;
use crate::psp::adaptive::ground::GradedGround;
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::pieces::{Piece, pieces};
use crate::psp::adaptive::set::AdaptiveSet;
use crate::psp::facing::Facing;
use crate::psp::fill::darts::random_point;
use crate::psp::fill::ground::{Ground, Point, Whole};
use crate::psp::fill::page::GROUP;
use crate::psp::fill::region::FIRST_DARTS;
use crate::psp::fill::rounds::{Open, PATCH, WHOLE, rounds, throw};
use crate::psp::fill::{Manner, RAIN_FROM};
use crate::psp::fragment::Fragment;
use crate::psp::obstacles::Obstacles;
use crate::psp::samples::Sample;
use crate::rng::{Draw, Rng};

/// Where samples are given, so many random points tell how much of a cube they leave open.
const PROBES: usize = 1 << 6;

/// What is to be filled, and around what.
#[derive(Clone, Copy)]
pub(super) struct GradedSurface<'a> {
    pub mesh: &'a Mesh,
    pub field: &'a RadiusField<'a>,
    pub quota: &'a Quota,
    pub facing: Facing,
    pub obstacles: &'a Obstacles,
    /// The finest scale that is expected.
    pub finest: f64,
}

impl GradedSurface<'_> {
    /// A maximal set around some samples, and how many darts it took.
    pub fn fill(&self, job: &Job, manner: Manner, samples: &[(Sample, f64)]) -> Result<(AdaptiveSet, u64)> {
        let &Self { mesh, field, quota, facing, obstacles, .. } = self;
        let mut set = AdaptiveSet::new(mesh, manner.seed, field.scale(), samples);
        let stretch = manner.largest_rank.map_or(1.0, |rank| (rank / field.scale()).max(1.0));
        let pieces = pieces(&job.part(0.05, 0.2), mesh, field, quota, &set)?;
        field.check()?;
        quota.check(field.argument())?;
        let darts = set.grow(&job.part(0.2, 1.0), mesh, facing, &pieces, stretch, |cube, dots, pieces| {
            let field = field.apart();
            let grid = grid(mesh, &field, facing, dots, pieces, stretch);
            let mut ground = GradedGround::new(mesh, &field, quota, obstacles, grid, self.looks(pieces));
            ground = ground.ranked(manner.largest_rank);
            fill_cube(&mut ground, pieces, manner, &mut Rng::at(manner.seed, Draw::Adaptive, &cube.key()));
            field.check()?;
            quota.check(field.argument()).map(|()| (ground.accepted, ground.darts))
        })?;
        Ok((set, darts))
    }

    /// How many pieces may be looked at: those of a cube, and at a coarser scale than the finest as many as there will be
    /// samples on them. Radii are steeper there by as much as samples are fewer.
    fn looks(&self, pieces: &[&Piece]) -> u64 {
        let growth = square(self.field.scale() / self.finest);
        let samples: f64 = pieces.iter().map(|piece| piece.area()).sum();
        pieces.len() as u64 + if growth > 1.0 { (growth * samples) as u64 } else { 0 }
    }
}

/// The samples around a cube in a grid that suits the radii on its pieces.
fn grid(mesh: &Mesh, field: &RadiusField, facing: Facing, dots: Vec<Dot>, pieces: &[&Piece], stretch: f64) -> Grid {
    let largest = pieces.iter().map(|piece| field.above(piece.bounds())).fold(0.0, f64::max);
    // The area by the number of samples that will stand on it gives their usual radius.
    let samples: f64 = pieces.iter().map(|piece| piece.area()).sum();
    let area: f64 = pieces.iter().map(|piece| piece.area() / piece.bounds().density()).sum();
    let usual = if samples > 0.0 { (area / samples).sqrt() } else { largest };
    let corners = pieces
        .iter()
        .map(|piece| piece.fragment())
        .flat_map(|fragment| fragment.corners.map(|corner| mesh.point_exact(fragment.triangle, corner)));
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let bounds = corners.fold(none, |[low, high], corner| [low.min(corner), high.max(corner)]);
    let mut grid = Grid::new(mesh, facing, bounds, [usual, largest], stretch);
    dots.into_iter().for_each(|dot| grid.add(dot));
    grid
}

/// Fills the pieces of a cube.
fn fill_cube(ground: &mut GradedGround, pieces: &[&Piece], manner: Manner, rng: &mut Rng) {
    let row = Weights::new(pieces.iter().map(|piece| piece.area()).collect());
    let point = |rng: &mut Rng| {
        let piece = &pieces[row.pick(rng) as usize];
        let fragment = piece.fragment();
        Point { triangle: fragment.triangle, barycentrics: fragment.at(random_point(rng)), local: piece.bounds() }
    };
    if manner.rains && ground.open_share(PROBES, || point(rng)) >= RAIN_FROM {
        let darts = (FIRST_DARTS * row.total() + rng.unit()) as usize;
        throw(ground, (0..darts).map(|_| point(rng)));
    }
    let open = open(ground, pieces);
    let Ok(()) = rounds(ground, open, manner.patch, rng, |_| Ok::<(), std::convert::Infallible>(()));
}

/// What is open of some pieces.
fn open(ground: &GradedGround, pieces: &[&Piece]) -> Open<RadiusBounds> {
    let (mut open, mut wholes) = (Open::default(), Vec::with_capacity(GROUP));
    for piece in pieces {
        match piece {
            Piece::Whole(whole) => wholes.push(*whole),
            Piece::Part(part) => open_parts(ground, &part.fragment, part.longest, part.local, &mut open),
        }
        if wholes.len() == GROUP {
            open_wholes(ground, &wholes, &mut open);
            wholes.clear();
        }
    }
    if !wholes.is_empty() {
        open_wholes(ground, &wholes, &mut open);
    }
    open
}

/// Adds those of a group of triangles that are not covered: whole, if they are small, or in parts.
fn open_wholes(ground: &GradedGround, wholes: &[Whole<RadiusBounds>], open: &mut Open<RadiusBounds>) {
    let mut uncovered = ground.open_wholes(wholes);
    while uncovered != 0 {
        let whole = wholes[uncovered.trailing_zeros() as usize];
        uncovered &= uncovered - 1;
        if whole.longest <= WHOLE {
            open.wholes.push(whole);
        } else {
            open_parts(ground, &Fragment::whole(whole.triangle), whole.longest, whole.local, open);
        }
    }
}

/// Adds what is open of a fragment, in patches that are small enough.
fn open_parts(
    ground: &GradedGround,
    fragment: &Fragment,
    longest: f32,
    bounds: RadiusBounds,
    open: &mut Open<RadiusBounds>,
) {
    let count = (f64::from(longest) / PATCH).ceil().max(1.0) as u32;
    open.patches.extend(fragment.parts(count).filter_map(|part| ground.look(&part, bounds)));
}
