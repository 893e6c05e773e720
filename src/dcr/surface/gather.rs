//! The moves that samples want to make in a step.

use glam::{Vec2, Vec3};

use crate::dcr::ground::constraints::{Constraints, Force, MOMENTUM, SAFE_FRACTION};
use crate::dcr::surface::apart::{Contacts, Limits, NEAR};
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::forces::Ring;
use crate::dcr::surface::lists::List;
use crate::dcr::surface::local::Local;
use crate::dcr::surface::view::{Star, View};
use crate::dcr::surface::walk::{SurfacePoint, walk};
use crate::simd::{Lanes, Position, Work};

/// What lengths in `f32` may be wrong by, with room to spare.
const ROUNDING: f32 = 1.0 + 1e-5;

/// A sample comes to rest where no force acts on it and its last move was shorter than this, in spacings.
const CALM: f32 = 1e-3;

/// A sample that moves farther than this in a step, in spacings, wakes those around it.
const STIRRING: f32 = 5e-3;

/// A sample on the way.
#[derive(Clone, Copy, Default)]
pub(super) struct Mover {
    pub(super) place: SurfacePoint,
    /// In the plane of its triangle and in spacings.
    pub(super) velocity: Vec2,
    pub(super) star: Star,
    /// The number of steps for which it stays at rest.
    pub(super) rest: u8,
}

/// A move that may end too close to another sample, and what it began with.
pub(super) struct Doubtful {
    pub(super) sample: u32,
    pub(super) place: SurfacePoint,
    /// What it kept of the triangle that it has left.
    pub(super) left: Option<Box<Local>>,
}

/// What is left to be done after moves.
#[derive(Default)]
pub(super) struct Aftermath {
    pub(super) doubtful: Vec<Doubtful>,
    /// The samples that wake those around them.
    pub(super) stirring: Vec<u32>,
}

/// The state of all samples that is read while they move, and the rules of the step.
pub(super) struct Situation<'a> {
    pub(super) connected: &'a ConnectedMesh<'a>,
    pub(super) positions: &'a [Position],
    pub(super) lists: &'a [List],
    pub(super) spacing: f64,
    /// 1 over a spacing.
    pub(super) unit: f32,
    /// The least distance of samples, in spacings.
    pub(super) floor: f32,
    pub(super) constraints: Constraints,
    pub(super) limits: Limits,
    /// The largest displacement, in spacings.
    pub(super) stride: f32,
    /// The number of steps for which samples rest that come to rest.
    pub(super) rest: u8,
}

/// The moves of consecutive samples, each made as it is wanted.
pub(super) struct Moves<'a> {
    pub(super) situation: &'a Situation<'a>,
    /// The number of the first sample.
    pub(super) first: usize,
    pub(super) movers: &'a mut [Mover],
    pub(super) locals: &'a mut [Local],
    /// The positions in which samples want to end.
    pub(super) wanted: &'a mut [Position],
}

impl Work for Moves<'_> {
    type Out = Aftermath;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Aftermath {
        let (mut view, mut ring, mut contacts) = (View::default(), Ring::default(), Contacts::default());
        let mut after = Aftermath::default();
        let situation = self.situation;
        let mut k = 0;
        while k < self.movers.len() {
            let (sample, mover, local) = (self.first + k, &mut self.movers[k], &mut self.locals[k]);
            if mover.rest > 0 {
                mover.rest -= 1;
                self.wanted[k] = situation.positions[sample];
                k += 1;
                continue;
            }
            let (from, list) = (situation.positions[sample], &situation.lists[sample]);
            let count = list.show(lanes, from, situation.positions, situation.unit, situation.connected, &mut view);
            view.project(lanes, local.tangents);
            view.find_star(lanes, &mut mover.star);
            let Force { sum, clearance } = ring.force(lanes, &situation.constraints, &view);
            let velocity = MOMENTUM * mover.velocity + sum;
            let wanted = velocity.clamp_length_max((SAFE_FRACTION * clearance).min(situation.stride));
            let reach = situation.limits.near + 2.0 * wanted.length();
            let close = view.nearer(lanes, count, reach * reach);
            let mut nearest = view.least_squared(lanes, count);
            contacts.clear();
            let mut bits = close;
            while bits != 0 {
                let offset = view.offset_in_space(bits.trailing_zeros() as usize);
                contacts.add(local.axes, offset, situation.limits.near);
                bits &= bits - 1;
            }
            for &other in list.others() {
                let offset = situation.offset(from, other);
                let squared = offset.length_squared();
                nearest = nearest.min(squared);
                if squared < reach * reach {
                    contacts.add(local.axes, offset, situation.limits.far);
                }
            }
            let held_off = contacts.hold_off(wanted).clamp_length_max(situation.stride);
            let place = mover.place;
            let left = situation.displace(mover, local, held_off);
            let to = local.position(mover.place.uv);
            self.wanted[k] = to;
            let length = situation.length(from, to);
            // Two samples of which each has moved by no more than half of what it was farther away from the nearest
            // other one than the floor are no closer than the floor.
            if length > 0.0 && nearest.sqrt() < (situation.floor + 2.0 * length) * ROUNDING {
                after.doubtful.push(Doubtful { sample: sample as u32, place, left });
            }
            // Whom others hold off, now or when limits have grown, has no rest.
            if situation.rest > 0 && sum == Vec2::ZERO && length < CALM && nearest >= NEAR * NEAR {
                (mover.rest, mover.velocity) = (situation.rest, Vec2::ZERO);
            } else if length > STIRRING {
                after.stirring.push(sample as u32);
            }
            k += 1;
        }
        after
    }
}

impl Situation<'_> {
    /// The offset of another sample, in spacings.
    fn offset(&self, from: Position, other: u32) -> Vec3 {
        offset(from, self.positions[other as usize]) * self.unit
    }

    /// The distance of two positions, in spacings.
    #[inline(always)]
    pub(super) fn length(&self, from: Position, to: Position) -> f32 {
        (offset(from, to) * self.unit).length()
    }

    /// Moves a sample by a displacement in the plane of its triangle. Returns what it kept of this if it has left it.
    #[inline(always)]
    fn displace(&self, mover: &mut Mover, local: &mut Local, displacement: Vec2) -> Option<Box<Local>> {
        let Some(uv) = local.moved(mover.place.uv, displacement) else { return self.walk(mover, local, displacement) };
        (mover.place.uv, mover.velocity) = (uv, displacement);
        None
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
