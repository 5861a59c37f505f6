//! Loads: the sums of forces on each body. They follow from the places and velocities of bodies at a time.

use crate::rows::{Frame, Places, Row};
use crate::scene::{Carrier, Scene};
use crate::vector::{Vector, cross};

/// Depth over which the damper of a bumper fades in [m or rad]: given by the contract.
const FADE: f64 = 1e-3;

/// Forces on all bodies.
#[derive(Debug, Clone)]
pub(crate) struct Loads {
    /// Force and torque about the centre of mass.
    pub(crate) on: Vec<[f64; 6]>,
    /// Stored energy of gravity and springs [J].
    pub(crate) potential: f64,
    /// Power of all forces that have no potential [W].
    pub(crate) power: f64,
}

/// Numbers of an effect at a time, besides its forces on bodies.
#[derive(Debug, Clone, Default)]
pub(crate) struct Exerted {
    /// Row of the measured number, and the force that acts towards larger numbers.
    pub(crate) along: Option<(Row, f64)>,
    /// Force on the effect's body, and moment about the effect's point on it. If the effect has two bodies, this is the second.
    pub(crate) wrench: Option<[Vector; 2]>,
    /// Measured number less its free value, or the depth of the effect's contact.
    pub(crate) deflection: f64,
    /// Energy that the effect stores [J].
    pub(crate) stored: f64,
    /// Rate of the stored energy [W].
    pub(crate) stored_rate: f64,
    /// True if the effect is in contact.
    pub(crate) touches: bool,
}

impl Exerted {
    /// A force along a row.
    pub(crate) fn along(loads: &mut Loads, row: Row, force: f64) -> Self {
        loads.along(&row, force);
        Self { along: Some((row, force)), ..Self::default() }
    }

    /// A force and a moment on a body at a point, which is given by its arm from the centre of mass.
    pub(crate) fn on(loads: &mut Loads, body: Carrier, arm: Vector, wrench: [Vector; 2]) -> Self {
        let [force, moment] = wrench;
        loads.at_point(body, arm, force);
        loads.wrench(body, [0.0; 3], moment);
        Self { wrench: Some(wrench), ..Self::default() }
    }

    /// Adds the energy that a contact stores at a depth, and the rate of this energy.
    pub(crate) fn touching(self, stiffness: f64, depth: f64, rate: f64) -> Self {
        let x = depth.max(0.0);
        let (stored, stored_rate) = (0.5 * stiffness * x * x, stiffness * x * rate);
        Self { deflection: x, stored, stored_rate, touches: depth > 0.0, ..self }
    }
}

impl Loads {
    /// Zero forces on this number of bodies.
    pub(crate) fn none(n_bodies: usize) -> Self {
        Self { on: vec![[0.0; 6]; n_bodies], potential: 0.0, power: 0.0 }
    }

    /// Adds the forces, energy and power of other loads.
    pub(crate) fn add(&mut self, other: &Self) {
        for (to, more) in self.on.iter_mut().zip(&other.on) {
            to.iter_mut().zip(more).for_each(|(x, y)| *x += y);
        }
    }

    /// The power of the forces on bodies that move [W].
    pub(crate) fn power_on(&self, frames: &[Frame]) -> f64 {
        let of = |(f, frame): (&[f64; 6], &Frame)| {
            (0..3).map(|i| f[i] * frame.v[i] + f[i + 3] * frame.w[i]).sum::<f64>()
        };
        self.on.iter().zip(frames).map(of).sum()
    }

    /// Adds a force along a row: equal to force times gradient on each body.
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

/// State of the bodies: scene, places, frames, angles of joints, time.
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

/// Contact force max(0, k x + c ẋ s) at a depth x, with the stiffness k and the damping c. The factor s = 3 r² - 2 r³, with r = min(1, x /
/// 1 mm), lets the damping begin smoothly.
pub(crate) fn contact(k: f64, c: f64, x: f64, rate: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let r = (x / FADE).min(1.0);
    (k * x + c * rate * (3.0 * r * r - 2.0 * r * r * r)).max(0.0)
}
