//! The tangent plane of one sample: the candidates for its neighbours there, and its Delaunay star among them.
//!
//! Offsets are divided by the square of their length: of the points that this makes, those of the star are on the
//! convex hull (the inversion that maps circles through the sample to straight lines). So a star that is kept from the
//! step before is still right if no point is outside any of its edges, which takes a few products per edge. Only
//! otherwise is the star found again, by gift wrapping (McLain 1976, "Two dimensional interpolation from random data").

use glam::{Vec2, Vec3};

use crate::dcr::surface::grading::{Grading, between};
use crate::simd::{LANES, Lanes};

/// The largest number of candidates.
pub const MOST: usize = 48;

/// The number of vectors of candidates.
const VECTORS: usize = MOST / LANES;

/// The largest number of neighbours of a star that is kept.
const KEPT: usize = 15;

/// A value for each candidate.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct PerCandidate([f32; MOST]);

impl PerCandidate {
    const ZERO: Self = Self([0.0; MOST]);

    #[inline(always)]
    fn of(&self, candidate: usize) -> f32 {
        self.0[candidate]
    }

    /// Sixteen candidates.
    #[inline(always)]
    fn vector(&self, vector: usize) -> &[f32; LANES] {
        &self.0.as_chunks().0[vector]
    }

    #[inline(always)]
    fn vector_mut(&mut self, vector: usize) -> &mut [f32; LANES] {
        &mut self.0.as_chunks_mut().0[vector]
    }
}

/// The star of a sample: its neighbours counter-clockwise, by the number of the candidate.
#[derive(Clone, Copy, Default)]
pub struct Star {
    /// 0 if it is not known, or has too many neighbours to be kept.
    count: u8,
    ring: [u8; KEPT],
}

/// The tangent plane of one sample after the other.
pub struct View {
    /// The number of candidates.
    count: usize,
    /// The offsets of the candidates in space, in spacings of the sample; 0, which stands for none, beyond the last.
    offsets: [PerCandidate; 3],
    /// Where grades vary, the factor that takes these to the mean of the two spacings.
    factors: PerCandidate,
    /// The squared lengths of the offsets in space.
    squared: PerCandidate,
    /// The offsets in the plane.
    plane: [PerCandidate; 2],
    /// The offsets in the plane over their squared lengths; 0 for a sample at the same position, which has no
    /// direction.
    inverted: [PerCandidate; 2],
    /// The star, and true if it surrounds the sample.
    ring: [u8; MOST],
    length: usize,
    is_closed: bool,
}

impl Default for View {
    fn default() -> Self {
        let zero = PerCandidate::ZERO;
        Self {
            count: 0,
            offsets: [zero; 3],
            factors: zero,
            squared: zero,
            plane: [zero; 2],
            inverted: [zero; 2],
            ring: [0; MOST],
            length: 0,
            is_closed: false,
        }
    }
}

impl View {
    /// Forgets all candidates.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds the first `count` of sixteen candidates, by their offsets in spacings; the rest must be 0. All before them
    /// must be whole vectors.
    #[inline(always)]
    pub fn add_vector<L: Lanes>(&mut self, lanes: L, offsets: [L::Floats; 3], count: usize) {
        let vector = self.count / LANES;
        lanes.store(offsets[0], self.offsets[0].vector_mut(vector));
        lanes.store(offsets[1], self.offsets[1].vector_mut(vector));
        lanes.store(offsets[2], self.offsets[2].vector_mut(vector));
        self.count += count;
    }

    /// Notes the grades of sixteen candidates from the first of a vector on, beside that of the sample itself.
    #[inline(always)]
    pub fn grade_vector<G: Grading>(&mut self, vector: usize, own: f32, grades: [f32; LANES]) {
        *self.factors.vector_mut(vector) = grades.map(|other| own * between::<G>(own, other));
    }

    /// Adds a candidate of this grade, one of [`MOST`] at most.
    pub fn add_graded<G: Grading>(&mut self, offset: Vec3, own: f32, other: f32) {
        if G::VARIES {
            self.factors.vector_mut(self.count / LANES)[self.count % LANES] = own * between::<G>(own, other);
        }
        self.add(offset);
    }

    /// Adds a candidate, one of [`MOST`] at most.
    pub fn add(&mut self, offset: Vec3) {
        let (vector, lane) = (self.count / LANES, self.count % LANES);
        for axis in 0..3 {
            let offsets = self.offsets[axis].vector_mut(vector);
            if lane == 0 {
                *offsets = [0.0; LANES];
            }
            offsets[lane] = offset[axis];
        }
        self.count += 1;
    }

    /// Projects the candidates into the plane of these axes, without changing their distance.
    #[inline(always)]
    pub fn project<L: Lanes>(&mut self, lanes: L, axes: [Vec3; 2]) {
        let zero = lanes.splat(0.0);
        let mut vector = 0;
        while vector < self.vectors() {
            let x = lanes.load(self.offsets[0].vector(vector));
            let y = lanes.load(self.offsets[1].vector(vector));
            let z = lanes.load(self.offsets[2].vector(vector));
            let u = Self::along(lanes, axes[0], x, y, z);
            let v = Self::along(lanes, axes[1], x, y, z);
            let squared = lanes.add(lanes.add(lanes.mul(x, x), lanes.mul(y, y)), lanes.mul(z, z));
            let planar = lanes.add(lanes.mul(u, u), lanes.mul(v, v));
            // (u, v) / |(u, v)| over the distance.
            let lengths = lanes.mul(squared, planar);
            let scale = lanes.only(lanes.less(zero, lengths), lanes.div(lanes.splat(1.0), lanes.sqrt(lengths)));
            let (u, v) = (lanes.mul(u, scale), lanes.mul(v, scale));
            lanes.store(squared, self.squared.vector_mut(vector));
            lanes.store(u, self.inverted[0].vector_mut(vector));
            lanes.store(v, self.inverted[1].vector_mut(vector));
            lanes.store(lanes.mul(u, squared), self.plane[0].vector_mut(vector));
            lanes.store(lanes.mul(v, squared), self.plane[1].vector_mut(vector));
            vector += 1;
        }
    }

    #[inline(always)]
    fn along<L: Lanes>(lanes: L, axis: Vec3, x: L::Floats, y: L::Floats, z: L::Floats) -> L::Floats {
        let xy = lanes.add(lanes.mul(x, lanes.splat(axis.x)), lanes.mul(y, lanes.splat(axis.y)));
        lanes.add(xy, lanes.mul(z, lanes.splat(axis.z)))
    }

    /// The number of vectors.
    #[inline(always)]
    fn vectors(&self) -> usize {
        self.count.div_ceil(LANES)
    }

    /// The number of candidates.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The offset of a candidate in space, in the mean of the two spacings.
    #[inline(always)]
    pub fn offset_in_space<G: Grading>(&self, candidate: usize) -> Vec3 {
        let offset = Vec3::from_array([0, 1, 2].map(|axis: usize| self.offsets[axis].of(candidate)));
        self.factor::<G>(candidate) * offset
    }

    /// The factor that takes the offset of a candidate to the mean of the two spacings.
    #[inline(always)]
    pub fn factor<G: Grading>(&self, candidate: usize) -> f32 {
        if G::VARIES { self.factors.of(candidate) } else { 1.0 }
    }

    /// The squared distances of sixteen candidates, in the mean of the two spacings.
    #[inline(always)]
    fn relative<L: Lanes, G: Grading>(&self, lanes: L, vector: usize) -> L::Floats {
        let squared = lanes.load(self.squared.vector(vector));
        if !G::VARIES {
            return squared;
        }
        let factors = lanes.load(self.factors.vector(vector));
        lanes.mul(squared, lanes.mul(factors, factors))
    }

    /// The offset of a candidate in the plane, in spacings.
    #[inline(always)]
    pub fn offset(&self, candidate: usize) -> Vec2 {
        Vec2::new(self.plane[0].of(candidate), self.plane[1].of(candidate))
    }

    #[inline(always)]
    fn inverted(&self, candidate: usize) -> Vec2 {
        Vec2::new(self.inverted[0].of(candidate), self.inverted[1].of(candidate))
    }

    /// The square of the least distance of the first `count` candidates, in the mean of the two spacings; infinite for
    /// none.
    #[inline(always)]
    pub fn least_squared<L: Lanes, G: Grading>(&self, lanes: L, count: usize) -> f32 {
        let mut least = lanes.splat(f32::INFINITY);
        let mut vector = 0;
        while vector * LANES < count {
            let squared = self.relative::<L, G>(lanes, vector);
            let is_one = lanes.less(lanes.load(&NUMBERS[vector]), lanes.splat(count as f32));
            least = lanes.min(least, lanes.select(is_one, squared, lanes.splat(f32::INFINITY)));
            vector += 1;
        }
        lanes.least(least)
    }

    /// The candidates, of the first `count`, whose squared distance in the mean of the two spacings is less than
    /// `limit`, as bits.
    #[inline(always)]
    pub fn nearer<L: Lanes, G: Grading>(&self, lanes: L, count: usize, limit: f32) -> u64 {
        let mut near = 0;
        let mut vector = 0;
        while vector * LANES < count {
            let squared = self.relative::<L, G>(lanes, vector);
            near |= u64::from(lanes.bits(lanes.less(squared, lanes.splat(limit)))) << (vector * LANES);
            vector += 1;
        }
        near & ((1 << count) - 1)
    }

    /// Finds the star: the kept one if it is still right, or a new one, which is kept.
    #[inline(always)]
    pub fn find_star<L: Lanes>(&mut self, lanes: L, kept: &mut Star) {
        let count = usize::from(kept.count);
        if count > 0 && self.is_star(lanes, &kept.ring[..count]) {
            self.ring[..KEPT].copy_from_slice(&kept.ring);
            (self.length, self.is_closed) = (count, true);
        } else {
            self.wrap(lanes);
            kept.count = 0;
            if self.is_closed && self.length <= KEPT {
                kept.count = self.length as u8;
                kept.ring.copy_from_slice(&self.ring[..KEPT]);
            }
        }
    }

    /// True if a ring is the star, and closed: no candidate, nor the sample itself, is outside any of its edges.
    #[inline(always)]
    fn is_star<L: Lanes>(&self, lanes: L, ring: &[u8]) -> bool {
        match self.vectors() {
            1 => self.is_star_of::<L, 1>(lanes, ring),
            2 => self.is_star_of::<L, 2>(lanes, ring),
            _ => self.is_star_of::<L, VECTORS>(lanes, ring),
        }
    }

    /// [`View::is_star`] for this number of vectors.
    #[inline(always)]
    fn is_star_of<L: Lanes, const N: usize>(&self, lanes: L, ring: &[u8]) -> bool {
        let mut points = [[lanes.splat(0.0); 2]; N];
        let mut vector = 0;
        while vector < N {
            points[vector] = [lanes.load(self.inverted[0].vector(vector)), lanes.load(self.inverted[1].vector(vector))];
            vector += 1;
        }
        let (mut least, mut is_around) = (lanes.splat(0.0), true);
        let mut from = self.inverted(ring[ring.len() - 1].into());
        for &next in ring {
            let to = self.inverted(next.into());
            let edge = to - from;
            is_around &= from.perp_dot(to) > 0.0;
            let (x, y) = (lanes.splat(from.x), lanes.splat(from.y));
            let (along_x, along_y) = (lanes.splat(edge.x), lanes.splat(edge.y));
            let mut vector = 0;
            while vector < N {
                let [u, v] = [lanes.sub(points[vector][0], x), lanes.sub(points[vector][1], y)];
                // For the ends of the edge it is exactly 0, as nothing is contracted.
                let sine = lanes.sub(lanes.mul(along_x, v), lanes.mul(along_y, u));
                least = lanes.min(sine, least);
                vector += 1;
            }
            from = to;
        }
        is_around && lanes.bits(lanes.less(least, lanes.splat(0.0))) == 0
    }

    /// Finds the star by gift wrapping, from the nearest candidate on: the next neighbour counter-clockwise is the
    /// candidate that sees the edge to the last under the largest angle. Where neighbours leave a gap of a half turn or
    /// more, the ring begins after the gap and is not closed.
    #[inline(always)]
    pub fn wrap<L: Lanes>(&mut self, lanes: L) {
        (self.length, self.is_closed) = (0, false);
        let is_somewhere = |&candidate: &usize| self.inverted(candidate) != Vec2::ZERO;
        let order = |&a: &usize, &b: &usize| self.squared.of(a).total_cmp(&self.squared.of(b));
        let Some(nearest) = (0..self.count).filter(is_somewhere).min_by(order) else { return };
        let mut last = nearest;
        loop {
            self.ring[self.length] = last as u8;
            self.length += 1;
            match self.following(lanes, last, 1.0) {
                Some(next) if next == nearest => {
                    self.is_closed = true;
                    return;
                }
                // Rounding can hide the first neighbour among others on one circle.
                Some(next) if self.length < self.count => last = next,
                _ => break,
            }
        }
        let mut first = nearest;
        while self.length < self.count
            && let Some(before) = self.following(lanes, first, -1.0).filter(|&before| !self.has(before))
        {
            self.ring.copy_within(..self.length, 1);
            self.ring[0] = before as u8;
            self.length += 1;
            first = before;
        }
    }

    #[inline(always)]
    fn has(&self, candidate: usize) -> bool {
        self.ring[..self.length].contains(&(candidate as u8))
    }

    /// The neighbour after this one: counter-clockwise for a `turn` of 1, clockwise for -1.
    #[inline(always)]
    fn following<L: Lanes>(&self, lanes: L, last: usize, turn: f32) -> Option<usize> {
        let offset = self.offset(last);
        let (x, y) = (lanes.splat(offset.x), lanes.splat(offset.y));
        let infinite = lanes.splat(f32::INFINITY);
        let mut cotangents = [infinite; VECTORS];
        let mut least = infinite;
        let mut vector = 0;
        while vector < self.vectors() {
            let u = lanes.load(self.plane[0].vector(vector));
            let v = lanes.load(self.plane[1].vector(vector));
            let sine = lanes.mul(lanes.splat(turn), lanes.sub(lanes.mul(x, v), lanes.mul(y, u)));
            // |b|² - a·b, of the candidate b seen from the last neighbour a; falls with the angle at b.
            let here = lanes.load(self.squared.vector(vector));
            let cosine = lanes.sub(here, lanes.add(lanes.mul(x, u), lanes.mul(y, v)));
            let is_ahead = lanes.less(lanes.splat(0.0), sine);
            cotangents[vector] = lanes.select(is_ahead, lanes.div(cosine, sine), infinite);
            least = lanes.min(least, cotangents[vector]);
            vector += 1;
        }
        let least = lanes.least(least);
        let beyond = lanes.splat(least);
        let mut vector = 0;
        while least < f32::INFINITY && vector < self.vectors() {
            let more = lanes.bits(lanes.less(beyond, cotangents[vector]));
            let lane = (!more).trailing_zeros() as usize;
            if lane < LANES {
                return Some(vector * LANES + lane);
            }
            vector += 1;
        }
        None
    }

    /// The neighbours, counter-clockwise, and true if they surround the sample.
    #[inline(always)]
    pub fn star(&self) -> (&[u8], bool) {
        (&self.ring[..self.length], self.is_closed)
    }
}

/// The candidate numbers.
const NUMBERS: [[f32; LANES]; VECTORS] = {
    let mut numbers = [[0.0; LANES]; VECTORS];
    let mut candidate = 0;
    while candidate < MOST {
        numbers[candidate / LANES][candidate % LANES] = candidate as f32;
        candidate += 1;
    }
    numbers
};

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};
    use crate::simd::{Level, Work, run};

    /// The neighbours by definition: those in a triangle with the centre whose circumcircle holds no point.
    fn neighbours(points: &[Vec2]) -> Vec<usize> {
        let is_empty = |a: Vec2, b: Vec2| {
            let [a, b] = [a, b].map(|point| point.as_dvec2());
            let centre = (b.length_squared() * a.perp() - a.length_squared() * b.perp()) / (2.0 * a.perp_dot(b));
            let others = points.iter().map(|point| point.as_dvec2()).filter(|&point| point != a && point != b);
            let others: Vec<_> = others.collect();
            others.iter().all(|point| point.distance(centre) > centre.length())
        };
        let is_neighbour =
            |&point: &usize| (0..points.len()).any(|other| other != point && is_empty(points[point], points[other]));
        (0..points.len()).filter(is_neighbour).collect()
    }

    /// Finds the star of points, after the star that is kept.
    struct Find<'a>(&'a [Vec2], &'a mut Star);

    impl Work for Find<'_> {
        type Out = (Vec<usize>, bool);

        fn run<L: Lanes>(self, lanes: L) -> (Vec<usize>, bool) {
            let mut view = View::default();
            self.0.iter().for_each(|point| view.add(point.extend(0.0)));
            view.project(lanes, [Vec3::X, Vec3::Y]);
            view.find_star(lanes, self.1);
            (view.star().0.iter().map(|&neighbour| neighbour.into()).collect(), view.star().1)
        }
    }

    /// The star, which is the same at all levels.
    fn star_after(points: &[Vec2], kept: &mut Star) -> (Vec<usize>, bool) {
        let found = Level::available().into_iter().map(|level| {
            let mut kept = *kept;
            (run(level, Find(points, &mut kept)), kept)
        });
        let found: Vec<_> = found.collect();
        assert!(found.iter().all(|other| other.0 == found[0].0));
        *kept = found[0].1;
        found[0].0.clone()
    }

    fn star(points: &[Vec2]) -> (Vec<usize>, bool) {
        star_after(points, &mut Star::default())
    }

    #[test]
    fn the_star_is_that_of_the_delaunay_triangulation() {
        let (mut closed, mut open) = (0, 0);
        for case in 0..400 {
            let mut rng = Rng::at(5, Draw::Probe, &[case]);
            let count = 2 + case as usize % 25;
            let points: Vec<Vec2> =
                (0..count).map(|_| Vec2::new(rng.unit() as f32 - 0.5, rng.unit() as f32 - 0.5)).collect();
            let (ring, is_closed) = star(&points);
            let mut sorted = ring.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, neighbours(&points), "{points:?}");
            let turns_left = |pair: [usize; 2]| points[pair[0]].perp_dot(points[pair[1]]) > 0.0;
            assert!(ring.windows(2).all(|pair| turns_left([pair[0], pair[1]])));
            assert_eq!(is_closed, turns_left([ring[ring.len() - 1], ring[0]]) && ring.len() > 2);
            (closed, open) = if is_closed { (closed + 1, open) } else { (closed, open + 1) };
        }
        assert!(closed > 100 && open > 20, "{closed} closed, {open} open");
    }

    #[test]
    fn few_points_leave_a_gap() {
        assert_eq!(star(&[]), (vec![], false));
        assert_eq!(star(&[Vec2::X]), (vec![0], false));
        assert!(!star(&[Vec2::X, -Vec2::X]).1);
        assert_eq!(star(&[Vec2::Y, Vec2::X]), (vec![1, 0], false));
    }

    #[test]
    fn a_star_is_kept_while_it_is_right_and_no_longer() {
        let (mut kept, mut found_anew) = (0, 0);
        for case in 0..100 {
            let mut rng = Rng::at(7, Draw::Probe, &[case]);
            let mut random = |scale: f64| Vec2::new(rng.unit() as f32 - 0.5, rng.unit() as f32 - 0.5) * scale as f32;
            let mut points: Vec<Vec2> = (0..30).map(|_| random(1.0)).collect();
            let mut star = Star::default();
            let mut before = star_after(&points, &mut star);
            for _ in 0..20 {
                points.iter_mut().for_each(|point| *point += random(0.01));
                let after = star_after(&points, &mut star);
                let mut sorted = after.0.clone();
                sorted.sort_unstable();
                assert_eq!(sorted, neighbours(&points));
                (kept, found_anew) = if after == before { (kept + 1, found_anew) } else { (kept, found_anew + 1) };
                before = after;
            }
        }
        assert!(kept > 500 && found_anew > 100, "{kept} kept, {found_anew} found anew");
    }
}
