//! Transmissions of actuators: sums of coordinates, or forces and moments on a body.

use super::model::{Model, Motion, Moves};
use super::size::Size;
use crate::element::Element;
use crate::pose::{M3, V3, direction, v3};
use crate::robot::{GROUND, Kind, Signal, Term, What};
use crate::source::Read;
use mbs_core::algebra::cross;

/// Reason why an actuator is left out: the import does not know its effect in such a frame.
pub(super) const GROWN: &str = "it pulls a tendon, a site or a ball in a frame with a scale";

/// Distance between the two forces of a couple [m]. At this distance, two forces of 1 N are a moment of 1 N m.
const ARM: f64 = 1.0;

/// Transmission of an actuator: the sum or the forces on which it acts.
pub(super) struct Transmission {
    /// Terms of the length of the transmission, without the gear. `drawn` is this length in the reference configuration.
    pub(super) terms: Vec<Term>,
    pub(super) drawn: f64,
    pub(super) gear: f64,
    /// Forces and moments on a body per newton of actuator force, used in place of terms. They include the gear.
    pub(super) pushes: Vec<Push>,
    /// True if the length of the transmission can differ from zero.
    pub(super) has_length: bool,
    /// Index of the tendon, if the tendon limits the total force of its actuators.
    pub(super) rope: Option<usize>,
    pub(super) range: Option<[f64; 2]>,
    /// Size factors of the frames that contain the transmission, and whether it is a slide.
    pub(super) size: (Size, bool),
    pub(super) label: String,
}

/// A force at a point of a link. Without a point it is a moment on the link.
#[derive(Debug, Clone)]
pub(super) struct Push {
    pub(super) link: usize,
    at: Option<V3>,
    /// Force or moment in global axes. When it turns with the link, these are the axes in the reference configuration.
    value: V3,
    turns: bool,
}

/// A transmission, or the reason why the scene has none.
type Found = Result<Transmission, String>;

/// Finds the transmission of an actuator, by the attribute that names it.
pub(super) fn transmission(
    element: &Element,
    gear: &[f64; 6],
    ending: &str,
    model: &Model<'_, '_, '_>,
) -> Read<Found> {
    for (word, is_of_parent) in [("joint", false), ("jointinparent", true)] {
        if let Some(joint) = element.attribute(word) {
            let motion = model.motion(joint, ending)?;
            return Ok(of_joint(motion, gear, is_of_parent, model));
        }
    }
    if let Some(tendon) = element.attribute("tendon") {
        let (number, found) = model.tendon(tendon, ending)?;
        if found.is_grown {
            return Ok(Err(GROWN.into()));
        }
        if found.terms.is_empty() {
            return Ok(Err("its tendon is no sum of coordinates".into()));
        }
        return Ok(Ok(Transmission {
            terms: found.terms.clone(),
            drawn: found.drawn,
            gear: gear[0],
            has_length: true,
            rope: found.effort.map(|_| number),
            range: found.range,
            ..Transmission::none(&tendon.value)
        }));
    }
    if let Some(site) = element.attribute("site") {
        let found = model.site(site, ending)?;
        if found.is_grown() {
            return Ok(Err(GROWN.into()));
        }
        if let Some(other) = element.attribute("refsite") {
            let other = model.site(other, ending)?;
            if model.robot.carriers(|joint| joint.kind == Kind::Fixed)[other.link] != GROUND {
                return Ok(Err("`refsite`: a force between two places that move".into()));
            }
            let [force, moment] = halves(gear).map(|half| other.pose.turn * half);
            let mut pushes = vec![
                Push { link: found.link, at: Some(found.pose.at), value: force, turns: false },
                Push { link: found.link, at: None, value: moment, turns: false },
            ];
            pushes.retain(|push| push.value != V3::zeros());
            return Ok(Ok(Transmission {
                pushes,
                has_length: true,
                ..Transmission::none(&site.value)
            }));
        }
        let [force, moment] = halves(gear).map(|half| found.pose.turn * half);
        let pushes = turning(found.link, found.pose.at, force, moment);
        return Ok(Ok(Transmission { pushes, ..Transmission::none(&site.value) }));
    }
    Ok(Err(match element.attribute("body") {
        Some(_) => "`body`: it pulls what a body touches".into(),
        None => "it says nothing that it pulls".into(),
    }))
}

impl Transmission {
    /// A transmission that has neither terms nor forces. The caller adds them.
    pub(super) fn none(label: &str) -> Self {
        Self {
            terms: Vec::new(),
            drawn: 0.0,
            gear: 1.0,
            pushes: Vec::new(),
            has_length: false,
            rope: None,
            range: None,
            size: (Size::ONE, false),
            label: label.to_owned(),
        }
    }
}

fn halves([a, b, c, d, e, f]: &[f64; 6]) -> [V3; 2] {
    [v3([*a, *b, *c]), v3([*d, *e, *f])]
}

/// The transmission on a joint. For a hinge or a slide it is the coordinate. For a free joint, and for a ball on the ground, it consists of
/// forces and moments.
fn of_joint(
    motion: &Motion,
    gear: &[f64; 6],
    is_of_parent: bool,
    model: &Model<'_, '_, '_>,
) -> Found {
    if motion.is_single() {
        let (term, drawn) = motion.term(1.0);
        return Ok(Transmission {
            terms: vec![term],
            drawn,
            gear: gear[0],
            has_length: true,
            range: motion.range,
            size: (motion.size, motion.moves == Moves::Slide),
            ..Transmission::none(&motion.name)
        });
    }
    if motion.size != Size::ONE {
        return Err(GROWN.into());
    }
    let joint = &model.robot.joints[motion.joint];
    let carriers = model.robot.carriers(|joint| joint.kind == Kind::Fixed);
    if carriers[joint.parent] != GROUND {
        return Err("a moment between two moving bodies about axes of one of them".into());
    }
    let (link, [first, second]) = (joint.child, halves(gear));
    // A ball has three gears. The forces on a free joint are along global axes.
    let is_free = motion.moves == Moves::Free;
    let (force, moment) = if is_free { (first, second) } else { (V3::zeros(), first) };
    let pose = &model.robot.links[link].pose;
    let mut pushes = Vec::new();
    if force != V3::zeros() {
        pushes.push(Push { link, at: Some(pose.at), value: force, turns: false });
    }
    if is_of_parent {
        // The axes of a ball are those of the child in the drawn configuration.
        let turn = if is_free { M3::identity() } else { pose.turn };
        pushes.push(Push { link, at: None, value: turn * moment, turns: false });
    } else {
        pushes.extend(turning(link, pose.at, V3::zeros(), pose.turn * moment));
    }
    Ok(Transmission { pushes, has_length: !is_free, ..Transmission::none(&motion.name) })
}

/// A force and a moment that turn with a link. The moment is a couple of F and −F: d is perpendicular to the moment, and F = m × d / d².
fn turning(link: usize, at: V3, force: V3, moment: V3) -> Vec<Push> {
    let push = |at: V3, value: V3| Push { link, at: Some(at), value, turns: true };
    let least = (0..3).min_by(|a, b| moment[*a].abs().total_cmp(&moment[*b].abs())).unwrap_or(0);
    let Some(arm) = direction(&cross(&moment, &crate::pose::unit(least))) else {
        return vec![push(at, force)];
    };
    let couple = cross(&moment, &arm) / ARM;
    let mut pushes = vec![push(at, force - couple), push(at + arm * ARM, couple)];
    pushes.retain(|push| push.value != V3::zeros());
    pushes
}

/// Adds the forces and moments whose value is a signal.
pub(super) fn push(name: &str, signal: &str, pushes: &[Push], model: &mut Model<'_, '_, '_>) {
    for (number, push) in pushes.iter().enumerate() {
        let ending = if pushes.len() > 1 { format!(" {}", number + 1) } else { String::new() };
        let signals = [("x", 0), ("y", 1), ("z", 2)].map(|(axis, i)| {
            let of = vec![(signal.to_owned(), push.value[i])];
            model.signal(&format!("{name} {axis}{ending}"), Signal::Sum { of })
        });
        let Push { link, at, turns, .. } = *push;
        model.law(&format!("{name}{ending}"), What::Push { link, at, turns, signals });
    }
}
