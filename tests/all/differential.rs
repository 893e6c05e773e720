//! Differential domain analysis against what is known of simple sets.

use std::f64::consts::{FRAC_PI_6, PI, TAU};

use azulejo::analysis::differential::{
    Differences, GRID_REACH, GRID_SIZE, REACH, SHELL_WIDTH, plane_differences, surface_differences,
};
use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::maximal;
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Error};

use crate::common::meshes;
use crate::common::sets::{Random, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];
const UP: [f32; 3] = [0.0, 0.0, 1.0];
const EAST: [f64; 3] = [1.0, 0.0, 0.0];

fn context() -> Context {
    Context::new(2).unwrap()
}

fn plane_of(domain: &Domain, points: &[[f32; 2]]) -> Differences {
    plane_differences(&context(), domain, points, None).unwrap()
}

/// The unit square as a mesh, with points of the plane on it.
fn sheet_of(points: &[[f32; 2]], seed: u64) -> Differences {
    let (positions, triangles) = meshes::plane();
    let mesh = Mesh::new(positions, triangles).unwrap();
    let positions: Vec<_> = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    surface_differences(&context(), &mesh, &positions, &vec![UP; points.len()], EAST, seed, None).unwrap()
}

/// The largest deviation from 1, in standard errors of a Poisson process: of the radial mean, then of the grid.
fn deviation(of: &Differences) -> [f64; 2] {
    let shells = of.radial();
    let radial = shells.iter().map(|shell| (shell.density - 1.0).abs() * shell.expected.sqrt());
    // As many pairs are expected in each cell as in all shells by area.
    let per_area = shells.iter().map(|shell| shell.expected).sum::<f64>() / (PI * REACH * REACH);
    let cell = per_area * (2.0 * GRID_REACH / GRID_SIZE as f64).powi(2);
    let grid = of.density().into_iter().map(|density| (density - 1.0).abs() * cell.sqrt());
    [radial.fold(0.0, f64::max), grid.fold(0.0, f64::max)]
}

/// A maximal set of about this many points on the unit torus.
fn blue_noise(count: f64, seed: u64) -> Vec<[f32; 2]> {
    let (radius, domain) = ((0.69656 / count).sqrt(), unit_square(Boundary::Periodic));
    maximal::sample(&context(), &maximal::Options::new(radius).domain(domain).seed(seed), None).unwrap().positions
}

#[test]
fn a_poisson_process_has_density_one_everywhere_in_the_plane_and_on_a_surface() {
    let points = random_points(20_000, 3);
    // 512 shells and 16,384 cells: 4 and 5 standard errors, and both ends of a pair are counted, which makes it √2 more;
    // a surface has the noise of its random points too.
    for boundary in BOUNDARIES {
        let [radial, grid] = deviation(&plane_of(&unit_square(boundary), &points));
        assert!((1.5..6.5).contains(&radial) && (2.0..8.0).contains(&grid), "{boundary:?} {radial} {grid}");
    }
    let [radial, grid] = deviation(&sheet_of(&points, 1));
    assert!((1.5..7.5).contains(&radial) && (2.0..9.0).contains(&grid), "{radial} {grid}");
    let power = plane_of(&unit_square(Boundary::Periodic), &points).power(&[0.3, 0.7, 1.0, 1.5, 2.5]);
    assert!(power.iter().all(|power| (power - 1.0).abs() < 0.1), "{power:?}");
}

/// Straight lengths make the area about a point of a sphere that of the plane; poles and the far side do no harm.
#[test]
fn random_points_of_a_sphere_have_density_one() {
    let (positions, triangles) = meshes::sphere();
    let mesh = Mesh::new(positions, triangles).unwrap();
    let mut random = Random::new(5);
    let mut positions = Vec::new();
    while positions.len() < 20_000 {
        let triangle = (random.unit() * mesh.triangles().len() as f32) as u32;
        let largest = 0.0175;
        if f64::from(random.unit()) * largest < mesh.triangle_area(triangle) {
            let (u, v) = (random.unit(), random.unit());
            let uv = if u + v < 1.0 { [u, v] } else { [1.0 - u, 1.0 - v] };
            positions.push((mesh.point(triangle, uv), mesh.normal(triangle)));
        }
    }
    let (positions, normals): (Vec<_>, Vec<_>) = positions.into_iter().unzip();
    let differences = surface_differences(&context(), &mesh, &positions, &normals, EAST, 1, None).unwrap();
    let [radial, grid] = deviation(&differences);
    assert!((1.5..7.5).contains(&radial) && (2.0..9.0).contains(&grid), "{radial} {grid}");
    // The expectation is what the plane's geometry says.
    let shell = differences.radial()[300];
    let area = PI * SHELL_WIDTH * SHELL_WIDTH * 601.0;
    assert!((shell.expected / (area * 20_000.0) - 1.0).abs() < 0.02, "{shell:?}");
}

#[test]
fn a_hexagonal_lattice_has_its_shells_and_its_six_directions() {
    // 40 by 46 points, a little stretched to fit a torus; their spacing is 1.0746 mean spacings.
    let (columns, rows) = (40, 46);
    let height = 3f64.sqrt() / 2.0 * f64::from(rows) / f64::from(columns);
    let domain = Domain { min: [0.0; 2], max: [1.0, height], boundary: Boundary::Periodic };
    let place = |i: i32| {
        let (column, row) = (i % columns, i / columns);
        let x = (f64::from(column) + 0.5 * f64::from(row % 2) + 0.25) / f64::from(columns);
        [x as f32, ((f64::from(row) + 0.5) / f64::from(rows) * height) as f32]
    };
    let differences = plane_of(&domain, &(0..columns * rows).map(place).collect::<Vec<_>>());
    let spacing = (2.0 / 3f64.sqrt()).sqrt();
    let pairs = |distance: f64| {
        let near = |shell: &azulejo::analysis::differential::Shell| (shell.distance / spacing - distance).abs() < 0.03;
        let shells = differences.radial();
        let count: f64 = shells.iter().filter(|shell| near(shell)).map(|shell| shell.density * shell.expected).sum();
        count / f64::from(columns * rows)
    };
    let found = [0.5, 1.0, 1.4, 3f64.sqrt(), 2.0, 2.3, 7f64.sqrt()].map(pairs);
    for (found, expected) in found.into_iter().zip([0.0, 6.0, 0.0, 6.0, 6.0, 0.0, 12.0]) {
        assert!((found - expected).abs() < 0.01, "{found}, not {expected}");
    }
    let density = differences.density();
    let at = |angle: f64, distance: f64| {
        let cell = |x: f64| ((spacing * distance * x + GRID_REACH) * GRID_SIZE as f64 / (2.0 * GRID_REACH)) as usize;
        density[cell(angle.sin()) * GRID_SIZE + cell(angle.cos())]
    };
    // Points may lie on a boundary of cells: those around it are taken together.
    let around = |angle: f64, distance: f64| {
        let near = [-0.03, 0.0, 0.03].into_iter().flat_map(|a| [-0.03, 0.0, 0.03].map(|d| at(angle + a, distance + d)));
        near.fold(0.0, f64::max)
    };
    for k in 0..6 {
        let angle = f64::from(k) * 2.0 * FRAC_PI_6;
        assert!(around(angle, 1.0) > 50.0 && around(angle + FRAC_PI_6, 1.0) == 0.0, "{k}");
        assert!(around(angle + FRAC_PI_6, 3f64.sqrt()) > 50.0 && around(angle, 1.5) == 0.0, "{k}");
    }
    // Its spectrum has the first ring of the dual lattice.
    let power = differences.power(&[0.5, spacing]);
    assert!(power[1] > 6.0 && power[0].abs() < 0.3, "{power:?}");
}

/// The radial mean of the periodogram, blurred as the differences are, is the transform of the radial mean of p(d).
#[test]
fn the_spectrum_of_the_differences_is_that_of_the_periodogram() {
    let domain = unit_square(Boundary::Periodic);
    let sets: Vec<_> = (0..4).map(|seed| blue_noise(10_000.0, seed)).collect();
    let spectra: Vec<_> = sets.iter().map(|set| periodogram(&context(), &domain, set, 401, None).unwrap()).collect();
    let annuli = Periodogram::mean(&spectra).unwrap().radial(0.05).unwrap();
    let in_plane: Vec<_> = sets.iter().map(|set| plane_of(&domain, set)).collect();
    let on_sheet: Vec<_> = sets.iter().zip(0..).map(|(set, seed)| sheet_of(set, seed)).collect();
    let frequencies: Vec<_> = annuli.iter().map(|annulus| annulus.frequency).collect();
    for (differences, tolerance) in [(in_plane, 0.04), (on_sheet, 0.07)] {
        let power = Differences::together(&differences).unwrap().power(&frequencies);
        for (annulus, power) in annuli.iter().zip(power).skip(4) {
            assert!((annulus.power - power).abs() < tolerance, "{power} at {annulus:?}");
        }
    }
}

#[test]
fn a_maximal_set_has_no_pair_below_its_radius_and_most_just_above() {
    let set = blue_noise(10_000.0, 1);
    let differences = plane_of(&unit_square(Boundary::Periodic), &set);
    let radius = (0.69656f64 / 10_000.0).sqrt() * (set.len() as f64).sqrt();
    for shell in differences.radial() {
        if shell.distance + 0.5 * SHELL_WIDTH < radius {
            assert_eq!(shell.density, 0.0, "{shell:?}");
        }
        let is_first = (radius + SHELL_WIDTH..radius + 3.0 * SHELL_WIDTH).contains(&shell.distance);
        assert!(!is_first || shell.density > 2.0, "{shell:?}");
        assert!(shell.distance < 4.0 || (shell.density - 1.0).abs() < 0.08, "{shell:?}");
    }
}

/// A set whose x is stretched has its neighbours farther apart along x: fewer of them near, more of them far.
#[test]
fn a_stretched_set_is_elongated_along_its_direction() {
    let stretched: Vec<_> = blue_noise(10_000.0, 2).iter().map(|&[x, y]| [1.3 * x, y]).collect();
    let domain = Domain { min: [0.0; 2], max: [1.3, 1.0], boundary: Boundary::Periodic };
    let elongation = |domain: &Domain, set: &[[f32; 2]], range| plane_of(domain, set).elongation(range);
    let (near, far) = (elongation(&domain, &stretched, 0.5..0.85), elongation(&domain, &stretched, 0.85..1.05));
    assert!(near < -0.8 && far > 0.05, "{near} {far}");
    let even = elongation(&unit_square(Boundary::Periodic), &blue_noise(10_000.0, 2), 0.5..1.05);
    assert!(even.abs() < 0.03, "{even}");
    // On a tilted sheet x is where the direction points in the sheet.
    let (positions, triangles) = meshes::plane();
    let turn = |[x, y, _]: [f32; 3]| [y, 0.6 * 1.3 * x, 0.8 * 1.3 * x];
    let mesh = Mesh::new(positions.into_iter().map(turn).collect(), triangles).unwrap();
    let samples: Vec<_> = blue_noise(10_000.0, 2).iter().map(|&[x, y]| turn([x, y, 0.0])).collect();
    let of = |direction| {
        let normals = vec![mesh.normal(0); samples.len()];
        surface_differences(&context(), &mesh, &samples, &normals, direction, 1, None).unwrap()
    };
    let ([up, across], whole) = ([[0.0, 0.0, -3.0], EAST].map(of), 0.5..0.85);
    let [up, across] = [up, across].map(|differences| differences.elongation(whole.clone()));
    assert!(up < -0.8 && across > 0.8, "{up} {across}");
}

/// Over all pairs, with the definition of the estimator of bounded domains.
#[test]
fn counts_are_those_of_all_pairs() {
    let mut random = Random::new(9);
    let points: Vec<_> = (0..400).map(|_| [3.0 + 2.0 * random.unit(), random.unit()]).collect();
    for boundary in BOUNDARIES {
        let domain = Domain { min: [3.0, 0.0], max: [5.1, 1.9], boundary };
        let unit = (domain.area() / 400.0).sqrt();
        let mut shells = vec![0.0; (REACH / SHELL_WIDTH) as usize];
        for (i, a) in points.iter().enumerate() {
            for b in points.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, b)| b) {
                let [x, y] = domain.offset(a.map(f64::from), b.map(f64::from));
                let length = x.hypot(y) / unit;
                let stays = (1.0 - x.abs() / 2.1) * (1.0 - y.abs() / 1.9);
                if length < REACH {
                    shells[(length / SHELL_WIDTH) as usize] +=
                        if boundary == Boundary::Bounded { 1.0 / stays } else { 1.0 };
                }
            }
        }
        let found = plane_of(&domain, &points).radial();
        for (i, (shell, expected)) in found.iter().zip(&shells).enumerate() {
            let area = SHELL_WIDTH * SHELL_WIDTH * (TAU * i as f64 + PI);
            assert!((shell.expected - 399.0 * area).abs() < 1e-6);
            // A pair on the boundary of two shells may be in either.
            let two = |values: &dyn Fn(usize) -> f64| (0..=i).map(values).sum::<f64>();
            let difference = two(&|k| found[k].density * found[k].expected) - two(&|k| shells[k]);
            assert!(difference.abs() < 4.5 + 1e-9 * expected, "{boundary:?} {i} {difference}");
        }
        let all: [f64; 2] = [found.iter().map(|s| s.density * s.expected).sum(), shells.iter().sum()];
        assert!((all[0] / all[1] - 1.0).abs() < 1e-4, "{all:?}");
    }
}

#[test]
fn what_has_no_differences_is_refused() {
    let name = |result: azulejo::Result<Differences>| match result.unwrap_err() {
        Error::InvalidArgument { argument, .. } => argument,
        other => panic!("{other}"),
    };
    let unit = unit_square(Boundary::Periodic);
    let refused_plane =
        |domain: &Domain, points: &[[f32; 2]]| name(plane_differences(&context(), domain, points, None));
    assert_eq!(refused_plane(&Domain { min: [2.0; 2], ..unit }, &[]), "domain_max");
    assert_eq!(refused_plane(&unit, &[]), "positions");
    assert_eq!(refused_plane(&unit, &[[0.5; 2]]), "positions");
    assert_eq!(refused_plane(&unit, &[[0.5; 2], [1.5; 2]]), "positions");
    assert_eq!(refused_plane(&unit, &random_points(255, 1)), "domain");
    assert_eq!(refused_plane(&Domain { max: [3.0, 1.0], ..unit }, &random_points(500, 1)), "domain");

    let (positions, triangles) = meshes::plane();
    let mesh = Mesh::new(positions, triangles).unwrap();
    let refused = |positions: &[[f32; 3]], normals: &[[f32; 3]], direction| {
        name(surface_differences(&context(), &mesh, positions, normals, direction, 1, None))
    };
    let two = [[0.1; 3], [0.2; 3]];
    assert_eq!(refused(&two[..1], &[UP], EAST), "positions");
    assert_eq!(refused(&[two[0], [f32::NAN; 3]], &[UP; 2], EAST), "positions");
    assert_eq!(refused(&two, &[UP], EAST), "normals");
    assert_eq!(refused(&two, &[UP, [0.0, f32::INFINITY, 0.0]], EAST), "normals");
    assert_eq!(refused(&two, &[UP; 2], [0.0; 3]), "direction");
    assert_eq!(refused(&two, &[UP; 2], [f64::NAN, 0.0, 1.0]), "direction");
    let nothing = mesh.clone().with_mask(vec![false; mesh.triangles().len()]).unwrap();
    let of_nothing = surface_differences(&context(), &nothing, &two, &[UP; 2], EAST, 1, None);
    assert_eq!(name(of_nothing), "mesh");
    assert_eq!(name(Differences::together(&[])), "differences");
    // Normals of triangles without area, and directions along the normal, are taken as they come.
    surface_differences(&context(), &mesh, &two, &[[0.0; 3]; 2], [0.0, 0.0, 1.0], 1, None).unwrap();
}
