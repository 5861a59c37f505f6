//! Trials of damaged checkpoints: bytes are changed, cut off or added, in half of the trials with a valid checksum. A damaged checkpoint
//! must be refused, or a run must resume from it and end or stop with a reason.

use mbs::core::scene::{Dimension, Scene};
use mbs::scene_file::Dice;
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};

/// Numbers of steps before a state is saved and after it is restored.
const STEPS: [usize; 2] = [3, 3];
/// Length of a step [s].
const STEP: f64 = 1e-3;

/// Saves a scene's state after some steps, damages the checkpoint, and resumes from it. Does nothing if the scene stops in the first steps.
///
/// # Errors
/// The fault: a restored state that is not finite, or a refusal without a message.
pub(crate) fn torn(
    scene: &Scene<f64>,
    formulation: &str,
    dice: &mut Dice,
) -> Result<Option<bool>, String> {
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        step: Some(STEP.min(scene.duration)),
        ..Method::default()
    };
    let Ok(settings) = ResolvedMethod::new(scene, &overrides) else { return Ok(None) };
    match scene.dimension {
        Dimension::Planar => go::<2>(scene, &settings, dice),
        Dimension::Spatial => go::<3>(scene, &settings, dice),
    }
}

fn go<const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    dice: &mut Dice,
) -> Result<Option<bool>, String> {
    let Ok(mut simulation) = Simulation::<f64, D>::new(scene, settings) else { return Ok(None) };
    for _ in 0..STEPS[0] {
        if simulation.step(settings.step).is_err() {
            return Ok(None);
        }
    }
    let mut bytes = Vec::new();
    simulation.save((scene, settings), &mut bytes).map_err(|e| format!("cannot be kept: {e}"))?;
    damage(&mut bytes, dice);
    if dice.below(2) == 0 {
        seal(&mut bytes);
    }
    if let Err(error) = simulation.restore((scene, settings), &bytes[..]) {
        let has_words = !error.to_string().is_empty() && !error.hint().is_empty();
        return if has_words { Ok(Some(false)) } else { Err("a refusal without words".to_owned()) };
    }
    for _ in 0..STEPS[1] {
        if simulation.step(settings.step).is_err() {
            break;
        }
    }
    let state = simulation.state();
    let is_finite = state.q.iter().chain(&state.v).all(|x| x.is_finite());
    is_finite.then_some(Some(true)).ok_or_else(|| "a state that is not finite".to_owned())
}

/// Corrects length and checksum of a checkpoint, so that the reader reaches the damaged contents, such as lengths of lists.
fn seal(bytes: &mut [u8]) {
    /// Number of bytes before the counted contents: magic, format, length, checksum.
    const HEAD: usize = 28;
    let Some((head, rest)) = bytes.split_at_mut_checked(HEAD) else { return };
    let step = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    let sum = rest.iter().fold(0xcbf2_9ce4_8422_2325, step);
    head[12..20].copy_from_slice(&(rest.len() as u64).to_le_bytes());
    head[20..].copy_from_slice(&sum.to_le_bytes());
}

/// Changes some bytes, cuts off the end, appends bytes, or does nothing.
pub(crate) fn damage(bytes: &mut Vec<u8>, dice: &mut Dice) {
    match dice.below(4) {
        0 => bytes.truncate(dice.below(bytes.len())),
        1 => bytes.extend((0..=dice.below(20)).map(|k| u8::try_from(k).unwrap_or(0))),
        2 => {
            for _ in 0..=dice.below(4) {
                let at = dice.below(bytes.len());
                bytes[at] ^= 1 << dice.below(8);
            }
        }
        _ => {}
    }
}
