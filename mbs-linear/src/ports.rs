//! Inputs and outputs of a linearisation.
//!
//! ```text
//! z'' = f(z, z', x, u),   x' = g(z, z', x, u),   y = h(z, z', x, u)
//! d/dt (z, z', x) = A (z, z', x) + B u,   y = C (z, z', x) + D u:   B = [0; df/du; dg/du],  C = dh/d(z, z', x),  D = dh/du
//! ```
//!
//! Derivatives are differences of fourth order, taken with those of A. The value of a guide moves the constraints: positions are closed
//! again without a change of z, then velocities, then accelerations. Its rate and its acceleration are inputs of their own.

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

/// Inputs and outputs that are asked for.
pub struct Ports<'a, T> {
    /// The place of each input among [`State::inputs`]: see [`Prescribed`](mbs_core::inputs::Prescribed).
    pub inputs: &'a [usize],
    /// Measure of the outputs, which always gives as many numbers.
    pub outputs: &'a mut OutputMeasure<'a, T>,
    /// Coordinates x in place of z: of dy/dz, p x f, it makes dx/dz, f x f, both column by column; nothing where no x determine z. Without
    /// it they are z.
    ///
    /// Slopes are then differences along x themselves: what a change of one x does small is not the difference of large ones by z.
    pub coordinates: Option<&'a mut CoordinateChoice<'a, T>>,
}

/// Chooses coordinates by the slopes of outputs: see [`Ports::coordinates`].
pub type CoordinateChoice<'a, T> = dyn FnMut(&[T]) -> Option<Vec<T>> + 'a;

impl<T> fmt::Debug for Ports<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ports").field("inputs", &self.inputs).finish_non_exhaustive()
    }
}

/// Matrices of the inputs and outputs of a linearised motion, stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearPorts<T> {
    /// Number of inputs m.
    pub n_inputs: usize,
    /// The outputs at the state, p numbers.
    pub values: Vec<T>,
    /// d(z'', x')/du, (f + s) x m for s states x of signals.
    pub forces: Vec<T>,
    /// dy/d(z, z', x), p x (2 f + s).
    pub outputs: Vec<T>,
    /// dy/du, p x m.
    pub feedthrough: Vec<T>,
}

impl<T: Real> LinearPorts<T> {
    /// B of d/dt (z, z', x) = A (z, z', x) + B u, (2 f + s) x m, for a motion with `n_freedoms`, column by column.
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
/// With [`coordinates`](Ports::coordinates) z stands for what they choose, in all that is given; inertia is then no unit matrix.
///
/// At [`Instant::Rest`] rates and accelerations of guides are zero at the state, and derivatives by them are taken about zero.
///
/// Cost: that of [`linearise`](crate::linearise()) with a measurement at each evaluation, 6 evaluations for each input, and 5
/// factorisations for one that moves a guide. Where coordinates are chosen, 4 f factorisations more; allocates.
///
/// # Errors
/// As [`linearise`](crate::linearise()), and what `ports.outputs` answers with; [`LinearError::Singular`] where no coordinates are
/// chosen. A guide whose value cannot be changed, as joints hold its coordinate too, is [`LinearError::NotClosed`].
///
/// # Panics
/// If a place is none of a state's inputs.
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

/// Largest factor by which the difference of an input grows, where it hardly moves the mechanism [-]. Chosen, not tuned.
const MOST_GROWTH: f64 = 1e4;

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'_, T, M, S> {
    /// Slopes of (z'', x') and of the outputs by the inputs at these places.
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
            // the next input begins from the state itself
            driven.acceleration(self, T::ZERO)?;
            forces.extend_from_slice(&slope[..rows]);
            outputs.extend_from_slice(&slope[rows..]);
        }
        Ok([forces, outputs])
    }
}

/// An input that is changed.
struct Driven<'a, T> {
    place: usize,
    instant: Instant,
    /// The guides as the state's own inputs have them.
    held: &'a [[T; 3]],
    /// Whether the input changes value, rate and acceleration of a guide, each by itself.
    changed: [bool; 3],
    /// Are positions closed with it?
    is_moved: bool,
}

impl<T: Real> Driven<'_, T> {
    /// Sets the input to its value and a change.
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

    /// z'' with the input changed, z and z' as they are.
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

    /// The difference of the input that moves coordinates, velocities, or accelerations by `reach` of their sizes.
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
