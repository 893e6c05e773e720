//! Samples in lanes of eight, and the coarse test, in `f32`, by which merging finds the samples near a point.
//!
//! Lengths are in radii. The test finds the points that are certainly far; the rest is decided in `f64`
//! (`surroundings.rs`). The code here is portable; `vectors.rs` has the same in AVX2, equal to the bit.

/// The amount that rounding can add to a squared distance of about 1, and some more. Places in a cube's surroundings
/// are off by at most 2^-19 on each axis, which makes 1.4e-5 for two of them.
pub const SLACK: f32 = 3e-5;

/// The number of points that are tested together.
pub const LANES: usize = 8;

/// A coordinate for lanes without a point. Its square is a float.
pub const FAR: f32 = 1e18;

/// A few points, one axis after the other; places without a point are [`FAR`] away.
pub type PointLanes = [[f32; LANES]; 3];

/// The points that are no farther than the square root of `reach2` from a point: a bit for each.
pub fn within(places: &PointLanes, point: [f32; 3], reach2: f32) -> u8 {
    let mut within = 0;
    let [xs, ys, zs] = places;
    for (lane, ((x, y), z)) in xs.iter().zip(ys).zip(zs).enumerate() {
        let [x, y, z] = [x - point[0], y - point[1], z - point[2]];
        within |= u8::from(x * x + y * y + z * z <= reach2) << lane;
    }
    within
}
