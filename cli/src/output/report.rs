//! The report of a command about a file that it has written: a line of text, or an object of JSON.

use std::path::Path;

use serde_json::{Map, Value};

use crate::text::grouped;

/// Facts about a file, in their order.
#[derive(Default)]
pub struct Report {
    facts: Map<String, Value>,
    texts: Vec<String>,
}

impl Report {
    /// With a fact: its name and value in JSON, and the words of the line; none if they are empty.
    pub fn fact(mut self, name: &str, value: impl Into<Value>, text: impl Into<String>) -> Self {
        self.facts.insert(name.to_owned(), value.into());
        self.say(text)
    }

    /// With a number of things, such as "1,234 triangles".
    pub fn count(self, name: &str, count: usize, what: &str) -> Self {
        self.fact(name, count, format!("{} {what}", grouped(count)))
    }

    /// With words that repeat facts.
    pub fn say(mut self, text: impl Into<String>) -> Self {
        self.texts.extend(Some(text.into()).filter(|text| !text.is_empty()));
        self
    }

    /// With all that another report has.
    pub fn and(mut self, other: Self) -> Self {
        self.facts.extend(other.facts);
        self.texts.extend(other.texts);
        self
    }

    /// With the time of the work.
    pub fn seconds(self, seconds: f64) -> Self {
        self.fact("seconds", seconds, format!("{seconds:.2} s"))
    }

    /// The line about a file.
    pub fn line(&self, path: &Path) -> String {
        format!("{}: {}", path.display(), self.texts.join(", "))
    }

    /// The object, which names the file.
    pub fn json(&self, path: &Path) -> String {
        let mut object = Map::new();
        object.insert("file".to_owned(), path.to_string_lossy().into());
        object.extend(self.facts.clone());
        Value::Object(object).to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_a_line_or_an_object() {
        let report = Report::default()
            .count("samples", 1234, "samples")
            .fact("maximal", true, "")
            .and(Report::default().fact("radius", 0.5, "radius 0.5"))
            .seconds(0.126);
        let path = Path::new("a \"b\".ply");
        assert_eq!(report.line(path), "a \"b\".ply: 1,234 samples, radius 0.5, 0.13 s");
        let object: Value = serde_json::from_str(&report.json(path)).unwrap();
        let expected = serde_json::json!({
            "file": "a \"b\".ply", "samples": 1234, "maximal": true, "radius": 0.5, "seconds": 0.126
        });
        assert_eq!(object, expected);
    }

    #[test]
    fn numbers_that_json_lacks_are_null() {
        let report = Report::default().fact("smallest", f64::INFINITY, "");
        assert_eq!(report.json(Path::new("a")), r#"{"file":"a","smallest":null}"#);
    }
}
