//! What a sample keeps of its triangle while it stays on it.

use glam::{DQuat, DVec2, Vec2, Vec3};

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::walk::FlatTriangle;
use crate::mesh::{exact, round_barycentrics};
use crate::simd::Position;

/// A triangle as the samples on it see it.
#[derive(Clone, Copy, Default)]
pub(super) struct Local {
    corners: [[f32; 3]; 3],
    /// The axes of the plane of the triangle.
    pub(super) axes: [Vec3; 2],
    /// Those of the mean plane of the sample's surroundings: rotated into each other, they are the same axes.
    pub(super) tangents: [Vec3; 2],
    /// The mean normal of the sample's surroundings, on the front side of the triangle; zero where there is none.
    normal: Vec3,
    /// The barycentrics that a displacement by a spacing along each axis adds.
    steps: [Vec2; 2],
}

impl Local {
    /// A triangle as seen by a sample with this mean normal.
    pub(super) fn on(connected: &ConnectedMesh, spacing: f64, triangle: u32, normal: Vec3) -> Self {
        let flat = FlatTriangle::new(connected, triangle, spacing);
        let axes = flat.axes();
        let turn = DQuat::from_rotation_arc(normal.as_dvec3(), flat.normal()).inverse();
        Self {
            corners: connected.mesh.corners(triangle),
            axes: axes.map(|axis| axis.as_vec3()),
            tangents: axes.map(|axis| (turn * axis).as_vec3()),
            normal,
            steps: flat.steps().map(|step| step.as_vec2()),
        }
    }

    /// The mean normal of the sample's surroundings.
    pub(super) fn mean_normal(&self) -> Vec3 {
        self.normal
    }

    /// The normal of the triangle.
    pub(super) fn normal(&self) -> Vec3 {
        self.axes[0].cross(self.axes[1])
    }

    /// Barycentrics after a displacement, in spacings along the axes, if they are in the triangle still.
    #[inline(always)]
    pub(super) fn moved(&self, uv: DVec2, displacement: Vec2) -> Option<DVec2> {
        let moved = uv + (displacement.x * self.steps[0] + displacement.y * self.steps[1]).as_dvec2();
        (moved.x > 0.0 && moved.y > 0.0 && moved.x + moved.y < 1.0).then_some(moved)
    }

    /// The position of barycentrics, in the floats in which samples are returned: that of `Mesh::point`.
    #[inline(always)]
    pub(super) fn position(&self, uv: DVec2) -> Position {
        let [u, v] = round_barycentrics(uv.into()).map(f64::from);
        let [a, b, c] = [exact(self.corners[0]), exact(self.corners[1]), exact(self.corners[2])];
        let [x, y, z] = ((1.0 - u - v) * a + u * b + v * c).as_vec3().to_array();
        [x, y, z, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::rng::{Draw, Rng};

    #[test]
    fn positions_are_those_of_the_mesh_and_displacements_those_of_space() {
        let mut rng = Rng::at(11, Draw::Probe, &[]);
        for _ in 0..200 {
            let mut random = || Vec3::new(rng.unit() as f32, rng.unit() as f32, rng.unit() as f32);
            let mesh = Mesh::new([(); 3].map(|()| random().to_array()).to_vec(), vec![[0, 1, 2]]).unwrap();
            let (spacing, normal) = (0.01, random().normalize());
            let local = Local::on(&ConnectedMesh::new(&mesh).unwrap(), spacing, 0, normal);
            let uv = DVec2::new(rng.unit(), rng.unit()) * 0.4 + 0.05;
            let [x, y, z, _] = local.position(uv);
            assert_eq!([x, y, z], mesh.point(0, round_barycentrics(uv.into())));
            let displacement = Vec2::new(0.02, -0.01);
            if let Some(moved) = local.moved(uv, displacement) {
                let expected = displacement.x * local.axes[0] + displacement.y * local.axes[1];
                let gone = (mesh.point_exact(0, moved.into()) - mesh.point_exact(0, uv.into())) / spacing;
                assert!(gone.distance(expected.as_dvec3()) < 1e-5, "{gone} {expected}");
            }
            // The tangents are at right angles to the mean normal, and turned as the axes are.
            let [u, v] = local.tangents;
            assert!(u.cross(v).distance(normal) < 1e-5 && (local.mean_normal() == normal));
            assert!(local.axes[0].cross(local.axes[1]).distance(local.normal()) < 1e-6);
        }
    }
}
