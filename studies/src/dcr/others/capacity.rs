//! Capacity-constrained Voronoi tessellation (Balzer, Schlömer and Deussen 2009): the plane is many points, of which
//! every site has as many; two sites exchange points as long as that brings these nearer to them, and then move to
//! their centroids.

use glam::DVec2;

use super::Outcome;
use crate::reference::random;

/// The least gain of an exchange: rounding must not let two points be exchanged for ever.
const ROUNDING: f64 = 1e-9;

/// Rounds until no point changes hands. `capacity` is the points of a site.
pub fn relax(points: &[[f32; 2]], seed: u64, capacity: usize, rounds: u32) -> Outcome {
    let side = (points.len() as f64).sqrt();
    let places = |points: &[[f32; 2]]| points.iter().map(|&point| side * DVec2::from(point.map(f64::from))).collect();
    let mut state = State { side, sites: places(points), owned: vec![Vec::new(); points.len()] };
    state.divide((0..points.len()).collect(), places(&random(points.len() * capacity, !seed)));
    let mut is_met = false;
    let mut round = 0;
    while round < rounds && !is_met {
        is_met = !state.exchange();
        state.centre();
        round += 1;
    }
    let unit = |site: &DVec2| {
        site.to_array().map(|x| Some((x.rem_euclid(side) / side) as f32).filter(|&x| x < 1.0).unwrap_or(0.0))
    };
    Outcome { points: state.sites.iter().map(unit).collect(), steps: round, is_met }
}

struct State {
    side: f64,
    sites: Vec<DVec2>,
    /// The points of each site.
    owned: Vec<Vec<DVec2>>,
}

impl State {
    /// Gives every site as many points: halves both across the wider side of where they are, over and over. That is
    /// nearer to the end than the random start of the paper.
    fn divide(&mut self, mut sites: Vec<usize>, mut points: Vec<DVec2>) {
        if let [site] = sites[..] {
            self.owned[site] = points;
            return;
        }
        let (low, high) = points.iter().fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        let axis = usize::from((high - low).y > (high - low).x);
        sites.sort_by(|&a, &b| self.sites[a][axis].total_cmp(&self.sites[b][axis]));
        points.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        let half = sites.len() / 2;
        let upper_points = points.split_off(points.len() / sites.len() * half);
        let upper_sites = sites.split_off(half);
        self.divide(sites, points);
        self.divide(upper_sites, upper_points);
    }

    /// The shortest way from one place to another.
    fn apart(&self, from: DVec2, to: DVec2) -> DVec2 {
        let direct = to - from;
        direct - self.side * (direct / self.side).round()
    }

    /// Lets all pairs of sites exchange points, and returns whether any did. Sites that are farther apart than their
    /// points reach have none to exchange.
    fn exchange(&mut self) -> bool {
        let reach = |state: &Self, site: usize| {
            let lengths = state.owned[site].iter().map(|&point| state.apart(state.sites[site], point).length());
            lengths.fold(0.0, f64::max)
        };
        let mut reaches: Vec<_> = (0..self.sites.len()).map(|site| reach(self, site)).collect();
        let mut is_changed = false;
        for a in 0..self.sites.len() {
            for b in a + 1..self.sites.len() {
                let apart = self.apart(self.sites[a], self.sites[b]).length();
                if apart <= reaches[a] + reaches[b] && self.exchange_between(a, b) {
                    is_changed = true;
                    [a, b].into_iter().for_each(|site| reaches[site] = reach(self, site));
                }
            }
        }
        is_changed
    }

    /// Exchanges the points of two sites in the order of their gain, while that lessens the sum of squared distances.
    fn exchange_between(&mut self, a: usize, b: usize) -> bool {
        let loss = |point: &DVec2, own: usize, other: usize| {
            let [own, other] = [own, other].map(|site| self.apart(self.sites[site], *point).length_squared());
            own - other
        };
        let losses = |own: usize, other: usize| -> Vec<_> {
            self.owned[own].iter().enumerate().map(|(i, point)| (loss(point, own, other), i)).collect()
        };
        let [mut of_a, mut of_b] = [losses(a, b), losses(b, a)];
        let largest = |losses: &[(f64, usize)]| losses.iter().fold(f64::MIN, |largest, loss| largest.max(loss.0));
        if largest(&of_a) + largest(&of_b) <= ROUNDING {
            return false;
        }
        [&mut of_a, &mut of_b].into_iter().for_each(|losses| losses.sort_by(|x, y| y.0.total_cmp(&x.0)));
        let gaining = of_a.iter().zip(&of_b).take_while(|(x, y)| x.0 + y.0 > ROUNDING);
        for (i, j) in gaining.map(|(x, y)| (x.1, y.1)).collect::<Vec<_>>() {
            let point = self.owned[a][i];
            self.owned[a][i] = std::mem::replace(&mut self.owned[b][j], point);
        }
        true
    }

    fn centre(&mut self) {
        for site in 0..self.sites.len() {
            let (place, points) = (self.sites[site], &self.owned[site]);
            let sum: DVec2 = points.iter().map(|&point| self.apart(place, point)).sum();
            self.sites[site] = place + sum / points.len() as f64;
        }
    }
}
