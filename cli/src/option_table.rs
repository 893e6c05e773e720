//! `docs/options.md` against the command line: flags, defaults, ranges, and the commands of the guides.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use clap::{Arg, ArgAction, Command, CommandFactory, Parser};

use crate::program::Cli;

fn read(page: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(page);
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{page}: {error}"))
}

/// All that stands in back quotes.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// The flags that are named in a text.
fn flags(text: &str) -> impl Iterator<Item = String> {
    quoted(text).filter_map(|name| name.strip_prefix("--")).map(str::to_owned)
}

/// The lines of a bullet of the page.
fn bullet<'a>(page: &'a str, start: &str) -> &'a str {
    let text = page.split(start).nth(1).unwrap_or_else(|| panic!("the page lacks {start:?}"));
    &text[..text.find("\n* ").or(text.find("\n\n")).unwrap_or(text.len())]
}

/// The options whose flags have other names, with these.
fn renamed(page: &str) -> BTreeMap<&str, &str> {
    let (mut renamed, mut options) = (BTreeMap::new(), Vec::new());
    for name in quoted(bullet(page, "* On the command line ")) {
        match name.strip_prefix("--") {
            Some(flag) => renamed.extend(options.drain(..).map(|option| (option, flag))),
            None => options.push(name),
        }
    }
    assert!(renamed.len() >= 7 && options.is_empty());
    renamed
}

/// The numbers in a text, as they are written.
fn numbers(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    parts.filter(|part| part.contains(|c: char| c.is_ascii_digit()))
}

/// The value of a default: a number, or a root of two.
fn number(text: &str) -> Option<f64> {
    let root = text.strip_prefix("2^(1/").and_then(|root| root.strip_suffix(')'));
    root.map_or_else(|| text.parse().ok(), |root| Some(2f64.powf(root.parse::<f64>().ok()?.recip())))
}

/// Holds a flag against a row of the page.
fn check(arg: &Arg, [name, default, range, meaning]: [&str; 4]) {
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    let place = format!("{name}: {default}, {range}: {help}");
    let lower = |text: &str| text.to_lowercase().replace(' ', "-");
    if matches!(arg.get_action(), ArgAction::SetTrue) {
        return assert!(["periodic, bounded", "0 or 1"].contains(&range), "{place}");
    }
    let (in_words, in_help) = (default.split(" (C: ").next().unwrap_or(default), help.split("[default: ").nth(1));
    match (&arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect::<Vec<_>>()[..], in_help) {
        ([value], None) => {
            assert!(
                number(value).is_some_and(|value| Some(value) == number(default)) || lower(default) == *value,
                "{place}"
            );
        }
        ([], None) => assert!(["required", "none", "0"].contains(&in_words), "no default: {place}"),
        // One flag, of which the row of the lower corner has the remark.
        ([], Some(_)) if name == "domain_max" => {}
        ([], Some(_)) if name == "domain_min" => {
            assert!(
                ["unit square", "unit cube"].iter().any(|unit| help.contains(unit))
                    || meaning.contains("On the command line"),
                "{place}"
            );
        }
        ([], Some(text)) => {
            let start = in_words.split(',').next().unwrap_or(in_words).trim_end_matches(" the domain");
            assert!(text.to_lowercase().starts_with(&start.to_lowercase()), "{place}");
        }
        _ => panic!("two defaults: {place}"),
    }
    let values: BTreeSet<_> = arg.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    if values.is_empty() {
        let is_plain = matches!(range, "0 or 1" | "0 or more");
        let missing = numbers(range)
            .find(|&number| !is_plain && !numbers(&help).any(|other| other.trim_end_matches('.') == number));
        assert_eq!(missing, None, "{place}");
    } else {
        assert_eq!(values, range.split(", ").map(lower).collect(), "{place}");
    }
}

#[test]
fn commands_have_the_options_defaults_and_ranges_of_the_page() {
    let page = read("docs/options.md");
    let (renamed, common) = (renamed(&page), flags(bullet(&page, "* Commands also have ")).collect::<BTreeSet<_>>());
    let mut cli = Cli::command();
    cli.build();
    let command = |name: &str| cli.find_subcommand(name).unwrap_or_else(|| panic!("no command {name}"));
    let find =
        |command: &Command, flag: &str| command.get_arguments().find(|arg| arg.get_long() == Some(flag)).cloned();
    let mut named = BTreeMap::<&str, BTreeSet<String>>::new();
    let mut checked = 0;
    for section in page.split("\n## ").skip(1) {
        let value =
            |key: &str| section.lines().find_map(|line| line.strip_prefix("* ")?.strip_prefix(key)?.strip_prefix(": "));
        let Some(name) = value("command").and_then(|text| text.trim_matches('`').strip_prefix("azulejo ")) else {
            continue;
        };
        let absent: BTreeSet<_> = value("not of the command").into_iter().flat_map(quoted).collect();
        let known = named.entry(name).or_insert_with(|| common.clone());
        known.extend(value("command alone").into_iter().flat_map(flags));
        for line in section.lines().filter_map(|line| line.strip_prefix("| `")) {
            let cells: Vec<_> = line.trim_end_matches(" |").split(" | ").collect();
            let [option, default, range, meaning] = cells[..] else { panic!("not four cells: {line}") };
            let option = option.trim_end_matches('`');
            let flag = renamed.get(option).map_or_else(|| option.replace('_', "-"), ToString::to_string);
            if option == "progress" || meaning.contains("(C only)") || absent.contains(option) {
                continue;
            }
            let arg = find(command(name), &flag).unwrap_or_else(|| panic!("azulejo {name} lacks --{flag}"));
            check(&arg, [option, default, range, meaning]);
            known.insert(flag);
            checked += 1;
        }
    }
    for (&name, known) in &named {
        let flags = command(name).get_arguments().filter_map(Arg::get_long).filter(|&flag| flag != "help");
        let unknown: Vec<_> = flags.filter(|&flag| !known.contains(flag)).collect();
        assert!(unknown.is_empty(), "azulejo {name} has {unknown:?}, which are not on the page");
    }
    assert!(named.len() == 7 && checked > 40, "{checked} flags of {} commands", named.len());
}

#[test]
fn commands_of_the_guides_are_accepted() {
    let mut accepted = 0;
    for page in ["README.md", "docs/integrating.md", "docs/porting.md"] {
        for line in read(page).lines().filter(|line| line.starts_with("azulejo ") && line.contains(" -")) {
            let words = line.split(" #").next().unwrap_or(line).split_whitespace();
            Cli::try_parse_from(words).unwrap_or_else(|error| panic!("{page}: {line}: {error}"));
            accepted += 1;
        }
    }
    assert!(accepted > 10, "{accepted} commands");
}
