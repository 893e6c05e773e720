//! The scene of a call: its instances, where they lie, and which of them can be near to each other.

use std::sync::Arc;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::index::{BoxTree, Extent, meet};
use crate::memory;
use crate::mesh::{Mesh, exact};
use crate::points::{check_radius, check_resolution};
use crate::psp::fill::{DENSITY, require_samples};
use crate::psp::fragment::Facing;
use crate::psp::options::InstanceOptions;

/// A mesh, placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// The index of the mesh among the prototypes.
    pub prototype: u32,
    /// The rows of the matrix that takes a vertex `(x, y, z, 1)` of the mesh to its place. Any: it may scale, shear,
    /// mirror and flatten. Places are computed in `f64`, row by row from left to right, and rounded once.
    pub transform: [[f64; 4]; 3],
}

impl Instance {
    /// Where a point of the mesh lies in the world.
    pub(super) fn place(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.transform.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// A box that holds what the transform makes of a box, before places are rounded.
    fn extent(&self, [low, high]: [[f32; 3]; 2]) -> Extent {
        let mut extent = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for corner in 0..8 {
            let corner = [0, 1, 2].map(|axis| f64::from(if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }));
            let place = DVec3::from_array(self.place(corner));
            extent = [extent[0].min(place), extent[1].max(place)];
        }
        extent
    }

    /// The rows of the matrix of cofactors, which takes vectors of areas to theirs: the inverse transpose times the
    /// determinant.
    fn cofactors(&self) -> [DVec3; 3] {
        let [a, b, c] = self.transform.map(|[x, y, z, _]| DVec3::new(x, y, z));
        [b.cross(c), c.cross(a), a.cross(b)]
    }

    /// True if the transform turns the outside in.
    pub(super) fn mirrors(&self) -> bool {
        let [a, b, c] = self.transform.map(|[x, y, z, _]| DVec3::new(x, y, z));
        a.dot(b.cross(c)) < 0.0
    }

    /// The unit vector at right angles to what was so to `normal`, on the same side; `other` where the transform leaves
    /// no direction.
    pub(super) fn normal(&self, normal: [f32; 3], other: [f32; 3]) -> [f32; 3] {
        let side = if self.mirrors() { -1.0 } else { 1.0 };
        let normal = side * DVec3::from_array(self.cofactors().map(|row| row.dot(exact(normal))));
        normal.try_normalize().map_or(other, |normal| normal.as_vec3().to_array())
    }
}

/// Peak memory per sample beside the instance at work, and per instance.
const BYTES_PER_SAMPLE: f64 = 110.0;
const BYTES_PER_INSTANCE: f64 = 700.0;

/// A box is taken to be larger by this share of the radius, which is at least 64 float spacings: places are rounded.
const MARGIN: f64 = 1.0 / 16.0;

/// Instances, and what of them is known before any is filled.
pub struct Scene<'a> {
    pub prototypes: &'a [Arc<Mesh>],
    pub instances: &'a [Instance],
    pub options: &'a InstanceOptions<'a>,
    /// The boxes of the instances, larger by half of the distance at which two of them matter to each other.
    boxes: BoxTree,
}

impl<'a> Scene<'a> {
    /// Refuses what is out of range.
    pub fn new(
        prototypes: &'a [Arc<Mesh>],
        instances: &'a [Instance],
        options: &'a InstanceOptions<'a>,
    ) -> Result<Self> {
        let (radius, count) = (options.radius, instances.len());
        check_radius(radius)?;
        Facing::new(options.cosine)?;
        options.given.check()?;
        if count >= u32::MAX as usize {
            return Err(Error::too_large("instances", format!("{count} of them; the limit is {}", u32::MAX - 1)));
        }
        memory::require(BYTES_PER_INSTANCE * count as f64, "instances", &format!("{count} instances"))?;
        let (mut boxes, mut samples, mut largest) = (Vec::with_capacity(count), 0.0, 0.0f64);
        for (number, instance) in instances.iter().enumerate() {
            let refuse = |reason: String| Err(Error::invalid("instances", format!("[{number}]: {reason}")));
            let Some(mesh) = prototypes.get(instance.prototype as usize) else {
                let count = prototypes.len();
                return refuse(format!("prototype is {}, and there are {count}", instance.prototype));
            };
            if let Some(entry) = instance.transform.as_flattened().iter().position(|x| !x.is_finite()) {
                let value = instance.transform.as_flattened()[entry];
                return refuse(format!("transform[{entry}] is {value}, not finite"));
            }
            let (low, high) = mesh.bounds();
            let extent = instance.extent([low, high]);
            let farthest = extent[0].abs().max(extent[1].abs()).max_element();
            if farthest.is_nan() || farthest > f64::from(f32::MAX) / 2.0 {
                return refuse("the transform takes the mesh out of the range of floats".to_string());
            }
            largest = largest.max(farthest);
            let growth = instance.cofactors().map(|row| row.length_squared()).iter().sum::<f64>();
            samples += DENSITY * mesh.area() * (growth / 3.0).sqrt() / (radius * radius);
            boxes.push([extent[0] - (0.5 + MARGIN) * radius, extent[1] + (0.5 + MARGIN) * radius]);
        }
        let largest = largest as f32;
        let spacing = f64::from(largest) - f64::from(largest.next_down());
        check_resolution("radius", radius, spacing, "the largest coordinate of the instances")?;
        require_samples(samples, BYTES_PER_SAMPLE, "radius", &format!("{radius:?} asks for"))?;
        Ok(Self { prototypes, instances, options, boxes: BoxTree::new(boxes) })
    }

    /// The instances before this one that it can be near to, in order.
    fn before(&self, number: usize) -> Vec<usize> {
        let mut before = Vec::new();
        self.boxes.visit(&self.boxes.boxes()[number], |other| {
            if (other as usize) < number {
                before.push(other as usize);
            }
        });
        before.sort_unstable();
        before
    }

    /// The instances by the longest chain of those that have to be filled before them.
    pub fn levels(&self) -> Vec<Vec<usize>> {
        let (mut levels, mut level_of) = (Vec::<Vec<usize>>::new(), Vec::with_capacity(self.instances.len()));
        for number in 0..self.instances.len() {
            let level = self.before(number).into_iter().map(|other| level_of[other] + 1).max().unwrap_or(0);
            level_of.push(level);
            if level == levels.len() {
                levels.push(Vec::new());
            }
            levels[level].push(number);
        }
        levels
    }

    /// The positions and clearances of all samples that can matter to an instance, from those of each one before it.
    pub fn given_near<'p>(&self, number: usize, others: impl Fn(usize) -> &'p [[f32; 3]]) -> (Vec<[f32; 3]>, Vec<f64>) {
        let (given, radius, [low, high]) = (self.options.given, self.options.radius, self.boxes.boxes()[number]);
        let is_near = |position: [f32; 3], reach: f64| {
            let position = exact(position);
            meet(&[position - reach, position + reach], &[low, high])
        };
        let own = given.positions.iter().enumerate().map(|(i, &position)| (position, given.clearance(i, radius)));
        let own = own.filter(|&(position, clearance)| is_near(position, clearance));
        let others = self.before(number).into_iter().flat_map(others).map(|&position| (position, radius));
        // The box has half of the radius in it.
        own.chain(others.filter(|&(position, _)| is_near(position, 0.5 * radius))).unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_follow_planes_and_stay_outside() {
        // Of the plane x + y = 1, stretched along x, and mirrored.
        let stretched =
            Instance { prototype: 0, transform: [[2.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };
        let [x, y, z] = stretched.normal([0.5f32.sqrt(), 0.5f32.sqrt(), 0.0], [0.0; 3]);
        assert!((y / x - 2.0).abs() < 1e-6 && x > 0.0 && z == 0.0, "{x} {y} {z}");
        let mirrored =
            Instance { prototype: 0, transform: [[-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };
        assert!(mirrored.mirrors() && !stretched.mirrors());
        assert_eq!(mirrored.normal([1.0, 0.0, 0.0], [0.0; 3]), [-1.0, 0.0, 0.0]);
        let flat = Instance { prototype: 0, transform: [[0.0; 4]; 3] };
        assert_eq!(flat.normal([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 1.0, 0.0]);
    }

    #[test]
    fn the_box_holds_the_vertices() {
        let turned =
            Instance { prototype: 0, transform: [[0.6, -0.8, 0.0, 1.0], [0.8, 0.6, 0.0, 2.0], [0.3, 0.0, -1.0, 3.0]] };
        let [low, high] = turned.extent([[0.0; 3], [1.0; 3]]);
        assert!((low - DVec3::new(0.2, 2.0, 2.0)).length() < 1e-12, "{low}");
        assert!((high - DVec3::new(1.6, 3.4, 3.3)).length() < 1e-12, "{high}");
    }
}
