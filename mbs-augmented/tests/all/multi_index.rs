//! Changes between index-3 and index-1: the state remains consistent, and the index changes at the right step.

use mbs_augmented::{ConstraintIndex, IndexChange, Options, Workspace, index1, index3};
use mbs_core::SpdSolver;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::step::Step;
use mbs_sparse::Multifrontal;
use mbs_testkit::{apart, file, solver, start};

type Work = Workspace<f64, Multifrontal<f64>>;

struct Bench<const D: usize> {
    model: NaturalModel<f64, D>,
    state: State<f64>,
    work: Work,
}

impl<const D: usize> Bench<D> {
    fn new(name: &str) -> Self {
        let (model, state) = start(&file(name));
        let work = Workspace::new(&model, solver(&model));
        Self { model, state, work }
    }

    fn index3(&mut self, h: f64, n: u32) {
        for _ in 0..n {
            let step = Step { dt: h, length: self.model.length() };
            index3::step(&self.model, step, &Options::index3(), &mut self.state, &mut self.work)
                .expect("it steps");
        }
    }

    /// Returns the largest component of |M a + J^T lambda - Q| [N].
    fn imbalance(&mut self) -> f64 {
        let Self { model, state: s, .. } = self;
        let mut terms = model.terms();
        model.set_inputs(s.t, s, &mut terms);
        model.evaluate(&s.q, &mut terms);
        model.evaluate_forces(&s.q, &s.v, &mut terms);
        let load =
            mbs_core::model::Load { mass: Some(&s.a), multipliers: Some(&s.lambda), force: 1.0 };
        let tangent = mbs_core::model::Tangent {
            stiffness: 0.0,
            damping: 0.0,
            penalty: &[],
            geometric: None,
        };
        let system = mbs_core::model::System { model: &*model, terms: &terms, tangent, load };
        let mut solver = solver::<f64>(&*model);
        let mut f = vec![0.0; mbs_core::Cliques::n_unknowns(&*model)];
        solver.assemble(&system, &mut f);
        f.iter().fold(0.0, |most, x| f64::max(most, x.abs()))
    }
}

/// Checks that a change of index changes the state only a little. The multipliers of index-3 balance its iteration to 1e-10 of the
/// accelerations. Masses of tens of kilograms and accelerations of a hundred metres per second squared multiply this error.
fn check_settling<const D: usize>(name: &str, h: f64, force: f64) {
    let mut bench = Bench::<D>::new(name);
    bench.index3(h, 200);
    let before = bench.state.clone();
    let length = bench.model.length();
    let Bench { model, state, work } = &mut bench;
    index1::settle(model, length, &Options::index1(), state, work).expect("it settles");
    assert_eq!(state.q, before.q, "{name}: positions stay");
    assert_eq!(state.t.to_bits(), before.t.to_bits(), "{name}");
    assert!(apart(&state.v, &before.v) < 1e-11, "{name}: velocities were consistent");
    let energy = |s: &State<f64>| bench.model.kinetic_energy(&s.v);
    assert!((energy(&bench.state) - energy(&before)).abs() < 1e-9, "{name}: no step of energy");
    let jump = apart(&bench.state.reaction, &before.reaction);
    let scale = before.reaction.iter().fold(1.0, |most, x| f64::max(most, x.abs()));
    assert!(jump < force * scale, "{name}: multipliers jump by {jump} of {scale}");
    assert!(bench.imbalance() < 1e-7 * scale, "{name}: {}", bench.imbalance());
}

#[test]
fn a_change_of_index_moves_neither_positions_nor_energy_and_leaves_equations_in_balance() {
    // The third argument limits the relative change of the multipliers. Those of index-3 come from inside the iteration, with an error of
    // second order in the step.
    check_settling::<2>("double-pendulum", 1e-4, 1e-5);
    check_settling::<2>("slider-crank", 1e-4, 1e-5);
    check_settling::<3>("iltis-suspension-halved", 1e-4, 1e-3);
}

#[test]
fn short_steps_are_made_in_index_1_and_long_ones_in_index_3_with_room_between() {
    let mut bench = Bench::<2>::new("double-pendulum");
    let Bench { model, state, work } = &mut bench;
    let mut change = IndexChange::new(Options::index1(), Options::index3());
    let length = model.length();
    let mut index_at = |change: &mut IndexChange<f64>, h: f64, reductions: u32| {
        let is_changed = change.prepare(model, Step { dt: h, length }, reductions, state, work);
        change.tried(h);
        change.accept();
        (change.index(), is_changed)
    };
    assert_eq!(index_at(&mut change, 1.1e-4, 0), (ConstraintIndex::Three, false));
    assert_eq!(index_at(&mut change, 0.9e-4, 0), (ConstraintIndex::One, true));
    assert_eq!(index_at(&mut change, 1.9e-4, 0), (ConstraintIndex::One, false));
    assert_eq!(index_at(&mut change, 2.1e-4, 0), (ConstraintIndex::Three, true));
    // Repeated reductions lead to index-1 at any step. The index changes back only after the step has grown again.
    assert_eq!(index_at(&mut change, 1e-3, 3), (ConstraintIndex::Three, false));
    assert_eq!(index_at(&mut change, 5e-4, 4), (ConstraintIndex::One, true));
    assert_eq!(index_at(&mut change, 5e-4, 0), (ConstraintIndex::One, false));
    assert_eq!(index_at(&mut change, 6e-4, 0), (ConstraintIndex::Three, true));
    assert_eq!(change.changes(), 4);
}
