//! The page of samples of pixels, in Markdown.

use std::fmt::Write;

use super::integrands::INTEGRANDS;
use super::patterns::{PATTERNS, Pattern};
use super::{Effort, Measured};
use crate::claims::{self, Claim};
use azulejo_cli::text::grouped;

/// The samplers that renderers use, and those that are compared with them.
const USUAL: [Pattern; 2] = [Pattern::Sobol, Pattern::Stratified];
const TILES: [Pattern; 2] = [Pattern::Tile, Pattern::RelaxedTile];

/// The text of the page.
pub fn text(effort: &Effort, measured: &[Measured]) -> String {
    let cases = USUAL.map(|usual| cases(usual, effort, measured));
    let won = cases.each_ref().map(|cases| cases.iter().filter(|case| case.low.mean < case.high.mean).count());
    let introduction = introduction(effort, won, cases[0].len());
    let claims: Vec<_> = cases.into_iter().flatten().collect();
    [introduction, errors(effort, measured), claims::table(&claims)].join("\n")
}

fn introduction(effort: &Effort, [sobol, stratified]: [usize; 2], cases: usize) -> String {
    format!(
        "Owen-scrambled Sobol points estimate a pixel better than tiles of KDRT and DCR in {sobol} of {cases} cases, \
         stratified points in {stratified}: [what the sets are for](integrating.md#samples-of-pixels).\n\n\
         Images of {0} by {0} pixels, through a box filter of one pixel: a pixel shows the mean of its samples. *Random* \
         samples are independent, *stratified* ones lie anywhere in as many square cells, *Sobol* is his (0,2)-sequence, \
         scrambled anew in each pixel (Burley 2020). A *tile* is one set of the unit torus that has exactly as many samples, \
         moved along it at random in each pixel: one that KDRT made, or random points after DCR. An *image* is one KDRT set \
         of all pixels, with as many samples in a pixel on average, or the same after DCR, up to {1} samples; a pixel \
         without any takes the nearest one.\n\n\
         *Zone plate* is sin(x² + y²), its frequency growing from 0 in a corner to one wave per pixel on the far sides; the \
         others are different in each pixel: an *edge* is a line of random slope, black on one side and white on the other; a \
         *soft shadow* the same, from one to the other over half a pixel; a *gradient* is linear with a slope of 1 per pixel. \
         The exact pictures are known. How errors are distributed over the picture, which the eye sees, is not \
         measured.\n",
        effort.side,
        grouped(effort.relaxed),
    )
}

fn errors(effort: &Effort, measured: &[Measured]) -> String {
    let mut text = format!(
        "## Errors\n\nRoot mean squares over an image; means of {} images of different seeds ± their standard errors, by \
         samples of a pixel.\n",
        effort.images
    );
    let head: Vec<_> = effort.counts.iter().map(usize::to_string).collect();
    for (i, integrand) in INTEGRANDS.into_iter().enumerate() {
        _ = write!(text, "\n| {} | {} |\n|---|{}\n", integrand.name(), head.join(" | "), "---|".repeat(head.len()));
        for pattern in PATTERNS {
            let cell = |&count| {
                let found = measured.iter().find(|one| one.pattern == pattern && one.count == count);
                found.map_or("-".to_owned(), |one| one.errors[i].cell(4))
            };
            let cells: Vec<_> = effort.counts.iter().map(cell).collect();
            _ = writeln!(text, "| {} | {} |", pattern.name(), cells.join(" | "));
        }
    }
    text
}

/// For each integrand and more than one sample, that a usual sampler has a smaller error than the better tile.
fn cases(usual: Pattern, effort: &Effort, measured: &[Measured]) -> Vec<Claim> {
    let case = |i: usize, count: usize| {
        let error = |pattern: Pattern| {
            let found = measured.iter().find(|one| one.pattern == pattern && one.count == count);
            found.expect("tiles and usual samplers have all counts").errors[i]
        };
        let better = if error(TILES[0]).mean < error(TILES[1]).mean { TILES[0] } else { TILES[1] };
        let names = format!("{} below {}", usual.name(), better.name());
        Claim::less(format!("{}, {count} samples: {names}", INTEGRANDS[i].name()), error(usual), error(better))
    };
    let counts = || effort.counts.iter().filter(|&&count| count > 1);
    (0..INTEGRANDS.len())
        .flat_map(|i| counts().map(move |&count| (i, count)))
        .map(|(i, count)| case(i, count))
        .collect()
}
