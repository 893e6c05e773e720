//! The test of coverage where the radius varies, in `f32`, of sixteen parts of a fragment at once.

use glam::{DVec3, Vec3};

use crate::psp::adaptive::field::RadiusBounds;
use crate::psp::fragment::Shape;
use crate::psp::sixteenths::SIXTEENTHS;

/// How much, as a share of the distances at hand, rounding can add to a distance, and some more.
pub(super) const SLACK: f64 = 1e-5;

/// The centres of the sixteenths as seen from the centre of the fragment, in edges, one axis after the other.
const CENTRES: [[f32; 16]; 2] = {
    let mut centres = [[0.0; 16]; 2];
    let mut index = 0;
    while index < 16 {
        let [a, b, c] = SIXTEENTHS[index];
        centres[0][index] = ((a[0] + b[0] + c[0]) / 12.0 - 1.0 / 3.0) as f32;
        centres[1][index] = ((a[1] + b[1] + c[1]) / 12.0 - 1.0 / 3.0) as f32;
        index += 1;
    }
    centres
};

/// A sample near a fragment, in units of the test.
#[derive(Clone, Copy, Default)]
pub(super) struct Nearby {
    offset: Vec3,
    /// Half of its radius, less what rounding can add to distances from it.
    half: f32,
}

impl Nearby {
    /// A sample as it is seen from `offset` away, where distances are up to `reach` and half of its radius.
    pub fn new(offset: DVec3, radius: f64, reach: f64, per_unit: f64) -> Self {
        let half = 0.5 * radius - SLACK * (reach + 0.5 * radius);
        Self { offset: (offset * per_unit).as_vec3(), half: (half * per_unit) as f32 }
    }
}

/// A fragment in units of the test, and half of the radii on it.
pub(super) struct Outline {
    centre: Vec3,
    edges: [Vec3; 2],
    extent: f32,
    least: f32,
    largest: f32,
}

impl Outline {
    /// A fragment as seen from a place.
    pub fn new(shape: &Shape, bounds: RadiusBounds, from: DVec3, per_unit: f64) -> Self {
        let scaled = |vector: DVec3| (vector * per_unit).as_vec3();
        let half = |radius: f64| (0.5 * radius * per_unit) as f32;
        Self {
            centre: scaled(shape.centre - from),
            edges: [1, 2].map(|corner| scaled(shape.corners[corner] - shape.corners[0])),
            extent: (shape.extent * per_unit) as f32,
            least: half(bounds.least),
            largest: half(bounds.largest),
        }
    }

    /// Whether a sample can cover a point of the fragment.
    #[inline(always)]
    pub fn is_reached_by(&self, sample: &Nearby) -> bool {
        let limit = self.largest + self.extent + sample.half;
        (sample.offset - self.centre).length_squared() <= limit * limit
    }

    /// The sixteenths that none of these samples certainly covers.
    #[inline(always)]
    pub fn open_sixteenths(&self, samples: &[Nearby]) -> u16 {
        let [e, f] = self.edges;
        // By how much the squared distance is above its limit, at the sample for which this is least.
        let mut excess = [f32::INFINITY; 16];
        for sample in samples.iter().filter(|sample| self.is_reached_by(sample)) {
            let offset = sample.offset - self.centre;
            let limit = self.least + sample.half - 0.25 * self.extent;
            // Where the limit is small against the fragment the difference of the squares would be nothing but rounding.
            let limit = if limit > 0.25 * self.extent { limit * limit } else { f32::NEG_INFINITY };
            let (squared, a, b) = (offset.length_squared() - limit, -2.0 * offset.dot(e), -2.0 * offset.dot(f));
            for i in 0..16 {
                let above = squared + (a * CENTRES[0][i] + b * CENTRES[1][i]);
                excess[i] = if above < excess[i] { above } else { excess[i] };
            }
        }
        if excess[0] == f32::INFINITY {
            return u16::MAX;
        }
        let (ee, ef, ff) = (e.length_squared(), 2.0 * e.dot(f), f.length_squared());
        let mut open = [0; 16];
        for i in 0..16 {
            let (s, t) = (CENTRES[0][i], CENTRES[1][i]);
            let is_open = excess[i] + (s * s * ee + s * t * ef + t * t * ff) >= 0.0;
            open[i] = if is_open { 1u32 << i } else { 0 };
        }
        open.iter().fold(0, |all, bit| all | bit) as u16
    }
}
