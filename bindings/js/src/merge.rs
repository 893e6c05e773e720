//! The merging of sets of the plane.

use azulejo::kdrt::{MergeOptions, Piece, merge};

use crate::answer::{Answer, call};
use crate::domain;
use crate::memory::rows;

/// The samples, and how many of the pieces' are kept, eliminated, and inserted. `counts` and `corners` are those of each
/// piece, `positions` those of all, one after the other.
///
/// # Safety
/// The pointers are valid for reads of so many rows, and `counts` add up to `position_count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_merge(
    radius: f64,
    min_x: f64,
    min_y: f64,
    max_x: f64,
    max_y: f64,
    bounded: i32,
    seed: u64,
    maximal_pieces: i32,
    counts: *const u32,
    piece_count: usize,
    corners: *const [[f64; 2]; 2],
    positions: *const [f32; 2],
    position_count: usize,
    fixed: *const [f32; 2],
    fixed_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (counts, corners) = unsafe { (rows(counts, piece_count), rows(corners, piece_count)) };
    // SAFETY: guaranteed by the caller.
    let (mut rest, fixed) = unsafe { (rows(positions, position_count), rows(fixed, fixed_count)) };
    call(|context, progress| {
        let options = MergeOptions::new(radius)
            .domain(domain(min_x, min_y, max_x, max_y, bounded))
            .seed(seed)
            .maximal_pieces(maximal_pieces != 0);
        let mut pieces = Vec::with_capacity(piece_count);
        for (&count, &[min, max]) in counts.iter().zip(corners) {
            let (samples, after) = rest.split_at(count as usize);
            pieces.push(Piece { samples, min, max });
            rest = after;
        }
        let (set, report) = merge(context, &options, &pieces, fixed, progress)?;
        let report = [report.kept, report.eliminated, report.inserted].map(|count| count as f64);
        Ok(Answer::default().and(set.positions).and(report.to_vec()))
    })
}
