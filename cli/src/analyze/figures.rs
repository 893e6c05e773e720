//! Figures of sets, as rows of a table and as JSON.

use std::fmt::Write;

use serde_json::{Map, Value, json};

use crate::summary::Summary;
use crate::text::{grouped, rounded};

/// Digits of a figure in a table.
const DIGITS: usize = 6;

/// A number that describes a set.
#[derive(Clone, Copy)]
pub struct Figure {
    /// Its name in JSON.
    pub key: &'static str,
    /// Its name in the table, and its unit; none for a number and for lengths in units of the file.
    pub name: &'static str,
    pub unit: &'static str,
}

impl Figure {
    pub const fn new(key: &'static str, name: &'static str, unit: &'static str) -> Self {
        Self { key, name, unit }
    }
}

/// The values of a figure: one for each set, or one for all of them together. NaN where it is not known.
pub struct Row {
    pub figure: Figure,
    pub values: Vec<f64>,
}

/// A count or a measure in readable form.
fn shown(value: f64) -> String {
    match value {
        _ if value.is_nan() => "-".to_owned(),
        _ if value.fract() == 0.0 && (1.0..1e15).contains(&value) => grouped(value as usize),
        _ => rounded(value, DIGITS),
    }
}

/// The rows under each other: the value of a single set; mean, standard error and range of several.
pub fn table(rows: &[Row], sets: usize) -> String {
    let mut text = String::new();
    if sets > 1 {
        _ = writeln!(text, "{:<36}{:>12}{:>12}{:>12}{:>12}", "", "mean", "±", "least", "greatest");
    }
    for Row { figure, values } in rows {
        let summary = Summary::of(values);
        _ = write!(text, "{:<36}{:>12}", figure.name, shown(summary.mean));
        if sets > 1 {
            let rest = [summary.error, summary.low, summary.high].map(shown);
            let rest = if values.len() > 1 { rest } else { [const { String::new() }; 3] };
            rest.iter().for_each(|value| _ = write!(text, "{value:>12}"));
        }
        _ = writeln!(text, "{}{}", if figure.unit.is_empty() { "" } else { "  " }, figure.unit);
    }
    // Rows without a unit end with their last number.
    text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

/// An object with an entry for each row. Unknown values are null.
pub fn object(rows: &[Row]) -> Value {
    let entry = |Row { figure, values }: &Row| {
        let Summary { mean, error, low, high } = Summary::of(values);
        let mut entry = json!({ "mean": mean, "values": values, "unit": figure.unit });
        if values.len() > 1 {
            let spread = [("standard_error", error), ("least", low), ("greatest", high)];
            spread.into_iter().for_each(|(key, value)| entry[key] = json!(value));
        }
        (figure.key.to_owned(), entry)
    };
    Value::Object(rows.iter().map(entry).collect::<Map<_, _>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: Figure = Figure::new("length", "length", "m");
    const COUNT: Figure = Figure::new("count", "count", "");

    #[test]
    fn a_table_shows_the_value_of_a_set_and_the_range_of_several() {
        let single = [Row { figure: LENGTH, values: vec![0.12345] }, Row { figure: COUNT, values: vec![12_345.0] }];
        assert_eq!(table(&single, 1), format!("length{:>42}  m\ncount{:>43}\n", "0.12345", "12,345"));
        let several = [Row { figure: LENGTH, values: vec![1.0, 3.0] }, Row { figure: COUNT, values: vec![f64::NAN] }];
        let text = table(&several, 2);
        let words: Vec<Vec<_>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(words[0], ["mean", "±", "least", "greatest"]);
        assert_eq!(words[1], ["length", "2", "1", "1", "3", "m"]);
        assert_eq!(words[2], ["count", "-"]);
    }

    #[test]
    fn json_has_null_for_what_is_not_known() {
        let rows = [Row { figure: LENGTH, values: vec![1.0, 3.0] }, Row { figure: COUNT, values: vec![f64::NAN] }];
        let object = object(&rows);
        assert_eq!(object["length"]["mean"], 2.0);
        assert_eq!(object["length"]["greatest"], 3.0);
        assert!(object["count"]["mean"].is_null() && object["count"].get("least").is_none());
    }
}
