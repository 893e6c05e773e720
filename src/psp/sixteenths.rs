//! The sixteen parts of a fragment: their positions, and the parts that are covered when some corners are.
//!
//! Lines parallel to the three edges cut a fragment into four by four congruent parts of its own shape: ten that stand
//! as it does, then six turned over. They have fifteen corners, counted along the rows of five, four, three, two and
//! one.

/// The number of sixteenths that are oriented like the fragment. They come first.
pub(super) const STANDING: usize = 10;

/// The corners of the sixteenths in quarters of the fragment's edges.
pub(super) const SIXTEENTHS: [[[f64; 2]; 3]; 16] = {
    let mut corners = [[[0.0; 2]; 3]; 16];
    let (mut index, mut turned) = (0, STANDING);
    let mut row = 0;
    while row < 4 {
        let mut column = 0;
        while column + row < 4 {
            let (x, y) = (column as f64, row as f64);
            corners[index] = [[x, y], [x + 1.0, y], [x, y + 1.0]];
            index += 1;
            if column + row < 3 {
                corners[turned] = [[x + 1.0, y + 1.0], [x, y + 1.0], [x + 1.0, y]];
                turned += 1;
            }
            column += 1;
        }
        row += 1;
    }
    corners
};

/// The fifteen corners in shares of the fragment's edges, one edge after the other, and the last one twice.
pub(super) const CORNERS: [[f32; 16]; 2] = {
    let mut corners = [[0.0; 16], [1.0; 16]];
    let (mut index, mut row) = (0, 0);
    while row < 5 {
        let mut column = 0;
        while column + row < 5 {
            corners[0][index] = 0.25 * column as f32;
            corners[1][index] = 0.25 * row as f32;
            index += 1;
            column += 1;
        }
        row += 1;
    }
    corners
};

/// Corners in shares of the fragment's edges, of which each sixteenth has one or more: the three inside, and one for
/// each of the sixteenths at the fragment's own corners.
pub(super) const PIERCING: [[f64; 2]; 6] =
    [[0.25, 0.25], [0.5, 0.25], [0.25, 0.5], [0.25, 0.0], [0.75, 0.25], [0.0, 0.75]];

/// The piercing corners, one edge after the other, in eight lanes: the first one again in the last two.
pub(super) const PIERCING_BY_EDGE: [[f64; 8]; 2] = {
    let mut corners = [[0.0; 8]; 2];
    let mut lane = 0;
    while lane < 8 {
        let corner = PIERCING[if lane < PIERCING.len() { lane } else { 0 }];
        corners[0][lane] = corner[0];
        corners[1][lane] = corner[1];
        lane += 1;
    }
    corners
};

/// The numbers of the first, second and third corners of the sixteenths.
pub(super) const CORNERS_OF_SIXTEENTHS: [[i32; 16]; 3] = {
    let mut numbers = [[0; 16]; 3];
    let mut index = 0;
    while index < 48 {
        let [column, row] = SIXTEENTHS[index / 3][index % 3];
        let (column, row) = (column as i32, row as i32);
        numbers[index % 3][index / 3] = row * (11 - row) / 2 + column;
        index += 1;
    }
    numbers
};

/// The covered sixteenths, gathered ball by ball. Bit `5·row + column` is the sixteenth whose lowest corner, or whose
/// missing corner for those turned over, is the one in this row and column.
#[derive(Default)]
pub(super) struct Cover {
    standing: u32,
    turned: u32,
}

impl Cover {
    /// Adds the sixteenths of which all three corners are in a ball, given the fifteen corners that are.
    #[inline(always)]
    pub fn add(&mut self, corners: u16) {
        let corners = u32::from(corners);
        // Rows of five bits each.
        let here = corners & 0x1ff | (corners & 0xe00) << 1 | (corners & 0x3000) << 3 | (corners & 0x4000) << 6;
        let (right, above) = (here >> 1, here >> 5);
        self.standing |= here & right & above;
        self.turned |= right & above & (above >> 1);
    }

    /// A bit for each sixteenth, in the order of [`SIXTEENTHS`].
    #[inline(always)]
    pub fn sixteenths(&self) -> u16 {
        let (s, t) = (self.standing, self.turned);
        let standing = s & 0xf | (s >> 5 & 7) << 4 | (s >> 10 & 3) << 7 | (s >> 15 & 1) << 9;
        let turned = t & 7 | (t >> 5 & 3) << 3 | (t >> 10 & 1) << 5;
        (standing | turned << STANDING) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_sixteenth_has_a_piercing_corner() {
        for corners in SIXTEENTHS {
            assert!(corners.iter().any(|corner| PIERCING.contains(&corner.map(|quarters| 0.25 * quarters))));
        }
        assert!(PIERCING.iter().all(|&piercing| {
            let others: Vec<_> = PIERCING.into_iter().filter(|&other| other != piercing).collect();
            SIXTEENTHS.iter().any(|corners| !corners.iter().any(|c| others.contains(&c.map(|q| 0.25 * q))))
        }));
    }

    /// Every set of corners, against the corners of each sixteenth.
    #[test]
    fn a_sixteenth_is_covered_when_its_corners_are_in_one_ball() {
        let corner = |[x, y]: [f64; 2]| {
            let place = |i: &usize| [CORNERS[0][*i], CORNERS[1][*i]].map(f64::from) == [0.25 * x, 0.25 * y];
            (0..15).find(place).unwrap()
        };
        let needed = SIXTEENTHS.map(|corners| corners.iter().fold(0, |bits, &c| bits | 1u16 << corner(c)));
        let expected = |corners: u16| (0..16).fold(0, |all, i| all | u16::from(corners & needed[i] == needed[i]) << i);
        for corners in 0..1 << 15 {
            let mut cover = Cover::default();
            cover.add(corners);
            assert_eq!(cover.sixteenths(), expected(corners), "{corners:b}");
            cover.add(0x7fff ^ corners);
            assert_eq!(cover.sixteenths(), expected(corners) | expected(0x7fff ^ corners));
        }
    }
}
