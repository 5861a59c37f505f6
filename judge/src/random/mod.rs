//! Random scenes by seed, as text of a scene file. They have no, one or two closed loops, in the plane and in space. They have every kind
//! of joint and effect, guides, partly given initial conditions, and sizes from a millimetre to a hundred metres.
//!
//! A mechanism of length L has the time scale T = sqrt(L/g). Stiffnesses, rates and forces are drawn in units of the mechanism's mass, L
//! and T. Every seed gives a scene: a part that would lock the mechanism, or that has no start, is left out.

mod cases;
mod couplings;
mod dice;
mod draft;
mod effects;
mod mechanism;
mod rolling;
mod signals;
mod write;

use crate::read;
use dice::Dice;
use draft::Draft;
use write::mechanism_of;

pub use cases::{Case, STEPS, cases};

/// A scene with its step and its number of steps.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Text of the scene file.
    pub text: String,
    /// Step, chosen by the time scale of the motion [s].
    pub step: f64,
    /// Number of steps.
    pub steps: u32,
}

/// The scene of a seed.
#[must_use]
pub fn scene(seed: u64) -> Drawn {
    let mut dice = Dice::new(seed);
    let mut draft = Draft::tree(&mut dice);
    draft.train(&mut dice);
    draft.roll(&mut dice);
    draft.close(&mut dice);
    draft.couple(&mut dice);
    draft.guide(&mut dice);
    draft.start(&mut dice);
    effects::draw(&mut dice, &mut draft);
    draft.steer(&mut dice);
    // drops effects whose forces would rotate a thin rod about its own line, where it has no inertia
    while !draft.blocks.is_empty() && loads_unmet(&draft) {
        draft.blocks.pop();
    }
    #[allow(clippy::cast_possible_truncation, reason = "at most 100")]
    let steps = 20 + dice.below(81) as u32;
    let share = dice.logarithmic(0.02, 0.1);
    let step = share * time_scale(&draft);
    draft.duration = step * f64::from(steps);
    Drawn { text: draft.text(), step, steps }
}

/// True if there is a force that no inertia balances.
fn loads_unmet(draft: &Draft) -> bool {
    let Some(mechanism) = mechanism_of(draft) else { return true };
    mechanism.start().map_or(true, |start| mechanism.evaluate(&start).unmet > 1e-9)
}

/// The shortest time scale at the start. Time scales are the times in which a body rotates by a radian or moves by the mechanism's size,
/// and the time scale of the largest frequency.
fn time_scale(draft: &Draft) -> f64 {
    let own = draft.time;
    let Some(mechanism) = mechanism_of(draft) else { return own };
    let Ok(start) = mechanism.start() else { return own };
    let moved = mechanism.evaluate(&start);
    let mut fastest = 1.0 / own;
    for (frame, a) in start.frames.iter().zip(&moved.accelerations) {
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        fastest = fastest.max(size(&frame.w)).max(size(&frame.v) / draft.length);
        fastest = fastest.max((size(&a[..3]) / draft.length).sqrt()).max(size(&a[3..]).sqrt());
    }
    1.0 / fastest.max(draft.stiffest / own)
}

/// Returns the kinds of the scene's parts, each once: joints, effects, guides, closed loops, initial conditions.
#[must_use]
pub fn kinds(text: &str) -> Vec<String> {
    let Ok(scene) = read(text) else { return Vec::new() };
    let mut kinds: Vec<String> =
        scene.joints.iter().map(|j| format!("joint {:?}", j.kind).to_lowercase()).collect();
    kinds.extend(scene.effects.iter().map(|e| format!("effect {}", e.name())));
    kinds.extend(scene.rollings.iter().map(|r| format!("rolling {}", r.shape.name())));
    kinds.extend(scene.signals.iter().map(|s| format!("signal {}", s.source.name())));
    kinds.push(if scene.planar { "in the plane" } else { "in space" }.to_owned());
    let loops = scene.joints.len().saturating_sub(scene.bodies.len());
    kinds.extend(scene.couplings.iter().map(|c| format!("coupling {}", c.kind)));
    kinds.push(format!("{loops} loops"));
    if !scene.guides.is_empty() {
        kinds.push("guide".to_owned());
    }
    if !scene.initials.is_empty() {
        kinds.push("initial".to_owned());
    }
    kinds.sort();
    kinds.dedup();
    kinds
}
