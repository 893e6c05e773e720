//! What is still uncovered: the surface in patches, of which each knows the sixteenths that are not proved covered.
//! The thesis has no such search; its loop runs for as many iterations as asked.
//!
//! A fragment of a triangle is cut into four by four congruent ones of its own shape (`sixteenths.rs`). Whether one of them
//! is covered is asked of a [`CoverTest`], of all sixteen at once. The test may err on one side: what it keeps is looked at
//! again in smaller parts, down to the exact test of a single point (`rain.rs`).
//!
//! A patch knows the sixteenths of its sixteenths: large enough to be few, and yet with hardly any area that is covered.

use crate::mesh::Mesh;
use crate::psp::fragment::{Fragment, Shape};

/// Tells what the samples in and around a cube cover.
///
/// A test has a stack of samples: those gathered around a fragment, and behind them, for each fragment that contains the one
/// in question, the samples that can reach it.
pub(super) trait CoverTest {
    /// A fragment as the test sees it.
    type Part: Copy;
    /// What the test knows of the radius on a fragment.
    type Radius: Copy;

    /// The radius on a fragment.
    fn radius_on(&mut self, fragment: &Fragment, shape: &Shape) -> Self::Radius;

    /// The part that a fragment is. The stack then holds the samples that can reach it, and others.
    fn locate(&mut self, fragment: &Fragment, shape: &Shape, radius: Self::Radius) -> Self::Part;

    /// The same, and pushes those samples that can reach it of all but the first `known` that were added.
    fn locate_among_added(
        &mut self,
        fragment: &Fragment,
        shape: &Shape,
        radius: Self::Radius,
        known: usize,
    ) -> Self::Part;

    /// One of the sixteen parts of a part.
    fn sixteenth(&mut self, part: &Self::Part, index: usize) -> Self::Part;

    /// The sixteenths that no single sample in the stack from `from` on certainly covers. Pushes those samples that can reach
    /// the part.
    fn open_sixteenths(&mut self, part: &Self::Part, from: usize) -> u16;

    /// Of the sixteenths of each sixteenth, a bit for each, takes those that a sample in the stack from `from` on certainly
    /// covers.
    fn take_covered(&mut self, part: &Self::Part, from: usize, open: &mut [u16; 16]);

    /// The radius on a part.
    fn radius(&self, part: &Self::Part) -> Self::Radius;

    /// Whether a patch whose longest edge has this length is told apart by the sixteenths of its sixteenths, where it is
    /// partly covered.
    fn is_fine(&self, longest: f64, radius: Self::Radius) -> bool;

    /// How many samples have been added since the test was made.
    fn added(&self) -> usize;

    /// How many of them were known when the stack was gathered.
    fn gathered(&self) -> usize;

    /// The height of the stack.
    fn height(&self) -> usize;

    /// Takes the top of the stack away.
    fn truncate(&mut self, height: usize);
}

/// A fragment that is not covered.
#[derive(Clone, Copy)]
pub(super) struct OpenPatch<R> {
    pub fragment: Fragment,
    /// For each sixteenth, a bit for each sixteenth of it that may be uncovered; at least one.
    pub open: [u16; 16],
    /// The length of the longest edge.
    pub longest: f64,
    /// The radius on it.
    pub radius: R,
    /// How many of the samples added since the search began are accounted for.
    seen: usize,
}

impl<R> OpenPatch<R> {
    /// The number of open sixteenths of sixteenths.
    pub fn open_parts(&self) -> u32 {
        self.open.iter().map(|open| open.count_ones()).sum()
    }

    /// The area that may be uncovered.
    pub fn open_area(&self, mesh: &Mesh) -> f64 {
        self.fragment.area(mesh) * f64::from(self.open_parts()) / 256.0
    }
}

/// A search for uncovered surface in a cube.
pub(super) struct PatchSearch<'a, T> {
    pub mesh: &'a Mesh,
    pub test: T,
    /// Patches no longer than this are cut up no more.
    pub finest: f64,
}

impl<T: CoverTest> PatchSearch<'_, T> {
    /// Appends the uncovered parts of a fragment, in fixed order.
    pub fn search(&mut self, fragment: &Fragment, uncovered: &mut Vec<OpenPatch<T::Radius>>) {
        let shape = fragment.shape(self.mesh);
        let radius = self.test.radius_on(fragment, &shape);
        let part = self.test.locate(fragment, &shape, radius);
        let gathered = self.test.height();
        let open = self.test.open_sixteenths(&part, 0);
        self.keep(fragment, shape.longest, &part, open, gathered, uncovered);
        self.test.truncate(gathered);
    }

    /// Takes from a patch what samples cover that were added since it was looked at.
    pub fn update(&mut self, patch: &mut OpenPatch<T::Radius>) {
        if patch.seen == self.test.added() {
            return;
        }
        let (shape, start) = (patch.fragment.shape(self.mesh), self.test.height());
        let part = self.test.locate_among_added(&patch.fragment, &shape, patch.radius, patch.seen);
        patch.seen = self.test.added();
        if self.test.height() > start {
            self.test.take_covered(&part, start, &mut patch.open);
        }
        self.test.truncate(start);
    }

    /// Appends the parts of a patch that are uncovered when they are looked at more closely.
    pub fn refine(&mut self, patch: &OpenPatch<T::Radius>, uncovered: &mut Vec<OpenPatch<T::Radius>>) {
        let whole = self.test.locate(&patch.fragment, &patch.fragment.shape(self.mesh), patch.radius);
        let gathered = self.test.height();
        for index in (0..16).filter(|&index| patch.open[index] != 0) {
            let (fragment, part) = (patch.fragment.sixteenth(index), self.test.sixteenth(&whole, index));
            self.keep(&fragment, 0.25 * patch.longest, &part, patch.open[index], 0, uncovered);
            self.test.truncate(gathered);
        }
    }

    /// Keeps a fragment as a patch, or in parts. The stack from `from` on holds the samples that can reach it.
    fn keep(
        &mut self,
        fragment: &Fragment,
        longest: f64,
        part: &T::Part,
        open: u16,
        from: usize,
        uncovered: &mut Vec<OpenPatch<T::Radius>>,
    ) {
        let radius = self.test.radius(part);
        let (is_fine, is_finest) = (self.test.is_fine(longest, radius), longest <= self.finest);
        let is_kept = |index: usize| open >> index & 1 == 1 && (is_fine || is_finest || open == u16::MAX);
        let parts = std::array::from_fn(|index| if is_kept(index) { u16::MAX } else { 0 });
        let mut patch = OpenPatch { fragment: *fragment, open: parts, longest, radius, seen: self.test.gathered() };
        if is_fine && !is_finest {
            self.test.take_covered(part, from, &mut patch.open);
        }
        for index in (0..16).filter(|&index| open >> index & 1 == 1 && !is_kept(index)) {
            let (part, start) = (self.test.sixteenth(part, index), self.test.height());
            let open = self.test.open_sixteenths(&part, from);
            if open != 0 {
                self.keep(&fragment.sixteenth(index), 0.25 * longest, &part, open, start, uncovered);
            }
            self.test.truncate(start);
        }
        if patch.open != [0; 16] {
            uncovered.push(patch);
        }
    }
}
