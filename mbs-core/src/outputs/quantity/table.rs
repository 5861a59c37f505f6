//! Macros that expand the list of quantities: to modules, rows, constructors, and the enum of channels.

/// Expands a list of quantities to modules and rows.
macro_rules! rows {
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
        $(mod $point;)*
        $(mod $relative;)*
        $(mod $turning;)*
        $(mod $carrier;)*
        $($(mod $module;)*)*
        $(mod $scene;)*

        /// All kinds of quantity, in the order of the scene format.
        pub const QUANTITIES: &[QuantityRow] =
            &[$($point::ROW,)* $($relative::ROW,)* $($turning::ROW,)* $($carrier::ROW,)* $($($module::ROW,)*)* $($scene::ROW,)*];

        const _: () = {
            $(assert!(matches!($point::ROW.target, TargetKind::Point));)*
            $(assert!(matches!($relative::ROW.target, TargetKind::RelativePoint));)*
            $(assert!(matches!($turning::ROW.target, TargetKind::RelativeBody));)*
            $(assert!(matches!($carrier::ROW.target, TargetKind::WheelCarrier));)*
            $($(assert!(matches!($module::ROW.target, TargetKind::$Target));)*)*
            $(assert!(matches!($scene::ROW.target, TargetKind::Scene));)*
        };

        impl<T> Quantity<T> {
            /// Row of the quantity in the table of quantities.
            #[must_use]
            pub const fn row(&self) -> &'static QuantityRow {
                match self {
                    $(Self::$Point { .. } => &$point::ROW,)*
                    $(Self::$Relative(_) => &$relative::ROW,)*
                    $(Self::$Turning { .. } => &$turning::ROW,)*
                    $(Self::$Carrier(_) => &$carrier::ROW,)*
                    $($(Self::$Kind { .. } => &$module::ROW,)*)*
                    $(Self::$Scene => &$scene::ROW,)*
                }
            }

            /// Quantity of this name in scene files; `None` if the target has no such quantity.
            ///
            /// ```
            /// use mbs_core::outputs::{Quantity, Target};
            /// use mbs_core::scene::JointId;
            /// let joint = JointId::new(0);
            /// let rate = Quantity::<f64>::of("rate", Target::Joint(joint));
            /// assert_eq!(rate, Some(Quantity::JointRate { joint }));
            /// ```
            #[must_use]
            pub fn of(name: &str, target: Target<T>) -> Option<Self> {
                Some(match target {
                    $(Target::Point(body, at) if $point::ROW.has_name(name) => Self::$Point { body, at },)*
                    $(Target::RelativePoint(of) if $relative::ROW.has_name(name) => Self::$Relative(of),)*
                    $(Target::RelativeBody(body, relative_to) if $turning::ROW.has_name(name) => {
                        Self::$Turning { body, relative_to }
                    })*
                    $(Target::WheelCarrier(of) if $carrier::ROW.has_name(name) => Self::$Carrier(of),)*
                    $($(Target::$Target($id) if $module::ROW.has_name(name) => Self::$Kind { $id },)*)*
                    $(Target::Scene if $scene::ROW.has_name(name) => Self::$Scene,)*
                    _ => return None,
                })
            }
        }
    };
}

/// Expands a list of quantities to constructors of outputs.
macro_rules! constructors {
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
        impl Output<Number> {
            $(
                $(#[doc = $point_doc])+
                pub fn $point(body: BodyId, at: impl Into<Vector3>) -> Self {
                    Self::new(Quantity::$Point { body, at: at.into().0 })
                }
            )*
            $(
                $(#[doc = $relative_doc])+
                pub fn $relative<P: Into<Vector3>>(
                    (body, at): (BodyId, P),
                    (relative_to, origin): (BodyId, P),
                ) -> Self {
                    let (at, origin) = (at.into().0, origin.into().0);
                    Self::new(Quantity::$Relative(RelativePoint { body, at, relative_to, origin }))
                }
            )*
            $(
                $(#[doc = $turning_doc])+
                #[must_use]
                pub fn $turning(body: BodyId, relative_to: BodyId) -> Self {
                    Self::new(Quantity::$Turning { body, relative_to })
                }
            )*
            $(
                $(#[doc = $carrier_doc])+
                #[must_use]
                pub fn $carrier(of: WheelCarrier<Number>) -> Self {
                    Self::new(Quantity::$Carrier(of))
                }
            )*
            $($(
                $(#[doc = $doc])+
                #[must_use]
                pub fn $module($id: $Id) -> Self {
                    Self::new(Quantity::$Kind { $id })
                }
            )*)*
            $(
                $(#[doc = $scene_doc])+
                #[must_use]
                pub fn $scene() -> Self {
                    Self::new(Quantity::$Scene)
                }
            )*
        }
    };
}

/// Expands a list of quantities to the enum of channels.
macro_rules! channels {
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
        /// Channel of an output: one of the kinds of quantity.
        #[derive(Debug, Clone)]
        pub(in crate::outputs) enum Channel<T: Real, const D: usize> {
            $($Point(super::$point::$Point<T, D>),)*
            $($Relative(super::$relative::$Relative<T, D>),)*
            $($Turning(super::$turning::$Turning<T, D>),)*
            $($Carrier(super::$carrier::$Carrier<T, D>),)*
            $($($Kind(super::$module::$Kind<T, D>),)*)*
            $($Scene(super::$scene::$Scene<T, D>),)*
        }

        impl<T: Real, const D: usize> Channel<T, D> {
            pub(in crate::outputs) fn new(quantity: &Quantity<T>, from: &mut Maker<'_, T, D>) -> Self {
                match *quantity {
                    $(Quantity::$Point { body, at } => {
                        Self::$Point(Measured::new(from.model.point(body, at), from))
                    })*
                    $(Quantity::$Relative(of) => {
                        Self::$Relative(Measured::new(SeenPoint::new(&of, from), from))
                    })*
                    $(Quantity::$Turning { body, relative_to } => {
                        Self::$Turning(Measured::new([body, relative_to], from))
                    })*
                    $(Quantity::$Carrier(of) => Self::$Carrier(Measured::new(of, from)),)*
                    $($(Quantity::$Kind { $id } => Self::$Kind(Measured::new($id, from)),)*)*
                    $(Quantity::$Scene => Self::$Scene(Measured::new((), from)),)*
                }
            }

            pub(in crate::outputs) fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
                match self {
                    $(Self::$Point(channel) => channel.write(now, out),)*
                    $(Self::$Relative(channel) => channel.write(now, out),)*
                    $(Self::$Turning(channel) => channel.write(now, out),)*
                    $(Self::$Carrier(channel) => channel.write(now, out),)*
                    $($(Self::$Kind(channel) => channel.write(now, out),)*)*
                    $(Self::$Scene(channel) => channel.write(now, out),)*
                }
            }

            pub(in crate::outputs) fn followed(&self) -> Option<&Followed<T, D>> {
                match self {
                    $(Self::$Point(channel) => channel.followed(),)*
                    $(Self::$Relative(channel) => channel.followed(),)*
                    $(Self::$Turning(channel) => channel.followed(),)*
                    $(Self::$Carrier(channel) => channel.followed(),)*
                    $($(Self::$Kind(channel) => channel.followed(),)*)*
                    $(Self::$Scene(channel) => channel.followed(),)*
                }
            }
        }
    };
}

pub(super) use {channels, constructors, rows};
