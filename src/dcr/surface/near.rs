//! Who is near whom: the samples that are reached on the surface without leaving a ball.
//!
//! A flood goes from a sample's triangle through all edges that the ball meets. So what is near through space but not on
//! the surface, as on the other side of a thin wall, is not found, and what is behind a sharp fold is.
//!
//! Where the flood meets a border it mirrors what it has found by it, as the thesis does on bounded domains (Fig. 4.12 (b)).

use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hasher};

use glam::DVec3;

use super::sheet::Sheet;
use super::star::MOST;
use crate::error::Result;
use crate::job::{Chunks, Job};
use crate::mesh::exact;

/// Two places on the borders at which a sample is mirrored are farther apart than this share of the ball's radius.
const APART: f64 = 0.2;

/// A sample, or its mirror image by a half-edge at the border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Neighbour {
    pub(super) sample: u32,
    pub(super) mirror: Option<u32>,
}

/// The neighbours of samples that follow each other.
#[derive(Default)]
pub(super) struct Neighbourhoods {
    /// Where those of each sample end.
    ends: Vec<u32>,
    neighbours: Vec<Neighbour>,
    /// The mean normal around each sample.
    normals: Vec<DVec3>,
}

impl Neighbourhoods {
    /// Those of the `nth` of the samples.
    pub(super) fn of(&self, nth: usize) -> &[Neighbour] {
        let start = if nth == 0 { 0 } else { self.ends[nth - 1] };
        &self.neighbours[start as usize..self.ends[nth] as usize]
    }

    /// The mean normal around the `nth` sample, on the side of its triangle's front; zero where there is none.
    pub(super) fn normal(&self, nth: usize) -> DVec3 {
        self.normals[nth]
    }
}

/// Samples by their triangle.
pub(super) struct Crowd<'a> {
    sheet: &'a Sheet<'a>,
    positions: &'a [DVec3],
    triangles: &'a [u32],
    /// The samples on triangle `t` are `samples[starts[t]..starts[t + 1]]`.
    starts: Vec<u32>,
    samples: Vec<u32>,
}

impl<'a> Crowd<'a> {
    pub(super) fn new(sheet: &'a Sheet<'a>, positions: &'a [DVec3], triangles: &'a [u32]) -> Self {
        let mut starts = vec![0u32; sheet.mesh.triangles().len() + 1];
        triangles.iter().for_each(|&triangle| starts[triangle as usize + 1] += 1);
        for triangle in 1..starts.len() {
            starts[triangle] += starts[triangle - 1];
        }
        let (mut places, mut samples) = (starts.clone(), vec![0; triangles.len()]);
        for (sample, &triangle) in triangles.iter().enumerate() {
            samples[places[triangle as usize] as usize] = sample as u32;
            places[triangle as usize] += 1;
        }
        Self { sheet, positions, triangles, starts, samples }
    }

    /// The neighbours of all samples within `radius`; of more than [`MOST`] the nearest.
    pub(super) fn neighbourhoods(&self, job: &Job, chunks: Chunks, radius: f64) -> Result<Vec<Neighbourhoods>> {
        job.map(chunks.len(), |chunk| {
            let (mut flood, mut found) = (Flood::default(), Neighbourhoods::default());
            for sample in chunks.range(chunk) {
                self.find(sample as u32, radius, &mut flood);
                found.neighbours.extend(flood.found.iter().map(|&(_, neighbour)| neighbour));
                found.normals.push(flood.normal.normalize_or_zero());
                found.ends.push(found.neighbours.len() as u32);
            }
            found
        })
    }

    /// Finds the neighbours of a sample, the nearest first.
    fn find(&self, centre: u32, radius: f64, flood: &mut Flood) {
        let place = self.positions[centre as usize];
        flood.spread(self.sheet, self.triangles[centre as usize], place, radius * radius);
        for &Reached { triangle, side } in &flood.reached {
            let of_triangle = self.starts[triangle as usize] as usize..self.starts[triangle as usize + 1] as usize;
            if of_triangle.is_empty() {
                continue;
            }
            let normal = side * exact(self.sheet.mesh.normal(triangle));
            for &sample in &self.samples[of_triangle] {
                let squared = self.positions[sample as usize].distance_squared(place);
                if squared <= radius * radius {
                    flood.found.push((squared, Neighbour { sample, mirror: None }));
                    flood.normal += (1.0 - squared / (radius * radius)) * normal;
                }
            }
        }
        for i in 0..flood.found.len() {
            flood.mirror(self.sheet, i, self.positions, place, radius);
        }
        flood.found.retain(|(_, neighbour)| *neighbour != Neighbour { sample: centre, mirror: None });
        flood.found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        flood.found.truncate(MOST);
    }
}

/// What the flood from one sample has reached.
#[derive(Default)]
struct Flood {
    seen: HashSet<u32, BuildHasherDefault<Mixer>>,
    reached: Vec<Reached>,
    borders: Vec<u32>,
    /// Neighbours with the squares of their distances.
    found: Vec<(f64, Neighbour)>,
    /// The sum of their normals, the near ones with more weight.
    normal: DVec3,
}

/// A triangle, and whether its front is on the same side as that of the first, 1, or on the other, -1.
struct Reached {
    triangle: u32,
    side: f64,
}

impl Flood {
    fn spread(&mut self, sheet: &Sheet, triangle: u32, place: DVec3, radius_squared: f64) {
        (self.seen.clear(), self.reached.clear(), self.borders.clear(), self.found.clear());
        self.normal = DVec3::ZERO;
        self.seen.insert(triangle);
        self.reached.push(Reached { triangle, side: 1.0 });
        let mut next = 0;
        while let Some(&Reached { triangle, side }) = self.reached.get(next) {
            next += 1;
            for edge in 3 * triangle..3 * triangle + 3 {
                let [a, b] = sheet.ends(edge);
                if nearest_on(a, b, place).distance_squared(place) > radius_squared {
                    continue;
                }
                let mut is_border = true;
                for other in sheet.across(edge) {
                    is_border = false;
                    if self.seen.insert(other / 3) {
                        let side = if sheet.run_alike(edge, other) { -side } else { side };
                        self.reached.push(Reached { triangle: other / 3, side });
                    }
                }
                if is_border {
                    self.borders.push(edge);
                }
            }
        }
    }
}

impl Flood {
    /// Adds the mirror images of the sample that was found as `nth` to what is found: by the place on the borders that is
    /// nearest to it, and by all others that are beside it. Along a border with many corners one image stands for several.
    fn mirror(&mut self, sheet: &Sheet, nth: usize, positions: &[DVec3], centre: DVec3, radius: f64) {
        let sample = self.found[nth].1.sample;
        let place = positions[sample as usize];
        let mirrors = self.borders.iter().map(|&border| {
            let [a, b] = sheet.ends(border);
            let mirror = nearest_on(a, b, place);
            (mirror.distance_squared(place), border, mirror, mirror != a && mirror != b)
        });
        let mut mirrors: Vec<_> = mirrors.collect();
        mirrors.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<DVec3> = Vec::new();
        for (_, border, mirror, is_beside) in mirrors {
            let is_apart = taken.iter().all(|other| other.distance(mirror) > APART * radius);
            if taken.is_empty() || (is_beside && is_apart) {
                taken.push(mirror);
                let squared = (2.0 * mirror - place).distance_squared(centre);
                if squared <= radius * radius {
                    self.found.push((squared, Neighbour { sample, mirror: Some(border) }));
                }
            }
        }
    }
}

/// The point of a segment that is nearest to a place.
fn nearest_on(a: DVec3, b: DVec3, place: DVec3) -> DVec3 {
    let (along, way) = (b - a, place - a);
    match way.dot(along) / along.length_squared() {
        share if share <= 0.0 => a,
        share if share >= 1.0 => b,
        share => a + share * along,
    }
}

/// The image of a place by an edge.
pub(super) fn mirrored(place: DVec3, [a, b]: [DVec3; 2]) -> DVec3 {
    2.0 * nearest_on(a, b, place) - place
}

/// Hashes the numbers of triangles: one multiplication (Knuth, TAOCP 3, §6.4).
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
