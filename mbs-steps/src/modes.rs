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

/// Modes (eigenvalues) of a scene, with the names of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Name of the scene.
    pub scene: String,
    /// State about which the scene is linearised.
    pub place: Place,
    /// The equilibrium, if the place is an equilibrium.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are omitted from the scene, and from the search for its equilibrium.
    pub left_out: Vec<LeftOut>,
    /// Number of degrees of freedom of the scene.
    pub dof: usize,
    /// Reason why the state is neither an equilibrium nor a steady motion; `None` if it is an equilibrium or a steady motion. With a
    /// reason, the eigenvalues hold at one instant only.
    pub unsteady: Option<Unsteady>,
    /// Largest acceleration of a joint coordinate that is caused by the rotation of bodies [m/s^2].
    pub turning: f64,
    /// The eigenvalues, in order of increasing magnitude.
    pub modes: Vec<Mode>,
}

impl Modes {
    /// Assembles a scene, searches for its equilibrium if the place needs one, and linearises it at the place: at rest, or in a steady
    /// motion.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, consistent start, equilibrium or linearisation; [`StopError::NotSteady`] if the state is
    /// neither an equilibrium nor a steady motion.
    pub fn new(scene: &Scene<f64>, place: Place, search: Search) -> Result<Self, StopError> {
        let found = Self::of(scene, (place, search), false)?;
        match found.unsteady {
            Some(unsteady) => Err(StopError::NotSteady(Box::new(unsteady))),
            None => Ok(found),
        }
    }

    /// Modes at any state. If the motion is not steady, the eigenvalues hold only at that instant, in axes that do not turn. Such
    /// eigenvalues do not show whether a disturbance grows or decays.
    ///
    /// # Errors
    /// As for [`new`](Self::new), except the error for a motion that is not steady.
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

    /// Modes of a system that was linearised at this place.
    ///
    /// # Errors
    /// [`StopError::Eigenvalues`] if the iteration does not converge.
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

    /// Linearises about an equilibrium. The axes do not turn there, and every choice of coordinates gives the same eigenvalues.
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

    /// True if every disturbance decays or stays small. Neutral eigenvalues count as stable. Eigenvalues on the imaginary axis, to machine
    /// precision, count as stable too.
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

/// Eigenvalues of a linearised motion in order of increasing magnitude; a conjugate pair is listed once.
///
/// # Errors
/// [`StopError::Eigenvalues`] if the iteration does not converge.
pub fn eigenvalues(linear: &Linear<f64>) -> Result<Vec<Mode>, StopError> {
    let (n, a) = (linear.order(), linear.state_matrix());
    if n == 0 {
        return Ok(Vec::new());
    }
    let values = mbs_linear::eigenvalues(n, &a).ok_or(StopError::Eigenvalues)?;
    Ok(slowest_first(&values, linear.noise))
}

/// Number of directions without stiffness [-], along which the equilibrium is neutral.
///
/// # Errors
/// [`StopError::Eigenvalues`] if the iteration does not converge.
pub fn neutral_directions(linear: &Linear<f64>) -> Result<usize, StopError> {
    let f = linear.n_freedoms;
    if f == 0 {
        return Ok(0);
    }
    let stiffness = Matrix::from_fn(f, f, |i, j| linear.stiffness[j * f + i]);
    let sizes = singular_values(&stiffness).ok_or(StopError::Eigenvalues)?;
    Ok(sizes.iter().filter(|&&size| size <= NOISE * linear.noise).count())
}
