//! The enum of kinds, what each kind says of itself, and the table of all.

use super::action::Compiler;
use super::{
    EffectData, EffectKind, EffectPicture, Field, Form, RoadWheel, RotorInertia, SignalForm,
    UnitHint, Value,
};
use crate::Real;
use crate::scene::place::Place;
use crate::scene::{
    BodyId, CouplingMeasure, Joint, JointId, SceneError, Signal, Surroundings, UserLaw,
};
use alloc::vec::Vec;

/// The key of springs that are slack below their free length.
pub(super) const PULLS_ONLY: &str = "pulls_only";

/// Model of a kind of effect: its checks, its actions and its properties.
pub(crate) trait EffectModel<T: Real>: EffectData<T> {
    /// Law and range, in one line of Markdown.
    const LAW: &'static str;
    /// A word, and a sentence, for a scene that has none; where that is worth one.
    const ABSENT: Option<[&'static str; 2]> = None;
    /// Does it act on one side only, with gaps that open and close?
    const IS_ONE_SIDED: bool = false;
    /// Names of its gaps, where it has more than one.
    const ENDS: &'static [&'static str] = &[];
    /// Does it stand on the scene's road?
    const NEEDS_ROAD: bool = false;
    /// May its law take different ways by its numbers? Then several states are not computed at once.
    const HAS_BRANCHES: bool = true;

    /// Returns the name of the effect in scene files.
    fn name(&self) -> &'static str {
        Self::NAMES.first().copied().unwrap_or_default()
    }

    /// Refuses what single fields do not show.
    ///
    /// # Errors
    /// [`SceneError`] with the key.
    fn check(&self, _among: Surroundings<'_, T>, _place: Place) -> Result<(), SceneError> {
        Ok(())
    }

    /// Adds the actions of the effect.
    fn actions(&self, to: &mut Compiler<'_, T>);

    /// Picture of the effect.
    fn drawn_as(&self) -> EffectPicture<T>;

    /// Numbers whose size may show that they were written in another unit; none where every size is likely.
    fn unit_hints(&self, joints: &[Joint<T>]) -> Vec<UnitHint<T>>;

    /// Inertia of the rotor that the effect is.
    fn rotor(&self) -> Option<RotorInertia<T>> {
        None
    }

    /// Wheel by which the effect touches the road.
    fn road_wheel(&self) -> Option<RoadWheel<T>> {
        None
    }

    /// Rate below which friction rises steeply from zero [rad/s or m/s]; `None`: none does.
    fn sticking(&self) -> Option<T> {
        None
    }

    /// Number at a key that was left out and follows from the mass that the effect's coordinate moves [kg or kg m^2].
    fn open(&self, _key: &str, _mass: f64) -> Option<f64> {
        None
    }

    /// Signal that the effect follows, the form of its components and their unit; `None`: it follows none.
    fn signal(&self) -> Option<(Signal<T>, SignalForm, &'static str)> {
        let entries = Self::FIELDS.iter().zip(self.values());
        entries.into_iter().find_map(|(field, value)| match (field.form, value) {
            (Form::Signal(form), Value::Signal(signal)) => Some((signal, form, field.unit)),
            _ => None,
        })
    }

    /// Can it store energy?
    fn stores_energy(&self) -> bool {
        false
    }

    /// Can it take energy out by a rate?
    fn dissipates(&self) -> bool {
        false
    }

    /// Does it follow time or an input?
    fn follows_time(&self) -> bool {
        let is_constant = |s: &Signal<T>| matches!(s, Signal::Constant(_));
        self.values().iter().any(|value| matches!(value, Value::Signal(s) if !is_constant(s)))
    }

    /// Takes out what only motion makes, and names parts that could act at rest or on small motions about it; false: nothing stays.
    fn rest(&mut self, _leave: &mut dyn FnMut(&'static str)) -> bool {
        true
    }
}

/// A kind of effect, without its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Name of the kind's module: that of the kind in small letters.
    pub module: &'static str,
    /// Names of the kind in scene files; none for a law in code.
    pub names: &'static [&'static str],
    /// Fields of the kind, in order.
    pub fields: &'static [Field],
    /// Law and range, in one line of Markdown.
    pub law: &'static str,
    /// The Cargo feature that brings its law, and whether it is on; `None`: every build has it.
    pub feature: Option<(&'static str, bool)>,
    /// A word and a sentence for a scene that has none.
    pub absent: Option<[&'static str; 2]>,
    /// Does it act on one side only?
    pub is_one_sided: bool,
    /// Names of its gaps.
    pub ends: &'static [&'static str],
    /// Does it stand on the scene's road?
    pub needs_road: bool,
    /// May its law take different ways by its numbers?
    pub has_branches: bool,
}

impl Row {
    /// The row of a kind.
    pub(super) const fn of<K: EffectModel<f64>>(
        module: &'static str,
        feature: Option<(&'static str, bool)>,
    ) -> Self {
        Self {
            module,
            names: K::NAMES,
            fields: K::FIELDS,
            law: K::LAW,
            feature,
            absent: K::ABSENT,
            is_one_sided: K::IS_ONE_SIDED,
            ends: K::ENDS,
            needs_road: K::NEEDS_ROAD,
            has_branches: K::HAS_BRANCHES,
        }
    }
}

impl<T: Clone> EffectKind<T> {
    /// The places on bodies where it acts, reference configuration [m], with their keys.
    #[must_use]
    pub fn places(&self) -> Vec<(&'static str, BodyId, [T; 3])> {
        let mut bodies = Vec::new();
        let mut places = Vec::new();
        for (field, value) in self.row().fields.iter().zip(self.values()) {
            match value {
                Value::Bodies(both) => bodies.extend(both),
                Value::Body(body) => bodies.push(body),
                Value::Points(points) => {
                    places.extend(bodies.iter().zip(points).map(|(b, x)| (field.key, *b, x)));
                }
                Value::Line(points) => {
                    places.extend(points.into_iter().map(|(b, x)| (field.key, b, x)));
                }
                Value::Point(x) => {
                    places.extend(bodies.iter().map(|b| (field.key, *b, x.clone())));
                }
                Value::Terms(terms) => {
                    for term in terms {
                        let CouplingMeasure::Length { points } = term.of else { continue };
                        places.extend(points.into_iter().map(|(b, x)| (field.key, b, x)));
                    }
                }
                _ => {}
            }
        }
        places
    }
}

/// Part of a mechanism that an effect acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// A line over two points or more, by one number.
    Line,
    /// A joint, by one number.
    Joint(JointId),
    /// A sum of joint coordinates and lengths, by one number.
    Sum,
    /// One body or two, by several numbers.
    Bodies,
}

impl<T: Clone> EffectKind<T> {
    /// Is it slack on one side: is `pulls_only` set?
    fn pulls_only(&self) -> bool {
        let is_set = |(field, value): (&Field, Value<T>)| {
            field.key == PULLS_ONLY && matches!(value, Value::Flag(true))
        };
        self.row().fields.iter().zip(self.values()).any(is_set)
    }

    /// Number of the joint coordinate that the effect names; `None`: it names none.
    #[must_use]
    pub fn coordinate(&self) -> Option<usize> {
        self.values().into_iter().find_map(|value| match value {
            Value::Coordinate(number) => number,
            _ => None,
        })
    }

    /// Does it act on one side only?
    #[must_use]
    pub fn is_one_sided(&self) -> bool {
        self.row().is_one_sided || self.pulls_only()
    }

    /// May its law take different ways by its numbers? Then several states are not computed at once.
    #[must_use]
    pub fn has_branches(&self) -> bool {
        self.row().has_branches || self.pulls_only()
    }

    /// Returns the part of the mechanism that the effect acts on.
    #[must_use]
    pub fn acts_on(&self) -> ActsOn {
        if let Self::Own(own) = self {
            return match own.law {
                UserLaw::Length { .. } => ActsOn::Line,
                UserLaw::Joint { joint, .. } => ActsOn::Joint(joint),
                UserLaw::Body { .. } => ActsOn::Bodies,
            };
        }
        let values = self.values();
        let on = values.iter().find_map(|value| match value {
            Value::Points(_) | Value::Line(_) => Some(ActsOn::Line),
            Value::Joint(joint) => Some(ActsOn::Joint(*joint)),
            Value::Terms(_) => Some(ActsOn::Sum),
            _ => None,
        });
        on.unwrap_or(ActsOn::Bodies)
    }
}

/// Makes the enum of kinds.
macro_rules! kinds {
    ($($Kind:ident $module:ident $gate:tt),*) => {
        /// The kinds of effect.
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        pub enum EffectKind<T> {
            $(
                #[doc = concat!("[`", stringify!($Kind), "`].")]
                $Kind($Kind<T>),
            )*
        }

        $(impl<T> From<$Kind<T>> for EffectKind<T> {
            fn from(kind: $Kind<T>) -> Self {
                Self::$Kind(kind)
            }
        })*

        /// Every kind of effect, in the order of the format.
        pub const EFFECTS: &[Row] = &[$(Row::of::<$Kind<f64>>(stringify!($module), kind::feature_of! $gate)),*];

        impl<T> EffectKind<T> {
            /// Returns the row of the effect's kind.
            #[must_use]
            pub const fn row(&self) -> &'static Row {
                match self {
                    $(Self::$Kind(_) => const { &Row::of::<$Kind<f64>>(stringify!($module), kind::feature_of! $gate) },)*
                }
            }

            /// The effect of the kind `EFFECTS[row]` with these values; `None` if they are not those of its fields.
            pub fn of(row: usize, values: impl IntoIterator<Item = Value<T>>) -> Option<Self> {
                type Make<T> = fn(&mut dyn Iterator<Item = Value<T>>) -> Option<EffectKind<T>>;
                let make: [Make<T>; EFFECTS.len()] =
                    [$(|values| $Kind::of(values).map(Self::$Kind)),*];
                make.get(row)?(&mut values.into_iter())
            }

            /// Returns an effect of the same kind with other values; `None` if they are not those of its fields.
            pub fn with<U>(&self, values: impl IntoIterator<Item = Value<U>>) -> Option<EffectKind<U>> {
                let values = &mut values.into_iter();
                match self {
                    $(Self::$Kind(_) => $Kind::of(values).map(EffectKind::$Kind),)*
                }
            }

            /// The values of its fields, in their order; a user's own law has none.
            pub fn values(&self) -> Vec<Value<T>>
            where
                T: Clone,
            {
                match self {
                    $(Self::$Kind(kind) => kind.values(),)*
                }
            }

            /// Returns the effect with every number as `f` gives it; `None` for a user's own law, which is code for one scalar type.
            pub fn map<U>(self, f: &mut impl FnMut(T) -> U) -> Option<EffectKind<U>>
            where
                T: Clone,
            {
                self.with(self.values().into_iter().map(|value| value.map(f)))
            }
        }

        impl<T: Real> EffectKind<T> {
            /// Returns the name of the effect in scene files; `own` for a law in code.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$Kind(kind) => kind.name(),)*
                }
            }

            pub(crate) fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
                match self {
                    $(Self::$Kind(kind) => kind.check(among, place),)*
                }
            }

            pub(crate) fn actions(&self, to: &mut Compiler<'_, T>) {
                match self {
                    $(Self::$Kind(kind) => kind.actions(to),)*
                }
            }

            /// Picture of the effect.
            #[must_use]
            pub fn drawn_as(&self) -> EffectPicture<T> {
                match self {
                    $(Self::$Kind(kind) => kind.drawn_as(),)*
                }
            }

            /// Numbers whose size may show that they were written in another unit, among the joints of the scene.
            #[must_use]
            pub fn unit_hints(&self, joints: &[Joint<T>]) -> Vec<UnitHint<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.unit_hints(joints),)*
                }
            }

            /// Inertia of the rotor that the effect is; `None`: it is none.
            #[must_use]
            pub fn rotor(&self) -> Option<RotorInertia<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.rotor(),)*
                }
            }

            /// Wheel by which the effect touches the road; `None`: it does not.
            #[must_use]
            pub fn road_wheel(&self) -> Option<RoadWheel<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.road_wheel(),)*
                }
            }

            /// Rate below which friction rises steeply from zero [rad/s or m/s]; `None`: none does.
            #[must_use]
            pub fn sticking(&self) -> Option<T> {
                match self {
                    $(Self::$Kind(kind) => kind.sticking(),)*
                }
            }

            /// Number at a key that was left out and follows from the mass that the effect's coordinate moves [kg or kg m^2]; `None` at
            /// other keys.
            #[must_use]
            pub fn open(&self, key: &str, mass: f64) -> Option<f64> {
                match self {
                    $(Self::$Kind(kind) => kind.open(key, mass),)*
                }
            }

            /// Signal that the effect follows, the form of its components and their unit; `None`: it follows none.
            #[must_use]
            pub fn signal(&self) -> Option<(Signal<T>, SignalForm, &'static str)> {
                match self {
                    $(Self::$Kind(kind) => kind.signal(),)*
                }
            }

            /// Can it store energy?
            #[must_use]
            pub fn stores_energy(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.stores_energy(),)*
                }
            }

            /// Can it take energy out by a rate?
            #[must_use]
            pub fn dissipates(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.dissipates(),)*
                }
            }

            /// Does it follow time or an input?
            #[must_use]
            pub fn follows_time(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.follows_time(),)*
                }
            }

            /// Takes out what only motion makes, and names parts that could act at rest or on small motions about it; false: nothing stays.
            pub fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.rest(leave),)*
                }
            }
        }
    };
}

/// The Cargo feature of a gate, and whether it is on.
macro_rules! feature_of {
    (all()) => {
        None
    };
    (feature = $name:literal) => {
        Some(($name, cfg!(feature = $name)))
    };
}

pub(super) use {feature_of, kinds};
