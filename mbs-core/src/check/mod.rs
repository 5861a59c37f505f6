//! Checks of a whole scene. Contradictions and impossible values are refused; unusual values pass.
//!
//! This module also resolves a scene to the scalar of a run, and gives notes on unusual values.
//!
//! The checks of each entry come first: names, numbers and references. Checks of several entries together follow. Comparisons are written
//! so that a NaN fails them.

pub(crate) mod body;
mod coupling;
mod course;
mod drawn;
mod effect;
mod frame;
mod joint;
mod motion;
mod open;
mod output;
mod point;
mod resolve;
mod road;
mod rolling;
mod shape;
mod signal;
mod table_notes;

pub use table_notes::TableNote;

use crate::Real;
use crate::mechanism::Scene;
use crate::scene::place::Place;
use crate::scene::{Entry, SceneError, SceneFault, Setting, SettingValue};
use alloc::vec::Vec;

impl<T: Real> Scene<T> {
    /// Refuses a scene with contradictions or impossible values. The error is the first fault, with its entry and key.
    ///
    /// A body without joints and redundant constraints are unusual, but valid: they pass.
    ///
    /// # Errors
    /// [`SceneError`] with the entry, the key as in scene files, and the fault with its numbers.
    ///
    /// # Examples
    /// ```
    /// # use mbs_core::scene::{Dimension, Entry, Scene, SceneFault};
    /// let mut scene = Scene::<f64>::empty("empty", Dimension::Planar, 1.0);
    /// assert!(scene.check().is_ok());
    /// scene.duration = -1.0;
    /// let error = scene.check().unwrap_err();
    /// assert_eq!((error.entry, error.field), (Entry::Scene, "duration"));
    /// assert_eq!(error.fault, SceneFault::NotPositive(-1.0));
    /// ```
    pub fn check(&self) -> Result<(), SceneError> {
        self.check_names()?;
        let place = Place { entry: Entry::Scene, dimension: self.dimension };
        place.positive("duration", self.duration)?;
        if let Some(gravity) = self.gravity {
            place.vector("gravity", gravity)?;
        }
        self.check_solver()?;
        for (i, body) in self.bodies.iter().enumerate() {
            body::check(body, self.place(Entry::Body(i)))?;
        }
        for (i, joint) in self.joints.iter().enumerate() {
            joint::check(self, joint, self.place(Entry::Joint(i)))?;
        }
        body::check_lumps(self)?;
        motion::check_guides(self)?;
        coupling::check(self)?;
        rolling::check(self)?;
        signal::check(self)?;
        motion::check_initials(self)?;
        coupling::check_starts(self)?;
        for (i, effect) in self.effects.iter().enumerate() {
            effect::check(self, &effect.kind, self.place(Entry::Effect(i)))?;
        }
        frame::check(self)?;
        shape::check(self)?;
        road::check(self)?;
        for (i, output) in self.outputs.iter().enumerate() {
            output::check(self, output, self.place(Entry::Output(i)))?;
        }
        point::check(self)
    }

    /// Checks the tables of guides and of their signals against the length of a run. A table that begins or ends within the run must not
    /// have a slope there, since the rate would jump.
    ///
    /// A table that covers the whole run has no such jump.
    ///
    /// # Errors
    /// [`SceneFault::TableSlope`] with the guide or signal and the row.
    pub fn check_run(&self, duration: T) -> Result<(), SceneError> {
        motion::check_ends(self, duration)?;
        signal::check_ends(self, duration)
    }

    /// Bodies with an impossible inertia, or with an inertia but no mass. [`Self::check`] accepts them if they are welded to the ground, or
    /// if the bodies welded together have a possible inertia.
    #[must_use]
    pub fn odd_parts(&self) -> Vec<(usize, SceneFault)> {
        body::odd_parts(self)
    }

    fn place(&self, entry: Entry) -> Place {
        Place { entry, dimension: self.dimension }
    }

    fn check_names(&self) -> Result<(), SceneError> {
        unique(self.bodies.iter().map(|b| b.name.as_str()), Some("ground"), Entry::Body)?;
        unique(self.joints.iter().map(|j| j.name.as_str()), None, Entry::Joint)?;
        unique(self.couplings.iter().map(|c| c.name.as_str()), None, Entry::Coupling)?;
        unique(self.rollings.iter().map(|r| r.name.as_str()), None, Entry::Rolling)?;
        unique(self.signals.iter().map(|s| s.name.as_str()), None, Entry::Signal)?;
        unique(self.frames.iter().map(|f| f.name.as_str()), Some("ground"), Entry::Frame)?;
        unique(self.shapes.iter().map(|s| s.name.as_str()), None, Entry::Shape)?;
        unique(self.effects.iter().map(|e| e.name.as_str()), None, Entry::Effect)?;
        unique(self.outputs.iter().map(|o| o.name.as_str()), Some("t"), Entry::Output)
    }

    fn check_solver(&self) -> Result<(), SceneError> {
        let place = self.place(Entry::Solver);
        for (key, _) in Setting::of_table("solver") {
            match self.solver.value(key) {
                Some(SettingValue::Number(x)) => place.positive(key, x)?,
                Some(SettingValue::Pair(limits)) => place.descending(key, limits)?,
                Some(SettingValue::Word(_) | SettingValue::Flag(_) | SettingValue::Count(_))
                | None => {}
            }
        }
        Ok(())
    }
}

/// Checks that names exist, are not reserved, and differ. Cost: a sort, so that scenes of many bodies are fast to check.
fn unique<'a>(
    names: impl Iterator<Item = &'a str>,
    reserved: Option<&str>,
    entry: fn(usize) -> Entry,
) -> Result<(), SceneError> {
    let refuse = |i, fault| Err(SceneError { entry: entry(i), field: "name", fault });
    let mut seen = alloc::collections::BTreeMap::new();
    for (i, name) in names.enumerate() {
        if name.trim().is_empty() || Some(name) == reserved {
            return refuse(i, SceneFault::ReservedName);
        }
        if let Some(first) = seen.insert(name, i) {
            return refuse(i, SceneFault::DuplicateName(first));
        }
    }
    Ok(())
}
