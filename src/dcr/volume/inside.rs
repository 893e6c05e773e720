//! Points that move inside a closed mesh and never leave it.
//!
//! A point is inside if its float is, by the exact parity of a ray (`interior/`). That is asked for few steps: each point has a
//! clearance, a lower bound of its distance from the surface, which the length of each step reduces. A step shorter than the
//! clearance crosses no triangle, and parity only changes where one is crossed.
//!
//! Any other step is made if its end is inside. If not, it ends just inside of the place of the surface nearest to where it led, so
//! that points are held back as by the walls of a cuboid, and slide along them. If that is outside as well, as in a corner narrower
//! than the layer in which points stand, the step is halved, and refused in the end.
//!
//! Points that slide stand on the surface: the part of a step along its plane is made, and ends at the place of the surface nearest
//! to where it led, or as far beyond an edge on its other side. So they do not change to another sheet that is farther than a step.

use glam::DVec3;

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

/// The freedom of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Freedom {
    /// It stays where it is.
    Fixed,
    /// It moves on the surface.
    Slides,
    /// It moves inside.
    Free,
}

/// A bound on the distance of the surface from a point.
#[derive(Clone, Copy)]
pub struct Near {
    pub freedom: Freedom,
    /// The distance from the surface at which it is held back, in spacings.
    standoff: f32,
    /// The steps after which the surface is searched for again.
    patience: u32,
    /// No place of the surface is nearer, in spacings.
    clearance: f32,
    /// The place of the surface that was found last, in spacings from the corner of the torus, and the direction inwards there; that
    /// is 0 if there is none.
    foot: [f32; 3],
    /// Of points that slide, the normal of the triangle, towards either side.
    inwards: [f32; 3],
}

impl Near {
    /// Nothing is known yet of the surface around a point of the user's order.
    pub fn unknown(index: u32, freedom: Freedom) -> Self {
        // Multiples of the golden ratio differ from all before them by about 1 / index, modulo 1.
        let share = f64::from(index.wrapping_mul(0x9e37_79b9)) / f64::from(u32::MAX);
        Self {
            freedom,
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
    /// That of the mesh that points slide on, without caps.
    surface: &'a Interior,
    volume: f64,
    bounds: [[f32; 3]; 2],
    torus: VolumeTorus,
    points: &'a [[f32; 3]],
    fixed: &'a [bool],
    sliding: &'a [bool],
    /// The error of places, in spacings, and how much the clearance shrinks beyond the length of a step.
    margin: f64,
    lost: f32,
}

impl<'a> Inside<'a> {
    /// Points inside a closed mesh: those that are fixed, in the box around it, and those that slide, on a surface: that of the mesh
    /// without its caps. Either list may be empty: none then is.
    pub fn new(
        mesh: &Mesh,
        [interior, surface]: [&'a Interior; 2],
        points: &'a [[f32; 3]],
        [fixed, sliding]: [&'a [bool]; 2],
    ) -> Self {
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
            surface,
            volume,
            bounds: [bounds.0, bounds.1],
            torus,
            points,
            fixed,
            sliding,
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

    /// Refuses free points outside, fixed ones outside of the box around the mesh, and sliding ones that are off the surface.
    pub fn check(&self, context: &Context) -> Result<()> {
        let [low, high] = self.bounds;
        let refused = |index: usize| {
            let point = self.points[index];
            let (is_allowed, place) = match self.freedom(index as u32) {
                Freedom::Fixed => (
                    (0..3).all(|axis| (low[axis]..=high[axis]).contains(&point[axis])),
                    "fixed and outside of the box around",
                ),
                Freedom::Slides => (self.is_on_surface(point), "sliding and off the surface of"),
                Freedom::Free => (self.interior.contains(point), "outside"),
            };
            (!is_allowed).then_some((index, place))
        };
        let tasks = chunks(self.points.len());
        let find = |task: usize| tasks.range(task).find_map(refused);
        let refused = context.run(None, |job| job.map(tasks.len(), find))?.into_iter().flatten().next();
        refused.map_or(Ok(()), |(index, place)| {
            let point = self.points[index].map(|x| x.to_string()).join(", ");
            Err(Error::invalid("positions", format!("point {index} is ({point}), {place} the mesh")))
        })
    }

    /// True if a point is as near to the surface as the points that it holds back.
    fn is_on_surface(&self, point: [f32; 3]) -> bool {
        let within = (STANDOFF + self.margin) * self.torus.spacing();
        self.surface.nearest(point.map(f64::from), within).is_some()
    }

    /// The freedom of a point of the user's order.
    pub fn freedom(&self, index: u32) -> Freedom {
        let is_one = |of: &[bool]| of.get(index as usize).is_some_and(|&is_one| is_one);
        if is_one(self.fixed) {
            Freedom::Fixed
        } else if is_one(self.sliding) {
            Freedom::Slides
        } else {
            Freedom::Free
        }
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

    /// The place of a point that is moved from another one: none where it may not be, or where it would be back.
    pub fn parted(&self, index: u32, from: Place, step: [f32; 3]) -> Option<Place> {
        match self.freedom(index) {
            Freedom::Slides => {
                let to = DVec3::from_array(self.along(from)) + DVec3::from_array(step.map(f64::from));
                let foot = self.foot(to, SIGHT)?.0;
                Some(self.torus.place(foot.to_array())).filter(|&place| place != from)
            }
            _ => Some(self.torus.moved(from, step, self.torus.per_spacing()).0).filter(|&to| self.holds(to)),
        }
    }

    /// The place of a point after a step of this length and direction, in spacings, which is changed where the surface holds it back.
    #[inline(always)]
    pub fn moved(&self, from: Place, step: &mut [f32; 3], near: &mut Near) -> Place {
        if near.freedom == Freedom::Slides {
            return self.slid(from, step, near);
        }
        let to = self.torus.moved(from, *step, self.torus.per_spacing()).0;
        let squared = step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
        let rest = near.clearance - squared.sqrt() * (1.0 + ROUNDING as f32) - self.lost;
        if rest > 0.0 {
            near.clearance = rest;
            return to;
        }
        self.moved_near_surface(from, to, step, near)
    }

    /// The place of a point of the surface after a step, which becomes the way along the surface.
    #[inline(never)]
    fn slid(&self, from: Place, step: &mut [f32; 3], near: &mut Near) -> Place {
        near.turn_along(step, true);
        let way = DVec3::from_array(step.map(f64::from));
        // Not held back by the walls of the torus, which touch the surface.
        let to = DVec3::from_array(self.along(from)) + way;
        // The surface is no farther than the step was long, but for where the point stood.
        let within = way.length() * (1.0 + ROUNDING) + STANDOFF + self.margin;
        let Some((mut foot, mut normal)) = self.foot(to, within) else {
            *step = [0.0; 3];
            return from;
        };
        // The rest of a step beyond an edge is made on the other side of it, which is where the normal leads, one way or the other.
        let (rest, along) = (to.distance(foot), DVec3::from_array(near.inwards.map(f64::from)));
        if rest > STANDOFF + self.margin {
            let turned = [along, -along].map(|along| foot + rest * along);
            let found = turned.into_iter().filter_map(|place| Some((place, self.foot(place, rest)?)));
            let distance = |&(place, (foot, _)): &(DVec3, (DVec3, DVec3))| place.distance(foot);
            if let Some((_, found)) = found.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
                (foot, normal) = found;
            }
        }
        near.inwards = normal.as_vec3().to_array();
        let place = self.torus.place(foot.to_array());
        let unit = self.torus.unit();
        *step = std::array::from_fn(|axis| {
            (f64::from(place[axis].wrapping_sub(from[axis]).cast_signed()) * unit[axis]) as f32
        });
        place
    }

    /// The place of the surface nearest to one, if it is near enough, in spacings from the corner of the torus, and the normal there.
    fn foot(&self, place: DVec3, within: f64) -> Option<(DVec3, DVec3)> {
        let (spacing, min) = (self.torus.spacing(), DVec3::from_array(self.torus.domain().min));
        let (foot, normal) = self.surface.nearest_facing((min + spacing * place).to_array(), within * spacing)?;
        Some(((DVec3::from_array(foot) - min) / spacing, normal.into()))
    }

    #[inline(never)]
    fn moved_near_surface(&self, from: Place, to: Place, step: &mut [f32; 3], near: &mut Near) -> Place {
        near.clearance = 0.0;
        let along = self.along(to);
        let held = near.held(along);
        let place = held.map_or(to, |held| self.torus.place(held));
        if self.holds(place) {
            if held.is_some() {
                near.turn_along(step, false);
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
            near.turn_along(step, false);
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

    /// Takes from a step the part that leads outwards, or also one inwards.
    fn turn_along(&self, step: &mut [f32; 3], both: bool) {
        let [x, y, z] = self.inwards;
        let inwards = step[0] * x + step[1] * y + step[2] * z;
        let away = if both { inwards } else { inwards.min(0.0) };
        *step = std::array::from_fn(|axis| step[axis] - away * self.inwards[axis]);
    }
}
