//! OBJ files: vertices, normals and faces. All other lines are passed over, in whatever encoding they are, and no file
//! that they name is opened. Vertices keep the order of the file, faces too, across groups and objects.
//!
//! Not by a crate. What is wanted of tobj 4 is three kinds of lines, and it had to be shown these alone, with all indices
//! written anew: it panics on some broken ones, gives a corner without a normal that of its neighbour, numbers vertices
//! by first use, and does not say in which line an index is out of range. That was more code than this.

use super::Soup;
use super::text::{lines, number, shown, vector, words};

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Result<Soup, String> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err("is encoded in UTF-16; save it as UTF-8".to_owned());
    }
    let mut content = Content::default();
    let mut joined = Vec::new();
    let mut lines = lines(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)).peekable();
    while let Some((line, part)) = lines.next() {
        let part = part.split(|&byte| byte == b'#').next().unwrap_or_default().trim_ascii();
        // A line that ends with a backslash goes on in the next one.
        let (part, goes_on) = part.strip_suffix(b"\\").map_or((part, false), |part| (part, lines.peek().is_some()));
        if goes_on || !joined.is_empty() {
            joined.extend_from_slice(part);
            joined.push(b' ');
        }
        if !goes_on {
            let whole = if joined.is_empty() { part } else { &joined };
            content.read(whole, line).map_err(|problem| format!("line {line}: {problem}"))?;
            joined.clear();
        }
    }
    content.into_soup()
}

#[derive(Default)]
struct Content {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    /// The corners of each triangle: numbers of vertices and of normals, from 1 on; no normal is 0.
    triangles: Vec<[[u32; 2]; 3]>,
    /// The largest of both that a face has named, and in which line: items may stand behind the faces that name them.
    largest: [(u32, usize); 2],
}

impl Content {
    fn read(&mut self, content: &[u8], line: usize) -> Result<(), String> {
        let mut words = words(content);
        match words.next() {
            Some(b"v") => self.positions.push(vector(words)?),
            Some(b"vn") => self.normals.push(vector(words)?),
            Some(b"f") => {
                let first = words.next().ok_or("a face without corners")?;
                let first = self.corner(first, line)?;
                let mut last = None;
                for word in words {
                    let corner = self.corner(word, line)?;
                    self.triangles.extend(last.replace(corner).map(|last| [first, last, corner]));
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// A corner: `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`.
    fn corner(&mut self, word: &[u8], line: usize) -> Result<[u32; 2], String> {
        let mut parts = word.split(|&byte| byte == b'/');
        let (vertex, _texture, normal) = (parts.next().unwrap_or_default(), parts.next(), parts.next());
        if parts.next().is_some() {
            return Err(format!("{} is not the corner of a face", shown(word)));
        }
        let vertex = resolve(vertex, self.positions.len(), "vertex")?;
        let normal = match normal.unwrap_or_default() {
            b"" | b"0" => 0,
            normal => resolve(normal, self.normals.len(), "normal")?,
        };
        for (largest, number) in self.largest.iter_mut().zip([vertex, normal]) {
            if number > largest.0 {
                *largest = (number, line);
            }
        }
        Ok([vertex, normal])
    }

    fn into_soup(mut self) -> Result<Soup, String> {
        let found = [("vertex", "vertices", self.positions.len()), ("normal", "normals", self.normals.len())];
        for ((largest, line), (name, names, count)) in self.largest.into_iter().zip(found) {
            if largest as usize > count {
                return Err(format!("line {line}: a face names {name} {largest}, but there are {count} {names}"));
            }
        }
        let numbers = |item: usize| self.triangles.iter().map(move |corners| corners.map(|corner| corner[item]));
        let triangles = numbers(0).map(|corners| corners.map(|vertex| vertex - 1)).collect();
        if self.largest[1].0 == 0 {
            return Ok(Soup { positions: self.positions, triangles, ..Default::default() });
        }
        // The last normal stands for those that are missing.
        let missing = self.normals.len() as u32;
        self.normals.push([0.0; 3]);
        let normal_indices = numbers(1).map(|corners| corners.map(|normal| normal.checked_sub(1).unwrap_or(missing)));
        let normal_indices = Some(normal_indices.collect());
        Ok(Soup { positions: self.positions, triangles, normals: self.normals, normal_indices })
    }
}

/// The number, from 1 on, of an item that an index names: from 1 on, or negative and back from the last of the `count`
/// items so far.
fn resolve(index: &[u8], count: usize, name: &str) -> Result<u32, String> {
    let value: i64 = number(index).ok_or_else(|| format!("{} is not the index of a {name}", shown(index)))?;
    let resolved = if value < 0 { value.saturating_add(count as i64 + 1) } else { value };
    let resolved = u32::try_from(resolved).ok().filter(|&resolved| resolved > 0);
    resolved.ok_or_else(|| format!("a face names {name} {value}, but there are {count} so far"))
}
