//! Attributes of meshes: numbers that a PLY file has for each vertex or face, and masks in text files.

use std::path::Path;

use azulejo::mesh::Mesh;
use azulejo::mesh::ply::{Ply, triangles_of_faces};
use azulejo::{Error, Result};

use crate::input;

/// The file of a mesh.
pub struct MeshFile<'a> {
    path: &'a Path,
    bytes: Vec<u8>,
}

impl<'a> MeshFile<'a> {
    pub fn read(path: &'a Path) -> Result<Self> {
        Ok(Self { path, bytes: input::bytes(path)? })
    }

    pub fn mesh(&self) -> Result<Mesh> {
        Mesh::parse(self.path, &self.bytes)
    }

    /// A number for each vertex.
    pub fn vertex_values(&self, name: &str) -> Result<Vec<f32>> {
        Ok(self.attribute("vertex", name)?.into_iter().map(|value| value as f32).collect())
    }

    /// The mask of the mesh: for each triangle, whether the number of its face is not 0.
    pub fn face_mask(&self, name: &str) -> Result<Vec<bool>> {
        let numbers = self.attribute("face", name)?;
        let triangles = triangles_of_faces(&self.bytes).map_err(|reason| self.format_error(reason))?;
        let of_face = |(number, triangles): (f64, usize)| std::iter::repeat_n(number != 0.0, triangles);
        Ok(numbers.into_iter().zip(triangles).flat_map(of_face).collect())
    }

    /// An error about an attribute.
    pub fn error(&self, attribute: &str, reason: &str) -> Error {
        self.format_error(format!("attribute {attribute}: {reason}"))
    }

    /// An error about the numbers of the vertices, with the attribute that they are.
    pub fn blame(&self, attribute: Option<&str>, error: Error) -> Error {
        match (attribute, error) {
            (Some(attribute), Error::InvalidArgument { argument: "vertex_radii" | "density", reason }) => {
                self.error(attribute, &reason)
            }
            (_, other) => other,
        }
    }

    fn format_error(&self, reason: String) -> Error {
        Error::Format { path: self.path.into(), reason }
    }

    /// A number for each element of a kind.
    fn attribute(&self, kind: &str, name: &str) -> Result<Vec<f64>> {
        if !self.bytes.starts_with(b"ply") {
            return Err(self.error(name, "only PLY files have attributes"));
        }
        let ply = Ply::read(&self.bytes, |element, property| element == kind && property == name);
        let ply = ply.map_err(|reason| self.format_error(reason))?;
        let element = ply.element(kind);
        let numbers = element.and_then(|element| element.numbers(name)).ok_or_else(|| {
            let known = element.map_or_else(Vec::new, |element| element.properties().collect()).join(", ");
            self.error(name, &format!("element {kind} has no such number, but {known}"))
        })?;
        Ok(numbers.to_vec())
    }
}

/// The numbers of a text file, of which 1 is true and 0 is false.
pub fn mask_of_text(path: &Path) -> Result<Vec<bool>> {
    let bytes = input::bytes(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let entry = |(line, word): (usize, &str)| match word {
        "0" => Ok(false),
        "1" => Ok(true),
        _ => {
            let word: String = word.chars().take(40).collect();
            Err(Error::Format { path: path.into(), reason: format!("line {line}: {word:?} is neither 0 nor 1") })
        }
    };
    let words =
        (1..).zip(text.lines()).flat_map(|(line, content)| content.split_whitespace().map(move |word| (line, word)));
    words.map(entry).collect()
}
