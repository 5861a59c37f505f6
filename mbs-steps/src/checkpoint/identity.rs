//! Identity of a checkpoint: the scene, part by part, and the settings of its run.

use super::CheckpointError;
use super::tape::{Tape, Walked, holds};
use crate::fingerprint::Fingerprint;
use crate::settings::{Method, ResolvedMethod};
use core::fmt::{Debug, Write};
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Parts of a scene, as a file calls them.
const PARTS: [&str; 12] = [
    "[scene]",
    "[[body]]",
    "[[joint]]",
    "[[initial]]",
    "[[guide]]",
    "[[coupling]]",
    "[[rolling]]",
    "[[signal]]",
    "[road]",
    "[[effect]]",
    "[[output]]",
    "[solver]",
];

/// Settings that a checkpoint holds to, as the command line calls them.
const KEYS: [&str; 13] = [
    "formulation",
    "integrator",
    "precision",
    "step",
    "step-max",
    "step-control",
    "energy-tolerance",
    "error-tolerance",
    "events",
    "energy-alarm",
    "duration",
    "penalty",
    "tolerance",
];

/// Scene and settings of a run.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Identity {
    /// A number for each of [`PARTS`].
    parts: [u64; PARTS.len()],
    /// A text for each of [`KEYS`]; empty: left out.
    values: [String; KEYS.len()],
    /// The formulation as asked, `auto` among them.
    asked: String,
}

impl Identity {
    /// Makes the identity of a scene in the precision of its run. Comments, the order of keys and the name of the file have no part in it.
    pub fn new<T: Real>(scene: &Scene<T>, settings: &ResolvedMethod) -> Self {
        let (parts, values) = (fingerprints(scene), values(settings));
        Self { parts, values, asked: settings.asked.clone() }
    }

    /// Is that of a checkpoint the same?
    pub(super) fn check(&self, kept: &Self) -> Walked {
        self.check_settings(kept)?;
        let differs = |&i: &usize| self.parts[i] != kept.parts[i];
        let parts: Vec<_> = (0..PARTS.len()).filter(differs).map(|i| PARTS[i]).collect();
        if parts.is_empty() { Ok(()) } else { Err(CheckpointError::Scene(parts)) }
    }

    fn check_settings(&self, kept: &Self) -> Walked {
        match (0..KEYS.len()).find(|&i| self.values[i] != kept.values[i]) {
            None => Ok(()),
            Some(i) => {
                let [was, is] = [kept, self].map(|of| of.values[i].clone());
                Err(CheckpointError::Setting { key: KEYS[i], was, is })
            }
        }
    }

    /// The settings of a checkpoint where `given` says nothing else.
    pub(super) fn overrides(&self, given: &Method) -> Result<Method, CheckpointError> {
        let [formulation, integrator, precision, numbers @ ..] = &self.values;
        let [step, step_max, control, energy, error, events, alarm, rest @ ..] = numbers;
        let [duration, penalty, tolerance] = rest;
        let text = |given: &Option<String>, kept: &String| given.clone().or(Some(kept.clone()));
        let number = |given: Option<f64>, kept: &String| match given {
            Some(_) => Ok(given),
            None if kept.is_empty() => Ok(None),
            None => kept.parse().map(Some).map_err(|_| CheckpointError::Misfit),
        };
        let is_asked = given.formulation.as_ref().is_none_or(|f| *f == self.asked);
        let energy = match energy.split_once(',') {
            Some((u, l)) => [number(None, &u.to_owned())?, number(None, &l.to_owned())?],
            None => [None; 2],
        };
        Ok(Method {
            formulation: if is_asked {
                Some(formulation.clone())
            } else {
                given.formulation.clone()
            },
            integrator: text(&given.integrator, integrator),
            precision: text(&given.precision, precision),
            step: number(given.step, step)?,
            step_max: number(given.step_max, step_max)?,
            step_control: text(&given.step_control, control),
            energy_tolerance: given
                .energy_tolerance
                .or(energy[0].zip(energy[1]).map(<[f64; 2]>::from)),
            error_tolerance: number(given.error_tolerance, error)?,
            events: given.events.or(Some(events == "on")),
            energy_alarm: number(given.energy_alarm, alarm)?,
            duration: number(given.duration, duration)?,
            penalty: number(given.penalty, penalty)?,
            tolerance: number(given.tolerance, tolerance)?,
            threads: given.threads,
            interrupt: given.interrupt.clone(),
        })
    }

    /// The settings, where they are those of the checkpoint; what was asked for is what its run was asked for.
    pub(super) fn settle(
        &self,
        settings: ResolvedMethod,
    ) -> Result<ResolvedMethod, CheckpointError> {
        let now = Self { values: values(&settings), ..Self::default() };
        now.check_settings(self)?;
        Ok(ResolvedMethod { asked: self.asked.clone(), ..settings })
    }

    /// Writes it, or reads it back.
    pub(super) fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.places(&mut self.parts, Tape::word)?;
        tape.places(&mut self.values, Tape::text)?;
        tape.text(&mut self.asked)?;
        holds(!self.asked.is_empty())
    }
}

/// A number for each of [`PARTS`].
fn fingerprints<T: Real>(scene: &Scene<T>) -> [u64; PARTS.len()] {
    let Scene {
        name,
        dimension,
        gravity,
        duration,
        bodies,
        joints,
        initials,
        guides,
        couplings,
        rollings,
        signals,
        road,
        start,
        // names of places, and pictures: nothing moves by them
        frames: _,
        shapes: _,
        effects,
        outputs,
        solver,
    } = scene;
    let header = (name, dimension, gravity, duration, start);
    [
        of(&header),
        of(bodies),
        of(joints),
        of(initials),
        of(guides),
        of(couplings),
        of(rollings),
        of(signals),
        of(road),
        of(effects),
        of(outputs),
        of(solver),
    ]
}

/// Returns the fingerprint of all fields, as they are derived: numbers in the shortest text that reads back as the same bits.
fn of(part: &impl Debug) -> u64 {
    let mut print = Fingerprint::new();
    // Nothing in it can fail.
    let _ = write!(print, "{part:?}");
    print.get()
}

/// A text for each of [`KEYS`].
fn values(settings: &ResolvedMethod) -> [String; KEYS.len()] {
    let ResolvedMethod {
        asked: _,
        formulation,
        integrator,
        precision,
        step,
        step_max,
        rule,
        energy_tolerance: [upper, lower],
        error_tolerance,
        events,
        energy_alarm,
        duration,
        penalty,
        tolerance,
        // The bits are the same for any number of them, and however the rest was chosen.
        threads: _,
        choice: _,
        interrupt: _,
    } = settings;
    let optional = |x: &Option<f64>| x.map_or_else(String::new, |x| format!("{x:?}"));
    [
        formulation.name().to_owned(),
        integrator.name().to_owned(),
        precision.name().to_owned(),
        format!("{step:?}"),
        format!("{step_max:?}"),
        rule.name().to_owned(),
        format!("{upper:?},{lower:?}"),
        format!("{error_tolerance:?}"),
        if *events { "on" } else { "off" }.to_owned(),
        format!("{energy_alarm:?}"),
        format!("{duration:?}"),
        optional(penalty),
        optional(tolerance),
    ]
}
