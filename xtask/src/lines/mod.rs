//! The job `cargo xtask counts --lines`: counts the code that LLVM gets from each crate. It also checks that large functions are compiled
//! only in the crate that owns them.
//!
//! LLVM takes 95 % of the time of a build, in proportion to the number of lines that it gets. A million lines take 45 to 50 s of CPU time
//! at level 3, and a sixth of that at level 0. A line is one in the body of a function, before any optimisation. Each crate has a bound in
//! docs/PROFILES.md. The bound is raised by hand, so that growth is seen on the day on which it occurs.

mod counts;
mod table;
mod wrapper;

pub use wrapper::as_compiler;

use crate::process::{cargo, root, run, target_dir};
use crate::summary::{self, Outcome};
use counts::{Counted, Counts, OWNED};
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use table::Table;

/// Set of the command's features that is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Set {
    /// Features of the first command of README.md: `f64` alone.
    First,
    /// Features of all precisions.
    All,
}

impl Set {
    const BOTH: [Self; 2] = [Self::First, Self::All];

    fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::All => "all",
        }
    }
}

/// Crates whose steps directly call functions of modules that another crate owns. Other crates call them through a table.
const STEPS: [&str; 1] = ["mbs_steps"];

/// Largest number of lines of the modules with an owner in any other crate, for three precisions together. Allowed are functions that read
/// a field or two, since they are smaller than a call through a table. A model that is compiled outside its owner adds 50,000 lines.
const MOST_STRAY: u64 = 14_000;

/// Counts and prints the table. With `keep` it writes the counts into docs/PROFILES.md, and leaves the bounds unchanged.
#[allow(clippy::print_stdout, reason = "the table is what this job is for")]
pub fn lines(keep: bool) -> ExitCode {
    let counted = count(&Set::BOTH).and_then(|counts| {
        let mut table = Table::read()?;
        table.take(&counts);
        print!("{}", table.text());
        if keep {
            table.write()?;
        }
        verdict(&counts, &table)
    });
    summary::ended("lines", counted.map(Outcome::Passed))
}

/// Counts the build with all precisions, and compares it with the bounds. This build contains the code of the first command.
///
/// # Errors
///
/// Crates above their bounds, and functions that are compiled outside their owner.
pub(crate) fn check() -> Result<Outcome, String> {
    let counts = count(&[Set::All])?;
    let mut table = Table::read()?;
    table.take(&counts);
    verdict(&counts, &table).map(Outcome::Passed)
}

/// Compiles sets with a compiler that counts. Other sets get no counts.
fn count(sets: &[Set]) -> Result<Counted, String> {
    let mut counted = Counted::default();
    let asked = Set::BOTH.into_iter().zip(&mut counted).filter(|(set, _)| sets.contains(set));
    for (set, counts) in asked {
        let folder = folder(set);
        let mut check = cargo();
        check.args(["check", "--quiet", "--release", "--locked", "--package", "mbs-cli", "--lib"]);
        if set == Set::First {
            check.arg("--no-default-features");
        }
        check.arg("--target-dir").arg(target_dir().join("lines").join(set.name()));
        check.env("RUSTC_WRAPPER", std::env::current_exe().map_err(|e| e.to_string())?);
        run(check.env(wrapper::FOLDER, &folder).current_dir(root()))?;
        let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if root().join(name.replace('_', "-")).join("Cargo.toml").is_file() {
                counts.insert(name, wrapper::read(&entry.path())?);
            }
        }
        if counts.is_empty() {
            return Err(format!("no crate is counted in {}", folder.display()));
        }
    }
    Ok(counted)
}

/// The folder of the counts of a set.
fn folder(set: Set) -> PathBuf {
    target_dir().join("lines").join(format!("{}-counts", set.name()))
}

/// The totals, if all counts are within their bounds.
fn verdict(counted: &Counted, table: &Table) -> Result<String, String> {
    let mut faults = table.faults();
    for (name, counts) in counted.iter().flatten() {
        let strays = OWNED.iter().zip(counts.owned);
        let strays = strays.filter(|((owner, _), _)| owner != name && !STEPS.contains(&&**name));
        let n: u64 = strays.clone().map(|(_, n)| n).sum();
        if n > MOST_STRAY {
            let of: Vec<_> = strays.map(|((o, m), n)| format!("{n} of {o}::{m}")).collect();
            faults.push(format!(
                "{name} compiles functions of other crates ({}): {n} lines, {MOST_STRAY} at most. Call them through a table (mbs-math/src/once.rs)",
                of.join(", ")
            ));
        }
    }
    if !faults.is_empty() {
        return Err(faults.join("\n"));
    }
    let total = |counts: &BTreeMap<String, Counts>| {
        let lines: u64 = counts.values().map(|counts| counts.lines).sum();
        format!("{:.2}", lines as f64 / 1e6)
    };
    let names = ["of the first command", "with all precisions"];
    let counted = counted.iter().zip(names).filter(|(counts, _)| !counts.is_empty());
    let totals: Vec<_> = counted.map(|(c, name)| format!("{} {name}", total(c))).collect();
    Ok(format!("million lines: {}", totals.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(name: &str, lines: u64, natural: u64) -> Counted {
        let counts = Counts { lines, owned: [natural, 0, 0, 0] };
        [BTreeMap::from([(name.to_owned(), counts)]), BTreeMap::new()]
    }

    fn judged(counted: &Counted) -> Result<String, String> {
        let mut table = Table::parse("| mbs-study | 1 | 700 | 1 | 900 |\n").expect("a table");
        table.take(counted);
        verdict(counted, &table)
    }

    #[test]
    fn a_crate_above_its_bound_or_without_one_fails() {
        assert!(judged(&counted("mbs_study", 700_000, 0)).is_ok());
        let error = judged(&counted("mbs_study", 700_001, 0)).expect_err("above");
        assert!(error.contains("mbs-study") && error.contains("700"), "{error}");
        let error = judged(&counted("mbs_new", 1, 0)).expect_err("without a bound");
        assert!(error.contains("mbs-new"), "{error}");
    }

    #[test]
    fn functions_outside_their_owner_fail_but_for_those_of_a_step() {
        let error = judged(&counted("mbs_study", 600_000, MOST_STRAY + 1)).expect_err("a stray");
        assert!(error.contains("mbs_core::natural"), "{error}");
        assert!(judged(&counted("mbs_study", 600_000, MOST_STRAY)).is_ok());
    }
}
