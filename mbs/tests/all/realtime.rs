//! Runs that are synchronised with a clock: their results, and the state after a change of level. No test asserts a real time, because the
//! test sets its clocks.

mod document;

use crate::common;
use crate::common::allocations;
use mbs::realtime::{Clock, Degrade, Overrun, Pacing, PacingError, Recovery};
use mbs::scene_file::SceneFile;
use mbs::typed::Simulation;
use mbs::{
    Mechanism, Method, Outcome, ResolvedMethod, Run, RunResult, SwitchError, Watchers, run_with,
};
use std::cell::Cell;
use std::time::Duration;

/// Clock that advances only while a run waits for it. One sleep may be too long. The clock records the allocations between its first and last
/// reading.
#[derive(Default)]
struct ScriptedClock {
    time: Cell<Duration>,
    /// Number of the sleep that is too long, from 1, and the excess.
    oversleeps: Option<(u32, Duration)>,
    sleeps: u32,
    allocations: Cell<Option<[u64; 2]>>,
}

impl Clock for ScriptedClock {
    fn now(&self) -> Duration {
        let count = allocations::count();
        let [first, _] = self.allocations.get().unwrap_or([count; 2]);
        self.allocations.set(Some([first, count]));
        self.time.get()
    }

    fn sleep(&mut self, time: Duration) {
        self.sleeps += 1;
        let late =
            self.oversleeps.filter(|(n, _)| *n == self.sleeps).map_or(Duration::ZERO, |o| o.1);
        self.time.set(self.time.get() + time + late);
    }

    fn pause(&mut self) {
        self.time.set(self.time.get() + Duration::from_micros(10));
    }
}

fn document(name: &str) -> SceneFile {
    let bytes = std::fs::read(common::path(name)).expect("the scene is in the repository");
    SceneFile::from_bytes(&bytes, name).expect("a document")
}

/// Runs a scene with pacing, on a clock that the test sets.
fn paced(
    document: &SceneFile,
    overrides: &Method,
    pacing: &Pacing,
    clock: &mut ScriptedClock,
) -> Result<Outcome, PacingError> {
    let mechanism = Mechanism::of_file(document.clone()).expect("a scene");
    let options = Run::new().method(overrides.clone()).pacing(pacing.clone());
    let run = run_with(&mechanism, &options, &mut Watchers::clock(clock));
    run.map(RunResult::into_outcome)
        .map_err(|error| error.cause::<PacingError>().expect("a refusal of the pace").clone())
}

/// Runs a scene without pacing.
fn plain(document: &SceneFile, overrides: &Method) -> Outcome {
    let mechanism = Mechanism::of_file(document.clone()).expect("a scene");
    let run = mbs::run(&mechanism, &Run::new().method(overrides.clone()));
    run.expect("a run").into_outcome()
}

fn asked(formulation: &str, step: f64, duration: f64) -> Method {
    Method {
        formulation: Some(formulation.to_owned()),
        step: Some(step),
        duration: Some(duration),
        ..Method::default()
    }
}

#[test]
fn pacing_changes_no_bit_of_the_results() {
    for (name, formulation) in [
        ("double-pendulum", "index-3"),
        ("spatial-four-bar", "index-1"),
        ("andrews", "classical"),
        ("slider-crank", "state-space"),
        ("rssr", "recursive"),
    ] {
        let document = document(name);
        // the duration is no multiple of the period, so the last period is shorter
        let step = document.scene::<f64>().expect("a scene").duration / 2000.5;
        let overrides = Method { duration: None, ..asked(formulation, step, 1.0) };
        let plain = plain(&document, &overrides);
        let run = paced(&document, &overrides, &Pacing::default(), &mut ScriptedClock::default());
        let run = run.expect("it is paced");
        assert!(plain.summary.completed && run.summary.completed, "{name}");
        assert_eq!(plain.rows(), run.rows(), "{name}");
        let realtime = run.summary.realtime.expect("it was paced");
        assert_eq!((realtime.periods, realtime.overruns), (2001, 0), "{name}");
    }
}

#[test]
fn a_period_of_several_steps_has_the_results_of_these_steps() {
    let document = document("double-pendulum");
    let fine = asked("index-3", 1e-3, 0.5);
    let plain = plain(&document, &fine);
    let pacing = Pacing { period: Some(5e-3), ..Pacing::default() };
    let run = paced(&document, &fine, &pacing, &mut ScriptedClock::default()).expect("it is paced");
    assert_eq!((run.rows().len(), run.summary.steps), (101, 500));
    // 5e-3 / 5 is not exactly 1e-3, but the motion is not chaotic yet, so the difference stays small
    for ((t, a), (u, b)) in run.rows().iter().zip(plain.rows().iter().step_by(5)) {
        assert!((t - u).abs() < 1e-12);
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11), "{t}: {a:?} {b:?}");
    }
    // with controlled steps, each period must end exactly at its time
    let controlled =
        Method { error_tolerance: Some(1e-6), step_max: Some(0.05), ..asked("index-3", 1e-3, 0.5) };
    let run =
        paced(&document, &controlled, &pacing, &mut ScriptedClock::default()).expect("it is paced");
    assert!(run.summary.completed && run.rows().len() == 101);
    for (k, (t, row)) in run.rows().iter().enumerate() {
        assert!((t - k as f64 * 5e-3).abs() < 1e-12, "{t}");
        let near = &plain.rows()[5 * k].1;
        // both runs have errors of about 1e-5 m
        assert!(row.iter().zip(near).all(|(a, b)| (a - b).abs() < 1e-4), "{t}");
    }
}

/// Scene of a mass that moves on a rail between a spring and a damper.
const SLIDER: &str = r#"
[scene]
dimension = 2
duration = 2.0
gravity = [0.0, -9.81]
[[body]]
name = "slide"
mass = 2.0
center = [0.0, 0.0]
inertia = 0.1
[[joint]]
name = "rail"
kind = "prismatic"
bodies = ["ground", "slide"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
[[initial]]
joint = "rail"
value = 0.5
rate = 1.0
[[effect]]
name = "spring"
kind = "spring-damper"
bodies = ["ground", "slide"]
points = [[-2.0, 0.0], [0.0, 0.0]]
stiffness = 300.0
free_length = 2.0
[[output]]
name = "rail"
quantity = "value"
joint = "rail"
[[output]]
name = "held"
quantity = "reaction"
joint = "rail"
"#;

fn slider() -> SceneFile {
    SceneFile::parse(SLIDER, "slider.toml").unwrap_or_else(|e| panic!("{}", e.render()))
}

const FORMULATIONS: [&str; 4] = ["index-3", "index-1", "multi-index", "recursive"];

/// A simulation of the slider with its spring on or off.
fn slide(formulation: &str, is_on: bool) -> Simulation<f64, 2> {
    let mut scene = slider().scene::<f64>().expect("a scene");
    scene.effects[0].enabled = is_on;
    let settings = ResolvedMethod::new(&scene, &asked(formulation, 1e-3, 2.0)).expect("settings");
    Simulation::new(&scene, &settings).expect("it starts")
}

/// Position, velocity and acceleration along the rail.
fn motion(simulation: &Simulation<f64, 2>) -> [f64; 3] {
    use mbs::core::scene::BodyId;
    let point = simulation.model().point(BodyId::Body(0), [0.0; 3]);
    let state = simulation.state();
    [point.value(&state.q)[0], point.rate(&state.v)[0], point.rate(&state.a)[0]]
}

#[test]
fn a_spring_that_is_taken_away_leaves_a_mass_that_moves_on_evenly_and_one_that_comes_back_pulls_at_once()
 {
    for formulation in FORMULATIONS {
        let [mut full, mut less] = [true, false].map(|is_on| slide(formulation, is_on));
        assert_eq!(less.takes_over(&full), Ok(()), "{formulation}");
        for _ in 0..100 {
            full.step(1e-3).expect("a regular step");
        }
        let [x, v, a] = motion(&full);
        assert!((a + 150.0 * x).abs() < 1e-8, "{formulation}: k / m = 150 / s^2, but {a} at {x}");
        let invariant = full.invariant().error();
        less.take_over(&full).expect("it goes on");
        for _ in 0..200 {
            less.step(1e-3).expect("a regular step");
        }
        // uniform motion is exact in every rule, to the rounding of 200 steps; half a step with the old force would give an error of 1e-2 m
        let [x_less, v_less, a_less] = motion(&less);
        assert!((x_less - x - 0.2 * v).abs() < 1e-11, "{formulation}: {x_less}");
        assert!((v_less - v).abs() < 1e-11 && a_less.abs() < 1e-8, "{formulation}");
        assert!((less.state().t - 0.3).abs() < 1e-12);
        // the energy of the removed spring counts as work, so the invariant continues without a jump
        assert!((less.invariant().error() - invariant).abs() < 1e-10, "{formulation}");
        full.take_over(&less).expect("it comes back");
        let [x, _, a] = motion(&full);
        assert!((x - x_less).abs() < 1e-14 && (a + 150.0 * x).abs() < 1e-8, "{formulation}: {a}");
        // the trapezoidal rule conserves the energy of a linear motion
        for _ in 0..200 {
            full.step(1e-3).expect("a regular step");
        }
        assert!((full.invariant().error() - invariant).abs() < 1e-9, "{formulation}");
    }
}

#[test]
fn a_state_taken_over_with_the_same_effects_continues_as_if_it_had_stayed() {
    for (name, formulation) in
        [("spinning-top", "index-3"), ("rssr", "index-1"), ("spatial-four-bar", "recursive")]
    {
        let scene = common::scene(name);
        let settings = common::settings(&scene, formulation, Some(1e-3));
        let new = || Simulation::<f64, 3>::new(&scene, &settings).expect("it starts");
        let (mut one, mut other) = (new(), new());
        for k in 0..200 {
            if k % 40 == 39 {
                other.take_over(&one).expect("it goes on");
                core::mem::swap(&mut one, &mut other);
            }
            one.step(1e-3).expect("a regular step");
        }
        let mut stayed = new();
        for _ in 0..200 {
            stayed.step(1e-3).expect("a regular step");
        }
        let apart = one.state().q.iter().zip(&stayed.state().q).map(|(a, b)| (a - b).abs());
        // accelerations are solved for again, with a tolerance of 1e-10 of their displacement in a step
        assert!(apart.fold(0.0, common::worst) < 1e-9, "{name} {formulation}");
    }
}

/// Runs a scene with pacing, on a clock with one sleep of fifty periods too much. The run is then late in more consecutive periods than its
/// limit allows, and degrades.
fn degraded(document: &SceneFile, overrides: &Method, words: &[&str]) -> (Outcome, ScriptedClock) {
    let pacing = Pacing {
        overrun: Overrun::Degrade,
        degrade: Degrade::Listed(words.iter().map(|&word| word.to_owned()).collect()),
        quiet: Recovery { tasks: 30, ..Recovery::default() },
        period: Some(4e-3),
        ..Pacing::default()
    };
    let late = Duration::from_millis(200);
    let mut clock = ScriptedClock { oversleeps: Some((100, late)), ..ScriptedClock::default() };
    let run = paced(document, overrides, &pacing, &mut clock);
    (run.unwrap_or_else(|e| panic!("{e}")), clock)
}

#[test]
fn degraded_periods_are_marked_in_rows_log_and_notes_and_the_full_scene_comes_back() {
    // multi-index controls its steps, so degradation does not lengthen them
    for formulation in ["index-3", "index-1", "recursive"] {
        let overrides = asked(formulation, 1e-3, 2.0);
        let (run, _) = degraded(&slider(), &overrides, &["steps", "spring"]);
        assert!(run.summary.completed, "{formulation}");
        let realtime = run.summary.realtime.clone().expect("it was paced");
        // sleep 100 is before period 101, the first late one; the level changes after eleven late periods in a row, twice
        let log: Vec<_> = realtime
            .log
            .iter()
            .filter(|entry| entry.action != "finished")
            .map(|entry| (entry.index, entry.level, entry.next_level))
            .collect();
        let changes = [(110, 0, 1), (121, 1, 2)];
        assert_eq!(log[..2], changes, "{formulation}");
        assert_eq!(log.len(), 4);
        assert_eq!(log[2..].iter().map(|(_, a, b)| (*a, *b)).collect::<Vec<_>>(), [(2, 1), (1, 0)]);
        let (up, last) = (log[2].0, log[3].0);
        let expected = |k: u64| match k {
            k if k > 110 && k <= 121 => 1.0,
            k if k > 121 && k <= up => 2.0,
            k if k > up && k <= last => 1.0,
            _ => 0.0,
        };
        for (row, k) in run.rows()[1..].iter().zip(0..) {
            let level = *row.1.last().expect("the level stands last");
            assert!((level - expected(k)).abs() < 1e-15, "{formulation}: period {k}: {level}");
        }
        assert_eq!(realtime.degraded_periods, last - 110);
        assert_eq!(realtime.levels[2].without, ["spring"]);
        assert!((realtime.levels[2].step_times - 2.0).abs() < 1e-15);
        assert!(run.notes().iter().any(|note| note.contains("were degraded")));
        // the motion is uniform while the spring is off, and its energy counts as work: the invariant has no jump
        let place = |k: u64| run.rows()[k as usize].1[0];
        let even = (place(up) - place(up - 5)) - (place(up - 5) - place(up - 10));
        assert!(even.abs() < 1e-10, "{formulation}: {even}");
        assert!(run.summary.energy.max_error < 1e-7, "{formulation}: {:?}", run.summary.energy);
        // the rail carries the weight only, all the time: the removed spring exerts no force
        for (t, row) in run.rows() {
            let [along, across] = [row[1], row[2]];
            assert!(along.abs() < 1e-6 && (across.abs() - 19.62).abs() < 1e-6, "{t}: {row:?}");
        }
    }
}

#[test]
fn the_paced_loop_does_not_allocate_even_when_levels_change() {
    for formulation in FORMULATIONS {
        let overrides = asked(formulation, 1e-3, 2.0);
        let words = ["steps", "spring"];
        let words = if formulation == "multi-index" { &words[1..] } else { &words[..] };
        let (_, clock) = degraded(&slider(), &overrides, words);
        let [first, last] = clock.allocations.get().expect("the clock was read");
        assert_eq!(last - first, 0, "{formulation}");
    }
    let run = |name: &str, formulation: &str| {
        let mut clock = ScriptedClock::default();
        let overrides = asked(formulation, 1e-3, 0.3);
        let run = paced(&document(name), &overrides, &Pacing::default(), &mut clock);
        assert!(run.expect("it is paced").summary.completed, "{name} {formulation}");
        let [first, last] = clock.allocations.get().expect("the clock was read");
        assert_eq!(last - first, 0, "{name} {formulation}");
    };
    for formulation in ["index-3", "classical", "state-space", "recursive"] {
        run("iltis-suspension", formulation);
        run("double-pendulum", formulation);
    }
}

#[test]
fn a_ladder_by_measurement_has_levels_that_were_measured() {
    let document = document("iltis-suspension");
    let pacing = Pacing { overrun: Overrun::Degrade, period: Some(8e-3), ..Pacing::default() };
    let overrides = asked("index-3", 1e-3, 0.4);
    let run = match paced(&document, &overrides, &pacing, &mut ScriptedClock::default()) {
        Ok(run) => run,
        // on a busy machine, the times of half the work and of all work may not differ
        Err(error) => return assert_eq!(error, PacingError::NoLadder),
    };
    let realtime = run.summary.realtime.expect("it was paced");
    assert!(realtime.levels.len() >= 2, "{:?}", realtime.levels);
    assert_eq!((realtime.levels[0].saves, realtime.levels[0].without.len()), (None, 0));
    for level in &realtime.levels[1..] {
        assert!(level.changes.is_some_and(|changes| (0.0..=0.5).contains(&changes)), "{level:?}");
        assert!(level.saves.is_some() && level.measured_over.is_some() && level.output.is_some());
    }
    assert_eq!(realtime.levels[0].periods, 50);
}

#[test]
fn what_cannot_be_left_out_while_a_scene_runs_is_refused() {
    let refused = |document: &SceneFile, formulation: &str, words: &[&str], period: f64| {
        let pacing = Pacing {
            overrun: Overrun::Degrade,
            degrade: Degrade::Listed(words.iter().map(|&word| word.to_owned()).collect()),
            period: Some(period),
            ..Pacing::default()
        };
        let overrides = asked(formulation, 1e-3, 0.1);
        paced(document, &overrides, &pacing, &mut ScriptedClock::default()).err()
    };
    let fixed = |why| Some(PacingError::Fixed { name: "spring".to_owned(), why });
    for formulation in ["classical", "state-space"] {
        let found = refused(&slider(), formulation, &["spring"], 4e-3);
        assert_eq!(found, fixed(SwitchError::Formulation), "{formulation}");
        assert_eq!(refused(&slider(), formulation, &["steps"], 4e-3), None, "{formulation}");
    }
    // a torsion spring counts revolutions, which is not possible while it is off
    let text = SLIDER
        .replace("kind = \"prismatic\"", "kind = \"revolute\"")
        .replace("axis = [1.0, 0.0]\n", "")
        .replace("kind = \"spring-damper\"", "kind = \"torsion-spring\"")
        .replace(
            "bodies = [\"ground\", \"slide\"]\npoints = [[-2.0, 0.0], [0.0, 0.0]]",
            "joint = \"rail\"",
        )
        .replace("free_length = 2.0", "free_value = 0.0");
    let turning =
        SceneFile::parse(&text, "turning.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    assert_eq!(refused(&turning, "index-3", &["spring"], 4e-3), fixed(SwitchError::Coordinates));
    let steps = |is_controlled| Some(PacingError::Steps { is_controlled });
    assert_eq!(refused(&slider(), "index-3", &["steps"], 1e-3), steps(false));
    assert_eq!(refused(&slider(), "index-3", &["steps", "steps", "steps"], 4e-3), steps(false));
    let unknown = refused(&slider(), "index-3", &["sprig"], 4e-3).expect("there is no such effect");
    assert!(unknown.hint().contains("`spring`"), "{}", unknown);
    for (period, awake) in [(0.0, 0.0), (-1.0, 0.0), (f64::NAN, 0.0), (1e-3, -1.0), (1e-3, 2.0)] {
        let pacing = Pacing { period: Some(period), awake, ..Pacing::default() };
        let run =
            paced(&slider(), &asked("index-3", 1e-3, 0.1), &pacing, &mut ScriptedClock::default());
        assert!(matches!(run.err(), Some(PacingError::Time { .. })), "{period} {awake}");
    }
}

#[test]
fn a_run_that_stops_keeps_its_rows_and_its_measures() {
    // the state-space formulation stops at the singular position of the four-bar linkage, at 3.14 s
    let run = paced(
        &document("four-bar"),
        &Method { duration: None, ..asked("state-space", 1e-3, 0.0) },
        &Pacing::default(),
        &mut ScriptedClock::default(),
    );
    let run = run.expect("it is paced");
    assert!(!run.summary.completed);
    let realtime = run.summary.realtime.expect("it was paced");
    assert_eq!(realtime.periods, run.summary.steps);
    assert!((3.1..3.2).contains(&run.summary.end_time));
}
