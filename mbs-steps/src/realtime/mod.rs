//! Real time: a scene at the pace of a clock, or a loop of your own around a [`Simulation`].
//!
//! `mbs run SCENE --realtime` is a run with a [`Pacing`]; docs/REALTIME.md says what its policies do and what was measured. There is no
//! clock in a solver: the pacer of [`mbs_realtime`] stands around the steps.
//!
//! # A loop of your own
//! Who owns the loop, such as a test bench with hardware in it, sets inputs, steps, and reads outputs. The pacer calls `step` at the
//! begin of each period and `publish` at its end, or later, as the policy for late steps says.
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
//! A ladder of one's own: a second [`Simulation`] of the same scene with effects switched off takes the state over with
//! [`Simulation::take_over`] when [`Task::level`] changes. Inputs are set in both.

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
    /// Time between two boundaries [s]; else the step, or the largest one where lengths are controlled.
    pub period: Option<f64>,
    /// Policy for a period that is late.
    pub overrun: Overrun,
    /// The ladder of [`Overrun::Degrade`].
    pub degrade: Degrade,
    /// The loop waits awake for so long before each begin [s].
    pub awake: f64,
    /// When a degraded run comes back up.
    pub quiet: Recovery,
}

/// Time before a period's end in which a run waits awake, by default [s]. Chosen, not tuned.
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

/// Ladder of levels below the full scene: what they leave out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Degrade {
    /// Steps twice and four times as long, and effects, where they save time; what changes the outputs least goes first. Time
    /// and changes are measured before the run begins.
    Measured,
    /// Each entry is one more level, and leaves out what it names in addition: `steps` makes steps twice as long, the name of an
    /// effect switches it off.
    Listed(Vec<String>),
}
