//! Scenes that cannot be made into a tree, and what cannot be asked of one.

use mbs_core::actions::ActionError;

/// Reason why a scene has no tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TreeError {
    /// The scene is not of this space's dimension.
    Dimension,
    /// A guided joint closes a loop in which every joint is guided, or moves nothing.
    GuideCut {
        /// Number of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// A joint with a torsion spring or a torque closes a loop in which every joint has one or is guided.
    EffectCut {
        /// Number of the effect: `scene.effects[effect]`.
        effect: usize,
        /// Number of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// A coupling that relative coordinates do not have: a joint of it closes a loop in which every joint is guided or has an effect or a
    /// coupling, is free, or holds parts of one body together.
    Coupling {
        /// Number of the coupling: `scene.couplings[coupling]`.
        coupling: usize,
    },
    /// A signal measures a joint that relative coordinates do not give as one number: it closes a loop in which every joint is asked for,
    /// is free, or holds parts of one body together.
    Signal {
        /// Number of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// A coupling of guided joints alone, which their guides do not hold.
    CouplingGuided {
        /// Number of the coupling: `scene.couplings[coupling]`.
        coupling: usize,
    },
    /// An effect gives no actions.
    Effect(ActionError),
    /// A body without mass at the end of a branch: its joint meets no inertia.
    MasslessEnd {
        /// Number of the body: `scene.bodies[body]`.
        body: usize,
    },
    /// A joint meets no inertia: nothing beyond it resists its motion.
    NoInertia {
        /// The joint, or the free body.
        owner: mbs_core::model::Owner,
    },
}

/// Reason why several states of a mechanism are not evaluated at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LanesError {
    /// There is no tree.
    Tree(TreeError),
    /// Loops are swept until they close, each as often as it needs.
    Closed {
        /// Number of loop rows.
        rows: usize,
    },
    /// A law with pieces, or one whose branches are not known.
    Effect {
        /// Number of the effect: `scene.effects[effect]`.
        effect: usize,
    },
}

impl core::fmt::Display for LanesError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Tree(error) => write!(f, "{error}"),
            Self::Closed { rows } => write!(
                f,
                "the mechanism has loops ({rows} rows), each of which takes sweeps of its own: evaluate its states one by one"
            ),
            Self::Effect { effect } => write!(
                f,
                "effect {effect} acts by pieces, which lanes would not take alike: leave it out, or evaluate states one by one"
            ),
        }
    }
}

impl core::error::Error for LanesError {}

impl core::fmt::Display for TreeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Dimension => write!(f, "the scene is not of this dimension"),
            Self::GuideCut { joint } => write!(
                f,
                "guided joint {joint} would have to be cut, all joints of its loop being guided or welded: leave one guide out, or try index-3"
            ),
            Self::EffectCut { effect, joint } => write!(
                f,
                "joint {joint} of effect {effect} would have to be cut, all joints of its loop having effects or guides: try index-3"
            ),
            Self::Coupling { coupling } => {
                write!(f, "coupling {coupling} is not built in relative coordinates: try index-3")
            }
            Self::Signal { joint } => write!(
                f,
                "joint {joint}, which a signal measures, is not a relative coordinate here: try index-3"
            ),
            Self::CouplingGuided { coupling } => write!(
                f,
                "the joints of coupling {coupling} are all guided, and their guides do not hold it: leave one of them out"
            ),
            Self::Effect(error) => write!(f, "{error}"),
            Self::MasslessEnd { body } => write!(
                f,
                "body {body} has no mass and ends a branch, so that its joint meets no inertia: give it mass, or replace a massless link with two balls by a distance joint"
            ),
            Self::NoInertia { owner } => {
                write!(f, "{owner:?} meets no inertia: give what hangs on it mass or inertia")
            }
        }
    }
}

impl core::error::Error for TreeError {}

impl From<ActionError> for TreeError {
    fn from(error: ActionError) -> Self {
        Self::Effect(error)
    }
}
