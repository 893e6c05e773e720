//! Charts: the part of a surface in a cube, divided by the directions that it faces.
//!
//! A chart is a cone of normals: an axis, and facets that turn at most 60 degrees away from it, so that a projection
//! along the axis stretches what lies between the points of a pattern by no more than two. The cones are found by
//! clustering normals: from the direction with the largest area to the mean of all that are near it. What is left over
//! joins a chart that faces it well enough. (The thesis takes three orthogonal directions for the whole mesh, §3.3.1; it
//! cuts the plane by a kd-tree in §3.4.)
//!
//! A normal and its opposite are the same: both sides of a thin wall lie on one chart, and so do the triangles of a soup
//! however they are wound.

use glam::DVec3;

use crate::index::Binned;
use crate::mesh::Mesh;
use crate::psp::fill::Block;
use crate::psp::fragment::Fragment;

/// The least cosine between the axis of a chart and the normals of its facets.
const LEAST_COSINE: f64 = 0.5;
/// The least cosine between the axis of a cluster and the mean normals of its bins: 25 degrees.
const CONE: f64 = 0.906;
/// The times that an axis moves to the mean of its cone.
const MOVES: usize = 4;
/// The area in squared radii below which a cluster rather joins a chart: its boundary would be most of it.
const SMALLEST: f64 = 30.0;
/// Bins of normals along an axis of the faces of a cube, of which three represent all directions and their opposites.
const ROW: usize = 5;
const BINS: usize = 3 * ROW * ROW;

/// A triangle or a piece of one, as its block sees it: from its centre, in radii.
#[derive(Clone, Copy)]
pub struct Facet {
    pub triangle: u32,
    /// The number of the piece in the block; none if the triangle is whole.
    pub piece: Option<u32>,
    /// The corners of the whole triangle.
    pub corners: [DVec3; 3],
    pub normal: DVec3,
}

/// The facets of a block, by chart.
pub struct Charts {
    /// The unit axes of the charts, the one with the largest area first.
    pub axes: Vec<DVec3>,
    facets: Vec<Facet>,
    by_chart: Binned<u32>,
    /// The longest edge of all facets' triangles, in radii.
    pub longest: f64,
}

impl Charts {
    /// Divides a block, seen from a centre in units of the mesh. Facets without area are left out.
    pub fn new(mesh: &Mesh, block: &Block, centre: DVec3, per_radius: f64) -> Self {
        let (mut facets, mut longest) = (Vec::with_capacity(block.items.triangles.len()), 0.0f64);
        let (mut areas, mut bins) = (Vec::with_capacity(facets.capacity()), [Bin::default(); BINS]);
        let mut add = |triangle: u32, piece: Option<(u32, &Fragment)>| {
            let corners = mesh.exact_corners(triangle).map(|corner| (corner - centre) * per_radius);
            let [a, b, c] = corners;
            let (ab, ac) = (b - a, c - a);
            let cross = ab.cross(ac);
            let length = cross.length();
            if length > 0.0 && length.is_finite() {
                longest = longest.max(ab.length_squared()).max(ac.length_squared());
                let (normal, share) = (cross / length, piece.map_or(1.0, |(_, piece)| piece.share()));
                facets.push(Facet { triangle, piece: piece.map(|(number, _)| number), corners, normal });
                areas.push(0.5 * share * length);
            }
        };
        block.items.triangles.iter().for_each(|&triangle| add(triangle, None));
        (0..).zip(&block.items.pieces).for_each(|(number, piece)| add(piece.triangle, Some((number, piece))));

        let of_facets: Vec<u8> = facets.iter().map(|facet| bin_of(facet.normal)).collect();
        for ((facet, &area), &bin) in facets.iter().zip(&areas).zip(&of_facets) {
            bins[usize::from(bin)].add(area * facet.normal);
        }
        let mut clusters = Clusters::new(&bins);
        let mut assigned = Vec::with_capacity(facets.len());
        for ((facet, &area), &bin) in facets.iter().zip(&areas).zip(&of_facets) {
            assigned.push(clusters.take(usize::from(bin), facet.normal, area));
        }
        // The largest first.
        let Clusters { axes, areas, .. } = clusters;
        let mut order: Vec<usize> = (0..axes.len()).collect();
        order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, &number)| places[number] = place);
        let by_chart = Binned::new(order.len(), assigned.iter().zip(0..).map(|(&chart, facet)| (places[chart], facet)));
        let axes = order.iter().map(|&number| axes[number]).collect();
        Self { axes, facets, by_chart, longest: longest.sqrt() }
    }

    /// The facets of a chart, in the order of the mesh, pieces last.
    pub fn facets(&self, chart: usize) -> impl Iterator<Item = &Facet> {
        self.by_chart.bin(chart).iter().map(|&facet| &self.facets[facet as usize])
    }
}

/// The bin of a normal: the axis along which it is longest, and its direction beside that.
fn bin_of(normal: DVec3) -> u8 {
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let n = normal.to_array();
    let place = |other: usize| {
        let share = 0.5 + 0.5 * n[(axis + other) % 3] / n[axis];
        ((share * ROW as f64) as usize).min(ROW - 1)
    };
    ((axis * ROW + place(1)) * ROW + place(2)) as u8
}

/// The sum of the area vectors in a bin, each turned to the side of the sum.
#[derive(Clone, Copy, Default)]
struct Bin(DVec3);

impl Bin {
    fn add(&mut self, vector: DVec3) {
        self.0 += towards(vector, self.0);
    }
}

/// The vector, or its opposite if that is nearer to a direction.
fn towards(vector: DVec3, direction: DVec3) -> DVec3 {
    if vector.dot(direction) < 0.0 { -vector } else { vector }
}

/// Charts that grow.
struct Clusters {
    axes: Vec<DVec3>,
    areas: Vec<f64>,
    /// The chart of each bin that has an area.
    of_bins: [Option<usize>; BINS],
}

impl Clusters {
    fn new(bins: &[Bin; BINS]) -> Self {
        let mut clusters = Self { axes: Vec::new(), areas: Vec::new(), of_bins: [None; BINS] };
        let sizes = bins.map(|bin| bin.0.length());
        let normals: [DVec3; BINS] = std::array::from_fn(|bin| bins[bin].0 / sizes[bin].max(f64::MIN_POSITIVE));
        let mut left: Vec<usize> = (0..BINS).filter(|&bin| sizes[bin] > 0.0).collect();
        while let Some(&seed) = left.iter().max_by(|&&a, &&b| sizes[a].total_cmp(&sizes[b]).then(b.cmp(&a))) {
            let mut axis = normals[seed];
            let is_near = |axis: DVec3, bin: usize| normals[bin].dot(axis).abs() >= CONE;
            for _ in 0..MOVES {
                let near = left.iter().filter(|&&bin| is_near(axis, bin));
                axis = near.map(|&bin| towards(bins[bin].0, axis)).sum::<DVec3>().normalize_or(axis);
            }
            let area: f64 = left.iter().filter(|&&bin| bin == seed || is_near(axis, bin)).map(|&bin| sizes[bin]).sum();
            let joined = if area < SMALLEST { clusters.facing(axis) } else { None };
            let chart = joined.unwrap_or_else(|| clusters.add(axis));
            left.retain(|&bin| {
                let is_taken = bin == seed || is_near(axis, bin);
                if is_taken {
                    clusters.of_bins[bin] = Some(chart);
                }
                !is_taken
            });
        }
        clusters
    }

    /// A new chart.
    fn add(&mut self, axis: DVec3) -> usize {
        self.axes.push(axis);
        self.areas.push(0.0);
        self.axes.len() - 1
    }

    /// The chart that faces a direction most squarely, if any does well enough.
    fn facing(&self, direction: DVec3) -> Option<usize> {
        let cosines = self.axes.iter().map(|axis| axis.dot(direction).abs()).enumerate();
        let best = cosines.fold((0, 0.0), |best, (chart, cosine)| if cosine > best.1 { (chart, cosine) } else { best });
        (best.1 >= LEAST_COSINE).then_some(best.0)
    }

    /// The chart of a facet: that of its bin, or another one if it faces that too little. A facet that is seen edge on
    /// would be left with hardly a sample.
    fn take(&mut self, bin: usize, normal: DVec3, area: f64) -> usize {
        let of_bin = self.of_bins[bin].filter(|&chart| self.axes[chart].dot(normal).abs() >= LEAST_COSINE);
        let chart = of_bin.or_else(|| self.facing(normal)).unwrap_or_else(|| self.add(normal));
        self.areas[chart] += area;
        chart
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::fill::Extent;
    use crate::psp::fill::blocks::Items;
    use crate::psp::set::Cube;
    use crate::rng::{Draw, Rng};

    /// A block of random triangles, with pieces and triangles without area.
    fn block(rng: &mut Rng, triangles: u32) -> (Mesh, Block) {
        let mut place = || [(); 3].map(|()| (10.0 * rng.unit()) as f32);
        let mut positions: Vec<[f32; 3]> = (0..3 * triangles).map(|_| place()).collect();
        positions[1] = positions[0];
        let corners = (0..triangles).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh::new(positions, corners).unwrap();
        let whole: Vec<_> = (triangles / 2..triangles).map(Fragment::whole).collect();
        let pieces = whole.iter().flat_map(|whole| whole.parts(2)).collect();
        let items = Items { triangles: (0..triangles / 2).collect(), clusters: Vec::new(), pieces };
        (mesh, Block { cube: Cube([0; 3]), extent: Extent::EMPTY, items })
    }

    #[test]
    fn every_facet_is_on_one_chart_that_it_faces() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for round in 0..200 {
            let (mesh, block) = block(&mut rng, 2 + 5 * round % 60);
            let charts = Charts::new(&mesh, &block, DVec3::splat(5.0), 3.0);
            let mut seen: Vec<_> = Vec::new();
            let mut areas = Vec::new();
            for (chart, axis) in charts.axes.iter().enumerate() {
                assert!((axis.length() - 1.0).abs() < 1e-12);
                let mut area = 0.0;
                for facet in charts.facets(chart) {
                    let [a, b, c] = facet.corners;
                    let cross = (b - a).cross(c - a);
                    assert!(cross.normalize().dot(*axis).abs() >= LEAST_COSINE - 1e-12);
                    let whole = mesh.triangle_area(facet.triangle) * 9.0;
                    assert!((cross.length() / 2.0 - whole).abs() < 1e-4 * whole + 1e-6);
                    area += whole * if facet.piece.is_some() { 0.25 } else { 1.0 };
                    seen.push((facet.triangle, facet.piece));
                }
                areas.push(area);
            }
            assert!(areas.is_sorted_by(|a, b| *a >= b * (1.0 - 1e-6)), "{areas:?}");
            seen.sort_unstable();
            let whole = block.items.triangles.iter().map(|&triangle| (triangle, None));
            let pieces = (0..).zip(&block.items.pieces).map(|(number, piece)| (piece.triangle, Some(number)));
            let mut expected: Vec<_> = whole.chain(pieces).filter(|&(t, _)| mesh.triangle_area(t) > 0.0).collect();
            expected.sort_unstable();
            assert_eq!(seen, expected);
        }
    }

    #[test]
    fn a_plane_has_one_chart_however_its_triangles_are_wound() {
        let positions = vec![[0.0, 0.0, 1.0], [9.0, 0.0, 1.0], [9.0, 9.0, 2.0], [0.0, 9.0, 2.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 3, 2]]).unwrap();
        let items = Items { triangles: vec![0, 1], ..Items::default() };
        let block = Block { cube: Cube([0; 3]), extent: Extent::EMPTY, items };
        let charts = Charts::new(&mesh, &block, DVec3::ZERO, 1.0);
        assert_eq!(charts.axes.len(), 1);
        assert!((charts.longest - 163f64.sqrt()).abs() < 1e-9);
    }
}
