//! One-step integrators in the general form of [P1 (32)], in increments.
//!
//! ```text
//! (1 - am) a^_1 + am a^_0 = (1 - af) a_1 + af a_0
//! q_1 = q_0 + h v_0 + h^2 ((1/2 - beta) a^_0 + beta a^_1),   v_1 = v_0 + h ((1 - gamma) a^_0 + gamma a^_1)
//!
//! prediction (a^_1 = a^_0) and correction d of the position:
//! q_1 = q_p + d,   v_1 = v_p + v' d,   a_1 = a_p + a' d,   a^_1 = a^_0 + d / (beta h^2)
//! ```
//!
//! The trapezoidal rule is beta = 1/4, gamma = 1/2, am = af = 0: then v' = 2/h, a' = 4/h^2, the equations of [P3 (4)-(5)]
//! without the cancellation of 2/h q_1 - 2/h q_0.

use crate::Real;

/// An implicit one-step method for second-order systems.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrator<T> {
    /// beta of Newmark, `> 0`.
    pub beta: T,
    /// gamma of Newmark, `>= 1/2`; 1/2 has no numerical damping.
    pub gamma: T,
    /// Parameter am of generalised-alpha.
    pub alpha_m: T,
    /// Parameter af of generalised-alpha.
    pub alpha_f: T,
}

impl<T: Real> Integrator<T> {
    /// Trapezoidal rule of second order, which keeps energy best.
    #[must_use]
    pub fn trapezoidal() -> Self {
        Self::newmark(T::from_f64(0.25), T::HALF)
    }

    /// Newmark's method with parameters `beta` and `gamma`.
    pub fn newmark(beta: T, gamma: T) -> Self {
        Self { beta, gamma, alpha_m: T::ZERO, alpha_f: T::ZERO }
    }

    /// Generalised-alpha (Chung and Hulbert, 1993) with spectral radius `rho` at infinity, in `[0, 1]`: 1 damps nothing.
    pub fn generalised_alpha(rho: T) -> Self {
        let alpha_m = (T::TWO * rho - T::ONE) / (rho + T::ONE);
        let alpha_f = rho / (rho + T::ONE);
        Self::second_order(alpha_m, alpha_f)
    }

    /// HHT with damping `alpha` in `[0, 1/3]`: 0 is the trapezoidal rule.
    pub fn hht(alpha: T) -> Self {
        Self::second_order(T::ZERO, alpha)
    }

    /// gamma = 1/2 + af - am, beta = (gamma + 1/2)^2 / 4: second order and unconditionally stable.
    fn second_order(alpha_m: T, alpha_f: T) -> Self {
        let gamma = T::HALF + alpha_f - alpha_m;
        let half = (gamma + T::HALF) * T::HALF;
        Self { beta: half * half, gamma, alpha_m, alpha_f }
    }

    /// Is it of the Newmark family, whose auxiliary accelerations are the accelerations?
    pub fn is_newmark(&self) -> bool {
        self.alpha_m == T::ZERO && self.alpha_f == T::ZERO
    }

    /// The change of an auxiliary acceleration by one of its acceleration at the end of a step; in the Newmark family exactly one.
    pub fn share(&self) -> T {
        (T::ONE - self.alpha_f) / (T::ONE - self.alpha_m)
    }

    /// The auxiliary acceleration at the end of a step, from the acceleration there and both at its beginning.
    #[inline]
    pub fn auxiliary(&self, a_next: T, [a, a_aux]: [T; 2]) -> T {
        if self.is_newmark() {
            return a_next;
        }
        self.share() * a_next + (self.alpha_f * a - self.alpha_m * a_aux) / (T::ONE - self.alpha_m)
    }

    /// The coefficients for steps of length `dt` [s].
    pub fn rule(&self, dt: T) -> Rule<T> {
        let auxiliary = T::ONE / (self.beta * dt * dt);
        Rule {
            dt,
            velocity: self.gamma / (self.beta * dt),
            acceleration: (T::ONE - self.alpha_m) / (T::ONE - self.alpha_f) * auxiliary,
            auxiliary,
            alpha_f: self.alpha_f,
        }
    }
}

/// An integrator at a step length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule<T> {
    /// Length h of the step [s].
    pub dt: T,
    /// Factor v' of the correction in the velocity [1/s].
    pub velocity: T,
    /// Factor a' of the correction in the acceleration [1/s^2].
    pub acceleration: T,
    /// 1 / (beta h^2) [1/s^2].
    pub auxiliary: T,
    /// Parameter af of generalised-alpha.
    pub alpha_f: T,
}

impl<T: Real> Rule<T> {
    /// Predicted increment of the position and predicted velocity and acceleration at the end of the step.
    #[inline(always)]
    pub fn predict(&self, v: T, a: T, a_aux: T) -> (T, T, T) {
        let h = self.dt;
        let dq = h * (v + h * T::HALF * a_aux);
        let a_next = if self.alpha_f == T::ZERO {
            a_aux
        } else {
            (a_aux - self.alpha_f * a) / (T::ONE - self.alpha_f)
        };
        (dq, v + h * a_aux, a_next)
    }

    /// Takes the share of the accelerations out of a prediction, so that it goes at the rates that the step begins with. It is another
    /// point of the same rule. For a step that [`is_far`] says accelerations alone would carry far, as those of a stiff effect that is
    /// let go. `a` is in units of 1 / `unit`.
    pub fn hold_back(&self, unit: T, [dq, v, a]: [&mut [T]; 3], a_aux: &[T]) {
        let half_square = self.dt * self.dt * T::HALF;
        for (i, dq) in dq.iter_mut().enumerate() {
            let back = half_square * a_aux[i];
            *dq -= back;
            v[i] -= self.velocity * back;
            a[i] -= self.acceleration * unit * back;
        }
    }
}

/// Least displacement by accelerations in a step that is far, relative to the scene's length [-]. Chosen, not tuned.
const FAR_SHARE: f64 = 1.0 / 64.0;

/// Do accelerations carry a step far? `moved`, their part of the displacement, is then above half a radian, or half a metre and
/// `FAR_SHARE` of the scene's length.
pub fn is_far<T: Real>(moved: T, length: T) -> bool {
    moved > (length * T::from_f64(FAR_SHARE)).max(T::HALF)
}
