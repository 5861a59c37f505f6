//! One-step integrators in the general form of [P1 (32)], written in increments. a is the acceleration, a^ the auxiliary acceleration, h
//! the step; the indices 0 and 1 are the beginning and end of the step.
//!
//! ```text
//! (1 - am) a^_1 + am a^_0 = (1 - af) a_1 + af a_0
//! q_1 = q_0 + h v_0 + h^2 ((1/2 - beta) a^_0 + beta a^_1),   v_1 = v_0 + h ((1 - gamma) a^_0 + gamma a^_1)
//!
//! prediction (a^_1 = a^_0) and correction d of the position:
//! q_1 = q_p + d,   v_1 = v_p + v' d,   a_1 = a_p + a' d,   a^_1 = a^_0 + d / (beta h^2)
//! ```
//!
//! The trapezoidal rule has beta = 1/4, gamma = 1/2, am = af = 0. Then v' = 2/h and a' = 4/h^2. These are the equations of [P3 (4)-(5)],
//! without the cancellation of digits in 2/h q_1 - 2/h q_0.

use crate::Real;

/// An implicit one-step method for second-order systems.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrator<T> {
    /// Parameter beta of Newmark's method, `> 0`.
    pub beta: T,
    /// Parameter gamma of Newmark's method, `>= 1/2`. With 1/2 there is no numerical damping.
    pub gamma: T,
    /// Parameter am of generalised-alpha.
    pub alpha_m: T,
    /// Parameter af of generalised-alpha.
    pub alpha_f: T,
}

impl<T: Real> Integrator<T> {
    /// Trapezoidal rule of second order, without numerical damping.
    #[must_use]
    pub fn trapezoidal() -> Self {
        Self::newmark(T::from_f64(0.25), T::HALF)
    }

    /// Newmark's method with parameters `beta` and `gamma`.
    pub fn newmark(beta: T, gamma: T) -> Self {
        Self { beta, gamma, alpha_m: T::ZERO, alpha_f: T::ZERO }
    }

    /// Generalised-alpha method (Chung and Hulbert, 1993). `rho` in `[0, 1]` is the spectral radius at infinite frequency; 1 gives no
    /// numerical damping.
    pub fn generalised_alpha(rho: T) -> Self {
        let alpha_m = (T::TWO * rho - T::ONE) / (rho + T::ONE);
        let alpha_f = rho / (rho + T::ONE);
        Self::second_order(alpha_m, alpha_f)
    }

    /// HHT method (Hilber, Hughes and Taylor) with damping `alpha` in `[0, 1/3]`; 0 gives the trapezoidal rule.
    pub fn hht(alpha: T) -> Self {
        Self::second_order(T::ZERO, alpha)
    }

    /// Method with gamma = 1/2 + af - am and beta = (gamma + 1/2)^2 / 4, of second order and unconditionally stable.
    fn second_order(alpha_m: T, alpha_f: T) -> Self {
        let gamma = T::HALF + alpha_f - alpha_m;
        let half = (gamma + T::HALF) * T::HALF;
        Self { beta: half * half, gamma, alpha_m, alpha_f }
    }

    /// True if the method belongs to the Newmark family, where auxiliary accelerations equal the accelerations.
    pub fn is_newmark(&self) -> bool {
        self.alpha_m == T::ZERO && self.alpha_f == T::ZERO
    }

    /// Derivative of the auxiliary acceleration by the acceleration at the end of a step. It is exactly one in the Newmark family.
    pub fn share(&self) -> T {
        (T::ONE - self.alpha_f) / (T::ONE - self.alpha_m)
    }

    /// Auxiliary acceleration at the end of a step, from the acceleration `a_next` there and both accelerations at the beginning of the
    /// step.
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

/// Coefficients of an integrator for one step length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule<T> {
    /// Length h of the step [s].
    pub dt: T,
    /// Factor v' of the correction in the velocity [1/s].
    pub velocity: T,
    /// Factor a' of the correction in the acceleration [1/s^2].
    pub acceleration: T,
    /// Factor 1 / (beta h^2) of the correction in the auxiliary acceleration [1/s^2].
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

    /// Removes the accelerations' part from a prediction: the predicted velocity is then constant. The result is another start of the
    /// same Newton iteration and satisfies the same rule. It is for steps with large displacements by accelerations ([`is_far`]), such as
    /// at the release of a stiff effect. `a` is in units of 1 / `unit`.
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

/// Fraction of the scene's length above which accelerations displace a step too far for the usual prediction [-]. Chosen, not tuned.
const FAR_SHARE: f64 = 1.0 / 64.0;

/// True if accelerations displace coordinates too far for the usual prediction. `moved` is the displacement that they cause in the step.
/// The limit is half a radian or half a metre, and at least `FAR_SHARE` times the scene's length.
pub fn is_far<T: Real>(moved: T, length: T) -> bool {
    moved > (length * T::from_f64(FAR_SHARE)).max(T::HALF)
}
