//! PLY files: sets of the plane (`x y z`, where z is 0) and of a cuboid (`x y z`, and `radius` where radii differ), samples of a surface (`x y z nx ny nz triangle u v`, and `radius`
//! where radii differ), both with `rank` in progressive order and `class` where there are several; meshes.
//!
//! A set of the plane names its domain in a comment, `domain <x0> <y0> <x1> <y1> periodic|bounded`, one of a cuboid as
//! `<x0> <y0> <z0> <x1> <y1> <z1>`: points alone do not tell the period of a torus. Files without that comment are read too.

use std::fmt::Display;
use std::io::{self, Write};

use azulejo::mesh::ply::Ply;
use azulejo::{Boundary, Domain};

use crate::formats::columns::{Column, write_position};
use crate::formats::points::PointTable;
use crate::formats::set::{self, Columns, NAMES, PointSet};
use crate::formats::surface::SurfaceTable;
use crate::output::Output;

/// The vertices of a PLY file, text or binary, in any order of properties.
pub fn parse(bytes: &[u8]) -> Result<PointSet, String> {
    let is_kept = |property: &str| NAMES.contains(&property) || property == "triangle";
    let ply = Ply::read(bytes, |element, property| element == "vertex" && is_kept(property))?;
    let vertices = ply.element("vertex").ok_or("has no vertices")?;
    let columns =
        Columns::find(|name| vertices.numbers(name)).map_err(|missing| format!("vertices have no {missing}"))?;
    let mut points = columns.empty_set();
    for i in 0..vertices.count() {
        let at = |problem| format!("vertex {i}: {problem}");
        let numbers = columns.floats.map(|column| column.map_or(0.0, |column| column[i]));
        let triangle = columns.on_mesh().map_or(Ok(0), |column| set::triangle(column[i])).map_err(at)?;
        points.push(numbers, triangle).map_err(at)?;
    }
    points.domain = named_domain(ply.comments());
    Ok(points)
}

/// The positions of the vertices, in the plane z = 0 where there is no z.
pub fn positions(bytes: &[u8]) -> Result<Vec<[f64; 3]>, String> {
    let ply = Ply::read(bytes, |element, property| element == "vertex" && ["x", "y", "z"].contains(&property))?;
    let vertices = ply.element("vertex").ok_or("has no vertices")?;
    let [x, y, z] = ["x", "y", "z"].map(|name| vertices.numbers(name));
    let columns = [Some(x.ok_or("vertices have no x")?), Some(y.ok_or("vertices have no y")?), z];
    let position = |i: usize| columns.map(|column| column.map_or(0.0, |column| column[i]));
    Ok((0..vertices.count()).map(position).collect())
}

/// The domain of the header's comments, if one is there and is a rectangle.
fn named_domain(comments: &[String]) -> Option<Domain> {
    comments.iter().find_map(|comment| {
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

/// Writes a set of the plane or of a cuboid with its domain and all that is known of its points.
pub fn write_points<const D: usize>(output: &Output, domain: &Domain<D>, table: &PointTable<D>) -> azulejo::Result<()> {
    let [min, max] = [domain.min, domain.max].map(|corner| corner.map(|x| x.to_string()).join(" "));
    let boundary = match domain.boundary {
        Boundary::Periodic => "periodic",
        Boundary::Bounded => "bounded",
    };
    // Other programs read no vertices without z.
    const PROPERTIES: [&str; 3] = ["float x", "float y", "float z"];
    output.write(|writer| {
        let comment = format!("comment domain {min} {max} {boundary}\n");
        write_header(writer, &comment, table.points.len(), &PROPERTIES, table.more_columns())?;
        table.write_binary::<3>(writer)
    })
}

/// Writes samples of a surface with all that is known of them.
pub fn write_surface(output: &Output, table: &SurfaceTable) -> azulejo::Result<()> {
    const PROPERTIES: [&str; 9] =
        ["float x", "float y", "float z", "float nx", "float ny", "float nz", "uint triangle", "float u", "float v"];
    output.write(|writer| {
        let properties = PROPERTIES.map(|property| match property {
            "float x" | "float y" | "float z" if table.has_origin() => property.replace("float", "double"),
            _ => property.to_owned(),
        });
        write_header(writer, "", table.samples.len(), &properties, table.more_columns())?;
        table.write_binary(writer)
    })
}

/// Writes a triangle mesh, with faces as `vertex_indices`; around an origin, with vertices in doubles.
pub fn write_mesh(
    output: &Output,
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    origin: [f64; 3],
) -> azulejo::Result<()> {
    let float = if origin == [0.0; 3] { "float" } else { "double" };
    output.write(|writer| {
        writeln!(writer, "ply\nformat binary_little_endian 1.0\nelement vertex {}", positions.len())?;
        writeln!(
            writer,
            "property {float} x\nproperty {float} y\nproperty {float} z\nelement face {}",
            triangles.len()
        )?;
        writeln!(writer, "property list uchar uint vertex_indices\nend_header")?;
        positions.iter().try_for_each(|&position| write_position(writer, position, origin))?;
        triangles.iter().try_for_each(|triangle| {
            writer.write_all(&[3])?;
            triangle.iter().try_for_each(|index| writer.write_all(&index.to_le_bytes()))
        })
    })
}

fn write_header(
    writer: &mut impl Write,
    comment: &str,
    count: usize,
    properties: &[impl Display],
    mut more: impl Iterator<Item = Column>,
) -> io::Result<()> {
    write!(writer, "ply\nformat binary_little_endian 1.0\n{comment}element vertex {count}\n")?;
    properties.iter().try_for_each(|property| writeln!(writer, "property {property}"))?;
    more.try_for_each(|column| writeln!(writer, "property {} {}", column.ply_type(), column.name))?;
    writeln!(writer, "end_header")
}
