//! The surface in blocks, the cubes of `cubes.rs`: what each of them has to fill.
//!
//! A triangle belongs to the cube of its first corner. What is longer than a quarter of a cube is cut into pieces
//! before, which belong to the cubes of their first corners. So nothing reaches far out of its cube, and cubes of one
//! colour do not matter to each other.
//!
//! Most triangles are not looked at: where the ball around a group lies in a cube, so does the group.

use crate::error::Result;
use crate::index::Binned;
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::cubes::{Cube, Numbers, SIDE};
use crate::psp::fill::balls::Ball;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::items::{Group, Items};
use crate::psp::fill::region::parts_up_to;
use crate::psp::fill::rounds::PATCH;
use crate::psp::fill::triangles::{GROUP, Measures};
use crate::psp::fragment::Fragment;
use crate::psp::pieces::slice;
use crate::psp::samples::SampleSet;

/// Groups of triangles per task.
const CHUNK: usize = 1 << 12;

/// What is longer, in radii, is cut. A sample then lies no farther than this from its cube.
const LONGEST: f64 = SIDE as f64 / 4.0;

/// Of balls that are no larger than this, in radii, most lie in one cube.
const LARGEST_BALL: f64 = SIDE as f64 / 8.0;

/// The surface by cubes.
pub(in crate::psp) struct Blocks<'a> {
    measures: &'a Measures,
    balls: Option<&'a [Ball]>,
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
    pub items: Items,
}

/// Some of the triangles by cubes.
struct Chunk {
    cubes: Vec<Cube>,
    extents: Vec<Extent>,
    /// Groups that lie in one cube, and the indices of triangles of all other groups.
    groups: Binned<u32>,
    indices: Binned<u32>,
    pieces: Binned<Fragment>,
}

impl<'a> Blocks<'a> {
    pub fn new(job: &Job, mesh: &Mesh, measures: &'a Measures, samples: &SampleSet) -> Result<Self> {
        let balls = measures.balls_up_to(&job.part(0.0, 0.2), mesh, LARGEST_BALL * samples.radius())?;
        let chunks = chunks_of(measures.triangles().groups(), CHUNK);
        let chunk = |chunk: usize| Chunk::new(mesh, measures, balls, chunks.range(chunk), samples);
        let chunks = job.part(0.2, 1.0).map(chunks.len(), chunk)?;
        let (mut numbers, mut extents, mut parts) = (Numbers::new(), Vec::new(), Vec::new());
        for (chunk, part) in (0..).zip(&chunks) {
            for ((number, &cube), extent) in (0..).zip(&part.cubes).zip(&part.extents) {
                let cube = numbers.of(cube);
                extents.resize(numbers.cubes.len(), Extent::EMPTY);
                extents[cube].join(extent);
                parts.push((cube, (chunk, number)));
            }
        }
        // Balls reach beyond what is in them, and maybe beyond what a float can be.
        let bounds = Extent::of(mesh.bounds().into());
        extents.iter_mut().for_each(|extent| extent.clip(&bounds));
        let cubes = numbers.cubes;
        let parts = Binned::new(cubes.len(), parts.iter().copied());
        Ok(Self { measures, balls, chunks, cubes, extents, parts })
    }

    /// What is in one of the cubes, in the order of the mesh.
    pub fn block(&self, number: usize) -> Block {
        let (measured, mut items) = (self.measures.triangles(), Items::default());
        for &(chunk, part) in self.parts.bin(number) {
            let (chunk, part) = (&self.chunks[chunk as usize], part as usize);
            let mut single = chunk.indices.bin(part).iter().map(|&index| index as usize).peekable();
            let groups = chunk.groups.bin(part).iter().map(|&group| group as usize);
            for (group, ball) in groups.flat_map(|group| self.balls.map(|balls| (group, balls[group]))) {
                let indices = measured.group(group);
                while let Some(index) = single.next_if(|&index| index < indices.start) {
                    items.triangles.push(measured.at(index));
                }
                let start = items.triangles.len() as u32;
                items.triangles.extend(indices.map(|index| measured.at(index)));
                let indices = start..items.triangles.len() as u32;
                items.groups.push(Group { indices, area: self.measures.areas[group], ball });
            }
            items.triangles.extend(single.map(|index| measured.at(index)));
            items.pieces.extend_from_slice(chunk.pieces.bin(part));
        }
        Block { cube: self.cubes[number], extent: self.extents[number], items }
    }
}

impl Chunk {
    fn new(
        mesh: &Mesh,
        measures: &Measures,
        balls: Option<&[Ball]>,
        groups: std::ops::Range<usize>,
        samples: &SampleSet,
    ) -> Self {
        let (mut numbers, mut extents) = (Numbers::new(), Vec::new());
        let (mut in_one, mut whole, mut pieces, mut slices) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut place = |cube: Cube, extent: &Extent| {
            let number = numbers.of(cube);
            if number == extents.len() {
                extents.push(Extent::EMPTY);
            }
            extents[number].join(extent);
            number as u32
        };
        let (triangles, longest) = (measures.triangles(), LONGEST * samples.radius());
        let cuts = measures.longest() > longest;
        let in_one_cube = |ball: &Ball| {
            let ends = ball.ends();
            let [low, high] = ends.map(|end| samples.cube(end));
            let is_in_one = low == high && 2.0 * f64::from(ball.radius) <= longest;
            is_in_one.then(|| (low, Extent::of(ends.map(|end| end.map(|x| x as f32)))))
        };
        // Without area, no cube is needed.
        for group in groups.filter(|&group| measures.areas[group] > 0.0) {
            if let Some((cube, extent)) = balls.and_then(|balls| in_one_cube(&balls[group])) {
                in_one.push((place(cube, &extent), group as u32));
                continue;
            }
            // Where nothing is cut no size is needed: triangles without area are left out later.
            let (areas, lengths) = if cuts { triangles.measure(mesh, group) } else { ([1.0; GROUP], [0.0; GROUP]) };
            for (lane, index) in triangles.group(group).enumerate().filter(|&(lane, _)| areas[lane] > 0.0) {
                let triangle = triangles.at(index);
                if lengths[lane] <= longest * longest {
                    let corners = mesh.corners(triangle);
                    let cube = samples.cube(exact(corners[0]).to_array());
                    whole.push((place(cube, &Extent::of(corners)), index as u32));
                    continue;
                }
                slices.clear();
                slice(mesh, triangle, PATCH * samples.radius(), &mut slices);
                for piece in slices.iter().flat_map(|slice| parts_up_to(mesh, slice, longest)) {
                    let corners = piece.corners.map(|corner| mesh.point_exact(triangle, corner));
                    let extent = Extent::of(corners.map(|corner| corner.as_vec3().to_array()));
                    pieces.push((place(samples.cube(corners[0].to_array()), &extent), piece));
                }
            }
        }
        let cubes = numbers.cubes;
        let bins = cubes.len();
        let groups = Binned::new(bins, in_one.iter().map(|&(number, group)| (number as usize, group)));
        let indices = Binned::new(bins, whole.iter().map(|&(number, index)| (number as usize, index)));
        let pieces = Binned::new(bins, pieces.iter().map(|&(number, piece)| (number as usize, piece)));
        Self { cubes, extents, groups, indices, pieces }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::job::Context;
    use crate::psp::fill::darts::shuffle;
    use crate::rng::{Draw, Rng};

    /// 20,000 triangles in rows.
    pub fn rows() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let at = |i: u32, j: u32| i * 101 + j;
        let place = |i: u32, j: u32| [i as f32, j as f32, ((i * j) % 7) as f32 / 9.0];
        let halves =
            |i: u32, j: u32| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]];
        let positions = (0..=100).flat_map(|i| (0..=100).map(move |j| place(i, j)));
        let triangles = (0..100).flat_map(|i| (0..100).flat_map(move |j| halves(i, j)));
        (positions.collect(), triangles.collect())
    }

    /// In rows and in random order, some without area, masked and not. In rows most triangles come in groups, in random
    /// order none.
    #[test]
    fn cubes_have_the_triangles_that_begin_in_them() {
        let (positions, ordered) = rows();
        let mut shuffled = ordered.clone();
        shuffle(&mut Rng::at(3, Draw::Probe, &[]), &mut shuffled);
        for (is_ordered, mut triangles) in [(true, ordered), (false, shuffled)] {
            triangles[500..700].iter_mut().for_each(|triangle| triangle[1] = triangle[0]);
            let whole = Mesh::new(positions.clone(), triangles).unwrap();
            let mask = (0..whole.triangles().len()).map(|i| i % 100 != 7).collect();
            for mesh in [whole.clone(), whole.with_mask(mask).unwrap()] {
                let (measures, samples) = (Measures::of(&mesh), SampleSet::new(&mesh, 2.0));
                let blocks = |job: &Job| Blocks::new(job, &mesh, &measures, &samples);
                let blocks = Context::new(2).unwrap().run(None, blocks).unwrap();
                let mut expected: HashMap<Cube, Vec<u32>> = HashMap::new();
                for triangle in mesh.sampled_triangles() {
                    let first = exact(mesh.corners(triangle)[0]).to_array();
                    expected.entry(samples.cube(first)).or_default().push(triangle);
                }
                // A whole group without area needs no cube.
                let with_area = |triangles: &[u32]| -> Vec<u32> {
                    triangles.iter().copied().filter(|&triangle| mesh.triangle_area(triangle) > 0.0).collect()
                };
                let mut in_groups = 0;
                for (number, cube) in blocks.cubes.iter().enumerate() {
                    let Block { extent, items, .. } = blocks.block(number);
                    assert_eq!(with_area(&items.triangles), with_area(&expected.remove(cube).unwrap()));
                    let is_inside = |point: [f32; 3]| extent.is_in_reach(point, 1e-6);
                    let mut corners = items.triangles.iter().flat_map(|&triangle| mesh.corners(triangle));
                    assert!(corners.all(is_inside) && items.pieces.is_empty());
                    for group in &items.groups {
                        let triangles = &items.triangles[group.indices.start as usize..group.indices.end as usize];
                        let area: f64 = triangles.iter().map(|&triangle| mesh.triangle_area(triangle)).sum();
                        assert!((group.area / area - 1.0).abs() < 1e-12);
                        let corners = triangles.iter().flat_map(|&triangle| mesh.corners(triangle)).map(exact);
                        let mut distances = corners.map(|corner| corner.distance(exact(group.ball.centre)));
                        assert!(distances.all(|distance| distance <= group.ball.radius.into()));
                        in_groups += triangles.len();
                    }
                }
                assert!(expected.values().all(|triangles| with_area(triangles).is_empty()));
                let count = measures.triangles().len();
                assert!(if is_ordered { 2 * in_groups > count } else { in_groups == 0 }, "{in_groups} of {count}");
            }
        }
    }
}
