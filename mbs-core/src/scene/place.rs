//! Places of checks in a scene, and checks of numbers and vectors there.

use crate::Real;
use crate::joint::Dimension;
use crate::scene::{Entry, SceneError, SceneFault};

/// Place of a check: entry of the scene, and dimension.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) entry: Entry,
    pub(crate) dimension: Dimension,
}

impl Place {
    pub(crate) fn fault(self, field: &'static str, fault: SceneFault) -> Result<(), SceneError> {
        Err(SceneError { entry: self.entry, field, fault })
    }

    pub(crate) fn finite<T: Real>(self, field: &'static str, x: T) -> Result<(), SceneError> {
        if x.is_finite() { Ok(()) } else { self.fault(field, SceneFault::NotFinite) }
    }

    pub(crate) fn positive<T: Real>(self, field: &'static str, x: T) -> Result<(), SceneError> {
        self.finite(field, x)?;
        if x > T::ZERO { Ok(()) } else { self.fault(field, SceneFault::NotPositive(x.to_f64())) }
    }

    /// Checks that two numbers are positive, the larger one first.
    pub(crate) fn descending<T: Real>(
        self,
        field: &'static str,
        [upper, lower]: [T; 2],
    ) -> Result<(), SceneError> {
        self.positive(field, upper)?;
        self.positive(field, lower)?;
        if upper > lower {
            return Ok(());
        }
        self.fault(field, SceneFault::LimitOrder([upper.to_f64(), lower.to_f64()]))
    }

    pub(crate) fn not_negative<T: Real>(self, field: &'static str, x: T) -> Result<(), SceneError> {
        self.finite(field, x)?;
        if x >= T::ZERO { Ok(()) } else { self.fault(field, SceneFault::Negative(x.to_f64())) }
    }

    /// Checks that the components are finite, and that the third one is zero in a planar scene.
    pub(crate) fn vector<T: Real>(self, field: &'static str, v: [T; 3]) -> Result<(), SceneError> {
        for x in v {
            self.finite(field, x)?;
        }
        if is_planar(self.dimension) && !v[2].is_zero() {
            return self.fault(field, SceneFault::OutOfPlane(v[2].to_f64()));
        }
        Ok(())
    }

    /// Checks a vector that must have a direction.
    pub(crate) fn axis<T: Real>(self, field: &'static str, v: [T; 3]) -> Result<(), SceneError> {
        self.vector(field, v)?;
        if largest(v).is_zero() { self.fault(field, SceneFault::ZeroAxis) } else { Ok(()) }
    }

    /// Checks that two points differ.
    pub(crate) fn apart<T: Real>(
        self,
        field: &'static str,
        [p, q]: [[T; 3]; 2],
    ) -> Result<(), SceneError> {
        self.vector(field, p)?;
        self.vector(field, q)?;
        let distance = largest([p[0] - q[0], p[1] - q[1], p[2] - q[2]]);
        let size = largest(p).max(largest(q));
        if distance <= T::from_f64(8.0) * T::EPSILON * size {
            return self.fault(field, SceneFault::CoincidentPoints);
        }
        Ok(())
    }
}

/// Largest absolute value of the components.
pub(crate) fn largest<T: Real>(v: [T; 3]) -> T {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

/// Largest |a × b| of directions that count as parallel, in units of rounding of |a| |b| [-]. Chosen, not tuned.
const PARALLEL_ROUNDINGS: f64 = 64.0;

/// True if two directions are equal or opposite, within rounding errors. The largest component of a × b is compared with those of a
/// and b.
pub(crate) fn is_parallel<T: Real>(a: [T; 3], b: [T; 3]) -> bool {
    let (a, b) = (scaled(a), scaled(b));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    largest(cross) <= T::from_f64(PARALLEL_ROUNDINGS) * T::EPSILON
}

fn scaled<T: Real>(v: [T; 3]) -> [T; 3] {
    let size = largest(v);
    v.map(|x| x / size)
}

/// True if the scene is planar.
pub(crate) fn is_planar(dimension: Dimension) -> bool {
    dimension == Dimension::Planar
}

/// Checks the rows of a table: at least one, each later than the one before.
pub(crate) fn check_times<T: Real>(
    times: impl Iterator<Item = T>,
    place: Place,
) -> Result<(), SceneError> {
    let mut previous = None;
    for (row, time) in times.enumerate() {
        if previous.is_some_and(|before| time <= before) {
            return place.fault("table", SceneFault::TableOrder(row));
        }
        previous = Some(time);
    }
    match previous {
        Some(_) => Ok(()),
        None => place.fault("table", SceneFault::WrongCount { needed: 1, found: 0 }),
    }
}
