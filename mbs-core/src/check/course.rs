//! Checks of signals of effects: constants, tables, inputs and names of signals.

use crate::Real;
use crate::effects::SignalForm;
use crate::scene::place::{Place, check_times, is_planar};
use crate::scene::{SceneError, SceneFault, Signal};

/// Checks that numbers are finite, times increase, and the number of components fits the form. Without a form, all three components may
/// have any value.
pub(super) fn check<T: Real>(
    course: &Signal<T>,
    (form, n_signals): (Option<SignalForm>, usize),
    place: Place,
) -> Result<(), SceneError> {
    let needed = form.map_or(3, |form| form.n_components(place.dimension));
    let row = |field, value: [T; 3]| {
        if form == Some(SignalForm::Vector) && is_planar(place.dimension) {
            return place.vector(field, value);
        }
        let last = value.iter().rposition(|x| !x.is_zero()).unwrap_or(0);
        if needed == 1 && last > 0 {
            return place.fault(field, SceneFault::WrongCount { needed, found: last + 1 });
        }
        value.into_iter().try_for_each(|x| place.finite(field, x))
    };
    match course {
        Signal::Constant(value) | Signal::Input(value) => row("value", *value),
        Signal::Table(rows) => {
            for (time, value) in rows {
                place.finite("table", *time)?;
                row("table", *value)?;
            }
            check_times(rows.iter().map(|row| row.0), place)
        }
        Signal::Named(signals) => {
            let n = signals.iter().flatten().count();
            let is_first = signals.iter().take(n).all(Option::is_some);
            if n == 0 || !is_first || (form.is_some() && n != needed) {
                return place.fault("signal", SceneFault::WrongCount { needed, found: n });
            }
            if signals.iter().flatten().any(|signal| signal.index() >= n_signals) {
                return place.fault("signal", SceneFault::UnknownReference);
            }
            Ok(())
        }
    }
}

impl Place {
    /// Checks a signal with three arbitrary numbers, in a scene with `n_signals` named signals.
    pub(crate) fn signal<T: Real>(
        self,
        signal: &Signal<T>,
        n_signals: usize,
    ) -> Result<(), SceneError> {
        check(signal, (None, n_signals), self)
    }
}
