//! Constructors of outputs by quantity, and the components of a quantity.

use super::OutputPicture;
use super::components::{Component, ComponentForm, Magnitude, in_degrees, magnitudes};
use super::effect_deflection::has_free_value;
use super::table;
use crate::effects::{ActsOn, Value};
use crate::joint::Freedom;
use crate::mechanism::{Output, Scene};
use crate::scene::quantity::list;
use crate::scene::{
    BodyId, CouplingId, CouplingMeasure, CouplingTerm, DrawnKind, EffectId, JointId, Number,
    Quantity, RelativePoint, RollingId, SignalId, SignalKind, Target, Vector3, WheelCarrier,
};
use alloc::vec::Vec;

list::list!(table::constructors);

impl<T: Clone> Output<T> {
    /// Components in a scene, in the units of the output. The components of its quantity come first, then the magnitudes of its vectors if
    /// they are required.
    ///
    /// # Panics
    /// If [`Quantity::components`] panics.
    #[must_use]
    pub fn components(&self, scene: &Scene<T>) -> Vec<Component> {
        let mut components = self.measured(scene);
        for place in self.places_in_degrees(scene) {
            let unit = &mut components[place].unit;
            *unit = in_degrees(unit).unwrap_or_default().into();
        }
        components
    }

    /// Indices of the components that the output converts to degrees.
    pub(crate) fn places_in_degrees(&self, scene: &Scene<T>) -> Vec<usize> {
        if !self.is_in_degrees {
            return Vec::new();
        }
        let components = self.measured(scene);
        let is_angle = |place: &usize| in_degrees(&components[*place].unit).is_some();
        (0..components.len()).filter(is_angle).collect()
    }

    /// Components in the units of the quantity, before any conversion.
    fn measured(&self, scene: &Scene<T>) -> Vec<Component> {
        let mut components = self.quantity.components(scene);
        if self.magnitude {
            let of = |x: Magnitude| Component { label: x.label.into(), unit: x.unit };
            let more: Vec<_> = magnitudes(&components).into_iter().map(of).collect();
            components.extend(more);
        }
        components
    }
}

impl<T: Clone> Quantity<T> {
    /// Body in whose axes the vectors of the quantity are by default. It is the other body for relative quantities, and otherwise the
    /// ground, for global axes.
    #[must_use]
    pub fn axes(&self) -> BodyId {
        match self.target() {
            Target::RelativePoint(RelativePoint { relative_to, .. })
            | Target::RelativeBody(_, relative_to) => relative_to,
            _ => BodyId::Ground,
        }
    }

    /// Body, and point [m] of the body in the reference configuration, whose path pictures show. `None`: pictures show no path.
    #[must_use]
    pub fn traced(&self) -> Option<(BodyId, [T; 3])> {
        match self.target() {
            Target::Point(body, at) => {
                (self.row().picture == OutputPicture::Trace).then_some((body, at))
            }
            _ => None,
        }
    }

    /// Components of the quantity in a scene.
    ///
    /// # Panics
    /// If its joint, coupling or effect does not exist; [`Scene::check`] refuses that.
    #[must_use]
    pub fn components(&self, scene: &Scene<T>) -> Vec<Component> {
        let form = self.row().components;
        let (freedoms, measured) = match self.target() {
            Target::Joint(joint) => {
                let freedoms = scene.joints[joint.index()].kind.freedoms(scene.dimension);
                if freedoms.is_empty() && matches!(form, ComponentForm::Number(_)) {
                    return Vec::new();
                }
                (freedoms, None)
            }
            Target::Coupling(coupling) if form == ComponentForm::Length => {
                (&[][..], scene.couplings[coupling.index()].line().map(|_| "m"))
            }
            Target::Coupling(coupling) => {
                (&[][..], Some(unit_of_coupling(scene, coupling, form == ComponentForm::Force)))
            }
            Target::Effect(effect) if form == ComponentForm::Contact => {
                if !scene.effects[effect.index()].kind.is_one_sided() {
                    return Vec::new();
                }
                (&[][..], None)
            }
            Target::Effect(effect) if form.is_of_tire() => {
                // only a tire is in contact with the road
                if !scene.effects[effect.index()].kind.row().needs_road {
                    return Vec::new();
                }
                (&[][..], None)
            }
            Target::Effect(effect) if form == ComponentForm::Deflection => {
                (&[][..], unit_of_deflection(scene, effect))
            }
            Target::Effect(effect) => (&[][..], unit_of_measure(scene, effect)),
            Target::Signal(signal) => (&[][..], Some(unit_of_signal(scene, signal))),
            Target::Point(..)
            | Target::RelativePoint(_)
            | Target::Body(_)
            | Target::Rolling(_)
            | Target::RelativeBody(..)
            | Target::WheelCarrier(_)
            | Target::Scene => (&[][..], None),
        };
        form.of(scene.dimension, freedoms, measured)
    }
}

/// Unit of a joint's coordinate.
fn unit_of_coordinate<T>(scene: &Scene<T>, joint: JointId, number: usize) -> &'static str {
    let joint = scene.joints.get(joint.index());
    let freedom = joint.and_then(|joint| joint.kind.freedom(scene.dimension, number));
    freedom.map_or("rad", Freedom::unit)
}

/// Unit of the sum of a coupling. If `is_effort`, it is the unit of the measure on which the coupling's effort does work.
fn unit_of_coupling<T>(scene: &Scene<T>, coupling: CouplingId, is_effort: bool) -> &'static str {
    let of = &scene.couplings[coupling.index()];
    match of.drawn.map(|drawn| drawn.kind) {
        // the unit of a user-defined relation is unknown
        _ if of.relation.is_some() => "-",
        Some(DrawnKind::Belt { .. } | DrawnKind::Rack | DrawnKind::Screw) => "m",
        Some(DrawnKind::Gear { has_radii: true, .. }) if !is_effort => "m",
        Some(DrawnKind::Gear { .. } | DrawnKind::Differential) => "rad",
        Some(DrawnKind::Ratio) | None => unit_of_sum(scene, &of.terms),
    }
}

/// Unit of a sum. It is the metre if a term is a slide or a length: factors of such terms have no unit. Otherwise it is the radian.
fn unit_of_sum<T>(scene: &Scene<T>, terms: &[CouplingTerm<T>]) -> &'static str {
    let mut units = terms.iter().map(|term| unit_of_number(scene, &term.of));
    units.find(|unit| *unit == "m").unwrap_or("rad")
}

fn unit_of_number<T>(scene: &Scene<T>, of: &CouplingMeasure<T>) -> &'static str {
    match of {
        CouplingMeasure::Coordinate { joint, number } => unit_of_coordinate(scene, *joint, *number),
        CouplingMeasure::Length { .. } => "m",
        CouplingMeasure::Ball { .. } => "rad",
    }
}

/// Unit of a signal. A measured number and an input have a unit. A lag or limit has the unit of its argument. Other signals have `-`.
fn unit_of_signal<T>(scene: &Scene<T>, mut signal: SignalId) -> &str {
    // A chain of signals without a cycle is at most as long as the list of signals.
    for _ in &scene.signals {
        match scene.signals.get(signal.index()).map(|signal| &signal.kind) {
            Some(SignalKind::Measure { of, is_rate }) => {
                return match (unit_of_number(scene, of), is_rate) {
                    ("m", true) => "m/s",
                    (_, true) => "rad/s",
                    (unit, false) => unit,
                };
            }
            Some(SignalKind::Input { unit, .. }) if !unit.is_empty() => return unit,
            Some(SignalKind::Lag { of, .. } | SignalKind::Clamp { of, .. }) => signal = *of,
            _ => break,
        }
    }
    "-"
}

/// Unit of the deflection or contact depth of an effect; `None` for an effect that has neither.
fn unit_of_deflection<T: Clone>(scene: &Scene<T>, effect: EffectId) -> Option<&'static str> {
    let kind = &scene.effects[effect.index()].kind;
    let has_one = has_free_value(kind) || kind.is_one_sided();
    // the contact depth of a tire is a length
    has_one.then(|| unit_of_measure(scene, effect).unwrap_or("m"))
}

/// Unit of the number that an effect measures; `None` if it measures several.
fn unit_of_measure<T: Clone>(scene: &Scene<T>, effect: EffectId) -> Option<&'static str> {
    let kind = &scene.effects[effect.index()].kind;
    match kind.acts_on() {
        ActsOn::Line => Some("m"),
        ActsOn::Joint(joint) => {
            let of = scene.joints.get(joint.index())?.kind;
            let number = of.coordinate_or_default(kind.coordinate(), scene.dimension);
            Some(number.map_or("rad", |number| unit_of_coordinate(scene, joint, number)))
        }
        ActsOn::Sum => kind.values().iter().find_map(|value| match value {
            Value::Terms(terms) => Some(unit_of_sum(scene, terms)),
            _ => None,
        }),
        ActsOn::Bodies => None,
    }
}
