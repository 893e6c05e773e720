//! The levels of a group of classes in progressive order.

use crate::classes::Classes;
use crate::error::Result;
use crate::job::Job;
use crate::order::Order;
use crate::psp::classes::layers::Layers;
use crate::psp::classes::site::{Group, Places};
use crate::psp::fill::FillOptions;
use crate::psp::levels::{Levelled, Levels, by_radius, top};
use crate::psp::options::{ClassOptions, check_quotient};
use crate::psp::set::Sample;

/// The levels of a group: its own radius, and the radii between its classes, are multiplied by one number. Those to
/// earlier classes stay.
pub struct GroupLevels<'a> {
    pub places: Places<'a>,
    pub classes: &'a Classes,
    pub members: &'a [usize],
    /// The samples of earlier classes.
    pub earlier: &'a [Sample],
}

impl GroupLevels<'_> {
    /// The own radius.
    fn own(&self) -> f64 {
        self.classes.own(self.members[0])
    }

    /// An upper estimate of the samples.
    pub fn expected_samples(&self) -> f64 {
        self.at(self.own(), None).expected_samples()
    }

    /// The samples of earlier classes, and behind them those of the group; and the number of darts.
    pub fn complete(self, job: &Job, options: &ClassOptions, seed: u64) -> Result<(Vec<Sample>, u64)> {
        let (own, earlier) = (self.own(), self.earlier);
        match options.order {
            Order::Any => {
                let fill = FillOptions { measures: false, ..FillOptions::from_nothing(seed) };
                self.at(own, None).fill(job, earlier.to_vec(), fill)
            }
            Order::Progressive => {
                let set = by_radius(job, Levels::new(self, seed), options.quotient, own)?;
                Ok(([earlier, &set.samples].concat(), set.darts))
            }
        }
    }

    /// The group at another own radius.
    fn at(&self, radius: f64, largest_rank: Option<f64>) -> Group<'_> {
        Group {
            places: self.places,
            members: self.members.iter().map(|&class| class as u8).collect(),
            radius,
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

impl Levelled for GroupLevels<'_> {
    type Sample = Sample;

    fn top(&self) -> f64 {
        top(self.places.mesh)
    }

    fn expected(&self, radius: f64) -> f64 {
        self.at(radius, None).expected_samples()
    }

    fn has_given(&self) -> bool {
        !self.earlier.is_empty()
    }

    fn fill(&self, job: &Job, options: FillOptions, radius: f64, samples: &[Sample]) -> Result<(Vec<Sample>, u64)> {
        let group = self.at(radius, options.largest_rank);
        let (mut samples, darts) = group.fill(job, [self.earlier, samples].concat(), options)?;
        samples.retain(|sample| group.members.contains(&sample.class));
        Ok((samples, darts))
    }
}
