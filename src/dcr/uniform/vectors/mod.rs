//! Forces in each kind of vectors, the same to the bit: [`Mesh::feel_portable`] once more, compiled for them, so that its loops
//! over lanes use them; [`Cells::force`], of which the compiler makes no good vectors, written in them.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::torus::Place;
use crate::dcr::uniform::cells::Cells;
use crate::dcr::uniform::mesh::Mesh;
use crate::dcr::uniform::stars::Visit;
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;

impl Mesh {
    /// Tells `visit` what each of a range of points feels.
    pub(super) fn feel(
        &self,
        vectors: Level,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        visit: &mut impl Visit,
    ) {
        match vectors {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) | Level::Avx512(_) => unsafe { self.feel_avx2(places, constraints, points, visit) },
            Level::Portable => self.feel_portable(places, constraints, points, visit),
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
        vectors: Level,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        forces: &mut Vec<Vec2>,
    ) {
        match vectors {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) | Level::Avx512(_) => unsafe { self.forces_avx2(places, constraints, points, forces) },
            Level::Portable => {
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
