//! The surface in blocks, the cubes of `psp/set/cubes.rs`: the triangles that each has to fill, and random points on them.
//!
//! A triangle belongs to the cube of its first corner. Triangles longer than a quarter of a cube are first cut into
//! pieces, which belong to the cubes of their first corners. So nothing extends far out of its cube, and cubes of one
//! colour are independent.
//!
//! Most triangles are not read: if the ball around a cluster lies in a cube, so does the cluster.

use std::ops::Range;

use crate::error::Result;
use crate::index::{Binned, Weights};
use crate::job::{Job, chunks_of};
use crate::mesh::{Mesh, exact};
use crate::psp::fill::darts::random_point;
use crate::psp::fill::extent::Extent;
use crate::psp::fill::measures::{Ball, CLUSTER, Measures, Triangles};
use crate::psp::fill::rounds::{PATCH, Point};
use crate::psp::fragment::{Fragment, slice};
use crate::psp::set::{Cube, Numbers, SampleSet};
use crate::region::Region;
use crate::rng::Rng;

/// Clusters per task.
const CHUNK: usize = 1 << 12;

/// The length in sides of a cube above which triangles are cut. A sample then lies no farther than this from its cube.
const LONGEST: f64 = 0.25;

/// The size of balls, in sides of a cube, up to which most lie in one cube.
const LARGEST_BALL: f64 = 0.125;

/// The surface by cubes.
pub struct Blocks {
    chunks: Vec<Chunk>,
    pub cubes: Vec<Cube>,
    /// The box of the surface in each cube.
    pub extents: Vec<Extent>,
    /// The chunks with triangles in each cube, and the cube's number in them.
    parts: Binned<(u32, u32)>,
}

/// The surface in a cube.
pub struct Block {
    pub cube: Cube,
    pub extent: Extent,
    pub items: Items,
}

/// Some of the triangles by cubes.
struct Chunk {
    cubes: Vec<Cube>,
    extents: Vec<Extent>,
    /// Clusters that lie in one cube, and the indices of triangles of all other clusters.
    clusters: Binned<u32>,
    indices: Binned<u32>,
    pieces: Binned<Fragment>,
}

impl Blocks {
    /// The whole surface, or only the triangles and pieces whose boxes touch a region.
    pub fn new(
        job: &Job,
        mesh: &Mesh,
        measures: &Measures,
        samples: &SampleSet,
        region: Option<&Region>,
    ) -> Result<Self> {
        let balls = measures.balls_up_to(&job.part(0.0, 0.2), mesh, LARGEST_BALL * samples.side())?;
        let chunks = chunks_of(measures.triangles().clusters(), CHUNK);
        let chunk = |chunk: usize| Chunk::new(mesh, measures, balls, chunks.range(chunk), samples, region);
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
        // Balls extend beyond their clusters, and may overflow to infinity.
        let bounds = Extent::of(mesh.bounds().into());
        extents.iter_mut().for_each(|extent| extent.clip(&bounds));
        let cubes = numbers.cubes;
        let parts = Binned::new(cubes.len(), parts.iter().copied());
        Ok(Self { chunks, cubes, extents, parts })
    }

    /// The triangles of one of the cubes, in the order of the mesh, whose measures are those that the blocks are of.
    pub fn block(&self, measures: &Measures, number: usize) -> Block {
        let (measured, balls, mut items) = (measures.triangles(), measures.known_balls(), Items::default());
        for &(chunk, part) in self.parts.bin(number) {
            let (chunk, part) = (&self.chunks[chunk as usize], part as usize);
            let mut single = chunk.indices.bin(part).iter().map(|&index| index as usize).peekable();
            let clusters = chunk.clusters.bin(part).iter().map(|&cluster| cluster as usize);
            for (cluster, ball) in clusters.map(|cluster| (cluster, balls[cluster])) {
                let indices = measured.cluster(cluster);
                while let Some(index) = single.next_if(|&index| index < indices.start) {
                    items.triangles.push(measured.at(index));
                }
                let start = items.triangles.len() as u32;
                items.triangles.extend(indices.map(|index| measured.at(index)));
                let indices = start..items.triangles.len() as u32;
                items.clusters.push(Cluster { indices, area: measures.areas[cluster], ball });
            }
            items.triangles.extend(single.map(|index| measured.at(index)));
            items.pieces.extend_from_slice(chunk.pieces.bin(part));
        }
        Block { cube: self.cubes[number], extent: self.extents[number], items }
    }
}

impl Block {
    /// The part of the block whose boxes a test holds for: whole triangles and pieces.
    pub fn part(&self, mesh: &Mesh, is_in: impl Fn(&Extent) -> bool) -> Self {
        let (mut extent, mut items) = (Extent::EMPTY, Items::default());
        let mut join = |of: &Extent| {
            let is_in = is_in(of);
            if is_in {
                extent.join(of);
            }
            is_in
        };
        let left = self.items.indices_but(|ball| !is_in(&ball.extent())).map(|index| self.items.triangles[index]);
        items.triangles.extend(left.filter(|&triangle| join(&Extent::of(mesh.corners(triangle)))));
        items.pieces.extend(self.items.pieces.iter().filter(|piece| join(&piece.extent(mesh))));
        Self { cube: self.cube, extent, items }
    }
}

impl Chunk {
    fn new(
        mesh: &Mesh,
        measures: &Measures,
        balls: Option<&[Ball]>,
        clusters: std::ops::Range<usize>,
        samples: &SampleSet,
        region: Option<&Region>,
    ) -> Self {
        let touches = |extent: &Extent| region.is_none_or(|region| region.touches(extent.corners()));
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
        let (triangles, longest) = (measures.triangles(), LONGEST * samples.side());
        let cuts = measures.longest() > longest;
        let in_one_cube = |ball: &Ball| {
            let ends = ball.ends();
            let [low, high] = ends.map(|end| samples.cube(end));
            let is_in_one = low == high && 2.0 * f64::from(ball.radius) <= longest;
            is_in_one.then(|| (low, ball.extent()))
        };
        // Clusters without area need no cube.
        for cluster in clusters.filter(|&cluster| measures.areas[cluster] > 0.0) {
            if region.is_some() && balls.is_some_and(|balls| !touches(&balls[cluster].extent())) {
                continue;
            }
            if let Some((cube, extent)) = balls.and_then(|balls| in_one_cube(&balls[cluster])) {
                in_one.push((place(cube, &extent), cluster as u32));
                continue;
            }
            // If nothing is cut, no size is needed: triangles without area are dropped later.
            let (areas, lengths) =
                if cuts { triangles.measure(mesh, cluster) } else { ([1.0; CLUSTER], [0.0; CLUSTER]) };
            for (lane, index) in triangles.cluster(cluster).enumerate().filter(|&(lane, _)| areas[lane] > 0.0) {
                let triangle = triangles.at(index);
                if lengths[lane] <= longest * longest {
                    let corners = mesh.corners(triangle);
                    let (cube, extent) = (samples.cube(exact(corners[0]).to_array()), Extent::of(corners));
                    if touches(&extent) {
                        whole.push((place(cube, &extent), index as u32));
                    }
                    continue;
                }
                slices.clear();
                slice(mesh, triangle, PATCH * samples.radius(), &mut slices);
                for piece in slices.iter().flat_map(|slice| slice.parts_up_to(mesh, longest)) {
                    let (first, extent) = (mesh.point_exact(triangle, piece.corners[0]), piece.extent(mesh));
                    if touches(&extent) {
                        pieces.push((place(samples.cube(first.to_array()), &extent), piece));
                    }
                }
            }
        }
        let cubes = numbers.cubes;
        let bins = cubes.len();
        let clusters = Binned::new(bins, in_one.iter().map(|&(number, cluster)| (number as usize, cluster)));
        let indices = Binned::new(bins, whole.iter().map(|&(number, index)| (number as usize, index)));
        let pieces = Binned::new(bins, pieces.iter().map(|&(number, piece)| (number as usize, piece)));
        Self { cubes, extents, clusters, indices, pieces }
    }
}

/// Triangles, and fragments of others that are too long, which are numbered after them.
#[derive(Default)]
pub struct Items {
    pub triangles: Vec<u32>,
    /// The clusters among the triangles, in order.
    pub clusters: Vec<Cluster>,
    pub pieces: Vec<Fragment>,
}

/// Consecutive triangles that lie close together.
pub struct Cluster {
    /// Their indices.
    pub indices: Range<u32>,
    pub area: f64,
    pub ball: Ball,
}

impl Items {
    /// True if there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.pieces.is_empty()
    }

    /// The indices of the triangles, except those of clusters whose ball is covered.
    pub fn indices_but(&self, is_covered: impl Fn(&Ball) -> bool) -> impl Iterator<Item = usize> {
        let (mut next, end) = (0, self.triangles.len() as u32);
        let covered = self
            .clusters
            .iter()
            .filter(move |cluster| is_covered(&cluster.ball))
            .map(|cluster| cluster.indices.clone());
        let between = move |covered: Range<u32>| std::mem::replace(&mut next, covered.end)..covered.start;
        covered.chain(std::iter::once(end..end)).flat_map(between).map(|index| index as usize)
    }

    /// The areas of all items.
    pub fn row<'a>(&'a self, mesh: &'a Mesh) -> ItemRow<'a> {
        let (mut areas, mut entries, mut next) = (Vec::new(), Vec::new(), 0);
        let mut add = |single: Range<u32>, cluster: Option<(u32, &Cluster)>| {
            for some in self.triangles[single.start as usize..single.end as usize].chunks(CLUSTER) {
                areas.extend_from_slice(&Triangles::Listed(some).measure(mesh, 0).0[..some.len()]);
            }
            entries.extend(single.map(Entry::Item));
            areas.extend(cluster.map(|(_, cluster)| cluster.area));
            entries.extend(cluster.map(|(number, _)| Entry::Cluster(number)));
        };
        for (number, cluster) in (0..).zip(&self.clusters) {
            add(next..cluster.indices.start, Some((number, cluster)));
            next = cluster.indices.end;
        }
        let end = self.triangles.len() as u32;
        add(next..end, None);
        areas.extend(self.pieces.iter().map(|piece| piece.area(mesh)));
        entries.extend((end..).take(self.pieces.len()).map(Entry::Item));
        ItemRow {
            items: self,
            mesh,
            row: Weights::new(areas),
            entries,
            ends: vec![[0.0; CLUSTER]; self.clusters.len()],
        }
    }

    fn fragment(&self, number: usize) -> Fragment {
        match number.checked_sub(self.triangles.len()) {
            None => Fragment::whole(self.triangles[number]),
            Some(piece) => self.pieces[piece],
        }
    }
}

/// The areas of items in a row. A cluster has one area until a dart falls on it: where triangles are small, many
/// clusters are never hit.
pub struct ItemRow<'a> {
    items: &'a Items,
    mesh: &'a Mesh,
    row: Weights,
    entries: Vec<Entry>,
    /// For each cluster that a dart has hit, the running sums of its areas.
    ends: Vec<[f64; CLUSTER]>,
}

/// The owner of an area of the row, by its number.
#[derive(Clone, Copy)]
enum Entry {
    Item(u32),
    Cluster(u32),
}

impl ItemRow<'_> {
    pub fn total(&self) -> f64 {
        self.row.total()
    }

    /// A random point of all items.
    pub fn point(&mut self, rng: &mut Rng) -> Point {
        let (number, place) = self.row.pick_within(rng);
        let item = match self.entries[number as usize] {
            Entry::Item(item) => item as usize,
            Entry::Cluster(cluster) => self.in_cluster(cluster as usize, place),
        };
        let fragment = self.items.fragment(item);
        Point { triangle: fragment.triangle, barycentrics: fragment.at(random_point(rng)), local: () }
    }

    /// The triangle at a place in the row of a cluster's areas.
    fn in_cluster(&mut self, cluster: usize, place: f64) -> usize {
        let (ends, indices) = (&mut self.ends[cluster], &self.items.clusters[cluster].indices);
        let [first, end] = [indices.start, indices.end].map(|index| index as usize);
        if ends[CLUSTER - 1] == 0.0 {
            let mut total = 0.0;
            *ends = Triangles::Listed(&self.items.triangles[first..end]).measure(self.mesh, 0).0.map(|area| {
                total += area;
                total
            });
        }
        // Rounding may take the place beyond the last area.
        let place = place.min(ends[CLUSTER - 1].next_down());
        first + ends.iter().take_while(|&&end| end <= place).count()
    }
}

#[cfg(test)]
pub mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::job::Context;
    use crate::psp::fill::darts::shuffle;
    use crate::rng::Draw;

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

    /// Triangles in rows and in random order, some without area, masked and not. In rows most triangles form clusters,
    /// in random order none.
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
                let blocks = |job: &Job| Blocks::new(job, &mesh, &measures, &samples, None);
                let blocks = Context::new(2).unwrap().run(None, blocks).unwrap();
                let mut expected: HashMap<Cube, Vec<u32>> = HashMap::new();
                for triangle in mesh.sampled_triangles() {
                    let first = exact(mesh.corners(triangle)[0]).to_array();
                    expected.entry(samples.cube(first)).or_default().push(triangle);
                }
                // A whole cluster without area needs no cube.
                let with_area = |triangles: &[u32]| -> Vec<u32> {
                    triangles.iter().copied().filter(|&triangle| mesh.triangle_area(triangle) > 0.0).collect()
                };
                let mut in_clusters = 0;
                for (number, cube) in blocks.cubes.iter().enumerate() {
                    let Block { extent, items, .. } = blocks.block(&measures, number);
                    assert_eq!(with_area(&items.triangles), with_area(&expected.remove(cube).unwrap()));
                    let is_inside = |point: [f32; 3]| extent.is_in_reach(point, 1e-6);
                    let mut corners = items.triangles.iter().flat_map(|&triangle| mesh.corners(triangle));
                    assert!(corners.all(is_inside) && items.pieces.is_empty());
                    for cluster in &items.clusters {
                        let triangles = &items.triangles[cluster.indices.start as usize..cluster.indices.end as usize];
                        let area: f64 = triangles.iter().map(|&triangle| mesh.triangle_area(triangle)).sum();
                        assert!((cluster.area / area - 1.0).abs() < 1e-12);
                        let corners = triangles.iter().flat_map(|&triangle| mesh.corners(triangle)).map(exact);
                        let mut distances = corners.map(|corner| corner.distance(exact(cluster.ball.centre)));
                        assert!(distances.all(|distance| distance <= cluster.ball.radius.into()));
                        in_clusters += triangles.len();
                    }
                }
                assert!(expected.values().all(|triangles| with_area(triangles).is_empty()));
                let count = measures.triangles().len();
                assert!(
                    if is_ordered { 2 * in_clusters > count } else { in_clusters == 0 },
                    "{in_clusters} of {count}"
                );
            }
        }
    }

    /// Forty triangles in two clusters, one of them short, and single ones before, between and after them; some have no
    /// area.
    fn items() -> (Mesh, Items) {
        let size = |i: u32| [1.0, 0.0, 7.0, 1e-3][i as usize % 4];
        let corners = |i: u32| [[0.0, 0.0, i as f32], [size(i), 0.0, i as f32], [0.0, size(i), i as f32]];
        let mesh =
            Mesh::new((0..40).flat_map(corners).collect(), (0..40).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
        let (mesh, triangles): (_, Vec<u32>) = (mesh.unwrap(), (0..40).rev().collect());
        let area = |range: &Range<u32>| range.clone().map(|i| mesh.triangle_area(triangles[i as usize])).sum();
        let ball = |radius: f32| Ball { centre: [0.0; 3], radius };
        let clusters =
            [3..19, 25..32].map(|indices| Cluster { area: area(&indices), ball: ball(indices.end as f32), indices });
        let pieces = vec![Fragment::whole(5), Fragment::whole(2)];
        (mesh, Items { triangles, clusters: clusters.into(), pieces })
    }

    #[test]
    fn a_dart_falls_where_it_would_in_a_row_of_single_areas() {
        let (mesh, items) = items();
        let areas = items.triangles.iter().map(|&triangle| mesh.triangle_area(triangle));
        let single = Weights::new(areas.chain(items.pieces.iter().map(|piece| piece.area(&mesh))).collect());
        let (mut row, mut rng) = (items.row(&mesh), Rng::at(1, Draw::Probe, &[]));
        assert!((row.total() / single.total() - 1.0).abs() < 1e-15);
        for _ in 0..10_000 {
            let mut same = rng.clone();
            let number = single.pick(&mut same) as usize;
            let expected = items.triangles.get(number).copied().unwrap_or_else(|| items.pieces[number - 40].triangle);
            assert_eq!(row.point(&mut rng).triangle, expected);
        }
    }

    #[test]
    fn the_triangles_of_covered_clusters_are_left_out() {
        let (_, items) = items();
        let left = |covered: &[f32]| items.indices_but(|ball| covered.contains(&ball.radius)).collect::<Vec<_>>();
        assert_eq!(left(&[]), (0..40).collect::<Vec<_>>());
        assert_eq!(left(&[19.0]), (0..3).chain(19..40).collect::<Vec<_>>());
        assert_eq!(left(&[32.0]), (0..25).chain(32..40).collect::<Vec<_>>());
        assert_eq!(left(&[19.0, 32.0]), (0..3).chain(19..25).chain(32..40).collect::<Vec<_>>());
    }
}
