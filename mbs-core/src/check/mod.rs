//! Checks of a scene as a whole: what cannot be meant is refused, what is merely unusual passes.
//!
//! A scene is resolved to the scalar of a run here, and what passes may be noted.
//!
//! Order: names, numbers and references of each entry, then what entries say about one another. Comparisons
//! are written so that a NaN fails them.

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
    /// Refuses a scene that cannot be meant: the first fault found, with its entry and key.
    ///
    /// A body without joints and redundant constraints are unusual, not wrong: they pass.
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

    /// Refuses what only the length of a run shows: the table of a guide, or of a signal that one follows, that begins or ends
    /// within it on a slope.
    ///
    /// A table that is in motion at t = 0, or when the run ends, has no such jump.
    ///
    /// # Errors
    /// [`SceneFault::TableSlope`] with the guide or signal and the row.
    pub fn check_run(&self, duration: T) -> Result<(), SceneError> {
        motion::check_ends(self, duration)?;
        signal::check_ends(self, duration)
    }

    /// Bodies with an inertia that none can have, or with inertia and no mass. [`Self::check`] accepts them where the bodies welded
    /// together have an inertia that a body can have, and where they are welded to the ground.
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

/// Names are there, free and different. Cost: a sort, so that scenes of many bodies stay cheap.
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
