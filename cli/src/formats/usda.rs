//! OpenUSD as text: samples as `UsdGeom.Points`, or as a `PointInstancer` with a prototype for each class.
//!
//! Ranks, classes, triangles and barycentrics are primvars. Ids count the samples: a set in progressive order is thinned by
//! leaving out the ids from some number on (`inactiveIds`, or an array cut there).

use std::fmt::Display;
use std::io::{self, Write};

use super::scene::Scene;

/// Values that are written on one line.
const ROW: usize = 64;

/// Writes samples as points whose widths are their radii: as balls they touch, and do not overlap.
pub fn write_points(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    header(writer)?;
    writeln!(writer, "def Points \"samples\"\n{{")?;
    extent(writer, scene)?;
    array(writer, "int64[] ids", 0..scene.len())?;
    if !scene.normals.is_empty() {
        array(writer, "normal3f[] normals", scene.normals.iter().map(tuple))?;
    }
    array(writer, "point3f[] points", scene.positions.iter().map(tuple))?;
    if let Some(radius) = scene.one_radius() {
        writeln!(writer, "    float[] widths = [{}] (interpolation = \"constant\")", radius as f32)?;
    } else if let Some(widths) = (0..scene.len()).map(|sample| scene.radius(sample)).collect::<Option<Vec<_>>>() {
        interpolated(writer, "float[] widths", widths.into_iter().map(|radius| radius as f32))?;
    }
    primvars(writer, scene)?;
    translation(writer, scene)?;
    writeln!(writer, "}}")
}

/// Writes samples as instances: of balls of diameter 1, one for each class, that stand for what a user puts in their place,
/// scaled by the radius and turned from y to the normal.
pub fn write_instances(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    header(writer)?;
    writeln!(writer, "def PointInstancer \"samples\"\n{{")?;
    array(writer, "int64[] ids", 0..scene.len())?;
    if !scene.normals.is_empty() {
        let rotation = |sample| {
            let [x, y, z, w] = scene.rotation(sample);
            format!("({w:.4}, {x:.4}, {y:.4}, {z:.4})")
        };
        array(writer, "quath[] orientations", (0..scene.len()).map(rotation))?;
    }
    array(writer, "point3f[] positions", scene.positions.iter().map(tuple))?;
    array(writer, "int[] protoIndices", (0..scene.len()).map(|sample| scene.class(sample)))?;
    let prototypes = (0..scene.class_count()).map(|class| format!("</samples/prototypes/class{class}>"));
    writeln!(writer, "    rel prototypes = [{}]", prototypes.collect::<Vec<_>>().join(", "))?;
    if let Some(radii) = (0..scene.len()).map(|sample| scene.radius(sample)).collect::<Option<Vec<_>>>() {
        array(writer, "float3[] scales", radii.into_iter().map(|radius| tuple(&[radius as f32; 3])))?;
    }
    primvars(writer, scene)?;
    translation(writer, scene)?;
    writeln!(writer, "\n    def Scope \"prototypes\"\n    {{")?;
    for class in 0..scene.class_count() {
        writeln!(writer, "        def Sphere \"class{class}\"\n        {{")?;
        writeln!(writer, "            float3[] extent = [(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)]")?;
        writeln!(writer, "            double radius = 0.5\n        }}")?;
    }
    writeln!(writer, "    }}\n}}")
}

/// Files of meshes do not say which axis is up and how long a unit is: y, as is usual in USD, and a metre.
fn header(writer: &mut impl Write) -> io::Result<()> {
    writeln!(writer, "#usda 1.0\n(\n    defaultPrim = \"samples\"\n    doc = \"Blue-noise samples by azulejo\"")?;
    writeln!(writer, "    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n")
}

/// The box around all balls.
fn extent(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    let [low, high] = scene.bounds();
    let most = (0..scene.len()).filter_map(|sample| scene.radius(sample)).fold(0.0, f64::max) as f32;
    let [low, high] = [low.map(|x| x - 0.5 * most), high.map(|x| x + 0.5 * most)];
    writeln!(writer, "    float3[] extent = [{}, {}]", tuple(&low), tuple(&high))
}

fn primvars(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if !scene.barycentrics.is_empty() {
        interpolated(writer, "float2[] primvars:barycentrics", scene.barycentrics.iter().map(tuple))?;
    }
    if !scene.classes.is_empty() {
        interpolated(writer, "int[] primvars:class", scene.classes)?;
    }
    if !scene.ranks.is_empty() {
        let rank = |rank: &f32| if rank.is_finite() { rank.to_string() } else { "inf".to_owned() };
        interpolated(writer, "float[] primvars:rank", scene.ranks.iter().map(rank))?;
    }
    if !scene.triangles.is_empty() {
        interpolated(writer, "int[] primvars:triangle", scene.triangles)?;
    }
    Ok(())
}

fn translation(writer: &mut impl Write, scene: &Scene) -> io::Result<()> {
    if scene.origin == [0.0; 3] {
        return Ok(());
    }
    let [x, y, z] = scene.origin;
    writeln!(writer, "    double3 xformOp:translate = ({x}, {y}, {z})")?;
    writeln!(writer, "    uniform token[] xformOpOrder = [\"xformOp:translate\"]")
}

fn interpolated(writer: &mut impl Write, name: &str, values: impl IntoIterator<Item: Display>) -> io::Result<()> {
    list(writer, name, values)?;
    writeln!(writer, " (interpolation = \"vertex\")")
}

fn array(writer: &mut impl Write, name: &str, values: impl IntoIterator<Item: Display>) -> io::Result<()> {
    list(writer, name, values)?;
    writeln!(writer)
}

fn list(writer: &mut impl Write, name: &str, values: impl IntoIterator<Item: Display>) -> io::Result<()> {
    write!(writer, "    {name} = [")?;
    for (i, value) in values.into_iter().enumerate() {
        let before = match i {
            0 => "",
            _ if i.is_multiple_of(ROW) => ",\n        ",
            _ => ", ",
        };
        write!(writer, "{before}{value}")?;
    }
    write!(writer, "]")
}

fn tuple<const N: usize>(vector: &[f32; N]) -> String {
    format!("({})", vector.map(|x| x.to_string()).join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::points::PointTable;

    fn text(write: fn(&mut Vec<u8>, &Scene) -> io::Result<()>, table: &PointTable) -> String {
        let mut written = Vec::new();
        write(&mut written, &Scene::of_points(table)).unwrap();
        String::from_utf8(written).unwrap()
    }

    #[test]
    fn points_have_widths_ids_and_primvars() {
        let points = [[0.0, 1.0], [2.5, 1e-9]];
        let table = PointTable { ranks: &[f32::INFINITY, 0.5], class_radii: &[0.25], ..PointTable::of(&points) };
        let text = text(write_points, &table);
        for line in [
            "    int64[] ids = [0, 1]",
            "    point3f[] points = [(0, 1, 0), (2.5, 0.000000001, 0)]",
            "    float[] widths = [0.25] (interpolation = \"constant\")",
            "    float[] primvars:rank = [inf, 0.5] (interpolation = \"vertex\")",
            "    float3[] extent = [(-0.125, -0.125, -0.125), (2.625, 1.125, 0.125)]",
        ] {
            assert!(text.lines().any(|other| other == line), "{line}\n{text}");
        }
        assert!(!text.contains("normals") && !text.contains("class"), "{text}");
    }

    #[test]
    fn classes_are_prototypes() {
        let points = [[0.0; 2]; 3];
        let table = PointTable { classes: &[0, 2, 0], class_radii: &[0.5, 1.0, 2.0], ..PointTable::of(&points) };
        let text = text(write_instances, &table);
        for line in [
            "    int[] protoIndices = [0, 2, 0]",
            "    float3[] scales = [(0.5, 0.5, 0.5), (2, 2, 2), (0.5, 0.5, 0.5)]",
            "        def Sphere \"class2\"",
        ] {
            assert!(text.lines().any(|other| other == line), "{line}\n{text}");
        }
        let all = "[</samples/prototypes/class0>, </samples/prototypes/class1>, </samples/prototypes/class2>]";
        assert!(text.contains(all), "{text}");
    }

    #[test]
    fn nothing_is_a_file_too() {
        let table = PointTable::of(&[]);
        assert!(text(write_points, &table).contains("points = []"));
        assert!(text(write_instances, &table).contains("protoIndices = []"));
    }
}
