//! Signals on a controller, compared with the steps of the host. Inputs change during the run. Models are tested as constant tables and as
//! bytes.

use crate::support::start;
use mbs_core::scene::{Scene, SignalKind};
use mbs_nostd::export::{Collected, bytes, elements, source};
use mbs_nostd::format::Axes;
use mbs_nostd::table::{FeedbackOperation, FeedbackStep};
use mbs_nostd::{
    Bounds, Checked, LoadError, Options, Planar, SignalLaw, Solver, Spatial, Tables, Unwatched,
};
use mbs_recursive::Workspace;
use mbs_testkit::allocations;

type Room<S> = Solver<f64, S, 40, 64, 48, 40, 1024, 1024, 4, 48, 8, 48>;
type RoomTables<S> = Tables<f64, S, 40, 24, 40, 256, 48, 64, 48, 64, 80>;

/// Two links in the plane with a controller at each joint. One controller follows an input, the other a table.
pub(crate) const ARM: &str = r#"
[scene]
dimension = 2
duration = 1.0
gravity = [0.0, -9.81]
[[body]]
name = "upper"
mass = 2.0
center = [0.5, 0.0]
inertia = 0.2
[[body]]
name = "lower"
mass = 1.0
center = [1.4, 0.0]
inertia = 0.1
[[joint]]
name = "shoulder"
kind = "revolute"
bodies = ["ground", "upper"]
at = [0.0, 0.0]
[[joint]]
name = "elbow"
kind = "revolute"
bodies = ["upper", "lower"]
at = [1.0, 0.0]
[[signal]]
name = "lift"
kind = "pid"
target = "goal"
measured = "at-shoulder"
p = 400.0
i = 300.0
d = 40.0
limit = 60.0
[[signal]]
name = "goal"
kind = "input"
value = 0.2
[[signal]]
name = "at-shoulder"
kind = "measure"
joint = "shoulder"
[[signal]]
name = "path"
kind = "table"
table = [[0.0, 0.0], [0.1, 0.3], [0.3, -0.2]]
ends = "level"
[[signal]]
name = "at-elbow"
kind = "measure"
joint = "elbow"
[[signal]]
name = "bend"
kind = "pid"
target = "path"
measured = "at-elbow"
p = 100.0
d = 5.0
[[effect]]
kind = "torque"
joint = "shoulder"
signal = "lift"
[[effect]]
kind = "torque"
joint = "elbow"
signal = "bend"
"#;

/// A wheel that an engine drives, with throttle, brake and load. The engine's torque decreases with its speed and is delayed.
pub(crate) const LINE: &str = r#"
[scene]
dimension = 2
duration = 1.0
[[body]]
name = "wheel"
mass = 1.0
center = [0.0, 0.0]
inertia = 2.0
[[joint]]
name = "axle"
kind = "revolute"
bodies = ["ground", "wheel"]
at = [0.0, 0.0]
[[initial]]
joint = "axle"
value = 0.0
rate = 3.0
[[signal]]
name = "throttle"
kind = "input"
value = 0.5
[[signal]]
name = "eased"
kind = "curve"
of = "throttle"
table = [[0.0, 0.0], [0.5, 0.3], [1.0, 1.0]]
[[signal]]
name = "speed"
kind = "measure"
joint = "axle"
quantity = "rate"
[[signal]]
name = "full"
kind = "curve"
of = "speed"
coefficients = [120.0, -4.0, -0.5]
[[signal]]
name = "over-speed"
kind = "curve"
of = "speed"
table = [[-1.0, 1.0], [2.0, 1.2], [9.0, 0.1]]
[[signal]]
name = "asked"
kind = "product"
of = ["full", "eased", "over-speed"]
[[signal]]
name = "drive"
kind = "lag"
of = "asked"
time = 0.05
[[signal]]
name = "way"
kind = "integral"
of = "speed"
upper = 0.5
[[signal]]
name = "grade"
kind = "table"
interpolation = "linear"
table = [[0.0, 0.0], [0.1, -2.0], [0.3, 4.0]]
[[signal]]
name = "pedal"
kind = "input"
[[signal]]
name = "pressed"
kind = "clamp"
of = "pedal"
lower = 0.0
upper = 1.0
[[signal]]
name = "gust"
kind = "step"
from = 1.0
to = -2.0
at = 0.1
rise = 0.05
[[signal]]
name = "load"
kind = "sum"
of = ["grade", "way", "gust"]
factors = [1.5, -3.0, 2.0]
[[effect]]
kind = "torque"
joint = "axle"
signal = "drive"
[[effect]]
kind = "torque"
joint = "axle"
signal = "load"
[[effect]]
kind = "torque"
joint = "axle"
signal = "grade"
[[effect]]
kind = "friction"
joint = "axle"
coulomb = 20.0
signal = "pressed"
"#;

/// Number of steps of each comparison [-].
const STEPS: u32 = 300;

/// Returns the value to which an input is set before a step.
fn input(number: usize, step: u32) -> f64 {
    [0.5, 0.9, -0.2, 1.3][(step / 60) as usize % 4] * if number == 1 { 0.4 } else { 1.0 }
}

/// Returns the indices of the signals that are inputs.
fn inputs(scene: &Scene<f64>) -> Vec<usize> {
    let all = scene.signals.iter().enumerate();
    all.filter(|(_, signal)| matches!(signal.kind, SignalKind::Input { .. }))
        .map(|(i, _)| i)
        .collect()
}

/// Returns the largest difference of coordinates, velocities, accelerations and states of signals from the steps of the host.
fn apart<S: Axes<f64>, const D: usize>(scene: &Scene<f64>) -> f64 {
    let inputs = inputs(scene);
    let (tree, begin) = start::<S, D>(scene);
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let flash = Checked::new(&collected.model()).expect("a model");
    let text = bytes(&collected.model(), false).expect("a scene without own laws");
    let tables = RoomTables::<S>::read(&text).expect("a model");
    let mut worst = 0.0_f64;
    for model in [flash, tables.model()] {
        let mut solver = Room::<S>::new(&model).expect("room");
        // the second run starts again from the start of the model
        for _ in 0..2 {
            let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
            for k in 0..STEPS {
                for (number, &signal) in inputs.iter().enumerate() {
                    let value = input(number, k);
                    let set = tree.prescribed().set_signal(&mut state.inputs, signal, value);
                    set.expect("an input");
                    solver.set_input(signal, [value, 0.0, 0.0]).expect("an input");
                }
                let work = (1e-3, &Options::default(), Bounds::default());
                tree.bounded_step(work, &mut state, &mut workspace).expect("a step");
                let before = allocations::count();
                solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
                assert_eq!(allocations::count(), before, "step {k}");
                let own = [solver.coordinates(), solver.velocities(), solver.accelerations()];
                let own = own.concat().into_iter();
                let own = own.chain(solver.signal_states().as_flattened().iter().copied());
                let host = [&state.z[..], &state.v, &state.a].concat().into_iter();
                let host = host.chain(state.signals.as_flattened().iter().copied());
                for (x, y) in own.zip(host) {
                    worst = worst.max((x - y).abs() / (1.0 + y.abs()));
                }
            }
            assert!(state.v.iter().any(|v| v.abs() > 1e-3), "it moves: {:?}", state.v);
            solver.restart(&model);
        }
    }
    worst
}

#[test]
fn an_arm_with_controllers_at_its_joints_steps_as_on_the_host() {
    let apart = apart::<Planar, 2>(&mbs_testkit::scene(ARM));
    assert!(apart < 1e-12, "{apart:e}");
}

#[test]
fn a_drive_line_with_throttle_and_brake_steps_as_on_the_host() {
    let apart = apart::<Planar, 2>(&mbs_testkit::scene(LINE));
    assert!(apart < 1e-12, "{apart:e}");
}

#[test]
fn an_arm_in_space_with_servos_steps_as_on_the_host() {
    let apart = apart::<Spatial, 3>(&mbs_testkit::file("servo-arm"));
    assert!(apart < 1e-10, "{apart:e}");
}

/// Returns a model as bytes.
fn exported(text: &str) -> Vec<u8> {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    bytes(&collected.model(), false).expect("a scene without own laws")
}

#[test]
fn whatever_word_of_signals_is_broken_nothing_panics() {
    for text in [ARM, LINE].map(exported) {
        let (mut refused, mut stepped) = (0, 0);
        for at in (0..text.len() - 3).step_by(4) {
            for word in [u32::MAX, 1, 0x7f, 0x7ff8_0000] {
                let mut broken = text.clone();
                broken[at..at + 4].copy_from_slice(&word.to_le_bytes());
                let Ok(tables) = RoomTables::<Planar>::read(&broken) else {
                    refused += 1;
                    continue;
                };
                let model = tables.model();
                let Ok(mut solver) = Room::<Planar>::new(&model) else { continue };
                for _ in 0..3 {
                    let _ = solver.step(&model, 1e-3, &mut Unwatched);
                }
                stepped += 1;
            }
            RoomTables::<Planar>::read(&text[..at]).expect_err("cut off");
        }
        assert!(refused > 200 && stepped > 200, "{refused} {stepped}");
    }
}

#[test]
fn numbers_of_operations_that_point_outside_are_refused() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(LINE));
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let model = collected.model();
    let n_courses = u32::try_from(model.prescriptions.courses.len()).expect("few courses");
    let curves = model.mechanism.loops.couplings.curves;
    assert_eq!(curves.len(), 3, "each function once: {curves:?}");
    let first = model.mechanism.feedback.steps[0];
    let refused = |operation: FeedbackOperation<f64>, to: u32| {
        let steps = [first, FeedbackStep { to, operation }];
        let mut broken = model;
        broken.mechanism.feedback.steps = &steps;
        assert_eq!(
            Checked::new(&broken).map(drop),
            Err(LoadError::Index { table: "operations", entry: 1 }),
            "{operation:?}"
        );
    };
    let limits = [0.0, 1.0];
    refused(FeedbackOperation::Constant(1.0), n_courses);
    refused(FeedbackOperation::Value { number: 1 }, 0);
    refused(FeedbackOperation::Add { from: n_courses, factor: 1.0 }, 0);
    refused(FeedbackOperation::Curve { from: 0, curve: 3 }, 0);
    refused(FeedbackOperation::Integral { from: 0, state: 2, limits }, 0);
    refused(FeedbackOperation::Lag { from: n_courses, state: 0, time: 1.0 }, 0);
    let pid = |from| FeedbackOperation::Pid { from, state: 0, gains: [1.0; 3], limit: 1.0 };
    refused(pid([n_courses, 0]), 0);
    refused(pid([0, n_courses]), 0);
    refused(FeedbackOperation::Component { from: 0, component: 3 }, 0);
    refused(FeedbackOperation::Force { from: 0, on: 1 }, 0);
    for link in [0, 9] {
        let mut broken = model;
        let links = [link];
        broken.mechanism.feedback.links = &links;
        let refused = LoadError::Index { table: "measured coordinates", entry: 0 };
        assert_eq!(Checked::new(&broken).map(drop), Err(refused));
    }
}

#[test]
fn a_solver_without_room_for_signals_says_what_it_lacks() {
    type Small = Solver<f64, Planar, 4, 4, 4, 4, 64, 64, 2, 24>;
    let tables = exported(ARM);
    let tables = RoomTables::<Planar>::read(&tables).expect("a model");
    let refused = Small::new(&tables.model()).expect_err("no room");
    assert_eq!(refused, LoadError::Capacity { of: "states of signals", needed: 1, capacity: 0 });
}

#[test]
fn signals_of_constants_alone_are_constants_of_the_tables() {
    let more = "[[signal]]\nname = \"two\"\nkind = \"constant\"\nvalue = 2.0\n\
        [[signal]]\nname = \"four\"\nkind = \"product\"\nof = [\"two\", \"two\"]\n";
    let plain = ARM.split("[[signal]]").next().expect("a beginning");
    let torque = "[[effect]]\nkind = \"torque\"\njoint = \"elbow\"\nsignal = \"four\"\n";
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(&format!("{plain}{more}{torque}")));
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let model = collected.model();
    assert!(model.mechanism.feedback.steps.is_empty());
    assert_eq!(model.prescriptions.courses[2], SignalLaw::Constant([4.0, 0.0, 0.0]));
    let text = source(&model, ("A scene", false)).expect("tables");
    assert!(text.contains("FeedbackSlices::none()") && text.contains("0, 0, 0, 3>;"), "{text}");
}

#[allow(unreachable_pub, reason = "`mbs export` writes a module of a crate")]
#[rustfmt::skip]
#[path = "line.rs"]
mod line;

#[test]
fn the_source_of_the_drive_line_is_the_committed_one_and_compiles_to_its_tables() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(LINE));
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let text = source(&collected.model(), ("The scene of a drive line", false)).expect("tables");
    if std::env::var_os("MBS_WRITE_DOCS").is_some() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/line.rs");
        std::fs::write(file, &text).expect("a file of the repository");
    }
    assert_eq!(text, include_str!("line.rs"), "MBS_WRITE_DOCS=1 writes it anew");
    assert_eq!(elements(&collected.model()), ["signals"]);
    let model = Checked::new(&line::MODEL).expect("a model");
    assert_eq!(bytes(model.model(), false), bytes(&collected.model(), false));
    let mut solver = line::ModelSolver::new(&model).expect("a solver of just its size");
    solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
}
