//! Sets of several classes: trees, shrubs and grass, which keep clear of each other (Wei 2010; the thesis names them as
//! future work, §3.4.6).
//!
//! Classes of larger own radii come first. Each group of equal radii is filled around the samples of all earlier
//! groups, with the cross radii as clearances (`site.rs`, `layers.rs`). Within a group darts of all classes are thrown
//! at equal rates.

mod graded;
mod ground;
mod layers;
mod levels;
mod site;

use std::sync::Arc;

use crate::classes::Classes;
use crate::error::{Error, Result};
use crate::given::Given;
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::mesh::Mesh;
use crate::points::{Points, check_resolution};
use crate::psp::adaptive::MeasuredTriangles;
use crate::psp::classes::graded::{Varying, VaryingRadius};
use crate::psp::classes::levels::{expected_samples, is_ranked, sample_groups};
use crate::psp::classes::site::{Constant, Places, class_samples};
use crate::psp::fill::{Measures, require_samples};
use crate::psp::fragment::Facing;
use crate::psp::given::Obstacles;
use crate::psp::options::ClassOptions;
use crate::psp::report::Report;

/// Peak memory for each sample that the classes would have alone; in progressive order.
const BYTES_PER_SAMPLE: f64 = 105.0;
const BYTES_PER_RANKED_SAMPLE: f64 = 690.0;

/// Samples a mesh with several classes at once.
///
/// No two samples of classes i and j are closer than `classes.radius(i, j)`, in `f64` from the returned floats. And no
/// class admits another sample: for each class i every place of the surface is within `radius(i, j)` of a sample of
/// some class j, up to [`TOLERANCE`](super::TOLERANCE). The samples are sorted by class, which [`Points::classes`]
/// gives for each. They do not depend on the number of threads.
///
/// *Shares.* Classes of larger own radii come first and have as many samples as alone; those of smaller ones fill the
/// remaining surface. With [`Classes::of_radii`] and factor 1, own radii 1, 1/2, 1/4 give about 100, 82 and 82 per cent
/// of the samples that each class would have alone. Classes of equal radii are filled together and have equal shares:
/// two have about 77 per cent each, eight 83; with factor 0.7 two have 95. So shares jump where radii become equal: 1.1
/// and 1 give 100 and 68 per cent, 1 and 1 give 77 each. Cross radii above an own radius can starve the smaller class.
///
/// `masks` has a bit for each class, the lowest for class 0, for each triangle of the mesh: a class has no samples, and
/// needs no cover, on triangles where its bit is 0. Other bits are ignored. Where the mesh has a
/// [mask](Mesh::with_mask) of its own, both must allow a sample. `None`: all classes may stand everywhere.
///
/// In [`Order::Progressive`](crate::Order::Progressive) the samples of each class are sorted coarse to fine, and have
/// [ranks](Points::ranks). The first samples of a class, any number of them, are at least as far apart as the last of
/// their ranks. Those of classes of equal radii up to one rank are at least `radius(i, j)` times that rank over the own
/// radius apart, where the diagonal of the mesh's box stands for an infinite rank. And where these classes may stand,
/// every place is within `radius(i, j)` times [`ClassOptions::quotient`] times that rank over the own radius of one of
/// them, or within `radius(i, j)` of a sample of a class of larger radius: such classes keep their clearance from the
/// first sample on. For less than [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples of them the quotient is
/// larger, as in [`sample`](super::sample). So each class can be thinned independently, and classes have about the
/// shares that they have in any order.
///
/// With a [unit](ClassOptions::unit) s that varies over the surface the radii of the matrix are multiples of it: samples
/// a and b of classes i and j are at least `radius(i, j) * (s(a) + s(b)) / 2` apart, and for each class i every place x
/// is within `radius(i, j) * (s(x) + s(b)) / 2` of a sample b of some class j, up to the tolerance of
/// [`adaptive::sample`](super::adaptive::sample) with these radii. [`Points::radii`] gives s at each sample. So classes
/// have the shares that they have with constant radii, and all of them follow the density that s stands for. What is
/// said of radii and ranks above holds with these means for units of length. At jumps of s samples of larger classes on
/// the sparse side, which come first, leave fewer of the smaller ones on the other.
///
/// The set is always maximal. In the [`Report`] the radius is the smallest own radius, and `rho`, which is for one
/// class, is 0.
///
/// Time: with Wei's radii and two classes about twice that of [`sample`](super::sample) per sample, with eight classes
/// four times, and likewise with a unit beside [`adaptive::sample`](super::adaptive::sample); all triangles are visited once per class.
///
/// # Errors
/// [`Error::InvalidArgument`] for `radii` above 0 below 64 float spacings at the largest coordinate of the mesh,
/// `masks` that are not one for each triangle (`mask_count`), a `cosine` outside -1 to 1, and `given` samples out of
/// range. With a unit also what [`adaptive::sample`](super::adaptive::sample) refuses of a radius, where the smallest of
/// the matrix above 0 counts. [`Error::TooLarge`] if the radii would require more than 2^32 samples, or more than memory holds.
/// [`Error::Cancelled`] by the progress callback: nothing is returned.
pub fn sample_classes(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &ClassOptions,
    classes: &Classes,
    masks: Option<&[u32]>,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    check_masks(mesh, masks)?;
    if options.unit.is_none() {
        check_radii(mesh, classes)?;
    }
    let is_ranked = is_ranked(options)?;
    let facing = Facing::new(options.cosine)?;
    let given = obstacles_of_classes(mesh, options.given, classes)?;
    let places = Places { mesh, masks, given: &given, none: &Obstacles::default(), facing };
    let (set, darts) = match options.unit {
        None => {
            let unit = Constant { measures: &*mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))? };
            let bytes = if is_ranked { BYTES_PER_RANKED_SAMPLE } else { BYTES_PER_SAMPLE };
            require_samples(expected_samples(places, classes, unit), bytes, "radii", "they ask for")?;
            let (samples, darts) = context.run(progress, |job| sample_groups(job, places, classes, unit, options))?;
            (class_samples(mesh, &samples, is_ranked), darts)
        }
        Some(radius) => {
            options.given.require_clearances("are required where the radius varies")?;
            let radius = VaryingRadius::new(mesh, radius, classes)?;
            let (samples, darts) = context.run(progress, |job| {
                let field = &radius.field(&job.part(0.0, 0.02))?;
                let triangles = &MeasuredTriangles::of(mesh);
                let unit = Varying::new(&job.part(0.02, 0.05), field, triangles, classes, is_ranked)?;
                sample_groups(&job.part(0.05, 1.0), places, classes, unit, options)
            })?;
            let radii = samples.iter().map(|&(_, radius)| radius).collect();
            (Points { radii, ..class_samples(mesh, &samples, is_ranked) }, darts)
        }
    };
    let report = Report {
        uncovered_after: Some(0.0),
        radius: (0..classes.count()).map(|class| classes.own(class)).fold(f64::INFINITY, f64::min),
        ..Report::of_fill(set.len(), darts, &stopwatch)
    };
    Ok((set, report))
}

/// For each class, the given samples with their clearances from it, of which each sample has a row; without clearances,
/// with the class's own radius.
fn obstacles_of_classes(mesh: &Mesh, given: Given<3>, classes: &Classes) -> Result<Vec<Obstacles>> {
    given.check_classes(classes.count())?;
    let of_class = |class: usize| {
        let clearances = given.clearances_of_class(class, classes.count());
        let clearances = clearances.unwrap_or_else(|| vec![classes.own(class); given.positions.len()]);
        Obstacles::of(mesh, Given::with_clearances(given.positions, &clearances))
    };
    (0..classes.count()).map(of_class).collect()
}

fn check_masks(mesh: &Mesh, masks: Option<&[u32]>) -> Result<()> {
    let count = mesh.triangles().len();
    match masks {
        Some(masks) if masks.len() != count => {
            Err(Error::invalid("mask_count", format!("{} masks for {count} triangles", masks.len())))
        }
        _ => Ok(()),
    }
}

/// Refuses radii too small for the precision of floats.
fn check_radii(mesh: &Mesh, classes: &Classes) -> Result<()> {
    let least = classes.radii().iter().copied().filter(|&radius| radius > 0.0).fold(f64::INFINITY, f64::min);
    check_resolution("radii", least, mesh.float_spacing(), "the largest coordinate of the mesh")
}
