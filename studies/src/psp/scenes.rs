//! What is sampled: meshes from files, and some that are made.

use std::path::Path;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{MAXIMAL_DENSITY, Result};

use azulejo_cli::procedural::{hall, shapes};

/// A mesh with a name.
pub struct Scene {
    pub name: &'static str,
    pub mesh: Arc<Mesh>,
    /// Million rays per second of Embree and of OptiX in table 3.1 of the thesis; of its Sponza for the hall.
    pub thesis: [f64; 2],
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
            Some(path) => found.push(Scene { name, mesh: Arc::new(Mesh::load(path)?), thesis, is_room: false }),
            None => missing.push(Missing { name, option }),
        }
    }
    let (positions, triangles) = hall(detail);
    let mesh = Arc::new(Mesh::new(positions, triangles)?);
    found.push(Scene { name: "hall", mesh, thesis: [31.0, 379.0], is_room: true });
    Ok((found, missing))
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
    fn what_is_not_given_is_missing_and_what_is_not_there_refused() {
        let (found, missing) = scenes(None, None, 8).unwrap();
        assert_eq!(found.iter().map(|scene| scene.name).collect::<Vec<_>>(), ["hall"]);
        assert_eq!(missing.iter().map(|missing| missing.option).collect::<Vec<_>>(), ["--bunny", "--dragon"]);
        assert!(scenes(Some(Path::new("nowhere.obj")), None, 8).is_err());
    }
}
