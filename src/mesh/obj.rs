//! OBJ files: vertices, faces and normals of corners.
//!
//! Not by a crate: tobj 4 panics on broken texture and normal indices, gives a corner without a normal its neighbour's,
//! numbers vertices anew for each group and follows `mtllib` to other files. Showing it only what it can take needed more
//! code than reading the three kinds of lines that a mesh is made of.

use std::borrow::Cow;

use crate::mesh::soup::Soup;
use crate::mesh::text::{lines, number, shown, vector, words};

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err("is encoded in UTF-16; save it as UTF-8".to_owned());
    }
    let (mut vertices, mut normals) = (Items::new("vertex"), Items::new("normal"));
    for (line, content) in statements(bytes) {
        let mut words = words(&content);
        let read = match words.next() {
            Some(b"v") => vector(words).map(|vector| vertices.vectors.push(vector)),
            Some(b"vn") => vector(words).map(|vector| normals.vectors.push(vector)),
            Some(b"f") => read_face(words, line, &mut vertices, &mut normals),
            _ => Ok(()),
        };
        read.map_err(|problem| format!("line {line}: {problem}"))?;
    }
    let (positions, triangles) = vertices.finish()?;
    let mut soup = Soup { positions, triangles, ..Default::default() };
    if normals.highest > 0 {
        let (normals, indices) = normals.finish()?;
        (soup.normals, soup.normal_indices) = (normals, Some(indices));
    }
    Ok(soup)
}

/// Vectors, and the three of each triangle.
type Indexed = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// The vectors of one kind, and the three of each triangle.
struct Items {
    name: &'static str,
    vectors: Vec<[f32; 3]>,
    /// Numbers counted from 1; 0 where a corner has none.
    triangles: Vec<[u32; 3]>,
    /// The largest number that a face names, and the first line that names it.
    highest: i64,
    line: usize,
}

impl Items {
    fn new(name: &'static str) -> Self {
        Self { name, vectors: Vec::new(), triangles: Vec::new(), highest: 0, line: 0 }
    }

    /// The number that a corner names, counted from 1; 0 for none. Negative ones count back from the last so far, and
    /// positive ones may be of lines that follow.
    fn resolve(&mut self, word: &[u8], line: usize) -> Result<u32, String> {
        if word.is_empty() {
            return Ok(0);
        }
        let named: i64 = number(word).ok_or_else(|| format!("{} is not the number of a {}", shown(word), self.name))?;
        let so_far = self.vectors.len() as i64;
        let resolved = if named < 0 { so_far + 1 + named } else { named };
        if named < 0 && resolved < 1 {
            return Err(format!("a face names {} {named}, but there are {so_far} so far", self.name));
        }
        if resolved > self.highest {
            (self.highest, self.line) = (resolved, line);
        }
        Ok(u32::try_from(resolved).unwrap_or(u32::MAX))
    }

    /// The vectors, and the three of each triangle, counted from 0. One more vector, zero and behind all others, stands
    /// for none.
    fn finish(mut self) -> Result<Indexed, String> {
        let count = self.vectors.len();
        if self.highest > count as i64 {
            let Self { name, highest, line, .. } = self;
            return Err(format!("line {line}: a face names {name} {highest}, but there are {count}"));
        }
        let corners = self.triangles.as_flattened_mut();
        if corners.contains(&0) {
            self.vectors.push([0.0; 3]);
        }
        corners.iter_mut().for_each(|number| *number = number.checked_sub(1).unwrap_or(count as u32));
        Ok((self.vectors, self.triangles))
    }
}

/// Reads the corners `vertex/texture/normal` of a polygon, and cuts it into a fan.
fn read_face<'a>(
    words: impl Iterator<Item = &'a [u8]>,
    line: usize,
    vertices: &mut Items,
    normals: &mut Items,
) -> Result<(), String> {
    let mut corners = Vec::new();
    for corner in words {
        let mut parts = corner.split(|&byte| byte == b'/');
        let [vertex, _, normal] = [(); 3].map(|()| parts.next().unwrap_or_default());
        if parts.next().is_some() {
            return Err(format!("{} is not the corner of a face", shown(corner)));
        }
        let vertex = vertices.resolve(vertex, line)?;
        if vertex == 0 {
            return Err(format!("a face names vertex 0, but there are {}", vertices.vectors.len()));
        }
        corners.push([vertex, normals.resolve(normal, line)?]);
    }
    let [first, rest @ ..] = &corners[..] else { return Err("a face without corners".to_owned()) };
    for pair in rest.windows(2) {
        let [a, b, c] = [*first, pair[0], pair[1]];
        vertices.triangles.push([a[0], b[0], c[0]]);
        normals.triangles.push([a[1], b[1], c[1]]);
    }
    Ok(())
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
