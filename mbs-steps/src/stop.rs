//! Reason why a run stopped, as a message with the names of the scene's parts.

mod code;
mod gap;
mod linear;
mod step;

use self::linear::write_linear;
use self::step::{step_hint, step_owner, write_step};
use crate::names::Names;
use crate::tilt::AlmostDependent;
use crate::unsteady::Unsteady;
use mbs_scene::format::few;

use crate::record::RunError;
use mbs_core::actions::ActionError;
use mbs_core::laws::code::Codes;
use mbs_core::model::Owner;
use mbs_core::natural::ModelError;
use mbs_core::outputs::ReactionError;
use mbs_core::scene::Entry;
use mbs_core::start::AssemblyError;
use mbs_core::step::StepError;
use mbs_linear::{EquilibriumError, LinearError};
use mbs_recursive::TreeError;

/// Error code of an interrupted run.
pub const INTERRUPTED: &str = "interrupted";

/// Hint for a body with a motion that no inertia resists.
const NO_INERTIA: &str = "give the body mass and inertia; write a point mass as `point`, weld a point mass to what carries it, or give it any small \
                          inertia; a node between springs needs mass (a step h carries it from m = 4 k h^2 on), or one rope through it; or remove the \
                          freedom that nothing determines";

/// Reason why a run stopped early.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum StopError {
    /// The scene has no consistent start.
    Start(AssemblyError),
    /// Constraints that are almost dependent: without a small tilt of an axis they would be dependent.
    AlmostDependent(AlmostDependent),
    /// Reactions of joints that were requested but cannot be computed.
    Reaction(ReactionError),
    /// A step that failed, and the part of the scene that caused the failure.
    Step(StepError, Option<Owner>),
    /// The scene has no model in relative coordinates.
    Tree(TreeError, Option<Owner>),
    /// No static equilibrium was found. The owner is the part whose forces are unbalanced or whose joints are open.
    Equilibrium(EquilibriumError, Option<Owner>),
    /// The equations of motion cannot be linearised.
    Linear(LinearError),
    /// Modes were requested at a state that is neither an equilibrium nor a steady motion.
    NotSteady(Box<Unsteady>),
    /// The iteration for the eigenvalues did not converge.
    Eigenvalues,
    /// The operating system did not create this number of threads.
    NoThreads(usize),
    /// This build has no steps in the scalar of the scene.
    NotBuilt,
    /// The run was interrupted, and ended after a complete step.
    Interrupted,
    /// An observer stopped the run.
    Observer {
        /// Code of the observer's error.
        code: &'static str,
        /// Message of the error.
        message: Box<str>,
        /// Hint for the user; empty if the error has none.
        hint: Box<str>,
    },
    /// An output has a value that is not finite.
    Output {
        /// Index of the output in the scene.
        output: usize,
    },
    /// The transition of a friction law is too steep for the steps of an explicit method, so that the steps are unstable.
    Friction {
        /// Index of the effect in the scene.
        effect: usize,
        /// Velocity below which the friction force decreases to zero [rad/s or m/s].
        regularisation: f64,
        /// Length of the steps [s].
        step: f64,
    },
    /// The error of the energy invariant exceeds the allowed ratio of the exchanged energy.
    Energy {
        /// Error of the energy invariant, |Pi - Pi(0)| [J].
        error: f64,
        /// Exchanged energy: largest kinetic energy plus gross work [J].
        turned_over: f64,
        /// Allowed ratio of error to exchanged energy [-].
        share: f64,
        /// Owner of the constraint with the largest force, or of the coordinate with the largest acceleration.
        owner: Owner,
    },
}

impl StopError {
    /// Error of a failed step, with its owner. `unknown` and `row` return the owner of an unknown and of a constraint row.
    pub fn step(
        error: StepError,
        unknown: impl Fn(usize) -> Owner,
        row: impl Fn(usize) -> Owner,
    ) -> Self {
        let owner = step_owner(&error, unknown, row);
        Self::Step(error, owner)
    }

    /// Returns the failure of a user-defined law or relation, if one failed; otherwise this error.
    pub fn or_law(self, codes: &Codes) -> Self {
        codes.failed().map_or(self, |failed| Self::Step(failed.into(), None))
    }

    /// Error of a search that found no equilibrium, with its owner. The functions return the owner of an unknown and of a constraint row.
    pub fn equilibrium(
        error: EquilibriumError,
        n: usize,
        unknown: impl Fn(usize) -> Owner,
        row: impl Fn(usize) -> Owner,
    ) -> Self {
        let owner = match error {
            EquilibriumError::NotClosed { row: r, .. } => Some(row(r as usize)),
            EquilibriumError::Undetermined { unknown: u } if u as usize >= n => {
                Some(row(u as usize - n))
            }
            EquilibriumError::NotConverged { unknown: u, .. }
            | EquilibriumError::Escapes { unknown: u }
            | EquilibriumError::NotFinite { unknown: u }
            | EquilibriumError::Undetermined { unknown: u } => Some(unknown(u as usize)),
            _ => None,
        };
        Self::Equilibrium(error, owner)
    }

    /// Error of a scene that has no model as a tree.
    #[doc(hidden)]
    pub fn tree(error: TreeError) -> Self {
        let owner = match error {
            TreeError::GuideCut { joint }
            | TreeError::EffectCut { joint, .. }
            | TreeError::Signal { joint } => Some(Owner::Joint(joint)),
            TreeError::Effect(ActionError::LeftOut { effect, .. }) => Some(Owner::Effect(effect)),
            TreeError::Coupling { coupling } | TreeError::CouplingGuided { coupling } => {
                Some(Owner::Coupling(coupling))
            }
            TreeError::MasslessEnd { body } => Some(Owner::Body(body)),
            TreeError::NoInertia { owner } => Some(owner),
            _ => None,
        };
        Self::Tree(error, owner)
    }

    /// Place in the scene file that the error concerns.
    #[must_use]
    pub fn entry(&self) -> Option<Entry> {
        let owner = match self {
            Self::Start(
                AssemblyError::Position { initial: Some(i), .. }
                | AssemblyError::Velocity { initial: Some(i), .. },
            ) => return Some(Entry::Initial(*i)),
            Self::Start(error) => start_owner(error)?,
            Self::Step(_, owner) | Self::Tree(_, owner) | Self::Equilibrium(_, owner) => (*owner)?,
            Self::Energy { owner, .. } => *owner,
            Self::Output { output } => return Some(Entry::Output(*output)),
            Self::AlmostDependent(tilt) => Owner::Joint(tilt.joints[0]),
            Self::Friction { effect, .. } => Owner::Effect(*effect),
            Self::Reaction(_)
            | Self::Linear(_)
            | Self::NotSteady(_)
            | Self::Eigenvalues
            | Self::NoThreads(_)
            | Self::NotBuilt
            | Self::Observer { .. }
            | Self::Interrupted => return None,
        };
        Some(match owner {
            Owner::Body(b) => Entry::Body(b),
            Owner::Joint(j) => Entry::Joint(j),
            Owner::Effect(e) => Entry::Effect(e),
            Owner::Coupling(c) => Entry::Coupling(c),
            Owner::Rolling(r) => Entry::Rolling(r),
        })
    }

    /// Hint for the user: what to do about the error.
    #[must_use]
    #[allow(clippy::too_many_lines, reason = "one line or two for each error")]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Start(AssemblyError::Model(ModelError::LeftOut { .. })) => "set enabled = false",
            Self::Start(AssemblyError::Model(_)) => "check the data of the body",
            Self::Start(AssemblyError::Position { reached: Some(_), .. }) => {
                "hold a value up to the one that was reached, or hold fewer values: what is not written follows from the joints"
            }
            Self::Start(AssemblyError::NotLeast { .. }) => {
                "give initial values to more joints: the search then begins nearer"
            }
            Self::Start(AssemblyError::Position { .. }) => {
                "check the places of the joints, and that held values and guides fit together"
            }
            Self::Start(AssemblyError::Velocity { .. }) => {
                "hold fewer velocities: what is not written follows from the joints"
            }
            Self::Start(AssemblyError::NoInertia { .. }) => NO_INERTIA,
            Self::Start(_) => {
                "start a little away from this position, or check that guides and joints fit together"
            }
            Self::Step(error, _) => step_hint(error),
            Self::AlmostDependent(_) => {
                "write that axis; an intended tilt that holds the mechanism is larger than 0.001 rad"
            }
            Self::Reaction(_) => "leave the reaction outputs out",
            Self::Tree(TreeError::GuideCut { .. } | TreeError::EffectCut { .. }, _) => {
                "leave one of the guides or joint effects of the loop out, or try index-3"
            }
            Self::Tree(TreeError::Effect(_), _) => "set enabled = false",
            Self::Tree(TreeError::Coupling { .. } | TreeError::Signal { .. }, _) => {
                "try index-3, which takes it; or let it name joints of one coordinate that no loop needs"
            }
            Self::Tree(TreeError::CouplingGuided { .. }, _) => {
                "leave a guide or the coupling out: the guides alone determine its sum"
            }
            Self::Tree(TreeError::Dimension, _) => "give the scene the dimension of its bodies",
            Self::Tree(..) => "give the body mass and inertia, or try index-3",
            Self::Equilibrium(EquilibriumError::Escapes { .. }, _) => {
                "hold the mechanism by a joint or a spring; check the direction of gravity"
            }
            Self::Equilibrium(EquilibriumError::Undetermined { .. }, _)
            | Self::Linear(LinearError::NoInertia { .. }) => NO_INERTIA,
            Self::Equilibrium(EquilibriumError::SignalsMove, _) => {
                "let the integral measure what it drives, or take it out"
            }
            Self::Equilibrium(EquilibriumError::NotNear, _) => {
                "start nearer to it with [[initial]] values, or without `near`: the search then goes down to a stable one"
            }
            Self::Equilibrium(..) => "start nearer to the equilibrium with [[initial]] values",
            Self::Linear(LinearError::NotClosed { .. } | LinearError::Singular { .. }) => {
                "move away from the singular position with an [[initial]] value"
            }
            Self::Linear(LinearError::NotSettled { .. }) => {
                "leave out a joint that nearly repeats another"
            }
            Self::Linear(LinearError::Rolls) => "linearise about a rest, such as the equilibrium",
            Self::Linear(_) | Self::Eigenvalues => "check the data of the effects",
            Self::NotSteady(_) => {
                "start from a steady motion or a rest; `--frozen`, in Python `frozen=True`, gives the eigenvalues of the instant"
            }
            Self::NoThreads(_) => "ask for fewer threads",
            Self::NotBuilt => "build with the feature of the precision, which is on by default",
            Self::Interrupted => "rows are kept; a run with `checkpoint` continues by `resume`",
            Self::Observer { .. } => "change what the observer of the run reads or sets",
            Self::Output { .. } => {
                "measure a point nearer to the body, try a smaller step, or leave the output out"
            }
            Self::Friction { .. } => {
                "use the trapezoidal rule, radau5 or rk54; or give the friction a larger regularisation, or the run smaller steps"
            }
            Self::Energy { .. } => {
                "try a smaller step, and where stiff springs or dampers act formulation recursive with integrator radau5; if it always \
                 stops here, the mechanism locks, or cannot follow its guides: end the run or the guide before"
            }
        }
    }

    /// Keys of the scene that can cause the error, the most probable key first.
    #[must_use]
    pub fn fields(&self) -> &'static [&'static str] {
        match self {
            Self::Start(AssemblyError::Velocity { initial: Some(_), .. }) => {
                &["rate", "velocity", "angular_velocity"]
            }
            Self::Start(AssemblyError::Position { initial: Some(_), .. }) => &["value"],
            Self::Output { .. } => &["at", "name"],
            Self::AlmostDependent(_) => &["axis", "axes", "name"],
            _ => &["name"],
        }
    }

    /// Part of the scene that the error concerns.
    pub fn owner(&self) -> Option<Owner> {
        match self {
            Self::Start(error) => start_owner(error),
            Self::Step(_, owner) | Self::Tree(_, owner) | Self::Equilibrium(_, owner) => *owner,
            Self::Energy { owner, .. } => Some(*owner),
            Self::AlmostDependent(tilt) => Some(Owner::Joint(tilt.joints[0])),
            Self::Reaction(_)
            | Self::Friction { .. }
            | Self::Output { .. }
            | Self::Linear(_)
            | Self::NotSteady(_)
            | Self::Eigenvalues
            | Self::Interrupted
            | Self::Observer { .. }
            | Self::NoThreads(_)
            | Self::NotBuilt => None,
        }
    }

    /// Returns the error in its JSON form.
    #[must_use]
    pub fn report(&self, time: f64, names: &Names) -> RunError {
        let owner = self.owner();
        let (joint, body) = owner.map_or((None, None), |o| names.of(o));
        let named = match self {
            Self::Output { output } => names.outputs.get(*output),
            Self::Friction { effect, .. } => names.effects.get(*effect),
            Self::Step(StepError::Law { effect }, _) => names.effects.get(*effect as usize),
            Self::Step(StepError::Relation { coupling }, _) => {
                names.couplings.get(*coupling as usize)
            }
            _ => None,
        };
        let part = if let Self::Step(error, _) = self { names.part_of(error, self) } else { None };
        let message = part.unwrap_or_else(|| {
            named.map_or_else(|| self.to_string(), |name| format!("`{name}`: {self}"))
        });
        let hint = match self {
            Self::Observer { hint, .. } if !hint.is_empty() => hint,
            _ => self.hint(),
        };
        RunError { code: self.code().to_owned(), message, time, joint, body, hint: hint.to_owned() }
    }
}

fn start_owner(error: &AssemblyError) -> Option<Owner> {
    match error {
        AssemblyError::Position { owner, .. }
        | AssemblyError::Velocity { owner, .. }
        | AssemblyError::NoInertia { owner }
        | AssemblyError::Acceleration { owner, .. } => Some(*owner),
        AssemblyError::Model(ModelError::Basis { body } | ModelError::NoRotation { body }) => {
            Some(Owner::Body(*body))
        }
        AssemblyError::Model(ModelError::LeftOut { effect, .. }) => Some(Owner::Effect(*effect)),
        _ => None,
    }
}

impl core::fmt::Display for StopError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Start(error) => write_start(error, f),
            Self::Step(error, _) => write_step(error, f),
            Self::Reaction(error) => write!(f, "{error}"),
            Self::AlmostDependent(tilt) => write!(f, "{tilt}"),
            Self::Tree(error, _) => write_tree(error, f),
            Self::Equilibrium(error, _) => write_equilibrium(error, f),
            Self::Linear(error) => write_linear(error, f),
            Self::NotSteady(unsteady) => write!(f, "{unsteady}"),
            Self::Eigenvalues => write!(f, "the iteration for the eigenvalues did not converge"),
            Self::NoThreads(n) => write!(f, "the system gives no {n} threads"),
            Self::NotBuilt => write!(f, "this build has no steps in the scalar of the scene"),
            Self::Interrupted => write!(f, "interrupted by a signal"),
            Self::Observer { message, .. } => f.write_str(message),
            Self::Output { .. } => {
                write!(f, "an output is not finite: it is larger than numbers can be")
            }
            Self::Friction { regularisation, step, .. } => write!(
                f,
                "friction rises within {} rad/s (or m/s) of rest, and the explicit steps of {} s pass over that: it cannot hold",
                few(*regularisation),
                few(*step)
            ),
            Self::Energy { error, turned_over, share, .. } => write!(
                f,
                "the energy is off by {} J, more than {} % of the {} J exchanged: the motion is not resolved",
                few(*error),
                few(*share * 100.0),
                few(*turned_over)
            ),
        }
    }
}

impl core::error::Error for StopError {}

fn write_start(error: &AssemblyError, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
    match error {
        AssemblyError::Position { residual, reached: Some([reached, value]), .. } => write!(
            f,
            "the mechanism cannot be closed at the start: on the way from the reference configuration to {} rad (or m) this coordinate stops at {}, and {} is left",
            few(*value),
            few(*reached),
            few(*residual)
        ),
        AssemblyError::Position { residual, .. } => write!(
            f,
            "the mechanism cannot be closed at the start: a gap of {} m (or rad) is left",
            few(*residual)
        ),
        AssemblyError::Velocity { residual, .. } => write!(
            f,
            "the initial velocities contradict the joints or each other: {} m/s (or rad/s) is left",
            few(*residual)
        ),
        AssemblyError::Acceleration { residual, .. } => write!(
            f,
            "no accelerations meet the constraints at the start ({} m/s^2 is left): the mechanism stands in a singular position or locks",
            few(*residual)
        ),
        other => write!(f, "{other}"),
    }
}

fn write_tree(error: &TreeError, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
    match error {
        TreeError::GuideCut { .. } => write!(
            f,
            "relative coordinates need a joint to cut in every loop, and all of this loop are guided"
        ),
        TreeError::EffectCut { .. } => write!(
            f,
            "relative coordinates need a joint to cut in every loop, and all of this loop carry guides or joint effects"
        ),
        TreeError::MasslessEnd { .. } => {
            write!(f, "a body without mass ends a branch of the tree: its joint meets no inertia")
        }
        TreeError::Coupling { .. } => {
            write!(f, "relative coordinates do not have this coupling: try index-3")
        }
        TreeError::Signal { .. } => {
            write!(f, "a signal measures it, and it is no relative coordinate here: try index-3")
        }
        TreeError::CouplingGuided { .. } => {
            write!(
                f,
                "its joints are all guided, and their guides do not hold it: leave one of them out"
            )
        }
        TreeError::NoInertia { .. } => write!(f, "nothing beyond a joint resists its motion"),
        other => write!(f, "{other}"),
    }
}

fn write_equilibrium(
    error: &EquilibriumError,
    f: &mut core::fmt::Formatter<'_>,
) -> core::fmt::Result {
    match error {
        EquilibriumError::NotConverged { residual, .. } => {
            write!(f, "no static equilibrium was found: {} N (or N m) is left", few(*residual))
        }
        EquilibriumError::NotNear => {
            write!(f, "there is no static equilibrium near the start")
        }
        EquilibriumError::SignalsMove => {
            write!(
                f,
                "there is no static equilibrium: an integral or a lag among the signals does not come to rest"
            )
        }
        EquilibriumError::Escapes { .. } => {
            write!(f, "there is no static equilibrium: nothing holds the mechanism")
        }
        EquilibriumError::NotClosed { violation, .. } => {
            write!(
                f,
                "the mechanism cannot be closed: a gap of {} m (or rad) is left",
                few(*violation)
            )
        }
        EquilibriumError::Undetermined { .. } => {
            write!(f, "a coordinate has no mass, and neither joints nor forces determine it")
        }
        EquilibriumError::NotFinite { .. } => {
            write!(f, "a force became infinite or not a number")
        }
        other => write!(f, "{other}"),
    }
}
