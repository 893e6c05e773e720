//! Vertices at the same position are one, as needed for files that repeat their vertices in each triangle (STL), and
//! where a seam was computed twice.

use glam::DVec3;

use crate::mesh::{Mesh, exact};

/// The side of the cells in which vertices are found, in tolerances: wide, so that few vertices are near two of them.
const CELL: f64 = 256.0;

const NONE: u32 = u32::MAX;

/// For each vertex the first one at its position, up to a float spacing at the largest coordinate. O(n).
pub(super) fn welded(mesh: &Mesh) -> Vec<u32> {
    let tolerance = f64::from(mesh.largest_coordinate()) * f64::from(f32::EPSILON);
    let positions = mesh.positions();
    let low = exact(mesh.bounds().0);
    // Vertices that no triangle uses may be outside the bounds; whole numbers saturate there.
    let cell = |place: DVec3| {
        let cell = (place - low) / (CELL * tolerance);
        [cell.x as i64, cell.y as i64, cell.z as i64]
    };
    let bits = (2 * positions.len()).next_power_of_two().ilog2().max(1);
    let bucket = |[x, y, z]: [i64; 3]| {
        // Large primes of Teschner et al. 2003; the product brings the mixed bits to the top.
        let mixed = (x as u64).wrapping_mul(73_856_093)
            ^ (y as u64).wrapping_mul(19_349_663)
            ^ (z as u64).wrapping_mul(83_492_791);
        (mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits)) as usize
    };
    // The first vertices, in chains from the buckets of their cells.
    let mut heads = vec![NONE; 1 << bits];
    let mut chain = vec![NONE; positions.len()];
    let mut firsts = Vec::with_capacity(positions.len());
    for (vertex, &position) in (0..).zip(positions) {
        let place = exact(position);
        let (from, to) = (cell(place - tolerance), cell(place + tolerance));
        let mut first = NONE;
        for z in from[2]..=to[2] {
            for y in from[1]..=to[1] {
                for x in from[0]..=to[0] {
                    let mut other = heads[bucket([x, y, z])];
                    while other != NONE {
                        let squared = exact(positions[other as usize]).distance_squared(place);
                        if squared <= tolerance * tolerance {
                            first = first.min(other);
                        }
                        other = chain[other as usize];
                    }
                }
            }
        }
        if first == NONE {
            first = vertex;
            let bucket = bucket(cell(place));
            chain[vertex as usize] = heads[bucket];
            heads[bucket] = vertex;
        }
        firsts.push(first);
    }
    firsts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn vertices_are_welded_as_in_a_loop_over_all() {
        let mut rng = Rng::at(12, Draw::Probe, &[]);
        let tolerance = f64::from(f32::EPSILON);
        // Places in many and in few cells, each several times, about as far apart as the tolerance.
        for scale in [1.0, 1e-5] {
            let mut positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            for _ in 0..300 {
                let place: [f64; 3] = std::array::from_fn(|_| rng.unit() * scale);
                for _ in 0..3 {
                    positions.push(place.map(|x| (x + 2.0 * tolerance * (rng.unit() - 0.5)) as f32));
                }
            }
            let mut firsts: Vec<u32> = Vec::new();
            let expected = (0..positions.len() as u32).map(|vertex| {
                let here = |first: &&u32| {
                    let [a, b] = [**first, vertex].map(|vertex| exact(positions[vertex as usize]));
                    a.distance_squared(b) <= tolerance * tolerance
                };
                let first = firsts.iter().find(here).copied();
                first.unwrap_or_else(|| {
                    firsts.push(vertex);
                    vertex
                })
            });
            let expected: Vec<u32> = expected.collect();
            let mesh = Mesh::new(positions.clone(), vec![[0, 1, 2]]).unwrap();
            assert_eq!(welded(&mesh), expected);
            assert!(firsts.len() < positions.len() - 100);
        }
    }
}
