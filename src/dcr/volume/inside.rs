//! Points that move inside a closed mesh and never leave it.
//!
//! A point is inside if its float is, by the exact parity of a ray (`interior/`). That is asked for few steps: each point has a
//! clearance, a lower bound of its distance from the surface, which the length of each step reduces. A step shorter than the
//! clearance crosses no triangle, and parity only changes where one is crossed.
//!
//! Any other step is made if its end is inside. If not, it ends just inside of the place of the surface nearest to where it led, so
//! that points are held back as by the walls of a cuboid, and slide along them. If that is outside as well, as in a corner narrower
//! than the layer in which points stand, the step is halved, and refused in the end.

use crate::dcr::volume::torus::{Place, VolumeTorus};
use crate::error::{Error, Result};
use crate::interior::Interior;
use crate::job::{Context, chunks};
use crate::math::cbrt;
use crate::mesh::Mesh;
use crate::plane::float_spacing;
use crate::points::{Boundary, Domain};

/// The least distance from the surface, in spacings, of points that it holds back; and up to twice that, a distance of its own for
/// each, so that two points for which the same place of the surface is the nearest, as a corner is, do not coincide.
const STANDOFF: f64 = 1e-3;

/// The distance up to which the surface is searched for, in spacings: the largest clearance.
const SIGHT: f64 = 2.0;

/// The distance, in spacings, from the place of the surface that was found last, within which its tangent plane stands for it.
const FLAT: f64 = 0.3;

/// A point that is nearer to the surface than this, in spacings, has no clearance, and searches again after so many steps only.
const BESIDE: f64 = 0.1;
const PATIENCE: u32 = 8;

/// The times that a step is halved before it is refused.
const HALVINGS: u32 = 3;

/// The box in which points move is wider than that around the mesh by this share of its longest side.
const ROOM: f64 = 1e-6;

/// The tests of a clearance are right to this share of it and of the size of the mesh, and a step's length to this share.
const ROUNDING: f64 = 1e-6;
const ROUNDING_OF_SIZE: f64 = 2e-7;

/// A bound on the distance of the surface from a point.
#[derive(Clone, Copy)]
pub struct Near {
    /// True if the point stays.
    pub is_fixed: bool,
    /// The distance from the surface at which it is held back, in spacings.
    standoff: f32,
    /// The steps after which the surface is searched for again.
    patience: u32,
    /// No place of the surface is nearer, in spacings.
    clearance: f32,
    /// The place of the surface that was found last, in spacings from the corner of the torus, and the direction inwards there; that
    /// is 0 if there is none.
    foot: [f32; 3],
    inwards: [f32; 3],
}

impl Near {
    /// Nothing is known yet of the surface around a point of the user's order.
    pub fn unknown(index: u32, is_fixed: bool) -> Self {
        // Multiples of the golden ratio differ from all before them by about 1 / index, modulo 1.
        let share = f64::from(index.wrapping_mul(0x9e37_79b9)) / f64::from(u32::MAX);
        Self {
            is_fixed,
            standoff: (STANDOFF * (1.0 + share)) as f32,
            patience: 0,
            clearance: 0.0,
            foot: [0.0; 3],
            inwards: [0.0; 3],
        }
    }
}

/// The inside of a mesh, and the points with which a relaxation began.
#[derive(Clone, Copy)]
pub struct Inside<'a> {
    interior: &'a Interior,
    volume: f64,
    bounds: [[f32; 3]; 2],
    torus: VolumeTorus,
    points: &'a [[f32; 3]],
    fixed: &'a [bool],
    /// The error of places, in spacings, and how much the clearance shrinks beyond the length of a step.
    margin: f64,
    lost: f32,
}

impl<'a> Inside<'a> {
    /// Points inside a closed mesh; those that are fixed in the box around it, and none are if `fixed` is empty.
    pub fn new(mesh: &Mesh, interior: &'a Interior, points: &'a [[f32; 3]], fixed: &'a [bool]) -> Self {
        let (bounds, volume) = (mesh.bounds(), interior.volume());
        let [low, high] = [bounds.0, bounds.1].map(|corner| corner.map(f64::from));
        let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        // No wall of the cuboid is ever reached.
        let (min, max) = (low.map(|x| x - ROOM * size), high.map(|x| x + ROOM * size));
        let domain = Domain { min, max, boundary: Boundary::Bounded };
        let torus = VolumeTorus::around(domain, [volume, mesh.area()], points.len().max(1));
        let floats = float_spacing(min.iter().chain(&max)) / torus.spacing();
        let unit = torus.unit().into_iter().fold(0.0, f64::max);
        Self {
            interior,
            volume,
            bounds: [bounds.0, bounds.1],
            torus,
            points,
            fixed,
            margin: 4.0 * (floats + unit) + ROUNDING_OF_SIZE * size / torus.spacing(),
            lost: (ROUNDING + 4.0 * unit) as f32,
        }
    }

    /// The torus of a cuboid in which the mesh lies.
    pub fn torus(&self) -> &VolumeTorus {
        &self.torus
    }

    /// The distance of neighbours if the points stood in the densest packing of the volume. That of the forces for a body so thin
    /// that its volume is not known.
    pub fn packed_distance(&self) -> f64 {
        let distance = cbrt(2f64.sqrt() * self.volume / self.points.len().max(1) as f64);
        if distance > 0.0 { distance } else { self.torus.spacing() }
    }

    /// Refuses points outside, and fixed ones outside of the box around the mesh.
    pub fn check(&self, context: &Context) -> Result<()> {
        let [low, high] = self.bounds;
        let is_allowed = |index: usize| {
            let point = self.points[index];
            match self.is_fixed(index as u32) {
                true => (0..3).all(|axis| (low[axis]..=high[axis]).contains(&point[axis])),
                false => self.interior.contains(point),
            }
        };
        let tasks = chunks(self.points.len());
        let find = |task: usize| tasks.range(task).find(|&index| !is_allowed(index));
        let refused = context.run(None, |job| job.map(tasks.len(), find))?.into_iter().flatten().next();
        refused.map_or(Ok(()), |index| {
            let place = self.points[index].map(|x| x.to_string()).join(", ");
            let outside = if self.is_fixed(index as u32) { "fixed and outside of the box around" } else { "outside" };
            Err(Error::invalid("positions", format!("point {index} is ({place}), {outside} the mesh")))
        })
    }

    /// True if a point of the user's order stays.
    pub fn is_fixed(&self, index: u32) -> bool {
        self.fixed.get(index as usize).is_some_and(|&is_fixed| is_fixed)
    }

    /// The float of a point at a place: the one with which it began, if it is there.
    pub fn leave(&self, index: u32, place: Place) -> [f32; 3] {
        let given = self.points[index as usize];
        if self.torus.enter(given) == place { given } else { self.torus.leave(place) }
    }

    /// True if a place is inside, as the float that it is returned as.
    pub fn holds(&self, place: Place) -> bool {
        self.interior.contains(self.torus.leave(place))
    }

    /// The place of a point after a step of this length and direction, in spacings, which is changed where the surface holds it back.
    #[inline(always)]
    pub fn moved(&self, from: Place, step: &mut [f32; 3], near: &mut Near) -> Place {
        let to = self.torus.moved(from, *step, self.torus.per_spacing()).0;
        let squared = step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
        let rest = near.clearance - squared.sqrt() * (1.0 + ROUNDING as f32) - self.lost;
        if rest > 0.0 {
            near.clearance = rest;
            return to;
        }
        self.moved_near_surface(from, to, step, near)
    }

    #[inline(never)]
    fn moved_near_surface(&self, from: Place, to: Place, step: &mut [f32; 3], near: &mut Near) -> Place {
        near.clearance = 0.0;
        let along = self.along(to);
        let held = near.held(along);
        let place = held.map_or(to, |held| self.torus.place(held));
        if self.holds(place) {
            if held.is_some() {
                near.turn_along(step);
            } else if near.patience > 0 {
                near.patience -= 1;
            } else {
                self.search(along, true, near);
            }
            return place;
        }
        if held.is_some() && self.holds(to) {
            // The surface is not as flat as its tangent plane.
            self.search(along, true, near);
            return to;
        }
        self.search(along, false, near);
        let place = self.torus.place(near.inside_of_foot());
        if self.holds(place) {
            near.turn_along(step);
            return place;
        }
        let mut part = *step;
        for _ in 0..HALVINGS {
            part = part.map(|x| 0.5 * x);
            let place = self.torus.moved(from, part, self.torus.per_spacing()).0;
            if self.holds(place) {
                *step = part;
                return place;
            }
        }
        *step = [0.0; 3];
        from
    }

    /// Searches for the place of the surface nearest to one inside or outside.
    fn search(&self, along: [f64; 3], is_inside: bool, near: &mut Near) {
        let (spacing, min) = (self.torus.spacing(), self.torus.domain().min);
        let place = std::array::from_fn(|axis| min[axis] + along[axis] * spacing);
        (near.clearance, near.patience, near.inwards) = (0.0, 0, [0.0; 3]);
        let Some((foot, squared)) = self.interior.nearest(place, SIGHT * spacing) else {
            near.clearance = (SIGHT * (1.0 - ROUNDING) - self.margin).max(0.0) as f32;
            return;
        };
        let distance = squared.sqrt() / spacing;
        if distance >= BESIDE && is_inside {
            near.clearance = (distance * (1.0 - ROUNDING) - self.margin).max(0.0) as f32;
            return;
        }
        near.patience = PATIENCE;
        near.foot = std::array::from_fn(|axis| ((foot[axis] - min[axis]) / spacing) as f32);
        if distance > self.margin {
            let inwards = if is_inside { 1.0 } else { -1.0 };
            near.inwards = std::array::from_fn(|axis| (inwards * (place[axis] - foot[axis]) / squared.sqrt()) as f32);
        }
    }

    /// A place in spacings from the corner of the torus.
    fn along(&self, place: Place) -> [f64; 3] {
        let unit = self.torus.unit();
        std::array::from_fn(|axis| f64::from(place[axis]) * unit[axis])
    }
}

impl Near {
    /// The foot of a place that is beyond the tangent plane, on the plane's inner side.
    #[inline(always)]
    fn held(&self, along: [f64; 3]) -> Option<[f64; 3]> {
        let offset: [f64; 3] = std::array::from_fn(|axis| along[axis] - f64::from(self.foot[axis]));
        let inwards = self.inwards.map(f64::from);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let lift = f64::from(self.standoff) - dot(offset, inwards);
        let is_held = self.inwards != [0.0; 3] && lift > 0.0 && dot(offset, offset) < FLAT * FLAT;
        is_held.then(|| std::array::from_fn(|axis| along[axis] + lift * inwards[axis]))
    }

    /// The place on the inner side of the one of the surface that was found last.
    fn inside_of_foot(&self) -> [f64; 3] {
        std::array::from_fn(|axis| f64::from(self.foot[axis] + self.standoff * self.inwards[axis]))
    }

    /// Takes from a step the part that leads outwards.
    fn turn_along(&self, step: &mut [f32; 3]) {
        let [x, y, z] = self.inwards;
        let outwards = (step[0] * x + step[1] * y + step[2] * z).min(0.0);
        *step = std::array::from_fn(|axis| step[axis] - outwards * self.inwards[axis]);
    }
}
