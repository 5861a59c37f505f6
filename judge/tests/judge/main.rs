//! Tests of the judge: closed forms, conserved quantities, order, differences, invariance.

mod channels;
mod closed;
mod controller;
mod kinds;
mod machines;
mod rests;
mod rules;
mod signals;
mod tables;
mod trial;

use judge::{Mechanism, State};

/// Tolerance of controlled steps in these tests [-].
const TOLERANCE: f64 = 1e-12;

/// Prints a count on the console. `println` would be captured for tests that pass.
fn say(text: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stdout(), "{text}");
}

fn mechanism(text: &str) -> Mechanism {
    Mechanism::new(judge::read(text).expect("the scene is read"))
}

/// The state after the time `duration`.
fn run(mechanism: &Mechanism, duration: f64) -> State {
    let mut state = mechanism.start().expect("it starts");
    let mut h = 1e-3 * duration;
    // one call may take a thousand steps at most
    for part in 1..=8 {
        let until = duration * f64::from(part) / 8.0;
        mechanism.advance(&mut state, until, &mut h, TOLERANCE).expect("it runs");
    }
    state
}

/// A scene of the workspace.
fn scene(name: &str) -> Mechanism {
    let path = format!("{}/../{name}", env!("CARGO_MANIFEST_DIR"));
    mechanism(&std::fs::read_to_string(path).expect("the scene is there"))
}

/// A channel by its name.
fn channel(mechanism: &Mechanism, state: &State, name: &str) -> Vec<f64> {
    let found =
        mechanism.scene.outputs.iter().find(|o| o.name == name).expect("the channel is there");
    mechanism.show(state, found.quantity)
}
