//! Pages of sixteen samples, and the tests on them that nearly all work of a fill goes through, in `f32`.
//!
//! The tests say what is certain; what they leave open is decided later, in smaller parts or in `f64` (`grid.rs`). The
//! code here is plain and portable. `vectors/` has the same functions in the vectors of the processor, equal to the
//! bit: no sum has another order, no rounding is left out.

use glam::DVec3;

use crate::psp::fill::space::Place;
use crate::psp::sixteenths::{CORNERS, Cover};

/// The samples on a page.
pub const LANES: usize = 16;

/// A coordinate of no sample. Its square is a float.
const FAR: f32 = 1e18;

/// The places of up to sixteen samples, one axis after the other; lanes without a sample are far away.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Page(pub [[f32; LANES]; 3]);

pub const THIRD: f64 = 1.0 / 3.0;
/// What rounding adds to the square of a reach, and more.
pub const REACH_SLACK: f32 = 1.0001;

/// Triangles that are tested together.
pub const GROUP: usize = 64;

/// Some triangles, by their corners, and a page for each.
pub struct Group {
    pub triangles: [[Place; 3]; GROUP],
    pub pages: [u32; GROUP],
}

/// A fragment as seen from a place near it.
pub struct Part {
    pub origin: Place,
    pub corner: [f32; 3],
    /// From the corner to the other two.
    pub edges: [[f32; 3]; 2],
    pub centre: [f32; 3],
    /// No sample whose squared distance from the centre is above this covers any of it.
    pub reach2: f32,
}

impl Part {
    /// A fragment by its corners, where `reach` is how far from its centre the samples are at most that cover any of it.
    pub fn new([a, b, c]: [DVec3; 3], reach: f32) -> Self {
        let origin = a.as_vec3();
        let [corner, to_b, to_c] = [a - origin.as_dvec3(), b - a, c - a];
        Self {
            origin: origin.to_array(),
            corner: corner.as_vec3().to_array(),
            edges: [to_b.as_vec3().to_array(), to_c.as_vec3().to_array()],
            centre: (corner + (to_b + to_c) * THIRD).as_vec3().to_array(),
            reach2: reach * reach * REACH_SLACK,
        }
    }
}

impl Page {
    /// A page without samples.
    pub const EMPTY: Self = Self([[FAR; LANES]; 3]);

    /// Puts a sample into a lane.
    pub fn put(&mut self, lane: usize, place: Place) {
        (0..3).for_each(|axis| self.0[axis][lane] = place[axis]);
    }

    /// The sample in a lane.
    pub fn place(&self, lane: usize) -> Place {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }

    /// Which samples are no farther from a place than the square root of `limit`: a bit for each.
    pub fn near(&self, place: Place, limit: f32) -> u16 {
        let mut near = 0;
        for (lane, square) in self.squares(place).into_iter().enumerate() {
            near |= u16::from(square <= limit) << lane;
        }
        near
    }

    /// Which samples are nearer to all three places.
    pub fn covering(&self, corners: &[Place; 3], limit: f32) -> u16 {
        let [a, b, c] = corners.map(|corner| self.squares(corner));
        let mut covering = 0;
        for lane in 0..LANES {
            covering |= u16::from(a[lane] < limit && b[lane] < limit && c[lane] < limit) << lane;
        }
        covering
    }

    /// The squared distances of all samples from a place.
    fn squares(&self, place: Place) -> [f32; LANES] {
        std::array::from_fn(|lane| square([0, 1, 2].map(|axis| self.0[axis][lane] - place[axis])))
    }

    /// The sixteenths of a fragment whose three corners are nearer to one sample, among those in some lanes, than the
    /// square root of `limit`.
    pub fn covered(&self, part: &Part, among: u16, limit: f32) -> u16 {
        let mut cover = Cover::default();
        let corners: [[f32; 3]; 16] = std::array::from_fn(|i| {
            [0, 1, 2].map(|axis| {
                part.corner[axis] + (CORNERS[0][i] * part.edges[0][axis] + CORNERS[1][i] * part.edges[1][axis])
            })
        });
        for lane in 0..LANES {
            let sample = [0, 1, 2].map(|axis| self.0[axis][lane] - part.origin[axis]);
            let square_to_centre = square([0, 1, 2].map(|axis| sample[axis] - part.centre[axis]));
            if among >> lane & 1 == 1 && square_to_centre <= part.reach2 {
                let mut inside = 0;
                for (bit, corner) in corners.iter().enumerate() {
                    let offset = [0, 1, 2].map(|axis| corner[axis] - sample[axis]);
                    inside |= u16::from(square(offset) < limit) << bit;
                }
                cover.add(inside);
            }
        }
        cover.sixteenths()
    }
}

impl Group {
    pub const EMPTY: Self = Self { triangles: [[[0.0; 3]; 3]; GROUP], pages: [0; GROUP] };

    /// Which triangles lie, with their three corners, nearer to one sample of their page than the square root of
    /// `limit`: a bit for each.
    pub fn covered(&self, pages: &[Page], limit: f32) -> u64 {
        let mut covered = 0;
        for (lane, &page) in self.pages.iter().enumerate() {
            let covering = pages[page as usize].covering(&self.triangles[lane], limit);
            covered |= u64::from(covering != 0) << lane;
        }
        covered
    }
}

fn square([x, y, z]: [f32; 3]) -> f32 {
    x * x + y * y + z * z
}
