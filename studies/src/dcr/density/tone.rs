//! The agreement of dots with an image once both are blurred.

use azulejo_cli::stipple::darkness::Darkness;

/// Standard deviations of the filters, in mean spacings of the dots.
pub const WIDTHS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

/// Cells of the table per mean spacing, along each axis.
const FINENESS: f64 = 4.0;

/// Parts of a pixel, along each axis, that are put into cells.
const PARTS: usize = 4;

/// Gaussians are cut off at this many standard deviations.
const CUT: f64 = 4.0;

/// A square image on a table of cells, blurred by each of the filters.
pub struct Tone {
    /// Cells along an axis, and pixels of the image.
    side: usize,
    pixels: usize,
    /// The ink of all dots, in cells that are full of it.
    ink: f64,
    widths: [f64; WIDTHS.len()],
    wanted: [Vec<f64>; WIDTHS.len()],
}

impl Tone {
    /// That of a square image which is to have so many dots.
    pub fn new(image: &Darkness, count: usize) -> Self {
        let pixels = image.size()[0];
        let side = (FINENESS * (count as f64).sqrt()) as usize;
        let widths = WIDTHS.map(|width| width * side as f64 / (count as f64).sqrt());
        let (per_pixel, parts) = (side as f64 / pixels as f64, pixels * PARTS);
        let mut table = vec![0.0; side * side];
        for (row, column) in (0..parts).flat_map(|row| (0..parts).map(move |column| (row, column))) {
            let [x, y] = [column, row].map(|part| ((part as f64 + 0.5) / parts as f64 * side as f64) as usize);
            table[y * side + x] += image.at(column / PARTS, row / PARTS) * (per_pixel / PARTS as f64).powi(2);
        }
        let ink = image.ink() * per_pixel * per_pixel;
        Self { side, pixels, ink, widths, wanted: widths.map(|width| blurred(&table, side, width)) }
    }

    /// The root mean square of the difference, for each of the filters, in parts of full black.
    pub fn errors(&self, dots: &[[f32; 2]]) -> [f64; WIDTHS.len()] {
        let table = self.table(dots);
        std::array::from_fn(|i| {
            let found = blurred(&table, self.side, self.widths[i]);
            let squares = found.iter().zip(&self.wanted[i]).map(|(found, wanted)| (found - wanted).powi(2));
            (squares.sum::<f64>() / table.len() as f64).sqrt()
        })
    }

    /// The ink of dots, each divided between the four cells around its centre.
    fn table(&self, dots: &[[f32; 2]]) -> Vec<f64> {
        let mut table = vec![0.0; self.side * self.side];
        let ink = self.ink / dots.len() as f64;
        for dot in dots {
            let place = dot.map(|x| f64::from(x) * self.side as f64 / self.pixels as f64 - 0.5);
            for [right, down] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
                let cell = [place[0].floor() + right, place[1].floor() + down];
                let share = (1.0 - (place[0] - cell[0]).abs()) * (1.0 - (place[1] - cell[1]).abs());
                let [x, y] = cell.map(|index| index.clamp(0.0, (self.side - 1) as f64) as usize);
                table[y * self.side + x] += ink * share;
            }
        }
        table
    }
}

/// A square table after a Gaussian filter of this standard deviation, in cells; around it all is white.
fn blurred(table: &[f64], side: usize, width: f64) -> Vec<f64> {
    let reach = (CUT * width).ceil() as usize;
    let weights: Vec<f64> =
        (0..=2 * reach).map(|i| (-0.5 * ((i as f64 - reach as f64) / width).powi(2)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    // Along rows, and turned; twice.
    let pass = |table: &[f64]| {
        let mut turned = vec![0.0; side * side];
        for (row, cells) in table.chunks(side).enumerate() {
            for column in 0..side {
                let range = column.saturating_sub(reach)..(column + reach + 1).min(side);
                let weights = &weights[range.start + reach - column..];
                let blurred: f64 = cells[range].iter().zip(weights).map(|(cell, weight)| cell * weight).sum();
                turned[column * side + row] = blurred / sum;
            }
        }
        turned
    };
    pass(&pass(table))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_spreads_and_keeps_what_there_is() {
        let mut table = vec![0.0; 41 * 41];
        table[20 * 41 + 18] = 3.0;
        let blurred = blurred(&table, 41, 2.0);
        assert!((blurred.iter().sum::<f64>() - 3.0).abs() < 1e-9);
        let peak = 3.0 / (std::f64::consts::TAU * 4.0);
        assert!((blurred[20 * 41 + 18] - peak).abs() < 1e-3 * peak);
        let beside = peak * (-0.5f64 * 13.0 / 4.0).exp();
        assert!((blurred[22 * 41 + 21] - beside).abs() < 1e-3 * peak);
    }

    #[test]
    fn a_lattice_of_dots_is_grey_and_a_heap_is_not() {
        let grey = Darkness::new(vec![0.25; 64 * 64], 64);
        let tone = Tone::new(&grey, 256);
        let lattice: Vec<_> = (0..256).map(|i| [i % 16, i / 16].map(|x| 4.0 * x as f32 + 2.0)).collect();
        let (even, heap) = (tone.errors(&lattice), tone.errors(&[[32.0; 2]; 256]));
        // A filter of half the spacing leaves 2 exp(-π² / 2) of each of the two waves of a lattice: 0.0036 of a
        // quarter's grey.
        assert!((0.003..0.006).contains(&even[0]), "{even:?}");
        assert!(even[1..].iter().all(|&error| error < 0.0015), "{even:?}");
        assert!(heap.iter().zip(&even).all(|(heap, even)| *heap > 100.0 * even), "{heap:?}");
    }
}
