//! The estimate of the samples that varying radii require, before any work is done.

use crate::error::{Error, Result};
use crate::job::{Job, chunks_of};
use crate::memory;
use crate::mesh::Mesh;
use crate::psp::adaptive::field::RadiusField;
use crate::psp::fill::measures::{expected_samples_of, longest_edge};
use crate::psp::fragment::{Fragment, Shape, slice};

/// Triangles per task of the estimate.
const CHUNK: usize = 1 << 13;
/// The approximate maximum of the number of pieces on which samples are counted.
const ESTIMATES: f64 = 1e5;
/// Peak memory per sample.
const BYTES_PER_SAMPLE: f64 = 800.0;

/// Estimates the number of samples and refuses radii that require more than can be indexed or held. They are counted on
/// pieces of the surface, each as if it had the radius of its centre: those of the area, and those along parts longer
/// than the radius.
pub(super) fn require(job: &Job, mesh: &Mesh, field: &RadiusField) -> Result<f64> {
    // Needles have almost no area: their lengths bound the pieces as well.
    let lengths: f64 = mesh.sampled_triangles().map(|triangle| longest_edge(mesh, triangle)).sum();
    // Pieces that are shorter than every radius add no information, either.
    let longest = (4.0 * mesh.area() / ESTIMATES).sqrt().max(lengths / ESTIMATES).max(field.all().least);
    let chunks = chunks_of(mesh.triangles().len(), CHUNK);
    let estimates = job.map(chunks.len(), |chunk| {
        let (mut slices, mut estimate) = (Vec::new(), 0.0);
        for (triangle, area) in mesh.triangles_with_area(chunks.range(chunk)) {
            let mut count = |piece: &Fragment, shape: &Shape, area: f64| {
                estimate += expected_samples_of(field.centre(piece, shape), area, shape.longest);
            };
            let whole = Fragment::whole(triangle);
            let shape = whole.shape(mesh);
            if shape.longest <= longest {
                count(&whole, &shape, area);
            } else {
                slice(mesh, triangle, longest, &mut slices);
                for slice in slices.drain(..) {
                    slice.parts_up_to(mesh, longest).for_each(|part| count(&part, &part.shape(mesh), part.area(mesh)));
                }
            }
        }
        estimate
    })?;
    let estimate: f64 = estimates.iter().sum();
    field.check()?;
    let (argument, all) = (field.argument(), field.all());
    if estimate > f64::from(u32::MAX) {
        let [least, largest] = [all.least, all.largest];
        let reason =
            format!("{least:?} to {largest:?} asks for about {estimate:.3e} samples; the limit is {}", u32::MAX);
        return Err(Error::too_large(argument, reason));
    }
    memory::require(estimate * BYTES_PER_SAMPLE, argument, &format!("about {estimate:.3e} samples"))?;
    Ok(estimate)
}
