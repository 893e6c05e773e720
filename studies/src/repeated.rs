//! The results of rounds of a measurement, and the decision by them. In a round all calls that are compared take turns,
//! so that other work of the machine affects them alike.
//!
//! A goal is met where every round meets it and not met where none does; between that the rounds do not tell. Of
//! [`ROUNDS`] rounds all on the wrong side of a median come by chance in one of 128 cases (the sign test), which is
//! below [`LEVEL`]; fewer rounds decide nothing.

use azulejo_cli::text::rounded;

use crate::timing::Rounds;
use crate::verdict::{LEVEL, judged};

/// The fewest rounds that decide on a goal.
pub const ROUNDS: usize = 7;

/// The values of a quantity, one of each round.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeated(Vec<f64>);

impl Repeated {
    pub fn new(values: Vec<f64>) -> Self {
        assert!(!values.is_empty(), "no rounds");
        Self(values)
    }

    pub fn low(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub fn high(&self) -> f64 {
        self.0.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The middle value; of an even number the mean of the two in the middle.
    pub fn median(&self) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let middle = |i: usize| sorted[i / 2];
        (middle(sorted.len() - 1) + middle(sorted.len())) / 2.0
    }

    pub fn map(&self, value: impl Fn(f64) -> f64) -> Self {
        Self(self.0.iter().map(|&one| value(one)).collect())
    }

    /// This and another quantity of the same rounds in one value.
    pub fn with(&self, other: &Self, value: impl Fn(f64, f64) -> f64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(&own, &others)| value(own, others)).collect())
    }

    /// Round by round over another quantity.
    pub fn over(&self, other: &Self) -> Self {
        self.with(other, |own, others| own / others)
    }

    /// The verdict on a goal.
    pub fn verdict(&self, is_met: impl Fn(f64) -> bool) -> &'static str {
        let met = self.0.iter().filter(|&&value| is_met(value)).count();
        judged(match met {
            _ if self.0.len() < ROUNDS => None,
            0 => Some(false),
            met => (met == self.0.len()).then_some(true),
        })
    }

    /// True if all values are below all of another quantity's, and there are enough to say so: without a difference
    /// each order of the values is as likely as any other (the rank-sum test).
    pub fn is_below(&self, other: &Self) -> bool {
        let (own, others) = (self.0.len(), other.0.len());
        let chance: f64 = (1..=own).map(|i| i as f64 / (others + i) as f64).product();
        self.high() < other.low() && chance <= LEVEL
    }
}

impl Rounds {
    /// The seconds of each round, times a number.
    pub fn scaled(&self, scale: f64) -> Repeated {
        Repeated::new(self.seconds.iter().map(|seconds| scale * seconds).collect())
    }

    /// Seconds per sample.
    pub fn per_sample(&self) -> Repeated {
        self.scaled(1.0 / self.samples.max(1) as f64)
    }
}

/// The one of some quantities that is below all others, if the rounds tell.
pub fn lowest(all: &[&Repeated]) -> Option<usize> {
    let is_lowest = |&i: &usize| all.iter().enumerate().all(|(k, other)| k == i || all[i].is_below(other));
    (0..all.len()).find(is_lowest)
}

/// The median and in brackets the range: "1.73 (1.7 to 1.75)". Of one round the value alone.
pub fn cell(rounds: &Repeated, digits: usize) -> String {
    let [median, low, high] = [rounds.median(), rounds.low(), rounds.high()].map(|value| rounded(value, digits));
    if rounds.0.len() > 1 { format!("{median} ({low} to {high})") } else { median }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn repeated(values: &[f64]) -> Repeated {
        Repeated::new(values.to_vec())
    }

    #[test]
    fn a_goal_is_decided_by_all_rounds_or_not_at_all() {
        let seven = repeated(&[1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6]);
        assert_eq!(seven.verdict(|x| x >= 1.0), "met");
        assert_eq!(seven.verdict(|x| x >= 1.7), "**not met**");
        assert_eq!(seven.verdict(|x| x >= 1.1), "not decided");
        assert_eq!(seven.verdict(|x| x <= 1.5), "not decided");
        // Six rounds are on one side of their median by chance too often.
        assert_eq!(repeated(&[1.0; 6]).verdict(|x| x >= 0.0), "not decided");
        assert!(0.5f64.powi(ROUNDS as i32) <= LEVEL && 0.5f64.powi(ROUNDS as i32 - 1) > LEVEL);
    }

    #[test]
    fn the_lowest_is_named_only_where_ranges_are_apart_and_rounds_are_enough() {
        let [low, high] = [repeated(&[1.0, 1.2, 1.1, 1.0]), repeated(&[1.3, 1.4, 1.5, 1.3, 1.4])];
        // One order of 126.
        assert!(low.is_below(&high) && !high.is_below(&low));
        assert_eq!((lowest(&[&high, &low]), lowest(&[&low, &low])), (Some(1), None));
        assert_eq!(lowest(&[&low, &high, &repeated(&[1.1; 5])]), None);
        // One order of 35.
        assert!(!repeated(&[1.0; 3]).is_below(&repeated(&[2.0; 4])));
        assert!(
            repeated(&[1.0; 3]).is_below(&repeated(&[2.0; 7])) && repeated(&[1.0; 7]).is_below(&repeated(&[2.0; 3]))
        );
    }

    #[test]
    fn quantities_of_rounds_are_joined_round_by_round() {
        let (one, two) = (repeated(&[2.0, 4.0, 9.0]), repeated(&[1.0, 4.0, 3.0]));
        assert_eq!(one.over(&two), repeated(&[2.0, 1.0, 3.0]));
        assert_eq!((one.median(), one.low(), one.high()), (4.0, 2.0, 9.0));
        assert_eq!(repeated(&[1.0, 2.0, 5.0, 3.0]).median(), 2.5);
        assert_eq!(cell(&one, 3), "4 (2 to 9)");
        assert_eq!(cell(&repeated(&[0.1234]), 2), "0.12");
    }
}
