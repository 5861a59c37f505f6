//! Inertias of the bodies, by the settings of the whole model.

use super::model::{Model, Moves, Sort};
use crate::element::Attribute;
use crate::inertia::{Mass, SLACK};
use crate::pose::{M3, Pose};
use crate::robot::{GROUND, Joint, Kind, Link};
use crate::source::{Fault, Read};

/// Rounding of the moments of a tensor, relative to the largest.
const ROUNDING: f64 = 1.0e-14;

/// Refuses moments below zero, which no setting mends.
pub(super) fn check_written(word: &Attribute, tensor: &M3) -> Read<()> {
    let moments = tensor.symmetric_eigen().eigenvalues;
    if moments.min() >= -ROUNDING * moments.amax() {
        return Ok(());
    }
    let message =
        format!("the inertia has principal moments {}, one of them below zero", listed(tensor));
    Err(word.fault(
        message,
        "write the inertia of the part: all of its principal moments are above zero",
    ))
}

/// Principal moments of a tensor, rising.
fn listed(tensor: &M3) -> String {
    let mut moments: Vec<f64> = tensor.symmetric_eigen().eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    format!("{moments:?}")
}

/// Bounds, balances and scales the masses of all bodies, and gives them to the links.
pub(super) fn settle(model: &mut Model<'_, '_, '_>) -> Read<()> {
    let mut masses = std::mem::take(&mut model.masses);
    let carriers = model.robot.carriers(|joint| joint.kind == Kind::Fixed);
    for (link, mass, _) in &mut masses {
        let written = mass.tensor;
        bound(mass, model.compiler.bound_mass, model.compiler.bound_inertia);
        let is_mended = model.compiler.balance || model.context.options.balance;
        let is_raised = mass.tensor != written && carriers[*link] != GROUND;
        if is_raised && !is_mended && !is_possible(mass) {
            let link = &model.robot.links[*link];
            let message = format!(
                "body `{}` has principal moments {}, which `boundinertia` raises to {}, and no body has those",
                link.name,
                listed(&written),
                listed(&mass.tensor)
            );
            let hint = "write the inertia of the part, or balanceinertia=\"true\" in <compiler>";
            return Err(Fault::new(link.at, message, hint));
        }
        if model.compiler.balance && balance(mass) {
            let link = &model.robot.links[*link];
            let says =
                "moments that no body has: all three are their mean, as `balanceinertia` asks";
            model.context.findings.approximated(link.at, format!("body[{}]", link.name), says);
        }
    }
    if let Some(total) = model.compiler.total_mass {
        let sum: f64 = masses.iter().map(|(_, mass, _)| mass.mass).sum();
        let share = total / sum;
        if share.is_finite() {
            for (_, mass, _) in &mut masses {
                mass.mass *= share;
                mass.tensor *= share;
            }
        }
    }
    for (link, mass, lift) in masses {
        if !mass.is_nothing() {
            model.robot.links[link].mass = Some(mass);
        }
        model.robot.links[link].gravity_scale = 1.0 - lift;
    }
    Ok(())
}

/// Armature of a free joint, or of a ball on the ground, is an inertia of its body: E = ½ a |v|² + ½ a |ω|², with v of the joint's place, is
/// that of a mass a there, without weight, and of a moment a about all axes. Between moving bodies it has no counterpart.
pub(super) fn armatures(model: &mut Model<'_, '_, '_>) {
    let carriers = model.robot.carriers(|joint| joint.kind == Kind::Fixed);
    for number in 0..model.motions.len() {
        let motion = model.motions[number].clone();
        let joint = &model.robot.joints[motion.joint];
        let (link, place, armature) = (joint.child, joint.place, motion.armature);
        // the three slides of a free joint have the same
        let [mass, moment] = match (joint.kind, motion.moves) {
            (Kind::Free, Moves::Free) => [armature, armature],
            (Kind::Free, Moves::Slide) if motion.number == Some(0) => [armature, 0.0],
            (_, Moves::Ball) => [0.0, armature],
            _ => continue,
        };
        if armature == 0.0 {
            continue;
        }
        let own = model.robot.links[link].mass.unwrap_or_else(Mass::none);
        if carriers[joint.parent] != GROUND || own.mass == 0.0 {
            let moments = own.six();
            let says = format!(
                "armature of a ball between moving bodies: {armature} kg m^2 beside moments {:?} of its body does not act here",
                &moments[..3]
            );
            let label = format!("joint[{}]", motion.name);
            model.context.findings.ignored(motion.at, label, says);
            continue;
        }
        let added = Mass { mass, center: place, tensor: M3::identity() * moment };
        let body = model.robot.links[link].name.clone();
        let note = format!("Body {body}: armature {armature} of joint {} is in it.", motion.name);
        model.robot.notes.push(note);
        if mass > 0.0 {
            weightless(model, (link, &format!("{} armature", motion.name)), added);
        } else {
            model.robot.links[link].mass = Some(own.with(&added));
        }
    }
}

/// A mass without weight as a link of its own, fixed to another one.
fn weightless(model: &mut Model<'_, '_, '_>, (to, name): (usize, &str), mass: Mass) {
    let name = model.free_name(Sort::Link, name);
    let (at, number, place) = (model.robot.links[to].at, model.robot.links.len(), mass.center);
    let pose = Pose::new(M3::identity(), place);
    let link = Link { pose, mass: Some(mass), gravity_scale: 0.0, ..Link::new(&name, at) };
    model.robot.links.push(link);
    let name = model.free_name(Sort::Joint, &name);
    model.robot.joints.push(Joint::new(&name, at, Kind::Fixed, [to, number], place));
}

/// Raises mass and principal moments to the least that settings allow.
fn bound(mass: &mut Mass, least_mass: f64, least_moment: f64) {
    mass.mass = mass.mass.max(least_mass);
    if least_moment > 0.0 {
        let eigen = mass.tensor.symmetric_eigen();
        if eigen.eigenvalues.min() < least_moment {
            let moments = M3::from_diagonal(&eigen.eigenvalues.map(|x| x.max(least_moment)));
            mass.tensor = eigen.eigenvectors * moments * eigen.eigenvectors.transpose();
        }
    }
}

/// Sets moments that no body has to their mean; did it?
fn balance(mass: &mut Mass) -> bool {
    let is_possible = is_possible(mass);
    if !is_possible {
        mass.tensor = M3::identity() * (mass.tensor.trace() / 3.0);
    }
    !is_possible
}

/// Is no moment larger than the sum of the others?
fn is_possible(mass: &Mass) -> bool {
    let moments = mass.tensor.symmetric_eigen().eigenvalues;
    2.0 * moments.max() <= moments.sum() + SLACK * moments.max()
}
