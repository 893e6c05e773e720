//! Sets inside of meshes that are not closed: those with flat holes against the meshes that are closed by hand, others against
//! winding numbers by sums over all triangles.

use std::collections::BTreeMap;
use std::sync::Arc;

use azulejo::dcr::volume::{InsideOptions as Relaxation, relax_inside};
use azulejo::mesh::Mesh;
use azulejo::volume::{InsideOptions, InsideReport, Surface, adaptive, sample_inside};
use azulejo::{Context, Order, Points, psp};

use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::volume_oracle::{conflict, distance};
use crate::interior::winding;
use crate::volume_inside::{check_seeds_and_threads, check_shell, corners, cube, depth, made, mesh, space};

fn without_last((positions, mut triangles): Soup, count: usize) -> Soup {
    triangles.truncate(triangles.len() - count);
    (positions, triangles)
}

fn turned((positions, mut triangles): Soup) -> Soup {
    triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    (positions, triangles)
}

/// Without the triangles of which a corner is cut off.
fn cut((positions, mut triangles): Soup, is_cut: impl Fn([f32; 3]) -> bool) -> Soup {
    triangles.retain(|triangle| !triangle.iter().any(|&vertex| is_cut(positions[vertex as usize])));
    (positions, triangles)
}

/// A part of a surface of revolution around the z axis, of radii and heights by a turn and a share of the way up, and discs at the
/// ends of some ways: so many of its last triangles close it.
fn revolved(at: impl Fn(f64, f64) -> [f64; 2], steps: u32, discs: &[u32]) -> Soup {
    let place = |i: u32, j: u32| {
        let turn = std::f64::consts::TAU * f64::from(i % steps) / f64::from(steps);
        let [across, z] = at(turn, f64::from(j) / f64::from(steps));
        [across * turn.cos(), across * turn.sin(), z].map(|x| x as f32)
    };
    let vertex = |i: u32, j: u32| i % steps + steps * j;
    let mut positions: Vec<_> =
        (0..=steps).flat_map(|j| (0..steps).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
    let quad = |n: u32| {
        let (i, j) = (n % steps, n / steps);
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let mut triangles: Vec<_> = (0..steps * steps).flat_map(quad).collect();
    for &j in discs {
        let centre = positions.len() as u32;
        positions.push([0.0, 0.0, place(0, j)[2]]);
        triangles.extend((0..steps).map(|i| {
            if j == 0 { [vertex(i + 1, j), vertex(i, j), centre] } else { [vertex(i, j), vertex(i + 1, j), centre] }
        }));
    }
    (positions, triangles)
}

/// A bowl from the south pole to a height, by the turn.
fn bowl(height: impl Fn(f64) -> f64, discs: &[u32]) -> Soup {
    let at = |turn: f64, share: f64| {
        let z = share * (1.0 + height(turn)) - 1.0;
        [(1.0 - z * z).max(0.0).sqrt(), z]
    };
    revolved(at, 24, discs)
}

/// Where the surface is on one side of a flat hole, the level 1/2 is flat.
#[test]
fn flat_holes_are_closed_by_flat_caps() {
    let tube = |discs: &[u32]| revolved(|_, share| [0.5, 2.0 * share - 1.0], 12, discs);
    for (name, closed, caps, radius) in [
        ("cube without a face", cube(), 2, 0.12),
        ("cube without a triangle", cube(), 1, 0.12),
        ("hemisphere", bowl(|_| 0.0, &[24]), 24, 0.17),
        ("hemisphere that faces inwards", turned(bowl(|_| 0.0, &[24])), 24, 0.17),
        ("tube with a bottom", tube(&[0, 12]), 12, 0.12),
    ] {
        let [closed, open] = [mesh(closed.clone()), mesh(without_last(closed, caps))];
        assert!(closed.is_closed() && !open.is_closed(), "{name}");
        for (seed, surface, thickness) in
            [(1, Surface::Open, 0.0), (2, Surface::First, 0.0), (3, Surface::Open, 0.8 * radius)]
        {
            let options = InsideOptions::new(radius).seed(seed).surface(surface).thickness(thickness);
            let (points, report) = made(&open, &options);
            let thickness = if thickness > 0.0 { thickness } else { f64::INFINITY };
            assert!(points.len() > 100 && check_shell(&closed, &points, &report, &[], thickness) > 300, "{name}");
            let of_surface = psp::Options::new(radius).seed(seed);
            let surface = psp::sample(&Context::new(1).unwrap(), &open, &of_surface, None).unwrap().0;
            let first = &points.positions[..report.surface_samples];
            assert!(first.is_empty() || first == surface.positions, "{name}");
        }
        let counted = made(&open, &InsideOptions::by_count(200).order(Order::Progressive));
        assert_eq!(counted.0.len(), 200);
        check_shell(&closed, &counted.0, &counted.1, &[], f64::INFINITY);
    }
}

/// The edges that an odd number of triangles shares, by places, as triangles of no area.
fn rim(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    let mut counts = BTreeMap::new();
    for [a, b, c] in corners(mesh) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let mut ends = [from, to].map(|end| end.map(|x| ((x + 0.0) as f32).to_bits()));
            ends.sort_unstable();
            counts.entry(ends).or_insert((0, [from, to, to])).0 += 1;
        }
    }
    counts.into_values().filter(|(count, _)| count % 2 == 1).map(|(_, edge)| edge).collect()
}

/// Checks that samples wind and do not conflict, and that no place of a grid is open that winds more and is not near to the
/// surface, all but what is no farther from the rim than the longest of its edges, times a factor; gives the number of places that are
/// covered.
fn check(mesh: &Mesh, points: &Points<3>, report: &InsideReport, edges: f64) -> usize {
    let (domain, triangles, rim, mut covered) = (space(mesh), corners(mesh), rim(mesh), 0);
    let length = |[a, b, _]: &[[f64; 3]; 3]| distance(&domain, *a, *b);
    let beside = edges * rim.iter().map(length).fold(0.0, f64::max);
    assert_eq!(conflict(&domain, report.radius, &points.positions), None);
    for &sample in &points.positions[report.surface_samples..] {
        let (wound, place) = (winding(mesh, sample).abs(), sample.map(f64::from));
        let is_near = || depth(&triangles, place) < 0.02 || wound > 0.3 && depth(&rim, place) <= beside;
        assert!(wound > 0.47 || is_near(), "{sample:?} winds {wound}");
    }
    let (limit, steps) = (report.covering_radius + 7.0 * f64::from(f32::EPSILON) * 4.0, 24);
    for k in 0..steps * steps * steps {
        let share = [k % steps, k / steps % steps, k / steps / steps].map(|n| (f64::from(n) + 0.37) / f64::from(steps));
        let place = [0, 1, 2].map(|k: usize| domain.min[k] + domain.extent()[k] * share[k]);
        let is_covered = points.positions.iter().any(|s| distance(&domain, s.map(f64::from), place) < limit);
        let wound = winding(mesh, place.map(|x| x as f32)).abs();
        covered += usize::from(is_covered && wound > 0.5);
        let is_near = || depth(&triangles, place) <= report.depth || depth(&rim, place) <= beside;
        assert!(is_covered || wound < 0.56 || is_near(), "{place:?} is open, and winds {wound}");
    }
    covered
}

/// Checks sets of a mesh, with and without samples of its surface, which cover places.
fn check_sets(name: &str, soup: Soup, [radius, edges]: [f64; 2], places: usize) {
    let mesh = mesh(soup);
    assert!(!mesh.is_closed(), "{name}");
    for (seed, surface) in [(1, Surface::Open), (2, Surface::First)] {
        let (points, report) = made(&mesh, &InsideOptions::new(radius).seed(seed).surface(surface));
        let covered = check(&mesh, &points, &report, edges);
        assert!(points.len() > 80 && covered > places, "{name}: {} {covered}", points.len());
    }
}

#[test]
fn other_holes_are_closed_at_the_level_of_a_half() {
    check_sets("saddle", bowl(|turn| 0.3 * (2.0 * turn).cos(), &[]), [0.15, 0.0], 1_500);
    check_sets("tube", revolved(|_, share| [0.5, 2.0 * share - 1.0], 24, &[]), [0.12, 0.0], 1_500);
    let ball = |height: f32| cut(meshes::welded(meshes::sphere()), |place| place[2] > height);
    check_sets("ball without its top", ball(0.9), [0.25, 0.5], 4_000);
    check_sets("ball that faces inwards", turned(ball(0.3)), [0.25, 0.5], 3_000);
    let torus = |is_cut: fn([f32; 3]) -> bool| cut(meshes::welded(meshes::torus()), is_cut);
    let hole = torus(|[x, y, z]| x > 0.9 && y.abs() < 0.3 && z > 0.1);
    check_sets("torus with a hole", hole, [0.2, 0.5], 2_000);
    check_sets("torus with a gap", torus(|[x, y, _]| x > 0.0 && y.abs() < 0.3), [0.2, 0.5], 2_000);
    let mut hollow = turned(meshes::welded(meshes::sphere()));
    hollow.0.iter_mut().for_each(|place| *place = place.map(|x| 0.5 * x));
    check_sets("hollow ball with a hole", meshes::join([ball(0.9), hollow]), [0.2, 0.5], 4_000);
}

/// Heights that jump from vertex to vertex: the level has folds there that no cap of edges as long as those of the rim follows.
#[test]
fn samples_at_ragged_rims_wind_less_within_an_edge() {
    let mut random = Random::new(5);
    let heights: Vec<f64> = (0..24).map(|_| f64::from(random.unit())).collect();
    let step = |turn: f64| (turn * 24.0 / std::f64::consts::TAU).round() as usize % 24;
    check_sets("ragged bowl", bowl(|turn| 0.3 * heights[step(turn)], &[]), [0.15, 1.0], 1_500);
    check_sets("crown", bowl(|turn| 0.4 * (step(turn) % 2) as f64, &[]), [0.15, 1.0], 1_500);
}

#[test]
fn seeds_and_not_threads_decide() {
    check_seeds_and_threads(&mesh(bowl(|turn| 0.3 * (2.0 * turn).cos(), &[])), InsideOptions::new(0.1));
}

/// Loose triangles, whose caps are the same triangles, and flat sheets, along the axes and not: their caps part from them by rounding.
#[test]
fn meshes_that_enclose_nothing_are_refused() {
    let triangle = (vec![[0.0; 3], [1.0, 0.1, 0.0], [0.2, 1.0, 0.3]], vec![[0, 1, 2]]);
    let mut tilted = revolved(|_, share| [share, 0.0], 20, &[]);
    tilted.0.iter_mut().for_each(|place| place[2] = 0.3 * place[0] + 0.77 * place[1] + 1.0);
    let sheets = [meshes::plane(), meshes::sheets(0.1), tilted];
    for soup in [triangle, meshes::random_soup(2, 60), meshes::needles(1e-3)].into_iter().chain(sheets) {
        let mesh = mesh(soup);
        for options in [
            InsideOptions::new(0.1),
            InsideOptions::new(0.1).surface(Surface::First),
            InsideOptions::new(0.1).order(Order::Progressive),
            InsideOptions::by_count(5),
        ] {
            let error = sample_inside(&Context::new(1).unwrap(), &mesh, &options, None).unwrap_err().to_string();
            assert!(error.starts_with("mesh: encloses nothing: caps close its holes"), "{error}");
        }
    }
}

/// A mask opens a mesh.
#[test]
fn triangles_that_are_left_out_are_holes() {
    let (positions, triangles) = cube();
    let masked = Mesh::new(positions.clone(), triangles.clone()).unwrap();
    let masked = Arc::new(masked.with_mask((0..12).map(|k| k < 10).collect()).unwrap());
    let open = mesh(without_last((positions, triangles), 2));
    let options = InsideOptions::new(0.13);
    assert_eq!(made(&masked, &options).0.positions, made(&open, &options).0.positions);
}

#[test]
fn radii_that_vary_stay_inside() {
    let [open, closed] = [mesh(without_last(cube(), 2)), mesh(cube())];
    let context = Context::new(1).unwrap();
    let at = |place: [f64; 3]| 0.08 + 0.1 * place[0];
    let radius = adaptive::Radius::Function { at: &at, smallest: 0.05, largest: 0.3, slope: 0.11 };
    let points = adaptive::sample_inside(&context, &open, &adaptive::InsideOptions::new(radius), None).unwrap().0;
    assert!(points.len() > 100 && points.positions.iter().all(|&sample| closed.contains(sample)));
}

/// Points that slide stay on the mesh, and no other one leaves through a cap.
#[test]
fn points_are_relaxed_up_to_the_caps() {
    let [open, closed] = [mesh(without_last(cube(), 2)), mesh(cube())];
    let (points, report) = made(&open, &InsideOptions::new(0.1).surface(Surface::First));
    let mut random = Random::new(3);
    let moved = points.positions.iter().enumerate().map(|(k, &place)| {
        let shaken = place.map(|x| x + 0.02 * (random.unit() - 0.5));
        if k >= report.surface_samples && closed.contains(shaken) { shaken } else { place }
    });
    let start: Vec<_> = moved.collect();
    let sliding: Vec<bool> = (0..points.len()).map(|k| k < report.surface_samples).collect();
    let options = Relaxation::default().max_iterations(60).sliding(&sliding);
    let relaxed = relax_inside(&Context::new(1).unwrap(), &open, &options, &start, None).unwrap().0;
    let (triangles, mut slid) = (corners(&open), 0);
    for (k, &place) in relaxed.iter().enumerate() {
        if sliding[k] {
            assert!(depth(&triangles, place.map(f64::from)) < 1e-6, "{place:?} is off the surface");
            slid += usize::from(place != start[k]);
        } else {
            assert!(closed.contains(place), "{place:?} is outside");
        }
    }
    assert!(slid > 100);
}
