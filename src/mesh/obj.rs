//! OBJ files: plain ones in one pass, that is lines of vertices, normals and faces whose indices are in range, lines of
//! other kinds, which are skipped, and comments; all others by the crate tobj: continued lines, numbers and comments in
//! odd places, and the defects of a broken file.
//!
//! tobj is shown nothing but vertices and faces: once those of the file, and once its normals in place of the vertices,
//! with the faces by the numbers of their normals. That keeps the faces of all groups in their order, follows no
//! `mtllib` to other files, admits comments in any encoding, distinguishes corners without a normal, and avoids tobj's
//! handling of texture coordinates and normals, which panics on some broken files. As tobj numbers vertices by their
//! first use, the first faces that it sees use all of them, in the order of the file.
//!
//! Both passes are needed: in one pass tobj 4 either merges the indices of positions and normals, so that vertices lose
//! the numbers of the file, or gives a corner without a normal the normal of another. A file without normals is shown
//! once.

use std::borrow::Cow;

use tobj::LoadError::{FaceVertexOutOfBounds, InvalidPolygon};

use crate::mesh::load::Soup;
use crate::mesh::source::Source;
use crate::mesh::text::{ends_word, integer, lines, next_vector, number, skip_blanks, split_line, words};

/// Vertices, triangles and normals, or the defect of the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let start = source.at_least(3);
    if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
        return Err("is encoded in UTF-16; save it as UTF-8".to_owned());
    }
    if start.starts_with(b"\xef\xbb\xbf") {
        source.skip(3);
    }
    match parse_plain(source) {
        Some(soup) => Ok(soup),
        None => parse_any(&source.whole()),
    }
}

/// The vertices of a file that [`parse`] has read, in doubles.
pub(super) fn doubles(source: &mut Source) -> Result<Vec<[f64; 3]>, String> {
    let vertex = |(line, content): (usize, Cow<[u8]>)| {
        let mut words = words(&content);
        if words.next() != Some(VERTICES.keyword) {
            return None;
        }
        let mut next = || words.next().and_then(number);
        let vertex = (|| Some([next()?, next()?, next()?]))();
        Some(vertex.ok_or_else(|| format!("line {line}: a vertex without three numbers")))
    };
    statements(&source.whole()).filter_map(vertex).collect()
}

/// In place of the normal of a corner that has none.
const NONE: u32 = u32::MAX;

/// A corner of a face: its vertex and its normal.
type Corner = [u32; 2];

/// The part of a file that has been read.
#[derive(Default)]
struct Reader {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The normals of the triangles' corners, once a face has named one.
    normal_indices: Option<Vec<[u32; 3]>>,
    /// The numbers of vertices and of normals that there have to be: a face may precede the items that it names.
    needed_vertices: u32,
    needed_normals: u32,
}

/// Vertices, triangles and normals of a plain file; `None` if it is not plain.
fn parse_plain(source: &mut Source) -> Option<Soup> {
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
    /// Reads the line that `text` begins with. Returns the text after it; `None` if the line is not plain.
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

    /// All that was read; `None` if a face names an item that does not exist.
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

/// True if a keyword ends here.
#[inline]
fn ends_keyword(rest: &[u8]) -> bool {
    ends_word(rest) || rest[0] == b'#'
}

/// Skips the rest of a line. Returns the text after it; `None` if the line is continued by the next one.
#[inline]
fn rest_passed(text: &[u8]) -> Option<&[u8]> {
    if let [b'\n', rest @ ..] = text {
        return Some(rest);
    }
    let (line, rest) = split_line(text);
    let content = line.split(|&byte| byte == b'#').next().unwrap_or_default();
    (!content.trim_ascii_end().ends_with(b"\\")).then_some(rest)
}

/// The part of a file that is shown as vertices and faces.
struct View {
    /// The name of the items that faces refer to, and the keyword of their lines.
    name: &'static str,
    keyword: &'static [u8],
    /// The part of a corner, `vertex/texture/normal`, that names one.
    part: usize,
    /// True if corners may name none. An additional item, of zeros and after all others, stands for that.
    is_optional: bool,
}

/// Vectors, and the three of each triangle.
type Indexed = (Vec<[f32; 3]>, Vec<[u32; 3]>);

const VERTICES: View = View { name: "vertex", keyword: b"v", part: 0, is_optional: false };
const NORMALS: View = View { name: "normal", keyword: b"vn", part: 2, is_optional: true };

/// Vertices, triangles and normals, or the defect of the file.
fn parse_any(bytes: &[u8]) -> Result<Soup, String> {
    let (positions, triangles) = VERTICES.load(bytes)?;
    let mut soup = Soup { positions, triangles, ..Default::default() };
    if NORMALS.is_named_in(bytes) {
        let (normals, indices) = NORMALS.load(bytes)?;
        (soup.normals, soup.normal_indices) = (normals, Some(indices));
    }
    Ok(soup)
}

impl View {
    /// The items, and the three of each triangle.
    fn load(&self, bytes: &[u8]) -> Result<Indexed, String> {
        let items = self.count(bytes) + usize::from(self.is_optional);
        let firsts = items.div_ceil(3);
        let text = self.show(bytes, items);
        let options =
            tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
        let mut rest = &text[..];
        let loaded = tobj::load_obj_buf(&mut rest, &options, |_| Err(tobj::LoadError::MaterialParseError));
        let (models, _) = loaded.map_err(|error| match error {
            // These are found at the end, when the faces are put together.
            FaceVertexOutOfBounds | InvalidPolygon => self.bad_face(bytes).unwrap_or_else(|| error.to_string()),
            _ => {
                let read = text[..text.len() - rest.len()].iter().filter(|&&byte| byte == b'\n').count() - firsts;
                let line = statements(bytes).filter(|(_, content)| self.shows(content)).nth(read.saturating_sub(1));
                format!("line {}: {error}", line.map_or(0, |(line, _)| line))
            }
        })?;
        let Some(model) = models.into_iter().next() else { return Ok(Default::default()) };
        let vectors = model.mesh.positions.as_chunks().0.to_vec();
        let triangles = model.mesh.indices.as_chunks().0[firsts..].to_vec();
        Ok((vectors, triangles))
    }

    /// The lines that tobj is shown: faces that use all items in order, then the items and faces of the file.
    fn show(&self, bytes: &[u8], items: usize) -> Vec<u8> {
        let mut text = Vec::with_capacity(bytes.len());
        let mut write = |keyword: &[u8], words: &mut dyn Iterator<Item = Cow<[u8]>>| {
            text.extend(keyword);
            for word in words {
                text.push(b' ');
                text.extend_from_slice(&word);
            }
            text.push(b'\n');
        };
        let decimal = |number: usize| Cow::from(number.to_string().into_bytes());
        for first in (1..=items).step_by(3) {
            write(b"f", &mut (first..first + 3).map(|item| decimal(item.min(items))));
        }
        for (_, content) in statements(bytes).filter(|(_, content)| self.shows(content)) {
            let mut words = words(&content);
            if words.next() == Some(b"f") {
                write(b"f", &mut words.map(|corner| self.index(corner).map_or(decimal(items), Cow::from)));
            } else {
                // Weights and colours may follow.
                write(b"v", &mut words.take(3).map(Cow::from));
            }
        }
        if self.is_optional {
            write(b"v 0 0 0", &mut std::iter::empty());
        }
        text
    }

    /// The index in a corner of a face; `None` if it may be missing, and is.
    fn index<'a>(&self, corner: &'a [u8]) -> Option<&'a [u8]> {
        let mut parts = corner.split(|&byte| byte == b'/');
        match parts.clone().nth(self.part).unwrap_or_default() {
            // Not the corner of a face.
            _ if parts.nth(3).is_some() => Some(corner),
            b"" | b"0" if self.is_optional => None,
            b"" => Some(b"0"),
            index => Some(index),
        }
    }

    fn shows(&self, content: &[u8]) -> bool {
        words(content).next().is_some_and(|keyword| keyword == self.keyword || keyword == b"f")
    }

    /// The number of items.
    fn count(&self, bytes: &[u8]) -> usize {
        statements(bytes).filter(|(_, content)| words(content).next() == Some(self.keyword)).count()
    }

    /// True if a face names an item.
    fn is_named_in(&self, bytes: &[u8]) -> bool {
        let mut faces = statements(bytes).filter(|(_, content)| words(content).next() == Some(b"f"));
        faces.any(|(_, content)| words(&content).skip(1).any(|corner| self.index(corner).is_some()))
    }

    /// The first face that has no corners or names an item that does not exist.
    fn bad_face(&self, bytes: &[u8]) -> Option<String> {
        let (name, all) = (self.name, self.count(bytes));
        let mut so_far = 0;
        statements(bytes).find_map(|(line, content)| {
            let mut words = words(&content);
            let keyword = words.next();
            so_far += usize::from(keyword == Some(self.keyword));
            if keyword != Some(b"f") {
                return None;
            }
            if words.clone().next().is_none() {
                return Some(format!("line {line}: a face without corners"));
            }
            let is_bad = |&index: &i64| index == 0 || !(-(so_far as i64)..=all as i64).contains(&index);
            let bad = words.filter_map(|corner| number(self.index(corner)?)).find(is_bad)?;
            let seen = if bad < 0 { format!("{so_far} so far") } else { format!("{all}") };
            Some(format!("line {line}: a face names {name} {bad}, but there are {seen}"))
        })
    }
}

/// The statements of a file, line by line, each with its number: without comments and empty lines. A line that ends
/// with a backslash is continued by the next one.
fn statements(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut lines = lines(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let all = std::iter::from_fn(move || {
        let (mut joined, mut last) = (Vec::new(), 0);
        for (line, content) in lines.by_ref() {
            last = line;
            let content = content.split(|&byte| byte == b'#').next().unwrap_or_default().trim_ascii();
            if let Some(start) = content.strip_suffix(b"\\") {
                joined.extend([start, b" "].concat());
            } else if joined.is_empty() {
                return Some((line, Cow::from(content)));
            } else {
                joined.extend(content);
                return Some((line, Cow::from(joined)));
            }
        }
        (!joined.is_empty()).then(|| (last, Cow::from(joined)))
    });
    all.filter(|(_, content)| !content.is_empty())
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use proptest::prelude::*;
    use proptest::sample::select;

    use super::*;

    fn plain(text: &str) -> Option<Soup> {
        let mut input = Cursor::new(text.as_bytes());
        parse_plain(&mut Source::new(&mut input, text.len() as u64))
    }

    fn bits(vectors: &[[f32; 3]]) -> Vec<[u32; 3]> {
        vectors.iter().map(|vector| vector.map(f32::to_bits)).collect()
    }

    /// True if a file is plain; asserts that it is then read as tobj reads it.
    fn agrees(text: &str) -> bool {
        let Some(soup) = plain(text) else { return false };
        let other = parse_any(text.as_bytes()).unwrap_or_else(|error| panic!("{error} in:\n{text}"));
        assert_eq!(bits(&soup.positions), bits(&other.positions), "{text}");
        assert_eq!(soup.triangles, other.triangles, "{text}");
        assert_eq!(bits(&soup.normals), bits(&other.normals), "{text}");
        assert_eq!(soup.normal_indices, other.normal_indices, "{text}");
        true
    }

    #[test]
    fn what_programs_write_is_plain() {
        for text in [
            "",
            "# by a program\nmtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 1.0\r\nv 1.0e+00 1 -0 .1 .2 .3\nvt 0 1\nvn 0 0 1\ns off\n\
             usemtl C:\\b\nf 1/1/1 2/1/1 3/1/1\ng\nf 1//1 2//1 3//1 # a triangle\n\n  f -1 -2 -3/1\nl 1 2\nf 1 2\nf 1",
            "f 1 2 3 4\nv nan 0 0\nv 1e99 inf 0\nv 1 1 0\nv 123456789.123456789123456789 1 0\n# C:\\\n",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1//0 2/7/ 3//\nf 1 2 3//1\nvn 1 2 nan\nf 1//-1 2 3",
        ] {
            assert!(agrees(text), "{text}");
        }
    }

    #[test]
    fn all_else_is_left_to_tobj() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for line in [
            "v 1 2",
            "v",
            "v#",
            "v 1 2 x",
            "v 1 2 3#4",
            "vn 0 1",
            "vn",
            "f",
            "f 0 1 2",
            "f 1 2 4",
            "f -4 1 2",
            "f 4",
            "f 1 2 3//1",
            "f 1/1/1/1 2 3",
            "f 1 2 x",
            "f 1 2 3#",
            "f 1/#/1 2 3",
            "f 1 2 4294967297",
            "f 1 2 +3",
            "f 1//00 2 3",
            "f 1 2 18446744073709551617",
            "f 1 2 \\\n3",
            "v 1 2 \\\n3",
            "v 1 2 3 \\ # \\\n4",
            "g a \\\nb",
            "v\\\n 1 2 3",
            "f\\\n 1 2 3",
            "v 1\x0b2 3 4",
            "f 1/ 2/3/4/ 3",
        ] {
            assert!(plain(&format!("{vertices}{line}\n")).is_none(), "{line}");
            assert!(plain(&format!("{vertices}{line}")).is_none(), "{line}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn plain_files_are_read_as_tobj_reads_them(
            words in prop::collection::vec(select(&[
                "v", "v", "vn", "vn", "f", "f", "f", "g", "vt", "#", "1", "2", "3", "-1", "-2", "1/1/1", "2//1", "3/2",
                "1//", "2/2/", "-1//-1", "0", "0.5", "-1e3", ".25", "7.", "x", "\\", "\r", "\n", "\n", "\n", "\nf 1 2 3",
                "\nv 1 2 3", "\nvn 1 0 0", "\nf 1//1 2//1 3//2", "\nf -1 -2 -3 1", "\n# a\\",
            ][..]), 0..30),
            separators in prop::collection::vec(select(&[" ", " ", "  ", "\t", ""][..]), 30),
        ) {
            let text: String = words.iter().zip(&separators).flat_map(|(word, space)| [*word, space]).collect();
            agrees(&text);
            agrees(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\n{text}"));
        }
    }
}
