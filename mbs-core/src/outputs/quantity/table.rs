//! What the list of quantities is made into: modules, the enum with its targets and rows, constructors, and the enum that reads them.

/// Makes a list of quantities.
macro_rules! quantities {
    (
        point { $($(#[doc = $point_doc:literal])+ $Point:ident in $point:ident;)* }
        body { $($(#[doc = $body_doc:literal])+ $Body:ident in $body:ident;)* }
        joint { $($(#[doc = $joint_doc:literal])+ $Joint:ident in $joint:ident;)* }
    ) => {
        $(mod $point;)*
        $(mod $body;)*
        $(mod $joint;)*

        /// What a channel measures.
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
                $(#[doc = $body_doc])+
                $Body {
                    /// Body.
                    body: BodyId,
                },
            )*
            $(
                $(#[doc = $joint_doc])+
                $Joint {
                    /// Joint.
                    joint: JointId,
                },
            )*
        }

        /// Every kind of quantity, in the order of the format.
        pub const QUANTITIES: &[QuantityRow] = &[$($point::ROW,)* $($body::ROW,)* $($joint::ROW,)*];

        const _: () = {
            $(assert!(matches!($point::ROW.target, TargetKind::Point));)*
            $(assert!(matches!($body::ROW.target, TargetKind::Body));)*
            $(assert!(matches!($joint::ROW.target, TargetKind::Joint));)*
        };

        impl<T> Quantity<T> {
            /// What is known of its kind.
            #[must_use]
            pub const fn row(&self) -> &'static QuantityRow {
                match self {
                    $(Self::$Point { .. } => &$point::ROW,)*
                    $(Self::$Body { .. } => &$body::ROW,)*
                    $(Self::$Joint { .. } => &$joint::ROW,)*
                }
            }

            /// The quantity of this name in scene files; `None` where what it is to be of has none.
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
                    $(Target::Point(body, at) if name == $point::ROW.name => Self::$Point { body, at },)*
                    $(Target::Body(body) if name == $body::ROW.name => Self::$Body { body },)*
                    $(Target::Joint(joint) if name == $joint::ROW.name => Self::$Joint { joint },)*
                    _ => return None,
                })
            }

            /// What it is of.
            #[must_use]
            pub fn target(&self) -> Target<T>
            where
                T: Clone,
            {
                match self {
                    $(Self::$Point { body, at } => Target::Point(*body, at.clone()),)*
                    $(Self::$Body { body } => Target::Body(*body),)*
                    $(Self::$Joint { joint } => Target::Joint(*joint),)*
                }
            }

            /// The same with every number as `f` gives it.
            pub fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Quantity<U> {
                match self {
                    $(Self::$Point { body, at } => {
                        Quantity::$Point { body: *body, at: at.each_ref().map(f) }
                    })*
                    $(Self::$Body { body } => Quantity::$Body { body: *body },)*
                    $(Self::$Joint { joint } => Quantity::$Joint { joint: *joint },)*
                }
            }
        }
    };
}

/// Constructors of outputs.
macro_rules! constructors {
    (
        point { $($(#[doc = $point_doc:literal])+ $Point:ident in $point:ident;)* }
        body { $($(#[doc = $body_doc:literal])+ $Body:ident in $body:ident;)* }
        joint { $($(#[doc = $joint_doc:literal])+ $Joint:ident in $joint:ident;)* }
    ) => {
        impl Output<Number> {
            $(
                $(#[doc = $point_doc])+
                pub fn $point(body: BodyId, at: impl Into<Vector3>) -> Self {
                    Self::new(Quantity::$Point { body, at: at.into().0 })
                }
            )*
            $(
                $(#[doc = $body_doc])+
                #[must_use]
                pub fn $body(body: BodyId) -> Self {
                    Self::new(Quantity::$Body { body })
                }
            )*
            $(
                $(#[doc = $joint_doc])+
                #[must_use]
                pub fn $joint(joint: JointId) -> Self {
                    Self::new(Quantity::$Joint { joint })
                }
            )*
        }
    };
}

/// What reads each.
macro_rules! channels {
    (
        point { $($(#[doc = $point_doc:literal])+ $Point:ident in $point:ident;)* }
        body { $($(#[doc = $body_doc:literal])+ $Body:ident in $body:ident;)* }
        joint { $($(#[doc = $joint_doc:literal])+ $Joint:ident in $joint:ident;)* }
    ) => {
        /// What one channel reads.
        #[derive(Debug, Clone)]
        pub(in crate::outputs) enum Channel<T: Real, const D: usize> {
            $($Point(super::$point::$Point<T, D>),)*
            $($Body(super::$body::$Body<T, D>),)*
            $($Joint(super::$joint::$Joint<T, D>),)*
        }

        impl<T: Real, const D: usize> Channel<T, D> {
            pub(in crate::outputs) fn new(quantity: &Quantity<T>, from: &mut Maker<'_, T, D>) -> Self {
                match *quantity {
                    $(Quantity::$Point { body, at } => {
                        Self::$Point(Measured::new(from.model.point(body, at), from))
                    })*
                    $(Quantity::$Body { body } => Self::$Body(Measured::new(body, from)),)*
                    $(Quantity::$Joint { joint } => Self::$Joint(Measured::new(joint, from)),)*
                }
            }

            pub(in crate::outputs) fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
                match self {
                    $(Self::$Point(channel) => channel.write(now, out),)*
                    $(Self::$Body(channel) => channel.write(now, out),)*
                    $(Self::$Joint(channel) => channel.write(now, out),)*
                }
            }
        }
    };
}

pub(super) use {channels, constructors, quantities};
