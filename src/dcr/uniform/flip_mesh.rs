//! The Delaunay triangulation of a torus, kept while its points move and repaired by flips (`torus::must_flip`), in
//! rings.
//!
//! The forces hold points back so that no triangle turns over; if one does nevertheless, the mesh reports it and must
//! be rebuilt. The edges that may have to be flipped are found while points gather, so that flips need no pass over the
//! whole mesh: see [`FlipMesh::mend`].

use std::ops::Range;

use crate::dcr::law::Constraints;
use crate::dcr::torus::{Torus, TorusPoint, must_flip};
use crate::dcr::uniform::cover::{Cover, insert};
use crate::dcr::uniform::rings::{Edge, Patch, RingList, Rings, triangulate_by_tiles};
use crate::dcr::uniform::stars::{Gathered, Stars, Visitor};
use crate::error::Result;
use crate::geometry::{Delaunay, circumradius_squared};
use crate::job::{Job, chunks};
use crate::simd::Level;

/// The number of consecutive points that form a patch. Flips in different patches are made in parallel.
const PATCH: usize = 4096;

/// The largest number of points, not counting images, that are triangulated on a cover: more rarely need it.
const FEW: usize = 64;

/// The largest number of flips for each point of a patch. No set needs as many, unless rounding makes them go on.
const FLIPS: usize = 1000;

/// A triangulation of a torus, all of whose edges are short: on the torus itself, or for a few points on its cover until
/// their edges are short on the torus.
pub struct FlipMesh {
    /// The torus that is triangulated.
    torus: Torus,
    rings: Rings,
    cover: Option<Cover>,
}

/// The result of flipping the edges of a patch.
struct Mended {
    /// Edges that may have to be flipped, with points of other patches.
    left: Vec<Edge>,
    is_sound: bool,
}

/// The result of a pass over all points that moves none.
#[derive(Default)]
struct Inspection {
    suspects: Vec<Edge>,
    is_unsound: bool,
    violated: usize,
}

impl Visitor for Inspection {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, gathered: &Gathered) {
        self.is_unsound |= !gathered.are_sound(points.len());
        self.violated += gathered.violated(points.len()).count();
        gathered.suspects(rings, points, &mut self.suspects);
    }
}

impl FlipMesh {
    /// The Delaunay triangulation of points. None in sets with large holes, unless they have only a few points, or with
    /// points that have too many neighbours, or if copies are not triangulated alike, which happens to four points on
    /// one circle unless they are nudged.
    pub fn new(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Result<Option<Self>> {
        if is_few(torus, places) {
            return Self::of_few(job, torus, places);
        }
        match triangulate_by_tiles(&job.part(0.0, 0.8), torus, places)? {
            Some(stars) => Self::of_stars(&job.part(0.8, 1.0), torus, places, &stars),
            None => {
                let delaunay = Delaunay::new(&job.part(0.0, 0.8), &torus.frame, torus.nudged(places).into_iter())?;
                Self::of_delaunay(&job.part(0.8, 1.0), torus, places, &delaunay)
            }
        }
    }

    /// The mesh of a few points, made point by point; none of more points, and if points coincide on the cover.
    pub fn of_few(job: &Job, torus: &Torus, places: &[TorusPoint]) -> Result<Option<Self>> {
        if !is_few(torus, places) {
            return Ok(None);
        }
        let cover = Cover::new(torus, places);
        let (torus, nudged) = (cover.torus(), cover.nudged());
        let mut rings = Rings::of_first(places.len());
        let Some(mut whole) = rings.patches(places.len().max(1)).next() else { return Ok(None) };
        for point in 1..places.len() as u32 {
            let edges = insert(&mut whole, &nudged, point);
            if !edges.is_some_and(|edges| mend(&mut whole, &torus, &nudged, edges).is_sound) {
                return Ok(None);
            }
        }
        let mut mesh = Self { torus, rings, cover: Some(cover) };
        Ok(mesh.repair(job, places)?.then_some(mesh))
    }

    /// The mesh of a triangulation of the torus and its copies.
    pub fn of_delaunay(job: &Job, torus: &Torus, places: &[TorusPoint], delaunay: &Delaunay) -> Result<Option<Self>> {
        let mut stars = RingList::default();
        for point in 0..places.len() {
            stars.neighbours.extend(delaunay.neighbours(point));
            stars.points.push((point as u32, stars.neighbours.len()));
        }
        Self::of_stars(job, torus, places, &[stars])
    }

    /// The mesh of rings, if they are those of a triangulation of the torus.
    fn of_stars(job: &Job, torus: &Torus, places: &[TorusPoint], stars: &[RingList]) -> Result<Option<Self>> {
        let Some(rings) = Rings::new(places.len(), stars) else { return Ok(None) };
        let mut mesh = Self { torus: *torus, rings, cover: None };
        let chunks = chunks(places.len());
        let agree =
            job.part(0.0, 0.5).map(chunks.len(), |chunk| chunks.range(chunk).all(|point| mesh.rings.agree(point)))?;
        // Triangles that agree form a surface without boundary; with three edges per point it is a torus.
        let is_torus = agree.into_iter().all(|agree| agree) && mesh.rings.edges() == 3 * places.len();
        Ok((is_torus && mesh.repair(&job.part(0.5, 1.0), places)?).then_some(mesh))
    }

    /// True if the mesh must hold points back so that no triangle turns over, as it could not be built anew. A few points
    /// are free: on a torus that is no wider than a hole they jam if they are held back.
    pub fn holds_back(&self) -> bool {
        self.cover.is_none()
    }

    /// The neighbours of a point in a mesh that holds points back, counter-clockwise.
    pub fn ring(&self, point: usize) -> &[u32] {
        self.rings.ring(point)
    }

    /// The positions in the mesh of points at these places, with which it was made or last mended.
    fn places<'a>(&'a self, places: &'a [TorusPoint]) -> &'a [TorusPoint] {
        self.cover.as_ref().map_or(places, |cover| &cover.places)
    }

    /// Gathers for a range of points and passes the results to `visitor`; the points are where they were when the mesh
    /// was made or last mended.
    pub fn gather(
        &self,
        level: Level,
        places: &[TorusPoint],
        constraints: &Constraints,
        points: Range<usize>,
        visitor: &mut impl Visitor,
    ) {
        let stars = Stars { rings: &self.rings, torus: &self.torus, places: self.places(places), constraints };
        stars.gather(level, points, visitor);
    }

    /// Makes the mesh the Delaunay triangulation of these points; false if a triangle has turned over.
    pub fn repair(&mut self, job: &Job, places: &[TorusPoint]) -> Result<bool> {
        self.follow(places);
        let found = self.inspect(&job.part(0.0, 0.5), places, places.len())?;
        Ok(!found.is_unsound && self.mend(&job.part(0.5, 1.0), places, found.suspects)?)
    }

    /// Moves the points of the cover to where the points are.
    fn follow(&mut self, places: &[TorusPoint]) {
        self.cover.iter_mut().for_each(|cover| cover.follow(places));
    }

    /// Proceeds from the cover to the torus itself if all edges are short there.
    fn leave_cover(&mut self) {
        if let Some(cover) = &self.cover
            && let Some(rings) = cover.rings_on_torus(&self.rings)
        {
            *self = Self { torus: *cover.base(), rings, cover: None };
        }
    }

    /// The number of points, of the first `count`, whose constraints are violated.
    pub fn violated(&self, job: &Job, places: &[TorusPoint], count: usize) -> Result<usize> {
        Ok(self.inspect(job, places, count)?.violated)
    }

    /// Inspects the first `count` points.
    fn inspect(&self, job: &Job, places: &[TorusPoint], count: usize) -> Result<Inspection> {
        let chunks = chunks(count);
        let level = Level::widest();
        let still = Constraints { conflict_radius: 0.0, coverage_radius: f32::INFINITY, push: 0.0, pull: 0.0 };
        let parts = job.map(chunks.len(), |chunk| {
            let mut found = Inspection::default();
            self.gather(level, places, &still, chunks.range(chunk), &mut found);
            found
        })?;
        let mut all = Inspection::default();
        for part in parts {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.violated += part.violated;
        }
        Ok(all)
    }

    /// Flips edges that must be flipped, and those around them, until all are locally Delaunay; false if one could not
    /// be flipped.
    ///
    /// `suspects` are the edges suspect before the points moved, ordered by the points at which they start. An edge
    /// that was not suspect then but must be flipped now is left for the next step.
    pub fn mend(&mut self, job: &Job, places: &[TorusPoint], suspects: Vec<Edge>) -> Result<bool> {
        self.follow(places);
        let is_sound = self.flip(job, places, suspects)?;
        if is_sound {
            self.leave_cover();
        }
        Ok(is_sound)
    }

    /// [`FlipMesh::mend`], after the points of the cover have been moved.
    fn flip(&mut self, job: &Job, places: &[TorusPoint], suspects: Vec<Edge>) -> Result<bool> {
        let torus = self.torus;
        let places = self.cover.as_ref().map_or(places, |cover| &cover.places);
        let mut rest = suspects.as_slice();
        let tasks = self.rings.patches(PATCH).map(|patch| {
            let count = rest.partition_point(|&[from, _]| (from as usize) < patch.end());
            let (own, others) = rest.split_at(count);
            rest = others;
            (patch, own.to_vec())
        });
        let tasks: Vec<_> = tasks.collect();
        let mended =
            job.part(0.0, 0.7).map_each(tasks, |(mut patch, edges)| mend(&mut patch, &torus, places, edges))?;
        let mut is_sound = mended.iter().all(|mended| mended.is_sound);
        let left = mended.into_iter().flat_map(|mended| mended.left).collect();
        let whole = self.rings.patches(places.len()).next();
        if let Some(mut whole) = whole {
            is_sound &= mend(&mut whole, &torus, places, left).is_sound;
        }
        Ok(is_sound)
    }

    /// The largest circumradius.
    pub fn covering_radius(&self, job: &Job, places: &[TorusPoint]) -> Result<f64> {
        let (chunks, copies, places) = (chunks(self.rings.len()), self.rings.copies(), self.places(places));
        let largest = job.map(chunks.len(), |chunk| {
            let squared = |point: usize| {
                let ring = self.rings.ring(point);
                let offset = |other: u32| self.torus.offset(places[point], copies.place(places, other));
                let triangle = |(&q, &r): (&u32, &u32)| {
                    let (a, b) = (offset(q), offset(r));
                    circumradius_squared(a, b, a - b)
                };
                ring.iter().zip(ring.iter().cycle().skip(1)).map(triangle).fold(0.0, f64::max)
            };
            chunks.range(chunk).map(squared).fold(0.0, f64::max)
        })?;
        Ok(largest.into_iter().fold(0.0, f64::max).sqrt())
    }
}

/// True if a set, given with its images, has only a few points.
fn is_few(torus: &Torus, places: &[TorusPoint]) -> bool {
    places.len() <= FEW * torus.copies()
}

/// Flips the edges that must be flipped, and those around them, if their points are in the patch.
fn mend(patch: &mut Patch, torus: &Torus, places: &[TorusPoint], mut edges: Vec<Edge>) -> Mended {
    let (mut left, mut flips, copies) = (Vec::new(), FLIPS * patch.len(), patch.copies());
    while let Some(edge) = edges.pop() {
        let [p, q] = edge;
        if !patch.holds(p) {
            left.push(edge);
            continue;
        }
        let Some([r, s]) = patch.apices(edge) else { continue };
        if !must_flip(torus, [p, q, r, s].map(|name| copies.place(places, name))) {
            continue;
        }
        if ![q, r, s].into_iter().all(|point| patch.holds(point)) {
            left.push(edge);
            continue;
        }
        flips -= 1;
        if flips == 0 || patch.flip(edge, [r, s]).is_err() {
            return Mended { left, is_sound: false };
        }
        edges.extend([[p, r], [r, q], [q, s], [s, p]]);
    }
    Mended { left, is_sound: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    use glam::Vec2;

    use crate::dcr::law::Force;
    use crate::dcr::torus::random_sets::{self, random_places, with_and_without_mesh};
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// The triangulation by spade of all points at once.
    fn anew(job: &Job, torus: &Torus, places: &[TorusPoint]) -> (FlipMesh, f64) {
        let delaunay = Delaunay::new(job, &torus.frame, torus.nudged(places).into_iter()).unwrap();
        let mesh = FlipMesh::of_delaunay(job, torus, places, &delaunay).unwrap().expect("there is a mesh");
        (mesh, delaunay.covering_radius())
    }

    /// The rings, each from its least neighbour on.
    fn rings(mesh: &FlipMesh) -> Vec<Vec<u32>> {
        let turned = |point: usize| {
            let mut ring = mesh.rings.ring(point).to_vec();
            let least = (0..ring.len()).min_by_key(|&k| ring[k]).unwrap();
            ring.rotate_left(least);
            ring
        };
        (0..mesh.rings.len()).map(turned).collect()
    }

    fn offsets(mesh: &FlipMesh, places: &[TorusPoint], point: usize) -> Vec<Vec2> {
        let (places, copies) = (mesh.places(places), mesh.rings.copies());
        let offset = |&other: &u32| mesh.torus.offset_f32(places[point], copies.place(places, other));
        mesh.rings.ring(point).iter().map(offset).collect()
    }

    /// Points wander; after every repair the mesh is a torus, locally Delaunay, and the one that spade builds from
    /// scratch.
    #[test]
    fn repaired_meshes_are_those_that_are_built_anew() {
        let context = Context::new(1).unwrap();
        for (boundary, width, count) in
            [(Boundary::Periodic, 1.0, 600), (Boundary::Periodic, 3.0, 9000), (Boundary::Bounded, 1.5, 300)]
        {
            let (torus, mut places) = random_places(boundary, width, count);
            let mut rng = Rng::at(4, Draw::Probe, &[]);
            context
                .run(None, |job| {
                    let (mut mesh, _) = anew(job, &torus, &places);
                    let mut flipped = 0;
                    for _ in 0..25 {
                        wander(&mesh, &mut places, count, &mut rng);
                        let before = rings(&mesh);
                        assert!(mesh.repair(job, &places)?, "a triangle turned over");
                        flipped += usize::from(before != rings(&mesh));
                        assert!((0..places.len()).all(|point| mesh.rings.agree(point)));
                        assert!(is_delaunay(&mut mesh, &places));
                        let (built, coverage) = anew(job, &torus, &places);
                        // The corners of a mirrored rectangle lie on one circle: there spade may take the other
                        // diagonal.
                        if boundary == Boundary::Periodic {
                            assert!(rings(&mesh) == rings(&built));
                        }
                        assert!((mesh.covering_radius(job, &places)? - coverage).abs() < 1e-5);
                    }
                    assert!(flipped > 10);
                    Ok(())
                })
                .unwrap();
        }
    }

    /// Moves the points as far as their triangles allow, and their images with them.
    fn wander(mesh: &FlipMesh, places: &mut Vec<TorusPoint>, count: usize, rng: &mut Rng) {
        let before = places.clone();
        random_sets::wander(&mesh.torus, places, count, |point| offsets(mesh, &before, point), rng);
    }

    fn is_delaunay(mesh: &mut FlipMesh, places: &[TorusPoint]) -> bool {
        let edges: Vec<Edge> = (0..places.len())
            .flat_map(|point| mesh.rings.ring(point).iter().map(move |&other| [point as u32, other]))
            .collect();
        let (torus, copies, places) = (mesh.torus, mesh.rings.copies(), mesh.places(places).to_vec());
        let whole = mesh.rings.patches(places.len()).next().unwrap();
        edges.into_iter().all(|[p, q]| {
            let [r, s] = whole.apices([p, q]).unwrap();
            !must_flip(&torus, [p, q, r, s].map(|name| copies.place(&places, name)))
        })
    }

    /// As above for a few points, which are on the cover until their edges are short enough. Of four points on one
    /// circle, as mirror images and the copies of one point are, spade may take the other diagonal.
    #[test]
    fn meshes_of_a_few_points_are_those_of_all_copies() {
        let context = Context::new(1).unwrap();
        let (periodic, bounded) = (Boundary::Periodic, Boundary::Bounded);
        let (mut on_cover, mut on_torus, mut flipped) = (0, 0, 0);
        let widths = [(1.0, 1), (1.0, 2), (1.0, 3), (1.0, 5), (1.0, 16), (8.0, 12), (40.0, 7), (0.03, 20), (1.0, 64)];
        for (boundary, (width, count)) in [periodic, bounded].into_iter().flat_map(|b| widths.map(|set| (b, set))) {
            let (torus, mut places) = random_places(boundary, width, count);
            let mut rng = Rng::at(6, Draw::Probe, &[count as u64]);
            context
                .run(None, |job| {
                    let mut mesh = FlipMesh::new(job, &torus, &places)?.expect("there is a mesh");
                    for _ in 0..40 {
                        wander(&mesh, &mut places, count, &mut rng);
                        let before = rings(&mesh);
                        if !mesh.repair(job, &places)? {
                            // The torus itself is too small for its longest edges.
                            assert!(mesh.cover.is_none(), "a triangle turned over");
                            mesh = FlipMesh::new(job, &torus, &places)?.expect("there is a mesh");
                        }
                        flipped += usize::from(before != rings(&mesh));
                        *(if mesh.cover.is_some() { &mut on_cover } else { &mut on_torus }) += 1;
                        assert!((0..places.len()).all(|point| mesh.rings.agree(point)));
                        assert_eq!(mesh.rings.edges(), 3 * places.len());
                        assert!(is_delaunay(&mut mesh, &places));
                        let built = Delaunay::new(job, &torus.frame, torus.nudged(&places).into_iter())?;
                        let (radius, expected) = (mesh.covering_radius(job, &places)?, built.covering_radius());
                        assert!((radius - expected).abs() < 1e-5 * expected, "{radius}, not {expected}");
                        if boundary == Boundary::Bounded || count == 1 {
                            continue;
                        }
                        for point in 0..count {
                            let (offsets, built) = (offsets(&mesh, &places, point), built.ring(point));
                            let built: Vec<Vec2> = built.map(|offset| offset.as_vec2()).collect();
                            let is_one = |offset: &Vec2| built.iter().any(|other| other.distance(*offset) < 1e-4);
                            assert!(offsets.len() == built.len() && offsets.iter().all(is_one), "{count} {width}");
                        }
                    }
                    Ok(())
                })
                .unwrap();
        }
        assert!(on_cover > 300 && on_torus > 4 && flipped > 100, "{on_cover} {on_torus} {flipped}");
    }

    /// Tile by tile, and with flips patch by patch, meshes are the same as those of all points at once, for any number
    /// of threads.
    #[test]
    fn meshes_are_the_same_by_tiles_and_by_threads() {
        let (torus, mut places) = random_places(Boundary::Periodic, 1.0, 50_000);
        let (one, four) = (Context::new(1).unwrap(), Context::new(4).unwrap());
        let mut whole = one.run(None, |job| Ok(anew(job, &torus, &places).0)).unwrap();
        assert!(one.run(None, |job| triangulate_by_tiles(job, &torus, &places)).unwrap().is_some());
        let build = |context: &Context| context.run(None, |job| FlipMesh::new(job, &torus, &places)).unwrap().unwrap();
        let (mut alone, mut together) = (build(&one), build(&four));
        assert!(rings(&alone) == rings(&whole) && rings(&together) == rings(&whole));
        wander(&whole, &mut places, 50_000, &mut Rng::at(5, Draw::Probe, &[]));
        let before = rings(&whole);
        for (mesh, context) in [(&mut whole, &one), (&mut alone, &one), (&mut together, &four)] {
            assert!(context.run(None, |job| mesh.repair(job, &places)).unwrap());
        }
        assert!(before != rings(&whole) && mesh_slots(&alone) == mesh_slots(&together));
    }

    /// The slots unchanged: the threads must not even rotate a ring.
    fn mesh_slots(mesh: &FlipMesh) -> Vec<Vec<u32>> {
        (0..mesh.rings.len()).map(|point| mesh.rings.ring(point).to_vec()).collect()
    }

    /// Records the results of gathers.
    #[derive(Default)]
    struct Record {
        forces: Vec<(Vec2, f32)>,
        violated: Vec<usize>,
        is_unsound: bool,
    }

    impl Visitor for Record {
        fn visit(&mut self, _: &Rings, points: Range<usize>, gathered: &Gathered) {
            let force =
                |lane: usize| (Vec2::new(gathered.force[0][lane], gathered.force[1][lane]), gathered.clearance[lane]);
            self.forces.extend((0..points.len()).map(force));
            self.violated.extend(gathered.violated(points.len()).map(|lane| points.start + lane));
            self.is_unsound |= !gathered.are_sound(points.len());
        }
    }

    /// Eight points at a time gather to the bit what each gathers alone, at any level of vectors.
    #[test]
    fn vectors_change_nothing() {
        let context = Context::new(1).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let (torus, places) = random_places(boundary, 1.0, 1003);
            let mesh = context.run(None, |job| Ok(anew(job, &torus, &places).0)).unwrap();
            let constraints = Constraints { conflict_radius: 0.862, coverage_radius: 0.66, push: 0.4, pull: 0.2 };
            for level in Level::available() {
                let mut record = Record::default();
                mesh.gather(level, &places, &constraints, 0..places.len(), &mut record);
                assert!(!record.is_unsound && record.forces.len() == places.len());
                for (point, &(sum, clearance)) in record.forces.iter().enumerate() {
                    let alone: Force = constraints.force(&offsets(&mesh, &places, point));
                    assert!(
                        (sum, clearance) == (alone.sum, alone.clearance),
                        "{level:?}, {point}: {sum} {}",
                        alone.sum
                    );
                    let violated = is_violated(&mesh, &places, point);
                    assert_eq!(record.violated.contains(&point), violated, "{level:?}, {point}");
                }
            }
        }
    }

    /// True if another point is closer than 0.85, or a triangle wider than 0.67.
    fn is_violated(mesh: &FlipMesh, places: &[TorusPoint], point: usize) -> bool {
        let offsets = offsets(mesh, places, point);
        let own = mesh.torus.image_distances(places[point]);
        let is_own = |offset: &Vec2| offset.to_array() == [own[0], 0.0] || offset.to_array() == [0.0, own[1]];
        let wide = |(a, b): (&Vec2, &Vec2)| a.length() * b.length() * a.distance(*b) / (2.0 * a.perp_dot(*b)) > 0.67;
        let pairs = || offsets.iter().zip(offsets.iter().cycle().skip(1));
        offsets.iter().any(|offset| offset.length() < 0.85 && !is_own(offset)) || pairs().any(wide)
    }

    #[test]
    fn large_holes_have_no_mesh_and_turned_triangles_end_one() {
        let context = Context::new(1).unwrap();
        for (torus, mut places, has_mesh) in with_and_without_mesh().into_iter().skip(1) {
            context
                .run(None, |job| {
                    let mesh = FlipMesh::new(job, &torus, &places)?;
                    assert_eq!(mesh.is_some(), has_mesh);
                    if let Some(mut mesh) = mesh {
                        places.swap(0, 250);
                        assert!(!mesh.repair(job, &places)?);
                    }
                    Ok(())
                })
                .unwrap();
        }
    }

    /// A point with more neighbours than there are slots is in no mesh.
    #[test]
    fn hubs_have_no_mesh() {
        let torus = Torus::new(Domain::unit(Boundary::Periodic), 1000);
        let ring = (0..100).map(|i| glam::DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 100.0) * 0.1 + 0.5);
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let others = (0..400).map(|_| glam::DVec2::new(rng.unit(), rng.unit()));
        let others = others.filter(|point| point.distance(glam::DVec2::splat(0.5)) > 0.11);
        let points = ring.chain(others).chain([glam::DVec2::splat(0.5)]).map(|point| point.as_vec2().to_array());
        let places = torus.enter(&points.collect::<Vec<_>>(), 0);
        let mesh = Context::new(1).unwrap().run(None, |job| FlipMesh::new(job, &torus, &places)).unwrap();
        assert!(mesh.is_none());
    }
}
