//! The cross-formulation oracle on every scene of the repository.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

mod common;
#[path = "common/oracle.rs"]
mod oracle;

use common::SCENES;
use oracle::{METHODS, Method, Told, disagreement, everything, tell};

/// Step and span of a scene: the step resolves its motion, and the span ends before chaos has made rounding large.
fn span(name: &str) -> (f64, f64) {
    match name {
        "andrews" => (1e-5, 0.01),
        "double-pendulum" => (1e-3, 1.5),
        "spatial-chain-20" | "tree-30" => (5e-4, 0.5),
        "n-four-bar-40" => (1e-3, 0.3),
        "two-four-bars" | "n-four-bar-10" | "four-bar" => (1e-3, 1.0),
        _ => (1e-3, 1.0),
    }
}

/// Pairs that end in a typed error, by its code: what the formulation cannot do, and says.
const REFUSED: [(&str, &str, &[&str]); 0] = [];

#[test]
fn every_formulation_tells_of_the_same_motion_on_every_scene() {
    let mut faults = Vec::new();
    for name in SCENES {
        let scene = everything(&common::scene(name));
        let reference = tell(&scene, METHODS[0], span(name))
            .unwrap_or_else(|e| panic!("{name} in index-3: {e}"));
        for method in &METHODS[1..] {
            if let Some(fault) = fault(name, &scene, *method, &reference) {
                faults.push(fault);
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

fn fault(
    name: &str,
    scene: &mbs::core::scene::Scene<f64>,
    method: Method,
    reference: &Told,
) -> Option<String> {
    let expected = REFUSED.iter().find(|(s, f, _)| *s == name && *f == method.0).map(|r| r.2);
    match (tell(scene, method, span(name)), expected) {
        (Ok(told), _) => {
            let (ratio, component) = disagreement(reference, &told);
            println!("{name:<20} {:<12} {:<12} {ratio:.2}", method.0, method.1);
            // A refusal that does not come must at least be no silent wrong answer.
            (!(ratio <= 1.0)).then(|| {
                format!(
                    "{name} {method:?}: {ratio:.2} times what is allowed, component {component}"
                )
            })
        }
        (Err(stop), Some(codes)) => {
            println!("{name:<20} {:<12} {:<12} {}", method.0, method.1, stop.code());
            (!codes.contains(&stop.code()))
                .then(|| format!("{name} {method:?}: code {} ({stop})", stop.code()))
        }
        (Err(stop), None) => Some(format!("{name} {method:?}: {stop}")),
    }
}
