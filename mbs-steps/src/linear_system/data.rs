//! Linear system of a scene: its matrices with names.

use crate::placed::Place;
use crate::rest::LeftOut;
use crate::tree::Matrix;
use crate::unsteady::Unsteady;
use mbs_linear::Equilibrium;

/// dx/dt = A x + B u, y = C x + D u: deviations from a state, in SI units.
///
/// **States** are as many joint coordinates as there are freedoms, the first ones of the scene that are independent: `JOINT`, or `JOINT.1`
/// where a joint has several. Where joints have too few, places of bodies follow: `BODY.x` of the centre of mass and `BODY.rx` of the
/// rotation vector. Then come their rates in the same order (`JOINT.rate`), and the states of signals: `SIGNAL`, or `SIGNAL.integral` of a
/// controller. The rate of a rotation vector is the angular velocity, in global axes; of a joint the second body's against the first.
///
/// **Inputs** that are the value, rate and acceleration of one guide are three inputs, of which each is the derivative of the one before.
///
/// About a rest, and about a motion that is steady in axes that stand, the matrices are constant. Elsewhere they hold for an instant:
/// [`unsteady`](Self::unsteady) says why. [`steady`](Self::steady) takes axes that turn with the motion.
///
/// About a motion rotation vectors count from the rotations of the motion itself.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LinearSystem {
    /// Name of the scene.
    pub scene: String,
    /// State about which the scene is linearised; nothing where the state was given.
    pub place: Option<Place>,
    /// The equilibrium, if that is the place.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are left out of the scene, and of its equilibrium too.
    pub left_out: Vec<LeftOut>,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the outputs: the columns of a run.
    pub outputs: Vec<String>,
    /// A, a row for each state.
    pub a: Matrix,
    /// B, a row for each state, a column for each input.
    pub b: Matrix,
    /// C, a row for each output.
    pub c: Matrix,
    /// D, a row for each output, a column for each input.
    pub d: Matrix,
    /// The states at the state itself, from which x counts.
    pub state_values: Vec<f64>,
    /// The inputs there, from which u counts.
    pub input_values: Vec<f64>,
    /// The outputs there, from which y counts.
    pub output_values: Vec<f64>,
    /// Joints, couplings and rollings whose reaction, effort or force is an output and not unique: the smallest is linearised.
    pub not_unique: Vec<String>,
    /// Reason why the state is no rest and no steady motion, if it is none: the matrices hold for an instant.
    pub unsteady: Option<Unsteady>,
    /// Largest acceleration that joints ask for because bodies turn [m/s^2].
    pub turning: f64,
    /// Number of freedoms of the scene.
    pub(crate) n_freedoms: usize,
    /// At a rest the same motion as modes of an equilibrium have it, column by column: in coordinates that are better conditioned than the
    /// named ones. Its eigenvalues are those of A.
    pub(crate) rest: Option<Vec<f64>>,
    /// Rounding of squares of eigenvalues [1/s^2]: those of this size are zero.
    pub(crate) noise: f64,
}
