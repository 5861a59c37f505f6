//! Comparison of formulations: every formulation that can run a scene must compute the same motion.
//!
//! Each method runs at dt and dt/2. Its error in a channel is estimated by the largest difference of the two runs. Two methods agree if they
//! differ by at most [`SHARE`] times the larger of their estimates.

use mbs::core::scene::Scene;
use mbs::{FormulationKind, Method, StopError};
use mbs_testkit::quantities;

/// Largest difference of two methods, relative to the larger of their error estimates [-].
const SHARE: f64 = 10.0;
/// Largest difference that is rounding, relative to a channel's size [-]. Its causes are a start assembled to 1e-11 of the scene's length,
/// second differences of positions, and a second of motion.
const ROUNDING: f64 = 1e-7;

/// A formulation with an integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Way(pub(crate) &'static str, pub(crate) &'static str);

/// Methods that are compared; the first one is the reference.
pub(crate) fn methods() -> Vec<Way> {
    // a formulation whose index changes with the step controls the step: it is left out
    let fixed = FormulationKind::listed().filter(|f| !f.row().energy_rule);
    let mut methods: Vec<_> = fixed.map(|f| Way(f.name(), "trapezoidal")).collect();
    let explicit = ["rk4", "rk54", "rk853"];
    methods.extend(explicit.map(|i| Way(FormulationKind::RELATIVE.name(), i)));
    methods
}

/// The formulations that make fixed steps of the trapezoidal rule.
pub(crate) const TRAPEZOIDAL: [&str; 5] =
    ["index-3", "index-1", "classical", "state-space", "recursive"];

/// The trapezoidal methods, and the tree with an explicit method.
pub(crate) const WAYS: [Way; 6] = [
    Way("index-3", "trapezoidal"),
    Way("index-1", "trapezoidal"),
    Way("classical", "trapezoidal"),
    Way("state-space", "trapezoidal"),
    Way("recursive", "trapezoidal"),
    Way("recursive", "rk853"),
];

/// Rows of a run: times and components.
pub(crate) type Rows = Vec<(f64, Vec<f64>)>;

/// Adds outputs of all quantities of centres, bodies and joints to the scene. Reactions are left out, because they are not unique.
pub(crate) fn everything(scene: &Scene<f64>) -> Scene<f64> {
    let asked = scene.outputs.iter().map(|output| output.quantity.clone());
    let all = asked.chain(quantities::every(scene));
    let mut scene = scene.clone();
    quantities::show(&mut scene, all.filter(|quantity| !quantity.row().needs_reactions));
    scene
}

/// Components of the last row.
pub(crate) fn last(rows: &[(f64, Vec<f64>)]) -> &[f64] {
    &rows.last().expect("a row").1
}

/// Runs a scene to `duration` and returns the rows at multiples of `every` steps.
pub(crate) fn rows(
    scene: &Scene<f64>,
    Way(formulation, integrator): Way,
    (step, duration): (f64, f64),
    every: usize,
) -> Result<Rows, StopError> {
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        integrator: Some(integrator.to_owned()),
        step: Some(step),
        duration: Some(duration),
        ..Method::default()
    };
    let outcome = crate::common::run(scene, &overrides);
    match outcome.error {
        Some(error) => Err(error),
        None => Ok(outcome.rows().iter().step_by(every).cloned().collect()),
    }
}

/// Rows of every step of a scene that must run.
pub(crate) fn run(text: &str, way: Way, times: (f64, f64)) -> Rows {
    rows(&mbs_testkit::scene(text), way, times, 1).unwrap_or_else(|e| panic!("{way:?}: {e}"))
}

/// Outputs of an effect: its value, rate, force, energy and power.
pub(crate) fn outputs_of(effect: &str) -> String {
    let one = |quantity: &&str| {
        format!(
            "[[output]]\nname = \"{effect}-{quantity}\"\neffect = \"{effect}\"\nquantity = \"{quantity}\"\n"
        )
    };
    ["value", "rate", "force", "energy", "power"].iter().map(one).collect()
}

/// Rows of a method at dt/2, with its estimated error in every component.
pub(crate) struct RowsWithErrors {
    pub(crate) rows: Rows,
    pub(crate) errors: Vec<f64>,
}

/// Runs a method at dt and dt/2.
pub(crate) fn rows_with_errors(
    scene: &Scene<f64>,
    method: Way,
    (step, duration): (f64, f64),
) -> Result<RowsWithErrors, StopError> {
    let coarse = rows(scene, method, (step, duration), 1)?;
    let fine = rows(scene, method, (0.5 * step, duration), 2)?;
    let errors = differences(&coarse, &fine);
    Ok(RowsWithErrors { rows: fine, errors })
}

/// Largest difference of each component.
pub(crate) fn differences(a: &Rows, b: &Rows) -> Vec<f64> {
    assert_eq!(a.len(), b.len(), "the same rows");
    let mut largest = vec![0.0_f64; a[0].1.len()];
    for ((t, x), (u, y)) in a.iter().zip(b) {
        assert!((t - u).abs() < 1e-9 * (1.0 + t), "the same times: {t} and {u}");
        for (largest, (x, y)) in largest.iter_mut().zip(x.iter().zip(y)) {
            let difference = (x - y).abs();
            if !(difference <= *largest) {
                *largest = difference;
            }
        }
    }
    largest
}

/// Largest absolute value of each component, at least one.
fn sizes(rows: &Rows) -> Vec<f64> {
    let mut sizes = vec![1.0_f64; rows[0].1.len()];
    for (_, x) in rows {
        sizes.iter_mut().zip(x).for_each(|(s, x)| *s = s.max(x.abs()));
    }
    sizes
}

/// Largest ratio of the difference to the allowed difference over all components. It is at most one if two methods agree.
pub(crate) fn disagreement(a: &RowsWithErrors, b: &RowsWithErrors) -> (f64, usize) {
    let sizes = sizes(&a.rows);
    let mut worst = (0.0, 0);
    for (i, difference) in differences(&a.rows, &b.rows).into_iter().enumerate() {
        let allowed = SHARE * a.errors[i].max(b.errors[i]) + ROUNDING * sizes[i];
        let ratio = difference / allowed;
        if !(ratio <= worst.0) {
            worst = (ratio, i);
        }
    }
    worst
}

/// Asserts that an explicit run and the limit of the trapezoidal rule for small steps have equal rows. `digits` is the tolerance, relative to
/// one plus the number. `row` checks a row of the first run.
pub(crate) fn agree_in_the_limit(
    scene: &Scene<f64>,
    way: Way,
    (step, duration, every): (f64, f64, usize),
    digits: f64,
    row: impl Fn(&[f64]),
) {
    let exact = rows(scene, Way("recursive", "rk853"), (step, duration), every).expect("it runs");
    let run = |n: u32| {
        let every = every * n as usize;
        rows(scene, way, (step / f64::from(n), duration), every).expect("it runs")
    };
    let [one, two, four] = [1, 2, 4].map(run);
    for (i, (t, expected)) in exact.iter().enumerate() {
        row(expected);
        for (k, expected) in expected.iter().enumerate() {
            let [a, b, c] = [&one, &two, &four].map(|rows| rows[i].1[k]);
            // extrapolation that removes the errors in h^2 and h^4
            let [ab, bc] = [[a, b], [b, c]].map(|[x, y]| y + (y - x) / 3.0);
            let found = bc + (bc - ab) / 15.0;
            let error = (found - expected).abs() / (1.0 + expected.abs());
            assert!(error < digits, "{way:?}, {t}, {k}: {found} {expected}, of {a} {b} {c}");
        }
    }
}

/// Asserts the energy balance over a second with steps of 0.25 ms: to 1e-9 J by an explicit method, to 1e-4 J by the trapezoidal rule.
pub(crate) fn energy_balances(scene: &Scene<f64>) {
    for (way, most) in [(("recursive", "rk853"), 1e-9), (("index-3", "trapezoidal"), 1e-4)] {
        let method = Method {
            formulation: Some(way.0.to_owned()),
            integrator: Some(way.1.to_owned()),
            step: Some(2.5e-4),
            duration: Some(1.0),
            ..Method::default()
        };
        let outcome = crate::common::run(scene, &method);
        assert!(outcome.error.is_none(), "{way:?}");
        let error = outcome.summary.energy.max_error;
        assert!(error < most, "{way:?}: {error} J");
    }
}
