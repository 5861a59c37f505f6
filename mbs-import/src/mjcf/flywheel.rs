//! Inertia on a sum of coordinates: armature of tendons, and of the actuators that act on them.

use super::model::{Model, Sort};
use crate::inertia::Mass;
use crate::pose::{M3, V3, unit};
use crate::robot::{Coordinate, Coupling, GROUND, Joint, Kind, Link, Target, Term, What};
use crate::source::Origin;

/// Adds ½ a ṁ² to the kinetic energy, where m is a sum of coordinates. For one coordinate it is a rotor. Otherwise a body with that inertia
/// rotates by m about its centre.
pub(super) fn add(name: &str, terms: &[Term], inertia: f64, model: &mut Model<'_, '_, '_>) {
    if let [only] = terms
        && only.line.is_empty()
    {
        let on = Target::Coordinate(only.of.clone());
        let inertia = inertia * only.factor * only.factor;
        model.law(name, What::Rotor { on, inertia });
        return;
    }
    let wheel = model.free_name(Sort::Link, name);
    let link = model.robot.links.len();
    let at = Origin::start_of(0);
    // The body's mass rests at the origin. It has the same number as its moment, so that magnitudes are similar.
    let mass = Mass { mass: inertia, center: V3::zeros(), tensor: M3::identity() * inertia };
    model.robot.links.push(Link { mass: Some(mass), ..Link::new(&wheel, at) });
    let note =
        format!("Body {wheel}: it turns as the length changes, for its armature. It is no part.");
    model.robot.notes.push(note);
    let joint = model.robot.joints.len();
    let turn = model.free_name(Sort::Joint, name);
    let mut hinge = Joint::new(&turn, at, Kind::Revolute, [GROUND, link], V3::zeros());
    hinge.axes = vec![unit(2)];
    model.robot.joints.push(hinge);
    let of = Coordinate { joint, number: None };
    let mut sum = vec![Term::new(of, -1.0)];
    sum.extend(terms.iter().cloned());
    let coupling = model.free_name(Sort::Law, &format!("{name} turn"));
    model.robot.couplings.push(Coupling { name: coupling, terms: sum, value: 0.0 });
}
