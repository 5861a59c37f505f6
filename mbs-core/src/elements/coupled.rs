//! Coupling element: a sum of joint coordinates and lengths that is constrained.
//!
//! ```text
//! phi    = (sum_k c_k f_k(m_k) - s(t)) / c            c: the largest |c_k|;  m_k: a sum of measures;  f_k: a curve, or m_k itself
//! angle    C = x1.y, S = x2.y, r^2 = C^2 + S^2:  grad = (C grad S - S grad C)/r^2
//!          bias = (C S_b - S C_b)/r^2 - 2 (C C' + S S')/r^2 rate,   S_b = 2 x2'.y', C_b = 2 x1'.y'
//! slide    x.y                                  bias = 2 x'.y'
//! length   |x|,  n = x / |x|:  grad = n        bias = (x'.x' - (n.x')^2) / |x|
//! curve    f' grad,   f' bias + f'' rate^2
//! ```
//!
//! Angles are unwrapped against those of the last step. If the sum is linear and constant, a step adds the change of each measure
//! to phi. So no digits are lost after many turns.

use super::ball;
use super::combination::{Span, Term, add_gradient, combine};
use crate::Real;
use crate::algebra::{Vector, norm};

/// Sentinel value for "none" in a table of numbers.
pub const NONE: u32 = u32::MAX;

/// Number that is computed from natural coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measurand<T> {
    /// Angle of y in the frame x1, x2, unwrapped against the remembered number at `memory`.
    Angle {
        /// Direction at angle zero.
        x1: Span,
        /// Direction at a quarter turn further.
        x2: Span,
        /// Direction whose angle is measured.
        y: Span,
        /// Place of the last angle among the remembered numbers.
        memory: u32,
    },
    /// Slide of two points along a direction, x.y.
    Slide {
        /// Vector from the first body's point to the second's.
        x: Span,
        /// Direction of the slide, along which x is measured.
        y: Span,
    },
    /// Length of x, less its length in the reference configuration.
    Length {
        /// Vector from one point to the next.
        x: Span,
        /// Length in the reference configuration [m].
        reference: T,
    },
    /// Swing of a ball joint: the angle between two directions.
    Swing {
        /// Direction fixed in the first body.
        a: Span,
        /// Direction fixed in the second body.
        b: Span,
    },
    /// Twist of a ball joint, unwrapped against the remembered number at `memory`.
    Twist {
        /// Two directions perpendicular to the axis, in the first body.
        first: [Span; 2],
        /// Two directions perpendicular to the axis, in the second body.
        second: [Span; 2],
        /// Place of the last angle among the remembered numbers.
        memory: u32,
    },
}

/// Term of a sum: a factor times a function of measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledTerm<T> {
    /// Factor of the term, divided by the largest factor.
    pub factor: T,
    /// Measures of the term, as a span of their table. The term is a function of their sum, in which each measure counts with its
    /// sign.
    pub measures: Span,
    /// Curve of the term, by its number in the table of curves; [`NONE`]: the sum itself.
    pub curve: u32,
}

/// A measure with its sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signed<T> {
    /// Sign with which the measure counts.
    pub sign: T,
    /// Measure without its sign.
    pub of: Measurand<T>,
}

/// Constraint row of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupled<T> {
    /// Terms of the coupling, as a span of their table.
    pub terms: Span,
    /// Inverse of the largest factor, by which the sum is multiplied.
    pub inverse: T,
    /// Number of the guide that prescribes the sum; [`NONE`]: the sum is zero.
    pub guide: u32,
    /// Function of the terms that is constrained.
    pub form: CoupledForm,
    /// Number of the row, its place in `phi`.
    pub row: u32,
    /// Place of the row in the Jacobian store.
    pub place: Span,
}

/// Function of its terms that a coupling constrains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoupledForm {
    /// A sum that is constant, and without curves.
    Linear,
    /// A sum that follows time, or has curves.
    Sum,
    /// User-defined relation, given by its number.
    Relation(u32),
}

/// Tables to which couplings refer.
#[derive(Debug, Clone, Copy)]
pub struct CoupledTables<'a, T, F> {
    /// Terms of the couplings.
    pub terms: &'a [CoupledTerm<T>],
    /// Measures of the terms, each with its sign.
    pub measures: &'a [Signed<T>],
    /// Pool of the combinations of entities that measures refer to.
    pub pool: &'a [Term<T>],
    /// The curves by number.
    pub curves: &'a F,
}

/// Curves of couplings by number.
pub trait Curves<T> {
    /// Value f, slope f' and curvature f'' of a curve at `x`.
    fn at(&self, curve: u32, x: T) -> [T; 3];
    /// Change f(x + dx) - f(x), computed without cancellation.
    fn change(&self, curve: u32, x: T, dx: T) -> T;
}

impl<T: Real, F: Curves<T>> CoupledTables<'_, T, F> {
    /// Value, slope and curvature of a term's curve; the identity without a curve.
    pub fn function(&self, curve: u32, x: T) -> [T; 3] {
        if curve == NONE { [x, T::ONE, T::ZERO] } else { self.curves.at(curve, x) }
    }

    /// Value f(x), and the change f(x + dx) - f(x).
    fn parts(&self, curve: u32, x: T, dx: T) -> [T; 2] {
        if curve == NONE {
            return [x, dx];
        }
        [self.curves.at(curve, x)[0], self.curves.change(curve, x, dx)]
    }
}

impl<T: Real, F: Curves<T>> CoupledTables<'_, T, F> {
    /// Returns a sum of terms and its rate, and writes its gradient to `row`, which must be zero before. Angles are those nearest
    /// to `memory`.
    #[inline(never)]
    pub fn measure<const D: usize>(
        &self,
        terms: Span,
        (q, v, memory): (&[T], &[T], &[T]),
        row: &mut [T],
    ) -> (T, T) {
        let at = |x: Span| combine::<T, D>(x.of(self.pool), q);
        let moving = |x: Span| combine::<T, D>(x.of(self.pool), v);
        let (mut sum, mut rate) = (T::ZERO, T::ZERO);
        for term in terms.of(self.terms) {
            let measures = term.measures.of(self.measures);
            let (mut m, mut m_t) = (T::ZERO, T::ZERO);
            for measure in measures {
                m += measure.sign * value(&measure.of, at, memory);
                m_t += measure.sign * rate_and_bias(&measure.of, at, moving)[0];
            }
            let [f, slope, _] = self.function(term.curve, m);
            sum += term.factor * f;
            rate += term.factor * slope * m_t;
            for measure in measures {
                let weight = term.factor * slope * measure.sign;
                add_measure_gradient(&measure.of, self.pool, at, weight, row);
            }
        }
        (sum, rate)
    }
}

impl<T: Real> Coupled<T> {
    /// Writes value and gradient at `q`; angles are those nearest to `memory`.
    #[inline(never)]
    pub fn evaluate<const D: usize>(
        &self,
        tables: &CoupledTables<'_, T, impl Curves<T>>,
        (q, memory): (&[T], &[T]),
        sum: T,
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let at = |x: Span| combine::<T, D>(x.of(tables.pool), q);
        let value = self.evaluate_with(tables, at, (memory, sum), self.place.of_mut(jacobian));
        phi[self.row as usize] = value;
    }

    /// Writes value and gradient at `q + dq`. If the sum is linear and constant, the value starts from `phi_n`, the value at `q`.
    #[inline(never)]
    pub fn advance<const D: usize>(
        &self,
        tables: &CoupledTables<'_, T, impl Curves<T>>,
        (q, dq, memory): (&[T], &[T], &[T]),
        (phi_n, sum): (&[T], T),
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let before = |x: Span| combine::<T, D>(x.of(tables.pool), q);
        let change = |x: Span| combine::<T, D>(x.of(tables.pool), dq);
        let at = |x: Span| before(x) + change(x);
        let (gradient, row) = (self.place.of_mut(jacobian), self.row as usize);
        if self.form != CoupledForm::Linear {
            phi[row] = self.evaluate_with(tables, at, (memory, sum), gradient);
            return;
        }
        gradient.fill(T::ZERO);
        phi[row] = phi_n[row];
        for term in self.terms.of(tables.terms) {
            for measure in term.measures.of(tables.measures) {
                let weight = term.factor * measure.sign;
                phi[row] += weight * increment(&measure.of, before, change);
                add_measure_gradient(&measure.of, tables.pool, at, weight, gradient);
            }
        }
    }

    /// Computes phi, with its gradient in `row`. The parts that are constant in a step (remembered angles and the prescribed sum)
    /// are added first, and the changing parts then. So iterations see no rounding errors of full turns.
    fn evaluate_with<const D: usize>(
        &self,
        tables: &CoupledTables<'_, T, impl Curves<T>>,
        at: impl Fn(Span) -> Vector<T, D> + Copy,
        (memory, sum): (&[T], T),
        row: &mut [T],
    ) -> T {
        row.fill(T::ZERO);
        let (mut kept, mut change) = (-sum * self.inverse, T::ZERO);
        for term in self.terms.of(tables.terms) {
            let measures = term.measures.of(tables.measures);
            let (mut m, mut dm) = (T::ZERO, T::ZERO);
            for measure in measures {
                let [base, more] = base_and_change(&measure.of, at, memory);
                m += measure.sign * base;
                dm += measure.sign * more;
            }
            let [f, df] = tables.parts(term.curve, m, dm);
            kept += term.factor * f;
            change += term.factor * df;
            let [_, slope, _] = tables.function(term.curve, m + dm);
            for measure in measures {
                let weight = term.factor * slope * measure.sign;
                add_measure_gradient(&measure.of, tables.pool, at, weight, row);
            }
        }
        kept + change
    }

    /// The part of phi'' without accelerations; `sum` is the prescribed sum with its derivatives.
    #[inline(never)]
    pub fn bias<const D: usize>(
        &self,
        tables: &CoupledTables<'_, T, impl Curves<T>>,
        (q, v, memory): (&[T], &[T], &[T]),
        sum: [T; 3],
    ) -> T {
        let at = |x: Span| combine::<T, D>(x.of(tables.pool), q);
        let rate = |x: Span| combine::<T, D>(x.of(tables.pool), v);
        let terms = self.terms.of(tables.terms).iter();
        terms.fold(-sum[2] * self.inverse, |total, term| {
            let (mut m, mut m_t, mut m_b) = (T::ZERO, T::ZERO, T::ZERO);
            for measure in term.measures.of(tables.measures) {
                let [r, b] = rate_and_bias(&measure.of, at, rate);
                m += measure.sign * value(&measure.of, at, memory);
                m_t += measure.sign * r;
                m_b += measure.sign * b;
            }
            let [_, slope, bend] = tables.function(term.curve, m);
            total + term.factor * (slope * m_b + bend * m_t * m_t)
        })
    }

    /// The partial derivative of phi with respect to time.
    pub fn phi_t(&self, sum: [T; 3]) -> T {
        -sum[1] * self.inverse
    }
}

/// Value of a measure. An angle is the one nearest to the remembered angle.
pub fn value<T: Real, const D: usize>(
    of: &Measurand<T>,
    at: impl Fn(Span) -> Vector<T, D>,
    memory: &[T],
) -> T {
    let [base, change] = base_and_change(of, at, memory);
    base + change
}

/// Remembered angle, and the difference of the current angle from it. For a measure that is no angle: zero and the value.
pub(super) fn base_and_change<T: Real, const D: usize>(
    of: &Measurand<T>,
    at: impl Fn(Span) -> Vector<T, D>,
    memory: &[T],
) -> [T; 2] {
    match *of {
        Measurand::Angle { x1, x2, y, memory: place } => {
            let y = at(y);
            let (c, s) = (at(x1).dot(&y), at(x2).dot(&y));
            from_last(memory[place as usize], [c, s])
        }
        Measurand::Swing { a, b } => [T::ZERO, ball::swing(&[at(a), at(b)])],
        Measurand::Twist { first, second, memory: place } => {
            let parts = ball::twist_parts(&first.map(&at), &second.map(&at));
            from_last(memory[place as usize], parts)
        }
        Measurand::Slide { x, y } => [T::ZERO, at(x).dot(&at(y))],
        Measurand::Length { x, reference } => [T::ZERO, norm(&at(x)) - reference],
    }
}

/// Returns the last angle, and the difference of the new angle from it. `c` and `s` are cosine and sine of the new angle, times a
/// common factor.
fn from_last<T: Real>(last: T, [c, s]: [T; 2]) -> [T; 2] {
    let (sin, cos) = last.sin_cos();
    [last, (s * cos - c * sin).atan2(c * cos + s * sin)]
}

/// Least 1 + cos(swing) for which the twist is defined [-]: 1e-3 rad from half a turn. Closer to it the twist is a rounding error.
const OPEN: f64 = 5e-7;

/// True if the twist of a ball joint is undefined. `one_and_cosine` is 1 + cos of its swing.
#[must_use]
pub fn is_open<T: Real>(one_and_cosine: T) -> bool {
    !(one_and_cosine > T::from_f64(OPEN))
}

impl<T: Real> Measurand<T> {
    /// True if the measure is a twist that is undefined.
    pub fn is_open<const D: usize>(&self, at: impl Fn(Span) -> Vector<T, D>) -> bool {
        match *self {
            Self::Twist { first, second, .. } => {
                let [c, s] = ball::twist_parts(&first.map(&at), &second.map(&at));
                is_open((c * c + s * s).sqrt())
            }
            _ => false,
        }
    }
}

/// Change of a measure if coordinates change from `q` by `dq`, computed without cancellation.
fn increment<T: Real, const D: usize>(
    of: &Measurand<T>,
    at: impl Fn(Span) -> Vector<T, D>,
    change: impl Fn(Span) -> Vector<T, D>,
) -> T {
    // change of the product x.y
    let product = |x: Span, y: Span| {
        let (dx, dy) = (change(x), change(y));
        dx.dot(&(at(y) + dy)) + at(x).dot(&dy)
    };
    match *of {
        Measurand::Angle { x1, x2, y, .. } => {
            let (c, s) = (at(x1).dot(&at(y)), at(x2).dot(&at(y)));
            let (dc, ds) = (product(x1, y), product(x2, y));
            (ds * c - dc * s).atan2(c * (c + dc) + s * (s + ds))
        }
        Measurand::Slide { x, y } => product(x, y),
        // no constraint row contains a swing or twist
        Measurand::Swing { .. } | Measurand::Twist { .. } => T::ZERO,
        Measurand::Length { x, .. } => {
            let (before, dx) = (at(x), change(x));
            let lengths = norm(&before) + norm(&(before + dx));
            if lengths == T::ZERO { T::ZERO } else { dx.dot(&(before + before + dx)) / lengths }
        }
    }
}

/// Squared length that counts as zero, relative to the squared length at the other end of a step [-]. Below it, rounding errors
/// determine the direction.
const NO_LENGTH: f64 = 1e-18;
/// Closest distance of two points in a step, relative to their relative path [-]. Below it the step does not resolve how they pass.
const MEETING: f64 = 1e-2;

/// True if a part of a line loses its length in a step. Either its length is zero at an end of the step, or its ends meet during
/// the step, so that its direction reverses.
///
/// ```text
/// d: vector before the step, e: after it, d': its rate:   d.e < 0,   d.d' < 0,   |d x e| <= c |d - e|^2
/// ```
///
/// The array `dots` contains the products d.d, d.e, e.e and d.d'; c is `MEETING`. Cost: ten operations.
pub fn has_collapsed<T: Real>(dots: [T; 4]) -> bool {
    let [dd, de, ee, shortening] = dots;
    if dd.min(ee) <= T::from_f64(NO_LENGTH) * dd.max(ee) {
        return true;
    }
    let way = (dd - T::TWO * de + ee) * T::from_f64(MEETING);
    de < T::ZERO && shortening < T::ZERO && dd * ee - de * de <= way * way
}

/// Adds the gradient of a measure, times `weight`, to the row.
pub fn add_measure_gradient<T: Real, const D: usize>(
    of: &Measurand<T>,
    pool: &[Term<T>],
    at: impl Fn(Span) -> Vector<T, D>,
    weight: T,
    row: &mut [T],
) {
    match *of {
        Measurand::Angle { x1, x2, y, .. } => {
            let (p1, p2, py) = (at(x1), at(x2), at(y));
            let (c, s) = (p1.dot(&py), p2.dot(&py));
            let by = weight / (c * c + s * s);
            let (c, s) = (c * by, s * by);
            add_gradient(row, x2.of(pool), &(py * c));
            add_gradient(row, x1.of(pool), &(py * -s));
            add_gradient(row, y.of(pool), &(p2 * c - p1 * s));
        }
        Measurand::Slide { x, y } => {
            add_gradient(row, x.of(pool), &(at(y) * weight));
            add_gradient(row, y.of(pool), &(at(x) * weight));
        }
        Measurand::Swing { a, b } => {
            let [by_a, by_b] = ball::swing_gradient(&[at(a), at(b)]);
            add_gradient(row, a.of(pool), &(by_a * weight));
            add_gradient(row, b.of(pool), &(by_b * weight));
        }
        Measurand::Twist { first, second, .. } => {
            let by = ball::twist_gradient(&first.map(&at), &second.map(&at));
            for (spans, by) in [first, second].iter().zip(by) {
                for (span, by) in spans.iter().zip(by) {
                    add_gradient(row, span.of(pool), &(by * weight));
                }
            }
        }
        Measurand::Length { x, .. } => {
            let d = at(x);
            let length = norm(&d);
            // a line of length zero has no direction
            if length > T::ZERO {
                add_gradient(row, x.of(pool), &(d * (weight / length)));
            }
        }
    }
}

/// Rate m' of a measure, and the part of m'' without accelerations.
pub fn rate_and_bias<T: Real, const D: usize>(
    of: &Measurand<T>,
    at: impl Fn(Span) -> Vector<T, D>,
    rate: impl Fn(Span) -> Vector<T, D>,
) -> [T; 2] {
    match *of {
        Measurand::Angle { x1, x2, y, .. } => {
            let (p1, p2, py) = (at(x1), at(x2), at(y));
            let (w1, w2, wy) = (rate(x1), rate(x2), rate(y));
            let (c, s) = (p1.dot(&py), p2.dot(&py));
            let (c_t, s_t) = (w1.dot(&py) + p1.dot(&wy), w2.dot(&py) + p2.dot(&wy));
            let (c_b, s_b) = (T::TWO * w1.dot(&wy), T::TWO * w2.dot(&wy));
            let inverse = T::ONE / (c * c + s * s);
            let turn = (c * s_t - s * c_t) * inverse;
            [turn, ((c * s_b - s * c_b) - T::TWO * (c * c_t + s * s_t) * turn) * inverse]
        }
        Measurand::Slide { x, y } => {
            let (wx, wy) = (rate(x), rate(y));
            [wx.dot(&at(y)) + at(x).dot(&wy), T::TWO * wx.dot(&wy)]
        }
        Measurand::Swing { a, b } => ball::swing_rates(&[at(a), at(b)], &[rate(a), rate(b)]),
        Measurand::Twist { first, second, .. } => ball::twist_rates(
            (&first.map(&at), &second.map(&at)),
            (&first.map(&rate), &second.map(&rate)),
        ),
        Measurand::Length { x, .. } => {
            let (d, w) = (at(x), rate(x));
            let length = norm(&d);
            if length == T::ZERO {
                return [T::ZERO; 2];
            }
            let along = d.dot(&w) / length;
            [along, (w.dot(&w) - along * along) / length]
        }
    }
}
