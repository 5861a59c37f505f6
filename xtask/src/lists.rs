//! Lists of checks that run in parallel, each list in a process of its own. So the CPU time of a check includes only the processes for
//! which its own process waited.
//!
//! The system counts the CPU time of child processes for a process, not for a thread. The process of a list is this program again, started
//! with a hidden option. It writes the outcome of each check into a file. A check that is missing in the file did not run, and counts as
//! failed.

use crate::process;
use crate::summary::{Ended, LeftOut, Outcome};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Characters that no text of a check contains: the ASCII separators of fields and of records.
const ENDS: [char; 2] = ['\u{1f}', '\u{1e}'];

/// Runs lists of checks in parallel. Returns the outcomes of the checks, list by list. `lists` has the names of the checks. `words` returns
/// the arguments that start list `i` and name the file of its outcomes.
pub(crate) fn run(lists: &[Vec<&str>], words: impl Fn(usize, &Path) -> Vec<String>) -> Vec<Ended> {
    let started: Vec<_> = (0..lists.len()).map(|i| start(i, &words)).collect();
    let ended = started.into_iter().zip(lists).map(|(list, names)| {
        let read = list.and_then(|(child, report)| read(child, &report));
        let (ended, why) = read.unwrap_or_else(|why| (Vec::new(), why));
        whole(ended, names, &why)
    });
    ended.flatten().collect()
}

/// All checks of a list. A check without an outcome is a failure.
fn whole(mut ended: Vec<Ended>, names: &[&str], why: &str) -> Vec<Ended> {
    for name in names {
        if !ended.iter().any(|check| check.name == *name) {
            let outcome = Err(format!("did not come to its end: {why}"));
            ended.push(Ended { name: (*name).to_owned(), seconds: 0.0, cpu: None, outcome });
        }
    }
    ended
}

fn start(
    i: usize,
    words: &impl Fn(usize, &Path) -> Vec<String>,
) -> Result<(Child, PathBuf), String> {
    let folder = process::target_dir().join("check");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    // the name contains the number of this process: another run, or an earlier one, has a file of its own
    let report = folder.join(format!("list-{}-{i}", std::process::id()));
    fs::write(&report, "").map_err(|e| format!("{}: {e}", report.display()))?;
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    let mut command = Command::new(program);
    command.args(words(i, &report)).stdin(Stdio::null());
    let child = command.spawn().map_err(|e| format!("`{}`: {e}", process::line(&command)))?;
    Ok((child, report))
}

/// Waits for the process of a list. Returns the checks in its report, and the exit status of the process as text.
fn read(mut child: Child, report: &Path) -> Result<(Vec<Ended>, String), String> {
    let status = child.wait().map_err(|e| e.to_string())?;
    let text = fs::read_to_string(report);
    let text = text.map_err(|e| format!("{status}, {}: {e}", report.display()))?;
    let _ = fs::remove_file(report);
    Ok((decode(&text), format!("the process of its list ended with {status}")))
}

/// Writes the outcomes of the checks so far into the report of a list.
///
/// # Errors
///
/// The reason why the file cannot be written.
pub(crate) fn write(report: &Path, ended: &[Ended]) -> Result<(), String> {
    fs::write(report, encode(ended)).map_err(|e| format!("{}: {e}", report.display()))
}

fn encode(ended: &[Ended]) -> String {
    let record = |Ended { name, seconds, cpu, outcome }: &Ended| {
        let [kind, first, second] = match outcome {
            Ok(Outcome::Passed(remark)) => ["passed", remark, ""],
            Ok(Outcome::LeftOut(LeftOut { why, remedy })) => ["left out", why, remedy],
            Err(why) => ["failed", why, ""],
        };
        let cpu = cpu.map_or(String::new(), |cpu| cpu.to_string());
        let fields = [name, &seconds.to_string(), &cpu, kind, first, second];
        let fields = fields.map(|field| field.replace(ENDS, " "));
        fields.join(&ENDS[0].to_string()) + &ENDS[1].to_string()
    };
    ended.iter().map(record).collect()
}

/// The checks in a report. An incomplete record at the end is left out, since its check has not ended.
fn decode(text: &str) -> Vec<Ended> {
    let record = |text: &str| {
        let fields: Vec<&str> = text.split(ENDS[0]).collect();
        let &[name, seconds, cpu, kind, first, second] = &fields[..] else { return None };
        let outcome = match kind {
            "passed" => Ok(Outcome::Passed(first.to_owned())),
            "left out" => {
                Ok(Outcome::LeftOut(LeftOut { why: first.to_owned(), remedy: second.to_owned() }))
            }
            "failed" => Err(first.to_owned()),
            _ => return None,
        };
        let (name, seconds) = (name.to_owned(), seconds.parse().ok()?);
        Some(Ended { name, seconds, cpu: cpu.parse().ok(), outcome })
    };
    text.split_inclusive(ENDS[1]).filter_map(|text| record(text.strip_suffix(ENDS[1])?)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_read_as_it_was_written() {
        let ended =
            |name: &str, cpu, outcome| Ended { name: name.into(), seconds: 0.25, cpu, outcome };
        let left_out = LeftOut { why: "no target\nhere".into(), remedy: "add it".into() };
        let all = vec![
            ended("fuzz", Some(1.5), Ok(Outcome::Passed(String::new()))),
            ended("counts", None, Ok(Outcome::LeftOut(left_out))),
            ended("pick", Some(0.0), Err("two\nlines".into())),
        ];
        let text = encode(&all);
        assert_eq!(decode(&text), all);
        assert_eq!(decode(&text[..text.len() - 1]), all[..2]);
        assert_eq!(decode("a text"), Vec::new());
        let names = ["fuzz", "counts", "pick", "lines"];
        let whole = whole(all.clone(), &names, "killed");
        assert_eq!((&whole[..3], whole.len()), (&all[..], 4));
        assert!(whole[3].name == "lines" && whole[3].outcome.is_err());
    }

    #[test]
    fn checks_of_a_list_whose_process_ends_without_a_report_have_failed() {
        // the program of the tests has no such option, so that it ends at once
        let ended = run(&[vec!["one", "two"]], |_, _| vec!["--no-such-option".to_owned()]);
        let names: Vec<_> = ended.iter().map(|check| check.name.as_str()).collect();
        assert_eq!(names, ["one", "two"]);
        for check in ended {
            assert!(check.outcome.is_err_and(|why| why.contains("did not come to its end")));
        }
    }
}
