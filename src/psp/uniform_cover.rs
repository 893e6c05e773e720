//! What samples of one radius cover.
//!
//! A sixteenth of a fragment is covered if its three corners are nearer to one sample than the radius: then all of it is
//! inside one ball. This is asked in `f32`, in the vectors of the processor (`stack.rs`); its slack only delays a decision.

use glam::{DVec3, Vec3};

use crate::mesh::exact;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::patches::CoverTest;
use crate::psp::rain::Target;
use crate::psp::samples::Sample;
use crate::psp::stack::{FAR, LANES, LocalFragment, PointLanes, PointStack, SLACK};
use crate::psp::surroundings::Surroundings;
use crate::psp::vectors;
use crate::simd::Level;

/// How far around a fragment samples are gathered, in radii, even if it needs less: its neighbours will need them too.
const REACH: f32 = 2.5;

/// How long, in radii, the sixteenths of a partly covered patch are, whose sixteenths in turn it tells apart.
const FINE: f64 = 0.25;

/// The samples in and around a cube, and those that are added to them.
pub(super) struct UniformCover<'a> {
    surroundings: &'a mut Surroundings,
    vectors: Level,
    /// The places of the samples added, and how many.
    added: Vec<PointLanes>,
    count: usize,
    /// Where samples were gathered, how far around, in radii, and how many were added before.
    centre: [f32; 3],
    reach: f32,
    gathered: usize,
    /// As seen from the centre.
    stack: PointStack,
}

impl<'a> UniformCover<'a> {
    pub fn new(surroundings: &'a mut Surroundings) -> Self {
        let (vectors, stack) = (Level::widest(), PointStack::new());
        let (centre, reach) = ([0.0; 3], f32::NEG_INFINITY);
        Self { surroundings, vectors, added: Vec::new(), count: 0, centre, reach, gathered: 0, stack }
    }

    /// Where a fragment lies as seen from a place.
    fn local(&self, shape: &Shape, from: [f32; 3]) -> LocalFragment {
        let per_radius = 1.0 / self.surroundings.radius();
        let in_radii = |vector: DVec3| (vector * per_radius).as_vec3a();
        let [a, b, c] = shape.corners;
        LocalFragment {
            corner: in_radii(a - self.surroundings.at(from)),
            edges: [in_radii(b - a), in_radii(c - a)],
            extent: (shape.extent * per_radius) as f32,
        }
    }
}

impl CoverTest for UniformCover<'_> {
    type Part = LocalFragment;
    type Radius = ();

    fn radius_on(&mut self, _: &Fragment, _: &Shape) {}

    fn locate(&mut self, _: &Fragment, shape: &Shape, (): ()) -> LocalFragment {
        let extent = (shape.extent / self.surroundings.radius()) as f32;
        let place = self.surroundings.place(shape.centre);
        let apart = Vec3::from_array(place).distance(Vec3::from_array(self.centre));
        if self.reach < 1.0 + extent + apart + SLACK {
            (self.centre, self.reach) = (place, (1.0 + extent).max(REACH));
            (self.stack.len, self.gathered) = (0, self.count);
            self.surroundings.gather(place, self.reach, &mut self.stack);
        }
        self.local(shape, self.centre)
    }

    fn locate_among_added(&mut self, _: &Fragment, shape: &Shape, (): (), known: usize) -> LocalFragment {
        let centre = self.surroundings.place(shape.centre);
        let local = self.local(shape, centre);
        let reach = 1.0 + local.extent;
        for lanes in &self.added[known / LANES..] {
            self.stack.reserve(LANES);
            vectors::append(self.vectors, &mut self.stack, lanes, centre, reach * reach + SLACK);
        }
        local
    }

    fn sixteenth(&mut self, part: &LocalFragment, index: usize) -> LocalFragment {
        part.sixteenth(index)
    }

    fn open_sixteenths(&mut self, part: &LocalFragment, from: usize) -> u16 {
        let (start, (centre, reach2)) = (self.stack.len, part.reach());
        self.stack.reserve(start - from);
        vectors::append_reaching(self.vectors, &mut self.stack, from, start, centre, reach2);
        !vectors::covered(self.vectors, &self.stack, start, part)
    }

    fn take_covered(&mut self, part: &LocalFragment, from: usize, open: &mut [u16; 16]) {
        vectors::take_covered(self.vectors, &self.stack, from, part, open);
    }

    fn radius(&self, _: &LocalFragment) {}

    fn is_fine(&self, longest: f64, (): ()) -> bool {
        longest <= 4.0 * FINE * self.surroundings.radius()
    }

    fn added(&self) -> usize {
        self.count
    }

    fn gathered(&self) -> usize {
        self.gathered
    }

    fn height(&self) -> usize {
        self.stack.len
    }

    fn truncate(&mut self, height: usize) {
        self.stack.len = height;
    }
}

impl Target for UniformCover<'_> {
    type Dart = Sample;

    fn density(&self, (): ()) -> f64 {
        1.0
    }

    fn dart(&self, sample: Sample, (): ()) -> Sample {
        sample
    }

    fn add(&mut self, sample: &Sample) -> bool {
        if self.surroundings.rejects(sample.position) {
            return false;
        }
        self.surroundings.add(sample.position);
        let place = self.surroundings.place(exact(sample.position));
        let lane = self.count % LANES;
        if lane == 0 {
            self.added.push([[FAR; LANES]; 3]);
        }
        (0..3).for_each(|axis| self.added[self.count / LANES][axis][lane] = place[axis]);
        self.count += 1;
        true
    }

    fn is_futile(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::psp::cubes::Cube;
    use crate::psp::patches::{OpenPatch, PatchSearch};
    use crate::rng::{Draw, Rng};

    /// Against exact distances to the corners of every sixteenth: what is covered by no single sample is kept, and what
    /// one covers is dropped. The sixteenths together are the fragment. Both for a search and for an update.
    #[test]
    fn only_covered_sixteenths_are_dropped_and_all_that_are_well_covered() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let (mut kept, mut dropped) = (0, 0);
        for round in 0..3000 {
            let size = [1.0, 0.1, 1e-3][round % 3];
            let mut corner = || std::array::from_fn(|_| (8.0 + size * rng.unit()) as f32);
            let mesh = Mesh::new(vec![corner(), corner(), corner()], vec![[0, 1, 2]]).unwrap();
            let mut surroundings = Surroundings::new(Cube([0; 3]), [0.0; 3], 1.0);
            let whole = Fragment::whole(0);
            let shape = whole.shape(&mesh);
            let test = UniformCover::new(&mut surroundings);
            let mut search = PatchSearch { mesh: &mesh, test, finest: 0.0 };
            let mut samples = Vec::new();
            for _ in 0..6 {
                let position = std::array::from_fn(|_| (8.0 - 1.2 + 2.4 * rng.unit()) as f32);
                if search.test.add(&Sample { position, triangle: 0, barycentrics: [0.0; 2] }) {
                    samples.push(exact(position));
                }
            }
            let open = if round % 2 == 0 {
                let part = search.test.locate(&whole, &shape, ());
                search.test.open_sixteenths(&part, 0)
            } else {
                let mut patch = OpenPatch::unseen(whole, shape.longest, ());
                search.update(&mut patch);
                (0..16).fold(0, |open, index| open | u16::from(patch.open[index] != 0) << index)
            };
            for index in 0..16 {
                let part = whole.sixteenth(index).shape(&mesh);
                assert!((16.0 * whole.sixteenth(index).area(&mesh) / mesh.area() - 1.0).abs() < 1e-9);
                let farthest =
                    |sample: &DVec3| part.corners.map(|c| c.distance(*sample)).into_iter().fold(0.0, f64::max);
                let is_covered = samples.iter().any(|sample| farthest(sample) < 1.0);
                let well = samples.iter().any(|sample| farthest(sample) < 1.0 - 3.0 * f64::from(SLACK));
                let is_open = open >> index & 1 == 1;
                // One that is looked at in sixteen parts can be covered by several samples.
                assert!(is_open || is_covered || round % 2 == 1);
                assert!(!(is_open && well));
                kept += u32::from(is_open);
                dropped += u32::from(!is_open);
            }
        }
        assert!(kept > 5000 && dropped > 5000, "{kept} {dropped}");
    }
}
