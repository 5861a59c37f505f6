//! `fuzz SECONDS SEED COUNT CORPUS.. CURRENT`: COUNT trials of scenes by seed, or for SECONDS. Each is written to the file `CURRENT` before it
//! begins, so that who started this program knows what it was about when it stops or hangs. Exit status 1 where one is wrong.

use fuzz::{Verdict, scene, trial};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(told) => {
            // A reader that has gone away is no error.
            let _ = writeln!(std::io::stdout(), "{told}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [seconds, seed, count, folders @ .., current] = arguments else {
        return Err("usage: fuzz SECONDS SEED COUNT CORPUS.. CURRENT".to_owned());
    };
    let number = |text: &String| text.parse::<u64>().map_err(|e| format!("`{text}`: {e}"));
    let (seconds, first) = (Duration::from_secs(number(seconds)?), number(seed)?);
    let end = first.saturating_add(number(count)?);
    let mut corpus = Vec::new();
    for folder in folders {
        texts(Path::new(folder), &mut corpus).map_err(|e| format!("{folder}: {e}"))?;
    }
    let start = Instant::now();
    let (mut seed, mut counts) = (first, [0_usize; 3]);
    while start.elapsed() < seconds && seed < end {
        let text = scene(seed, &corpus);
        std::fs::write(current, &text).map_err(|e| format!("{current}: {e}"))?;
        #[allow(clippy::cast_possible_truncation, reason = "only its remainder counts")]
        match trial(text.as_bytes(), seed as usize) {
            Verdict::Refused => counts[0] += 1,
            Verdict::Ran { completed, stopped } => {
                counts[1] += completed;
                counts[2] += stopped;
            }
            Verdict::Wrong(why) => return Err(format!("seed {seed}: {why}")),
        }
        seed += 1;
    }
    let [refused, completed, stopped] = counts;
    Ok(format!(
        "{} texts from seed {first}: {refused} refused, {completed} runs completed, {stopped} stopped with a reason",
        seed - first
    ))
}

/// The scenes of a folder, in the order of their names.
fn texts(folder: &Path, corpus: &mut Vec<String>) -> std::io::Result<()> {
    let mut paths: Vec<_> = std::fs::read_dir(folder)?
        .map(|entry| entry.map(|e| e.path()))
        .collect::<Result<_, _>>()?;
    paths.sort();
    for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "toml")) {
        corpus.push(std::fs::read_to_string(path)?);
    }
    Ok(())
}
