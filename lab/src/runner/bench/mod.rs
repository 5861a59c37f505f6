//! Measurements of the cost of a step and of the speedup by threads. They are made in one process and printed as lines of JSON, which
//! `cargo xtask bench` reads.
//!
//! ```text
//! runner bench formulations
//! runner bench forks [--threads 2,3] [--seconds S]
//! runner bench SCENE FORMULATION[,FORMULATION] [--threads 1,2] [--seconds S]
//! runner bench digits SCENE FORM DIGITS STEP SPAN ALPHA
//! runner bench profile rates | step SCENE FROM TO | bare SCENE N
//! ```
//!
//! Only this module has clocks. It times the steps of the library through a model and a solver that call those of the library.

mod augmented;
mod clocked;
mod counted;
mod digits;
#[cfg(any(test, feature = "faer"))]
mod distance;
#[cfg(feature = "faer")]
mod faer_beside;
#[cfg(feature = "faer")]
mod faer_rival;
mod forks;
mod lane;
mod others;
mod profile;
mod race;
mod rates;
mod request;
mod scenes;
mod tally;

use mbs_core::scene::Dimension;
use request::{Job, Request, say};
use scenes::Prepared;
use serde_json::json;

/// Makes the measurement that the words name.
///
/// # Errors
///
/// The usage, or the reason why something cannot be measured.
pub fn run(words: &[String]) -> Result<(), String> {
    let (job, request) = request::parse(words)?;
    match job {
        Job::Formulations => {
            formulations();
            Ok(())
        }
        Job::Forks => forks::measure(&request),
        Job::Digits(words) => digits::measure(&words),
        Job::Profile(words) => profile::measure(&words),
        Job::Scene { scene, formulations } => {
            let scene = scenes::read(&scene)?;
            match scene.dimension {
                Dimension::Planar => measure::<2>(scene, &formulations, &request),
                Dimension::Spatial => measure::<3>(scene, &formulations, &request),
            }
        }
    }
}

/// Prints the formulations, and whether the bench times the solver and phases of their steps.
fn formulations() {
    for name in mbs::FormulationKind::listed().map(mbs::FormulationKind::name) {
        say(&json!({ "name": name, "own": lane::Method::named(name).is_some() }));
    }
}

/// Measures a scene in the named formulations.
fn measure<const D: usize>(
    scene: mbs_core::scene::Scene<f64>,
    formulations: &str,
    request: &Request,
) -> Result<(), String> {
    let is_own = |n: &&str| lane::Method::named(n).is_some();
    let (own, others): (Vec<_>, Vec<_>) = formulations.split(',').partition(is_own);
    for name in others {
        others::measure::<D>(&scene, name, request)?;
    }
    if own.is_empty() {
        return Ok(());
    }
    let prepared = Prepared::<D>::new(scene)?;
    say(&prepared.json());
    own.into_iter().try_for_each(|name| augmented::measure(&prepared, name, request))
}
