//! Measurements of what a step costs and what threads gain: in one process, printed as lines of JSON that `cargo xtask bench` reads.
//!
//! ```text
//! runner bench formulations
//! runner bench forks [--threads 2,3] [--seconds S]
//! runner bench SCENE FORMULATION[,FORMULATION] [--threads 1,2] [--seconds S]
//! runner bench digits SCENE FORM DIGITS STEP SPAN ALPHA
//! runner bench profile rates | step SCENE FROM TO | bare SCENE N
//! ```
//!
//! Clocks live here alone: what is timed is the step of the library, through a model and a solver that delegate to its own.

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

/// Does what the words ask for.
///
/// # Errors
///
/// What they should be, or what cannot be measured.
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

/// The formulations, and whether solver and clocks of their steps are the bench's own.
fn formulations() {
    for name in mbs::FormulationKind::listed().map(mbs::FormulationKind::name) {
        say(&json!({ "name": name, "own": lane::Method::named(name).is_some() }));
    }
}

/// Measures a scene in the formulations named.
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
