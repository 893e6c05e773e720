//! Damaged files of points and grids: valid ones with some bytes changed, cut out or doubled, in every format. Each is read or
//! refused with a message of one line, without a panic, and the numbers of a header are not trusted.

use super::columns::write_floats;
use super::points::PointTable;
use super::set::PointSet;
use super::{npy, raw, table};
use crate::ply;

type Parse = fn(&[u8]) -> Result<(), String>;

/// The undamaged input: every parser, and files that it reads.
fn good_files() -> Vec<(Parse, Vec<u8>)> {
    let (plane, space) = ([[0.5f32, -1.25], [3.0, 4e-3]], [[0.5f32, -1.25, 7.0], [3.0, 4e-3, 1e9]]);
    let mut array = Vec::new();
    npy::write_points(&mut array, &PointTable::of(&plane)).unwrap();
    let fields =
        "[('x', '<f4'), ('y', '<f4'), ('normal', '<f4', (3,)), ('triangle', '<u4'), ('barycentrics', '<f4', (2,))]";
    let header = format!("{:<246}", format!("{{'descr': {fields}, 'fortran_order': False, 'shape': (1,), }}"));
    let structured = [b"\x93NUMPY\x01\x00\xf6\x00", header.as_bytes(), &[0; 32]].concat();
    let header = format!("{:<118}", "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3, 1), }");
    let grid = [b"\x93NUMPY\x01\x00\x76\x00", header.as_bytes(), &[63; 24]].concat();
    let mut floats = Vec::new();
    write_floats(&mut floats, &space).unwrap();
    let text = "# points\nx,y,z,nx,ny,nz\n0.5,-1.25,7,0,0,1\n3,4e-3,1e9,1,0,0\n";
    let header = |format: &str, index: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment domain 0 0 1 1 periodic\nelement vertex 2\nproperty float x\nproperty \
             double y\nproperty short z\nproperty uint triangle\nproperty float u\nproperty float v\n{index}end_header\n"
        )
    };
    let vertex = [0.5f32.to_le_bytes().to_vec(), 2.0f64.to_le_bytes().to_vec(), vec![0; 14]].concat();
    let binary = [header("binary_little_endian", "").into_bytes(), vertex.clone(), vertex].concat();
    let list = header("ascii", "element face 1\nproperty list uchar int vertex_indices\n");
    let ascii = format!("{list}0.5 2 3 0 0.25 0.5\n1 2 3 1 0.5 0.25\n3 0 1 1\n");
    vec![
        (|bytes| npy::parse(bytes).map(check_points), array),
        (|bytes| npy::parse(bytes).map(check_points), structured),
        (|bytes| npy::parse_grid(bytes).map(check_grid), grid),
        (|bytes| raw::parse(bytes, 2).map(check_points), floats.clone()),
        (|bytes| raw::parse(bytes, 3).map(check_points), floats),
        (|bytes| table::parse(bytes).map(check_points), text.into()),
        (|bytes| table::parse(bytes).map(check_points), "0.5 2 3 0 0 1\n1 2 3 1 0 0\n".into()),
        (|bytes| ply::parse(bytes).map(check_points), binary),
        (|bytes| ply::parse(bytes).map(check_points), ascii.into()),
    ]
}

fn check_points(set: PointSet) {
    let Ok(samples) = set.into_samples([0.0; 3]) else { return };
    assert!(samples.positions.iter().chain(&samples.normals).flatten().all(|x| x.is_finite()));
    assert!(samples.normals.is_empty() || samples.normals.len() == samples.positions.len());
    let lengths = samples.on_mesh.map(|(triangles, sides)| [triangles.len(), sides.len()]);
    assert!(lengths.is_none_or(|lengths| lengths == [samples.positions.len(); 2]));
}

fn check_grid(grid: npy::Grid) {
    let [x, y, z] = grid.size;
    assert_eq!(grid.values.len(), z * y * x);
}

/// Random numbers (Marsaglia's xorshift).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % end.max(1)
    }
}

fn damage(file: &mut Vec<u8>, numbers: &mut Numbers) {
    const PARTS: [&str; 8] = [
        "18446744073709551615",
        "-1",
        "nan",
        "4294967296",
        "\n",
        "1e999",
        "(3, 6148914691236517206)",
        "element vertex 9",
    ];
    let at = numbers.below(file.len());
    let end = (at + numbers.below(12)).min(file.len());
    match numbers.below(6) {
        0 => file.truncate(at),
        1 => _ = file.drain(at..end),
        2 => file[at..end].fill(numbers.below(256) as u8),
        3 => _ = file.splice(at..at, file[at..end].to_vec()),
        4 => _ = file.splice(at..end, PARTS[numbers.below(PARTS.len())].bytes()),
        // One digit more than before.
        _ => _ = file.splice(at..at, [b'0' + numbers.below(10) as u8]),
    }
}

fn check(parsed: Result<(), String>) -> bool {
    if let Err(reason) = &parsed {
        assert!(!reason.is_empty() && reason.len() < 1000 && !reason.contains('\n'), "{reason}");
    }
    parsed.is_ok()
}

#[test]
fn damaged_files_are_read_or_refused() {
    let mut numbers = Numbers(1);
    for (parse, good) in good_files() {
        assert!(check(parse(&good)));
        let mut read = 0;
        for _ in 0..10_000 {
            let mut file = good.clone();
            (0..=numbers.below(4)).for_each(|_| {
                if !file.is_empty() {
                    damage(&mut file, &mut numbers);
                }
            });
            read += u32::from(check(parse(&file)));
        }
        assert!((100..9_900).contains(&read), "{read} of 10,000 damaged files were read");
    }
}
