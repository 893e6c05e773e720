//! The surroundings of samples: the samples within a ball that are reached on the surface without leaving it.
//!
//! A flood starts from a sample's triangle and crosses all edges that the ball meets. So samples that are near through
//! space but not on the surface, as on the other side of a thin wall, are not found, and those behind a sharp fold are.
//! Neither normals nor winding are trusted.
//!
//! Where the flood meets a boundary it mirrors the samples found, as the thesis does on bounded domains (Fig. 4.12 (b)).

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{BuildHasherDefault, Hasher};

use glam::DVec3;

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::star::MOST;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::geometry::grid3::Grid3;
use crate::job::{Chunks, Job};
use crate::mesh::exact;

/// Two positions on the boundary at which a sample is mirrored are farther apart than this fraction of the ball's
/// radius, or at least 60 degrees apart as seen from it: without its image by both sides of a corner, nothing keeps a
/// sample off one of them.
const APART: f64 = 0.2;

/// A sample, or its mirror image by a half-edge of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NearSample {
    pub(super) sample: u32,
    pub(super) mirror: Option<u32>,
}

/// The samples near one sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Surroundings {
    /// The nearest first, no more than [`MOST`].
    pub(super) neighbours: Box<[NearSample]>,
    /// The mean normal, on the front side of the sample's triangle; zero where there is none.
    pub(super) normal: DVec3,
    /// All samples within sight through space, on whatever parts of the surface, in ascending order.
    pub(super) in_sight: Box<[u32]>,
}

impl Surroundings {
    /// Whether a sample, or this image of it, is among the neighbours.
    pub(super) fn knows(&self, neighbour: NearSample) -> bool {
        self.neighbours.contains(&neighbour)
    }

    /// Whether another sample is in sight.
    pub(super) fn sees(&self, other: u32) -> bool {
        self.in_sight.binary_search(&other).is_ok()
    }
}

/// All samples, found by their position.
pub(super) struct SampleSearch<'a> {
    connected: &'a ConnectedMesh<'a>,
    places: &'a [SurfacePoint],
    positions: &'a [DVec3],
    radius: f64,
    sight: f64,
    grid: Grid3,
}

impl<'a> SampleSearch<'a> {
    /// A search for neighbours within `radius`, and samples in sight within `sight`.
    pub(super) fn new(
        connected: &'a ConnectedMesh<'a>,
        places: &'a [SurfacePoint],
        positions: &'a [DVec3],
        radius: f64,
        sight: f64,
    ) -> Self {
        let mut grid = Grid3::new(connected.mesh.bounds().0.map(f64::from), radius.max(sight));
        positions.iter().for_each(|position| {
            grid.insert(position.as_vec3().to_array());
        });
        Self { connected, places, positions, radius, sight, grid }
    }

    /// The surroundings of the samples that are asked for, with their numbers.
    pub(super) fn surroundings(
        &self,
        job: &Job,
        chunks: Chunks,
        is_asked: impl Fn(usize) -> bool + Sync,
    ) -> Result<Vec<(usize, Surroundings)>> {
        job.flat_map(chunks.len(), |chunk| {
            let mut flood = Flood::default();
            let asked = chunks.range(chunk).filter(|&sample| is_asked(sample));
            asked.map(|sample| (sample, self.surroundings_of(sample, &mut flood))).collect()
        })
    }

    fn surroundings_of(&self, centre: usize, flood: &mut Flood) -> Surroundings {
        let (position, limit) = (self.positions[centre], self.radius * self.radius);
        flood.spread(self.connected, self.places[centre].triangle, position, limit);
        let (mut found, mut in_sight) = (Vec::new(), Vec::new());
        for sample in self.grid.candidates(position.to_array(), self.radius.max(self.sight)) {
            let squared = self.positions[sample as usize].distance_squared(position);
            if squared <= self.sight * self.sight && sample as usize != centre {
                in_sight.push(sample);
            }
            if squared <= limit && flood.sides.contains_key(&self.places[sample as usize].triangle) {
                found.push((squared, NearSample { sample, mirror: None }));
            }
        }
        let order = |a: &(f64, NearSample), b: &(f64, NearSample)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        found.sort_unstable_by(order);
        // The grid may find a sample twice.
        found.dedup();
        in_sight.sort_unstable();
        in_sight.dedup();
        let weighted = found.iter().map(|&(squared, NearSample { sample, .. })| {
            let triangle = self.places[sample as usize].triangle;
            (1.0 - squared / limit) * flood.sides[&triangle] * exact(self.connected.mesh.normal(triangle))
        });
        let normal = weighted.sum::<DVec3>().normalize_or_zero();
        if !flood.boundary.is_empty() {
            for nth in 0..found.len() {
                self.mirror(&flood.boundary, found[nth].1.sample, position, &mut found);
            }
            found.sort_unstable_by(order);
        }
        let others = found.iter().map(|&(_, neighbour)| neighbour);
        let others = others.filter(|neighbour| neighbour.sample as usize != centre || neighbour.mirror.is_some());
        Surroundings { neighbours: others.take(MOST).collect(), normal, in_sight: in_sight.into() }
    }

    /// Adds the mirror images of a sample: by the position on the boundary that is nearest to it, and by all other
    /// edges that it is beside. Along a boundary with many corners one image replaces several.
    fn mirror(&self, boundary: &[u32], sample: u32, centre: DVec3, found: &mut Vec<(f64, NearSample)>) {
        let position = self.positions[sample as usize];
        let mirrors = boundary.iter().map(|&edge| {
            let [a, b] = self.connected.ends(edge);
            let mirror = nearest_on(a, b, position);
            (mirror.distance_squared(position), edge, mirror, mirror != a && mirror != b)
        });
        let mut mirrors: Vec<_> = mirrors.collect();
        mirrors.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<DVec3> = Vec::new();
        for (_, edge, mirror, is_beside) in mirrors {
            let is_apart = taken.iter().all(|&other| {
                let (one, other) = (mirror - position, other - position);
                one.distance(other) > APART * self.radius || 2.0 * one.dot(other) <= one.length() * other.length()
            });
            if taken.is_empty() || (is_beside && is_apart) {
                taken.push(mirror);
                let squared = (2.0 * mirror - position).distance_squared(centre);
                if squared <= self.radius * self.radius {
                    found.push((squared, NearSample { sample, mirror: Some(edge) }));
                }
            }
        }
    }
}

/// The triangles that the flood from one sample has reached.
#[derive(Default)]
struct Flood {
    /// For each triangle 1 if its front is on the same side as that of the first, -1 if it is on the other.
    sides: HashMap<u32, f64, BuildHasherDefault<Mixer>>,
    /// The half-edges through which the flood has entered triangles, and the sides of these.
    entries: Vec<(u32, f64)>,
    /// The half-edges of the boundary that the ball meets.
    boundary: Vec<u32>,
}

impl Flood {
    fn spread(&mut self, connected: &ConnectedMesh, start: u32, place: DVec3, radius_squared: f64) {
        self.sides.clear();
        self.entries.clear();
        self.boundary.clear();
        self.sides.insert(start, 1.0);
        (3 * start..3 * start + 3).for_each(|edge| self.leave(connected, (edge, 1.0), place, radius_squared));
        let mut next = 0;
        while let Some(&(entry, side)) = self.entries.get(next) {
            next += 1;
            let first = entry - entry % 3;
            let others = (first..first + 3).filter(|&edge| edge != entry);
            others.for_each(|edge| self.leave(connected, (edge, side), place, radius_squared));
        }
    }

    /// Crosses a half-edge of a triangle on this side, if the ball meets it.
    fn leave(&mut self, connected: &ConnectedMesh, (edge, side): (u32, f64), place: DVec3, radius_squared: f64) {
        let [mut is_open, mut is_met] = [true, false];
        for other in connected.across(edge) {
            is_open = false;
            // Most edges lead to triangles that were reached before.
            let Entry::Vacant(unreached) = self.sides.entry(other / 3) else { continue };
            is_met = is_met || meets(connected.ends(edge), place, radius_squared);
            if !is_met {
                return;
            }
            let side = if connected.run_alike(edge, other) { -side } else { side };
            unreached.insert(side);
            self.entries.push((other, side));
        }
        if is_open && meets(connected.ends(edge), place, radius_squared) {
            self.boundary.push(edge);
        }
    }
}

/// Whether a ball meets a segment.
fn meets([a, b]: [DVec3; 2], place: DVec3, radius_squared: f64) -> bool {
    // Most segments that are met have an end inside.
    a.distance_squared(place) <= radius_squared
        || b.distance_squared(place) <= radius_squared
        || nearest_on(a, b, place).distance_squared(place) <= radius_squared
}

/// The point of a segment that is nearest to a position.
fn nearest_on(a: DVec3, b: DVec3, place: DVec3) -> DVec3 {
    let (along, offset) = (b - a, place - a);
    match offset.dot(along) / along.length_squared() {
        share if share <= 0.0 => a,
        share if share >= 1.0 => b,
        share => a + share * along,
    }
}

/// The mirror image of a position by an edge.
pub(super) fn mirrored(place: DVec3, [a, b]: [DVec3; 2]) -> DVec3 {
    2.0 * nearest_on(a, b, place) - place
}

/// Hashes the numbers of triangles by one multiplication (Knuth, TAOCP 3, §6.4).
#[derive(Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u32(byte.into()));
    }
    fn write_u32(&mut self, number: u32) {
        self.0 = (self.0 ^ u64::from(number)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::{Context, chunks};
    use crate::mesh::Mesh;
    use crate::rng::{Draw, Rng};
    use glam::DVec2;

    const RADIUS: f64 = 0.15;

    /// Unit squares at these heights, each of two triangles.
    fn squares(heights: &[f32]) -> Mesh {
        let positions = heights.iter().flat_map(|&z| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]]);
        let triangles =
            (0..heights.len() as u32).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
        Mesh::new(positions.collect(), triangles.collect()).unwrap()
    }

    fn places(mesh: &Mesh, count: u64) -> Vec<SurfacePoint> {
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let mut place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            SurfacePoint { triangle: rng.below(mesh.triangles().len() as u64) as u32, uv }
        };
        (0..count).map(|_| place()).collect()
    }

    /// The neighbours of all samples: sample, and where it or its image is.
    fn found(mesh: &Mesh, places: &[SurfacePoint]) -> Vec<Vec<(u32, DVec3)>> {
        let connected = ConnectedMesh::new(mesh).unwrap();
        let positions: Vec<DVec3> =
            places.iter().map(|place| mesh.point_exact(place.triangle, place.uv.into())).collect();
        let search = SampleSearch::new(&connected, places, &positions, RADIUS, 0.0);
        let context = Context::new(1).unwrap();
        let found = context.run(None, |job| search.surroundings(job, chunks(places.len()), |_| true)).unwrap();
        let seen = |neighbour: &NearSample| {
            let position = positions[neighbour.sample as usize];
            (neighbour.sample, neighbour.mirror.map_or(position, |edge| mirrored(position, connected.ends(edge))))
        };
        found.iter().map(|(_, around)| around.neighbours.iter().map(seen).collect()).collect()
    }

    fn sorted(mut neighbours: Vec<(u32, DVec3)>) -> Vec<(u32, [i64; 3])> {
        // Up to rounding.
        let key = |x: DVec3| x.to_array().map(|x| (x * 1e9).round() as i64);
        neighbours.sort_by_key(|&(sample, position)| (sample, key(position)));
        neighbours.into_iter().map(|(sample, position)| (sample, key(position))).collect()
    }

    #[test]
    fn on_a_square_they_are_all_that_are_near_and_the_images_by_its_sides() {
        let mesh = squares(&[0.0]);
        let places = places(&mesh, 400);
        let positions: Vec<DVec3> =
            places.iter().map(|place| mesh.point_exact(place.triangle, place.uv.into())).collect();
        let mut mirrored = 0;
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            let mut expected = Vec::new();
            for (sample, &position) in positions.iter().enumerate() {
                let DVec3 { x, y, .. } = position;
                let mut images = vec![position];
                images.extend([DVec3::new(-x, y, 0.0), DVec3::new(x, -y, 0.0)]);
                images.extend([DVec3::new(2.0 - x, y, 0.0), DVec3::new(x, 2.0 - y, 0.0)]);
                let near = images.into_iter().filter(|image| image.distance(positions[centre]) <= RADIUS);
                expected.extend(
                    near.filter(|&image| sample != centre || image != position).map(|image| (sample as u32, image)),
                );
            }
            expected.sort_by(|a, b| a.1.distance(positions[centre]).total_cmp(&b.1.distance(positions[centre])));
            expected.truncate(MOST);
            mirrored += expected.iter().filter(|(_, position)| position.min_element() < 0.0).count();
            assert_eq!(sorted(neighbours), sorted(expected), "around {}", positions[centre]);
        }
        assert!(mirrored > 100);
    }

    #[test]
    fn the_other_side_of_a_thin_wall_is_not_near() {
        let mesh = squares(&[0.0, 0.001]);
        let places = places(&mesh, 500);
        for (centre, neighbours) in found(&mesh, &places).into_iter().enumerate() {
            assert!(neighbours.len() > 5);
            let side = |sample: usize| places[sample].triangle / 2;
            assert!(neighbours.iter().all(|&(sample, _)| side(sample as usize) == side(centre)));
        }
    }
}
