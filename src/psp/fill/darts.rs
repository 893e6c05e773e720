//! Where darts of even density fall on a row of areas, however the surface is cut into them.
//!
//! A row that is known as a whole takes darts in any number, one by one ([`Row`]). On one that is only passed over darts
//! fall as rain, a Poisson process ([`Rain`]): from one dart to the next the area passed is Exp(1) over the density.

use crate::math::log;
use crate::rng::Rng;

/// Areas in a row, on which darts fall.
pub(in crate::psp) struct Row {
    /// The sum of the areas up to each of them, itself included.
    ends: Vec<f64>,
    /// For as many equal parts of the total, the first area that a part can reach (Chen and Asau 1974): from there the
    /// area of a dart is one step away on average.
    guide: Vec<u32>,
}

impl Row {
    pub fn new(areas: Vec<f64>) -> Self {
        let (mut total, mut ends) = (0.0, areas);
        for end in &mut ends {
            total += *end;
            *end = total;
        }
        let (mut guide, mut first) = (Vec::with_capacity(ends.len()), 0);
        for part in 0..ends.len() {
            let start = part as f64 * (total / ends.len() as f64);
            while first + 1 < ends.len() && ends[first] <= start {
                first += 1;
            }
            guide.push(first as u32);
        }
        Self { ends, guide }
    }

    /// How many areas there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The sum of all areas.
    pub fn total(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    /// The number of the area that a dart falls on.
    pub fn hit(&self, rng: &mut Rng) -> u32 {
        self.place(rng).0
    }

    /// The same, and how far behind the start of the area it falls.
    pub fn place(&self, rng: &mut Rng) -> (u32, f64) {
        let (share, last) = (rng.unit(), self.ends.len() - 1);
        let mut number = self.guide[(share * self.ends.len() as f64) as usize] as usize;
        let place = share * self.total();
        while number < last && self.ends[number] <= place {
            number += 1;
        }
        let start = if number == 0 { 0.0 } else { self.ends[number - 1] };
        (number as u32, place - start)
    }
}

/// A rain that passes over areas, one after the other.
pub(in crate::psp) struct Rain<'a> {
    rng: &'a mut Rng,
    per_area: f64,
    /// The area left before the next dart falls.
    left: f64,
}

impl<'a> Rain<'a> {
    pub fn new(rng: &'a mut Rng, per_area: f64) -> Self {
        let left = waiting(rng, per_area);
        Self { rng, per_area, left }
    }

    /// Whether the next area stays dry. If so, it has been passed.
    pub fn passes(&mut self, area: f64) -> bool {
        let is_dry = area <= self.left;
        if is_dry {
            self.left -= area;
        }
        is_dry
    }

    /// How many darts fall on the next area.
    pub fn fall(&mut self, area: f64) -> usize {
        let mut darts = 0;
        self.left -= area;
        while self.left < 0.0 {
            darts += 1;
            self.left += waiting(self.rng, self.per_area);
        }
        darts
    }
}

fn waiting(rng: &mut Rng, per_area: f64) -> f64 {
    -log(1.0 - rng.unit()) / per_area
}

/// Puts items into random order (Fisher and Yates).
pub(in crate::psp) fn shuffle<T>(rng: &mut Rng, items: &mut [T]) {
    for last in (1..items.len()).rev() {
        items.swap(last, rng.below(last as u64 + 1) as usize);
    }
}

/// Barycentrics of a random point of a triangle.
pub(in crate::psp) fn random_point(rng: &mut Rng) -> [f64; 2] {
    let [s, t] = [rng.unit(), rng.unit()];
    if s + t > 1.0 { [1.0 - s, 1.0 - t] } else { [s, t] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Draw;

    /// Areas in ratios of up to 1e6, and none at both ends and between.
    #[test]
    fn a_row_is_hit_in_proportion_to_its_areas() {
        let mut rng = Rng::at(5, Draw::Probe, &[]);
        let area = |i: u32| if i.is_multiple_of(3) { 0.0 } else { [1.0, 1e-6, 0.3, 7.0][i as usize % 4] };
        let areas: Vec<f64> = (0..100).map(area).collect();
        let (row, darts) = (Row::new(areas.clone()), 200_000);
        let mut hits = [0.0; 100];
        (0..darts).for_each(|_| hits[row.hit(&mut rng) as usize] += 1.0);
        for (&area, hits) in areas.iter().zip(hits) {
            let expected = f64::from(darts) * area / row.total();
            assert!((hits - expected).abs() <= 5.0 * expected.sqrt(), "{hits} for {expected}");
        }
        assert_eq!((row.len(), Row::new(Vec::new()).total()), (100, 0.0));
    }
}
