//! Save and restore of a simulation.

use super::Simulation;
use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::checkpoint::{Checkpoint, CheckpointError, Identity, Kind, whole};
use crate::settings::ResolvedMethod;
use mbs_core::Real;
use mbs_core::scene::Scene;
use std::io::{Read, Write};

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Writes a checkpoint of the simulation, which was created from the given scene and settings. The checkpoint has all data that the
    /// next steps depend on, including inputs. After [`restore`](Self::restore) the next steps are bitwise the same.
    ///
    /// Cost: the checkpoint is first collected in memory. It has about eight numbers (of eight bytes each) for each coordinate and
    /// multiplier.
    ///
    /// # Errors
    /// The errors of the sink.
    ///
    /// # Examples
    /// ```
    /// use mbs::{Method, ResolvedMethod, scene_file::SceneFile};
    /// use mbs::typed::Simulation;
    /// # let text = r#"
    /// # [scene]
    /// # dimension = 2
    /// # duration = 1.0
    /// # gravity = [0.0, -9.81]
    /// # [[body]]
    /// # name = "bob"
    /// # mass = 1.0
    /// # center = [1.0, 0.0]
    /// # inertia = 0.0
    /// # [[joint]]
    /// # name = "pivot"
    /// # kind = "revolute"
    /// # bodies = ["ground", "bob"]
    /// # at = [0.0, 0.0]
    /// # "#;
    /// let scene = SceneFile::parse(text, "pendulum.toml")?.scene::<f64>()?;
    /// let settings = ResolvedMethod::new(&scene, &Method::default())?;
    /// let mut first = Simulation::<f64, 2>::new(&scene, &settings)?;
    /// first.step(1e-3)?;
    /// let mut bytes = Vec::new();
    /// first.save((&scene, &settings), &mut bytes)?;
    /// first.step(1e-3)?;
    ///
    /// let mut second = Simulation::<f64, 2>::new(&scene, &settings)?;
    /// second.restore((&scene, &settings), &bytes[..])?;
    /// second.step(1e-3)?;
    /// assert_eq!(first.state(), second.state());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(
        &self,
        (scene, settings): (&Scene<T>, &ResolvedMethod),
        mut sink: impl Write,
    ) -> Result<(), CheckpointError> {
        let (identity, t) = (Identity::new(scene, settings), self.state().t.to_f64());
        let mut snapshot = self.snapshot();
        let bytes = whole(&identity, (Kind::Simulation, [t, 0.0]), |pen| snapshot.walk(pen))?;
        Ok(sink.write_all(&bytes)?)
    }

    /// Restores a checkpoint of the same scene and settings. It is a checkpoint of [`save`](Self::save), or the state in a checkpoint of a
    /// run.
    ///
    /// # Errors
    /// [`CheckpointError`]; the state is unchanged then, but a state-space formulation may choose other independent coordinates.
    pub fn restore(
        &mut self,
        (scene, settings): (&Scene<T>, &ResolvedMethod),
        source: impl Read,
    ) -> Result<(), CheckpointError> {
        let checkpoint = Checkpoint::read(source)?;
        checkpoint.check(&Identity::new(scene, settings))?;
        self.restore_from(&mut checkpoint.body())
    }

    /// Restores the state from the current position of a tape.
    pub fn restore_from(&mut self, tape: &mut impl Tape) -> Walked {
        let before = self.snapshot();
        let mut snapshot = before.clone();
        snapshot.walk(tape)?;
        if self.restore_snapshot(&snapshot) {
            return Ok(());
        }
        let _ = self.restore_snapshot(&before);
        holds(false)
    }
}
