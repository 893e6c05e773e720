//! The quality of a set: judged in `f64` from the points that the peer returned, by counting pairs, and by azulejo's
//! exact coverage.

use std::collections::HashMap;
use std::error::Error;
use std::fs;
use std::path::Path;

use azulejo::analysis::{bonds, coverage};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain};

/// A set whose samples are floats, or are made such for azulejo's coverage, is taken to cover with disks that are
/// larger by so many spacings of floats at the largest coordinate: azulejo promises no more.
const ROUNDING: f64 = 6.0;

/// The quality of a set.
#[derive(Clone, Copy)]
pub struct Verdict {
    pub samples: usize,
    /// Pairs closer than the radius.
    pub conflicts: usize,
    pub smallest: f64,
    pub farthest: f64,
    pub gaps: usize,
    /// The distance of neighbours if as many samples stood in hexagonal arrangement.
    pub hexagonal: f64,
    /// Of sets in the plane.
    pub bond_order: Option<f64>,
    /// Of thinned clouds that have an order, for the first tenth of the points: the farthest point of the cloud over
    /// the smallest distance.
    pub of_first_tenth: Option<f64>,
}

/// Where samples lie.
pub enum Place<'a> {
    Square,
    Surface(&'a Mesh),
    /// The points to choose from, and the area that they lie on.
    Cloud(&'a [[f64; 3]], f64),
}

/// Judges the samples of a file of raw doubles.
pub fn judge(file: &Path, place: &Place, radius: f64, is_ordered: bool) -> Result<Verdict, Box<dyn Error>> {
    let bytes = fs::read(file)?;
    let numbers: Vec<f64> = bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("8 bytes"))).collect();
    match place {
        Place::Square => plane(&points(&numbers), radius),
        Place::Surface(mesh) => surface(mesh, &points(&numbers), radius),
        Place::Cloud(cloud, area) => Ok(thinned(cloud, *area, &points(&numbers), radius, is_ordered)),
    }
}

fn points<const N: usize>(numbers: &[f64]) -> Vec<[f64; N]> {
    numbers.chunks_exact(N).map(|point| point.try_into().expect("N numbers")).collect()
}

fn plane(points: &[[f64; 2]], radius: f64) -> Result<Verdict, Box<dyn Error>> {
    let (context, domain) = (Context::new(0)?, Domain::unit(Boundary::Bounded));
    // Some return 1, or what becomes 1 as a float.
    let rounded: Vec<[f32; 2]> =
        points.iter().map(|point| point.map(|x| (x as f32).clamp(0.0, 1.0f32.next_down()))).collect();
    let covered = coverage::coverage_2d(&context, &domain, &rounded, radius + rounding(&rounded), None)?;
    let (conflicts, smallest) = pairs(points, radius);
    Ok(Verdict {
        samples: points.len(),
        conflicts,
        smallest,
        farthest: covered.farthest,
        gaps: covered.gaps,
        hexagonal: domain.hexagonal_distance(points.len()),
        bond_order: Some(bonds::bond_order(&context, &domain, &rounded, None)?),
        of_first_tenth: None,
    })
}

fn surface(mesh: &Mesh, points: &[[f64; 3]], radius: f64) -> Result<Verdict, Box<dyn Error>> {
    let context = Context::new(0)?;
    let rounded: Vec<[f32; 3]> = points.iter().map(|point| point.map(|x| x as f32)).collect();
    let covered = coverage::surface_coverage(&context, mesh, &rounded, radius + rounding(&rounded), None)?;
    let (conflicts, smallest) = pairs(points, radius);
    Ok(Verdict {
        samples: points.len(),
        conflicts,
        smallest,
        farthest: covered.farthest,
        gaps: covered.gaps,
        hexagonal: (2.0 * mesh.area() / (3.0f64.sqrt() * points.len() as f64)).sqrt(),
        bond_order: None,
        of_first_tenth: None,
    })
}

fn thinned(cloud: &[[f64; 3]], area: f64, points: &[[f64; 3]], radius: f64, is_ordered: bool) -> Verdict {
    let (conflicts, smallest) = pairs(points, radius);
    let of_first_tenth = is_ordered.then(|| {
        let (first_tenth, wide) = (&points[..points.len() / 10], radius * 10.0f64.sqrt());
        farthest(cloud, first_tenth, wide) / pairs(first_tenth, wide).1
    });
    Verdict {
        samples: points.len(),
        conflicts,
        smallest,
        farthest: farthest(cloud, points, radius),
        gaps: 0,
        hexagonal: (2.0 * area / (3.0f64.sqrt() * points.len() as f64)).sqrt(),
        bond_order: None,
        of_first_tenth,
    }
}

/// The largest distance of a point of a cloud from the nearest of some points: around each, cells farther and farther
/// away are searched.
fn farthest(cloud: &[[f64; 3]], points: &[[f64; 3]], side: f64) -> f64 {
    let cell = |point: &[f64; 3]| point.map(|x| (x / side).floor() as i64);
    let mut cells: HashMap<[i64; 3], Vec<[f64; 3]>> = HashMap::new();
    points.iter().for_each(|point| cells.entry(cell(point)).or_default().push(*point));
    let squared = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    let nearest = |point: &[f64; 3]| {
        let (home, mut least) = (cell(point), f64::INFINITY);
        for ring in 0i64.. {
            // A distance below that of the rings that have been searched is final.
            if least.sqrt() <= (ring - 1) as f64 * side {
                break;
            }
            for z in -ring..=ring {
                for y in -ring..=ring {
                    let on_shell = z.abs() == ring || y.abs() == ring;
                    for x in (-ring..=ring).filter(|x| on_shell || x.abs() == ring) {
                        let others = cells.get(&[home[0] + x, home[1] + y, home[2] + z]);
                        least =
                            others.into_iter().flatten().fold(least, |least, other| least.min(squared(point, other)));
                    }
                }
            }
        }
        least.sqrt()
    };
    cloud.iter().map(nearest).fold(0.0, f64::max)
}

fn rounding<const N: usize>(points: &[[f32; N]]) -> f64 {
    let largest = points.iter().flatten().fold(0.0f32, |largest, x| largest.max(x.abs()));
    ROUNDING * f64::from(largest.next_up() - largest)
}

/// The pairs closer than `radius`, and the smallest distance, as far as it is below two radii.
fn pairs<const N: usize>(points: &[[f64; N]], radius: f64) -> (usize, f64) {
    let side = 2.0 * radius;
    let cell = |point: &[f64; N]| point.map(|x| (x / side).floor() as i64);
    let mut cells: HashMap<[i64; N], Vec<usize>> = HashMap::new();
    let (mut conflicts, mut smallest) = (0, f64::INFINITY);
    for (index, point) in points.iter().enumerate() {
        let home = cell(point);
        for neighbour in 0..3usize.pow(N as u32) {
            let key = std::array::from_fn(|axis| home[axis] + (neighbour / 3usize.pow(axis as u32) % 3) as i64 - 1);
            for &other in cells.get(&key).into_iter().flatten() {
                let squared: f64 = point.iter().zip(&points[other]).map(|(a, b)| (a - b) * (a - b)).sum();
                smallest = smallest.min(squared.sqrt());
                // As squares, and so exactly as azulejo promises it.
                conflicts += usize::from(squared < radius * radius);
            }
        }
        cells.entry(home).or_default().push(index);
    }
    (conflicts, smallest)
}
