//! Couplings with curves and with lines over points on a controller, compared with the steps of the host and with closed forms.

use crate::support::start;
use mbs_core::step::StepError;
use mbs_nostd::export::{Collected, bytes, elements, source};
use mbs_nostd::format::{Axes, Record};
use mbs_nostd::table::{Couplings, CurveTable, Span, SumMeasure};
use mbs_nostd::{
    Bounds, Checked, LoadError, Options, Planar, Real, Solver, Spatial, Tables, Unwatched,
};
use mbs_recursive::Workspace;
use mbs_testkit::{allocations, repository};

type Room<T, S> = Solver<T, S, 8, 16, 16, 8, 64, 64, 2, 12, 2, 12, 6, 8>;
type RoomTables<T, S> = Tables<T, S, 8, 4, 8, 32, 8, 32, 12, 16, 16, 16>;

/// A cam that lifts a slide, and a rope from a drum over the slide and a load.
pub(crate) const HOIST: &str = include_str!("hoist.toml");
/// A cam and a rope as in [`HOIST`], but in space, with axes in different directions.
pub(crate) const WINCH: &str = include_str!("winch.toml");

/// Number of steps of each comparison [-].
const STEPS: u32 = 500;

fn exported<S: Axes<f64>, const D: usize>(text: &str) -> Vec<u8> {
    let (tree, begin) = start::<S, D>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    bytes(&collected.model(), false).expect("a scene of tables")
}

/// Returns the largest difference of coordinates, velocities, accelerations and multipliers from the recursion, over steps of 1 ms.
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
        tree.bounded_step(work, &mut state, &mut workspace)
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
    let cam = file("cam-follower");
    assert_eq!(apart::<Planar, 2>(&cam), Ok(0.0));
    for way in ["monotone", "spline"] {
        let periodic = "periodic = true\n";
        let shaped = cam.replace(periodic, &format!("{periodic}interpolation = \"{way}\"\n"));
        assert_ne!(shaped, cam);
        assert_eq!(apart::<Planar, 2>(&shaped), Ok(0.0));
    }
    assert_eq!(apart::<Planar, 2>(&file("crane")), Ok(0.0));
    assert_eq!(apart::<Planar, 2>(HOIST), Ok(0.0));
    assert_eq!(apart::<Spatial, 3>(WINCH), Ok(0.0));
}

/// A rope over a slide and the load that may be slack, and a spring on a curve of the shaft's angle.
pub(crate) const SUMS: &str = r#"
[[effect]]
name = "sling"
kind = "spring-damper"
stiffness = 300.0
damping = 4.0
pulls_only = true
points = [{ body = "ground", at = [1.5, 0.2] }, { body = "load", at = [0.7, -0.4] }, { body = "slide", at = [0.1, 0.3] }]
[[effect]]
kind = "torsion-spring"
stiffness = 2.0
damping = 0.1
free_value = 0.4
terms = [{ joint = "shaft", factor = 0.5, coefficients = [0.0, 1.0, 0.1] }, { joint = "axle", factor = -1.0 }]
"#;

#[test]
fn effects_on_lengths_and_curves_have_the_bits_of_the_recursion_on_a_controller() {
    assert_eq!(apart::<Planar, 2>(&format!("{HOIST}{SUMS}")), Ok(0.0));
    // the effects of the scene without its couplings
    let alone = HOIST.split("[[coupling]]").next().expect("what stands before");
    let start = "[[initial]]\njoint = \"shaft\"\nvalue = 0.3\nrate = 15.0\n";
    assert_eq!(apart::<Planar, 2>(&format!("{alone}{start}{SUMS}")), Ok(0.0));
}

#[test]
fn curves_of_couplings_stand_beside_those_of_signals() {
    let signals = r#"
[[signal]]
name = "speed"
kind = "measure"
joint = "shaft"
quantity = "rate"
[[signal]]
name = "falls"
kind = "curve"
of = "speed"
table = [[0.0, 2.0], [10.0, 1.0], [30.0, 0.0]]
[[effect]]
kind = "torque"
joint = "axle"
signal = "falls"
"#;
    let text = format!("{HOIST}{signals}");
    // signals agree to rounding, as the tests of signals show
    let apart = apart::<Planar, 2>(&text).expect("a model");
    assert!(apart < 1e-9, "{apart:e}");
    assert_eq!(version(&exported::<Planar, 2>(&text)), 2 + 2 + 8);
}

/// Returns the version of a model in bytes.
fn version(text: &[u8]) -> u32 {
    u32::from_le_bytes([text[4], text[5], text[6], text[7]])
}

#[test]
fn texts_say_by_their_version_whether_curves_and_lines_follow() {
    let [cam, rope] = ["cam-follower", "crane"].map(|name| exported::<Planar, 2>(&file(name)));
    assert_eq!([version(&cam), version(&rope)], [2 + 4, 2 + 8]);
    assert_eq!(version(&exported::<Planar, 2>(HOIST)), 2 + 4 + 8);
    let alone = HOIST.split("[[coupling]]").next().expect("what stands before");
    assert_eq!(version(&exported::<Planar, 2>(alone)), 2);
    // versions that are refused: curves that are present twice, and unknown parts
    for unknown in [2 + 2 + 4, 2 + 16, 1] {
        let mut broken = cam.clone();
        broken[4..8].copy_from_slice(&u32::to_le_bytes(unknown));
        let refused = RoomTables::<f64, Planar>::read(&broken).err();
        assert_eq!(refused, Some(LoadError::Format), "{unknown}");
    }
}

/// Returns the coordinates after some steps in the precision of `T`.
fn after<T: Real + Record, S: Axes<T>>(text: &[u8], (steps, dt): (u32, f64)) -> Vec<f64> {
    let tables = RoomTables::<T, S>::read(text).expect("a model");
    let model = tables.model();
    let mut solver = Room::<T, S>::new(&model).expect("room");
    for _ in 0..steps {
        solver.step(&model, T::from_f64(dt), &mut Unwatched).expect("a step");
    }
    solver.coordinates().iter().map(|x| x.to_f64()).collect()
}

/// Returns the largest difference between a coordinate in single precision and in double precision.
fn apart_in_single<S: Axes<f64> + Axes<f32>, const D: usize>(text: &str) -> f64 {
    let (tree, begin) = start::<S, D>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let [double, single] =
        [false, true].map(|is_single| bytes(&collected.model(), is_single).expect("tables"));
    let exact = after::<f64, S>(&double, (STEPS, 1e-3));
    let near = after::<f32, S>(&single, (STEPS, 1e-3));
    exact.iter().zip(near).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn in_single_precision_cams_and_ropes_stay_near_the_run_in_double() {
    // a step rounds angles of about 8 rad to 5e-7; 500 rounding errors of the same sign are 2.4e-4
    const NEAR: f64 = 2.4e-4;
    for apart in [
        apart_in_single::<Planar, 2>(&file("cam-follower")),
        apart_in_single::<Planar, 2>(&file("crane")),
        apart_in_single::<Planar, 2>(HOIST),
        apart_in_single::<Spatial, 3>(WINCH),
    ] {
        assert!(apart < NEAR, "{apart:e}");
    }
}

/// Returns a scene with masses of 3 kg and 2 kg on slides. A rope connects them over two points of the ground.
fn atwood(below: f64) -> String {
    let mut text = String::from(
        "[scene]\nname = \"atwood\"\ndimension = 2\nduration = 2.0\ngravity = [0.0, -9.81]\n",
    );
    for (i, (mass, depth)) in [(3.0, 2.0), (2.0, below)].into_iter().enumerate() {
        let at = format!("[{i}.0, {:?}]", 1.0 - depth);
        text += &format!(
            "[[body]]\nname = \"b{i}\"\nmass = {mass:?}\ncenter = {at}\ninertia = 0.1\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"b{i}\"]\nat = {at}\naxis = [0.0, 1.0]\n"
        );
    }
    text + &format!(
        "[[coupling]]\nkind = \"rope\"\npoints = [{{ body = \"b0\", at = [0.0, -1.0] }}, {{ body = \"ground\", at = [0.0, 1.0] }}, \
         {{ body = \"ground\", at = [1.0, 1.0] }}, {{ body = \"b1\", at = [1.0, {:?}] }}]\n",
        1.0 - below
    )
}

#[test]
fn the_heavier_of_two_masses_on_a_rope_falls_with_a_fifth_of_gravity() {
    // a = (3 - 2)/(3 + 2) g = 1.962 m/s²: a displacement of 0.981 m in a second
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(&atwood(2.0)));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let [double, single] =
        [false, true].map(|is_single| bytes(&collected.model(), is_single).expect("tables"));
    for (z, near) in [
        // limits for the rounding errors of a thousand steps in each precision
        (after::<f64, Planar>(&double, (1000, 1e-3)), 1e-12),
        (after::<f32, Planar>(&single, (1000, 1e-3)), 1e-4),
    ] {
        assert!((z[0] + 0.981).abs() < near && (z[1] - 0.981).abs() < near, "{z:?}");
    }
    // T = 2·3·2/(3 + 2) g = 23.544 N. The multiplier belongs to the sum divided by its largest factor; this factor is one here.
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::<f64, Planar>::new(&model).expect("room");
    solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
    // one sweep leaves an error of the fraction ε = 1e-10 of the force, where ε is the regularisation
    assert!((solver.multipliers()[0].abs() - 23.544).abs() < 1e-8, "{:?}", solver.multipliers());
}

#[test]
fn a_part_of_a_rope_that_collapses_stops_a_controller_with_its_number() {
    // half a metre with 1.962 m/s² takes 0.714 s
    let text = exported::<Planar, 2>(&atwood(0.5));
    let tables = RoomTables::<f64, Planar>::read(&text).expect("a model");
    let model = tables.model();
    let mut solver = Room::<f64, Planar>::new(&model).expect("room");
    let stopped = (0..1000).find_map(|step| {
        let before = solver.coordinates().to_vec();
        let error = solver.step(&model, 1e-3, &mut Unwatched).err()?;
        assert_eq!(solver.coordinates(), before, "the state is unchanged");
        Some((step, error))
    });
    let (step, error) = stopped.expect("the lighter mass arrives at its point");
    assert_eq!(error, StepError::RopeCollapsed { coupling: 0, part: 2 });
    assert!((712..=716).contains(&step), "{step}");
}

/// A cam without gravity, with the lift 0.05 a + 0.1 a² of its follower at the angle a.
const BY_COEFFICIENTS: &str = r#"
[scene]
name = "cam"
dimension = 2
duration = 1.0
[[body]]
name = "cam"
mass = 2.0
center = [0.0, 0.0]
inertia = 0.01
[[body]]
name = "follower"
mass = 0.5
center = [0.0, 0.1]
inertia = 1.0e-4
[[joint]]
name = "shaft"
kind = "revolute"
bodies = ["ground", "cam"]
at = [0.0, 0.0]
[[joint]]
name = "guide"
kind = "prismatic"
bodies = ["ground", "follower"]
at = [0.0, 0.1]
axis = [0.6, 0.8]
[[coupling]]
kind = "cam"
joints = ["shaft", "guide"]
coefficients = [0.0, 0.05, 0.1]
[[initial]]
joint = "shaft"
value = 0.0
rate = 4.0
"#;

/// Returns the angle of the cam in [`BY_COEFFICIENTS`] after a time, by the Runge-Kutta method of order 4. The rate follows from the energy
/// (I + m f'²) a'²/2, which is constant.
fn angle_of_cam(duration: f64) -> f64 {
    let slope = |a: f64| {
        let [f, f0] = [0.05 + 0.2 * a, 0.05];
        4.0 * ((0.01 + 0.5 * f0 * f0) / (0.01 + 0.5 * f * f)).sqrt()
    };
    let n = 10_000;
    let h = duration / f64::from(n);
    (0..n).fold(0.0, |a, _| {
        let k1 = slope(a);
        let k2 = slope(a + h / 2.0 * k1);
        let k3 = slope(a + h / 2.0 * k2);
        let k4 = slope(a + h * k3);
        a + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    })
}

#[test]
fn the_angle_of_a_cam_meets_its_equation_of_energy_with_second_order() {
    let text = exported::<Planar, 2>(BY_COEFFICIENTS);
    let exact = angle_of_cam(0.4);
    let [coarse, fine] =
        [(200, 2e-3), (400, 1e-3)].map(|work| (after::<f64, Planar>(&text, work)[0] - exact).abs());
    assert!(fine < 1e-4, "{fine:e}");
    assert!((coarse / fine - 4.0).abs() < 0.4, "{coarse:e} {fine:e}");
}

#[test]
fn a_cam_drifts_and_is_projected() {
    let text = exported::<Planar, 2>(BY_COEFFICIENTS);
    let tables = RoomTables::<f64, Planar>::read(&text).expect("a model");
    let model = tables.model();
    let left = |projections: u32| {
        let mut solver = Room::<f64, Planar>::new(&model).expect("room");
        solver.bounds = Bounds { projections, ..Bounds::default() };
        let mut largest = [0.0_f64; 2];
        for _ in 0..400 {
            solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
            let ([a, s], [w, v]) = (numbers(solver.coordinates()), numbers(solver.velocities()));
            let [phi, rate] = [s - 0.05 * a - 0.1 * a * a, v - (0.05 + 0.2 * a) * w];
            largest = [largest[0].max(phi.abs()), largest[1].max(rate.abs())];
        }
        largest
    };
    let ([drift, rates], [kept, kept_rates]) = (left(0), left(1));
    assert!(drift > 1e-7 && rates > 1e-6, "{drift:e} {rates:e}");
    // a projection leaves the second-order part of the correction: f''/2 times the square of the correction, which is below 1e-11
    assert!(kept < 1e-10 && kept_rates < 1e-6, "{kept:e} {kept_rates:e}");
}

fn numbers(of: &[f64]) -> [f64; 2] {
    of.try_into().expect("two numbers")
}

#[test]
fn what_has_no_room_for_curves_and_lines_says_what_it_lacks() {
    type Uncurved = Solver<f64, Planar, 8, 16, 16, 8, 64, 64, 2, 12, 2, 12, 6>;
    type Unlined = Tables<f64, Planar, 8, 4, 8, 32, 8, 32, 12, 16, 16>;
    let text = exported::<Planar, 2>(HOIST);
    let tables = RoomTables::<f64, Planar>::read(&text).expect("a model");
    let refused = Uncurved::new(&tables.model()).err();
    let needed = LoadError::Capacity { of: "terms with curves", needed: 2, capacity: 0 };
    assert_eq!(refused, Some(needed));
    let refused = Unlined::read(&text).err();
    let needed = LoadError::Capacity { of: "points of lines", needed: 5, capacity: 0 };
    assert_eq!(refused, Some(needed));
}

#[test]
fn numbers_of_points_links_and_curves_that_point_outside_are_refused_with_their_place() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(HOIST));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let model = collected.model();
    let couplings = model.mechanism.loops.couplings;
    let refused = |couplings: Couplings<'_, f64, Planar>| {
        let mut broken = model;
        broken.mechanism.loops.couplings = couplings;
        Checked::new(&broken).map(drop)
    };
    let index = |table: &'static str, entry: usize| Err(LoadError::Index { table, entry });
    assert_eq!(refused(couplings), Ok(()));
    let terms = changed(couplings.terms, 1, |term| term.curve = 1);
    assert_eq!(refused(Couplings { terms, ..couplings }), index("loops", 0));
    for span in [Span { first: 0, end: 6 }, Span { first: 3, end: 2 }, Span { first: 0, end: 1 }] {
        let of = SumMeasure::Line { points: span, reference: 0.0 };
        let terms = changed(couplings.terms, 2, |term| term.of = of);
        assert_eq!(refused(Couplings { terms, ..couplings }), index("loops", 1));
    }
    let points = changed(couplings.points, 3, |point| point.start = 3);
    assert_eq!(refused(Couplings { points, ..couplings }), index("loops", 1));
    let starts = changed(couplings.starts, 2, |start| start.link = 5);
    assert_eq!(refused(Couplings { starts, ..couplings }), index("links of lines", 2));
    let starts = couplings.starts.split_last().expect("links").1;
    assert_eq!(refused(Couplings { starts, ..couplings }), index("loops", 1));
    let long = CurveTable::Spline { knots: Span { first: 0, end: 7 }, first: 1, period: 0.0 };
    let curves = changed(couplings.curves, 0, |curve| *curve = long);
    assert_eq!(refused(Couplings { curves, ..couplings }), index("curves", 0));
}

/// Returns a table with one entry changed.
fn changed<X: Copy>(table: &[X], i: usize, change: impl Fn(&mut X)) -> &'static [X] {
    let mut table = table.to_vec();
    change(&mut table[i]);
    table.leak()
}

#[test]
fn whatever_word_of_a_cam_and_a_rope_is_broken_nothing_panics() {
    let of = [exported::<Planar, 2>(HOIST), exported::<Planar, 2>(&format!("{HOIST}{SUMS}"))];
    for text in of {
        let (mut refused, mut stepped) = (0, 0);
        for at in (0..text.len() - 3).step_by(4) {
            for word in [u32::MAX, 1, 3, 0x7f, 0x7ff8_0000] {
                let mut broken = text.clone();
                broken[at..at + 4].copy_from_slice(&word.to_le_bytes());
                let Ok(tables) = RoomTables::<f64, Planar>::read(&broken) else {
                    refused += 1;
                    continue;
                };
                let model = tables.model();
                let Ok(mut solver) = Room::<f64, Planar>::new(&model) else { continue };
                for _ in 0..3 {
                    let _ = solver.step(&model, 1e-3, &mut Unwatched);
                }
                stepped += 1;
            }
            RoomTables::<f64, Planar>::read(&text[..at]).expect_err("cut off");
        }
        assert!(refused > 500 && stepped > 500, "{refused} {stepped}");
    }
}

#[allow(unreachable_pub, reason = "`mbs export` writes a module of a crate")]
#[allow(clippy::approx_constant, reason = "the period of a cam is a number of its scene")]
#[rustfmt::skip]
#[path = "hoist.rs"]
mod hoist;

#[test]
fn the_source_of_the_hoist_is_the_committed_one_and_compiles_to_its_tables() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(HOIST));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let text = source(&collected.model(), ("The scene of a hoist", false)).expect("tables");
    if std::env::var_os("MBS_WRITE_DOCS").is_some() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/hoist.rs");
        std::fs::write(file, &text).expect("a file of the repository");
    }
    assert_eq!(text, include_str!("hoist.rs"), "MBS_WRITE_DOCS=1 writes it anew");
    assert_eq!(elements(&collected.model()), ["couplings", "curves", "lines"]);
    let model = Checked::new(&hoist::MODEL).expect("a model");
    assert_eq!(bytes(model.model(), false), bytes(&collected.model(), false));
    let mut solver = hoist::ModelSolver::new(&model).expect("a solver of just its size");
    solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
}
