//! Test whether a motion is steady, and its linearisation in axes that turn with the motion.
//!
//! ```text
//! Omega: the turning of the whole about gravity, by which vectors x of bodies change:   x'' = Omega x x'
//! x_c = C^T x,   x_c' = C^T x' - Omega x x_c,   w_c' = C^T w' - Omega x w_c,   C = exp(Omega (t - t_0))
//! steady: w_c' = 0 in all states, at the state and a little later, with the same A in these axes
//! ```
//!
//! C is the rotation matrix of the axes at time t, and the index c denotes components in these axes. w is the rate of a state. Joint
//! coordinates of one freedom are the same in all axes. For joints with vector coordinates, the coordinates of bodies are used instead;
//! their vectors are in global axes.

use super::measured::Layout;
use crate::unsteady::Unsteady;
use mbs_core::algebra::{Matrix, Vector, rotation};
use mbs_core::scene::{Dimension, Scene};

/// Angle of the motion after which it is linearised again [rad]. A quantity with one period per turn then has changed by about a thirtieth.
/// One step of an integrator of order four over this angle has an error of 1e-10.
const PHASE: f64 = 0.03;
/// Largest acceleration in the turning axes for which a motion counts as steady [-]. It is relative to the acceleration that a deviation of
/// one radian, or of the scene's length, causes. Initial values that are written with seven digits stay below this limit.
const STEADY: f64 = 1e-6;
/// Largest acceleration that rounding errors cause, relative to the largest ratio of force to inertia [-].
const LEFT: f64 = 1e-9;
/// Largest change of an entry of A over the angle `PHASE` in a steady motion, relative to the largest entry of its row [-]. It is 1e-4 per
/// radian, because the entries change by 1e-5 for a state that is steady to seven digits.
const UNCHANGED: f64 = 1e-4 * PHASE;
/// Allowed change of entries of A, in units of the rounding error of squared eigenvalues [-]. It covers the rounding errors of both
/// matrices and of the step between the two states. Chosen, not tuned.
const ROUNDINGS: f64 = 1e2;

/// Axes that turn with a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning {
    /// Angular velocity Omega of the axes [rad/s].
    pub(super) rate: Vector<f64, 3>,
    /// Rotation matrix C of the axes; the identity at the first state.
    pub(super) axes: Matrix<f64, 3>,
}

/// Derivatives of one measured value by states and by inputs, or the value alone.
pub(super) type Row = Vec<f64>;

impl Turning {
    /// Returns axes that do not turn.
    pub(super) fn none() -> Self {
        Self { rate: Vector::zeros(), axes: Matrix::<f64, 3>::identity() }
    }

    /// Returns the turning axes of a state, from its measured values. Their angular velocity Omega is that of the vectors among the chosen
    /// states.
    pub(super) fn of(
        scene: &Scene<f64>,
        (layout, chosen): (&Layout, &[usize]),
        (values, sizes): (&[f64], &Sizes),
    ) -> Self {
        let [rates, accelerations] = [1, 3].map(|part| layout.part(part));
        let (mut square, mut moment) = (Matrix::<f64, 3>::zeros(), Vector::<f64, 3>::zeros());
        let is_chosen =
            |[first, n]: &&[usize; 2]| chosen.iter().any(|i| (*first..*first + *n).contains(i));
        for &[first, n] in layout.vectors.iter().filter(is_chosen) {
            let size = sizes.of(layout.units[first]);
            let of = |part: &dyn Fn(usize) -> usize| -> Vector<f64, 3> {
                Vector::from_fn(|i, _| if i < n { values[part(first + i)] / size } else { 0.0 })
            };
            let (v, a) = (of(&rates), of(&accelerations));
            if !(v.norm() > STILL * sizes.rate) {
                continue;
            }
            square += Matrix::<f64, 3>::identity() * v.dot(&v) - v * v.transpose();
            moment += v.cross(&a);
        }
        let gravity = scene.gravity.map_or_else(Vector::zeros, Vector::from);
        let is_planar = scene.dimension == Dimension::Planar;
        let axis = match (is_planar, gravity.norm() > 0.0) {
            (true, true) => return Self::none(),
            (true, false) => Vector::<f64, 3>::new(0.0, 0.0, 1.0),
            (false, true) => gravity.normalize(),
            // Without gravity, the axis is the axis about which the vectors rotate, if they rotate.
            (false, false) => {
                let norm = moment.norm();
                if norm > 0.0 { moment / norm } else { return Self::none() }
            }
        };
        let weight = axis.dot(&(square * axis));
        let rate = if weight > 0.0 { axis.dot(&moment) / weight } else { 0.0 };
        Self { rate: axis * rate, axes: Matrix::<f64, 3>::identity() }
    }

    /// Returns the axes at a time `h` [s] later.
    pub(super) fn after(&self, h: f64) -> Self {
        Self { axes: rotation(&(self.rate * h)) * self.axes, ..*self }
    }

    /// Value, rate, derivative of the value, and acceleration of coordinate `i` in these axes. `row` returns the row of a measured value.
    pub(super) fn rows(&self, layout: &Layout, i: usize, row: impl Fn(usize) -> Row) -> [Row; 4] {
        let part = |part: usize, of: usize| row(layout.part(part)(of));
        if self.rate.iter().all(|rate| *rate == 0.0) {
            return [0, 1, 2, 3].map(|k| part(k, i));
        }
        let vector = layout.vectors.iter().find(|[first, n]| (*first..*first + *n).contains(&i));
        let Some(&[first, n]) = vector else { return [0, 1, 2, 3].map(|k| part(k, i)) };
        let seen = |k: usize, component: usize| {
            let parts = (0..n).map(|j| (self.axes[(j, component)], part(k, first + j)));
            combined(parts)
        };
        let k = i - first;
        // Component k of the cross product, with indices modulo 3: (Omega x x)_k = Omega_(k+1) x_(k+2) - Omega_(k+2) x_(k+1)
        let carried = |of: usize, moved: Row| {
            let mut parts = vec![(1.0, moved)];
            for (component, by, sign) in
                [((k + 2) % 3, (k + 1) % 3, -1.0), ((k + 1) % 3, (k + 2) % 3, 1.0)]
            {
                if component < n && self.rate[by] != 0.0 {
                    parts.push((sign * self.rate[by], seen(of, component)));
                }
            }
            combined(parts.into_iter())
        };
        [seen(0, k), seen(1, k), carried(0, seen(2, k)), carried(1, seen(3, k))]
    }
}

/// Sum of rows, each multiplied by a factor.
fn combined(parts: impl Iterator<Item = (f64, Row)>) -> Row {
    let mut sum = Row::new();
    for (by, row) in parts {
        sum.resize(row.len(), 0.0);
        sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += by * x);
    }
    sum
}

/// Reference sizes of accelerations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes {
    /// The scene's length [m].
    pub(super) length: f64,
    /// Largest rate, with lengths divided by the scene's length [1/s].
    pub(super) rate: f64,
    /// Largest ratio of force to inertia, with lengths divided by the scene's length [1/s^2].
    pub(super) lively: f64,
}

/// Smallest rate of a vector that contributes to the axes, relative to the largest rate [-]. The acceleration of a slower vector is mostly
/// rounding error.
const STILL: f64 = 1e-6;
/// Longest time after which a motion is linearised again [s]. For a very slow motion the time for the angle `PHASE` would be too long.
const LONGEST: f64 = 1.0;

impl Sizes {
    /// True if there is a motion whose rates are larger than rounding errors.
    pub(super) fn has_motion(&self) -> bool {
        self.rate * self.rate > LEFT * self.lively
    }

    /// Time after which the motion is linearised again [s].
    pub(super) fn later(&self) -> f64 {
        (PHASE / self.rate).min(LONGEST)
    }

    /// Returns the reference size of a coordinate with this unit: the scene's length for `m`, else 1.
    pub(super) fn of(&self, unit: &str) -> f64 {
        if unit == "m" { self.length } else { 1.0 }
    }
}

/// Returns the state whose acceleration exceeds its limit most; `None` if no limit is exceeded. The matrix A determines the limits.
pub(super) fn accelerating(
    (layout, chosen): (&Layout, &[usize]),
    (turning, values): (&Turning, &[f64]),
    (a, sizes): (&crate::tree::Matrix, &Sizes),
) -> Option<Unsteady> {
    let (mut worst, f) = ((1.0, None), chosen.len());
    for (k, &i) in chosen.iter().enumerate() {
        let [.., acceleration] = turning.rows(layout, i, |place| vec![values[place]]);
        let (by, unit) = (acceleration[0].abs(), layout.units[i]);
        let deviations = a.row(f + k)[..2 * f].iter().enumerate().map(|(j, x)| {
            let by_rate = if j < f { 1.0 } else { sizes.rate };
            x.abs() * sizes.of(layout.units[chosen[j % f]]) * by_rate
        });
        let largest = deviations.fold(0.0, f64::max);
        let least = STEADY * largest + LEFT * sizes.lively * sizes.of(unit);
        if by > least * worst.0 {
            let state = layout.names[i].clone();
            let unit = if unit == "m" { "m/s^2" } else { "rad/s^2" };
            worst = (by / least, Some(Unsteady::Accelerates { state, by, unit }));
        }
    }
    worst.1
}

/// Returns the state whose row of A changes most between two matrices, relative to its limit; `None` if no limit is exceeded. `noise` is
/// the rounding error of squared eigenvalues [1/s^2].
pub(super) fn changing(
    names: &[String],
    [a, b]: [&crate::tree::Matrix; 2],
    noise: f64,
) -> Option<Unsteady> {
    let mut worst = (1.0, None);
    for (i, name) in names.iter().enumerate() {
        let largest = a.row(i).iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let change = a.row(i).iter().zip(b.row(i)).map(|(a, b)| (a - b).abs());
        let change = change.fold(0.0, f64::max);
        let least = UNCHANGED * largest + ROUNDINGS * noise;
        if change > least * worst.0 {
            let by = change / PHASE / largest.max(f64::MIN_POSITIVE);
            worst = (change / least, Some(Unsteady::Changes { state: name.clone(), by }));
        }
    }
    worst.1
}
