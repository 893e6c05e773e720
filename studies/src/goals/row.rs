//! The rows of the page: what is asked, what was measured, and whether it is enough.

use azulejo_cli::text::rounded;

use crate::timing::Rounds;
use crate::verdict::verdict;

/// A figure with the range of the rounds or sets that it is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    pub value: f64,
    pub range: [f64; 2],
}

impl Figure {
    /// The least time, in seconds times `scale`.
    pub fn time(rounds: &Rounds, scale: f64) -> Self {
        let range = range(rounds.seconds.iter().map(|seconds| scale * seconds));
        Self { value: range[0], range }
    }

    /// How many times as long one call takes as another that it took turns with.
    pub fn ratio(one: &Rounds, other: &Rounds) -> Self {
        Self {
            value: one.least() / other.least(),
            range: range(one.seconds.iter().zip(&other.seconds).map(|(one, other)| one / other)),
        }
    }

    /// The least of some values.
    pub fn least(values: impl IntoIterator<Item = f64>) -> Self {
        let range = range(values);
        Self { value: range[0], range }
    }

    /// The largest of some values.
    pub fn largest(values: impl IntoIterator<Item = f64>) -> Self {
        let range = range(values);
        Self { value: range[1], range }
    }
}

fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [f64::min(low, value), f64::max(high, value)])
}

/// What a figure has to be.
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
        let told = verdict(goal.is_met(figure.value));
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
        let rounds = |seconds: [f64; 3]| Rounds { samples: 1, seconds: seconds.to_vec() };
        let (slow, fast) = (rounds([0.4, 0.3, 0.36]), rounds([0.2, 0.2, 0.15]));
        let time = Figure::time(&slow, 1e3);
        assert_eq!((time.value, time.range), (300.0, [300.0, 400.0]));
        let ratio = Figure::ratio(&slow, &fast);
        assert!((ratio.value - 2.0).abs() < 1e-12 && (ratio.range[0] - 1.5).abs() < 1e-12, "{ratio:?}");
        assert!((ratio.range[1] - 2.4).abs() < 1e-12);
        let text = |goal| Row::new("a call", time, "ms", goal).text();
        assert_eq!(text(Goal::AtMost(300.0)), "| a call | 300 ms | 300 to 400 | at most 300 ms | met |\n");
        assert!(text(Goal::AtMost(299.0)).ends_with("| **not met** |\n"));
        assert!(text(Goal::AtLeast(301.0)).ends_with("| **not met** |\n"));
        assert!(text(Goal::AtLeast(2.0)).ends_with("| met |\n"));
        assert_eq!((Figure::least([3.0, 2.0]).value, Figure::largest([3.0, 2.0]).value), (2.0, 3.0));
    }
}
