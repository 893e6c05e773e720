//! The test of `lanes.rs` in AVX2, the same to the bit.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

use crate::psp::set::lanes::{self, PointLanes};
use crate::simd::Level;

/// [`lanes::within`].
#[inline]
pub fn within(vectors: Level, places: &PointLanes, point: [f32; 3], reach2: f32) -> u8 {
    match vectors {
        Level::Portable => lanes::within(places, point, reach2),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { within_avx2(places, point, reach2) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn within_avx2([x, y, z]: &PointLanes, point: [f32; 3], reach2: f32) -> u8 {
    // SAFETY: eight floats are read, from an array of eight; no alignment is required.
    let load = |lanes: &[f32; lanes::LANES]| unsafe { _mm256_loadu_ps(lanes.as_ptr()) };
    let x = _mm256_sub_ps(load(x), _mm256_set1_ps(point[0]));
    let y = _mm256_sub_ps(load(y), _mm256_set1_ps(point[1]));
    let z = _mm256_sub_ps(load(z), _mm256_set1_ps(point[2]));
    let squares = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
    _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(squares, _mm256_set1_ps(reach2))) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::set::lanes::FAR;
    use crate::rng::{Draw, Rng};

    #[test]
    fn all_vectors_give_the_same_bits() {
        let (mut rng, mut count) = (Rng::at(3, Draw::Probe, &[]), 0);
        for _ in 0..3000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut places: PointLanes = [(); 3].map(|()| [(); lanes::LANES].map(|()| coordinate(1.5)));
            places.iter_mut().for_each(|axis| axis[6..].fill(FAR));
            let point = [(); 3].map(|()| coordinate(0.5));
            let expected = within(Level::Portable, &places, point, 1.0);
            assert!(Level::available().into_iter().all(|level| within(level, &places, point, 1.0) == expected));
            count += expected.count_ones();
        }
        assert!(count > 1000, "{count}");
    }
}
