//! OBJ files: plain ones in one pass (`plain.rs`); all others, and whatever is to be said against a file, by the crate
//! tobj (`unusual.rs`).

mod plain;
mod unusual;

use crate::mesh::soup::Soup;
use crate::mesh::source::Source;

/// Vertices, triangles and normals, or what is wrong with the file.
pub(super) fn parse(source: &mut Source) -> Result<Soup, String> {
    let start = source.at_least(3);
    if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
        return Err("is encoded in UTF-16; save it as UTF-8".to_owned());
    }
    if start.starts_with(b"\xef\xbb\xbf") {
        source.skip(3);
    }
    match plain::parse(source) {
        Some(soup) => Ok(soup),
        None => unusual::parse(&source.whole()),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use proptest::prelude::*;
    use proptest::sample::select;

    use super::*;

    fn plain(text: &str) -> Option<Soup> {
        let mut input = Cursor::new(text.as_bytes());
        plain::parse(&mut Source::new(&mut input, text.len() as u64))
    }

    fn bits(vectors: &[[f32; 3]]) -> Vec<[u32; 3]> {
        vectors.iter().map(|vector| vector.map(f32::to_bits)).collect()
    }

    /// Whether a file is plain, and then that it is read as tobj reads it.
    fn agrees(text: &str) -> bool {
        let Some(soup) = plain(text) else { return false };
        let other = unusual::parse(text.as_bytes()).unwrap_or_else(|error| panic!("{error} in:\n{text}"));
        assert_eq!(bits(&soup.positions), bits(&other.positions), "{text}");
        assert_eq!(soup.triangles, other.triangles, "{text}");
        assert_eq!(bits(&soup.normals), bits(&other.normals), "{text}");
        assert_eq!(soup.normal_indices, other.normal_indices, "{text}");
        true
    }

    #[test]
    fn what_programs_write_is_plain() {
        for text in [
            "",
            "# by a program\nmtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 1.0\r\nv 1.0e+00 1 -0 .1 .2 .3\nvt 0 1\nvn 0 0 1\ns off\n\
             usemtl C:\\b\nf 1/1/1 2/1/1 3/1/1\ng\nf 1//1 2//1 3//1 # a triangle\n\n  f -1 -2 -3/1\nl 1 2\nf 1 2\nf 1",
            "f 1 2 3 4\nv nan 0 0\nv 1e99 inf 0\nv 1 1 0\nv 123456789.123456789123456789 1 0\n# C:\\\n",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1//0 2/7/ 3//\nf 1 2 3//1\nvn 1 2 nan\nf 1//-1 2 3",
        ] {
            assert!(agrees(text), "{text}");
        }
    }

    #[test]
    fn all_else_is_left_to_tobj() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for line in [
            "v 1 2",
            "v",
            "v#",
            "v 1 2 x",
            "v 1 2 3#4",
            "vn 0 1",
            "vn",
            "f",
            "f 0 1 2",
            "f 1 2 4",
            "f -4 1 2",
            "f 4",
            "f 1 2 3//1",
            "f 1/1/1/1 2 3",
            "f 1 2 x",
            "f 1 2 3#",
            "f 1/#/1 2 3",
            "f 1 2 4294967297",
            "f 1 2 +3",
            "f 1//00 2 3",
            "f 1 2 18446744073709551617",
            "f 1 2 \\\n3",
            "v 1 2 \\\n3",
            "v 1 2 3 \\ # \\\n4",
            "g a \\\nb",
            "v\\\n 1 2 3",
            "f\\\n 1 2 3",
            "v 1\x0b2 3 4",
            "f 1/ 2/3/4/ 3",
        ] {
            assert!(plain(&format!("{vertices}{line}\n")).is_none(), "{line}");
            assert!(plain(&format!("{vertices}{line}")).is_none(), "{line}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn plain_files_are_read_as_tobj_reads_them(
            words in prop::collection::vec(select(&[
                "v", "v", "vn", "vn", "f", "f", "f", "g", "vt", "#", "1", "2", "3", "-1", "-2", "1/1/1", "2//1", "3/2",
                "1//", "2/2/", "-1//-1", "0", "0.5", "-1e3", ".25", "7.", "x", "\\", "\r", "\n", "\n", "\n", "\nf 1 2 3",
                "\nv 1 2 3", "\nvn 1 0 0", "\nf 1//1 2//1 3//2", "\nf -1 -2 -3 1", "\n# a\\",
            ][..]), 0..30),
            separators in prop::collection::vec(select(&[" ", " ", "  ", "\t", ""][..]), 30),
        ) {
            let text: String = words.iter().zip(&separators).flat_map(|(word, space)| [*word, space]).collect();
            agrees(&text);
            agrees(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\n{text}"));
        }
    }
}
