//! A density on a mesh: its value at a place, its bounds on a fragment, and its integral.

use std::borrow::Cow;

use crate::error::{Error, Result};
use crate::job::{Job, chunks_of};
use crate::mesh::Mesh;
use crate::points::MAXIMAL_DENSITY;
use crate::psp::adaptive::options::{Density, DensityFunction, Radius, Scale, Texture};
use crate::psp::fragment::{Fragment, Shape, slice};

/// Triangles per task of the integral.
const CHUNK: usize = 1 << 13;
/// The approximate number of pieces over which the surface is integrated, and at least one of each triangle.
pub const PIECES: f64 = 1e5;
/// The share by which a function may exceed its largest value: places are rounded.
const ROUNDING: f64 = 1e-9;
/// The largest texture coordinate: up to it, pixels can be told apart.
const FARTHEST: f32 = 1e6;

/// A density that has been checked.
pub struct DensityField<'a> {
    mesh: &'a Mesh,
    of: Of<'a>,
    /// The largest value.
    pub largest: f64,
}

enum Of<'a> {
    Vertices(Cow<'a, [f32]>),
    Function { at: &'a DensityFunction<'a>, slope: f64 },
    Image { image: Image<'a>, texture: Texture<'a> },
}

impl<'a> DensityField<'a> {
    /// The density that a radius follows from, if it does, and the meaning of a density of 1.
    pub fn of(mesh: &'a Mesh, radius: Radius<'a>) -> Result<Option<(Self, Scale)>> {
        match radius {
            Radius::Density { density, scale } => Ok(Some((Self::new(mesh, density)?, scale))),
            Radius::PerVertex(_) | Radius::Function { .. } => Ok(None),
        }
    }

    /// Checks the density of the caller.
    pub fn new(mesh: &'a Mesh, density: Density<'a>) -> Result<Self> {
        let (of, largest) = match density {
            Density::PerVertex(values) => {
                check_count(mesh, "vertex_count", "densities", values.len())?;
                check_values(values, |vertex| format!("vertex {vertex}"))?;
                (Of::Vertices(values.into()), largest_of(mesh, values))
            }
            Density::AtVertices(at) => {
                let values = mesh.positions().iter().map(|position| at(position.map(f64::from)) as f32);
                let values: Vec<f32> = values.collect();
                check_values(&values, |vertex| format!("at vertex {vertex}"))?;
                let largest = largest_of(mesh, &values);
                (Of::Vertices(values.into()), largest)
            }
            Density::Function { at, largest, slope } => {
                for (argument, value, least) in [("largest", largest, f64::MIN_POSITIVE), ("slope", slope, 0.0)] {
                    if !(least..=f32::MAX.into()).contains(&value) {
                        let which = if least > 0.0 { "a positive finite number" } else { "a finite number from 0 on" };
                        return Err(Error::invalid(argument, format!("{value:?} is not {which}")));
                    }
                }
                (Of::Function { at, slope }, largest)
            }
            Density::Image { values, width, height, texture } => {
                check_image(values, width, height)?;
                check_texture(mesh, texture)?;
                let largest = values.iter().fold(0.0f32, |largest, &x| largest.max(x));
                (Of::Image { image: Image::new(values, [width, height]), texture }, largest.into())
            }
        };
        if largest == 0.0 {
            return Err(Error::invalid("density", "0 everywhere; there is no place for a sample"));
        }
        Ok(Self { mesh, of, largest })
    }

    /// The slope of a function; `None` for densities whose bounds are known without one.
    pub fn slope(&self) -> Option<f64> {
        match self.of {
            Of::Function { slope, .. } => Some(slope),
            _ => None,
        }
    }

    /// The density at a place of a triangle.
    ///
    /// # Errors
    /// The value of a function that is not a density or exceeds the stated largest.
    pub fn at(&self, triangle: u32, uv: [f64; 2], position: [f64; 3]) -> std::result::Result<f64, f64> {
        match &self.of {
            Of::Vertices(values) => {
                let [a, b, c] = self.corners(values, triangle);
                Ok(((1.0 - uv[0] - uv[1]) * a + uv[0] * b + uv[1] * c).max(0.0))
            }
            Of::Function { at, .. } => {
                let density = at(position);
                let most = self.largest * (1.0 + ROUNDING);
                if (0.0..=most).contains(&density) { Ok(density.min(self.largest)) } else { Err(density) }
            }
            Of::Image { image, texture } => Ok(image.at(self.texture(texture, triangle, uv))),
        }
    }

    /// The least and the largest density on a fragment, where a function gives `centre` at its centre.
    pub fn bounds(&self, fragment: &Fragment, shape: &Shape, centre: f64) -> Range {
        let joined = |[low, high]: Range, x: f64| [low.min(x), high.max(x)];
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        match &self.of {
            Of::Vertices(_) => {
                let place = [0.0; 3];
                let at = |uv| self.at(fragment.triangle, uv, place).unwrap_or(0.0);
                fragment.corners.map(at).into_iter().fold(none, joined)
            }
            Of::Function { slope, .. } => {
                let change = slope * shape.extent();
                [centre - change, centre + change].map(|x| x.clamp(0.0, self.largest))
            }
            Of::Image { image, texture } => {
                let corners = fragment.corners.map(|uv| self.texture(texture, fragment.triangle, uv));
                let [[left, right], [bottom, top]] =
                    [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).fold(none, joined));
                image.bounds([left, bottom], [right, top])
            }
        }
    }

    /// The radius at density 1 for a scale.
    pub fn unit(&self, job: &Job, scale: Scale) -> Result<f64> {
        match scale {
            Scale::Radius(radius) => Ok(radius),
            Scale::Count(count) => {
                let integral = self.integral(job)?;
                if integral > 0.0 {
                    Ok((MAXIMAL_DENSITY * integral / count).sqrt())
                } else {
                    Err(Error::invalid("density", "0 everywhere on the mesh; there is no place for a sample"))
                }
            }
        }
    }

    /// The integral over the surface, from the values at the centres of about [`PIECES`] pieces.
    fn integral(&self, job: &Job) -> Result<f64> {
        let longest = self.piece_length();
        let chunks = chunks_of(self.mesh.triangles().len(), CHUNK);
        let parts = job.map(chunks.len(), |chunk| {
            let mut sum = 0.0;
            self.for_each_piece(chunks.range(chunk), longest, |_, _, integral| sum += integral);
            sum
        })?;
        Ok(parts.iter().sum())
    }

    /// The density at the centre of each piece of the surface over which it is integrated, and its share of the integral.
    pub fn at_pieces(&self, job: &Job) -> Result<Vec<(f64, f64)>> {
        let longest = self.longest_of_few();
        let chunks = chunks_of(self.mesh.triangles().len(), CHUNK);
        job.concat(chunks.len(), |chunk| {
            let mut pieces = Vec::new();
            let add = |_, density, integral| pieces.push((density, integral));
            self.for_each_piece(chunks.range(chunk), longest, add);
            pieces
        })
    }

    /// The pieces of the surface over which it is integrated, with their shares of the integral.
    pub fn pieces(&self, job: &Job) -> Result<Vec<(Fragment, f64)>> {
        let longest = self.longest_of_few();
        let chunks = chunks_of(self.mesh.triangles().len(), CHUNK);
        job.concat(chunks.len(), |chunk| {
            let mut pieces = Vec::new();
            let add = |piece, _, integral| pieces.push((piece, integral));
            self.for_each_piece(chunks.range(chunk), longest, add);
            pieces
        })
    }

    /// The length of pieces of about equal area.
    fn piece_length(&self) -> f64 {
        (4.0 * self.mesh.area() / PIECES).sqrt()
    }

    /// The same where all pieces are kept: needles, whose pieces are far shorter than they are long, have no more of them
    /// than a few times [`PIECES`].
    fn longest_of_few(&self) -> f64 {
        let length = |(triangle, _)| Fragment::whole(triangle).shape(self.mesh).longest;
        let all: f64 = self.mesh.triangles_with_area(0..self.mesh.triangles().len()).map(length).sum();
        self.piece_length().max(all / (4.0 * PIECES))
    }

    fn for_each_piece(
        &self,
        triangles: std::ops::Range<usize>,
        longest: f64,
        mut each: impl FnMut(Fragment, f64, f64),
    ) {
        let (mut slices, asks_places) = (Vec::new(), self.slope().is_some());
        for (triangle, area) in self.mesh.triangles_with_area(triangles) {
            slice(self.mesh, triangle, longest, &mut slices);
            for slice in slices.drain(..) {
                for part in slice.parts_up_to(self.mesh, longest) {
                    let place = if asks_places { part.shape(self.mesh).centre.to_array() } else { [0.0; 3] };
                    let density = self.at(triangle, part.at([1.0 / 3.0; 2]), place).unwrap_or(0.0);
                    each(part, density, density * (area * part.share()));
                }
            }
        }
    }

    fn corners(&self, values: &[f32], triangle: u32) -> [f64; 3] {
        self.mesh.triangles()[triangle as usize].map(|vertex| values[vertex as usize].into())
    }

    /// Texture coordinates of a place of a triangle.
    fn texture(&self, texture: &Texture, triangle: u32, [u, v]: [f64; 2]) -> [f64; 2] {
        let [a, b, c] = match texture {
            Texture::PerVertex(places) => self.mesh.triangles()[triangle as usize].map(|i| places[i as usize]),
            Texture::PerCorner(places) => places[triangle as usize],
        };
        let along = |axis: usize| (1.0 - u - v) * f64::from(a[axis]) + u * f64::from(b[axis]) + v * f64::from(c[axis]);
        [along(0), along(1)]
    }
}

fn largest_of(mesh: &Mesh, values: &[f32]) -> f64 {
    let used = mesh.sampled_triangles().flat_map(|triangle| mesh.triangles()[triangle as usize]);
    used.map(|vertex| values[vertex as usize]).fold(0.0f32, f32::max).into()
}

fn check_count(mesh: &Mesh, argument: &'static str, what: &str, count: usize) -> Result<()> {
    let vertices = mesh.positions().len();
    if count == vertices {
        return Ok(());
    }
    Err(Error::invalid(argument, format!("{count} {what} for {vertices} vertices")))
}

fn check_values(values: &[f32], place: impl Fn(usize) -> String) -> Result<()> {
    match values.iter().position(|value| !(0.0..f32::INFINITY).contains(value)) {
        None => Ok(()),
        Some(i) => {
            let reason = format!("{} has {:?}, which is not finite and 0 or above", place(i), values[i]);
            Err(Error::invalid("density", reason))
        }
    }
}

fn check_image(values: &[f32], width: usize, height: usize) -> Result<()> {
    for (argument, length) in [("width", width), ("height", height)] {
        if length == 0 {
            return Err(Error::invalid(argument, "0 is not at least 1"));
        }
    }
    if width.checked_mul(height) != Some(values.len()) {
        let reason = format!("{} values are not those of an image of {width} by {height}", values.len());
        return Err(Error::invalid("density", reason));
    }
    check_values(values, |i| format!("pixel ({}, {})", i % width, i / width))
}

fn check_texture(mesh: &Mesh, texture: Texture) -> Result<()> {
    let is_bad = |uv: &[f32; 2]| !uv.iter().all(|x| x.abs() <= FARTHEST);
    let bad = match texture {
        Texture::PerVertex(places) => {
            check_count(mesh, "texture", "texture coordinates", places.len())?;
            places.iter().position(is_bad).map(|i| (format!("vertex {i}"), places[i]))
        }
        Texture::PerCorner(places) => {
            let triangles = mesh.triangles().len();
            if places.len() != triangles {
                let reason = format!("texture coordinates of {} triangles for {triangles}", places.len());
                return Err(Error::invalid("texture", reason));
            }
            let corner = places.iter().flatten().position(is_bad);
            corner.map(|i| (format!("corner {} of triangle {}", i % 3, i / 3), places[i / 3][i % 3]))
        }
    };
    match bad {
        None => Ok(()),
        Some((place, uv)) => {
            Err(Error::invalid("texture", format!("{place} has {uv:?}, not finite and up to {FARTHEST:e}")))
        }
    }
}

/// The least and the largest value.
pub type Range = [f64; 2];

/// The number of cells along an axis up to which they are examined one by one.
const FEW: f64 = 4.0;

/// Values, and the least and the largest of each square of side 2, 4, 8 and so on.
pub struct Image<'a> {
    values: &'a [f32],
    size: [usize; 2],
    /// Each level is half as wide and as high as the one before, rounded up; the last has one entry.
    levels: Vec<Level>,
}

struct Level {
    size: [usize; 2],
    ranges: Vec<[f32; 2]>,
}

impl<'a> Image<'a> {
    /// `values` are `width * height`, at least one of each. O(n).
    pub fn new(values: &'a [f32], [width, height]: [usize; 2]) -> Self {
        let mut image = Self { values, size: [width, height], levels: Vec::new() };
        let mut size = image.size;
        while size != [1, 1] {
            let finer = image.levels.len();
            let coarser = size.map(|length| length.div_ceil(2));
            let of_square = |x: usize, y: usize| {
                let columns = 2 * x..(2 * x + 2).min(size[0]);
                let all = (2 * y..(2 * y + 2).min(size[1])).flat_map(|y| columns.clone().map(move |x| (x, y)));
                all.map(|(x, y)| image.range(finer, [x, y])).fold([f32::INFINITY, f32::NEG_INFINITY], joined)
            };
            let ranges =
                (0..coarser[1]).flat_map(|y| (0..coarser[0]).map(move |x| (x, y))).map(|(x, y)| of_square(x, y));
            let ranges = ranges.collect();
            image.levels.push(Level { size: coarser, ranges });
            size = coarser;
        }
        image
    }

    /// The range of an entry of a level; level 0 consists of the values.
    fn range(&self, level: usize, [x, y]: [usize; 2]) -> [f32; 2] {
        match level.checked_sub(1) {
            None => [self.values[y * self.size[0] + x]; 2],
            Some(level) => self.levels[level].ranges[y * self.levels[level].size[0] + x],
        }
    }

    /// Texture coordinates in pixels, where centres of pixels are at whole numbers.
    fn place(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [u * self.size[0] as f64 - 0.5, v * self.size[1] as f64 - 0.5]
    }

    /// The value at texture coordinates: that of the four nearest centres, interpolated.
    pub fn at(&self, uv: [f64; 2]) -> f64 {
        let place = self.place(uv);
        self.in_cell(place.map(floor), place)
    }

    /// The values at the corners of a cell, a square between four centres of pixels, given by its lower corner: row by
    /// row.
    fn corners(&self, low: [f64; 2]) -> [f64; 4] {
        let pixels = |axis: usize| {
            let (size, first) = (self.size[axis] as i64, low[axis] as i64);
            // Most cells are inside the image: a division costs more than the rest.
            let wrapped = |i: i64| if (0..size).contains(&i) { i } else { i.rem_euclid(size) } as usize;
            [wrapped(first), wrapped(first + 1)]
        };
        let ([left, right], [bottom, top]) = (pixels(0), pixels(1));
        let value = |x: usize, y: usize| f64::from(self.values[y * self.size[0] + x]);
        [value(left, bottom), value(right, bottom), value(left, top), value(right, top)]
    }

    /// The value at a place in a cell.
    fn in_cell(&self, low: [f64; 2], place: [f64; 2]) -> f64 {
        interpolated(self.corners(low), [place[0] - low[0], place[1] - low[1]])
    }

    /// The least and the largest value at texture coordinates in a box: if it lies in few cells, from the values at the
    /// corners of its parts in them, which converge as boxes shrink; otherwise from all pixels around.
    pub fn bounds(&self, low: [f64; 2], high: [f64; 2]) -> Range {
        let [low, high] = [self.place(low), self.place(high)];
        let cells = |axis: usize| (floor(low[axis]), floor(high[axis]));
        let (columns, rows) = (cells(0), cells(1));
        if columns.1 - columns.0 < FEW && rows.1 - rows.0 < FEW {
            return self.bounds_in_cells([columns, rows], low, high);
        }
        let runs = [0, 1].map(|axis| runs(low[axis], high[axis], self.size[axis]));
        let mut range = [f32::INFINITY, f32::NEG_INFINITY];
        for y in runs[1].iter().flatten() {
            for x in runs[0].iter().flatten() {
                range = joined(range, self.range_of([x.0, y.0], [x.1, y.1]));
            }
        }
        range.map(f64::from)
    }

    /// The range of the values in a box that lies in some columns and rows of cells. In a cell the extremes of a
    /// bilinear function are at corners.
    fn bounds_in_cells(&self, [columns, rows]: [(f64, f64); 2], low: [f64; 2], high: [f64; 2]) -> Range {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let counts = [columns, rows].map(|(first, last)| (last - first) as i32 + 1);
        for row in 0..counts[1] {
            for column in 0..counts[0] {
                let cell = [columns.0 + f64::from(column), rows.0 + f64::from(row)];
                let corners = self.corners(cell);
                // What cells share is evaluated in one of them.
                let ends = |axis: usize, number: i32| {
                    let end = |x: f64| x.clamp(cell[axis], cell[axis] + 1.0) - cell[axis];
                    [Some(end(low[axis])), (number + 1 == counts[axis]).then(|| end(high[axis]))]
                };
                for s in ends(0, column).into_iter().flatten() {
                    for t in ends(1, row).into_iter().flatten() {
                        let value = interpolated(corners, [s, t]);
                        range = [range[0].min(value), range[1].max(value)];
                    }
                }
            }
        }
        range
    }

    /// The range of the values in a rectangle, its last column and row included, or of that and some around it.
    fn range_of(&self, first: [usize; 2], last: [usize; 2]) -> [f32; 2] {
        let longest = (last[0] - first[0]).max(last[1] - first[1]);
        // At most three entries along each axis.
        let level = (usize::BITS - longest.leading_zeros()).saturating_sub(1) as usize;
        let level = level.min(self.levels.len());
        let entries = [0, 1].map(|axis| first[axis] >> level..=last[axis] >> level);
        let [columns, rows] = entries;
        let all = rows.flat_map(|y| columns.clone().map(move |x| [x, y]));
        all.map(|entry| self.range(level, entry)).fold([f32::INFINITY, f32::NEG_INFINITY], joined)
    }
}

/// The largest whole number that does not exceed a place, which is far from the limits of `i64`. (The function of the
/// standard library is a call.)
fn floor(x: f64) -> f64 {
    let whole = x as i64 as f64;
    if whole > x { whole - 1.0 } else { whole }
}

/// The value at a place in a cell, in shares of its sides, from those at its corners.
fn interpolated([a, b, c, d]: [f64; 4], [s, t]: [f64; 2]) -> f64 {
    let mixed = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
    // Rounding must not take it beyond the values that it is interpolated from.
    mixed.clamp(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
}

fn joined(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// The pixels whose centres matter between two places along an axis: the first and last of one run, or of two if it
/// wraps.
fn runs(low: f64, high: f64, size: usize) -> [Option<(usize, usize)>; 2] {
    let (first, last) = (low.floor() as i64, high.floor() as i64 + 1);
    if last - first + 1 >= size as i64 {
        return [Some((0, size - 1)), None];
    }
    let start = first.rem_euclid(size as i64) as usize;
    let end = start + (last - first) as usize;
    if end < size { [Some((start, end)), None] } else { [Some((start, size - 1)), Some((0, end - size))] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Boxes of all sizes, also across the seams of the image.
    #[test]
    fn bounds_hold_all_values_and_are_not_much_wider() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for size in [[1, 1], [1, 7], [2, 2], [64, 64], [37, 5], [100, 129]] {
            let values: Vec<f32> = (0..size[0] * size[1]).map(|_| rng.unit() as f32).collect();
            let image = Image::new(&values, size);
            for round in 0..300 {
                let width = [0.001, 0.02, 0.3, 1.5][round % 4];
                let low = [(); 2].map(|()| 6.0 * rng.unit() - 3.0);
                let high = low.map(|x| x + width * rng.unit());
                let [least, largest] = image.bounds(low, high);
                for _ in 0..50 {
                    let value = image.at([0, 1].map(|axis| low[axis] + (high[axis] - low[axis]) * rng.unit()));
                    assert!((least..=largest).contains(&value), "{size:?} {low:?} {high:?}");
                }
                // All pixels within the level's squares around the box.
                let pixels = |axis: usize| ((high[axis] - low[axis]) * size[axis] as f64).max(2.0);
                let reach = 4.0 * pixels(0).max(pixels(1));
                let near = (0..values.len()).filter(|&i| {
                    let centre = [i % size[0], i / size[0]];
                    (0..2).all(|axis| {
                        let length = size[axis] as f64;
                        let middle = 0.5 * (low[axis] + high[axis]) * length - 0.5;
                        let away = (centre[axis] as f64 - middle).rem_euclid(length);
                        away.min(length - away) <= reach
                    })
                });
                let near: Vec<f64> = near.map(|i| f64::from(values[i])).collect();
                let all = near.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)]);
                assert!(all[0] <= least && largest <= all[1]);
                let pointlike = image.bounds(low, low.map(|x| x + 1e-9));
                assert!(pointlike[1] - pointlike[0] < 1e-6);
            }
        }
    }

    #[test]
    fn centres_of_pixels_have_their_values_and_between_them_it_is_linear() {
        let values = [0.0, 1.0, 4.0, 9.0, 2.0, 5.0f32];
        let image = Image::new(&values, [3, 2]);
        for (i, &value) in values.iter().enumerate() {
            let centre = [((i % 3) as f64 + 0.5) / 3.0, ((i / 3) as f64 + 0.5) / 2.0];
            assert_eq!(image.at(centre), f64::from(value));
            assert_eq!(image.at([centre[0] + 7.0, centre[1] - 2.0]), f64::from(value));
        }
        assert_eq!(image.at([1.0 / 3.0, 0.25]), 0.5);
        assert_eq!(image.at([0.0, 0.25]), 2.0, "the last pixel of a row and the first");
        assert_eq!(image.at([1.0 / 6.0, 0.5]), 4.5);
    }
}
