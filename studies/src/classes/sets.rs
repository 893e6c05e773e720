//! Sets of several classes and what they are like, each class and all together.

use std::thread;

use azulejo::kdrt::{self, Options};
use azulejo::{Classes, Context, MAXIMAL_DENSITY, Progress, Result};

use super::mixes::{FACTORS, MIXES, Mix};
use super::{Effort, wei};
use crate::blue::Blue;

/// A sampler of several classes.
#[derive(Clone, Copy, PartialEq)]
pub enum Maker {
    /// The library, with a factor on Wei's cross radii.
    Azulejo(f64),
    /// Wei's darts, with his cross radii.
    Wei,
}

/// All makers, in the order of the page.
fn makers() -> impl Iterator<Item = Maker> {
    FACTORS.into_iter().map(Maker::Azulejo).chain([Maker::Wei])
}

/// The sets of a mix.
pub struct Measured {
    pub mix: Mix,
    pub maker: Maker,
    pub classes: Classes,
    /// Of each class, how many samples it has in parts of what it has alone.
    pub shares: Vec<f64>,
    /// The spectral figures of each class.
    pub members: Vec<Blue>,
    /// The spectral figures of the union.
    pub union: Blue,
    /// The first set, by class.
    pub first: Vec<Vec<[f32; 2]>>,
}

impl Measured {
    fn of(context: &Context, mix: Mix, maker: Maker, effort: &Effort) -> Result<Self> {
        let factor = if let Maker::Azulejo(factor) = maker { factor } else { 1.0 };
        let classes = mix.classes(effort.count, factor)?;
        let sets = make(context, maker, &classes, effort.sets)?;
        let members: Vec<Blue> = (0..classes.count())
            .map(|class| Blue::of(context, &sets.iter().map(|set| set[class].clone()).collect::<Vec<_>>()))
            .collect::<Result<_>>()?;
        let union = Blue::of(context, &sets.iter().map(|set| set.concat()).collect::<Vec<_>>())?;
        let shares = (0..classes.count())
            .map(|class| Ok(members[class].count() / count_alone(context, classes.own(class), effort)?));
        let shares = shares.collect::<Result<_>>()?;
        let first = sets.into_iter().next().unwrap_or_default();
        Ok(Self { mix, maker, shares, members, union, first, classes })
    }

    /// All mixes by all makers.
    pub fn all(context: &Context, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let all: Vec<_> = MIXES.into_iter().flat_map(|mix| makers().map(move |maker| (mix, maker))).collect();
        let one = |(i, &(mix, maker)): (usize, &(Mix, Maker))| {
            _ = progress(i as f64 / all.len() as f64);
            Self::of(context, mix, maker, effort)
        };
        all.iter().enumerate().map(one).collect()
    }

    /// The smallest and the largest value of the classes.
    pub fn range(&self, value: impl Fn(&Blue) -> f64) -> [f64; 2] {
        ends(self.members.iter().map(value))
    }
}

/// The smallest and the largest of some values.
pub fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Sets, each by class.
fn make(context: &Context, maker: Maker, classes: &Classes, sets: u64) -> Result<Vec<Vec<Vec<[f32; 2]>>>> {
    match maker {
        Maker::Azulejo(_) => (0..sets).map(|seed| sampled(context, classes, seed)).collect(),
        // One thread each: there are few.
        Maker::Wei => Ok(thread::scope(|scope| {
            let threads: Vec<_> = (0..sets).map(|seed| scope.spawn(move || wei::sample(classes, seed))).collect();
            threads.into_iter().map(|thread| thread.join().expect("darts do not panic")).collect()
        })),
    }
}

/// A set of the library, by class.
fn sampled(context: &Context, classes: &Classes, seed: u64) -> Result<Vec<Vec<[f32; 2]>>> {
    let set = kdrt::sample(context, &Options::classes(classes).seed(seed), None)?;
    let mut by_class = vec![Vec::new(); classes.count()];
    set.positions.iter().zip(&set.classes).for_each(|(sample, &class)| by_class[class as usize].push(*sample));
    Ok(by_class)
}

/// The number of samples of a class that is alone, in the mean of the sets.
fn count_alone(context: &Context, radius: f64, effort: &Effort) -> Result<f64> {
    let count = |seed| Ok(kdrt::sample(context, &Options::new(radius).seed(seed), None)?.len() as f64);
    Ok((0..effort.sets).map(count).sum::<Result<f64>>()? / effort.sets as f64)
}

/// The own radii of a second class beside one of 1.
pub const SECONDS: [f64; 9] = [1.0, 0.99, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4];

/// The shares of a class of radius 1 and of one of a smaller radius or the same.
pub struct Tie {
    pub second: f64,
    pub shares: [f64; 2],
}

impl Tie {
    /// Measures the shares for all radii of the second class.
    pub fn all(context: &Context, effort: &Effort) -> Result<Vec<Self>> {
        SECONDS.into_iter().map(|second| Self::of(context, second, effort)).collect()
    }

    fn of(context: &Context, second: f64, effort: &Effort) -> Result<Self> {
        let smallest = (MAXIMAL_DENSITY / effort.count).sqrt();
        let classes = Classes::of_radii(&[smallest / second, smallest], 1.0)?;
        let mut shares = [0.0; 2];
        for seed in 0..effort.sets {
            let set = sampled(context, &classes, seed)?;
            shares.iter_mut().zip(&set).for_each(|(share, class)| *share += class.len() as f64);
        }
        for (class, share) in shares.iter_mut().enumerate() {
            *share /= effort.sets as f64 * count_alone(context, classes.own(class), effort)?;
        }
        Ok(Self { second, shares })
    }
}
