//! Blue-noise masks: ranks are permutations on tori of any size, their patterns have hardly any power at low frequencies,
//! seen beside random ones, and tiles have no seams. `src/mask/ranking.rs` has the oracle, the method by its definitions.

use std::f64::consts::TAU;

use azulejo::Context;
use azulejo::mask::{Image, Mask, Options, Pixels, create};

use crate::common::random::Random;

fn made(options: &Options) -> Mask {
    create(&Context::new(2).unwrap(), options, None).unwrap().0
}

/// A complex number.
type Complex = [f64; 2];

/// The discrete Fourier transform along one axis, from the definition.
fn transform(values: &mut [Complex], size: [usize; 3], axis: usize) {
    let stride: usize = size[..axis].iter().product();
    let length = size[axis];
    let turns: Vec<Complex> =
        (0..length).map(|k| TAU * k as f64 / length as f64).map(|angle| [angle.cos(), -angle.sin()]).collect();
    for first in (0..values.len()).filter(|i| (i / stride).is_multiple_of(length)) {
        let line: Vec<Complex> = (0..length).map(|k| values[first + k * stride]).collect();
        for k in 0..length {
            let term = |(j, [re, im]): (usize, &Complex)| {
                let [cos, sin] = turns[j * k % length];
                [re * cos - im * sin, re * sin + im * cos]
            };
            values[first + k * stride] =
                line.iter().enumerate().map(term).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        }
    }
}

/// The mean power of a pattern at frequencies up to `share` of its principal one, the constant left out: sqrt(density) cycles per
/// pixel in the plane, its cubic root in space, at most half (Ulichney 1988). 1 is that of independent random pixels.
fn low_power(size: [usize; 3], pattern: &[bool], share: f64) -> f64 {
    let density = pattern.iter().filter(|&&set| set).count() as f64 / pattern.len() as f64;
    let minority = density.min(1.0 - density);
    let principal = if size[2] > 1 { minority.cbrt() } else { minority.sqrt() }.min(0.5);
    let mut values: Vec<Complex> = pattern.iter().map(|&set| [f64::from(u8::from(set)) - density, 0.0]).collect();
    (0..3).filter(|&axis| size[axis] > 1).for_each(|axis| transform(&mut values, size, axis));
    let frequency = |i: usize| {
        let place = [i % size[0], i / size[0] % size[1], i / size[0] / size[1]];
        (0..3).map(|k| (place[k].min(size[k] - place[k]) as f64 / size[k] as f64).powi(2)).sum::<f64>().sqrt()
    };
    let low: Vec<f64> = (1..values.len())
        .filter(|&i| frequency(i) <= share * principal)
        .map(|i| values[i][0].powi(2) + values[i][1].powi(2))
        .collect();
    assert!(low.len() >= 8, "{} frequencies", low.len());
    low.iter().sum::<f64>() / low.len() as f64 / (pattern.len() as f64 * density * (1.0 - density))
}

fn below(ranks: &[u32], share: f64) -> Vec<bool> {
    let count = (share * ranks.len() as f64).round() as u32;
    ranks.iter().map(|&rank| rank < count).collect()
}

#[test]
fn every_rank_occurs_once_on_tori_of_any_size() {
    let sizes = [
        [2, 2, 1],
        [2, 1024, 1],
        [1024, 2, 1],
        [3, 5, 1],
        [127, 33, 1],
        [2, 2, 2],
        [64, 3, 5],
        [2, 2, 64],
        [17, 19, 13],
    ];
    for (seed, [width, height, depth]) in (0..).zip(sizes) {
        let mask = made(&Options::new(width, height).depth(depth).channels(2).seed(seed));
        assert_eq!((mask.size, mask.channels, mask.ranks.len()), ([width, height, depth], 2, 2 * mask.pixels()));
        for channel in 0..2 {
            let mut ranks = mask.channel(channel).to_vec();
            ranks.sort_unstable();
            assert!(ranks.into_iter().eq(0..mask.pixels() as u32), "{:?}", mask.size);
        }
    }
}

#[test]
fn patterns_of_all_densities_have_hardly_any_power_at_low_frequencies() {
    for (size, sigma) in
        [([64, 64, 1], 1.5), ([64, 64, 1], 1.9), ([61, 45, 1], 1.5), ([24, 24, 24], 1.5), ([24, 24, 24], 1.9)]
    {
        let masks: Vec<Mask> =
            (0..3).map(|seed| made(&Options::new(size[0], size[1]).depth(size[2]).seed(seed).sigma(sigma))).collect();
        for (share, most) in [(0.01, 0.4), (0.1, 0.2), (0.25, 0.2), (0.5, 0.2), (0.75, 0.2), (0.9, 0.2)] {
            let powers = masks.iter().map(|mask| low_power(size, &below(mask.channel(0), share), 0.5));
            let power = powers.sum::<f64>() / 3.0;
            println!("{size:?} sigma {sigma}, {share}: {power:.4}");
            assert!(power < most, "{size:?} {sigma} {share}: {power}");
        }
    }
}

#[test]
fn random_ranks_have_the_power_of_white_noise() {
    let mut random = Random::new(5);
    let mut order: Vec<(f32, u32)> = (0..64 * 64).map(|i| (random.unit(), i)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ranks: Vec<u32> = order.into_iter().map(|(_, rank)| rank).collect();
    for share in [0.1, 0.5, 0.9] {
        let power = low_power([64, 64, 1], &below(&ranks, share), 0.5);
        assert!((0.6..1.5).contains(&power), "{share}: {power}");
    }
}

#[test]
fn low_ranks_are_far_from_each_other_also_across_the_edges() {
    // As many pixels as are said, on the torus: the least distance beside that of a hexagonal grid.
    let mask = made(&Options::new(64, 48).seed(4));
    for count in [16, 64, 256] {
        let places: Vec<usize> = (0..mask.pixels()).filter(|&p| mask.ranks[p] < count).collect();
        let distance = |a: usize, b: usize| {
            let [x, y] = [(a % 64).abs_diff(b % 64), (a / 64).abs_diff(b / 64)];
            (x.min(64 - x) as f64).hypot(y.min(48 - y) as f64)
        };
        let least = places
            .iter()
            .flat_map(|&a| places.iter().filter(move |&&b| b != a).map(move |&b| (a, b)))
            .map(|(a, b)| distance(a, b))
            .fold(f64::INFINITY, f64::min);
        let hexagonal = (2.0 * mask.pixels() as f64 / (3f64.sqrt() * f64::from(count))).sqrt();
        println!("{count}: {:.3}", least / hexagonal);
        assert!(least > 0.5 * hexagonal, "{count}: {least} of {hexagonal}");
    }
}

#[test]
fn a_halftone_of_a_ramp_has_its_mean_in_every_part() {
    let mask = made(&Options::new(32, 32));
    let ramp: Vec<f32> = (0..256 * 64).map(|i| (i % 256) as f32 / 255.0).collect();
    let image = Image { size: [256, 64, 1], channels: 1, pixels: Pixels::Floats(&ramp) };
    let out = mask.dither(&image, 2).unwrap();
    for part in 0..16 {
        let in_part = |i: &usize| i % 256 / 16 == part;
        let mean = |of: &dyn Fn(usize) -> f64| (0..out.len()).filter(in_part).map(of).sum::<f64>() / 1024.0;
        let (halftone, exact) = (mean(&|i| f64::from(out[i])), mean(&|i| f64::from(ramp[i])));
        assert!((halftone - exact).abs() < 0.02, "{part}: {halftone} for {exact}");
    }
}
