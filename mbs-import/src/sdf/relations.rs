//! Relations between joints: gearboxes and mimic joints.

use super::frames::Frames;
use super::joint::{Names, coordinate, direction_of, find, is_still, known};
use super::scope::{Scope, is_gearbox, link, missing, number};
use crate::element::Element;
use crate::pose::V3;
use crate::robot::{Coupling, Kind, Law, Robot, Target, Term, What};
use crate::source::Read;

/// Adds the gearboxes and mimic relations of a model.
pub(super) fn read(model: &Element, scope: &Scope, frames: &Frames, robot: &mut Robot) -> Read<()> {
    for element in model.each("joint") {
        if is_gearbox(element) {
            if is_still(element, scope, frames)? {
                element.read_whole();
                continue;
            }
            let coupling = gearbox(element, scope, frames, robot)?;
            robot.couplings.push(coupling);
            continue;
        }
        if is_still(element, scope, frames)? {
            continue;
        }
        let of = Names { scope, frames };
        let name = &element.need("name")?.value;
        let follower = find(robot, &of, element, name)?;
        let shown = robot.joints[follower].name.clone();
        for (i, axis) in ["axis", "axis2"].into_iter().enumerate() {
            let Some(mimic) = element.child(axis).and_then(|axis| axis.child("mimic")) else {
                continue;
            };
            let leader = mimic.need("joint")?;
            let value = |word: &str, default| number(mimic, word, default);
            let (factor, offset, reference) =
                (value("multiplier", 1.0)?, value("offset", 0.0)?, value("reference", 0.0)?);
            let of_leader = coordinate(
                &robot.joints,
                find(robot, &of, mimic, &leader.value)?,
                usize::from(mimic.value("axis") == Some("axis2")),
            );
            robot.couplings.push(Coupling::follows(
                &shown,
                [coordinate(&robot.joints, follower, i), of_leader],
                factor,
                offset - factor * reference,
            ));
        }
        if let Some(mimic) = element.child("drake:mimic") {
            let leader = mimic.need("joint")?;
            let leader = find(robot, &of, mimic, &leader.value)?;
            let factor = mimic.number_or("multiplier", 1.0)?;
            robot.couplings.push(Coupling::follows(
                &shown,
                [follower, leader].map(|joint| coordinate(&robot.joints, joint, 0)),
                factor,
                mimic.number_or("offset", 0.0)?,
            ));
        }
        reflected(element, follower, robot)?;
    }
    Ok(())
}

/// Adds the inertia of a motor's rotor, reflected by its gear.
fn reflected(element: &Element, joint: usize, robot: &mut Robot) -> Read<()> {
    let Some(inertia) = element.child("drake:rotor_inertia") else { return Ok(()) };
    let inertia = inertia.content().number()?;
    let ratio =
        element.child("drake:gear_ratio").map_or(Ok(1.0), |ratio| ratio.content().number())?;
    if inertia > 0.0 && ratio != 0.0 {
        let on = Target::Coordinate(coordinate(&robot.joints, joint, 0));
        let name = format!("{} rotor", robot.joints[joint].name);
        robot.laws.push(Law { name, what: What::Rotor { on, inertia: inertia * ratio * ratio } });
    }
    Ok(())
}

/// The coupling of a gearbox. Its angles are relative to a third link. The angle of the child is minus the ratio times the angle of the
/// parent.
fn gearbox(element: &Element, scope: &Scope, frames: &Frames, robot: &Robot) -> Read<Coupling> {
    let full = format!("{}{}", scope.prefix, element.need("name")?.value);
    let [own, shown] = known(frames, &full, element)?;
    let link = |word: &str| link(element, word, scope, frames);
    let [parent, child, reference] =
        [link("parent")?, link("child")?, link("gearbox_reference_body")?];
    let ratio = number(element, "gearbox_ratio", 1.0)?;
    let axis = |word: &str| -> Read<V3> {
        let axis = element.child(word).ok_or_else(|| missing(element, word))?;
        direction_of(axis, own, scope, frames)
    };
    let first = turn(element, robot, [reference, parent], &axis("axis")?)?;
    let second = turn(element, robot, [reference, child], &axis("axis2")?)?;
    let term = |(joint, sign): (usize, f64), factor: f64| {
        Term::new(coordinate(&robot.joints, joint, 0), sign * factor)
    };
    Ok(Coupling {
        name: shown.to_owned(),
        terms: vec![term(second, 1.0), term(first, ratio)],
        value: 0.0,
    })
}

/// The joint whose coordinate is the rotation of link `to` relative to link `from` about an axis, and its sign.
fn turn(element: &Element, robot: &Robot, [from, to]: [usize; 2], axis: &V3) -> Read<(usize, f64)> {
    /// Largest difference of unit vectors of one axis [-]. Published axes have six digits.
    const ALIKE: f64 = 1.0e-5;
    for (number, joint) in
        robot.joints.iter().enumerate().filter(|(_, joint)| joint.kind == Kind::Revolute)
    {
        let sense = match [joint.parent, joint.child] {
            ends if ends == [from, to] => 1.0,
            ends if ends == [to, from] => -1.0,
            _ => continue,
        };
        let along = joint.axes[0].dot(axis);
        if along.abs() > 1.0 - ALIKE {
            return Ok((number, sense * along.signum()));
        }
    }
    let [from, to] = [from, to].map(|link| &robot.links[link].name);
    Err(element.fault(
        format!("no revolute joint turns `{to}` against `{from}` about the axis of this gearbox"),
        "join each of the two links to <gearbox_reference_body> by a revolute joint about its axis",
    ))
}
