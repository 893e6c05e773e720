//! The gaps of a set in the plane, counted by its Voronoi diagram.
//!
//! A point that moves away from its nearest point, ever farther from all of them, reaches an edge of the Voronoi
//! diagram, and along it one of its vertices. So each connected part of the uncovered places contains a vertex, a
//! circumcentre of a Delaunay triangle, and two vertices are in one part when edges without a covered place lead from
//! one to the other. An edge is nearest to its two points half-way between them, where it crosses the segment that
//! connects them, or else at an end.
//!
//! In a bounded domain the mirror images of the points are never nearer than the points, so that the diagram of all of
//! them, which the boundary divides, is the one inside.

use glam::DVec2;

use crate::error::Result;
use crate::geometry::{Delaunay, Dual, Frame};
use crate::index::{Entry, Grid2};
use crate::job::{Job, chunks, chunks_of};
use crate::memory;
use crate::points::Domain;

/// Circumcentres closer than this, in mean spacings, are one: copies of one on the other side of a torus, and those of
/// more than three points on one circle.
const SAME: f64 = 1e-6;

/// The vertices of a task.
const VERTICES: usize = 256;

/// The most bytes per point, none of which is covered as far as the next one.
const BYTES_PER_POINT: f64 = 740.0;

/// The number of connected parts of the domain farther than `radius` from all points, of which there is at least one.
pub(super) fn count(job: &Job, domain: &Domain, points: &[[f32; 2]], radius: f64) -> Result<usize> {
    memory::require_points("radius", points.len(), BYTES_PER_POINT)?;
    let frame = Frame::new(*domain, points.len());
    let radius = radius / frame.spacing();
    let delaunay = Delaunay::new(&job.part(0.0, 0.7), &frame, frame.enter(points).into_iter())?;
    let chunks = chunks(points.len());
    let edges = job.part(0.7, 0.8).flat_map(chunks.len(), |chunk| {
        let duals = chunks.range(chunk).flat_map(|point| delaunay.duals(point));
        duals.filter_map(|dual| Edge::uncovered(&frame, &dual, radius)).collect()
    })?;
    let vertices: Vec<_> = edges.iter().flat_map(|edge| edge.vertices).flatten().collect();
    let mut gaps = DisjointSets::new(vertices.len());
    let mut first = 0;
    for Edge { vertices, is_open } in &edges {
        if *is_open {
            gaps.link(first, first + 1);
        }
        first += vertices.iter().flatten().count() as u32;
    }
    link_same(&job.part(0.8, 1.0), &frame, &vertices, &mut gaps)?;
    Ok(gaps.count())
}

/// Links vertices that coincide.
fn link_same(job: &Job, frame: &Frame, vertices: &[[f64; 2]], gaps: &mut DisjointSets) -> Result<()> {
    let torus = Domain { min: [0.0; 2], max: frame.size().to_array(), boundary: frame.boundary() };
    job.report(0.0)?;
    let grid = Grid2::new(torus, vertices.iter().copied(), 1.0);
    let chunks = chunks_of(vertices.len(), VERTICES);
    let same = |chunk: usize| {
        let mut pairs = Vec::new();
        for &Entry { id: vertex, point: place } in &grid.entries()[chunks.range(chunk)] {
            grid.for_each_within(place, SAME, |other, _, _| pairs.extend((other < vertex).then_some([vertex, other])));
        }
        pairs
    };
    let link = |pairs: Vec<[u32; 2]>| {
        pairs.into_iter().for_each(|[a, b]| gaps.link(a, b));
        Ok(())
    };
    job.stream(chunks.len(), same, link)
}

/// An edge of the Voronoi diagram with an end that is not covered.
struct Edge {
    /// The ends that are not covered.
    vertices: [Option<[f64; 2]>; 2],
    /// True if no place of it is covered.
    is_open: bool,
}

impl Edge {
    fn uncovered(frame: &Frame, dual: &Dual, radius: f64) -> Option<Self> {
        let vertices = dual.circles.map(|(centre, reach)| (reach > radius).then(|| frame.fold(centre).to_array()));
        let both = vertices.iter().all(Option::is_some);
        let is_open = both && (dual.half_length() > radius || !dual.crosses_its_edge());
        vertices.iter().any(Option::is_some).then_some(Self { vertices, is_open })
    }
}

impl Dual {
    /// Half of the length of the Delaunay edge.
    fn half_length(&self) -> f64 {
        0.5 * self.ends[0].distance(self.ends[1])
    }

    /// True if the Voronoi edge crosses the Delaunay edge: its ends are on different sides.
    fn crosses_its_edge(&self) -> bool {
        let side = |(centre, _): (DVec2, f64)| (self.ends[1] - self.ends[0]).perp_dot(centre - self.ends[0]);
        side(self.circles[0]) * side(self.circles[1]) <= 0.0
    }
}

/// Linked members, and the number of groups that they form: a forest with a tree for each group (Tarjan 1975,
/// "Efficiency of a good but not linear set union algorithm").
pub(super) struct DisjointSets {
    parents: Vec<u32>,
    count: usize,
}

impl DisjointSets {
    /// Groups of one member each.
    pub fn new(members: usize) -> Self {
        Self { parents: (0..members as u32).collect(), count: members }
    }

    /// The number of groups.
    pub fn count(&self) -> usize {
        self.count
    }

    /// True if two members are in one group.
    pub fn are_linked(&mut self, a: u32, b: u32) -> bool {
        self.root(a) == self.root(b)
    }

    /// Merges the groups of two members.
    pub fn link(&mut self, a: u32, b: u32) {
        let [a, b] = [self.root(a), self.root(b)];
        if a != b {
            self.parents[a.max(b) as usize] = a.min(b);
            self.count -= 1;
        }
    }

    fn root(&mut self, mut member: u32) -> u32 {
        while self.parents[member as usize] != member {
            let grandparent = self.parents[self.parents[member as usize] as usize];
            self.parents[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }
}
