//! Courses over time: constants and tables.

use super::vector::{Place, check_times, is_planar};
use crate::Real;
use crate::effects::SignalForm;
use crate::scene::{SceneError, SceneFault, Signal};

/// Finite numbers, in the plane where a vector is meant, zero where one number is; and increasing times. Without a form all are free.
pub(super) fn check<T: Real>(
    course: &Signal<T>,
    form: Option<SignalForm>,
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
    }
}

impl Place {
    /// A signal of three free numbers.
    pub(crate) fn signal<T: Real>(self, signal: &Signal<T>) -> Result<(), SceneError> {
        check(signal, None, self)
    }
}
