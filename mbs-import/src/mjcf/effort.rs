//! Limits on the total effort of several actuators, on one joint or on one tendon.

use super::model::{Model, Motion};
use super::transmission::Transmission;
use crate::robot::{Coordinate, GROUND, Robot, Signal, Target, Term, What};

/// Force of an actuator on the terms of a sum: a signal times a gear.
#[derive(Debug, Clone)]
pub(super) struct Pull {
    pub(super) name: String,
    pub(super) signal: String,
    pub(super) gear: f64,
    pub(super) terms: Vec<Term>,
}

/// A part of the effort on a joint: the actuator's name, its signal, and the factor.
type Share = (String, String, f64);

/// Actuators that have a common limit.
#[derive(Debug, Default)]
pub(super) struct Shared {
    /// Actuators of a tendon with limits, by the tendon's index.
    ropes: Vec<(usize, Vec<Pull>)>,
    /// Parts of the effort on a joint with limits, by the index of the file's joint.
    joints: Vec<(usize, Vec<Share>)>,
}

impl Shared {
    /// Adds the force of an actuator. `rope` is the index of the actuator's tendon if that tendon limits the total force of its actuators.
    pub(super) fn add(&mut self, pull: Pull, rope: Option<usize>, model: &mut Model<'_, '_, '_>) {
        let Some(rope) = rope else { return self.spread(&pull, model) };
        match self.ropes.iter_mut().find(|(other, _)| *other == rope) {
            Some((_, pulls)) => pulls.push(pull),
            None => self.ropes.push((rope, vec![pull])),
        }
    }

    /// Adds the signals of the common limits, and the laws that apply the limited efforts.
    pub(super) fn finish(mut self, model: &mut Model<'_, '_, '_>) {
        for (rope, pulls) in std::mem::take(&mut self.ropes) {
            let pull = limited(rope, &pulls, model);
            self.spread(&pull, model);
        }
        for (number, shares) in self.joints {
            joint(number, &shares, model);
        }
    }

    /// Applies a force to the terms without limits. Terms of joints with limits are collected until all actuators are known.
    fn spread(&mut self, pull: &Pull, model: &mut Model<'_, '_, '_>) {
        let mut free = Vec::new();
        for term in &pull.terms {
            let Some(number) = limited_joint(term, model) else {
                free.push(term.clone());
                continue;
            };
            let factor = pull.gear * term.factor * model.motions[number].sign;
            let share = (pull.name.clone(), pull.signal.clone(), factor);
            match self.joints.iter_mut().find(|(other, _)| *other == number) {
                Some((_, shares)) => shares.push(share),
                None => self.joints.push((number, vec![share])),
            }
        }
        if free.is_empty() {
            return;
        }
        let signal = geared(&pull.name, &pull.signal, pull.gear, model);
        model.law(&format!("{} drive", pull.name), What::Driven { on: target(&free), signal });
    }
}

/// Adds a signal multiplied by a factor, and returns its name.
fn geared(name: &str, signal: &str, factor: f64, model: &mut Model<'_, '_, '_>) -> String {
    if factor == 1.0 {
        return signal.to_owned();
    }
    let of = vec![(signal.to_owned(), factor)];
    model.signal(&format!("{name} geared"), Signal::Sum { of })
}

/// Combines the actuators of a tendon. All forces are reduced by the same factor, so that their sum keeps the limit.
fn limited(rope: usize, pulls: &[Pull], model: &mut Model<'_, '_, '_>) -> Pull {
    let [lower, upper] = model.tendons[rope].effort.unwrap_or([f64::MIN, f64::MAX]);
    let first = &pulls[0];
    let name = match pulls {
        [only] => only.name.clone(),
        _ => model.tendons[rope].name.clone(),
    };
    let sum = |model: &mut Model<'_, '_, '_>, word: &str, factor: fn(&Pull) -> f64| {
        let of = pulls.iter().map(|pull| (pull.signal.clone(), factor(pull))).collect();
        model.signal(&format!("{name} {word}"), Signal::Sum { of })
    };
    let is_one = pulls.len() == 1;
    let of = if is_one { first.signal.clone() } else { sum(model, "actuators", |_| 1.0) };
    if pulls.iter().all(|pull| pull.gear == first.gear) {
        let clamp = Signal::Clamp { of, lower, upper };
        let signal = model.signal(&format!("{name} effort"), clamp);
        return Pull { name, signal, gear: first.gear, terms: first.terms.clone() };
    }
    // The sum Σ gᵢ fᵢ is multiplied by the ratio of the limited Σ fᵢ to Σ fᵢ.
    let all = sum(model, "geared actuators", |pull| pull.gear);
    let ratio = Signal::LimitRatio { of, lower, upper };
    let ratio = model.signal(&format!("{name} limit ratio"), ratio);
    let effort = Signal::Product { of: vec![all, ratio] };
    let signal = model.signal(&format!("{name} effort"), effort);
    Pull { name, signal, gear: 1.0, terms: first.terms.clone() }
}

/// Combines the actuators of a joint, and applies their limited effort.
fn joint(number: usize, shares: &[Share], model: &mut Model<'_, '_, '_>) {
    let motion = model.motions[number].clone();
    let [lower, upper] = motion.effort.unwrap_or([f64::MIN, f64::MAX]);
    let (name, of) = match shares {
        [(name, signal, factor)] => (name.clone(), geared(name, signal, *factor, model)),
        _ => {
            let of = shares.iter().map(|(_, signal, factor)| (signal.clone(), *factor)).collect();
            let sum = Signal::Sum { of };
            let signal = model.signal(&format!("{} actuators", motion.name), sum);
            (motion.name.clone(), signal)
        }
    };
    let signal = model.signal(&format!("{name} effort"), Signal::Clamp { of, lower, upper });
    let (term, _) = motion.term(1.0);
    model.law(&format!("{name} drive"), What::Driven { on: target(&[term]), signal });
}

/// The target of a law that acts on these terms.
pub(super) fn target(terms: &[Term]) -> Target {
    match terms {
        [only] if only.factor == 1.0 && only.line.is_empty() => Target::Coordinate(only.of.clone()),
        terms => Target::Sum(terms.to_vec()),
    }
}

/// Index of the file's joint to which a term belongs, if that joint limits the total effort of its actuators.
fn limited_joint(term: &Term, model: &Model<'_, '_, '_>) -> Option<usize> {
    let is_it = |of: &Coordinate| *of == term.of && term.line.is_empty();
    model.motions.iter().position(|motion| {
        motion.effort.is_some() && motion.is_single() && is_it(&motion.coordinate())
    })
}

/// True if a term is the coordinate of a joint whose actuators have a common limit.
pub(super) fn is_limited(terms: &[Term], model: &Model<'_, '_, '_>) -> bool {
    terms.iter().any(|term| limited_joint(term, model).is_some())
}

/// Names of the joints that limit their actuators' total effort, but on which a line or a force on a body acts without this limit.
pub(super) fn passed_by(pulled: &Transmission, model: &Model<'_, '_, '_>) -> Vec<String> {
    let limited: Vec<&Motion> =
        model.motions.iter().filter(|motion| motion.effort.is_some()).collect();
    if limited.is_empty() {
        return Vec::new();
    }
    let lines = pulled.terms.iter().map(|term| term.line.iter().map(|(link, _)| *link).collect());
    let mut all: Vec<Vec<usize>> = lines.collect();
    all.push(pulled.pushes.iter().map(|push| push.link).chain([GROUND]).collect());
    let found = limited.iter().filter(|motion| {
        let child = model.robot.joints[motion.joint].child;
        all.iter().any(|links: &Vec<usize>| {
            let carried =
                links.iter().filter(|link| is_carried(**link, child, &model.robot)).count();
            carried > 0 && carried < links.len()
        })
    });
    found.map(|motion| motion.name.clone()).collect()
}

/// True if a link is the link `by`, or if the chain of joints from it to the ground contains `by`.
fn is_carried(mut link: usize, by: usize, robot: &Robot) -> bool {
    while link != GROUND && link != by {
        // The first joint of a link leads to the ground; later joints of the same child close loops.
        let joint = robot.joints.iter().find(|joint| joint.child == link);
        link = joint.map_or(GROUND, |joint| joint.parent);
    }
    link == by
}
