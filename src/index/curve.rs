//! The Z-curve (Morton 1966): places close to each other along it are close in space, and mostly the reverse.

/// The position along the curve of a cell of the plane.
pub fn morton2([x, y]: [u32; 2]) -> u64 {
    let masks = [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ];
    spread(x.into(), masks) | spread(y.into(), masks) << 1
}

/// Bits per axis of the curve through space.
pub const SPACE_BITS: u32 = 21;

/// The position along the curve of a cell of space; its coordinates have [`SPACE_BITS`] bits.
pub fn morton3([x, y, z]: [u32; 3]) -> u64 {
    let masks = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ];
    spread(x.into(), masks) | spread(y.into(), masks) << 1 | spread(z.into(), masks) << 2
}

/// The bits of a number, with zeros between them: halves are moved apart, then their halves, down to single bits.
fn spread(x: u64, masks: [(u32, u64); 5]) -> u64 {
    masks.into_iter().fold(x, |x, (shift, mask)| (x | x << shift) & mask)
}

/// Positions along a curve in order, each with its former number.
pub fn sorted(places: impl Iterator<Item = u64>) -> Vec<(u64, u32)> {
    let mut sorted: Vec<(u64, u32)> = places.zip(0..).collect();
    sorted.sort_unstable();
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn bits_take_turns() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for _ in 0..100 {
            let cell = [0; 3].map(|_: u32| rng.bits() as u32);
            let interleaved = |axes: usize, bits: u32| {
                let bit = |place: u32| u64::from(cell[place as usize % axes] >> (place / axes as u32) & 1);
                (0..axes as u32 * bits).fold(0, |code, place| code | bit(place) << place)
            };
            assert_eq!(morton2([cell[0], cell[1]]), interleaved(2, 32));
            assert_eq!(morton3(cell.map(|x| x & ((1 << SPACE_BITS) - 1))), interleaved(3, SPACE_BITS));
        }
    }

    #[test]
    fn the_curve_visits_quarter_after_quarter() {
        const HALF: u32 = 1 << 31;
        let corners = [[0, 0], [HALF, 0], [0, HALF], [HALF, HALF]];
        let cells = (0..16).map(|i| corners[i % 4].map(|x| x + (i as u32 / 4) * 1000));
        let quarters: Vec<u32> = sorted(cells.map(morton2)).iter().map(|(_, i)| i % 4).collect();
        assert_eq!(quarters, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3]);
    }
}
