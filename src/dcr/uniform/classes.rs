//! Several classes relaxed at once: the momentum method with the constraints of the union of all points, and of each
//! class by itself.
//!
//! Each of these sets has a torus of its own spacing, a triangulation of its own, and long waves of its own. A point
//! moves by the sum of the forces in the two sets that it belongs to. They cannot all come to rest: a hexagonal lattice
//! divides into three or four hexagonal ones, but not into two or five, and with the radii of a single set
//! ([`Constraints::of_step`]) all points are pulled to and fro. So the constraints are weaker here, and the set that is
//! returned is the last.

use std::ops::Range;

use glam::Vec2;

use crate::classes::Classes;
use crate::dcr::law::{Constraints, FREE_CLEARANCE, Force, Neighbourhood};
use crate::dcr::relaxation::{
    DelaunayOptions, PlaneRelaxation, Relaxation, Report, Steps, Stopped, measure, relax_set, require_points,
};
use crate::dcr::torus::{CurveOrder, LEVEL, MirrorBoundary, Torus, TorusPoint, WaveGrid, leveled};
use crate::dcr::uniform::flip_mesh::FlipMesh;
use crate::dcr::uniform::rings::{Edge, Rings};
use crate::dcr::uniform::stars::{Gathered, Visitor};
use crate::dcr::uniform::{
    FIRST_FREE, JAMMED, KICK_EVERY, LAST_KICK, UniformRelaxation, WAVES_EVERY, highest_wave, kick,
};
use crate::error::{Error, Result};
use crate::geometry::Delaunay;
use crate::job::{Context, Job, Progress, chunks};
use crate::points::{Boundary, Domain};
use crate::simd::Level;

/// The peak memory for a point and all of its data, in the union and in its class; where it has images.
const BYTES_PER_POINT: f64 = 520.0;
const BYTES_PER_MIRRORED_POINT: f64 = 1900.0;

/// The shares of the forces and waves of the union and of the classes. With larger shares for the classes, these
/// improve by as much as the union gets worse.
const OF_UNION: f32 = 0.65;
const OF_CLASS: f32 = 1.0 - OF_UNION;

/// The constraints of the union and of each class, in spacings. With those of single sets, 0.862 and 0.66, the smallest
/// distances end 0.02 to 0.07 lower, that of the union of seven classes too, and covering radii 0.01 to 0.04 larger.
const CONFLICT_RADIUS: f32 = 0.793;
const COVERAGE_RADIUS: f32 = 0.717;

/// All points, or those of one class.
struct Subset {
    /// The points, in the order of the curve.
    members: Vec<u32>,
    torus: Torus,
    boundary: Option<MirrorBoundary>,
    waves: WaveGrid,
    /// The positions of the members, and after them their images.
    places: Vec<TorusPoint>,
    /// The triangulation, where one can be kept.
    mesh: Option<FlipMesh>,
    /// The edges of the mesh that may have to be flipped after the last step.
    suspects: Vec<Edge>,
    /// The spacing, in units of that of the union.
    spacing: f32,
    /// The share of its forces in the displacement of a point.
    weight: f32,
}

/// The forces on a range of members.
#[derive(Default)]
struct Gathering {
    forces: Vec<Force>,
    suspects: Vec<Edge>,
    is_unsound: bool,
}

/// The parts of a step.
struct Sums {
    /// The force on each point, by all of its subsets.
    forces: Vec<Force>,
    /// The displacement of each by long waves.
    drifts: Vec<Vec2>,
    /// The edges of each subset that may have to be flipped.
    suspects: Vec<Vec<Edge>>,
}

impl Visitor for Gathering {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, gathered: &Gathered) {
        self.is_unsound |= !gathered.are_sound(points.len());
        gathered.suspects(rings, points.clone(), &mut self.suspects);
        let [x, y] = gathered.force;
        self.forces.extend(
            (0..points.len())
                .map(|lane| Force { sum: Vec2::new(x[lane], y[lane]), clearance: gathered.clearance[lane] }),
        );
    }
}

impl Subset {
    fn new(domain: Domain, members: Vec<u32>, of: usize, weight: f32) -> Self {
        let torus = Torus::new(domain, members.len());
        let boundary = MirrorBoundary::new(&torus, Neighbourhood::Delaunay);
        Self {
            waves: WaveGrid::new(&torus, boundary, members.len()),
            boundary,
            places: Vec::new(),
            mesh: None,
            suspects: Vec::new(),
            spacing: (of as f32 / members.len() as f32).sqrt(),
            weight,
            torus,
            members,
        }
    }

    /// Updates the places of the members from those of all points.
    fn follow(&mut self, places: &[TorusPoint]) {
        let own: Vec<TorusPoint> = self.members.iter().map(|&point| places[point as usize]).collect();
        self.places = self.torus.with_images(&own);
    }

    /// The displacements of the members by long waves.
    fn drift(&self, job: &Job, iteration: u32) -> Result<Vec<Vec2>> {
        let mut drift = self.waves.drift(job, &self.places, self.members.len(), highest_wave(iteration))?;
        if let Some(boundary) = &self.boundary {
            boundary.calm(iteration, &self.places, &mut drift);
        }
        Ok(drift)
    }

    fn triangulate(&self, job: &Job) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(&self.places).into_iter())
    }

    /// The forces on the members, and the edges that may have to be flipped.
    fn gather(&mut self, job: &Job, constraints: &Constraints) -> Result<Gathering> {
        if self.mesh.is_none() {
            self.mesh = FlipMesh::new(&job.part(0.0, 0.5), &self.torus, &self.places)?;
        }
        let mut all = match &self.mesh {
            Some(mesh) => {
                // Images exert no force of their own, but their edges are flipped with the others.
                let chunks = chunks(self.places.len());
                let parts = job.part(0.5, 0.9).map(chunks.len(), |chunk| {
                    let mut gathering = Gathering::default();
                    mesh.gather(Level::widest(), &self.places, constraints, chunks.range(chunk), &mut gathering);
                    gathering
                })?;
                parts.into_iter().fold(Gathering::default(), |mut all, part| {
                    all.forces.extend(part.forces);
                    all.suspects.extend(part.suspects);
                    all.is_unsound |= part.is_unsound;
                    all
                })
            }
            None => Gathering { is_unsound: true, ..Gathering::default() },
        };
        // Points that are free may turn triangles over.
        if self.mesh.take_if(|mesh| !mesh.holds_back()).is_some() {
            all.suspects.clear();
            all.forces.iter_mut().for_each(|force| force.clearance = FREE_CLEARANCE);
        }
        if all.is_unsound {
            self.mesh = None;
            all = self.gather_anew(&job.part(0.9, 1.0), constraints)?;
        }
        all.forces.truncate(self.members.len());
        if let Some(boundary) = &self.boundary {
            for (force, &place) in all.forces.iter_mut().zip(&self.places) {
                force.sum = boundary.force(constraints, place, force.sum);
            }
        }
        Ok(all)
    }

    /// The same forces by a triangulation for this step.
    fn gather_anew(&self, job: &Job, constraints: &Constraints) -> Result<Gathering> {
        let delaunay = self.triangulate(job)?;
        let mut ring = Vec::new();
        let forces = (0..self.members.len()).map(|point| {
            ring.clear();
            ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
            Force { sum: constraints.force(&ring).sum, clearance: FREE_CLEARANCE }
        });
        Ok(Gathering { forces: forces.collect(), ..Gathering::default() })
    }
}

/// The points, their velocities, and the sets that they form.
pub struct ClassRelaxation {
    domain: Domain,
    seed: u64,
    /// The class of each point, in the user's order.
    classes: Vec<u32>,
    order: CurveOrder,
    /// The union first, then the classes of several points.
    subsets: Vec<Subset>,
    places: Vec<TorusPoint>,
    velocities: Vec<Vec2>,
}

impl ClassRelaxation {
    /// The points before the first step; `classes` has the class of each.
    pub fn new(domain: Domain, seed: u64, points: &[[f32; 2]], classes: &[u32]) -> Self {
        let torus = Torus::new(domain, points.len());
        let order = CurveOrder::new(&torus, points, seed);
        Self {
            subsets: subsets(domain, &order, classes),
            places: order.start().to_vec(),
            velocities: vec![Vec2::ZERO; order.len()],
            classes: classes.to_vec(),
            domain,
            seed,
            order,
        }
    }

    /// Levels those subsets that are clustered, one by one.
    fn level(&mut self, job: &Job, subsets: Range<usize>) -> Result<()> {
        let (mut places, mut is_clustered) = (self.places.clone(), false);
        for (part, i) in subsets.clone().enumerate() {
            let job = job.part(part as f64 / subsets.len() as f64, (part + 1) as f64 / subsets.len() as f64);
            let subset = &mut self.subsets[i];
            subset.follow(&places);
            if let Some(leveled) = leveled(&job, &subset.torus, &subset.waves, &subset.places, &LEVEL, self.seed)? {
                subset.members.iter().zip(leveled).for_each(|(&point, place)| places[point as usize] = place);
                is_clustered = true;
            }
        }
        if is_clustered {
            (self.order, self.places) = self.order.reordered(&self.space().parted(&places, self.seed));
            self.subsets = self::subsets(self.domain, &self.order, &self.classes);
        }
        Ok(())
    }

    fn gather(&mut self, job: &Job, iteration: u32) -> Result<Sums> {
        let (conflict_radius, coverage_radius) = (CONFLICT_RADIUS, COVERAGE_RADIUS);
        let constraints = Constraints { conflict_radius, coverage_radius, ..Constraints::of_step(iteration) };
        let mut forces = vec![Force { clearance: f32::INFINITY, ..Force::default() }; self.places.len()];
        let mut drifts = vec![Vec2::ZERO; self.places.len()];
        let mut suspects = Vec::with_capacity(self.subsets.len());
        let parts = self.subsets.len() as f64;
        for (i, subset) in self.subsets.iter_mut().enumerate() {
            let job = job.part(i as f64 / parts, (i + 1) as f64 / parts);
            subset.follow(&self.places);
            let scale = subset.weight * subset.spacing;
            if iteration.is_multiple_of(WAVES_EVERY) {
                let drift = subset.drift(&job.part(0.0, 0.4), iteration)?;
                subset.members.iter().zip(drift).for_each(|(&point, drift)| drifts[point as usize] += scale * drift);
            }
            let gathered = subset.gather(&job.part(0.4, 1.0), &constraints)?;
            for (&point, force) in subset.members.iter().zip(&gathered.forces) {
                let sum = &mut forces[point as usize];
                sum.sum += scale * force.sum;
                sum.clearance = sum.clearance.min(subset.spacing * force.clearance);
            }
            suspects.push(gathered.suspects);
        }
        Ok(Sums { forces, drifts, suspects })
    }
}

/// The union first, then the classes of several points.
fn subsets(domain: Domain, order: &CurveOrder, classes: &[u32]) -> Vec<Subset> {
    let count = order.len();
    let mut members = vec![Vec::new(); classes.iter().max().map_or(0, |&last| last as usize + 1)];
    (0..count as u32).for_each(|point| members[classes[order.user(point)] as usize].push(point));
    let of_class = members.into_iter().filter(|members| members.len() > 1);
    let of_class = of_class.map(|members| Subset::new(domain, members, count, OF_CLASS));
    std::iter::once(Subset::new(domain, (0..count as u32).collect(), count, OF_UNION)).chain(of_class).collect()
}

impl Relaxation for ClassRelaxation {
    type Position = TorusPoint;
    type Space = Torus;

    fn space(&self) -> Torus {
        self.subsets[0].torus
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = TorusPoint> {
        self.places.iter().copied()
    }

    fn begin(&mut self, job: &Job) -> Result<()> {
        self.level(&job.part(0.0, 0.5), 1..self.subsets.len())?;
        self.level(&job.part(0.5, 1.0), 0..1)
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        let Sums { forces, drifts, suspects } = self.gather(&job.part(0.0, 0.8), iteration)?;
        let torus = self.space();
        let frees = iteration.is_multiple_of(KICK_EVERY) && (FIRST_FREE..=LAST_KICK).contains(&iteration);
        let mut is_torn = false;
        let points = self.places.iter_mut().zip(&mut self.velocities).zip(forces.into_iter().zip(drifts)).enumerate();
        for (point, ((place, velocity), (mut sum, drift))) in points {
            if frees && sum.clearance < JAMMED {
                sum.sum += kick(iteration, point);
                sum.clearance = FREE_CLEARANCE;
                is_torn = true;
            }
            let displacement;
            (displacement, *velocity) = sum.moves(*velocity, drift);
            *place = torus.moved(*place, displacement);
        }
        for (subset, suspects) in self.subsets.iter_mut().zip(suspects) {
            subset.suspects = suspects;
            subset.mesh = subset.mesh.take().filter(|_| !is_torn);
        }
        Ok(())
    }

    fn follow(&mut self, job: &Job) -> Result<()> {
        let parts = self.subsets.len() as f64;
        for (i, subset) in self.subsets.iter_mut().enumerate() {
            let job = job.part(0.8 + 0.2 * i as f64 / parts, 0.8 + 0.2 * (i + 1) as f64 / parts);
            subset.follow(&self.places);
            if let Some(mut mesh) = subset.mesh.take() {
                let suspects = std::mem::take(&mut subset.suspects);
                subset.mesh = mesh.mend(&job, &subset.places, suspects)?.then_some(mesh);
            }
        }
        Ok(())
    }

    fn finish(&mut self, _: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            self.places = self.order.given().to_vec();
        }
        Ok(())
    }
}

impl PlaneRelaxation for ClassRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.space(), &self.places, points)
    }

    fn covering_radius(&mut self, job: &Job) -> Result<f64> {
        let union = &mut self.subsets[0];
        union.follow(&self.places);
        Ok(union.triangulate(job)?.covering_radius() * union.torus.frame.spacing())
    }
}

/// The figures of one class after [`relax_classes`]. The unit d_max is that of a set of its points alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClassReport {
    /// The number of its points.
    pub count: usize,
    /// The smallest distance between two of its points, in units of d_max; infinite for less than two.
    pub rho: f64,
    /// The largest distance of a position in the domain from its points, in units of d_max; infinite for no point.
    pub relative_covering_radius: f64,
}

/// Relaxes points of several classes: spread more evenly are the union of all, and each class by itself. Returns as
/// many points, in the same order, the report of the union, and one for each class up to the highest.
///
/// `classes` has the class of each point, below [`Classes::MOST`]; they may be of any number and density, as in sets
/// of [`kdrt`](crate::kdrt::Options::classes). They cannot all be as even as the set of a single class: a good
/// lattice does not divide into good lattices. From maximal sets of 2 to 7 classes of a periodic domain, rho ends above
/// 0.7 and the coverage below 0.82, those of the union and those of each class; before, some classes cover 1 or more.
/// Where the points of a class are crowded in some places and missing in others it is levelled before the first step.
/// No distance between points of two classes is promised.
///
/// The method is always momentum with Delaunay neighbours. The set after the last whole step is returned; it converges
/// if its motion ends, which mostly does not happen within 100 steps. The points are the same for every number of
/// threads.
///
/// About 2.5 times the time of [`relax`](fn@crate::dcr::relax) and its memory.
///
/// # Errors
/// [`Error::InvalidArgument`] as [`relax`](fn@crate::dcr::relax), and for classes of
/// another number than that of the points, and for one that is too high (`classes`, with its index);
/// [`Error::TooLarge`](crate::Error::TooLarge).
pub fn relax_classes(
    context: &Context,
    options: &DelaunayOptions,
    points: &[[f32; 2]],
    classes: &[u32],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report, Vec<ClassReport>)> {
    options.check()?;
    options.domain.check_points(points)?;
    if classes.len() != points.len() {
        return Err(Error::invalid("classes", format!("{} for {} points", classes.len(), points.len())));
    }
    if let Some(index) = classes.iter().position(|&class| class as usize >= Classes::MOST) {
        let reason = format!("[{index}] is {}, not below {}", classes[index], Classes::MOST);
        return Err(Error::invalid("classes", reason));
    }
    let bytes = match options.domain.boundary {
        Boundary::Periodic => BYTES_PER_POINT,
        Boundary::Bounded => BYTES_PER_MIRRORED_POINT,
    };
    require_points("positions", points.len(), bytes)?;
    let mut set = ClassRelaxation::new(options.domain, options.seed, points, classes);
    let (relaxed, report) = relax_set(context, &options.domain, options.limits(), points, &mut set, progress, None)?;
    let count = classes.iter().max().map_or(0, |&last| last + 1);
    let reports =
        (0..count).map(|class| of_class(context, options, &relaxed, classes, class)).collect::<Result<_>>()?;
    Ok((relaxed, report, reports))
}

/// The figures of one class.
fn of_class(
    context: &Context,
    options: &DelaunayOptions,
    points: &[[f32; 2]],
    classes: &[u32],
    class: u32,
) -> Result<ClassReport> {
    let own = points.iter().zip(classes).filter(|&(_, &of)| of == class);
    let own: Vec<[f32; 2]> = own.map(|(&point, _)| point).collect();
    let mut set = UniformRelaxation::new(options.domain, Neighbourhood::Delaunay, options.seed, &own);
    let steps = Steps { iterations: 0, stopped: Stopped::Steps, motion: 0.0 };
    let (_, report) = context.run(None, |job| measure(job, &options.domain, &own, &mut set, steps))?;
    Ok(ClassReport { count: own.len(), rho: report.rho, relative_covering_radius: report.relative_covering_radius })
}
