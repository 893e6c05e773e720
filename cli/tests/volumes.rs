//! `azulejo volume`, from outside.

mod common;
#[path = "common/ply.rs"]
#[allow(dead_code)]
mod ply;

use std::fs;
use std::sync::Arc;

use azulejo::dcr::volume;
use azulejo::mesh::Mesh;
use azulejo::volume::{InsideOptions, Options, Surface, adaptive, sample, sample_inside};
use azulejo::{Boundary, Context, Domain, Given, Order};
use common::Workshop;
use ply::floats;

/// A distance on the unit torus.
fn distance(a: &[f32], b: &[f64; 3]) -> f64 {
    let squared = |axis: usize| {
        let d = (f64::from(a[axis]) - b[axis]).abs();
        d.min(1.0 - d).powi(2)
    };
    (squared(0) + squared(1) + squared(2)).sqrt()
}

fn wide(point: &[f32]) -> [f64; 3] {
    [0, 1, 2].map(|axis| point[axis].into())
}

/// The vertices of a PLY file of `width` floats each, and its header.
fn rows(workshop: &Workshop, name: &str, width: usize) -> (String, Vec<Vec<f32>>) {
    floats(&fs::read(workshop.path(name)).unwrap(), width)
}

#[test]
fn volume_writes_a_maximal_set_and_its_cuboid() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["volume", "--radius", "0.15", "--seed", "3", "-o", "a.ply"]);
    let (header, points) = rows(&workshop, "a.ply", 3);
    assert!(header.contains("comment domain 0 0 0 1 1 1 periodic\n"), "{header}");
    assert!(said.starts_with(&format!("a.ply: {} samples, radius 0.15, ", points.len())), "{said}");
    for (i, a) in points.iter().enumerate() {
        assert!(points[..i].iter().all(|b| distance(a, &wide(b)) >= 0.15));
    }
    const STEPS: usize = 20;
    for place in 0..STEPS.pow(3) {
        let place = [place % STEPS, place / STEPS % STEPS, place / STEPS / STEPS].map(|i| i as f64 / STEPS as f64);
        let nearest = points.iter().map(|point| distance(point, &place)).fold(f64::MAX, f64::min);
        assert!(nearest <= 0.15 + 1e-6, "{place:?}");
    }
    let options = Options::new(0.15).seed(3);
    let (expected, _) = sample(&Context::new(1).unwrap(), &options, None).unwrap();
    assert!(points.iter().eq(expected.positions.iter()));
}

#[test]
fn relax_spreads_the_points_of_a_cuboid() {
    let workshop = Workshop::new();
    workshop.succeed(&["volume", "--count", "300", "--seed", "3", "-o", "a.ply"]);
    let (_, points) = rows(&workshop, "a.ply", 3);
    let points: Vec<[f32; 3]> = points.iter().map(|point| [0, 1, 2].map(|axis| point[axis])).collect();
    for boundary in [Boundary::Periodic, Boundary::Bounded] {
        let cuboid = ["--cuboid", "0", "0", "0", "1", "1", "1"];
        let bounded: &[&str] = if boundary == Boundary::Bounded { &["--bounded"] } else { &[] };
        let arguments = ["relax", "a.ply", "-o", "b.ply", "--iterations", "40", "--seed", "5"];
        let said = workshop.succeed(&[&arguments[..], &cuboid, bounded].concat());
        let options = volume::Options::new(Domain::unit(boundary)).max_iterations(40).seed(5);
        let (expected, done) = volume::relax(&Context::new(1).unwrap(), &options, &points, None).unwrap();
        let (header, relaxed) = rows(&workshop, "b.ply", 3);
        assert!(relaxed.iter().eq(expected.iter()), "{boundary:?}");
        let name = if boundary == Boundary::Bounded { "bounded" } else { "periodic" };
        assert!(header.contains(&format!("comment domain 0 0 0 1 1 1 {name}\n")), "{header}");
        assert!(
            said.starts_with(&format!("b.ply: 300 samples, {} steps, smallest distance 0.", done.iterations)),
            "{said}"
        );
        assert!(done.rho > 0.85, "{}", done.rho);
    }
    let said = workshop.refuse(&["relax", "a.ply", "-o", "c.ply", "--cuboid", "0", "0", "0", "0.5", "1", "1"], 1);
    assert!(said.starts_with("error: a.ply: "), "{said}");
    let both =
        ["relax", "a.ply", "-o", "c.ply", "--cuboid", "0", "0", "0", "1", "1", "1", "--neighbourhood", "nearest"];
    workshop.refuse(&both, 2);
}

#[test]
fn volume_depends_on_the_seed_and_not_on_the_threads() {
    let workshop = Workshop::new();
    let made = |seed, threads| {
        workshop.succeed(&["volume", "--count", "2000", "--seed", seed, "--threads", threads, "-o", "a.ply"]);
        fs::read(workshop.path("a.ply")).unwrap()
    };
    assert!(made("1", "1") == made("1", "3"));
    assert!(made("1", "2") != made("2", "2"));
}

#[test]
fn volume_fills_the_box_that_it_is_given_in_every_format() {
    let workshop = Workshop::new();
    let corners = ["-1", "2", "0", "1", "2.5", "0.25"];
    let made = |name: &str, flag: &str| {
        let arguments = [&["volume", "--count", "300", "--bounded", "-o", name, flag], &corners[..]].concat();
        let said = workshop.succeed(&arguments);
        assert!(said.starts_with(&format!("{name}: 300 samples, radius 0.0")), "{said}");
        assert!(said.contains(", covered within 0.0"), "{said}");
        fs::read(workshop.path(name)).unwrap()
    };
    let (header, points) = floats(&made("a.ply", "--box"), 3);
    assert!(header.contains("comment domain -1 2 0 1 2.5 0.25 bounded\n"), "{header}");
    let is_inside =
        |p: &Vec<f32>| (-1.0..1.0).contains(&p[0]) && (2.0..2.5).contains(&p[1]) && (0.0..0.25).contains(&p[2]);
    assert!(points.len() == 300 && points.iter().all(is_inside));
    let bytes: Vec<u8> = points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    assert!(made("a.raw", "--domain") == bytes);
    let array = made("a.npy", "--domain");
    assert!(array.ends_with(&bytes) && String::from_utf8_lossy(&array[..128]).contains("(300, 3)"));
    let lines = |separator: &str| -> Vec<String> {
        points.iter().map(|p| p.iter().map(|x| x.to_string()).collect::<Vec<_>>().join(separator)).collect()
    };
    assert_eq!(String::from_utf8(made("a.csv", "--box")).unwrap(), format!("x,y,z\n{}\n", lines(",").join("\n")));
    assert_eq!(String::from_utf8(made("a.xyz", "--box")).unwrap(), lines(" ").join("\n") + "\n");
    // All of them are read again as the same points in space.
    let around = |name: &str| {
        let given = ["--given", name, "--clearance", "0.05"];
        workshop
            .succeed(&[&["volume", "--radius", "0.03", "-o", "around.ply", "--box"][..], &corners, &given].concat());
        fs::read(workshop.path("around.ply")).unwrap()
    };
    let expected = around("a.ply");
    assert!(expected.len() > 1000);
    for name in ["a.npy", "a.csv", "a.xyz", "a.raw"] {
        assert!(around(name) == expected, "{name}");
    }
}

#[test]
fn volume_sets_in_progressive_order_are_nested() {
    let workshop = Workshop::new();
    let made = |name: &str, count: &str| {
        let order = ["--order", "progressive", "--quotient", "1.2"];
        workshop.succeed(&[&["volume", "--count", count, "-o", name][..], &order].concat());
        rows(&workshop, name, 4)
    };
    let ((_, few), (header, many)) = (made("a.ply", "150"), made("b.ply", "600"));
    assert!(header.contains("property float rank\n"), "{header}");
    assert!(few.len() == 150 && few == many[..150]);
    for (i, a) in many.iter().enumerate() {
        assert!(many[..i].iter().all(|b| distance(a, &wide(b)) >= a[3].into()));
    }
    workshop.succeed(&["volume", "--count", "150", "--order", "progressive", "--quotient", "1.2", "-o", "a.csv"]);
    let csv = fs::read_to_string(workshop.path("a.csv")).unwrap();
    let row = few[149].iter().map(|x| x.to_string()).collect::<Vec<_>>().join(",");
    assert!(csv.starts_with("x,y,z,rank\n") && csv.ends_with(&format!("{row}\n")), "{csv}");
}

#[test]
fn volume_is_made_around_given_points() {
    let workshop = Workshop::new();
    workshop.write("given.csv", "x,y,z,clearance\n0.5,0.5,0.5,0.25\n0.125,0.25,0,0.125\n");
    let made = |arguments: &[&str]| {
        workshop.succeed(&[&["volume", "--given", "given.csv", "-o", "a.ply"], arguments].concat());
        rows(&workshop, "a.ply", 3).1
    };
    let given = [([0.5, 0.5, 0.5], 0.25), ([0.125, 0.25, 0.0], 0.125)];
    for points in [made(&["--radius", "0.1"]), made(&["--count", "400"])] {
        assert!(points.len() > 300);
        assert!(points.iter().all(|p| given.iter().all(|(place, clearance)| distance(p, place) >= *clearance)));
    }
    let points = made(&["--radius", "0.1", "--clearance", "0.3", "--order", "any"]);
    let positions = given.map(|(place, _)| place.map(|x| x as f32));
    let options = Options::new(0.1).order(Order::Any).domain(Domain::unit(Boundary::Periodic));
    let options = options.given(Given::with_clearances(&positions, &[0.3; 2]));
    let (expected, _) = sample(&Context::new(1).unwrap(), &options, None).unwrap();
    assert!(points.iter().eq(expected.positions.iter()));
}

#[test]
fn volume_is_tiled() {
    let workshop = Workshop::new();
    workshop.succeed(&["volume", "--radius", "0.0288", "--leaf-size", "6", "-o", "a.ply"]);
    let options = Options::new(0.0288).leaf_size(6.0);
    let (expected, _) = sample(&Context::new(1).unwrap(), &options, None).unwrap();
    assert!(rows(&workshop, "a.ply", 3).1.iter().eq(expected.positions.iter()));
    for (arguments, name) in
        [(["--radius", "0.1"], "leaf_size: 2.0 is neither 0"), (["--count", "9"], "leaf_size: 2.0")]
    {
        let said = workshop.refuse(&[&["volume", "--leaf-size", "2", "-o", "b.ply"], &arguments[..]].concat(), 1);
        assert!(said.starts_with(&format!("error: {name}")), "{said}");
    }
}

/// A tetrahedron, and without its last face.
const SOLID: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

#[test]
fn volume_fills_the_inside_of_a_mesh() {
    let workshop = Workshop::new();
    workshop.write("solid.obj", format!("{SOLID}f 2 3 4\n"));
    let mesh = Arc::new(Mesh::load(workshop.path("solid.obj")).unwrap());
    let free = InsideOptions::new(0.2).seed(3);
    for (arguments, options) in [
        (&[][..], free),
        (&["--surface-first"], free.surface(Surface::First)),
        (&["--tolerance", "0.01"], free.tolerance(0.01)),
        (&["--thickness", "0.15"], free.thickness(0.15)),
    ] {
        let all =
            [&["volume", "--inside", "solid.obj", "--radius", "0.2", "--seed", "3", "-o", "a.ply"], arguments].concat();
        let said = workshop.succeed(&all);
        let (header, points) = rows(&workshop, "a.ply", 3);
        let (expected, report) = sample_inside(&Context::new(1).unwrap(), &mesh, &options, None).unwrap();
        assert!(points.iter().eq(expected.positions.iter()) && points.len() > 100);
        assert!(header.contains("comment domain 0 0 0 2 2 2 bounded\n"), "{header}");
        assert!(said.starts_with(&format!("a.ply: {} samples, radius 0.2, ", points.len())), "{said}");
        let on_surface = format!(", {} on the surface, ", report.surface_samples);
        assert_eq!(said.contains(&on_surface), report.surface_samples > 0, "{said}");
    }
    workshop.succeed(&["volume", "--inside", "solid.obj", "--count", "70", "--order", "progressive", "-o", "a.ply"]);
    assert_eq!(rows(&workshop, "a.ply", 4).1.len(), 70);
}

/// An array of NumPy of the axes z, y and x.
fn grid([x, y, z]: [usize; 3], values: &[f32]) -> Vec<u8> {
    let header =
        format!("{:<117}\n", format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({z}, {y}, {x}), }}"));
    let values: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes(), &values].concat()
}

#[test]
fn volume_has_radii_on_a_grid() {
    let workshop = Workshop::new();
    workshop.write("solid.obj", format!("{SOLID}f 2 3 4\n"));
    let (values, size) = ([0.15f32, 0.3, 0.25, 0.2], [2, 1, 2]);
    workshop.write("radii.npy", grid(size, &values));
    let (context, radius) = (Context::new(1).unwrap(), adaptive::Radius::Grid { values: &values, size });
    let domain = Domain { min: [0.0; 3], max: [2.0, 1.0, 1.0], boundary: Boundary::Bounded };
    let options = adaptive::Options::new(radius).domain(domain).seed(3);
    let (cuboid, _) = adaptive::sample(&context, &options, None).unwrap();
    let options = adaptive::InsideOptions::new(radius).tolerance(0.25).seed(3);
    let mesh = Arc::new(Mesh::load(workshop.path("solid.obj")).unwrap());
    let (inside, _) = adaptive::sample_inside(&context, &mesh, &options, None).unwrap();
    for (arguments, expected, domain) in [
        (&["--box", "0", "0", "0", "2", "1", "1", "--bounded"][..], cuboid, "0 0 0 2 1 1 bounded"),
        (&["--inside", "solid.obj", "--tolerance", "0.25"], inside, "0 0 0 2 2 2 bounded"),
    ] {
        let made = |name: &str| {
            let all = ["volume", "--radius-from", "radii.npy", "--seed", "3", "-o", name];
            workshop.succeed(&[&all[..], arguments].concat())
        };
        let said = made("a.ply");
        let (header, points) = rows(&workshop, "a.ply", 4);
        assert!(points.len() > 60 && header.contains("property float radius\n"), "{header}");
        assert!(header.contains(&format!("comment domain {domain}\n")), "{header}");
        let samples = expected.positions.iter().zip(&expected.radii);
        assert!(
            points
                .iter()
                .eq(samples.map(|([x, y, z], &radius)| [*x, *y, *z, radius as f32]).collect::<Vec<_>>().iter())
        );
        assert!(said.starts_with(&format!("a.ply: {} samples, radii 0.1", points.len())), "{said}");
        made("a.csv");
        let csv = fs::read_to_string(workshop.path("a.csv")).unwrap();
        let row = points[7].iter().map(|x| x.to_string()).collect::<Vec<_>>().join(",");
        assert!(csv.starts_with("x,y,z,radius\n") && csv.lines().nth(8) == Some(&row), "{csv}");
        made("a.usda");
        let scene = fs::read_to_string(workshop.path("a.usda")).unwrap();
        assert!(scene.contains(&format!("float[] widths = [{}, ", points[0][3])), "{scene}");
        // As given samples they have these clearances.
        workshop.succeed(&["volume", "--given", "a.ply", "--radius", "0.4", "-o", "b.ply"]);
    }
}

#[test]
fn volume_refuses_options_of_one_radius_with_a_grid() {
    let workshop = Workshop::new();
    workshop.write("solid.obj", format!("{SOLID}f 2 3 4\n"));
    workshop.write("given.csv", "x,y,z\n0.5,0.5,0.5\n");
    workshop.write("good.npy", grid([1, 2, 1], &[0.25, 0.5]));
    workshop.write("bad.npy", grid([1, 2, 1], &[0.25, -1.0]));
    workshop.write("none.npy", grid([1, 0, 1], &[]));
    workshop.write("cut.npy", grid([1, 2, 2], &[0.25, 0.5]));
    workshop.write("small.npy", grid([1, 1, 1], &[1e-9]));
    workshop.write("many.npy", grid([1, 1, 1], &[1e-5]));
    for (arguments, text) in [
        (&["--radius", "0.1"][..], "--radius <R>"),
        (&["--count", "9"], "--count <N>"),
        (&["--order", "progressive"], "--order <ORDER>"),
        (&["--order", "progressive", "--quotient", "1.2"], "--order <ORDER>"),
        (&["--given", "given.csv"], "--given <FILE>"),
        (&["--leaf-size", "20"], "--leaf-size <L>"),
        (&["--inside", "solid.obj", "--surface-first"], "--surface-first"),
        (&["--inside", "solid.obj", "--thickness", "0.3"], "--thickness <D>"),
    ] {
        let said = workshop.refuse(&[&["volume", "--radius-from", "good.npy", "-o", "a.ply"], arguments].concat(), 2);
        let first = said.lines().next().unwrap();
        assert!(first.contains("--radius-from <FILE>") && said.contains(text), "{arguments:?}: {said}");
    }
    workshop.write("flat.obj", "v 0 0 0\nv 2 0 0\nv 0 2 1\nf 1 2 3\n");
    for (arguments, text) in [
        (&["bad.npy"][..], "error: bad.npy: grid_values: [1] is -1.0, not a positive finite number"),
        (&["none.npy"], "error: none.npy: grid_size: [1, 0, 1] is not the size of a grid"),
        (&["cut.npy"], "error: cut.npy: the header announces the shape [2,2,1], but only 8 bytes follow"),
        (&["small.npy"], "error: small.npy: grid_values: "),
        (&["many.npy"], "error: many.npy: grid_values: asks for more samples"),
        (&["given.csv"], "error: given.csv: is no array of NumPy"),
        (&["missing.npy"], "error: missing.npy: "),
        (&["good.npy", "--box", "0", "0", "2", "1", "1", "1"], "error: domain_max"),
        (&["good.npy", "--inside", "flat.obj"], "error: flat.obj: encloses nothing"),
        (&["good.npy", "--inside", "solid.obj", "--tolerance", "2"], "error: tolerance: "),
    ] {
        let said = workshop.refuse(&[&["volume", "-o", "a.ply", "--radius-from"], arguments].concat(), 1);
        assert!(said.starts_with(text), "{arguments:?}: {said}");
    }
}

#[test]
fn relax_keeps_points_inside_a_mesh() {
    let workshop = Workshop::new();
    workshop.write("solid.obj", format!("{SOLID}f 2 3 4\n"));
    workshop.write("open.obj", SOLID);
    workshop.succeed(&["volume", "--inside", "solid.obj", "--radius", "0.2", "--surface-first", "-o", "a.ply"]);
    let mesh = Arc::new(Mesh::load(workshop.path("solid.obj")).unwrap());
    let context = Context::new(1).unwrap();
    let set = InsideOptions::new(0.2).surface(Surface::First);
    let (points, report) = sample_inside(&context, &mesh, &set, None).unwrap();
    let count = report.surface_samples.to_string();
    for of_surface in [None, Some("--fixed"), Some("--sliding")] {
        let first = |name| match of_surface == Some(name) {
            false => Vec::new(),
            true => (0..points.len()).map(|index| index < report.surface_samples).collect::<Vec<bool>>(),
        };
        let (fixed, sliding) = (first("--fixed"), first("--sliding"));
        let arguments: Vec<&str> = of_surface.into_iter().flat_map(|name| [name, &count]).collect();
        // Other samples of the surface are not inside.
        let inside: Vec<[f32; 3]> =
            points.positions.iter().copied().filter(|&p| of_surface.is_some() || mesh.contains(p)).collect();
        let rows_of = |points: &[[f32; 3]]| points.iter().map(|[x, y, z]| format!("{x},{y},{z}\n")).collect::<String>();
        workshop.write("inside.csv", format!("x,y,z\n{}", rows_of(&inside)));
        let all = ["relax", "inside.csv", "--inside", "solid.obj", "--iterations", "20", "--seed", "2", "-o", "b.ply"];
        let said = workshop.succeed(&[&all[..], &arguments].concat());
        let options = volume::InsideOptions::default().max_iterations(20).seed(2).fixed(&fixed).sliding(&sliding);
        let (expected, done) = volume::relax_inside(&context, &mesh, &options, &inside, None).unwrap();
        let (header, relaxed) = rows(&workshop, "b.ply", 3);
        assert!(relaxed.iter().eq(expected.iter()));
        assert!(header.contains("comment domain 0 0 0 2 2 2 bounded\n"), "{header}");
        assert!(said.starts_with(&format!("b.ply: {} samples, {} steps, ", inside.len(), done.iterations)), "{said}");
    }
    workshop.write("outside.csv", "x,y,z\n0.5,0.5,0.5\n2,2,2\n");
    for (arguments, code, text) in [
        (&["a.ply", "--inside", "none.obj"][..], 1, "error: none.obj: "),
        (&["outside.csv", "--inside", "solid.obj"], 1, "error: outside.csv: point 1 is (2, 2, 2), outside the mesh"),
        (&["outside.csv", "--inside", "solid.obj", "--fixed", "3"], 1, "error: outside.csv: has 2 points, fewer than"),
        (&["a.ply", "--fixed", "3"], 2, "error: "),
        (
            &["outside.csv", "--inside", "solid.obj", "--sliding", "3"],
            1,
            "error: outside.csv: has 2 points, fewer than",
        ),
        (&["a.ply", "--inside", "solid.obj", "--fixed", "3", "--sliding", "3"], 2, "error: "),
        (&["a.ply", "--inside", "solid.obj", "--mesh", "solid.obj"], 2, "error: "),
    ] {
        let said = workshop.refuse(&[&["relax", "-o", "c.ply"], arguments].concat(), code);
        assert!(said.starts_with(text), "{arguments:?}: {said}");
    }
}

#[test]
fn volume_refuses_what_it_cannot_make() {
    let workshop = Workshop::new();
    workshop.write("open.obj", SOLID);
    workshop.write("flat.obj", "v 0 0 0\nv 2 0 0\nv 0 2 1\nf 1 2 3\n");
    workshop.write("given.xyz", "0.5 0.5 0.5\n");
    workshop.write("flat.csv", "x,y\n0.5,0.5\n");
    for (arguments, code, text) in [
        (&["--radius", "-1"][..], 1, "error: radius: "),
        (&["--radius", "0.1", "--box", "0", "0", "2", "1", "1", "1"], 1, "error: domain_max"),
        (&["--radius", "0.1", "--order", "progressive", "--quotient", "3"], 1, "error: quotient: "),
        (&["--count", "10", "--given", "given.xyz"], 1, "error: given.xyz: given_clearances: "),
        (&["--radius", "0.1", "--given", "flat.csv"], 1, "error: flat.csv: "),
        (&["--radius", "0.1", "--given", "none.csv"], 1, "error: none.csv: "),
        (&["--radius", "0.1", "--quotient", "1.2"], 2, "error: "),
        (&["--radius", "0.1", "--clearance", "0.2"], 2, "error: "),
        (&["--radius", "0.1", "--count", "5"], 2, "error: "),
        (&["--radius", "0.1", "--box", "0", "0", "1", "1"], 2, "error: "),
        (&["--radius", "0.1", "--inside", "flat.obj"], 1, "error: flat.obj: encloses nothing: caps close its holes"),
        (&["--radius", "0.1", "--inside", "none.obj"], 1, "error: none.obj: "),
        (&["--radius", "0.1", "--inside", "open.obj", "--bounded"], 2, "error: "),
        (&["--count", "9", "--inside", "open.obj", "--surface-first"], 2, "error: "),
        (&["--radius", "0.1", "--tolerance", "0.1"], 2, "error: "),
        (&["--radius", "0.1", "--thickness", "0.1"], 2, "error: "),
        (&[], 2, "error: "),
    ] {
        let said = workshop.refuse(&[&["volume", "-o", "a.ply"], arguments].concat(), code);
        assert!(said.starts_with(text), "{arguments:?}: {said}");
    }
}
