//! Density by facing angle: whether samples are spread evenly however a surface is turned towards some directions.
//!
//! A pattern that is projected along a direction lands on a surface at an angle to it stretched by the angle's secant.
//! The part of it that PSP's merging and filling do not remove is a bias, which shows as a density that depends on the
//! angle between the normal and the nearest of the projectors' directions (thesis fig. 3.11 shows where it would).

use glam::DVec3;

use crate::check;
use crate::error::{Error, Result};
use crate::math::acos;
use crate::mesh::{Mesh, exact};

/// The part of a surface that faces some directions at about one angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facing {
    /// Its area.
    pub area: f64,
    /// The number of samples on it.
    pub samples: u64,
}

impl Facing {
    /// Samples per area; 0 where there is no area.
    pub fn density(&self) -> f64 {
        if self.area > 0.0 { self.samples as f64 / self.area } else { 0.0 }
    }
}

/// The area of a mesh and the samples on it by the angle between the normal and the nearest of `directions`, or its
/// opposite: `bins` equal parts of 0 to 90 degrees, from faces that are met squarely to faces that are only grazed.
///
/// `triangles` are those of the samples, as in [`Points`](crate::Points); `directions` have any length.
/// Takes O(triangles · directions + samples).
///
/// # Errors
/// [`Error::InvalidArgument`] for no bin, for no direction or one that is not finite or zero (`directions`), and for a
/// triangle that the mesh does not have (`triangles`).
pub fn density_by_facing(mesh: &Mesh, triangles: &[u32], directions: &[[f64; 3]], bins: usize) -> Result<Vec<Facing>> {
    if bins == 0 {
        return Err(Error::invalid("bins", "there is none"));
    }
    if directions.is_empty() {
        return Err(Error::invalid("directions", "there is none"));
    }
    if let Some(i) = directions.iter().position(|&direction| DVec3::from(direction).try_normalize().is_none()) {
        return Err(Error::invalid("directions", format!("[{i}] is {:?}, no direction", directions[i])));
    }
    check::triangles(triangles, mesh.triangles().len())?;
    let directions: Vec<_> = directions.iter().map(|&direction| DVec3::from(direction).normalize()).collect();
    let bin = |triangle: u32| {
        let normal = exact(mesh.normal(triangle));
        let cosine = directions.iter().map(|direction| normal.dot(*direction).abs()).fold(0.0, f64::max);
        let angle = acos(cosine.min(1.0)) / std::f64::consts::FRAC_PI_2;
        ((angle * bins as f64) as usize).min(bins - 1)
    };
    let of_triangles: Vec<_> = (0..mesh.triangles().len() as u32).map(bin).collect();
    let mut facings = vec![Facing::default(); bins];
    of_triangles.iter().zip(0..).for_each(|(&bin, triangle)| facings[bin].area += mesh.triangle_area(triangle));
    triangles.iter().for_each(|&triangle| facings[of_triangles[triangle as usize]].samples += 1);
    Ok(facings)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sides of a unit cube around the origin, x first, and one more square of area 4 at 45 degrees to x and y.
    fn cube() -> Mesh {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let mut square = |centre: DVec3, u: DVec3, v: DVec3| {
            let first = positions.len() as u32;
            let corners = [centre - u - v, centre + u - v, centre + u + v, centre - u + v];
            positions.extend(corners.map(|corner| corner.as_vec3().to_array()));
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        };
        let half = DVec3::AXES.map(|axis| 0.5 * axis);
        for side in [-1.0, 1.0] {
            (0..3).for_each(|axis| square(side * half[axis], half[(axis + 1) % 3], half[(axis + 2) % 3]));
        }
        square(DVec3::splat(9.0), DVec3::new(0.5, 0.5, 0.0) * 2f64.sqrt(), DVec3::Z);
        Mesh::new(positions, triangles).unwrap()
    }

    #[test]
    fn area_and_samples_go_to_the_angle_of_their_triangle() {
        let mesh = cube();
        let facings = density_by_facing(&mesh, &[0, 1, 6, 12, 12, 2], &[[-3.0, 0.0, 0.0]], 3).unwrap();
        let expected = [(2.0, 3), (4.0, 2), (4.0, 1)];
        for (facing, (area, samples)) in facings.iter().zip(expected) {
            assert!((facing.area - area).abs() < 1e-5 && facing.samples == samples, "{facings:?}");
        }
        assert!((facings[1].density() - 0.5).abs() < 1e-5);
        // With all three axes the cube is faced squarely, and nothing else is.
        let facings = density_by_facing(&mesh, &[], &DVec3::AXES.map(DVec3::into), 3).unwrap();
        assert!((facings[0].area - 6.0).abs() < 1e-5 && (facings[1].area - 4.0).abs() < 1e-5);
        assert_eq!((facings[2].area, facings[2].density()), (0.0, 0.0));
    }

    #[test]
    fn what_is_no_direction_or_triangle_is_refused() {
        let mesh = cube();
        let refused = |triangles: &[u32], directions: &[[f64; 3]], bins| match density_by_facing(
            &mesh, triangles, directions, bins,
        )
        .unwrap_err()
        {
            Error::InvalidArgument { argument, .. } => argument,
            other => panic!("{other}"),
        };
        let up = [0.0, 0.0, 1.0];
        assert_eq!(refused(&[], &[up], 0), "bins");
        assert_eq!(refused(&[], &[], 5), "directions");
        for bad in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
            assert_eq!(refused(&[], &[up, bad], 5), "directions");
        }
        assert_eq!(refused(&[13, 14], &[up], 5), "triangles");
    }
}
