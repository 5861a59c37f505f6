//! Inputs and outputs of a linearisation.
//!
//! ```text
//! z'' = f(z, z', x, u),   x' = g(z, z', x, u),   y = h(z, z', x, u)
//! d/dt (z, z', x) = A (z, z', x) + B u,   y = C (z, z', x) + D u:   B = [0; df/du; dg/du],  C = dh/d(z, z', x),  D = dh/du
//! ```
//!
//! Derivatives are differences of fourth order, as those of A. A change of a guide's value moves the constraints. Then positions are closed
//! again without a change of z, then velocities, then accelerations. The rate and the acceleration of a guide are separate inputs.

use crate::error::LinearError;
use crate::linear::Linear;
use crate::linearise::{Field, Instant, difference};
use crate::options::LinearOptions;
use crate::watch::{OutputMeasure, Watch};
use crate::workspace::Workspace;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use mbs_core::model::{Model, State};
use mbs_core::{Real, SymmetricSolver};

/// Inputs and outputs that a linearisation includes.
pub struct Ports<'a, T> {
    /// The index of each input among [`State::inputs`]: see [`Prescribed`](mbs_core::inputs::Prescribed).
    pub inputs: &'a [usize],
    /// Measure of the outputs; it must always return the same number of values.
    pub outputs: &'a mut OutputMeasure<'a, T>,
    /// Coordinates x that replace z. The function gets dy/dz (p x f) and returns dx/dz (f x f), both column by column. It returns `None`
    /// where the outputs do not determine z. Without this function the coordinates are z.
    ///
    /// With it, derivatives are differences along x itself. This matters where a change of one x has a small effect. A difference along
    /// several z would then lose digits, because their large effects nearly cancel.
    pub coordinates: Option<&'a mut CoordinateChoice<'a, T>>,
}

/// Function that chooses coordinates from the derivatives of outputs: see [`Ports::coordinates`].
pub type CoordinateChoice<'a, T> = dyn FnMut(&[T]) -> Option<Vec<T>> + 'a;

impl<T> fmt::Debug for Ports<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ports").field("inputs", &self.inputs).finish_non_exhaustive()
    }
}

/// Matrices of the inputs u and the outputs y of a linearised motion, stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearPorts<T> {
    /// Number of inputs m.
    pub n_inputs: usize,
    /// Values of the outputs at the state, p numbers.
    pub values: Vec<T>,
    /// Derivatives d(z'', x')/du, (f + s) x m for s states x of signals.
    pub forces: Vec<T>,
    /// Derivatives dy/d(z, z', x), p x (2 f + s).
    pub outputs: Vec<T>,
    /// Feedthrough dy/du, p x m.
    pub feedthrough: Vec<T>,
}

impl<T: Real> LinearPorts<T> {
    /// Matrix B of d/dt (z, z', x) = A (z, z', x) + B u, (2 f + s) x m, for a motion with `n_freedoms`, column by column.
    #[must_use]
    pub fn input_matrix(&self, n_freedoms: usize) -> Vec<T> {
        let rows = self.forces.len() / self.n_inputs.max(1);
        let mut b = Vec::with_capacity((n_freedoms + rows) * self.n_inputs);
        for column in self.forces.chunks_exact(rows.max(1)) {
            b.resize(b.len() + n_freedoms, T::ZERO);
            b.extend_from_slice(column);
        }
        b
    }
}

/// Linearises as [`linearise`](crate::linearise()) does, with inputs and outputs.
///
/// With [`coordinates`](Ports::coordinates), z means the chosen coordinates in all results; the inertia is then not the unit matrix.
///
/// At [`Instant::Rest`] rates and accelerations of guides are zero at the state, and derivatives with respect to them are taken there.
///
/// Cost: that of [`linearise`](crate::linearise()) with a measurement at each evaluation, and 6 evaluations for each input. An input that
/// moves a guide adds 5 factorisations. Chosen coordinates add 4 f factorisations for f freedoms. Allocates.
///
/// # Errors
/// Errors of [`linearise`](crate::linearise()) and of `ports.outputs`; [`LinearError::Singular`] where no coordinates are chosen.
/// [`LinearError::NotClosed`] where a guide's value cannot be changed, because joints also fix the guided coordinate.
///
/// # Panics
/// If an index is not one of the state's inputs.
pub fn linearise_ports<'a, T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &'a M,
    how: (Instant, &LinearOptions<T>),
    s: &'a State<T>,
    w: &'a mut Workspace<T, S>,
    ports: Ports<'a, T>,
) -> Result<(Linear<T>, LinearPorts<T>), LinearError> {
    let (places, reach) = (ports.inputs, how.1.step);
    let mut field = Field::checked(model, how, s, w)?;
    field.watch = Some(Watch::new(ports.outputs, s));
    if let Some(choose) = ports.coordinates {
        let slopes = field.by_places(reach)?.outputs;
        field.tangent.choose(choose(&slopes).ok_or(LinearError::Singular { freedom: 0 })?);
        field.return_to(&s.q)?;
    }
    let (linear, [values, outputs]) = field.linear(reach)?;
    let [forces, feedthrough] = field.by_inputs(how.0, places, reach)?;
    let n_inputs = places.len();
    let linear = Linear { basis: field.tangent.basis, ..linear };
    Ok((linear, LinearPorts { n_inputs, values, forces, outputs, feedthrough }))
}

/// Largest factor that makes the difference of an input longer, if the input hardly moves the mechanism [-]. Chosen, not tuned.
const MOST_GROWTH: f64 = 1e4;

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'_, T, M, S> {
    /// Returns the derivatives of (z'', x') and of the outputs by the inputs at `places`.
    fn by_inputs(
        &mut self,
        instant: Instant,
        places: &[usize],
        reach: T,
    ) -> Result<[Vec<T>; 2], LinearError> {
        let rows = self.tangent.n_freedoms() + self.model.n_signal_states();
        let [mut forces, mut outputs] = [Vec::new(), Vec::new()];
        self.model.set_inputs(self.start.t, self.start, &mut self.w.terms);
        let held = self.w.terms.guides.clone();
        for &place in places {
            let none = [false; 3];
            let mut driven = Driven { place, instant, held: &held, changed: none, is_moved: false };
            let h = driven.difference(self, reach)?;
            let slope = difference(h, |change| {
                let answer = driven.acceleration(self, change)?;
                self.with_the_rest(answer)
            })?;
            // the next input starts from the state itself
            driven.acceleration(self, T::ZERO)?;
            forces.extend_from_slice(&slope[..rows]);
            outputs.extend_from_slice(&slope[rows..]);
        }
        Ok([forces, outputs])
    }
}

/// An input that is changed for a difference.
struct Driven<'a, T> {
    place: usize,
    instant: Instant,
    /// Values, rates and accelerations of the guides at the state.
    held: &'a [[T; 3]],
    /// Whether the input changes the value, the rate and the acceleration of a guide.
    changed: [bool; 3],
    /// True if the present positions are closed with a change of this input.
    is_moved: bool,
}

impl<T: Real> Driven<'_, T> {
    /// Sets the input to its value plus a change.
    fn set<M: Model<T>, S: SymmetricSolver<T>>(
        &mut self,
        field: &mut Field<'_, T, M, S>,
        change: T,
    ) {
        let mut s = field.start.clone();
        s.inputs[self.place] += change;
        let value = s.inputs[self.place];
        if let Some(watch) = &mut field.watch {
            watch.set_input(self.place, value);
        }
        field.model.set_inputs(s.t, &s, &mut field.w.terms);
        self.changed = [false; 3];
        for (guide, held) in field.w.terms.guides.iter_mut().zip(self.held) {
            for (k, changed) in self.changed.iter_mut().enumerate() {
                *changed |= guide[k] != held[k];
                if k > 0 && self.instant == Instant::Rest {
                    guide[k] -= held[k];
                }
            }
        }
    }

    /// Returns z'' with the input changed, at unchanged z and z'.
    fn acceleration<M: Model<T>, S: SymmetricSolver<T>>(
        &mut self,
        field: &mut Field<'_, T, M, S>,
        change: T,
    ) -> Result<Vec<T>, LinearError> {
        self.set(field, change);
        let [moves, ..] = self.changed;
        if moves || self.is_moved {
            field.return_to(&field.start.q)?;
        }
        self.is_moved = moves;
        field.acceleration_at_start()
    }

    /// Returns the length of the input's difference that moves coordinates, velocities or accelerations by `reach` of their sizes.
    fn difference<M: Model<T>, S: SymmetricSolver<T>>(
        &mut self,
        field: &mut Field<'_, T, M, S>,
        reach: T,
    ) -> Result<T, LinearError> {
        let h = reach * (T::ONE + field.start.inputs[self.place].abs());
        let motion = |field: &Field<'_, T, M, S>| [&field.q, &field.v, &field.a].map(Vec::clone);
        self.acceleration(field, T::ZERO)?;
        let before = motion(field);
        self.acceleration(field, h)?;
        let mut moved = [T::ZERO; 3];
        for ((moved, after), before) in moved.iter_mut().zip(motion(field)).zip(&before) {
            let mut way = vec![T::ZERO; field.w.n];
            for (way, (&x, &from)) in way.iter_mut().zip(after.iter().zip(before)) {
                *way = x - from;
            }
            *moved = field.w.extent(&way);
        }
        let [moves, hurries, _] = self.changed;
        let rounding = T::EPSILON.sqrt() * reach;
        let ratio = match moved {
            [way, ..] if moves && way > rounding => reach / way,
            [_, speed, _] if hurries && speed > rounding => reach / speed,
            [.., push] if push > T::ZERO => {
                (reach * field.lively / push).max(T::ONE).min(T::from_f64(MOST_GROWTH))
            }
            _ => T::ONE,
        };
        Ok(h * ratio)
    }
}
