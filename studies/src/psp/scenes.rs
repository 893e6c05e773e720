//! The meshes that are sampled: from files, and procedural ones.

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
    /// Million rays per second of Embree and of OptiX in table 3.1 of the thesis, if it has the scene; of its Sponza
    /// for the hall.
    pub thesis: Option<[f64; 2]>,
    /// True if a picture looks into it, through the faces that are turned away.
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

/// Up to so many expected samples the library fills a set in one piece.
const ONE_PIECE: f64 = 25_000.0;

/// A mesh, its triangles in parts if need be, on which the library fills sets of a radius in one piece: it expects
/// samples on the area, and along what is longer than the radius.
pub fn in_one_piece(mesh: &Arc<Mesh>, radius: f64) -> Result<Arc<Mesh>> {
    let on_area = 0.7 * mesh.area() / (radius * radius);
    let mut mesh = mesh.clone();
    // On too large an area no parts are small enough.
    while on_area <= ONE_PIECE && on_area + along_edges(&mesh, radius) > ONE_PIECE {
        mesh = divided(&mesh, 4 * mesh.triangles().len())?;
    }
    Ok(mesh)
}

/// An upper estimate of the number of samples along edges longer than the radius, as the library expects it.
fn along_edges(mesh: &Mesh, radius: f64) -> f64 {
    let longest = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle).map(Vec3::from);
        f64::from(a.distance(b).max(b.distance(c)).max(c.distance(a)))
    };
    let long = (0..mesh.triangles().len() as u32).map(longest).filter(|&length| length > radius);
    long.map(|length| length / radius).sum()
}

/// A mesh in about so many triangles: all of its triangles in four parts, again and again, and at last as many as it
/// takes.
pub fn divided(mesh: &Mesh, count: usize) -> Result<Arc<Mesh>> {
    let (mut positions, mut triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    while triangles.len() < count {
        let whole = triangles.split_off(((count - triangles.len()) / 3).clamp(1, triangles.len()));
        (positions, triangles) = quartered((positions, triangles));
        triangles.extend(whole);
    }
    Ok(Arc::new(Mesh::new(positions, triangles)?))
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
    fn a_divided_mesh_has_the_triangles_asked_for_and_its_area() {
        let mesh = &scenes(None, None, 8).unwrap().0[0].mesh;
        let whole = mesh.triangles().len();
        for (asked, found) in [(1, whole), (whole, whole), (4 * whole, 4 * whole), (5 * whole, 5 * whole)] {
            let divided = divided(mesh, asked).unwrap();
            assert!(divided.triangles().len().abs_diff(found) <= 3, "{asked}: {}", divided.triangles().len());
            assert!((divided.area() / mesh.area() - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_mesh_is_divided_until_its_edges_are_short_enough_for_one_piece() {
        let sphere = sphere().unwrap();
        let [many, few] = [24_200.0, 2000.0].map(|count| radius(&sphere, count));
        assert!(Arc::ptr_eq(&in_one_piece(&sphere, few).unwrap(), &sphere));
        let divided = in_one_piece(&sphere, many).unwrap();
        assert!(along_edges(&sphere, many) > 1000.0 && along_edges(&divided, many) < 100.0);
        assert_eq!(divided.triangles().len(), 4 * sphere.triangles().len());
    }

    #[test]
    fn what_is_not_given_is_missing_and_what_is_not_there_refused() {
        let (found, missing) = scenes(None, None, 8).unwrap();
        assert_eq!(found.iter().map(|scene| &*scene.name).collect::<Vec<_>>(), ["hall"]);
        assert_eq!(missing.iter().map(|missing| missing.option).collect::<Vec<_>>(), ["--bunny", "--dragon"]);
        assert!(scenes(Some(Path::new("nowhere.obj")), None, 8).is_err());
    }
}
