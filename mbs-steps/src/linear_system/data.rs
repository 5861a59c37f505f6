//! Linear system of a scene: its matrices with names.

use crate::placed::Place;
use crate::rest::LeftOut;
use crate::tree::Matrix;
use crate::unsteady::Unsteady;
use mbs_linear::Equilibrium;

/// Linear system dx/dt = A x + B u, y = C x + D u. The vectors x, u and y are deviations from a state, in SI units.
///
/// **States** are independent joint coordinates, as many as there are degrees of freedom: the first independent ones in the order of the
/// scene. The name of a state is `JOINT`, or `JOINT.1` for a joint with several coordinates. If there are too few joint coordinates,
/// coordinates of bodies follow: `BODY.x` of the centre of mass and `BODY.rx` of the rotation vector. Then come the rates in the same order
/// (`JOINT.rate`). The last states are those of signals: `SIGNAL`, or `SIGNAL.integral` of a controller. The rate of a body's rotation
/// vector is its angular velocity in global axes. The rate of a joint's rotation vector is the angular velocity of the second body relative
/// to the first.
///
/// **Inputs** that are the value, rate and acceleration of one guide are three separate inputs. The matrices treat them as independent,
/// although rate and acceleration are derivatives of the value.
///
/// The matrices are constant about an equilibrium, and about a motion that is steady in axes that do not turn. About other states they hold
/// for an instant, and [`unsteady`](Self::unsteady) gives the reason. [`steady`](Self::steady) uses axes that turn with the motion.
///
/// About a motion, rotation vectors are relative to the rotations of the bodies in that motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LinearSystem {
    /// Name of the scene.
    pub scene: String,
    /// State about which the scene is linearised; `None` if the caller gave a state.
    pub place: Option<Place>,
    /// The equilibrium, if the place is an equilibrium.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are omitted from the scene, and from the search for its equilibrium.
    pub left_out: Vec<LeftOut>,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the outputs, as in the columns of a run.
    pub outputs: Vec<String>,
    /// Matrix A, one row for each state.
    pub a: Matrix,
    /// Matrix B, one row for each state and one column for each input.
    pub b: Matrix,
    /// Matrix C, one row for each output.
    pub c: Matrix,
    /// Matrix D, one row for each output and one column for each input.
    pub d: Matrix,
    /// Values of the states at the linearisation point, where x = 0.
    pub state_values: Vec<f64>,
    /// Values of the inputs at the linearisation point, where u = 0.
    pub input_values: Vec<f64>,
    /// Values of the outputs at the linearisation point, where y = 0.
    pub output_values: Vec<f64>,
    /// Joints, couplings and rolling contacts with a reaction, effort or force that is an output but is not unique. For these outputs the
    /// values of smallest norm are linearised.
    pub not_unique: Vec<String>,
    /// Reason why the state is neither an equilibrium nor a steady motion; `None` if it is an equilibrium or a steady motion. With a
    /// reason, the matrices hold at one instant only.
    pub unsteady: Option<Unsteady>,
    /// Largest acceleration of a joint coordinate that is caused by the rotation of bodies [m/s^2].
    pub turning: f64,
    /// Number of degrees of freedom of the scene.
    pub(crate) n_freedoms: usize,
    /// State matrix at an equilibrium in tangent coordinates, column by column. Its eigenvalues are those of A, but it is better
    /// conditioned, so its computed eigenvalues are more accurate.
    pub(crate) rest: Option<Vec<f64>>,
    /// Rounding error of squared eigenvalues [1/s^2]. Eigenvalues whose square is not larger than this error count as zero.
    pub(crate) noise: f64,
}
