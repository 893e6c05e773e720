//! Distances and coverage by disks of any radii in the plane, from the definition. The fuzz targets include this file, too.

use azulejo::{Boundary, Domain};

/// The distance of two points, of which each may be anywhere: on a torus that of the nearest images.
pub fn distance(domain: &Domain, a: [f32; 2], b: [f32; 2]) -> f64 {
    let along = |axis: usize| {
        let along = (f64::from(a[axis]) - f64::from(b[axis])).abs();
        match domain.boundary {
            Boundary::Bounded => along,
            Boundary::Periodic => {
                let period = domain.max[axis] - domain.min[axis];
                let along = along % period;
                along.min(period - along)
            }
        }
    };
    length(along(0), along(1))
}

/// Squares of all floats are far from the limits of `f64`.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// A point of a domain in none of some disks, if there is one. On a torus disks wrap.
pub fn find_gap(
    domain: &Domain,
    disks: impl Iterator<Item = ([f32; 2], f64)>,
    tolerance: f64,
    finest: f64,
) -> Option<[f64; 2]> {
    let mut images = Vec::new();
    for (place, radius) in disks.filter(|&(_, radius)| radius > 0.0) {
        let mut place = place.map(f64::from);
        let turns = if domain.boundary == Boundary::Periodic { -1..=1 } else { 0..=0 };
        if domain.boundary == Boundary::Periodic {
            place = [0, 1].map(|axis: usize| {
                let extent = domain.extent()[axis];
                place[axis] - extent * ((place[axis] - domain.min[axis]) / extent).floor()
            });
        }
        for [x, y] in turns.clone().flat_map(|y| turns.clone().map(move |x| [x, y])) {
            let [width, height] = domain.extent();
            images.push(([place[0] + f64::from(x) * width, place[1] + f64::from(y) * height], radius + tolerance));
        }
    }
    find_gap_in(domain.min, domain.max, &images, finest)
}

/// Cuts the rectangle into smaller ones until each lies in one disk, or one is as small as `finest` and does not.
fn find_gap_in(min: [f64; 2], max: [f64; 2], disks: &[([f64; 2], f64)], finest: f64) -> Option<[f64; 2]> {
    let nearest = |place: &[f64; 2]| {
        let [dx, dy] = [0, 1].map(|axis| (min[axis] - place[axis]).max(place[axis] - max[axis]).max(0.0));
        length(dx, dy)
    };
    let farthest = |place: &[f64; 2]| {
        let [dx, dy] = [0, 1].map(|axis| (place[axis] - min[axis]).max(max[axis] - place[axis]));
        length(dx, dy)
    };
    if disks.iter().any(|(place, radius)| farthest(place) <= *radius) {
        return None;
    }
    let touching: Vec<_> = disks.iter().copied().filter(|(place, radius)| nearest(place) <= *radius).collect();
    let middle = [0, 1].map(|axis| 0.5 * (min[axis] + max[axis]));
    let longer = if max[0] - min[0] >= max[1] - min[1] { 0 } else { 1 };
    if touching.is_empty() || max[longer] - min[longer] <= finest {
        return Some(middle);
    }
    let (mut end, mut start) = (max, min);
    end[longer] = middle[longer];
    start[longer] = middle[longer];
    find_gap_in(min, end, &touching, finest).or_else(|| find_gap_in(start, max, &touching, finest))
}
