//! Relaxation in the plane of several classes at once.

use crate::classes::Classes;
use crate::dcr::ground::memory::require_memory;
use crate::dcr::options::{Method, Neighbourhood, Options};
use crate::dcr::relax::{Report, measure, relax_set};
use crate::dcr::relaxation::{Steps, Stopped};
use crate::dcr::uniform::{ClassRelaxation, UniformRelaxation};
use crate::error::{Error, Result};
use crate::job::{Context, Progress};

/// What [`relax_classes`] reached for one class. The unit d_max is that of a set of its points alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClassReport {
    /// The number of its points.
    pub count: usize,
    /// The smallest distance between two of its points, in units of d_max; infinite for less than two.
    pub rho: f64,
    /// The largest distance of a position in the domain from its points, in units of d_max; infinite for no point.
    pub coverage: f64,
}

/// Relaxes points of several classes: spread more evenly are the union of all, and each class by itself. Returns as many
/// points, in the same order, the report of the union, and one for each class up to the highest.
///
/// `classes` has the class of each point, below [`Classes::MOST`]; they may be of any number and density, as those of
/// [`kdrt::sample_classes`](fn@crate::kdrt::sample_classes) are. They cannot all be as even as the set of a single class:
/// a good lattice does not divide into good lattices. From maximal sets of 2 to 7 classes of a periodic domain, rho ends
/// above 0.7 and the coverage below 0.82, those of the union and those of each class; before, some classes cover 1 or
/// more. Where the points of a class are crowded in some places and missing in others it is levelled before the first
/// step. No distance between points of two classes is promised.
///
/// Always the momentum method with Delaunay neighbours. The set after the last whole step is returned; it converges if its
/// motion ends, which it mostly does not within 100 steps. The points are the same for every number of threads.
///
/// About 2.5 times the time of [`relax`](fn@super::relax) and its memory.
///
/// # Errors
/// [`Error::InvalidArgument`] as [`relax`](fn@super::relax), and for another method or other neighbours, for classes of
/// another number than that of the points, and for one that is too high (`classes`, with its index);
/// [`Error::TooLarge`](crate::Error::TooLarge).
pub fn relax_classes(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    classes: &[u32],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report, Vec<ClassReport>)> {
    options.check()?;
    if options.method != Method::Momentum {
        return Err(Error::invalid("method", "classes are relaxed by the momentum method only".to_owned()));
    }
    if options.neighbourhood != Neighbourhood::Delaunay {
        return Err(Error::invalid("neighbourhood", "classes are relaxed with Delaunay neighbours only".to_owned()));
    }
    options.domain.check_points(points)?;
    if classes.len() != points.len() {
        return Err(Error::invalid("classes", format!("{} for {} points", classes.len(), points.len())));
    }
    if let Some(index) = classes.iter().position(|&class| class as usize >= Classes::MOST) {
        let reason = format!("[{index}] is {}, not below {}", classes[index], Classes::MOST);
        return Err(Error::invalid("classes", reason));
    }
    require_memory("xy", points.len())?;
    let mut set = ClassRelaxation::new(options.domain, options.seed, points, classes);
    let (relaxed, report) = relax_set(context, options, points, &mut set, progress, None)?;
    let count = classes.iter().max().map_or(0, |&last| last + 1);
    let reports =
        (0..count).map(|class| of_class(context, options, &relaxed, classes, class)).collect::<Result<_>>()?;
    Ok((relaxed, report, reports))
}

/// The figures of one class.
fn of_class(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    classes: &[u32],
    class: u32,
) -> Result<ClassReport> {
    let own = points.iter().zip(classes).filter(|&(_, &of)| of == class);
    let own: Vec<[f32; 2]> = own.map(|(&point, _)| point).collect();
    let mut set = UniformRelaxation::new(options.domain, Neighbourhood::Delaunay, options.seed, &own);
    let steps = Steps { iterations: 0, stopped: Stopped::Steps, motion: 0.0 };
    let (_, report) = context.run(None, |job| measure(job, &options.domain, &own, &mut set, steps))?;
    Ok(ClassReport { count: own.len(), rho: report.rho, coverage: report.coverage })
}
