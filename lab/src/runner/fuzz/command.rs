//! The command `runner fuzz SECONDS SEED COUNT CORPUS.. CURRENT`: trials of malformed scenes by seed, up to a number or a time. Each scene
//! is written to the file `CURRENT` before its trial. So a caller knows the scene if this program stops or hangs. The exit status is 1 if a
//! trial is wrong.

use super::mechanism::mechanism;
use super::mutate::mutated;
use super::trial::{Verdict, trial};
use mbs::scene_file::Dice;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

/// Runs the trials that the words name.
///
/// # Errors
///
/// The usage, or the fault of a trial.
pub fn run(words: &[String]) -> Result<(), String> {
    let report = try_scenes(words)?;
    // an error of writing is ignored: the reader may have closed its end
    let _ = writeln!(std::io::stdout(), "{report}");
    Ok(())
}

fn try_scenes(arguments: &[String]) -> Result<String, String> {
    let [seconds, seed, count, folders @ .., current] = arguments else {
        return Err("usage: runner fuzz SECONDS SEED COUNT CORPUS.. CURRENT".to_owned());
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

/// The scene of a seed: a random mechanism, or a mutated text of the corpus.
fn scene(seed: u64, corpus: &[String]) -> String {
    let mut dice = Dice::new(seed);
    match dice.below(4) {
        0 => mechanism(&mut dice),
        1 => {
            let text = mechanism(&mut dice);
            mutated(&text, corpus, &mut dice)
        }
        _ if corpus.is_empty() => mechanism(&mut dice),
        _ => {
            let text = dice.one_of(corpus).clone();
            mutated(&text, corpus, &mut dice)
        }
    }
}
