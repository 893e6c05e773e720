use super::*;
use azulejo::Points;

/// A file of version 1.0 with this description and body.
fn file(description: &str, body: &[u8]) -> Vec<u8> {
    let header = format!("{description:<117}\n");
    let size = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &size[..], header.as_bytes(), body].concat()
}

fn dictionary(element: &str, fortran: &str, shape: &str) -> String {
    format!("{{'descr': '{element}', 'fortran_order': {fortran}, 'shape': {shape}, }}")
}

fn points(file: &[u8]) -> Vec<[f32; 2]> {
    parse(file).unwrap().into_plane("").unwrap().points
}

#[test]
fn every_type_and_order_gives_the_same_points() {
    let expected = [[1.0, 2.0], [3.0, -4.0]];
    let rows = [1.0f32, 2.0, 3.0, -4.0];
    let columns = [1.0f32, 3.0, 2.0, -4.0];
    let bytes = |numbers: [f32; 4], of: fn(f32) -> Vec<u8>| numbers.into_iter().flat_map(of).collect::<Vec<_>>();
    for (element, fortran, body) in [
        ("<f4", "False", bytes(rows, |x| x.to_le_bytes().to_vec())),
        (">f4", "False", bytes(rows, |x| x.to_be_bytes().to_vec())),
        ("<f8", "True", bytes(columns, |x| f64::from(x).to_le_bytes().to_vec())),
        ("<i4", "False", bytes(rows, |x| (x as i32).to_le_bytes().to_vec())),
        (">i8", "False", bytes(rows, |x| (x as i64).to_be_bytes().to_vec())),
        ("|i1", "True", bytes(columns, |x| vec![x as i8 as u8])),
    ] {
        assert_eq!(points(&file(&dictionary(element, fortran, "(2, 2)"), &body)), expected, "{element}");
    }
    let mut written = Vec::new();
    write_points(&mut written, &PointTable::of(&expected)).unwrap();
    assert_eq!(points(&written), expected);
    let mut classed = Vec::new();
    write_points(&mut classed, &PointTable { classes: &[7, 300], ..PointTable::of(&expected) }).unwrap();
    assert!(points(&classed) == expected && classed.ends_with(&[44, 1, 0, 0]));
    let mut ranked = Vec::new();
    write_points(&mut ranked, &PointTable { ranks: &[1.5, 0.25], ..PointTable::of(&expected) }).unwrap();
    assert!(points(&ranked) == expected && ranked.ends_with(&0.25f32.to_le_bytes()));
    let mut varying = Vec::new();
    write_points(&mut varying, &PointTable { radii: &[0.5, 0.125], ..PointTable::of(&expected) }).unwrap();
    assert!(points(&varying) == expected && varying.ends_with(&0.125f32.to_le_bytes()));
    // The header of these bytes is what numpy.save writes.
    let start = b"\x93NUMPY\x01\x00v\x00{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }  ";
    assert!(written.starts_with(start) && written[..128].ends_with(b" \n") && written.len() == 128 + 16);
}

#[test]
fn a_structured_array_holds_all_that_is_known_of_samples() {
    let samples = Points {
        positions: vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        normals: vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        interpolated_normals: Vec::new(),
        triangles: vec![7, 4_000_000_001],
        barycentrics: vec![[0.25, 0.5], [0.0, 1.0]],
        ranks: vec![f32::INFINITY, 0.5],
        classes: vec![1, 0],
        radii: Vec::new(),
        ids: Vec::new(),
        instances: Vec::new(),
    };
    let table = |radii| SurfaceTable {
        samples: &samples,
        normals: &samples.normals,
        radii,
        class_radii: &[],
        origin: [0.0; 3],
    };
    for radii in [None, Some(&[0.5, 2.0][..])] {
        let mut written = Vec::new();
        write_surface(&mut written, &table(radii)).unwrap();
        let read = parse(&written).unwrap().into_samples([0.0; 3]).unwrap();
        assert_eq!((&read.positions, &read.normals), (&samples.positions, &samples.normals));
        assert_eq!(read.on_mesh, Some((samples.triangles.clone(), samples.barycentrics.clone())));
    }
    // Fields as plyfile and others write them, with some that are not needed.
    let fields = "[('red', '|u1'), ('y', '<f8'), ('more', '<i2', (2, 2)), ('x', '<f4')]";
    let text = format!("{{'descr': {fields}, 'fortran_order': False, 'shape': (1,), }}");
    let body = [&[255][..], &2.5f64.to_le_bytes(), &[1; 8], &(-1.0f32).to_le_bytes()].concat();
    assert_eq!(points(&file(&text, &body)), [[-1.0, 2.5]]);
}

#[test]
fn what_is_no_array_of_points_is_refused_with_the_reason() {
    let refused = |file: &[u8]| parse(file).unwrap_err();
    let body = [0u8; 48];
    let of = |element: &str, shape: &str| file(&dictionary(element, "False", shape), &body);
    assert!(refused(&of("<f4", "(12,)")).starts_with("has the shape [12], not"));
    assert_eq!(refused(&of("<f4", "(6, 1)")), "has 1 columns, and none for y");
    assert!(refused(&of("<f4", "(7, 2)")).contains("7 rows of 8 bytes, but only 48 bytes"));
    assert!(refused(&of("<f4", "(9223372036854775807, 9223372036854775807)")).contains("announces"));
    assert!(refused(&of("<c8", "(3, 2)")).contains("\"<c8\", not floats or integers"));
    assert!(refused(&file("{'shape': (1, 2)}", &body)).contains("has no descr"));
    let field = |field: &str| file(&format!("{{'descr': [{field}], 'fortran_order': False, 'shape': (1,)}}"), &body);
    assert!(refused(&field("('x', '<f4'), ('y', [('z', '<f4')])")).starts_with("has a field that is not read"));
    assert_eq!(refused(&field("('x', '<f4'), ('z', '<f4')")), "has no field for y");
    assert!(refused(&field("('position', '<f4', (9223372036854775807,))")).contains("announces"));
    for cut in [b"no array".to_vec(), file("{}", &[])[..60].to_vec(), b"\x93NUMPY\x03\x00\xff\xff".to_vec()] {
        assert!(refused(&cut).starts_with("is no array of NumPy"));
    }
    let infinite = file(&dictionary("<f8", "False", "(1, 2)"), &[1.0f64, 1e300].map(f64::to_le_bytes).concat());
    assert_eq!(refused(&infinite), "row 0: y is inf, not finite");
}

#[test]
fn a_grid_has_its_values_in_one_order_whatever_that_of_the_file() {
    // Two layers of one row of three values.
    let rows = [0.5f32, 1.0, 1.5, 2.0, 2.5, 3.0];
    let columns = [0.5f32, 2.0, 1.0, 2.5, 1.5, 3.0];
    for (element, fortran, body) in [
        ("<f4", "False", rows.map(f32::to_le_bytes).concat()),
        (">f4", "True", columns.map(f32::to_be_bytes).concat()),
        ("<f8", "True", columns.map(|x| f64::from(x).to_le_bytes()).concat()),
    ] {
        let grid = parse_grid(&file(&dictionary(element, fortran, "(2, 1, 3)"), &body)).unwrap();
        assert_eq!((&grid.values[..], grid.size), (&rows[..], [3, 1, 2]), "{element}");
    }
    let whole = parse_grid(&file(&dictionary("|u1", "False", "(1, 2, 1)"), &[7, 9])).unwrap();
    assert_eq!((whole.values, whole.size), (vec![7.0, 9.0], [1, 2, 1]));
}

#[test]
fn what_is_no_grid_is_refused() {
    let floats = |shape: &str| file(&dictionary("<f4", "False", shape), &[0; 24]);
    for (bytes, said) in [
        (floats("(6,)"), "has the shape [6] and the type \"<f4\", not (z, y, x) and numbers"),
        (floats("(1, 2, 3, 1)"), "has the shape [1,2,3,1]"),
        (floats("(1, -2, 3)"), "has the shape [1,-2,3]"),
        (floats("(2, 2, 3)"), "the header announces the shape [2,2,3], but only 24 bytes follow"),
        (floats("(4294967296, 4294967296, 1)"), "the header announces the shape"),
        (file(&dictionary("<c8", "False", "(1, 1, 3)"), &[0; 24]), "has numbers of the type \"<c8\""),
        (b"x,y\n1,2\n".to_vec(), "is no array of NumPy"),
    ] {
        let reason = parse_grid(&bytes).err().unwrap();
        assert!(reason.starts_with(said), "{reason}");
    }
}
