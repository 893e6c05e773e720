//! The surface in blocks, the cubes of `cubes.rs`: what each of them has to fill.
//!
//! A triangle belongs to the cube of its first corner. What is longer than a quarter of a cube is cut into pieces
//! before, which belong to the cubes of their first corners. So nothing reaches far out of its cube, and cubes of one
//! colour do not matter to each other.

use glam::DVec3;

use crate::error::Result;
use crate::geometry::counting_sort::Binned;
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::cubes::{Cube, Numbers, SIDE};
use crate::psp::fill::extent::Extent;
use crate::psp::fill::region::{Items, parts_up_to};
use crate::psp::fill::rounds::PATCH;
use crate::psp::fill::triangles::{GROUP, Measures, Triangles};
use crate::psp::fragment::Fragment;
use crate::psp::pieces::slice;
use crate::psp::samples::SampleSet;

/// Groups of triangles per task.
const CHUNK: usize = 1 << 12;

/// What is longer, in radii, is cut. A sample then lies no farther than this from its cube.
const LONGEST: f64 = SIDE as f64 / 4.0;

/// The surface by cubes.
pub(in crate::psp) struct Blocks {
    chunks: Vec<Chunk>,
    /// The cubes, where in each the surface is, which chunks have something there, and by what number.
    pub cubes: Vec<Cube>,
    extents: Vec<Extent>,
    parts: Binned<(u32, u32)>,
}

/// The surface in a cube.
pub(in crate::psp) struct Block {
    pub cube: Cube,
    pub extent: Extent,
    pub triangles: Vec<u32>,
    pub pieces: Vec<Fragment>,
}

/// Some of the triangles by cubes.
struct Chunk {
    cubes: Vec<Cube>,
    extents: Vec<Extent>,
    triangles: Binned<u32>,
    pieces: Binned<Fragment>,
}

impl Blocks {
    pub fn new(job: &Job, mesh: &Mesh, measures: &Measures, samples: &SampleSet) -> Result<Self> {
        let chunks = chunks_of(measures.triangles().groups(), CHUNK);
        let chunks = job.map(chunks.len(), |chunk| Chunk::new(mesh, measures, chunks.range(chunk), samples))?;
        let (mut numbers, mut extents, mut parts) = (Numbers::new(), Vec::new(), Vec::new());
        for (chunk, part) in (0..).zip(&chunks) {
            for ((number, &cube), extent) in (0..).zip(&part.cubes).zip(&part.extents) {
                let cube = numbers.of(cube);
                extents.resize(numbers.cubes.len(), Extent::EMPTY);
                extents[cube].join(extent);
                parts.push((cube, (chunk, number)));
            }
        }
        let cubes = numbers.cubes;
        let parts = Binned::new(cubes.len(), parts.iter().copied());
        Ok(Self { chunks, cubes, extents, parts })
    }

    /// What is in one of the cubes.
    pub fn block(&self, number: usize) -> Block {
        let (mut triangles, mut pieces) = (Vec::new(), Vec::new());
        for &(chunk, part) in self.parts.bin(number) {
            triangles.extend_from_slice(self.chunks[chunk as usize].triangles.bin(part as usize));
            pieces.extend_from_slice(self.chunks[chunk as usize].pieces.bin(part as usize));
        }
        Block { cube: self.cubes[number], extent: self.extents[number], triangles, pieces }
    }
}

impl Block {
    pub fn items(&self) -> Items<'_> {
        Items { triangles: Triangles::Listed(&self.triangles), pieces: &self.pieces }
    }
}

impl Chunk {
    fn new(mesh: &Mesh, measures: &Measures, groups: std::ops::Range<usize>, samples: &SampleSet) -> Self {
        let (mut numbers, mut extents) = (Numbers::new(), Vec::new());
        let (mut whole, mut pieces, mut slices) = (Vec::new(), Vec::new(), Vec::new());
        let mut place = |point: DVec3, corners: [[f32; 3]; 3]| {
            let number = numbers.of(samples.cube(point.to_array()));
            if number == extents.len() {
                extents.push(Extent::EMPTY);
            }
            corners.into_iter().for_each(|corner| extents[number].add(corner));
            number as u32
        };
        let (triangles, longest) = (measures.triangles(), LONGEST * samples.radius());
        let cuts = measures.longest() > longest;
        for group in groups {
            // Where nothing is cut no size is needed: triangles without area are left out later.
            let (areas, lengths) = if cuts { triangles.measure(mesh, group) } else { ([1.0; GROUP], [0.0; GROUP]) };
            for (lane, index) in triangles.group(group).enumerate().filter(|&(lane, _)| areas[lane] > 0.0) {
                let triangle = triangles.at(index);
                if lengths[lane] <= longest * longest {
                    let corners = mesh.corners(triangle);
                    whole.push((place(exact(corners[0]), corners), triangle));
                    continue;
                }
                slices.clear();
                slice(mesh, triangle, PATCH * samples.radius(), &mut slices);
                for piece in slices.iter().flat_map(|slice| parts_up_to(mesh, slice, longest)) {
                    let corners = piece.corners.map(|corner| mesh.point_exact(triangle, corner));
                    pieces.push((place(corners[0], corners.map(|corner| corner.as_vec3().to_array())), piece));
                }
            }
        }
        let cubes = numbers.cubes;
        let triangles = Binned::new(cubes.len(), whole.iter().map(|&(number, item)| (number as usize, item)));
        let pieces = Binned::new(cubes.len(), pieces.iter().map(|&(number, item)| (number as usize, item)));
        Self { cubes, extents, triangles, pieces }
    }
}
