//! The attributes of a mesh: normals and a mask.

use std::sync::Arc;

use azulejo::analysis::coverage::surface_uncovered_fraction;
use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, ProjectionOptions, Psp, Report};
use azulejo::{Context, Error, Points};

use crate::common::meshes::{self, Soup};
use crate::common::surface_oracle as oracle;

fn mesh((positions, triangles): Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

/// The argument that is complained of, and how.
fn refusal(result: azulejo::Result<Mesh>) -> (&'static str, String) {
    match result {
        Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
        other => panic!("not refused as an invalid argument: {other:?}"),
    }
}

fn length(vector: [f32; 3]) -> f64 {
    vector.map(|x| f64::from(x).powi(2)).iter().sum::<f64>().sqrt()
}

#[test]
fn normals_that_do_not_fit_are_refused() {
    let plane = || mesh(meshes::plane());
    let up = [0.0, 0.0, 1.0];
    let normals = |count, indices| refusal(plane().with_normals(vec![up; count], indices));
    let reason = |count: usize| format!("{count} of them without indices, but there are 4 vertices");
    for count in [0, 3, 5] {
        assert_eq!(normals(count, None), ("normals", reason(count)));
    }
    for count in [0, 1, 3] {
        let reason = format!("{count} entries, but there are 2 triangles");
        assert_eq!(normals(1, Some(vec![[0; 3]; count])), ("normal_indices", reason));
    }
    let reason = "triangle 1 names normal 7, but there are 7 normals".to_owned();
    assert_eq!(normals(7, Some(vec![[6, 6, 6], [0, 7, 0]])), ("normal_indices", reason));
    for bad in [f32::NAN, f32::INFINITY] {
        let (argument, reason) = refusal(plane().with_normals(vec![up, up, up, [0.0, bad, 0.0]], None));
        assert!(argument == "normals" && reason.starts_with("normal 3 is ["), "{argument} {reason}");
    }
}

#[test]
fn normals_are_interpolated_and_normalised() {
    let (positions, triangles) = meshes::sphere();
    let plain = mesh((positions.clone(), triangles.clone()));
    let smooth = plain.clone().with_normals(positions.clone(), None).unwrap();
    assert!(!plain.has_normals() && smooth.has_normals());
    let context = Context::new(1).unwrap();
    let sample = |mesh: &Mesh| psp::sample(&context, &Arc::new(mesh.clone()), &Options::new(0.1), None).unwrap().0;
    let (without, with) = (sample(&plain), sample(&smooth));
    assert!(without.interpolated_normals.is_empty());
    assert_eq!(with, Points { interpolated_normals: with.interpolated_normals.clone(), ..without.clone() });
    for (normal, position) in with.interpolated_normals.iter().zip(&with.positions) {
        assert!((length(*normal) - 1.0).abs() < 1e-6);
        let expected = position.map(|x| f64::from(x) / length(*position));
        assert!((0..3).all(|axis| (f64::from(normal[axis]) - expected[axis]).abs() < 1e-6));
    }
    assert_ne!(with.interpolated_normals, with.normals);

    // Corners that share a vertex may differ: with the normals of the triangles nothing is smooth.
    let faces = (0..triangles.len() as u32).map(|triangle| plain.normal(triangle)).collect();
    let indices = (0..triangles.len() as u32).map(|triangle| [triangle; 3]).collect();
    let facetted = sample(&smooth.with_normals(faces, Some(indices)).unwrap());
    for (interpolated, normal) in facetted.interpolated_normals.iter().zip(&facetted.normals) {
        assert!((0..3).all(|axis| (interpolated[axis] - normal[axis]).abs() < 1e-6));
    }
}

#[test]
fn where_normals_have_no_direction_it_is_that_of_the_triangle() {
    let with = |normals: [[f32; 3]; 3]| {
        let (mut positions, _) = meshes::plane();
        positions.truncate(3);
        mesh((positions, vec![[0, 1, 2]])).with_normals(normals.to_vec(), None).unwrap()
    };
    let (x, y, down, none) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0; 3]);
    let front = with([x; 3]).normal(0);
    let at = |normals, uv| with(normals).interpolated_normal(0, uv).unwrap();
    assert_eq!(at([none; 3], [0.2, 0.3]), front);
    assert_eq!(at([none, x, y], [0.0, 0.0]), front);
    assert_eq!(at([none, x, y], [0.25, 0.0]), x, "a zero does not turn the others");
    assert_eq!(at([x, [-1.0, 0.0, 0.0], y], [0.5, 0.0]), front);
    assert_eq!(at([[0.1, 0.2, 0.7], [-0.1, -0.2, -0.7], y], [0.5, 1e-8]), front, "roundings have no direction");
    assert_eq!(at([down; 3], [0.2, 0.3]), down, "the caller's word counts, not the winding");
    for length in [f32::MAX, 1e-45] {
        assert_eq!(at([[length, 0.0, 0.0]; 3], [0.5, 0.25]), x);
    }
}

#[test]
fn a_mask_of_another_length_is_refused() {
    for count in [0, 1, 3] {
        let reason = format!("{count} entries, but there are 2 triangles");
        assert_eq!(refusal(mesh(meshes::plane()).with_mask(vec![true; count])), ("mask", reason));
    }
}

#[test]
fn a_mask_counts_in_all_that_a_mesh_says() {
    let positions = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 8.0]];
    let whole = mesh((positions, vec![[0, 1, 2], [0, 1, 3], [0, 0, 1]]));
    let masked = |mask: [bool; 3]| whole.clone().with_mask(mask.to_vec()).unwrap();
    let mesh = masked([false, true, true]);
    assert_eq!((mesh.area(), mesh.bounds()), (8.0, ([0.0; 3], [2.0, 0.0, 8.0])));
    assert_eq!([0, 1, 2].map(|triangle| mesh.triangle_area(triangle)), [0.0, 8.0, 0.0]);
    assert_eq!([0, 1, 2].map(|triangle| mesh.is_sampled(triangle)), [false, true, true]);
    assert_eq!(mesh.triangles(), whole.triangles());
    for nothing in [[false; 3], [false, false, true]] {
        let mesh = masked(nothing);
        assert_eq!((mesh.area(), mesh.bounds()), (0.0, whole.bounds()));
    }
    let again = mesh.with_mask(vec![true; 3]).unwrap();
    assert_eq!((again.area(), again.bounds()), (whole.area(), whole.bounds()), "a mask replaces the one before");
}

/// The mesh without the triangles that a mask leaves out, and the numbers of the others.
fn removed((positions, triangles): &Soup, mask: &[bool]) -> (Mesh, Vec<u32>) {
    let numbers: Vec<_> = (0..triangles.len()).filter(|&triangle| mask[triangle]).collect();
    let kept = numbers.iter().map(|&triangle| triangles[triangle]).collect();
    (mesh((positions.clone(), kept)), numbers.iter().map(|&triangle| triangle as u32).collect())
}

/// Samples with and without iterations and filling.
fn all_ways(mesh: &Mesh, radius: f64) -> [(Points<3>, Report); 3] {
    let context = Context::new(2).unwrap();
    [(0, true), (2, false), (1, true)].map(|(iterations, maximal)| {
        let options = ProjectionOptions::new(radius);
        let mesh = Arc::new(mesh.clone());
        let (samples, report) = psp::project(&context, &mesh, &options, iterations, maximal, None).unwrap();
        (samples, timeless(report))
    })
}

/// The figures that do not differ from call to call.
fn timeless(mut report: Report) -> Report {
    for seconds in [
        &mut report.seconds,
        &mut report.prepare_seconds,
        &mut report.project_seconds,
        &mut report.merge_seconds,
        &mut report.fill_seconds,
    ] {
        *seconds = 0.0;
    }
    report
}

#[test]
fn masked_triangles_are_as_if_they_were_not_there() {
    // Parts of a hall, a far part that makes the box large, faces that lie on others, needles, and single triangles.
    let far = meshes::join([meshes::torus(), meshes::placed(meshes::sphere(), 1.0, 1000.0)]);
    let torus = meshes::torus().1.len();
    type Case<'a> = (Soup, f64, &'a dyn Fn(usize) -> bool);
    let cases: [Case; 5] = [
        (meshes::hall(6), 0.12, &|triangle| triangle % 7 < 4),
        (far, 0.2, &|triangle| triangle < torus),
        (meshes::duplicated(meshes::random_soup(4, 4)), 0.08, &|triangle| triangle >= 5),
        (meshes::needles(1e-4), 0.02, &|triangle| triangle == 1),
        (meshes::torus(), 0.3, &|triangle| triangle == 17),
    ];
    for (soup, radius, is_kept) in cases {
        let mask: Vec<_> = (0..soup.1.len()).map(is_kept).collect();
        let masked = mesh(soup.clone()).with_mask(mask.clone()).unwrap();
        let (without, numbers) = removed(&soup, &mask);
        assert_eq!((masked.area(), masked.bounds()), (without.area(), without.bounds()));
        let expected = all_ways(&without, radius);
        for ((samples, report), (mut expected, expected_report)) in all_ways(&masked, radius).into_iter().zip(expected)
        {
            expected.triangles.iter_mut().for_each(|triangle| *triangle = numbers[*triangle as usize]);
            assert_eq!(report, expected_report);
            assert_eq!(samples, expected);
            assert_eq!(oracle::misplaced(&masked, &samples), None);
            assert_eq!(oracle::conflict(&samples, radius), None);
        }
    }
}

#[test]
fn a_masked_mesh_is_covered_where_it_has_to_be() {
    let soup = meshes::torus();
    let half = soup.1.len() / 2;
    let [front, back] = [true, false].map(|front| (0..soup.1.len()).map(move |triangle| (triangle < half) == front));
    let whole = mesh(soup);
    let masked = whole.clone().with_mask(front.collect()).unwrap();
    let inverse = whole.clone().with_mask(back.collect()).unwrap();
    let radius = 0.15;
    let [(samples, _), ..] = all_ways(&masked, radius);
    assert_eq!(oracle::gap(&masked, &samples, radius, 1e-5), None);
    assert!(
        oracle::gap(&whole, &samples, radius, 1e-5).is_some()
            && oracle::gap(&inverse, &samples, radius, 1e-5).is_some()
    );

    // The share of the whole is that of the parts.
    let context = Context::new(1).unwrap();
    let uncovered = |mesh: &Mesh| {
        surface_uncovered_fraction(&context, mesh, &samples.positions[..40], radius, 20_000, 0, None).unwrap()
    };
    let (part, rest) = (uncovered(&masked), uncovered(&inverse));
    let expected = (part * masked.area() + rest * inverse.area()) / whole.area();
    assert!((uncovered(&whole) - expected).abs() < 0.01, "{part} and {rest} of the parts");
}

#[test]
fn a_mask_may_leave_out_everything() {
    let context = Context::new(2).unwrap();
    let (mut positions, mut triangles) = meshes::torus();
    // The only triangle that is left has no area, and stands at the origin.
    positions.push([0.0; 3]);
    let vertex = positions.len() as u32 - 1;
    triangles.push([vertex; 3]);
    let count = triangles.len();
    let whole = mesh((positions, triangles));
    for last in [false, true] {
        let mut mask = vec![false; count];
        mask[count - 1] = last;
        let masked = Arc::new(whole.clone().with_mask(mask).unwrap());
        let mut psp = Psp::new(&masked, &ProjectionOptions::new(0.01)).unwrap();
        let advanced = psp.advance(&context, 3, None).unwrap();
        let filled = psp.fill(&context, None).unwrap();
        let nothing = |report: Report| {
            let Report { uncovered_before, uncovered_after, .. } = report;
            assert!([uncovered_before, uncovered_after].into_iter().flatten().all(|share| share == 0.0));
            let mut counts = timeless(report);
            assert!(counts.radius == 0.01 && counts.covering_radius.is_none_or(|coverage| coverage == 0.01));
            (counts.uncovered_before, counts.uncovered_after) = (None, None);
            (counts.radius, counts.covering_radius) = (0.0, None);
            assert_eq!(counts, Report::default());
        };
        nothing(advanced);
        nothing(filled);
        assert!(psp.samples().is_empty());
        for iterations in [0, 1] {
            let options = ProjectionOptions::new(0.01);
            let (samples, report) = psp::project(&context, &masked, &options, iterations, true, None).unwrap();
            nothing(report);
            assert!(samples.is_empty());
        }
        assert_eq!(surface_uncovered_fraction(&context, &masked, &[], 0.1, 100, 0, None).unwrap(), 0.0);
    }
}
