//! `docs/options.md` against all that names options: the header and the defaults that the `_init` functions write,
//! azulejo.hpp, the stubs of Python, the types of JavaScript, the constants of the core, and the guides.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use azulejo_core::{kdrt, volume};

use crate::adaptive::azulejo_psp_adaptive_options_init;
use crate::dcr::azulejo_dcr_options_init;
use crate::inside::azulejo_volume_inside_options_init;
use crate::kdrt::azulejo_kdrt_options_init;
use crate::mask::azulejo_mask_options_init;
use crate::maximal::azulejo_maximal_options_init;
use crate::merge::azulejo_kdrt_merge_options_init;
use crate::psp::azulejo_psp_options_init;
use crate::status::AZULEJO_OK;
use crate::surface::azulejo_dcr_surface_options_init;
use crate::thin::azulejo_thin_options_init;
use crate::volume::azulejo_volume_options_init;
use crate::volume_adaptive::azulejo_volume_adaptive_options_init;
use crate::volume_relax::{azulejo_relax_inside_options_init, azulejo_volume_relax_options_init};

/// The root of the repository, whichever package compiles this crate.
fn root() -> &'static Path {
    let mut above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    above.find(|folder| folder.join("docs/options.md").exists()).expect("docs/options.md exists")
}

fn read(name: &str) -> String {
    fs::read_to_string(PathBuf::from(root()).join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A row of a table of the page.
struct Row {
    /// The default in words, as Python and JavaScript have it.
    default: String,
    /// The value that stands for it in C, if it is another one.
    in_c: Option<String>,
    range: String,
}

/// A section of the page: a struct of options.
#[derive(Default)]
struct Section {
    title: String,
    /// The names behind "C:", "Python:", "JavaScript:", "Python alone:".
    names: BTreeMap<String, Vec<String>>,
    rows: BTreeMap<String, Row>,
}

impl Section {
    fn names(&self, of: &str) -> &[String] {
        self.names.get(of).map_or(&[], Vec::as_slice)
    }
}

/// All that stands in back quotes.
fn quoted(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn sections() -> Vec<Section> {
    let mut sections = Vec::<Section>::new();
    for line in read("docs/options.md").lines() {
        if let Some(title) = line.strip_prefix("## ") {
            sections.push(Section { title: title.into(), ..Section::default() });
        }
        let Some(section) = sections.last_mut() else { continue };
        if let Some((of, names)) = line.strip_prefix("* ").and_then(|line| line.split_once(": ")) {
            // An explanation may follow the names.
            let names = names.split(": ").next().unwrap_or(names);
            section.names.insert(of.into(), quoted(names));
        }
        if let Some(cells) = line.strip_prefix("| `") {
            let cells: Vec<&str> = cells.trim_end_matches(" |").split(" | ").collect();
            let [name, default, range, meaning] = cells[..] else { panic!("not four cells: {line}") };
            assert!(meaning.ends_with('.'), "the meaning is no sentence: {line}");
            let (default, in_c) = match default.split_once(" (C: ") {
                Some((words, value)) => (words, Some(value.trim_end_matches(')').trim_matches('`').to_owned())),
                None => (default, None),
            };
            let row = Row { default: default.into(), in_c, range: range.into() };
            assert!(section.rows.insert(name.trim_end_matches('`').into(), row).is_none(), "twice: {line}");
        }
    }
    assert!(sections.len() >= 8 && sections.iter().all(|section| !section.rows.is_empty()));
    sections
}

/// A field of a struct of the header.
struct Field {
    kind: String,
    name: String,
    elements: usize,
    comment: String,
}

/// The fields of a struct of the header.
fn fields(header: &str, name: &str) -> Vec<Field> {
    let body = header.split(&format!("typedef struct {name} {{")).nth(1).expect("the struct is in the header");
    let body = body.split(&format!("}} {name};")).next().unwrap_or(body);
    let (mut fields, mut comment) = (Vec::new(), String::new());
    for line in body.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some(text) = line.strip_prefix("/// ") {
            comment += &format!("{text} ");
            continue;
        }
        // The comment is above the field or behind it.
        let (line, behind) = line.split_once(" ///< ").unwrap_or((line, ""));
        comment += behind;
        let (kind, declared) = line.trim_end_matches(';').rsplit_once([' ', '*']).expect("a declaration");
        let (name, elements) = declared.split_once('[').map_or((declared, 1), |(name, rest)| {
            (name, rest.trim_end_matches(']').parse().expect("a number of elements"))
        });
        let kind = if line.contains('*') || kind.ends_with("_fn") { "pointer" } else { kind };
        fields.push(Field { kind: kind.into(), name: name.into(), elements, comment: std::mem::take(&mut comment) });
    }
    fields
}

/// Numbers that a struct holds, in the order of its fields, which have no gaps between them.
fn values(fields: &[Field], bytes: &[u8]) -> BTreeMap<String, Vec<f64>> {
    let mut rest = bytes;
    let mut take = |kind: &str| {
        let size = if matches!(kind, "uint32_t" | "int32_t") { 4 } else { 8 };
        let (bytes, behind) = rest.split_at(size);
        rest = behind;
        match kind {
            "uint32_t" => f64::from(u32::from_ne_bytes(bytes.try_into().unwrap())),
            "int32_t" => f64::from(i32::from_ne_bytes(bytes.try_into().unwrap())),
            "double" => f64::from_ne_bytes(bytes.try_into().unwrap()),
            "uint64_t" | "size_t" | "pointer" => u64::from_ne_bytes(bytes.try_into().unwrap()) as f64,
            _ => panic!("a field of the type {kind}"),
        }
    };
    fields.iter().map(|field| (field.name.clone(), (0..field.elements).map(|_| take(&field.kind)).collect())).collect()
}

/// The bytes that the `_init` function of a struct writes.
fn written(name: &str) -> Vec<u8> {
    macro_rules! written {
        ($($name:literal: $init:ident),*) => {
            match name {
                $($name => {
                    let mut options = std::mem::MaybeUninit::zeroed();
                    // SAFETY: the struct is as large as it says, and zeros are valid for it.
                    let status = unsafe { $init(options.as_mut_ptr(), size_of_val(&options)) };
                    assert_eq!(status, AZULEJO_OK);
                    // SAFETY: structs that can grow have no padding.
                    unsafe {
                        std::slice::from_raw_parts(options.as_ptr().cast::<u8>(), size_of_val(&options)).to_vec()
                    }
                })*
                _ => panic!("{name} has no _init function here"),
            }
        };
    }
    written! {
        "azulejo_kdrt_options": azulejo_kdrt_options_init,
        "azulejo_maximal_options": azulejo_maximal_options_init,
        "azulejo_kdrt_merge_options": azulejo_kdrt_merge_options_init,
        "azulejo_psp_options": azulejo_psp_options_init,
        "azulejo_psp_adaptive_options": azulejo_psp_adaptive_options_init,
        "azulejo_dcr_options": azulejo_dcr_options_init,
        "azulejo_dcr_surface_options": azulejo_dcr_surface_options_init,
        "azulejo_thin_options": azulejo_thin_options_init,
        "azulejo_mask_options": azulejo_mask_options_init,
        "azulejo_volume_options": azulejo_volume_options_init,
        "azulejo_volume_inside_options": azulejo_volume_inside_options_init,
        "azulejo_volume_adaptive_options": azulejo_volume_adaptive_options_init,
        "azulejo_volume_relax_options": azulejo_volume_relax_options_init,
        "azulejo_relax_inside_options": azulejo_relax_inside_options_init
    }
}

/// The value of a constant of the header.
fn constant(header: &str, name: &str) -> Option<f64> {
    header.lines().find_map(|line| line.strip_prefix(&format!("#define {name} "))?.split(' ').next()?.parse().ok())
}

/// The numbers that a default of the page stands for in C.
fn expected(header: &str, name: &str, row: &Row) -> Vec<f64> {
    let text = row.in_c.as_ref().unwrap_or(&row.default);
    if matches!(text.as_str(), "required" | "none") {
        return vec![0.0];
    }
    let numbers: Option<Vec<f64>> = text.split(' ').map(|number| number.parse().ok()).collect();
    let words = text.replace(' ', "_").to_uppercase();
    numbers.unwrap_or_else(|| {
        let found =
            constant(header, text).or_else(|| constant(header, &format!("AZULEJO_{}_{words}", name.to_uppercase())));
        vec![found.unwrap_or_else(|| panic!("{name}: {text} is no number and no constant"))]
    })
}

/// True if a text gives a default: "default X" or "X, the default".
fn gives(text: &str, default: &str) -> bool {
    let (text, default) = (text.to_lowercase(), default.to_lowercase());
    text.contains(&format!("default {default}")) || text.contains(&format!("{default}, the default"))
}

/// The numbers in a text, as they are written.
fn numbers(text: &str) -> Vec<&str> {
    let parts = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    parts.filter(|part| part.contains(|c: char| c.is_ascii_digit())).collect()
}

#[test]
fn the_structs_of_the_header_have_these_options_defaults_and_ranges() {
    let header: String = ["base", "kdrt", "psp", "volume", "dcr", "thin", "mask"]
        .map(|name| read(&format!("include/azulejo/{name}.h")))
        .concat();
    let mut structs = BTreeSet::new();
    for section in sections() {
        let [name] = section.names("C") else { panic!("{}: one struct", section.title) };
        structs.insert(name.clone());
        let fields = fields(&header, name);
        let is_option =
            |field: &&Field| !matches!(&*field.name, "struct_size" | "reserved") && !field.name.ends_with("_user");
        let declared: BTreeSet<_> = fields.iter().filter(is_option).map(|field| &field.name).collect();
        assert_eq!(declared, section.rows.keys().collect(), "{name}");
        let values = values(&fields, &written(name));
        for field in fields.iter().filter(is_option) {
            let row = &section.rows[&field.name];
            let place = format!("{name}.{}: {}", field.name, field.comment);
            assert_eq!(values[&field.name], expected(&header, &field.name, row), "{place}");
            let says = match row.in_c.as_ref().unwrap_or(&row.default).as_str() {
                "required" => field.comment.contains("has no default"),
                "none" => gives(&field.comment, "NULL"),
                default => gives(&field.comment, default),
            };
            assert!(says, "no default in {place}");
            let is_plain = matches!(&*row.range, "0 or 1" | "0 or more");
            let missing = numbers(&row.range).into_iter().find(|&number| !is_plain && !field.comment.contains(number));
            assert_eq!(missing, None, "{place}");
        }
    }
    let inits = header.split("azulejo_status azulejo_").skip(1).filter_map(|text| text.split_once("_options_init("));
    let inits: BTreeSet<String> = inits
        .filter(|(name, _)| !name.contains(|c: char| !(c.is_ascii_lowercase() || c == '_')))
        .map(|(name, _)| format!("azulejo_{name}_options"))
        .collect();
    assert_eq!(structs, inits, "structs of options");
}

#[test]
fn azulejo_hpp_wraps_all_structs() {
    let wrapper = read("include/azulejo.hpp");
    for section in sections() {
        let [name] = section.names("C") else { panic!("{}: one struct", section.title) };
        assert!(wrapper.contains(&format!("Options<{name}, {name}_init>")), "{name}");
    }
}

/// The parameters with defaults of a function, or of the constructor of a class, in the stubs of Python.
fn parameters(stubs: &str, name: &str) -> Vec<(String, String)> {
    let class = stubs.split(&format!("\nclass {name}:")).nth(1).and_then(|body| body.split("def __init__(").nth(1));
    let function = || stubs.split(&format!("\ndef {name}(")).nth(1);
    let signature = class.or_else(function).unwrap_or_else(|| panic!("{name} is not in the stubs"));
    let signature = signature.split(") ->").next().unwrap_or(signature);
    let with_default = signature.lines().filter_map(|line| line.trim().trim_end_matches(',').split_once(" = "));
    with_default.map(|(left, default)| (left.split(':').next().unwrap_or(left).into(), default.into())).collect()
}

/// True if a default of Python is that of a row. None stands for lists and negative numbers, which Python's help() would
/// not show, and for the boundary of positions, which may have one of their own.
fn is_python(option: &str, default: &str, row: &Row) -> bool {
    let number = |text: &str| text.parse::<f64>().ok();
    match default {
        "None" if row.default.contains(' ') || row.default.starts_with('-') || option == "boundary" => true,
        "None" => row.in_c.is_some() || row.default == "none",
        "True" => row.default == "1",
        "False" => row.default == "0",
        _ if default.starts_with('"') => default.trim_matches('"') == row.default.replace(' ', "_").to_lowercase(),
        _ => number(default) == number(&row.default) || row.default == "required" && number(default) == Some(0.0),
    }
}

#[test]
fn python_has_these_options_and_defaults() {
    let stubs = read("bindings/python/azulejo.pyi");
    for section in sections() {
        for name in section.names("Python") {
            for (option, default) in parameters(&stubs, name) {
                let place = format!("{name}: {option}={default}");
                if option == "threads" || section.names("Python alone").contains(&option) {
                    continue;
                }
                let row = section.rows.get(&option).unwrap_or_else(|| panic!("{place} is not on the page"));
                // An option of the thesis's method is refused by the other one wherever it is not left out.
                let is_thesis = name == "dcr_relax" && default == "None";
                assert!(is_thesis || is_python(&option, &default, row), "{place}, but {} on the page", row.default);
            }
        }
    }
}

#[test]
fn javascript_has_these_options_and_defaults() {
    let types = read("bindings/js/index.d.ts");
    for section in sections() {
        for name in section.names("JavaScript") {
            let body = types.split(&format!("\nexport interface {name} ")).nth(1).expect("the interface is there");
            let body = body.split("\n}").next().unwrap_or(body);
            let mut comment = String::new();
            for line in body.lines().skip(1).map(str::trim) {
                if let Some(text) = line.strip_prefix("/**") {
                    comment = text.into();
                    continue;
                }
                let option = line.split(['?', ':']).next().unwrap_or(line);
                let snake =
                    option.chars().map(|c| if c.is_uppercase() { format!("_{}", c.to_lowercase()) } else { c.into() });
                let snake: String = snake.collect();
                let row = section.rows.get(&snake).unwrap_or_else(|| panic!("{name}.{option} is not on the page"));
                let plain = comment.replace(['`', '[', ']', ','], "").to_lowercase();
                let default = row.default.replace(' ', "_").to_lowercase();
                let says = match &*row.default {
                    "required" => plain.contains("required"),
                    "none" => plain.contains("by default the radius") || line.contains("null"),
                    "1" if line.contains("boolean") => plain.contains("default true"),
                    "0 0" | "1 1" | "0 0 0" | "1 1 1" => plain.contains(&format!("default {}", row.default)),
                    _ => {
                        plain.contains(&format!("default {default}"))
                            || plain.contains(&format!("{default} the default"))
                            || row.in_c.is_some() && plain.contains("default")
                    }
                };
                assert!(says, "{name}.{option}: {comment}, but {} on the page", row.default);
            }
        }
    }
}

#[test]
fn the_constants_of_the_core_are_those_of_the_page() {
    let sections = sections();
    let of = |option: &str| sections.iter().filter_map(|section| section.rows.get(option)).collect::<Vec<_>>();
    let of_plane = (kdrt::DEFAULT_LEAF_SIZE.to_string(), format!("at least {}", kdrt::MIN_LEAF_SIZE));
    let of_volume = ("0".to_owned(), format!("0, or at least {}", volume::MIN_LEAF_SIZE));
    for row in of("leaf_size") {
        let said = (row.default.clone(), row.range.clone());
        assert!(said == of_plane || said == of_volume, "{said:?}");
    }
    for row in of("quotient") {
        assert_eq!(row.range, format!("{} to {}", kdrt::QUOTIENTS.start(), kdrt::QUOTIENTS.end()));
        assert!(row.default == "2^(1/8)" && (kdrt::DEFAULT_QUOTIENT - 2_f64.sqrt().sqrt().sqrt()).abs() < 1e-15);
    }
    assert_eq!((of("leaf_size").len(), of("quotient").len()), (2, 5));
}

#[test]
fn guides_set_no_other_option() {
    let sections = sections();
    let mut named = 0;
    for page in ["README.md", "docs/integrating.md", "docs/porting.md"] {
        for text in read(page).split("options.").skip(1) {
            let end = text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(text.len());
            let (name, behind) = text.split_at(end);
            let is_set = behind.starts_with(" = ") || behind.starts_with('[');
            if is_set {
                named += 1;
                assert!(sections.iter().any(|section| section.rows.contains_key(name)), "{page}: options.{name}");
            }
        }
    }
    assert!(named > 10, "{named} options are set in the guides");
}
