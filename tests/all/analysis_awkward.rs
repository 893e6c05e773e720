//! The figures of awkward sets against their definitions: few points, coincident ones, points on the boundary, thin domains.

use std::f64::consts::PI;

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::coverage::{
    coverage_2d, covering_radius_2d, surface_coverage, surface_covering_radius, surface_uncovered_fraction,
};
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::spacing::{nearest_distances_2d, smallest_distance_3d};
use azulejo::analysis::triangles::{Triangle, delaunay_triangles};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain};
use glam::DVec2;

use crate::common::meshes;
use crate::common::sets::{Random, distance, nearest_distances};
use crate::common::triangle::distance as straight;

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn context() -> Context {
    Context::new(2).unwrap()
}

/// Domains of several shapes with few points each, some of them coincident or on the boundary.
fn cases() -> Vec<(Domain, Vec<[f32; 2]>)> {
    let mut cases = Vec::new();
    for (i, [width, height]) in [[1.0, 1.0], [7.0, 1.0], [0.01, 3.0], [1e4, 1.0]].into_iter().enumerate() {
        for boundary in BOUNDARIES {
            let domain = Domain { min: [2.0, -1.0], max: [2.0 + width, -1.0 + height], boundary };
            for count in [1, 2, 3, 6] {
                let mut random = Random::new(10 * i as u64 + count);
                let mut point = || [2.0 + random.unit() * width as f32, -1.0 + random.unit() * height as f32];
                let mut points: Vec<_> = (0..count).map(|_| point()).collect();
                cases.push((domain, points.clone()));
                points.extend_from_within(..);
                cases.push((domain, points.clone()));
                points.extend([[2.0, -1.0], [2.0, points[0][1]], [points[0][0], -1.0]]);
                cases.push((domain, points));
            }
        }
    }
    cases
}

/// A point or one of its images: on a torus moved by periods, in a bounded domain mirrored by the boundary.
#[derive(Clone, Copy)]
struct Image {
    point: usize,
    place: DVec2,
    is_original: bool,
}

/// The points, without those that coincide with one before them, and all images in the domains around.
fn images(domain: &Domain, points: &[[f32; 2]]) -> Vec<Image> {
    let (min, size) = (DVec2::from(domain.min), DVec2::from(domain.extent()));
    let mut images = Vec::new();
    for (point, &place) in points.iter().enumerate().filter(|&(i, point)| !points[..i].contains(point)) {
        let place = DVec2::new(place[0].into(), place[1].into()) - min;
        for side in (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y])) {
            let along = |axis: usize| match (domain.boundary, side[axis]) {
                (Boundary::Periodic, turns) => place[axis] + f64::from(turns) * size[axis],
                (Boundary::Bounded, 0) => place[axis],
                (Boundary::Bounded, side) => f64::from(1 + side) * size[axis] - place[axis],
            };
            images.push(Image { point, place: DVec2::new(along(0), along(1)), is_original: side == [0, 0] });
        }
    }
    images
}

/// The centre of the circle through three points, unless they are on a line.
fn circumcentre([a, b, c]: [DVec2; 3]) -> Option<DVec2> {
    let (ab, ac) = (b - a, c - a);
    let area = 2.0 * ab.perp_dot(ac);
    let centre = a + (ab.length_squared() * -ac.perp() + ac.length_squared() * ab.perp()) / area;
    (area.abs() > 1e-12 * ab.length() * ac.length()).then_some(centre)
}

/// All triples of images with an original.
fn triples(images: &[Image]) -> impl Iterator<Item = [Image; 3]> {
    let count = images.len();
    let triples =
        (0..count).flat_map(move |a| (a + 1..count).flat_map(move |b| (b + 1..count).map(move |c| [a, b, c])));
    triples.map(|triple| triple.map(|i| images[i])).filter(|triple| triple.iter().any(|image| image.is_original))
}

/// The largest distance of a place from the points: it is at a vertex of the Voronoi diagram, where one of its edges meets
/// the boundary, or in a corner.
fn covering_radius(domain: &Domain, points: &[[f32; 2]]) -> f64 {
    let (images, size) = (images(domain, points), DVec2::from(domain.extent()));
    let mut places: Vec<_> = triples(&images).filter_map(|triple| circumcentre(triple.map(|i| i.place))).collect();
    if domain.boundary == Boundary::Periodic {
        places.iter_mut().for_each(|place| *place -= size * (*place / size).floor());
    }
    if domain.boundary == Boundary::Bounded {
        places.extend([DVec2::ZERO, DVec2::new(size.x, 0.0), DVec2::new(0.0, size.y), size]);
        let originals: Vec<_> = images.iter().filter(|image| image.is_original).map(|image| image.place).collect();
        for (i, &a) in originals.iter().enumerate() {
            for &b in &originals[..i] {
                let (middle, way) = (0.5 * (a + b), b - a);
                // Places x with (x - middle) · way = 0.
                for y in [0.0, size.y] {
                    places.push(DVec2::new(middle.x - (y - middle.y) * way.y / way.x, y));
                }
                for x in [0.0, size.x] {
                    places.push(DVec2::new(x, middle.y - (x - middle.x) * way.x / way.y));
                }
            }
        }
    }
    let slack = 1e-9 * size;
    let inside = |place: &DVec2| place.cmpge(-slack).all() && place.cmple(size + slack).all();
    let nearest = |place: DVec2| images.iter().map(|image| image.place.distance(place)).fold(f64::INFINITY, f64::min);
    places.into_iter().filter(inside).map(nearest).fold(0.0, f64::max)
}

#[test]
fn covering_radii_are_those_of_all_voronoi_vertices() {
    for (domain, points) in cases() {
        let found = covering_radius_2d(&context(), &domain, &points, None).unwrap();
        let expected = covering_radius(&domain, &points);
        assert!((found / expected - 1.0).abs() < 1e-6, "{found}, not {expected}: {domain:?} {points:?}");
        // Above the covering radius there is no gap, and below there is one.
        let gaps = |factor: f64| coverage_2d(&context(), &domain, &points, factor * expected, None).unwrap().gaps;
        assert_eq!(gaps(1.0 + 1e-5), 0);
        assert!((1..=4 * points.len()).contains(&gaps(0.999)), "{} gaps: {domain:?} {points:?}", gaps(0.999));
    }
}

#[test]
fn nearest_distances_and_pairs_are_those_of_all_pairs() {
    for (domain, points) in cases() {
        let found = nearest_distances_2d(&context(), &domain, &points, None).unwrap();
        for (found, expected) in std::iter::zip(found, nearest_distances(&domain, &points)) {
            // A torus that holds one point has no other.
            assert!(found == expected || (found - expected).abs() < 1e-12 * expected, "{found}, not {expected}");
        }
        let [width, height] = domain.extent();
        let (unit, bins) = (domain.hexagonal_distance(points.len()), 4);
        let reach = 0.4 * width.min(height) / unit;
        if points.len() < 2 {
            continue;
        }
        let mut counts = vec![0.0; bins];
        for (i, a) in points.iter().enumerate() {
            for b in points.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, b)| b) {
                let bin = distance(&domain, *a, *b) / (reach * unit) * bins as f64;
                let [x, y] = [0, 1].map(|axis| f64::from((a[axis] - b[axis]).abs()));
                let stays = (1.0 - x / width) * (1.0 - y / height);
                if bin < bins as f64 {
                    counts[bin as usize] += if domain.boundary == Boundary::Bounded { 1.0 / stays } else { 1.0 };
                }
            }
        }
        let found = radial_distribution(&context(), &domain, &points, reach, bins, None).unwrap();
        for (bin, (found, count)) in std::iter::zip(found.density(), counts).enumerate() {
            let ring = PI * (2 * bin + 1) as f64 * (reach * unit / bins as f64).powi(2);
            let expected = count * domain.area() / ((points.len() * (points.len() - 1)) as f64 * ring);
            assert!((found - expected).abs() < 1e-4 * (1.0 + expected), "{found}, not {expected}: {domain:?}");
        }
    }
}

/// The triangles whose circles are empty; none if four points are on one of the circles, as in every lattice.
fn triangles(images: &[Image]) -> Option<Vec<[Image; 3]>> {
    let mut found = Vec::new();
    for triple in triples(images) {
        let Some(centre) = circumcentre(triple.map(|image| image.place)) else { continue };
        let radius = centre.distance(triple[0].place);
        let within = |factor: f64| images.iter().filter(|image| image.place.distance(centre) < factor * radius).count();
        match [within(1.0 - 1e-7), within(1.0 + 1e-7)] {
            [0, 3] => found.push(triple),
            [0, _] => return None,
            _ => {}
        }
    }
    Some(found)
}

#[test]
fn triangles_and_bonds_are_those_with_empty_circles() {
    let mut compared = 0;
    for (domain, points) in cases().into_iter().filter(|(domain, _)| domain.boundary == Boundary::Periodic) {
        let images = images(&domain, &points);
        let Some(triangles) = triangles(&images) else { continue };
        compared += 1;
        // Of a triangle's images that one counts whose first corner is in the domain.
        let order = |a: &&Image, b: &&Image| {
            a.point.cmp(&b.point).then(a.place.x.total_cmp(&b.place.x)).then(a.place.y.total_cmp(&b.place.y))
        };
        let counts = |corners: &&[Image; 3]| corners.iter().min_by(order).unwrap().is_original;
        let shape = |triangle: Triangle| {
            let mut edges = triangle.edges();
            edges.sort_by(f64::total_cmp);
            edges
        };
        let in_plane = |corners: &[Image; 3]| {
            let mut corners = corners.map(|corner| corner.place);
            if (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) < 0.0 {
                corners.swap(1, 2);
            }
            Triangle { corners: corners.map(DVec2::into) }
        };
        let mut expected: Vec<_> = triangles.iter().filter(counts).map(|corners| shape(in_plane(corners))).collect();
        let found = delaunay_triangles(&context(), &domain, &points, None).unwrap();
        let area: f64 = found.iter().map(Triangle::area).sum();
        assert!((area / domain.area() - 1.0).abs() < 1e-6, "{area}: {domain:?} {points:?}");
        let mut found: Vec<_> = found.into_iter().map(shape).collect();
        // Each edge is one of two triangles, so that only all three tell which triangle it is.
        let length = |edges: &[f64; 3]| edges.iter().sum::<f64>();
        for shapes in [&mut expected, &mut found] {
            shapes.sort_by(|a, b| length(a).total_cmp(&length(b)));
        }
        assert_eq!(found.len(), expected.len(), "{domain:?} {points:?}");
        for (found, expected) in std::iter::zip(found.as_flattened(), expected.as_flattened()) {
            assert!((found / expected - 1.0).abs() < 1e-5, "{found}, not {expected}: {domain:?} {points:?}");
        }

        let orders = images.iter().filter(|image| image.is_original).map(|image| {
            let of_it = triangles.iter().filter(|corners| corners.iter().any(|corner| corner.place == image.place));
            let mut ways: Vec<_> = of_it.flatten().map(|corner| corner.place - image.place).collect();
            ways.retain(|way| *way != DVec2::ZERO);
            // Each neighbour is a corner of two triangles.
            let sum: DVec2 = ways.iter().map(|way| DVec2::from_angle(6.0 * way.to_angle())).sum();
            sum.length() / ways.len() as f64
        });
        let orders: Vec<_> = orders.collect();
        let expected = orders.iter().sum::<f64>() / orders.len() as f64;
        let order = bond_order(&context(), &domain, &points, None).unwrap();
        assert!((order - expected).abs() < 1e-5, "{order}, not {expected}: {domain:?} {points:?}");
    }
    assert!(compared > 12, "{compared} sets without four points on a circle");
}

/// Meshes with few samples, against places all over them: no place is farther than the covering radius, and the nearest of
/// them to the farthest is as far but for their own distance.
#[test]
fn surfaces_with_few_samples_are_covered_as_their_places_are() {
    let soups = [meshes::plane(), meshes::sphere(), meshes::needles(300.0), meshes::sheets(0.01)];
    for (positions, triangles) in soups {
        let mesh = Mesh::new(positions, triangles).unwrap();
        let mut random = Random::new(3);
        let mut sample = || {
            let (u, v) = (0.5 * random.unit(), 0.5 * random.unit());
            mesh.point((random.unit() * mesh.triangles().len() as f32) as u32 % mesh.triangles().len() as u32, [u, v])
        };
        let all: Vec<_> = (0..5).map(|_| sample()).collect();
        let twice = [&all[..], &all[..]].concat();
        for samples in [&all[..1], &all[..2], &all[..3], &all[..], &twice[..]] {
            let pairs =
                samples.iter().enumerate().flat_map(|(i, a)| samples[..i].iter().map(move |b| straight(*a, *b)));
            let smallest = pairs.fold(f64::INFINITY, f64::min);
            let found = smallest_distance_3d(&context(), samples, None).unwrap();
            assert!(found == smallest || (found - smallest).abs() < 1e-12, "{found}, not {smallest}");

            let (farthest, step) = farthest_place(&mesh, samples, 40);
            let found = surface_covering_radius(&context(), &mesh, samples, None).unwrap();
            assert!((farthest - 1e-6..=farthest + step).contains(&found), "{found}, not {farthest} + {step}");
            let coverage = surface_coverage(&context(), &mesh, samples, 0.7 * found, None).unwrap();
            assert!(coverage.farthest == found && coverage.gaps > 0);
            assert_eq!(surface_coverage(&context(), &mesh, samples, 1.001 * found, None).unwrap().gaps, 0);
            let open = surface_uncovered_fraction(&context(), &mesh, samples, 1.001 * found, 2000, 1, None).unwrap();
            assert_eq!(open, 0.0);
        }
    }
}

/// The largest distance of a lattice of places of a mesh from samples, and how far other places can be from the lattice.
fn farthest_place(mesh: &Mesh, samples: &[[f32; 3]], steps: u32) -> (f64, f64) {
    let (mut farthest, mut longest): (f64, f64) = (0.0, 0.0);
    for triangle in (0..mesh.triangles().len() as u32).filter(|&triangle| mesh.triangle_area(triangle) > 0.0) {
        for (u, v) in (0..=steps).flat_map(|u| (0..=steps - u).map(move |v| (u, v))) {
            let place = mesh.point(triangle, [u, v].map(|x| x as f32 / steps as f32));
            farthest =
                farthest.max(samples.iter().map(|&sample| straight(sample, place)).fold(f64::INFINITY, f64::min));
        }
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|place| mesh.point(triangle, place));
        longest = (0..3).map(|i| straight(corners[i], corners[(i + 1) % 3])).fold(longest, f64::max);
    }
    (farthest, longest / f64::from(steps) + 1e-6)
}
