//! The points of a file as they stand in it, to be copied: everything that a record holds besides its coordinates is
//! kept, in the format of the file, byte for byte. Where columns have names a rank can be added to each record.

use std::io::{self, Write};
use std::ops::Range;

use azulejo::mesh::ply;

use super::table::is_comment;

/// A file as its records: a run of bytes for each point.
#[derive(Debug)]
pub struct Records {
    bytes: Vec<u8>,
    head: Head,
    records: Vec<Range<usize>>,
    /// The bytes after each record.
    separator: &'static [u8],
    /// The form in which ranks are added.
    ranks: Ranks,
}

/// The text before the records.
#[derive(Debug)]
enum Head {
    /// The names of the columns; empty if they have none.
    Names(Vec<u8>),
    /// The header of a PLY file, which has their number.
    Ply(ply::Records),
}

/// The name of the column of ranks.
const RANK: &str = "rank";

/// The form in which ranks are added to records.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ranks {
    /// No ranks can be added: the columns have no names.
    None,
    /// The records have some already.
    Taken,
    /// As text, after this character.
    Text(char),
    /// As floats, little-endian or big-endian.
    Little,
    Big,
}

impl Records {
    /// The vertices of a PLY file. Other elements are left out.
    pub fn of_ply(bytes: Vec<u8>) -> Result<Self, String> {
        let vertices = ply::Records::read(&bytes, "vertex")?;
        let (separator, ranks): (&[u8], _) = match vertices.format() {
            ply::Format::Text => (b"\n", Ranks::Text(' ')),
            ply::Format::LittleEndian => (b"", Ranks::Little),
            ply::Format::BigEndian => (b"", Ranks::Big),
        };
        let ranks = if vertices.has(RANK) { Ranks::Taken } else { ranks };
        let records = vertices.ranges().to_vec();
        Ok(Self { bytes, head: Head::Ply(vertices), records, separator, ranks })
    }

    /// The lines of a table of `count` points, with its header if it has one. Comments are left out.
    pub fn of_table(bytes: Vec<u8>, count: usize) -> Result<Self, String> {
        let is_row = |line: &Range<usize>| {
            let text = String::from_utf8_lossy(&bytes[line.clone()]);
            !is_comment(text.trim_start_matches('\u{feff}').trim())
        };
        let mut records: Vec<_> = lines(&bytes).filter(is_row).collect();
        let (mut head, mut ranks) = (Vec::new(), Ranks::None);
        if records.len() == count + 1 {
            head.extend_from_slice(&bytes[records.remove(0)]);
            head.push(b'\n');
            let names = String::from_utf8_lossy(&head);
            let separator = [',', ';'].into_iter().find(|&separator| names.contains(separator)).unwrap_or(' ');
            let is_rank = |name: &str| name.trim().trim_matches('"') == RANK;
            ranks = if names.split(separator).any(is_rank) { Ranks::Taken } else { Ranks::Text(separator) };
        }
        if records.len() != count {
            return Err(format!("has {} lines for {count} points", records.len()));
        }
        Ok(Self { bytes, head: Head::Names(head), records, separator: b"\n", ranks })
    }

    /// Raw floats.
    pub fn of_raw(bytes: Vec<u8>, count: usize) -> Self {
        let size = bytes.len() / count.max(1);
        let records = (0..count).map(|i| i * size..(i + 1) * size).collect();
        Self { bytes, head: Head::Names(Vec::new()), records, separator: b"", ranks: Ranks::None }
    }

    /// True if the points have a column of ranks already.
    pub fn has_ranks(&self) -> bool {
        self.ranks == Ranks::Taken
    }

    /// Writes a file of some of the points, in this order, each with its rank if there are any and columns have names.
    pub fn write(&self, writer: &mut impl Write, indices: &[u32], ranks: &[f32]) -> io::Result<()> {
        let column = if ranks.is_empty() { Ranks::None } else { self.ranks };
        match (&self.head, column) {
            (Head::Ply(vertices), _) => {
                let added: &[&str] = if matches!(column, Ranks::None | Ranks::Taken) { &[] } else { &[RANK] };
                vertices.write_header(writer, indices.len(), added)?;
            }
            (Head::Names(names), Ranks::Text(separator)) => {
                writer.write_all(names.trim_ascii_end())?;
                writeln!(writer, "{separator}{RANK}")?;
            }
            (Head::Names(names), _) => writer.write_all(names)?,
        }
        (0..).zip(indices).try_for_each(|(i, &index): (usize, _)| {
            let record = &self.bytes[self.records[index as usize].clone()];
            match column {
                Ranks::None | Ranks::Taken => writer.write_all(record)?,
                Ranks::Text(separator) => {
                    writer.write_all(record.trim_ascii_end())?;
                    write!(writer, "{separator}{}", ranks[i])?;
                }
                Ranks::Little => writer.write_all(&[record, &ranks[i].to_le_bytes()].concat())?,
                Ranks::Big => writer.write_all(&[record, &ranks[i].to_be_bytes()].concat())?,
            }
            writer.write_all(self.separator)
        })
    }
}

/// The lines, without their ends.
fn lines(bytes: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let mut next = 0;
    bytes.split_inclusive(|&byte| byte == b'\n').map(move |line| {
        let begin = next;
        next += line.len();
        begin..begin + line.strip_suffix(b"\n").unwrap_or(line).len()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(records: &Records, indices: &[u32]) -> String {
        let mut file = Vec::new();
        records.write(&mut file, indices, &[]).unwrap();
        String::from_utf8_lossy(&file).into_owned()
    }

    fn ranked(records: &Records) -> Vec<u8> {
        let mut file = Vec::new();
        records.write(&mut file, &[1, 0], &[f32::INFINITY, 0.5]).unwrap();
        file
    }

    #[test]
    fn ranks_are_added_where_columns_have_names() {
        let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n";
        let head = header.replace("end_", "property float rank\nend_");
        let of_ply = |header: &str, body: &[u8]| Records::of_ply([header.as_bytes(), body].concat());
        let text = of_ply(header, b"1 \r\n2\n").unwrap();
        assert_eq!(String::from_utf8(ranked(&text)).unwrap(), format!("{head}2 inf\n1 0.5\n"));
        for (format, bytes) in [
            ("little", [f32::INFINITY, 0.5].map(f32::to_le_bytes)),
            ("big", [f32::INFINITY, 0.5].map(f32::to_be_bytes)),
        ] {
            let binary = |header: &str| header.replace("ascii", &format!("binary_{format}_endian"));
            let records = of_ply(&binary(header), b"aaaabbbb").unwrap();
            assert_eq!(ranked(&records), [binary(&head).as_bytes(), b"bbbb", &bytes[0], b"aaaa", &bytes[1]].concat());
        }
        assert!(of_ply(&head, b"1 2\n3 4\n").unwrap().has_ranks() && !text.has_ranks());
        let table = |text: &str| Records::of_table(text.into(), 2).unwrap();
        assert_eq!(ranked(&table("x;y\r\n1;2\n3;4\n")), b"x;y;rank\n3;4;inf\n1;2;0.5\n");
        assert_eq!(ranked(&table("1 2\n3 4\n")), b"3 4\n1 2\n");
        assert!(table("x,rank\n1,2\n3,4\n").has_ranks());
        assert_eq!(ranked(&Records::of_raw(b"aabb".to_vec(), 2)), b"bbaa");
    }

    #[test]
    fn vertices_are_taken_from_between_other_elements() {
        let header = "ply\r\nformat ascii 1.0\ncomment kept\nelement camera 1\nproperty int id\nelement vertex 3\n\
            property float x\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let file = format!("{header}7\n\n0.50 1\n1e0 2 \n-2 003\n3 0 1 2\n");
        let records = Records::of_ply(file.into_bytes()).unwrap();
        assert_eq!(records.records.len(), 3);
        assert_eq!(
            written(&records, &[2, 0]),
            "ply\nformat ascii 1.0\ncomment kept\nelement vertex 2\nproperty float x\nproperty uchar red\nend_header\n\
             -2 003\n0.50 1\n"
        );
        let binary = header.replace("ascii", "binary_big_endian");
        let file = [binary.as_bytes(), b"idid", b"aaaaA", b"bbbbB", b"ccccC", b"rest"].concat();
        let text = written(&Records::of_ply(file.clone()).unwrap(), &[1, 2]);
        assert!(
            text.ends_with("element vertex 2\nproperty float x\nproperty uchar red\nend_header\nbbbbBccccC"),
            "{text}"
        );
        assert_eq!(
            Records::of_ply(file[..file.len() - 5].to_vec()).unwrap_err(),
            "ends after 2 of 3 of element vertex"
        );
        let lists = binary.replace("int id", "list uchar int ids");
        let file = [lists.as_bytes(), b"\x01idid", b"aaaaA", b"bbbbB", b"ccccC", b"rest"].concat();
        assert_eq!(written(&Records::of_ply(file).unwrap(), &[1, 2]), text);
    }

    #[test]
    fn lines_of_tables_keep_what_they_have() {
        let file = "# made by hand\nx;y;name\n\n1;2;a b\r\n3;4;\n5;6;c";
        let records = Records::of_table(file.into(), 3).unwrap();
        assert_eq!(written(&records, &[0, 2]), "x;y;name\n1;2;a b\r\n5;6;c\n");
        assert_eq!(written(&Records::of_table(b"1 2\n3 4\n".to_vec(), 2).unwrap(), &[1]), "3 4\n");
        assert_eq!(Records::of_table(b"1 2\n3 4\n".to_vec(), 4).unwrap_err(), "has 2 lines for 4 points");
        assert_eq!(written(&Records::of_raw(b"aabbcc".to_vec(), 3), &[2, 1]), "ccbb");
    }
}
