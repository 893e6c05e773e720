//! The claims of a page, and whether the run shows them.

use std::fmt::Write;

use crate::verdict::{self, Difference, LEVEL, Mean, chance};
use azulejo_cli::text::rounded;

/// That a mean is below another one.
pub struct Claim {
    what: String,
    pub low: Mean,
    pub high: Mean,
}

impl Claim {
    pub fn less(what: impl Into<String>, low: Mean, high: Mean) -> Self {
        Self { what: what.into(), low, high }
    }

    /// The difference of the higher mean from the lower one.
    fn difference(&self) -> Option<Difference> {
        self.high.above(&self.low)
    }
}

/// A mean with its standard error.
pub fn cell(Mean { mean, error, .. }: &Mean) -> String {
    let sign = if *mean < 0.0 { "-" } else { "" };
    format!("{sign}{} ± {}", rounded(mean.abs(), 5), rounded(*error, 2))
}

/// The table of claims.
pub fn table(claims: &[Claim]) -> String {
    let differences: Vec<_> = claims.iter().map(Claim::difference).collect();
    let mut text = format!(
        "## Claims\n\n\
         That one mean is *below* another: ± is the standard error, *n* the number of independent sets or rounds, *t* the \
         difference over its standard error (Welch), *p* the chance of as large a one where there is none, corrected for all {} \
         claims of the table (Holm). A claim is met where p is at most {LEVEL}, not met where that of the opposite is, \
         corrected in the same way, and otherwise not decided.\n\n\
         | claim | below | n | above | n | t | p | |\n|---|---|---|---|---|---|---|---|\n",
        claims.len(),
    );
    let verdicts = verdict::claims(&differences);
    for ((Claim { what, low, high }, difference), (p, verdict)) in claims.iter().zip(&differences).zip(verdicts) {
        let t = difference.map_or("-".to_owned(), |difference| format!("{:+.1}", difference.t));
        let ([n, m], [low, high], p) = ([low.count, high.count], [low, high].map(cell), chance(p));
        _ = writeln!(text, "| {what} | {low} | {n} | {high} | {m} | {t} | {p} | {verdict} |");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claim_is_met_where_it_is_shown_and_only_there() {
        let [low, high] = [[1.0, 1.1, 0.9, 1.0], [2.0, 2.1, 1.9, 2.0]].map(|values| Mean::of(&values));
        let chance = |low, high| Claim::less("", low, high).difference().unwrap().chance_of_larger();
        assert!(chance(low, high) < 1e-4 && chance(high, low) > 0.999 && (chance(low, low) - 0.5).abs() < 1e-9);
        let table = |low, high| table(&[Claim::less("x", low, high)]);
        assert!(table(low, high).contains("| met |") && table(high, low).contains("**not met**"));
        // One value shows nothing.
        assert!(table(Mean::of(&[1.0]), high).contains("| - | 1 | not decided |"));
    }

    #[test]
    fn means_are_written_with_their_sign() {
        assert_eq!(cell(&Mean { mean: -0.25, error: 0.0125, count: 3 }), "-0.25 ± 0.013");
    }
}
