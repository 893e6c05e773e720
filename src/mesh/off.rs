//! OFF files (Object File Format, Geomview), as text: a header, numbers of vertices and faces, vertices, polygons.
//!
//! The letters before `OFF` announce what else a vertex has, behind its position: `N` a normal, which is read; `C` a colour
//! and `ST` texture coordinates, which are not. Colours of faces, and numbers of edges, are ignored. There is no kept crate
//! for the format.

use crate::mesh::load::Soup;
use crate::mesh::source::Source;
use crate::mesh::text::{Float, next_number, next_vector, shown, skip_blanks, split_line, split_word};

/// True if a file without a name looks like OFF.
pub(super) fn is_likely(source: &mut Source) -> bool {
    let (word, _) = split_word(source.at_least(16).trim_ascii_start());
    Header::of(word).is_some()
}

/// Vertices, triangles and normals, or the defect of the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let Reader { positions, normals, triangles, .. } = read(source)?;
    Ok(Soup { positions, normals, triangles, ..Default::default() })
}

/// The vertices in doubles, or the defect of the file.
pub(super) fn doubles(source: &mut Source) -> Result<Vec<[f64; 3]>, String> {
    Ok(read(source)?.positions)
}

/// The first word.
struct Header {
    has_normals: bool,
}

impl Header {
    fn of(word: &[u8]) -> Option<Self> {
        let letters = word.strip_suffix(b"OFF")?;
        let rest = letters.strip_prefix(b"ST").unwrap_or(letters);
        let rest = rest.strip_prefix(b"C").unwrap_or(rest);
        let (has_normals, rest) = rest.strip_prefix(b"N").map_or((false, rest), |rest| (true, rest));
        rest.is_empty().then_some(Self { has_normals })
    }
}

/// The part of a file that has been read.
struct Reader<T> {
    /// None before the first word.
    header: Option<Header>,
    /// The numbers of vertices and of faces, once they are known.
    counts: Option<[u64; 2]>,
    positions: Vec<[T; 3]>,
    normals: Vec<[f32; 3]>,
    faces: u64,
    triangles: Vec<[u32; 3]>,
}

fn read<T: Float + Copy + Default>(source: &mut Source) -> Result<Reader<T>, String> {
    let mut reader =
        Reader { header: None, counts: None, positions: vec![], normals: vec![], faces: 0, triangles: vec![] };
    let mut number = 0;
    while let Some(lines) = source.whole_lines() {
        let (count, mut rest) = (lines.len(), lines);
        while !rest.is_empty() {
            let line;
            (line, rest) = split_line(rest);
            number += 1;
            let content = skip_blanks(line.split(|&byte| byte == b'#').next().unwrap_or_default()).trim_ascii_end();
            if !content.is_empty() {
                reader.line(content).map_err(|problem| format!("line {number}: {problem}"))?;
            }
        }
        source.skip(count);
    }
    reader.finished()
}

/// The defect of a word that should be a number.
fn problem(word: &[u8]) -> String {
    if word.is_empty() { "too few numbers".to_owned() } else { format!("{} is not a number", shown(word)) }
}

/// The next whole number of a line, and the text after it.
fn whole(text: &[u8]) -> Result<(u64, &[u8]), String> {
    let (number, rest): (f64, _) = next_number(text).map_err(problem)?;
    let whole = number as u64;
    if whole as f64 == number { Ok((whole, rest)) } else { Err(format!("{number} is no count or index")) }
}

impl<T: Float + Copy + Default> Reader<T> {
    /// Reads a line that is not empty.
    fn line(&mut self, mut text: &[u8]) -> Result<(), String> {
        let Some(header) = &self.header else {
            let (word, rest) = split_word(text);
            let header = Header::of(word).ok_or_else(|| format!("{} is not the header OFF", shown(word)))?;
            self.header = Some(header);
            text = skip_blanks(rest);
            if text.eq_ignore_ascii_case(b"BINARY") {
                return Err("binary OFF is not read: save it as text".to_owned());
            }
            // The counts may follow at once.
            return if text.is_empty() { Ok(()) } else { self.line(text) };
        };
        match self.counts {
            None => {
                let (vertices, rest) = whole(text)?;
                self.counts = Some([vertices, whole(rest)?.0]);
            }
            Some([vertices, _]) if (self.positions.len() as u64) < vertices => {
                let (position, rest) = next_vector(text).map_err(problem)?;
                if header.has_normals {
                    self.normals.push(next_vector(rest).map_err(problem)?.0);
                }
                self.positions.push(position);
            }
            Some([_, faces]) if self.faces < faces => {
                self.face(text)?;
                self.faces += 1;
            }
            Some(_) => {}
        }
        Ok(())
    }

    /// Reads the corners of a face, which becomes a fan.
    fn face(&mut self, text: &[u8]) -> Result<(), String> {
        let (count, mut rest) = whole(text)?;
        let (mut first, mut previous) = (0, 0);
        for i in 0..count {
            let index;
            (index, rest) = whole(rest)?;
            let vertices = self.positions.len();
            let corner = u32::try_from(index).ok().filter(|&corner| (corner as usize) < vertices);
            let corner = corner.ok_or_else(|| format!("vertex {index}, of {vertices}"))?;
            match i {
                0 => first = corner,
                1 => {}
                _ => self.triangles.push([first, previous, corner]),
            }
            previous = corner;
        }
        Ok(())
    }

    fn finished(self) -> Result<Self, String> {
        let [vertices, faces] = self.counts.ok_or("has no numbers of vertices and faces")?;
        let found = self.positions.len() as u64;
        if found < vertices {
            return Err(format!("the header announces {vertices} vertices, but there are {found}"));
        }
        if self.faces < faces {
            return Err(format!("the header announces {faces} faces, but there are {}", self.faces));
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn parsed(text: &str) -> Result<Soup, String> {
        parse(&mut Source::new(&mut Cursor::new(text.as_bytes()), text.len() as u64))
    }

    #[test]
    fn polygons_are_fans_and_all_else_is_ignored() {
        let body = "# a square and a triangle\n0 0 0\n1 0 0 # corner\n\n1 1 .5\n0 1 0\n4 0 1 2 3 255 0 0\n3  0 2 3\n";
        for header in ["OFF\n4 2 5\n", "  OFF 4 2 0\n", "OFF # text\n4 2\n"] {
            let soup = parsed(&format!("{header}{body}")).unwrap();
            assert_eq!(soup.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5], [0.0, 1.0, 0.0]], "{header}");
            assert_eq!(soup.triangles, [[0, 1, 2], [0, 2, 3], [0, 2, 3]], "{header}");
            assert!(soup.normals.is_empty());
        }
        let soup = parsed("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 1 0\n3 0 1 2").unwrap();
        assert_eq!(soup.normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        let coloured = parsed("STCNOFF\n1 0 0\n0 0 0 0 0 1 .5 .5 .5 1 0 0\n").unwrap();
        assert_eq!((coloured.positions.len(), coloured.normals.len()), (1, 1));
    }

    #[test]
    fn broken_files_are_refused_with_the_line() {
        let reason = |text: &str| parsed(text).err().unwrap();
        assert_eq!(reason(""), "has no numbers of vertices and faces");
        assert_eq!(reason("COG\n"), "line 1: \"COG\" is not the header OFF");
        assert_eq!(reason("OFF BINARY\n"), "line 1: binary OFF is not read: save it as text");
        assert_eq!(reason("OFF\n1 1 0\n0 0\n"), "line 3: too few numbers");
        assert_eq!(reason("OFF\n1 1 0\n0 0 o\n"), "line 3: \"o\" is not a number");
        assert_eq!(reason("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "line 4: vertex 1, of 1");
        assert_eq!(reason("OFF\n-1 1 0\n"), "line 2: -1 is no count or index");
        assert_eq!(reason("OFF\n2 1 0\n0 0 0\n"), "the header announces 2 vertices, but there are 1");
        assert_eq!(reason("OFF\n1 4000000000 0\n0 0 0\n"), "the header announces 4000000000 faces, but there are 0");
    }
}
