//! Computes the verdicts of a page anew, from what the page prints beside them. Of its own, without code of the
//! studies.

mod claims;
mod table;

pub use table::{Table, numbers, tables};

/// The result of recomputing the verdicts of a page.
#[derive(Debug, Default)]
pub struct Recomputed {
    /// The number of verdicts that follow from the page.
    pub right: usize,
    /// The verdicts that do not, and why.
    pub wrong: Vec<String>,
    /// Rows with verdicts that are in no known form.
    pub unknown: Vec<String>,
}

/// Verdicts as pages write them.
const VERDICTS: [&str; 4] = ["met", "**not met**", "not decided", "no difference shown"];

/// Rounds of a measurement that decide: fewer are all on one side of a median by chance too often.
const DECIDING_ROUNDS: f64 = 7.0;

impl Recomputed {
    /// All verdicts of a page.
    pub fn of(page: &str) -> Self {
        let mut all = Self::default();
        for table in &tables(page) {
            match claims::Columns::of(table) {
                Some(columns) => claims::check(table, &columns, &mut all),
                None => table.rows.iter().for_each(|row| all.row(table, row)),
            }
        }
        all
    }

    fn check(&mut self, row: &[String], found: &str, expected: &[&str]) {
        match expected.contains(&found) {
            true => self.right += 1,
            false => self.wrong.push(format!("{found}, not {expected:?}: {row:?}")),
        }
    }

    fn row(&mut self, table: &Table, row: &[String]) {
        let mut is_unknown = false;
        for (column, cell) in row.iter().enumerate() {
            let (figure, found) = match cell.rsplit_once(", ") {
                Some((figure, found)) if VERDICTS.contains(&found) => (figure, found),
                _ if VERDICTS.contains(&&**cell) => ("", &**cell),
                _ => continue,
            };
            let head = table.head.get(column).map_or("", |head| head);
            let expected = match figure {
                "" => of_whole_row(table, row),
                figure => goal(&row[0]).or_else(|| goal(head)).map(|goal| of_figure(table, figure, goal)),
            };
            match expected {
                Some(expected) => self.check(row, found, &expected),
                None => is_unknown = true,
            }
        }
        if is_unknown {
            self.unknown.push(row.join(" | "));
        }
    }
}

/// The condition on a figure.
#[derive(Clone, Copy)]
enum Goal {
    AtMost(f64),
    AtLeast(f64),
    /// At most this, and its inverse at most this.
    EitherWay(f64),
}

/// The goal that a head states: "goal: at most 1.5".
fn goal(head: &str) -> Option<Goal> {
    let (_, goal) = head.split_once("goal: ")?;
    let bound = *numbers(goal).first()?;
    match goal {
        _ if goal.ends_with("either way") => Some(Goal::EitherWay(bound.value)),
        _ if goal.starts_with("at most ") => Some(Goal::AtMost(bound.value)),
        _ if goal.starts_with("at least ") => Some(Goal::AtLeast(bound.value)),
        _ => None,
    }
}

impl Goal {
    /// The possibility that a number meets the goal, and that it misses it: both where it was rounded to the limit.
    fn may(self, number: table::Number) -> [bool; 2] {
        let [low, high] = [number.value - number.rounding, number.value + number.rounding];
        match self {
            Self::AtMost(most) => [low <= most, high > most],
            Self::AtLeast(least) => [high >= least, low < least],
            Self::EitherWay(most) => [low <= most && high >= 1.0 / most, high > most || low < 1.0 / most],
        }
    }
}

/// The verdicts "met", "not met" and "not decided", as far as each is possible.
fn allowed(possible: [bool; 3]) -> Vec<&'static str> {
    VERDICTS.into_iter().zip(possible).filter(|it| it.1).map(|it| it.0).collect()
}

/// The verdicts that a figure allows: of a median with its range, or of a number that is exact.
fn of_figure(table: &Table, figure: &str, goal: Goal) -> Vec<&'static str> {
    let all = numbers(figure);
    let [_, low, high] = all[..] else {
        let [may_meet, may_miss] = goal.may(all[0]);
        return allowed([may_meet, may_miss, false]);
    };
    assert!(figure.contains(" to "), "{figure} has three numbers, but no range");
    if table.rounds().is_none_or(|rounds| rounds < DECIDING_ROUNDS) {
        return vec!["not decided"];
    }
    let [low, high] = [low, high].map(|bound| goal.may(bound));
    let mut allowed = Vec::new();
    if low[0] && high[0] {
        allowed.push("met");
    }
    // A range that spans a goal of either way is decided by rounds in between, which are not printed.
    if low[1] && high[1] {
        allowed.push("**not met**");
    }
    if low[0] && high[1] || low[1] && high[0] || matches!(goal, Goal::EitherWay(_)) && low[1] && high[1] {
        allowed.push("not decided");
    }
    allowed
}

/// The verdicts that a row allows whose last cell is one.
fn of_whole_row(table: &Table, row: &[String]) -> Option<Vec<&'static str>> {
    let one = |is_met: bool| Some(vec![if is_met { "met" } else { "**not met**" }]);
    let (what, found) = (&row[0], numbers(&row[1]));
    // Distances and coverage of sets: "maximal up to 1e-4 r".
    if let Some((_, limit)) = what.split_once("conflict-free, and maximal up to ") {
        let (limit, [smallest, farthest]) = (numbers(limit)[0].value, [found[0].value, found[1].value]);
        return one(smallest >= 1.0 && farthest <= 1.0 + limit + 5e-7);
    }
    if let Some((_, times)) = what.split_once(": ends after ") {
        return one(found.iter().all(|found| found.value == numbers(times)[0].value));
    }
    // The ratios of the errors, at each width.
    if table.head.iter().any(|head| head.starts_with("width ")) {
        let gains = table.head.iter().zip(row).filter(|(head, _)| head.starts_with("width "));
        let gains: Vec<_> = gains.map(|(_, cell)| Goal::AtLeast(1.0).may(numbers(cell)[0])).collect();
        let mut allowed = Vec::new();
        if gains.iter().all(|may| may[0]) {
            allowed.push("met");
        }
        if gains.iter().any(|may| may[1]) {
            allowed.push("**not met**");
        }
        return Some(allowed);
    }
    // A measured figure with a goal beside it: "at most 300 ms".
    if let Some(column) = table.head.iter().position(|head| head == "goal").filter(|&column| column > 0) {
        let bound = numbers(&row[column])[0].value;
        let goal = if row[column].starts_with("at least") { Goal::AtLeast(bound) } else { Goal::AtMost(bound) };
        if let Some(range) = table.head.iter().position(|head| head == "range") {
            return Some(of_range(goal, found[0], &numbers(&row[range])));
        }
        let [may_meet, may_miss] = goal.may(found[0]);
        return Some(allowed([may_meet, may_miss, false]));
    }
    let stated = stated(what)?;
    let [may_meet, may_miss] = stated.may(*found.first()?);
    Some(allowed([may_meet, may_miss, false]))
}

/// The verdicts that a figure allows whose range has a column of its own: of a median, which all rounds or none decide,
/// or of the worst of all, which decides by itself.
fn of_range(goal: Goal, figure: table::Number, range: &[table::Number]) -> Vec<&'static str> {
    let [low, high] = [range[0], range[1]].map(|end| goal.may(end));
    let worst = if matches!(goal, Goal::AtLeast(_)) { range[0] } else { range[1] };
    let is_worst = (figure.value - worst.value).abs() <= figure.rounding + worst.rounding;
    let spans = low[0] && high[1] || low[1] && high[0];
    allowed([low[0] && high[0], low[1] && high[1] || is_worst && spans, spans])
}

/// A goal in words: "at most 4 ×", "within 0.5 dB", "1 million per second", "of one class: 2 ×".
fn stated(what: &str) -> Option<Goal> {
    if let Some((_, bound)) = what.split_once(" at most ").or_else(|| what.split_once(" within ")) {
        let bound = numbers(bound);
        let allowed = if what.contains(" of it for rounding") { 1.0 + bound.get(1)?.value } else { 1.0 };
        return Some(Goal::AtMost(bound[0].value * allowed));
    }
    if let Some((bound, _)) = what.split_once(" million per second") {
        return Some(Goal::AtLeast(numbers(bound).last()?.value));
    }
    let (_, bound) = what.rsplit_once(": ")?;
    bound.ends_with(['×', 's']).then(|| Goal::AtMost(numbers(bound)[0].value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(section: &str, head: &str, row: &str) -> Recomputed {
        let line = "|---".repeat(head.matches('|').count() - 1);
        Recomputed::of(&format!("## A section\n\n{section}\n\n{head}\n{line}|\n{row}\n"))
    }

    fn is_right(section: &str, head: &str, row: &str) -> bool {
        let all = of(section, head, row);
        assert!(all.unknown.is_empty() && all.right + all.wrong.len() == 1, "{row}: {all:?}");
        all.right == 1
    }

    #[test]
    fn a_range_decides_or_does_not() {
        let of =
            |row: &str| is_right("Medians of 7 rounds.", "| | x |", &format!("| factor; goal: at least 1.7 | {row} |"));
        assert!(
            of("1.78 (1.71 to 1.8), met") && !of("1.78 (1.69 to 1.8), met") && of("1.78 (1.69 to 1.8), not decided")
        );
        assert!(
            of("1.5 (1.4 to 1.6), **not met**")
                && !of("1.72 (1.6 to 1.8), **not met**")
                && !of("2 (1.9 to 3), not decided")
        );
        // At the limit rounding hides which.
        assert!(of("1.7 (1.7 to 1.8), met") && of("1.7 (1.7 to 1.8), not decided"));
        let of_two = |row: &str| is_right("2 rounds.", "| | x |", &format!("| factor; goal: at least 1.7 | {row} |"));
        assert!(of_two("2 (2 to 3), not decided") && !of_two("2 (2 to 3), met"));
    }

    #[test]
    fn goals_are_found_in_heads_of_columns_and_numbers_judged_alone() {
        let head = "| scene | over; goal: at most 1.5 either way |";
        let of = |row: &str| is_right("Of 7 rounds", head, &format!("| bunny | {row} |"));
        assert!(of("1 (0.9 to 1.2), met") && !of("0.6 (0.5 to 0.66), met") && of("0.6 (0.5 to 0.66), **not met**"));
        let exact = |cell: &str| is_right("", "| | x |", &format!("| spacings; goal: at most 6 | {cell} |"));
        assert!(exact("0.030, met") && exact("-12.1, met") && exact("6.100, **not met**") && !exact("6.100, met"));
    }

    #[test]
    fn goals_in_words_are_understood() {
        let of = |what: &str, found: &str, verdict: &str| {
            is_right("", "| goal | found | |", &format!("| {what} | {found} | {verdict} |"))
        };
        let ratio = "√2: covering radius / smallest distance at most 1.4142 in all, up to 0.0001 of it for rounding";
        assert!(of(ratio, "1.4143", "met") && !of(ratio, "1.4146", "met"));
        assert!(of("anisotropy within 0.5 dB", "0.1 dB", "met") && !of("anisotropy within 0.5 dB", "0.7 dB", "met"));
        assert!(of("1,000,000 samples, quotient √2: 1 million per second", "0.999", "**not met**"));
        assert!(of("bunny, own radii 1, 1: 2 ×", "2.10 ×", "**not met**"));
        let facts = "nine sets: conflict-free, and maximal up to 1e-3 r";
        assert!(of(facts, "distances from 1.000000 r, all places within 1.000096 r", "met"));
        assert!(!of(facts, "distances from 0.999900 r, all places within 1.000096 r", "met"));
    }

    #[test]
    fn a_range_in_a_column_of_its_own_decides_or_does_not() {
        let head = "| asked | measured | range | goal | |";
        let of = |row: &str| is_right("", head, &format!("| a call | {row} |"));
        assert!(of("2 s | 1.5 to 2.5 | at most 3 s | met") && of("4 s | 3.5 to 5 | at most 3 s | **not met**"));
        assert!(of("2 s | 1.5 to 3.5 | at most 3 s | not decided"));
        assert!(!of("2 s | 1.5 to 3.5 | at most 3 s | met") && !of("2 s | 1.5 to 3.5 | at most 3 s | **not met**"));
        // The worst of all decides.
        assert!(of("0.84 | 0.84 to 0.86 | at least 0.85 | **not met**"));
        assert!(!of("0.84 | 0.84 to 0.86 | at least 0.85 | met"));
    }

    #[test]
    fn what_is_not_understood_is_said() {
        assert_eq!(of("", "| goal | found | |", "| beauty | plenty | met |").unknown.len(), 1);
    }
}
