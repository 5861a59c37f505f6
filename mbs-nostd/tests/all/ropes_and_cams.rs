//! Couplings with curves and with lengths over points on a controller: the steps of the host, and closed forms.

use crate::support::start;
use mbs_core::step::StepError;
use mbs_nostd::export::{Collected, bytes, elements, source};
use mbs_nostd::format::{Axes, Record};
use mbs_nostd::{
    Bounds, Checked, LoadError, Options, Planar, Real, Solver, Spatial, Tables, Unwatched,
};
use mbs_recursive::{Workspace, bounded_step};
use mbs_testkit::{allocations, repository};

type Room<T, S> = Solver<T, S, 8, 16, 16, 8, 64, 64, 2, 12, 2, 12, 6, 8>;
type RoomTables<T, S> = Tables<T, S, 8, 4, 8, 32, 8, 32, 12, 16, 16, 16>;

/// A cam that lifts a slide, and a rope over the slide and a load to a drum.
pub(crate) const HOIST: &str = include_str!("hoist.toml");
/// The same in space, about axes across.
pub(crate) const WINCH: &str = include_str!("winch.toml");

/// Steps of each comparison.
const STEPS: u32 = 500;

fn exported<S: Axes<f64>, const D: usize>(text: &str) -> Vec<u8> {
    let (tree, begin) = start::<S, D>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    bytes(&collected.model(), false).expect("a scene of tables")
}

/// The largest difference of coordinates, velocities, accelerations and multipliers from the recursion over steps of 1 ms.
fn apart<S: Axes<f64>, const D: usize>(text: &str) -> Result<f64, LoadError> {
    let (tree, begin) = start::<S, D>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let flash = Checked::new(&collected.model())?;
    let bytes = bytes(&collected.model(), false).expect("a scene of tables");
    let tables = RoomTables::<f64, S>::read(&bytes)?;
    let read = tables.model();
    let mut solvers = [Room::<f64, S>::new(&flash)?, Room::<f64, S>::new(&read)?];
    let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
    let mut worst = 0.0_f64;
    for step in 0..STEPS {
        let work = (1e-3, &Options::default(), Bounds::default());
        bounded_step(&tree, work, &mut state, &mut workspace)
            .unwrap_or_else(|e| panic!("step {step}: {e}"));
        for (solver, model) in solvers.iter_mut().zip([&flash, &read]) {
            let before = allocations::count();
            solver.step(model, 1e-3, &mut Unwatched).expect("a step");
            assert_eq!(allocations::count(), before, "step {step}");
            let own = [
                solver.coordinates(),
                solver.velocities(),
                solver.accelerations(),
                solver.multipliers(),
            ];
            let host = [&state.z[..], &state.v, &state.a, &state.lambda];
            for (x, y) in own.concat().iter().zip(host.concat()) {
                worst = worst.max((x - y).abs());
            }
        }
    }
    assert!(state.v.iter().all(|v| v.abs() > 1e-6), "all moves: {:?}", state.v);
    Ok(worst)
}

fn file(name: &str) -> String {
    std::fs::read_to_string(repository::path(name)).expect("a scene")
}

#[test]
fn cams_and_ropes_have_the_bits_of_the_recursion_on_a_controller() {
    assert_eq!(apart::<Planar, 2>(&file("cam-follower")), Ok(0.0));
    assert_eq!(apart::<Planar, 2>(&file("crane")), Ok(0.0));
    assert_eq!(apart::<Planar, 2>(HOIST), Ok(0.0));
    assert_eq!(apart::<Spatial, 3>(WINCH), Ok(0.0));
}
