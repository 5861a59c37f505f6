//! Supervised processes that run cases. A process that takes too long for a run is ended, and another one continues with the next case.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;
use xtask::process;

/// Lines that one worker prints, with the outcomes of its cases.
pub(super) type Lines = Vec<Value>;

/// Cases of a worker, and the time limit of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    /// Number of all cases.
    pub(super) count: usize,
    /// Index of the worker's first case, and the step to its next one.
    pub(super) first: usize,
    pub(super) stride: usize,
    /// Time limit of a single run.
    pub(super) limit: Duration,
}

/// Runs a worker's cases; `done` is called for each line.
///
/// # Errors
///
/// The reason why the program cannot be started.
pub(super) fn run(
    program: &Path,
    share: Share,
    done: &(impl Fn() + Sync),
) -> Result<Lines, String> {
    let (mut lines, mut first) = (Vec::new(), share.first);
    while first < share.count {
        let mut command = Command::new(program);
        let numbers = [share.count, first, share.stride].map(|n| n.to_string());
        command.args(["gauntlet", "run"]).args(numbers).stdin(Stdio::null()).stdout(Stdio::piped());
        let line = process::line(&command);
        let mut child = command.spawn().map_err(|e| format!("cannot start `{line}`: {e}"))?;
        let received = listen(&mut child)?;
        let (mut number, mut about) = (first, String::from("its beginning"));
        let fault = loop {
            match received.recv_timeout(share.limit) {
                Ok(line) if line.starts_with('{') => {
                    let case = serde_json::from_str(&line).map_err(|e| format!("`{line}`: {e}"))?;
                    lines.push(case);
                    done();
                }
                Ok(line) => {
                    let mut words = line.splitn(3, ' ').skip(1);
                    number = words.next().and_then(|n| n.parse().ok()).unwrap_or(number);
                    words.next().unwrap_or_default().clone_into(&mut about);
                }
                Err(RecvTimeoutError::Timeout) => {
                    // an error is ignored: the program may have ended by itself
                    let _ = child.kill();
                    break Some(format!("hung for {} s", share.limit.as_secs()));
                }
                Err(RecvTimeoutError::Disconnected) => break None,
            }
        };
        let status = child.wait().map_err(|e| e.to_string())?;
        let fault = fault.or((!status.success()).then(|| format!("ended with {status}")));
        let Some(fault) = fault else { break };
        lines.push(json!({ "number": number, "fault": format!("{about} {fault}") }));
        first = number + share.stride;
    }
    Ok(lines)
}

/// The lines of a program, as they come.
fn listen(child: &mut Child) -> Result<Receiver<String>, String> {
    let out = child.stdout.take().ok_or("a program without output")?;
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    Ok(receiver)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    /// A program that hangs in its second case and dies in its third.
    const SCRIPT: &str = "#!/bin/sh\nk=$4\nwhile [ $k -lt $3 ]; do\n  echo \"begin $k a run\"\n  [ $k -eq 1 ] && exec sleep 30\n  [ $k -eq 2 ] && exit 7\n  echo \"{\\\"number\\\":$k}\"\n  k=$((k+$5))\ndone\n";

    #[test]
    fn a_case_that_hangs_or_dies_is_reported_and_the_others_are_run() {
        use std::os::unix::fs::PermissionsExt;
        let program = std::env::temp_dir().join(format!("lab-gauntlet-{}", std::process::id()));
        std::fs::write(&program, SCRIPT).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let share = Share { count: 5, first: 0, stride: 1, limit: Duration::from_millis(500) };
        let lines = run(&program, share, &|| {}).unwrap();
        std::fs::remove_file(&program).unwrap();
        let cases: Vec<_> =
            lines.iter().map(|line| (line["number"].as_u64(), line["fault"].as_str())).collect();
        let [zero, one, two, three, four] = cases.as_slice() else { panic!("{cases:?}") };
        assert_eq!((*zero, *three, *four), ((Some(0), None), (Some(3), None), (Some(4), None)));
        assert!(one.1.is_some_and(|why| why.contains("a run hung")), "{one:?}");
        assert!(two.1.is_some_and(|why| why.contains("ended with")), "{two:?}");
    }
}
