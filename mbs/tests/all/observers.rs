//! Observers of a run. Their inputs act as in a simulation that a program steps. Their readings are those that the run records. Their return
//! value can end the run, whose rows are kept.

use core::ops::ControlFlow;
use mbs::core::control::Accepted;
use mbs::{
    Body, Effect, EffectId, Error, FormulationKind, GROUND, InputId, IntegratorKind, Joint,
    JointId, Mechanism, Method, Observer, Output, OutputId, ResolvedMethod, Run, RunInputs, Signal,
    SimulationError, StepReport, StopError, View, Watchers, run, run_with, typed,
};

/// Length of a step [s].
const STEP: f64 = 1e-3;

/// Mechanism of an arm with a motor, and the output of its tip.
struct Arm {
    mechanism: Mechanism,
    pivot: JointId,
    motor: EffectId,
    tip: OutputId,
}

fn arm() -> Arm {
    let mut m = Mechanism::planar("arm");
    m.set_gravity([0.0, -9.81]).set_duration(0.5);
    let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 2.0));
    let lower = m.add(Body::rod([1.0, 0.0], [1.5, 0.0], 1.0));
    let pivot = m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]).named("pivot"));
    m.add(Joint::revolute([upper, lower], [1.0, 0.0]));
    let motor = m.add(Effect::torque(pivot, Signal::input(0.0)));
    let tip = m.add(Output::position(lower, [1.5, 0.0]).named("tip"));
    Arm { mechanism: m, pivot, motor, tip }
}

fn methods() -> [Method; 3] {
    let method = |f| Method::new(f).step(STEP);
    [
        method(FormulationKind::Index3),
        method(FormulationKind::Recursive).integrator(IntegratorKind::Rk4),
        method(FormulationKind::Recursive).integrator(IntegratorKind::Rk54),
    ]
}

/// Torque of a controller at an angle and a rate [N m].
fn torque(angle: f64, rate: f64) -> f64 {
    -80.0 * angle - 12.0 * rate
}

/// Observer that controls the arm, and stores its readings after each step.
struct Hold {
    pivot: JointId,
    motor: EffectId,
    tip: OutputId,
    seen: Vec<[f64; 3]>,
    ends: u32,
}

impl Hold {
    fn new(arm: &Arm) -> Self {
        Self { pivot: arm.pivot, motor: arm.motor, tip: arm.tip, seen: Vec::new(), ends: 0 }
    }
}

impl Observer for Hold {
    fn inputs(
        &mut self,
        now: &View<'_>,
        inputs: &mut RunInputs<'_>,
    ) -> Result<(), SimulationError> {
        let motor = inputs.of_effect(self.motor)?;
        inputs.set(motor, torque(now.value(self.pivot), now.rate(self.pivot)))
    }

    fn step(
        &mut self,
        now: &View<'_>,
        report: &StepReport,
    ) -> Result<ControlFlow<()>, SimulationError> {
        assert!(report.steps > 0);
        let tip = now.output(self.tip)?;
        self.seen.push([now.time(), tip[0], tip[1]]);
        Ok(ControlFlow::Continue(()))
    }

    fn end(&mut self, now: &View<'_>, stop: Option<&SimulationError>) {
        assert!(stop.is_none() && (now.time() - 0.5).abs() < 1e-12);
        self.ends += 1;
    }
}

#[test]
fn a_controller_in_a_run_has_the_bits_of_one_around_a_simulation() {
    let arm = arm();
    for method in methods() {
        let mut hold = Hold::new(&arm);
        let options = Run::new().method(method.clone());
        let result = run_with(&arm.mechanism, &options, &mut Watchers::observers(&mut [&mut hold]))
            .expect("it runs");
        assert_eq!((result.stop().map(|e| e.to_string()), hold.ends), (None, 1));

        let mut sim = arm.mechanism.simulate(&method).expect("it starts");
        let input = sim.input_of(arm.motor).expect("it has one");
        for k in 0..500 {
            sim.set_input(input, torque(sim.value(arm.pivot), sim.rate(arm.pivot))).unwrap();
            sim.step(STEP).expect("it steps");
            let tip = sim.output(arm.tip).expect("it is finite");
            let own = [sim.time(), tip[0], tip[1]].map(f64::to_bits);
            assert_eq!(hold.seen[k].map(f64::to_bits), own, "{method:?}, step {k}");
        }
        let of = |name| result.table().column(name).expect("an output");
        for (row, seen) in hold.seen.iter().enumerate() {
            let recorded =
                [result.table().time()[row + 1], of("tip.x")[row + 1], of("tip.y")[row + 1]];
            assert_eq!(recorded.map(f64::to_bits), seen.map(f64::to_bits), "{method:?}, row {row}");
        }
    }
}

/// Observer that ends the run at a time, normally or by an error.
struct Ends {
    at: f64,
    by: fn(&mut RunInputs<'_>) -> Result<(), SimulationError>,
    is_break: bool,
    stop: Option<String>,
}

impl Observer for Ends {
    fn inputs(
        &mut self,
        now: &View<'_>,
        inputs: &mut RunInputs<'_>,
    ) -> Result<(), SimulationError> {
        if now.time() < self.at { Ok(()) } else { (self.by)(inputs) }
    }

    fn step(&mut self, now: &View<'_>, _: &StepReport) -> Result<ControlFlow<()>, SimulationError> {
        let is_over = self.is_break && now.time() >= self.at;
        Ok(if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    fn end(&mut self, _: &View<'_>, stop: Option<&SimulationError>) {
        self.stop = stop.map(|stop| stop.code().to_owned());
    }
}

#[test]
fn an_observer_ends_a_run_and_its_rows_stay() {
    let arm = arm();
    let whole = run(&arm.mechanism, &Run::new()).expect("it runs");
    let not_finite: fn(&mut RunInputs<'_>) -> _ = |i| i.set(InputId::new(0), f64::NAN);
    let unknown: fn(&mut RunInputs<'_>) -> _ = |i| i.set(InputId::new(7), 0.0);
    let own: fn(&mut RunInputs<'_>) -> _ = |_| Err(SimulationError::new("too-hot", "hot", "wait"));
    let none: fn(&mut RunInputs<'_>) -> _ = |_| Ok(());
    let refused = Some("input-refused");
    for (by, code) in
        [(not_finite, refused), (unknown, refused), (own, Some("too-hot")), (none, None)]
    {
        let is_break = code.is_none();
        let mut ends = Ends { at: 0.1, by, is_break, stop: None };
        let result =
            run_with(&arm.mechanism, &Run::new(), &mut Watchers::observers(&mut [&mut ends]))
                .expect("it starts");
        assert_eq!(result.stop().as_ref().map(Error::code), code);
        assert_eq!(ends.stop.as_deref(), code);
        let hint = result.stop().as_ref().and_then(Error::hint);
        assert_eq!(hint.as_deref() == Some("wait"), code == Some("too-hot"));
        assert_eq!(result.summary().completed, is_break);
        assert!((result.summary().end_time - 0.1).abs() < 1e-12);
        let n = result.table().len();
        assert_eq!(n, 101);
        assert_eq!(result.table().column("tip.y"), whole.table().column("tip.y").map(|y| &y[..n]));
    }
}

#[test]
fn an_observer_that_only_looks_changes_no_bit() {
    struct Looks;
    impl Observer for Looks {}
    let arm = arm();
    for method in methods() {
        let options = Run::new().method(method);
        let alone = run(&arm.mechanism, &options).expect("it runs");
        let seen = run_with(&arm.mechanism, &options, &mut Watchers::observers(&mut [&mut Looks]))
            .expect("it runs");
        assert_eq!(alone.table(), seen.table());
    }
}

#[test]
fn an_output_in_code_is_a_column_and_a_reading_with_the_same_bits() {
    let Arm { mechanism: mut m, pivot, tip, .. } = arm();
    let reach = move |now: &View<'_>| {
        let tip = now.output(tip).expect("it is finite");
        tip[0].hypot(tip[1]) + now.value(pivot)
    };
    let reach = m.add_function("reach", reach);
    for method in methods() {
        let result = run(&m, &Run::new().method(method.clone())).expect("it runs");
        let column = result.table().column("reach").expect("a column");
        let mut sim = m.simulate(&method).expect("it starts");
        for value in column {
            assert_eq!(value.to_bits(), sim.function(reach).to_bits());
            sim.step(STEP).expect("it steps");
        }
        let other = run(&arm().mechanism, &Run::new().method(method)).expect("it runs");
        assert_eq!(result.table().column("tip.x"), other.table().column("tip.x"));
    }
}

#[test]
fn outputs_in_code_are_shared_by_clones_and_have_no_text() {
    let Arm { mechanism: mut m, pivot, .. } = arm();
    m.add_function("twice", move |now: &View<'_>| 2.0 * now.value(pivot));
    let clone = m.clone();
    assert_eq!(clone, m);
    assert_ne!(arm().mechanism, m);
    let error = m.to_toml().expect_err("it has no text");
    assert!(error.to_string().contains("output `twice`"), "{error}");
    assert!(serde_json::to_string(&m).is_err());
    // a change by path keeps the function
    m.set("body.body-1.mass", 2.5).expect("a path");
    let result = run(&m, &Run::new()).expect("it runs");
    assert!(result.table().column("twice").is_some());
    // names of outputs must be unique, and values that are not finite are reported
    m.add_function("tip", |_: &View<'_>| 0.0);
    let twice = m.check().expect_err("a name twice").to_string();
    assert!(twice.starts_with("`name` of output 3, `tip`, repeats"), "{twice}");
    // without outputs in the scene, joints are the columns
    let mut m = Mechanism::planar("pendulum");
    let bob = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
    m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
    m.add_function("pivot", |_: &View<'_>| 0.0);
    let twice = m.check().expect_err("a name twice").to_string();
    assert!(twice.contains("`pivot`, repeats"), "{twice}");
    let mut m = arm().mechanism;
    m.add_function("late", |now: &View<'_>| if now.time() < 0.1 { 0.0 } else { f64::NAN });
    let result = run(&m, &Run::new()).expect("it starts");
    let stop = result.stop().expect("it stops");
    assert_eq!(stop.code(), "output-not-finite");
    assert!(stop.to_string().contains("`late`"), "{stop}");
    assert_eq!(result.table().len(), 100);
}

/// Observer that stores the coordinates after each step.
#[derive(Default)]
struct Coordinates(Vec<(f64, Vec<u64>)>);

impl<const D: usize> typed::StepObserver<f64, D> for Coordinates {
    fn step(
        &mut self,
        now: &typed::Simulation<f64, D>,
        _: &Accepted<f64>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let state = now.state();
        self.0.push((state.t, state.q.iter().map(|x| x.to_bits()).collect()));
        Ok(ControlFlow::Continue(()))
    }
}

/// Coordinates of a run, and of a loop of single steps from the same start.
fn both<const D: usize>(name: &str, formulation: &str) -> [Vec<(f64, Vec<u64>)>; 2] {
    let scene = crate::common::scene(name);
    let formulation = Some(formulation.to_owned());
    let method =
        Method { formulation, duration: Some(0.0505), step: Some(STEP), ..Method::default() };
    let settings = ResolvedMethod::new(&scene, &method).expect("good settings");
    let mut seen = Coordinates::default();
    typed::run::<f64, D>(&scene, &settings, &mut seen);
    let mut simulation = typed::Simulation::<f64, D>::new(&scene, &settings).expect("it starts");
    let mut alone = Coordinates::default();
    for k in 1..=51_u32 {
        // the last step is half as long
        let t = if k == 51 { 0.0505 } else { f64::from(k) * STEP };
        let dt = if k == 51 { t - 50.0 * STEP } else { STEP };
        let accepted = simulation.advance(dt).expect("it steps");
        simulation.set_time(t);
        let flow = typed::StepObserver::step(&mut alone, &simulation, &accepted, k == 51);
        assert_eq!(flow, Ok(ControlFlow::Continue(())));
    }
    [seen.0, alone.0]
}

#[test]
fn a_run_has_the_bits_of_a_loop_of_single_steps() {
    // multi-index controls the length of its steps
    for formulation in mbs::FORMULATIONS[1..].iter().filter(|name| **name != "multi-index") {
        let [run, alone] = both::<2>("double-pendulum", formulation);
        assert_eq!(run, alone, "{formulation}");
        assert_eq!(run.len(), 51);
        let [run, alone] = both::<3>("spinning-top", formulation);
        assert_eq!(run, alone, "{formulation}");
    }
}
