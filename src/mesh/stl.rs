//! STL files, binary and text.
//!
//! STL knows no shared vertices: facet `i` is triangle `i`, and its vertices are `3 i` to `3 i + 2`, not merged with
//! those of others. The normals of facets are ignored: they repeat the winding, or contradict it.
//!
//! Not by a crate: stl_io 0.11 takes a binary file whose header begins with "solid" for text, reads the first of
//! several solids only, and refuses text whose normals are "nan".

use crate::mesh::load::Soup;
use crate::mesh::source::Source;
use crate::mesh::text::{Float, next_vector, shown, skip_blanks, split_line, split_word};

/// The size of a header of any content, which the number of facets follows.
const HEADER: usize = 80;
const PREAMBLE: usize = HEADER + 4;
/// The size of a normal, three vertices and two more bytes.
const FACET: usize = 12 + 36 + 2;

/// True if a file without a name looks like STL.
pub(super) fn is_likely(source: &mut Source) -> bool {
    let size = source.length();
    let start = source.at_least(PREAMBLE);
    begins_as_text(start) || facet_count(start).is_some_and(|count| has_size(size, count))
}

/// Vertices and triangles, or the defect of the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let positions = match facets(source) {
        Some(count) => binary(source, count)?,
        None => text(source)?,
    };
    let triangles = (0..positions.len() as u32 / 3).map(|facet| [3 * facet, 3 * facet + 1, 3 * facet + 2]);
    Ok(Soup { triangles: triangles.collect(), positions, ..Default::default() })
}

/// The vertices of all facets in doubles, which only a text has, or the defect of the file.
pub(super) fn doubles(source: &mut Source) -> Result<Vec<[f64; 3]>, String> {
    match facets(source) {
        Some(count) => Ok(binary(source, count)?.into_iter().map(|position| position.map(f64::from)).collect()),
        None => text(source),
    }
}

/// The number of facets of a binary file; `None` for a text.
fn facets(source: &mut Source) -> Option<u32> {
    let size = source.length();
    let start = source.at_least(PREAMBLE);
    // Headers of binary files, too, may begin with "solid"; the size decides.
    facet_count(start).filter(|&count| has_size(size, count) || !begins_as_text(start))
}

fn begins_as_text(start: &[u8]) -> bool {
    start.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// The number of facets that a binary file announces.
fn facet_count(start: &[u8]) -> Option<u32> {
    let (count, _) = start.get(HEADER..)?.split_first_chunk()?;
    Some(u32::from_le_bytes(*count))
}

/// True if a file of this size is a binary one with this many facets.
fn has_size(size: u64, count: u32) -> bool {
    size == PREAMBLE as u64 + FACET as u64 * u64::from(count)
}

/// The vertices of all facets.
fn binary(source: &mut Source, count: u32) -> Result<Vec<[f32; 3]>, String> {
    source.skip(PREAMBLE);
    let remaining = source.remaining();
    let too_few = || format!("the header announces {count} facets, but only {remaining} bytes follow");
    if remaining / (FACET as u64) < u64::from(count) {
        return Err(too_few());
    }
    let float = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let vertex = |bytes: &[u8]| [float(bytes), float(&bytes[4..]), float(&bytes[8..])];
    let mut positions = Vec::with_capacity(3 * count as usize);
    for _ in 0..count {
        let facet = source.at_least(FACET).get(12..48).ok_or_else(too_few)?;
        positions.extend(facet.chunks_exact(12).map(vertex));
        source.skip(FACET);
    }
    Ok(positions)
}

/// The vertices of all facets of all solids.
fn text<T: Float + Copy + Default>(source: &mut Source) -> Result<Vec<[T; 3]>, String> {
    let (mut positions, mut number) = (Vec::new(), 0);
    while let Some(lines) = source.whole_lines() {
        let (count, mut rest) = (lines.len(), lines);
        while !rest.is_empty() {
            let line;
            (line, rest) = split_line(rest);
            number += 1;
            let (keyword, content) = split_word(skip_blanks(line));
            if keyword.eq_ignore_ascii_case(b"vertex") {
                let (position, _) = next_vector(content).map_err(|word| format!("line {number}: {}", problem(word)))?;
                positions.push(position);
            } else if keyword.eq_ignore_ascii_case(b"endloop") && !positions.len().is_multiple_of(3) {
                return Err(format!("line {number}: the facet ends, but does not have three vertices"));
            }
        }
        source.skip(count);
    }
    if positions.len().is_multiple_of(3) { Ok(positions) } else { Err("ends within a facet".to_owned()) }
}

/// The defect of a word that should be a coordinate.
fn problem(word: &[u8]) -> String {
    if word.is_empty() { "fewer than three numbers".to_owned() } else { format!("{} is not a number", shown(word)) }
}
