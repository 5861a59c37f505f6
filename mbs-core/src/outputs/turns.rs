//! Check whether the positions of joints at the end of a step determine their rotation in the step.
//!
//! ```text
//! expected   h (rate_n + rate_(n+1)) / 2
//! ```
//!
//! h is the step. Positions determine an angle up to whole turns. If the rotation in a step is below half a turn, the nearest value is
//! correct. Otherwise the correct value is the one nearest to the value expected from the rates. Above a third of a radian, rotations by
//! positions and by rates must agree within one percent; otherwise the integration rule does not resolve the rotation.

use super::coordinate::Coordinate;
use crate::Real;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::step::StepError;
use alloc::vec::Vec;

/// Angles of the joints of a scene.
#[derive(Debug, Clone)]
pub struct Turns<T: Real, const D: usize> {
    angles: Vec<(u32, Coordinate<T, D>)>,
}

impl<T: Real, const D: usize> Turns<T, D> {
    /// Angles of all joints that turn about an axis.
    #[must_use]
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Self {
        let angles = scene.joints.iter().enumerate().flat_map(|(i, joint)| {
            let number = u32::try_from(i).unwrap_or(u32::MAX);
            let all = Coordinate::of_joint(scene, model, joint).into_iter();
            all.filter(Coordinate::is_angle).map(move |angle| (number, angle))
        });
        Self { angles: angles.collect() }
    }

    /// Checks whether turns are lost between the states before and after a step.
    ///
    /// Cost: two rates for each angle; no allocation.
    ///
    /// # Errors
    /// [`StepError::TurnTooLarge`] with the first joint concerned.
    pub fn check(&self, states: [&State<T>; 2]) -> Result<(), StepError> {
        for (joint, angle) in &self.angles {
            if let Some(turn) = angle.lost_turn(states) {
                return Err(StepError::TurnTooLarge { joint: *joint, turn: turn.to_f64() });
            }
        }
        Ok(())
    }
}
