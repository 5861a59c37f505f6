//! Eigenvalues of a linearised motion; conjugate pairs are listed once.

use core::f64::consts::TAU;

/// A real eigenvalue, or a pair of conjugate eigenvalues.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Real part of the eigenvalue [1/s]; a negative one means decay.
    pub real: f64,
    /// Imaginary part of the eigenvalue [rad/s], never negative. If it is positive, the mode stands for a conjugate pair.
    pub imaginary: f64,
    /// True if the eigenvalue is zero within the accuracy of the linearisation.
    pub is_neutral: bool,
}

impl Mode {
    /// Undamped natural frequency |lambda| / 2 pi [Hz].
    #[must_use]
    pub fn undamped_frequency(&self) -> f64 {
        libm::hypot(self.real, self.imaginary) / TAU
    }

    /// Frequency of the oscillation, Im lambda / 2 pi [Hz].
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.imaginary / TAU
    }

    /// True if the mode grows faster than rounding errors explain.
    #[must_use]
    pub fn grows(&self) -> bool {
        !self.is_neutral && self.real > AXIS * libm::hypot(self.real, self.imaginary)
    }

    /// Damping ratio -Re lambda / |lambda| [-]; `None` for a neutral mode.
    #[must_use]
    pub fn damping_ratio(&self) -> Option<f64> {
        (!self.is_neutral).then(|| -self.real / libm::hypot(self.real, self.imaginary))
    }
}

/// Ratio of real part to magnitude of an eigenvalue, below which the real part counts as rounding error of an undamped mode [-]. Difference
/// quotients have ten digits.
const AXIS: f64 = 1e-8;
/// Largest square of an eigenvalue that counts as zero, in units of the rounding error of squared eigenvalues [-]. Chosen, not tuned.
pub(crate) const NOISE: f64 = 1e3;

/// Lists the modes of eigenvalues in order of increasing magnitude; a conjugate pair is listed once. `noise` is the rounding error of
/// squared eigenvalues [1/s^2].
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
