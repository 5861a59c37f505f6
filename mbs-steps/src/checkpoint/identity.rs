//! Identity of a checkpoint: the scene, part by part, and the settings of its run.

use super::CheckpointError;
use super::tape::{Tape, Walked, holds};
use crate::fingerprint::Fingerprint;
use crate::settings::{Method, ResolvedMethod};
use core::fmt::{Debug, Write};
use mbs_core::Real;
use mbs_core::scene::{SETTINGS, Scene, Setting};

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

/// Settings that a checkpoint holds to, in the order of its format; others follow in the order of the table.
const FORMAT: [&str; 13] = [
    "formulation",
    "integrator",
    "precision",
    "step",
    "step_max",
    "step_control",
    "energy_tolerance",
    "error_tolerance",
    "events",
    "energy_alarm",
    "duration",
    "penalty",
    "tolerance",
];

/// Setting that a checkpoint does not hold to: the bits are the same for any number of threads.
const FREE: &str = "threads";

/// Returns the settings that a checkpoint holds to.
fn held() -> impl Iterator<Item = &'static Setting> {
    let is_other = |row: &&Setting| row.name != FREE && !FORMAT.contains(&row.name);
    let first = FORMAT.into_iter().filter_map(Setting::named);
    first.chain(SETTINGS.iter().filter(is_other))
}

/// Scene and settings of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    /// A number for each of [`PARTS`].
    parts: [u64; PARTS.len()],
    /// A text for each of [`held`]; empty: left out.
    values: Vec<String>,
    /// The formulation as asked, `auto` among them.
    asked: String,
}

impl Default for Identity {
    fn default() -> Self {
        let values = held().map(|_| String::new()).collect();
        Self { parts: [0; PARTS.len()], values, asked: String::new() }
    }
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
        let mut rows = held().zip(kept.values.iter().zip(&self.values));
        match rows.find(|(_, (was, is))| was != is) {
            None => Ok(()),
            Some((row, (was, is))) => {
                let (was, is) = (was.clone(), is.clone());
                Err(CheckpointError::Setting { key: row.option(), was, is })
            }
        }
    }

    /// The settings of a checkpoint where `given` says nothing else.
    pub(super) fn overrides(&self, given: &Method) -> Result<Method, CheckpointError> {
        let mut method = given.clone();
        // what was asked for stands for what it was decided to be
        if method.formulation.as_ref() == Some(&self.asked) {
            method.formulation = None;
        }
        for (row, kept) in held().zip(&self.values) {
            if kept.is_empty() || method.value(row.name).is_some() {
                continue;
            }
            let value = row.parse(kept).ok_or(CheckpointError::Misfit)?;
            method.set(row.name, value).map_err(|_| CheckpointError::Misfit)?;
        }
        Ok(method)
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

/// A text for each of [`held`].
fn values(settings: &ResolvedMethod) -> Vec<String> {
    let decided = settings.decided();
    let text =
        |row: &Setting| decided.value(row.name).map(|value| value.text(|x| format!("{x:?}")));
    held().map(|row| text(row).unwrap_or_default()).collect()
}
