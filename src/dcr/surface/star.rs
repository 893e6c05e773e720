//! The Delaunay star of one point among those near it in its tangent plane.
//!
//! The nearest point is a Delaunay neighbour; from one neighbour on, the next counter-clockwise is the point that sees the
//! edge to it under the largest angle (gift wrapping; McLain 1976, "Two dimensional interpolation from random data").

use glam::Vec2;

/// No more points than these are looked at.
pub(super) const MOST: usize = 48;

/// The points near one, as offsets from it.
pub(super) struct Near {
    x: [f32; MOST],
    y: [f32; MOST],
    squared: [f32; MOST],
    count: usize,
}

impl Default for Near {
    fn default() -> Self {
        Self { x: [0.0; MOST], y: [0.0; MOST], squared: [0.0; MOST], count: 0 }
    }
}

impl Near {
    pub(super) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a point, one of [`MOST`] at most and not the centre itself.
    pub(super) fn add(&mut self, offset: Vec2) {
        (self.x[self.count], self.y[self.count]) = offset.into();
        self.squared[self.count] = offset.length_squared();
        self.count += 1;
    }

    pub(super) fn offset(&self, point: usize) -> Vec2 {
        Vec2::new(self.x[point], self.y[point])
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Writes the neighbours, counter-clockwise, to `ring`. False if they leave a gap of a half turn or more; then `ring`
    /// begins after the gap.
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
        let mut cotangents = [f32::INFINITY; MOST];
        for other in 0..self.count {
            let sine = turn * (x * self.y[other] - y * self.x[other]);
            let cosine = self.squared[other] - x * self.x[other] - y * self.y[other];
            cotangents[other] = if sine > 0.0 { cosine / sine } else { f32::INFINITY };
        }
        let least =
            (0..self.count).fold(0, |least, other| if cotangents[other] < cotangents[least] { other } else { least });
        (cotangents[least] < f32::INFINITY).then_some(least)
    }
}
