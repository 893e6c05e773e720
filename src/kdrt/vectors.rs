//! The filling of a block (`fill.rs`) compiled for each level of vector instructions, the same to the bit, so that the
//! small functions over `Lanes` (`plane/near.rs`) are inlined, and its loops over bits and footprints use these
//! instructions.

use crate::plane::CellGrid;
use crate::rng::Rng;
use crate::simd::Level;

use crate::kdrt::blocks::Block;
use crate::kdrt::fill::Filling;

impl Filling<'_> {
    /// Makes the samples of the grid maximal in `block` and shows each new one to `accepted`, with the grid as it is
    /// then. `rng` makes the random numbers of the block.
    pub fn fill(
        &mut self,
        grid: &mut CellGrid,
        block: &Block,
        rng: impl Fn() -> Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        match grid.vectors() {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => unsafe { self.fill_avx512(grid, block, rng, accepted) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => unsafe { self.fill_avx2(grid, block, rng, accepted) },
            Level::Portable => self.fill_portable(grid, block, rng, accepted),
        }
    }

    /// The portable code, compiled for AVX-512.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2,avx512f,avx512vl,avx512dq,avx512bw")]
    fn fill_avx512(
        &mut self,
        grid: &mut CellGrid,
        block: &Block,
        rng: impl Fn() -> Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        self.fill_portable(grid, block, rng, accepted);
    }

    /// The portable code, compiled for AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
    fn fill_avx2(
        &mut self,
        grid: &mut CellGrid,
        block: &Block,
        rng: impl Fn() -> Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        self.fill_portable(grid, block, rng, accepted);
    }
}
