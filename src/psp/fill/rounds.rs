//! Rounds of darts on uncovered parts, until none is left: they make a set maximal.
//!
//! As in the flat quadtree of Ebeida et al. 2012 ("A simple algorithm for maximal Poisson-disk sampling in high
//! dimensions"), with triangles for squares: darts on all open parts, then subdivision of those that are still open.
//!
//! *Darts of uniform density.* The darts of a round are a Poisson process of one density on the whole open area, thrown
//! in random order. So each place is as likely to be hit as any other, however the surface is cut: a dart on a dropped
//! part would be rejected anyway. Only needles, which are lines compared with the radius, receive more darts than by
//! their area.
//!
//! *Termination.* Each round halves the length up to which open parts are kept whole. Floats cannot distinguish points
//! that are closer than the float spacing at the mesh's largest coordinate. If parts no longer than that are still
//! open, one dart is thrown at their centre. If it is rejected the part is covered up to rounding: that of the position
//! (0.9 spacings), of the barycentrics (below 4.4, on a triangle that spans a mesh around the origin) and the size of
//! the part (0.7). So no point of the surface is farther from all samples than the radius and [`TOLERANCE`] float
//! spacings.

use crate::error::Result;
use crate::mesh::Mesh;
use crate::psp::fill::darts::{PoissonProcess, random_point, shuffle};
use crate::psp::fill::page::BATCH;
use crate::psp::fragment::Fragment;
use crate::rng::Rng;

/// The largest excess over the radius of the distance of a point of the surface from a maximal set, in float spacings
/// at the largest absolute coordinate of the mesh.
pub const TOLERANCE: f64 = 6.0;

/// The largest length of patches at first, in radii: their sixteenths can be covered.
pub const PATCH: f64 = 2.0;
/// The length up to which triangles are kept whole at first.
pub const WHOLE: f32 = 0.5;

/// Darts of a round per whole triangle.
const DARTS_PER_WHOLE: f64 = 0.2;
/// The limit of the darts of a round where whole triangles are tiny: darts per squared radius of their area.
const DARTS_PER_AREA: f64 = 20.0;
/// Darts of a round per patch.
const DARTS_PER_PATCH: f64 = 0.9;

/// The number of darts whose triangles are looked up together: the processor waits for many memory reads at once.
const TOGETHER: usize = 32;

/// A whole triangle, small beside the radius, that may be uncovered.
#[derive(Clone, Copy, Debug)]
pub struct WholeTriangle<L = ()> {
    pub triangle: u32,
    pub area: f32,
    pub longest: f32,
    /// The bounds of the radius on it, or its class.
    pub local: L,
}

/// A fragment that may be uncovered.
#[derive(Clone, Copy, Debug)]
pub struct Patch<L = ()> {
    pub fragment: Fragment,
    /// A bit for each sixteenth that may be uncovered; at least one.
    pub open: u16,
    pub area: f32,
    /// The longest edge.
    pub longest: f32,
    /// The bounds of the radius on it, or its class.
    pub local: L,
}

/// A point that a dart is thrown at.
#[derive(Clone, Copy)]
pub struct Point<L = ()> {
    pub triangle: u32,
    pub barycentrics: [f64; 2],
    /// The bounds of the radius there, or its class.
    pub local: L,
}

/// A surface of which samples cover a part: the interface between the fill and the way in which its samples cover.
///
/// Lengths are in radii and areas in squared radii: the local ones, where the radius varies.
pub trait Ground {
    /// The values that differ from place to place: bounds of the radius, or the class that a dart is of.
    type Local: Copy;
    /// A dart, until it is known whether it is accepted.
    type Dart;
    /// A sample that the fill adds.
    type Sample;

    /// The length up to which fragments are no longer cut.
    fn finest(&self, local: Self::Local) -> f32;

    /// A fragment as a patch, unless all of its sixteenths are covered, each by one sample. The bounds of the radius
    /// are those of a fragment that it is part of.
    fn patch(&self, fragment: &Fragment, within: Self::Local) -> Option<Patch<Self::Local>>;

    /// Adds the open sixteenths of a patch that are not covered, as patches.
    fn subdivide(&self, patch: &Patch<Self::Local>, parts: &mut Vec<Patch<Self::Local>>) {
        let open = (0..16).filter(|part| patch.open >> part & 1 == 1);
        parts.extend(open.filter_map(|part| self.patch(&patch.fragment.sixteenth(part), patch.local)));
    }

    /// The open sixteenths of a patch that no single sample certainly covers now: a bit for each.
    fn open_sixteenths(&self, patch: &Patch<Self::Local>) -> u16;

    /// Those of at most 64 triangles that no single sample certainly covers: a bit for each.
    fn open_wholes(&self, wholes: &[WholeTriangle<Self::Local>]) -> u64;

    /// The mesh that the surface belongs to.
    fn mesh(&self) -> &Mesh;

    /// The dart at a point of a triangle with these corners, which lies in a part of this radius.
    fn dart(&self, point: Point<Self::Local>, corners: &[[f32; 3]; 3]) -> Self::Dart;

    /// The dart at a point of a triangle whose corners are not known to the caller.
    fn dart_at(&self, point: Point<Self::Local>) -> Self::Dart {
        self.dart(point, &self.mesh().corners(point.triangle))
    }

    /// True if given samples, and others with which the open share is measured, leave a point open.
    fn is_open(&self, point: Point<Self::Local>) -> bool;

    /// Drops darts, given by points and the corners of their triangles, that certainly conflict with a sample: most of
    /// those that conflict, at a fraction of the cost of [`Ground::throw`].
    fn drop_conflicting(&mut self, _points: &mut Vec<Point<Self::Local>>, _corners: &mut Vec<[[f32; 3]; 3]>) {}

    /// Makes a dart a sample, unless it conflicts with another one.
    fn throw(&mut self, dart: Self::Dart);

    /// The samples that the fill has added, and the number of darts thrown.
    fn into_accepted(self) -> (Vec<Self::Sample>, u64);
}

/// A ground that may be one of several *layers*: the samples of some classes with balls of one radius, or of radii that
/// are those of one field times a factor (`psp/classes/layers.rs`).
pub trait Layer: Ground {
    /// The radius, or the factor of the field.
    fn radius(&self) -> f64;

    /// Adds a sample that is there already.
    fn add(&mut self, sample: &Self::Sample);

    /// True if a sample conflicts with one of the layer, or with a given one.
    fn rejects(&self, sample: &Self::Sample) -> bool;

    /// The rank of a sample that is added now, before it is rounded down to a float. Infinite if there are no ranks.
    fn rank(&self, sample: &Self::Sample) -> f64;

    /// The sample of the least radius that a dart can become.
    fn least(&self, dart: &Self::Dart) -> Self::Sample;

    /// The sample that a dart becomes, unless it is rejected.
    fn settled(&self, dart: &Self::Dart, rejects: impl Fn(&Self::Sample) -> bool) -> Option<Self::Sample>;

    /// False if no sample of the layer covers a sixteenth of a fragment of this length, in local radii.
    fn may_cover(&self, longest: f32) -> bool;
}

/// The parts of a surface that may be uncovered.
pub struct Open<L = ()> {
    pub wholes: Vec<WholeTriangle<L>>,
    pub patches: Vec<Patch<L>>,
}

impl<L> Default for Open<L> {
    fn default() -> Self {
        Self { wholes: Vec::new(), patches: Vec::new() }
    }
}

/// Needles that are flatter receive as many darts as if their area were this times their squared length. They are lines
/// compared with the radius, and by their area alone darts would never hit them where other surface is open, too: they
/// would be cut without end.
const FLAT: f64 = 2e-3;

/// The weight of an area when a round throws darts: the area, except for needles.
fn weight(area: f32, longest: f32) -> f64 {
    f64::from(area).max(FLAT * f64::from(longest) * f64::from(longest))
}

impl<L> Patch<L> {
    /// The share of it that may be uncovered.
    fn open_share(&self) -> f64 {
        f64::from(self.open.count_ones()) / 16.0
    }
}

impl<L: Copy> Open<L> {
    /// The area of each whole triangle, then that of each patch.
    pub fn areas(&self) -> impl Iterator<Item = f64> {
        let of_patch = |patch: &Patch<L>| f64::from(patch.area) * patch.open_share();
        self.wholes.iter().map(|whole| f64::from(whole.area)).chain(self.patches.iter().map(of_patch))
    }

    fn weights(&self) -> impl Iterator<Item = f64> {
        let of_patch = |patch: &Patch<L>| weight(patch.area, patch.longest) * patch.open_share();
        self.wholes.iter().map(|whole| weight(whole.area, whole.longest)).chain(self.patches.iter().map(of_patch))
    }

    /// Adds the open parts of `other`.
    pub fn append(&mut self, other: &mut Self) {
        self.wholes.append(&mut other.wholes);
        self.patches.append(&mut other.patches);
    }

    /// The darts of a round, each by the number of the whole triangle or, behind these, of the patch that it falls on.
    fn darts(&self, rng: &mut Rng) -> Vec<u32> {
        let weights: Vec<f64> = self.weights().collect();
        let of_wholes: f64 = weights[..self.wholes.len()].iter().sum();
        let per_wholes = (DARTS_PER_WHOLE * self.wholes.len() as f64).min(DARTS_PER_AREA * of_wholes);
        let expected = per_wholes + DARTS_PER_PATCH * self.patches.len() as f64;
        let mut darts = Vec::with_capacity((1.1 * expected) as usize + 16);
        let mut process = PoissonProcess::new(rng, expected / weights.iter().sum::<f64>());
        for (number, weight) in (0..).zip(weights) {
            let count = process.darts_on(weight);
            darts.extend(std::iter::repeat_n(number, count));
        }
        shuffle(rng, &mut darts);
        darts
    }

    /// A random point of a whole triangle or an open part of a patch.
    pub fn point(&self, number: u32, rng: &mut Rng) -> Point<L> {
        let number = number as usize;
        match self.wholes.get(number) {
            Some(&WholeTriangle { triangle, local, .. }) => Point { triangle, barycentrics: random_point(rng), local },
            None => {
                let Patch { fragment, open, local, .. } = &self.patches[number - self.wholes.len()];
                let skipped = rng.below(open.count_ones().into());
                let part = (0..skipped).fold(*open, |open, _| open & (open - 1)).trailing_zeros();
                let barycentrics = fragment.sixteenth(part as usize).at(random_point(rng));
                Point { triangle: fragment.triangle, barycentrics, local: *local }
            }
        }
    }

    /// Cuts the patches that are longer than a limit, without throwing darts at them.
    pub fn cut<G: Ground<Local = L>>(&mut self, ground: &G, limit: f32) {
        let patches = std::mem::take(&mut self.patches);
        for patch in patches {
            if patch.longest > limit {
                ground.subdivide(&patch, &mut self.patches);
            } else {
                self.patches.push(patch);
            }
        }
    }

    /// Drops all parts that are covered by now, and cuts those that are longer than a limit.
    pub fn update<G: Ground<Local = L>>(&mut self, ground: &mut G, limit: f32) {
        let is_kept = |longest: f32, finest: f32| longest <= limit && finest <= limit;
        let (mut kept, mut grown, mut last) = (0, Vec::new(), Vec::new());
        for start in (0..self.wholes.len()).step_by(BATCH) {
            let end = (start + BATCH).min(self.wholes.len());
            let mut open = ground.open_wholes(&self.wholes[start..end]);
            while open != 0 {
                let whole = self.wholes[start + open.trailing_zeros() as usize];
                open &= open - 1;
                let (fragment, finest) = (Fragment::whole(whole.triangle), ground.finest(whole.local));
                if is_kept(whole.longest, finest) {
                    self.wholes[kept] = whole;
                    kept += 1;
                } else if whole.longest <= finest {
                    last.push((fragment, whole.local));
                } else {
                    grown.extend(ground.patch(&fragment, whole.local));
                }
            }
        }
        self.wholes.truncate(kept);
        kept = 0;
        for index in 0..self.patches.len() {
            let mut patch = self.patches[index];
            let finest = ground.finest(patch.local);
            patch.open = ground.open_sixteenths(&patch);
            if patch.open == 0 {
                continue;
            }
            if is_kept(patch.longest, finest) {
                self.patches[kept] = patch;
                kept += 1;
            } else if patch.longest <= finest {
                last.push((patch.fragment, patch.local));
            } else {
                ground.subdivide(&patch, &mut grown);
            }
        }
        self.patches.truncate(kept);
        self.patches.append(&mut grown);
        for (fragment, local) in last {
            let barycentrics = fragment.at([1.0 / 3.0; 2]);
            ground.throw(ground.dart_at(Point { triangle: fragment.triangle, barycentrics, local }));
        }
    }
}

/// Throws darts at points of triangles, in order.
pub fn throw<G: Ground>(ground: &mut G, mut targets: impl Iterator<Item = Point<G::Local>>) {
    let (mut points, mut corners) = (Vec::with_capacity(TOGETHER), Vec::with_capacity(TOGETHER));
    let mut darts = Vec::with_capacity(TOGETHER);
    loop {
        points.extend(targets.by_ref().take(TOGETHER));
        if points.is_empty() {
            return;
        }
        corners.extend(points.iter().map(|point: &Point<_>| ground.mesh().corners(point.triangle)));
        ground.drop_conflicting(&mut points, &mut corners);
        darts.extend(points.drain(..).zip(corners.drain(..)).map(|(point, corners)| ground.dart(point, &corners)));
        darts.drain(..).for_each(|dart| ground.throw(dart));
    }
}

/// Throws darts at all open parts until they are covered; at first on patches up to a limit. After each round the
/// number of rounds is reported.
pub fn rounds<G: Ground>(
    ground: &mut G,
    mut open: Open<G::Local>,
    mut limit: f32,
    rng: &mut Rng,
    report: impl Fn(i32) -> Result<()>,
) -> Result<()> {
    if limit < PATCH as f32 {
        open.cut(ground, limit);
    }
    let mut round = 0;
    while !(open.wholes.is_empty() && open.patches.is_empty()) {
        let darts = open.darts(rng);
        throw(ground, darts.iter().map(|&number| open.point(number, rng)));
        limit *= 0.5;
        open.update(ground, limit);
        round += 1;
        report(round)?;
    }
    Ok(())
}
