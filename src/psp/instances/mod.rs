//! Sets on instances: meshes that are placed in the world many times over, none of which is flattened for longer than it
//! is at work.
//!
//! Every instance is filled as a mesh of its own, around given samples: those of the instances before it that lie within a
//! radius of its box. So the set is conflict-free and maximal as any other, and the samples of an instance depend on
//! those before it that are near, and on nothing else. Instances that see none before them are filled first, in
//! parallel, then those that see these alone, and so on.

mod scene;

pub use scene::Instance;

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::Result;
use crate::given::Given;
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::options::{InstanceOptions, Options};
use crate::psp::progressive::sample;
use crate::psp::report::{Report, rho_on};
use crate::rng::{Draw, hash};
use scene::Scene;

/// A maximal set on the instances of some meshes in world space, as if all their triangles were one mesh: conflict-free
/// and maximal across instances, wherever they overlap or touch. Samples are in the order of the
/// [instances](Points::instances); their triangles and barycentrics are those of the prototypes, their normals on the
/// side that is the front of the prototype.
///
/// The memory for triangles is that of one instance for each thread. Takes the time of [`sample`](super::sample) for
/// every instance, in O(its triangles + its samples + those of the instances whose boxes it meets).
///
/// The report counts and times all instances, and with several threads their times add up to more than its `seconds`.
///
/// # Errors
/// Those of [`sample`](super::sample), and [`Error::InvalidArgument`](crate::Error::InvalidArgument) for `instances` of a
/// prototype that there is not, with a transform that is not finite, or that lie out of the range of floats. Where the
/// call is cancelled nothing is returned.
pub fn sample_instances(
    context: &Context,
    prototypes: &[Arc<Mesh>],
    instances: &[Instance],
    options: &InstanceOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let scene = Scene::new(prototypes, instances, options)?;
    let mut parts = vec![None; instances.len()];
    context.run(progress, |job| scene.fill(job, &mut parts))?;

    let (mut points, mut report, mut area) = (Points::default(), Report::default(), 0.0);
    points.positions.reserve_exact(parts.iter().flatten().map(|part: &Part| part.points.len()).sum());
    for part in parts.into_iter().flatten() {
        report.add(&part.report);
        area += part.area;
        append(&mut points, part.points);
    }
    let (samples, radius) = (points.len(), options.radius);
    let report = Report {
        samples: samples as u64,
        seconds: stopwatch.seconds(),
        rho: rho_on(area, samples, radius),
        radius,
        covering_radius: Some(radius),
        uncovered_after: Some(0.0),
        ..report
    };
    Ok((points, report))
}

/// Adds the samples of the next instance.
fn append(points: &mut Points<3>, part: Points<3>) {
    points.positions.extend(part.positions);
    points.normals.extend(part.normals);
    points.interpolated_normals.extend(part.interpolated_normals);
    points.triangles.extend(part.triangles);
    points.barycentrics.extend(part.barycentrics);
    points.instances.extend(part.instances);
}

/// The samples of an instance.
#[derive(Clone)]
struct Part {
    points: Points<3>,
    report: Report,
    /// The area of the instance.
    area: f64,
}

impl Scene<'_> {
    fn fill(&self, job: &Job, parts: &mut [Option<Part>]) -> Result<()> {
        let share = |done: usize| done as f64 / self.instances.len().max(1) as f64;
        let (one_thread, mut done) = (Context::new(1)?, 0);
        for level in self.levels() {
            if level.len() < job.context().num_threads() || job.context().num_threads() == 1 {
                for number in level {
                    let job = job.part(share(done), share(done + 1));
                    let progress = |share| match job.report(share) {
                        Ok(()) => ControlFlow::Continue(()),
                        Err(_) => ControlFlow::Break(()),
                    };
                    parts[number] = Some(self.fill_one(job.context(), number, parts, Some(&progress))?);
                    done += 1;
                }
                continue;
            }
            let job = job.part(share(done), share(done + level.len()));
            let made = job.map(level.len(), |i| self.fill_one(&one_thread, level[i], parts, None))?;
            done += level.len();
            for (number, part) in level.into_iter().zip(made) {
                parts[number] = Some(part?);
            }
        }
        Ok(())
    }

    /// The samples of an instance, around those that are there.
    fn fill_one(
        &self,
        context: &Context,
        number: usize,
        parts: &[Option<Part>],
        progress: Option<&Progress>,
    ) -> Result<Part> {
        let (instance, &InstanceOptions { radius, seed, cosine, .. }) = (&self.instances[number], self.options);
        let prototype = &self.prototypes[instance.prototype as usize];
        let place = |&vertex: &[f32; 3]| instance.place(vertex.map(f64::from)).map(|x| x as f32);
        let mesh = Arc::new(prototype.moved(prototype.positions().iter().map(place).collect()));
        let others = |other: usize| parts[other].as_ref().map_or(&[][..], |part| &part.points.positions);
        let (positions, clearances) = self.given_near(number, others);
        let options = Options::new(radius)
            .seed(hash(seed, Draw::Instance, &[number as u64]))
            .given(Given::with_clearances(&positions, &clearances))
            .cosine(cosine);
        let (points, report) = sample(context, &mesh, &options, progress)?;
        let points = Points { instances: vec![number as u32; points.len()], ..self.with_normals(instance, points) };
        Ok(Part { points, report, area: mesh.area() })
    }

    /// Samples with the normals of an instance: on the side that is the front of its prototype, and if any prototype
    /// carries normals, with these or in their place those of the triangles.
    fn with_normals(&self, instance: &Instance, mut points: Points<3>) -> Points<3> {
        if instance.mirrors() {
            points.normals.iter_mut().flatten().for_each(|x| *x = -*x);
        }
        if self.prototypes.iter().any(|prototype| prototype.has_normals()) {
            let prototype = &self.prototypes[instance.prototype as usize];
            let places = points.triangles.iter().zip(&points.barycentrics).zip(&points.normals);
            let normal = |((&triangle, &uv), &own): ((&u32, &[f32; 2]), &[f32; 3])| {
                let carried = prototype.interpolated_normal(triangle, uv);
                carried.map_or(own, |normal| instance.normal(normal, own))
            };
            points.interpolated_normals = places.map(normal).collect();
        }
        points
    }
}
