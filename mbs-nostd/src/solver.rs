//! [`Solver`]: state, scratch and inputs of one model in arrays of fixed capacity, and its step.

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

/// State, scratch and inputs of a model with at most `L` links (the ground among them), `Z` coordinates, `V` freedoms and `R`
/// rows of loops. It has at most `B` numbers in blocks of Λ, `N` gains, `G` guides and `C` courses. It has at most
/// `M` states of signals, and `F` courses where there are operations on them. A row has at most `K` sides: two, or as many branches as
/// a coupling has joints and points on. Of the terms of couplings and sums the last with a curve is at most the `W`-th.
///
/// Its size is about 130 numbers for each link, 46 for each row, 10 for each freedom, and at most six for each of the others.
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
    /// Choices for the steps.
    pub options: Options<T>,
    /// Bounds on the work of a step.
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
    /// K as it travels, and at its bodies; all sides.
    gradients: [[[S::Motion; R]; K]; 2],
    rows: [[T; 3]; R],
    /// l, λ of a sweep, summed λ, scales, pivots.
    multipliers: [[T; R]; 5],
    blocks: [T; B],
    gains: [[T; N]; 2],
    guides: [[T; 3]; G],
    courses: [[T; 3]; C],
    /// States of signals at the start of a step, and at the instant.
    states: [[[T; 2]; M]; 2],
    course_slopes: [CourseSlope<T>; F],
    /// Slopes of the terms of couplings that have curves.
    slopes: [T; W],
    z: [T; Z],
    /// v, z̈, response, scratch.
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
    /// A solver at the beginning of a model.
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
        // Made where it is returned: the stack holds no second one.
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

    /// Goes back to the beginning of the model; inputs and choices stay.
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

    /// Returns the coordinates: angles, slides, quaternions; of free bodies rotation, then position.
    pub fn coordinates(&self) -> &[T] {
        self.z.get(..self.sizes.coordinates).unwrap_or(&[])
    }

    /// Returns the velocities.
    pub fn velocities(&self) -> &[T] {
        self.v.get(..self.sizes.freedoms).unwrap_or(&[])
    }

    /// Accelerations that the last step found.
    pub fn accelerations(&self) -> &[T] {
        self.a.get(..self.sizes.freedoms).unwrap_or(&[])
    }

    /// Multipliers of the loops' rows [N, N m].
    pub fn multipliers(&self) -> &[T] {
        self.lambda.get(..self.sizes.rows).unwrap_or(&[])
    }

    /// States of signals, each with its rate.
    pub fn signal_states(&self) -> &[[T; 2]] {
        states(&self.signals, self.sizes.states)
    }

    /// Writes the vector of a course from now on: the next step is made with it from its beginning. The scene's signals are the first
    /// courses, in their order, and those of effects follow. A signal's vector is its value, its rate and its acceleration: zeros
    /// where the value is held.
    ///
    /// # Errors
    /// [`InputError`] where there is no such course, it is no input, or a component is not finite. Nothing is written then.
    pub fn set_input(&mut self, course: usize, value: [T; 3]) -> Result<(), InputError> {
        self.inputs.set_input(course, value)
    }

    /// Writes value, rate and acceleration that a guide has at the end of the next step.
    ///
    /// # Errors
    /// [`InputError`] where there is no such guide, it is no input, or a component is not finite. Nothing is written then.
    pub fn set_guide(&mut self, guide: usize, motion: [T; 3]) -> Result<(), InputError> {
        self.inputs.set_guide(guide, motion)
    }

    /// Advances by one step of length `dt` [s]: work within the bounds, as long as `watch` says that there is time.
    ///
    /// The rung of the ladder says which effects act, and takes note of the step. Where a course was written since the last step,
    /// the accelerations at the beginning are evaluated anew first, whatever `watch` says.
    ///
    /// # Errors
    /// [`StepError`]; time, coordinates and velocities are then unchanged, and accelerations are those of the inputs that are set.
    /// [`StepError::Tables`] if the model is not the solver's.
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
            // Guides are those that the last step ended with: those of now are of the end of this one.
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
        // The step has checked the lengths.
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

/// The first `n` entries.
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
    /// The scratch as slices of a model's sizes.
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

/// The first `n` states of signals; a build without signals has none.
#[inline(always)]
fn states<T>(of: &[[T; 2]], n: usize) -> &[[T; 2]] {
    if feedback::IS_BUILT { of.get(..n).unwrap_or(&[]) } else { &[] }
}

/// The entries of a slice, with zeros behind them.
fn taken<X: Copy, const N: usize>(from: &[X], zero: X) -> [X; N] {
    let mut to = [zero; N];
    put(from, &mut to);
    to
}

/// Entries over the first ones of another list.
#[inline(always)]
fn put<X: Copy>(from: &[X], to: &mut [X]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
