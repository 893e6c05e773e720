//! `azulejo plane`, `relax` and `mesh`, from outside.

mod common;

use std::fs;

use common::Workshop;

/// The numbers of a binary PLY file with `width` four-byte floats per vertex, and its header.
fn floats(file: &[u8], width: usize) -> (String, Vec<Vec<f32>>) {
    const END: &[u8] = b"end_header\n";
    let end = file.windows(END.len()).position(|window| window == END).unwrap() + END.len();
    let header = String::from_utf8(file[..end].to_vec()).unwrap();
    assert_eq!((file.len() - end) % (4 * width), 0);
    let numbers = file[end..].chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
    let numbers: Vec<_> = numbers.collect();
    (header, numbers.chunks(width).map(<[f32]>::to_vec).collect())
}

#[test]
fn plane_writes_a_conflict_free_set_and_its_domain() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["plane", "--radius", "0.05", "-o", "a.ply"]);
    let (header, points) = floats(&fs::read(workshop.path("a.ply")).unwrap(), 2);
    assert!(header.contains("comment domain 0 0 1 1 periodic\n"), "{header}");
    assert!(header.contains(&format!("element vertex {}\n", points.len())));
    assert!((230..330).contains(&points.len()), "{}", points.len());
    assert!(said.starts_with(&format!("a.ply: {} samples, radius 0.05, ", points.len())), "{said}");
    for (i, a) in points.iter().enumerate() {
        assert!(a.iter().all(|x| (0.0..1.0).contains(x)));
        for b in &points[..i] {
            let offset = [0, 1].map(|axis| (a[axis] as f64 - b[axis] as f64).abs()).map(|d| d.min(1.0 - d));
            assert!(offset[0].hypot(offset[1]) >= 0.05, "{a:?} {b:?}");
        }
    }
    assert_eq!(workshop.files(), ["a.ply"]);
}

#[test]
fn plane_depends_on_the_seed_and_not_on_the_threads() {
    let workshop = Workshop::new();
    let made = |seed, threads| {
        let arguments = ["plane", "--count", "3000", "--seed", seed, "--threads", threads, "-o", "a.ply"];
        workshop.succeed(&arguments);
        fs::read(workshop.path("a.ply")).unwrap()
    };
    assert!(made("1", "1") == made("1", "3"));
    assert!(made("1", "2") != made("2", "2"));
}

#[test]
fn plane_fills_the_rectangle_that_it_is_given() {
    let workshop = Workshop::new();
    let arguments = ["plane", "--count", "500", "--domain", "-3", "2", "-1", "3", "--bounded", "--leaf-size", "8"];
    let said = workshop.succeed(&[&arguments[..], &["-o", "a.ply"]].concat());
    assert!(said.starts_with("a.ply: 500 samples, radius 0.0"), "{said}");
    let (header, points) = floats(&fs::read(workshop.path("a.ply")).unwrap(), 2);
    assert!(header.contains("comment domain -3 2 -1 3 bounded\n"), "{header}");
    assert_eq!(points.len(), 500);
    assert!(points.iter().all(|p| (-3.0..-1.0).contains(&p[0]) && (2.0..3.0).contains(&p[1])));
}

/// The points of a PLY file.
fn points(workshop: &Workshop, name: &str) -> Vec<Vec<f32>> {
    floats(&fs::read(workshop.path(name)).unwrap(), 2).1
}

#[test]
fn plane_sets_in_progressive_order_are_nested() {
    let workshop = Workshop::new();
    let made = |name: &str, arguments: &[&str]| {
        workshop.succeed(&[&["plane", "--order", "progressive", "-o", name], arguments].concat());
        floats(&fs::read(workshop.path(name)).unwrap(), 3).1
    };
    let (few, many) = (made("a.ply", &["--count", "200"]), made("b.ply", &["--count", "2000"]));
    assert!(few.len() == 200 && few == many[..200]);
    let (coarse, fine) = (made("c.ply", &["--radius", "0.04"]), made("d.ply", &["--radius", "0.02"]));
    assert!(coarse.len() > 300 && coarse == fine[..coarse.len()]);
    assert!(made("e.ply", &["--radius", "0.02", "--quotient", "1.4", "--coarsest", "0.05"]) != fine);
    let said =
        workshop.refuse(&["plane", "--radius", "0.1", "--order", "progressive", "--quotient", "3", "-o", "f.ply"], 1);
    assert!(said.starts_with("error: quotient: 3.0 is not in 1.02 to 1.5"), "{said}");
}

/// x, y and rank of each sample of a file in progressive order.
fn ranked(workshop: &Workshop, name: &str) -> Vec<[f32; 3]> {
    let bytes = fs::read(workshop.path(name)).unwrap();
    let row = |row: &[f32]| [row[0], row[1], row[2]];
    match name.rsplit('.').next().unwrap() {
        "ply" => {
            let (header, rows) = floats(&bytes, 3);
            assert!(header.contains("property float y\nproperty float rank\nend_header"), "{header}");
            rows.iter().map(|floats| row(floats)).collect()
        }
        "csv" => {
            let text = String::from_utf8(bytes).unwrap();
            assert!(text.starts_with("x,y,rank\n"), "{text}");
            let numbers = |line: &str| line.split(',').map(|word| word.parse().unwrap()).collect::<Vec<_>>();
            text.lines().skip(1).map(|line| row(&numbers(line))).collect()
        }
        _ => {
            let (header, body) = bytes.split_at(128);
            let fields = "'descr': [('x', '<f4'), ('y', '<f4'), ('rank', '<f4')]";
            assert!(String::from_utf8_lossy(header).contains(fields), "{header:?}");
            let numbers: Vec<f32> = body.as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
            numbers.chunks(3).map(row).collect()
        }
    }
}

/// Every prefix is at least as far apart as its last rank, on the unit torus; a window is a part of such a set.
#[test]
fn progressive_sets_have_ranks_that_never_rise_and_that_prefixes_keep() {
    let workshop = Workshop::new();
    let radius = ["--radius", "0.03"];
    for (arguments, least) in [
        (&radius[..], 0.03),
        (&["--count", "700"], 0.02),
        (&["--radius", "0.01", "--window", "0.5", "0.25", "0.75", "0.5"], 0.01),
    ] {
        let mut found = Vec::new();
        for name in ["a.ply", "a.csv", "a.npy"] {
            workshop.succeed(&[&["plane", "--order", "progressive", "-o", name], arguments].concat());
            found.push(ranked(&workshop, name));
        }
        let [samples, csv, npy] = &found[..] else { unreachable!() };
        assert!(samples == csv && samples == npy && samples.len() > 400, "{}", samples.len());
        assert!(samples[0][2] > 3.0 * samples.last().unwrap()[2]);
        for (i, a) in samples.iter().enumerate() {
            let rank = f64::from(a[2]);
            assert!(rank >= least * (1.0 - 1e-6) && (i == 0 || samples[i - 1][2] >= a[2]), "{i}: {a:?}");
            for b in &samples[..i] {
                let offset = [0, 1].map(|axis| (a[axis] as f64 - b[axis] as f64).abs()).map(|d| d.min(1.0 - d));
                assert!(offset[0].hypot(offset[1]) >= rank, "{a:?} {b:?}");
            }
        }
    }
    // Formats without names of columns have the order alone; sets in any order have no ranks.
    workshop.succeed(&[&["plane", "--order", "progressive", "-o", "a.raw"], &radius[..]].concat());
    workshop.succeed(&[&["plane", "--order", "progressive", "-o", "a.ply"], &radius[..]].concat());
    let raw = fs::read(workshop.path("a.raw")).unwrap();
    let positions = ranked(&workshop, "a.ply").into_iter().flat_map(|[x, y, _]| [x, y]).flat_map(f32::to_le_bytes);
    assert!(raw == positions.collect::<Vec<_>>());
    // Points with ranks are read as others are.
    for name in ["a.ply", "a.csv", "a.npy"] {
        workshop.succeed(&[&["plane", "--order", "progressive", "-o", name], &radius[..]].concat());
        workshop.succeed(&["relax", name, "--iterations", "0", "-o", "back.raw"]);
        assert!(fs::read(workshop.path("back.raw")).unwrap() == raw, "{name}");
    }
}

/// The smallest distance on the unit torus of points from a place.
fn nearest(points: &[Vec<f32>], place: [f64; 2]) -> f64 {
    let distance = |point: &Vec<f32>| {
        let [dx, dy] = [0, 1].map(|axis| (f64::from(point[axis]) - place[axis]).abs()).map(|d| d.min(1.0 - d));
        dx.hypot(dy)
    };
    points.iter().map(distance).fold(f64::MAX, f64::min)
}

#[test]
fn plane_samples_around_what_stands_already() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "coarse.ply"]);
    workshop.succeed(&["plane", "--radius", "0.1", "--given", "coarse.ply", "-o", "none.ply"]);
    assert!(points(&workshop, "none.ply").is_empty());
    workshop.succeed(&["plane", "--radius", "0.02", "--given", "coarse.ply", "--clearance", "0.03", "-o", "fine.ply"]);
    let fine = points(&workshop, "fine.ply");
    assert!(fine.len() > 500);
    for place in points(&workshop, "coarse.ply") {
        assert!(nearest(&fine, [place[0].into(), place[1].into()]) >= 0.03, "{place:?}");
    }
    // The name that the option had first.
    workshop.succeed(&["plane", "--radius", "0.02", "--around", "coarse.ply", "--clearance", "0.03", "-o", "old.ply"]);
    assert_eq!(points(&workshop, "old.ply"), fine);
    workshop.refuse(&["plane", "--count", "100", "--given", "coarse.ply", "-o", "a.ply"], 2);
    workshop.refuse(&["plane", "--radius", "0.1", "--clearance", "1", "-o", "a.ply"], 2);
}

/// By the column of clearances, by that of radii, and by the radius of the set; in all ways to make a set.
#[test]
fn plane_keeps_the_clearances_of_the_file_that_is_given() {
    let workshop = Workshop::new();
    workshop.write("clear.csv", "x,y,radius,clearance\n0.5,0.5,0.01,0.2\n0.1,0.9,0.02,0.1\n");
    workshop.write("radii.csv", "x,y,radius\n0.5,0.5,0.15\n0.1,0.9,0\n");
    workshop.write("plain.csv", "x,y\n0.5,0.5\n0.1,0.9\n");
    let square = ["--window", "0.25", "0.25", "0.75", "0.75"];
    for (name, more, expected) in [
        ("clear.csv", &[][..], [0.2, 0.1]),
        ("radii.csv", &[], [0.15, 0.0]),
        ("plain.csv", &[], [0.02, 0.02]),
        ("clear.csv", &["--clearance", "0.05"], [0.05, 0.05]),
    ] {
        for (density, way) in [
            (["--radius", "0.02"], &[][..]),
            (["--radius", "0.02"], &["--order", "progressive"]),
            (["--classes", "0.02,0.02"], &[]),
            (["--radius", "0.02"], &square),
            (["--classes", "0.02,0.02"], &square),
        ] {
            let arguments = [&["plane", "--given", name, "-o", "a.csv"], &density[..], more, way].concat();
            workshop.succeed(&arguments);
            let text = fs::read_to_string(workshop.path("a.csv")).unwrap();
            let row = |line: &str| line.split(',').map(|word| word.parse().unwrap()).collect::<Vec<f32>>();
            let points: Vec<_> = text.lines().skip(1).map(row).collect();
            for (place, clearance) in [[0.5, 0.5], [0.1, 0.9]].into_iter().zip(expected) {
                let found = nearest(&points, place);
                let is_there = way != &square[..] || place == [0.5, 0.5];
                assert!(found >= clearance && (!is_there || found < clearance + 0.04), "{arguments:?}: {found}");
            }
        }
    }
    workshop.write("bad.csv", "x,y,clearance\n0,0,1\n0,1,-2\n");
    for density in [["--radius", "0.1"], ["--classes", "0.1,0.1"]] {
        let said = workshop.refuse(&[&["plane", "--given", "bad.csv", "-o", "b.ply"], &density[..]].concat(), 1);
        let index = if density[0] == "--classes" { 2 } else { 1 };
        let reason = format!("given_clearances: [{index}] is -2.0; it must be 0 or more and finite");
        assert_eq!(said, format!("error: bad.csv: {reason}\n"));
    }
}

#[test]
fn plane_samples_of_several_classes() {
    let workshop = Workshop::new();
    let own = [0.04, 0.08, 0.02];
    let set = ["plane", "--classes", "0.04,0.08,0.02", "--class-factor", "0.8", "--seed", "3"];
    let said = workshop.succeed(&[&set[..], &["-o", "whole.csv"]].concat());
    assert!(said.contains(", by classes "), "{said}");
    let text = fs::read_to_string(workshop.path("whole.csv")).unwrap();
    assert!(text.starts_with("x,y,class\n"));
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    for class in ["0", "1", "2"] {
        let own = own[class.parse::<usize>().unwrap()];
        let samples = rows.iter().filter(|row| row[2] == class).map(|row| [0, 1].map(|axis| row[axis].parse::<f64>()));
        let samples: Vec<_> = samples.map(|[x, y]| [x.unwrap(), y.unwrap()]).collect();
        assert!(samples.len() as f64 > 0.5 / (own * own), "{class} has {}", samples.len());
        for (i, a) in samples.iter().enumerate() {
            let [dx, dy] = [0, 1].map(|axis| samples[..i].iter().map(move |b| (a[axis] - b[axis]).abs()));
            let distance = |(dx, dy): (f64, f64)| dx.min(1.0 - dx).hypot(dy.min(1.0 - dy));
            assert!(dx.zip(dy).map(distance).all(|distance| distance >= own * (1.0 - 1e-12)), "{a:?} of {class}");
        }
    }
    // The other formats have the same rows, and can be read as sets of the plane.
    for (name, more) in [("whole.ply", &[][..]), ("window.ply", &["--window", "0.25", "0.5", "0.75", "1"])] {
        workshop.succeed(&[&set[..], more, &["-o", name]].concat());
        let (header, found) = floats(&fs::read(workshop.path(name)).unwrap(), 3);
        assert!(header.contains("property uint class"), "{header}");
        let [min, max] = if more.is_empty() { [[0.0, 0.0], [1.0, 1.0]] } else { [[0.25, 0.5], [0.75, 1.0]] };
        let of_text = |row: &Vec<&str>| [0, 1].map(|axis| row[axis].parse::<f32>().unwrap());
        let is_inside = |[x, y]: &[f32; 2]| (min[0]..max[0]).contains(x) && (min[1]..max[1]).contains(y);
        let expected = rows.iter().map(|row| (of_text(row), row[2].parse::<u32>().unwrap()));
        let found = found.iter().map(|row| ([row[0], row[1]], row[2].to_bits()));
        assert!(found.eq(expected.filter(|(sample, _)| is_inside(sample))), "{name}");
    }
    workshop.succeed(&[&set[..], &["-o", "whole.npy"]].concat());
    for name in ["whole.npy", "whole.ply", "whole.csv"] {
        workshop.succeed(&["plane", "--radius", "0.02", "--given", name, "-o", "none.csv"]);
        assert_eq!(fs::read_to_string(workshop.path("none.csv")).unwrap(), "x,y\n", "{name}");
    }
    workshop.refuse(&[&set[..], &["-o", "a.raw"]].concat(), 1);
    workshop.refuse(&[&set[..], &["--order", "progressive", "-o", "a.ply"]].concat(), 2);
    workshop.refuse(&["plane", "--radius", "0.1", "--class-factor", "2", "-o", "a.ply"], 2);
    let said = workshop.refuse(&["plane", "--classes", "0.1,0", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: own: [1] is 0.0"), "{said}");
}

#[test]
fn a_window_has_the_samples_that_the_whole_set_has_there() {
    let workshop = Workshop::new();
    let radius = ["plane", "--radius", "0.01", "--seed", "7"];
    workshop.succeed(&[&radius[..], &["-o", "whole.ply"]].concat());
    let window = ["--window", "0.25", "0.5", "0.75", "1"];
    workshop.succeed(&[&radius[..], &window, &["-o", "window.ply"]].concat());
    let [(_, whole), (header, part)] =
        ["whole.ply", "window.ply"].map(|name| floats(&fs::read(workshop.path(name)).unwrap(), 2));
    let inside = |point: &&Vec<f32>| (0.25..0.75).contains(&point[0]) && point[1] >= 0.5;
    assert_eq!(part, whole.iter().filter(inside).cloned().collect::<Vec<_>>());
    assert!(part.len() > 1000 && header.contains("comment domain 0.25 0.5 0.75 1 bounded\n"), "{header}");
    let said = workshop.refuse(&[&radius[..], &["--window", "0", "0", "2", "1", "-o", "a.ply"]].concat(), 1);
    assert!(said.starts_with("error: window_max: "), "{said}");
    workshop.refuse(&["plane", "--count", "9", "--window", "0", "0", "1", "1", "-o", "a.ply"], 2);
}

#[test]
fn counts_can_be_written_with_an_exponent() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["plane", "--count", "1.5e3", "-o", "a.ply"]);
    assert!(said.starts_with("a.ply: 1,500 samples, "), "{said}");
    for count in ["1e-1", "2.5", "0e5", "1e99", "inf"] {
        workshop.refuse(&["plane", "--count", count, "-o", "a.ply"], 2);
    }
}

#[test]
fn relax_moves_points_apart_and_keeps_their_number_and_domain() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "400", "-o", "a.ply"]);
    for neighbourhood in ["delaunay", "nearest"] {
        let arguments = ["relax", "a.ply", "--neighbourhood", neighbourhood, "--iterations", "30", "-o", "b.ply"];
        let said = workshop.succeed(&arguments);
        assert!(said.contains(" steps, smallest distance 0.0"), "{said}");
        let [(before, old), (after, new)] =
            ["a.ply", "b.ply"].map(|name| floats(&fs::read(workshop.path(name)).unwrap(), 2));
        assert_eq!(before, after);
        assert_ne!(old, new);
    }
    workshop.succeed(&["relax", "a.ply", "--iterations", "0", "-o", "b.ply"]);
    assert!(fs::read(workshop.path("a.ply")).unwrap() == fs::read(workshop.path("b.ply")).unwrap());
}

/// The smallest distance on the unit torus within each of three classes, of rows of x, y and class as bits.
fn distances_of_classes(rows: &[Vec<f32>]) -> [f64; 3] {
    [0, 1, 2].map(|class| {
        let own: Vec<Vec<f32>> = rows.iter().filter(|row| row[2].to_bits() == class).cloned().collect();
        let pairs = own.iter().enumerate().skip(1);
        pairs.map(|(i, a)| nearest(&own[..i], [a[0].into(), a[1].into()])).fold(f64::MAX, f64::min)
    })
}

/// Classes stay with their points, and each is spread more evenly, which relaxation of the union does not do.
#[test]
fn relax_keeps_the_classes_of_a_file_and_spreads_each() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--classes", "0.06,0.06,0.06", "-o", "a.ply"]);
    let rows = |name: &str| floats(&fs::read(workshop.path(name)).unwrap(), 3);
    let said = workshop.succeed(&["relax", "a.ply", "--iterations", "60", "-o", "b.ply"]);
    assert!(said.contains(" 60 steps, smallest distance 0.0") && said.contains(", ρ 0."), "{said}");
    let ((header, before), (same, after)) = (rows("a.ply"), rows("b.ply"));
    assert!(header == same && header.contains("property uint class"), "{header}");
    assert!(before.iter().map(|row| row[2].to_bits()).eq(after.iter().map(|row| row[2].to_bits())));
    workshop.succeed(&["relax", "a.ply", "--iterations", "60", "--no-classes", "-o", "union.ply"]);
    let union = points(&workshop, "union.ply");
    assert_eq!(union.len(), before.len());
    let union: Vec<Vec<f32>> = union.iter().zip(&before).map(|(at, of)| vec![at[0], at[1], of[2]]).collect();
    let [before, after, union] = [&before, &after, &union].map(|rows| distances_of_classes(rows));
    for class in 0..3 {
        assert!(
            after[class] > 1.05 * before[class] && after[class] > 1.2 * union[class],
            "{before:?} {after:?} {union:?}"
        );
    }
    // The other formats with columns, and without steps the file as it was.
    for name in ["a.csv", "a.npy"] {
        workshop.succeed(&["plane", "--classes", "0.06,0.06,0.06", "-o", name]);
        workshop.succeed(&["relax", name, "--iterations", "0", "-o", "back.ply"]);
        assert!(fs::read(workshop.path("back.ply")).unwrap() == fs::read(workshop.path("a.ply")).unwrap(), "{name}");
    }
}

#[test]
fn classes_that_cannot_be_relaxed_are_refused_and_not_dropped() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--classes", "0.1,0.1", "-o", "a.ply"]);
    let refuse = |arguments: &[&str]| workshop.refuse(&[&["relax"], arguments].concat(), 1);
    let said = refuse(&["a.ply", "-o", "b.xyz"]);
    assert_eq!(said, "error: b.xyz: this format has no place for the classes of samples: give .ply, .npy or .csv\n");
    let said = refuse(&["a.ply", "--neighbourhood", "nearest", "-o", "b.ply"]);
    assert!(said.starts_with("error: neighbourhood: classes are relaxed"), "{said}");
    workshop.write("names.csv", "x,y,class\n0.1,0.1,oak\n0.9,0.9,elm\n");
    let said = refuse(&["names.csv", "--domain", "0", "0", "1", "1", "-o", "b.ply"]);
    let reason = "point 0: its class is no whole number: --no-classes takes the points for one set";
    assert_eq!(said, format!("error: names.csv: {reason}\n"));
    workshop.succeed(&["relax", "names.csv", "--domain", "0", "0", "1", "1", "--no-classes", "-o", "b.xyz"]);
    workshop.write("many.csv", "x,y,class\n0.1,0.1,3\n0.9,0.9,16\n");
    let said = refuse(&["many.csv", "--domain", "0", "0", "1", "1", "-o", "c.ply"]);
    assert_eq!(said, "error: many.csv: classes: [1] is 16, not below 16\n");
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    workshop.succeed(&["surface", "roof.obj", "--classes", "0.3,0.3", "-o", "s.ply"]);
    let said = refuse(&["s.ply", "--mesh", "roof.obj", "-o", "c.ply"]);
    assert!(said.starts_with("error: s.ply: has classes, which are relaxed in the plane only"), "{said}");
    workshop.succeed(&["relax", "s.ply", "--mesh", "roof.obj", "--no-classes", "-o", "c.ply"]);
}

#[test]
fn mesh_writes_a_closed_mesh() {
    let workshop = Workshop::new();
    assert!(workshop.succeed(&["mesh", "knot", "--detail", "64", "-o", "knot.ply"]).is_empty());
    let file = fs::read(workshop.path("knot.ply")).unwrap();
    let header = b"element face 2048\nproperty list uchar uint vertex_indices\nend_header\n";
    let end = file.windows(header.len()).position(|window| window == header).unwrap() + header.len();
    // 64 rings of 16 vertices, and two triangles to a vertex.
    assert_eq!(file.len() - end, 1024 * 12 + 2048 * 13);
}

#[test]
fn numbers_out_of_range_are_refused_with_their_name() {
    let workshop = Workshop::new();
    for radius in ["0", "-1", "nan", "inf", "1e-30"] {
        let said = workshop.refuse(&["plane", "--radius", radius, "-o", "a.ply"], 1);
        assert!(said.starts_with("error: radius: "), "{said}");
    }
    let said = workshop.refuse(&["plane", "--count", "100", "--leaf-size", "2", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: leaf_size: "), "{said}");
    let said = workshop.refuse(&["plane", "--count", "100", "--domain", "0", "0", "0", "1", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: domain_max: ") || said.starts_with("error: radius: "), "{said}");
    let said = workshop.refuse(&["plane", "--count", "100", "--threads", "99999", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: num_threads: "), "{said}");
}

#[test]
fn wrong_usage_has_a_code_of_its_own() {
    let workshop = Workshop::new();
    for arguments in [
        &["plane", "-o", "a.ply"][..],
        &["plane", "--count", "0", "-o", "a.ply"],
        &["plane", "--count", "x", "-o", "a.ply"],
        &["plane", "--count", "9", "--radius", "1", "-o", "a.ply"],
        &["plane", "--count", "9"],
        &["plane", "--count", "9", "--domain", "0", "1", "-o", "a.ply"],
        &["mesh", "cube", "-o", "a.ply"],
        &["mesh", "knot", "--detail", "1", "-o", "a.ply"],
        &["relax", "-o", "a.ply"],
        &["paint"],
        &[],
    ] {
        assert!(!workshop.refuse(arguments, 2).is_empty());
    }
}

#[test]
fn files_that_cannot_be_read_are_named_with_the_reason() {
    let workshop = Workshop::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nend_header\n";
    fs::create_dir(workshop.path("folder")).unwrap();
    for (name, content) in [
        ("empty.ply", String::new()),
        ("garbage.ply", "no ply at all".to_owned()),
        ("short.ply", format!("{header}0 0\n")),
        ("word.ply", format!("{header}0 0\n1 one\n")),
        ("infinite.ply", format!("{header}0 0\n1 1e99\n")),
        ("none.ply", header.replace("vertex 2", "vertex 0")),
        ("huge.ply", header.replace("ascii", "binary_little_endian").replace("vertex 2", "vertex 99999999999999")),
        ("flat.ply", header.replace("float y", "float z") + "0 0\n1 1\n"),
        ("anywhere.ply", format!("{header}5 5\n7 7\n")),
    ] {
        workshop.write(name, content);
        let said = workshop.refuse(&["relax", name, "-o", "out.ply"], 1);
        assert!(said.starts_with(&format!("error: {name}: ")), "{said}");
    }
    for name in ["missing.ply", "folder"] {
        let said = workshop.refuse(&["relax", name, "-o", "out.ply"], 1);
        assert!(said.starts_with(&format!("error: {name}: ")), "{said}");
    }
}

#[test]
fn places_that_cannot_be_written_are_refused_before_the_work() {
    let workshop = Workshop::new();
    fs::create_dir(workshop.path("folder")).unwrap();
    for place in ["folder", "missing/a.ply"] {
        let said = workshop.refuse(&["plane", "--count", "1000000000", "-o", place], 1);
        assert!(said.starts_with(&format!("error: {place}: ")), "{said}");
    }
    let said = workshop.refuse(&["mesh", "knot", "-o", "knot.obj"], 1);
    assert_eq!(said, "error: knot.obj: the extension is not .ply, the only format of this file\n");
}

#[test]
fn points_in_text_with_other_properties_are_read() {
    let workshop = Workshop::new();
    let mut text = "ply\nformat ascii 1.0\ncomment domain 0 0 4 4 bounded\nelement vertex 16\nproperty uchar red\n\
                    property double y\nproperty int x\nproperty list uchar int near\nend_header\n"
        .to_owned();
    (0..16).for_each(|i| text += &format!("255 {}.25 {} 2 7 8\n", i / 4, i % 4));
    workshop.write("text.ply", text);
    workshop.succeed(&["relax", "text.ply", "--iterations", "0", "-o", "a.ply"]);
    let (header, points) = floats(&fs::read(workshop.path("a.ply")).unwrap(), 2);
    assert!(header.contains("comment domain 0 0 4 4 bounded\n"), "{header}");
    assert_eq!((points.len(), &points[6][..]), (16, &[2.0, 1.25][..]));
}

#[test]
fn surface_writes_samples_with_normals_triangles_and_barycentrics() {
    let workshop = Workshop::new();
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    let said = workshop.succeed(&["surface", "roof.obj", "--radius", "0.1", "-o", "a.ply"]);
    assert!(said.contains(" samples, radius 0.1, "), "{said}");
    let (header, samples) = floats(&fs::read(workshop.path("a.ply")).unwrap(), 9);
    let names = ["x", "y", "z", "nx", "ny", "nz", "triangle", "u", "v"];
    let lines = names.map(|name| if name == "triangle" { "uint triangle".into() } else { format!("float {name}") });
    assert!(header.ends_with(&format!("property {}\nend_header\n", lines.join("\nproperty "))), "{header}");
    assert!((200..400).contains(&samples.len()), "{}", samples.len());
    for sample in &samples {
        let (triangle, [u, v]) = (sample[6].to_bits(), [sample[7], sample[8]]);
        let [expected, normal] = match triangle {
            0 => [[2.0 * u, 2.0 * v, 0.0], [0.0, 0.0, 1.0]],
            _ => [[2.0 * v, 0.0, 2.0 * u], [0.0, 1.0, 0.0]],
        };
        assert!((0..3).all(|i| (sample[i] - expected[i]).abs() < 1e-6 && sample[3 + i] == normal[i]), "{sample:?}");
    }
    let few = ["surface", "roof.obj", "--radius", "0.0964", "--iterations", "1", "--no-fill", "-o", "b.ply"];
    workshop.succeed(&few);
    let (_, fewer) = floats(&fs::read(workshop.path("b.ply")).unwrap(), 9);
    assert!((150..300).contains(&fewer.len()), "{}", fewer.len());
    workshop.succeed(&["draw", "surface", "roof.obj", "a.ply", "-o", "a.png", "--size", "200"]);
}
