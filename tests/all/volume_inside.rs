//! Sets inside of meshes against their definition: no sample outside, no conflict, no place open that is deeper than the report
//! says.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::volume::{InsideOptions, InsideReport, Surface, sample_inside};
use azulejo::{Boundary, Context, Domain, Error, Given, Order, Points, psp};

use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::volume_oracle::{conflict, distance, sample_in_ball};

pub fn made(mesh: &Arc<Mesh>, options: &InsideOptions) -> (Points<3>, InsideReport) {
    sample_inside(&Context::new(1).unwrap(), mesh, options, None).unwrap()
}

pub fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

pub fn space(mesh: &Mesh) -> Domain<3> {
    let (min, max) = mesh.bounds();
    Domain { min: min.map(f64::from), max: max.map(|x| f64::from(x) + 1e-3), boundary: Boundary::Bounded }
}

/// The distance of a point from a triangle, by the nearest of the points of its plane, edges and corners.
fn distance_from_triangle(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let to_edge = |a: [f64; 3], b: [f64; 3]| {
        let (edge, to) = (minus(b, a), minus(p, a));
        let share = (dot(edge, to) / dot(edge, edge).max(1e-300)).clamp(0.0, 1.0);
        let rest = [0, 1, 2].map(|k| to[k] - share * edge[k]);
        dot(rest, rest).sqrt()
    };
    let normal = cross(minus(b, a), minus(c, a));
    let is_left = |a: [f64; 3], b: [f64; 3]| dot(cross(minus(b, a), minus(p, a)), normal) >= 0.0;
    let edges = to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a));
    let length = dot(normal, normal).sqrt();
    if length > 0.0 && is_left(a, b) && is_left(b, c) && is_left(c, a) {
        return (dot(minus(p, a), normal) / length).abs().min(edges);
    }
    edges
}

pub fn corners(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions()[vertex as usize].map(f64::from));
    mesh.triangles().iter().map(corners).collect()
}

pub fn depth(triangles: &[[[f64; 3]; 3]], point: [f64; 3]) -> f64 {
    triangles.iter().map(|&triangle| distance_from_triangle(point, triangle)).fold(f64::INFINITY, f64::min)
}

/// A place inside that is deeper than `depth`, less deep than `end`, and lies in no ball, by halving boxes until each lies in a ball, near to the
/// surface, outside, or is smaller than `finest`. Triangles are those that may be the nearest one of a point of the box.
fn gap(
    mesh: &Mesh,
    triangles: &[[[f64; 3]; 3]],
    balls: &[([f64; 3], f64)],
    [min, max]: [[f64; 3]; 2],
    [depth, end, finest]: [f64; 3],
) -> Option<[f64; 3]> {
    let length = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let centre = [0, 1, 2].map(|k: usize| 0.5 * (min[k] + max[k]));
    let half = length([0, 1, 2].map(|k: usize| 0.5 * (max[k] - min[k])));
    let from_centre = |place: [f64; 3]| length([0, 1, 2].map(|k: usize| place[k] - centre[k]));
    if balls.iter().any(|&(ball, radius)| from_centre(ball) + half <= radius) {
        return None;
    }
    let distances: Vec<f64> = triangles.iter().map(|&t| distance_from_triangle(centre, t)).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    // A box beside the surface lies on one side of it, as far as its centre's float does.
    let is_inside = || mesh.contains(centre.map(|x| x as f32));
    if nearest + half <= depth || nearest - half >= end || half < finest || nearest > half + 1e-6 && !is_inside() {
        return None;
    }
    let is_between = nearest > depth + 1e-6 && nearest < end - 1e-6;
    if is_between && balls.iter().all(|&(ball, radius)| from_centre(ball) > radius) && is_inside() {
        return Some(centre);
    }
    let near = |&(ball, radius): &([f64; 3], f64)| from_centre(ball) <= radius + half;
    let balls: Vec<_> = balls.iter().copied().filter(near).collect();
    let may_be_nearest = distances.iter().map(|&distance| distance <= nearest + 2.0 * half);
    let triangles: Vec<_> = triangles.iter().zip(may_be_nearest).filter(|pair| pair.1).map(|pair| *pair.0).collect();
    let axis = (0..3).max_by(|&a, &b| (max[a] - min[a]).total_cmp(&(max[b] - min[b]))).unwrap();
    let (mut lower, mut upper) = (max, min);
    (lower[axis], upper[axis]) = (centre[axis], centre[axis]);
    gap(mesh, &triangles, &balls, [min, lower], [depth, end, finest])
        .or_else(|| gap(mesh, &triangles, &balls, [upper, max], [depth, end, finest]))
}

/// True if most rays in random directions cross an odd number of triangles, by sums of floats.
pub fn votes_inside(mesh: &Mesh, point: [f32; 3], random: &mut Random) -> bool {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let point = point.map(f64::from);
    let crosses = |triangle: &[u32; 3], along: [f64; 3]| {
        let [a, b, c] = triangle.map(|vertex| minus(mesh.positions()[vertex as usize].map(f64::from), point));
        let side = |p: [f64; 3], q: [f64; 3]| dot(along, cross(p, q)) > 0.0;
        let normal = cross(minus(b, a), minus(c, a));
        side(a, b) == side(b, c) && side(b, c) == side(c, a) && (dot(normal, a) > 0.0) == (dot(normal, along) > 0.0)
    };
    let odd = (0..5).filter(|_| {
        let along = [0; 3].map(|_: i32| f64::from(random.unit()) - 0.5);
        mesh.triangles().iter().filter(|triangle| crosses(triangle, along)).count() % 2 == 1
    });
    odd.count() >= 3
}

/// The balls that cover what a report says of a shell, of samples and given ones, and the place that is open in spite of them.
pub fn open_place(
    mesh: &Mesh,
    samples: &[[f32; 3]],
    report: &InsideReport,
    given: &[([f32; 3], f64)],
    thickness: f64,
) -> Option<[f64; 3]> {
    let limit = report.covering_radius + 7.0 * f64::from(f32::EPSILON) * 4.0;
    let of_given = given.iter().map(|&(centre, clearance)| (centre, clearance + 1e-6));
    let balls = samples.iter().map(|&sample| (sample, limit)).chain(of_given);
    let balls: Vec<_> = balls.map(|(centre, radius)| (centre.map(f64::from), radius)).collect();
    let Domain { min, max, .. } = space(mesh);
    let finest = 1e-3 * report.radius.min(thickness);
    gap(mesh, &corners(mesh), &balls, [min, max], [report.depth, thickness - report.depth, finest])
}

/// Checks a set of all of the inside, and gives the number of random points inside that are covered.
fn check(mesh: &Mesh, points: &Points<3>, report: &InsideReport, given: &[([f32; 3], f64)]) -> usize {
    check_shell(mesh, points, report, given, f64::INFINITY)
}

/// Checks a set of a shell, and gives the number of random points in it that are covered.
pub fn check_shell(
    mesh: &Mesh,
    points: &Points<3>,
    report: &InsideReport,
    given: &[([f32; 3], f64)],
    thickness: f64,
) -> usize {
    let (domain, new) = (space(mesh), &points.positions[report.surface_samples..]);
    assert_eq!(new.iter().find(|&&sample| !mesh.contains(sample)), None, "outside");
    assert_eq!(conflict(&domain, report.radius, &points.positions), None);
    let balls: Vec<_> = given.iter().map(|&(centre, clearance)| (centre.map(f64::from), clearance)).collect();
    assert_eq!(sample_in_ball(&domain, &points.positions, &balls), None);
    let (mut random, mut covered) = (Random::new(17), 0);
    for &sample in new.iter().step_by(1 + new.len() / 100) {
        assert!(votes_inside(mesh, sample, &mut random), "{sample:?}");
    }
    let open = open_place(mesh, &points.positions, report, given, thickness);
    assert_eq!(open, None, "open, deeper than {}", report.depth);
    let (limit, triangles) = (report.covering_radius + 7.0 * f64::from(f32::EPSILON) * 4.0, corners(mesh));
    if thickness.is_finite() {
        let too_deep = new.iter().find(|sample| depth(&triangles, sample.map(f64::from)) > thickness * (1.0 + 1e-12));
        assert_eq!(too_deep, None, "deeper than {thickness}");
    }
    for _ in 0..6_000 {
        let place = [0, 1, 2].map(|k: usize| (domain.min[k] + domain.extent()[k] * f64::from(random.unit())) as f32);
        if !mesh.contains(place) {
            continue;
        }
        let place = place.map(f64::from);
        let near = |samples: &[[f32; 3]]| samples.iter().any(|s| distance(&domain, s.map(f64::from), place) < limit);
        if near(&points.positions) || balls.iter().any(|&(c, r)| distance(&domain, c, place) < r + 1e-6) {
            covered += usize::from(thickness.is_infinite() || depth(&triangles, place) <= thickness);
        } else {
            let depth = depth(&triangles, place);
            let is_at_border = depth <= report.depth || depth >= thickness - report.depth;
            assert!(is_at_border, "{place:?} is open, {depth} deep of {}", report.depth);
        }
    }
    covered
}

pub fn scaled((mut positions, triangles): Soup, scale: f32) -> Soup {
    positions.iter_mut().for_each(|p| *p = p.map(|x| x * scale));
    (positions, triangles)
}

pub fn cube() -> Soup {
    let positions = (0..8).map(|k| [(k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32]).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (positions, faces.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect())
}

/// A star of large triangles whose planes run through its inside.
pub fn star() -> Soup {
    let (mut positions, mut triangles) = cube();
    positions.iter_mut().for_each(|p| *p = p.map(|x| x - 0.5));
    for face in 0..6 {
        let [a, b, c] = triangles[2 * face];
        let d = triangles[2 * face + 1][2];
        let middle = [a, c].map(|vertex| positions[vertex as usize]);
        let tip = positions.len() as u32;
        positions.push([0, 1, 2].map(|k| 1.5 * (middle[0][k] + middle[1][k])));
        triangles.extend([[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]]);
    }
    (positions, triangles.split_off(12))
}

pub fn closed_shapes() -> Vec<(&'static str, Soup, f64)> {
    let sphere = || meshes::welded(meshes::sphere());
    let shells = meshes::join([sphere(), scaled(sphere(), 0.7), scaled(sphere(), 0.4)]);
    vec![
        ("cube", cube(), 0.1),
        ("star", star(), 0.11),
        ("sphere", sphere(), 0.2),
        ("torus", meshes::welded(meshes::torus()), 0.16),
        ("shells", shells, 0.17),
        ("far torus", meshes::welded(meshes::placed(meshes::torus(), 1.0, 3.0)), 0.2),
        (
            "two tori",
            meshes::join([meshes::welded(meshes::torus()), scaled(meshes::welded(meshes::torus()), 0.8)]),
            0.15,
        ),
    ]
}

#[test]
fn closed_meshes_are_filled() {
    for (name, soup, radius) in closed_shapes() {
        let mesh = mesh(soup);
        assert!(mesh.is_closed(), "{name}");
        for seed in 0..2 {
            for surface in [Surface::Open, Surface::First] {
                let (points, report) = made(&mesh, &InsideOptions::new(radius).seed(seed).surface(surface));
                assert!(points.len() > 100, "{name}: {}", points.len());
                assert!(check(&mesh, &points, &report, &[]) > 300, "{name}");
            }
        }
    }
}

/// Two closed copies of a surface enclose nothing.
#[test]
fn meshes_that_enclose_nothing_are_refused() {
    let doubled = |soup: Soup| mesh(meshes::join([(soup.0.clone(), soup.1.clone()), soup]));
    let refuse = |mesh: &Arc<Mesh>, options: InsideOptions| {
        assert!(mesh.is_closed());
        let error = sample_inside(&Context::new(1).unwrap(), mesh, &options, None).unwrap_err().to_string();
        assert!(error.starts_with("mesh: encloses nothing"), "{error}");
    };
    let soups =
        [meshes::plane(), meshes::sheets(0.2), meshes::book(4), meshes::random_soup(2, 60), meshes::needles(1e-3)];
    for mesh in soups.map(doubled) {
        refuse(&mesh, InsideOptions::new(0.1));
        refuse(&mesh, InsideOptions::new(0.1).order(Order::Progressive));
        refuse(&mesh, InsideOptions::by_count(5));
    }
    // The same plane by other triangles, which no sample finds.
    let square = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    refuse(&mesh((square, vec![[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]])), InsideOptions::new(0.1));
    // What is thinner than the tolerance may stay open, and is not refused.
    let (positions, triangles) = cube();
    let thin = positions.into_iter().map(|[x, y, z]| [x, y, 1e-4 * z]).collect();
    made(&mesh((thin, triangles)), &InsideOptions::new(0.3));
}

/// The surface comes first, as the sampler of surfaces makes it.
#[test]
fn samples_of_the_surface_come_first() {
    let mesh = mesh(meshes::welded(meshes::torus()));
    let options = InsideOptions::new(0.12).seed(4).surface(Surface::First);
    let (points, report) = made(&mesh, &options);
    let surface = psp::sample(&Context::new(1).unwrap(), &mesh, &psp::Options::new(0.12).seed(4), None).unwrap().0;
    assert_eq!(points.positions[..report.surface_samples], surface.positions);
    assert!(report.surface_samples > 300 && points.len() > report.surface_samples + 100);
    let refused = |options: InsideOptions| {
        let error =
            sample_inside(&Context::new(1).unwrap(), &mesh, &options.surface(Surface::First), None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument: "surface", .. }), "{error}");
    };
    refused(InsideOptions::by_count(100));
    refused(InsideOptions::new(0.1).order(Order::Progressive));
}

#[test]
fn given_samples_keep_their_clearances() {
    let mesh = mesh(meshes::welded(meshes::sphere()));
    let mut random = Random::new(6);
    let positions: Vec<_> = (0..40).map(|_| [0; 3].map(|_: i32| 2.4 * random.unit() - 1.2)).collect();
    let clearances: Vec<_> = (0..40).map(|i| [0.0, 0.05, 0.3][i % 3]).collect();
    let given: Vec<_> = positions.iter().copied().zip(clearances.iter().copied()).collect();
    for surface in [Surface::Open, Surface::First] {
        let with = Given::with_clearances(&positions, &clearances);
        let (points, report) = made(&mesh, &InsideOptions::new(0.15).given(with).surface(surface));
        assert!(check(&mesh, &points, &report, &given) > 1_000);
    }
    let alike: Vec<_> = positions.iter().map(|&p| (p, 0.15)).collect();
    let (points, report) = made(&mesh, &InsideOptions::new(0.15).given(Given::at(&positions)));
    assert!(check(&mesh, &points, &report, &alike) > 1_000);
}

#[test]
fn counts_are_exact_and_orders_progressive() {
    for soup in [meshes::welded(meshes::torus()), star()] {
        let mesh = mesh(soup);
        for count in [1, 2, 7, 300, 1000] {
            let (points, report) = made(&mesh, &InsideOptions::by_count(count));
            assert_eq!(points.len(), count);
            check(&mesh, &points, &report, &[]);
            let (ordered, _) = made(&mesh, &InsideOptions::by_count(count).order(Order::Progressive));
            let (more, _) = made(&mesh, &InsideOptions::by_count(count + 50).order(Order::Progressive));
            assert_eq!(ordered.positions, more.positions[..count]);
            for i in 1..count.min(400) {
                let rank = f64::from(ordered.ranks[i]);
                let place = |i: usize| ordered.positions[i].map(f64::from);
                assert!((0..i).all(|k| distance(&space(&mesh), place(k), place(i)) >= rank));
            }
        }
    }
}

#[test]
fn seeds_and_not_threads_decide() {
    check_seeds_and_threads(&mesh(meshes::welded(meshes::torus())), InsideOptions::new(0.04));
}

/// Another seed makes another set, other numbers of threads make the same one.
pub fn check_seeds_and_threads(mesh: &Arc<Mesh>, options: InsideOptions) {
    for surface in [Surface::Open, Surface::First] {
        let options = options.seed(1).surface(surface);
        let first = made(mesh, &options).0.positions;
        assert_ne!(first, made(mesh, &options.seed(2)).0.positions);
        for threads in [2, 3] {
            let context = Context::new(threads).unwrap();
            assert_eq!(first, sample_inside(&context, mesh, &options, None).unwrap().0.positions);
        }
    }
}

#[test]
fn tolerances_bound_what_stays_open_and_bad_ones_are_refused() {
    let mesh = mesh(star());
    for tolerance in [0.5, 0.25, 1.0 / 64.0] {
        let (points, report) = made(&mesh, &InsideOptions::new(0.2).tolerance(tolerance));
        assert!((report.depth / (3f64.sqrt() * 0.2 * tolerance) - 1.0).abs() < 0.01, "{}", report.depth);
        check(&mesh, &points, &report, &[]);
    }
    for tolerance in [0.0, -1.0, 0.6, 1e-3, f64::NAN] {
        let options = InsideOptions::new(0.2).tolerance(tolerance);
        let error = sample_inside(&Context::new(1).unwrap(), &mesh, &options, None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument: "tolerance", .. }), "{error}");
    }
    // Radii beyond the mesh: a sample at most.
    for radius in [10.0, 1e6] {
        assert!(made(&mesh, &InsideOptions::new(radius)).0.len() <= 1);
    }
}

/// The oracle finds a sample that is missing.
#[test]
fn the_oracle_can_fail() {
    let mesh = mesh(cube());
    let (mut points, report) = made(&mesh, &InsideOptions::new(0.25));
    let inner = |p: &[f32; 3]| p.iter().all(|x| (0.3..0.7).contains(x));
    let missing = points.positions.iter().position(inner).unwrap();
    points.positions.remove(missing);
    assert!(open_place(&mesh, &points.positions, &report, &[], f64::INFINITY).is_some());
    assert!(std::panic::catch_unwind(|| check(&mesh, &points, &report, &[])).is_err());
}
