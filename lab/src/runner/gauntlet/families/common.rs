//! Cases made of drafts, by the kind of their truth; steps, and random powers of ten.

use crate::gauntlet::case::{Case, Image, Options, Truth};
use crate::gauntlet::draft::Draft;
use crate::gauntlet::text::text;
use mbs::scene_file::Dice;

/// A case of a draft whose truth is a run in another formulation.
pub(super) fn others(draft: &Draft, name: &str, time: (f64, f64)) -> Case {
    case(draft, name, time, Truth::Others)
}

pub(super) fn case(draft: &Draft, name: &str, (step, duration): (f64, f64), truth: Truth) -> Case {
    let scene = text(draft, name, duration);
    Case { scene, step, size: draft.size(), options: Options::default(), truth }
}

/// A case of a draft that moves as another, simpler draft does.
pub(super) fn twin(draft: &Draft, plain: &Draft, name: &str, time: (f64, f64)) -> Case {
    let image =
        Image { dimensions: [plain.dimension, draft.dimension], ..Image::same(draft.dimension) };
    let scene = text(plain, "twin", time.1);
    case(draft, name, time, Truth::Twin(scene, image))
}

/// A random step of the list, and the duration rounded to a number of steps [s].
pub(super) fn time(dice: &mut Dice, steps: &[f64], duration: f64) -> (f64, f64) {
    let step = *dice.one_of(steps);
    // whole steps, so that runs with a tenth of the step have rows at the same times
    (step, (duration / step).round().max(1.0) * step)
}

/// Ten to the power of a random number between `from` and `to`.
pub(super) fn decades(dice: &mut Dice, from: f64, to: f64) -> f64 {
    10_f64.powf(dice.between(from, to))
}
