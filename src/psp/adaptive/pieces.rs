//! The surface in pieces on which the radius changes little: the number of samples that they require, and the pieces that
//! are filled, by cubes. The pieces of a cube are filled together.

use crate::error::Result;
use crate::index::Buckets;
use crate::job::{Job, chunks_of};
use crate::mesh::Mesh;
use crate::psp::adaptive::field::{Quota, RadiusBounds, RadiusField};
use crate::psp::adaptive::set::OctaveCubes;
use crate::psp::cubes::OctaveCube;
use crate::psp::fill::measures::{expected_samples_of, longest_edge, require_samples};
use crate::psp::fill::rounds::{Patch, Whole};
use crate::psp::fragment::{Fragment, Shape, slice};

/// Triangles per task.
const CHUNK: usize = 1024;

/// Pieces are no longer than this, in local radii.
pub const LONGEST: f64 = 4.0;

/// A piece of the surface, all of it uncovered.
pub enum Piece {
    Whole(Whole<RadiusBounds>),
    Part(Box<Patch<RadiusBounds>>),
}

impl Piece {
    pub fn fragment(&self) -> Fragment {
        match self {
            Self::Whole(whole) => Fragment::whole(whole.triangle),
            Self::Part(part) => part.fragment,
        }
    }

    /// The area, in squares of the local radius.
    pub fn area(&self) -> f64 {
        match self {
            Self::Whole(whole) => whole.area.into(),
            Self::Part(part) => part.area.into(),
        }
    }

    pub fn bounds(&self) -> RadiusBounds {
        match self {
            Self::Whole(whole) => whole.local,
            Self::Part(part) => part.local,
        }
    }
}

/// The pieces of the whole surface.
pub fn pieces(
    job: &Job,
    mesh: &Mesh,
    field: &RadiusField,
    quota: &Quota,
    cubes: &OctaveCubes,
) -> Result<Buckets<OctaveCube, Piece>> {
    let chunks = chunks_of(mesh.triangles().len(), CHUNK);
    let (pieces, _) = Buckets::collect(job, chunks.len(), |chunk, add| {
        let (mut slices, mut cuts) = (Vec::new(), Cuts { mesh, field, quota, cubes, add });
        for (triangle, area) in mesh.triangles_with_area(chunks.range(chunk)) {
            let whole = Fragment::whole(triangle);
            let shape = whole.shape(mesh);
            let bounds = field.bounds(&whole, &shape, field.all());
            if field.is_empty_radius(bounds.least) {
                continue;
            }
            if cuts.is_small(&shape, bounds) {
                let bounds = field.settled(bounds);
                let (area, longest) = (area * bounds.density(), shape.longest / bounds.scale());
                let whole = Whole { triangle, area: area as f32, longest: longest as f32, local: bounds };
                cuts.add(&shape, bounds, Piece::Whole(whole));
            } else {
                slice(mesh, triangle, LONGEST * field.settled(bounds).scale(), &mut slices);
                if let [whole] = slices[..] {
                    slices.splice(.., whole.parts(2));
                }
                slices.drain(..).for_each(|slice| cuts.cut(&slice, bounds));
            }
        }
    })?;
    Ok(pieces)
}

/// The state of a task that cuts triangles.
struct Cuts<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    cubes: &'a OctaveCubes,
    add: &'a mut dyn FnMut(OctaveCube, Piece),
}

impl Cuts<'_> {
    fn is_small(&self, shape: &Shape, bounds: RadiusBounds) -> bool {
        shape.longest <= LONGEST * self.field.settled(bounds).scale() || self.quota.is_exceeded()
    }

    fn add(&mut self, shape: &Shape, bounds: RadiusBounds, piece: Piece) {
        self.quota.take(1);
        (self.add)(self.cubes.cube_of_piece(shape.centre, bounds.largest), piece);
    }

    /// Cuts a fragment that is part of one with bounds `within` into quarters, until they are small enough.
    fn cut(&mut self, fragment: &Fragment, within: RadiusBounds) {
        let shape = fragment.shape(self.mesh);
        let bounds = self.field.bounds(fragment, &shape, within);
        if self.field.is_empty_radius(bounds.least) {
            return;
        }
        if !self.is_small(&shape, bounds) {
            return fragment.parts(2).for_each(|quarter| self.cut(&quarter, bounds));
        }
        let bounds = self.field.settled(bounds);
        let (area, longest) = (fragment.area(self.mesh) * bounds.density(), shape.longest / bounds.scale());
        let (area, longest) = (area as f32, longest as f32);
        let part = Patch { fragment: *fragment, open: u16::MAX, area, longest, local: bounds };
        self.add(&shape, bounds, Piece::Part(Box::new(part)));
    }
}

/// Triangles per task of the estimate.
const ESTIMATE_CHUNK: usize = 1 << 13;
/// The approximate maximum of the number of pieces on which samples are counted.
const ESTIMATES: f64 = 1e5;
/// Peak memory per sample, where triangles are cut into pieces smaller than the radius; in progressive order; and per
/// triangle.
const BYTES_PER_SAMPLE: f64 = 265.0;
const BYTES_PER_RANKED_SAMPLE: f64 = 390.0;
const BYTES_PER_TRIANGLE: f64 = 60.0;

/// Estimates the number of samples and refuses radii that require more than can be indexed or held. They are counted on
/// pieces of the surface, each as if it had the radius of its centre: those of the area, and those along parts longer
/// than the radius. For the memory a part has its share, by area, of those along its triangle.
pub fn checked_samples(job: &Job, mesh: &Mesh, field: &RadiusField, is_ranked: bool) -> Result<f64> {
    // Needles have almost no area: their lengths bound the pieces as well.
    let lengths: f64 = mesh.sampled_triangles().map(|triangle| longest_edge(mesh, triangle)).sum();
    // Pieces that are shorter than every radius add no information, either.
    let longest = (4.0 * mesh.area() / ESTIMATES).sqrt().max(lengths / ESTIMATES).max(field.all().least);
    let chunks = chunks_of(mesh.triangles().len(), ESTIMATE_CHUNK);
    let estimates = job.map(chunks.len(), |chunk| {
        let (mut slices, mut estimate) = (Vec::new(), [0.0; 2]);
        for (triangle, area) in mesh.triangles_with_area(chunks.range(chunk)) {
            let whole = Fragment::whole(triangle);
            let shape = whole.shape(mesh);
            let mut count = |piece: &Fragment, own: &Shape, part: f64| {
                let radius = field.centre(piece, own);
                estimate[0] += expected_samples_of(radius, part, own.longest);
                estimate[1] += part / area * expected_samples_of(radius, area, shape.longest);
            };
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
    let [estimate, held] = [0, 1].map(|of: usize| estimates.iter().map(|both| both[of]).sum::<f64>());
    field.check()?;
    let (argument, all) = (field.argument(), field.all());
    let asking = format!("{:?} to {:?} asks for", all.least, all.largest);
    // What triangles take is told as that of more samples.
    let each = if is_ranked { BYTES_PER_RANKED_SAMPLE } else { BYTES_PER_SAMPLE };
    let bytes = held * each + mesh.triangles().len() as f64 * BYTES_PER_TRIANGLE;
    require_samples(estimate, bytes / estimate.max(1.0), argument, &asking)?;
    Ok(estimate)
}
