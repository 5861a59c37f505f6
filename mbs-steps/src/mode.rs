//! Eigenvalues, conjugate ones once.

use core::f64::consts::TAU;

/// An eigenvalue, or a pair of conjugate ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Real part of the eigenvalue [1/s]: negative decays.
    pub real: f64,
    /// Imaginary part [rad/s], not negative; positive stands for a pair.
    pub imaginary: f64,
    /// Not distinguishable from zero.
    pub is_neutral: bool,
}

impl Mode {
    /// |lambda| / 2 pi [Hz].
    #[must_use]
    pub fn undamped_frequency(&self) -> f64 {
        libm::hypot(self.real, self.imaginary) / TAU
    }

    /// Im lambda / 2 pi [Hz].
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.imaginary / TAU
    }

    /// Does it grow, beyond rounding?
    #[must_use]
    pub fn grows(&self) -> bool {
        !self.is_neutral && self.real > AXIS * libm::hypot(self.real, self.imaginary)
    }

    /// -Re lambda / |lambda| [-]; `None` for a neutral one.
    #[must_use]
    pub fn damping_ratio(&self) -> Option<f64> {
        (!self.is_neutral).then(|| -self.real / libm::hypot(self.real, self.imaginary))
    }
}

/// Ratio of real part and eigenvalue below which it is rounding of an undamped one [-]: differences give ten digits.
const AXIS: f64 = 1e-8;
/// Square of an eigenvalue that is zero, in units of rounding of the stiffness [-]. Chosen, not tuned.
pub(crate) const NOISE: f64 = 1e3;

/// Conjugate eigenvalues once, from the slowest to the fastest, with the rounding of their squares [1/s^2].
pub fn slowest_first(values: &[[f64; 2]], noise: f64) -> Vec<Mode> {
    let zero = (NOISE * noise).sqrt();
    let mut modes: Vec<Mode> = values
        .iter()
        .filter(|[_, imaginary]| *imaginary >= 0.0)
        .map(|&[real, imaginary]| Mode {
            real,
            imaginary,
            is_neutral: libm::hypot(real, imaginary) <= zero,
        })
        .collect();
    modes.sort_by(|a, b| {
        let size = |m: &Mode| m.undamped_frequency();
        size(a).total_cmp(&size(b)).then(a.real.total_cmp(&b.real))
    });
    modes
}
