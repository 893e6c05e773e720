//! The evenness of the sets of PSP, however a surface is turned towards the projectors, and however it is cut into triangles.

use std::sync::Arc;

use azulejo::analysis::facing::density_by_facing;
use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Radius};
use azulejo::psp::{Priority, ProjectionOptions, Projectors, Psp};
use azulejo::{Context, MAXIMAL_DENSITY};

use crate::common::meshes;

/// Degrees of a bin.
const BIN: usize = 6;

type Point = [f64; 3];

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

/// The oracle of `density_by_facing`: samples and area of each bin, all from the corners of triangles.
fn naive_facings(mesh: &Mesh, triangles: &[u32], directions: &[Point]) -> Vec<[f64; 2]> {
    let mut samples_of = vec![0.0; mesh.triangles().len()];
    triangles.iter().for_each(|&triangle| samples_of[triangle as usize] += 1.0);
    let mut bins = vec![[0.0; 2]; 90 / BIN];
    for (triangle, samples) in mesh.triangles().iter().zip(samples_of) {
        let [a, b, c] = triangle.map(|vertex| mesh.positions()[vertex as usize].map(f64::from));
        let [u, v]: [Point; 2] = [b, c].map(|corner| std::array::from_fn(|axis| corner[axis] - a[axis]));
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = dot(cross, cross).sqrt();
        let turned = |d: &Point| (dot(cross, *d).abs() / (length * dot(*d, *d).sqrt())).min(1.0).acos().to_degrees();
        let least = directions.iter().map(turned).fold(90.0, f64::min);
        let bin = ((least / BIN as f64) as usize).min(bins.len() - 1);
        bins[bin] = [bins[bin][0] + samples, bins[bin][1] + 0.5 * length];
    }
    bins
}

/// N·r²/A by the angle to the nearest projector, 0 to 54 degrees, after one iteration and after filling, of a few seeds.
fn densities(priority: Priority) -> [Vec<f64>; 2] {
    let (positions, triangles) = meshes::fine_torus(400, 160);
    let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
    let (context, radius, seeds) = (Context::new(2).unwrap(), 0.016, 6);
    let mut sums = [(); 2].map(|()| vec![[0.0; 2]; 54 / BIN]);
    for seed in 0..seeds {
        let mut psp = Psp::new(
            &mesh,
            &ProjectionOptions::new(radius).projectors(Projectors::Global).seed(seed).priority(priority),
        )
        .unwrap();
        assert_eq!(psp.directions(), None);
        for (step, sums) in sums.iter_mut().enumerate() {
            let advance = if step == 0 { psp.advance(&context, 1, None) } else { psp.fill(&context, None) };
            advance.unwrap();
            let directions = psp.directions().unwrap();
            let facings = density_by_facing(&mesh, &psp.samples().triangles, &directions, 90 / BIN).unwrap();
            assert!(facings[10..].iter().all(|facing| facing.area == 0.0), "a direction is missing");
            let naive = naive_facings(&mesh, &psp.samples().triangles, &directions);
            for ((sum, facing), [samples, area]) in sums.iter_mut().zip(facings).zip(naive) {
                // Normals that are rounded to floats put a few triangles into the bin beside.
                assert!((facing.area - area).abs() < 1e-3 * area, "{facing:?}, {area}");
                assert!((facing.samples as f64 - samples).abs() < 1e-3 * samples + 5.0, "{facing:?}, {samples}");
                *sum = [sum[0] + samples, sum[1] + area];
            }
        }
    }
    sums.map(|bins| bins.into_iter().map(|[samples, area]| samples * radius * radius / area).collect())
}

/// Squares at known angles to two directions, each of another area and with another number of samples, and an odd one out.
#[test]
fn the_oracle_puts_areas_and_samples_where_they_face() {
    let (mut positions, mut triangles, mut samples) = (Vec::new(), Vec::new(), Vec::new());
    for bin in 0..90 / BIN {
        let first = positions.len() as u32;
        let angle = ((bin as f64 + 0.5) * BIN as f64).to_radians();
        let (length, sine, cosine) = ((bin + 1) as f64, angle.sin(), angle.cos());
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        positions.extend(corners.map(|[x, y]: [f64; 2]| [x * length * cosine, y, x * length * sine].map(|x| x as f32)));
        samples.extend(std::iter::repeat_n(triangles.len() as u32, 10 * bin));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let mesh = Mesh::new(positions, triangles).unwrap();
    let check = |directions: &[Point], expected: &dyn Fn(usize) -> [usize; 2]| {
        for (bin, [samples, area]) in naive_facings(&mesh, &samples, directions).into_iter().enumerate() {
            let [samples_here, area_here] = expected(bin);
            assert_eq!(samples, samples_here as f64, "{directions:?}, {bin}");
            assert!((area - area_here as f64).abs() < 1e-5, "{directions:?}, {bin}: {area}");
        }
    };
    let last = 90 / BIN - 1;
    check(&[[0.0, 0.0, -3.0]], &|bin| [10 * bin, bin + 1]);
    check(&[[0.5, 0.0, 0.0]], &|bin| [10 * (last - bin), last - bin + 1]);
    // Of two directions it is the nearer; the square halfway is as far from both.
    let both = |bin: usize| match bin.cmp(&(last / 2)) {
        std::cmp::Ordering::Less => [10 * last, last + 2],
        std::cmp::Ordering::Equal => [10 * bin, bin + 1],
        std::cmp::Ordering::Greater => [0, 0],
    };
    check(&[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]], &both);
}

/// The samples of one iteration depend on the angle; the fill makes up for all of it but a few percent.
#[test]
fn filling_evens_out_what_the_projectors_miss() {
    for (priority, left) in [(Priority::Squareness, 0.045), (Priority::Projector, 0.03)] {
        let [found, filled] = densities(priority);
        assert!(found[found.len() - 1] < 0.8 * found[0], "{priority:?} {found:?}");
        // Where a projector looks squarely its pattern is as it was, but for what candidates of others displace.
        assert_eq!(found[0] > 0.98 * MAXIMAL_DENSITY, priority == Priority::Squareness, "{priority:?} {found:?}");
        for density in filled {
            assert!((density / MAXIMAL_DENSITY - 1.0).abs() < left, "{priority:?} {density}");
        }
    }
}

/// A square of `count` by `count` quads of side 2, every second one whole and the others cut into 8 by 8. For each triangle,
/// whether it is of a whole quad.
fn checkers(count: u32) -> (Mesh, Vec<bool>) {
    let (mut positions, mut triangles, mut is_whole) = (Vec::new(), Vec::new(), Vec::new());
    for [i, j] in (0..count * count).map(|quad| [quad / count, quad % count]) {
        let parts = if (i + j) % 2 == 0 { 1 } else { 8 };
        for [a, b] in (0..parts * parts).map(|part| [part / parts, part % parts]) {
            let first = positions.len() as u32;
            let corner = |[x, y]: [u32; 2]| {
                let [x, y] =
                    [(i, a + x), (j, b + y)].map(|(quad, part)| 2.0 * (quad as f32 + part as f32 / parts as f32));
                [x, y, 0.0]
            };
            positions.extend([[0, 0], [1, 0], [1, 1], [0, 1]].map(corner));
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            is_whole.extend([parts == 1; 2]);
        }
    }
    (Mesh::new(positions, triangles).unwrap(), is_whole)
}

/// As many samples stand on large triangles as on small ones between them.
#[test]
fn the_size_of_triangles_does_not_matter() {
    let (mesh, is_whole) = checkers(20);
    let radii = vec![1.0; mesh.positions().len()];
    let (context, seeds) = (Context::new(2).unwrap(), 8);
    let mut counts = [0.0; 2];
    for seed in 0..seeds {
        let options = adaptive::Options::new(Radius::PerVertex(&radii)).seed(seed);
        let (set, _) = adaptive::sample(&context, &mesh, &options, None).unwrap();
        for (position, &triangle) in set.positions.iter().zip(&set.triangles) {
            // Samples stand closer at the boundary of the square.
            if position[..2].iter().all(|x| (4.0..36.0).contains(x)) {
                counts[usize::from(is_whole[triangle as usize])] += 1.0;
            }
        }
    }
    for count in counts {
        let density = count / (0.5 * 32.0 * 32.0 * seeds as f64);
        assert!((density / MAXIMAL_DENSITY - 1.0).abs() < 0.04, "{counts:?}: {density}");
    }
}

/// Two unit squares apart: one of two triangles, one of 45,000.
fn halves() -> Mesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (left, parts) in [(0.0, 1u32), (2.0, 150)] {
        let first = positions.len() as u32;
        for [i, j] in (0..(parts + 1) * (parts + 1)).map(|corner| [corner / (parts + 1), corner % (parts + 1)]) {
            positions.push([left + i as f32 / parts as f32, j as f32 / parts as f32, 0.0]);
        }
        for [i, j] in (0..parts * parts).map(|part| [part / parts, part % parts]) {
            let corner = |i: u32, j: u32| first + i * (parts + 1) + j;
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(positions, triangles).unwrap()
}

/// Two huge triangles get as many samples of a uniform fill as the tiny ones of the same area, both in one piece and by
/// cubes. These leave up to 1 % more samples at their seams, and seams across huge triangles are longer.
#[test]
fn huge_and_tiny_triangles_are_filled_alike() {
    let (mesh, context) = (Arc::new(halves()), Context::new(2).unwrap());
    for (samples, seeds, bound) in [(10_000.0, 24, 0.004), (100_000.0, 3, 0.008)] {
        let radius = (2.0 * MAXIMAL_DENSITY / samples).sqrt();
        let mut counts = [0.0; 2];
        for seed in 0..seeds {
            let mut psp =
                Psp::new(&mesh, &ProjectionOptions::new(radius).projectors(Projectors::Global).seed(seed)).unwrap();
            psp.fill(&context, None).unwrap();
            psp.samples().triangles.iter().for_each(|&triangle| counts[usize::from(triangle >= 2)] += 1.0);
        }
        let [huge, tiny] = counts;
        assert!(huge > 0.45 * samples * seeds as f64);
        assert!((huge / tiny - 1.0f64).abs() < bound, "{samples}: {counts:?}");
    }
}
