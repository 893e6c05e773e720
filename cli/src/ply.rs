//! PLY files: sets of the plane (`x y`), samples of a surface (`x y z nx ny nz triangle u v`), meshes.
//!
//! A set of the plane names its domain in a comment, `domain <x0> <y0> <x1> <y1> periodic|bounded`: points alone do
//! not tell the period of a torus. Files without that comment are read too.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;

use azulejo::{Boundary, Domain, Error, Result, SurfaceSamples};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, PropertyAccess, PropertyAccessResult};

use crate::output::Output;

/// What a file of points holds, whoever wrote it.
pub struct PointSet {
    /// Positions; 0 where the file has no z.
    pub positions: Vec<[f32; 3]>,
    /// The domain that the file names.
    pub domain: Option<Domain>,
    /// For each point its triangle and barycentrics, where the file has them.
    pub on_mesh: Option<(Vec<u32>, Vec<[f32; 2]>)>,
}

impl PointSet {
    /// The positions without z.
    pub fn plane_positions(&self) -> Vec<[f32; 2]> {
        self.positions.iter().map(|&[x, y, _]| [x, y]).collect()
    }
}

/// A vertex, of which only some numbers are kept. What the file has as another type counts too.
#[derive(Default)]
struct Vertex {
    position: [f32; 3],
    triangle: Option<u32>,
    uv: [f32; 2],
}

impl Vertex {
    /// For every type of number that a file may hold.
    fn set(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        match name {
            "x" => self.position[0] = value,
            "y" => self.position[1] = value,
            "z" => self.position[2] = value,
            "u" => self.uv[0] = value,
            "v" => self.uv[1] = value,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }
    fn set_char(&mut self, name: &str, value: i8) -> PropertyAccessResult {
        self.set(name, value.into())
    }
    fn set_uchar(&mut self, name: &str, value: u8) -> PropertyAccessResult {
        self.set(name, value.into())
    }
    fn set_short(&mut self, name: &str, value: i16) -> PropertyAccessResult {
        self.set(name, value.into())
    }
    fn set_ushort(&mut self, name: &str, value: u16) -> PropertyAccessResult {
        self.set(name, value.into())
    }
    fn set_int(&mut self, name: &str, value: i32) -> PropertyAccessResult {
        self.set(name, value as f32)
    }
    fn set_uint(&mut self, name: &str, value: u32) -> PropertyAccessResult {
        if name == "triangle" {
            self.triangle = Some(value);
            return PropertyAccessResult::Set;
        }
        self.set(name, value as f32)
    }
    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set(name, value)
    }
    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.set(name, value as f32)
    }
}

/// Reads the vertices of a PLY file, text or binary, in any order of properties.
pub fn read(path: &Path) -> Result<PointSet> {
    let read_error = |source| Error::Io { path: path.into(), source };
    let format_error = |reason: String| Error::Format { path: path.into(), reason };
    // The reader's messages go on with what it had hoped for, line after line.
    let parse_error = |error: ParseError| {
        format_error(error.to_string().lines().next().unwrap_or_default().trim_end_matches('.').to_owned())
    };
    let file = File::open(path).map_err(read_error)?;
    if file.metadata().map_err(read_error)?.is_dir() {
        return Err(read_error(io::ErrorKind::IsADirectory.into()));
    }
    let mut reader = Reader::new(BufReader::with_capacity(1 << 18, file));
    let parser = Parser::<Vertex>::new();
    let header = parser.read_header(&mut reader).map_err(parse_error)?;
    let (first, vertex) = header.elements.first().ok_or_else(|| format_error("no element in the header".to_owned()))?;
    if first != "vertex" || !["x", "y"].iter().all(|&axis| vertex.properties.contains_key(axis)) {
        return Err(format_error("the first element is not a vertex with x and y".to_owned()));
    }
    let vertices = parser.read_payload_for_element(&mut reader, vertex, &header).map_err(parse_error)?;
    if let Some(i) = vertices.iter().position(|vertex| !vertex.position.iter().all(|x| x.is_finite())) {
        return Err(format_error(format!("vertex {i} is {:?}, not finite", vertices[i].position)));
    }
    if vertices.is_empty() {
        return Err(format_error("no points".to_owned()));
    }
    let is_on_mesh = ["triangle", "u", "v"].iter().all(|&name| vertex.properties.contains_key(name));
    let triangles = vertices.iter().map(|vertex| vertex.triangle).collect::<Option<Vec<u32>>>();
    let uvs = || vertices.iter().map(|vertex| vertex.uv).collect();
    Ok(PointSet {
        positions: vertices.iter().map(|vertex| vertex.position).collect(),
        domain: named_domain(&header),
        on_mesh: triangles.filter(|_| is_on_mesh).map(|triangles| (triangles, uvs())),
    })
}

/// The domain of the header's comments, if one is there and is a rectangle.
fn named_domain(header: &Header) -> Option<Domain> {
    header.comments.iter().find_map(|comment| {
        let words: Vec<_> = comment.split_whitespace().collect();
        let ["domain", x0, y0, x1, y1, boundary] = words[..] else { return None };
        let boundary = match boundary {
            "periodic" => Boundary::Periodic,
            "bounded" => Boundary::Bounded,
            _ => return None,
        };
        let number = |word: &str| word.parse::<f64>().ok().filter(|x| x.is_finite());
        let domain = Domain { min: [number(x0)?, number(y0)?], max: [number(x1)?, number(y1)?], boundary };
        domain.extent().iter().all(|&length| length > 0.0).then_some(domain)
    })
}

/// Writes a set of the plane with its domain.
pub fn write_plane(output: &Output, domain: &Domain, points: &[[f32; 2]]) -> Result<()> {
    let ([x0, y0], [x1, y1]) = (domain.min, domain.max);
    let boundary = match domain.boundary {
        Boundary::Periodic => "periodic",
        Boundary::Bounded => "bounded",
    };
    output.write(|writer| {
        let comment = format!("comment domain {x0} {y0} {x1} {y1} {boundary}\n");
        write_header(writer, &comment, points.len(), &["float x", "float y"])?;
        points.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
    })
}

/// Writes samples of a surface with all that is known of them, and with these of their normals.
pub fn write_surface(output: &Output, samples: &SurfaceSamples, normals: &[[f32; 3]]) -> Result<()> {
    const PROPERTIES: [&str; 9] =
        ["float x", "float y", "float z", "float nx", "float ny", "float nz", "uint triangle", "float u", "float v"];
    output.write(|writer| {
        write_header(writer, "", samples.len(), &PROPERTIES)?;
        (0..samples.len()).try_for_each(|i| {
            let vector = samples.positions[i].into_iter().chain(normals[i]);
            vector.into_iter().try_for_each(|x| writer.write_all(&x.to_le_bytes()))?;
            writer.write_all(&samples.triangles[i].to_le_bytes())?;
            samples.barycentrics[i].iter().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
        })
    })
}

/// Writes a triangle mesh, with faces as `vertex_indices`.
pub fn write_mesh(output: &Output, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<()> {
    output.write(|writer| {
        writeln!(writer, "ply\nformat binary_little_endian 1.0\nelement vertex {}", positions.len())?;
        writeln!(writer, "property float x\nproperty float y\nproperty float z\nelement face {}", triangles.len())?;
        writeln!(writer, "property list uchar uint vertex_indices\nend_header")?;
        positions.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))?;
        triangles.iter().try_for_each(|triangle| {
            writer.write_all(&[3])?;
            triangle.iter().try_for_each(|index| writer.write_all(&index.to_le_bytes()))
        })
    })
}

fn write_header(writer: &mut impl Write, comment: &str, count: usize, properties: &[&str]) -> io::Result<()> {
    write!(writer, "ply\nformat binary_little_endian 1.0\n{comment}element vertex {count}\n")?;
    properties.iter().try_for_each(|property| writeln!(writer, "property {property}"))?;
    writeln!(writer, "end_header")
}
