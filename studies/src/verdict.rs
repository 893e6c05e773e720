//! The verdicts of pages on goals, and the tests behind them.
//!
//! A goal that a quantity be no larger than the reference's, or the same, is tested by Welch's t: the difference of the
//! two means over its standard error, both from independent sets. All tests of a page that are judged together share
//! one level by Holm's method, so that the chance of even one false "not met" is at most that level.

use std::f64::consts::FRAC_PI_2;

use azulejo_cli::text::rounded;

/// The chance of any false verdict among goals that are judged together.
pub const LEVEL: f64 = 0.01;

/// The verdict of a goal that is missed where a difference is shown, by the chance of one as large. A test that shows
/// none does not prove that there is none.
pub fn unless_different(p: f64) -> &'static str {
    if p <= LEVEL { verdict(false) } else { "no difference shown" }
}

/// The words for a goal that is met or not.
pub fn verdict(is_met: bool) -> &'static str {
    if is_met { "met" } else { "**not met**" }
}

/// The words for a goal that is met or not, or not judged.
pub fn judged(is_met: Option<bool>) -> &'static str {
    is_met.map_or("not decided", verdict)
}

/// Mean, standard error and number of independent values: what a verdict can be computed from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    pub mean: f64,
    pub error: f64,
    pub count: usize,
}

impl Mean {
    pub fn of(values: &[f64]) -> Self {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Self { mean, error: (squares / count.saturating_sub(1).max(1) as f64 / count as f64).sqrt(), count }
    }

    /// This over a number that is known.
    pub fn over_number(&self, number: f64) -> Self {
        Self { mean: self.mean / number, error: self.error / number, count: self.count }
    }

    /// This over another of independent values: relative errors add in squares.
    pub fn over(&self, other: &Self) -> Self {
        let mean = self.mean / other.mean;
        let error = mean * (self.error / self.mean).hypot(other.error / other.mean);
        Self { mean, error, count: self.count.min(other.count) }
    }

    /// The excess of this mean over another (Welch 1947). `None` for fewer than two values each: they have no standard
    /// error.
    pub fn above(&self, other: &Self) -> Option<Difference> {
        let [own, others] = [self, other].map(|one| one.error.powi(2));
        let squares = own + others;
        let freedom =
            squares.powi(2) / (own.powi(2) / (self.count as f64 - 1.0) + others.powi(2) / (other.count as f64 - 1.0));
        (self.count > 1 && other.count > 1).then(|| Difference::new(self.mean - other.mean, squares.sqrt(), freedom))
    }

    /// The excess of this mean over a number that is known.
    pub fn above_number(&self, number: f64) -> Option<Difference> {
        (self.count > 1).then(|| Difference::new(self.mean - number, self.error, self.count as f64 - 1.0))
    }

    /// The mean with its standard error: "0.8618 ± 4e-5". Of a single value the error is not known.
    pub fn cell(&self, digits: usize) -> String {
        let error = if self.count > 1 { rounded(self.error, 1) } else { "?".to_owned() };
        format!("{} ± {error}", rounded(self.mean, digits))
    }
}

/// A difference over its standard error, and the degrees of freedom of Student's distribution that it follows by
/// chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    pub t: f64,
    pub freedom: f64,
}

impl Difference {
    fn new(difference: f64, error: f64, freedom: f64) -> Self {
        // Equal values on both sides have no error; nor have they a difference.
        let t = if difference == 0.0 { 0.0 } else { difference / error };
        Self { t, freedom: if freedom.is_finite() { freedom.max(1.0) } else { 1.0 } }
    }

    /// The chance of one at least as large.
    pub fn chance_of_larger(&self) -> f64 {
        upper_tail(self.t, self.freedom)
    }

    /// The chance of one at least as large or as small.
    pub fn chance_of_farther(&self) -> f64 {
        (2.0 * upper_tail(self.t.abs(), self.freedom)).min(1.0)
    }
}

/// The part of Student's distribution above `t`: with t = √freedom tan θ its density becomes a power of cos θ.
fn upper_tail(t: f64, freedom: f64) -> f64 {
    let mass = |from: f64| simpson(from, FRAC_PI_2, |angle| angle.cos().max(0.0).powf(freedom - 1.0));
    if t < 0.0 {
        return 1.0 - upper_tail(-t, freedom);
    }
    let beyond = if t.is_finite() { mass((t / freedom.sqrt()).atan()) } else { 0.0 };
    beyond / (2.0 * mass(0.0))
}

/// The integral of a smooth function by Simpson's rule.
fn simpson(from: f64, to: f64, function: impl Fn(f64) -> f64) -> f64 {
    const PARTS: u32 = 2000;
    let step = (to - from) / f64::from(PARTS);
    let weight = |i: u32| if i == 0 || i == PARTS { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    (0..=PARTS).map(|i| weight(i) * function(from + f64::from(i) * step)).sum::<f64>() * step / 3.0
}

/// Chances corrected for the number of tests (Holm 1979): those at most [`LEVEL`] are rejected, and the chance that any
/// of them is so falsely is at most that level.
pub fn holm(chances: &[f64]) -> Vec<f64> {
    let mut order: Vec<_> = (0..chances.len()).collect();
    order.sort_by(|&a, &b| chances[a].total_cmp(&chances[b]));
    let (mut corrected, mut largest) = (vec![0.0; chances.len()], 0.0f64);
    for (rank, &i) in order.iter().enumerate() {
        largest = largest.max(((chances.len() - rank) as f64 * chances[i]).min(1.0));
        corrected[i] = largest;
    }
    corrected
}

/// The verdicts on claims that differences are above zero, each after its corrected chance. A claim is met where its
/// chance is at most [`LEVEL`], not met where that of the opposite is, and otherwise not decided.
pub fn claims(differences: &[Option<Difference>]) -> Vec<(f64, &'static str)> {
    let corrected = |chance: fn(&Difference) -> f64| {
        holm(&differences.iter().map(|it| it.as_ref().map_or(1.0, chance)).collect::<Vec<_>>())
    };
    let opposite = |it: &Difference| Difference { t: -it.t, ..*it }.chance_of_larger();
    let (own, opposite) = (corrected(Difference::chance_of_larger), corrected(opposite));
    let verdict = |(own, opposite): (f64, f64)| match (own <= LEVEL, opposite <= LEVEL) {
        (false, false) => (own, judged(None)),
        (is_met, _) => (own, judged(Some(is_met))),
    };
    own.into_iter().zip(opposite).map(verdict).collect()
}

/// A chance as pages write it.
pub fn chance(chance: f64) -> String {
    match chance {
        ..1e-6 => "< 1e-6".to_owned(),
        ..0.01 => format!("{chance:.1e}"),
        _ => rounded(chance, 3),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn tails_are_those_of_printed_tables() {
        // Student's distribution: t, degrees of freedom, upper tail.
        for (t, freedom, tail) in
            [(6.314, 1.0, 0.05), (31.821, 1.0, 0.01), (2.015, 5.0, 0.05), (4.501, 8.0, 0.001), (2.626, 100.0, 0.005)]
        {
            assert!((upper_tail(t, freedom) / tail - 1.0).abs() < 2e-3, "{t} {freedom}: {}", upper_tail(t, freedom));
            assert!((upper_tail(-t, freedom) - 1.0 + tail).abs() < 1e-4);
        }
        // With one degree of freedom it is Cauchy's distribution, which is known in closed form.
        for t in [0.0, 0.3, 2.0, 50.0] {
            assert!((upper_tail(t, 1.0) - (0.5 - f64::atan(t) / PI)).abs() < 1e-9);
        }
        assert!(upper_tail(9.0, 150.0) > 0.0 && upper_tail(9.0, 150.0) < 1e-14);
        assert_eq!(upper_tail(f64::INFINITY, 3.0), 0.0);
    }

    #[test]
    fn means_are_written_with_their_errors() {
        assert_eq!(Mean::of(&[0.25, 0.27]).cell(4), "0.26 ± 0.01");
        assert_eq!(Mean::of(&[-1e-9]).cell(2), "-1e-9 ± ?");
    }

    #[test]
    fn a_difference_is_that_of_welch() {
        // Means 3 and 6, variances 2.5 and 10, of five values each.
        let low = Mean::of(&[1.0, 2.0, 3.0, 4.0, 5.0]);
        let high = Mean::of(&[2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!((low.mean, low.count), (3.0, 5));
        assert!((low.error - 0.5f64.sqrt()).abs() < 1e-12);
        let above = high.above(&low).unwrap();
        assert!((above.t - 3.0 / 2.5f64.sqrt()).abs() < 1e-12);
        assert!((above.freedom - 6.25 / (0.25 / 4.0 + 4.0 / 4.0)).abs() < 1e-12);
        assert!((low.above(&high).unwrap().chance_of_farther() - 2.0 * above.chance_of_larger()).abs() < 1e-12);
        assert!((high.above_number(6.0).unwrap().chance_of_larger() - 0.5).abs() < 1e-9);
    }

    #[test]
    fn what_has_no_standard_error_has_no_difference_or_a_certain_one() {
        let (one, same) = (Mean::of(&[1.0]), Mean::of(&[2.0, 2.0]));
        assert!(one.above(&same).is_none() && same.above(&one).is_none() && one.above_number(0.0).is_none());
        assert_eq!(same.above(&same).unwrap().chance_of_farther(), 1.0);
        assert_eq!(same.above(&Mean::of(&[1.0, 1.0])).unwrap().chance_of_larger(), 0.0);
        assert_eq!(same.above_number(3.0).unwrap().chance_of_larger(), 1.0);
    }

    #[test]
    fn a_ratio_has_the_relative_errors_of_both() {
        let (own, other) = (Mean { mean: 6.0, error: 0.3, count: 9 }, Mean { mean: 3.0, error: 0.36, count: 4 });
        let ratio = own.over(&other);
        assert_eq!((ratio.mean, ratio.count), (2.0, 4));
        assert!((ratio.error / 2.0 - 0.13).abs() < 1e-12);
        assert_eq!(own.over_number(3.0), Mean { mean: 2.0, error: 0.3 / 3.0, count: 9 });
    }

    #[test]
    fn chances_are_corrected_step_by_step() {
        let corrected = holm(&[0.01, 0.04, 0.03, 0.005]);
        for (own, expected) in corrected.iter().zip([0.03, 0.06, 0.06, 0.02]) {
            assert!((own - expected).abs() < 1e-12, "{corrected:?}");
        }
        assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
        assert!(holm(&[]).is_empty());
    }

    #[test]
    fn a_claim_is_met_or_refuted_or_not_decided() {
        let difference = |t| Some(Difference { t, freedom: 20.0 });
        let claims = claims(&[difference(9.0), difference(-9.0), difference(1.0), None]);
        assert_eq!(
            claims.iter().map(|it| it.1).collect::<Vec<_>>(),
            ["met", "**not met**", "not decided", "not decided"]
        );
        assert!(claims[0].0 < 1e-6 && claims[1].0 == 1.0 && claims[3].0 == 1.0);
        // Decided alone, but not among many: t of 3 has a chance of 0.0035.
        assert_eq!(super::claims(&[difference(3.0)])[0].1, "met");
        assert_eq!(super::claims(&[difference(3.0); 4])[0].1, "not decided");
    }

    #[test]
    fn few_false_verdicts_are_made_where_nothing_differs() {
        // Twenty comparisons of ten values each of the same distribution, 400 times: the level holds for all twenty.
        let families = 400u64;
        let rejected = (0..families).filter(|&family| {
            let values =
                |seed| crate::reference::random(10, seed).iter().map(|[x, _]| f64::from(*x)).collect::<Vec<_>>();
            let chance = |test| {
                let [own, other] = [0u64, 1].map(|side| Mean::of(&values(2 * (20 * family + test) + side)));
                own.above(&other).unwrap().chance_of_larger()
            };
            holm(&(0..20).map(chance).collect::<Vec<_>>()).iter().any(|&chance| chance <= LEVEL)
        });
        // 4 are expected; more than 12 would come by chance once in 3,000 times.
        assert!(rejected.count() <= 12);
    }
}
