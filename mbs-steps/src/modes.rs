//! Eigenvalues of a scene linearised about its equilibrium, its start, or a steady motion.
//!
//! ```text
//! lambda = -zeta omega_0 +- i omega_0 sqrt(1 - zeta^2):   omega_0 = |lambda|,  zeta = -Re lambda / |lambda|
//! ```

use crate::equilibrium::Search;
use crate::linear_system::{About, Axes, LinearSystem, at_rest};
use crate::mode::NOISE;
pub use crate::mode::{Mode, slowest_first};
use crate::placed::{Place, PlacedScene};
use crate::rest::{LeftOut, left_out_json};
use crate::stop::StopError;
use crate::unsteady::Unsteady;
use mbs_core::scene::{Dimension, Scene};
use mbs_linear::{Equilibrium, Linear, Matrix, singular_values};
use serde_json::{Value, json};

/// The modes of a scene, with its names.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Name of the scene.
    pub scene: String,
    /// State about which the scene is linearised.
    pub place: Place,
    /// The equilibrium, if that is the place.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are left out of the scene, and of its equilibrium too.
    pub left_out: Vec<LeftOut>,
    /// Number of freedoms of the scene.
    pub dof: usize,
    /// Reason why the state is no rest and no steady motion, if it is none: the eigenvalues are then those of an instant.
    pub unsteady: Option<Unsteady>,
    /// Largest acceleration that joints ask for because bodies turn [m/s^2].
    pub turning: f64,
    /// The eigenvalues from the slowest to the fastest.
    pub modes: Vec<Mode>,
}

impl Modes {
    /// Assembles a scene, seeks its equilibrium if that is the place, and linearises it there: at rest, or in a steady motion.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, consistent start, equilibrium or linearisation; [`StopError::NotSteady`] where the state is
    /// neither a rest nor a steady motion.
    pub fn new(scene: &Scene<f64>, place: Place, search: Search) -> Result<Self, StopError> {
        let found = Self::of(scene, (place, search), false)?;
        match found.unsteady {
            Some(unsteady) => Err(StopError::NotSteady(Box::new(unsteady))),
            None => Ok(found),
        }
    }

    /// Modes of any state: of one that is no steady motion the eigenvalues of the instant, in axes that stand. They say nothing of what grows or
    /// decays.
    ///
    /// # Errors
    /// As for [`new`](Self::new), but for the last.
    pub fn frozen(scene: &Scene<f64>, place: Place, search: Search) -> Result<Self, StopError> {
        Self::of(scene, (place, search), true)
    }

    fn of(scene: &Scene<f64>, how: (Place, Search), is_frozen: bool) -> Result<Self, StopError> {
        match scene.dimension {
            Dimension::Planar => Self::in_space::<2>(scene, how, is_frozen),
            Dimension::Spatial => Self::in_space::<3>(scene, how, is_frozen),
        }
    }

    fn in_space<const D: usize>(
        scene: &Scene<f64>,
        (place, search): (Place, Search),
        is_frozen: bool,
    ) -> Result<Self, StopError> {
        let placed = PlacedScene::<D>::new(scene, place, search)?;
        if place == Place::Equilibrium {
            return Self::at_rest(placed);
        }
        let axes = if is_frozen { Axes::TurningOrStanding } else { Axes::Turning };
        Self::of_system(&About::alone(scene, &placed, axes).system()?, place)
    }

    /// The modes of a system that was linearised about this place.
    ///
    /// # Errors
    /// [`StopError::Eigenvalues`] where the iteration does not converge.
    pub fn of_system(system: &LinearSystem, place: Place) -> Result<Self, StopError> {
        Ok(Self {
            scene: system.scene.clone(),
            place,
            found: system.found,
            left_out: system.left_out.clone(),
            dof: system.n_freedoms,
            unsteady: system.unsteady.clone(),
            turning: system.turning,
            modes: slowest_first(&system.eigenvalues()?, system.noise),
        })
    }

    /// About an equilibrium, where the axes stand and all coordinates have the same eigenvalues.
    fn at_rest<const D: usize>(placed: PlacedScene<D>) -> Result<Self, StopError> {
        let linear = at_rest(&placed)?;
        let PlacedScene { scene, found, left_out, .. } = placed;
        Ok(Self {
            scene: scene.name,
            place: Place::Equilibrium,
            found,
            left_out,
            dof: linear.n_freedoms,
            unsteady: None,
            turning: linear.turning,
            modes: eigenvalues(&linear)?,
        })
    }

    /// Does every disturbance decay or stay small? Neutral eigenvalues and those on the axis within rounding count as stable.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        !self.modes.iter().any(Mode::grows)
    }

    /// Returns the modes as one JSON object.
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
            "stable": self.unsteady.is_none().then(|| self.is_stable()),
            "acceleration": match &self.unsteady {
                Some(Unsteady::Accelerates { by, .. }) => *by,
                _ => 0.0,
            },
            "unsteady": self.unsteady.as_ref().map(Unsteady::to_json),
            "turning": self.turning,
            "left_out": left_out_json(&self.left_out),
            "equilibrium_residual": self.found.map(|f| f.residual),
            "modes": self.modes.iter().map(mode).collect::<Vec<_>>(),
        })
    }
}

/// The eigenvalues of a linearised motion, conjugate ones once, from the slowest to the fastest.
///
/// # Errors
/// [`StopError::Eigenvalues`] where the iteration does not converge.
pub fn eigenvalues(linear: &Linear<f64>) -> Result<Vec<Mode>, StopError> {
    let (n, a) = (linear.order(), linear.state_matrix());
    if n == 0 {
        return Ok(Vec::new());
    }
    let values = mbs_linear::eigenvalues(n, &a).ok_or(StopError::Eigenvalues)?;
    Ok(slowest_first(&values, linear.noise))
}

/// Directions without stiffness [-]: in which an equilibrium may stand anywhere.
///
/// # Errors
/// [`StopError::Eigenvalues`] where the iteration does not converge.
pub fn neutral_directions(linear: &Linear<f64>) -> Result<usize, StopError> {
    let f = linear.n_freedoms;
    if f == 0 {
        return Ok(0);
    }
    let stiffness = Matrix::from_fn(f, f, |i, j| linear.stiffness[j * f + i]);
    let sizes = singular_values(&stiffness).ok_or(StopError::Eigenvalues)?;
    Ok(sizes.iter().filter(|&&size| size <= NOISE * linear.noise).count())
}
