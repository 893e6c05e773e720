//! PLY files: sets of the plane (`x y`), samples of a surface (`x y z nx ny nz triangle u v`), meshes.
//!
//! A set of the plane names its domain in a comment, `domain <x0> <y0> <x1> <y1> periodic|bounded`: points alone do
//! not tell the period of a torus. Files without that comment are read too.

use std::io::{self, Write};

use azulejo::{Boundary, Domain, SurfaceSamples};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, PropertyAccess, PropertyAccessResult};

use crate::formats::{Coordinates, PointSet};
use crate::output::Output;

/// The properties of a vertex that are kept as floats.
const NAMES: [&str; 8] = ["x", "y", "z", "nx", "ny", "nz", "u", "v"];

/// A vertex, of which only some numbers are kept. A coordinate that the file has as an integer type counts too.
#[derive(Default)]
struct Vertex {
    floats: [f32; NAMES.len()],
    triangle: Option<u32>,
}

impl Vertex {
    /// For every type of number that a file may hold.
    fn set(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        let Some(place) = NAMES.iter().position(|&known| known == name) else {
            return PropertyAccessResult::Ignored;
        };
        self.floats[place] = value;
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

/// The vertices of a PLY file, text or binary, in any order of properties.
pub fn parse(bytes: &[u8], coordinates: Coordinates) -> Result<PointSet, String> {
    // The reader's messages go on with what it had hoped for, line after line.
    let explain = |error: ParseError| {
        error.to_string().lines().next().unwrap_or_default().trim_end_matches('.').replacen("Line", "line", 1)
    };
    if !bytes.starts_with(b"ply") {
        return Err("is no PLY file: it does not begin with \"ply\"".to_owned());
    }
    let mut reader = Reader::new(bytes);
    let parser = Parser::<Vertex>::new();
    let header = parser.read_header(&mut reader).map_err(explain)?;
    let (first, vertex) = header.elements.first().ok_or("no element in the header")?;
    let has = |names: &[&str]| names.iter().all(|&name| vertex.properties.contains_key(name));
    if first != "vertex" || !has(&NAMES[..coordinates.count()]) {
        return Err(format!("the first element is not a vertex with {}", NAMES[..coordinates.count()].join(", ")));
    }
    let vertices = parser.read_payload_for_element(&mut reader, vertex, &header).map_err(explain)?;
    if let Some(i) = vertices.iter().position(|vertex| !vertex.floats.iter().all(|x| x.is_finite())) {
        return Err(format!("vertex {i} is {:?}, not finite", &vertices[i].floats));
    }
    let is_on_mesh = has(&["triangle", "u", "v"]);
    let triangles = vertices.iter().map(|vertex| vertex.triangle).collect::<Option<Vec<u32>>>().filter(|_| is_on_mesh);
    Ok(PointSet {
        positions: part(&vertices, 0),
        normals: if has(&NAMES[3..6]) { part(&vertices, 3) } else { Vec::new() },
        on_mesh: triangles.map(|triangles| (triangles, part(&vertices, 6))),
        domain: named_domain(&header),
    })
}

/// Some of the numbers of each vertex.
fn part<const N: usize>(vertices: &[Vertex], from: usize) -> Vec<[f32; N]> {
    vertices.iter().map(|vertex| std::array::from_fn(|axis| vertex.floats[from + axis])).collect()
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
pub fn write_plane(output: &Output, domain: &Domain, points: &[[f32; 2]]) -> azulejo::Result<()> {
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
pub fn write_surface(output: &Output, samples: &SurfaceSamples, normals: &[[f32; 3]]) -> azulejo::Result<()> {
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
pub fn write_mesh(output: &Output, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> azulejo::Result<()> {
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
