//! A set of points under relaxation in a cuboid, or inside a mesh in it.

use crate::dcr::clustering::{EXCESS, is_clustered};
use crate::dcr::law::{Constraints, FREE_CLEARANCE, carried};
use crate::dcr::relaxation::Relaxation;
use crate::dcr::volume::inside::{Freedom, Inside, Near};
use crate::dcr::volume::lists::{Lists, lists};
use crate::dcr::volume::torus::{Place, VolumeTorus, packed, place};
use crate::error::Result;
use crate::index::curve::{SPACE_BITS, morton3, sorted};
use crate::job::{Job, chunks};
use crate::rng::{Draw, Rng};
use crate::simd::{LANES, Lanes, Level, Position, Work, run};

/// The distance by which points that coincide with others are moved, in spacings; and up to twice that.
const PARTING: f64 = 1e-3;

/// The distance beyond the reach of the forces up to which points are listed, in spacings.
const SKIN: f32 = 0.25;

/// The least square of a distance, so that it has a finite inverse.
const LEAST: f32 = f32::MIN_POSITIVE;

/// The conflict radius of the first step, in spacings. It closes holes, but cannot be satisfied by all pairs.
const FIRST_RADIUS: f64 = 1.1;

/// The conflict radius of the last of `FEW_STEPS` steps, and that of very many: by little below the radius at which random
/// packings jam, (.64 / .7405)^(1/3) = .9526 spacings for balls that fill .64 of the volume. Only crystals have larger ones.
const LAST_RADIUS: f64 = 0.945;
const FEW_STEPS: f64 = 100.0;
const JAMMED_RADIUS: f64 = 0.9519;

/// The share of the steps in which the conflict radius falls, of so few steps and of very many.
const FALL_OF_FEW: f64 = 0.7;
const FALL_OF_MANY: f64 = 0.85;

/// The displacement by a conflict of tension 1.
const PUSH: f32 = 0.5;

/// Up to this distance, in spacings, points push each other a little in the first steps, those of this share of all: from
/// behind, into holes. Without, the widest hole is .85 spacings in radius after 100 steps instead of .78.
const FAR_RADIUS: f32 = 1.3;
const FAR_PUSH: f32 = 0.1;
const FAR_SHARE: f64 = 0.7;

/// The directions in which a point is moved from where others are, one after the other, until one does not lead outside.
const PARTINGS: u64 = 16;

/// Moving points of a cuboid. They are in the order of a curve; the user's order is that of `order`.
pub struct VolumeRelaxation<'a> {
    torus: VolumeTorus,
    /// The inside of the mesh that they do not leave, if there is one.
    inside: Option<Inside<'a>>,
    level: Level,
    max_iterations: u32,
    seed: u64,
    /// The user's number of each point.
    order: Vec<u32>,
    /// The places of the points, and after them their images, and those of fixed points once more: where only one of two points
    /// moves, it is pushed twice as far.
    places: Vec<Position>,
    /// Memory for the next ones.
    next: Vec<Position>,
    velocities: Vec<[f32; 3]>,
    /// A bound on the distance of the surface of the mesh from each point.
    near: Vec<Near>,
    /// The number of steps made.
    steps: u32,
    lists: Vec<Lists>,
    /// The places of the points when they were listed.
    listed: Vec<Place>,
    /// The radius of the lists, and the longest way of a point since it was listed, in spacings.
    radius: f32,
    strayed: f32,
}

impl<'a> VolumeRelaxation<'a> {
    /// The points before the first of so many steps.
    pub fn new(torus: VolumeTorus, points: &[[f32; 3]], max_iterations: u32, seed: u64) -> Self {
        let mut set = Self {
            torus,
            inside: None,
            level: Level::widest(),
            max_iterations,
            seed,
            order: Vec::new(),
            places: Vec::new(),
            next: Vec::new(),
            velocities: vec![[0.0; 3]; points.len()],
            near: Vec::new(),
            steps: 0,
            lists: Vec::new(),
            listed: Vec::new(),
            radius: 0.0,
            strayed: f32::INFINITY,
        };
        set.put(points.iter().map(|&point| torus.enter(point)).collect());
        set
    }

    /// The same points, which do not leave the inside of a mesh.
    pub fn inside(self, inside: Inside<'a>) -> Self {
        Self { inside: Some(inside), ..self }
    }

    /// The points, in the user's order.
    pub fn points(&self) -> Vec<[f32; 3]> {
        let mut points = vec![[0.0; 3]; self.order.len()];
        for (&i, &at) in self.order.iter().zip(&self.places) {
            points[i as usize] = match &self.inside {
                None => self.torus.leave(place(at)),
                Some(inside) => inside.leave(i, place(at)),
            };
        }
        points
    }

    /// Puts all points at places, which are in the user's order.
    fn put(&mut self, places: Vec<Place>) {
        self.order = along_curve(&self.torus, &places).into_iter().map(|(_, i)| i).collect();
        self.places = self.order.iter().map(|&i| packed(places[i as usize])).collect();
        let images = self.torus.images().count();
        self.places.resize(places.len() * (1 + images), [0.0; 4]);
        if let Some(inside) = &self.inside {
            self.near = self.order.iter().map(|&i| Near::unknown(i, inside.freedom(i))).collect();
            let fixed = self.order.iter().filter(|&&i| inside.freedom(i) == Freedom::Fixed);
            self.places.extend(fixed.map(|&i| packed(places[i as usize])));
        }
        self.next = self.places.clone();
        self.mirror();
    }

    /// Moves images to where their points are.
    fn mirror(&mut self) {
        let count = self.order.len();
        let (points, images) = self.places.split_at_mut(count);
        for (images, by) in images.chunks_mut(count.max(1)).zip(self.torus.images()) {
            for (image, &point) in images.iter_mut().zip(&*points) {
                let at = place(point);
                *image = packed(std::array::from_fn(|axis| at[axis].wrapping_add(by[axis])));
            }
        }
    }

    /// The places in the user's order.
    fn given(&self) -> Vec<Place> {
        let mut places = vec![[0; 3]; self.order.len()];
        self.order.iter().zip(&self.places).for_each(|(&i, &at)| places[i as usize] = place(at));
        places
    }

    /// Other places for points of a cuboid that are heaped, in the user's order: those of the same rank along the curve of random
    /// ones.
    fn spread(&self, places: &[Place]) -> Option<Vec<Place>> {
        if self.inside.is_some() {
            return None;
        }
        let throw = |i: usize| {
            let mut rng = Rng::at(self.seed, Draw::Spread, &[i as u64]);
            self.torus.fraction([rng.unit(), rng.unit(), rng.unit()])
        };
        let thrown: Vec<Place> = (0..places.len()).map(throw).collect();
        let [own, random] = [places, &thrown].map(|all| along_curve(&self.torus, all));
        let [along, along_random] = [&own, &random].map(|all| all.iter().map(|&(at, _)| at).collect::<Vec<u64>>());
        is_clustered::<3>(&along, &along_random, 3 * SPACE_BITS, EXCESS).then(|| {
            let mut spread = places.to_vec();
            own.iter().zip(&random).for_each(|(from, to)| spread[from.1 as usize] = thrown[to.1 as usize]);
            spread
        })
    }

    /// Moves all but the first of coincident points, on which forces would have no direction. Those that are fixed come first, then
    /// those that slide.
    fn part(&self, places: &mut [Place]) {
        let freedom = |i: u32| self.inside.map_or(Freedom::Free, |inside| inside.freedom(i));
        let mut order: Vec<u32> = (0..places.len() as u32).collect();
        order.sort_unstable_by_key(|&i| (places[i as usize], freedom(i), i));
        let repeated = order.windows(2).filter(|pair| places[pair[0] as usize] == places[pair[1] as usize]);
        for i in repeated.map(|pair| pair[1]).filter(|&i| freedom(i) != Freedom::Fixed).collect::<Vec<_>>() {
            let mut rng = Rng::at(self.seed, Draw::Part, &[i.into()]);
            let from = places[i as usize];
            let parted = (0..PARTINGS).find_map(|_| {
                let step = direction(&mut rng);
                match &self.inside {
                    None => Some(self.torus.moved(from, step, self.torus.per_spacing()).0),
                    Some(inside) => inside.parted(i, from, step),
                }
            });
            places[i as usize] = parted.unwrap_or(from);
        }
    }

    /// The share of all steps that some are.
    fn share(&self, iterations: u32) -> f64 {
        f64::from(iterations) / f64::from(self.max_iterations)
    }

    /// A value for few steps and for many, at the number of steps of this set.
    fn between(&self, of_few: f64, of_many: f64) -> f64 {
        of_many + (of_few - of_many) * (FEW_STEPS / f64::from(self.max_iterations)).min(1.0)
    }

    /// The share of the steps in which the conflict radius falls.
    fn fall(&self) -> f64 {
        self.between(FALL_OF_FEW, FALL_OF_MANY)
    }

    /// The forces of a step.
    fn law(&self, iterations: u32) -> Law {
        let share = self.share(iterations);
        let last = self.between(LAST_RADIUS, JAMMED_RADIUS);
        let radius = FIRST_RADIUS + (last - FIRST_RADIUS) * (share / self.fall()).min(1.0);
        let repels = |conflict_radius: f32, push: f32| Constraints {
            conflict_radius,
            coverage_radius: f32::INFINITY,
            push,
            pull: 0.0,
        };
        let far = if share < FAR_SHARE { FAR_PUSH } else { 0.0 };
        Law { near: repels(radius as f32, PUSH), far: repels(FAR_RADIUS, far) }
    }

    /// Lists neighbours anew if a point may have come into the reach of another one.
    fn list(&mut self, job: &Job, reach: f32) -> Result<()> {
        if reach + 2.0 * self.strayed <= self.radius {
            return Ok(());
        }
        let places: Vec<Place> = self.places.iter().map(|&at| place(at)).collect();
        let (count, radius) = (self.order.len(), reach + SKIN);
        // Memory for one of both.
        (self.lists, self.strayed) = (Vec::new(), f32::INFINITY);
        self.lists = lists(job, &self.torus, self.level, &places, count, radius.into())?;
        (self.radius, self.strayed) = (radius, 0.0);
        self.listed = places;
        self.listed.truncate(count);
        Ok(())
    }
}

/// The way of a point that is moved from where another one is.
fn direction(rng: &mut Rng) -> [f32; 3] {
    // A direction in the ball, away from its centre.
    loop {
        let toward = [rng.unit(), rng.unit(), rng.unit()].map(|x| 2.0 * x - 1.0);
        let squared: f64 = toward.iter().map(|x| x * x).sum();
        if (0.01..1.0).contains(&squared) {
            let length = PARTING * (1.0 + rng.unit()) / squared.sqrt();
            return toward.map(|x| (x * length) as f32);
        }
    }
}

/// The places of points along a curve through the torus, in order, with their numbers.
fn along_curve(torus: &VolumeTorus, places: &[Place]) -> Vec<(u64, u32)> {
    let periods = torus.periods();
    let longest = periods.into_iter().fold(0.0, f64::max);
    let scales = periods.map(|period| period / longest * f64::from((1u32 << SPACE_BITS) - 1) / f64::from(u32::MAX));
    sorted(places.iter().map(|at| morton3(std::array::from_fn(|axis| (f64::from(at[axis]) * scales[axis]) as u32))))
}

impl Relaxation for VolumeRelaxation<'_> {
    type Position = Position;
    type Space = VolumeTorus;

    fn space(&self) -> VolumeTorus {
        self.torus
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = Position> {
        self.places[..self.order.len()].iter().copied()
    }

    fn begin(&mut self, job: &Job) -> Result<()> {
        job.report(0.0)?;
        let given = self.given();
        let mut places = self.spread(&given).unwrap_or(given);
        self.part(&mut places);
        job.report(1.0)?;
        self.put(places);
        Ok(())
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        let law = self.law(iteration);
        self.list(&job.part(0.0, 0.5), law.reach())?;
        let size = chunks(self.order.len()).size();
        let moves = self
            .lists
            .iter()
            .zip(self.listed.chunks(size))
            .zip(0..)
            .map(|((lists, listed), chunk)| (lists, listed, chunk * size));
        let moved = self.next.chunks_mut(size).zip(self.velocities.chunks_mut(size));
        // Of a cuboid there are none.
        let mut near = self.near.chunks_mut(size);
        let moves = moves.zip(moved).map(|((lists, listed, first), (next, velocities))| Moves {
            torus: &self.torus,
            inside: self.inside.as_ref().zip(near.next()),
            law,
            places: &self.places,
            lists,
            listed,
            first,
            next,
            velocities,
        });
        let level = self.level;
        let strayed = job.context().run(None, |whole| whole.map_each(moves.collect(), |moves| run(level, moves)))?;
        self.strayed = strayed.into_iter().fold(0.0, f32::max).sqrt();
        std::mem::swap(&mut self.places, &mut self.next);
        self.mirror();
        self.steps += 1;
        Ok(())
    }

    /// Before its fall ends, each smaller conflict radius could move points again.
    fn has_converged(&self, is_at_rest: bool) -> bool {
        is_at_rest && self.share(self.steps) >= self.fall()
    }
}

/// The forces of a step: those of two conflict radii.
#[derive(Clone, Copy)]
struct Law {
    near: Constraints,
    far: Constraints,
}

impl Law {
    /// The distance up to which points push each other.
    fn reach(&self) -> f32 {
        if self.far.push > 0.0 { self.far.conflict_radius } else { self.near.conflict_radius }
    }

    /// The factors of the offsets of points at these distances: without conflict 0.
    #[inline(always)]
    fn pushes<L: Lanes>(&self, lanes: L, distance: L::Floats) -> L::Floats {
        let [near, far] = [self.near.conflicts(lanes, distance), self.far.conflicts(lanes, distance)];
        let none = lanes.splat(0.0);
        lanes.add(lanes.min(near, none), lanes.min(far, none))
    }
}

/// A step of points that follow each other.
struct Moves<'a> {
    torus: &'a VolumeTorus,
    inside: Option<(&'a Inside<'a>, &'a mut [Near])>,
    law: Law,
    places: &'a [Position],
    lists: &'a Lists,
    /// The places in which they were listed.
    listed: &'a [Place],
    /// The number of the first.
    first: usize,
    next: &'a mut [Position],
    velocities: &'a mut [[f32; 3]],
}

impl Work for Moves<'_> {
    /// The longest squared way of a point since it was listed.
    type Out = f32;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f32 {
        let Self { torus, mut inside, law, places, lists, listed, first, next, velocities } = self;
        let (unit, per_spacing) = (torus.unit().map(|unit| unit as f32), torus.per_spacing());
        let (mut strayed, mut number) = (0f32, 0);
        let points = places[first..].iter().zip(lists.iter()).zip(listed);
        for (((&at, list), from), (next, velocity)) in points.zip(next.iter_mut().zip(velocities)) {
            let near = inside.as_mut().map(|(inside, near)| (*inside, &mut near[number]));
            number += 1;
            if near.as_ref().is_some_and(|(_, near)| near.freedom == Freedom::Fixed) {
                *next = at;
                continue;
            }
            let force = force(lanes, places, at, list, unit, &law);
            *velocity = carried(*velocity, force, FREE_CLEARANCE);
            let to = match near {
                None => {
                    let (to, held) = torus.moved(place(at), *velocity, per_spacing);
                    let mut axis = 0;
                    while axis < 3 {
                        if held[axis] {
                            velocity[axis] = 0.0;
                        }
                        axis += 1;
                    }
                    to
                }
                Some((inside, near)) => inside.moved(place(at), velocity, near),
            };
            *next = packed(to);
            let mut squared = 0.0;
            let mut axis = 0;
            while axis < 3 {
                let way = to[axis].wrapping_sub(from[axis]).cast_signed() as f32 * unit[axis];
                squared += way * way;
                axis += 1;
            }
            strayed = strayed.max(squared);
        }
        strayed
    }
}

/// The force on a point by all others of its list that conflict with it.
#[inline(always)]
fn force<L: Lanes>(
    lanes: L,
    places: &[Position],
    at: Position,
    list: &[[u32; LANES]],
    unit: [f32; 3],
    law: &Law,
) -> [f32; 3] {
    let [x, y, z] = place(at);
    let here = [lanes.splat_int(x.cast_signed()), lanes.splat_int(y.cast_signed()), lanes.splat_int(z.cast_signed())];
    let mut sums = [lanes.splat(0.0); 3];
    for names in list {
        let [x, y, z] = lanes.gather(places, names);
        let x = offset(lanes, x, here[0], unit[0]);
        let y = offset(lanes, y, here[1], unit[1]);
        let z = offset(lanes, z, here[2], unit[2]);
        let squared = lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z));
        let distance = lanes.sqrt(lanes.max(squared, lanes.splat(LEAST)));
        // The offset of a point from itself is 0.
        let pushed = law.pushes(lanes, distance);
        sums[0] = lanes.add(sums[0], lanes.mul(pushed, x));
        sums[1] = lanes.add(sums[1], lanes.mul(pushed, y));
        sums[2] = lanes.add(sums[2], lanes.mul(pushed, z));
    }
    [lanes.sum(sums[0]), lanes.sum(sums[1]), lanes.sum(sums[2])]
}

/// The offsets of gathered coordinates from one, in spacings. They are bits of integers.
#[inline(always)]
fn offset<L: Lanes>(lanes: L, there: L::Floats, here: L::Ints, unit: f32) -> L::Floats {
    lanes.mul(lanes.floats(lanes.sub_ints(lanes.float_bits(there), here)), lanes.splat(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::relaxation::Space;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};

    /// The force of all others on a point in `f64`, with all images of them that are within its reach, and the nearest only
    /// where the torus is thin.
    fn all_pairs(set: &VolumeRelaxation, law: &Law, point: usize, extent: [f64; 3], boundary: Boundary) -> [f64; 3] {
        let at = |i: usize| {
            let place = place(set.places[i]);
            [0, 1, 2].map(|axis| f64::from(place[axis]) * set.torus.unit()[axis])
        };
        let (here, mut sum) = (at(point), [0.0; 3]);
        let turns = |axis: usize| match boundary {
            Boundary::Periodic if extent[axis] > 0.8 => {
                let most = (1.0 + 1.5 / extent[axis]) as i32;
                -most..most + 1
            }
            _ => 0..1,
        };
        for other in (0..set.order.len()).filter(|&other| other != point) {
            for (x, y, z) in turns(0).flat_map(|x| turns(1).flat_map(move |y| turns(2).map(move |z| (x, y, z)))) {
                let there = at(other);
                let offset: [f64; 3] = std::array::from_fn(|axis| {
                    let offset = there[axis] - here[axis];
                    match boundary {
                        Boundary::Periodic if extent[axis] < 0.8 => {
                            offset - extent[axis] * (offset / extent[axis]).round()
                        }
                        _ => offset + f64::from([x, y, z][axis]) * extent[axis],
                    }
                });
                let distance = offset.iter().map(|x| x * x).sum::<f64>().sqrt();
                for one in [law.near, law.far] {
                    let (radius, push) = (f64::from(one.conflict_radius), f64::from(one.push));
                    let pushed = (push * (radius.recip() - distance.recip())).min(0.0);
                    (0..3).for_each(|axis| sum[axis] += pushed * offset[axis]);
                }
            }
        }
        sum
    }

    /// On a torus, on one of a few periods, on thin ones, and in a box; with forces that reach far and with those that do not;
    /// and from lists that are some steps old.
    #[test]
    fn a_step_moves_points_by_the_forces_of_all_pairs() {
        let context = Context::new(1).unwrap();
        for (max, count, boundary) in [
            ([1.0, 1.0, 1.0], 120, Boundary::Periodic),
            ([1.0, 1.0, 1.0], 2, Boundary::Periodic),
            ([1.0, 0.9, 0.3], 7, Boundary::Periodic),
            ([4.0, 5.0, 0.1], 50, Boundary::Periodic),
            ([0.01, 5.0, 0.1], 50, Boundary::Periodic),
            ([1.0, 1.0, 2.0], 90, Boundary::Bounded),
            ([3.0, 0.2, 2.0], 9, Boundary::Bounded),
        ] {
            let domain = Domain { min: [0.0; 3], max, boundary };
            let mut rng = Rng::at(6, Draw::Probe, &[]);
            let points: Vec<[f32; 3]> =
                (0..count).map(|_| max.map(|length| (rng.unit() * 0.999 * length) as f32)).collect();
            let torus = VolumeTorus::new(domain, count);
            let mut set = VolumeRelaxation::new(torus, &points, 10, 1);
            context.run(None, |job| set.begin(job)).unwrap();
            let extent = torus.extent();
            for iteration in 0..10 {
                let law = set.law(iteration);
                let (before, velocities) = (set.places.clone(), set.velocities.clone());
                let forces: Vec<_> = (0..count).map(|i| all_pairs(&set, &law, i, extent, boundary)).collect();
                context.run(None, |job| set.step(job, iteration)).unwrap();
                for i in 0..count {
                    let velocity = carried(velocities[i], forces[i].map(|x| x as f32), FREE_CLEARANCE);
                    let (to, _) = torus.moved(place(before[i]), velocity, torus.per_spacing());
                    let missed = torus.distance_squared(packed(to), set.places[i]).sqrt();
                    assert!(missed < 2e-5, "{max:?} {count} {boundary:?}, step {iteration}, point {i}: {missed}");
                }
            }
        }
    }

    #[test]
    fn all_levels_make_the_same_steps() {
        let context = Context::new(1).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let mut rng = Rng::at(7, Draw::Probe, &[]);
            let points: Vec<[f32; 3]> =
                (0..500).map(|_| [rng.unit(), rng.unit(), rng.unit()].map(|x| x as f32 * 0.999)).collect();
            let run = |level: Level| {
                let mut set = VolumeRelaxation::new(VolumeTorus::new(Domain::unit(boundary), 500), &points, 20, 1);
                set.level = level;
                context.run(None, |job| set.begin(job)).unwrap();
                (0..20).for_each(|iteration| context.run(None, |job| set.step(job, iteration)).unwrap());
                set.points()
            };
            for level in Level::available() {
                assert_eq!(run(level), run(Level::Portable), "{level:?}");
            }
        }
    }
}
