//! What a step costs and what threads gain: measured in one process, printed as lines of JSON that `cargo xtask bench` reads.
//!
//! ```text
//! bench forks [--threads 2,3] [--seconds S]
//! bench SCENE FORMULATION[,FORMULATION] [--threads 1,2] [--seconds S]
//! bench digits SCENE FORM DIGITS STEP SPAN ALPHA
//! bench profile rates | told SCENE FROM TO | bare SCENE N
//! ```
//!
//! Clocks live here alone: what is timed is the step of the library, through a model and a solver that delegate to its own.

mod augmented;
mod clocked;
mod counted;
mod digits;
mod faer_beside;
mod faer_rival;
mod forks;
mod lane;
mod others;
mod profile;
mod race;
mod rates;
mod scenes;
mod tally;

use mbs_core::scene::Dimension;
use scenes::Prepared;
use serde_json::Value;
use std::process::ExitCode;

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Request {
    /// Sizes of teams; one is always measured.
    pub(crate) threads: Vec<usize>,
    /// Time of one race of steps, about [s].
    pub(crate) seconds: f64,
}

/// Does what the command line asks for; its exit status.
pub fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match run(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("bench: {why}");
            ExitCode::FAILURE
        }
    }
}

/// One line of output.
#[allow(clippy::print_stdout, reason = "the lines are what is asked for")]
pub(crate) fn say(line: &Value) {
    println!("{line}");
}

fn run(words: &[String]) -> Result<(), String> {
    let (places, request) = parse(words)?;
    match &places[..] {
        [word] if word == "forks" => forks::measure(&request),
        [word, words @ ..] if word == "digits" => digits::measure(words),
        [word, words @ ..] if word == "profile" => profile::measure(words),
        [scene, formulations] => {
            let scene = scenes::read(scene)?;
            match scene.dimension {
                Dimension::Planar => measure::<2>(scene, formulations, &request),
                Dimension::Spatial => measure::<3>(scene, formulations, &request),
            }
        }
        _ => Err("expected `forks`, `digits`, `profile`, or a scene and formulations".to_owned()),
    }
}

/// Measures a scene in the formulations named.
fn measure<const D: usize>(
    scene: mbs_core::scene::Scene<f64>,
    formulations: &str,
    request: &Request,
) -> Result<(), String>
where
    mbs::Plane<D>: mbs::InSpace<f64>,
{
    let is_augmented = |name: &str| ["index-3", "index-1", "multi-index"].contains(&name);
    let (own, others): (Vec<_>, Vec<_>) = formulations.split(',').partition(|n| is_augmented(n));
    for name in others {
        others::measure::<D>(&scene, name, request)?;
    }
    if own.is_empty() {
        return Ok(());
    }
    let prepared = Prepared::<D>::new(scene)?;
    say(&prepared.told());
    own.into_iter().try_for_each(|name| augmented::measure(&prepared, name, request))
}

/// Places and options.
fn parse(words: &[String]) -> Result<(Vec<String>, Request), String> {
    let mut request = Request { threads: vec![1], seconds: 1.0 };
    let (mut places, mut words) = (Vec::new(), words.iter());
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--threads" => {
                let numbers = value()?.split(',').map(str::parse);
                let numbers: Result<Vec<usize>, _> = numbers.collect();
                request.threads = numbers.map_err(|e| format!("--threads: {e}"))?;
            }
            "--seconds" => {
                request.seconds = value()?.parse().map_err(|e| format!("--seconds: {e}"))?;
            }
            _ => places.push(word.clone()),
        }
    }
    request.threads.retain(|&n| n > 0);
    Ok((places, request))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_places_and_options() {
        let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let (places, request) =
            parse(&words("andrews index-3 --threads 1,2 --seconds 0.5")).unwrap();
        assert_eq!(places, ["andrews", "index-3"]);
        assert_eq!(request, Request { threads: vec![1, 2], seconds: 0.5 });
        assert!(parse(&words("forks --threads")).is_err());
        assert!(parse(&words("forks --threads x")).is_err());
        assert!(run(&words("forks a b")).is_err());
    }
}
