//! What each sample knows of the samples around it, from one search to the next.

use glam::DVec3;

use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::near::{Image, Surroundings, mirrored};
use crate::dcr::surface::view::View;
use crate::simd::{LANES, Lanes, Position};

/// The vectors of samples that are kept in place.
const VECTORS: usize = 2;

/// The samples around one sample.
#[derive(Clone, Default)]
pub(super) struct List {
    /// Samples that are reached on the surface; the sample itself beyond the last.
    reached: [[u32; LANES]; VECTORS],
    count: usize,
    /// What most samples do not have.
    more: Option<Box<More>>,
}

#[derive(Clone, Default)]
struct More {
    /// More samples that are reached on the surface.
    reached: Vec<u32>,
    images: Vec<Image>,
    /// The samples in sight that are not reached.
    others: Vec<u32>,
}

impl List {
    pub(super) fn new(sample: u32, around: Surroundings) -> Self {
        let mut list = Self { reached: [[sample; LANES]; VECTORS], ..Self::default() };
        let (first, rest) = around.reached.split_at(around.reached.len().min(LANES * VECTORS));
        list.reached.as_flattened_mut()[..first.len()].copy_from_slice(first);
        list.count = first.len();
        if !(rest.is_empty() && around.images.is_empty() && around.others.is_empty()) {
            let (images, others) = (around.images, around.others);
            list.more = Some(Box::new(More { reached: rest.to_vec(), images, others }));
        }
        list
    }

    /// The samples that are reached on the surface.
    pub(super) fn reached(&self) -> impl Iterator<Item = u32> + '_ {
        let more = self.more.iter().flat_map(|more| &more.reached);
        self.reached.as_flattened()[..self.count].iter().chain(more).copied()
    }

    /// The sample of a candidate that a view was shown; none for an image.
    pub(super) fn sample(&self, candidate: usize) -> Option<u32> {
        self.reached().nth(candidate)
    }

    /// The samples in sight that are not.
    pub(super) fn others(&self) -> &[u32] {
        self.more.as_ref().map_or(&[], |more| &more.others)
    }

    /// The images of samples by the boundary.
    pub(super) fn images(&self) -> &[Image] {
        self.more.as_ref().map_or(&[], |more| &more.images)
    }

    /// Whether a sample is reached on the surface.
    pub(super) fn has(&self, sample: u32) -> bool {
        // Beyond the last is the sample itself, which nobody asks for.
        self.reached.as_flattened().contains(&sample)
            || self.more.as_ref().is_some_and(|more| more.reached.contains(&sample))
    }

    /// Adds a sample that is reached, if there is room and the list has nothing that must be found anew with it.
    pub(super) fn add(&mut self, sample: u32) -> bool {
        let is_simple = self.more.is_none() && self.count < LANES * VECTORS;
        if is_simple {
            self.reached.as_flattened_mut()[self.count] = sample;
            self.count += 1;
        }
        is_simple
    }

    /// Lets a view see all that is reached, and the images. Returns how many are no images: they come first.
    #[inline(always)]
    pub(super) fn show<L: Lanes>(
        &self,
        lanes: L,
        from: Position,
        positions: &[Position],
        unit: f32,
        connected: &ConnectedMesh,
        view: &mut View,
    ) -> usize {
        view.clear();
        let scale = lanes.splat(unit);
        let mut shown = 0;
        while shown < self.count {
            let [x, y, z] = lanes.gather(positions, &self.reached[shown / LANES]);
            let offset = |x, from| lanes.mul(lanes.sub(x, lanes.splat(from)), scale);
            let count = (self.count - shown).min(LANES);
            view.add_vector(lanes, [offset(x, from[0]), offset(y, from[1]), offset(z, from[2])], count);
            shown += LANES;
        }
        match &self.more {
            None => self.count,
            Some(more) => more.show(from, positions, unit, connected, view),
        }
    }
}

impl More {
    #[inline(never)]
    fn show(
        &self,
        from: Position,
        positions: &[Position],
        unit: f32,
        connected: &ConnectedMesh,
        view: &mut View,
    ) -> usize {
        let exact = |[x, y, z, _]: Position| DVec3::new(x.into(), y.into(), z.into());
        let from = exact(from);
        for &sample in &self.reached {
            view.add((exact(positions[sample as usize]) - from).as_vec3() * unit);
        }
        let count = view.count();
        for image in &self.images {
            let place = mirrored(exact(positions[image.sample as usize]), connected.ends(image.edge));
            view.add((place - from).as_vec3() * unit);
        }
        count
    }
}
