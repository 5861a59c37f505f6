//! The help of the command and of its subcommands, compared with `help.txt`. Its lines are short, and each option with a value has a
//! default.

use super::{json, run, scene, text};
use std::path::Path;

pub(super) const COMMANDS: [&str; 19] = [
    "run",
    "compare",
    "diff",
    "explain",
    "doctor",
    "export",
    "import",
    "inspect",
    "equilibrium",
    "modes",
    "generate",
    "plot",
    "sweep",
    "new",
    "check",
    "kinds",
    "schema",
    "completions",
    "man",
];

/// Largest number of words in a line: rule 1 of the language in docs/NOTATION.md.
const MAX_WORDS: usize = 25;

/// Options with a value and without a default: the command needs one of them, or they are sizes of a family.
const NO_DEFAULT: [&str; 8] =
    ["--out <FILE>", "--rust", "--binary", "--count", "--rows", "--columns", "--of", "--resume"];

fn help(command: &str) -> String {
    let arguments: &[&str] = if command == "--help" { &[] } else { &["--help"] };
    let lines = text(&run(command, arguments).stdout);
    lines.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

#[test]
fn help_is_that_of_the_file() {
    let all = ["--help"].iter().chain(&COMMANDS);
    let found: String = all.map(|c| format!("# mbs {c}\n\n{}\n", help(c))).collect();
    let kept = include_str!("help.txt");
    let new = Path::new(env!("CARGO_TARGET_TMPDIR")).join("help.txt");
    std::fs::write(&new, &found).expect("the folder of the test is there");
    let differs = found.lines().zip(kept.lines()).find(|(found, kept)| found != kept);
    assert!(
        found == kept,
        "{differs:?} differ: where the new help is intended, copy {} to help.txt",
        new.display()
    );
}

#[test]
fn lines_are_short() {
    for command in ["--help"].iter().chain(&COMMANDS) {
        for line in help(command).lines().filter(|line| !line.contains("possible values")) {
            let words = line.split_whitespace().count();
            assert!(words <= MAX_WORDS, "{command}: {words} words: {line}");
        }
    }
}

#[test]
fn every_option_with_a_value_states_its_default() {
    for command in COMMANDS {
        let help = help(command);
        let options = help.split("\n      --").skip(1).filter(|option| {
            let name = option.lines().next().unwrap_or_default();
            let name = name.split("  ").next().unwrap_or_default();
            name.contains('<') && !NO_DEFAULT.iter().any(|o| format!("--{name}").starts_with(o))
        });
        for option in options.map(|option| option.to_lowercase()) {
            assert!(option.contains("default: "), "{command}: --{option}");
        }
    }
}

#[test]
fn another_name_of_an_option_or_a_value_means_the_same() {
    let scene = scene("double-pendulum");
    let with = |options: &[&str]| {
        let common = [scene.as_str(), "--duration", "0.05", "--no-estimate", "--json"];
        let control = json(&run("run", &[&common[..], options].concat()))["control"].clone();
        assert!(control.is_object(), "{options:?}");
        control
    };
    let old = with(&["--step-control", "energy-printed", "--events", "off"]);
    assert_eq!(old["rule"], "energy-printed");
    assert_eq!(with(&["--step-control", "energy-published", "--locate-events", "off"]), old);
}
