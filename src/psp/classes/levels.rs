//! The levels of a group of classes in progressive order.

use crate::classes::Classes;
use crate::error::Result;
use crate::job::Job;
use crate::levels::{LevelOptions, Levelled, Levels, by_radius};
use crate::order::Order;
use crate::psp::classes::layers::Layers;
use crate::psp::classes::site::{Classed, Group, Places, Unit};
use crate::psp::fill::FillOptions;
use crate::psp::levels::{NAMES, SurfaceSample, check_work, top};
use crate::psp::options::{ClassOptions, check_quotient};
use crate::rng::{Draw, hash};

/// Samples for all classes, group by group, and the number of darts. Groups of larger own radii come first.
pub fn sample_groups<U: Unit>(
    job: &Job,
    places: Places,
    classes: &Classes,
    unit: U,
    options: &ClassOptions,
) -> Result<(Vec<U::Sample>, u64)> {
    let groups = classes.groups();
    let groups: Vec<_> =
        groups.iter().map(|members| GroupLevels { places, classes, members, unit, earlier: &[] }).collect();
    let expected: f64 = groups.iter().map(GroupLevels::expected_samples).sum();
    let (mut samples, mut darts, mut done) = (Vec::new(), 0, 0.0);
    for (number, group) in (0..).zip(groups) {
        let next = (done + group.expected_samples() / expected.max(1.0)).min(1.0);
        let (job, seed) = (&job.part(done, next), hash(options.seed, Draw::Group, &[number]));
        let thrown;
        (samples, thrown) = GroupLevels { earlier: &samples, ..group }.complete(job, options, seed)?;
        darts += thrown;
        done = next;
    }
    // Stable: within a class they keep the order of the fill, or that by rank.
    samples.sort_by_key(|sample| sample.sample().class);
    Ok((samples, darts))
}

/// An upper estimate of the samples of all classes.
pub fn expected_samples(places: Places, classes: &Classes, unit: impl Unit) -> f64 {
    (0..classes.count()).map(|class| unit.expected_samples(places.mesh, classes.own(class))).sum()
}

/// The levels of a group: its own radius, and the radii between its classes, are multiplied by one number. Those to
/// earlier classes stay.
struct GroupLevels<'a, U: Unit> {
    places: Places<'a>,
    classes: &'a Classes,
    members: &'a [usize],
    unit: U,
    /// The samples of earlier classes.
    earlier: &'a [U::Sample],
}

impl<U: Unit> GroupLevels<'_, U> {
    /// The own radius.
    fn own(&self) -> f64 {
        self.classes.own(self.members[0])
    }

    /// An upper estimate of the samples.
    fn expected_samples(&self) -> f64 {
        self.at(self.own(), None).expected_samples()
    }

    /// The samples of earlier classes, and behind them those of the group; and the number of darts.
    fn complete(self, job: &Job, options: &ClassOptions, seed: u64) -> Result<(Vec<U::Sample>, u64)> {
        let (own, earlier) = (self.own(), self.earlier);
        match options.order {
            Order::Any => {
                let fill = FillOptions { measures: false, ..FillOptions::from_nothing(seed) };
                U::fill(&self.at(own, None), job, earlier.to_vec(), fill)
            }
            Order::Progressive => {
                let set = by_radius(job, Levels::new(self, seed), options.quotient, own)?;
                Ok(([earlier, &set.samples].concat(), set.darts))
            }
        }
    }

    /// The group at another own radius.
    fn at(&self, radius: f64, largest_rank: Option<f64>) -> Group<'_, U> {
        Group {
            places: self.places,
            unit: self.unit,
            members: self.members.iter().map(|&class| Classed { class: class as u8, local: () }).collect(),
            radius,
            finest: self.own(),
            layers: Layers::new(self.classes, self.members, radius / self.own()),
            largest_rank,
        }
    }
}

/// True if samples get ranks. Refuses a quotient out of range.
pub fn is_ranked(options: &ClassOptions) -> Result<bool> {
    match options.order {
        Order::Any => Ok(false),
        Order::Progressive => check_quotient(options.quotient).map(|()| true),
    }
}

impl<U: Unit> Levelled for GroupLevels<'_, U> {
    type Sample = U::Sample;

    const DIMENSION: u32 = 2;

    const NAMES: [&'static str; 2] = NAMES;

    fn top(&self) -> f64 {
        top(self.places.mesh) / self.unit.least()
    }

    fn expected(&self, radius: f64) -> f64 {
        self.at(radius, None).expected_samples()
    }

    fn check_work(&self, radius: f64, count: usize) -> Result<()> {
        check_work(!self.earlier.is_empty(), self.expected(radius), count)
    }

    fn fill(
        &self,
        job: &Job,
        options: LevelOptions,
        radius: f64,
        samples: &[U::Sample],
    ) -> Result<(Vec<U::Sample>, u64)> {
        let group = self.at(radius, options.largest_rank);
        let (mut samples, darts) =
            U::fill(&group, job, [self.earlier, samples].concat(), FillOptions::of_level(options))?;
        samples.retain(|sample| self.members.contains(&usize::from(sample.sample().class)));
        Ok((samples, darts))
    }
}
