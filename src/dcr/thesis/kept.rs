//! The links between Delaunay neighbours along a mesh that is kept from step to step and repaired by flips.

use glam::DVec2;

use crate::dcr::thesis::forces::Particle;
use crate::dcr::thesis::links::{Link, Links};
use crate::dcr::torus::{Torus, TorusPoint};
use crate::dcr::uniform::FlipMesh;
use crate::error::Result;
use crate::geometry::Frame;
use crate::job::Job;
use crate::points::{Boundary, Domain};

/// The mesh of the points, on the torus that the domain is or is mirrored on.
pub struct KeptMesh {
    frame: Frame,
    torus: Torus,
    /// A spacing of the points' frame in those of the torus.
    scale: f64,
    /// The points on the torus and, where the domain is mirrored, after them their images.
    places: Vec<TorusPoint>,
    mesh: Option<FlipMesh>,
}

impl KeptMesh {
    /// Without a mesh, for `count` points.
    pub fn new(domain: Domain, frame: Frame, count: usize) -> Self {
        let torus = Torus::new(domain, count);
        let scale = frame.spacing() / torus.frame.spacing();
        Self { frame, torus, scale, places: Vec::new(), mesh: None }
    }

    /// Makes the mesh the Delaunay triangulation of these particles: by flips unless a triangle has turned over. There is
    /// none of a few points, and where there are large holes.
    pub fn follow(&mut self, job: &Job, particles: &[Particle]) -> Result<()> {
        let place = |particle: &Particle| self.torus.place(particle.position * self.scale);
        self.places = self.torus.with_images(&particles.iter().map(place).collect::<Vec<_>>());
        if let Some(mut mesh) = self.mesh.take()
            && mesh.repair(&job.part(0.0, 0.5), &self.places)?
        {
            self.mesh = Some(mesh);
            return Ok(());
        }
        self.mesh = FlipMesh::new(&job.part(0.5, 1.0), &self.torus, &self.places)?.filter(FlipMesh::holds_back);
        Ok(())
    }

    /// Frees what is kept.
    pub fn forget(&mut self) {
        self.mesh = None;
        self.places = Vec::new();
    }

    /// The links of the particles that the mesh follows; none where there is no mesh.
    pub fn links<'a>(&'a self, particles: &'a [Particle]) -> Option<MeshLinks<'a>> {
        self.mesh.as_ref().map(|mesh| MeshLinks { mesh, frame: &self.frame, particles })
    }
}

/// The links of a kept mesh, see [`DelaunayLinks`](super::links::DelaunayLinks).
pub struct MeshLinks<'a> {
    mesh: &'a FlipMesh,
    frame: &'a Frame,
    particles: &'a [Particle],
}

impl Links for MeshLinks<'_> {
    #[inline(always)]
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        let (count, size) = (self.particles.len(), self.frame.size());
        let here = self.particles[point].position;
        for &name in self.mesh.ring(point) {
            let name = name as usize;
            let other = if name < count { name } else { name % count };
            let offset = match self.frame.boundary() {
                Boundary::Periodic => self.frame.offset(here, self.particles[other].position),
                Boundary::Bounded if name < count => self.particles[other].position - here,
                // The image of the point itself across the nearer side: along x, or along y.
                Boundary::Bounded if other == point && name < 3 * count => {
                    let axis = name / count - 1;
                    let x = here[axis];
                    let across = if 2.0 * x < size[axis] { -2.0 * x } else { 2.0 * (size[axis] - x) };
                    if axis == 0 { DVec2::new(across, 0.0) } else { DVec2::new(0.0, across) }
                }
                Boundary::Bounded => continue,
            };
            visit(Link { other: other as u32, offset, outgoing: true, incoming: true });
        }
    }
}
