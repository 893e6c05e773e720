//! The figures of each class, where files have a column of classes.

use std::collections::BTreeSet;
use std::fmt::Write;

use azulejo::{Classes, Progress, Result};
use serde_json::{Value, json};

use super::Set;
use super::figures::{Figure, Row, object, table};
use crate::formats::blame;
use crate::formats::set::{ClassColumn, PlaneSet, SampleSet};
use crate::progress::{part, watched};

/// A set whose points may have classes.
pub trait Classified {
    type Point: Copy;
    fn points(&self) -> &[Self::Point];
    fn classes(&self) -> &ClassColumn;
}

impl Classified for PlaneSet {
    type Point = [f32; 2];
    fn points(&self) -> &[[f32; 2]] {
        &self.points
    }
    fn classes(&self) -> &ClassColumn {
        &self.classes
    }
}

impl Classified for SampleSet {
    type Point = [f32; 3];
    fn points(&self) -> &[[f32; 3]] {
        &self.positions
    }
    fn classes(&self) -> &ClassColumn {
        &self.classes
    }
}

/// The figures of the classes of all sets.
pub enum ByClass {
    /// No file has classes.
    None,
    /// The reason why the classes are left out.
    Unread(String),
    /// Each class with its figures.
    Read(Vec<(u32, Vec<Row>)>),
}

impl ByClass {
    /// Measures the points of each class of all sets.
    pub fn of<S: Classified>(
        sets: &[Set<S>],
        figures: &[Figure],
        measure: impl Fn(&[S::Point], &Progress) -> Result<Vec<f64>>,
    ) -> Result<Self> {
        if sets.iter().all(|set| set.loaded.classes().is_none()) {
            return Ok(Self::None);
        }
        let classes = match sets.iter().map(classes_of).collect::<std::result::Result<Vec<_>, _>>() {
            Ok(classes) => classes,
            Err(reason) => return Ok(Self::Unread(reason)),
        };
        let present: BTreeSet<u32> = classes.iter().copied().flatten().copied().collect();
        let share = 1.0 / (present.len() * sets.len()) as f64;
        let mut read = Vec::new();
        watched("classes", |progress| {
            for (number, &class) in present.iter().enumerate() {
                let measure = |(i, (set, classes)): (usize, (&Set<S>, &&[u32]))| {
                    let own = set.loaded.points().iter().zip(*classes).filter(|&(_, &of)| of == class);
                    let own: Vec<_> = own.map(|(&point, _)| point).collect();
                    if own.is_empty() {
                        return Ok(vec![f64::NAN; figures.len()]);
                    }
                    let done = (number * sets.len() + i) as f64 * share;
                    measure(&own, &part(progress, done, done + share)).map_err(|error| blame(&set.path, error))
                };
                let values = sets.iter().zip(&classes).enumerate().map(measure).collect::<Result<Vec<_>>>()?;
                let row =
                    |(i, &figure): (usize, &Figure)| Row { figure, values: values.iter().map(|of| of[i]).collect() };
                read.push((class, figures.iter().enumerate().map(row).collect()));
            }
            Ok(())
        })?;
        Ok(Self::Read(read))
    }

    /// The text that is printed below the figures of the union.
    pub fn text(&self, sets: usize) -> String {
        let mut text = String::new();
        match self {
            Self::None => (),
            Self::Unread(reason) => _ = writeln!(text, "\nOf all points together, without classes: {reason}."),
            Self::Read(classes) => {
                text += "\nSo far of all points together; of each class alone:\n";
                for (class, rows) in classes {
                    _ = write!(text, "\nclass {class}\n{}", table(rows, sets));
                }
            }
        }
        text
    }

    /// Each class with its figures; null without classes.
    pub fn json(&self) -> Value {
        match self {
            Self::None | Self::Unread(_) => Value::Null,
            Self::Read(classes) => {
                classes.iter().map(|(class, rows)| json!({ "class": class, "figures": object(rows) })).collect()
            }
        }
    }
}

/// The classes of a set, or the reason why they are left out.
fn classes_of<S: Classified>(set: &Set<S>) -> std::result::Result<&[u32], String> {
    let path = set.path.display();
    match set.loaded.classes() {
        Some(Ok(classes)) if classes.iter().any(|&class| class as usize >= Classes::MOST) => {
            Err(format!("{path} has classes that are not below {}", Classes::MOST))
        }
        Some(Ok(classes)) => Ok(classes),
        Some(Err(reason)) => Err(format!("{path}: {reason}")),
        None => Err(format!("{path} has none")),
    }
}
