//! The links between nearest points along lists that are kept while points move little.
//!
//! The list of a point holds all others, and all mirror images, up to a skin beyond the reach of the forces. Until a
//! point has moved by half of the skin no other can have come into reach, as in Verlet's lists (1967). A point that the
//! boundary reflects moves no farther than one that passes it, and so do its images.

use glam::DVec2;

use crate::dcr::thesis::forces::Particle;
use crate::dcr::thesis::links::{Link, Links, SiteGrid, reach};
use crate::error::Result;
use crate::geometry::{Frame, Site};
use crate::job::{Chunks, Job, chunks};
use crate::math::square;
use crate::points::Boundary;

/// The distance beyond the reach of the forces up to which points are listed, in spacings.
const SKIN: f64 = 0.25;

/// The least width and height, in spacings, of a domain with lists: there the offset between two listed points of a
/// torus is unambiguous.
const LEAST_SIZE: f64 = 4.0;

/// The most listed points for each point of a chunk. In sets with dense clusters lists would take too much memory.
const MOST: usize = 24;

/// The bits of a name below those that tell the sides across which it is an image: 3 along each axis.
const POINT_BITS: u32 = 28;

/// The lists of all points.
pub struct KeptLists {
    frame: Frame,
    radius: f64,
    neighbours: usize,
    chunks: Chunks,
    /// The positions in which the points were listed; empty where there are no lists.
    origins: Vec<DVec2>,
    lists: Vec<Lists>,
    /// As of [`NearestLinks`](super::links::NearestLinks).
    reach: Vec<f64>,
}

/// The lists of consecutive points: the end of each, and the names in all.
#[derive(Default)]
struct Lists {
    ends: Vec<usize>,
    names: Vec<u32>,
}

/// The name of a site.
fn name(site: &Site) -> u32 {
    let [x, y] = site.side.map(|side| (side + 1) as u32);
    site.source | (x + 3 * y) << POINT_BITS
}

impl KeptLists {
    /// Without lists, for neighbourhoods of so many points closer than `radius`, which is at most 1.
    pub fn new(frame: Frame, radius: f64, neighbours: usize, count: usize) -> Self {
        let (origins, lists, reach) = Default::default();
        Self { frame, radius, neighbours, chunks: chunks(count), origins, lists, reach }
    }

    /// Makes the lists those of these particles: as they are unless one of these has moved too far. No lists are made in
    /// narrow domains, and around dense clusters.
    pub fn follow(&mut self, job: &Job, particles: &[Particle]) -> Result<()> {
        let positions = particles.iter().map(|particle| particle.position);
        let has_strayed = |(&from, to)| self.frame.offset(from, to).length_squared() > square(SKIN / 2.0);
        if self.origins.is_empty() || self.origins.iter().zip(positions.clone()).any(has_strayed) {
            self.origins.clear();
            if self.frame.size().min_element() < LEAST_SIZE || particles.len() >> POINT_BITS > 0 {
                return Ok(());
            }
            let Some(lists) = self.list(&job.part(0.0, 0.8), positions.clone())? else { return Ok(()) };
            self.lists = lists;
            self.origins.extend(positions);
        }
        let links = ListLinks { kept: self, particles };
        // Few points have so many others in reach, or even on their lists.
        self.reach = job.part(0.8, 1.0).flat_map(self.chunks.len(), |chunk| {
            let mut nearest = Vec::new();
            let within = |point| {
                if self.listed(point).len() < self.neighbours {
                    return f64::INFINITY;
                }
                nearest.clear();
                links.for_each_listed(point, |_, _, squared| {
                    if squared <= square(self.radius) {
                        nearest.push(squared);
                    }
                });
                reach(&mut nearest, self.neighbours)
            };
            self.chunks.range(chunk).map(within).collect()
        })?;
        Ok(())
    }

    fn list(&self, job: &Job, positions: impl ExactSizeIterator<Item = DVec2> + Clone) -> Result<Option<Vec<Lists>>> {
        let around = SiteGrid::new(&self.frame, positions, self.radius + SKIN);
        let lists = job.map(self.chunks.len(), |chunk| {
            let (points, mut lists) = (self.chunks.range(chunk), Lists::default());
            let most = MOST * points.len();
            for point in points {
                around.for_each(point, |site, _, _| lists.names.push(name(site)));
                lists.ends.push(lists.names.len());
                if lists.names.len() > most {
                    return None;
                }
            }
            Some(lists)
        })?;
        Ok(lists.into_iter().collect())
    }

    /// The names on the list of a point.
    #[inline(always)]
    fn listed(&self, point: usize) -> &[u32] {
        let (Lists { ends, names }, index) = (&self.lists[point / self.chunks.size()], point % self.chunks.size());
        &names[index.checked_sub(1).map_or(0, |before| ends[before])..ends[index]]
    }

    /// Frees what is kept.
    pub fn forget(&mut self) {
        (self.origins, self.lists, self.reach) = Default::default();
    }

    /// The links of the particles that the lists follow; none where there are no lists.
    pub fn links<'a>(&'a self, particles: &'a [Particle]) -> Option<ListLinks<'a>> {
        (!self.origins.is_empty()).then_some(ListLinks { kept: self, particles })
    }
}

/// The links of kept lists.
pub struct ListLinks<'a> {
    kept: &'a KeptLists,
    particles: &'a [Particle],
}

impl ListLinks<'_> {
    /// Visits the listed points and images of a point, with offsets and squared distances.
    #[inline(always)]
    fn for_each_listed(&self, point: usize, mut visit: impl FnMut(u32, DVec2, f64)) {
        let frame = &self.kept.frame;
        let (here, size) = (self.particles[point].position, frame.size());
        for &name in self.kept.listed(point) {
            let (other, across) = (name & ((1 << POINT_BITS) - 1), name >> POINT_BITS);
            let there = self.particles[other as usize].position;
            let offset = match frame.boundary() {
                Boundary::Periodic => frame.offset(here, there),
                Boundary::Bounded => {
                    let image = |x: f64, length: f64, side: u32| match side {
                        0 => -x,
                        1 => x,
                        _ => 2.0 * length - x,
                    };
                    DVec2::new(image(there.x, size.x, across % 3), image(there.y, size.y, across / 3)) - here
                }
            };
            visit(other, offset, offset.length_squared());
        }
    }
}

impl Links for ListLinks<'_> {
    /// Also visits links that are longer than the radius by up to the skin, which exert no force: branches would cost more
    /// than they save.
    #[inline(always)]
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        let reach = &self.kept.reach;
        self.for_each_listed(point, |other, offset, squared| {
            let (outgoing, incoming) = (squared <= reach[point], squared <= reach[other as usize]);
            visit(Link { other, offset, outgoing, incoming });
        });
    }
}
