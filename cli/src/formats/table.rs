//! Points in text, one to a line: CSV and XYZ.
//!
//! Numbers stand between commas, semicolons or white space. Empty lines and those that begin with `#` or `//` are passed
//! over. The first other line may be a header, which says where x, y and z, nx, ny and nz, and triangle, u and v stand;
//! without one the first six come in this order, if there are exactly two, three or six of them, and otherwise the first
//! three numbers are x, y and z.

use std::io::{self, Write};

use azulejo::SurfaceSamples;

use super::{Coordinates, PointSet, shortened};

/// The columns that are kept as floats.
const NAMES: [&str; 8] = ["x", "y", "z", "nx", "ny", "nz", "u", "v"];

/// What is known after the first line that is no comment.
struct Columns {
    /// How many there are, and the number of the line that says so.
    width: usize,
    line: usize,
    /// Where those of [`NAMES`] are.
    places: [Option<usize>; NAMES.len()],
    /// Where the number of the triangle is.
    triangle: Option<usize>,
}

pub fn parse(bytes: &[u8], coordinates: Coordinates) -> Result<PointSet, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        format!("line {line}: is no text in UTF-8")
    })?;
    let mut set = PointSet::default();
    let mut columns = None;
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.trim().trim_start_matches('\u{feff}');
        if content.is_empty() || content.starts_with('#') || content.starts_with("//") {
            continue;
        }
        let words = words(content);
        let at = |reason: String| format!("line {line}: {reason}");
        let columns = match &columns {
            Some(columns) => columns,
            None => {
                let (found, is_header) = Columns::of(&words, line, coordinates).map_err(at)?;
                let found = columns.insert(found);
                if is_header {
                    continue;
                }
                found
            }
        };
        let numbers = columns.read(&words).map_err(at)?;
        set.positions.push([numbers[0], numbers[1], numbers[2]]);
        if columns.has_normals() {
            set.normals.push([numbers[3], numbers[4], numbers[5]]);
        }
        if let Some(place) = columns.on_mesh() {
            let (triangles, barycentrics) = set.on_mesh.get_or_insert_default();
            let no_number = |_| at(format!("{:?} is not the number of a triangle", shortened(words[place])));
            triangles.push(words[place].parse().map_err(no_number)?);
            barycentrics.push([numbers[6], numbers[7]]);
        }
    }
    Ok(set)
}

/// What stands between the separators of a line.
fn words(line: &str) -> Vec<&str> {
    match [',', ';'].into_iter().find(|&separator| line.contains(separator)) {
        Some(separator) => line.split(separator).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

impl Columns {
    /// The columns by the first line, and whether it is a header.
    fn of(words: &[&str], line: usize, coordinates: Coordinates) -> Result<(Self, bool), String> {
        let width = words.len();
        let is_header = words.iter().all(|word| word.parse::<f64>().is_err());
        let named = |name: &str| {
            let is = |word: &&str| is_header && word.trim_matches('"').eq_ignore_ascii_case(name);
            words.iter().position(is)
        };
        let places = if is_header {
            NAMES.map(named)
        } else {
            let known = if width == 6 { 6 } else { width.min(3) };
            std::array::from_fn(|i| (i < known).then_some(i))
        };
        match places[..coordinates.count()].iter().position(Option::is_none) {
            Some(missing) if is_header => Err(format!("the header names no column {}", NAMES[missing])),
            Some(_) => Err(format!("has {width} columns, and {} are needed", coordinates.count())),
            None => Ok((Self { width, line, places, triangle: named("triangle") }, is_header)),
        }
    }

    fn has_normals(&self) -> bool {
        self.places[3..6].iter().all(Option::is_some)
    }

    /// The column of the triangles, if there are barycentrics as well.
    fn on_mesh(&self) -> Option<usize> {
        self.triangle.filter(|_| self.places[6..].iter().all(Option::is_some))
    }

    /// The numbers of a line; 0 where there is no column.
    fn read(&self, words: &[&str]) -> Result<[f32; NAMES.len()], String> {
        if words.len() != self.width {
            return Err(format!("has {} columns, and line {} has {}", words.len(), self.line, self.width));
        }
        let mut numbers = [0.0f32; NAMES.len()];
        for (number, place) in numbers.iter_mut().zip(self.places) {
            let Some(place) = place else { continue };
            *number = words[place].parse().map_err(|_| format!("{:?} is not a number", shortened(words[place])))?;
            if !number.is_finite() {
                return Err(format!("{:?} is not finite as a float", shortened(words[place])));
            }
        }
        Ok(numbers)
    }
}

pub fn write_csv_plane(writer: &mut impl Write, points: &[[f32; 2]]) -> io::Result<()> {
    writeln!(writer, "x,y")?;
    points.iter().try_for_each(|[x, y]| writeln!(writer, "{x},{y}"))
}

pub fn write_csv_surface(writer: &mut impl Write, samples: &SurfaceSamples, normals: &[[f32; 3]]) -> io::Result<()> {
    writeln!(writer, "x,y,z,nx,ny,nz,triangle,u,v")?;
    (0..samples.len()).try_for_each(|i| {
        let ([x, y, z], [nx, ny, nz], [u, v]) = (samples.positions[i], normals[i], samples.barycentrics[i]);
        writeln!(writer, "{x},{y},{z},{nx},{ny},{nz},{},{u},{v}", samples.triangles[i])
    })
}

pub fn write_xyz_plane(writer: &mut impl Write, points: &[[f32; 2]]) -> io::Result<()> {
    points.iter().try_for_each(|[x, y]| writeln!(writer, "{x} {y} 0"))
}

pub fn write_xyz_surface(writer: &mut impl Write, positions: &[[f32; 3]], normals: &[[f32; 3]]) -> io::Result<()> {
    std::iter::zip(positions, normals)
        .try_for_each(|([x, y, z], [nx, ny, nz])| writeln!(writer, "{x} {y} {z} {nx} {ny} {nz}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, coordinates: Coordinates) -> Result<PointSet, String> {
        parse(text.as_bytes(), coordinates)
    }

    #[test]
    fn separators_comments_and_headers_are_as_people_write_them() {
        let expected = [[1.0, 2.5, 0.0], [-3.0, 4e-3, 0.0]];
        for text in [
            "1 2.5\n-3 4e-3\n",
            "# a comment\n\n 1,2.5\r\n// another\r\n-3 , .004",
            "x;y\n1;2.5\n-3;0.004\n",
            "\u{feff}\"id\",\"Y\",\"X\"\na,2.5,1\nb,4e-3,-3\n",
            "1\t2.5\n-3\t 4e-3\n",
        ] {
            assert_eq!(read(text, Coordinates::Plane).unwrap().positions, expected, "{text}");
        }
        let set = read("1 2 3 0 0 1\n", Coordinates::Space).unwrap();
        assert_eq!((&set.positions[..], &set.normals[..]), (&[[1.0, 2.0, 3.0]][..], &[[0.0, 0.0, 1.0]][..]));
        let set = read("1 2 3 255 0\n", Coordinates::Space).unwrap();
        assert_eq!((set.positions.len(), set.normals.len()), (1, 0));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, coordinates, said) in [
            ("1 2\n# no\n3 four\n", Coordinates::Plane, "line 3: \"four\" is not a number"),
            ("1 2\n\n3\n", Coordinates::Plane, "line 3: has 1 columns, and line 1 has 2"),
            ("1 2\n3 4 5\n", Coordinates::Plane, "line 2: has 3 columns, and line 1 has 2"),
            ("1 2\n", Coordinates::Space, "line 1: has 2 columns, and 3 are needed"),
            ("7\n", Coordinates::Plane, "line 1: has 1 columns, and 2 are needed"),
            ("x,z\n1,2\n", Coordinates::Plane, "line 1: the header names no column y"),
            ("#\nx y\n1 2\n", Coordinates::Space, "line 2: the header names no column z"),
            ("1 2\n3 1e99\n", Coordinates::Plane, "line 2: \"1e99\" is not finite as a float"),
            ("1 2\nnan 1\n", Coordinates::Plane, "line 2: \"nan\" is not finite as a float"),
            ("1, 2\n3,\n", Coordinates::Plane, "line 2: \"\" is not a number"),
            ("x,y,triangle,u,v\n1,2,-3,0,0\n", Coordinates::Plane, "line 2: \"-3\" is not the number of a triangle"),
        ] {
            assert_eq!(read(text, coordinates).unwrap_err(), said, "{text}");
        }
        let said = parse(b"1 2\n\xff\xfe", Coordinates::Plane).unwrap_err();
        assert_eq!(said, "line 2: is no text in UTF-8");
        assert!(read("# nothing\n", Coordinates::Plane).unwrap().positions.is_empty());
    }

    #[test]
    fn what_is_written_is_read_again_bit_by_bit() {
        let points = [[0.1f32, 1.0 / 3.0], [1e-30, -7e20]];
        let (mut csv, mut xyz) = (Vec::new(), Vec::new());
        write_csv_plane(&mut csv, &points).unwrap();
        write_xyz_plane(&mut xyz, &points).unwrap();
        for text in [csv, xyz] {
            assert_eq!(parse(&text, Coordinates::Plane).unwrap().plane_positions(), points);
        }
    }
}
