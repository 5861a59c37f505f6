//! Outputs by what they measure, and the components of a quantity.

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
    /// Its components in a scene: those of its quantity, then the magnitudes that it has columns for; in its units.
    ///
    /// # Panics
    /// As [`Quantity::components`].
    #[must_use]
    pub fn components(&self, scene: &Scene<T>) -> Vec<Component> {
        let mut components = self.measured(scene);
        for place in self.places_in_degrees(scene) {
            let unit = &mut components[place].unit;
            *unit = in_degrees(unit).unwrap_or_default().into();
        }
        components
    }

    /// The places of its components that it converts to degrees.
    pub(crate) fn places_in_degrees(&self, scene: &Scene<T>) -> Vec<usize> {
        if !self.is_in_degrees {
            return Vec::new();
        }
        let components = self.measured(scene);
        let is_angle = |place: &usize| in_degrees(&components[*place].unit).is_some();
        (0..components.len()).filter(is_angle).collect()
    }

    /// Its components in the units in which they are measured.
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
    /// The body in whose axes its vectors are by themselves: seen from another body that one, else the ground, for global axes.
    #[must_use]
    pub fn axes(&self) -> BodyId {
        match self.target() {
            Target::RelativePoint(RelativePoint { relative_to, .. })
            | Target::RelativeBody(_, relative_to) => relative_to,
            _ => BodyId::Ground,
        }
    }

    /// The body and the point whose way pictures draw, reference configuration [m]; `None`: they draw none.
    #[must_use]
    pub fn traced(&self) -> Option<(BodyId, [T; 3])> {
        match self.target() {
            Target::Point(body, at) => {
                (self.row().picture == OutputPicture::Trace).then_some((body, at))
            }
            _ => None,
        }
    }

    /// Its components in a scene.
    ///
    /// # Panics
    /// If it is of a joint, a coupling or an effect that is not there; [`Scene::check`] refuses those.
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
                // a tire alone stands on the road
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

/// The unit of a joint's coordinate.
fn unit_of_coordinate<T>(scene: &Scene<T>, joint: JointId, number: usize) -> &'static str {
    let joint = scene.joints.get(joint.index());
    let freedom = joint.and_then(|joint| joint.kind.freedom(scene.dimension, number));
    freedom.map_or("rad", Freedom::unit)
}

/// The unit of what a coupling holds; or of what its effort does work on.
fn unit_of_coupling<T>(scene: &Scene<T>, coupling: CouplingId, is_effort: bool) -> &'static str {
    let of = &scene.couplings[coupling.index()];
    match of.drawn.map(|drawn| drawn.kind) {
        // what a relation makes of its measures is its own
        _ if of.relation.is_some() => "-",
        Some(DrawnKind::Belt { .. } | DrawnKind::Rack | DrawnKind::Screw) => "m",
        Some(DrawnKind::Gear { has_radii: true, .. }) if !is_effort => "m",
        Some(DrawnKind::Gear { .. } | DrawnKind::Differential) => "rad",
        Some(DrawnKind::Ratio) | None => unit_of_sum(scene, &of.terms),
    }
}

/// The unit of a sum: that of its slides and lengths, whose factors are numbers, else that of its angles.
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

/// The unit of a signal: that of the number that it measures, and of an input, also late or within limits; `-` of what is made of
/// others.
fn unit_of_signal<T>(scene: &Scene<T>, mut signal: SignalId) -> &str {
    // No walk without a circle is longer.
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

/// The unit of what an effect is from its free value, or of how deep it is in contact; `None` of one that has neither.
fn unit_of_deflection<T: Clone>(scene: &Scene<T>, effect: EffectId) -> Option<&'static str> {
    let kind = &scene.effects[effect.index()].kind;
    let has_one = has_free_value(kind) || kind.is_one_sided();
    // a tire is in contact by a length
    has_one.then(|| unit_of_measure(scene, effect).unwrap_or("m"))
}

/// The unit of the one number that an effect measures; `None` where it measures several.
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
