//! Real time: a run that a clock paces, or a user-defined loop around a [`Simulation`].
//!
//! `mbs run SCENE --realtime` is a run with a [`Pacing`]; docs/REALTIME.md describes its policies and measurements. No solver reads a
//! clock: the pacer of [`mbs_realtime`] calls the steps from outside.
//!
//! # A loop of your own
//! A program with a loop of its own, such as a test bench with hardware, sets inputs, makes steps, and reads outputs. The pacer calls
//! `step` at the beginning of each period and `publish` at its end. After an overrun, `publish` is called later; the policy determines
//! when.
//!
//! ```
//! use core::{cell::Cell, ops::ControlFlow, time::Duration};
//! use mbs::core::scene::{BodyId, Signal, Effect, EffectKind, JointId, JointTorque};
//! use mbs::realtime::{Clock, Overrun, Pace, Pacer, Task, Work};
//! use mbs::{Method, ResolvedMethod, StopError, scene_file::SceneFile};
//! use mbs::typed::Simulation;
//!
//! struct Bench<'a> {
//!     simulation: Simulation<f64, 2>,
//!     motor: usize,
//!     /// What the hardware asks for [N m], and what it receives [m].
//!     wanted: &'a dyn Fn(u64) -> f64,
//!     tip: Vec<[f64; 2]>,
//! }
//!
//! impl Work for Bench<'_> {
//!     type Error = StopError;
//!     fn step(&mut self, task: Task) -> Result<ControlFlow<()>, StopError> {
//!         let torque = [(self.wanted)(task.index), 0.0, 0.0];
//!         self.simulation.set_input(self.motor, torque).expect("the motor's torque is an input");
//!         self.simulation.step(1e-3)?;
//!         Ok(ControlFlow::Continue(()))
//!     }
//!     fn publish(&mut self, _: Task) {
//!         let tip = self.simulation.model().point(BodyId::Body(0), [1.0, 0.0, 0.0]);
//!         self.tip.push(tip.value(&self.simulation.state().q).into());
//!     }
//! }
//!
//! // The system's clock is `SystemClock::new()`; this one runs only while it is waited for, so that the example takes no time.
//! struct Still(Cell<Duration>);
//! impl Clock for Still {
//!     fn now(&self) -> Duration { self.0.get() }
//!     fn sleep(&mut self, time: Duration) { self.0.set(self.0.get() + time); }
//!     fn pause(&mut self) { self.sleep(Duration::from_micros(1)); }
//! }
//!
//! let text = r#"
//! [scene]
//! dimension = 2
//! duration = 1.0
//! gravity = [0.0, -9.81]
//! [[body]]
//! name = "arm"
//! mass = 1.0
//! center = [1.0, 0.0]
//! inertia = 0.0
//! [[joint]]
//! name = "pivot"
//! kind = "revolute"
//! bodies = ["ground", "arm"]
//! at = [0.0, 0.0]
//! "#;
//! let mut scene = SceneFile::parse(text, "arm.toml")?.scene::<f64>()?;
//! // what the input is at the start, before the first `set_input`: 9.81 N m hold 1 kg at 1 m
//! let kind = EffectKind::JointTorque(JointTorque { joint: JointId::new(0), coordinate: None, course: Signal::Input([9.81, 0.0, 0.0]) });
//! scene.effects.push(Effect { name: "motor".into(), enabled: true, kind });
//! let settings = ResolvedMethod::new(&scene, &Method { step: Some(1e-3), ..Method::default() })?;
//! let simulation = Simulation::new(&scene, &settings).expect("the scene starts");
//! let mut bench = Bench { simulation, motor: 0, wanted: &|_| 9.81, tip: Vec::with_capacity(500) };
//!
//! let pace = Pace { overrun: Overrun::Hold, ..Pace::every(Duration::from_millis(1)) };
//! let mut pacer = Pacer::new(pace, 1)?;
//! pacer.run(500, &mut Still(Cell::default()), &mut bench).expect("no step fails");
//! assert_eq!(bench.tip.len(), 500);
//! assert!(bench.tip.iter().all(|[_, y]| y.abs() < 1e-9), "the arm is held level");
//! assert!(pacer.report().held());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A ladder in such a loop needs a second [`Simulation`] of the same scene, with some effects switched off. When [`Task::level`] changes,
//! this simulation copies the state with [`Simulation::take_over`]. Inputs are set in both simulations.

mod error;
mod ladder;
mod measure;
pub mod run;
mod summary;

pub use crate::words::paced::rows;
pub use error::PacingError;
pub use mbs_realtime::{
    Action, Clock, Entry, Margin, Overrun, Pace, PaceError, Pacer, Recovery, Report, Spread,
    SystemClock, Task, Work,
};
pub use summary::OVERRUNS;

pub use crate::words::paced::note;
pub use summary::summary;

#[cfg(doc)]
use crate::typed::Simulation;

/// Settings by which a run is paced.
#[derive(Debug, Clone, PartialEq)]
pub struct Pacing {
    /// Length of a period [s]. Default: the length of a step; with step control, the largest length of a step.
    pub period: Option<f64>,
    /// Policy for a period that misses its deadline.
    pub overrun: Overrun,
    /// Ladder for the policy [`Overrun::Degrade`].
    pub degrade: Degrade,
    /// Time before the beginning of each period during which the loop waits actively [s].
    pub awake: f64,
    /// Condition on which a degraded run returns to a better level.
    pub quiet: Recovery,
}

/// Default time before the beginning of a period during which a run waits actively [s]. Chosen, not tuned.
const AWAKE: f64 = 1e-4;

impl Default for Pacing {
    fn default() -> Self {
        Self {
            period: None,
            overrun: Overrun::Finish,
            degrade: Degrade::Measured,
            awake: AWAKE,
            quiet: Recovery::default(),
        }
    }
}

/// Ladder of levels below the full scene, with the omissions of each level.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Degrade {
    /// Levels found by measurement before the run. They have longer steps (twice and four times as long) or omit effects, if this saves
    /// time. The first level changes the outputs least.
    Measured,
    /// Levels listed by the user. Each entry adds a level with one more omission: `steps` doubles the step length, and the name of an
    /// effect switches the effect off.
    Listed(Vec<String>),
}
