//! include/azulejo.h and the headers below include/azulejo/ are what cbindgen makes of this crate, byte for byte.
//! `AZULEJO_BLESS=1` writes them.
//!
//! Each source file has one topic, and its types stand before its calls. cbindgen would put the types of a whole crate
//! before all calls, so it reads one file at a time.

use std::{env, fs, path::Path};

/// As wide as a line of the header may be.
const COLUMNS: usize = 100;

/// As many lines of comments as all headers may have, so that they can be read: what holds for many calls stands once, in
/// azulejo.h, and derivations in docs/.
const COMMENTS: usize = 1_200;

/// The texts of all _init functions, which azulejo.h says once.
const OF_INIT: [&str; 2] = ["Writes the defaults.", "Writes zeros and the size."];

/// A header below include/azulejo/.
struct Header {
    name: &'static str,
    /// Its page.
    page: &'static str,
    /// The source files, in the order of the header.
    sources: &'static [&'static str],
}

/// The headers, in the order in which azulejo.h includes them.
const HEADERS: [Header; 8] = [
    Header {
        name: "base",
        page: "What all calls share: status codes, contexts, points, orders, classes and meshes.",
        sources: &[
            "status",
            "version",
            "progress",
            "context",
            "domain",
            "order",
            "points",
            "region",
            "classes",
            "mesh",
            "of_position",
            "embree",
        ],
    },
    Header {
        name: "kdrt",
        page: "KDRT: maximal Poisson-disk sets in the plane, whole, in windows and in streams, and edited.",
        sources: &["kdrt", "kept", "kdrt_classes", "merge", "plane_edit", "maximal"],
    },
    Header {
        name: "psp",
        page: "PSP: maximal Poisson-disk sets on triangle meshes, also with a radius that varies.",
        sources: &["psp_report", "psp", "psp_classes", "psp_edit", "instances", "adaptive", "mesh_density"],
    },
    Header {
        name: "volume",
        page: "Volumes: maximal Poisson-disk sets of cuboids and inside meshes, and their relaxation.",
        sources: &["volume", "inside", "volume_adaptive", "volume_relax"],
    },
    Header {
        name: "dcr",
        page: "DCR: relaxation of point sets in the plane, with a density, and on meshes.",
        sources: &["dcr", "density", "surface", "remesh"],
    },
    Header { name: "thin", page: "Thinning: points of a cloud that are far from each other.", sources: &["thin"] },
    Header { name: "mask", page: "Masks: blue-noise masks, and halftones by them.", sources: &["mask"] },
    Header {
        name: "analysis",
        page: "Analysis: distances, coverage and spectra of sets.",
        sources: &["analysis", "statistics", "spectrum", "differences"],
    },
];

#[test]
fn the_committed_headers_are_the_generated_ones() {
    let crate_root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let include = crate_root.join("../../include");
    let (mut declared, mut comments) = (0, 0);
    for header in &HEADERS {
        let topics: Vec<String> = header.sources.iter().map(|source| topic(crate_root, source)).collect();
        declared += topics.iter().map(|topic| topic.matches("azulejo_status azulejo_").count()).sum::<usize>();
        let includes = match header.name {
            "base" => "#include <stddef.h>\n#include <stdint.h>\n",
            // For densities on meshes.
            "dcr" => "#include \"base.h\"\n#include \"psp.h\"\n",
            _ => "#include \"base.h\"\n",
        };
        let page = format!("/* {}\n * {GENERATED} */\n", header.page);
        let linkage = |brace| format!("#ifdef __cplusplus\n{brace}\n#endif\n");
        let body = [&linkage("extern \"C\" {"), &topics.join("\n"), &linkage("}")].map(String::as_str).join("\n");
        let guard = format!("AZULEJO_{}_H", header.name.to_uppercase());
        comments +=
            check(&include.join(format!("azulejo/{}.h", header.name)), &guarded(&guard, &page, includes, &body));
    }
    assert!(declared > 50, "{declared} calls");

    let all: String = HEADERS.iter().map(|header| format!("#include \"azulejo/{}.h\"\n", header.name)).collect();
    let page = fs::read_to_string(crate_root.join("src/lib.rs")).unwrap();
    comments += check(&include.join("azulejo.h"), &guarded("AZULEJO_H", &preamble(&page), &all, ""));
    assert!(comments <= COMMENTS, "{comments} lines of comments");
}

const GENERATED: &str = "Generated from ffi/azulejo-c by cbindgen; do not edit. The conventions are in azulejo.h.";

/// A page, and what it includes and declares, once.
fn guarded(guard: &str, page: &str, includes: &str, body: &str) -> String {
    let body = if body.is_empty() { String::new() } else { format!("{body}\n") };
    format!("{page}\n#ifndef {guard}\n#define {guard}\n\n{includes}\n{body}#endif\n")
}

/// The types and calls of a source file.
fn topic(crate_root: &Path, source: &str) -> String {
    let mut config = cbindgen::Config::from_file(crate_root.join("cbindgen.toml")).unwrap();
    let path = crate_root.join(format!("src/{source}.rs"));
    // Types that only other files use are left out unless they are named.
    let text = fs::read_to_string(&path).unwrap();
    let types = text.lines().filter_map(|line| line.strip_prefix("pub struct ").or(line.strip_prefix("pub type ")));
    config.export.include = types.filter_map(|line| line.split([' ', ';']).next()).map(str::to_owned).collect();
    let mut generated = Vec::new();
    cbindgen::Builder::new().with_config(config).with_src(path).generate().unwrap().write(&mut generated);
    let generated = String::from_utf8(generated).unwrap();
    // Types of the same file have a tag before their name, those of others have not.
    let untagged = |line: &str| match line.starts_with("typedef struct ") {
        true => format!("{line}\n"),
        false => format!("{}\n", line.replace("struct azulejo_", "azulejo_")),
    };
    laid_out(&generated.lines().map(untagged).collect::<String>())
}

/// The output of cbindgen, with its comments in fewer lines: one of a line stands behind the constant or the field that it
/// is of, and what is said of arguments is a list without empty lines.
fn laid_out(generated: &str) -> String {
    let (mut laid_out, mut comment) = (String::new(), Vec::new());
    for line in generated.lines() {
        if let Some(text) = line.trim_start().strip_prefix("///") {
            comment.push(text.strip_prefix(' ').unwrap_or(text));
            continue;
        }
        let indent = &line[..line.len() - line.trim_start().len()];
        let is_item = !indent.is_empty() || line.starts_with("#define ");
        match comment[..] {
            [text] if OF_INIT.contains(&text) => laid_out += &format!("{line}\n"),
            [text] if is_item && line.len() + " ///< ".len() + text.chars().count() <= COLUMNS => {
                laid_out += &format!("{line} ///< {text}\n");
            }
            _ => {
                let above = list(&comment, COLUMNS - indent.len() - "/// ".len());
                laid_out.extend(above.iter().map(|text| format!("{}\n", format!("{indent}/// {text}").trim_end())));
                laid_out += &format!("{line}\n");
            }
        }
        comment.clear();
    }
    laid_out
}

/// The lines of a comment. Paragraphs on an argument ("name: …"), on complexity and on errors become items of a list.
fn list(comment: &[&str], columns: usize) -> Vec<String> {
    let mut lines = Vec::<String>::new();
    for paragraph in comment.split(|line| line.is_empty()) {
        let is_name = |text: &str| text.chars().all(|c| c.is_ascii_lowercase() || "_, ".contains(c));
        let is_item = paragraph.first().is_some_and(|line| {
            line.starts_with("O(") || line.split_once(": ").is_some_and(|(name, _)| is_name(name) || name == "Errors")
        });
        if !is_item {
            // A list ends at an empty line.
            lines.extend((!lines.is_empty()).then(String::new));
            lines.extend(paragraph.iter().map(|&line| line.to_owned()));
            continue;
        }
        lines.push("-".to_owned());
        for word in paragraph.iter().flat_map(|line| line.split(' ')) {
            let line = lines.last_mut().unwrap();
            if line.chars().count() + 1 + word.chars().count() <= columns {
                *line += &format!(" {word}");
            } else {
                lines.push(format!("  {word}"));
            }
        }
    }
    lines
}

/// Compares or writes a header, and returns its number of lines of comments.
fn check(path: &Path, generated: &str) -> usize {
    let is_too_long = |line: &&str| line.chars().count() > COLUMNS;
    assert_eq!(generated.lines().find(is_too_long), None, "a line is longer than {COLUMNS} columns");
    if env::var_os("AZULEJO_BLESS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, generated).unwrap();
    }
    let committed = fs::read_to_string(path).unwrap_or_default();
    let same = committed.lines().zip(generated.lines()).take_while(|(old, new)| old == new).count();
    assert!(committed == generated, "{} differs from line {}; AZULEJO_BLESS=1 rewrites it", path.display(), same + 1);
    generated.lines().filter(|line| ["/", "*"].iter().any(|mark| line.trim_start().starts_with(mark))).count()
}

/// The `//!` page at the top of a source file as a C comment.
fn preamble(source: &str) -> String {
    let page = source.lines().map_while(|line| line.strip_prefix("//!"));
    let lines: String = page.map(|line| format!(" *{line}\n")).collect();
    format!("/*\n{lines} */\n")
}
