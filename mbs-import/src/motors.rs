//! Motors that the file does not have: an input for each moving joint.

use crate::findings::Findings;
use crate::robot::{Coordinate, GROUND, Joint, Kind, Law, Robot, Signal, Target, Term, What};
use crate::source::{Fault, Read};

/// Adds a motor to each joint that no actuator of the file drives. A coordinate that a coupling determines gets no motor. A joint that closes
/// a loop gets none, and neither does a free joint on the ground, which belongs to a base.
pub(crate) fn add(robot: &mut Robot, findings: &mut Findings) -> Read<()> {
    let driven = driven(robot);
    for number in 0..robot.joints.len() {
        let joint = robot.joints[number].clone();
        let is_base = joint.kind == Kind::Free && joint.parent == GROUND;
        if joint.closes || is_base || driven[number] {
            continue;
        }
        let before = robot.laws.len();
        efforts(&joint, number, robot)?;
        moments(&joint, robot)?;
        if robot.laws.len() > before && joint.effort.is_none() {
            let says = "the file limits no effort above zero: its motor does not saturate";
            findings.noted(joint.at, format!("joint[{}]", joint.name), says);
        }
    }
    Ok(())
}

/// Returns for each joint whether an actuator of the file drives it.
fn driven(robot: &Robot) -> Vec<bool> {
    let mut driven = vec![false; robot.joints.len()];
    for law in &robot.laws {
        match &law.what {
            What::Input { on, .. } | What::Driven { on, .. } => match on {
                Target::Coordinate(of) => driven[of.joint] = true,
                Target::Sum(terms) => {
                    let of_lines = |term: &&Term| term.line.is_empty();
                    terms.iter().filter(of_lines).for_each(|term| driven[term.of.joint] = true);
                }
            },
            What::Push { link, .. } => {
                let is_pushed = |joint: &Joint| {
                    joint.child == *link && matches!(joint.kind, Kind::Free | Kind::Spherical)
                };
                let joints = driven.iter_mut().zip(&robot.joints);
                joints.filter(|(_, joint)| is_pushed(joint)).for_each(|(driven, _)| *driven = true);
            }
            _ => {}
        }
    }
    driven
}

/// Words of the coordinates that get their own motor, in the order of the scene. The word of a single coordinate is empty.
const fn words(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::Fixed | Kind::Weld | Kind::Distance(_) | Kind::Spherical => &[],
        Kind::Revolute | Kind::Prismatic => &[""],
        Kind::Cylindrical => &["slide", "turn"],
        Kind::Universal => &["first", "second"],
        Kind::Planar => &["x", "y", "turn"],
        Kind::Free => &["x", "y", "z"],
    }
}

/// Adds the motors of single coordinates of a joint.
fn efforts(joint: &Joint, number: usize, robot: &mut Robot) -> Read<()> {
    let words = words(joint.kind);
    for (i, word) in words.iter().enumerate() {
        let of = Coordinate { joint: number, number: (words.len() > 1).then_some(i) };
        // A coupling determines the coordinate of its first term. This coordinate gets no motor.
        let is_led = robot.couplings.iter().any(|coupling| coupling.terms[0].of == of);
        if is_led {
            continue;
        }
        let is_slide = match joint.kind {
            Kind::Prismatic | Kind::Free => true,
            Kind::Cylindrical => i == 0,
            Kind::Planar => i < 2,
            _ => false,
        };
        let unit = if is_slide { "N" } else { "N m" };
        let ending = if word.is_empty() { String::new() } else { format!(".{word}") };
        let (name, signal) = input(joint, &ending, unit, robot)?;
        let on = Target::Coordinate(of);
        robot.laws.push(Law { name: format!("{name} drive"), what: What::Driven { on, signal } });
    }
    Ok(())
}

/// Adds the motors of the rotations of a ball joint: moments about global axes on its second body, and opposite moments on the first.
fn moments(joint: &Joint, robot: &mut Robot) -> Read<()> {
    let word = match joint.kind {
        Kind::Spherical => "",
        // The ending distinguishes the names of these motors from those of the translations.
        Kind::Free => "turn-",
        _ => return Ok(()),
    };
    let mut signals = [const { String::new() }; 3];
    for (signal, axis) in signals.iter_mut().zip(["x", "y", "z"]) {
        *signal = input(joint, &format!(".{word}{axis}"), "N m", robot)?.1;
    }
    let back = signals.each_ref().map(|signal| format!("{signal} back"));
    if joint.parent != GROUND {
        for (name, signal) in back.iter().zip(&signals) {
            let what = What::Signal(Signal::Sum { of: vec![(signal.clone(), -1.0)] });
            robot.laws.push(Law { name: name.clone(), what });
        }
    }
    for (link, signals, ending) in [(joint.child, signals, ""), (joint.parent, back, " back")] {
        if link != GROUND {
            let what = What::Push { link, at: None, turns: false, signals };
            robot.laws.push(Law { name: format!("{}.motor drive{ending}", joint.name), what });
        }
    }
    Ok(())
}

/// Adds an input of a joint. Returns the signal that acts: the input, or the input limited by the joint's effort.
fn input(
    joint: &Joint,
    ending: &str,
    unit: &'static str,
    robot: &mut Robot,
) -> Read<(String, String)> {
    let name = format!("{}.motor{ending}", joint.name);
    if robot.laws.iter().any(|law| law.name == name) {
        let message = format!("`{name}` is the name of a motor, and the file has it already");
        return Err(Fault::new(joint.at, message, "give it another name, or leave --motors out"));
    }
    let what = What::Signal(Signal::Set { value: 0.0, unit });
    robot.laws.push(Law { name: name.clone(), what });
    let Some(effort) = joint.effort else { return Ok((name.clone(), name)) };
    let limited = format!("{name} limited");
    let what = Signal::Clamp { of: name.clone(), lower: -effort, upper: effort };
    robot.laws.push(Law { name: limited.clone(), what: What::Signal(what) });
    Ok((name, limited))
}
