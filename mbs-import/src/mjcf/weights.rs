//! Inertias of the bodies, with the settings of the whole model applied.

use super::model::{Model, Moves, Sort};
use crate::element::Attribute;
use crate::inertia::{Mass, SLACK};
use crate::pose::{M3, Pose};
use crate::robot::{GROUND, Joint, Kind, Link};
use crate::source::{Fault, Read};

/// Rounding error of the principal moments of a tensor, relative to the largest [-].
const ROUNDING: f64 = 1.0e-14;

/// Refuses negative moments in the file, which no setting can correct.
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

/// Text of the principal moments of a tensor, in ascending order.
fn listed(tensor: &M3) -> String {
    let mut moments: Vec<f64> = tensor.symmetric_eigen().eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    format!("{moments:?}")
}

/// Applies the settings for minimum, balance and total mass to all bodies, and gives the masses to the links.
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

/// Converts the armature a of a free joint, or of a ball on the ground, to inertia of its body. The energy of the armature is ½ a |v|² + ½ a
/// |ω|², where v is the velocity of the body at the joint's place. A weightless mass a at this place has the same energy, together with a
/// moment a about all axes. The armature of a joint between moving bodies has no counterpart.
pub(super) fn armatures(model: &mut Model<'_, '_, '_>) {
    let carriers = model.robot.carriers(|joint| joint.kind == Kind::Fixed);
    for number in 0..model.motions.len() {
        let motion = model.motions[number].clone();
        let joint = &model.robot.joints[motion.joint];
        let (link, place, armature) = (joint.child, joint.place, motion.armature);
        // The three translations of a free joint have equal armature.
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

/// Adds a mass without weight as a link of its own, fixed to another link.
fn weightless(model: &mut Model<'_, '_, '_>, (to, name): (usize, &str), mass: Mass) {
    let name = model.free_name(Sort::Link, name);
    let (at, number, place) = (model.robot.links[to].at, model.robot.links.len(), mass.center);
    let pose = Pose::new(M3::identity(), place);
    let link = Link { pose, mass: Some(mass), gravity_scale: 0.0, ..Link::new(&name, at) };
    model.robot.links.push(link);
    let name = model.free_name(Sort::Joint, &name);
    model.robot.joints.push(Joint::new(&name, at, Kind::Fixed, [to, number], place));
}

/// Raises the mass and the principal moments to the minimum values of the settings.
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

/// Replaces impossible principal moments by their mean; returns `true` if they were impossible.
fn balance(mass: &mut Mass) -> bool {
    let is_possible = is_possible(mass);
    if !is_possible {
        mass.tensor = M3::identity() * (mass.tensor.trace() / 3.0);
    }
    !is_possible
}

/// True if no principal moment is larger than the sum of the other two.
fn is_possible(mass: &Mass) -> bool {
    let moments = mass.tensor.symmetric_eigen().eigenvalues;
    2.0 * moments.max() <= moments.sum() + SLACK * moments.max()
}
