//! What is sampled: meshes from files, and some that are made.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;
use std::path::Path;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{MAXIMAL_DENSITY, Result};

use azulejo_cli::procedural::hall;
use azulejo_cli::procedural::shapes::{self, Soup};
use glam::Vec3;
use rustc_hash::FxHasher;

/// A mesh with a name.
pub struct Scene {
    pub name: String,
    pub mesh: Arc<Mesh>,
    /// Million rays per second of Embree and of OptiX in table 3.1 of the thesis, if it has the scene; of its Sponza for the
    /// hall.
    pub thesis: Option<[f64; 2]>,
    /// Whether a picture looks into it, through the faces that are turned away.
    pub is_room: bool,
}

/// A scene that could not be had, and why.
pub struct Missing {
    pub name: &'static str,
    pub option: &'static str,
}

/// The scenes that are there, and the others; the hall with this `detail`.
pub fn scenes(bunny: Option<&Path>, dragon: Option<&Path>, detail: u32) -> Result<(Vec<Scene>, Vec<Missing>)> {
    let (mut found, mut missing) = (Vec::new(), Vec::new());
    let files = [("bunny", "--bunny", bunny, [45.0, 470.0]), ("dragon", "--dragon", dragon, [27.0, 290.0])];
    for (name, option, path, thesis) in files {
        match path {
            Some(path) => found.push(loaded(name.to_owned(), path, Some(thesis))?),
            None => missing.push(Missing { name, option }),
        }
    }
    let (positions, triangles) = hall(detail);
    let mesh = Arc::new(Mesh::new(positions, triangles)?);
    found.push(Scene { name: "hall".to_owned(), mesh, thesis: Some([31.0, 379.0]), is_room: true });
    Ok((found, missing))
}

/// The mesh of a file.
fn loaded(name: String, path: &Path, thesis: Option<[f64; 2]>) -> Result<Scene> {
    Ok(Scene { name, mesh: Arc::new(Mesh::load(path)?), thesis, is_room: false })
}

/// The mesh of a file, with the file's name.
pub fn further(path: &Path) -> Result<Scene> {
    loaded(path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), path, None)
}

/// A scene whose triangles are in 16 parts: as many triangles as the thesis's largest has, from a mesh that can be had.
pub fn in_parts(scene: &Scene) -> Result<Scene> {
    let soup = (scene.mesh.positions().to_vec(), scene.mesh.triangles().to_vec());
    let (positions, triangles) = quartered(quartered(soup));
    let mesh = Arc::new(Mesh::new(positions, triangles)?);
    Ok(Scene { name: format!("{}-in-16-parts", scene.name), mesh, thesis: None, is_room: scene.is_room })
}

/// Each triangle in four, by the midpoints of its edges.
fn quartered((mut positions, triangles): Soup) -> Soup {
    let mut midpoints: HashMap<[u32; 2], u32, BuildHasherDefault<FxHasher>> = HashMap::default();
    let mut midpoint = |a: u32, b: u32| {
        *midpoints.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let [from, to] = [a, b].map(|vertex| Vec3::from(positions[vertex as usize]));
            positions.push((0.5 * (from + to)).to_array());
            positions.len() as u32 - 1
        })
    };
    let parts = |[a, b, c]: [u32; 3]| {
        let [ab, bc, ca] = [midpoint(a, b), midpoint(b, c), midpoint(c, a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let triangles = triangles.into_iter().flat_map(parts).collect();
    (positions, triangles)
}

/// The radius at which a maximal set has about `count` samples.
pub fn radius(mesh: &Mesh, count: f64) -> f64 {
    (MAXIMAL_DENSITY * mesh.area() / count).sqrt()
}

/// A sphere of radius 1, smooth to about a degree.
pub fn sphere() -> Result<Arc<Mesh>> {
    let (positions, triangles) = shapes::sphere(320);
    Ok(Arc::new(Mesh::new(positions, triangles)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_is_one() {
        let mesh = sphere().unwrap();
        assert!((mesh.area() / (4.0 * std::f64::consts::PI) - 1.0).abs() < 2e-4, "{}", mesh.area());
        let outwards = |triangle: u32| {
            let (normal, corner) =
                (glam::Vec3::from(mesh.normal(triangle)), glam::Vec3::from(mesh.corners(triangle)[0]));
            // At the poles there are triangles that are not even rounding errors wide.
            mesh.triangle_area(triangle) < 1e-8 || normal.dot(corner) > 0.99
        };
        assert!((0..mesh.triangles().len() as u32).all(outwards));
    }

    #[test]
    fn parts_have_the_area_of_the_whole_and_share_their_corners() {
        let scene = scenes(None, None, 8).unwrap().0.remove(0);
        let parts = in_parts(&scene).unwrap();
        assert_eq!(parts.mesh.triangles().len(), 16 * scene.mesh.triangles().len());
        assert!((parts.mesh.area() / scene.mesh.area() - 1.0).abs() < 1e-5);
        assert!(parts.mesh.positions().len() < 16 * scene.mesh.positions().len());
    }

    #[test]
    fn what_is_not_given_is_missing_and_what_is_not_there_refused() {
        let (found, missing) = scenes(None, None, 8).unwrap();
        assert_eq!(found.iter().map(|scene| &*scene.name).collect::<Vec<_>>(), ["hall"]);
        assert_eq!(missing.iter().map(|missing| missing.option).collect::<Vec<_>>(), ["--bunny", "--dragon"]);
        assert!(scenes(Some(Path::new("nowhere.obj")), None, 8).is_err());
    }
}
