//! The surface in blocks, the cubes of `cubes.rs`: what each of them has to fill.
//!
//! A triangle belongs to the cube of its first corner. What is longer than a quarter of a cube is cut into pieces
//! before, which belong to the cubes of their first corners. So nothing reaches far out of its cube, and cubes of one
//! colour do not matter to each other.

use crate::error::Result;
use crate::geometry::counting_sort::Binned;
use crate::job::{Job, chunks_of};
use crate::mesh::Mesh;
use crate::psp::cubes::{Cube, SIDE};
use crate::psp::fill::region::parts_up_to;
use crate::psp::fill::rounds::PATCH;
use crate::psp::fill::space::key;
use crate::psp::fill::table::Table;
use crate::psp::fill::triangles::Triangles;
use crate::psp::fragment::Fragment;
use crate::psp::pieces::slice;
use crate::psp::samples::SampleSet;

/// Groups of triangles per task.
const CHUNK: usize = 1 << 10;

/// What is longer, in radii, is cut. A sample then lies no farther than this from its cube.
const LONGEST: f64 = SIDE as f64 / 4.0;

/// The surface by cubes.
pub(super) struct Blocks {
    chunks: Vec<Chunk>,
    /// The cubes, which chunks have something in each, and by what number.
    pub cubes: Vec<Cube>,
    parts: Binned<(u32, u32)>,
}

/// Some of the triangles by cubes.
struct Chunk {
    cubes: Vec<Cube>,
    triangles: Binned<u32>,
    pieces: Binned<Fragment>,
}

impl Blocks {
    pub fn new(job: &Job, mesh: &Mesh, triangles: Triangles, samples: &SampleSet) -> Result<Self> {
        let chunks = chunks_of(triangles.groups(), CHUNK);
        let chunks = job.map(chunks.len(), |chunk| Chunk::new(mesh, triangles, chunks.range(chunk), samples))?;
        let (mut numbers, mut cubes, mut parts) = (Table::new(), Vec::new(), Vec::new());
        for (chunk, part) in (0..).zip(&chunks) {
            for (number, &cube) in (0..).zip(&part.cubes) {
                parts.push((number_of(cube, &mut numbers, &mut cubes), (chunk, number)));
            }
        }
        let parts = Binned::new(cubes.len(), parts.iter().copied());
        Ok(Self { chunks, cubes, parts })
    }

    /// The triangles and the pieces in a cube.
    pub fn content(&self, cube: usize) -> (Vec<u32>, Vec<Fragment>) {
        let (mut triangles, mut pieces) = (Vec::new(), Vec::new());
        for &(chunk, number) in self.parts.bin(cube) {
            triangles.extend_from_slice(self.chunks[chunk as usize].triangles.bin(number as usize));
            pieces.extend_from_slice(self.chunks[chunk as usize].pieces.bin(number as usize));
        }
        (triangles, pieces)
    }
}

impl Chunk {
    fn new(mesh: &Mesh, triangles: Triangles, groups: std::ops::Range<usize>, samples: &SampleSet) -> Self {
        let (mut numbers, mut cubes) = (Table::new(), Vec::new());
        let (mut whole, mut pieces, mut slices) = (Vec::new(), Vec::new(), Vec::new());
        let longest = LONGEST * samples.radius();
        for group in groups {
            let (areas, lengths) = triangles.measure(mesh, group);
            for (lane, index) in triangles.group(group).enumerate().filter(|&(lane, _)| areas[lane] > 0.0) {
                let triangle = triangles.at(index);
                if lengths[lane] <= longest * longest {
                    let cube = samples.cube(mesh.corners(triangle)[0].map(f64::from));
                    whole.push((number_of(cube, &mut numbers, &mut cubes), triangle));
                    continue;
                }
                slices.clear();
                slice(mesh, triangle, PATCH * samples.radius(), &mut slices);
                for piece in slices.iter().flat_map(|slice| parts_up_to(mesh, slice, longest)) {
                    let cube = samples.cube(mesh.point_exact(triangle, piece.corners[0]).to_array());
                    pieces.push((number_of(cube, &mut numbers, &mut cubes), piece));
                }
            }
        }
        let triangles = Binned::new(cubes.len(), whole.iter().copied());
        let pieces = Binned::new(cubes.len(), pieces.iter().copied());
        Self { cubes, triangles, pieces }
    }
}

/// The number of a cube: a new one where it has none.
fn number_of(cube: Cube, numbers: &mut Table<u32>, cubes: &mut Vec<Cube>) -> usize {
    let number = numbers.entry(key(cube.0.map(|x| x as u32)));
    if *number == 0 {
        cubes.push(cube);
        *number = cubes.len() as u32;
    }
    *number as usize - 1
}
