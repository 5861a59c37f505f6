//! The job `cargo xtask fuzz`: trials of malformed scenes in a process of their own. A text that breaks the process, or takes too long, is
//! saved.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};
use xtask::process;

/// Largest time of a text: a trial that takes longer hangs. Chosen, not tuned.
const TEXT_TIME: Duration = Duration::from_secs(60);
/// Largest memory of a text [KiB]: readers refuse larger ones. Chosen, not tuned.
const MEMORY: u64 = 1 << 20;
/// Time between two checks of the process.
const PAUSE: Duration = Duration::from_millis(100);

/// Tries texts during `seconds` [s], at most `count` of them, from the first seed.
///
/// # Errors
///
/// The fault, and the file in which the text is saved.
#[allow(clippy::print_stdout, reason = "the counts are what is asked for")]
pub(crate) fn fuzz(seconds: u64, seed: u64, count: u64) -> Result<(), String> {
    let program = process::tested("runner", "short")?;
    let folder = process::target_dir().join("fuzz");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let current = folder.join("current.toml");
    let mut command = limited(&program, MEMORY);
    command.arg("fuzz").args([seconds.to_string(), seed.to_string(), count.to_string()]);
    command.args([process::root().join("scenes"), process::root().join("lab/corpus")]);
    command.arg(&current).stdin(Stdio::null()).stdout(Stdio::piped());
    let line = process::line(&command);
    let mut child = command.spawn().map_err(|e| format!("cannot start `{line}`: {e}"))?;
    let hung = watch(&mut child, &current, TEXT_TIME)?;
    let out = child.wait_with_output().map_err(|e| e.to_string())?;
    if !hung && out.status.success() {
        println!("{}", String::from_utf8_lossy(&out.stdout).trim());
        return Ok(());
    }
    let what = if hung { "hung".to_owned() } else { format!("ended with {}", out.status) };
    let kept = keep(&current, &folder)?;
    Err(format!(
        "a text {what}. It is kept in {}: mend it, then move it to lab/corpus, where it stays tried",
        kept.display()
    ))
}

/// A program with a limit of memory [KiB], on systems whose shell can set one.
fn limited(program: &Path, memory: u64) -> Command {
    if !cfg!(target_os = "linux") {
        return Command::new(program);
    }
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -v {memory}; exec \"$0\" \"$@\"")]).arg(program);
    command
}

/// Waits for the program. Ends it, and returns true, if it takes too long for one text.
fn watch(child: &mut Child, current: &Path, limit: Duration) -> Result<bool, String> {
    let start = SystemTime::now();
    let since = Instant::now();
    loop {
        if child.try_wait().map_err(|e| e.to_string())?.is_some() {
            return Ok(false);
        }
        // a file of an earlier program does not count
        let written = fs::metadata(current).and_then(|m| m.modified()).unwrap_or(start).max(start);
        let is_late = SystemTime::now().duration_since(written).is_ok_and(|d| d > limit);
        if is_late && since.elapsed() > limit {
            // an error is ignored: the program may have ended by itself
            let _ = child.kill();
            return Ok(true);
        }
        sleep(PAUSE);
    }
}

/// Moves the text to a file with a free name.
fn keep(current: &Path, folder: &Path) -> Result<PathBuf, String> {
    let free = (1..).map(|k| folder.join(format!("kept-{k}.toml"))).find(|path| !path.exists());
    let kept = free.unwrap_or_else(|| folder.join("kept.toml"));
    fs::rename(current, &kept).map_err(|e| format!("{}: {e}", current.display()))?;
    Ok(kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_program_that_stays_with_one_text_is_ended() {
        let folder = std::env::temp_dir().join(format!("lab-fuzz-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let current = folder.join("current.toml");
        let start = |script: &str| {
            let mut command = Command::new("sh");
            let mut child = command.args(["-c", script, "sh"]).arg(&current).spawn().unwrap();
            let hung = watch(&mut child, &current, Duration::from_millis(1500)).unwrap();
            child.wait().unwrap();
            hung
        };
        assert!(start("echo text > \"$1\"; exec sleep 20"), "one text for too long");
        assert!(
            !start("for i in 1 2 3 4 5 6 7 8; do echo $i > \"$1\"; sleep 0.3; done"),
            "many texts"
        );
        assert_eq!(keep(&current, &folder).unwrap(), folder.join("kept-1.toml"));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_program_that_takes_too_much_memory_ends() {
        // the script makes a word of 64 MiB and doubles it
        let script = "x=$(head -c 67108864 /dev/zero | tr '\\0' x); y=$x$x; echo ${#y}";
        let takes = |memory: u64| {
            let mut command = limited(Path::new("bash"), memory);
            command.args(["-c", script]).output().unwrap().status.success()
        };
        assert!(takes(4 << 20) && !takes(1 << 16));
    }
}
