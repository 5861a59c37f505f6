//! [`Solver`]: state, scratch and inputs of one model in arrays of fixed capacity, with a step function.

mod set_state;

use crate::check::{Checked, LoadError, Sizes};
use crate::inputs::{Values, Written};
use crate::ladder::DegradationLadder;
use mbs_core::Real;
use mbs_core::feedback::{CourseSlope, SignalStates};
use mbs_core::step::{InputError, StepError};
use mbs_recursive::link::{ArticulatedInertia, LinkMotion, curves};
use mbs_recursive::loops::LoopStore;
use mbs_recursive::passes::feedback;
use mbs_recursive::passes::slices::{Counts, Inputs, Store, TreeSlices};
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::step::bounded::{self, BoundedReport, Bounds, Watch};
use mbs_recursive::step::trapezoidal::Start;
use mbs_recursive::{Options, Outside};

/// State, scratch and inputs of a model. The parameters are the largest sizes: `L` links including the ground, `Z` coordinates, `V`
/// freedoms, `R` rows of loops. `B` is the number of entries in blocks of Λ (the matrix of the loops' rows), `N` the number of gains of
/// rows at joints. `G` is the number of guides, `C` the number of signals. `M` is the number of states of signals. `F` is the number of
/// signals if there are operations on signals, otherwise zero. `K` is the number of sides of a row: two, or for a coupling the number of
/// branches that carry its joints and points. `W` is the number of terms of couplings and sums up to the last term with a curve.
///
/// The size of a solver is about 130 numbers for each link, 46 for each row and 10 for each freedom. Every other size adds at most six
/// numbers.
#[derive(Debug, Clone)]
pub struct Solver<
    T: Real,
    S: Space<T>,
    const L: usize,
    const Z: usize,
    const V: usize,
    const R: usize,
    const B: usize,
    const N: usize,
    const G: usize,
    const C: usize,
    const M: usize = 0,
    const F: usize = 0,
    const K: usize = 2,
    const W: usize = 0,
> {
    /// Options of the steps.
    pub options: Options<T>,
    /// Limits of the work of a step: numbers of evaluations, sweeps and projections.
    pub bounds: Bounds,
    /// Ladder by which effects are dropped after overruns.
    pub ladder: DegradationLadder,
    sizes: Sizes,
    t: T,
    z: [T; Z],
    v: [T; V],
    a: [T; V],
    lambda: [T; R],
    signals: [[T; 2]; M],
    inputs: Values<G, C, T>,
    scratch: Scratch<T, S, L, Z, V, R, B, N, G, C, M, F, K, W>,
}

#[derive(Debug, Clone)]
struct Scratch<
    T: Real,
    S: Space<T>,
    const L: usize,
    const Z: usize,
    const V: usize,
    const R: usize,
    const B: usize,
    const N: usize,
    const G: usize,
    const C: usize,
    const M: usize,
    const F: usize,
    const K: usize,
    const W: usize,
> {
    placed: [LinkMotion<T, S>; L],
    trial: [LinkMotion<T, S>; L],
    condensed: [ArticulatedInertia<T, S>; L],
    motions: [[S::Motion; L]; 2],
    /// Gradients K of the rows, for all sides: first as carried inward, then as evaluated at the bodies.
    gradients: [[[S::Motion; R]; K]; 2],
    rows: [[T; 3]; R],
    /// Numbers of each row, in this order: right-hand side l, multiplier λ of a sweep, sum of λ, scale, pivot.
    multipliers: [[T; R]; 5],
    blocks: [T; B],
    gains: [[T; N]; 2],
    guides: [[T; 3]; G],
    courses: [[T; 3]; C],
    /// States of signals: first at the start of a step, then at the instant of an evaluation.
    states: [[[T; 2]; M]; 2],
    course_slopes: [CourseSlope<T>; F],
    /// Slopes of the terms of couplings that have curves.
    slopes: [T; W],
    z: [T; Z],
    /// Numbers of each freedom, in this order: velocity v, acceleration z̈, response to multipliers, scratch.
    freedoms: [[T; V]; 4],
    rank: usize,
}

impl<
    T: Real,
    S: Space<T>,
    const L: usize,
    const Z: usize,
    const V: usize,
    const R: usize,
    const B: usize,
    const N: usize,
    const G: usize,
    const C: usize,
    const M: usize,
    const F: usize,
    const K: usize,
    const W: usize,
> Solver<T, S, L, Z, V, R, B, N, G, C, M, F, K, W>
{
    /// Makes a solver whose state is the start state of a model.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] if the model is larger than the solver.
    pub fn new(model: &Checked<'_, T, S>) -> Result<Self, LoadError> {
        let sizes = model.sizes();
        sizes.fit(&Sizes {
            links: L,
            coordinates: Z,
            freedoms: V,
            rows: R,
            blocks: B,
            gains: N,
            guides: G,
            courses: C,
            states: M,
            followed: F,
            sides: K,
        })?;
        let needed = model.n_slopes();
        if needed > W {
            return Err(LoadError::Capacity { of: "terms with curves", needed, capacity: W });
        }
        let zero = S::Motion::zero();
        let from = &model.model().start;
        // The value is built in the returned result, so that the stack does not hold a second copy.
        Ok(Self {
            options: Options::default(),
            bounds: Bounds::default(),
            ladder: DegradationLadder::default(),
            sizes,
            t: from.t,
            z: taken(from.z, T::ZERO),
            v: taken(from.v, T::ZERO),
            a: taken(from.a, T::ZERO),
            lambda: [T::ZERO; R],
            signals: taken(from.signals, [T::ZERO; 2]),
            inputs: Values::new(&model.model().prescriptions),
            scratch: Scratch {
                placed: [LinkMotion::ground(); L],
                trial: [LinkMotion::ground(); L],
                condensed: [ArticulatedInertia::empty(); L],
                motions: [[zero; L]; 2],
                gradients: [[[zero; R]; K]; 2],
                rows: [[T::ZERO; 3]; R],
                multipliers: [[T::ZERO; R]; 5],
                blocks: [T::ZERO; B],
                gains: [[T::ZERO; N]; 2],
                guides: [[T::ZERO; 3]; G],
                courses: [[T::ZERO; 3]; C],
                states: [[[T::ZERO; 2]; M]; 2],
                course_slopes: [CourseSlope::none(); F],
                slopes: [T::ZERO; W],
                z: [T::ZERO; Z],
                freedoms: [[T::ZERO; V]; 4],
                rank: 0,
            },
        })
    }

    /// Sets the state to the start state of the model. Inputs, options and limits are unchanged.
    pub fn restart(&mut self, model: &Checked<'_, T, S>) {
        let from = &model.model().start;
        self.t = from.t;
        self.z = taken(from.z, T::ZERO);
        self.v = taken(from.v, T::ZERO);
        self.a = taken(from.a, T::ZERO);
        self.lambda = [T::ZERO; R];
        self.signals = taken(from.signals, [T::ZERO; 2]);
        self.scratch.rank = 0;
        self.inputs.restart(&model.model().prescriptions);
    }

    /// Returns the time [s].
    pub fn time(&self) -> T {
        self.t
    }

    /// Returns the coordinates: angles, slides, quaternions. A free body has its rotation, then its position.
    pub fn coordinates(&self) -> &[T] {
        self.z.get(..self.sizes.coordinates).unwrap_or(&[])
    }

    /// Returns the velocities of the freedoms [rad/s, m/s].
    pub fn velocities(&self) -> &[T] {
        self.v.get(..self.sizes.freedoms).unwrap_or(&[])
    }

    /// Returns the accelerations of the last evaluation.
    pub fn accelerations(&self) -> &[T] {
        self.a.get(..self.sizes.freedoms).unwrap_or(&[])
    }

    /// Returns the multipliers of the loops' rows [N, N m].
    pub fn multipliers(&self) -> &[T] {
        self.lambda.get(..self.sizes.rows).unwrap_or(&[])
    }

    /// Returns the states of signals, each with its rate.
    pub fn signal_states(&self) -> &[[T; 2]] {
        states(&self.signals, self.sizes.states)
    }

    /// Sets the vector of a signal. It applies from the start of the next step until it is set again. The index `course` counts the scene's
    /// signals first, in their order, then the signals of effects. The vector of a scene's signal is its value, rate and acceleration. Give
    /// zero for rate and acceleration if the value remains constant.
    ///
    /// # Errors
    /// [`InputError`] if the signal does not exist or is not an input, or if a component is not finite. The inputs are then unchanged.
    pub fn set_input(&mut self, course: usize, value: [T; 3]) -> Result<(), InputError> {
        self.inputs.set_input(course, value)
    }

    /// Sets value, rate and acceleration of a guide at the end of the next step.
    ///
    /// # Errors
    /// [`InputError`] if the guide does not exist or is not an input, or if a component is not finite. The inputs are then unchanged.
    pub fn set_guide(&mut self, guide: usize, motion: [T; 3]) -> Result<(), InputError> {
        self.inputs.set_guide(guide, motion)
    }

    /// Advances by one step of length `dt` [s], with work within the bounds. Evaluations and projections are omitted if `watch` reports
    /// that no time remains.
    ///
    /// The rung of the ladder selects the effects that act, and the ladder counts the step. If a signal was set since the last step, the
    /// accelerations at the start are first evaluated again, even if no time remains.
    ///
    /// # Errors
    /// [`StepError`]. Time, coordinates and velocities are then unchanged, and the accelerations belong to the inputs that are set.
    /// [`StepError::Tables`] if the solver was made for another model.
    pub fn step(
        &mut self,
        model: &Checked<'_, T, S>,
        dt: T,
        watch: &mut impl Watch,
    ) -> Result<BoundedReport<T>, StepError> {
        if model.sizes() != self.sizes {
            return Err(StepError::Tables);
        }
        let whole = &model.model().mechanism;
        let reduced;
        let mechanism = match model.kept_on(self.ladder.rung()) {
            None => whole,
            Some(loads) => {
                reduced = TreeSlices { loads, ..*whole };
                &reduced
            }
        };
        let inputs = Written {
            laws: model.model().prescriptions,
            guides: &self.inputs.guides,
            courses: &self.inputs.courses,
        };
        let sizes = &self.sizes;
        let mut s = self.scratch.store(sizes).map_err(|Outside| StepError::Tables)?;
        if self.inputs.has_new {
            // The guides have their motions at the end of the last step. The values that were set since then belong to the end of this
            // step.
            let ended = Written { guides: &self.inputs.ended, ..inputs };
            ended.evaluate(self.t, s.guides, s.courses);
            let place = (
                self.z.get(..sizes.coordinates).unwrap_or(&[]),
                self.v.get(..sizes.freedoms).unwrap_or(&[]),
                states(&self.signals, sizes.states),
            );
            bounded::begin(mechanism, (&self.options, self.bounds), place, &mut s)?;
            put(s.zdd, &mut self.a);
            put(s.signals.ends, &mut self.signals);
            self.inputs.has_new = false;
        }
        let start = Start {
            t: self.t,
            z: self.z.get(..sizes.coordinates).unwrap_or(&[]),
            v: self.v.get(..sizes.freedoms).unwrap_or(&[]),
            a: self.a.get(..sizes.freedoms).unwrap_or(&[]),
            signals: states(&self.signals, sizes.states),
        };
        let work = (dt, &self.options, self.bounds);
        let report = bounded::step(mechanism, &inputs, work, (start, watch), &mut s)?;
        // The step has checked the lengths of these slices.
        for (to, from) in [
            (&mut self.z[..], &*s.z),
            (&mut self.v, &*s.v),
            (&mut self.a, &*s.zdd),
            (&mut self.lambda, &*s.lambda),
        ] {
            put(from, to);
        }
        put(s.signals.ends, &mut self.signals);
        self.t += dt;
        self.inputs.ended = self.inputs.guides;
        let n_rungs = model.model().rungs.len();
        self.ladder.note(report.is_cut_short, u32::try_from(n_rungs).unwrap_or(u32::MAX));
        Ok(report)
    }
}

/// Returns the first `n` entries.
#[inline]
fn first<X>(of: &mut [X], n: usize) -> Result<&mut [X], Outside> {
    of.get_mut(..n).ok_or(Outside)
}

impl<
    T: Real,
    S: Space<T>,
    const L: usize,
    const Z: usize,
    const V: usize,
    const R: usize,
    const B: usize,
    const N: usize,
    const G: usize,
    const C: usize,
    const M: usize,
    const F: usize,
    const K: usize,
    const W: usize,
> Scratch<T, S, L, Z, V, R, B, N, G, C, M, F, K, W>
{
    /// Returns the scratch as slices with the sizes of a model.
    fn store(&mut self, n: &Sizes) -> Result<Store<'_, T, S>, Outside> {
        let [a, a_response] = &mut self.motions;
        let [k, gradient] = &mut self.gradients;
        let [l, lambda_response, lambda, scales, pivots] = &mut self.multipliers;
        let [gains, heads] = &mut self.gains;
        let [v, zdd, v_response, scratch] = &mut self.freedoms;
        let [starts, ends] = &mut self.states;
        Ok(Store {
            placed: first(&mut self.placed, n.links)?,
            trial: first(&mut self.trial, n.links)?,
            condensed: first(&mut self.condensed, n.links)?,
            a: first(a, n.links)?,
            a_response: first(a_response, n.links)?,
            v_response: first(v_response, n.freedoms)?,
            loops: LoopStore {
                k: first(k.as_flattened_mut(), n.sides * n.rows)?,
                slopes: if curves::IS_BUILT { &mut self.slopes } else { &mut [] },
                l: first(l, n.rows)?,
                lambda: first(lambda_response, n.rows)?,
                blocks: first(&mut self.blocks, n.blocks)?,
                gains: first(gains, n.gains)?,
                heads: first(heads, n.gains)?,
                scales: first(scales, n.rows)?,
                pivots: first(pivots, n.rows)?,
            },
            gradient: first(gradient.as_flattened_mut(), n.sides * n.rows)?,
            rows: first(&mut self.rows, n.rows)?,
            lambda: first(lambda, n.rows)?,
            guides: first(&mut self.guides, n.guides)?,
            courses: first(&mut self.courses, n.courses)?,
            signals: if feedback::IS_BUILT {
                SignalStates {
                    dt: T::ZERO,
                    starts: first(starts, n.states)?,
                    ends: first(ends, n.states)?,
                    slopes: first(&mut self.course_slopes, n.followed)?,
                }
            } else {
                SignalStates { dt: T::ZERO, starts: &mut [], ends: &mut [], slopes: &mut [] }
            },
            z: first(&mut self.z, n.coordinates)?,
            v: first(v, n.freedoms)?,
            zdd: first(zdd, n.freedoms)?,
            scratch: first(scratch, n.freedoms)?,
            history: &mut [],
            rank: &mut self.rank,
            counts: Counts::default(),
        })
    }
}

/// Returns the first `n` states of signals; a build without signals returns none.
#[inline(always)]
fn states<T>(of: &[[T; 2]], n: usize) -> &[[T; 2]] {
    if feedback::IS_BUILT { of.get(..n).unwrap_or(&[]) } else { &[] }
}

/// Returns an array with the entries of a slice, followed by `zero`.
fn taken<X: Copy, const N: usize>(from: &[X], zero: X) -> [X; N] {
    let mut to = [zero; N];
    put(from, &mut to);
    to
}

/// Copies a list over the first entries of another list.
#[inline(always)]
fn put<X: Copy>(from: &[X], to: &mut [X]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
