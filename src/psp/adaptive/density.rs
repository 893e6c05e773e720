//! A density on a mesh: its value at a place, its bounds on a fragment, and its integral.

use std::borrow::Cow;

use crate::error::{Error, Result};
use crate::job::{Job, chunks_of};
use crate::mesh::Mesh;
use crate::points::MAXIMAL_DENSITY;
use crate::psp::adaptive::image::{Image, Range};
use crate::psp::adaptive::radius::{Density, DensityFunction, Scale, Texture};
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::pieces::slice;

/// Triangles per task of the integral.
const CHUNK: usize = 1 << 13;
/// In how many pieces the surface is integrated, about.
const PIECES: f64 = 1e5;
/// How much, as a share, a function may exceed its largest value: places are rounded.
const ROUNDING: f64 = 1e-9;
/// Texture coordinates are no larger: pixels are told apart.
const FARTHEST: f32 = 1e6;

/// A density that has been checked.
pub(super) struct DensityField<'a> {
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

    /// The slope of a function; `None` for what is known without one.
    pub fn slope(&self) -> Option<f64> {
        match self.of {
            Of::Function { slope, .. } => Some(slope),
            _ => None,
        }
    }

    /// The density at a place of a triangle.
    ///
    /// # Errors
    /// What a function gives that is no density, or more than its largest.
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

    /// What no density on a fragment is below and above, where a function gives `centre` at its centre.
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
                let change = slope * shape.extent;
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

    /// The radius at density 1 that a scale asks for.
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

    /// The integral over the surface: by the values at the centres of about [`PIECES`] pieces.
    fn integral(&self, job: &Job) -> Result<f64> {
        let longest = (4.0 * self.mesh.area() / PIECES).sqrt();
        let chunks = chunks_of(self.mesh.triangles().len(), CHUNK);
        let parts = job.map(chunks.len(), |chunk| {
            let (mut slices, mut sum) = (Vec::new(), 0.0);
            for triangle in chunks.range(chunk).map(|triangle| triangle as u32) {
                if self.mesh.triangle_area(triangle) == 0.0 {
                    continue;
                }
                slice(self.mesh, triangle, longest, &mut slices);
                for slice in slices.drain(..) {
                    for part in slice.parts_up_to(self.mesh, longest) {
                        let place = part.shape(self.mesh).centre.to_array();
                        let density = self.at(triangle, part.at([1.0 / 3.0; 2]), place).unwrap_or(0.0);
                        sum += density * part.area(self.mesh);
                    }
                }
            }
            sum
        })?;
        Ok(parts.iter().sum())
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
