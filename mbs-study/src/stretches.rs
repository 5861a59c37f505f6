//! Parts of a repeated run, which has the same steps or rows as the original run. An observer examines the run after each part.

use mbs::ResolvedMethod;
use mbs::inside::{Stretch, step};
use mbs_core::scene::Scene;

/// Returns the steps of a method. If the method controls their lengths, returns the intervals between its rows.
pub(crate) fn stretches(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    is_controlled: bool,
) -> impl Iterator<Item = Stretch<f64>> {
    let lengths = settings.lengths(scene);
    (1..=settings.n_steps()).map(move |k| {
        let step = step(settings, &lengths, k);
        if is_controlled { Stretch { fixed: None, ..step } } else { step }
    })
}
