//! The density of maximal sets by the method of their filling, against the jamming limit.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, ProjectionOptions};
use azulejo::{Context, MAXIMAL_DENSITY, Progress, Result};
use azulejo_cli::procedural::shapes;

use super::Effort;
use super::scenes::{Scene, in_one_piece, radius, sphere};
use super::variants::ONE_PIECE;
use crate::verdict::{Difference, LEVEL, Mean, chance, holm, unless_different};
use azulejo_cli::text::grouped;

/// A way to a maximal set.
#[derive(Clone, Copy)]
struct Way {
    name: &'static str,
    iterations: u32,
    /// True if sets are so small that they are filled in one piece.
    is_one_piece: bool,
    /// The number of samples over that of the effort.
    times: f64,
}

impl Way {
    fn count(self, effort: &Effort) -> f64 {
        let count = self.times * effort.bias;
        if self.is_one_piece { count.min(ONE_PIECE) } else { count }
    }
}

/// The ways, of which the first is unbiased.
const WAYS: [Way; 4] = [
    Way { name: "filled in one piece", iterations: 0, is_one_piece: true, times: 1.0 },
    Way { name: "filled cube by cube", iterations: 0, is_one_piece: false, times: 1.0 },
    Way { name: "filled cube by cube", iterations: 0, is_one_piece: false, times: 10.0 },
    Way { name: "projected once, then filled", iterations: 1, is_one_piece: false, times: 1.0 },
];

/// The sets of one way on one surface.
pub struct Density {
    surface: &'static str,
    /// True if the surface has no boundary and no sharp folds, so that the jamming limit is that of its unbiased sets.
    is_smooth: bool,
    way: Way,
    /// The wanted number of samples, approximately.
    count: f64,
    /// N·r² per area.
    density: Mean,
}

/// The sets on a sphere, a torus and, where there is one, the bunny.
pub fn measure(context: &Context, scenes: &[Scene], effort: &Effort, progress: &Progress) -> Result<Vec<Density>> {
    let torus = {
        let (positions, triangles) = shapes::torus(400, 160);
        Arc::new(Mesh::new(positions, triangles)?)
    };
    let bunny = scenes.iter().find(|scene| scene.name == "bunny").map(|scene| ("bunny", scene.mesh.clone(), false));
    let surfaces: Vec<_> = [("sphere", sphere()?, true), ("torus", torus, true)].into_iter().chain(bunny).collect();
    let mut all = Vec::new();
    for (surface, mesh, is_smooth) in &surfaces {
        for way in WAYS {
            let count = way.count(effort);
            let radius = radius(mesh, count);
            let mesh = if way.is_one_piece { &in_one_piece(mesh, radius)? } else { mesh };
            let set = |seed: u64| {
                let options = ProjectionOptions::new(radius).seed(seed);
                let samples = psp::project(context, mesh, &options, way.iterations, true, None)?.0.len();
                Ok(samples as f64 * radius * radius / mesh.area())
            };
            // As many samples of each way.
            let sets = (effort.sets as f64 * effort.bias / count).round().max(2.0) as u64;
            let first = 10_000 * all.len() as u64;
            let densities: Vec<f64> = (first..first + sets).map(set).collect::<Result<_>>()?;
            all.push(Density { surface, is_smooth: *is_smooth, way, count, density: Mean::of(&densities) });
            _ = progress(all.len() as f64 / (surfaces.len() * WAYS.len()) as f64);
        }
    }
    Ok(all)
}

impl Density {
    /// The difference from the jamming limit if that is the surface's, and otherwise from the sets that were filled in
    /// one piece. `None` for these themselves.
    fn difference(&self, one_piece: &Self) -> Option<Difference> {
        match self.is_smooth {
            true => self.density.above_number(MAXIMAL_DENSITY),
            false if self.way.is_one_piece => None,
            false => self.density.above(&one_piece.density),
        }
    }
}

/// The section.
pub fn section(densities: &[Density]) -> String {
    let rows: Vec<_> = densities
        .chunks(WAYS.len())
        .flat_map(|of_surface| of_surface.iter().map(|one| (one, &of_surface[0], one.difference(&of_surface[0]))))
        .collect();
    let tested: Vec<_> = rows.iter().filter_map(|(.., difference)| *difference).collect();
    let chances = holm(&tested.iter().map(Difference::chance_of_farther).collect::<Vec<_>>());
    let mut corrected = chances.iter();
    let mut text = format!(
        "## Density of maximal sets\n\nN·r² per area, ± its standard error over *n* sets. Unbiased darts give {MAXIMAL_DENSITY:.5}, the \
         jamming limit, on a surface that has no boundary and is smooth. On the bunny, whose boundaries let more in and whose \
         folds fewer, sets are held against those filled in one piece. For these, triangles longer than the radius are cut into four. *t* is the difference over its standard error, *p* the chance of one as large between sets that do not differ, corrected for all {} \
         tests (Holm); a set is *not* as unbiased darts give it where p is at most {LEVEL}.\n\n\
         | surface | way | samples | n | N·r² / area | over the limit | over one piece | t | p | as unbiased |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        tested.len(),
    );
    let percent = |mean: &Mean| format!("{:+.2} ± {:.2} %", 100.0 * (mean.mean - 1.0), 100.0 * mean.error);
    for (one, one_piece, difference) in &rows {
        let Density { surface, way, count, density, .. } = one;
        let [t, p, told] = match difference {
            None => [(); 3].map(|()| "–".to_owned()),
            Some(difference) => {
                let p = *corrected.next().unwrap_or(&1.0);
                [format!("{:+.1}", difference.t), chance(p), unless_different(p).to_owned()]
            }
        };
        let over_piece = if way.is_one_piece { "–".to_owned() } else { percent(&density.over(&one_piece.density)) };
        text += &format!(
            "| {surface} | {} | {} | {} | {:.5} ± {:.5} | {} | {over_piece} | {t} | {p} | {told} |\n",
            way.name,
            grouped(*count as usize),
            density.count,
            density.mean,
            density.error,
            percent(&density.over_number(MAXIMAL_DENSITY)),
        );
    }
    text + "\n" + &found(densities)
}

/// The sentence on each method.
fn found(densities: &[Density]) -> String {
    let excess = |iterations: u32| {
        let percent = densities.chunks(WAYS.len()).flat_map(|of_surface| {
            let ways = of_surface.iter().filter(move |one| !one.way.is_one_piece && one.way.iterations == iterations);
            ways.map(|one| 100.0 * (one.density.over(&of_surface[0].density).mean - 1.0))
        });
        let [low, high] = percent.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [x.min(low), x.max(high)]);
        format!("{low:+.2} to {high:+.2} %")
    };
    let farthest = densities.iter().filter(|one| one.way.is_one_piece && one.is_smooth);
    let farthest = farthest.map(|one| 100.0 * (one.density.mean / MAXIMAL_DENSITY - 1.0).abs()).fold(0.0, f64::max);
    format!(
        "A set is filled in one piece where at most 25,000 samples are expected on the area and along edges that \
         are longer than the radius, cube by cube where there are more, or by default projected once, with local projectors, \
         then filled. In one piece sets are within {farthest:.2} % of the jamming \
         limit on the smooth surfaces. Filled cube by cube they have {} samples beside those in one piece, at the seams of \
         the cubes, wherever these face; projected once, then filled, {}, by where the surface faces (next section).\n",
        excess(0),
        excess(1),
    )
}
