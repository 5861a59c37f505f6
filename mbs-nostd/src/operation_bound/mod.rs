//! Bound of the number of operations of one step, computed from the structure of a model only.
//!
//! ```text
//! step         inputs + (E + 1) reach + E evaluation + P projection          E evaluations, P projections, σ further sweeps
//!              (+ inputs + evaluation where courses are written between steps, + 2 inputs + Σ links place + gaps of parts where there are lines)
//! evaluation   Σ links [place, inertia, eliminate, advance, (+ inward shift unless on the ground)]
//!              + Σ loops [rows, passes, elimination, opening, residual] + rotors + signals + effects [spread, forces ahead] + σ (response + residual)
//! response     Σ links [impulse, advance (+ shift)] + Σ loops [passes and eliminations of l alone, opening]
//! projection   Σ links place + Σ loops rows + 2 response + move
//! ```
//!
//! Counts are exact for mechanisms without effects and for mechanisms with springs and dampers only, because no branch of their code
//! depends on numbers. Other effects are counted by their most expensive branch. A road that is not level is counted with the longest
//! search for the nearest point. For such effects and roads the count is a bound.
//!
//! The counts contain products, sums and differences, quotients, square roots, and calls of sine with cosine or of the arc tangent. Changes
//! of sign, comparisons and copies are not counted. The instructions for them are included in the instructions for the counted operations
//! and for the table entries that are read.

mod couplings;
mod curves;
mod effects;
mod joints;
mod loops;
mod signals;

use crate::inputs::SignalLaw;
use crate::model::Model;
use mbs_core::Real;
pub use mbs_core::laws::operations::Operations;
use mbs_core::laws::operations::count;
use mbs_recursive::link::Link;
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::step::bounded::Bounds;

/// Number of table entries that are read in a step, in addition to the entries for links and loops [-]. Counted for a pendulum of two links
/// on a Cortex-M7, rounded up.
const STEP_ENTRIES: u64 = 8;
/// Number of table entries that are read for a link in an evaluation [-]. Counted for a pendulum of two links on a Cortex-M7, rounded up.
const LINK_ENTRIES: u64 = 8;

/// Returns the number of operations of one step within `bounds`.
///
/// Cost: linear in the size of the tables.
#[must_use]
pub fn step<T: Real, S: Space<T>>(model: &Model<'_, T, S>, bounds: Bounds) -> Operations {
    let m = &model.mechanism;
    let freedoms = count(m.n_freedoms);
    let has_loops = !m.loops.loops.is_empty();
    let evaluations = u64::from(bounds.evaluations.max(1));
    // h² β and h γ, and the time at the end of the step, which is computed for the inputs and for the state
    let mut total = Operations::new(3, 2) + effects::inputs(&model.prescriptions);
    total += Operations::entries(STEP_ENTRIES);
    let reach = Operations::new(7, 6) * freedoms + moves::<T, S>(m.links);
    total += reach * (evaluations + 1);
    // Operations for the largest change of an acceleration, and for its scale.
    let mut evaluation = Operations::new(1, freedoms);
    for link in skip_ground(m.links) {
        evaluation += joints::evaluation::<T, S>(link) + Operations::entries(LINK_ENTRIES);
    }
    evaluation += Operations::new(0, count(m.rotors.len()));
    evaluation += signals::evaluation(m);
    if !m.loads.is_empty() {
        for link in skip_ground(m.links) {
            evaluation += joints::spread::<T, S>(link.kind);
        }
        for load in m.loads {
            evaluation += effects::load(m, load);
        }
    }
    if has_loops {
        let residual = loops::residual(m);
        let answer = response(m)
            + Operations::new(
                0,
                count(S::Motion::N * m.links.len() + m.n_freedoms + m.loops.rows.len()),
            );
        evaluation += loops::rows(m) + loops::evaluation(m) + residual;
        evaluation += (residual + answer) * u64::from(bounds.sweeps);
        let mut projection = loops::rows(m) + response(m) * 2 + moves::<T, S>(m.links);
        projection += places::<T, S>(m.links);
        projection += Operations::new(0, freedoms);
        total += projection * u64::from(bounds.projections);
    }
    let ends = [effects::inputs(&model.prescriptions), places::<T, S>(m.links)];
    total += couplings::collapse(m, ends);
    let written = |course: &SignalLaw<T>| matches!(course, SignalLaw::Input(_));
    if model.prescriptions.courses.iter().any(written) {
        // A step begins with an evaluation if a signal was set before.
        total += evaluation + effects::inputs(&model.prescriptions);
    }
    total + evaluation * evaluations
}

fn skip_ground<T: Real, S: Space<T>>(links: &[Link<T, S>]) -> impl Iterator<Item = &Link<T, S>> {
    links.iter().skip(1)
}

/// Operations for places and velocities of all links.
fn places<T: Real, S: Space<T>>(links: &[Link<T, S>]) -> Operations {
    let mut sum = Operations::NONE;
    for link in skip_ground(links) {
        sum += joints::place::<T, S>(link.kind);
    }
    sum
}

/// Operations to move all coordinates along the freedoms.
fn moves<T: Real, S: Space<T>>(links: &[Link<T, S>]) -> Operations {
    let mut sum = Operations::NONE;
    for link in skip_ground(links) {
        sum += joints::moved::<T, S>(link.kind);
    }
    sum
}

/// Operations for a response of the tree to new right-hand sides of rows only.
fn response<T: Real, S: Space<T>>(
    m: &mbs_recursive::passes::slices::TreeSlices<'_, T, S>,
) -> Operations {
    let mut sum = loops::response(m);
    for link in skip_ground(m.links) {
        sum += joints::response::<T, S>(link);
    }
    sum
}
