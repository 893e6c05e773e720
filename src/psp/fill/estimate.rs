//! The number of samples that a maximal set will have, from the mesh alone, and the refusal of one that cannot be held.
//!
//! Area alone misses needles, which have length and hardly any area. The first estimate takes each triangle that is longer
//! than the radius for a needle apart from all others, as a blade of grass is: one look at the measures of the mesh. Only
//! where memory does not hold as many samples is the surface around each part looked at, which costs about as much as
//! sorting it into cells: connected triangles then count by their area, and needles beside each other as one.

use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::BuildHasherDefault;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::memory;
use crate::mesh::{Mesh, exact};
use crate::points::{MAXIMAL_DENSITY, check_radius, check_resolution};
use crate::psp::fill::measures::{Measures, longest_edge};
use crate::psp::given;
use crate::rng::{Draw, Rng};

/// The number of samples of a maximal set on an area of radius²: [`MAXIMAL_DENSITY`], rounded up.
pub const DENSITY: f64 = 0.7;
const _: () = assert!(MAXIMAL_DENSITY < DENSITY && DENSITY < 1.01 * MAXIMAL_DENSITY);

/// Peak memory per sample that is filled from nothing, the returned samples included.
pub const BYTES_PER_SAMPLE: f64 = 126.0;

/// The most samples that a part of the surface gets for its share of the area in the 27 cells of one radius around it.
/// Samples along a needle are at least a radius apart, and at most 3 sqrt(3) radii of it lie in these cells; a plane covers at
/// least 7.7 radius² there, so that its parts count by their area.
const MOST_AROUND: f64 = 4.0;
/// Probes on an area of radius², and along a radius of a longest edge.
const PROBES: [f64; 2] = [4.0, 2.0];
/// More probes than these cost more than a refusal is worth.
const MOST_PROBES: f64 = (1u32 << 26) as f64;

impl Measures {
    /// An upper estimate of the samples of a maximal set.
    pub fn expected_samples(&self, mesh: &Mesh, radius: f64) -> f64 {
        DENSITY * mesh.area() / (radius * radius) + self.longer_than(radius) / radius
    }

    /// The same. Refuses a radius that is out of range or requires too many, of so many bytes each, beside given ones.
    pub fn checked_samples(&self, mesh: &Mesh, radius: f64, bytes: f64, given: Given<3>) -> Result<f64> {
        check_radius(radius)?;
        let estimate = self.expected_samples(mesh, radius);
        let bytes = bytes + given::bytes(given) / estimate.max(1.0);
        self.require(mesh, radius, bytes)?;
        check_radius_on(mesh, radius)?;
        Ok(estimate)
    }

    /// Refuses a radius that requires more samples than can be indexed, or than memory holds, of so many bytes each.
    pub fn require(&self, mesh: &Mesh, radius: f64, bytes: f64) -> Result<()> {
        let asking = format!("{radius:?} asks for");
        let refused = |samples: f64| require_samples(samples, bytes, "radius", &asking);
        refused(self.expected_samples(mesh, radius)).or_else(|error| {
            // Those of the area are the fewest that can be found.
            refused(DENSITY * mesh.area() / (radius * radius))?;
            self.samples_around(mesh, radius).map_or(Err(error), refused)
        })
    }

    /// An upper estimate of the samples of a maximal set from the surface around each part of it; none where that takes
    /// too long, or more memory than there is.
    fn samples_around(&self, mesh: &Mesh, radius: f64) -> Option<f64> {
        let [by_area, by_length] = [PROBES[0] / (radius * radius), PROBES[1] / radius];
        let all = self.triangles();
        if all.len() as f64 + by_area * mesh.area() + by_length * self.longer_than(radius) > MOST_PROBES {
            return None;
        }
        let mut areas = HashMap::<[i32; 3], f64, BuildHasherDefault<DefaultHasher>>::default();
        for triangle in (0..all.len()).map(|index| all.at(index)) {
            let area = mesh.triangle_area(triangle);
            let longest = longest_edge(mesh, triangle);
            let length = if longest > radius { longest } else { 0.0 };
            let probes = 1 + (by_area * area + by_length * length) as u64;
            let mut rng = Rng::at(0, Draw::Probe, &[triangle.into()]);
            for _ in 0..probes {
                let place = exact(mesh.point(triangle, rng.in_triangle().map(|x| x as f32))) / radius;
                areas.try_reserve(1).ok()?;
                *areas.entry(place.floor().as_ivec3().to_array()).or_default() += area / probes as f64;
            }
        }
        let offsets = || (0..27).map(|i| [i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1]);
        let around = |cell: &[i32; 3]| -> f64 {
            let neighbours = offsets().map(|offset| [0, 1, 2].map(|axis| cell[axis].saturating_add(offset[axis])));
            neighbours.filter_map(|neighbour| areas.get(&neighbour)).sum()
        };
        let samples = |cell, area: f64| area * (DENSITY / (radius * radius)).max(MOST_AROUND / around(cell));
        Some(areas.iter().filter(|&(_, &area)| area > 0.0).map(|(cell, &area)| samples(cell, area)).sum())
    }
}

/// An upper estimate of the samples of a maximal set on a part of the surface: those of the area, and those along parts
/// longer than the radius, since a needle has length and hardly any area.
pub fn expected_samples_of(radius: f64, area: f64, longest: f64) -> f64 {
    DENSITY * area / (radius * radius) + if longest > radius { longest / radius } else { 0.0 }
}

/// Refuses a radius that is out of range on a mesh.
pub fn check_radius_on(mesh: &Mesh, radius: f64) -> Result<()> {
    check_radius(radius)?;
    check_resolution("radius", radius, mesh.float_spacing(), "the largest coordinate of the mesh")
}

/// Refuses an argument that is `asking` for more samples than can be indexed, or than memory holds.
pub fn require_samples(estimate: f64, bytes: f64, argument: &'static str, asking: &str) -> Result<()> {
    let samples = format!("about {estimate:.3e} samples");
    if estimate > f64::from(u32::MAX) {
        return Err(Error::too_large(argument, format!("{asking} {samples}; the limit is {}", u32::MAX)));
    }
    memory::require(estimate * bytes, argument, &samples)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::job::Context;
    use crate::psp;

    /// A strip of quads between two curves, as triangles, of which some are left out.
    fn strip(count: u32, curves: impl Fn(f32) -> [[f32; 3]; 2], is_kept: impl Fn(u32) -> bool) -> Mesh {
        let positions = (0..=count).flat_map(|i| curves(i as f32 / count as f32)).collect();
        let triangles = (0..count).filter(|&i| is_kept(i)).flat_map(|i| {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
            [[a, b, c], [c, b, d]]
        });
        Mesh::new(positions, triangles.collect()).unwrap()
    }

    /// The number of samples beside both estimates.
    fn estimates(mesh: Mesh, radius: f64) -> [f64; 3] {
        let measures = Measures::of(&mesh);
        let around = measures.samples_around(&mesh, radius).expect("few probes");
        let first = measures.expected_samples(&mesh, radius);
        let context = Context::new(1).unwrap();
        let (samples, _) = psp::FlatOptions::new(radius).sample(&context, &Arc::new(mesh), None).unwrap();
        [samples.len() as f64, around, first]
    }

    #[test]
    fn connected_triangles_count_by_their_area() {
        // Of long triangles side by side: flat in three directions, and around a cylinder.
        let flat = |normal: fn(f32, f32) -> [f32; 3]| strip(2000, |t| [normal(t, 0.0), normal(t, 1.0)], |_| true);
        let meshes = [
            flat(|x, y| [x, y, 0.0]),
            flat(|x, y| [x, x, y]),
            flat(|x, y| [x - y, y, -x]),
            strip(2000, |t| [0.0, 1.0].map(|z| [(6.3 * t).cos(), (6.3 * t).sin(), z]), |_| true),
        ];
        for (i, mesh) in meshes.into_iter().enumerate() {
            let [samples, around, first] = estimates(mesh, 0.02);
            // Boundaries have a few more, here 3 %.
            assert!((0.95..1.25).contains(&(around / samples)), "mesh {i}: {samples} {around}");
            assert!(first > 3.0 * samples, "mesh {i}: {first}");
        }
    }

    #[test]
    fn needles_count_by_their_length() {
        // Blades that are far apart in space, and a tube, which has no boundary between its needles.
        let blades = strip(4000, |t| [0.0, 1.0].map(|x| [x, 200.0 * t, 0.0]), |i| i % 40 == 0);
        let [samples, around, _] = estimates(blades, 0.1);
        assert!((1.0..2.5).contains(&(around / samples)), "blades: {samples} {around}");

        let tube = strip(64, |t| [0.0, 1.0].map(|z| [1e-3 * (6.3 * t).cos(), 1e-3 * (6.3 * t).sin(), z]), |_| true);
        let [samples, around, first] = estimates(tube, 0.01);
        assert!((1.0..2.5).contains(&(around / samples)), "tube: {samples} {around}");
        assert!(first > 50.0 * samples, "tube: {first}");
    }
}
