//! Expansions of the list of effects: modules, names, the enums of laws, and the enum of kinds with its dispatch.

/// Declares the modules and the enum of kinds from a list of effects.
macro_rules! kinds {
    ($(
        $Kind:ident in $module:ident $gate:tt
        $(tension $Tension:ident($TensionLaw:ident $(<$TS:ident>)?) = $tension_tag:literal)?
        $(body $Body:ident($BodyLaw:ident $(<$BS:ident>)?) = $body_tag:literal)?;
    )*) => {
        $(pub mod $module;)*
        /// Data of each kind of effect.
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

/// Declares the laws of a list of effects.
macro_rules! laws {
    ($(
        $Kind:ident in $module:ident $gate:tt
        $(tension $Tension:ident($TensionLaw:ident $(<$TS:ident>)?) = $tension_tag:literal)?
        $(body $Body:ident($BodyLaw:ident $(<$BS:ident>)?) = $body_tag:literal)?;
    )*) => {
        /// Laws under the names that the tables of controllers use.
        pub mod laws {
            $($(pub use super::super::$module::$TensionLaw;)?)*
            $($(pub use super::super::$module::$BodyLaw;)?)*
        }

        /// Law along a length or about an angle.
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
            /// Converts the law; `None` if the Cargo feature of its effect is off.
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
            /// Tension and its tangents, for a value and its rate.
            ///
            /// The result is without rotation of the line of action: [`ScalarForce::transverse`] is zero. A law along a length
            /// adds it itself.
            #[inline]
            #[must_use]
            fn evaluate(value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T>;
            /// Energy that the elastic part stores at a value [J].
            #[inline]
            fn energy(value: T, law_inputs: &LawInputs<'_, T>) -> T;
            /// Power that is not stored [W]: dampers dissipate it, signals supply it.
            #[inline]
            fn power(measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T;
            /// Improves the slope with the iterate `before`.
            #[inline]
            fn look_back(measure: &mut ScalarForce<T>, before: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> ();
            /// Slope by the rate, for iterations that do not use the iterate before. It is at least the tangent.
            #[inline]
            fn secant(measure: &ScalarForce<T>) -> T;
            /// True if the law can act like a wall, with a force that begins at some value.
            fn may_push() -> bool;
            /// How many gaps it has; none where it acts always.
            fn n_gaps() -> usize;
            /// True if the damper of the law's contact fades in over a depth.
            fn has_fade() -> bool;
            /// Its gaps and their rates at a value and its rate.
            fn gaps(value: T, rate: T) -> [[T; 2]; 2];
            /// True if the law can have kinks besides those of its gaps.
            fn may_have_kinks() -> bool;
            /// Passes the kinks of the law to `take`, in any order.
            fn kinks(law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) -> ();
            /// Checks that every signal and table entry exists to which the law refers by number.
            fn fits(law_inputs: &LawInputs<'_, T>, n_courses: usize) -> bool;
            /// Upper bound of the operations of [`evaluate`](Self::evaluate).
            fn operations() -> Operations;
        } }

        /// Law on one body. If no Cargo feature adds such a law, the type has no values, and the compiler removes the code for
        /// them.
        #[derive(Debug, Clone, Copy, PartialEq)]
        #[non_exhaustive]
        pub enum BodyLaw<T> {
            /// Variant that no value can have.
            #[doc(hidden)]
            Never(NeverLaw<T>),
            $($(
                #[cfg $gate]
                #[doc = concat!("[`", stringify!($BodyLaw), "`](laws::", stringify!($BodyLaw), ").")]
                $Body(super::$module::$BodyLaw $(<$BS>)?),
            )?)*
        }

        $($(impl<T> From<super::$module::$BodyLaw $(<$BS>)?> for Option<BodyLaw<T>> {
            /// Converts the law; `None` if the Cargo feature of its effect is off.
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
            /// True if the law uses the body's direction and spin, or gives moments.
            fn needs_rotation() -> bool;
            /// Writes the actions for a motion into `out`, which is [`n_actions`](Self::n_actions) long.
            fn evaluate(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>, out: &mut [UnitWrench<T>]) -> ();
            /// Improves the slope of an action with the iterate `before`. In the first iterate of a step, `before` has no rate.
            #[inline]
            fn look_back(action: usize, measure: &mut ScalarForce<T>, before: &ScalarForce<T>) -> ();
            /// Slope of an action by its rate, for iterations that do not use the iterate before. It is at least the tangent.
            #[inline]
            fn secant(action: usize, measure: &ScalarForce<T>) -> T;
            /// Energy that an action stores [J].
            fn energy(action: usize, measure: &ScalarForce<T>) -> T;
            /// Power of an action that is not stored as energy [W].
            fn power(action: usize, measure: &ScalarForce<T>) -> T;
            /// How many gaps it has; none where it acts always.
            fn n_gaps() -> usize;
            /// True if the damper of the law's contact fades in over a depth.
            fn has_fade() -> bool;
            /// Its gap with the rate, then where it is over its road and how fast, along and up.
            fn watch(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> [[T; 2]; 3];
            /// What the road does to a tire; `None` of other laws.
            fn tire(motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> Option<TireForces<T>>;
            /// True if the law can have kinks besides those of its gaps.
            fn may_have_kinks() -> bool;
            /// Passes the kinks of the law to `take`, in any order.
            fn kinks(law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) -> ();
            /// How far from its place a kink may be passed [m].
            fn reach() -> T;
            /// Checks that every signal and table entry exists to which the law refers by number.
            fn fits(law_inputs: &LawInputs<'_, T>, n_courses: usize) -> bool;
            /// Upper bound of the operations of [`evaluate`](Self::evaluate).
            fn operations(law_inputs: &LawInputs<'_, T>) -> Operations;
        } }
    };
}

/// Converts the `cfg` gate of a law to its Cargo feature.
macro_rules! feature_of {
    (all()) => {
        None
    };
    (feature = $name:literal) => {
        Some($name)
    };
}

/// Implements the methods of an enum of laws, which call the law of the variant. In tables a law is a tag, followed by its numbers.
macro_rules! dispatch {
    ($Enum:ident $laws:tt $Trait:ident { $(
        $(#[$meta:meta])*
        fn $method:ident($($arg:ident: $Arg:ty),*) -> $Out:ty;
    )* }) => {
        /// Methods that call the law of the variant.
        impl<T: Real> $Enum<T> {
            $(table::method! {
                $laws $Trait law (law $(, $arg)*) $(#[$meta])* fn $method($($arg: $Arg),*) -> $Out
            })*
            table::tags! { $Enum $laws }
        }
    };
}

/// Implements one method of an enum of laws.
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

/// Implements reading and writing of an enum of laws, and the Cargo feature of each law.
macro_rules! tags {
    ($Enum:ident [$([$gate:tt $Variant:ident $tag:literal])*]) => {
        /// Reads a law from the numbers of a table.
        ///
        /// # Errors
        /// Errors of the reader, and an error for a law that the build does not contain.
        pub fn read<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
            match from.word()? {
                $(#[cfg $gate] $tag => Ok(Self::$Variant(Entry::of(from)?)),)*
                _ => Err(from.fault()),
            }
        }

        /// Writes the numbers of the law. Returns false if the law does not consist of numbers, as a user-defined law.
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

        /// Cargo feature that adds the law; `None`: every build has the law.
        #[must_use]
        pub fn feature(&self) -> Option<&'static str> {
            match self {
                $(#[cfg $gate] Self::$Variant(_) => table::feature_of! $gate,)*
            }
        }
    };
}

pub(super) use {dispatch, feature_of, kinds, laws, method, tags};
