//! Recording of the motion of a run: the poses of all bodies at up to 600 instants.

mod drawing;
mod joints;
mod lines;
pub mod pose;
pub mod principal;
mod road;
mod shapes;
mod written;

pub use pose::frame;

use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::record::{DrawnBody, N_POSE, RecordedMotion};
use drawing::Drawing;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Dimension, Scene};
use pose::BodyPose;

/// Largest number of recorded frames of a run [-]. It suffices for ten seconds at sixty frames per second.
const MAX_PICTURES: f64 = 600.0;
/// Time by which a frame may be too early, relative to the interval of frames [-], because times have rounding errors. Chosen, not tuned.
const EARLY: f64 = 1e-6;
/// Largest number of values in all frames [-]; they need eighty megabytes. Scenes with thousands of bodies get fewer frames.
const MAX_NUMBERS: f64 = 1e7;

/// Recorder of the motion: functions that compute the poses, and the recorded motion.
#[derive(Debug)]
pub struct MotionRecorder<T: Real, const D: usize> {
    poses: Vec<BodyPose<T, D>>,
    motion: RecordedMotion,
    /// Interval of frames, and time of the next frame [s].
    every: f64,
    next: f64,
}

impl<T: Real, const D: usize> MotionRecorder<T, D> {
    /// Creates a recorder and the shapes to draw, for a run of the given duration [s].
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, duration: f64) -> Self {
        let up = scene.gravity.map_or([0.0; 3], |g| g.map(|x| -x.to_f64()));
        let drawing = Drawing { scene, length: model.length().to_f64() };
        let mut motion = RecordedMotion {
            dimension: D,
            up: if scene.dimension == Dimension::Spatial { up } else { [0.0; 3] },
            length: drawing.length,
            bodies: scene.bodies.iter().map(|b| body(&b.name, b.mass)).collect(),
            traces: drawing.traces(),
            forces: drawing.forces(),
            ..RecordedMotion::default()
        };
        drawing.add_bodies(&mut motion);
        drawing.add_joints(&mut motion);
        drawing.add_lines(&mut motion);
        let n = (scene.bodies.len() * N_POSE).max(1);
        #[allow(clippy::cast_precision_loss, reason = "numbers of bodies are far below 2^53")]
        let pictures = (MAX_NUMBERS / n as f64).clamp(1.0, MAX_PICTURES);
        let poses = (0..scene.bodies.len()).map(|b| BodyPose::new(scene, model, b)).collect();
        Self { poses, motion, every: duration / pictures, next: 0.0 }
    }

    /// Allocates memory for all frames of a run, so that no step allocates.
    pub fn reserve(&mut self, duration: f64) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of pictures"
        )]
        let n = (duration / self.every).clamp(0.0, MAX_PICTURES) as usize + 3;
        self.motion.poses.reserve(n * self.poses.len() * N_POSE);
        self.motion.times.reserve(n);
    }

    /// Writes the recorded frames to a checkpoint, or reads them from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.float(&mut self.next)?;
        tape.list(&mut self.motion.times, 8, Tape::float)?;
        tape.list(&mut self.motion.poses, 8, Tape::float)?;
        holds(self.motion.times.len() * self.poses.len() * N_POSE == self.motion.poses.len())
    }

    /// Records a frame if the time of the next frame is reached.
    pub fn offer(&mut self, t: f64, q: &[T], is_last: bool) {
        if !(t >= self.next || is_last) {
            return;
        }
        let n = self.poses.len() * N_POSE;
        for pose in &self.poses {
            let before = self.motion.poses.len().checked_sub(n);
            let before = before.map(|at| core::array::from_fn(|i| self.motion.poses[at + 3 + i]));
            let place = pose.place(q);
            self.motion.poses.extend(place);
            self.motion.poses.extend(pose.quaternion(q, before));
        }
        self.motion.times.push(t);
        self.next = ((t / self.every + EARLY).floor() + 1.0 - EARLY) * self.every;
    }

    /// Returns the recorded motion, completed by the road along the path of the tires.
    pub fn finish(self, scene: &Scene<T>) -> RecordedMotion {
        let mut motion = self.motion;
        motion.road = road::under(scene, &motion);
        motion
    }
}

fn body<T: Real>(name: &str, mass: T) -> DrawnBody {
    DrawnBody { name: name.to_owned(), mass: mass.to_f64() }
}
