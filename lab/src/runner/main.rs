//! The program `runner bench | fuzz | gauntlet WORDS`, which jobs start as a process of their own and supervise.

use std::process::ExitCode;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let done = match words.split_first() {
        Some((job, words)) if job == "bench" => runner::bench::run(words),
        Some((job, words)) if job == "fuzz" => runner::fuzz::command::run(words),
        Some((job, words)) if job == "gauntlet" => runner::gauntlet::command::run(words),
        _ => Err("usage: runner bench | fuzz | gauntlet WORDS".to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("runner: {why}");
            ExitCode::FAILURE
        }
    }
}
