//! The time of several classes, against one class in the same run.

use std::sync::Arc;

use azulejo::kdrt;
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Classes, Context, Domain, Result, maximal, psp};

use super::Effort;
use super::mixes::{MIXES, Mix, PICTURED, density};
use crate::repeated::Repeated;
use crate::timing::{Rounds, in_turns};

/// The mixes that are timed, and the largest time of a sample as a multiple of that with one class.
pub const TIMED: [(Mix, f64); 6] = [
    (MIXES[0], 2.0),
    (MIXES[1], 2.0),
    (MIXES[2], 3.0),
    (MIXES[3], 3.0),
    (Mix { name: "four of 1", own: &[1.0; 4] }, 3.0),
    (Mix { name: "eight of 1", own: &[1.0; 8] }, 5.5),
];

/// The samples of a window, and the milliseconds that it may take.
pub const WINDOW: f64 = 1e4;
pub const WINDOW_GOAL: f64 = 25.0;

/// The samples of the plane whose windows are made.
pub const PLANE: f64 = 1e9;

/// The times of a mix on one thread.
pub struct Times {
    pub mix: Mix,
    pub goal: f64,
    pub classes: Rounds,
    /// A plain set of one class.
    pub one: Rounds,
    /// In the plane: one class by the flat quadtree, which fills all of it as classes are filled.
    pub filled: Option<Rounds>,
}

impl Times {
    /// Times in the plane.
    pub fn plane(effort: &Effort) -> Result<Vec<Self>> {
        let one = Context::new(1)?;
        let time = |(mix, goal): (Mix, f64)| {
            let classes = Classes::of_radii(&mix.radii(effort.timed, 1.0), 1.0)?;
            let options = kdrt::Options::new(smallest(&classes)).seed(1);
            let unbiased = maximal::Options::new(smallest(&classes)).seed(1);
            let timed = in_turns(
                effort.rounds,
                &[
                    &|| Ok(kdrt::sample(&one, &kdrt::Options::classes(&classes).seed(1), None)?.len()),
                    &|| Ok(kdrt::sample(&one, &options, None)?.len()),
                    &|| Ok(maximal::sample(&one, &unbiased, None)?.len()),
                ],
            )?;
            let [classes, one, filled] = [0, 1, 2].map(|call: usize| timed[call].clone());
            Ok(Self { mix, goal, classes, one, filled: Some(filled) })
        };
        TIMED.into_iter().map(time).collect()
    }

    /// Times on a mesh.
    pub fn mesh(mesh: &Arc<Mesh>, effort: &Effort) -> Result<Vec<Self>> {
        let one = Context::new(1)?;
        let time = |(mix, goal): (Mix, f64)| {
            let classes = Classes::of_radii(&mix.radii(effort.timed, mesh.area()), 1.0)?;
            let several = psp::ClassOptions::default().seed(1);
            let options = psp::Options::new(smallest(&classes)).seed(1);
            let timed = in_turns(
                effort.rounds,
                &[&|| Ok(psp::sample_classes(&one, mesh, &several, &classes, None, None)?.0.positions.len()), &|| {
                    Ok(psp::sample(&one, mesh, &options, None)?.0.positions.len())
                }],
            )?;
            let [classes, one] = [0, 1].map(|call: usize| timed[call].clone());
            Ok(Self { mix, goal, classes, one, filled: None })
        };
        TIMED.into_iter().map(time).collect()
    }
}

fn smallest(classes: &Classes) -> f64 {
    (0..classes.count()).map(|class| classes.own(class)).fold(f64::INFINITY, f64::min)
}

/// The times of windows of [`PICTURED`] in a kept plane, on one thread.
pub struct Windows {
    /// Samples of a window, in the mean.
    pub samples: f64,
    /// Milliseconds of a window in the mean of all places, one value of each round.
    pub milliseconds: Repeated,
}

impl Windows {
    /// Makes windows at several places.
    pub fn measure(effort: &Effort) -> Result<Self> {
        let classes = Classes::of_radii(PICTURED.own, 1.0)?;
        // The classes fill what they leave each other; the union's density is found by a set.
        let some = square(effort.window.sqrt() / density(0.25).sqrt() * 2.0);
        let found = kdrt::sample(&Context::new(1)?, &kdrt::Options::classes(&classes).domain(some), None)?;
        let per_area = found.len() as f64 / (4.0 * effort.window / density(0.25));
        let (side, width) = ((PLANE / per_area).sqrt(), (effort.window / per_area).sqrt());
        let options = kdrt::Options::classes(&classes).domain(square(side));
        let plane = kdrt::Plane::new(&Context::new(1)?, &options, None)?;
        let window = |place: u32| {
            let min = [0.1 + 0.037 * f64::from(place), 0.2 + 0.051 * f64::from(place)].map(|x| side * x);
            Ok(plane.window(min, min.map(|x| x + width))?.len())
        };
        let all = || (0..effort.windows).map(window).sum::<Result<usize>>();
        let timed = in_turns(effort.rounds, &[&all])?.remove(0);
        let windows = f64::from(effort.windows);
        Ok(Self { samples: timed.samples as f64 / windows, milliseconds: timed.scaled(1e3 / windows) })
    }
}

fn square(side: f64) -> Domain {
    Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic }
}
