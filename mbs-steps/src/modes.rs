//! Eigenvalues of a scene linearised about its equilibrium or its start.
//!
//! ```text
//! lambda = -zeta omega_0 +- i omega_0 sqrt(1 - zeta^2):   omega_0 = |lambda|,  zeta = -Re lambda / |lambda|
//! ```

use crate::equilibrium::{Search, workspace};
use crate::placed::{Place, PlacedScene};
use crate::rest::{LeftOut, left_out_json};
use crate::stop::StopError;
use core::f64::consts::TAU;
use mbs_core::scene::{Dimension, Scene};
use mbs_linear::{Equilibrium, Linear, LinearOptions, Matrix, linearise, singular_values};
use serde_json::{Value, json};

/// An eigenvalue, or a pair of conjugate ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Real part [1/s]: negative decays.
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

/// The modes of a scene, with its names.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Name of the scene.
    pub scene: String,
    /// About which state.
    pub place: Place,
    /// The equilibrium, if that is the place.
    pub found: Option<Equilibrium<f64>>,
    /// What is left out, of the equilibrium too.
    pub left_out: Vec<LeftOut>,
    /// Freedoms.
    pub dof: usize,
    /// Largest acceleration at the state, of coordinates with unit inertia [m sqrt(kg)/s^2]; zero in an equilibrium.
    pub acceleration: f64,
    /// Largest acceleration that joints ask for because bodies turn [m/s^2]: where it is not zero, eigenvalues hold for an
    /// instant and depend on the choice of coordinates.
    pub turning: f64,
    /// The eigenvalues from the slowest to the fastest.
    pub modes: Vec<Mode>,
}

impl Modes {
    /// Assembles a scene, seeks its equilibrium if that is the place, and linearises it.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, consistent start, equilibrium or linearisation.
    pub fn new(scene: &Scene<f64>, place: Place, search: Search) -> Result<Self, StopError> {
        match scene.dimension {
            Dimension::Planar => Self::in_space::<2>(scene, place, search),
            Dimension::Spatial => Self::in_space::<3>(scene, place, search),
        }
    }

    fn in_space<const D: usize>(
        scene: &Scene<f64>,
        place: Place,
        search: Search,
    ) -> Result<Self, StopError> {
        let PlacedScene { scene, ready, found, left_out, instant } =
            PlacedScene::<D>::new(scene, place, search)?;
        let (model, state) = (&ready.model, &ready.start.state);
        let how = (instant, &LinearOptions::default());
        let linear = linearise(model, how, state, &mut workspace(model))
            .map_err(|error| StopError::Linear(error).or_law(model.codes()))?;
        let acceleration = linear.acceleration.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        Ok(Self {
            scene: scene.name,
            place,
            found,
            left_out,
            dof: linear.n_freedoms,
            acceleration,
            turning: linear.turning,
            modes: eigenvalues(&linear)?,
        })
    }

    /// Does every disturbance decay or stay small? Neutral eigenvalues and those on the axis within rounding count as stable.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        !self.modes.iter().any(Mode::grows)
    }

    /// One JSON object.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let mode = |m: &Mode| {
            json!({
                "real": m.real,
                "imaginary": m.imaginary,
                "frequency": m.frequency(),
                "undamped_frequency": m.undamped_frequency(),
                "damping_ratio": m.damping_ratio(),
                "neutral": m.is_neutral,
            })
        };
        json!({
            "scene": self.scene,
            "completed": true,
            "error": null,
            "at": self.place.name(),
            "dof": self.dof,
            "stable": self.is_stable(),
            "acceleration": self.acceleration,
            "turning": self.turning,
            "left_out": left_out_json(&self.left_out),
            "equilibrium_residual": self.found.map(|f| f.residual),
            "modes": self.modes.iter().map(mode).collect::<Vec<_>>(),
        })
    }
}

/// Ratio of real part and eigenvalue below which it is rounding of an undamped one [-]: differences give ten digits.
const AXIS: f64 = 1e-8;
/// Square of an eigenvalue that is zero, in units of rounding of the stiffness [-]. Chosen, not tuned.
const NOISE: f64 = 1e3;

/// The eigenvalues of a linearised motion, conjugate ones once, from the slowest to the fastest.
pub fn eigenvalues(linear: &Linear<f64>) -> Result<Vec<Mode>, StopError> {
    let (n, a) = (linear.order(), linear.state_matrix());
    if n == 0 {
        return Ok(Vec::new());
    }
    let values = mbs_linear::eigenvalues(n, &a).ok_or(StopError::Eigenvalues)?;
    Ok(slowest_first(&values, linear.noise))
}

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

/// Directions without stiffness [-]: in which an equilibrium may stand anywhere.
pub fn neutral_directions(linear: &Linear<f64>) -> Result<usize, StopError> {
    let f = linear.n_freedoms;
    if f == 0 {
        return Ok(0);
    }
    let stiffness = Matrix::from_fn(f, f, |i, j| linear.stiffness[j * f + i]);
    let sizes = singular_values(&stiffness).ok_or(StopError::Eigenvalues)?;
    Ok(sizes.iter().filter(|&&size| size <= NOISE * linear.noise).count())
}
