//! Steps that a document asks of its reader, in order: files, changes of files, commands, outputs.

use std::path::Path;

/// A fence of a document, or a line of it.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// A line of a fence `sh` that calls `mbs`, `cp`, `cmp` or `cut`. `cargo mbs` and `cargo xtask simulate` count as `mbs`. The expected
    /// status is 0, or that of `# status N`.
    Command { text: String, status: i32 },
    /// A fence `toml NAME`: the file's text.
    File { name: String, text: String },
    /// A fence `diff NAME`: lines that are replaced in the file.
    Change { name: String, lines: Vec<String> },
    /// A fence `text shown`: the output of the preceding command.
    Shown(String),
    /// A mark that a fence may not have.
    Fault(String),
}

/// The steps of a document with their line numbers. A fence with `skip: REASON` is not a step.
pub(super) fn of(document: &str) -> Vec<(usize, Step)> {
    let mut steps = Vec::new();
    let mut lines = document.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let Some(info) = line.trim().strip_prefix("```") else { continue };
        let inside: Vec<(usize, &str)> =
            lines.by_ref().take_while(|(_, line)| line.trim() != "```").collect();
        let text = || inside.iter().map(|(_, line)| format!("{line}\n")).collect::<String>();
        let (language, mark) = info.split_once(' ').unwrap_or((info, ""));
        let is_file = mark.contains('.') && !mark.contains(' ');
        let step = match (language, mark) {
            ("sh", "") => {
                commands(&inside, &mut steps);
                continue;
            }
            (_, mark) if mark.split_once("skip: ").is_some_and(|(_, why)| !why.is_empty()) => {
                continue;
            }
            ("text", "shown") => Step::Shown(text()),
            ("toml", name) if is_file => Step::File { name: name.to_owned(), text: text() },
            ("diff", name) if is_file => {
                let lines = inside.iter().map(|(_, line)| (*line).to_owned()).collect();
                Step::Change { name: name.to_owned(), lines }
            }
            (_, "") => continue,
            ("sh" | "text" | "toml" | "diff", mark) => {
                Step::Fault(format!("`{language} {mark}` is no mark of a fence"))
            }
            _ => continue,
        };
        steps.push((number + 1, step));
    }
    steps
}

fn commands(lines: &[(usize, &str)], steps: &mut Vec<(usize, Step)>) {
    let mut before = String::new();
    for (number, line) in lines {
        let (code, comment) = line.split_once(" #").unwrap_or((line, ""));
        let code = format!("{before}{}", code.trim());
        if let Some(begun) = code.strip_suffix('\\') {
            before = begun.to_owned();
            continue;
        }
        before.clear();
        let run = code.strip_prefix("cargo xtask simulate ").map(|rest| format!("mbs run {rest}"));
        let text = run.unwrap_or_else(|| code.trim_start_matches("cargo ").to_owned());
        if ["mbs ", "cp ", "cmp ", "cut "].iter().any(|program| text.starts_with(program)) {
            let status = comment.split_once("status ").map(|(_, rest)| &rest[..1]);
            let status = status.map_or(0, |digit| digit.parse().expect("`# status N`"));
            steps.push((number + 1, Step::Command { text, status }));
        }
    }
}

/// Replaces lines of a file. Lines with `-` must exist and are replaced by the lines with `+` that follow. Lines with a blank must exist
/// and stay.
pub(super) fn change(file: &Path, lines: &[String]) -> Result<(), String> {
    let text = std::fs::read_to_string(file).map_err(|e| e.to_string())?;
    let of = |skipped: char| {
        let kept = lines.iter().filter(|line| !line.starts_with(skipped));
        kept.map(|line| format!("{}\n", line.get(1..).unwrap_or(""))).collect::<String>()
    };
    let (old, new) = (of('+'), of('-'));
    if text.matches(&old).count() != 1 {
        return Err(format!("these lines are {} times in it:\n{old}", text.matches(&old).count()));
    }
    std::fs::write(file, text.replacen(&old, &new, 1)).map_err(|e| e.to_string())
}

#[test]
fn fences_are_read_as_a_reader_follows_them() {
    let text = "```toml a.toml\nx = 1\n```\nRun:\n```sh\nmbs run a.toml --out o   # status 2: stops\ncargo build\ncargo xtask simulate a.toml\nmbs plot o \\\n  --log\n```\n```text shown\n1.5 m\n```\n```sh skip: long\nmbs compare a.toml\n```\n```diff a.toml\n-x = 1\n+x = 2\n```\n```sh slow\nmbs run b\n```\n";
    let command = |text: &str, status| Step::Command { text: text.to_owned(), status };
    let name = || "a.toml".to_owned();
    let expected = [
        (1, Step::File { name: name(), text: "x = 1\n".to_owned() }),
        (6, command("mbs run a.toml --out o", 2)),
        (8, command("mbs run a.toml", 0)),
        (10, command("mbs plot o --log", 0)),
        (12, Step::Shown("1.5 m\n".to_owned())),
        (18, Step::Change { name: name(), lines: vec!["-x = 1".to_owned(), "+x = 2".to_owned()] }),
        (22, Step::Fault("`sh slow` is no mark of a fence".to_owned())),
    ];
    assert_eq!(of(text), expected);
}
