//! Classes whose radii vary over the surface by one field: each layer has the radii of the field times its own.

use crate::classes::Classes;
use crate::error::Result;
use crate::job::Job;
use crate::math::square;
use crate::mesh::Mesh;
use crate::order::Order;
use crate::psp::adaptive::{
    CubeOfPieces, DensityField, FARTHEST, GradedGround, GradedSite, GradedSurface, MeasuredTriangles, Quota, Radius,
    RadiusBounds, RadiusField, Scale, checked_count, checked_samples, fill_octaves,
};
use crate::psp::classes::ground::ClassGround;
use crate::psp::classes::site::{Classed, Group, Places, Unit};
use crate::psp::fill::{FillOptions, Kinds, Open};
use crate::psp::set::Sample;
use crate::rng::Rng;

/// Peak memory for each sample that the classes would have alone; in progressive order.
const BYTES_PER_SAMPLE: f64 = 265.0;
const BYTES_PER_RANKED_SAMPLE: f64 = 850.0;

/// A radius that classes have multiples of, as the caller gives it.
pub struct VaryingRadius<'a> {
    mesh: &'a Mesh,
    radius: Radius<'a>,
    density: Option<(DensityField<'a>, Scale)>,
    /// The least multiple, with which the radius must not be too small for floats.
    least: f64,
}

impl<'a> VaryingRadius<'a> {
    /// Checks what can be checked without work.
    pub fn new(mesh: &'a Mesh, radius: Radius<'a>, classes: &Classes) -> Result<Self> {
        if let Radius::Density { scale, .. } = radius {
            checked_count(scale, Order::Any)?;
        }
        let least = classes.radii().iter().copied().filter(|&radius| radius > 0.0).fold(f64::INFINITY, f64::min);
        let checked = Self { mesh, radius, density: DensityField::of(mesh, radius)?, least };
        if checked.density.is_none() {
            RadiusField::new(mesh, radius, None, least)?;
        }
        Ok(checked)
    }

    /// The radius on the mesh, at the scale 1.
    pub fn field(&self, job: &Job) -> Result<RadiusField<'_>> {
        let density = match &self.density {
            Some((density, scale)) => Some((density, density.unit(job, *scale)?)),
            None => None,
        };
        Ok(RadiusField::new(self.mesh, self.radius, density, self.least)?.at_scale(1.0))
    }
}

/// A unit that varies.
#[derive(Clone, Copy)]
pub struct Varying<'a> {
    pub field: &'a RadiusField<'a>,
    pub triangles: &'a MeasuredTriangles<'a>,
    /// The approximate number of samples of one class of radius 1.
    pub estimate: f64,
}

impl<'a> Varying<'a> {
    /// The unit of some classes. Refuses radii that require more samples than memory holds.
    pub fn new(
        job: &Job,
        field: &'a RadiusField<'a>,
        triangles: &'a MeasuredTriangles<'a>,
        classes: &Classes,
        is_ranked: bool,
    ) -> Result<Self> {
        // The radius of one class that has as many samples as all of them, each by itself.
        let density: f64 = (0..classes.count()).map(|class| 1.0 / square(classes.own(class))).sum();
        let bytes = if is_ranked { BYTES_PER_RANKED_SAMPLE } else { BYTES_PER_SAMPLE };
        let all = checked_samples(job, triangles.mesh, &field.at_scale(1.0 / density.sqrt()), bytes)?;
        Ok(Self { field, triangles, estimate: all / density })
    }
}

impl Unit for Varying<'_> {
    type Sample = (Sample, f64);

    fn expected_samples(&self, _: &Mesh, radius: f64) -> f64 {
        self.estimate / square(radius)
    }

    fn least(&self) -> f64 {
        self.field.least()
    }

    fn fill(
        group: &Group<Self>,
        job: &Job,
        samples: Vec<(Sample, f64)>,
        options: FillOptions,
    ) -> Result<(Vec<(Sample, f64)>, u64)> {
        let Places { mesh, facing, .. } = group.places;
        let Varying { field, triangles, .. } = group.unit;
        let (field, quota) = (&field.at_scale(group.radius), &Quota::new(group.expected_samples(), mesh));
        let surface = GradedSurface { mesh, field, quota, facing, triangles, finest: group.finest };
        let (set, darts) = fill_octaves(job, &GradedGroup { group, surface }, options, &samples)?;
        Ok((set.into_samples(), darts))
    }
}

/// A group on the surface of one fill.
struct GradedGroup<'a> {
    group: &'a Group<'a, Varying<'a>>,
    surface: GradedSurface<'a>,
}

impl Kinds for GradedGroup<'_> {
    type Kind = Classed;

    fn kinds(&self) -> &[Classed] {
        self.group.kinds()
    }

    fn random_kind(&self, rng: &mut Rng) -> Classed {
        self.group.random_kind(rng)
    }

    fn allows(&self, member: Classed, triangle: u32) -> bool {
        self.group.allows(member, triangle)
    }
}

/// The classes of a group with varying radii.
type GradedClasses<'a> = ClassGround<'a, GradedGround<'a>>;

impl GradedSite for GradedGroup<'_> {
    type Ground<'b>
        = GradedClasses<'b>
    where
        Self: 'b;

    fn surface(&self) -> &GradedSurface<'_> {
        &self.surface
    }

    fn scale_of_cubes(&self) -> f64 {
        self.group.radius_of_cubes(FARTHEST)
    }

    fn reach(&self) -> f64 {
        self.group.reach()
    }

    fn is_bare(&self) -> bool {
        false
    }

    fn ground(&self, cube: &CubeOfPieces) -> GradedClasses<'_> {
        ClassGround::new(self.group, |layer, radius| {
            let largest_rank = self.group.largest_rank_in(layer);
            GradedGround::new(&self.surface, cube, radius, self.group.obstacles(layer), largest_rank)
        })
    }

    fn add(ground: &mut GradedClasses, sample: &(Sample, f64)) {
        ground.add(sample);
    }

    fn local<'b>(Classed { class, .. }: Classed, bounds: RadiusBounds) -> Classed<RadiusBounds>
    where
        Self: 'b,
    {
        Classed { class, local: bounds }
    }

    fn layer<'g>(ground: &'g GradedClasses<'_>, member: Classed) -> &'g GradedGround<'g> {
        ground.own(member.class)
    }

    fn narrowed<'b>(
        ground: &GradedClasses<'b>,
        member: Classed,
        open: Open<RadiusBounds>,
    ) -> Open<Classed<RadiusBounds>>
    where
        Self: 'b,
    {
        ground.open_in_all(member.class, &open)
    }
}
