//! Filling where the radius varies: octave by octave and cube by cube, each as a surface of one radius is filled.

use glam::DVec3;

use crate::error::Result;
use crate::index::Weights;
use crate::job::Job;
use crate::math::square;
use crate::mesh::Mesh;
use crate::psp::adaptive::field::{Quota, RadiusBounds, RadiusField};
use crate::psp::adaptive::ground::GradedGround;
use crate::psp::adaptive::pieces::{MeasuredTriangles, Piece, pieces};
use crate::psp::adaptive::set::AdaptiveSet;
use crate::psp::fill::{
    Alike, FIRST_DARTS, FillOptions, Ground, Kinds, Layer, Open, PROBES_IN_CUBE, Point, Zone, fill_zone, open_share,
    random_point, throw,
};
use crate::psp::fragment::Facing;
use crate::psp::given::Obstacles;
use crate::psp::set::{OctaveCube, Sample};
use crate::rng::{Draw, Rng};

/// A surface whose radius varies, at the scale of one fill.
#[derive(Clone, Copy)]
pub struct GradedSurface<'a> {
    pub mesh: &'a Mesh,
    pub field: &'a RadiusField<'a>,
    pub quota: &'a Quota,
    pub facing: Facing,
    pub triangles: &'a MeasuredTriangles<'a>,
    /// The finest scale that is expected.
    pub finest: f64,
}

impl GradedSurface<'_> {
    /// The number of pieces for the work limit: those of a cube, and at a scale coarser than the finest as many as
    /// there will be samples on them. Radii are steeper there by as much as samples are fewer.
    pub fn limit(&self, cube: &CubeOfPieces) -> u64 {
        let growth = square(self.field.scale() / self.finest);
        let samples: f64 = cube.pieces.iter().map(|piece| piece.area()).sum();
        cube.pieces.len() as u64 + if growth > 1.0 { (growth * samples) as u64 } else { 0 }
    }
}

/// A surface to be filled with samples whose radii vary by one field: of one kind, or of several classes.
pub trait GradedSite: Kinds {
    type Ground<'a>: Ground<Sample = (Sample, f64)>
    where
        Self: 'a;

    fn surface(&self) -> &GradedSurface<'_>;

    /// The scale that the cubes are made for.
    fn scale_of_cubes(&self) -> f64;

    /// The largest scale at which a sample matters to another one.
    fn reach(&self) -> f64;

    /// True if all of it is certainly open before the fill.
    fn is_bare(&self) -> bool;

    /// The surface in a cube, with the samples that are given.
    fn ground(&self, cube: &CubeOfPieces) -> Self::Ground<'_>;

    /// Adds a sample that is there already.
    fn add(ground: &mut Self::Ground<'_>, sample: &(Sample, f64));

    /// The values of a place to a kind.
    fn local<'a>(kind: Self::Kind, bounds: RadiusBounds) -> LocalOf<'a, Self>
    where
        Self: 'a;

    /// The ground for the samples of one kind, with their radii.
    fn layer<'g>(ground: &'g Self::Ground<'_>, kind: Self::Kind) -> &'g GradedGround<'g>;

    /// The open parts of a kind's layer that are open to the kind on the whole ground.
    fn narrowed<'a>(ground: &Self::Ground<'a>, kind: Self::Kind, open: Open<RadiusBounds>) -> Open<LocalOf<'a, Self>>
    where
        Self: 'a;
}

/// The values that a fill keeps for a place.
type LocalOf<'a, S> = <<S as GradedSite>::Ground<'a> as Ground>::Local;

/// Fills a surface around some samples. Returns a maximal set with these, and the number of darts.
pub fn fill_octaves<S: GradedSite>(
    job: &Job,
    site: &S,
    options: FillOptions,
    samples: &[(Sample, f64)],
) -> Result<(AdaptiveSet, u64)> {
    let &GradedSurface { mesh, field, quota, triangles, .. } = site.surface();
    let mut set = AdaptiveSet::new(mesh, options.seed, site.scale_of_cubes(), samples);
    triangles.begin_level(samples.len(), options.throws_first);
    let stretch = (site.reach() / site.scale_of_cubes()).max(1.0);
    let pieces = pieces(&job.part(0.05, 0.2), triangles, field, quota, &set.cubes)?;
    field.check()?;
    quota.check(field.argument())?;
    let cubes: Vec<OctaveCube> = (0..pieces.len()).map(|number| pieces.key(number)).collect();
    let darts = set.grow(&job.part(0.2, 1.0), &cubes, |number, set| {
        let cube = CubeOfPieces::new(mesh, field, pieces.items(number).collect());
        let mut ground = site.ground(&cube);
        set.each_around(cubes[number], stretch, |sample| S::add(&mut ground, sample));
        let mut rng = Rng::at(options.seed, Draw::Adaptive, &cubes[number].key());
        // Without first darts no random point is asked for.
        let weighed = if options.throws_first { &cube.pieces[..] } else { &[] };
        let areas = Weights::new(weighed.iter().map(|piece| piece.area()).collect());
        let mut zone = CubeZone { site, pieces: &cube.pieces, areas };
        let share = open_share(&mut zone, &ground, options, &mut rng);
        fill_zone(&mut zone, &mut ground, share, options, &mut rng)?;
        site.kinds().iter().try_for_each(|&kind| S::layer(&ground, kind).check())?;
        quota.check(field.argument()).map(|()| ground.into_accepted())
    })?;
    triangles.end_level(set.len());
    Ok((set, darts))
}

/// Samples of one kind, around given ones.
pub struct OneKind<'a> {
    pub surface: GradedSurface<'a>,
    pub obstacles: &'a Obstacles,
    /// The largest rank of the samples that are added, if they get ranks.
    pub largest_rank: Option<f64>,
}

impl Alike for OneKind<'_> {}

impl GradedSite for OneKind<'_> {
    type Ground<'b>
        = GradedGround<'b>
    where
        Self: 'b;

    fn surface(&self) -> &GradedSurface<'_> {
        &self.surface
    }

    fn scale_of_cubes(&self) -> f64 {
        self.surface.field.scale()
    }

    fn reach(&self) -> f64 {
        self.largest_rank.unwrap_or(0.0)
    }

    fn is_bare(&self) -> bool {
        self.obstacles.is_empty()
    }

    fn ground(&self, cube: &CubeOfPieces) -> GradedGround<'_> {
        let scale = self.surface.field.scale();
        GradedGround::new(&self.surface, cube, scale, self.obstacles, self.largest_rank)
    }

    fn add(ground: &mut GradedGround, sample: &(Sample, f64)) {
        ground.add(sample);
    }

    fn local<'b>((): (), bounds: RadiusBounds) -> RadiusBounds
    where
        Self: 'b,
    {
        bounds
    }

    fn layer<'g>(ground: &'g GradedGround<'_>, (): ()) -> &'g GradedGround<'g> {
        ground
    }

    fn narrowed<'b>(_: &GradedGround<'b>, (): (), open: Open<RadiusBounds>) -> Open<RadiusBounds>
    where
        Self: 'b,
    {
        open
    }
}

/// The pieces of a cube, and what the grids of samples around it depend on.
pub struct CubeOfPieces<'a> {
    pub pieces: Vec<&'a Piece>,
    /// The box of the pieces.
    pub bounds: [DVec3; 2],
    /// The usual and the largest radius on them.
    pub radii: [f64; 2],
}

impl<'a> CubeOfPieces<'a> {
    fn new(mesh: &Mesh, field: &RadiusField, pieces: Vec<&'a Piece>) -> Self {
        let largest = field.above(pieces.iter().map(|piece| piece.bounds().largest).fold(0.0, f64::max));
        // The area over the number of samples that will lie on it gives their usual radius.
        let samples: f64 = pieces.iter().map(|piece| piece.area()).sum();
        let area: f64 = pieces.iter().map(|piece| piece.area() / piece.bounds().density()).sum();
        let usual = if samples > 0.0 { (area / samples).sqrt() } else { largest };
        let corners = pieces.iter().flat_map(|piece| match piece {
            Piece::Whole(whole) => mesh.exact_corners(whole.triangle),
            Piece::Part(part) => part.fragment.corners.map(|corner| mesh.point_exact(part.fragment.triangle, corner)),
        });
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = corners.fold(none, |[low, high], corner| [low.min(corner), high.max(corner)]);
        Self { pieces, bounds, radii: [usual, largest] }
    }
}

/// The surface in a cube, as it is filled.
struct CubeZone<'a, S> {
    site: &'a S,
    pieces: &'a [&'a Piece],
    areas: Weights,
}

impl<'a, S: GradedSite> CubeZone<'a, S> {
    /// A random point, and the kind that it is for.
    fn random_point(&self, rng: &mut Rng) -> (Point<LocalOf<'a, S>>, S::Kind) {
        let piece = &self.pieces[self.areas.pick(rng) as usize];
        let (fragment, barycentrics) = (piece.fragment(), piece.fragment().at(random_point(rng)));
        let kind = self.site.random_kind(rng);
        (Point { triangle: fragment.triangle, barycentrics, local: S::local(kind, piece.bounds()) }, kind)
    }
}

impl<'a, S: GradedSite> Zone for CubeZone<'a, S> {
    type Ground = S::Ground<'a>;

    fn is_bare(&self) -> bool {
        self.site.is_bare()
    }

    fn probes(&self) -> usize {
        PROBES_IN_CUBE
    }

    /// The area, in squared radii.
    fn area(&self) -> f64 {
        self.areas.total()
    }

    fn point(&mut self, rng: &mut Rng) -> Point<LocalOf<'a, S>> {
        self.random_point(rng).0
    }

    fn throw_first(&mut self, ground: &mut S::Ground<'a>, rng: &mut Rng) -> Result<()> {
        let expected = self.site.kinds().len() as f64 * FIRST_DARTS * self.areas.total();
        let darts = (expected + rng.unit()) as usize;
        let random = (0..darts).map(|_| self.random_point(rng));
        let allowed = random.filter(|&(ref point, kind)| self.site.allows(kind, point.triangle));
        throw(ground, allowed.map(|(point, _)| point));
        Ok(())
    }

    fn open(&self, ground: &S::Ground<'a>) -> Result<Open<LocalOf<'a, S>>> {
        let (site, mut open) = (self.site, Open::default());
        for &kind in site.kinds() {
            let allowed = self.pieces.iter().filter(|piece| site.allows(kind, piece.fragment().triangle));
            let of_kind = S::layer(ground, kind).open_pieces(allowed.copied());
            open.append(&mut S::narrowed(ground, kind, of_kind));
        }
        Ok(open)
    }
}
