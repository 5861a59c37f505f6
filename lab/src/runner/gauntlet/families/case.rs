//! Cases of drafts, and the numbers that they are drawn with.

use crate::case::{Case, Image, Options, Truth};
use crate::draft::Draft;
use crate::text::text;
use mbs::scene_file::Dice;

/// A case of a draft whose outputs are judged by other formulations.
pub(super) fn others(draft: &Draft, name: &str, time: (f64, f64)) -> Case {
    case(draft, name, time, Truth::Others)
}

pub(super) fn case(draft: &Draft, name: &str, (step, duration): (f64, f64), truth: Truth) -> Case {
    let scene = text(draft, name, duration);
    Case { scene, step, size: draft.size(), options: Options::default(), truth }
}

/// A case that moves as another draft does.
pub(super) fn twin(draft: &Draft, plain: &Draft, name: &str, time: (f64, f64)) -> Case {
    let image =
        Image { dimensions: [plain.dimension, draft.dimension], ..Image::same(draft.dimension) };
    let scene = text(plain, "twin", time.1);
    case(draft, name, time, Truth::Twin(scene, image))
}

/// One of the steps, and so many of them.
pub(super) fn time(dice: &mut Dice, steps: &[f64], duration: f64) -> (f64, f64) {
    let step = *dice.one_of(steps);
    // whole steps, so that a tenth of one meets all of them
    (step, (duration / step).round().max(1.0) * step)
}

/// Ten to a power between.
pub(super) fn decades(dice: &mut Dice, from: f64, to: f64) -> f64 {
    10_f64.powf(dice.between(from, to))
}
