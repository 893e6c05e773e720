//! Darts into uncovered patches, until none is left: what makes a set maximal.
//!
//! A dart into each uncovered patch, a new look at the patch, and so on, as in the flat quadtree of Ebeida et al. 2012
//! ("A simple algorithm for maximal Poisson-disk sampling in high dimensions") with patches of triangles for squares.
//!
//! *Order of the darts.* There are no rounds: darts rain on the surface. Where `rate` darts are expected on a patch in a unit
//! of time, the next one comes after a waiting time Exp(1) / rate, and darts are thrown in the order in which they arrive.
//! So the accepted ones are distributed as if all of the surface had been rained on, however it is cut. A patch of which
//! other samples have covered something since waits anew, for what is left of it; one that is still as it was is cut up.
//!
//! *The end.* Floats cannot tell points apart that are closer than the float spacing at the mesh's largest coordinate.
//! The darts of patches no longer than that go to their centre. If it is rejected the patch is covered up to
//! rounding: that of the position (0.9 spacings), of the barycentrics (below 4.4, on a triangle that spans a mesh around
//! the origin) and the size of the patch (0.7). So no point of the surface is farther from all samples than the
//! radius and [`TOLERANCE`](crate::psp::TOLERANCE) float spacings.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::mesh::{Mesh, round_barycentrics};
use crate::psp::fragment::Fragment;
use crate::psp::patches::{CoverTest, OpenPatch, PatchSearch};
use crate::psp::samples::Sample;
use crate::rng::Rng;

/// How a cube's surface takes the darts that fall on it.
pub(super) trait Target: CoverTest {
    /// A sample and its radius.
    type Dart;

    /// How many darts fall on a unit of area in a unit of time, given the radius on a patch.
    fn density(&self, radius: Self::Radius) -> f64;

    /// The dart at a point of a patch.
    fn dart(&self, sample: Sample, radius: Self::Radius) -> Self::Dart;

    /// Adds a dart, unless it conflicts with another sample.
    fn add(&mut self, dart: &Self::Dart) -> bool;

    /// Whether the rest of the work is in vain.
    fn is_futile(&self) -> bool;
}

/// What a rain leaves.
pub(super) struct Rained<D> {
    /// The accepted darts, in their order.
    pub accepted: Vec<D>,
    /// How many were thrown.
    pub darts: u64,
}

/// Rains on patches until all is covered.
pub(super) fn rain<T: Target>(
    mut search: PatchSearch<T>,
    mut patches: Vec<OpenPatch<T::Radius>>,
    rng: Rng,
) -> Rained<T::Dart> {
    let mut arrivals = Arrivals { mesh: search.mesh, rng, darts: BinaryHeap::new() };
    patches.iter().enumerate().for_each(|(number, patch)| arrivals.send(0.0, number, patch, &search.test));
    let (mut accepted, mut darts) = (Vec::new(), 0);
    while let Some((time, number)) = arrivals.next().filter(|_| !search.test.is_futile()) {
        let before = patches[number];
        let [part, of_part] = arrivals.open_part(&before);
        let patch = &mut patches[number];
        search.update(patch);
        let is_last = patch.longest <= search.finest;
        let dart = if is_last && patch.open_parts() > 0 {
            let centre = arrivals.sample(&patch.fragment, [1.0 / 3.0; 2]);
            Some(search.test.dart(centre, patch.radius))
        } else if patch.open[part] >> of_part & 1 == 1 {
            let point = arrivals.point(&patch.fragment.sixteenth(part).sixteenth(of_part));
            Some(search.test.dart(point, patch.radius))
        } else {
            None
        };
        darts += u64::from(dart.is_some());
        if let Some(dart) = dart.filter(|dart| search.test.add(dart)) {
            accepted.push(dart);
            search.update(patch);
        }
        if is_last || patch.open_parts() == 0 {
            continue;
        }
        if patch.open != before.open {
            arrivals.send(time, number, patch, &search.test);
        } else {
            let first = patches.len();
            search.refine(&before, &mut patches);
            (first..patches.len()).for_each(|number| arrivals.send(time, number, &patches[number], &search.test));
        }
    }
    Rained { accepted, darts }
}

/// Darts that will fall on the patches of a cube, in the order in which they arrive.
struct Arrivals<'a> {
    mesh: &'a Mesh,
    rng: Rng,
    /// When the next dart arrives (the bits of floats that are not negative are in the order of the floats), and where.
    darts: BinaryHeap<Reverse<(u64, usize)>>,
}

impl Arrivals<'_> {
    /// Sends the next dart to a patch that has been waiting since `time`.
    fn send<T: Target>(&mut self, time: f64, number: usize, patch: &OpenPatch<T::Radius>, target: &T) {
        let rate = patch.open_area(self.mesh) * target.density(patch.radius);
        let arrival = time - (1.0 - self.rng.unit()).ln() / rate;
        self.darts.push(Reverse((arrival.to_bits(), number)));
    }

    /// The next dart to arrive: when, and at which patch.
    fn next(&mut self) -> Option<(f64, usize)> {
        self.darts.pop().map(|Reverse((arrival, number))| (f64::from_bits(arrival), number))
    }

    /// One of the open parts of a patch: a sixteenth, and a sixteenth of it.
    fn open_part<R>(&mut self, patch: &OpenPatch<R>) -> [usize; 2] {
        let mut skipped = self.rng.below(patch.open_parts().into()) as u32;
        let mut part = 0;
        while skipped >= patch.open[part].count_ones() {
            skipped -= patch.open[part].count_ones();
            part += 1;
        }
        let rest = (0..skipped).fold(patch.open[part], |open, _| open & (open - 1));
        [part, rest.trailing_zeros() as usize]
    }

    /// A point of a fragment.
    fn point(&mut self, fragment: &Fragment) -> Sample {
        let [mut s, mut t] = [self.rng.unit(), self.rng.unit()];
        if s + t > 1.0 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        self.sample(fragment, [s, t])
    }

    fn sample(&self, fragment: &Fragment, place: [f64; 2]) -> Sample {
        Sample::new(self.mesh, fragment.triangle, round_barycentrics(fragment.at(place)))
    }
}
