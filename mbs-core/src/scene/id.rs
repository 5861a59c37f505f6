//! Handles: numbers that identify a body, joint, effect or other entry of a scene.
//!
//! A handle is the place of an entry in its list. Each kind has its own type, so that a joint cannot be passed as a body.

/// Body by its place in `scene.bodies`, or the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BodyId {
    /// Ground, which is the fixed frame.
    Ground,
    /// Body number i (from 0): `scene.bodies[i]`.
    Body(usize),
}

/// Ground, which is the fixed frame.
pub const GROUND: BodyId = BodyId::Ground;

impl BodyId {
    /// Ground, which is the fixed frame.
    pub const GROUND: Self = Self::Ground;

    /// Body at a place in `scene.bodies`.
    #[must_use]
    pub const fn new(index: usize) -> Self {
        Self::Body(index)
    }

    /// Place of the body in `scene.bodies`; `None` for the ground.
    #[must_use]
    pub const fn index(self) -> Option<usize> {
        match self {
            Self::Ground => None,
            Self::Body(index) => Some(index),
        }
    }
}

macro_rules! handle {
    ($(#[$text:meta])* $name:ident) => {
        $(#[$text])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(usize);

        impl $name {
            /// Handle of the entry at a place in its list.
            #[must_use]
            pub const fn new(index: usize) -> Self {
                Self(index)
            }

            /// Place of the entry in its list.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0
            }
        }
    };
}

handle!(/** A joint by its place in `scene.joints`. */ JointId);
handle!(/** An initial condition by its place in `scene.initials`. */ InitialId);
handle!(/** A guide by its place in `scene.guides`. */ GuideId);
handle!(/** A coupling by its place in `scene.couplings`. */ CouplingId);
handle!(/** A rolling by its place in `scene.rollings`. */ RollingId);
handle!(/** An effect by its place in `scene.effects`. */ EffectId);
handle!(/** An output by its place in `scene.outputs`. */ OutputId);
handle!(/** A signal by its place in `scene.signals`. */ SignalId);
