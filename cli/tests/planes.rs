//! `azulejo plane`, from outside.

mod common;
#[path = "common/ply.rs"]
#[allow(dead_code)]
mod ply;

use std::fs;

use common::Workshop;
use ply::{flat, nearest, points};

#[test]
fn plane_writes_a_conflict_free_set_and_its_domain() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["plane", "--radius", "0.05", "-o", "a.ply"]);
    let (header, points) = flat(&fs::read(workshop.path("a.ply")).unwrap(), 2);
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
    let (header, points) = flat(&fs::read(workshop.path("a.ply")).unwrap(), 2);
    assert!(header.contains("comment domain -3 2 -1 3 bounded\n"), "{header}");
    assert_eq!(points.len(), 500);
    assert!(points.iter().all(|p| (-3.0..-1.0).contains(&p[0]) && (2.0..3.0).contains(&p[1])));
}

#[test]
fn plane_sets_in_progressive_order_are_nested() {
    let workshop = Workshop::new();
    let made = |name: &str, arguments: &[&str]| {
        workshop.succeed(&[&["plane", "--order", "progressive", "-o", name], arguments].concat());
        flat(&fs::read(workshop.path(name)).unwrap(), 3).1
    };
    let (few, many) = (made("a.ply", &["--count", "200"]), made("b.ply", &["--count", "2000"]));
    assert!(few.len() == 200 && few == many[..200]);
    let (coarse, fine) = (made("c.ply", &["--radius", "0.04"]), made("d.ply", &["--radius", "0.02"]));
    assert!(coarse.len() > 300 && coarse == fine[..coarse.len()]);
    assert!(made("e.ply", &["--radius", "0.02", "--quotient", "1.4", "--coarsest", "0.05"]) != fine);
    let said =
        workshop.refuse(&["plane", "--radius", "0.1", "--order", "progressive", "--quotient", "3", "-o", "f.ply"], 1);
    assert!(said.starts_with("error: quotient: 3.0 is not in 1.02 to 1.5"), "{said}");
    for levels in [["--quotient", "1.2"], ["--coarsest", "0.5"]] {
        workshop.refuse(&[&["plane", "--radius", "0.1", "-o", "f.ply"][..], &levels].concat(), 2);
    }
}

/// x, y and rank of each sample of a file in progressive order.
fn ranked(workshop: &Workshop, name: &str) -> Vec<[f32; 3]> {
    let bytes = fs::read(workshop.path(name)).unwrap();
    let row = |row: &[f32]| [row[0], row[1], row[2]];
    match name.rsplit('.').next().unwrap() {
        "ply" => {
            let (header, rows) = flat(&bytes, 3);
            assert!(header.contains("property float z\nproperty float rank\nend_header"), "{header}");
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
fn a_window_has_the_samples_that_the_whole_set_has_there() {
    let workshop = Workshop::new();
    let radius = ["plane", "--radius", "0.01", "--seed", "7"];
    workshop.succeed(&[&radius[..], &["-o", "whole.ply"]].concat());
    let window = ["--window", "0.25", "0.5", "0.75", "1"];
    workshop.succeed(&[&radius[..], &window, &["-o", "window.ply"]].concat());
    let [(_, whole), (header, part)] =
        ["whole.ply", "window.ply"].map(|name| flat(&fs::read(workshop.path(name)).unwrap(), 2));
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
fn a_plane_in_a_ply_file_has_a_z_that_other_programs_need() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "a.ply"]);
    workshop.succeed(&["plane", "--radius", "0.1", "-o", "a.csv"]);
    let file = std::fs::read(workshop.path("a.ply")).unwrap();
    let end = b"end_header\n";
    let start = file.windows(end.len()).position(|part| part == end).unwrap() + end.len();
    let header = String::from_utf8_lossy(&file[..start]).into_owned();
    assert!(header.contains("property float x\nproperty float y\nproperty float z\nend_header\n"), "{header}");
    let rows: Vec<_> = file[start..].as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    let text = std::fs::read_to_string(workshop.path("a.csv")).unwrap();
    let expected = text.lines().skip(1).map(|line| format!("{line},0"));
    assert!(rows.chunks(3).map(|row| format!("{},{},{}", row[0], row[1], row[2])).eq(expected));
    // It is a set of the plane all the same.
    workshop.succeed(&["relax", "a.ply", "--iterations", "2", "-o", "b.ply"]);
    workshop.succeed(&["mesh", "sphere", "-o", "mesh.ply"]);
    let said = workshop.refuse(&["analyze", "a.ply", "--mesh", "mesh.ply"], 1);
    assert!(said.contains("holds points in the plane"), "{said}");
}

#[test]
fn coordinates_that_floats_would_displace_are_refused_with_the_way_out() {
    let workshop = Workshop::new();
    workshop.write("far.csv", "x,y\n500000.3,4649776.7\n500001.1,4649777.2\n500000.9,4649776.1\n");
    let said =
        workshop.refuse(&["relax", "far.csv", "--domain", "500000", "4649776", "500002", "4649778", "-o", "b.csv"], 1);
    assert!(said.contains("floats would displace: subtract 500000") && said.contains("from y first"), "{said}");
}

#[cfg(unix)]
#[test]
fn a_reader_that_stops_early_is_no_failure() {
    use std::io::Read;
    use std::process::Stdio;

    let workshop = Workshop::new();
    for format in ["csv", "ply", "npy", "raw"] {
        let mut command = workshop.command(&["plane", "--radius", "0.002", "-o", "-", "--format", format]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut some = [0; 10];
        child.stdout.take().unwrap().read_exact(&mut some).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{format}: {output:?}");
    }
}
