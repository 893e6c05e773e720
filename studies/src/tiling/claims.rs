//! The statements of a section, the thesis's claims, and whether the run shows them.

use std::fmt::Write;

use crate::verdict::{self, Difference, LEVEL, Mean, chance};
use azulejo_cli::text::rounded;

/// A section of the page.
pub struct Part {
    /// Its text, from its `##` title on.
    pub text: String,
    pub claims: Vec<Claim>,
    pub facts: Vec<Fact>,
}

/// That a mean is below another mean or a number.
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
        if self.high.count == 0 {
            let above = self.low.above_number(self.high.mean);
            above.map(|difference| Difference { t: -difference.t, ..difference })
        } else if self.low.count == 0 {
            self.high.above_number(self.low.mean)
        } else {
            self.high.above(&self.low)
        }
    }
}

/// A statement that holds exactly or not.
pub struct Fact {
    pub what: String,
    pub found: String,
    pub is_met: bool,
}

/// A number that is given, not measured: of no values.
pub fn number(mean: f64) -> Mean {
    Mean { mean, error: 0.0, count: 0 }
}

/// A mean with its standard error.
pub fn cell(Mean { mean, error, .. }: &Mean) -> String {
    let sign = if *mean < 0.0 { "-" } else { "" };
    format!("{sign}{} ± {}", rounded(mean.abs(), 5), rounded(*error, 2))
}

/// The tables of all claims and facts of the page.
pub fn tables(parts: &[Part]) -> String {
    let claims: Vec<_> = parts.iter().flat_map(|part| &part.claims).collect();
    let differences: Vec<_> = claims.iter().map(|claim| claim.difference()).collect();
    let mut text = format!(
        "## Claims\n\n\
         That one mean is *below* another, or below a number that is given: ± is the standard error, *n* the number of \
         independent sets or rounds, *t* the difference over its standard error (Welch), *p* the chance of as large a one where \
         there is none, corrected for all {} claims of the table (Holm). A claim is met where p is at most {LEVEL}, not \
         met where that of the opposite is, corrected in the same way, and otherwise not decided.\n\n\
         | claim | below | n | above | n | t | p | |\n|---|---|---|---|---|---|---|---|\n",
        claims.len(),
    );
    let verdicts = verdict::claims(&differences);
    for ((claim, difference), (p, verdict)) in claims.iter().zip(&differences).zip(verdicts) {
        let [low, high] = [&claim.low, &claim.high].map(cell);
        let [n, m] = [&claim.low, &claim.high]
            .map(|mean| if mean.count == 0 { "given".to_owned() } else { mean.count.to_string() });
        let t = difference.map_or("-".to_owned(), |difference| format!("{:+.1}", difference.t));
        let (what, p) = (&claim.what, chance(p));
        _ = writeln!(text, "| {what} | {low} | {n} | {high} | {m} | {t} | {p} | {verdict} |");
    }
    let mut facts = parts.iter().flat_map(|part| &part.facts).peekable();
    if facts.peek().is_some() {
        text += "\nWhat must hold exactly, in every set:\n\n| property | found | |\n|---|---|---|\n";
    }
    for fact in facts {
        _ = writeln!(text, "| {} | {} | {} |", fact.what, fact.found, verdict::verdict(fact.is_met));
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
        assert!(chance(low, number(2.0)) < 1e-3 && chance(number(2.0), low) > 0.99 && chance(number(0.0), low) < 1e-3);
        let part = |low, high| Part { text: String::new(), claims: vec![Claim::less("x", low, high)], facts: vec![] };
        assert!(tables(&[part(low, high)]).contains("| met |") && tables(&[part(high, low)]).contains("**not met**"));
        // One value shows nothing.
        assert!(tables(&[part(Mean::of(&[1.0]), high)]).contains("| - | 1 | not decided |"));
    }

    #[test]
    fn means_are_written_with_their_sign() {
        assert_eq!(cell(&Mean { mean: -0.25, error: 0.0125, count: 3 }), "-0.25 ± 0.013");
        assert_eq!(cell(&number(3.0)), "3 ± 0");
    }
}
