//! Choices on a bench whose costs and errors are given: no clock, no scene.

use super::entrant::Entrant;
use super::goal::Goal;
use super::law::Law;
use super::race::{BUDGET, Race, Wanted};
use super::second;
use super::trial::{Aim, Bench, End, Rows, Time, Trial};
use crate::compare::ladder::Instants;
use crate::compare::method::{Control, MethodCase};
use mbs::FormulationKind;
use mbs::Precision;
use mbs::record::RunError;
use mbs::{Method, Settings};

/// Coarsest step [s], and tolerance.
const COARSEST: f64 = 0.05;
const LOOSEST: f64 = 0.1;

/// How a method behaves: error and CPU time [s] at a setting of 0.01, by its law from there; settings at which it stops.
#[derive(Clone, Copy)]
struct Nature {
    error: f64,
    seconds: f64,
    stops_above: f64,
    stops_below: f64,
    /// CPU time of one step to each row [s], below which no setting comes.
    held: f64,
}

const TAME: Nature =
    Nature { error: 1.0, seconds: 1.0, stops_above: f64::INFINITY, stops_below: 0.0, held: 0.0 };

/// Runs nothing: tells what the natures say, and counts.
struct Fake<F: Fn(&MethodCase) -> Nature> {
    nature: F,
    spent: f64,
    trials: Vec<(String, f64)>,
}

impl<F: Fn(&MethodCase) -> Nature> Fake<F> {
    fn new(nature: F) -> Self {
        Self { nature, spent: 0.0, trials: Vec::new() }
    }

    fn cost(&self, method: &MethodCase, setting: f64) -> f64 {
        let nature = (self.nature)(method);
        nature.held.max(nature.seconds * (0.01 / setting).powf(Law::of(method).cost))
    }

    fn error(&self, method: &MethodCase, setting: f64) -> f64 {
        (self.nature)(method).error * (setting / 0.01).powf(Law::of(method).error)
    }

    /// CPU time that a method takes for an error [s]: with a setting that can be had, none coarser than the coarsest.
    fn needs(&self, method: &MethodCase, error: f64) -> f64 {
        let setting = 0.01 * Law::of(method).setting_for(error / (self.nature)(method).error);
        let coarsest = if method.is_fixed() { COARSEST } else { LOOSEST };
        self.cost(method, Entrant::new(*method, coarsest, coarsest).fit(setting.min(coarsest)))
    }
}

impl<F: Fn(&MethodCase) -> Nature> Bench for Fake<F> {
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, time: Time) -> Trial {
        self.trials.push((method.name(), setting));
        let nature = (self.nature)(method);
        let whole = self.cost(method, setting);
        // its pace is the same throughout
        let is_late = whole > time.at_last;
        let reached = if is_late { time.most / whole } else { 1.0 };
        let stops = setting > nature.stops_above || setting < nature.stops_below;
        let reached = if stops { reached.min(0.5) } else { reached };
        self.spent += whole * reached;
        let error = self.error(method, setting);
        // the same motion for all, and an error that grows
        let row = |k: usize| vec![(0.01 * k as f64).sin() + error * k as f64 / 200.0];
        let rows: Rows = (1..=200).map(row).collect();
        let error = RunError { code: "violated".into(), ..RunError::default() };
        Trial {
            rows,
            seconds: whole * reached,
            // as many as the CPU time's law says
            steps: match nature.held > 0.0 {
                true => (200.0 * whole / nature.held) as u64,
                false => (1e6 * (0.01 / setting).powf(Law::of(method).cost)) as u64,
            },
            reached,
            slowest: (aim == Aim::Steps).then_some(whole * setting),
            end: match (stops, is_late) {
                (true, _) => End::Stopped(error),
                (_, true) => End::GivenUp,
                _ => End::Done,
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
        let settings = Settings::new(&scene, &base).expect("settings");
        let methods = super::methods(&scene, &base, &settings, &Goal::default());
        methods.expect("candidates").iter().any(|m| m.integrator.name() == "gbs")
    };
    assert_eq!([has(None, "f64"), has(None, "dd"), has(Some("gbs"), "f64")], [false, true, true]);
}

fn all() -> Vec<MethodCase> {
    MethodCase::all(&[], &[Precision::F64])
}

fn entrants(methods: &[MethodCase], wanted: f64) -> Vec<Entrant> {
    let of = |m: &MethodCase| {
        let coarsest = if m.is_fixed() { COARSEST } else { LOOSEST };
        let first = if m.is_fixed() { COARSEST } else { wanted.max(1e-4) };
        Entrant::new(*m, first, coarsest)
    };
    methods.iter().map(of).collect()
}

/// The name that is chosen first, its setting, and the bench.
fn chosen<F: Fn(&MethodCase) -> Nature>(
    nature: F,
    error: f64,
    deadline: Option<f64>,
) -> (Option<(MethodCase, f64, bool)>, Fake<F>) {
    let mut fake = Fake::new(nature);
    let methods: Vec<MethodCase> =
        all().into_iter().filter(|m| deadline.is_none() || m.is_fixed()).collect();
    let mut entrants = entrants(&methods, error);
    if let Some(deadline) = deadline {
        for entrant in &mut entrants {
            (entrant.first, entrant.coarsest) = (deadline, deadline);
        }
    }
    let mut race = Race::new(&mut fake, entrants, Wanted { error, deadline });
    let places = race.run();
    let first = places.first().map(|place| {
        (race.entrants[place.entrant].method, place.prediction.point.setting, place.reaches)
    });
    (first, fake)
}

/// A nature for each method, spread over some decades. The same rule in coordinates of the same kind takes about the same steps, and
/// two and a half times the work of another at most: that is what the pilot relies on where it leaves such a candidate alone.
fn spread(seed: usize) -> impl Fn(&MethodCase) -> Nature {
    let kind = |m: &MethodCase| {
        (m.integrator, m.control, m.formulation == FormulationKind::Recursive, !m.is_fixed())
    };
    move |m: &MethodCase| {
        let first = |is: &dyn Fn(&MethodCase) -> bool| all().iter().position(is).unwrap_or(0);
        let (place, twins) = (first(&|other| other == m), first(&|other| kind(other) == kind(m)));
        let roll =
            |of: usize, k: usize| ((of * 7919 + seed * 104_729 + k * 1299) % 997) as f64 / 997.0;
        let seconds = 1e-4 * 10.0_f64.powf(1.2 * roll(twins, 1) + 0.39 * roll(place, 3));
        // a tolerance of 0.01 and a step of 0.01 are not alike
        let error = 10.0_f64.powf(-3.0 + 2.0 * roll(twins, 2) + 0.1 * roll(place, 4));
        Nature { error, seconds, ..TAME }
    }
}

#[test]
fn the_cheapest_is_found_within_a_fifth_where_all_keep_their_laws_and_twins_take_like_steps() {
    for seed in 0..40 {
        for error in [1e-2, 1e-4, 1e-6] {
            let (first, fake) = chosen(spread(seed), error, None);
            let (method, setting, reaches) = first.unwrap();
            // half of the wanted error is aimed at where that costs little, else 0.7 of it
            let aim = |m: &MethodCase| if m.control == Control::Own { 0.5 } else { 0.7 } * error;
            let needs = |m: &MethodCase| fake.needs(m, aim(m));
            let best = all().iter().map(needs).fold(f64::INFINITY, f64::min);
            let takes = fake.cost(&method, setting);
            assert!(
                reaches && fake.error(&method, setting) <= error,
                "{seed} {error}: {}",
                method.name()
            );
            assert!(takes <= 1.2 * best, "{seed} {error}: {} {takes} {best}", method.name());
        }
    }
}

#[test]
fn what_stops_in_the_pilot_is_not_chosen() {
    let nature = |m: &MethodCase| match m.formulation {
        FormulationKind::Recursive => Nature { seconds: 1e-4, stops_below: 1.0, ..TAME },
        FormulationKind::Index3 => Nature { seconds: 1e-3, error: 1e-4, ..TAME },
        _ => Nature { seconds: 4e-3, error: 1e-4, ..TAME },
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
    assert_eq!(
        (method.formulation, method.is_fixed(), reaches),
        (FormulationKind::Index3, true, true)
    );
    assert!(setting <= 0.02, "{setting}");
}

#[test]
fn what_is_dearer_in_any_case_gets_one_look() {
    let nature = |m: &MethodCase| match m.name().as_str() {
        "recursive rk54, f64" => Nature { seconds: 1e-3, error: 1e-3, ..TAME },
        _ => Nature { seconds: 50.0, error: 1e-3, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-4, None);
    assert_eq!(first.unwrap().0.name(), "recursive rk54, f64");
    for method in all().iter().filter(|m| m.name() != "recursive rk54, f64") {
        let looks = fake.trials.iter().filter(|(name, _)| *name == method.name()).count();
        assert!(looks <= 3, "{}: {looks}", method.name());
    }
}

#[test]
fn a_method_whose_steps_are_held_by_the_rows_is_tried_with_what_may_cost_it_nothing() {
    // both make a step to each row, with errors that only a tolerance of 1e-7 brings down; by its law rk853 would take 3.5 times as
    // long for that as it does
    let nature = |m: &MethodCase| match m.integrator.name() {
        "rk54" => Nature { seconds: 2e-4, error: 1.0, held: 2e-3, ..TAME },
        "rk853" => Nature { seconds: 1e-4, error: 10.0, held: 2.2e-3, ..TAME },
        _ => Nature { seconds: 50.0, error: 1e-3, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-6, None);
    let (method, setting, _) = first.unwrap();
    assert_eq!(method.name(), "recursive rk853, f64");
    assert!(fake.cost(&method, setting) <= 2.2e-3, "{setting}");
}

#[test]
fn where_the_rows_hold_all_steps_two_rules_that_agree_tell_the_error() {
    // whatever the tolerance, both make one step to each row: no neighbour has fewer
    let nature = |m: &MethodCase| match m.integrator.name() {
        "rk54" => Nature { seconds: 1e-6, error: 1e-6, held: 1e-2, ..TAME },
        "rk853" => Nature { seconds: 1e-6, error: 1e-7, held: 1.2e-2, ..TAME },
        _ => Nature { seconds: 50.0, error: 1e-3, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-2, None);
    let (method, _, reaches) = first.unwrap();
    assert!(reaches && method.name() == "recursive rk54, f64", "{}", method.name());
    // a neighbour of the first is tried before another rule is, and takes the same steps
    for (rule, most) in [("rk54", 2), ("rk853", 1)] {
        let mut settings: Vec<f64> = Vec::new();
        settings.extend(fake.trials.iter().filter(|(name, _)| name.contains(rule)).map(|t| t.1));
        settings.sort_by(f64::total_cmp);
        settings.dedup();
        assert_eq!(settings.len(), most, "{:?}", fake.trials);
    }
}

#[test]
fn the_pilot_keeps_to_its_budget() {
    for seconds in [1e-3, 1e-2, 0.1, 1.0] {
        let (_, fake) = chosen(|_: &MethodCase| Nature { seconds, ..TAME }, 1e-6, None);
        let best = all().iter().map(|m| fake.needs(m, 1e-6)).fold(f64::INFINITY, f64::min);
        // the last trial may begin just before the end
        let most = BUDGET[0].max(1.5 * BUDGET[1] * best) * 1.5;
        assert!(fake.spent <= most, "{seconds}: {} of {most}", fake.spent);
    }
}

#[test]
fn times_that_are_the_same_go_by_the_order_of_the_list() {
    let nature = |m: &MethodCase| match m.formulation {
        FormulationKind::Recursive => Nature { seconds: 1.0, ..TAME },
        _ if m.is_fixed() => Nature { seconds: 1e-3, error: 1e-4, ..TAME },
        _ => Nature { seconds: 1.0, ..TAME },
    };
    let (first, _) = chosen(nature, 1e-3, None);
    assert_eq!(first.unwrap().0.formulation, FormulationKind::Index3);
}

#[test]
fn a_deadline_gives_the_most_accurate_method_whose_slowest_step_leaves_time() {
    // frames of 10 ms: index-3 fits in with many steps, rk4 with 1, the others not at all
    let nature = |m: &MethodCase| match m.name().as_str() {
        "index-3, f64" => Nature { seconds: 1e-2, error: 1e-2, ..TAME },
        "recursive rk4, f64" => Nature { seconds: 4e-1, error: 1e-1, ..TAME },
        _ => Nature { seconds: 1.0, error: 1e-6, ..TAME },
    };
    let (first, fake) = chosen(nature, 1e-6, Some(0.01));
    let (method, setting, _) = first.unwrap();
    assert_eq!(method.name(), "index-3, f64");
    // a step takes 1e-4 s whatever its length, so at most 50 of them are half a frame
    let slowest = fake.cost(&method, setting) * setting;
    assert!(0.01 / setting * slowest <= 0.5 * 0.01 * (1.0 + 1e-9), "{setting}");
    assert!(setting < 0.001, "{setting}");
}

#[test]
fn an_error_that_nobody_reaches_gives_the_least_and_says_so() {
    // rounding at 1e-3: errors do not fall below
    let nature = |m: &MethodCase| Nature {
        seconds: 1e-4,
        stops_below: 0.009,
        error: 1e-2,
        ..{
            let _ = m;
            TAME
        }
    };
    let (first, _) = chosen(nature, 1e-9, None);
    let (_, _, reaches) = first.unwrap();
    assert!(!reaches);
}

/// A bench whose index-3 is off by a constant: another model.
struct Apart<F: Fn(&MethodCase) -> Nature>(Fake<F>, f64);

impl<F: Fn(&MethodCase) -> Nature> Bench for Apart<F> {
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, time: Time) -> Trial {
        let mut trial = self.0.trial(method, setting, aim, time);
        if method.formulation == FormulationKind::Index3 {
            trial.rows.iter_mut().for_each(|row| row[0] += self.1);
        }
        trial
    }

    fn spent(&mut self) -> f64 {
        self.0.spent()
    }

    fn distance(&self, a: &Rows, b: &Rows) -> f64 {
        self.0.distance(a, b)
    }
}

#[test]
fn a_look_from_the_other_coordinates_finds_two_models_that_differ() {
    let nature = |_: &MethodCase| Nature { seconds: 1e-4, error: 1e-5, ..TAME };
    let relative = |m: &MethodCase| m.formulation == FormulationKind::Recursive;
    let methods: Vec<MethodCase> = all().into_iter().filter(relative).collect();
    for (apart, differs) in [(0.0, false), (0.5, true)] {
        let mut bench = Apart(Fake::new(nature), apart);
        let wanted = Wanted { error: 1e-4, deadline: None };
        let mut race = Race::new(&mut bench, entrants(&methods, 1e-4), wanted);
        let places = race.run();
        let instants = Instants { count: 200, interval: 0.01 };
        let look = second::look(&mut race, &places, instants).expect("index-3 runs");
        assert_eq!(look.differs, differs, "{look:?}");
        assert!((look.distance.unwrap() - apart).abs() < 1e-2);
    }
}
