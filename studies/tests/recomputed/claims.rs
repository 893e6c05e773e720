//! Tables of claims: two means with their errors and numbers, then t, p and the verdict.

use super::Recomputed;
use super::table::{Table, numbers};

/// The level at which claims are decided, and by how much a chance may differ from it by what rounding does to errors.
const LEVEL: f64 = 0.01;
const NEAR: f64 = 3.0;

/// Where the columns are.
pub struct Columns {
    t: usize,
}

impl Columns {
    pub fn of(table: &Table) -> Option<Self> {
        let t = table.head.iter().position(|head| head == "t")?;
        let is_count = |before: usize| t >= 4 && ["n", "sets"].contains(&&*table.head[t - before]);
        let is_claim = is_count(3) && is_count(1) && table.head.get(t + 1)? == "p" && table.head.len() == t + 3;
        is_claim.then_some(Self { t })
    }
}

/// A mean, its error, and the number of its values: none of a number that is given.
fn mean(row: &[String], column: usize) -> ([f64; 2], Option<f64>) {
    let all = numbers(&row[column]);
    let error = all.get(1).map_or(f64::NAN, |error| error.value);
    ([all[0].value, error], numbers(&row[column + 1]).first().map(|count| count.value))
}

/// Welch's degrees of freedom.
fn freedom([a, b]: [([f64; 2], Option<f64>); 2]) -> f64 {
    let part = |([_, error], count): ([f64; 2], Option<f64>)| {
        let square = error * error;
        [square, count.map_or(0.0, |count| square * square / (count - 1.0))]
    };
    let [[a, a_part], [b, b_part]] = [part(a), part(b)];
    let freedom = (a + b).powi(2) / (a_part + b_part);
    if freedom.is_finite() { freedom.max(1.0) } else { 1.0 }
}

/// The part of Student's distribution above t, by the midpoint rule on the angle whose tangent is t / √freedom.
fn above(t: f64, freedom: f64) -> f64 {
    let part = |from: f64| {
        let step = (std::f64::consts::FRAC_PI_2 - from) / 4000.0;
        (0..4000).map(|i| (from + (f64::from(i) + 0.5) * step).cos().powf(freedom - 1.0)).sum::<f64>() * step
    };
    let tail = part((t.abs() / freedom.sqrt()).atan()) / (2.0 * part(0.0));
    if t < 0.0 { 1.0 - tail } else { tail }
}

/// Holm's correction: the k-th smallest of n chances times n - k, and no smaller than those before.
fn corrected(chances: &[f64]) -> Vec<f64> {
    let of = |own: f64| {
        let up_to = |limit: f64| chances.iter().filter(move |&&chance| chance < limit).count();
        let smaller = chances.iter().filter(|&&chance| chance <= own);
        smaller.map(|&chance| ((chances.len() - up_to(chance)) as f64 * chance).min(1.0)).fold(0.0, f64::max)
    };
    chances.iter().map(|&chance| of(chance)).collect()
}

/// A row that was read.
struct Claim<'a> {
    row: &'a [String],
    t: f64,
    /// The chance of as large a difference, and of the opposite.
    chances: [f64; 2],
}

impl<'a> Claim<'a> {
    /// None of a row without a standard error.
    fn of(table: &Table, row: &'a [String], columns: &Columns) -> Option<Self> {
        let t = numbers(&row[columns.t]).first()?.value;
        let [low, high] = [4, 2].map(|before| mean(row, columns.t - before));
        // Of the smallest distance more is better.
        let sign =
            if table.head[columns.t - 4] == "momentum" && row.iter().any(|cell| cell == "ρ") { -1.0 } else { 1.0 };
        let difference = sign * (high.0[0] - low.0[0]) / low.0[1].hypot(high.0[1]);
        // Errors have one or two digits.
        assert!((difference - t).abs() <= 0.1 + 0.4 * t.abs(), "t is {difference}: {row:?}");
        let freedom = freedom([low, high]);
        let is_two_sided = row[0].starts_with("contrast as");
        let chances =
            if is_two_sided { [2.0 * above(t.abs(), freedom); 2] } else { [t, -t].map(|t| above(t, freedom)) };
        Some(Self { row, t, chances })
    }
}

pub fn check(table: &Table, columns: &Columns, all: &mut Recomputed) {
    let claims: Vec<_> = table.rows.iter().map(|row| Claim::of(table, row, columns)).collect();
    let [own, opposite] = [0, 1].map(|side| {
        corrected(
            &claims.iter().map(|claim| claim.as_ref().map_or(1.0, |claim| claim.chances[side])).collect::<Vec<_>>(),
        )
    });
    let is_decided = |chance: f64| [chance / NEAR <= LEVEL, chance * NEAR > LEVEL];
    for ((claim, row), (own, opposite)) in claims.iter().zip(&table.rows).zip(own.into_iter().zip(opposite)) {
        let printed = &row[columns.t + 1];
        let p = numbers(printed)[0].value;
        let [may_be, may_not_be] = is_decided(own);
        // The printed chance has all digits of the errors: it decides, and has to be near what they give.
        let is_near = [p <= LEVEL && may_be, p > LEVEL && may_not_be].contains(&true);
        if !is_near {
            all.wrong.push(format!("p is {own}: {row:?}"));
            continue;
        }
        let [may_be_opposite, may_not_be_opposite] = is_decided(opposite);
        let mut expected = Vec::new();
        if table.text.contains("no difference was shown") {
            let shown = if table.text.contains("*met* says that no difference was shown") {
                "met"
            } else {
                "no difference shown"
            };
            expected.push(if p <= LEVEL { "**not met**" } else { shown });
        } else if p <= LEVEL {
            expected.push("met");
        } else if !table.text.contains("otherwise not decided") {
            expected.push("**not met**");
        } else {
            let is_below = claim.as_ref().is_some_and(|claim| claim.t < 0.0);
            if may_be_opposite && is_below {
                expected.push("**not met**");
            }
            if may_not_be_opposite || !is_below {
                expected.push("not decided");
            }
        }
        let row = claim.as_ref().map_or(&row[..], |claim| claim.row);
        all.check(row, &row[columns.t + 2], &expected);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_are_those_of_printed_tables() {
        for (t, freedom, tail) in [(6.314, 1.0, 0.05), (4.501, 8.0, 0.001), (2.626, 100.0, 0.005)] {
            assert!((above(t, freedom) / tail - 1.0).abs() < 2e-3 && (above(-t, freedom) - 1.0 + tail).abs() < 1e-4);
        }
        let chances = corrected(&[0.01, 0.04, 0.03, 0.005]);
        let known = [0.03, 0.06, 0.06, 0.02];
        assert!(chances.iter().zip(known).all(|(own, known)| (own - known).abs() < 1e-12), "{chances:?}");
    }

    /// True if the verdicts of some rows are all right, of a table with this text before it.
    fn is_right(text: &str, rows: &[&str]) -> bool {
        let head = "| claim | below | n | above | n | t | p | |\n|---|---|---|---|---|---|---|---|";
        let all = Recomputed::of(&format!("## Claims\n\n{text}\n\n{head}\n{}\n", rows.join("\n")));
        assert_eq!(all.right + all.wrong.len(), rows.len(), "{all:?}");
        all.wrong.is_empty()
    }

    #[test]
    fn a_claim_is_met_or_refuted_or_not_decided() {
        let three = "and otherwise not decided.";
        let row = |above: &str, t: &str, p: &str, verdict: &str| {
            format!("| x | 10 ± 0.1 | 20 | {above} ± 0.1 | 20 | {t} | {p} | {verdict} |")
        };
        let of = |text: &str, row: String| is_right(text, &[&row]);
        assert!(
            of(three, row("11", "+7.1", "< 1e-6", "met")) && !of(three, row("11", "+7.1", "< 1e-6", "not decided"))
        );
        assert!(of(three, row("9", "-7.1", "1", "**not met**")) && !of(three, row("9", "-7.1", "1", "not decided")));
        assert!(of(three, row("10.1", "+0.7", "0.242", "not decided")));
        assert!(
            !of(three, row("10.1", "+0.7", "0.242", "**not met**")) && !of(three, row("10.1", "+0.7", "0.242", "met"))
        );
        // A chance that does not follow from the means.
        assert!(!of(three, row("10.1", "+0.7", "1e-4", "met")));
        assert!(of("", row("10.1", "+0.7", "0.242", "**not met**")));
        let shown = "Elsewhere no difference was shown.";
        assert!(
            of(shown, row("10.1", "+0.7", "0.242", "no difference shown"))
                && !of(shown, row("10.1", "+0.7", "0.242", "met"))
        );
        assert!(of(shown, row("11", "+7.1", "< 1e-6", "**not met**")));
        let given = "| x | 1 ± 0 | given | 1.2 ± 0.02 | 12 | +10.0 | < 1e-6 | met |";
        assert!(is_right(three, &[given]));
    }

    #[test]
    fn many_claims_share_one_level() {
        let row = |verdict: &str, p: &str| format!("| x | 10 ± 0.1 | 20 | 10.42 ± 0.1 | 20 | +3.0 | {p} | {verdict} |");
        let three = "and otherwise not decided.";
        assert!(is_right(three, &[&row("met", "2.6e-3")]));
        let rows: Vec<_> = (0..20).map(|_| row("not decided", "0.052")).collect();
        assert!(is_right(three, &rows.iter().map(|row| &**row).collect::<Vec<_>>()));
        let rows: Vec<_> = (0..20).map(|_| row("met", "2.6e-3")).collect();
        assert!(!is_right(three, &rows.iter().map(|row| &**row).collect::<Vec<_>>()));
    }
}
