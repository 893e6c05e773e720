//! Plain OBJ files, in one pass: lines of vertices, normals and faces whose indices are in range, lines of other kinds,
//! which are passed over, and comments.

use crate::mesh::decimal::{ends_word, integer};
use crate::mesh::soup::Soup;
use crate::mesh::source::Source;
use crate::mesh::text::{next_vector, skip_blanks, split_line};

/// In place of the normal of a corner that has none.
const NONE: u32 = u32::MAX;

/// A corner of a face: its vertex and its normal.
type Corner = [u32; 2];

/// What has been read.
#[derive(Default)]
struct Reader {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The normals of the triangles' corners, once a face has named one.
    normal_indices: Option<Vec<[u32; 3]>>,
    /// How many vertices and normals there have to be: what a face names may follow it.
    needed_vertices: u32,
    needed_normals: u32,
}

/// Vertices, triangles and normals of a plain file; `None` if it is not plain.
pub(super) fn parse(source: &mut Source) -> Option<Soup> {
    let mut reader = Reader::default();
    while let Some(lines) = source.whole_lines() {
        let mut rest = lines;
        while !rest.is_empty() {
            rest = reader.line(rest)?;
        }
        let count = lines.len();
        source.skip(count);
    }
    reader.finished()
}

impl Reader {
    /// Reads the line that `text` begins with. What follows it; `None` if the line is not plain.
    #[inline]
    fn line<'a>(&mut self, text: &'a [u8]) -> Option<&'a [u8]> {
        match skip_blanks(text) {
            [b'v', rest @ ..] if ends_keyword(rest) => {
                let (position, rest) = next_vector(rest).ok()?;
                self.positions.push(position);
                rest_passed(rest)
            }
            [b'f', rest @ ..] if ends_keyword(rest) => self.face(rest),
            [b'v', b'n', rest @ ..] if ends_keyword(rest) => {
                let (normal, rest) = next_vector(rest).ok()?;
                self.normals.push(normal);
                rest_passed(rest)
            }
            rest => rest_passed(rest),
        }
    }

    /// Reads the corners of a face, which becomes a fan.
    #[inline]
    fn face<'a>(&mut self, mut text: &'a [u8]) -> Option<&'a [u8]> {
        let mut corner;
        (corner, text) = self.corner(skip_blanks(text))?;
        let (first, mut previous, mut count) = (corner, corner, 1);
        loop {
            text = skip_blanks(text);
            if matches!(text, [] | [b'\n' | b'#', ..]) {
                return rest_passed(text);
            }
            (corner, text) = self.corner(text)?;
            count += 1;
            if count > 2 {
                let [vertices, normals] = [0, 1].map(|part| [first[part], previous[part], corner[part]]);
                self.triangles.push(vertices);
                if let Some(indices) = &mut self.normal_indices {
                    indices.push(normals);
                }
            }
            previous = corner;
        }
    }

    /// Reads a corner: `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
    #[inline]
    fn corner<'a>(&mut self, text: &'a [u8]) -> Option<(Corner, &'a [u8])> {
        let (vertex, mut rest) = index(text, self.positions.len())?;
        self.needed_vertices = self.needed_vertices.max(vertex + 1);
        let mut normal = NONE;
        if let [b'/', behind @ ..] = rest {
            let ends_texture = |byte: &u8| byte.is_ascii_whitespace() || b"/#\\".contains(byte);
            let end = behind.iter().position(ends_texture).unwrap_or(behind.len());
            rest = &behind[end..];
            if let [b'/', behind @ ..] = rest {
                (normal, rest) = match behind {
                    _ if ends_word(behind) => (NONE, behind),
                    [b'0', behind @ ..] if ends_word(behind) => (NONE, behind),
                    _ => self.normal(behind)?,
                };
            }
        }
        ends_word(rest).then_some(([vertex, normal], rest))
    }

    /// Reads the index of a normal.
    #[inline]
    fn normal<'a>(&mut self, text: &'a [u8]) -> Option<(u32, &'a [u8])> {
        let (normal, rest) = index(text, self.normals.len())?;
        self.needed_normals = self.needed_normals.max(normal + 1);
        // The corners before this one have none.
        self.normal_indices.get_or_insert_with(|| vec![[NONE; 3]; self.triangles.len()]);
        Some((normal, rest))
    }

    /// All that was read; `None` if a face names what there is not.
    fn finished(mut self) -> Option<Soup> {
        let has = |items: &[_], needed| items.len() >= needed as usize;
        if !has(&self.positions, self.needed_vertices) || !has(&self.normals, self.needed_normals) {
            return None;
        }
        if let Some(indices) = &mut self.normal_indices {
            let none = self.normals.len() as u32;
            self.normals.push([0.0; 3]);
            indices.as_flattened_mut().iter_mut().filter(|index| **index == NONE).for_each(|index| *index = none);
        } else {
            self.normals.clear();
        }
        let Self { positions, triangles, normals, normal_indices, .. } = self;
        Some(Soup { positions, triangles, normals, normal_indices })
    }
}

/// Reads an index, which counts from 1, or backwards from the last of `so_far` items.
#[inline]
fn index(text: &[u8], so_far: usize) -> Option<(u32, &[u8])> {
    let unsigned = text.strip_prefix(b"-").unwrap_or(text);
    let (number, rest) = integer(unsigned);
    // Ten digits cannot overflow; no digits are zero.
    if number == 0 || unsigned.len() - rest.len() > 10 {
        return None;
    }
    let index = if unsigned.len() < text.len() { (so_far as u64).checked_sub(number)? } else { number - 1 };
    (index < u64::from(NONE)).then_some((index as u32, rest))
}

/// Whether a keyword ends here.
#[inline]
fn ends_keyword(rest: &[u8]) -> bool {
    ends_word(rest) || rest[0] == b'#'
}

/// Passes over the rest of a line. What follows it; `None` if the line goes on in the next one.
#[inline]
fn rest_passed(text: &[u8]) -> Option<&[u8]> {
    if let [b'\n', rest @ ..] = text {
        return Some(rest);
    }
    let (line, rest) = split_line(text);
    let content = line.split(|&byte| byte == b'#').next().unwrap_or_default();
    (!content.trim_ascii_end().ends_with(b"\\")).then_some(rest)
}
