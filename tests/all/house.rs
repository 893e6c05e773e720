//! The rules of the house, read off the sources: sizes of files, imports, dependencies (CONTRIBUTING.md).
//!
//! Exceptions from a rule are listed by name, and must leave the list when they keep it: the lists only shrink.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// No file of the library has more lines: one idea with its tests.
const MOST_LINES: usize = 1000;

/// A file that imports from more modules lacks an abstraction.
const MOST_IMPORTS: usize = 12;

/// Files that import from more modules than they should, and from how many.
const IMPORTING: &[(&str, usize)] = &[
    ("dcr/surface/mod.rs", 14),
    ("dcr/surface/relaxation.rs", 16),
    ("dcr/uniform/classes.rs", 15),
    ("dcr/uniform/mod.rs", 15),
    ("kdrt/classes/mod.rs", 17),
    ("kdrt/progressive.rs", 15),
    ("psp/adaptive/sample.rs", 18),
    ("psp/adaptive/site.rs", 15),
    ("psp/classes/mod.rs", 17),
    ("psp/editable.rs", 16),
    ("psp/fill/blocks.rs", 14),
    ("psp/fill/mod.rs", 13),
    ("psp/fill/uniform.rs", 18),
    ("psp/given.rs", 14),
    ("psp/progressive.rs", 17),
];

/// Groups of files in more than one folder that import each other, by their first one.
const IN_CIRCLES: &[&str] = &[];

/// The modules of the crate: each imports only from those before it.
const ORDER: &[&str] = &[
    "error", "host", "setters", "math", "check", "centred", "rng", "simd", "memory", "kept", "job", "mask", "points",
    "order", "given", "region", "classes", "levels", "mesh", "index", "interior", "editable", "geometry", "plane",
    "maximal", "kdrt", "trace", "psp", "volume", "thin", "dcr", "analysis",
];

/// A file of src/ without its unit tests.
struct Source {
    /// The path of its module, such as `psp::fill`; empty for lib.rs.
    module: String,
    lines: usize,
    /// The paths of all that it imports, such as `crate::rng::Rng`.
    imports: Vec<String>,
}

/// The files of a folder, and of those in it, that have one of the extensions; not of what is built in it.
fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut found: Vec<PathBuf> = entries
        .flat_map(|path| {
            if path.is_dir() {
                if path.ends_with("target") { Vec::new() } else { files(&path, extensions) }
            } else if path.extension().is_some_and(|end| extensions.iter().any(|&extension| end == extension)) {
                vec![path]
            } else {
                Vec::new()
            }
        })
        .collect();
    found.sort();
    found
}

/// The sources by their names below src/.
fn sources() -> BTreeMap<String, Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let read = |path: PathBuf| {
        let name = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        let mut steps: Vec<&str> = name.strip_suffix(".rs").unwrap().split('/').collect();
        if matches!(steps.last(), Some(&"mod" | &"lib")) {
            steps.pop();
        }
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
        let lines = code.lines().map(|line| line.split("//").next().unwrap());
        let imports = imports(&lines.collect::<Vec<_>>().join("\n"));
        (name.clone(), Source { module: steps.join("::"), lines: text.lines().count(), imports })
    };
    files(&root, &["rs"]).into_iter().map(read).collect()
}

/// The paths in all `use` items of code.
fn imports(code: &str) -> Vec<String> {
    let mut paths = Vec::new();
    for item in code.split(';') {
        let item = item
            .rsplit('\n')
            .find(|line| line.trim_start().starts_with("use "))
            .map_or(item, |line| &item[line.as_ptr() as usize - item.as_ptr() as usize..]);
        let item = item.trim_start();
        let item = item.strip_prefix("pub ").unwrap_or(item);
        if let Some(tree) = item.strip_prefix("use ") {
            leaves(tree, "", &mut paths);
        }
    }
    paths
}

/// Adds the paths of a tree such as `crate::{rng::{Draw, Rng}, math}`.
fn leaves(tree: &str, prefix: &str, paths: &mut Vec<String>) {
    let (mut depth, mut from) = (0, 0);
    for (i, c) in tree.char_indices().chain([(tree.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let branch = tree[from..i].trim();
                from = i + 1;
                match branch.split_once('{') {
                    Some((path, inner)) => leaves(inner.rsplit_once('}').unwrap().0, &format!("{prefix}{path}"), paths),
                    None if branch.is_empty() => {}
                    None => paths.push(format!("{prefix}{}", branch.split(" as ").next().unwrap())),
                }
            }
            _ => {}
        }
    }
}

/// The file that a path leads to, seen from a module; `None` outside the crate.
fn target<'a>(sources: &'a BTreeMap<String, Source>, from: &str, path: &str) -> Option<&'a str> {
    let mut steps: Vec<&str> = match path.split_once("::")? {
        ("crate", rest) => rest.split("::").collect(),
        ("self", rest) => from.split("::").chain(rest.split("::")).collect(),
        ("super", rest) => {
            let above = from.rsplit_once("::").map_or("", |(above, _)| above);
            return target(sources, above, &format!("self::{rest}"));
        }
        _ => return None,
    };
    steps.retain(|step| !step.is_empty());
    (0..=steps.len()).rev().find_map(|count| {
        let module = steps[..count].join("::");
        sources.iter().find(|(_, source)| source.module == module).map(|(name, _)| &**name)
    })
}

/// The files that each file imports from.
fn edges(sources: &BTreeMap<String, Source>) -> BTreeMap<&str, BTreeSet<&str>> {
    let of = |source: &Source| source.imports.iter().filter_map(|path| target(sources, &source.module, path)).collect();
    sources.iter().map(|(name, source)| (&**name, of(source))).collect()
}

#[test]
fn imports_are_read_as_the_compiler_reads_them() {
    let code = "use a::{b, c::{D as E, self}};\npub use crate::f::G;\nfn h() {}\nuse super::i::*;\n";
    assert_eq!(imports(code), ["a::b", "a::c::D", "a::c::self", "crate::f::G", "super::i::*"]);
}

#[test]
fn no_file_is_longer_than_an_idea() {
    let long: Vec<_> = sources().into_iter().filter(|(_, source)| source.lines > MOST_LINES).map(|(n, _)| n).collect();
    assert!(long.is_empty(), "{long:?}");
}

/// Documentation is of nouns and of what functions do.
#[test]
fn no_sentence_of_documentation_begins_as_a_question() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders =
        ["src", "ffi", "cli", "include", "bindings", "studies", "tests", "benches", "fuzz", "examples", "examples_c"];
    let mut questions = Vec::new();
    for path in folders.iter().flat_map(|folder| files(&root.join(folder), &["rs", "h", "hpp", "cpp"])) {
        let text = fs::read_to_string(&path).unwrap();
        for line in text.lines().map(str::trim_start) {
            let documentation = ["/// ", "//! "].iter().find_map(|start| line.strip_prefix(start)).unwrap_or_default();
            let first = documentation.split(' ').next().unwrap();
            if ["What", "Whether", "How", "Which"].contains(&first) && !documentation.ends_with('?') {
                questions.push(format!("{}: {line}", path.display()));
            }
        }
    }
    assert_eq!(questions, [""; 0]);
}

#[test]
fn a_file_imports_from_few_modules() {
    let sources = sources();
    let count = |source: &Source| {
        // What a folder exports of its own files is no import.
        let is_own = |first: &str| sources.values().any(|other| other.module == format!("{}::{first}", source.module));
        let of = |path: &String| match (target(&sources, &source.module, path), path.split("::").next().unwrap()) {
            (Some(file), _) => Some(file.to_owned()),
            (None, first) => Some(first.to_owned()).filter(|first| !is_own(first)),
        };
        source.imports.iter().filter_map(of).collect::<BTreeSet<_>>().len()
    };
    let many: Vec<_> =
        sources.iter().map(|(name, s)| (&**name, count(s))).filter(|&(_, count)| count > MOST_IMPORTS).collect();
    assert_eq!(many, IMPORTING);
}

#[test]
fn modules_import_from_those_below_alone() {
    let sources = sources();
    let top = |file: &str| file.split('/').next().unwrap().trim_end_matches(".rs").to_owned();
    let place = |module: &str| ORDER.iter().position(|&known| known == module);
    for (from, targets) in edges(&sources) {
        let from = top(from);
        for to in targets.into_iter().map(top) {
            if from != to && from != "lib" && to != "lib" {
                let [Some(above), Some(below)] = [&from, &to].map(|module| place(module)) else {
                    panic!("ORDER lacks {from} or {to}")
                };
                assert!(above > below, "{from} imports from {to}");
            }
        }
    }
}

#[test]
fn files_of_different_folders_do_not_import_each_other() {
    let sources = sources();
    let edges = edges(&sources);
    let reach = |from: &str| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(file) = open.pop() {
            open.extend(edges[&*file].iter().filter(|&&to| seen.insert(to.to_owned())).map(|&to| to.to_owned()));
        }
        seen
    };
    let reached: BTreeMap<&str, BTreeSet<String>> = edges.keys().map(|&file| (file, reach(file))).collect();
    let folder = |file: &str| file.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
    let mut circles = BTreeSet::new();
    for &file in edges.keys() {
        let circle: Vec<_> = reached[file].iter().filter(|&other| reached[&**other].contains(file)).collect();
        if circle.iter().any(|other| folder(other) != folder(file)) {
            circles.insert(circle[0].clone());
        }
    }
    assert_eq!(circles.iter().map(|file| &**file).collect::<Vec<_>>(), IN_CIRCLES);
}
