//! The surface in pieces on which the radius changes little: the number of samples that they require, and the pieces that
//! are filled, by cubes. The pieces of a cube are filled together.

use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use glam::DVec3;

use crate::error::Result;
use crate::index::Buckets;
use crate::job::{Chunks, Job, chunks_of};
use crate::mesh::Mesh;
use crate::psp::adaptive::field::{Quota, RadiusBounds, RadiusField};
use crate::psp::adaptive::set::{CubesOfPieces, OctaveCubes};
use crate::psp::fill::{Patch, WholeTriangle, expected_samples_of, longest_edge, require_samples};
use crate::psp::fragment::{Fragment, Shape, slice};
use crate::psp::set::OctaveCube;

/// Triangles per task.
const CHUNK: usize = 1024;

/// The share by which the scale at which a triangle is covered is increased: several times what rounding adds, so that
/// the test that finds it covered would do so again at this scale (`fill/page.rs`).
const ROUNDING: f64 = 1e-5;

/// Pieces are no longer than this, in local radii.
pub const LONGEST: f64 = 4.0;

/// A piece of the surface, all of it uncovered.
pub enum Piece {
    Whole(WholeTriangle<RadiusBounds>),
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

/// A triangle with an area, as it is at every scale.
#[derive(Clone, Copy)]
struct Measured {
    triangle: u32,
    area: f64,
    longest: f64,
    centre: DVec3,
    /// Of the relative radius.
    bounds: RadiusBounds,
}

/// The triangles with an area that are cut into pieces. Those of a set of many levels are measured once: bounds of the
/// radius take longer than anything else that is done with a triangle at a scale.
pub struct MeasuredTriangles<'a> {
    pub mesh: &'a Mesh,
    chunks: Chunks,
    /// Those of each chunk, if they are kept.
    kept: Vec<Vec<Measured>>,
    /// With them, for each triangle of the mesh, a scale down to which one sample certainly covers it: the bits of an
    /// `f64`. Samples stay, so that it holds on all levels to come.
    covered: Vec<AtomicU64>,
    /// The number of samples of the set for which that holds.
    samples: AtomicUsize,
    /// The scale from which no triangle is cut. Below it covered triangles are not left out: they are tested in groups,
    /// and the parts of others come between groups, so that the order of open parts would change, and with it the set.
    cut_below: f64,
}

impl<'a> MeasuredTriangles<'a> {
    /// The triangles of a set that is filled at once.
    pub fn of(mesh: &'a Mesh) -> Self {
        Self {
            mesh,
            chunks: chunks_of(mesh.triangles().len(), CHUNK),
            kept: Vec::new(),
            covered: Vec::new(),
            samples: AtomicUsize::new(0),
            cut_below: 0.0,
        }
    }

    /// The triangles of a set of many levels, with 72 bytes for each.
    pub fn kept(job: &Job, mesh: &'a Mesh, field: &RadiusField) -> Result<Self> {
        let field = &field.at_scale(1.0);
        let triangles = Self::of(mesh);
        let kept = job.map(triangles.chunks.len(), |chunk| triangles.measure(chunk, field).collect::<Vec<_>>())?;
        field.check()?;
        let cut_below = |triangle: &Measured| triangle.longest / (LONGEST * field.settled(triangle.bounds).scale());
        let cut_below = (1.0 + ROUNDING) * kept.iter().flatten().map(cut_below).fold(0.0, f64::max);
        let covered = (0..mesh.triangles().len()).map(|_| AtomicU64::new(f64::INFINITY.to_bits())).collect();
        Ok(Self { kept, covered, cut_below, ..triangles })
    }

    /// True if scales are kept at which triangles are covered.
    pub fn keeps_covered(&self) -> bool {
        !self.covered.is_empty()
    }

    /// Keeps the scale at which a sample just covers a triangle. Only one task does so for a triangle at a time.
    pub fn cover(&self, triangle: u32, scale: f64) {
        self.covered[triangle as usize].store((scale * (1.0 + ROUNDING)).to_bits(), Ordering::Relaxed);
    }

    /// True if a sample of a level before certainly covers a triangle at a scale, and it can be left out.
    fn is_covered(&self, triangle: u32, scale: f64) -> bool {
        let covered = self.covered.get(triangle as usize).filter(|_| scale > self.cut_below);
        covered.is_some_and(|least| f64::from_bits(least.load(Ordering::Relaxed)) < scale)
    }

    /// Forgets what is covered, unless the set is the one that the last level ended with. A level that is filled as if
    /// there were no samples needs all triangles.
    pub fn begin_level(&self, samples: usize, is_bare: bool) {
        if is_bare || samples != self.samples.load(Ordering::Relaxed) {
            self.covered.iter().for_each(|least| least.store(f64::INFINITY.to_bits(), Ordering::Relaxed));
        }
    }

    /// Ends a level with so many samples in the set.
    pub fn end_level(&self, samples: usize) {
        self.samples.store(samples, Ordering::Relaxed);
    }

    /// The triangles of a chunk, given the relative radii.
    fn chunk(&self, chunk: usize, field: &RadiusField) -> Cow<'_, [Measured]> {
        self.kept.get(chunk).map_or_else(|| self.measure(chunk, field).collect(), |kept| kept.as_slice().into())
    }

    fn measure(&self, chunk: usize, field: &RadiusField) -> impl Iterator<Item = Measured> {
        self.mesh.triangles_with_area(self.chunks.range(chunk)).map(|(triangle, area)| {
            let whole = Fragment::whole(triangle);
            let shape = whole.shape(self.mesh);
            let bounds = field.bounds(&whole, &shape, field.all());
            Measured { triangle, area, longest: shape.longest, centre: shape.centre, bounds }
        })
    }
}

/// The pieces of the whole surface.
pub fn pieces(
    job: &Job,
    triangles: &MeasuredTriangles,
    field: &RadiusField,
    quota: &Quota,
    cubes: &OctaveCubes,
) -> Result<Buckets<OctaveCube, Piece>> {
    let (mesh, relative) = (triangles.mesh, &field.at_scale(1.0));
    let (pieces, _) = Buckets::collect(job, triangles.chunks.len(), |chunk, add| {
        let mut slices = Vec::new();
        let mut cuts = Cuts { mesh, field, quota, cubes: cubes.of_pieces(field.scale()), add };
        for &Measured { triangle, area, longest, centre, bounds } in &*triangles.chunk(chunk, relative) {
            let bounds = bounds.times(field.scale());
            // One that is covered needs no cube: most are, by the samples of the level before.
            if triangles.is_covered(triangle, field.scale()) || field.is_empty_radius(bounds.least) {
                continue;
            }
            if cuts.is_small(longest, bounds) {
                let bounds = field.settled(bounds);
                let (area, longest) = (area * bounds.density(), longest / bounds.scale());
                let whole = WholeTriangle { triangle, area: area as f32, longest: longest as f32, local: bounds };
                cuts.add(centre, bounds, Piece::Whole(whole));
            } else {
                slice(mesh, triangle, LONGEST * field.settled(bounds).scale(), &mut slices);
                if let [whole] = slices[..] {
                    slices.splice(.., whole.parts(2));
                }
                slices.drain(..).for_each(|slice| cuts.cut(&slice, bounds));
            }
        }
    })?;
    relative.check()?;
    Ok(pieces)
}

/// The state of a task that cuts triangles.
struct Cuts<'a> {
    mesh: &'a Mesh,
    field: &'a RadiusField<'a>,
    quota: &'a Quota,
    cubes: CubesOfPieces<'a>,
    add: &'a mut dyn FnMut(OctaveCube, Piece),
}

impl Cuts<'_> {
    fn is_small(&self, longest: f64, bounds: RadiusBounds) -> bool {
        longest <= LONGEST * self.field.settled(bounds).scale() || self.quota.is_exceeded()
    }

    fn add(&mut self, centre: DVec3, bounds: RadiusBounds, piece: Piece) {
        self.quota.take(1);
        (self.add)(self.cubes.cube(centre, bounds.largest), piece);
    }

    /// Cuts a fragment that is part of one with bounds `within` into quarters, until they are small enough.
    fn cut(&mut self, fragment: &Fragment, within: RadiusBounds) {
        let shape = fragment.shape(self.mesh);
        let bounds = self.field.bounds(fragment, &shape, within);
        if self.field.is_empty_radius(bounds.least) {
            return;
        }
        if !self.is_small(shape.longest, bounds) {
            return fragment.parts(2).for_each(|quarter| self.cut(&quarter, bounds));
        }
        let bounds = self.field.settled(bounds);
        let (area, longest) = (fragment.area(self.mesh) * bounds.density(), shape.longest / bounds.scale());
        let (area, longest) = (area as f32, longest as f32);
        let part = Patch { fragment: *fragment, open: u16::MAX, area, longest, local: bounds };
        self.add(shape.centre, bounds, Piece::Part(Box::new(part)));
    }
}

/// Triangles per task of the estimate.
const ESTIMATE_CHUNK: usize = 1 << 13;
/// The approximate maximum of the number of pieces on which samples are counted.
const ESTIMATES: f64 = 1e5;
/// Peak memory per sample, where triangles are cut into pieces smaller than the radius; in progressive order; and per
/// triangle.
pub const BYTES_PER_SAMPLE: f64 = 265.0;
pub const BYTES_PER_RANKED_SAMPLE: f64 = 390.0;
const BYTES_PER_TRIANGLE: f64 = 60.0;

/// Estimates the number of samples and refuses radii that require more than can be indexed or held. They are counted on
/// pieces of the surface, each as if it had the radius of its centre: those of the area, and those along parts longer
/// than the radius. For the memory a part has its share, by area, of those along its triangle.
pub fn checked_samples(job: &Job, mesh: &Mesh, field: &RadiusField, bytes_per_sample: f64) -> Result<f64> {
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
    let bytes = held * bytes_per_sample + mesh.triangles().len() as f64 * BYTES_PER_TRIANGLE;
    require_samples(estimate, bytes / estimate.max(1.0), argument, &asking)?;
    Ok(estimate)
}
