//! Forces in each kind of vectors, the same to the bit: [`Mesh::feel_portable`] once more, compiled for them, so that its loops
//! over lanes use them; [`Cells::force`], of which the compiler makes no good vectors, written in them.

use std::ops::Range;

use glam::Vec2;

use super::cells::Cells;
use super::constraints::Constraints;
use super::mesh::Mesh;
use super::stars::Visit;
use super::torus::Place;
use crate::maximal::Vectors;

#[cfg(target_arch = "x86_64")]
mod avx2;

impl Mesh {
    /// Tells `visit` what each of a range of points feels.
    pub(super) fn feel(
        &self,
        vectors: Vectors,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        visit: &mut impl Visit,
    ) {
        match vectors {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.feel_avx2(places, constraints, points, visit) },
            Vectors::Portable => self.feel_portable(places, constraints, points, visit),
        }
    }

    /// The portable code, compiled for AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
    fn feel_avx2(&self, places: &[Place], constraints: &Constraints, points: Range<usize>, visit: &mut impl Visit) {
        self.feel_portable(places, constraints, points, visit);
    }
}

impl Cells {
    /// Adds the forces on a range of points by all that conflict with them to `forces`.
    pub(super) fn forces(
        &self,
        vectors: Vectors,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        forces: &mut Vec<Vec2>,
    ) {
        match vectors {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.forces_avx2(places, constraints, points, forces) },
            Vectors::Portable => {
                let force = |point| self.force(places[point], constraints, self.around(point));
                forces.extend(points.map(force));
            }
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
    fn forces_avx2(&self, places: &[Place], constraints: &Constraints, points: Range<usize>, forces: &mut Vec<Vec2>) {
        for point in points {
            forces.push(avx2::force(self, places[point], constraints, self.around(point)));
        }
    }
}
