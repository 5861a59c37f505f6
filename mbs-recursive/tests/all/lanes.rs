//! Several states in one evaluation, compared with a separate evaluation of each state.

use mbs_core::real::Lanes;
use mbs_recursive::space::Space;
use mbs_recursive::{
    EffortTerms, LanesError, Options, Planar, Spatial, TreeModel, TreeState, Workspace,
};
use mbs_testkit::file_in;

/// Returns a state whose angles, slides and velocities differ from the reference configuration. The coordinates of ball joints are
/// unchanged, because their quaternions must have length one.
fn wandered<S: Space<f64>>(model: &TreeModel<f64, S>, seed: usize) -> TreeState<f64> {
    let mut state = TreeState::at_rest(model);
    for (k, z) in state.z.iter_mut().enumerate().filter(|(_, z)| **z == 0.0) {
        *z = 0.02 * ((k + 7 * seed) as f64).sin();
    }
    for (k, v) in state.v.iter_mut().enumerate() {
        *v = ((2 * k + 5 * seed) as f64).cos();
    }
    state
}

/// Checks that accelerations and efforts of four states in lanes have the same bits as in separate evaluations.
fn hold<S: Space<f64> + Space<Lanes<4>>>(name: &str) {
    let model = TreeModel::<f64, S>::new(&file_in(name)).expect("a tree");
    let wide = TreeModel::<Lanes<4>, S>::in_lanes(&file_in(name)).expect("a tree in lanes");
    let mut state = TreeState::at_rest(&wide);
    let mut alone: Vec<_> = (0..4).map(|seed| wandered(&model, seed)).collect();
    for (lane, one) in alone.iter().enumerate() {
        state.set_lane(lane, &one.z, &one.v);
    }
    let (mut workspace, mut wide_workspace) = (Workspace::new(&model), Workspace::new(&wide));
    let (options, wide_options) = (Options::default(), Options::default());
    wide.accelerate(&wide_options, &mut state, &mut wide_workspace).expect("regular");
    let mut efforts = vec![Lanes::all(0.0); state.a.len()];
    let terms = EffortTerms::WithEffects;
    wide.write_efforts((&state, terms), &mut wide_workspace, &mut efforts);
    for (lane, one) in alone.iter_mut().enumerate() {
        model.accelerate(&options, one, &mut workspace).expect("regular");
        let found: Vec<u64> = state.lane_accelerations(lane).map(f64::to_bits).collect();
        let expected: Vec<u64> = one.a.iter().map(|a| a.to_bits()).collect();
        assert_eq!(found, expected, "{name}: accelerations of lane {lane}");
        assert!(one.a.iter().any(|a| a.abs() > 0.1), "{name}: it moves");
        let mut own = vec![0.0; one.a.len()];
        model.write_efforts((one, terms), &mut workspace, &mut own);
        let found = efforts.iter().map(|x| x.0[lane].to_bits());
        assert!(found.eq(own.iter().map(|x| x.to_bits())), "{name}: efforts of lane {lane}");
    }
}

#[test]
fn each_lane_has_the_bits_of_its_state_alone() {
    hold::<Planar>("double-pendulum");
    hold::<Spatial>("spatial-chain-20");
    // joints of six kinds, springs and dampers along lengths and about joints
    hold::<Spatial>("tree-30");
}

/// Checks that central differences of four freedoms at once have the same bits as separate differences.
#[test]
fn finite_differences_in_lanes_are_those_one_by_one() {
    const STEP: f64 = 1e-6;
    let name = "spatial-chain-20";
    let model = TreeModel::<f64, Spatial>::new(&file_in(name)).expect("a tree");
    let wide = TreeModel::<Lanes<4>, Spatial>::in_lanes(&file_in(name)).expect("a tree in lanes");
    let here = wandered(&model, 3);
    let moved = |column: usize, by: f64| {
        let mut z = here.z.clone();
        z[column] += by;
        z
    };
    let mut state = TreeState::at_rest(&wide);
    for (lane, (column, by)) in
        [(0, STEP), (0, -STEP), (5, STEP), (5, -STEP)].into_iter().enumerate()
    {
        state.set_lane(lane, &moved(column, by), &here.v);
    }
    wide.accelerate(&Options::default(), &mut state, &mut Workspace::new(&wide)).expect("regular");
    for (pair, column) in [(0, 0), (1, 5)] {
        let ends = [STEP, -STEP].map(|by| {
            let mut one = here.clone();
            one.z = moved(column, by);
            model
                .accelerate(&Options::default(), &mut one, &mut Workspace::new(&model))
                .expect("regular");
            one.a
        });
        for (k, a) in state.a.iter().enumerate() {
            let (found, alone) = (a.0[2 * pair] - a.0[2 * pair + 1], ends[0][k] - ends[1][k]);
            assert_eq!(found.to_bits(), alone.to_bits(), "column {column}, row {k}");
        }
    }
}

#[test]
fn what_branches_by_numbers_is_refused_in_lanes() {
    let closed = TreeModel::<Lanes<2>, Planar>::in_lanes(&file_in("four-bar")).map(|_| ());
    assert_eq!(closed, Err(LanesError::Closed { rows: 2 }));
    let tire = TreeModel::<Lanes<2>, Planar>::in_lanes(&file_in("quarter-car")).map(|_| ());
    assert!(matches!(tire, Err(LanesError::Effect { .. })), "{tire:?}");
}

#[test]
fn one_lane_with_an_angle_that_is_no_number_refuses_all() {
    let wide =
        TreeModel::<Lanes<2>, Planar>::in_lanes(&file_in("double-pendulum")).expect("a tree");
    let mut state = TreeState::at_rest(&wide);
    let n = state.z.len();
    state.set_lane(1, &vec![f64::NAN; n], &vec![0.0; n]);
    let done = wide.accelerate(&Options::default(), &mut state, &mut Workspace::new(&wide));
    assert!(done.is_err(), "an angle that is no number");
}
