//! Samples as scene descriptions have them: places in space with sizes, directions and classes.

use glam::{Quat, Vec3};

use super::points::PointTable;
use super::surface::SurfaceTable;

/// Samples in space with all that is known of them. Lists of what is not known are empty.
pub struct Scene<'a> {
    pub positions: Vec<[f32; 3]>,
    /// The origin to which positions are relative.
    pub origin: [f64; 3],
    /// The normals of the surface that the samples lie on.
    pub normals: &'a [[f32; 3]],
    pub ranks: &'a [f32],
    pub classes: &'a [u32],
    pub triangles: &'a [u32],
    pub barycentrics: &'a [[f32; 2]],
    /// The radius of each class, or of all samples.
    class_radii: &'a [f64],
    /// The radius of each sample, where they differ within a class.
    radii: &'a [f64],
}

impl<'a> Scene<'a> {
    /// A set of the plane z = 0 or of a cuboid.
    pub fn of_points<const D: usize>(table: &PointTable<'a, D>) -> Self {
        let in_space = |point: &[f32; D]| {
            let mut position = [0.0; 3];
            position[..D].copy_from_slice(point);
            position
        };
        Self {
            positions: table.points.iter().map(in_space).collect(),
            origin: [0.0; 3],
            normals: &[],
            ranks: table.ranks,
            classes: table.classes,
            triangles: &[],
            barycentrics: &[],
            class_radii: table.class_radii,
            radii: table.radii,
        }
    }

    /// Samples of a surface.
    pub fn of_surface(table: &SurfaceTable<'a>) -> Self {
        let samples = table.samples;
        Self {
            positions: samples.positions.clone(),
            origin: table.origin,
            normals: table.normals,
            ranks: &samples.ranks,
            classes: &samples.classes,
            triangles: &samples.triangles,
            barycentrics: &samples.barycentrics,
            class_radii: table.class_radii,
            radii: table.radii.unwrap_or_default(),
        }
    }

    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// The number of classes, at least one.
    pub fn class_count(&self) -> usize {
        self.classes.iter().max().map_or(1, |&class| class as usize + 1).max(self.class_radii.len())
    }

    /// The class of a sample.
    pub fn class(&self, sample: usize) -> usize {
        self.classes.get(sample).map_or(0, |&class| class as usize)
    }

    /// The radius of a sample: of two of one class no centres are closer than the smaller one, so that balls of this
    /// diameter do not overlap.
    pub fn radius(&self, sample: usize) -> Option<f64> {
        let of_class = || self.class_radii.get(self.class(sample)).copied();
        self.radii.get(sample).copied().or_else(|| self.one_radius()).or_else(of_class)
    }

    /// The radius of all samples, if they have one and the same.
    pub fn one_radius(&self) -> Option<f64> {
        match self.class_radii {
            &[radius] if self.radii.is_empty() => Some(radius),
            _ => None,
        }
    }

    /// The rotation that takes the axis y, along which things stand where it points upwards, to the normal of a sample: in the
    /// plane and in cuboids none.
    pub fn rotation(&self, sample: usize) -> [f32; 4] {
        let normal = self.normals.get(sample).map_or(Vec3::Y, |&normal| Vec3::from(normal));
        // The rotation is one of the shortest, and any of those for a normal that points downwards.
        normal.try_normalize().map_or(Quat::IDENTITY, |normal| Quat::from_rotation_arc(Vec3::Y, normal)).to_array()
    }

    /// The corners of the box around all positions.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        let ends = |choose: fn(f32, f32) -> f32| {
            let all = self.positions.iter().copied();
            all.reduce(|one, other| std::array::from_fn(|axis| choose(one[axis], other[axis]))).unwrap_or_default()
        };
        [ends(f32::min), ends(f32::max)]
    }
}
