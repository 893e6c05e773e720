//! OBJ files, by the crate tobj.
//!
//! tobj is shown vertices and faces only. That keeps the vertices of all groups in one list and the faces in their
//! order, follows no `mtllib` to other files, admits comments in any encoding, and spares tobj's handling of texture
//! coordinates and normals, which panics on some broken files.

use std::io::{BufRead, Read, Result as IoResult};

use super::Soup;

/// Vertices and triangles, or what is wrong with the file.
pub(super) fn parse(bytes: &[u8]) -> Soup {
    let options =
        tobj::LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..Default::default() };
    let mut lines = GeometryLines { rest: bytes, line: Vec::new(), given: 0, number: 0 };
    let parsed = tobj::load_obj_buf(&mut lines, &options, |_| Err(tobj::LoadError::MaterialParseError));
    let (models, _) = parsed.map_err(|error| {
        use tobj::LoadError::{FaceVertexOutOfBounds, InvalidPolygon};
        match error {
            // These are found at the end, when the faces are put together.
            FaceVertexOutOfBounds | InvalidPolygon => error.to_string(),
            _ => format!("line {}: {error}", lines.number),
        }
    })?;
    let Some(model) = models.into_iter().next() else { return Err("no faces".to_owned()) };
    let positions = model.mesh.positions.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    let triangles = model.mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    Ok((positions, triangles))
}

/// The lines of a file that hold vertices and faces.
struct GeometryLines<'a> {
    rest: &'a [u8],
    /// The line that is being given, of which the first `given` bytes are gone.
    line: Vec<u8>,
    given: usize,
    /// The number of that line, counted from 1.
    number: usize,
}

impl GeometryLines<'_> {
    /// Moves on to the next line of geometry; past the last one the line is empty.
    fn advance(&mut self) {
        self.line.clear();
        self.given = 0;
        while self.line.is_empty() && !self.rest.is_empty() {
            let end = self.rest.iter().position(|&byte| byte == b'\n').map_or(self.rest.len(), |at| at + 1);
            let (line, rest) = self.rest.split_at(end);
            self.rest = rest;
            self.number += 1;
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            let kept = match words.next() {
                // x, y, z, and a weight if that is all there is: what follows are colours.
                Some(b"v") if words.clone().count() > 4 => 3,
                Some(b"v" | b"f") => usize::MAX,
                _ => continue,
            };
            self.line.push(line.trim_ascii_start()[0]);
            for word in words.take(kept) {
                self.line.push(b' ');
                self.line.extend(word);
            }
            self.line.push(b'\n');
        }
    }
}

impl BufRead for GeometryLines<'_> {
    fn fill_buf(&mut self) -> IoResult<&[u8]> {
        if self.given == self.line.len() {
            self.advance();
        }
        Ok(&self.line[self.given..])
    }

    fn consume(&mut self, count: usize) {
        self.given += count;
    }
}

impl Read for GeometryLines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> IoResult<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}
