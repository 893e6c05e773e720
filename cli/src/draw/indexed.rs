//! PNG files with a palette: a fifth of the size of full colour, for pictures of dots and curves, which do not
//! compress.
//!
//! A picture of at most 16 colours keeps them. In others the box of colours with the largest squared error is split
//! until there are 16 boxes, or 64 where 16 would show, and k-means moves the centres (Wu 1991, "Efficient Statistical
//! Computations for Optimal Color Quantization").

use std::io::{self, Write};

use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use super::palette::Colour;

/// The sizes of a palette that are tried in turn: the most that 4 bits a pixel hold, and a size that suffices for any
/// picture.
const SIZES: [usize; 2] = [16, 64];
/// The error of the smaller palette, root mean square, that is still invisible, in steps of a channel. Spectra, which
/// are noisy, err by 3.5; on shaded surfaces, which err by 5, bands show in shadows and in discs.
const UNSEEN: f64 = 4.0;
/// Rounds of k-means; after these few the colours change by a step or less.
const ROUNDS: usize = 4;
/// The number of colours of 24 bits.
const COLOURS: usize = 1 << 24;

/// Writes a picture whose rows have `width` pixels.
pub fn write_png(writer: impl Write, pixels: &[Colour], width: u32) -> io::Result<()> {
    let (palette, of_pixels) = reduce(pixels);
    let depth = match palette.len() {
        ..=2 => BitDepth::One,
        3..=4 => BitDepth::Two,
        5..=16 => BitDepth::Four,
        _ => BitDepth::Eight,
    };
    let mut encoder = Encoder::new(writer, width, (pixels.len() / width as usize) as u32);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(depth);
    encoder.set_palette(palette.concat());
    encoder.set_compression(Compression::High);
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&packed(&of_pixels, width as usize, depth as usize))?;
    writer.finish()?;
    Ok(())
}

/// Rows of indices of `bits` each, the first in the highest bits; a row ends with its byte.
fn packed(indices: &[u8], width: usize, bits: usize) -> Vec<u8> {
    let byte =
        |of: &[u8]| of.iter().enumerate().fold(0, |byte, (place, index)| byte | index << (8 - bits * (place + 1)));
    indices.chunks(width).flat_map(|row| row.chunks(8 / bits).map(byte)).collect()
}

/// A colour of the picture, and how many pixels have it.
#[derive(Clone, Copy)]
struct Entry {
    colour: Colour,
    count: f64,
}

/// The palette of a picture, and the index of each pixel.
fn reduce(pixels: &[Colour]) -> (Vec<Colour>, Vec<u8>) {
    let key = |[r, g, b]: Colour| usize::from(r) << 16 | usize::from(g) << 8 | usize::from(b);
    let mut counts = vec![0_u32; COLOURS];
    pixels.iter().for_each(|&pixel| counts[key(pixel)] += 1);
    let used = counts.iter().enumerate().filter(|&(_, &count)| count > 0);
    let entries: Vec<Entry> = used
        .map(|(key, &count)| Entry { colour: [16, 8, 0].map(|shift| (key >> shift) as u8), count: f64::from(count) })
        .collect();
    let palette = choose(&entries, pixels.len() as f64);
    let mut of_colours = vec![0_u8; COLOURS];
    entries.iter().for_each(|entry| of_colours[key(entry.colour)] = nearest(&palette, entry.colour) as u8);
    (palette, pixels.iter().map(|&pixel| of_colours[key(pixel)]).collect())
}

/// The palette for colours of this many pixels.
fn choose(entries: &[Entry], pixels: f64) -> Vec<Colour> {
    if entries.len() <= SIZES[0] {
        return entries.iter().map(|entry| entry.colour).collect();
    }
    let mut palette = Vec::new();
    for size in SIZES {
        palette = means(entries, split(entries, size));
        let error: f64 = entries
            .iter()
            .map(|entry| entry.count * distance(entry.colour, palette[nearest(&palette, entry.colour)]))
            .sum();
        if error <= 3.0 * pixels * UNSEEN * UNSEEN {
            break;
        }
    }
    palette
}

/// The mean colours of at most `size` boxes into which the colours are split.
fn split(entries: &[Entry], size: usize) -> Vec<Colour> {
    let mut boxes = vec![entries.to_vec()];
    while boxes.len() < size {
        let errors = boxes.iter().map(|of| (0..3).map(|channel| spread(of, channel)).sum::<f64>());
        let (worst, error) = errors.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).expect("there is a box");
        if error == 0.0 {
            break;
        }
        let whole = boxes.swap_remove(worst);
        let axis = (0..3).max_by(|&a, &b| spread(&whole, a).total_cmp(&spread(&whole, b))).expect("three channels");
        let middle = mean(&whole)[axis];
        let (low, high) = whole.into_iter().partition(|entry| f64::from(entry.colour[axis]) <= middle);
        boxes.extend([low, high]);
    }
    boxes.iter().map(|of| mean(of).map(|channel| channel.round() as u8)).collect()
}

/// The mean colour.
fn mean(of: &[Entry]) -> [f64; 3] {
    let pixels: f64 = of.iter().map(|entry| entry.count).sum();
    [0, 1, 2].map(|channel| of.iter().map(|entry| entry.count * f64::from(entry.colour[channel])).sum::<f64>() / pixels)
}

/// The sum of the squared deviations of a channel from its mean.
fn spread(of: &[Entry], channel: usize) -> f64 {
    let middle = mean(of)[channel];
    of.iter().map(|entry| entry.count * (f64::from(entry.colour[channel]) - middle).powi(2)).sum()
}

/// The palette after some rounds of k-means. A colour that most pixels of its cluster have stays exact, so that paper
/// and flat areas do.
fn means(entries: &[Entry], mut palette: Vec<Colour>) -> Vec<Colour> {
    for _ in 0..ROUNDS {
        let mut clusters = vec![Vec::new(); palette.len()];
        entries.iter().for_each(|&entry| clusters[nearest(&palette, entry.colour)].push(entry));
        clusters.retain(|cluster| !cluster.is_empty());
        palette = clusters
            .iter()
            .map(|cluster| {
                let pixels: f64 = cluster.iter().map(|entry| entry.count).sum();
                let most = cluster.iter().find(|entry| 2.0 * entry.count > pixels);
                most.map_or_else(|| mean(cluster).map(|channel| channel.round() as u8), |entry| entry.colour)
            })
            .collect();
    }
    palette.sort_unstable();
    palette.dedup();
    palette
}

/// The index of the nearest colour of a palette.
fn nearest(palette: &[Colour], colour: Colour) -> usize {
    (0..palette.len())
        .min_by(|&a, &b| distance(palette[a], colour).total_cmp(&distance(palette[b], colour)))
        .expect("a palette has colours")
}

/// The squared distance of two colours.
fn distance(a: Colour, b: Colour) -> f64 {
    a.iter().zip(b).map(|(&a, b)| (f64::from(a) - f64::from(b)).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(pixels: &[Colour], width: u32) -> (usize, Vec<Colour>) {
        let mut file = Vec::new();
        write_png(&mut file, pixels, width).unwrap();
        let read = image::load_from_memory(&file).unwrap().to_rgb8();
        assert_eq!(read.width(), width);
        (file.len(), read.pixels().map(|pixel| pixel.0).collect())
    }

    #[test]
    fn few_colours_are_exact_whatever_their_number_and_the_width() {
        for colours in 1..=16 {
            for width in [1, 3, 8, 13] {
                let pixels: Vec<Colour> =
                    (0..width * 5).map(|i| [(i % colours * 15) as u8, 7, (i % 3) as u8]).collect();
                let pixels: Vec<Colour> = pixels.iter().map(|&[r, g, _]| [r, g, r / 2]).collect();
                assert_eq!(read(&pixels, width).1, pixels, "{colours} colours, {width} wide");
            }
        }
    }

    #[test]
    fn many_colours_are_near_and_paper_stays() {
        let shade = |i: u32| {
            if i.is_multiple_of(2) { [255, 252, 246] } else { [i % 251, i % 241, i % 239].map(|value| value as u8) }
        };
        let pixels: Vec<Colour> = (0..60_000).map(shade).collect();
        let (size, read) = read(&pixels, 300);
        assert!(size < 60_000, "{size} bytes");
        assert!(read.iter().step_by(2).all(|&pixel| pixel == [255, 252, 246]));
        let error: f64 = pixels.iter().zip(&read).map(|(&a, &b)| distance(a, b)).sum();
        assert!((error / 60_000.0 / 3.0).sqrt() < 15.0, "{error}");
        let different: std::collections::BTreeSet<_> = read.iter().collect();
        assert!((17..=64).contains(&different.len()), "{} colours", different.len());
    }
}
