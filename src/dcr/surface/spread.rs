//! Redistributes samples that are clustered on one part of the surface and missing on others.
//!
//! There is no Fourier transform on a mesh that would level a cluster, and forces move a sample by a fraction of the
//! spacing in a step. So before the first step such samples are redistributed (`dcr/clustering.rs`): as many points are
//! thrown on the surface at random, both are sorted along a Z-curve through space, and each sample is put on the point
//! of its rank. Each part of the surface, connected with others or not, receives samples by its area, or by the
//! integral of the density over it.

use crate::dcr::clustering::{EXCESS, is_clustered};
use crate::dcr::surface::apart::Floor;
use crate::dcr::surface::grading::Grading;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::index::curve::{SPACE_BITS, morton3, sorted};
use crate::index::{Grid3, Weights};
use crate::job::{Job, chunks};
use crate::mesh::{Mesh, exact};
use crate::psp::Fragment;
use crate::rng::{Draw, Rng};

/// The smallest distance, in spacings, from which on samples are left in place: random points would be too close.
const APART: f64 = 0.6;

/// The factor that takes the place of [`EXCESS`] where a density is asked for: points are thrown so evenly that their
/// numbers vary little, and forces do not level what is left.
const GRADED_EXCESS: f64 = 6.0;

/// The largest number of throws for a sample that get too close to samples placed before.
const ATTEMPTS: u64 = 64;

/// New places for samples that are clustered, no two closer to each other through space than the floor. None if they
/// are not clustered, or if there is not enough space.
///
/// Where the grade varies, new places keep no distance; and samples that lie where none are wanted get one each, even
/// if the set is not clustered.
pub fn spread<G: Grading>(
    job: &Job,
    mesh: &Mesh,
    grading: &G,
    places: &[SurfacePoint],
    floor: Floor,
    spacing: f64,
    seed: u64,
) -> Result<Option<Vec<SurfacePoint>>> {
    let is_stray = |place: &SurfacePoint| G::VARIES && grading.at(mesh, *place).is_none();
    let strays = places.iter().filter(|place| is_stray(place)).count();
    if floor.distance() >= APART * spacing && strays == 0 {
        return Ok(None);
    }
    let throws = RandomPoints::new(&job.part(0.0, 0.1), mesh, grading, seed)?;
    let tasks = chunks(places.len());
    let throw = |i: usize| throws.at([i, places.len()], 0);
    let thrown = job.part(0.1, 0.5).concat(tasks.len(), |task| tasks.range(task).map(throw).collect())?;
    let samples = along_curve(mesh, places);
    let [along, along_thrown] =
        [&samples, &along_curve(mesh, &thrown)].map(|all| all.iter().map(|&(along, _)| along).collect::<Vec<_>>());
    let mut spread = places.to_vec();
    let excess = if G::VARIES { GRADED_EXCESS } else { EXCESS };
    if !is_clustered::<3>(&along, &along_thrown, 3 * SPACE_BITS, excess) {
        let places = spread.iter_mut().filter(|place| is_stray(place));
        (0..).zip(places).for_each(|(i, place)| *place = throws.at([i, strays], 0));
        return Ok((strays > 0).then_some(spread));
    }
    let placed = match G::VARIES {
        true => Some(thrown),
        false => throws.apart(&job.part(0.5, 1.0), places.len(), floor, spacing)?,
    };
    let Some(placed) = placed else { return Ok(None) };
    for ((_, sample), (_, point)) in samples.iter().zip(along_curve(mesh, &placed)) {
        spread[*sample as usize] = placed[point as usize];
    }
    Ok(Some(spread))
}

/// Random points of a mesh.
struct RandomPoints<'a, G> {
    mesh: &'a Mesh,
    grading: &'a G,
    seed: u64,
    pieces: Pieces,
    /// The areas of the pieces, or the integrals of the density over them.
    weights: Weights,
}

/// The pieces on one of which a point is thrown.
enum Pieces {
    Triangles(Vec<u32>),
    Fragments(Vec<Fragment>),
}

impl<'a, G: Grading> RandomPoints<'a, G> {
    fn new(job: &Job, mesh: &'a Mesh, grading: &'a G, seed: u64) -> Result<Self> {
        let (pieces, weights) = match grading.pieces(job)? {
            None => {
                let (triangles, areas) = mesh.triangles_with_area(0..mesh.triangles().len()).unzip();
                (Pieces::Triangles(triangles), areas)
            }
            Some(pieces) => {
                let pieces: Vec<_> = pieces.into_iter().filter(|piece| piece.1 > 0.0).collect();
                let centres: Vec<_> = pieces.iter().map(|(fragment, _)| within(fragment, [1.0 / 3.0; 2])).collect();
                let along = along_curve(mesh, &centres).into_iter().map(|(_, i)| pieces[i as usize]);
                let (fragments, shares) = along.unzip();
                (Pieces::Fragments(fragments), shares)
            }
        };
        Ok(Self { mesh, grading, seed, pieces, weights: Weights::new(weights) })
    }

    /// The point of a sample, of so many, in one of its throws. On pieces, each sample has an equal part of their sum
    /// along the curve: so their numbers vary less than those of random points.
    fn at(&self, [sample, count]: [usize; 2], attempt: u64) -> SurfacePoint {
        let mut rng = Rng::at(self.seed, Draw::Spread, &[sample as u64, attempt]);
        match &self.pieces {
            Pieces::Triangles(triangles) => {
                let triangle = triangles[self.weights.pick(&mut rng) as usize];
                SurfacePoint { triangle, uv: rng.in_triangle().into() }
            }
            Pieces::Fragments(fragments) => {
                let share = ((sample as f64 + rng.unit()) / count as f64).min(1.0 - f64::EPSILON);
                let at = |inner| within(&fragments[self.weights.at(share) as usize], inner);
                // At the centre of a piece samples are wanted, at others of its points maybe not.
                let is_wanted = |place: &SurfacePoint| self.grading.at(self.mesh, *place).is_some();
                (0..ATTEMPTS).map(|_| at(rng.in_triangle())).find(is_wanted).unwrap_or(at([1.0 / 3.0; 2]))
            }
        }
    }

    /// The points of a number of samples, each the first of its sample that is far enough from those before; none if a
    /// sample has no such point.
    fn apart(&self, job: &Job, count: usize, floor: Floor, spacing: f64) -> Result<Option<Vec<SurfacePoint>>> {
        let (low, _) = self.mesh.bounds();
        let mut grid = Grid3::new(low.map(f64::from), spacing);
        let mut places: Vec<SurfacePoint> = Vec::with_capacity(count);
        for sample in 0..count {
            if sample % 4096 == 0 {
                job.report(sample as f64 / count as f64)?;
            }
            let is_free = |place: &SurfacePoint| {
                let position = place.position(self.mesh);
                let mut near = grid.candidates(position.into(), floor.distance());
                near.all(|other| floor.admits(position, places[other as usize].position(self.mesh), 1.0))
            };
            let Some(place) = (0..ATTEMPTS).map(|attempt| self.at([sample, count], attempt)).find(is_free) else {
                return Ok(None);
            };
            grid.insert(place.position(self.mesh).as_vec3().into());
            places.push(place);
        }
        Ok(Some(places))
    }
}

/// A point of a fragment.
fn within(fragment: &Fragment, inner: [f64; 2]) -> SurfacePoint {
    SurfacePoint { triangle: fragment.triangle, uv: fragment.at(inner).into() }
}

// A Z-curve through the bounds of a mesh: points close on the surface are mostly close along it.

/// The places of points along the curve, in order, with the points' numbers.
pub fn along_curve(mesh: &Mesh, points: &[SurfacePoint]) -> Vec<(u64, u32)> {
    let (low, high) = mesh.bounds();
    let extent = (exact(high) - exact(low)).max_element().max(f64::MIN_POSITIVE);
    let last = f64::from((1u32 << SPACE_BITS) - 1);
    sorted(points.iter().map(|point| {
        let place = (point.position(mesh) - exact(low)) / extent * last;
        morton3(place.to_array().map(|x| x as u32))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::surface::grading::Even;
    use crate::job::Context;

    /// A unit square of `side`² cells and, far from it, another of twice its size.
    fn squares(side: u32) -> Mesh {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for (corner, size) in [([0.0, 0.0, 0.0], 1.0), ([9.0, 3.0, -4.0], 2.0)] {
            let first = positions.len() as u32;
            let at = |i: u32| size * i as f32 / side as f32;
            for (row, column) in (0..=side).flat_map(|row| (0..=side).map(move |column| (row, column))) {
                positions.push([corner[0] + at(column), corner[1] + at(row), corner[2]]);
                if row < side && column < side {
                    let a = first + row * (side + 1) + column;
                    triangles.extend([[a, a + 1, a + side + 2], [a, a + side + 2, a + side + 1]]);
                }
            }
        }
        Mesh::new(positions, triangles).unwrap()
    }

    fn uniform(mesh: &Mesh, count: usize) -> Vec<SurfacePoint> {
        let new = |job: &Job| RandomPoints::new(job, mesh, &Even, 77);
        let throws = Context::new(1).unwrap().run(None, new).unwrap();
        (0..count).map(|sample| throws.at([sample, count], 0)).collect()
    }

    fn spread_of(mesh: &Mesh, places: &[SurfacePoint], floor: f64) -> Option<Vec<SurfacePoint>> {
        let spacing = (2.0 * mesh.area() / (3f64.sqrt() * places.len() as f64)).sqrt();
        let run = |job: &Job| spread(job, mesh, &Even, places, Floor::new(floor), spacing, 3);
        let [one, three] = [1, 3].map(|threads| Context::new(threads).unwrap().run(None, run).unwrap());
        assert_eq!(one, three);
        one
    }

    /// The samples of a uniform set on triangle 0 alone, or with a share of them elsewhere.
    fn clustered(mesh: &Mesh, count: usize, share: f64) -> Vec<SurfacePoint> {
        let mut places = uniform(mesh, count);
        let moved = (share * count as f64) as usize;
        places[..moved].iter_mut().for_each(|place| place.triangle = 0);
        places
    }

    #[test]
    fn clusters_are_redistributed_by_area() {
        let mesh = squares(20);
        for share in [1.0, 0.5, 0.2] {
            let placed = spread_of(&mesh, &clustered(&mesh, 5000, share), 0.0).unwrap();
            let on_small = placed.iter().filter(|place| place.triangle < 800).count();
            assert!(on_small.abs_diff(1000) < 120, "{on_small}");
            let mut per_triangle = vec![0; 1600];
            placed.iter().for_each(|place| per_triangle[place.triangle as usize] += 1);
            assert!(per_triangle.iter().all(|&count| count < 20), "{share}");
            assert!(placed.iter().all(|place| place.uv.min_element() >= 0.0 && place.uv.element_sum() <= 1.0));
        }
    }

    #[test]
    fn sets_that_forces_can_spread_are_left_alone() {
        let mesh = squares(20);
        for count in [1, 50, 400, 5000, 40_000] {
            assert_eq!(spread_of(&mesh, &uniform(&mesh, count), 0.0), None, "{count}");
        }
        assert_eq!(spread_of(&mesh, &clustered(&mesh, 50, 1.0), 0.0), None);
    }

    #[test]
    fn none_are_placed_closer_than_the_floor() {
        let mesh = squares(20);
        let places = clustered(&mesh, 1500, 1.0);
        let spacing = (2.0 * mesh.area() / (3f64.sqrt() * 1500.0)).sqrt();
        let floor = 0.5 * spacing;
        let placed = spread_of(&mesh, &places, floor).unwrap();
        let positions: Vec<_> = placed.iter().map(|place| place.position(&mesh)).collect();
        for i in 0..positions.len() {
            assert!((0..i).all(|j| positions[i].distance(positions[j]) >= floor));
        }
        // Three sheets within the floor have space for a third of the samples.
        let sheet = squares(4);
        let positions =
            (0..3).flat_map(|k| sheet.positions().iter().map(move |&[x, y, z]| [x, y, z + 1e-3 * k as f32]));
        let count = sheet.positions().len() as u32;
        let triangles = (0..3).flat_map(|k| sheet.triangles().iter().map(move |t| t.map(|corner| corner + k * count)));
        let sheets = Mesh::new(positions.collect(), triangles.collect()).unwrap();
        let spacing = (2.0 * sheets.area() / (3f64.sqrt() * 1500.0)).sqrt();
        assert_eq!(spread_of(&sheets, &clustered(&sheets, 1500, 1.0), 0.59 * spacing), None);
    }

    /// Samples keep their order along the curve.
    #[test]
    fn neighbours_in_the_cluster_are_neighbours_after_it() {
        let mesh = squares(20);
        let places = clustered(&mesh, 4000, 1.0);
        let placed = spread_of(&mesh, &places, 0.0).unwrap();
        let order = |places: &[SurfacePoint]| along_curve(&mesh, places).iter().map(|&(_, i)| i).collect::<Vec<_>>();
        assert_eq!(order(&places), order(&placed));
    }
}
