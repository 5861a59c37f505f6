//! Courses over time: constants and tables.

use super::is_planar;
use super::motion::check_times;
use super::vector::Place;
use crate::Real;
use crate::scene::{SceneError, Signal};

/// Finite numbers, in the plane where a vector is meant, and increasing times.
pub(super) fn check<T: Real>(
    course: &Signal<T>,
    is_vector: bool,
    place: Place,
) -> Result<(), SceneError> {
    let row = |field, value: [T; 3]| {
        if is_vector && is_planar(place.dimension) {
            return place.vector(field, value);
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
