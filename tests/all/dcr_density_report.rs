//! The report of points that were relaxed to a density: held against its definitions, evaluated plainly.

use azulejo::dcr::{DelaunayOptions, Density, Report, relax, relax_with_density, scatter};
use azulejo::{Boundary, Context, Domain};

use crate::common::sets::{distance, unit_square};

type Place = [f64; 2];

/// A density on a domain, and the spacing that a number of points has at its mean.
struct Scene<'a> {
    domain: Domain,
    density: &'a (dyn Fn(Place) -> f64 + Sync),
    mean: f64,
    unit: f64,
}

impl<'a> Scene<'a> {
    fn new(domain: Domain, density: &'a (dyn Fn(Place) -> f64 + Sync), count: usize) -> Self {
        let [width, height] = domain.extent();
        let places = (0..300 * 300).map(|i| [i % 300, i / 300]);
        let at = |[i, j]: [i32; 2]| {
            let share = |k: i32| (f64::from(k) + 0.5) / 300.0;
            density([domain.min[0] + share(i) * width, domain.min[1] + share(j) * height])
        };
        let mean = places.map(at).sum::<f64>() / 9e4;
        Self { domain, density, mean, unit: (2.0 * width * height / (3f64.sqrt() * count as f64)).sqrt() }
    }

    /// The place in the domain of which a place beyond it is an image.
    fn folded(&self, place: Place) -> Place {
        [0, 1].map(|axis| {
            let (min, side) = (self.domain.min[axis], self.domain.extent()[axis]);
            let along = place[axis] - min;
            min + match self.domain.boundary {
                Boundary::Periodic => along.rem_euclid(side),
                Boundary::Bounded => (along + side).rem_euclid(2.0 * side) - side,
            }
            .abs()
        })
    }

    /// 1 / sqrt(density), in units of d_max for the mean density.
    fn unlimited(&self, place: Place) -> f64 {
        self.unit * (self.mean / (self.density)(self.folded(place))).sqrt()
    }

    /// The local spacing: it increases by no more than half of the distance from place to place.
    fn spacing(&self, [x, y]: Place) -> f64 {
        let step = self.unit / 12.0;
        let around = (-60..=60).flat_map(|j| (-60..=60).map(move |i| [f64::from(i) * step, f64::from(j) * step]));
        let limit = |[dx, dy]: Place| self.unlimited([x + dx, y + dy]) + 0.5 * dx.hypot(dy);
        around.map(limit).fold(f64::INFINITY, f64::min)
    }

    /// The least of all distances over the mean of the spacings of the two points.
    fn rho(&self, points: &[[f32; 2]]) -> f64 {
        let spacings: Vec<_> = points.iter().map(|point| self.spacing(point.map(f64::from))).collect();
        let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let ratio =
            |(i, j): (usize, usize)| distance(&self.domain, points[i], points[j]) / (0.5 * (spacings[i] + spacings[j]));
        pairs.map(ratio).fold(f64::INFINITY, f64::min)
    }

    /// The largest circumradius of a triangle over the unlimited spacing at its centre: of all circles through three points,
    /// or their images, without another inside.
    fn relative_covering_radius(&self, points: &[[f32; 2]]) -> f64 {
        let [width, height] = self.domain.extent();
        let image = |point: &[f32; 2], turns: [i32; 2]| -> Place {
            [0, 1].map(|axis| {
                let (min, side) = (self.domain.min[axis], [width, height][axis]);
                let along = f64::from(point[axis]) - min;
                min + match self.domain.boundary {
                    Boundary::Periodic => along + f64::from(turns[axis]) * side,
                    Boundary::Bounded => [-along, along, 2.0 * side - along][(turns[axis] + 1) as usize],
                }
            })
        };
        let turns = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]));
        let images: Vec<_> = turns.flat_map(|turns| points.iter().map(move |point| image(point, turns))).collect();
        let is_inside =
            |place: Place| (0..2).all(|axis| (self.domain.min[axis]..=self.domain.max[axis]).contains(&place[axis]));
        let mut largest: f64 = 0.0;
        for (i, &a) in images.iter().enumerate() {
            // The circles of a set that is spread hardly reach farther.
            let reach = 4.0 * self.unlimited(a);
            let near: Vec<usize> = (0..images.len()).filter(|&j| j != i && length(a, images[j]) < reach).collect();
            for (&j, &k) in near.iter().flat_map(|j| near.iter().map(move |k| (j, k))).filter(|(j, k)| i < **j && j < k)
            {
                let Some((centre, radius)) = circumcircle(a, images[j], images[k]) else { continue };
                let is_empty = || near.iter().all(|&other| length(centre, images[other]) > radius * (1.0 - 1e-9));
                if 2.0 * radius < reach && is_inside(centre) && is_empty() {
                    largest = largest.max(radius / self.unlimited(centre));
                }
            }
        }
        largest
    }
}

fn length(a: Place, b: Place) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Centre and radius of the circle through three places that are not in a line.
fn circumcircle(a: Place, b: Place, c: Place) -> Option<(Place, f64)> {
    let ([px, py], [qx, qy]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let doubled = 2.0 * (px * qy - py * qx);
    let (p, q) = (px * px + py * py, qx * qx + qy * qy);
    let offset = [(qy * p - py * q) / doubled, (px * q - qx * p) / doubled];
    let radius = offset[0].hypot(offset[1]);
    radius.is_finite().then_some(([a[0] + offset[0], a[1] + offset[1]], radius))
}

type NamedDensity = (&'static str, fn(Place) -> f64);

/// Densities without details that are lost; the last one is 0 in places, where the increase of the spacing is limited.
const DENSITIES: [NamedDensity; 4] = [
    ("constant", |_| 7.0),
    ("wave", |[x, _]| 2.0 + (x * std::f64::consts::TAU).sin()),
    ("hill", |[x, y]| 0.05 + ((x * std::f64::consts::PI).sin() * (y * std::f64::consts::PI).sin()).powi(4)),
    ("disk", |[x, y]| (1.0 - ((x - 0.5).powi(2) + (y - 0.5).powi(2)) / 0.12).max(0.0)),
];

fn relaxed(domain: Domain, density: &Density, count: usize, steps: u32) -> (Vec<[f32; 2]>, Report) {
    let context = Context::new(1).unwrap();
    let start = scatter(&context, &domain, density, count, 5, None).unwrap();
    let options = DelaunayOptions::new(domain).max_iterations(steps);
    relax_with_density(&context, &options, density, &start, None).unwrap()
}

#[test]
fn the_report_s_rho_and_relative_covering_radius_are_those_of_the_definitions() {
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
        for (name, density) in DENSITIES {
            for steps in [12, 100] {
                let domain = unit_square(boundary);
                let (points, report) = relaxed(domain, &Density::Function(&density), 150, steps);
                let scene = Scene::new(domain, &density, 150);
                let (rho, relative_covering_radius) = (scene.rho(&points), scene.relative_covering_radius(&points));
                // At a boundary the density of half a cell of an eighth of d_max is lost.
                let tolerance = if name == "constant" { 1e-5 } else { 0.01 };
                assert!((report.rho / rho - 1.0).abs() < tolerance, "{boundary:?} {name}: {rho}, {report:?}");
                assert!(
                    (report.relative_covering_radius / relative_covering_radius - 1.0).abs() < tolerance,
                    "{boundary:?} {name}: {relative_covering_radius}, {report:?}"
                );
            }
        }
    }
}

/// Where all points are farther apart than any of a set that is spread in all directions, also in a strip that is thinner
/// than d_max. Without steps, and with a density that is constant, relative_covering_radius is that of sets without one.
#[test]
fn the_figures_of_points_in_a_row_are_those_of_the_definitions() {
    let (density, context) = (|_: Place| 1.0, Context::new(1).unwrap());
    let rows = [vec![[1.0, 2.0], [23.0, 2.0]], vec![[1.0, 2.0], [12.0, 2.0], [23.0, 2.0]]];
    for (height, points) in [4.0, 2.5].into_iter().flat_map(|height| rows.each_ref().map(|row| (height, row))) {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [0.0; 2], max: [24.0, height], boundary };
            let options = DelaunayOptions::new(domain).max_iterations(0);
            let (_, report) =
                relax_with_density(&context, &options, &Density::Function(&density), points, None).unwrap();
            let (_, plain) = relax(&context, &options.into(), points, None).unwrap();
            let rho = Scene::new(domain, &density, points.len()).rho(points);
            assert!((report.rho / rho - 1.0).abs() < 1e-5, "{domain:?}: {rho}, {report:?}");
            assert!(
                (report.relative_covering_radius / plain.relative_covering_radius - 1.0).abs() < 1e-5,
                "{domain:?}: {plain:?}, {report:?}"
            );
        }
    }
}

/// The definitions notice a point that is missing and one that is moved.
#[test]
fn the_oracle_notices_points_that_are_missing_or_moved() {
    let domain = unit_square(Boundary::Periodic);
    let (points, report) = relaxed(domain, &Density::Function(&DENSITIES[2].1), 150, 100);
    let scene = Scene::new(domain, &DENSITIES[2].1, 150);
    for index in [0, 100, 149] {
        let mut fewer = points.clone();
        fewer.remove(index);
        assert!(scene.relative_covering_radius(&fewer) > 1.05 * report.relative_covering_radius);
        let mut moved = points.clone();
        moved[index] = moved[(index + 1) % 150].map(|x| x + 1e-4);
        assert!(
            scene.rho(&moved) < 0.1 && scene.relative_covering_radius(&moved) > 1.05 * report.relative_covering_radius
        );
    }
}
