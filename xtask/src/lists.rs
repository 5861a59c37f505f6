//! Lists of checks beside each other, each in a process of its own: the CPU time of a check is then that of what its process waited for.
//!
//! The system counts CPU time of children by process, not by thread. The process of a list is this program again, with an option that is not shown;
//! it writes how its checks ended into a file.

use crate::process;
use crate::summary::{Ended, LeftOut, Outcome};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// Characters that no text of a check has: the ends of a field and of a record, as ASCII names them.
const ENDS: [char; 2] = ['\u{1f}', '\u{1e}'];

/// Runs as many lists beside each other; how their checks ended, list by list. `words` are those that start list `i` and have it write a file.
pub(crate) fn run(n: usize, words: impl Fn(usize, &Path) -> Vec<String>) -> Vec<Ended> {
    let started: Vec<_> = (0..n).map(|i| start(i, &words)).collect();
    let ended = started.into_iter().enumerate().map(|(i, list)| {
        list.and_then(|(child, report)| read(child, &report))
            .unwrap_or_else(|why| vec![lost(i, why)])
    });
    ended.flatten().collect()
}

fn start(
    i: usize,
    words: &impl Fn(usize, &Path) -> Vec<String>,
) -> Result<(Child, PathBuf), String> {
    let folder = process::target_dir().join("check");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let report = folder.join(format!("list-{i}"));
    // One of an earlier run must not be taken for this one's.
    let _ = fs::remove_file(&report);
    let program = std::env::current_exe().map_err(|e| e.to_string())?;
    let mut command = Command::new(program);
    command.args(words(i, &report)).stdin(Stdio::null());
    let child = command.spawn().map_err(|e| format!("`{}`: {e}", process::line(&command)))?;
    Ok((child, report))
}

fn read(mut child: Child, report: &Path) -> Result<Vec<Ended>, String> {
    let status = child.wait().map_err(|e| e.to_string())?;
    let text = fs::read_to_string(report);
    let text = text.map_err(|e| format!("ended without its report, {status}: {e}"))?;
    decode(&text).ok_or_else(|| format!("{} is no report", report.display()))
}

/// The line of a list whose process did not come to its end.
fn lost(i: usize, why: String) -> Ended {
    Ended { name: format!("list {}", i + 1), seconds: 0.0, cpu: None, outcome: Err(why) }
}

/// Writes how the checks of a list ended.
///
/// # Errors
///
/// Why the file cannot be written.
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

fn decode(text: &str) -> Option<Vec<Ended>> {
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
    text.split_terminator(ENDS[1]).map(record).collect()
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
        assert_eq!(decode(&encode(&all)), Some(all));
        assert_eq!(decode(""), Some(Vec::new()));
        assert_eq!(decode("a text"), None);
    }

    #[test]
    fn a_list_whose_process_ends_without_a_report_has_failed() {
        // No option of a program of tests: it ends at once.
        let ended = run(1, |_, _| vec!["--no-such-option".to_owned()]);
        assert!(ended[0].outcome.as_ref().is_err_and(|why| why.contains("without its report")));
    }
}
