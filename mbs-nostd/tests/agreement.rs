//! The solver of fixed capacity against mbs-recursive on the same scenes.

mod support;

use mbs_nostd::export::{Gathered, bytes};
use mbs_nostd::{Bounds, Checked, Options, Solver, Spatial, Tables, Unwatched};
use mbs_recursive::{TreeModel, TreeState, Workspace, bounded_step, step};
use support::{file, start};

/// Room for the vehicle.
type Room = Solver<f64, Spatial, 12, 40, 32, 16, 256, 256, 2, 8>;
type RoomTables = Tables<f64, Spatial, 12, 12, 16, 64, 24, 64, 8, 40>;

fn vehicle(name: &str) -> (TreeModel<f64, Spatial>, TreeState<f64>) {
    start::<Spatial, 3>(&file(name))
}

#[test]
fn a_solver_of_fixed_capacity_gives_the_bits_of_the_recursion() {
    for name in ["iltis-slalom", "iltis-jump", "iltis-suspension", "spatial-four-bar"] {
        let (tree, begin) = vehicle(name);
        let gathered = Gathered::new(&tree, &begin, &[]);
        let text = bytes(&gathered.model(), false).expect("a scene without own laws");
        let tables = RoomTables::read(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let flash = Checked::new(&gathered.model()).unwrap_or_else(|e| panic!("{name}: {e}"));
        let read = tables.model();
        let mut solvers = [Room::new(&flash), Room::new(&read)].map(|s| s.expect("room"));
        let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
        let (options, bounds) = (Options::default(), Bounds::default());
        for _ in 0..500 {
            bounded_step(&tree, (1e-3, &options, bounds), &mut state, &mut workspace)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            for (solver, model) in solvers.iter_mut().zip([&flash, &read]) {
                solver.step(model, 1e-3, &mut Unwatched).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_eq!(solver.coordinates(), &state.z[..], "{name}");
                assert_eq!(solver.velocities(), &state.v[..], "{name}");
                assert_eq!(solver.accelerations(), &state.a[..], "{name}");
            }
        }
    }
}

#[test]
fn scratch() {
    for name in [
        "iltis-slalom",
        "iltis-jump",
        "iltis-stairs",
        "iltis-stairs-stiff",
        "iltis-suspension",
        "iltis-bump-5",
    ] {
        for evaluations in [1, 2, 3] {
            let (tree, begin) = vehicle(name);
            let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
            let (mut exact, mut other) = (begin.clone(), Workspace::new(&tree));
            let options = Options::default();
            let bounds = Bounds { evaluations, ..Bounds::default() };
            let mut worst = [0.0_f64; 4];
            let mut z_worst = 0.0_f64;
            let mut stopped = None;
            for i in 0..10_000 {
                match bounded_step(&tree, (1e-3, &options, bounds), &mut state, &mut workspace) {
                    Ok(r) => {
                        for (w, x) in worst.iter_mut().zip([
                            r.correction,
                            r.violation[0],
                            r.violation[1],
                            r.violation[2],
                        ]) {
                            *w = w.max(x);
                        }
                    }
                    Err(e) => {
                        stopped = Some((i, e));
                        break;
                    }
                }
                step(&tree, 1e-3, &options, &mut exact, &mut other).unwrap();
                for (x, y) in state.z.iter().zip(&exact.z) {
                    z_worst = z_worst.max((x - y).abs());
                }
            }
            println!(
                "{name} {evaluations}: {:?} worst {worst:?} z {z_worst:.2e} links {} nv {} rows {}",
                stopped,
                tree.n_links(),
                tree.n_freedoms(),
                tree.n_rows()
            );
        }
    }
}
