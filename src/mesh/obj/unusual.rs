//! OBJ files of all kinds, by the crate tobj: lines that go on in the next one, numbers and comments in odd places, and
//! what is wrong with a broken file.
//!
//! tobj is shown nothing but vertices and faces: once those of the file, and once its normals in place of the vertices,
//! with the faces by the numbers of their normals. That keeps the faces of all groups in their order, follows no `mtllib`
//! to other files, admits comments in any encoding, distinguishes corners without a normal, and avoids tobj's
//! handling of texture coordinates and normals, which panics on some broken files. As tobj numbers vertices by their
//! first use, the first faces that it sees use all of them, in the order of the file.
//!
//! Both passes are needed: in one pass tobj 4 either merges the indices of positions and normals, so that vertices lose the
//! numbers of the file, or gives a corner without a normal the normal of another. A file without normals is shown once.

use std::borrow::Cow;

use tobj::LoadError::{FaceVertexOutOfBounds, InvalidPolygon};

use crate::mesh::soup::Soup;
use crate::mesh::text::{lines, number, words};

/// What of a file is shown as vertices and faces.
struct View {
    /// What the items are called, that faces name, and the keyword of their lines.
    name: &'static str,
    keyword: &'static [u8],
    /// Which part of a corner, `vertex/texture/normal`, names one.
    part: usize,
    /// Whether corners may name none. One more item, of zeros and behind all others, stands for that.
    is_optional: bool,
}

/// Vectors, and the three of each triangle.
type Indexed = (Vec<[f32; 3]>, Vec<[u32; 3]>);

const VERTICES: View = View { name: "vertex", keyword: b"v", part: 0, is_optional: false };
const NORMALS: View = View { name: "normal", keyword: b"vn", part: 2, is_optional: true };

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
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

    /// The index in a corner of a face; none if there may be none, and is none.
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

    /// Whether a face names an item.
    fn is_named_in(&self, bytes: &[u8]) -> bool {
        let mut faces = statements(bytes).filter(|(_, content)| words(content).next() == Some(b"f"));
        faces.any(|(_, content)| words(&content).skip(1).any(|corner| self.index(corner).is_some()))
    }

    /// The first face that has no corners or names an item that there is not.
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

/// What a file says, line by line, each with its number: without comments and empty lines. A line that ends with a
/// backslash goes on in the next one.
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
