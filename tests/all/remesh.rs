//! Remeshing: the triangles of samples, on smooth, open, sharp and broken meshes.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use azulejo::dcr::surface::{Options, RemeshReport, relax, remesh};
use azulejo::mesh::Mesh;
use azulejo::{Context, Error, Points, psp};
use glam::{DVec2, Vec3};

use crate::common::meshes::{self, Soup};

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// About `count` samples, relaxed.
fn relaxed(mesh: &Arc<Mesh>, count: f64, seed: u64) -> Points<3> {
    let context = Context::new(2).unwrap();
    let darts = darts(mesh, count, seed);
    relax(&context, mesh, &darts.triangles, &darts.barycentrics, &Options::default(), None).unwrap().0
}

fn darts(mesh: &Arc<Mesh>, count: f64, seed: u64) -> Points<3> {
    let radius = (0.7 * mesh.area() / count).sqrt();
    psp::sample(&Context::new(2).unwrap(), mesh, &psp::Options::new(radius).seed(seed), None).unwrap().0
}

/// The mesh of samples, of which all that is said is verified by a naive count.
fn checked(mesh: &Mesh, samples: &Points<3>) -> (Mesh, RemeshReport) {
    let call = |threads| {
        remesh(&Context::new(threads).unwrap(), mesh, &samples.triangles, &samples.barycentrics, None).unwrap()
    };
    let ((made, report), (same, again)) = (call(1), call(3));
    assert_eq!((made.triangles(), &report), (same.triangles(), &again));
    assert_eq!(made.positions(), samples.positions);
    assert_eq!(fault(samples.len(), made.triangles(), &report), None);
    (made, report)
}

/// The fault in triangles of so many samples, or in what is said of them, if there is one.
fn fault(samples: usize, triangles: &[[u32; 3]], report: &RemeshReport) -> Option<String> {
    let quality = report.quality;
    let mut edges: BTreeMap<BTreeSet<u32>, Vec<bool>> = BTreeMap::new();
    let mut fans: BTreeMap<u32, Vec<BTreeSet<u32>>> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
            edges.entry(BTreeSet::from([a, b])).or_default().push(a < b);
            fans.entry(a).or_default().push(BTreeSet::from([b, c]));
        }
    }
    if edges.values().any(|sides| sides.len() > 2) {
        return Some("an edge has more than two triangles".into());
    }
    if edges.values().any(|sides| sides.len() == 2 && sides[0] == sides[1]) {
        return Some("a triangle is wound against another".into());
    }
    let is_split = |fan: &&Vec<BTreeSet<u32>>| {
        let mut fan = fan.to_vec();
        let mut joined = fan.pop().unwrap();
        while let Some(next) = fan.iter().position(|side| !side.is_disjoint(&joined)) {
            joined.extend(fan.swap_remove(next));
        }
        !fan.is_empty()
    };
    let with = |triangles: usize| edges.values().filter(|sides| sides.len() == triangles).count() as u64;
    let found = [
        triangles.len() as u64,
        with(1),
        with(2),
        0,
        0,
        fans.values().filter(is_split).count() as u64,
        (samples - fans.len()) as u64,
    ];
    let said = [
        report.triangles,
        quality.boundary_edges,
        quality.inner_edges,
        quality.non_manifold_edges,
        quality.twisted_edges,
        quality.non_manifold_vertices,
        quality.unused_vertices,
    ];
    let euler = fans.len() as i64 - edges.len() as i64 + triangles.len() as i64;
    (found != said || quality.euler != euler).then(|| format!("{found:?}, {euler} and not {said:?}, {}", quality.euler))
}

#[test]
fn the_oracle_notices_broken_meshes_and_counts_that_are_wrong() {
    let mesh = mesh(meshes::torus());
    let samples = relaxed(&mesh, 500.0, 7);
    let (made, report) = checked(&mesh, &samples);
    let fault = |change: &dyn Fn(&mut Vec<[u32; 3]>, &mut RemeshReport)| {
        let (mut triangles, mut report) = (made.triangles().to_vec(), report);
        change(&mut triangles, &mut report);
        fault(samples.len(), &triangles, &report)
    };
    assert_eq!(fault(&|_, _| ()), None);
    for index in (0..made.triangles().len()).step_by(17) {
        assert!(
            fault(&|triangles, _| {
                triangles.remove(index);
            })
            .is_some()
        );
        assert!(fault(&|triangles, _| triangles[index].swap(0, 1)).unwrap().contains("wound"));
        assert!(fault(&|triangles, _| triangles.push(triangles[index])).unwrap().contains("more than two"));
        // A corner at another sample.
        assert!(
            fault(&|triangles, _| triangles[index][0] = (triangles[index][0] + 250) % samples.len() as u32).is_some()
        );
    }
    let wrong: [&dyn Fn(&mut RemeshReport); 8] = [
        &|report| report.triangles -= 1,
        &|report| report.quality.boundary_edges += 1,
        &|report| report.quality.inner_edges += 1,
        &|report| report.quality.non_manifold_edges += 1,
        &|report| report.quality.twisted_edges += 1,
        &|report| report.quality.non_manifold_vertices += 1,
        &|report| report.quality.unused_vertices += 1,
        &|report| report.quality.euler += 2,
    ];
    wrong.iter().for_each(|wrong| assert!(fault(&|_, report| wrong(report)).is_some()));
    // Two fans that meet at one vertex alone.
    let pair = [[0, 1, 2], [0, 3, 4]];
    let mut told = report;
    (told.triangles, told.quality) = (2, Mesh::new(samples.positions[..5].to_vec(), pair.to_vec()).unwrap().quality());
    assert_eq!((told.quality.non_manifold_vertices, self::fault(5, &pair, &told)), (1, None));
}

/// Wherever samples resolve a closed surface, the result is one of the same kind.
#[test]
fn closed_surfaces_give_closed_surfaces_of_the_same_topology() {
    for (name, soup, euler, least_angle) in [
        ("sphere", meshes::sphere(), 2, 35.0),
        ("torus", meshes::torus(), 0, 35.0),
        ("torus of many triangles", meshes::fine_torus(300, 150), 0, 35.0),
    ] {
        let mesh = mesh(soup);
        for seed in 0..3 {
            let samples = relaxed(&mesh, 1500.0, seed);
            let (made, report) = checked(&mesh, &samples);
            let quality = report.quality;
            assert!(quality.is_closed_manifold() && quality.euler == euler, "{name}, seed {seed}: {report:?}");
            assert_eq!(
                (made.triangles().len() as i64, quality.unused_vertices),
                (2 * (samples.len() as i64 - euler), 0)
            );
            assert!(quality.smallest_angle > least_angle && quality.mean_smallest_angle > 46.0, "{name}: {report:?}");
            assert!(report.disputed < report.triangles / 50, "{name}: {report:?}");
            assert!((made.area() / mesh.area() - 1.0).abs() < 0.02, "{name}: {} of {}", made.area(), mesh.area());
        }
    }
}

/// On a square the triangles are those of the Delaunay triangulation, wherever no circle crosses its sides.
#[test]
fn on_a_square_triangles_are_those_with_empty_circles() {
    let mesh = mesh(meshes::plane());
    for samples in [relaxed(&mesh, 220.0, 1), darts(&mesh, 220.0, 2)] {
        let (made, report) = checked(&mesh, &samples);
        assert!(report.quality.is_manifold() && report.quality.euler == 1, "{report:?}");
        let at = |sample: u32| {
            let [x, y, _] = samples.positions[sample as usize];
            DVec2::new(x.into(), y.into())
        };
        let (low, high) = mesh.bounds();
        let (low, high) = (DVec2::new(low[0].into(), low[1].into()), DVec2::new(high[0].into(), high[1].into()));
        let (mut inside, made) = (0, made.triangles().iter().copied().collect::<BTreeSet<_>>());
        let count = samples.len() as u32;
        for a in 0..count {
            for b in a + 1..count {
                for c in b + 1..count {
                    let (to_b, to_c) = (at(b) - at(a), at(c) - at(a));
                    let doubled = 2.0 * to_b.perp_dot(to_c);
                    let offset = (to_c.perp() * to_b.length_squared() - to_b.perp() * to_c.length_squared()) / -doubled;
                    let (centre, radius) = (at(a) + offset, offset.length());
                    if !((centre - radius).cmpgt(low).all() && (centre + radius).cmplt(high).all()) {
                        continue;
                    }
                    // Up to rounding, which decides where four samples are on a circle.
                    let least = (0..count)
                        .filter(|other| ![a, b, c].contains(other))
                        .map(|other| at(other).distance(centre) / radius)
                        .fold(f64::INFINITY, f64::min);
                    let turned = if doubled > 0.0 { [a, b, c] } else { [a, c, b] };
                    inside += usize::from(made.contains(&turned));
                    assert!(least < 1.0 + 1e-5 || made.contains(&turned), "{turned:?} is missing: {least}");
                    assert!(least > 1.0 - 1e-5 || !made.contains(&turned), "{turned:?} is too much: {least}");
                }
            }
        }
        assert!(inside > samples.len(), "{inside} triangles were tested");
    }
}

#[test]
fn triangles_face_as_the_mesh_does() {
    let (positions, mut triangles) = meshes::sphere();
    for outwards in [1.0, -1.0] {
        let mesh = mesh((positions.clone(), triangles.clone()));
        let (made, _) = checked(&mesh, &relaxed(&mesh, 600.0, 3));
        for triangle in 0..made.triangles().len() as u32 {
            let [a, b, c] = made.corners(triangle).map(Vec3::from);
            assert!(outwards * (b - a).cross(c - a).dot(a + b + c) > 0.0, "triangle {triangle}");
        }
        triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    }
}

/// Meshes that are no surface, or too thin for the samples, still give edges of at most two triangles.
#[test]
fn broken_meshes_give_what_can_be_had() {
    let (sheets, one) = (mesh(meshes::sheets(0.001)), darts(&mesh(meshes::plane()), 300.0, 1));
    let below = one.triangles.iter().map(|triangle| triangle + 2);
    let triangles: Vec<u32> = one.triangles.iter().copied().chain(below).collect();
    let both = sheets.samples_at(&triangles, &one.barycentrics.repeat(2)).unwrap();
    let (_, report) = checked(&sheets, &both);
    assert!(report.quality.is_manifold() && report.quality.euler == 2, "two disks: {report:?}");
    let soups = [
        ("book", meshes::book(3), 200),
        ("sphere, each face three times", meshes::duplicated(meshes::sphere()), 200),
        ("soup", meshes::random_soup(4, 30), 100),
        ("slivers", meshes::slivers(), 1),
    ];
    for (name, soup, least) in soups {
        let mesh = mesh(soup);
        let (_, report) = checked(&mesh, &darts(&mesh, 500.0, 1));
        assert!(report.triangles >= least, "{name}: {report:?}");
    }
}

#[test]
fn calls_without_triangles_are_refused() {
    let mesh = mesh(meshes::sphere());
    let context = Context::new(1).unwrap();
    let refused =
        |triangles: &[u32], barycentrics: &[[f32; 2]]| match remesh(&context, &mesh, triangles, barycentrics, None)
            .map(|made| made.1)
        {
            Err(Error::InvalidArgument { argument, .. }) => argument,
            other => panic!("{other:?}"),
        };
    assert_eq!(refused(&[], &[]), "triangles");
    assert_eq!(refused(&[0, 1], &[[0.2; 2]; 2]), "triangles");
    assert_eq!(refused(&[0], &[[0.2; 2]; 2]), "barycentrics");
    assert_eq!(refused(&[u32::MAX], &[[0.2; 2]]), "triangles");
    // Samples at one place.
    assert_eq!(refused(&[5; 40], &[[0.2; 2]; 40]), "triangles");
}
