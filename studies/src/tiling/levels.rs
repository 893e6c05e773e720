//! The time of the subdivision by its levels (thesis table 2.1), and its share of all time (§2.5.2).

use std::fmt::Write;
use std::hint::black_box;

use azulejo::kdrt::stages::{divide, measure};
use azulejo::{Boundary, Domain, Result, kdrt};

use super::claims::{Claim, Part, number};
use super::study::{Study, mean_of, timed, times};
use super::thesis::divide::building_blocks;
use crate::kdrt::{LEAF_SIZES, radius};
use crate::verdict::Mean;
use azulejo_cli::progress::watched;
use azulejo_cli::text::{grouped, rounded};

/// Table 2.1 of the thesis: levels, milliseconds on its CPU and on its GPU.
const THESIS: [[f64; 3]; 4] = [[10.0, 16.0, 95.0], [12.0, 27.0, 99.0], [14.0, 59.0, 116.0], [16.0, 172.0, 130.0]];

/// "Only less than 5 percent of time taken in the subdivision of the square" (§2.5.2).
const SHARE: f64 = 5.0;

/// Leaves have sides from one to two times this, in radii.
const LEAF_SIZE: f64 = kdrt::DEFAULT_LEAF_SIZE;

/// A subdivision to about a number of levels.
struct Row {
    leaves: usize,
    blocks: usize,
    /// Seconds of each round: azulejo's tree, and Algorithm 1.
    own: Vec<f64>,
    thesis: Vec<f64>,
}

pub fn section(study: &Study) -> Result<Part> {
    let rounds = study.effort(10, 3);
    let domain = Domain::unit(Boundary::Periodic);
    let (rows, shares) = watched("levels", |progress| {
        // The mean side of a leaf is about 1.4 times the smallest one.
        let sizes = THESIS.map(|[levels, ..]| 1.0 / (1.4 * (levels / 2.0).exp2()));
        let new = |_| Row { leaves: 0, blocks: 0, own: Vec::new(), thesis: Vec::new() };
        let mut rows: [Row; 4] = std::array::from_fn(new);
        let mut shares: [Vec<f64>; 4] = Default::default();
        for round in 0..rounds {
            for (row, size) in rows.iter_mut().zip(sizes) {
                let options = kdrt::Options::new(size / LEAF_SIZE).domain(domain).leaf_size(LEAF_SIZE).seed(1);
                let (leaves, time) = divide(&options)?;
                let (blocks, seconds) = timed(|| Ok(black_box(building_blocks(size, 1)).len()))?;
                (row.leaves, row.blocks) = (leaves, blocks);
                row.own.push(time.as_secs_f64());
                row.thesis.push(seconds);
            }
            for (shares, leaf_size) in shares.iter_mut().zip(LEAF_SIZES) {
                let count = study.effort(1e6, 8e4);
                let options = kdrt::Options::new(radius(count)).domain(domain).leaf_size(leaf_size).seed(1);
                let stages = measure(&options)?;
                let all = stages.pattern + stages.divide + stages.clip + stages.eliminate + stages.fill + stages.output;
                shares.push(100.0 * stages.divide.as_secs_f64() / all.as_secs_f64());
            }
            _ = progress((round + 1) as f64 / rounds as f64);
        }
        Ok((rows, shares))
    })?;
    let claim = |(leaf_size, shares): (f64, &Vec<f64>)| {
        let what =
            format!("percent of time that the subdivision takes, {leaf_size}r (§2.5.2: \"less than 5 percent\")");
        Claim::less(what, Mean::of(shares), number(SHARE))
    };
    Ok(Part {
        text: text(&rows, &shares),
        claims: LEAF_SIZES.into_iter().zip(&shares).map(claim).collect(),
        facts: Vec::new(),
    })
}

fn text(rows: &[Row], shares: &[Vec<f64>]) -> String {
    let levels = |leaves: usize| format!("{:.1}", (leaves as f64).log2());
    let mut text = "## Subdivision by levels (thesis table 2.1)\n\n\
        Milliseconds. *Levels* is the binary logarithm of the number of leaves. The whole tree at once, as in the thesis: \
        azulejo's tree, which splits the longer side, and Algorithm 1 of the thesis as this command has it, which splits the sides \
        in turns.\n\n\
        | thesis, levels | thesis, CPU | thesis, GPU | azulejo, levels | leaves | azulejo | Algorithm 1, levels | leaves | Algorithm 1 |\n\
        |---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for ([depth, cpu, gpu], row) in THESIS.iter().zip(rows) {
        _ = writeln!(
            text,
            "| {depth} | {cpu} | {gpu} | {} | {} | {} | {} | {} | {} |",
            levels(row.leaves),
            grouped(row.leaves),
            times(&row.own, 1e3),
            levels(row.blocks),
            grouped(row.blocks),
            times(&row.thesis, 1e3),
        );
    }
    let least = |row: &Row| row.own.iter().copied().fold(f64::INFINITY, f64::min);
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    _ = write!(
        text,
        "\nFrom the first row to the last the thesis's CPU takes {} times as long, azulejo {} times; leaves are {} times as \
         many. Of all time that a set takes, with its pattern, the subdivision takes, by windows as the sampler does it:\n\n\
         | R_leaf | percent of time, mean of {} rounds |\n|---|---|\n",
        rounded(THESIS[3][1] / THESIS[0][1], 3),
        rounded(least(last) / least(first), 3),
        rounded(last.leaves as f64 / first.leaves as f64, 3),
        shares[0].len(),
    );
    for (leaf_size, shares) in LEAF_SIZES.iter().zip(shares) {
        _ = writeln!(text, "| {leaf_size}r | {} |", super::claims::cell(&mean_of(shares, |share| *share)));
    }
    text
}
