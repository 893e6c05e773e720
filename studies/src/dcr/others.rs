//! Other methods on the same starts (thesis fig. 4.16 to 4.18): push-pull, centroidal Voronoi tessellations, farthest
//! point optimisation, capacity-constrained tessellations.

mod capacity;
mod farthest;
mod lloyd;
mod push_pull;
pub mod torus;

use std::fmt::Write;
use std::time::Instant;

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::{Boundary, Context, Domain, Result};

use super::radii::draw_column;
use super::sets::{FIRST_SEED, STARTS, Start};
use super::study::Study;
use crate::reference::random;
use crate::verdict::Mean;
use azulejo_cli::draw::canvas::Canvas;
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::quality::Quality;
use azulejo_cli::text::{grouped, rounded};
use push_pull::Aims;

/// d_max where the mean area of a cell is 1: √(2 / √3).
const HEXAGONAL: f64 = 1.074_569_931_823_542;

/// The aims of push-pull: the defaults of its published code, areas relative to their mean.
const AIMS: Aims = Aims { distance: 0.87, cover: 0.65, area: 0.0386 };
const PUSH_PULL_ROUNDS: u32 = 300;

/// The largest move of a point in the last step of Lloyd's method, in units of d_max.
const STILL: f64 = 1e-3;
const LLOYD_STEPS: u32 = 1000;

/// The growth of the mean nearest distance in the last round of farthest point optimisation, in units of d_max.
const GROWTH: f64 = 1e-4;
const FARTHEST_ROUNDS: u32 = 100;

/// Points of a site of a capacity-constrained tessellation.
pub const CAPACITY: usize = 256;
const CAPACITY_ROUNDS: u32 = 300;

/// The outcome of a method.
pub struct Outcome {
    pub points: Vec<[f32; 2]>,
    pub steps: u32,
    /// True if it converged before all steps were made.
    pub is_met: bool,
}

/// A method of others.
#[derive(Clone, Copy, PartialEq)]
pub enum Method {
    PushPull,
    Lloyd,
    Farthest,
    Capacity,
}

const METHODS: [Method; 4] = [Method::PushPull, Method::Lloyd, Method::Farthest, Method::Capacity];

impl Method {
    fn name(self) -> &'static str {
        match self {
            Self::PushPull => "push-pull",
            Self::Lloyd => "CVT",
            Self::Farthest => "FPO",
            Self::Capacity => "CCVT",
        }
    }

    /// The numbers of points and of sets, which a method makes in some minutes.
    fn sizes(self, quick: bool) -> &'static [(usize, u64)] {
        match (self, quick) {
            (Self::PushPull, true) => &[(300, 2)],
            (Self::PushPull, false) => &[(1000, 16), (4096, 8)],
            (_, true) => &[(300, 1)],
            (Self::Capacity, false) => &[(1000, 4)],
            (_, false) => &[(1000, 8), (4096, 4)],
        }
    }

    /// Relaxes points of the unit torus.
    pub fn relax(self, points: &[[f32; 2]], seed: u64) -> Outcome {
        match self {
            Self::PushPull => push_pull::relax(points, seed, AIMS, PUSH_PULL_ROUNDS),
            Self::Lloyd => lloyd::relax(points, STILL, LLOYD_STEPS),
            Self::Farthest => farthest::relax(points, GROWTH, FARTHEST_ROUNDS),
            Self::Capacity => capacity::relax(points, seed, CAPACITY, CAPACITY_ROUNDS),
        }
    }
}

/// Numbers in random order.
fn shuffled(count: usize, seed: u64) -> Vec<usize> {
    let keys = random(count, seed);
    let mut order: Vec<_> = (0..count).collect();
    order.sort_by(|&a, &b| f32::total_cmp(&keys[a][0], &keys[b][0]));
    order
}

/// A set that a method made.
struct Set {
    points: Vec<[f32; 2]>,
    quality: Quality,
    steps: u32,
    is_met: bool,
    seconds: f64,
}

/// The sets of one method, size and start.
pub struct Measured {
    pub method: Method,
    pub start: Start,
    pub count: usize,
    sets: Vec<Set>,
}

impl Measured {
    /// The sets of all methods.
    pub fn all(study: &Study) -> Result<Vec<Self>> {
        let kinds =
            METHODS.iter().flat_map(|&method| method.sizes(study.quick).iter().map(move |&size| (method, size)));
        let kinds: Vec<_> = kinds.flat_map(|kind| STARTS.map(|start| (kind, start))).collect();
        let tasks = kinds.iter().flat_map(|&((method, (count, sets)), start)| {
            (FIRST_SEED..FIRST_SEED + sets).map(move |seed| (method, count, start, seed))
        });
        let tasks: Vec<_> = tasks.collect();
        let mut made = study.each("others", tasks.len(), |context, i| Set::make(context, tasks[i]))?.into_iter();
        let measured = |((method, (count, sets)), start)| Self {
            method,
            start,
            count,
            sets: made.by_ref().take(sets as usize).collect(),
        };
        Ok(kinds.into_iter().map(measured).collect())
    }

    /// A figure of each set.
    pub fn figures(&self, figure: impl Fn(&Quality) -> f64) -> Vec<f64> {
        self.sets.iter().map(|set| figure(&set.quality)).collect()
    }

    fn mean(&self, figure: impl Fn(&Set) -> f64) -> f64 {
        self.sets.iter().map(figure).sum::<f64>() / self.sets.len() as f64
    }
}

impl Set {
    fn make(context: &Context, (method, count, start, seed): (Method, usize, Start, u64)) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let points = start.points(context, domain, count, seed)?;
        let clock = Instant::now();
        let Outcome { points, steps, is_met } = method.relax(&points, seed);
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Self { quality: Quality::of(context, &domain, &points)?, points, steps, is_met, seconds })
    }
}

/// The section. Draws the sets of the smallest size from random starts.
pub fn section(study: &Study, measured: &[Measured]) -> Result<String> {
    let smallest = |method| measured.iter().find(|one| one.method == method && one.start == Start::Random);
    let mut canvas = Canvas::new(1760.0, 1180.0, 1200);
    for (column, one) in METHODS.into_iter().filter_map(smallest).enumerate() {
        let half = (FREQUENCY_LIMIT * (one.count as f64).sqrt()).ceil() as usize + 1;
        let (context, domain) = (study.context, Domain::unit(Boundary::Periodic));
        let spectra = one.sets.iter().map(|set| periodogram(context, &domain, &set.points, 2 * half + 1, None));
        let spectrum = Periodogram::mean(&spectra.collect::<Result<Vec<_>>>()?)?;
        draw_column(&mut canvas, 90.0 + 425.0 * column as f32, one.method.name(), &one.sets[0].points, &spectrum)?;
    }
    canvas.write(&study.picture("others")?)?;
    Ok(text(measured))
}

fn text(measured: &[Measured]) -> String {
    let Aims { distance, cover, area } = AIMS;
    let mut text = format!(
        "## Others (thesis fig. 4.16 to 4.18)\n\n\
         From the same starts, by implementations of this command, each set on one thread, which were not compared with the authors' programs. \
         *Push-pull* (Ahmed et al. 2016) aims at ρ = {distance}, cover = {cover} and areas of Voronoi cells within {area} \
         of their mean, the defaults of published code for it with areas taken relative to their mean, and ends when a round moves no point. *CVT* is Lloyd's method \
         (1982), until no point moves by more than {STILL} d_max in a step. *FPO* (Schlömer et al. 2011) ends when a round adds \
         no more than {GROWTH} d_max to the mean distance to the nearest point. *CCVT* (Balzer et al. 2009) has {CAPACITY} \
         points per site, divided at first by halving, and ends when none changes hands. *Ended* counts the sets that met their \
         condition before {PUSH_PULL_ROUNDS}, {LLOYD_STEPS}, {FARTHEST_ROUNDS} and {CAPACITY_ROUNDS} steps, which are rounds \
         over all points. Columns of the thesis's figures that are not here: BNOT, CapCVT and KDM, which are not implemented, and \
         MPS, which is the reference of [docs/kdrt.md](kdrt.md).\n\n\
         ![Samples, spectra and radial means of four methods](dcr/others.png)\n\n\
         | method | points | sets | start | ρ | nearest | cover | ψ6 | P | obtuse | edge CV² | steps | ended | seconds | samples/s |\n{}|\n",
        "|---".repeat(15),
    );
    for one in measured {
        let figure = |of: fn(&Quality) -> f64| Mean::of(&one.figures(of));
        let seconds = one.mean(|set| set.seconds);
        _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} % | {} | {:.0} | {} | {} | {} |",
            one.method.name(),
            grouped(one.count),
            one.sets.len(),
            one.start.name(),
            figure(|set| set.rho).cell(3),
            figure(|set| set.mean_distance).cell(3),
            figure(|set| set.cover).cell(3),
            figure(|set| set.order).cell(3),
            figure(|set| set.low_power).cell(2),
            figure(|set| 100.0 * set.obtuse).cell(3),
            figure(|set| set.edge_variation).cell(4),
            one.mean(|set| set.steps.into()),
            one.sets.iter().filter(|set| set.is_met).count(),
            rounded(seconds, 2),
            grouped((one.count as f64 / seconds) as usize),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use azulejo::analysis::triangles::triangle_statistics;

    use super::*;

    fn quality(points: &[[f32; 2]]) -> Quality {
        Quality::of(&Context::new(1).unwrap(), &Domain::unit(Boundary::Periodic), points).unwrap()
    }

    #[test]
    fn every_method_comes_to_what_it_is_known_for() {
        let start = random(200, 3);
        let [push_pull, lloyd, farthest, capacity] = METHODS.map(|method| method.relax(&start, 3));
        for (method, outcome) in METHODS.iter().zip([&push_pull, &lloyd, &farthest, &capacity]) {
            assert_eq!(outcome.points.len(), 200);
            assert!(outcome.is_met && method.relax(&start, 3).points == outcome.points, "{}", method.name());
        }
        // As an independent analysis finds, what push-pull aims at is there.
        let found = quality(&push_pull.points);
        assert!(found.rho > AIMS.distance - 1e-4 && found.cover < AIMS.cover + 1e-4, "{} {}", found.rho, found.cover);
        // The mean over many is 0.93 in the paper on FPO; its sets are the most widely spaced.
        let widest = quality(&farthest.points);
        assert!(widest.rho > 0.88 && widest.rho > found.rho);
        // Lloyd's are the most regular.
        let [regular, others] = [&lloyd, &capacity].map(|outcome| quality(&outcome.points).order);
        assert!(regular > 0.6 && regular > others && regular > found.order, "{regular} {others}");
        // Equal capacities: areas of triangles vary less than in a random set, power at low frequencies all but
        // vanishes.
        let domain = Domain::unit(Boundary::Periodic);
        let areas = |points: &[[f32; 2]]| {
            triangle_statistics(&Context::new(1).unwrap(), &domain, points, None).unwrap().area_variation
        };
        assert!(areas(&capacity.points) < 0.1 * areas(&start) && quality(&capacity.points).low_power < 0.01);
    }

    #[test]
    fn an_order_has_every_number_once() {
        let mut order = shuffled(100, 7);
        assert!(order != shuffled(100, 8) && order == shuffled(100, 7));
        order.sort_unstable();
        assert_eq!(order, (0..100).collect::<Vec<_>>());
    }
}
