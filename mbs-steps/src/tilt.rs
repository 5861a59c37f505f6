//! Axes that are almost parallel or almost perpendicular to another axis. Such an axis causes a note, or an error if its tilt locks a
//! closed loop.

use crate::loop_alone::loops_alone;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::once::found;
use mbs_core::scene::align::{DOUBTFUL, FIVE_DIGITS, MEANT, Tilt, align, tilts};
use mbs_core::scene::{Dimension, Scene};
use mbs_core::start::constraint_rank;
use mbs_core::{Cliques, Real, instances};
use mbs_scene::format::{counted, few};
use std::borrow::Cow;

/// Axis of a joint with a small tilt that locks a closed loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AlmostDependent {
    /// The joint with the tilted axis, and the joint to whose axis it should be parallel or perpendicular.
    pub joints: [usize; 2],
    /// Angle of the tilt [rad].
    pub angle: f64,
    /// Unit vector of the axis without the tilt. With this axis the scene is correct.
    pub axis: [f64; 3],
}

impl AlmostDependent {
    fn new<T: Real>(tilt: &Tilt<T>) -> Self {
        let (joints, axis) = ([tilt.joint, tilt.other], tilt.to.map(T::to_f64));
        Self { joints, angle: tilt.angle.to_f64(), axis }
    }
}

impl core::fmt::Display for AlmostDependent {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let axis = self.axis.map(|x| (x + 0.0).to_string()).join(", ");
        write!(
            f,
            "the axis is off by {} rad, and this alone holds its loop: with the axis [{axis}] it moves",
            few(self.angle)
        )
    }
}

/// Notes on axes with a small tilt: all axes that are treated as exactly parallel or perpendicular, and one axis whose tilt removes
/// freedoms.
pub fn notes<T: Real>(scene: &Scene<T>) -> Vec<(usize, String)> {
    if T::HAS_INSTANCES {
        return found::<Notes<T>>(NOTES)(scene);
    }
    notes_here(scene)
}

type Notes<T> = fn(&Scene<T>) -> Vec<(usize, String)>;
instances!(NOTES: Notes<T> = notes_here::<T>, {});

fn notes_here<T: Real>(scene: &Scene<T>) -> Vec<(usize, String)> {
    let note = |tilt: &Tilt<T>| {
        let [joint, other] = [tilt.joint, tilt.other].map(|j| &scene.joints[j].name);
        let angle = few(tilt.angle.to_f64());
        let text = format!(
            "the axis of joint `{joint}` is off by {angle} rad from the direction that joint `{other}` gives: it is taken without the tilt"
        );
        (tilt.joint, text)
    };
    tilts(scene, T::from_f64(MEANT)).iter().map(note).chain(binding_note(scene)).collect()
}

/// Returns the scene as natural coordinates use it, and the tilts in closed loops that cannot move with the tilt. The tilts are an argument
/// of [`lock`].
///
/// A tilt of at most 1e-5 rad that removes freedoms of a loop is ignored, if the loop can still move with it. In such a configuration
/// even a tiny tilt changes the motion by more than its own size. Cost: the search for tilts. If there are tilts, the ranks of the
/// constraints for some variants of the scene are computed too.
pub(crate) fn meant<T: Real, const D: usize>(
    scene: &Scene<T>,
) -> (Cow<'_, Scene<T>>, Vec<Tilt<T>>) {
    let [locks, mut others] = doubtful::<T, D>(scene);
    let is_spatial = scene.dimension == Dimension::Spatial;
    others.retain(|tilt| is_spatial && tilt.angle <= T::from_f64(FIVE_DIGITS));
    let meant = match binding::<T, D>(scene, &others) {
        Some(_) => Cow::Owned(align(scene, &others)),
        None => Cow::Borrowed(scene),
    };
    (meant, locks)
}

/// Returns the axis whose tilt locks closed loops in the reference configuration. `scene` and `locks` are the results of [`meant`]. Cost:
/// nothing without such tilts, else the ranks of the constraints for some variants of the scene.
pub(crate) fn lock<T: Real, const D: usize>(
    scene: &Scene<T>,
    locks: &[Tilt<T>],
) -> Option<AlmostDependent> {
    binding::<T, D>(scene, locks).map(|(tilt, _)| AlmostDependent::new(&tilt))
}

/// Tilts that are too large to be ignored, but small enough to be errors of the file. The first list has the tilts in loops that cannot
/// move with the tilt. The second list has all other tilts.
fn doubtful<T: Real, const D: usize>(scene: &Scene<T>) -> [Vec<Tilt<T>>; 2] {
    let mut tilts = tilts(scene, T::from_f64(DOUBTFUL));
    tilts.retain(|tilt| tilt.angle > T::from_f64(MEANT));
    let is_lock = |tilt: &Tilt<T>| freedoms::<T, D>(&loops_alone(scene, tilt.joint)) == Some(0);
    let (locks, others) = tilts.into_iter().partition(is_lock);
    [locks, others]
}

/// Returns the tilt whose removal gives the mechanism more freedoms, and the number of these freedoms. If no single removal gives more
/// freedoms, but the removal of all tilts does, it returns the first tilt.
fn binding<T: Real, const D: usize>(
    scene: &Scene<T>,
    tilts: &[Tilt<T>],
) -> Option<(Tilt<T>, usize)> {
    let first = tilts.first()?;
    let now = freedoms::<T, D>(scene)?;
    let more = |tilts: &[Tilt<T>]| {
        let straight = freedoms::<T, D>(&align(scene, tilts));
        straight.and_then(|straight| straight.checked_sub(now)).filter(|more| *more > 0)
    };
    let all = more(tilts)?;
    let one = tilts.iter().find_map(|tilt| Some((*tilt, more(&[*tilt])?)));
    Some(one.unwrap_or((*first, all)))
}

/// Note on a tilt that removes freedoms. The note says whether natural coordinates ignore the tilt.
fn binding_note<T: Real>(scene: &Scene<T>) -> Option<(usize, String)> {
    if scene.dimension != Dimension::Spatial {
        return None;
    }
    let [_, others] = doubtful::<T, 3>(scene);
    let (tilt, freedoms) = binding::<T, 3>(scene, &others)?;
    let AlmostDependent { joints, angle, axis } = AlmostDependent::new(&tilt);
    let [joint, other] = joints.map(|j| &scene.joints[j].name);
    let axis = axis.map(|x| (x + 0.0).to_string()).join(", ");
    let outcome = if angle <= FIVE_DIGITS {
        "natural coordinates take it without the tilt".to_owned()
    } else {
        format!("with the axis [{axis}] it does not")
    };
    let text = format!(
        "the axis of joint `{joint}` is off by {} rad from the direction that joint `{other}` gives, and takes {} for it at the start: {outcome}",
        few(angle),
        counted(freedoms, "freedom")
    );
    Some((tilt.joint, text))
}

/// Number of freedoms in the reference configuration.
fn freedoms<T: Real, const D: usize>(scene: &Scene<T>) -> Option<usize> {
    let model = NaturalModel::<T, D>::new(scene).ok()?;
    let mut terms = model.terms();
    let start = State::at_rest(&model);
    model.set_inputs(start.t, &start, &mut terms);
    model.evaluate(&start.q, &mut terms);
    Some(model.n_unknowns() - constraint_rank(&model, &terms))
}
