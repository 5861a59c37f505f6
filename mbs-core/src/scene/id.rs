//! Handles: which body, joint, effect or other entry of a scene is meant.
//!
//! A handle is the place of an entry in its list. The kinds are types of their own, so that a joint is not passed for a body.

use crate::scene::{Effect, Guide, InitialCondition, Joint, Output};
use alloc::vec::Vec;
use core::ops::{Index, IndexMut};

/// A body by its place in `scene.bodies`, or the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BodyId {
    /// The fixed frame.
    Ground,
    /// `scene.bodies[i]`.
    Body(usize),
}

/// The fixed frame.
pub const GROUND: BodyId = BodyId::Ground;

impl BodyId {
    /// The fixed frame.
    pub const GROUND: Self = Self::Ground;

    /// The body at a place in `scene.bodies`.
    #[must_use]
    pub const fn new(index: usize) -> Self {
        Self::Body(index)
    }

    /// Its place in `scene.bodies`; `None` for the ground.
    #[must_use]
    pub const fn index(self) -> Option<usize> {
        match self {
            Self::Ground => None,
            Self::Body(index) => Some(index),
        }
    }
}

macro_rules! handle {
    ($(#[$text:meta])* $name:ident of $entry:ident) => {
        $(#[$text])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(usize);

        impl $name {
            /// The entry at a place in its list.
            #[must_use]
            pub const fn new(index: usize) -> Self {
                Self(index)
            }

            /// Its place in its list.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0
            }
        }

        impl<T> Index<$name> for Vec<$entry<T>> {
            type Output = $entry<T>;

            fn index(&self, id: $name) -> &$entry<T> {
                &self[id.0]
            }
        }

        impl<T> IndexMut<$name> for Vec<$entry<T>> {
            fn index_mut(&mut self, id: $name) -> &mut $entry<T> {
                &mut self[id.0]
            }
        }
    };
}

handle!(/** A joint by its place in `scene.joints`. */ JointId of Joint);
handle!(/** An initial condition by its place in `scene.initials`. */ InitialId of InitialCondition);
handle!(/** A guide by its place in `scene.guides`. */ GuideId of Guide);
handle!(/** An effect by its place in `scene.effects`. */ EffectId of Effect);
handle!(/** An output by its place in `scene.outputs`. */ OutputId of Output);
