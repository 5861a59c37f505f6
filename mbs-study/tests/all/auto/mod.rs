//! Choices on a test bench with given costs and errors, without a clock or a scene.

mod estimate;
mod goal;

use mbs::record::RunError;
use mbs::{FormulationKind, Method, Precision, ResolvedMethod};
use mbs_study::auto::Goal;
use mbs_study::inside::auto::{
    Aim, BUDGET, BUDGET_FRACTION, Bench, PilotCandidate, PilotSearch, PilotTarget, PowerLaw, Trial,
    TrialEnd, check, methods,
};
use mbs_study::inside::compare::{Control, MethodCase};

/// Outputs at the instants.
type Rows = Vec<Vec<f64>>;

/// Longest step of a candidate [s].
const LONGEST: f64 = 0.05;
/// Largest tolerance of a candidate [-].
const LOOSEST: f64 = 0.1;

/// How a method behaves: error and CPU time [s] at a setting of 0.01, by its law from there; settings at which it stops.
#[derive(Clone, Copy)]
struct Nature {
    error: f64,
    seconds: f64,
    stops_above: f64,
    stops_below: f64,
    /// CPU time of a run with one step between two rows [s]. No setting makes fewer steps.
    held: f64,
}

const TAME: Nature =
    Nature { error: 1.0, seconds: 1.0, stops_above: f64::INFINITY, stops_below: 0.0, held: 0.0 };

/// Bench without runs: it returns trials that the given natures determine, and counts them.
struct Fake<F: Fn(&MethodCase) -> Nature> {
    nature: F,
    spent: f64,
    trials: Vec<(String, f64)>,
    /// Constant error of index-3, as if its model were another one.
    apart: f64,
}

impl<F: Fn(&MethodCase) -> Nature> Fake<F> {
    fn new(nature: F) -> Self {
        Self { nature, spent: 0.0, trials: Vec::new(), apart: 0.0 }
    }

    fn cost(&self, method: &MethodCase, setting: f64) -> f64 {
        let nature = (self.nature)(method);
        nature.held.max(nature.seconds * (0.01 / setting).powf(PowerLaw::of(method).cost))
    }

    fn error(&self, method: &MethodCase, setting: f64) -> f64 {
        (self.nature)(method).error * (setting / 0.01).powf(PowerLaw::of(method).error)
    }

    /// CPU time that a method needs for an error [s], with a possible setting that is no coarser than the coarsest.
    fn needs(&self, method: &MethodCase, error: f64) -> f64 {
        let ratio = error / (self.nature)(method).error;
        let setting = 0.01 * ratio.powf(1.0 / PowerLaw::of(method).error);
        let coarsest = if method.is_fixed() { LONGEST } else { LOOSEST };
        self.cost(method, candidate(*method, error).fit(setting.min(coarsest)))
    }
}

fn candidate(method: MethodCase, error: f64) -> PilotCandidate {
    PilotCandidate::new(method, PilotTarget { error, deadline: None }, LONGEST)
}

impl<F: Fn(&MethodCase) -> Nature> Bench for Fake<F> {
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, limit: f64) -> Trial {
        self.trials.push((method.name(), setting));
        let nature = (self.nature)(method);
        let whole = self.cost(method, setting);
        let is_late = whole > limit;
        let reached = if is_late { limit / whole } else { 1.0 };
        let stops = setting > nature.stops_above || setting < nature.stops_below;
        let reached = if stops { reached.min(0.5) } else { reached };
        self.spent += whole * reached;
        let error = self.error(method, setting);
        let is_apart = method.formulation == FormulationKind::Index3;
        let apart = if is_apart { self.apart } else { 0.0 };
        // all methods compute the same motion, with an error that grows in time
        let row = |k: usize| vec![(0.01 * k as f64).sin() + error * k as f64 / 200.0 + apart];
        let rows: Rows = (1..=200).map(row).collect();
        let error = RunError { code: "violated".into(), ..RunError::default() };
        Trial {
            rows,
            seconds: whole * reached,
            // the number of steps follows the law of the CPU time
            steps: match nature.held > 0.0 {
                true => (200.0 * whole / nature.held) as u64,
                false => (1e6 * (0.01 / setting).powf(PowerLaw::of(method).cost)) as u64,
            },
            reached,
            slowest: (aim == Aim::Steps).then_some(whole * setting),
            end: match (stops, is_late) {
                (true, _) => TrialEnd::Stopped(error),
                (_, true) => TrialEnd::GivenUp,
                _ => TrialEnd::Done,
            },
        }
    }

    fn spent(&mut self) -> f64 {
        self.spent
    }

    fn distance(&self, a: &Rows, b: &Rows) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max)
    }
}

#[test]
fn extrapolation_is_a_candidate_where_it_is_asked_for_and_in_pairs() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../scenes/double-pendulum.toml"
    ));
    let document = mbs_scene::SceneFile::parse(&text.expect("a scene"), "scene").expect("TOML");
    let scene = document.scene::<f64>().expect("a scene");
    let has = |integrator: Option<&str>, precision: &str| {
        let base = Method {
            formulation: Some("auto".to_owned()),
            integrator: integrator.map(str::to_owned),
            precision: Some(precision.to_owned()),
            ..Method::default()
        };
        let settings = ResolvedMethod::new(&scene, &base).expect("settings");
        let methods = methods(&scene, &base, &settings, &Goal::default());
        methods.expect("candidates").iter().any(|m| m.integrator.name() == "gbs")
    };
    assert_eq!([has(None, "f64"), has(None, "dd"), has(Some("gbs"), "f64")], [false, true, true]);
}

fn all() -> Vec<MethodCase> {
    MethodCase::all(&[], &[Precision::F64])
}

/// Methods that a pilot tries for a scene with a tree.
fn few(mut methods: Vec<MethodCase>) -> Vec<MethodCase> {
    let is_relative = |m: &MethodCase| m.formulation.row().relative;
    let is_one = |m: &MethodCase| match is_relative(m) {
        true => !m.is_fixed() || m.integrator.is_explicit(),
        false => m.formulation == FormulationKind::DEFAULT && m.is_fixed(),
    };
    methods.retain(is_one);
    methods.sort_by_key(|m| (!is_relative(m), m.control != Control::Own, !m.is_fixed()));
    methods
}

/// Returns the method that is chosen first, its setting, and the bench.
fn chosen<F: Fn(&MethodCase) -> Nature>(
    nature: F,
    error: f64,
    deadline: Option<f64>,
) -> (Option<(MethodCase, f64, bool)>, Fake<F>) {
    let mut fake = Fake::new(nature);
    let target = PilotTarget { error, deadline };
    let methods = match deadline {
        Some(_) => all().into_iter().filter(MethodCase::is_fixed).collect(),
        None => few(all()),
    };
    let longest = deadline.unwrap_or(LONGEST);
    let candidates = methods.iter().map(|m| PilotCandidate::new(*m, target, longest)).collect();
    let mut search = PilotSearch::new(&mut fake, candidates, target);
    let places = search.run();
    let first = places.first().map(|place| {
        (search.candidates[place.candidate].method, place.prediction.setting, place.reaches)
    });
    (first, fake)
}

/// Natures of all methods, spread over some decades by a pseudorandom number.
fn spread(seed: usize) -> impl Fn(&MethodCase) -> Nature {
    move |m: &MethodCase| {
        let place = all().iter().position(|other| other == m).unwrap_or(0);
        let roll = |k: usize| ((place * 7919 + seed * 104_729 + k * 1299) % 997) as f64 / 997.0;
        let seconds = 1e-4 * 10.0_f64.powf(1.6 * roll(1));
        Nature { error: 10.0_f64.powf(-3.0 + 2.0 * roll(2)), seconds, ..TAME }
    }
}

#[test]
fn the_cheapest_is_found_within_a_fifth_where_all_keep_their_laws() {
    for seed in 0..40 {
        for error in [1e-2, 1e-4, 1e-6] {
            let (first, fake) = chosen(spread(seed), error, None);
            let (method, setting, reaches) = first.unwrap();
            let needs = |m: &MethodCase| fake.needs(m, 0.7 * error);
            let best = few(all()).iter().map(needs).fold(f64::INFINITY, f64::min);
            let takes = fake.cost(&method, setting);
            let is_reached = reaches && fake.error(&method, setting) <= error;
            assert!(is_reached, "{seed} {error}: {}", method.name());
            assert!(takes <= 1.2 * best, "{seed} {error}: {} {takes} {best}", method.name());
        }
    }
}

#[test]
fn what_stops_in_the_pilot_is_not_chosen() {
    let nature = |m: &MethodCase| match m.formulation {
        FormulationKind::Recursive => Nature { seconds: 1e-4, stops_below: 1.0, ..TAME },
        _ => Nature { seconds: 1e-3, error: 1e-4, ..TAME },
    };
    let (first, _) = chosen(nature, 1e-4, None);
    assert_eq!(first.unwrap().0.formulation, FormulationKind::Index3);
}

#[test]
fn a_method_that_stops_with_coarse_settings_is_tried_with_finer_ones() {
    let nature = |m: &MethodCase| match (m.formulation, m.is_fixed()) {
        (FormulationKind::Index3, true) => {
            Nature { seconds: 1e-4, error: 1e-5, stops_above: 0.02, ..TAME }
        }
        _ => Nature { seconds: 1e-2, error: 1e-5, ..TAME },
    };
    let (first, _) = chosen(nature, 1e-4, None);
    let (method, setting, reaches) = first.unwrap();
    assert_eq!((method.formulation, reaches), (FormulationKind::Index3, true));
    assert!(setting <= 0.02, "{setting}");
}

#[test]
fn what_is_dearer_in_any_case_gets_two_trials_at_most() {
    let nature = |m: &MethodCase| match m.name().as_str() {
        "recursive rk54, f64" => Nature { seconds: 1e-3, error: 1e-3, ..TAME },
        _ => Nature { seconds: 50.0, error: 1e-3, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-4, None);
    assert_eq!(first.unwrap().0.name(), "recursive rk54, f64");
    for method in all().iter().filter(|m| m.name() != "recursive rk54, f64") {
        let trials = fake.trials.iter().filter(|(name, _)| *name == method.name()).count();
        assert!(trials <= 2, "{}: {trials}", method.name());
    }
}

#[test]
fn where_the_rows_hold_all_steps_two_rules_that_agree_give_the_error() {
    // both integrators make one step for each row at every tolerance, so no coarser trial has fewer steps
    let nature = |m: &MethodCase| match m.integrator.name() {
        "rk54" => Nature { seconds: 1e-6, error: 1e-6, held: 1e-2, ..TAME },
        "rk853" => Nature { seconds: 1e-6, error: 1e-7, held: 1.2e-2, ..TAME },
        _ => Nature { seconds: 50.0, error: 1e-3, ..TAME },
    };
    let (first, _) = chosen(nature, 1e-2, None);
    let (method, _, reaches) = first.unwrap();
    assert!(reaches && method.name() == "recursive rk54, f64", "{}", method.name());
}

#[test]
fn the_pilot_keeps_to_its_budget() {
    for seconds in [1e-3, 1e-2, 0.1, 1.0] {
        let (_, fake) = chosen(|_: &MethodCase| Nature { seconds, ..TAME }, 1e-6, None);
        let best = few(all()).iter().map(|m| fake.needs(m, 1e-6)).fold(f64::INFINITY, f64::min);
        // the pilot predicts the time of the run from the trials so far
        let most = BUDGET.max(1.5 * BUDGET_FRACTION * best) * 1.5;
        assert!(fake.spent <= most, "{seconds}: {} of {most}", fake.spent);
    }
}

#[test]
fn a_deadline_gives_the_most_accurate_method_whose_slowest_step_leaves_time() {
    // in a frame of 10 ms, index-3 can make many steps, rk4 only one, and the others none
    let nature = |m: &MethodCase| match m.name().as_str() {
        "index-3, f64" => Nature { seconds: 1e-2, error: 1e-2, ..TAME },
        "recursive rk4, f64" => Nature { seconds: 4e-1, error: 1e-1, ..TAME },
        _ => Nature { seconds: 1.0, error: 1e-6, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-6, Some(0.01));
    let (method, setting, _) = first.unwrap();
    assert_eq!(method.name(), "index-3, f64");
    // a step takes 1e-4 s at any length, so at most 50 steps take half a frame
    let slowest = fake.cost(&method, setting) * setting;
    assert!(0.01 / setting * slowest <= 0.5 * 0.01 * (1.0 + 1e-9), "{setting}");
    assert!(setting < 0.001, "{setting}");
}

#[test]
fn an_error_that_no_candidate_reaches_is_said() {
    // errors do not fall below 1e-3
    let nature = |_: &MethodCase| Nature { seconds: 1e-4, stops_below: 0.009, error: 1e-2, ..TAME };
    let (first, _) = chosen(nature, 1e-9, None);
    assert!(!first.expect("what completed a trial is left").2);
}

#[test]
fn a_check_from_the_other_coordinates_finds_two_models_that_differ() {
    let nature = |_: &MethodCase| Nature { seconds: 1e-4, error: 1e-5, ..TAME };
    for (apart, differs) in [(0.0, false), (0.5, true)] {
        let mut bench = Fake { apart, ..Fake::new(nature) };
        let target = PilotTarget { error: 1e-4, deadline: None };
        let relative = all().into_iter().filter(|m| m.formulation.row().relative);
        let candidates = relative.map(|m| PilotCandidate::new(m, target, LONGEST)).collect();
        let mut search = PilotSearch::new(&mut bench, candidates, target);
        let places = search.run();
        let look = check(&mut search, &places, 0.01).expect("index-3 runs").unwrap();
        assert_eq!(look.differs, differs, "{look:?}");
        assert!((look.distance.unwrap() - apart).abs() < 1e-2);
    }
}
