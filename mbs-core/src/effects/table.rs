//! Expansions of the list of effects: modules, names, the enums of laws, and the enum of kinds with its dispatch.

/// Modules and kinds of a list of effects.
macro_rules! kinds {
    ($(
        $Kind:ident in $module:ident $gate:tt
        $(tension $Tension:ident($TensionLaw:ident $(<$TS:ident>)?) = $tension_tag:literal)?
        $(body $Body:ident($BodyLaw:ident $(<$BS:ident>)?) = $body_tag:literal)?;
    )*) => {
        $(pub mod $module;)*
        /// The data of each kind.
        #[cfg(feature = "alloc")]
        pub mod kinds {
            $(pub use super::$module::$Kind;)*
        }
        #[cfg(feature = "alloc")]
        pub use kinds::*;
        #[cfg(feature = "alloc")]
        kind::kinds! { $($Kind $module $gate),* }
    };
}

/// The laws of a list of effects.
macro_rules! laws {
    ($(
        $Kind:ident in $module:ident $gate:tt
        $(tension $Tension:ident($TensionLaw:ident $(<$TS:ident>)?) = $tension_tag:literal)?
        $(body $Body:ident($BodyLaw:ident $(<$BS:ident>)?) = $body_tag:literal)?;
    )*) => {
        /// The laws, as tables of controllers name them.
        pub mod laws {
            $($(pub use super::super::$module::$TensionLaw;)?)*
            $($(pub use super::super::$module::$BodyLaw;)?)*
        }

        /// A law along a length or about an angle.
        #[derive(Debug, Clone, Copy, PartialEq)]
        #[non_exhaustive]
        pub enum Law<T> {
            $($(
                #[cfg $gate]
                #[doc = concat!("[`", stringify!($TensionLaw), "`](laws::", stringify!($TensionLaw), ").")]
                $Tension(super::$module::$TensionLaw $(<$TS>)?),
            )?)*
        }

        $($(impl<T> From<super::$module::$TensionLaw $(<$TS>)?> for Option<Law<T>> {
            /// `None` where the Cargo feature of its effect is off.
            fn from(law: super::$module::$TensionLaw $(<$TS>)?) -> Self {
                #[cfg $gate]
                return Some(Law::$Tension(law));
                #[cfg(not $gate)]
                {
                    let _ = law;
                    None
                }
            }
        })?)*

        table::dispatch! { Law [$($([$gate $Tension $tension_tag])?)*] TensionLaw {
            /// Tension and its tangents at a value and its rate.
            ///
            /// The line of action does not turn ([`ScalarForce::transverse`] is zero): a law along a length adds that itself.
            #[inline]
            #[must_use]
            fn evaluate(value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T>;
            /// Stored energy [J] of the elastic part at a value.
            #[inline]
            fn energy(value: T, law_inputs: &LawInputs<'_, T>) -> T;
            /// Power that is not stored: dampers take, courses give [W].
            #[inline]
            fn power(measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T;
            /// The slope at an iterate, with the iterate `before`.
            #[inline]
            fn look_back(measure: &mut ScalarForce<T>, before: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> ();
            /// The slope by the rate for an iteration that does not look back; not below the tangent.
            #[inline]
            fn secant(measure: &ScalarForce<T>) -> T;
            /// May it stand in the way like a wall, with a force that begins somewhere?
            fn may_push() -> bool;
            /// How many gaps it has; none where it acts always.
            fn n_gaps() -> usize;
            /// Does the damper of its contact fade in over a depth?
            fn has_fade() -> bool;
            /// Its gaps and their rates at a value and its rate.
            fn gaps(value: T, rate: T) -> [[T; 2]; 2];
            /// Can it have kinks besides those of its gaps?
            fn may_have_kinks() -> bool;
            /// Hands out its kinks, in no order.
            fn kinks(law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) -> ();
            /// Is all that it refers to by number there?
            fn fits(law_inputs: &LawInputs<'_, T>, n_courses: usize) -> bool;
            /// A bound of the operations of [`evaluate`](Self::evaluate).
            fn operations() -> Operations;
        } }

        /// A law on one body. Where no feature brings one there is no value of this type, and the compiler drops what would act on one.
        #[derive(Debug, Clone, Copy, PartialEq)]
        #[non_exhaustive]
        pub enum BodyLaw<T> {
            /// Variant that cannot be made.
            #[doc(hidden)]
            Never(NeverLaw<T>),
            $($(
                #[cfg $gate]
                #[doc = concat!("[`", stringify!($BodyLaw), "`](laws::", stringify!($BodyLaw), ").")]
                $Body(super::$module::$BodyLaw $(<$BS>)?),
            )?)*
        }

        $($(impl<T> From<super::$module::$BodyLaw $(<$BS>)?> for Option<BodyLaw<T>> {
            /// `None` where the Cargo feature of its effect is off.
            fn from(law: super::$module::$BodyLaw $(<$BS>)?) -> Self {
                #[cfg $gate]
                return Some(BodyLaw::$Body(law));
                #[cfg(not $gate)]
                {
                    let _ = law;
                    None
                }
            }
        })?)*

        table::dispatch! { BodyLaw [[(all()) Never 4_294_967_295] $($([$gate $Body $body_tag])?)*] WrenchesLaw {
            /// Number of actions.
            fn n_actions() -> usize;
            /// Does the law ask for the body's direction and spin, or give moments?
            fn needs_rotation() -> bool;
            /// Writes the actions at a motion into `out`, [`n_actions`](Self::n_actions) long.
            fn evaluate(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>, out: &mut [UnitWrench<T>]) -> ();
            /// The slope of an action by the iterate `before`; the first one of a step has no rate.
            #[inline]
            fn look_back(action: usize, measure: &mut ScalarForce<T>, before: &ScalarForce<T>) -> ();
            /// The slope of an action by its rate for an iteration that does not look back; not below the tangent.
            #[inline]
            fn secant(action: usize, measure: &ScalarForce<T>) -> T;
            /// Stored energy of an action [J].
            fn energy(action: usize, measure: &ScalarForce<T>) -> T;
            /// Power of an action that is not stored [W].
            fn power(action: usize, measure: &ScalarForce<T>) -> T;
            /// How many gaps it has; none where it acts always.
            fn n_gaps() -> usize;
            /// Does the damper of its contact fade in over a depth?
            fn has_fade() -> bool;
            /// Its gap with the rate, then where it is over its road and how fast, along and up.
            fn watch(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> [[T; 2]; 3];
            /// What the road does to a tire; `None` of other laws.
            fn tire(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> Option<TireForces<T>>;
            /// Can it have kinks besides those of its gaps?
            fn may_have_kinks() -> bool;
            /// Hands out its kinks, in no order.
            fn kinks(law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) -> ();
            /// How far from its place a kink may be passed [m].
            fn reach() -> T;
            /// Is all that it refers to by number there?
            fn fits(law_inputs: &LawInputs<'_, T>, n_courses: usize) -> bool;
            /// A bound of the operations of [`evaluate`](Self::evaluate).
            fn operations(law_inputs: &LawInputs<'_, T>) -> Operations;
        } }
    };
}

/// The Cargo feature of a gate.
macro_rules! feature_of {
    (all()) => {
        None
    };
    (feature = $name:literal) => {
        Some($name)
    };
}

/// An enum of laws: each method asks the law that it is, numbers in tables are a tag and those of the law.
macro_rules! dispatch {
    ($Enum:ident $laws:tt $Trait:ident { $(
        $(#[$meta:meta])*
        fn $method:ident($($arg:ident: $Arg:ty),*) -> $Out:ty;
    )* }) => {
        /// Methods that ask the law of the variant.
        impl<T: Real> $Enum<T> {
            $(table::method! {
                $laws $Trait law (law $(, $arg)*) $(#[$meta])* fn $method($($arg: $Arg),*) -> $Out
            })*
            table::tags! { $Enum $laws }
        }
    };
}

/// One method of an enum of laws.
macro_rules! method {
    ([$([$gate:tt $Variant:ident $tag:literal])*] $Trait:ident $law:ident $call:tt $(#[$meta:meta])*
        fn $method:ident($($arg:ident: $Arg:ty),*) -> $Out:ty) => {
        $(#[$meta])*
        pub fn $method(&self $(, $arg: $Arg)*) -> $Out {
            match self {
                $(#[cfg $gate] Self::$Variant($law) => $Trait::<T>::$method $call,)*
            }
        }
    };
}

/// Reading and writing an enum of laws, and the feature of each.
macro_rules! tags {
    ($Enum:ident [$([$gate:tt $Variant:ident $tag:literal])*]) => {
        /// Reads a law from the numbers of a table.
        ///
        /// # Errors
        /// Those of the reader; a law that this build has not.
        pub fn read<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
            match from.word()? {
                $(#[cfg $gate] $tag => Ok(Self::$Variant(Entry::of(from)?)),)*
                _ => Err(from.fault()),
            }
        }

        /// Writes the numbers of the law; false if it is not made of numbers, as a user's own.
        pub fn write<W: EntryWriter<T>>(&self, to: &mut W) -> bool {
            match self {
                $(#[cfg $gate] Self::$Variant(law) => {
                    to.tag($tag);
                    to.open(concat!(stringify!($Enum), "::", stringify!($Variant)));
                    to.field("0");
                    let is_written = Entry::<T>::numbers(law, to);
                    to.close();
                    is_written
                })*
            }
        }

        /// The Cargo feature that brings the law; `None`: every build has it.
        #[must_use]
        pub fn feature(&self) -> Option<&'static str> {
            match self {
                $(#[cfg $gate] Self::$Variant(_) => table::feature_of! $gate,)*
            }
        }
    };
}

pub(super) use {dispatch, feature_of, kinds, laws, method, tags};
