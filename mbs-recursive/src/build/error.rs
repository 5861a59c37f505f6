//! Errors for scenes that have no tree, and for trees that several lanes cannot evaluate at once.

use mbs_core::actions::ActionError;

/// Reason why a scene has no tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TreeError {
    /// The dimension of the scene differs from the dimension of this space.
    Dimension,
    /// A guided joint closes a loop in which every joint is guided, or a guided joint connects no moving body.
    GuideCut {
        /// Index of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// A joint with an effect about its axis, for example a torsion spring, closes a loop. The joint must be cut, because every joint of
    /// the loop has such an effect or is guided.
    EffectCut {
        /// Index of the effect: `scene.effects[effect]`.
        effect: usize,
        /// Index of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// Relative coordinates cannot express a coupling. One of its joints is free, connects parts of one rigid body, or must be cut. A joint
    /// must be cut if every joint of its loop is guided or has an effect or a coupling.
    Coupling {
        /// Index of the coupling: `scene.couplings[coupling]`.
        coupling: usize,
    },
    /// A signal measures a joint whose coordinate is no coordinate of the tree. The joint is free, connects parts of one rigid body, or
    /// must be cut. A joint must be cut if the coordinate of every joint of its loop is required.
    Signal {
        /// Index of the joint: `scene.joints[joint]`.
        joint: usize,
    },
    /// A coupling has guided joints only, and their guides contradict the coupling.
    CouplingGuided {
        /// Index of the coupling: `scene.couplings[coupling]`.
        coupling: usize,
    },
    /// An effect cannot be made into actions.
    Effect(ActionError),
    /// A body at the end of a branch has no mass, so that its joint moves no inertia.
    MasslessEnd {
        /// Index of the body: `scene.bodies[body]`.
        body: usize,
    },
    /// A joint moves no inertia: the bodies that it carries have no inertia along its freedom.
    NoInertia {
        /// Owner of the freedom: the joint, or the free body.
        owner: mbs_core::model::Owner,
    },
}

/// Reason why several states of a mechanism cannot be evaluated at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LanesError {
    /// Error: the scene cannot be made into a tree.
    Tree(TreeError),
    /// The mechanism has loops. The number of sweeps of a loop depends on the state, so lanes may differ.
    Closed {
        /// Number of rows (scalar equations) of all loops.
        rows: usize,
    },
    /// The law of an effect has pieces. Or the law is user-defined, so that its branches are unknown.
    Effect {
        /// Index of the effect: `scene.effects[effect]`.
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
