//! What is sampled: meshes from files, and some that are made.

use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;

use azulejo::Result;
use azulejo::mesh::Mesh;

use crate::generate::MAXIMAL_DENSITY;

#[path = "../../../../tests/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

/// A mesh with a name.
pub struct Scene {
    pub name: &'static str,
    pub mesh: Arc<Mesh>,
    /// Million rays per second of Embree and of OptiX in table 3.1 of the thesis; of its Sponza for the hall.
    pub thesis: [f64; 2],
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
            Some(path) => found.push(Scene { name, mesh: Arc::new(Mesh::load(path)?), thesis }),
            None => missing.push(Missing { name, option }),
        }
    }
    let (positions, triangles) = meshes::hall(detail);
    found.push(Scene { name: "hall", mesh: Arc::new(Mesh::new(positions, triangles)?), thesis: [31.0, 379.0] });
    Ok((found, missing))
}

impl Scene {
    /// What a picture shows of the scene, and the samples on it, `positions` with their `triangles`: of the hall a
    /// section without its front and its ceiling, turned so that it stands on y.
    pub fn pictured(&self, positions: &[[f32; 3]], triangles: &[u32]) -> Result<(Mesh, Vec<[f32; 3]>)> {
        if self.name != "hall" {
            return Ok((
                Mesh::new(self.mesh.positions().to_vec(), self.mesh.triangles().to_vec())?,
                positions.to_vec(),
            ));
        }
        let turned = |&[x, y, z]: &[f32; 3]| [x, z, -y];
        let is_shown = |triangle: u32| {
            let corners = self.mesh.corners(triangle);
            corners.iter().all(|corner| corner[1] > 0.5) && corners.iter().any(|corner| corner[2] < 0.999)
        };
        let shown = (0..self.mesh.triangles().len() as u32).filter(|&triangle| is_shown(triangle));
        let shown = shown.map(|triangle| self.mesh.triangles()[triangle as usize]).collect();
        let samples = positions.iter().zip(triangles).filter(|&(_, &triangle)| is_shown(triangle));
        let mesh = Mesh::new(self.mesh.positions().iter().map(turned).collect(), shown)?;
        Ok((mesh, samples.map(|(position, _)| turned(position)).collect()))
    }
}

/// The radius at which a maximal set has about `count` samples.
pub fn radius(mesh: &Mesh, count: f64) -> f64 {
    (MAXIMAL_DENSITY * mesh.area() / count).sqrt()
}

/// A sphere of radius 1, smooth to half a degree.
pub fn sphere() -> Result<Arc<Mesh>> {
    const ROWS: u32 = 160;
    let place = |row: u32, column: u32| {
        let (height, width) = (PI * (f64::from(row) / f64::from(ROWS) - 0.5)).sin_cos();
        let (sin, cos) = (TAU * f64::from(column) / f64::from(2 * ROWS)).sin_cos();
        [width * cos, width * sin, height].map(|x| x as f32)
    };
    let vertex = |row: u32, column: u32| row * 2 * ROWS + column % (2 * ROWS);
    let positions = (0..=ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| place(row, column))).collect();
    let quads = (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| (row, column)));
    let triangles = quads.flat_map(|(row, column)| {
        let [a, b] = [vertex(row, column), vertex(row, column + 1)];
        let [c, d] = [vertex(row + 1, column + 1), vertex(row + 1, column)];
        [[a, b, c], [a, c, d]]
    });
    Ok(Arc::new(Mesh::new(positions, triangles.collect())?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sphere_is_one() {
        let mesh = sphere().unwrap();
        assert!((mesh.area() / (2.0 * TAU) - 1.0).abs() < 2e-4, "{}", mesh.area());
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
