//! Forces of couplings at the points where they act: of a thread between screw and nut, of a rope at the rim of its drum.
//!
//! ```text
//! thread   F along the axis and -M about it on the nut, at the screw's axis; -F and M on the screw
//! drum     T along the line, on the drum at the point where the line leaves the drum's carrier; a couple adds the rest of the moment radius T
//! ```
//!
//! F and M are force and moment of the thread, T is the tension of the rope. These forces do not change the motion, since the work of the
//! coupling along its coordinates is the same. They load the bearings.

use super::coordinate::Coordinate;
use super::wrench::{Applied, Wrench};
use crate::Real;
use crate::algebra::{Vector, cross, raised};
use crate::mechanism::{Acting, Scene};
use crate::model::State;
use crate::natural::{Affine, NaturalModel};
use crate::scene::{BodyId, Coupling};

/// Force of a coupling that acts at a point, and not only along the coordinates.
#[derive(Debug, Clone)]
pub(super) enum DrawnForce<T: Real, const D: usize> {
    /// Force of a thread between screw and nut.
    Thread {
        /// Bodies of the nut and the screw, in this order.
        bodies: [BodyId; 2],
        /// Axis of the screw, with a point on it.
        turn: (Coordinate<T, D>, Affine<T, D>),
        slide: Coordinate<T, D>,
        /// Force on the nut along the slide, and moment on the screw about its axis, for an effort of one.
        weights: [T; 2],
    },
    /// Force of a rope at its drum.
    Drum {
        drum: BodyId,
        carrier: BodyId,
        is_end: bool,
        turn: (Coordinate<T, D>, Affine<T, D>),
        /// Generalised force on the line's length, and moment on the drum about its axis, for an effort of one.
        weights: [T; 2],
    },
}

impl<T: Real, const D: usize> DrawnForce<T, D> {
    /// Force of a coupling in a checked scene. `None`: the coupling acts along its coordinates only.
    pub(super) fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        coupling: &Coupling<T>,
    ) -> Option<Self> {
        // Returns the body other than the carrier, and the coordinate of the term with its point on the carrier. The last value is the
        // factor, with the sign for the motion of this body.
        let part = |term: usize, carrier: BodyId| {
            let of = coupling.terms[term].of.coordinate()?;
            let bodies = scene.joints[of.0.index()].bodies;
            let (body, sign) =
                if bodies[0] == carrier { (bodies[1], T::ONE) } else { (bodies[0], -T::ONE) };
            let axis = Coordinate::carried((scene, model), of, carrier)?;
            Some((body, axis, coupling.terms[term].factor * sign))
        };
        match Acting::of(scene, coupling)? {
            Acting::Thread { carrier } => {
                let (nut, (slide, _), force) = part(0, carrier)?;
                let (screw, turn, moment) = part(1, carrier)?;
                Some(Self::Thread { bodies: [nut, screw], turn, slide, weights: [force, moment] })
            }
            Acting::Drum { is_end, carrier } => {
                let (drum, turn, moment) = part(1, carrier)?;
                let weights = [coupling.terms[0].factor, moment];
                Some(Self::Drum { drum, carrier, is_end, turn, weights })
            }
        }
    }

    /// Generalised force on the line's length; `None` for a thread. For a drum the caller passes the parts of the line one after the other
    /// to [`moved`](Self::moved).
    pub(super) fn on_line(&self, effort: T) -> Option<T> {
        match self {
            Self::Thread { .. } => None,
            Self::Drum { weights, .. } => Some(weights[0] * effort),
        }
    }

    /// Moves a force on the line from the carrier to the drum if its point is at the rim. The moment of the force about the drum's axis is
    /// added to `about`. `end` is the index of the end point among the end points of the line's parts, `ends` the number of these points.
    pub(super) fn moved(
        &self,
        (end, ends): (usize, usize),
        (body, at, wrench): Applied<T>,
        (state, about): (&State<T>, &mut T),
    ) -> Applied<T> {
        let Self::Drum { drum, is_end, turn: (axis, place), .. } = self else {
            return (body, at, wrench);
        };
        let is_rim = end == if *is_end { ends - 1 } else { 0 };
        let (true, Some(rim)) = (is_rim, at) else { return (body, at, wrench) };
        let way = rim - raised(&place.value(&state.q));
        *about += axis.direction(&state.q).moment.dot(&cross(&way, &wrench.force));
        (*drum, at, wrench)
    }

    /// Passes to `take` the wrenches besides those of the line. `about` is the moment of the line's force about the drum's axis.
    pub(super) fn apply(
        &self,
        (effort, about): (T, T),
        state: &State<T>,
        take: &mut dyn FnMut(Applied<T>),
    ) {
        match self {
            Self::Thread { bodies: [nut, screw], turn: (axis, place), slide, weights } => {
                let at = raised(&place.value(&state.q));
                let wrench = Wrench {
                    force: slide.direction(&state.q).force * (weights[0] * effort),
                    moment: axis.direction(&state.q).moment * (-weights[1] * effort),
                };
                take((*nut, Some(at), wrench));
                take((*screw, Some(at), wrench.scaled(-T::ONE)));
            }
            Self::Drum { drum, carrier, turn: (axis, _), weights, .. } => {
                let moment = axis.direction(&state.q).moment * (weights[1] * effort - about);
                let wrench = Wrench { force: Vector::zeros(), moment };
                take((*drum, None, wrench));
                take((*carrier, None, wrench.scaled(-T::ONE)));
            }
        }
    }
}
