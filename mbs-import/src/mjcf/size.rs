//! Size factors of elements in frames with a `scale`.
//!
//! Lengths are multiplied by s, masses by s³ or by `massscale`. With the scaling `similar`, forces are multiplied by m s and moments by m
//! s².

use super::compiler::{SAVED, word};
use crate::element::{Attribute, Element};
use crate::inertia::Mass;
use crate::pose::{Pose, V3};
use crate::robot::{Form, FormKind};
use crate::source::Read;

/// Factors of lengths and masses, and two factors from which the factors of forces are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Size {
    pub(super) length: f64,
    pub(super) mass: f64,
    force_length: f64,
    force_mass: f64,
}

impl Size {
    pub(super) const ONE: Self =
        Self { length: 1.0, mass: 1.0, force_length: 1.0, force_mass: 1.0 };

    /// Returns the size factors inside the element `frame`, given the factors outside of it.
    pub(super) fn of_frame(self, frame: &Element) -> Read<Self> {
        let length = frame.attribute("scale").map(scale).transpose()?;
        let scaling = frame.attribute("scaling");
        let is_similar = scaling.map_or(Ok(0), |by| word(by, &["similar", "geometry"]))? == 0;
        let written = frame.attribute("massscale").map(|mass| factor(mass, mass.number()?));
        let length = length.unwrap_or(1.0);
        let mass = written.transpose()?.unwrap_or(length.powi(3));
        let [force_length, force_mass] = if is_similar { [length, mass] } else { [1.0; 2] };
        Ok(Self {
            length: self.length * length,
            mass: self.mass * mass,
            force_length: self.force_length * force_length,
            force_mass: self.force_mass * force_mass,
        })
    }

    /// A pose within a frame, with its position scaled.
    pub(super) fn pose(&self, pose: Pose) -> Pose {
        Pose { at: pose.at * self.length, ..pose }
    }

    /// A mass in global axes, scaled about a place.
    pub(super) fn of_mass(&self, mass: &Mass, about: &V3) -> Mass {
        if *self == Self::ONE {
            return *mass;
        }
        Mass {
            mass: mass.mass * self.mass,
            center: about + (mass.center - about) * self.length,
            tensor: mass.tensor * (self.mass * self.length * self.length),
        }
    }

    /// Scales a shape about a place.
    pub(super) fn grow(&self, form: &mut Form, about: &V3) {
        if *self == Self::ONE {
            return;
        }
        form.pose.at = about + (form.pose.at - about) * self.length;
        match &mut form.kind {
            FormKind::Box(size) | FormKind::Mesh { scale: size, .. } => {
                size.iter_mut().for_each(|x| *x *= self.length);
            }
            FormKind::Sphere { radius } => *radius *= self.length,
            FormKind::Capsule { radius, length } | FormKind::Cylinder { radius, length } => {
                *radius *= self.length;
                *length *= self.length;
            }
        }
    }

    /// Factor of moments, and of moments per angle or angular rate.
    pub(super) const fn moment(&self) -> f64 {
        self.force_mass * self.force_length * self.force_length
    }

    /// Factor of forces in the frame [-].
    pub(super) const fn force(&self) -> f64 {
        self.force_mass * self.force_length
    }

    /// Factor of a force coefficient that multiplies a power of a length or of its rate.
    pub(super) fn force_by(&self, power: i32) -> f64 {
        self.force() / self.force_length.powi(power)
    }
}

/// Reads a scale factor of lengths, which must be equal along all axes.
fn scale(word: &Attribute) -> Read<f64> {
    let list = word.list()?;
    match list[..] {
        [all] => factor(word, all),
        [x, y, z] if x == y && y == z => factor(word, x),
        _ => Err(word.fault("a frame that is stretched along its axes is not read", SAVED)),
    }
}

fn factor(word: &Attribute, x: f64) -> Read<f64> {
    if x > 0.0 {
        return Ok(x);
    }
    let message = format!("`{}` is not above zero", word.name);
    Err(word.fault(message, "write a factor above zero"))
}
