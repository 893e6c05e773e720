//! STL files, binary and text.
//!
//! STL knows no shared vertices: facet `i` is triangle `i`, and its vertices are `3 i` to `3 i + 2`, not merged with those
//! of others. The normals of facets are left aside: they repeat the winding, or contradict it.
//!
//! Not by a crate: stl_io 0.11 takes a binary file whose header begins with "solid" for text, reads the first of several
//! solids only, and refuses text whose normals are "nan".

use crate::mesh::soup::Soup;
use crate::mesh::text::{lines, vector, words};

/// A header that may say anything, and the number of facets.
const HEADER: usize = 80;
const PREAMBLE: usize = HEADER + 4;
/// A normal, three vertices and two bytes more.
const FACET: usize = 12 + 36 + 2;

/// Whether a file without a name looks like STL.
pub(super) fn is_likely(bytes: &[u8]) -> bool {
    begins_as_text(bytes) || facet_count(bytes).is_some_and(|count| bytes.len() == PREAMBLE + FACET * count)
}

/// Vertices and triangles, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
    let count = facet_count(bytes);
    // Headers of binary files, too, may begin with "solid"; the size decides.
    let has_exact_size = count.is_some_and(|count| bytes.len() == PREAMBLE + FACET * count);
    let positions = match count {
        Some(count) if has_exact_size || !begins_as_text(bytes) => binary(&bytes[PREAMBLE..], count)?,
        _ => text(bytes)?,
    };
    let triangles = (0..positions.len() as u32 / 3).map(|facet| [3 * facet, 3 * facet + 1, 3 * facet + 2]);
    Ok(Soup { triangles: triangles.collect(), positions, ..Default::default() })
}

fn begins_as_text(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

/// How many facets a binary file announces.
fn facet_count(bytes: &[u8]) -> Option<usize> {
    let (count, _) = bytes.get(HEADER..)?.split_first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

/// The vertices of all facets.
fn binary(facets: &[u8], count: usize) -> Result<Vec<[f32; 3]>, String> {
    if facets.len() / FACET < count {
        return Err(format!("the header announces {count} facets, but only {} bytes follow", facets.len()));
    }
    let float = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let vertex = |bytes: &[u8]| [float(bytes), float(&bytes[4..]), float(&bytes[8..])];
    let facets = facets.chunks_exact(FACET).take(count);
    Ok(facets.flat_map(|facet| facet[12..48].chunks_exact(12).map(vertex)).collect())
}

/// The vertices of all facets of all solids.
fn text(bytes: &[u8]) -> Result<Vec<[f32; 3]>, String> {
    let mut positions = Vec::new();
    for (line, content) in lines(bytes) {
        let mut words = words(content);
        let Some(keyword) = words.next() else { continue };
        if keyword.eq_ignore_ascii_case(b"vertex") {
            positions.push(vector(words).map_err(|problem| format!("line {line}: {problem}"))?);
        } else if keyword.eq_ignore_ascii_case(b"endloop") && !positions.len().is_multiple_of(3) {
            return Err(format!("line {line}: the facet ends, but does not have three vertices"));
        }
    }
    if positions.len().is_multiple_of(3) { Ok(positions) } else { Err("ends within a facet".to_owned()) }
}
