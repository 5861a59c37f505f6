//! Enum of the kinds of effect, the properties that each kind declares, and the table of all kinds.

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

/// Key in scene files of springs that are slack below their free length.
pub(super) const PULLS_ONLY: &str = "pulls_only";

/// Model of a kind of effect: its checks, its actions and its properties.
pub(crate) trait EffectModel<T: Real>: EffectData<T> {
    /// Law and range, in one line of Markdown.
    const LAW: &'static str;
    /// Short name and sentence with which a user is informed that a scene has no effect of this kind; `None`: no such information.
    const ABSENT: Option<[&'static str; 2]> = None;
    /// True if the effect acts on one side only, with gaps that open and close.
    const IS_ONE_SIDED: bool = false;
    /// Names of the effect's gaps, if it has more than one.
    const ENDS: &'static [&'static str] = &[];
    /// True if the effect needs the road of the scene.
    const NEEDS_ROAD: bool = false;
    /// True if numbers decide which branch of the law is computed. Several states are then not computed at once.
    const HAS_BRANCHES: bool = true;

    /// Returns the name of the effect in scene files.
    fn name(&self) -> &'static str {
        Self::NAMES.first().copied().unwrap_or_default()
    }

    /// Checks conditions that involve several fields or other entries of the scene.
    ///
    /// # Errors
    /// [`SceneError`] with the key that has the fault.
    fn check(&self, _among: Surroundings<'_, T>, _place: Place) -> Result<(), SceneError> {
        Ok(())
    }

    /// Adds the actions of the effect.
    fn actions(&self, to: &mut Compiler<'_, T>);

    /// Returns the picture that represents the effect in drawings.
    fn drawn_as(&self) -> EffectPicture<T>;

    /// Returns the numbers whose size may show that they were written in another unit. Empty if every size is plausible.
    fn unit_hints(&self, joints: &[Joint<T>]) -> Vec<UnitHint<T>>;

    /// Inertia that the effect adds to a joint coordinate, if it is a rotor; else `None`.
    fn rotor(&self) -> Option<RotorInertia<T>> {
        None
    }

    /// Wheel of the effect that touches the road; `None` if it has no wheel.
    fn road_wheel(&self) -> Option<RoadWheel<T>> {
        None
    }

    /// Rate below which friction rises steeply from zero [rad/s or m/s]; `None` if no friction does.
    fn sticking(&self) -> Option<T> {
        None
    }

    /// Value of a key that was left out, computed from the mass that the effect's coordinate moves [kg or kg m^2]. `None` for other
    /// keys.
    fn open(&self, _key: &str, _mass: f64) -> Option<f64> {
        None
    }

    /// Signal that the effect follows, with the form of its components and their unit; `None` if the effect follows no signal.
    fn signal(&self) -> Option<(Signal<T>, SignalForm, &'static str)> {
        let entries = Self::FIELDS.iter().zip(self.values());
        entries.into_iter().find_map(|(field, value)| match (field.form, value) {
            (Form::Signal(form), Value::Signal(signal)) => Some((signal, form, field.unit)),
            _ => None,
        })
    }

    /// True if the effect can store energy.
    fn stores_energy(&self) -> bool {
        false
    }

    /// True if the effect can dissipate energy, as a damper does.
    fn dissipates(&self) -> bool {
        false
    }

    /// True if the effect depends on time or on an input.
    fn follows_time(&self) -> bool {
        let is_constant = |s: &Signal<T>| matches!(s, Signal::Constant(_));
        self.values().iter().any(|value| matches!(value, Value::Signal(s) if !is_constant(s)))
    }

    /// Removes the parts of the effect that act only in larger motions. Calls `_leave` with the name of each removed part that
    /// could act at rest or on small motions about it. Returns false if no part remains.
    fn rest(&mut self, _leave: &mut dyn FnMut(&'static str)) -> bool {
        true
    }
}

/// A kind of effect, without its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Name of the kind's module: the name of the kind in small letters.
    pub module: &'static str,
    /// Names of the kind in scene files; empty for a law in code.
    pub names: &'static [&'static str],
    /// Fields of the kind, in order.
    pub fields: &'static [Field],
    /// Law and range, in one line of Markdown.
    pub law: &'static str,
    /// Cargo feature that adds the law, and true if the feature is on. `None`: every build has the law.
    pub feature: Option<(&'static str, bool)>,
    /// Short name and sentence with which a user is informed that a scene has no effect of this kind; `None`: no such information.
    pub absent: Option<[&'static str; 2]>,
    /// True if the effect acts on one side only.
    pub is_one_sided: bool,
    /// Names of the effect's gaps, if it has more than one.
    pub ends: &'static [&'static str],
    /// True if the effect needs the road of the scene.
    pub needs_road: bool,
    /// True if numbers decide which branch of the law is computed.
    pub has_branches: bool,
}

impl Row {
    /// Returns the table row of a kind.
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
    /// Returns the places on bodies where the effect acts, in the reference configuration [m]. Each has its key and its body.
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
    /// Line over two or more points. One number measures it.
    Line,
    /// Joint of which one number is measured.
    Joint(JointId),
    /// Sum of joint coordinates and lengths, which is one number.
    Sum,
    /// One or two bodies. Several numbers measure their motion.
    Bodies,
}

impl<T: Clone> EffectKind<T> {
    /// True if the effect is slack on one side, because `pulls_only` is set.
    fn pulls_only(&self) -> bool {
        let is_set = |(field, value): (&Field, Value<T>)| {
            field.key == PULLS_ONLY && matches!(value, Value::Flag(true))
        };
        self.row().fields.iter().zip(self.values()).any(is_set)
    }

    /// Number of the joint coordinate that the effect names; `None` if it names no coordinate.
    #[must_use]
    pub fn coordinate(&self) -> Option<usize> {
        self.values().into_iter().find_map(|value| match value {
            Value::Coordinate(number) => number,
            _ => None,
        })
    }

    /// True if the effect acts on one side only.
    #[must_use]
    pub fn is_one_sided(&self) -> bool {
        self.row().is_one_sided || self.pulls_only()
    }

    /// True if numbers decide which branch of the law is computed. Several states are then not computed at once.
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

/// Generates the enum of the kinds of effect, and its methods.
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

        /// Rows of all kinds of effect, in the order of the scene format.
        pub const EFFECTS: &[Row] = &[$(Row::of::<$Kind<f64>>(stringify!($module), kind::feature_of! $gate)),*];

        impl<T> EffectKind<T> {
            /// Returns the row of the effect's kind.
            #[must_use]
            pub const fn row(&self) -> &'static Row {
                match self {
                    $(Self::$Kind(_) => const { &Row::of::<$Kind<f64>>(stringify!($module), kind::feature_of! $gate) },)*
                }
            }

            /// Returns the effect of the kind `EFFECTS[row]` with these values; `None` if the values do not fit its fields.
            pub fn of(row: usize, values: impl IntoIterator<Item = Value<T>>) -> Option<Self> {
                type Make<T> = fn(&mut dyn Iterator<Item = Value<T>>) -> Option<EffectKind<T>>;
                let make: [Make<T>; EFFECTS.len()] =
                    [$(|values| $Kind::of(values).map(Self::$Kind)),*];
                make.get(row)?(&mut values.into_iter())
            }

            /// Returns an effect of the same kind with other values; `None` if the values do not fit its fields.
            pub fn with<U>(&self, values: impl IntoIterator<Item = Value<U>>) -> Option<EffectKind<U>> {
                let values = &mut values.into_iter();
                match self {
                    $(Self::$Kind(_) => $Kind::of(values).map(EffectKind::$Kind),)*
                }
            }

            /// Returns the values of the effect's fields, in their order. A user-defined law has no values.
            pub fn values(&self) -> Vec<Value<T>>
            where
                T: Clone,
            {
                match self {
                    $(Self::$Kind(kind) => kind.values(),)*
                }
            }

            /// Returns the effect with every number converted by `f`; `None` for a user-defined law, which is code for one scalar
            /// type.
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

            /// Returns the picture that represents the effect in drawings.
            #[must_use]
            pub fn drawn_as(&self) -> EffectPicture<T> {
                match self {
                    $(Self::$Kind(kind) => kind.drawn_as(),)*
                }
            }

            /// Returns the numbers whose size may show that they were written in another unit. `joints` are the joints of the
            /// scene.
            #[must_use]
            pub fn unit_hints(&self, joints: &[Joint<T>]) -> Vec<UnitHint<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.unit_hints(joints),)*
                }
            }

            /// Inertia that the effect adds to a joint coordinate, if it is a rotor; else `None`.
            #[must_use]
            pub fn rotor(&self) -> Option<RotorInertia<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.rotor(),)*
                }
            }

            /// Wheel of the effect that touches the road; `None` if it has no wheel.
            #[must_use]
            pub fn road_wheel(&self) -> Option<RoadWheel<T>> {
                match self {
                    $(Self::$Kind(kind) => kind.road_wheel(),)*
                }
            }

            /// Rate below which friction rises steeply from zero [rad/s or m/s]; `None` if no friction does.
            #[must_use]
            pub fn sticking(&self) -> Option<T> {
                match self {
                    $(Self::$Kind(kind) => kind.sticking(),)*
                }
            }

            /// Value of a key that was left out, computed from the mass that the effect's coordinate moves [kg or kg m^2]. `None`
            /// for other keys.
            #[must_use]
            pub fn open(&self, key: &str, mass: f64) -> Option<f64> {
                match self {
                    $(Self::$Kind(kind) => kind.open(key, mass),)*
                }
            }

            /// Signal that the effect follows, with the form of its components and their unit; `None` if the effect follows no
            /// signal.
            #[must_use]
            pub fn signal(&self) -> Option<(Signal<T>, SignalForm, &'static str)> {
                match self {
                    $(Self::$Kind(kind) => kind.signal(),)*
                }
            }

            /// True if the effect can store energy.
            #[must_use]
            pub fn stores_energy(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.stores_energy(),)*
                }
            }

            /// True if the effect can dissipate energy, as a damper does.
            #[must_use]
            pub fn dissipates(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.dissipates(),)*
                }
            }

            /// True if the effect depends on time or on an input.
            #[must_use]
            pub fn follows_time(&self) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.follows_time(),)*
                }
            }

            /// Removes the parts of the effect that act only in larger motions. Calls `leave` with the name of each removed part
            /// that could act at rest or on small motions about it. Returns false if no part remains.
            pub fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
                match self {
                    $(Self::$Kind(kind) => kind.rest(leave),)*
                }
            }
        }
    };
}

/// Converts the `cfg` gate of a kind to its Cargo feature, with true if the feature is on.
macro_rules! feature_of {
    (all()) => {
        None
    };
    (feature = $name:literal) => {
        Some(($name, cfg!(feature = $name)))
    };
}

pub(super) use {feature_of, kinds};
