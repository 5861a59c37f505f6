//! Stretches of a run that an observer examines, as in the original run.

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
