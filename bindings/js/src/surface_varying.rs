//! Sets on meshes whose radius varies, and of several classes.

use azulejo::psp::adaptive::{self, Density, Radius, Scale, Texture};
use azulejo::psp::{ClassOptions, sample_classes};
use azulejo::{Classes, Error, Result};

use crate::answer::call;
use crate::memory::rows;
use crate::mesh::Handle;
use crate::surface::{answer, numbers};
use crate::{given, order};

/// The options of a set, as JavaScript lays them out.
#[repr(C)]
pub struct VaryingOptions {
    progressive: f64,
    quotient: f64,
    cosine: f64,
    /// The kind of the numbers of the mesh: 0 none, 1 radii of the vertices, 2 a density.
    kind: f64,
    /// Of a density, the radius where it is 1, or the number of samples if that is above 0.
    radius: f64,
    count: f64,
    /// Of an image: its pixels in a row and its rows; 0 where the numbers are of the vertices.
    width: f64,
    height: f64,
}

impl VaryingOptions {
    /// The radius on a mesh, if it varies.
    fn radius<'a>(&self, mesh: &Handle, values: &'a [f32], texture: &'a [[f32; 2]]) -> Result<Option<Radius<'a>>> {
        if self.kind < 2.0 {
            let radii = (self.kind > 0.0).then(|| of_vertices("vertex_radii", mesh, values)).transpose()?;
            return Ok(radii.map(Radius::PerVertex));
        }
        let density = density(mesh, values, [self.width as usize, self.height as usize], texture)?;
        let scale = if self.count > 0.0 { Scale::Count(self.count) } else { Scale::Radius(self.radius) };
        Ok(Some(Radius::Density { density, scale }))
    }
}

/// Values of the vertices of a mesh.
fn of_vertices<'a>(argument: &'static str, mesh: &Handle, values: &'a [f32]) -> Result<&'a [f32]> {
    let vertices = mesh.0.positions().len();
    if values.len() == vertices {
        return Ok(values);
    }
    let reason = format!("{} numbers for {vertices} vertices", values.len());
    Err(Error::InvalidArgument { argument, reason })
}

/// A density on a mesh: of the vertices where it has no size, or an image.
pub(crate) fn density<'a>(
    mesh: &Handle,
    values: &'a [f32],
    [width, height]: [usize; 2],
    texture: &'a [[f32; 2]],
) -> Result<Density<'a>> {
    if width == 0 && height == 0 {
        return Ok(Density::PerVertex(of_vertices("density", mesh, values)?));
    }
    let is_of_vertices = texture.len() == mesh.0.positions().len();
    let corners = || texture.as_chunks().0;
    let texture = if is_of_vertices { Texture::PerVertex(texture) } else { Texture::PerCorner(corners()) };
    Ok(Density::Image { values, width, height, texture })
}

/// The samples of a varying radius; the radius of each, and [`numbers`], of which the radius is what they are multiplied by.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_adaptive(
    mesh: &Handle,
    options: &VaryingOptions,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    values: *const f32,
    value_count: usize,
    texture: *const [f32; 2],
    texture_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    // SAFETY: likewise.
    let (values, texture) = unsafe { (rows(values, value_count), rows(texture, texture_count)) };
    call(|context, progress| {
        let radius = options.radius(mesh, values, texture)?.unwrap_or(Radius::PerVertex(values));
        let request = adaptive::Options::new(radius)
            .order(order((options.progressive != 0.0).into()))
            .quotient(options.quotient)
            .cosine(options.cosine)
            .seed(seed)
            .given(given);
        let (mut samples, report) = adaptive::sample(context, &mesh.0, &request, progress)?;
        let radii = std::mem::take(&mut samples.radii);
        Ok(answer(samples).and(radii).and(numbers(&report)))
    })
}

/// The samples of several classes; the class of each and, if there is a varying radius that is the unit of theirs, this one; and
/// [`numbers`].
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample_classes(
    mesh: &Handle,
    options: &VaryingOptions,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
    values: *const f32,
    value_count: usize,
    texture: *const [f32; 2],
    texture_count: usize,
    radii: *const f64,
    radius_count: usize,
    masks: *const u32,
    mask_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    // SAFETY: likewise.
    let (values, texture) = unsafe { (rows(values, value_count), rows(texture, texture_count)) };
    // SAFETY: likewise.
    let (radii, masks) = unsafe { (rows(radii, radius_count), rows(masks, mask_count)) };
    call(|context, progress| {
        let classes = Classes::new(radii.len().isqrt(), radii)?;
        let request = ClassOptions::default()
            .order(order((options.progressive != 0.0).into()))
            .quotient(options.quotient)
            .cosine(options.cosine)
            .seed(seed)
            .given(given)
            .unit(options.radius(mesh, values, texture)?);
        let masks = (!masks.is_empty()).then_some(masks);
        let (mut samples, report) = sample_classes(context, &mesh.0, &request, &classes, masks, progress)?;
        let (classes, radii) = (std::mem::take(&mut samples.classes), std::mem::take(&mut samples.radii));
        Ok(answer(samples).and(classes).and(radii).and(numbers(&report)))
    })
}
