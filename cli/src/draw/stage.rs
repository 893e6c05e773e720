//! The stage in front of the camera: the mesh with its samples, brought to unit size around the origin.

use azulejo::mesh::Mesh;
use azulejo::trace::{Hit, Ray, Scene};
use azulejo::{Context, Error, MAXIMAL_DENSITY, Result};
use glam::Vec3;

use super::camera::Camera;
use super::discs::{Disc, Discs};
use super::palette::{COBALT, Colour};

/// The radius of a painted disc in parts of the radius of a maximal set of as many samples: discs stay apart.
const DISC: f64 = 0.36;

/// Samples of one kind, and the discs that they are painted as.
#[derive(Clone, Copy)]
pub struct Paint<'a> {
    /// The samples.
    pub samples: &'a [[f32; 3]],
    /// The radius of their discs, in the units of the mesh.
    pub radius: f64,
    /// Their colour.
    pub colour: Colour,
}

/// A mesh, its samples, and rays into both.
pub struct Stage {
    scene: Scene,
    triangles: Vec<[u32; 3]>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    pub(super) discs: Discs,
    /// The radius of a maximal set of as many samples.
    pub(super) radius: f32,
    pub(super) camera: Camera,
    /// The numbers of samples and of triangles, seen or not.
    pub(super) counts: [usize; 2],
}

/// A place on the mesh that was seen.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    pub point: Vec3,
    /// The interpolated normal, on the side that was seen.
    pub normal: Vec3,
}

impl Stage {
    /// With `cutaway` the faces that are turned away from the camera are left out, which shows the inside of a building
    /// whose walls face inwards.
    pub fn new(context: &Context, mesh: &Mesh, samples: &[[f32; 3]], cutaway: bool) -> Result<Self> {
        let radius = (MAXIMAL_DENSITY * mesh.area() / samples.len() as f64).sqrt();
        Self::painted(context, mesh, &[Paint { samples, radius: DISC * radius, colour: COBALT }], cutaway)
    }

    /// As [`new`](Self::new), with samples of several kinds.
    pub fn painted(context: &Context, mesh: &Mesh, paints: &[Paint], cutaway: bool) -> Result<Self> {
        let (low, high) = mesh.bounds();
        let [low, high] = [low, high].map(|corner| glam::DVec3::from(corner.map(f64::from)));
        let (centre, size) = (0.5 * (low + high), (high - low).max_element());
        if !(size > 0.0 && mesh.area() > 0.0) {
            return Err(Error::InvalidArgument { argument: "MESH", reason: "has no area to draw".to_owned() });
        }
        let place = |point: &[f32; 3]| ((glam::DVec3::from(point.map(f64::from)) - centre) / size).as_vec3();
        let positions: Vec<_> = mesh.positions().iter().map(place).collect();
        let plain: Vec<_> = positions.iter().map(Vec3::to_array).collect();
        let camera = Camera::in_front();
        let mut triangles = mesh.triangles().to_vec();
        if cutaway {
            triangles.retain(|triangle| faces(camera.eye, triangle.map(|vertex| positions[vertex as usize])));
        }
        if triangles.is_empty() {
            let reason = "has no face that is turned to the camera".to_owned();
            return Err(Error::InvalidArgument { argument: "MESH", reason });
        }
        let scene = Scene::new(&plain, &triangles, context.num_threads())?;
        let count = paints.iter().map(|paint| paint.samples.len()).sum();
        let radius = (MAXIMAL_DENSITY * mesh.area() / count as f64).sqrt() / size;
        let discs = paints.iter().flat_map(|&Paint { samples, radius, colour }| {
            samples.iter().map(move |sample| Disc { centre: place(sample), radius: (radius / size) as f32, colour })
        });
        let discs = Discs::new(discs.collect());
        let normals = vertex_normals(&positions, &triangles);
        let counts = [count, mesh.triangles().len()];
        Ok(Self { scene, triangles, positions, normals, discs, radius: radius as f32, camera, counts })
    }

    pub(super) fn positions(&self) -> impl Iterator<Item = Vec3> {
        self.triangles.iter().flatten().map(|&vertex| self.positions[vertex as usize])
    }

    /// The height on which the object stands.
    pub(super) fn floor(&self) -> f32 {
        self.positions().map(|point| point.y).fold(f32::INFINITY, f32::min)
    }

    /// The first place on each ray.
    pub(super) fn look(&self, rays: &[Ray]) -> Vec<Option<Seen>> {
        let hits = self.scene.closest_hits(rays);
        rays.iter().zip(hits).map(|(ray, hit)| hit.map(|hit| self.seen(ray, &hit))).collect()
    }

    /// Tells for each ray whether it meets the mesh.
    pub(super) fn meet(&self, rays: &[Ray]) -> Vec<bool> {
        self.scene.closest_hits(rays).iter().map(Option::is_some).collect()
    }

    fn seen(&self, ray: &Ray, hit: &Hit) -> Seen {
        let corners = self.triangles[hit.triangle as usize].map(|vertex| vertex as usize);
        let [a, b, c] = corners.map(|vertex| self.positions[vertex]);
        let [u, v] = hit.uv;
        let mix = |[a, b, c]: [Vec3; 3]| (1.0 - u - v) * a + u * b + v * c;
        let flat = (b - a).cross(c - a);
        let direction = Vec3::from(ray.direction);
        let flat = flat.normalize_or(-direction) * -flat.dot(direction).signum();
        let smooth = mix(corners.map(|vertex| self.normals[vertex]));
        // The mean of the normals is meaningless where windings are mixed, and the triangle's own is taken.
        let normal = (smooth * smooth.dot(flat).signum()).normalize_or(flat);
        let normal = if normal.dot(flat) > 0.3 { normal } else { flat };
        Seen { point: mix([a, b, c]), normal }
    }
}

/// True if a triangle is seen from its front.
fn faces(eye: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
    (b - a).cross(c - a).dot(eye - a) > 0.0
}

/// Normals of the triangles, weighted by area and summed at the vertices.
fn vertex_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&vertex| normals[vertex as usize] += normal);
    }
    normals.iter().map(|normal| normal.normalize_or_zero()).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A square of side 2 upright before the camera, its two triangles wound in opposite directions, with one sample.
    pub fn square(sample: [f32; 3]) -> Stage {
        let positions = vec![[9.0, 4.0, 7.0], [11.0, 4.0, 7.0], [11.0, 6.0, 7.0], [9.0, 6.0, 7.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 3, 2]]).unwrap();
        Stage::new(&Context::new(1).unwrap(), &mesh, &[sample], false).unwrap()
    }

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn a_mesh_is_brought_to_unit_size_and_seen_from_its_front() {
        let stage = square([10.0, 5.0, 7.0]);
        assert_eq!(stage.floor(), -0.5);
        assert!((stage.radius as f64 - (MAXIMAL_DENSITY * 4.0).sqrt() / 2.0).abs() < 1e-6);
        assert_eq!([Vec3::ZERO, Vec3::new(0.5, 0.5, 0.0)].map(|point| stage.discs.paint(point)), [Some(COBALT), None]);
        let ray = |x, y| Ray {
            origin: stage.camera.eye.to_array(),
            direction: (Vec3::new(x, y, 0.0) - stage.camera.eye).to_array(),
        };
        let rays = [ray(0.4, -0.3), ray(-0.4, 0.3), ray(0.6, 0.0)];
        let seen = stage.look(&rays);
        for (seen, place) in seen.iter().zip([Vec3::new(0.4, -0.3, 0.0), Vec3::new(-0.4, 0.3, 0.0)]) {
            let seen = seen.unwrap();
            assert!(seen.point.distance(place) < 1e-5 && seen.normal.distance(Vec3::Z) < 1e-5);
        }
        assert!(seen[2].is_none());
        assert_eq!(stage.meet(&rays), [true, true, false]);
    }

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn a_cutaway_leaves_out_what_is_turned_away() {
        let positions = vec![[9.0, 4.0, 7.0], [11.0, 4.0, 7.0], [11.0, 6.0, 7.0], [9.0, 6.0, 7.0]];
        let context = Context::new(1).unwrap();
        let cut = |triangles: &[[u32; 3]]| {
            let mesh = Mesh::new(positions.clone(), triangles.to_vec()).unwrap();
            Stage::new(&context, &mesh, &[[10.0, 5.0, 7.0]], true)
        };
        let (front, back) = ([0, 1, 2], [0, 3, 2]);
        assert_eq!(cut(&[back, front, back]).unwrap().triangles, [front]);
        assert!(cut(&[back]).err().unwrap().to_string().contains("turned to the camera"));
    }

    #[test]
    #[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
    fn normals_are_smooth_across_the_edges_of_a_mesh() {
        let positions = vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, -0.5], [-1.0, 0.0, -0.5]];
        let mesh = Mesh::new(positions, vec![[0, 2, 1], [0, 1, 3]]).unwrap();
        let stage = Stage::new(&Context::new(1).unwrap(), &mesh, &[[0.0; 3]], false).unwrap();
        // Just beside the common edge, half way up, the mean of the two triangles' normals looks forward.
        let target = stage.positions[0].lerp(stage.positions[1], 0.5) + Vec3::new(1e-4, 0.0, -5e-5);
        let ray = Ray { origin: stage.camera.eye.to_array(), direction: (target - stage.camera.eye).to_array() };
        let seen = stage.look(&[ray])[0].unwrap();
        assert!(seen.normal.distance(Vec3::Z) < 0.01, "{}", seen.normal);
    }
}
