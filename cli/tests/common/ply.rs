//! Points of the plane in binary PLY files.

use std::fs;

use super::common::Workshop;

/// The numbers of a binary PLY file with `width` four-byte floats per vertex, and its header.
pub fn floats(file: &[u8], width: usize) -> (String, Vec<Vec<f32>>) {
    const END: &[u8] = b"end_header\n";
    let end = file.windows(END.len()).position(|window| window == END).unwrap() + END.len();
    let header = String::from_utf8(file[..end].to_vec()).unwrap();
    assert_eq!((file.len() - end) % (4 * width), 0);
    let numbers = file[end..].chunks(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
    let numbers: Vec<_> = numbers.collect();
    (header, numbers.chunks(width).map(<[f32]>::to_vec).collect())
}

/// [`floats`] of a set of the plane, without the column of z, which is 0: `width` numbers per vertex are left.
pub fn flat(file: &[u8], width: usize) -> (String, Vec<Vec<f32>>) {
    let (header, mut rows) = floats(file, width + 1);
    assert!(header.contains("property float y\nproperty float z\n"), "{header}");
    assert!(rows.iter_mut().all(|row| row.remove(2) == 0.0));
    (header, rows)
}

/// The points of a PLY file.
pub fn points(workshop: &Workshop, name: &str) -> Vec<Vec<f32>> {
    flat(&fs::read(workshop.path(name)).unwrap(), 2).1
}

/// The smallest distance on the unit torus of points from a place.
pub fn nearest(points: &[Vec<f32>], place: [f64; 2]) -> f64 {
    let distance = |point: &Vec<f32>| {
        let [dx, dy] = [0, 1].map(|axis| (f64::from(point[axis]) - place[axis]).abs()).map(|d| d.min(1.0 - d));
        dx.hypot(dy)
    };
    points.iter().map(distance).fold(f64::MAX, f64::min)
}
