//! Points in text, one to a line: CSV and XYZ.
//!
//! Numbers stand between commas or semicolons, whichever the first line of data has, or else between white space. Empty
//! lines and lines that begin with `#` or `//` are comments. The first other line may be a header, which says where x,
//! y and z, nx, ny and nz, and triangle, u and v stand; without one the first six come in this order, if there are
//! exactly two, three or six of them, and otherwise the first three numbers are x, y and z.

use std::io::{self, Write};

use csv::{ReaderBuilder, StringRecord, Trim};

use super::columns::{CLASS, Column, Number};
use super::points::PointTable;
use super::set::{Columns, NAMES, PointSet};
use super::shortened;
use super::surface::SurfaceTable;

pub fn parse(bytes: &[u8]) -> Result<PointSet, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        format!("line {line}: is no text in UTF-8")
    })?;
    let text = text.trim_start_matches('\u{feff}');
    let mut table = Table::default();
    let first = text.lines().find(|line| !is_comment(line.trim())).unwrap_or_default();
    match [',', ';'].into_iter().find(|&separator| first.contains(separator)) {
        Some(separator) => read_separated(text, separator as u8, &mut table)?,
        None => {
            for (line, content) in (1..).zip(text.lines()).filter(|(_, content)| !is_comment(content.trim())) {
                let words: Vec<_> = content.split_whitespace().collect();
                table.add(&words, || line).map_err(|problem| format!("line {line}: {problem}"))?;
            }
        }
    }
    Ok(table.set())
}

pub(super) fn is_comment(line: &str) -> bool {
    line.is_empty() || line.starts_with('#') || line.starts_with("//")
}

/// Reads lines of numbers between commas or the like, perhaps quoted.
fn read_separated(text: &str, separator: u8, table: &mut Table) -> Result<(), String> {
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut record = StringRecord::new();
    // The reader's own lines count from the comments before a record.
    let line_before = |byte: u64| 1 + text[..byte as usize].trim_end().matches('\n').count();
    while reader.read_record(&mut record).map_err(|error| error.to_string())? {
        let words: Vec<_> = record.iter().collect();
        if is_comment(words[0]) && (words.len() == 1 || !words[0].is_empty()) {
            continue;
        }
        let line = || line_before(reader.position().byte());
        table.add(&words, line).map_err(|problem| format!("line {}: {problem}", line()))?;
    }
    Ok(())
}

/// The part of a table that has been read.
#[derive(Default)]
struct Table {
    layout: Option<Layout>,
    set: Option<PointSet>,
}

/// The layout that follows from the first line that is not a comment.
struct Layout {
    /// The number of columns, and the number of the line that defines it.
    width: usize,
    line: usize,
    columns: Columns<usize>,
}

impl Table {
    /// Takes one more line, or the header if it is the first and has no number.
    fn add(&mut self, words: &[&str], line: impl Fn() -> usize) -> Result<(), String> {
        let (Some(layout), Some(set)) = (&self.layout, &mut self.set) else {
            let (layout, is_header) = Layout::of(words, line())?;
            self.set = Some(layout.columns.empty_set());
            self.layout = Some(layout);
            return if is_header { Ok(()) } else { self.add(words, line) };
        };
        let (numbers, triangle) = layout.read(words)?;
        set.push(numbers, triangle)
    }

    fn set(self) -> PointSet {
        self.set.unwrap_or_else(|| Columns::<()> { floats: Default::default(), triangle: None }.empty_set())
    }
}

impl Layout {
    /// The columns by the first line, and whether it is a header.
    fn of(words: &[&str], line: usize) -> Result<(Self, bool), String> {
        let width = words.len();
        let is_header = words.iter().all(|word| word.parse::<f64>().is_err());
        let known = if width == 6 { 6 } else { width.min(3) };
        let columns = if is_header {
            let is = |word: &str, name: &str| word.trim_matches('"').eq_ignore_ascii_case(name);
            Columns::find(|name| words.iter().position(|word| is(word, name)))
                .map_err(|missing| format!("the header names no column {missing}"))
        } else {
            Columns::find(|name| NAMES[..known].iter().position(|known| *known == name))
                .map_err(|missing| format!("has {width} columns, and none for {missing}"))
        }?;
        Ok((Self { width, line, columns }, is_header))
    }

    /// The numbers of a line, 0 where there is no column, and the triangle.
    fn read(&self, words: &[&str]) -> Result<([f64; NAMES.len()], u32), String> {
        if words.len() != self.width {
            return Err(format!("has {} columns, and line {} has {}", words.len(), self.line, self.width));
        }
        let mut numbers = [0.0; NAMES.len()];
        for ((number, column), name) in numbers.iter_mut().zip(self.columns.floats).zip(NAMES) {
            let Some(column) = column else { continue };
            *number = match words[column].parse() {
                Ok(number) => number,
                // Classes may have names, as long as no command needs them.
                Err(_) if name == CLASS.name => f64::NAN,
                Err(_) => return Err(format!("{:?} is not a number", shortened(words[column]))),
            };
        }
        let triangle = |column: &usize| {
            let word = words[*column];
            word.parse().map_err(|_| format!("{:?} is not the number of a triangle", shortened(word)))
        };
        Ok((numbers, self.columns.on_mesh().map_or(Ok(0), triangle)?))
    }
}

pub fn write_csv_points<const D: usize>(writer: &mut impl Write, table: &PointTable<D>) -> io::Result<()> {
    write_csv_header(writer, &NAMES[..D].join(","), table.more_columns())?;
    table.points.iter().enumerate().try_for_each(|(i, point)| {
        write!(writer, "{}", point.map(|x| x.to_string()).join(","))?;
        end_csv_row(writer, table.more_numbers(i))
    })
}

pub fn write_csv_surface(writer: &mut impl Write, table: &SurfaceTable) -> io::Result<()> {
    let SurfaceTable { samples, normals, .. } = table;
    write_csv_header(writer, "x,y,z,nx,ny,nz,triangle,u,v", table.more_columns())?;
    (0..samples.len()).try_for_each(|i| {
        let ([x, y, z], [nx, ny, nz], [u, v]) = (table.position(i), normals[i], samples.barycentrics[i]);
        write!(writer, "{x},{y},{z},{nx},{ny},{nz},{},{u},{v}", samples.triangles[i])?;
        end_csv_row(writer, table.more_numbers(i))
    })
}

fn write_csv_header(writer: &mut impl Write, names: &str, mut more: impl Iterator<Item = Column>) -> io::Result<()> {
    write!(writer, "{names}")?;
    more.try_for_each(|column| write!(writer, ",{}", column.name))?;
    writeln!(writer)
}

fn end_csv_row(writer: &mut impl Write, mut more: impl Iterator<Item = Number>) -> io::Result<()> {
    more.try_for_each(|number| write!(writer, ",{number}"))?;
    writeln!(writer)
}

/// Points of the plane have the z 0.
pub fn write_xyz_points<const D: usize>(writer: &mut impl Write, points: &[[f32; D]]) -> io::Result<()> {
    let z = if D == 2 { " 0" } else { "" };
    points.iter().try_for_each(|point| writeln!(writer, "{}{z}", point.map(|x| x.to_string()).join(" ")))
}

pub fn write_xyz_surface(writer: &mut impl Write, table: &SurfaceTable) -> io::Result<()> {
    (0..).zip(table.normals).try_for_each(|(i, [nx, ny, nz])| {
        let [x, y, z] = table.position(i);
        writeln!(writer, "{x} {y} {z} {nx} {ny} {nz}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Vec<[f32; 2]> {
        parse(text.as_bytes()).unwrap().into_plane("").unwrap().points
    }

    #[test]
    fn separators_comments_and_headers_are_as_people_write_them() {
        for text in [
            "1 2.5\n-3 4e-3\n",
            "# a comment\n\n 1,2.5\r\n// another\r\n-3 , .004",
            "// x, y, z\nx;y\n1;2.5\n# 5;6\n\n//7;8\n-3;0.004\n",
            "\u{feff}\"id\",\"Y\",\"X\"\n\"a, b\",2.5,1\nb,4e-3,-3\n",
            "1\t2.5\n-3\t 4e-3\n",
            "x y z\n1 2.5 0\n-3 4e-3 0\n",
        ] {
            assert_eq!(points(text), [[1.0, 2.5], [-3.0, 4e-3]], "{text}");
        }
        let samples = |text: &str| parse(text.as_bytes()).unwrap().into_samples([0.0; 3]).unwrap();
        let set = samples("1 2 3 0 0 1\n");
        assert_eq!((&set.positions[..], &set.normals[..]), (&[[1.0, 2.0, 3.0]][..], &[[0.0, 0.0, 1.0]][..]));
        let set = samples("1 2 3 255 0\n");
        assert_eq!((set.positions.len(), set.normals.len()), (1, 0));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, said) in [
            ("1 2\n# no\n3 four\n", "line 3: \"four\" is not a number"),
            ("1,2\n# no\n\n// no\n3,four\n4,5\n", "line 5: \"four\" is not a number"),
            ("# no\r\n1;2\r\n\r\n3;four", "line 4: \"four\" is not a number"),
            ("1 2\n\n3\n", "line 3: has 1 columns, and line 1 has 2"),
            ("# no\n1,2\n\n3,4,5\n", "line 4: has 3 columns, and line 2 has 2"),
            ("1 2\n3 4 5\n", "line 2: has 3 columns, and line 1 has 2"),
            ("7\n", "line 1: has 1 columns, and none for y"),
            ("x,z\n1,2\n", "line 1: the header names no column y"),
            ("1 2\n3 1e99\n", "line 2: y is inf, not finite"),
            ("1 2\nnan 1\n", "line 2: x is NaN, not finite"),
            ("1, 2\n3,\n", "line 2: \"\" is not a number"),
            ("1, 2\n,\n", "line 2: \"\" is not a number"),
            ("x,y,triangle,u,v\n1,2,-3,0,0\n", "line 2: \"-3\" is not the number of a triangle"),
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap_err(), said, "{text}");
        }
        assert_eq!(parse(b"1 2\n\xff\xfe").unwrap_err(), "line 2: is no text in UTF-8");
        assert!(parse(b"# nothing\n").unwrap().is_empty());
    }

    #[test]
    fn what_is_written_is_read_again_bit_by_bit() {
        let expected = [[0.1f32, 1.0 / 3.0], [1e-30, -7e20]];
        let (mut csv, mut xyz) = (Vec::new(), Vec::new());
        write_csv_points(&mut csv, &PointTable::of(&expected)).unwrap();
        write_xyz_points(&mut xyz, &expected).unwrap();
        for text in [csv, xyz] {
            assert_eq!(points(&String::from_utf8(text).unwrap()), expected);
        }
    }
}
