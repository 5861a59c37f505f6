//! Loads: the sums of forces on each body, and the state from which they follow, bodies in their places at a time.

use crate::rows::{Frame, Places, Row};
use crate::scene::{Carrier, Scene};
use crate::vector::{Vector, cross};

/// Depth over which the damper of a bumper fades in [m or rad].
const FADE: f64 = 1e-3;

/// Forces on all bodies.
#[derive(Debug, Clone)]
pub(crate) struct Loads {
    /// Force and torque about the centre of mass.
    pub(crate) on: Vec<[f64; 6]>,
    /// Stored energy of gravity and springs [J].
    pub(crate) potential: f64,
    /// Power of all that is not stored [W].
    pub(crate) power: f64,
}

impl Loads {
    /// A force along a row that stores energy in part.
    pub(crate) fn along(&mut self, row: &Row, force: f64) {
        for (body, part) in &row.parts {
            if let Some(b) = body {
                self.on[*b].iter_mut().zip(part).for_each(|(f, p)| *f += force * p);
            }
        }
    }

    pub(crate) fn at_point(&mut self, body: Carrier, arm: Vector, force: Vector) {
        self.wrench(body, force, cross(arm, force));
    }

    pub(crate) fn wrench(&mut self, body: Carrier, force: Vector, torque: Vector) {
        if let Some(b) = body {
            for i in 0..3 {
                self.on[b][i] += force[i];
                self.on[b][i + 3] += torque[i];
            }
        }
    }
}

/// State that bodies are in: scene, places, frames, turns of joints, time.
#[derive(Debug)]
pub(crate) struct Now<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) places: &'a Places,
    pub(crate) frames: &'a [Frame],
    pub(crate) turns: &'a [[f64; 3]],
    pub(crate) t: f64,
    /// States of the signals.
    pub(crate) memory: &'a [f64],
}

/// max(0, k x + c ẋ s), s = 3 r² - 2 r³, r = min(1, x / 1 mm).
pub(crate) fn contact(k: f64, c: f64, x: f64, rate: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let r = (x / FADE).min(1.0);
    (k * x + c * rate * (3.0 * r * r - 2.0 * r * r * r)).max(0.0)
}
