//! Forces of a belt's strands on its wheels.
//!
//! ```text
//! F = w1/r1               difference of the strands, w1: moment on the first wheel about its axis for an effort of one
//! S + F/2, S - F/2        pull of the strand that turns the first wheel about its axis, and of the other;  S: pretension
//! ```
//!
//! The pretension S has no moment about the axes. It changes the loads of bearings, but neither the motion nor the effort.

use super::coordinate::Coordinate;
use super::wrench::{Applied, Wrench};
use crate::Real;
use crate::algebra::{Vector, raised};
use crate::mechanism::{Scene, Strands};
use crate::model::State;
use crate::natural::{Affine, NaturalModel};
use crate::scene::{Coupling, CouplingKind};

/// Forces of the strands of a belt.
#[derive(Debug, Clone)]
pub(super) struct StrandForce<T: Real, const D: usize> {
    strands: Strands<T>,
    /// Coordinate of the first joint, which gives the axis. Then the points of both joints on the body that carries the wheels.
    axis: Coordinate<T, D>,
    places: [Affine<T, D>; 2],
    /// Difference of the tensions for an effort of one.
    difference: T,
    pretension: T,
}

impl<T: Real, const D: usize> StrandForce<T, D> {
    /// Forces of a coupling in a checked scene; `None` if the coupling has no pretension.
    pub(super) fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        coupling: &Coupling<T>,
    ) -> Option<Self> {
        let CouplingKind::Strands { pretension } = coupling.kind else { return None };
        let strands = Strands::new(scene, coupling).ok()?;
        let carrier = strands.wheels.carrier;
        let part = |term: usize| {
            let of = coupling.terms[term].of.coordinate()?;
            Coordinate::carried((scene, model), of, carrier)
        };
        let ((axis, first), (_, second)) = (part(0)?, part(1)?);
        let moment = strands.wheels.moments[0];
        let difference = moment / moment.abs();
        Some(Self { strands, axis, places: [first, second], difference, pretension })
    }

    /// Passes to `take` the wrenches that turn the wheels at an effort.
    pub(super) fn apply(&self, effort: T, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        let half = self.difference * effort * T::HALF;
        self.hand_out(state, |is_about| if is_about { half } else { -half }, take);
    }

    /// Passes to `take` the forces that pull the wheels together.
    pub(super) fn draw_together(&self, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        if !self.pretension.is_zero() {
            self.hand_out(state, |_| self.pretension, take);
        }
    }

    /// Passes to `take` the tensions of both strands on the first wheel, and the opposite forces on the second.
    fn hand_out(
        &self,
        state: &State<T>,
        pull: impl Fn(bool) -> T,
        take: &mut dyn FnMut(Applied<T>),
    ) {
        let n = self.axis.direction(&state.q).moment;
        let places = self.places.each_ref().map(|place| raised(&place.value(&state.q)));
        for strand in self.strands.at(&n, places) {
            let force = strand.along * pull(strand.is_about);
            let wrench = Wrench { force, moment: Vector::zeros() };
            let [first, second] = self.strands.wheels.wheels;
            take((first, Some(strand.ends[0]), wrench));
            take((second, Some(strand.ends[1]), wrench.scaled(-T::ONE)));
        }
    }
}
