//! One run of the index-3 formulation, as published or in our form. Numbers have 16 or 32 digits, or the factor has 16 digits and its
//! solutions are refined to 32.
//!
//! The published form has a fixed alpha, multipliers that start from zero, projections that solve for the vector itself [P1 (13), (19)],
//! and no compensated arithmetic.

use crate::bench::request::say;
use crate::bench::scenes;
use mbs_augmented::printed::{self, publication1};
use mbs_augmented::{Options, Penalty, Workspace, index3};
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::real::DoubleDouble as Pair;
use mbs_core::refined::{ALL, Refined, Tally};
use mbs_core::start::assemble;
use mbs_core::step::{Step, StepError, StepReport};
use mbs_core::{Cliques, SpdSolver, scene::Dimension};
use mbs_sparse::Multifrontal;
use serde_json::{Value, json};
use std::time::Instant;

/// The requested run: `SCENE FORM DIGITS STEP SPAN ALPHA`.
struct Asked<'a> {
    scene: &'a str,
    form: &'a str,
    step: &'a str,
    span: &'a str,
    alpha: &'a str,
}

/// Makes the requested run, and prints its report as one line.
pub(crate) fn measure(words: &[String]) -> Result<(), String> {
    let [scene, form, digits, step, span, alpha] = words else {
        return Err(
            "digits SCENE printed|correction|default f64|once|refined|dd STEP SPAN ALPHA".into()
        );
    };
    let asked = Asked { scene, form, step, span, alpha };
    let none = Tally::default;
    let line = match digits.as_str() {
        "f64" => run(&asked, plain::<f64, _>, |_| none()),
        "dd" => run(&asked, plain::<Pair, _>, |_| none()),
        "once" | "refined" => {
            let most = if digits == "once" { 1 } else { ALL };
            let over = |model: &NaturalModel<Pair, 2>| Refined::new(model, plain(model), most);
            run(&asked, over, Refined::take_tally)
        }
        _ => return Err(format!("no digits `{digits}`; there are f64, once, refined, dd")),
    };
    say(&line?);
    Ok(())
}

/// Reads a number in decimal notation.
fn number<T: Real>(text: &str) -> Result<T, String> {
    T::from_decimal(text).ok_or_else(|| format!("`{text}` is no number"))
}

/// A form of index-3 with its options.
#[derive(Debug)]
enum Form<T> {
    Published(printed::Options<T>),
    Ours(Options<T>),
}

/// The form that the words request.
fn form<T: Real>(asked: &Asked<'_>) -> Result<Form<T>, String> {
    let alpha = number(asked.alpha)?;
    // the tolerance is that of double precision in all cases, so that the number of digits is the only difference
    let tolerance = T::from_f64(1e-10);
    let ours = Options { tolerance, ..Options::index3() };
    match asked.form {
        "printed" => {
            Ok(Form::Published(printed::Options { tolerance, ..printed::Options::new(alpha) }))
        }
        "correction" => {
            let penalty = Penalty::Fixed(alpha);
            Ok(Form::Ours(Options { penalty, adaptive_penalty: false, ..ours }))
        }
        "default" => Ok(Form::Ours(ours)),
        form => Err(format!("no form `{form}`; there are printed, correction, default")),
    }
}

/// Outcome of a run, summed over its steps.
#[derive(Debug, Default)]
struct Outcome {
    steps: u32,
    iterations: u64,
    seconds: f64,
    energy_error: f64,
    turned_over: f64,
    violation: [f64; 3],
    tally: Tally,
    /// Time and reason of a stop.
    stopped: Option<(f64, String)>,
}

impl Outcome {
    /// Adds the report of a step that ends or fails at time `t` [s].
    fn take<T: Real>(&mut self, t: f64, report: Result<StepReport<T>, StepError>, tally: Tally) {
        match report {
            Ok(report) => {
                self.steps += 1;
                self.iterations += u64::from(report.iterations);
                for (most, now) in self.violation.iter_mut().zip(report.violation) {
                    *most = worse(*most, now.to_f64());
                }
            }
            Err(error) => self.stopped = Some((t, error.to_string())),
        }
        self.tally.solutions += tally.solutions - tally.failed;
        self.tally.corrections += tally.corrections;
        // a step also fails where the refinement of a solution failed
        if let Some(error) = tally.failure {
            self.stopped = Some((t, error.to_string()));
        }
    }

    fn json(&self) -> Value {
        let each = |x: f64| x / f64::from(self.steps.max(1));
        #[allow(clippy::cast_precision_loss, reason = "counts of steps")]
        let [iterations, solutions, corrections] =
            [self.iterations, self.tally.solutions, self.tally.corrections].map(|n| n as f64);
        let mut line = json!({
            "kind": "digits", "steps": self.steps, "iterations": each(iterations), "seconds": each(self.seconds),
            "energy_error": self.energy_error, "turned_over": self.turned_over, "violation": self.violation,
        });
        if solutions > 0.0 {
            line["corrections"] = json!(corrections / solutions);
        }
        if let Some((t, why)) = &self.stopped {
            (line["stopped_at"], line["reason"]) = (json!(t), json!(why));
        }
        line
    }
}

/// Makes the steps from the scene's start to the end of the span.
fn run<T: Real, S: SpdSolver<T>>(
    asked: &Asked<'_>,
    analyse: impl Fn(&NaturalModel<T, 2>) -> S,
    tally: impl Fn(&S) -> Tally,
) -> Result<Value, String> {
    let scene = scenes::read::<T>(asked.scene)?;
    if scene.dimension != Dimension::Planar {
        return Err(format!("`{}` is not planar", asked.scene));
    }
    let form = form::<T>(asked)?;
    let model = NaturalModel::<T, 2>::new(&scene).map_err(|e| e.to_string())?;
    let mut solver = plain(&model);
    let start = assemble(&scene, &model, |p| plain(p), &mut solver);
    let mut state = start.map_err(|e| e.to_string())?.state;
    let mut workspace = Workspace::new(&model, analyse(&model));
    let step = Step { dt: number(asked.step)?, length: model.length() };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let n = (number::<f64>(asked.span)? / step.dt.to_f64()).round().clamp(1.0, 1e9) as u32;

    let reading = reading();
    let mut energy = Energy::new(&model, &state, workspace.terms());
    let mut outcome = Outcome::default();
    for _ in 0..n {
        let clock = Instant::now();
        let report = match &form {
            Form::Published(o) => publication1(&model, step, o, &mut state, &mut workspace),
            Form::Ours(o) => index3::step(&model, step, o, &mut state, &mut workspace),
        };
        outcome.seconds += (clock.elapsed().as_secs_f64() - reading).max(0.0);
        outcome.take(state.t.to_f64(), report, tally(workspace.solver()));
        if outcome.stopped.is_some() {
            break;
        }
        energy.mark(&model, &state, workspace.terms());
        if !energy.error.is_finite() {
            outcome.stopped = Some((state.t.to_f64(), "the energy is not a number".to_owned()));
            break;
        }
    }
    (outcome.energy_error, outcome.turned_over) = (energy.error, energy.kinetic);
    Ok(outcome.json())
}

/// Makes a solver whose factor has the precision of the model.
fn plain<T: Real, C: Cliques>(cliques: &C) -> Multifrontal<T> {
    Multifrontal::analyse(cliques, mbs_sparse::Options::default())
}

/// Returns the larger number; NaN counts as larger than all.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}

/// Energy of a conservative scene, checked after every step.
struct Energy<T> {
    initial: T,
    /// Largest error of the energy, and largest kinetic energy [J].
    error: f64,
    kinetic: f64,
}

impl<T: Real> Energy<T> {
    fn new(model: &impl Model<T>, s: &State<T>, terms: &mbs_core::model::Terms<T>) -> Self {
        let kinetic = model.kinetic_energy(&s.v);
        let initial = kinetic + model.potential_energy(&s.q, terms);
        Self { initial, error: 0.0, kinetic: kinetic.to_f64() }
    }

    fn mark(&mut self, model: &impl Model<T>, s: &State<T>, terms: &mbs_core::model::Terms<T>) {
        let kinetic = model.kinetic_energy(&s.v);
        let error = kinetic + model.potential_energy(&s.q, terms) - self.initial;
        self.error = worse(self.error, error.to_f64().abs());
        self.kinetic = worse(self.kinetic, kinetic.to_f64());
    }
}

/// Measures the time of one reading of the clock [s].
fn reading() -> f64 {
    /// Number of readings that are timed together [-], since the clock cannot resolve a single one.
    const TIMES: u32 = 10_000;
    let clock = Instant::now();
    let sum: f64 = (0..TIMES).map(|_| Instant::now().elapsed().as_secs_f64()).sum();
    // the sum is used, so that the compiler does not remove the readings
    if sum < 0.0 { 0.0 } else { clock.elapsed().as_secs_f64() / f64::from(2 * TIMES) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mbs_core::refined::RefinementError;

    fn words(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn malformed_requests_are_refused() {
        for (text, why) in [
            ("double-pendulum printed f64", "STEP SPAN ALPHA"),
            ("double-pendulum printed f16 1e-3 1 1e7", "no digits `f16`"),
        ] {
            let why_not = measure(&words(text)).unwrap_err();
            assert!(why_not.contains(why), "{why_not}");
        }
        let asked = |form, alpha| Asked { scene: "", form, step: "1", span: "1", alpha };
        assert!(form::<f64>(&asked("print", "1")).unwrap_err().contains("no form `print`"));
        assert!(form::<f64>(&asked("printed", "x")).unwrap_err().contains("`x` is no number"));
    }

    #[test]
    fn a_form_is_the_same_with_more_digits() {
        fn limits<T: Real>(form: &Form<T>) -> (u64, u32, bool) {
            let (tolerance, iterations) = match form {
                Form::Published(o) => (o.tolerance, o.max_iterations),
                Form::Ours(o) => (o.tolerance, o.max_iterations),
            };
            (tolerance.to_f64().to_bits(), iterations, matches!(form, Form::Published(_)))
        }
        for name in ["printed", "correction", "default"] {
            let asked = Asked { scene: "", form: name, step: "1", span: "1", alpha: "1e9" };
            let (short, long) = (form::<f64>(&asked).unwrap(), form::<Pair>(&asked).unwrap());
            assert_eq!(limits(&short), limits(&long));
        }
    }

    #[test]
    fn failures_are_reported_with_their_time_and_leave_no_average_behind() {
        let mut outcome = Outcome::default();
        let error = RefinementError::NotFinite;
        let tally = Tally { solutions: 3, corrections: 8, failed: 1, failure: Some(error) };
        outcome.take::<f64>(0.5, Err(StepError::NotFinite { unknown: 1 }), tally);
        let line = outcome.json();
        assert_eq!(line["reason"], json!(error.to_string()));
        assert_eq!((&line["stopped_at"], &line["corrections"]), (&json!(0.5), &json!(4.0)));
    }
}
