//! A checkpoint with bytes changed, cut off or added, and alternately with a checksum that holds: it is refused, or what resumes from it runs or stops with a reason.

use mbs::core::scene::{Dimension, Scene};
use mbs::scene_file::Dice;
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};

/// Steps before a state is saved, and after it is restored.
const STEPS: [usize; 2] = [3, 3];
/// Length of a step [s].
const STEP: f64 = 1e-3;

/// Keeps a scene after some steps, damages what was kept, and resumes from it; what was wrong. Nothing where the scene does not get
/// that far.
///
/// # Errors
/// What must not be: a restored state that is not finite, or a refusal without words.
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

/// Puts length and checksum of a checkpoint right, so that what comes after them is read: lengths of lists among it.
fn seal(bytes: &mut [u8]) {
    /// Bytes before those that are counted and summed: magic, format, length, checksum.
    const HEAD: usize = 28;
    let Some((head, rest)) = bytes.split_at_mut_checked(HEAD) else { return };
    let step = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    let sum = rest.iter().fold(0xcbf2_9ce4_8422_2325, step);
    head[12..20].copy_from_slice(&(rest.len() as u64).to_le_bytes());
    head[20..].copy_from_slice(&sum.to_le_bytes());
}

/// Some bytes changed, the end cut off, something added, or nothing.
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
