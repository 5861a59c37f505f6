//! Tables of a tree. Effects that the degradation ladder may drop are last, in the order of the ladder.

use super::signals::{MovingSignal, SignalTables, add_laws, held};
use crate::elements;
use crate::inputs::{Motion, Prescriptions, SignalLaw};
use crate::model::{Model, StartState};
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::inputs::Prescribed;
use mbs_core::laws::Part;
use mbs_core::scene::{Motion as SceneLaw, Signal};
use mbs_recursive::loads::{Load, Measure};
use mbs_recursive::loops::Loops;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::rows::Row;
use mbs_recursive::space::Space;
use mbs_recursive::{TreeModel, TreeState};

/// A model as tables. Some tables belong to the tree from which the model was collected, the others to this value.
#[derive(Debug, Clone)]
pub struct Collected<'a, T: Real, S: Space<T>> {
    mechanism: TreeSlices<'a, T, S>,
    loads: Vec<Load<T, S>>,
    state: &'a TreeState<T>,
    guides: Vec<Motion<T>>,
    courses: Vec<SignalLaw<T>>,
    knots: Vec<[T; 2]>,
    curvatures: Vec<T>,
    rows: Vec<[T; 4]>,
    signals: SignalTables<T>,
    rungs: Vec<u32>,
    /// Rows of the loops. A row of a coupling also contains the constant that its guide adds to the guide's law.
    lap_rows: Vec<Row<T, S>>,
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

impl<'a, T: Real, S: Space<T>> Collected<'a, T, S> {
    /// Collects the tables of a tree and a start state. `ladder` has the indices of effects in the scene. The first of them is dropped
    /// first. Each effect is one rung.
    ///
    /// # Errors
    /// [`MovingSignal`] for a function that tables do not support: waves, ramps, and tables that hold their last value or repeat. Guides
    /// support constants, splines and steps only.
    pub fn new(
        tree: &'a TreeModel<T, S>,
        state: &'a TreeState<T>,
        ladder: &[usize],
    ) -> Result<Self, MovingSignal> {
        let mechanism = tree.mechanism();
        let mut model = Self {
            mechanism,
            loads: Vec::new(),
            state,
            guides: Vec::new(),
            courses: Vec::new(),
            knots: Vec::new(),
            curvatures: Vec::new(),
            rows: Vec::new(),
            signals: SignalTables::new(tree.prescribed(), &mechanism),
            rungs: Vec::new(),
            lap_rows: mechanism.loops.rows.to_vec(),
        };
        model.order(tree.effect_of_load(), ladder);
        model.prescribe(tree.prescribed())?;
        Ok(model)
    }

    /// Sorts the effects for the ladder. The effects that always act come first, in the order of the scene. Then the effects of the ladder
    /// follow; the effect that is dropped first is the last.
    fn order(&mut self, effects: &[usize], ladder: &[usize]) {
        let loads = self.mechanism.loads;
        let with = |wanted: &dyn Fn(usize) -> bool| -> Vec<Load<T, S>> {
            let both = loads.iter().zip(effects);
            both.filter(|(_, effect)| wanted(**effect)).map(|(load, _)| *load).collect()
        };
        self.loads = with(&|effect| !ladder.contains(&effect));
        for &dropped in ladder.iter().rev() {
            self.rungs.push(index(self.loads.len()));
            self.loads.extend(with(&|effect| effect == dropped));
        }
        self.rungs.reverse();
    }

    fn prescribe(&mut self, prescribed: &Prescribed<T>) -> Result<(), MovingSignal> {
        for row in &mut self.lap_rows {
            let Row::Coupled(row) = row else { continue };
            let guide = prescribed.guides().get(row.guide as usize);
            row.value = guide.and_then(|guide| guide.offset()).map_or(T::ZERO, |x| x * row.inverse);
        }
        // signals that are not constant are computed by operations
        let signals = held(prescribed.signals());
        let knots = (&mut self.knots, &mut self.curvatures);
        add_laws(prescribed.signals(), &signals, (&mut self.courses, knots))?;
        for guide in prescribed.guides() {
            let law = match guide.law() {
                SceneLaw::Input(motion) => Motion::Input(*motion),
                SceneLaw::Sine { amplitude, frequency, phase } => {
                    Motion::Sine { amplitude: *amplitude, frequency: *frequency, phase: *phase }
                }
                SceneLaw::Ramp { rate } => Motion::Ramp { rate: *rate },
                SceneLaw::Signal(signal) => match self.courses.get(signal.index()) {
                    Some(SignalLaw::Spline(part)) => Motion::Table(*part),
                    Some(SignalLaw::Step(rise)) => Motion::Step(*rise),
                    Some(SignalLaw::Constant([value, ..]))
                        if prescribed.signals().is_constant(*signal) =>
                    {
                        let first = index(self.knots.len());
                        self.knots.push([T::ZERO, *value]);
                        self.curvatures.push(T::ZERO);
                        Motion::Table(Part { first, n: 1 })
                    }
                    _ => return Err(MovingSignal { signal: *signal }),
                },
                SceneLaw::Table { rows: table, .. } | SceneLaw::Monotone { rows: table, .. } => {
                    let first = index(self.knots.len());
                    self.knots.extend_from_slice(table);
                    self.curvatures.extend_from_slice(guide.curvature());
                    Motion::Table(Part { first, n: index(table.len()) })
                }
            };
            self.guides.push(law);
        }
        for (_, course) in prescribed.courses() {
            let law = match (course.speed(), course.course()) {
                (Some(speed), _) => SignalLaw::Travel(speed),
                (None, Signal::Constant(value)) => SignalLaw::Constant(*value),
                (None, Signal::Named(_)) => SignalLaw::Constant(course.at(T::ZERO, &signals)),
                (None, Signal::Input(value)) => SignalLaw::Input(*value),
                (None, Signal::Table(table)) => {
                    let first = index(self.rows.len());
                    self.rows.extend(table.iter().map(|&(t, [x, y, z])| [t, x, y, z]));
                    SignalLaw::Table(Part { first, n: index(table.len()) })
                }
            };
            self.courses.push(law);
        }
        Ok(())
    }

    /// Returns the model, whose slices refer to the collected tables.
    #[must_use]
    pub fn model(&self) -> Model<'_, T, S> {
        Model {
            mechanism: TreeSlices {
                loads: &self.loads,
                loops: Loops {
                    rows: &self.lap_rows,
                    couplings: self.signals.couplings(&self.mechanism.loops.couplings),
                    ..self.mechanism.loops
                },
                feedback: self.signals.feedback(self.mechanism.feedback.links),
                ..self.mechanism
            },
            prescriptions: Prescriptions {
                guides: &self.guides,
                courses: &self.courses,
                knots: (&self.knots, &self.curvatures),
                rows: &self.rows,
            },
            start: StartState {
                t: self.state.t,
                z: &self.state.z,
                v: &self.state.v,
                a: &self.state.a,
                signals: self.signals.starts(&self.state.signals),
            },
            rungs: &self.rungs,
        }
    }
}

/// Returns the features of mbs-nostd for the machine elements of a model.
#[must_use]
pub fn elements<T: Real, S: Space<T>>(model: &Model<'_, T, S>) -> Vec<&'static str> {
    let needed = elements::all(model).into_iter().filter(|element| element.is_needed);
    needed.map(|element| element.feature).collect()
}

/// Returns the features of mbs-core for the effects of a model.
#[must_use]
pub fn needs<T: Real, S: Space<T>>(model: &Model<'_, T, S>) -> Vec<&'static str> {
    let mut needed = Vec::new();
    for load in model.mechanism.loads {
        let feature = match load {
            Load::Between { gauge: Measure::Rotation { .. }, .. } => Some("bushing"),
            Load::Between { law, .. } | Load::Angle { law, .. } => law.feature(),
            Load::BodyLoad(load) => load.law.feature(),
            Load::Sum(load) => load.law.feature(),
            _ => None,
        };
        needed.extend(feature);
    }
    needed.sort_unstable();
    needed.dedup();
    needed
}
