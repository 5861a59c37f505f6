//! Whether the joints' positions at the end of a step determine how far they have turned in it.
//!
//! ```text
//! expected   h (rate_n + rate_(n+1)) / 2
//! ```
//!
//! An angle of a position is known but for whole turns. Within half a turn a step the nearest value is the right one; beyond, that which the
//! rates lead to. Beyond a third of a radian the positions of a step must fit the rates to a hundredth: else the rule does not resolve the turn.

use super::coordinate::Coordinate;
use crate::Real;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::step::StepError;
use alloc::vec::Vec;

/// The angles of a scene's joints.
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

    /// Looks whether turns are lost between the states before and after a step.
    ///
    /// Cost: two rates for each angle; no allocation.
    ///
    /// # Errors
    /// [`StepError::TurnTooLarge`] names the first joint.
    pub fn check(&self, states: [&State<T>; 2]) -> Result<(), StepError> {
        for (joint, angle) in &self.angles {
            if let Some(turn) = angle.lost_turn(states) {
                return Err(StepError::TurnTooLarge { joint: *joint, turn: turn.to_f64() });
            }
        }
        Ok(())
    }
}
