//! Stars as they are found and kept.

use crate::dcr::surface::view::*;
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
