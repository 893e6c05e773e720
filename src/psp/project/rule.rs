//! The rule of when a maximal set begins with an iteration of local projectors: where that, and the fill of what it
//! leaves, take less time than a fill from nothing.
//!
//! Two things make an iteration slow or futile. Every chart reads all of its triangles, so that the time grows with the
//! number of triangles per sample, while a fill from nothing passes over most of them in groups. And where the surface
//! bends within a few radii charts are small, and most of what they find conflicts at their boundaries. Both are known
//! before any work is done, the same on every machine: a set must not depend on how fast that is.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Result;
use crate::mesh::Mesh;
use crate::psp::fill::{DENSITY, Measures, ONE_PIECE};

/// The number of triangles per expected sample at which both ways take the same time on a flat surface; and the bending
/// of the surface, in radii, at which they do with few triangles. Measured (`benches/projectors.rs`).
const MOST_TRIANGLES: f64 = 11.0;
const MOST_BENDING: f64 = 0.12;
/// The share of the area that given samples may cover with which both ways do, on a flat surface of few triangles: the
/// iteration passes over what is covered, too.
const MOST_COVERED: f64 = 0.4;

/// The most clusters of triangles by which a mesh is judged.
const PROBES: usize = 1 << 10;

/// The bending of a surface: about the angle, in radians per unit of length, by which its normals turn.
struct Bending(f64);

impl Bending {
    /// From clusters of triangles all over the mesh: their normals, turned to one side, add up to less than their areas
    /// if they differ. Triangles that follow each other without being near each other seem to bend.
    fn of(mesh: &Mesh, measures: &Measures) -> Self {
        let triangles = measures.triangles();
        let step = triangles.clusters().div_ceil(PROBES).max(1);
        let (mut total, mut bending) = (0.0, 0.0);
        for cluster in (0..triangles.clusters()).step_by(step) {
            let (mut area, mut sum) = (0.0, DVec3::ZERO);
            for index in triangles.cluster(cluster) {
                let [a, b, c] = mesh.exact_corners(triangles.at(index));
                let normal = 0.5 * (b - a).cross(c - a);
                area += normal.length();
                sum += if normal.dot(sum) < 0.0 { -normal } else { normal };
            }
            // In a cone of this half angle, nearly, which a length of the root of the area takes.
            let angle = (2.0 * (1.0 - sum.length() / area).max(0.0)).sqrt();
            if area > 0.0 && angle.is_finite() {
                total += area;
                bending += angle * area.sqrt();
            }
        }
        Self(if total > 0.0 { bending / total } else { 0.0 })
    }
}

/// True if a maximal set of a radius is made sooner with an iteration of local projectors before the fill. Given samples
/// cover no more than an area.
///
/// Sets that are filled in one piece are not projected, which keeps them unbiased.
pub fn is_sooner_projected(mesh: &Mesh, measures: &Measures, radius: f64, covered: f64) -> Result<bool> {
    // Those along edges, of which the upper estimate of the fill may have many more, do not count.
    let samples = DENSITY * mesh.area() / (radius * radius);
    let triangles = measures.triangles().len() as f64 / samples;
    let cost = triangles / MOST_TRIANGLES + covered / mesh.area() / MOST_COVERED;
    if measures.expected_samples(mesh, radius) <= ONE_PIECE || cost > 1.0 {
        return Ok(false);
    }
    let bending: Arc<Bending> = mesh.kept(|| Ok(()), || Ok(Bending::of(mesh, measures)))?;
    Ok(cost + bending.0 * radius / MOST_BENDING <= 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::project::tests::meshes;

    fn mesh((positions, triangles): meshes::Soup) -> Mesh {
        Mesh::new(positions, triangles).unwrap()
    }

    fn bending(mesh: &Mesh) -> f64 {
        Bending::of(mesh, &Measures::of(mesh)).0
    }

    #[test]
    fn a_plane_does_not_bend_and_a_sphere_by_its_curvature_however_fine_it_is() {
        assert_eq!(bending(&mesh(meshes::plane())), 0.0);
        let torus = [(200, 80), (600, 240)].map(|(around, along)| bending(&mesh(meshes::fine_torus(around, along))));
        assert!((torus[0] / torus[1] - 1.0).abs() < 0.1 && torus[0] > 0.1, "{torus:?}");
        let soup = meshes::fine_torus(200, 80);
        let tenth = bending(&mesh((soup.0.iter().map(|place| place.map(|x| 0.1 * x)).collect(), soup.1.clone())));
        assert!((tenth / torus[0] - 10.0).abs() < 0.01, "{tenth}");
        // However the triangles are wound.
        let turned = soup.1.iter().enumerate().map(|(i, &[a, b, c])| if i % 3 == 0 { [a, c, b] } else { [a, b, c] });
        assert!((bending(&mesh((soup.0, turned.collect()))) / torus[0] - 1.0).abs() < 1e-9);
    }

    #[test]
    fn many_samples_on_few_triangles_that_bend_little_are_projected() {
        let is_sooner = |mesh: &Mesh, samples: f64| {
            let measures = Measures::of(mesh);
            let radius = (0.7 * mesh.area() / samples).sqrt();
            let by_rule = |share: f64| is_sooner_projected(mesh, &measures, radius, share * mesh.area()).unwrap();
            assert!(!by_rule(0.5) && (by_rule(0.0) || !by_rule(0.1)), "the less, the more is covered");
            by_rule(0.0)
        };
        let (plane, torus) = (mesh(meshes::plane()), mesh(meshes::fine_torus(600, 240)));
        assert!(!is_sooner(&plane, 1e4) && is_sooner(&plane, 3e4));
        // 288,000 triangles.
        assert!(!is_sooner(&torus, 2.55e4) && is_sooner(&torus, 5e4));
        let soup = mesh(meshes::random_soup(3, 60_000));
        assert!(!is_sooner(&soup, 3e4) && is_sooner(&soup, 1e7));
        let nothing = torus.clone().with_mask(vec![false; 288_000]).unwrap();
        assert!(!is_sooner_projected(&nothing, &Measures::of(&nothing), 0.1, 0.0).unwrap());
    }
}
