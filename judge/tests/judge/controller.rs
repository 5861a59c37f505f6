//! Enumerated cases on the solver of fixed capacity, which controllers run. Its results equal those of the recursive formulation bit by
//! bit, and the judge checks that formulation.

use judge::random;
use judge::trial::document;
use mbs::core::scene::{Dimension, Scene};
use mbs_nostd::export::Collected;
use mbs_nostd::{Bounds, Checked, Solver, Unwatched};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeError, TreeModel, Workspace};

/// Solver with room for two bodies: links, coordinates, freedoms, rows, blocks, gains, guides, signals.
type Room<S> = Solver<f64, S, 12, 16, 12, 8, 64, 256, 2, 8>;
/// Compares ten steps of a controller with the recursive formulation. False where the scene has no tree.
fn is_followed<S: Space<f64>, const D: usize>(scene: &Scene<f64>, name: &str, step: f64) -> bool {
    let tree: TreeModel<f64, S> = match TreeModel::new(scene) {
        Ok(tree) => tree,
        Err(TreeError::EffectCut { .. }) => return false,
        Err(error) => panic!("{name}: {error}"),
    };
    let (natural, begin) = mbs_testkit::start::<D>(scene);
    let start = tree.start(scene, &natural, &begin).unwrap_or_else(|e| panic!("{name}: {e}"));
    let collected = Collected::new(&tree, &start, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut solver = Room::new(&model).unwrap_or_else(|e| panic!("{name}: {e}"));
    let (options, bounds) = (Options::default(), Bounds::default());
    let (mut state, mut workspace) = (start.clone(), Workspace::new(&tree));
    for _ in 0..random::STEPS {
        tree.bounded_step((step, &options, bounds), &mut state, &mut workspace)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        solver.step(&model, step, &mut Unwatched).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(solver.coordinates(), &state.z[..], "{name}");
        assert_eq!(solver.velocities(), &state.v[..], "{name}");
        assert_eq!(solver.accelerations(), &state.a[..], "{name}");
    }
    true
}

#[test]
fn a_controller_moves_every_joint_with_every_effect_as_the_recursion_does() {
    let (mut followed, mut without) = (0, 0);
    // exports support lines between two points only
    for case in random::cases().into_iter().filter(|case| !case.name.ends_with("-points")) {
        let scene = document(&case.text).unwrap_or_else(|e| panic!("{}: {e}", case.name));
        let is_followed = match scene.dimension {
            Dimension::Planar => is_followed::<Planar, 2>(&scene, &case.name, case.step),
            Dimension::Spatial => is_followed::<Spatial, 3>(&scene, &case.name, case.step),
        };
        *(if is_followed { &mut followed } else { &mut without }) += 1;
    }
    crate::say(&format!("{followed} cases on the controller's solver, {without} without a tree"));
    assert!(followed > 1000 && without == 0, "{followed}, {without}");
}
