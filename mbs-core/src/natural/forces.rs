//! Effects as elements: scalar laws along a length or an angle, point forces, torques on bodies.
//!
//! ```text
//! measure m(q), tension f(m, m'):   Q = -f dm/dq
//! force F at p = sum a_k e_k:       Q_k = A_k^T F
//! torque tau on a spatial body:     Q = 1/2 sum_i (tau x u_i) on its three orthonormal directions u_i
//! ```

use super::rotation::{rotation, unwrap};
use crate::Real;
use crate::algebra::{Vector, cross, lowered, norm, raised};
use crate::effects::Law;
use crate::elements::{CoupledTables, Curves, Span, Term, combine};
use crate::laws::LawInputs;
use crate::laws::scalar::ScalarForce;

/// Quantity that a scalar law measures, by combinations of entities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Measure<T> {
    /// Length of a combination.
    Length { x: Span },
    /// Distance of a combination along a direction.
    Along { x: Span, d: Span, offset: T },
    /// Component of the rotation vector of the second frame relative to the first, unwrapped against the three numbers from
    /// `memory` on.
    Rotation { frames: [[Span; 3]; 2], number: u32, memory: u32 },
    /// Angle of y in the frame x1, x2, unwrapped against the remembered number at `memory`.
    Angle { x1: Span, x2: Span, y: Span, memory: u32 },
    /// Sum of terms, a span of the table of coupling terms.
    Sum { terms: Span },
}

/// Scalar law of a measured quantity, with the place of the gradient in the Jacobian store.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasureElement<T> {
    pub(crate) gauge: Measure<T>,
    pub(crate) law: Law<T>,
    pub(crate) place: Span,
}

/// Force at a point. A force in body axes rotates with the directions of `frame`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PointForce {
    pub(crate) point: Span,
    pub(crate) course: u32,
    /// Directions of the body, three in space and two in the plane, if the force rotates with the body; `None`: global axes.
    pub(crate) frame: Option<[Span; 3]>,
    pub(crate) force: Span,
}

/// Torque vector on a spatial body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyTorque {
    pub(crate) frame: [Span; 3],
    pub(crate) course: u32,
    pub(crate) force: Span,
}

impl<T: Real> MeasureElement<T> {
    /// Evaluates the measure, its rate, its gradient and the law at (q, v).
    pub(crate) fn evaluate<const D: usize>(
        &self,
        tables: &CoupledTables<'_, T, impl Curves<T>>,
        (q, v, memory): (&[T], &[T], &[T]),
        law_inputs: &LawInputs<'_, T>,
        jacobian: &mut [T],
    ) -> ScalarForce<T> {
        let pool = tables.pool;
        let row = self.place.of_mut(jacobian);
        row.fill(T::ZERO);
        let (value, rate) = match self.gauge {
            Measure::Length { x } => length::<T, D>(x.of(pool), q, v, row),
            Measure::Along { x, d, offset } => {
                let (value, rate) =
                    product::<T, D>([x, d].map(|x| x.of(pool)), (q, v), T::ONE, row);
                (value - offset, rate)
            }
            Measure::Rotation { frames, number, memory: place } => {
                let last = &memory[place as usize..][..3];
                let frames = frames.map(|frame| frame.map(|x| x.of(pool)));
                rotation::<T, D>(frames, number as usize, (q, v), last, row)
            }
            Measure::Angle { x1, x2, y, memory: turn } => {
                let spans = [x1.of(pool), x2.of(pool), y.of(pool)];
                angle::<T, D>(spans, q, v, memory[turn as usize], row)
            }
            Measure::Sum { terms } => tables.measure::<D>(terms, (q, v, memory), row),
        };
        let measure = self.law.evaluate(value, rate, law_inputs);
        match self.gauge {
            Measure::Length { .. } if value > T::ZERO && measure.tension > T::ZERO => {
                ScalarForce { transverse: measure.tension / value, ..measure }
            }
            _ => measure,
        }
    }

    /// Energy that the elastic part of the law stores at the measured value [J].
    pub(crate) fn energy(&self, measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T {
        self.law.energy(measure.value, law_inputs)
    }

    /// Power that is not stored [W]: dampers dissipate it, signals supply it.
    pub(crate) fn power(&self, measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T {
        self.law.power(measure, law_inputs)
    }
}

/// Length of a combination and its rate. The gradient, zero at length zero where the line has no direction, is added to the row.
fn length<T: Real, const D: usize>(x: &[Term<T>], q: &[T], v: &[T], row: &mut [T]) -> (T, T) {
    let (d, w): (Vector<T, D>, Vector<T, D>) = (combine(x, q), combine(x, v));
    let value = norm(&d);
    if value == T::ZERO {
        return (value, T::ZERO);
    }
    let n = d * (T::ONE / value);
    for term in x {
        crate::algebra::add_to(row, term.column as usize, &term.coef.apply_transposed(&n));
    }
    (value, n.dot(&w))
}

/// Product s x.y of two combinations, and its rate. The gradient is added to the row.
fn product<T: Real, const D: usize>(
    [x, y]: [&[Term<T>]; 2],
    (q, v): (&[T], &[T]),
    s: T,
    row: &mut [T],
) -> (T, T) {
    let (px, py): (Vector<T, D>, Vector<T, D>) = (combine(x, q) * s, combine(y, q));
    let (wx, wy): (Vector<T, D>, Vector<T, D>) = (combine(x, v) * s, combine(y, v));
    for (terms, g) in [(x, py * s), (y, px)] {
        for term in terms {
            crate::algebra::add_to(row, term.column as usize, &term.coef.apply_transposed(&g));
        }
    }
    (px.dot(&py), wx.dot(&py) + px.dot(&wy))
}

/// Angle atan2(x2.y, x1.y), unwrapped to be nearest to `last`, its rate and gradient.
fn angle<T: Real, const D: usize>(
    [x1, x2, y]: [&[Term<T>]; 3],
    q: &[T],
    v: &[T],
    last: T,
    row: &mut [T],
) -> (T, T) {
    let (p1, p2, py): (Vector<T, D>, Vector<T, D>, Vector<T, D>) =
        (combine(x1, q), combine(x2, q), combine(y, q));
    let (w1, w2, wy): (Vector<T, D>, Vector<T, D>, Vector<T, D>) =
        (combine(x1, v), combine(x2, v), combine(y, v));
    let (c, s) = (p1.dot(&py), p2.dot(&py));
    let inverse = T::ONE / (c * c + s * s);
    let (c, s) = (c * inverse, s * inverse);
    // gradient of the angle: d theta = c d(x2.y) - s d(x1.y)
    let across = p2 * c - p1 * s;
    for (terms, g) in [(x2, py * c), (x1, py * -s), (y, across)] {
        for term in terms {
            crate::algebra::add_to(row, term.column as usize, &term.coef.apply_transposed(&g));
        }
    }
    let rate = (w2 * c - w1 * s).dot(&py) + across.dot(&wy);
    (unwrap(s.atan2(c), last), rate)
}

/// Adds the generalised forces of a torque on a spatial body to the local force vector.
pub(crate) fn add_torque<T: Real, const D: usize>(
    pool: &[Term<T>],
    frame: &[Span; 3],
    torque: [T; 3],
    q: &[T],
    local: &mut [T],
) {
    let tau = Vector::<T, 3>::from(torque);
    for span in frame {
        let u: Vector<T, D> = combine(span.of(pool), q);
        let f = cross(&tau, &raised(&u)) * T::HALF;
        add_terms::<T, D>(span.of(pool), &lowered(&f), local);
    }
}

/// Adds the generalised forces A_k^T F of a force on a combination to the local force vector. Constant entities are skipped.
pub(crate) fn add_terms<T: Real, const D: usize>(
    terms: &[Term<T>],
    f: &Vector<T, D>,
    local: &mut [T],
) {
    for term in terms {
        let column = term.column as usize;
        if column + D <= local.len() {
            crate::algebra::add_to(local, column, &term.coef.apply_transposed(f));
        }
    }
}
