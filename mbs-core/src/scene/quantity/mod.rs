//! Quantities that outputs measure, as data: kind and target of each. `list` has all quantities; `outputs` computes them from a
//! state.

pub(crate) mod list;
mod target;

pub use target::{RelativePoint, Target, VehicleSide, WheelCarrier};

use crate::scene::{BodyId, CouplingId, EffectId, JointId, RollingId, SignalId};

/// Makes the enum of all quantities from their list.
macro_rules! quantities {
    (
        point { $($(#[doc = $point_doc:literal])+ $Point:ident in $point:ident;)* }
        relative { $($(#[doc = $relative_doc:literal])+ $Relative:ident in $relative:ident;)* }
        turning { $($(#[doc = $turning_doc:literal])+ $Turning:ident in $turning:ident;)* }
        carrier { $($(#[doc = $carrier_doc:literal])+ $Carrier:ident in $carrier:ident;)* }
        $(of $Target:ident($id:ident: $Id:ident) {
            $($(#[doc = $doc:literal])+ $Kind:ident in $module:ident;)*
        })*
        scene { $($(#[doc = $scene_doc:literal])+ $Scene:ident in $scene:ident;)* }
    ) => {
        /// Quantity that an output channel measures.
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        pub enum Quantity<T> {
            $(
                $(#[doc = $point_doc])+
                $Point {
                    /// Body.
                    body: BodyId,
                    /// Point in the reference configuration [m].
                    at: [T; 3],
                },
            )*
            $(
                $(#[doc = $relative_doc])+
                $Relative(RelativePoint<T>),
            )*
            $(
                $(#[doc = $turning_doc])+
                $Turning {
                    /// Body.
                    body: BodyId,
                    /// The other body.
                    relative_to: BodyId,
                },
            )*
            $(
                $(#[doc = $carrier_doc])+
                $Carrier(WheelCarrier<T>),
            )*
            $($(
                $(#[doc = $doc])+
                $Kind {
                    #[doc = concat!(stringify!($Target), ".")]
                    $id: $Id,
                },
            )*)*
            $(
                $(#[doc = $scene_doc])+
                $Scene,
            )*
        }

        impl<T> Quantity<T> {
            /// Target of the quantity: the part of the scene that is measured.
            #[must_use]
            pub fn target(&self) -> Target<T>
            where
                T: Clone,
            {
                match self {
                    $(Self::$Point { body, at } => Target::Point(*body, at.clone()),)*
                    $(Self::$Relative(of) => Target::RelativePoint(of.clone()),)*
                    $(Self::$Turning { body, relative_to } => Target::RelativeBody(*body, *relative_to),)*
                    $(Self::$Carrier(of) => Target::WheelCarrier(of.clone()),)*
                    $($(Self::$Kind { $id } => Target::$Target(*$id),)*)*
                    $(Self::$Scene => Target::Scene,)*
                }
            }

            /// Returns the quantity with each number converted by `f`.
            pub fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Quantity<U> {
                match self {
                    $(Self::$Point { body, at } => {
                        Quantity::$Point { body: *body, at: at.each_ref().map(f) }
                    })*
                    $(Self::$Relative(of) => Quantity::$Relative(RelativePoint {
                        body: of.body,
                        at: of.at.each_ref().map(&mut *f),
                        relative_to: of.relative_to,
                        origin: of.origin.each_ref().map(f),
                    }),)*
                    $(Self::$Turning { body, relative_to } => {
                        Quantity::$Turning { body: *body, relative_to: *relative_to }
                    })*
                    $(Self::$Carrier(of) => Quantity::$Carrier(WheelCarrier {
                        body: of.body,
                        relative_to: of.relative_to,
                        side: of.side,
                        up: of.up.each_ref().map(&mut *f),
                        forward: of.forward.each_ref().map(&mut *f),
                        axis: of.axis.as_ref().map(|axis| axis.each_ref().map(f)),
                    }),)*
                    $($(Self::$Kind { $id } => Quantity::$Kind { $id: *$id },)*)*
                    $(Self::$Scene => Quantity::$Scene,)*
                }
            }
        }
    };
}

list::list!(quantities);
