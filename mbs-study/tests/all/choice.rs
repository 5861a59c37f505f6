//! Choice by measurement on real scenes. Measured times are not asserted: any chosen method must reach the required error.

use crate::clock::CountedClock;
use mbs::inside::PreparedRun;
use mbs::{Goal, Mechanism, Method, Outcome, ResolvedMethod, Run, Watchers};
use mbs_study::auto::{Plan, plan, run_plan};

fn file(name: &str) -> String {
    format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn read(name: &str) -> Mechanism {
    Mechanism::read(file(name)).expect("it is a scene")
}

/// Plans a run, and calls a function with the run and its plan.
fn with_plan<R>(
    (mechanism, base): (&Mechanism, &Method),
    goal: Goal,
    work: impl FnOnce(&PreparedRun<'_>, Plan) -> R,
) -> R {
    let options = Run::new().method(base.clone()).goal(goal);
    let run = PreparedRun::new(mechanism, &options).expect("the settings go together");
    let plan = plan(&run, &mut CountedClock::default()).expect("the goal can be meant");
    work(&run, plan)
}

/// Returns the outcome of a plan, and the method that ran.
fn outcome(run: &PreparedRun<'_>, plan: &Plan) -> (Outcome, ResolvedMethod) {
    run_plan(run, plan, &mut Watchers::default()).expect("a run")
}

fn planned(name: &str, base: &Method, goal: Goal) -> Plan {
    with_plan((&read(name), base), goal, |_, plan| plan)
}

fn error(e: f64) -> Goal {
    Goal { error: Some(e), deadline: None }
}

#[test]
fn on_a_clock_that_counts_work_a_choice_is_the_same_every_time() {
    for name in ["double-pendulum", "slider-crank", "hammer-blow"] {
        let base = Method { formulation: Some("auto".into()), ..Method::default() };
        let plans = [0, 1].map(|_| planned(name, &base, error(1e-3)));
        assert_eq!(plans[0], plans[1], "{name}");
        let choice = plans[0].first().choice.as_ref().unwrap();
        assert!(choice.candidates.iter().any(|c| c.trials.len() > 1), "{name}: {choice:?}");
    }
}

#[test]
fn the_required_error_is_kept_on_the_pendulum_against_its_closed_form() {
    let table = std::fs::read_to_string(file("references/simple-pendulum").replace("toml", "csv"));
    let table = table.unwrap();
    let last: Vec<f64> =
        table.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    for wanted in [1e-2, 1e-4, 1e-6] {
        let both = (&read("simple-pendulum"), &Method::default());
        let (outcome, settings) = with_plan(both, error(wanted), |run, plan| outcome(run, &plan));
        let (t, row) = outcome.rows().last().unwrap();
        assert!((t - last[0]).abs() < 1e-9 && outcome.error.is_none());
        // the required error is relative to the range of each coordinate
        let share = |k: usize| {
            let column = || outcome.rows().iter().map(|(_, row)| row[k]);
            let range = column().fold(f64::MIN, f64::max) - column().fold(f64::MAX, f64::min);
            (row[k] - last[1 + k]).abs() / range
        };
        let off = share(0).max(share(1));
        assert!(off <= 2.0 * wanted, "{wanted}: {off} with {:?}", settings.formulation);
    }
}

#[test]
fn structure_leaves_out_what_cannot_run_and_says_why() {
    let base = Method { formulation: Some("classical".into()), ..Method::default() };
    let plan = planned("spatial-four-bar", &base, error(1e-2));
    let choice = plan.first().choice.clone().unwrap();
    assert!(!choice.candidates.is_empty());
    for candidate in &choice.candidates {
        let why = candidate.out.clone().unwrap();
        assert!(candidate.trials.is_empty() && why.contains("redundant"), "{why}");
    }
    assert!(choice.structure.iter().any(|s| s.contains("one loop")), "{:?}", choice.structure);
}

#[test]
fn a_formulation_that_is_asked_for_is_kept_and_the_rest_is_chosen() {
    let base = Method { formulation: Some("recursive".into()), ..Method::default() };
    let plan = planned("double-pendulum", &base, error(1e-3));
    assert!(plan.ranked.iter().all(|s| s.formulation == mbs::FormulationKind::Recursive));
    assert_eq!(plan.first().asked, "recursive");
    let base = Method { integrator: Some("hht".into()), ..Method::default() };
    let plan = planned("quarter-car", &base, error(1e-2));
    assert!(plan.ranked.iter().all(|s| s.integrator == mbs::IntegratorKind::Hht));
}

#[test]
fn where_the_first_stops_the_next_runs_and_the_choice_says_so() {
    // relative coordinates with small steps stop at the four-bar's singular position, while index-3 passes through it
    let (mechanism, base) = (read("four-bar"), Method::default());
    let scene = mechanism.resolve().expect("a scene");
    with_plan((&mechanism, &base), error(1e-2), |run, plan| {
        let choice = plan.first().choice.clone();
        let of = |formulation: &str| {
            let overrides =
                Method { formulation: Some(formulation.into()), step: Some(1e-3), ..base.clone() };
            let settings = ResolvedMethod::new(&scene, &overrides).unwrap();
            ResolvedMethod { choice: choice.clone(), ..settings }
        };
        let plan = Plan { ranked: vec![of("recursive"), of("index-3")] };
        let (first, settings) = outcome(run, &plan);
        assert!(first.summary.completed);
        assert_eq!(settings.formulation, mbs::FormulationKind::Index3);
        let lost = &first.summary.chosen.unwrap().evidence.unwrap().fallbacks;
        assert_eq!((lost.len(), lost[0].code.as_str()), (1, "violated"));
        // both stop before the end: the result is the run that got furthest
        let plan = Plan { ranked: vec![of("recursive"), of("state-space")] };
        let (furthest, _) = outcome(run, &plan);
        assert!(!furthest.summary.completed && furthest.summary.end_time > 3.0);
    });
}

#[test]
fn with_a_deadline_a_frame_is_a_whole_number_of_steps() {
    let goal = Goal { error: None, deadline: Some(0.01) };
    let plan = planned("quarter-car", &Method::default(), goal);
    for settings in &plan.ranked {
        let steps = 0.01 / settings.step;
        assert!((steps - steps.round()).abs() < 1e-9 && steps >= 1.0, "{steps}");
        assert!(!settings.integrator.controls_its_step());
        assert_eq!(settings.rule, mbs::StepRule::Fixed);
    }
}

#[test]
fn without_a_goal_nothing_is_measured_and_auto_is_index_3() {
    let plan = planned("double-pendulum", &Method::default(), Goal::default());
    assert_eq!((plan.ranked.len(), plan.first().formulation), (1, mbs::FormulationKind::Index3));
    assert!(plan.first().choice.is_none());
    assert!(plan.first().chosen().unwrap().evidence.is_none());
}
