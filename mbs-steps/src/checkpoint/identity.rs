//! Identity of a checkpoint: a fingerprint of each part of the scene, and the settings of its run.

use super::CheckpointError;
use super::tape::{Tape, Walked, holds};
use crate::fingerprint::Fingerprint;
use crate::settings::{Method, ResolvedMethod};
use core::fmt::{Debug, Write};
use mbs_core::Real;
use mbs_core::scene::{SETTINGS, Scene, Setting};

/// Parts of a scene, by their names in a scene file.
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

/// Settings that must equal those of the checkpoint, in the order in which the file stores them. Further settings follow in the order of
/// the table.
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

/// Name of the only setting that may differ from the checkpoint, because the results are bitwise the same for any number of threads.
const FREE: &str = "threads";

/// Returns the settings that must equal those of the checkpoint.
fn held() -> impl Iterator<Item = &'static Setting> {
    let is_other = |row: &&Setting| row.name != FREE && !FORMAT.contains(&row.name);
    let first = FORMAT.into_iter().filter_map(Setting::named);
    first.chain(SETTINGS.iter().filter(is_other))
}

/// Identity of a run: scene and settings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    /// Fingerprint of each of [`PARTS`].
    parts: [u64; PARTS.len()],
    /// Text of each setting in [`held`]; empty for a setting without value.
    values: Vec<String>,
    /// Formulation as requested; it may be `auto`.
    asked: String,
}

impl Default for Identity {
    fn default() -> Self {
        let values = held().map(|_| String::new()).collect();
        Self { parts: [0; PARTS.len()], values, asked: String::new() }
    }
}

impl Identity {
    /// Computes the identity of a scene and its settings, in the precision of the run. Comments, the order of keys and the name of the file
    /// do not change it.
    pub fn new<T: Real>(scene: &Scene<T>, settings: &ResolvedMethod) -> Self {
        let (parts, values) = (fingerprints(scene), values(settings));
        Self { parts, values, asked: settings.asked.clone() }
    }

    /// Compares scene and settings with those of a checkpoint.
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

    /// Returns the given settings, completed by those of the checkpoint.
    pub(super) fn overrides(&self, given: &Method) -> Result<Method, CheckpointError> {
        let mut method = given.clone();
        // A requested formulation that equals the checkpoint's request (for example `auto`) selects the formulation that the checkpoint's
        // run used.
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

    /// Returns the settings after a check that they equal those of the checkpoint. The requested formulation is taken from the checkpoint.
    pub(super) fn settle(
        &self,
        settings: ResolvedMethod,
    ) -> Result<ResolvedMethod, CheckpointError> {
        let now = Self { values: values(&settings), ..Self::default() };
        now.check_settings(self)?;
        Ok(ResolvedMethod { asked: self.asked.clone(), ..settings })
    }

    /// Writes the identity to a checkpoint, or reads it from one.
    pub(super) fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.places(&mut self.parts, Tape::word)?;
        tape.places(&mut self.values, Tape::text)?;
        tape.text(&mut self.asked)?;
        holds(!self.asked.is_empty())
    }
}

/// Computes the fingerprint of each of [`PARTS`].
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
        // Frames and drawn shapes do not influence the motion.
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

/// Returns the fingerprint of all fields in their `Debug` form, because this form has each number as the shortest text that reads back
/// exactly.
fn of(part: &impl Debug) -> u64 {
    let mut print = Fingerprint::new();
    // Writing into a fingerprint cannot fail.
    let _ = write!(print, "{part:?}");
    print.get()
}

/// Returns the text of each setting in [`held`].
fn values(settings: &ResolvedMethod) -> Vec<String> {
    let decided = settings.decided();
    let text =
        |row: &Setting| decided.value(row.name).map(|value| value.text(|x| format!("{x:?}")));
    held().map(|row| text(row).unwrap_or_default()).collect()
}
