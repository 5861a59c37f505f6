//! The static equilibrium that Newton's method finds from a state, stable or unstable, in independent coordinates.
//!
//! ```text
//! K_r d = z'',   q <- q + x B d, closed,   x = 1, 1/2, 1/4, ...   until |K_r^-1 z''(q)| <= (1 - x/4) |d|
//! ```
//!
//! K_r is computed by differences of the equations of motion, as in [`linearise`](crate::linearise). The effects' tangents cannot replace
//! it: they leave out terms that would make the matrix of a step indefinite, and unstable equilibria depend on these terms. The test of a
//! step uses the inverse of K_r at its start (P. Deuflhard, Numer. Math. 22, 1974). So the test depends on no unit.
//!
//! Directions without stiffness keep their position where no force acts. A force moves them by at most a fifth of the scene's size in a
//! step, until a stop prevents further motion.

use crate::equilibrium::{Equilibrium, Search};
use crate::error::{EquilibriumError, LinearError};
use crate::linearise::{Field, Instant};
use crate::options::{LinearOptions, Options};
use crate::pivoted::Pivoted;
use crate::workspace::Workspace;
use alloc::vec::Vec;
use mbs_core::model::{Model, State};
use mbs_core::{Real, SymmetricSolver};

/// Longest step, in sizes of coordinates [-]. A longer one would rotate bodies and change the stiffness. Chosen, not tuned.
const LONGEST: f64 = 0.2;
/// Stiffness that is assumed for a direction without any, in units of its rounding error [-]. A real force then gives a long step, and a
/// rounding error gives a step of 1e-9 of the scene's size.
const NOISE: f64 = 1e4;
/// Largest number of halvings of a step before the search ends [-]. Chosen, not tuned.
const HALVINGS: u32 = 40;
/// Longest step that counts as rounding error, in units of EPSILON times the scene's size [-]. Chosen, not tuned.
const NOWHERE: f64 = 64.0;
/// A step x d, a fraction x of the full step d, is accepted if the next step is shorter than d by at least this fraction of x d [-].
/// Chosen, not tuned.
const PROGRESS: f64 = 0.25;

/// Moves `s` to the static equilibrium that Newton's method finds from it, stable or not.
///
/// The state is written as by [`equilibrium`](crate::equilibrium()).
///
/// Cost: 4 f + 2 factorisations for each of about five steps, where f is the number of freedoms. Allocates.
///
/// # Errors
/// [`EquilibriumError`]; the state is then unchanged.
pub fn equilibrium_near<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<Equilibrium<T>, EquilibriumError> {
    options.validate()?;
    let mut there = s.clone();
    let (mut iterations, mut size) = (0, T::ONE);
    while size > T::EPSILON * T::from_f64(NOWHERE) {
        if iterations > options.max_factorizations / 4 {
            return Err(EquilibriumError::NotNear);
        }
        (there.q, there.memory, size) = newton(model, &there, w)?;
        iterations += 1;
    }
    let mut search = Search::new(model, &there, w);
    search.begin()?;
    search.check_balance(options)?;
    let found = search.finish(&s.q, &mut there);
    *s = there;
    Ok(Equilibrium { iterations, ..found })
}

/// Makes one step from a state. Returns positions and measured angles at its end, and its size.
fn newton<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<(Vec<T>, Vec<T>, T), EquilibriumError> {
    let mut field = Field::new(model, Instant::Rest, s, w).map_err(failed)?;
    let acceleration = field.at_rest_of(&s.v).map_err(failed)?;
    let (q, mut memory) = (field.q.clone(), s.memory.clone());
    let reach = LinearOptions::default().step;
    let stiffness = field.by_places(reach).map_err(failed)?.forces;
    let noise = field.noise(&stiffness);
    let matrix = Pivoted::new(acceleration.len(), stiffness, noise * T::from_f64(NOISE));
    let mut way = matrix.solve(&acceleration);
    let size = field.extent(&way);
    if !(size > T::EPSILON.sqrt()) {
        // The last step is accepted without a test, because with rounding errors the next step may not be shorter.
        field.displaced(&way).map_err(failed)?;
        model.remember(&field.q, &field.w.terms, &mut memory);
        return Ok((if size.is_finite() { field.q } else { q }, memory, T::ZERO));
    }
    let mut ratio = (T::from_f64(LONGEST) / size).min(T::ONE);
    for _ in 0..HALVINGS {
        let part: Vec<T> = way.iter().map(|&z| z * ratio).collect();
        if let Ok(left) = field.displaced(&part) {
            let next = field.extent(&matrix.solve(&left));
            if next <= size * (T::ONE - ratio * T::from_f64(PROGRESS)) {
                way = part;
                model.remember(&field.q, &field.w.terms, &mut memory);
                let size = field.extent(&way);
                return Ok((field.q, memory, size));
            }
        }
        ratio *= T::HALF;
    }
    Err(EquilibriumError::NotNear)
}

pub(crate) fn failed(error: LinearError) -> EquilibriumError {
    match error {
        LinearError::NoInertia { unknown } => EquilibriumError::Undetermined { unknown },
        LinearError::NotFinite => EquilibriumError::NotFinite { unknown: 0 },
        _ => EquilibriumError::NotNear,
    }
}
