//! The points of a file as they stand in it, to be copied: everything that a record holds besides its coordinates is
//! kept, in the format of the file, byte for byte. Where columns have names a rank can be added to each record.

use std::io::{self, Write};
use std::ops::Range;

use super::table::is_comment;

/// A file as its records: a run of bytes for each point.
#[derive(Debug)]
pub struct Records {
    bytes: Vec<u8>,
    /// The bytes before the records; the number of records belongs between the two parts.
    head: Vec<u8>,
    behind_count: Option<Vec<u8>>,
    records: Vec<Range<usize>>,
    /// The bytes after each record.
    separator: &'static [u8],
    /// The form in which ranks are added.
    ranks: Ranks,
}

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
    /// The vertices of a PLY file, whose header is in order. Other elements are left out.
    pub fn of_ply(bytes: Vec<u8>) -> Result<Self, String> {
        let Header { is_text, is_big, elements, before, behind, length } = Header::of(&bytes)?;
        let vertices = elements.iter().position(|element| element.name == "vertex").ok_or("has no vertices")?;
        let (first, count) = (&elements[..vertices], elements[vertices].count);
        let records: Vec<_> = if is_text {
            let skipped = first.iter().map(|element| element.count).sum();
            lines(&bytes, length)
                .filter(|line| !bytes[line.clone()].trim_ascii().is_empty())
                .skip(skipped)
                .take(count)
                .collect()
        } else {
            let mut start = length;
            for element in first {
                start += element.count * element.size()?;
            }
            let size = elements[vertices].size()?;
            (0..count).map(|i| start + i * size..start + (i + 1) * size).collect()
        };
        if records.len() < count || records.last().is_some_and(|last| last.end > bytes.len()) {
            return Err(format!("ends before its {count} vertices do"));
        }
        let separator: &[u8] = if is_text { b"\n" } else { b"" };
        let ranks = match (elements[vertices].has_ranks, is_text, is_big) {
            (true, ..) => Ranks::Taken,
            (_, true, _) => Ranks::Text(' '),
            (.., true) => Ranks::Big,
            _ => Ranks::Little,
        };
        Ok(Self { bytes, head: before, behind_count: Some(behind), records, separator, ranks })
    }

    /// The lines of a table of `count` points, with its header if it has one. Comments are left out.
    pub fn of_table(bytes: Vec<u8>, count: usize) -> Result<Self, String> {
        let is_row = |line: &Range<usize>| {
            let text = String::from_utf8_lossy(&bytes[line.clone()]);
            !is_comment(text.trim_start_matches('\u{feff}').trim())
        };
        let mut records: Vec<_> = lines(&bytes, 0).filter(is_row).collect();
        let (mut head, mut ranks) = (Vec::new(), Ranks::None);
        if records.len() == count + 1 {
            head.extend_from_slice(&bytes[records.remove(0)]);
            head.push(b'\n');
            let names = String::from_utf8_lossy(&head);
            let separator = [',', ';'].into_iter().find(|&separator| names.contains(separator)).unwrap_or(' ');
            let is_rank = |name: &str| name.trim().trim_matches('"') == "rank";
            ranks = if names.split(separator).any(is_rank) { Ranks::Taken } else { Ranks::Text(separator) };
        }
        if records.len() != count {
            return Err(format!("has {} lines for {count} points", records.len()));
        }
        Ok(Self { bytes, head, behind_count: None, records, separator: b"\n", ranks })
    }

    /// Raw floats.
    pub fn of_raw(bytes: Vec<u8>, count: usize) -> Self {
        let size = bytes.len() / count.max(1);
        let records = (0..count).map(|i| i * size..(i + 1) * size).collect();
        Self { bytes, head: Vec::new(), behind_count: None, records, separator: b"", ranks: Ranks::None }
    }

    /// True if the points have a column of ranks already.
    pub fn has_ranks(&self) -> bool {
        self.ranks == Ranks::Taken
    }

    /// Writes a file of some of the points, in this order, each with its rank if there are any and columns have names.
    pub fn write(&self, writer: &mut impl Write, indices: &[u32], ranks: &[f32]) -> io::Result<()> {
        let column = if ranks.is_empty() { Ranks::None } else { self.ranks };
        match (&self.behind_count, column) {
            (Some(behind), _) => {
                writer.write_all(&self.head)?;
                write!(writer, "{}", indices.len())?;
                let (properties, end) = behind.split_at(behind.len() - END.len());
                writer.write_all(properties)?;
                writer.write_all(if column == Ranks::None { b"" } else { b"property float rank\n" })?;
                writer.write_all(end)?;
            }
            (None, Ranks::Text(separator)) => {
                writer.write_all(self.head.trim_ascii_end())?;
                writeln!(writer, "{separator}rank")?;
            }
            _ => writer.write_all(&self.head)?,
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

/// The lines from an offset on, without their ends.
fn lines(bytes: &[u8], start: usize) -> impl Iterator<Item = Range<usize>> {
    let mut next = start;
    bytes[start..].split_inclusive(|&byte| byte == b'\n').map(move |line| {
        let begin = next;
        next += line.len();
        begin..begin + line.strip_suffix(b"\n").unwrap_or(line).len()
    })
}

/// A header of PLY, cut at the number of vertices.
struct Header {
    is_text: bool,
    is_big: bool,
    elements: Vec<Element>,
    /// The bytes up to the number of vertices, and from there on, both without other elements.
    before: Vec<u8>,
    behind: Vec<u8>,
    /// The offset of the body.
    length: usize,
}

struct Element {
    name: String,
    count: usize,
    /// The size of each property in bytes, if it is the same in all elements.
    sizes: Vec<Option<usize>>,
    has_ranks: bool,
}

/// The end of a header.
const END: &[u8] = b"end_header\n";

impl Element {
    /// The size of an element in bytes.
    fn size(&self) -> Result<usize, String> {
        let size = self.sizes.iter().copied().sum::<Option<usize>>();
        size.ok_or_else(|| format!("the elements {} have lists, and cannot be taken apart", self.name))
    }
}

impl Header {
    fn of(bytes: &[u8]) -> Result<Self, String> {
        let mut header =
            Self { is_text: false, is_big: false, elements: vec![], before: vec![], behind: vec![], length: 0 };
        for line in lines(bytes, 0) {
            let text = String::from_utf8_lossy(&bytes[line.clone()]).into_owned();
            let words: Vec<_> = text.split_whitespace().collect();
            header.length = (line.end + 1).min(bytes.len());
            match words[..] {
                ["format", format, ..] => {
                    header.is_text = format == "ascii";
                    header.is_big = format == "binary_big_endian";
                }
                ["element", name, count] => {
                    let count = count.parse().map_err(|_| format!("{count:?} is no number of elements"))?;
                    header.elements.push(Element { name: name.to_owned(), count, sizes: Vec::new(), has_ranks: false });
                }
                ["property", kind, ..] => {
                    let element = header.elements.last_mut().ok_or("a property of no element")?;
                    element.sizes.push(size(kind));
                    element.has_ranks |= words.last() == Some(&"rank");
                }
                _ => {}
            }
            let is_of_vertices = header.elements.last().is_none_or(|element| element.name == "vertex");
            match words[..] {
                ["element", "vertex", _] => header.before.extend_from_slice(b"element vertex "),
                ["element" | "property", ..] if !is_of_vertices => continue,
                _ => {
                    let part = if header.has_vertices() { &mut header.behind } else { &mut header.before };
                    part.extend_from_slice(text.trim_ascii_end().as_bytes());
                }
            }
            // The number of vertices ends its line.
            let part = if header.has_vertices() { &mut header.behind } else { &mut header.before };
            part.push(b'\n');
            if words[..] == ["end_header"] {
                return Ok(header);
            }
        }
        Err("its header does not end".to_owned())
    }

    fn has_vertices(&self) -> bool {
        self.elements.iter().any(|element| element.name == "vertex")
    }
}

/// The size of a number in bytes.
fn size(kind: &str) -> Option<usize> {
    match kind {
        "char" | "uchar" | "int8" | "uint8" => Some(1),
        "short" | "ushort" | "int16" | "uint16" => Some(2),
        "int" | "uint" | "int32" | "uint32" | "float" | "float32" => Some(4),
        "double" | "float64" => Some(8),
        _ => None,
    }
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
        assert_eq!(Records::of_ply(file[..file.len() - 5].to_vec()).unwrap_err(), "ends before its 3 vertices do");
        let lists = binary.replace("int id", "list uchar int ids");
        assert!(Records::of_ply(lists.into_bytes()).unwrap_err().starts_with("the elements camera have lists"));
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
