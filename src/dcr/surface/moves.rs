//! The moves that forces ask samples to make in a step.

use glam::{DQuat, DVec2, Vec2, Vec3};

use crate::dcr::law::{Constraints, FREE_CLEARANCE, Force, MOMENTUM, RingPoint, SAFE_FRACTION, graded_force};
use crate::dcr::surface::apart::{Contacts, Limits, NEAR};
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::grading::{Even, Grading, between, grade};
use crate::dcr::surface::lists::{GROWTH, List, Listed};
use crate::dcr::surface::view::{MOST, Star, View};
use crate::dcr::surface::walk::{FlatTriangle, SurfacePoint, walk};
use crate::mesh::{exact, round_barycentrics};
use crate::simd::{LANES, Lanes, Position, Work};

/// A bound of the relative error of lengths in `f32`.
const ROUNDING: f32 = 1.0 + 1e-5;

/// A sample comes to rest where no force acts on it and its last move was shorter than this, in spacings.
const CALM: f32 = 1e-3;

/// A sample that moves farther than this in a step, in spacings, wakes those around it.
const WAKING: f32 = 5e-3;

/// The distance up to which the density at the centre of a hole is looked for, in spacings of the sample.
const FARTHEST_HOLE: f32 = 8.0;

/// The turns by which a sample tries to pass a place where none are wanted: none, then 30, 60 and 85 degrees to both
/// sides, as unit vectors.
const TURNS: [Vec2; 7] = [
    Vec2::X,
    Vec2::new(0.866, 0.5),
    Vec2::new(0.866, -0.5),
    Vec2::new(0.5, 0.866),
    Vec2::new(0.5, -0.866),
    Vec2::new(0.087, 0.996),
    Vec2::new(0.087, -0.996),
];

/// A moving sample.
#[derive(Clone, Copy, Default)]
pub struct Mover {
    pub place: SurfacePoint,
    /// The velocity in the plane of its triangle and in mean spacings.
    pub velocity: Vec2,
    pub star: Star,
    /// The number of steps for which it stays at rest.
    pub rest: u8,
}

/// A move that may end too close to another sample, and its starting state.
pub struct UncheckedMove {
    pub sample: u32,
    pub place: SurfacePoint,
    /// Its view of the triangle that it has left.
    pub left: Option<Box<Local>>,
}

/// The work left after moves.
#[derive(Default)]
pub struct FollowUp {
    pub unchecked: Vec<UncheckedMove>,
    /// The samples that wake those around them.
    pub stirring: Vec<u32>,
}

/// The state of all samples that is read while they move, and the rules of the step. A spacing is that of the sample.
pub struct StepState<'a, G> {
    pub connected: &'a ConnectedMesh<'a>,
    pub grading: &'a G,
    pub positions: &'a [Position],
    pub lists: &'a [List],
    /// The mean spacing.
    pub spacing: f64,
    /// 1 over the mean spacing.
    pub unit: f32,
    /// The least distance of samples, in spacings.
    pub floor: f32,
    pub constraints: Constraints,
    pub limits: Limits,
    /// The largest displacement, in spacings.
    pub stride: f32,
    /// The number of steps that samples rest once they come to rest.
    pub rest: u8,
}

/// The moves of consecutive samples, each made as it is wanted.
pub struct Moves<'a, G> {
    pub state: &'a StepState<'a, G>,
    /// The number of the first sample.
    pub first: usize,
    pub movers: &'a mut [Mover],
    pub locals: &'a mut [Local],
    /// The positions in which the samples would end.
    pub wanted: &'a mut [Position],
}

impl<G: Grading> Work for Moves<'_, G> {
    type Out = FollowUp;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> FollowUp {
        let (mut view, mut ring, mut contacts) = (View::default(), Ring::default(), Contacts::default());
        let (mut graded, mut after) = (Vec::new(), FollowUp::default());
        let state = self.state;
        let StepState { connected, grading, positions, unit, .. } = *state;
        let all = Listed::new(connected, grading, positions, unit);
        let mut k = 0;
        while k < self.movers.len() {
            let (sample, mover, local) = (self.first + k, &mut self.movers[k], &mut self.locals[k]);
            if mover.rest > 0 {
                mover.rest -= 1;
                self.wanted[k] = state.positions[sample];
                k += 1;
                continue;
            }
            let (from, list) = (state.positions[sample], &state.lists[sample]);
            let own = grade::<G>(from);
            let (count, mut least) = list.show(lanes, from, &all, &mut view);
            view.project(lanes, local.tangents);
            view.find_star(lanes, &mut mover.star);
            let Force { sum, clearance } = match G::VARIES {
                true => state.graded(mover.place, own, &view, &mut graded),
                false => ring.force(lanes, &state.constraints, &view),
            };
            let velocity = MOMENTUM * (mover.velocity / own) + sum;
            let wanted = velocity.clamp_length_max((SAFE_FRACTION * clearance).min(state.stride));
            let reach = state.limits.near + 2.0 * wanted.length();
            let close = view.nearer::<L, G>(lanes, count, reach * reach);
            let mut nearest = view.least_squared::<L, G>(lanes, count);
            contacts.clear();
            let mut bits = close;
            while bits != 0 {
                let offset = view.offset_in_space::<G>(bits.trailing_zeros() as usize);
                contacts.add(local.axes, offset, state.limits.near);
                bits &= bits - 1;
            }
            for &other in list.others() {
                let offset = state.offset(from, other);
                let squared = offset.length_squared();
                least = if G::VARIES { least.min(grade::<G>(state.positions[other as usize])) } else { least };
                nearest = nearest.min(squared);
                if squared < reach * reach {
                    contacts.add(local.axes, offset, state.limits.far);
                }
            }
            let held_off = contacts.hold_off(wanted).clamp_length_max(state.stride);
            let place = mover.place;
            let (left, to) = match G::VARIES {
                true => state.displace_to_wanted(mover, local, own, held_off),
                false => (state.displace(mover, local, held_off), local.position(mover.place.uv)),
            };
            self.wanted[k] = to;
            let length = state.length(from, to) / own;
            // Two samples are no closer than the floor if each has moved by no more than half of the excess, over the
            // floor, of its distance to the nearest other one.
            let (growth, share) = if G::VARIES { (GROWTH, own * between::<G>(own, least)) } else { (1.0, 1.0) };
            if length > 0.0 && nearest.sqrt() < (growth * state.floor + 2.0 * (share * length)) * ROUNDING {
                after.unchecked.push(UncheckedMove { sample: sample as u32, place, left });
            }
            // A sample that others push, now or when limits have grown, never rests.
            if state.rest > 0 && sum == Vec2::ZERO && length < CALM && nearest >= NEAR * NEAR {
                (mover.rest, mover.velocity) = (state.rest, Vec2::ZERO);
            } else if length > WAKING {
                after.stirring.push(sample as u32);
            }
            k += 1;
        }
        after
    }
}

impl<G: Grading> StepState<'_, G> {
    /// The offset of another sample, in the mean of the two spacings.
    fn offset(&self, from: Position, other: u32) -> Vec3 {
        let other = self.positions[other as usize];
        offset(from, other) * (self.unit * between::<G>(grade::<G>(from), grade::<G>(other)))
    }

    /// The distance of two positions, in mean spacings.
    #[inline(always)]
    pub fn length(&self, from: Position, to: Position) -> f32 {
        (offset(from, to) * self.unit).length()
    }

    /// Moves a sample by a displacement in the plane of its triangle, in mean spacings. Returns the state kept of the
    /// triangle if the sample has left it.
    #[inline(always)]
    fn displace(&self, mover: &mut Mover, local: &mut Local, displacement: Vec2) -> Option<Box<Local>> {
        let Some(uv) = local.moved(mover.place.uv, displacement) else { return self.walk(mover, local, displacement) };
        (mover.place.uv, mover.velocity) = (uv, displacement);
        None
    }

    /// The force where grades vary, by the law of the plane.
    #[inline(never)]
    fn graded(&self, place: SurfacePoint, own: f32, view: &View, ring: &mut Vec<RingPoint>) -> Force {
        let (star, is_closed) = view.star();
        if !is_closed {
            return pushed::<G>(&self.constraints, view);
        }
        let seen = |&candidate: &u8| {
            let (offset, factor) = (view.offset(candidate.into()), view.factor::<G>(candidate.into()));
            RingPoint { offset: own * offset, spacing: own * (2.0 / factor - 1.0) }
        };
        ring.clear();
        ring.extend(star.iter().map(seen));
        let density_at = |offset: Vec2| {
            let offset = offset.clamp_length_max(FARTHEST_HOLE * own).as_dvec2();
            let centre = walk(self.connected, self.spacing, place, offset).place;
            self.grading.at(self.connected.mesh, centre).map_or(0.0, |grade| 1.0 / (grade * grade))
        };
        let Force { sum, clearance } = graded_force(&self.constraints, own, ring, density_at);
        Force { sum, clearance: clearance / own }
    }

    /// Moves a sample by a displacement in its spacings, or past a place where no samples are wanted, along its rim;
    /// and its position then. It stays if there is no way.
    #[inline(never)]
    fn displace_to_wanted(
        &self,
        mover: &mut Mover,
        local: &mut Local,
        own: f32,
        displacement: Vec2,
    ) -> (Option<Box<Local>>, Position) {
        let (mesh, from) = (self.connected.mesh, (*mover, *local));
        for turn in TURNS {
            let left = self.displace(mover, local, own * turn.x * turn.rotate(displacement));
            if let Some(grade) = self.grading.at(mesh, mover.place) {
                let [x, y, z, _] = local.position(mover.place.uv);
                return (left, [x, y, z, grade.min(GROWTH * own)]);
            }
            (*mover, *local) = from;
        }
        mover.velocity = Vec2::ZERO;
        let [x, y, z, _] = local.position(mover.place.uv);
        (None, [x, y, z, own])
    }

    #[inline(never)]
    fn walk(&self, mover: &mut Mover, local: &mut Local, displacement: Vec2) -> Option<Box<Local>> {
        let end = walk(self.connected, self.spacing, mover.place, displacement.as_dvec2());
        let left = (end.place.triangle != mover.place.triangle).then(|| {
            let normal = local.mean_normal();
            let normal = if end.is_turned { -normal } else { normal };
            let entered = Local::on(self.connected, self.spacing, end.place.triangle, normal);
            Box::new(std::mem::replace(local, entered))
        });
        (mover.place, mover.velocity) = (end.place, end.displacement.as_vec2());
        left
    }
}

fn offset(from: Position, to: Position) -> Vec3 {
    Vec3::new(to[0] - from[0], to[1] - from[1], to[2] - from[2])
}

// [`Constraints::force`] by the star of a sample, sixteen neighbours at a time, in the same operations.

/// The offsets of the neighbours of a sample, the last of them before the first too.
pub struct Ring {
    offsets: [[f32; MOST + 1]; 2],
}

impl Default for Ring {
    fn default() -> Self {
        Self { offsets: [[0.0; MOST + 1]; 2] }
    }
}

impl Ring {
    /// The force by the neighbours of the star. A sample that they do not surround is only pushed, by all candidates.
    #[inline(always)]
    pub fn force<L: Lanes>(&mut self, lanes: L, constraints: &Constraints, view: &View) -> Force {
        let (star, is_closed) = view.star();
        if !is_closed {
            return pushed::<Even>(constraints, view);
        }
        let before = view.offset(star[star.len() - 1].into());
        [self.offsets[0][0], self.offsets[1][0]] = before.to_array();
        for (place, &neighbour) in (1..).zip(star) {
            [self.offsets[0][place], self.offsets[1][place]] = view.offset(neighbour.into()).to_array();
        }
        let mut force = Force { sum: Vec2::ZERO, clearance: f32::INFINITY };
        let mut first = 0;
        while first < star.len() {
            let count = (star.len() - first).min(LANES);
            let part = self.force_of(lanes, constraints, first, count);
            force.sum += part.sum;
            force.clearance = force.clearance.min(part.clearance);
            first += LANES;
        }
        force.clearance = force.clearance.sqrt();
        force
    }

    /// The force by `count` neighbours, and the square of the clearance.
    #[inline(always)]
    fn force_of<L: Lanes>(&self, lanes: L, constraints: &Constraints, first: usize, count: usize) -> Force {
        let one = lanes.splat(1.0);
        let at = |axis: usize, place: usize| {
            let from: &[f32; LANES] = self.offsets[axis][place..place + LANES].try_into().unwrap_or(&[0.0; LANES]);
            lanes.load(from)
        };
        let is_one = lanes.less(lanes.load(&FIRST), lanes.splat(count as f32));
        let [ax, ay, bx, by] = [at(0, first), at(1, first), at(0, first + 1), at(1, first + 1)];
        let squared_of = |x, y| lanes.add(lanes.mul(x, x), lanes.mul(y, y));
        let (a_squared, squared) = (squared_of(ax, ay), squared_of(bx, by));
        let opposite = squared_of(lanes.sub(bx, ax), lanes.sub(by, ay));
        // Twice the area of the triangle.
        let area = lanes.sub(lanes.mul(ax, by), lanes.mul(ay, bx));
        let longest = lanes.max(lanes.max(a_squared, squared), opposite);
        let height = lanes.div(lanes.mul(lanes.max(area, lanes.splat(0.0)), area), longest);
        let clearance = lanes.least(lanes.select(is_one, height, lanes.splat(f32::INFINITY)));

        let radius = constraints.conflict_radius;
        let is_near = lanes.less(squared, lanes.splat(radius * radius));
        let pushed = lanes.only(is_near, constraints.conflicts(lanes, lanes.sqrt(squared)));
        let mut x = lanes.mul(pushed, bx);
        let mut y = lanes.mul(pushed, by);

        // The circumradius is the product of the edges over four times the area.
        let wide = lanes.mul(lanes.splat(2.0 * constraints.coverage_radius), area);
        let edges = lanes.mul(lanes.mul(a_squared, squared), opposite);
        let is_hole = lanes.less(lanes.mul(wide, wide), edges);
        if lanes.bits(is_hole) & ((1 << count) - 1) != 0 {
            let half = lanes.div(one, lanes.mul(lanes.splat(2.0), area));
            // b² perp(a) - a² perp(b), with perp(x, y) = (-y, x).
            let centre_x = lanes.mul(lanes.sub(lanes.mul(a_squared, by), lanes.mul(squared, ay)), half);
            let centre_y = lanes.mul(lanes.sub(lanes.mul(squared, ax), lanes.mul(a_squared, bx)), half);
            let distance = lanes.sqrt(squared_of(centre_x, centre_y));
            let pulled = constraints.holes(lanes, distance);
            // Triangles without area have no centre; by rounding, some have it at the sample.
            let is_there = lanes.less(distance, lanes.splat(f32::INFINITY));
            let is_apart = lanes.less(lanes.splat(0.0), distance);
            let pulled =
                |centre| lanes.only(is_hole, lanes.only(is_there, lanes.only(is_apart, lanes.mul(pulled, centre))));
            x = lanes.add(x, pulled(centre_x));
            y = lanes.add(y, pulled(centre_y));
        }
        let sum = |x| lanes.sum(lanes.only(is_one, x));
        Force { sum: Vec2::new(sum(x), sum(y)), clearance }
    }
}

/// The force on a sample that is not surrounded.
#[inline(never)]
fn pushed<G: Grading>(constraints: &Constraints, view: &View) -> Force {
    let push = |candidate: usize| {
        let offset = view.factor::<G>(candidate) * view.offset(candidate);
        constraints.push(offset, offset.length_squared())
    };
    Force { sum: (0..view.count()).map(push).sum(), clearance: FREE_CLEARANCE }
}

/// The lane numbers.
const FIRST: [f32; LANES] = {
    let mut numbers = [0.0; LANES];
    let mut lane = 0;
    while lane < LANES {
        numbers[lane] = lane as f32;
        lane += 1;
    }
    numbers
};

/// A triangle as the samples on it see it.
#[derive(Clone, Copy, Default)]
pub struct Local {
    corners: [[f32; 3]; 3],
    /// The axes of the plane of the triangle.
    pub axes: [Vec3; 2],
    /// The axes of the mean plane of the sample's surroundings: the rotation of this plane into that of the triangle
    /// takes them to `axes`.
    pub tangents: [Vec3; 2],
    /// The mean normal of the sample's surroundings, on the front side of the triangle; zero where there is none.
    normal: Vec3,
    /// The barycentrics that a displacement by a spacing along each axis adds.
    steps: [Vec2; 2],
}

impl Local {
    /// A triangle as seen by a sample with this mean normal.
    pub fn on(connected: &ConnectedMesh, spacing: f64, triangle: u32, normal: Vec3) -> Self {
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
    pub fn mean_normal(&self) -> Vec3 {
        self.normal
    }

    /// The normal of the triangle.
    pub fn normal(&self) -> Vec3 {
        self.axes[0].cross(self.axes[1])
    }

    /// The barycentrics after a displacement, in spacings along the axes, if they are still in the triangle.
    #[inline(always)]
    pub fn moved(&self, uv: DVec2, displacement: Vec2) -> Option<DVec2> {
        let moved = uv + (displacement.x * self.steps[0] + displacement.y * self.steps[1]).as_dvec2();
        (moved.x > 0.0 && moved.y > 0.0 && moved.x + moved.y < 1.0).then_some(moved)
    }

    /// The position of barycentrics, in the floats in which samples are returned: that of `Mesh::point`.
    #[inline(always)]
    pub fn position(&self, uv: DVec2) -> Position {
        let [u, v] = round_barycentrics(uv.into()).map(f64::from);
        let [a, b, c] = [exact(self.corners[0]), exact(self.corners[1]), exact(self.corners[2])];
        let [x, y, z] = ((1.0 - u - v) * a + u * b + v * c).as_vec3().to_array();
        [x, y, z, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use std::f32::consts::TAU;

    use crate::mesh::Mesh;
    use crate::rng::{Draw, Rng};
    use crate::simd::{Level, run};

    /// The force on the origin by points, and that by [`Constraints::force`] or the sum of all pushes.
    struct Both<'a>(&'a Constraints, &'a [Vec2]);

    impl Work for Both<'_> {
        type Out = ([Force; 2], bool);

        fn run<L: Lanes>(self, lanes: L) -> ([Force; 2], bool) {
            let mut view = View::default();
            self.1.iter().for_each(|point| view.add(point.extend(0.0)));
            view.project(lanes, [Vec3::X, Vec3::Y]);
            view.find_star(lanes, &mut Star::default());
            let (star, is_closed) = view.star();
            let ring: Vec<Vec2> = star.iter().map(|&neighbour| view.offset(neighbour.into())).collect();
            let expected = if is_closed { self.0.force(&ring) } else { pushed::<Even>(self.0, &view) };
            ([Ring::default().force(lanes, self.0, &view), expected], is_closed)
        }
    }

    #[test]
    fn forces_are_those_of_the_constraints_and_the_same_at_all_levels() {
        let (mut closed, mut many) = (0, 0);
        for case in 0..600 {
            let mut rng = Rng::at(8, Draw::Probe, &[case]);
            // Random points, and rings of many.
            let count = 1 + case as usize % 40;
            let point = |k: usize, x: f64, y: f64| match case % 3 {
                0 => Vec2::from_angle(k as f32 / count as f32 * TAU) * (0.8 + 1e-3 * x as f32),
                _ => Vec2::new(x as f32 - 0.5, y as f32 - 0.5) * (0.5 * (count as f32).sqrt()),
            };
            let points: Vec<Vec2> = (0..count).map(|k| point(k, rng.unit(), rng.unit())).collect();
            let constraints = Constraints::of_step(case as u32 % 90);
            let mut portable = None;
            for level in Level::available() {
                let ([force, expected], is_closed) = run(level, Both(&constraints, &points));
                let scale = 1.0 + expected.sum.length();
                assert!(force.sum.distance(expected.sum) < 1e-4 * scale, "{} {}", force.sum, expected.sum);
                assert!((force.clearance - expected.clearance).abs() < 1e-4);
                let bits = (force.sum.to_array().map(f32::to_bits), force.clearance.to_bits());
                assert_eq!(bits, *portable.get_or_insert(bits), "{level:?}");
                closed += usize::from(is_closed);
                many += usize::from(is_closed && case % 3 == 0 && count > LANES);
            }
        }
        assert!(closed > 300 && many > 50, "{closed} {many}");
    }

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
