//! The Delaunay star of one point among those near it in its tangent plane.
//!
//! The nearest point is a Delaunay neighbour; from one neighbour on, the next counter-clockwise is the point that sees
//! the edge to it under the largest angle (gift wrapping; McLain 1976, "Two dimensional interpolation from random
//! data").

use glam::Vec2;

/// The largest number of candidates.
pub(super) const MOST: usize = 48;

/// The points near a point, as offsets from it.
pub(super) struct StarCandidates {
    x: [f32; MOST],
    y: [f32; MOST],
    squared: [f32; MOST],
    count: usize,
}

impl Default for StarCandidates {
    fn default() -> Self {
        Self { x: [0.0; MOST], y: [0.0; MOST], squared: [0.0; MOST], count: 0 }
    }
}

impl StarCandidates {
    /// Removes all points.
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a point, one of [`MOST`] at most and not the centre itself.
    pub(super) fn add(&mut self, offset: Vec2) {
        (self.x[self.count], self.y[self.count]) = offset.into();
        self.squared[self.count] = offset.length_squared();
        self.count += 1;
    }

    /// The offset of a point, by the order in which they were added.
    pub(super) fn offset(&self, point: usize) -> Vec2 {
        Vec2::new(self.x[point], self.y[point])
    }

    /// Writes the neighbours, counter-clockwise, to `ring`. False if they leave a gap of a half turn or more; then
    /// `ring` begins after the gap.
    pub(super) fn star(&self, ring: &mut Vec<usize>) -> bool {
        ring.clear();
        let nearest = (0..self.count).min_by(|&a, &b| self.squared[a].total_cmp(&self.squared[b]));
        let Some(nearest) = nearest else { return false };
        let mut last = nearest;
        loop {
            ring.push(last);
            match self.following(last, 1.0) {
                Some(next) if next == nearest => return true,
                // Rounding can hide the first neighbour among others on one circle.
                Some(next) if ring.len() < self.count => last = next,
                _ => break,
            }
        }
        let mut first = nearest;
        while let Some(before) = self.following(first, -1.0).filter(|before| !ring.contains(before)) {
            ring.insert(0, before);
            first = before;
        }
        false
    }

    /// The neighbour after this one: counter-clockwise for a `turn` of 1, clockwise for -1.
    fn following(&self, point: usize, turn: f32) -> Option<usize> {
        let (x, y) = (self.x[point], self.y[point]);
        // The cotangent of the angle under which a point sees the edge falls with the angle.
        let cotangent = |other: usize| {
            let sine = turn * (x * self.y[other] - y * self.x[other]);
            let cosine = self.squared[other] - x * self.x[other] - y * self.y[other];
            if sine > 0.0 { cosine / sine } else { f32::INFINITY }
        };
        let mut cotangents = [f32::INFINITY; MOST];
        cotangents[..self.count].iter_mut().zip(0..).for_each(|(place, other)| *place = cotangent(other));
        let least =
            (0..self.count).fold(0, |least, other| if cotangents[other] < cotangents[least] { other } else { least });
        (cotangents[least] < f32::INFINITY).then_some(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

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

    fn star(points: &[Vec2]) -> (Vec<usize>, bool) {
        let (mut candidates, mut ring) = (StarCandidates::default(), Vec::new());
        points.iter().for_each(|&point| candidates.add(point));
        let is_closed = candidates.star(&mut ring);
        (ring, is_closed)
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
}
