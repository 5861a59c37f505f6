//! Guided coordinate: a joint's angle, slide or rotation vector follows a prescribed f(t). The known coordinate adds no unknown.
//!
//! ```text
//! slide:  phi = s x.y - f
//! angle:  phi = A.y,   A = cos f x2 - sin f x1,   B = sin f x2 + cos f x1
//!         phi_t = -f' B.y
//!         bias  = A_tt.y + 2 A_t.y',   A_t  = cos f x2' - sin f x1' - f' B
//!                                      A_tt = -2 f' (sin f x2' + cos f x1') - f'' B - f'^2 A
//! rotation, component k, (i, j, k) cyclic:
//!         phi   = (z_j.y_i - z_i.y_j)/2,   z_i = sum_a R_ai x_a,   R = exp(f)
//!         phi_t, bias: z with R' = [w] R and R'' = ([w'] + [w]^2) R
//! ```
//!
//! The three rows of a rotation are the axial vector sum_i z_i x y_i / 2 in the axes of z. Its length is the sine of the deviation
//! from the guide.
//!
//! The directions x1, x2 are perpendicular to the axis in the first body, and y in the second. Since phi = sin(angle - f), the row
//! is regular for every angle. The false root, half a turn away, has B.y < 0: see [`Guided::is_opposite`].

use super::combination::{Span, Term, add_gradient, combine};
use crate::Real;
use crate::algebra::{Vector, cross, rotation, unit};
use crate::laws::spin::spin;

/// Guided coordinate: an angle, a slide, or a component of a rotation vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GuidedMotion {
    /// Angle of y in the frame x1, x2 of the first body.
    Angle {
        /// Direction at angle zero.
        x1: Span,
        /// Direction at a quarter turn further.
        x2: Span,
    },
    /// Distance along a direction, which the row has as `y`.
    Slide {
        /// Vector from the first body's point to the second's.
        x: Span,
    },
    /// Component of a rotation vector, by three directions of the first body and two of the second. The row has the second body's
    /// axis i.
    Rotation {
        /// Directions of the first body that were the global axes in the reference configuration.
        x: [Span; 3],
        /// Axis j of the second body.
        y: Span,
        /// Component k of the rotation vector, from 0.
        number: u32,
    },
}

/// Component of a rotation vector: the first body's axes, the second body's axis j, and the number k.
type Component = ([Span; 3], Span, u32);

/// Axes (i, j) that a rotation about axis k turns into each other.
fn pair(k: u32) -> (usize, usize) {
    let k = k as usize;
    ((k + 1) % 3, (k + 2) % 3)
}

/// Rotation vector from three guides that begin with `first`, with its first two derivatives.
fn vector<T: Real>(guides: &[[T; 3]], first: u32) -> [Vector<T, 3>; 3] {
    let mut f = [Vector::<T, 3>::zeros(); 3];
    for (i, guide) in guides.iter().skip(first as usize).take(3).enumerate() {
        for (vector, &number) in f.iter_mut().zip(guide) {
            vector[i] = number;
        }
    }
    f
}

/// Columns (i, j) of R = exp(f), R' and R''.
fn columns<T: Real>(guides: &[[T; 3]], first: u32, k: u32) -> [[Vector<T, 3>; 2]; 3] {
    let f = vector(guides, first);
    let [omega, omega_t] = spin(f);
    let now = turned(&f[0], k);
    let rates = now.map(|r| cross(&omega, &r));
    let second = [0, 1].map(|n| cross(&omega_t, &now[n]) + cross(&omega, &rates[n]));
    [now, rates, second]
}

/// Columns (i, j) of the rotation exp(f).
fn turned<T: Real>(f: &Vector<T, 3>, k: u32) -> [Vector<T, 3>; 2] {
    let (r, (i, j)) = (rotation(f), pair(k));
    [r * unit(i), r * unit(j)]
}

/// Returns the combination sum_a r_a x_a of three vectors.
fn mixed<T: Real, const D: usize>(r: &Vector<T, 3>, x: &[Vector<T, D>; 3]) -> Vector<T, D> {
    x[0] * r[0] + x[1] * r[1] + x[2] * r[2]
}

/// Product (z_j.y_i - z_i.y_j)/2, for columns (i, j) of a rotation or of its derivatives.
fn skew<T: Real, const D: usize>(
    r: &[Vector<T, 3>; 2],
    x: &[Vector<T, D>; 3],
    y: &[Vector<T, D>; 2],
) -> T {
    (mixed(&r[1], x).dot(&y[0]) - mixed(&r[0], x).dot(&y[1])) * T::HALF
}

/// Rheonomic (time-dependent) row of a guided coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guided {
    /// Coordinate that is guided, with the directions that measure it.
    pub motion: GuidedMotion,
    /// Direction in the second body (angle), direction of the slide, or axis i of the second body (rotation).
    pub y: Span,
    /// Number of the guide that prescribes the coordinate. For a rotation, the first of its three guides.
    pub guide: u32,
    /// Number of the row, its place in `phi`.
    pub row: u32,
    /// Place of the row in the Jacobian store.
    pub place: Span,
}

impl Guided {
    /// Passes pairs of directions with their factors to `take`. The second derivatives of phi at the current guide values follow
    /// from them.
    #[cfg(feature = "alloc")]
    pub(crate) fn each_pair<T: Real>(
        &self,
        guides: &[[T; 3]],
        mut take: impl FnMut(Span, Span, T),
    ) {
        match self.motion {
            GuidedMotion::Slide { x } => take(x, self.y, T::ONE),
            GuidedMotion::Angle { x1, x2 } => {
                let (sine, cosine) = guides[self.guide as usize][0].sin_cos();
                take(x1, self.y, -sine);
                take(x2, self.y, cosine);
            }
            GuidedMotion::Rotation { x, y, number } => {
                let r = turned(&vector(guides, self.guide)[0], number);
                for (a, x) in x.into_iter().enumerate() {
                    take(x, self.y, r[1][a] * T::HALF);
                    take(x, y, r[0][a] * -T::HALF);
                }
            }
        }
    }

    /// Writes value and gradient at `q`, with all guides at the current time.
    pub fn evaluate<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        q: &[T],
        guides: &[[T; 3]],
        store: (&mut [T], &mut [T]),
    ) {
        self.evaluate_with::<T, D>(pool, |x| combine(x.of(pool), q), guides, store);
    }

    /// Writes value and gradient at `q + dq`.
    pub fn evaluate_at_sum<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, dq): (&[T], &[T]),
        guides: &[[T; 3]],
        store: (&mut [T], &mut [T]),
    ) {
        let at = |x: Span| combine::<T, D>(x.of(pool), q) + combine::<T, D>(x.of(pool), dq);
        self.evaluate_with::<T, D>(pool, at, guides, store);
    }

    fn evaluate_with<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        at: impl Fn(Span) -> Vector<T, D>,
        guides: &[[T; 3]],
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let y = at(self.y);
        let f = guides[self.guide as usize][0];
        let row = self.place.of_mut(jacobian);
        row.fill(T::ZERO);
        match self.motion {
            GuidedMotion::Slide { x } => {
                let x_value = at(x);
                phi[self.row as usize] = x_value.dot(&y) - f;
                add_gradient(row, x.of(pool), &y);
                add_gradient(row, self.y.of(pool), &x_value);
            }
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = f.sin_cos();
                let a = at(x2) * cos - at(x1) * sin;
                phi[self.row as usize] = a.dot(&y);
                add_gradient(row, x2.of(pool), &(y * cos));
                add_gradient(row, x1.of(pool), &(y * -sin));
                add_gradient(row, self.y.of(pool), &a);
            }
            GuidedMotion::Rotation { x, y: other, number } => {
                let of = (x, other, number);
                phi[self.row as usize] = self.evaluate_rotation(pool, &at, (guides, of), row);
            }
        }
    }

    /// Writes value and gradient of a component of a rotation. A separate function, because inlining it makes the loops over rows
    /// too large.
    #[inline(never)]
    fn evaluate_rotation<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        at: &impl Fn(Span) -> Vector<T, D>,
        (guides, (x, other, number)): (&[[T; 3]], Component),
        row: &mut [T],
    ) -> T {
        let r = turned(&vector(guides, self.guide)[0], number);
        let (axes, second) = (x.map(at), [at(self.y), at(other)]);
        add_gradient(row, self.y.of(pool), &(mixed(&r[1], &axes) * T::HALF));
        add_gradient(row, other.of(pool), &(mixed(&r[0], &axes) * -T::HALF));
        for (a, x) in x.into_iter().enumerate() {
            let along = (second[0] * r[1][a] - second[1] * r[0][a]) * T::HALF;
            add_gradient(row, x.of(pool), &along);
        }
        skew(&r, &axes, &second)
    }

    /// Directions of a rotation at coordinates or velocities `q`.
    fn axes<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        (x, y): ([Span; 3], Span),
        q: &[T],
    ) -> ([Vector<T, D>; 3], [Vector<T, D>; 2]) {
        (x.map(|x| combine(x.of(pool), q)), [self.y, y].map(|y| combine(y.of(pool), q)))
    }

    /// The partial derivative of phi with respect to time.
    pub fn phi_t<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        q: &[T],
        guides: &[[T; 3]],
    ) -> T {
        let f = guides[self.guide as usize];
        match self.motion {
            GuidedMotion::Slide { .. } => -f[1],
            GuidedMotion::Angle { .. } => -f[1] * self.cosine::<T, D>(pool, q, guides),
            GuidedMotion::Rotation { x, y, number } => {
                let ([_, rates, _], (x, y)) =
                    (columns(guides, self.guide, number), self.axes::<T, D>(pool, (x, y), q));
                skew(&rates, &x, &y)
            }
        }
    }

    /// Cosine of the deviation from the guide, B.y. It is one if the deviation is zero. For a rotation it is z_i.y_i + z_j.y_j,
    /// which is two if the deviation is zero. At a deviation of half a turn it is negative in one of the rows.
    fn cosine<T: Real, const D: usize>(&self, pool: &[Term<T>], q: &[T], guides: &[[T; 3]]) -> T {
        match self.motion {
            GuidedMotion::Slide { .. } => T::ONE,
            GuidedMotion::Rotation { x, y, number } => {
                let r = turned(&vector(guides, self.guide)[0], number);
                let (x, y) = self.axes::<T, D>(pool, (x, y), q);
                mixed(&r[0], &x).dot(&y[0]) + mixed(&r[1], &x).dot(&y[1])
            }
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = guides[self.guide as usize][0].sin_cos();
                let b =
                    combine::<T, D>(x2.of(pool), q) * sin + combine::<T, D>(x1.of(pool), q) * cos;
                b.dot(&combine::<T, D>(self.y.of(pool), q))
            }
        }
    }

    /// True if the angle is at the false root, half a turn from the guide.
    pub fn is_opposite<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        q: &[T],
        guides: &[[T; 3]],
    ) -> bool {
        self.cosine::<T, D>(pool, q, guides) < T::ZERO
    }

    /// The part of phi'' without accelerations.
    pub fn bias<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, v): (&[T], &[T]),
        guides: &[[T; 3]],
    ) -> T {
        let f = guides[self.guide as usize];
        let yt: Vector<T, D> = combine(self.y.of(pool), v);
        match self.motion {
            GuidedMotion::Slide { x } => combine::<T, D>(x.of(pool), v).dot(&yt) * T::TWO - f[2],
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = f[0].sin_cos();
                let y: Vector<T, D> = combine(self.y.of(pool), q);
                let (p1, p2) = (combine::<T, D>(x1.of(pool), q), combine::<T, D>(x2.of(pool), q));
                let (w1, w2) = (combine::<T, D>(x1.of(pool), v), combine::<T, D>(x2.of(pool), v));
                let (a, b) = (p2 * cos - p1 * sin, p2 * sin + p1 * cos);
                let a_t = w2 * cos - w1 * sin - b * f[1];
                let a_tt = (w2 * sin + w1 * cos) * (-T::TWO * f[1]) - b * f[2] - a * (f[1] * f[1]);
                a_tt.dot(&y) + a_t.dot(&yt) * T::TWO
            }
            GuidedMotion::Rotation { x, y, number } => {
                let [now, rates, second] = columns(guides, self.guide, number);
                let (at, moving) =
                    (self.axes::<T, D>(pool, (x, y), q), self.axes::<T, D>(pool, (x, y), v));
                // C is the matrix of the products, C': its rate. phi'' = C'': x.y + 2 C': (x'.y + x.y') + 2 C: x'.y'
                let turning = skew(&rates, &moving.0, &at.1) + skew(&rates, &at.0, &moving.1);
                let products = turning + skew(&now, &moving.0, &moving.1);
                skew(&second, &at.0, &at.1) + products * T::TWO
            }
        }
    }
}
