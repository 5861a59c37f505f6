//! Builds that the tests of the workspace do not make: crates with sets of their features, and the command in `f64` alone.

use crate::process::{self, cargo, output, run};
use crate::summary::Outcome;
use std::fs;
use std::path::PathBuf;
use std::process::Stdio;

/// Crates with the sets of their features.
type Sets = [(&'static str, &'static [&'static str])];

/// Sets of the short check: no feature, and sets in which each feature is on in one and off in another. Sets with all features are built by
/// `lints` and the tests, and the command in `f64` alone by `lean`. With `alloc` mbs-core takes a quarter of a minute per set, so crates
/// above it use its sets.
const SHORT: &Sets = &[
    ("mbs-math", &["", "alloc", "f32,dd"]),
    // effects: each kind of law with tables in one set, together with laws that share no file with it
    ("mbs-core", &["", "alloc", POLYNOMIAL, TIRE, OWN_LAWS, "effects"]),
    // elements: those with rows, those without rows, and all
    (
        "mbs-recursive",
        &[
            "",
            "couplings,rolling,sums",
            "couplings,curves",
            "lines,sums",
            "rotors,signals",
            "alloc",
        ],
    ),
    (
        "mbs-nostd",
        &["", "mbs-core/tire", "couplings,rotors", "lines,signals,sums", "elements", "export"],
    ),
    // the other features of lab are checked by `lints`
    ("lab", &["jobs"]),
];

const POLYNOMIAL: &str = "alloc,polynomial,limit,bumper";
const TIRE: &str = "alloc,tire,friction,drag";
const OWN_LAWS: &str = "alloc,own-laws,bushing,speed-hold";

/// Sets of the long check: each effect alone, laws that share a file, tables of functions with and without precisions, and the precisions
/// alone.
const MORE: &Sets = &[
    (
        "mbs-core",
        &[
            "std",
            "alloc,polynomial",
            "alloc,bumper",
            "alloc,limit",
            "alloc,friction",
            "alloc,bushing",
            "alloc,drag",
            "alloc,speed-hold",
            "alloc,tire",
            "alloc,own-laws",
            "alloc,limit,friction",
            "alloc,bushing,bumper",
            "alloc,tire,speed-hold",
            "alloc,own-laws,drag",
            "instances",
            "instances,f32,dd",
        ],
    ),
    (
        "mbs-recursive",
        &["alloc,mbs-core/tire", "alloc,mbs-core/effects", "instances", "instances,f32,dd"],
    ),
    (
        "mbs-nostd",
        &[
            "mbs-core/polynomial,mbs-core/speed-hold",
            "mbs-core/effects",
            "couplings,curves",
            "rolling",
            "export,mbs-core/effects",
        ],
    ),
    ("mbs-steps", &["", "f32", "dd"]),
    ("mbs", &[""]),
    ("mbs-cli", &["", "f32", "dd"]),
    ("lab", &["jobs,effects"]),
];

/// The environment variable through which the tests get the path of the command in `f64` alone.
const LEAN: &str = "MBS_LEAN";

/// Checks crates with the sets of the short form, with lints if they are installed.
///
/// # Errors
///
/// The first set that fails.
pub(crate) fn check() -> Result<Outcome, String> {
    check_sets(SHORT)
}

/// Checks crates with the sets of the long list.
///
/// # Errors
///
/// The first set that fails.
pub(crate) fn more() -> Result<Outcome, String> {
    check_sets(MORE)
}

fn check_sets(all: &Sets) -> Result<Outcome, String> {
    let has_lints = output(cargo().args(["clippy", "--version"])).is_some();
    let sets = all.iter().flat_map(|(package, sets)| sets.iter().map(move |set| (package, set)));
    for (package, set) in sets {
        let mut command = cargo();
        command.args([if has_lints { "clippy" } else { "check" }, "--quiet", "--package", package]);
        command.args(["--no-default-features", "--features", set]);
        if has_lints {
            command.args(["--", "--deny", "warnings"]);
        }
        run(command.current_dir(process::root()))?;
    }
    let names = |sets: &[&str]| {
        let names = sets.iter().map(|set| if set.is_empty() { "none" } else { set });
        names.collect::<Vec<_>>().join(", ")
    };
    let remarks = all.iter().map(|(package, sets)| format!("{package} with {}", names(sets)));
    Ok(Outcome::Passed(remarks.collect::<Vec<_>>().join("; ")))
}

/// Tests the command in `f64` alone, which the first command of the README builds. A request for another precision must be reported by the
/// exit status.
///
/// # Errors
///
/// A failure of the build or of the tests.
pub(crate) fn lean() -> Result<Outcome, String> {
    let mbs = lean_command()?;
    let mut tests = cargo();
    tests.args([
        "test",
        "--workspace",
        "--quiet",
        "--test",
        "command",
        "--",
        "--ignored",
        "lean::",
    ]);
    run(tests.env(LEAN, mbs).current_dir(process::root()))?;
    Ok(Outcome::Passed(String::new()))
}

/// Crates of the command whose level of optimisation the profile of the tests raises.
const RAISED: [&str; 3] = ["mbs-nostd", "mbs-scene", "mbs-steps"];

/// Builds the command in `f64` alone. Returns its path. Its tests are short, so all crates of the workspace are built at level 0, with a
/// fifth of the work of a release build. A warning is a failure, since the lints do not check this set of features.
fn lean_command() -> Result<PathBuf, String> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--package", "mbs-cli", "--bin", "mbs"]);
    build.arg("--no-default-features");
    for raised in RAISED {
        build.args(["--config", &format!("profile.dev.package.{raised}.opt-level=0")]);
    }
    // colours would add characters to the words that are searched
    build.env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").env("CARGO_TERM_COLOR", "never");
    build.stdin(Stdio::null());
    let line = process::line(&build);
    let out = build.current_dir(process::root()).output();
    let out = out.map_err(|e| format!("cannot start `{line}`: {e}"))?;
    let messages = String::from_utf8_lossy(&out.stderr);
    if !out.status.success() || messages.contains("warning: ") {
        return Err(format!("`{line}`: {}\n{messages}", out.status));
    }
    let [built, kept] =
        ["debug", "lean"].map(|folder| process::target_dir().join(folder).join("mbs"));
    let copied = fs::create_dir_all(process::target_dir().join("lean"));
    copied
        .and_then(|()| fs::copy(&built, &kept))
        .map_err(|e| format!("{}: {e}", kept.display()))?;
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::Path;

    fn of(sets: &'static Sets, package: &str) -> Vec<BTreeSet<&'static str>> {
        let sets = sets.iter().filter(|(name, _)| *name == package).flat_map(|(_, sets)| *sets);
        sets.map(|set| set.split(',').filter(|feature| !feature.is_empty()).collect()).collect()
    }

    #[test]
    fn each_effect_is_on_without_each_other_in_the_long_list_and_in_one_set_of_the_short_form() {
        let effects: BTreeSet<_> =
            crate::effects::all().filter_map(|listed| listed.feature).collect();
        let of_effects = |sets| -> Vec<BTreeSet<_>> {
            let all = of(sets, "mbs-core").into_iter().filter(|set| set.contains("alloc"));
            all.map(|set| set.intersection(&effects).copied().collect()).collect()
        };
        let (short, more) = (of_effects(SHORT), of_effects(MORE));
        for effect in &effects {
            assert_eq!(short.iter().filter(|set| set.contains(effect)).count(), 1, "{effect}");
            assert!(more.contains(&BTreeSet::from([*effect])), "{effect} alone");
        }
    }

    #[test]
    fn each_element_is_on_and_off_in_the_short_form() {
        let sets = of(SHORT, "mbs-recursive");
        for element in ["couplings", "curves", "lines", "rolling", "rotors", "signals", "sums"] {
            let n = sets.iter().filter(|set| set.contains(element)).count();
            assert!((1..sets.len()).contains(&n), "{element}");
        }
    }

    /// features that only enable those of other crates are checked in the long list alone
    #[test]
    fn features_that_only_forward_are_asked_for_nowhere() {
        fn text(folder: &Path) -> String {
            let entries = fs::read_dir(folder).expect("a folder").flatten().map(|e| e.path());
            let each = entries.map(|path| {
                if path.is_dir() {
                    text(&path)
                } else {
                    fs::read_to_string(path).unwrap_or_default()
                }
            });
            each.collect()
        }
        for (package, features) in [
            ("mbs-core", &["std"][..]),
            ("mbs", &["f32", "dd"]),
            ("mbs-study", &["f32", "dd"]),
            ("mbs-cli", &["f32", "dd"]),
        ] {
            let text = text(&process::root().join(package).join("src"));
            let asked =
                features.iter().find(|name| text.contains(&format!("feature = \"{name}\"")));
            assert_eq!(asked, None, "{package}: put a set with it into the short form");
        }
    }
}
