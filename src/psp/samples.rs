//! The samples accepted so far, and candidates that want to join them.

use crate::error::Result;
use crate::grid3::{Grid3, distance_squared};
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::points::SurfaceSamples;
use crate::psp::merge;

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub position: [f32; 3],
    pub triangle: u32,
    pub barycentrics: [f32; 2],
}

impl Sample {
    /// The sample at rounded barycentrics: whatever is tested later is tested on the position that is returned.
    pub fn new(mesh: &Mesh, triangle: u32, barycentrics: [f32; 2]) -> Self {
        Self { position: mesh.point(triangle, barycentrics), triangle, barycentrics }
    }
}

/// A conflict-free set of samples that only grows.
pub(super) struct SampleSet {
    radius: f64,
    origin: [f64; 3],
    grid: Grid3,
    triangles: Vec<u32>,
    barycentrics: Vec<[f32; 2]>,
}

impl SampleSet {
    /// An empty set. Two samples conflict when they are closer than `radius`.
    ///
    /// Distances are compared as squares in `f64`. The radius used is larger by 1e-14, dozens of units in the last place:
    /// the samples keep `radius` in whatever order a caller evaluates their distances.
    pub fn new(mesh: &Mesh, radius: f64) -> Self {
        let radius = radius * (1.0 + 1e-14);
        let origin = mesh.bounds().0.map(f64::from);
        Self { radius, origin, grid: Grid3::new(origin, radius), triangles: Vec::new(), barycentrics: Vec::new() }
    }

    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether two points are too close to both be samples; equally, whether a sample covers a point.
    pub fn conflict(&self, a: [f32; 3], b: [f32; 3]) -> bool {
        distance_squared(a, b) < self.radius * self.radius
    }

    /// Whether the set has no room for a candidate.
    pub fn rejects(&self, candidate: &Sample) -> bool {
        self.grid.any_closer(candidate.position, self.radius, None)
    }

    /// The radius in use, a little above the one asked for.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The positions within a distance of a point, in any order.
    pub fn near(&self, centre: glam::DVec3, distance: f64) -> impl Iterator<Item = glam::DVec3> {
        let positions =
            self.grid.candidates(centre.to_array(), distance).map(|id| exact(self.grid.points()[id as usize]));
        positions.filter(move |position| position.distance_squared(centre) <= distance * distance)
    }

    /// Adds those of the candidates that the greedy choice in their order takes, and returns how many that are.
    ///
    /// The candidates must not be rejected by the set. Where the job is cancelled nothing is added.
    pub fn merge(&mut self, job: &Job, candidates: &[Sample]) -> Result<usize> {
        let positions: Vec<_> = candidates.iter().map(|candidate| candidate.position).collect();
        let accepted = merge::greedy(job, &positions, self.radius, self.origin)?;
        for &index in &accepted {
            let Sample { position, triangle, barycentrics } = candidates[index as usize];
            self.grid.insert(position);
            self.triangles.push(triangle);
            self.barycentrics.push(barycentrics);
        }
        Ok(accepted.len())
    }

    /// The samples in the order in which they were accepted.
    pub fn to_surface_samples(&self, mesh: &Mesh) -> SurfaceSamples {
        SurfaceSamples {
            positions: self.grid.points().to_vec(),
            normals: self.triangles.iter().map(|&triangle| mesh.normal(triangle)).collect(),
            triangles: self.triangles.clone(),
            barycentrics: self.barycentrics.clone(),
        }
    }

    /// The invariants: one entry per sample everywhere, each sample at its barycentrics, no two in conflict.
    #[cfg(test)]
    fn sanity_check(&self, mesh: &Mesh) {
        let positions = self.grid.points();
        assert_eq!((positions.len(), self.barycentrics.len()), (self.len(), self.len()));
        for (i, &position) in positions.iter().enumerate() {
            assert_eq!(position, mesh.point(self.triangles[i], self.barycentrics[i]));
            assert!(!self.grid.any_closer(position, self.radius, Some(i as u32)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    #[test]
    fn a_set_that_grows_stays_sane_and_takes_whom_it_has_room_for() {
        let corners = vec![[3.0, 0.0, 0.1], [4.0, 0.0, 0.0], [4.0, 1.0, 0.0], [3.0, 1.0, 0.3]];
        let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let context = Context::new(2).unwrap();
        let mut samples = SampleSet::new(&mesh, 0.05);
        for round in 0..4 {
            let mut rng = Rng::at(1, Draw::Probe, &[round]);
            let mut candidate = |_| {
                let (u, v) = (rng.unit() as f32, rng.unit() as f32);
                Sample::new(&mesh, rng.below(2) as u32, if u + v < 1.0 { [u, v] } else { [0.5 * u, 0.5 * v] })
            };
            let candidates: Vec<_> = (0..500).map(&mut candidate).collect();
            let welcome: Vec<_> = candidates.iter().copied().filter(|sample| !samples.rejects(sample)).collect();
            let before = samples.len();
            let accepted = context.run(None, |job| samples.merge(job, &welcome)).unwrap();
            assert_eq!(samples.len(), before + accepted);
            assert!(candidates.iter().all(|candidate| samples.rejects(candidate)), "room is left for a candidate");
            samples.sanity_check(&mesh);
        }
    }
}
