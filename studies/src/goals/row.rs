//! The rows of the page: target, measurement and verdict.

use azulejo_cli::text::rounded;

use crate::repeated::{ROUNDS, Repeated};
use crate::timing::Rounds;
use crate::verdict::judged;

/// A figure with the range of the rounds or sets that it is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    pub value: f64,
    pub range: [f64; 2],
    of: Of,
}

/// The quantity of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Of {
    /// The median of so many rounds.
    Rounds(usize),
    /// The worst of all that was made.
    All,
}

impl Figure {
    /// The median of a quantity of rounds.
    pub fn of_rounds(values: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let (count, all) = (values.len(), Repeated::new(values));
        Self { value: all.median(), range: [all.low(), all.high()], of: Of::Rounds(count) }
    }

    /// A time, in seconds times `scale`.
    pub fn time(rounds: &Rounds, scale: f64) -> Self {
        Self::of_rounds(rounds.seconds.iter().map(|seconds| scale * seconds))
    }

    /// The ratio of the times of two calls that took turns.
    pub fn ratio(one: &Rounds, other: &Rounds) -> Self {
        Self::of_rounds(one.seconds.iter().zip(&other.seconds).map(|(one, other)| one / other))
    }

    /// The least of some values.
    pub fn least(values: impl IntoIterator<Item = f64>) -> Self {
        let range = range(values);
        Self { value: range[0], range, of: Of::All }
    }

    /// The largest of some values.
    pub fn largest(values: impl IntoIterator<Item = f64>) -> Self {
        let range = range(values);
        Self { value: range[1], range, of: Of::All }
    }

    /// True if a goal is met: by every round, or by the worst of all; `None` if rounds disagree.
    fn meets(&self, goal: Goal) -> Option<bool> {
        let [low, high] = self.range.map(|end| goal.is_met(end));
        match self.of {
            Of::All => Some(goal.is_met(self.value)),
            Of::Rounds(count) => (count >= ROUNDS && low == high).then_some(low),
        }
    }
}

fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [f64::min(low, value), f64::max(high, value)])
}

/// The condition on a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    AtMost(f64),
    AtLeast(f64),
}

impl Goal {
    pub fn is_met(self, value: f64) -> bool {
        match self {
            Self::AtMost(most) => value <= most,
            Self::AtLeast(least) => value >= least,
        }
    }
}

/// A row of the page.
pub struct Row {
    pub asked: String,
    pub figure: Figure,
    pub unit: &'static str,
    pub goal: Goal,
}

impl Row {
    pub fn new(asked: impl Into<String>, figure: Figure, unit: &'static str, goal: Goal) -> Self {
        Self { asked: asked.into(), figure, unit, goal }
    }

    fn text(&self) -> String {
        let Self { asked, figure, unit, goal } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let [low, high] = figure.range.map(|value| rounded(value, 3));
        let (word, bound) = match goal {
            Goal::AtMost(most) => ("at most", most),
            Goal::AtLeast(least) => ("at least", least),
        };
        let told = judged(figure.meets(*goal));
        // One digit more than the range, so that the verdict can be read off.
        format!("| {asked} | {}{unit} | {low} to {high} | {word} {bound}{unit} | {told} |\n", rounded(figure.value, 4))
    }
}

/// A part of the page: a title, what is to be known, and the rows.
pub fn section(title: &str, about: &str, rows: &[Row]) -> String {
    let rows: String = rows.iter().map(Row::text).collect();
    format!("## {title}\n\n{about}\n\n| asked | measured | range | goal | |\n|---|---|---|---|---|\n{rows}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_says_what_follows_from_its_figure() {
        let rounds = |seconds: &[f64]| Rounds { samples: 1, seconds: seconds.to_vec() };
        let slow = rounds(&[0.4, 0.3, 0.36, 0.31, 0.32, 0.33, 0.34]);
        let fast = rounds(&[0.2, 0.2, 0.15, 0.2, 0.2, 0.2, 0.2]);
        let time = Figure::time(&slow, 1e3);
        assert_eq!((time.value, time.range), (330.0, [300.0, 400.0]));
        let ratio = Figure::ratio(&slow, &fast);
        assert!((ratio.value - 1.65).abs() < 1e-12 && (ratio.range[0] - 1.5).abs() < 1e-12, "{ratio:?}");
        assert!((ratio.range[1] - 2.4).abs() < 1e-12);
        let text = |goal| Row::new("a call", time, "ms", goal).text();
        assert_eq!(text(Goal::AtMost(400.0)), "| a call | 330 ms | 300 to 400 | at most 400 ms | met |\n");
        assert!(text(Goal::AtMost(399.0)).ends_with("| not decided |\n"));
        assert!(text(Goal::AtMost(299.0)).ends_with("| **not met** |\n"));
        assert!(text(Goal::AtLeast(401.0)).ends_with("| **not met** |\n"));
        assert!(text(Goal::AtLeast(2.0)).ends_with("| met |\n"));
        let few = Figure::time(&rounds(&[0.3; ROUNDS - 1]), 1.0);
        assert!(Row::new("a call", few, "s", Goal::AtMost(1.0)).text().ends_with("| not decided |\n"));
        let (least, largest) = (Figure::least([3.0, 2.0]), Figure::largest([3.0, 2.0]));
        assert_eq!((least.value, largest.value), (2.0, 3.0));
        assert_eq!((largest.meets(Goal::AtMost(2.5)), least.meets(Goal::AtLeast(2.0))), (Some(false), Some(true)));
    }
}
