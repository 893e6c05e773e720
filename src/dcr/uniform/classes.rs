//! Several classes relaxed at once: the momentum method with the constraints of the union of all points, and of each
//! class by itself.
//!
//! Each of these sets has a torus of its own spacing, a triangulation of its own, and long waves of its own. A point
//! moves by the sum of the forces in the two sets that it belongs to. They cannot all come to rest: a hexagonal lattice
//! divides into three or four hexagonal ones, but not into two or five, and with the radii of a single set
//! (`ground/constraints.rs`) all points are pulled to and fro. So the constraints are weaker here, and the set that is
//! returned is the last.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::boundary::MirrorBoundary;
use crate::dcr::ground::constraints::{Constraints, FREE_CLEARANCE, MOMENTUM, SAFE_FRACTION};
use crate::dcr::ground::curve::CurveOrder;
use crate::dcr::ground::level::{LEVEL, leveled};
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::ground::waves::WaveGrid;
use crate::dcr::options::Neighbourhood;
use crate::dcr::relax::PlaneRelaxation;
use crate::dcr::relaxation::Relaxation;
use crate::dcr::uniform::flip_mesh::{Edge, FlipMesh};
use crate::dcr::uniform::gather::{JAMMED, kick, limited};
use crate::dcr::uniform::relaxation::{FIRST_FREE, KICK_EVERY, LAST_KICK, WAVES_EVERY, highest_wave};
use crate::dcr::uniform::rings::Rings;
use crate::dcr::uniform::stars::{Gathered, Visitor};
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::job::{Job, chunks};
use crate::points::Domain;
use crate::simd::Level;

/// The shares of the forces and waves of the union and of the classes. With more for the classes they get better by as
/// much as the union gets worse.
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
    /// Where the members are, and after them their images.
    places: Vec<TorusPoint>,
    /// The triangulation, where one can be kept.
    mesh: Option<FlipMesh>,
    /// The spacing, in those of the union.
    spacing: f32,
    /// The share of its forces in the displacement of a point.
    weight: f32,
}

/// What acts on a point, in spacings.
#[derive(Clone, Copy, Default)]
struct Pull {
    force: Vec2,
    clearance: f32,
}

/// What a range of members gathers.
#[derive(Default)]
struct Gathering {
    pulls: Vec<Pull>,
    suspects: Vec<Edge>,
    is_unsound: bool,
}

/// What a step is made of.
struct Sums {
    /// What acts on each point, by all of its subsets.
    pulls: Vec<Pull>,
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
        self.pulls.extend(
            (0..points.len())
                .map(|lane| Pull { force: Vec2::new(x[lane], y[lane]), clearance: gathered.clearance[lane] }),
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
            spacing: (of as f32 / members.len() as f32).sqrt(),
            weight,
            torus,
            members,
        }
    }

    /// Takes the places of the members from those of all points.
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

    /// What acts on the members, and the edges that may have to be flipped.
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
                    all.pulls.extend(part.pulls);
                    all.suspects.extend(part.suspects);
                    all.is_unsound |= part.is_unsound;
                    all
                })
            }
            None => Gathering { is_unsound: true, ..Gathering::default() },
        };
        if all.is_unsound {
            self.mesh = None;
            all = self.gather_anew(&job.part(0.9, 1.0), constraints)?;
        }
        all.pulls.truncate(self.members.len());
        if let Some(boundary) = &self.boundary {
            for (pull, &place) in all.pulls.iter_mut().zip(&self.places) {
                pull.force = boundary.force(constraints, place, pull.force);
            }
        }
        Ok(all)
    }

    /// The same by a triangulation for this step.
    fn gather_anew(&self, job: &Job, constraints: &Constraints) -> Result<Gathering> {
        let delaunay = self.triangulate(job)?;
        let mut ring = Vec::new();
        let pulls = (0..self.members.len()).map(|point| {
            ring.clear();
            ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
            Pull { force: constraints.force(&ring).sum, clearance: FREE_CLEARANCE }
        });
        Ok(Gathering { pulls: pulls.collect(), ..Gathering::default() })
    }
}

/// The points, their velocities, and the sets that they form.
pub(in crate::dcr) struct ClassRelaxation {
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
    pub(in crate::dcr) fn new(domain: Domain, seed: u64, points: &[[f32; 2]], classes: &[u32]) -> Self {
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

    /// Levels some of the subsets, if they are heaped, one by one.
    fn level(&mut self, job: &Job, subsets: Range<usize>) -> Result<()> {
        let (mut places, mut is_heaped) = (self.places.clone(), false);
        for (part, i) in subsets.clone().enumerate() {
            let job = job.part(part as f64 / subsets.len() as f64, (part + 1) as f64 / subsets.len() as f64);
            let subset = &mut self.subsets[i];
            subset.follow(&places);
            if let Some(leveled) = leveled(&job, &subset.torus, &subset.waves, &subset.places, &LEVEL, self.seed)? {
                subset.members.iter().zip(leveled).for_each(|(&point, place)| places[point as usize] = place);
                is_heaped = true;
            }
        }
        if is_heaped {
            (self.order, self.places) = self.order.reordered(&self.space().parted(&places, self.seed));
            self.subsets = self::subsets(self.domain, &self.order, &self.classes);
        }
        Ok(())
    }

    fn gather(&mut self, job: &Job, iteration: u32) -> Result<Sums> {
        let (conflict_radius, coverage_radius) = (CONFLICT_RADIUS, COVERAGE_RADIUS);
        let constraints = Constraints { conflict_radius, coverage_radius, ..Constraints::of_step(iteration) };
        let mut sums = vec![Pull { clearance: f32::INFINITY, ..Pull::default() }; self.places.len()];
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
            for (&point, pull) in subset.members.iter().zip(&gathered.pulls) {
                let sum = &mut sums[point as usize];
                sum.force += scale * pull.force;
                sum.clearance = sum.clearance.min(subset.spacing * pull.clearance);
            }
            suspects.push(gathered.suspects);
        }
        Ok(Sums { pulls: sums, drifts, suspects })
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
        let Sums { pulls, drifts, suspects } = self.gather(&job.part(0.0, 0.8), iteration)?;
        let torus = self.space();
        let frees = iteration.is_multiple_of(KICK_EVERY) && (FIRST_FREE..=LAST_KICK).contains(&iteration);
        let mut is_torn = false;
        let points = self.places.iter_mut().zip(&mut self.velocities).zip(pulls.into_iter().zip(drifts)).enumerate();
        for (point, ((place, velocity), (mut sum, drift))) in points {
            if frees && sum.clearance < JAMMED {
                sum.force += kick(iteration, point);
                sum.clearance = FREE_CLEARANCE;
                is_torn = true;
            }
            let limit = SAFE_FRACTION * sum.clearance;
            let moved = MOMENTUM * *velocity + sum.force;
            *place = torus.moved(*place, limited(moved + drift, limit));
            *velocity = limited(moved, limit);
        }
        let parts = self.subsets.len() as f64;
        for (i, (subset, suspects)) in self.subsets.iter_mut().zip(suspects).enumerate() {
            let job = job.part(0.8 + 0.2 * i as f64 / parts, 0.8 + 0.2 * (i + 1) as f64 / parts);
            subset.follow(&self.places);
            if let Some(mut mesh) = subset.mesh.take()
                && !is_torn
            {
                subset.mesh = mesh.mend(&job, &subset.places, suspects)?.then_some(mesh);
            }
        }
        Ok(())
    }

    fn finish(&mut self, _: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            self.places = self.order.start().to_vec();
        }
        Ok(())
    }
}

impl PlaneRelaxation for ClassRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.space(), &self.places, points)
    }

    fn coverage(&mut self, job: &Job) -> Result<f64> {
        let union = &mut self.subsets[0];
        union.follow(&self.places);
        Ok(union.triangulate(job)?.coverage() * union.torus.frame.spacing())
    }
}
