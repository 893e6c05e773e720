//! Clouds of points that are thinned.

use std::f32::consts::{PI, TAU};

use azulejo::thin::{Options, thin};
use azulejo::{MAXIMAL_DENSITY, Order, Result};

use super::Study;
use super::row::{Figure, Goal, Row, section as rows_in};
use crate::reference::{random, stream};
use crate::timing::{Rounds, in_turns};
use azulejo_cli::text::grouped;

/// Points of a cloud, and those that are selected.
const POINTS: f64 = 1e6;
const SELECTED: f64 = 1e5;
/// Seconds for them by farthest-first selection and by a radius, and for all points in order.
const GOALS: [f64; 3] = [0.5, 0.35, 1.5];

pub fn section(study: &Study) -> Result<String> {
    let count = study.effort.of(POINTS) as usize;
    let mut unit = stream(5);
    let cube: Vec<_> = (0..count).map(|_| [unit(), unit(), unit()]).collect();
    let sphere: Vec<_> = random(count, 6)
        .into_iter()
        .map(|[x, y]| {
            let (height, turn) = (2.0 * x - 1.0, TAU * y);
            let width = (1.0 - height * height).sqrt();
            [width * turn.cos(), width * turn.sin(), height]
        })
        .collect();
    let mut rows = of_cloud(study, "unit square", &random(count, 4), 1.0)?;
    rows.extend(of_cloud(study, "sphere", &sphere, 4.0 * PI)?);
    rows.extend(of_cloud(study, "unit cube", &cube, f32::INFINITY)?);
    let about = "Random points. The radius is that of a maximal set of as many points as are selected by number; in the cube it is the \
        distance at which that selection ends.";
    Ok(rows_in("Clouds", about, &rows))
}

/// Thins a cloud on an area, or in a volume, whose radius is found.
fn of_cloud<const D: usize>(study: &Study, name: &str, cloud: &[[f32; D]], area: f32) -> Result<Vec<Row>> {
    let selected = study.effort.of(SELECTED) as usize;
    let by_count = Options::by_count(selected);
    let radius = if area.is_finite() {
        (MAXIMAL_DENSITY * f64::from(area) / selected as f64).sqrt()
    } else {
        let ordered = thin(&study.two, &by_count.order(Order::Progressive), cloud, None)?;
        ordered.ranks.last().copied().map_or(1.0, f64::from)
    };
    let thinned = |options: Options| move || Ok(thin(&study.one, &options, cloud, None)?.indices.len());
    let [first, second, third] = [by_count, Options::by_radius(radius), Options::progressive()].map(thinned);
    let measured = in_turns(study.effort.rounds, &[&first, &second, &third])?;
    let row = |((what, goal), rounds): ((&str, f64), &Rounds)| {
        let (count, found) = (grouped(cloud.len()), grouped(rounds.samples));
        let asked = format!("{name}: {found} of {count} points, {what}");
        Row::new(asked, Figure::time(rounds, 1.0), "s", Goal::AtMost(goal))
    };
    Ok(["farthest-first", "by radius", "in progressive order"].into_iter().zip(GOALS).zip(&measured).map(row).collect())
}
