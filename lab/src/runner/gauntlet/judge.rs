//! Evaluation of each method: its outputs are compared with a reference that another method gave. The unit is the error of the trapezoidal
//! rule at that step.
//!
//! The error of the rule is the lower median of the errors of the other formulations, or of those on the equivalent mechanism. Their errors
//! at steps down to half of the step count too, if they are larger. A result is *wrong* if its error is more than ten times the error of
//! the rule and more than machine precision. It is also wrong if the error of its energy balance at the end exceeds a tenth of the
//! exchanged energy. It is not wrong if the run stops with a typed error, or if the error decreases with the square of the step.

use crate::gauntlet::case::{Case, Image, Options, Truth};
use crate::gauntlet::run::{EXTRAPOLATED, Ran, methods, run};
use mbs::FormulationKind;

/// Ratio of an error to that of the rule above which the result is wrong [-]. Chosen, not tuned.
const TIMES: f64 = 10.0;
/// Error that counts as machine precision in double and in single precision, relative to the size of the case [-]. Chosen, not tuned.
const ROUNDING: [f64; 2] = [1e-7, 2e-3];
/// Error above which a correct result is reported as coarse [-]: relative to the size of the case, or of the energy relative to the
/// exchanged one. Chosen, not tuned.
const COARSE: f64 = 0.1;
/// Largest difference of two references that agree, relative to the size of the case [-]. If they agree, no third one is run. Chosen, not
/// tuned.
const AGREEMENT: f64 = 1e-3;
/// Largest residual of joints where only invariants are checked, relative to the size of the case [-]. Chosen, not tuned.
const MOST_VIOLATION: f64 = 1e-6;
/// Largest factor between a quotient of two errors and the square of the quotient of their steps for an error of second order [-]. Chosen,
/// not tuned.
const ORDER: f64 = 3.0;
/// Number of steps of a reference in one step of the case. Chosen, not tuned.
const FINER: f64 = 10.0;
/// Number of steps of a second run in one step of the case. It shows how an error decreases with the step. Chosen, not tuned.
const THIRD: f64 = 3.0;
/// Fractions of the step at which the error of the rule is evaluated again [-], since it may be small by chance at the full step. They are
/// tenths, so that a reference with a tenth of the step has rows at the same times. Other references have rows at some of the times and at
/// the end.
const SMALLER: [f64; 5] = [0.9, 0.8, 0.7, 0.6, 0.5];
/// Largest number of formulations from which references are taken. Chosen, not tuned.
const N_REFERENCES: usize = 4;

/// Formulations from which references are taken, in this order.
fn reference_methods() -> Vec<&'static str> {
    FormulationKind::references().into_iter().take(N_REFERENCES).map(|f| f.name()).collect()
}

/// Verdict on a method in a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Correct outputs: the error relative to the size of the case.
    Right(f64),
    /// Correct outputs, compared with the rule, which itself has a large error at this step.
    Coarse(f64),
    /// Error larger than those of the others, but decreasing with the square of the step: it is the rule's error in these coordinates.
    Apart(f64),
    /// Code of a typed error, and the time of the stop [s].
    Stopped(String, f64),
    /// Completed run with constant energy and closed joints. More cannot be known of a long motion.
    Kept,
    /// Completed run without a reference, with finite outputs and an exact energy balance.
    Unjudged,
    /// Reason why a result is wrong.
    Wrong(String),
}

type Row = (f64, Vec<f64>);
type Rows = Vec<Row>;

/// True rows, and the formulation that gave them, if there is one.
struct Reference {
    method: Option<&'static str>,
    rows: Rows,
}

/// Runs a case with all methods. `about` is called with each run's name before the run begins.
pub fn judge(case: &Case, about: &mut dyn FnMut(&str)) -> Vec<(&'static str, Verdict)> {
    let ran: Vec<(&'static str, Ran)> = methods()
        .map(|method| {
            about(method);
            (method, run(&case.scene, method, case.step, case.options))
        })
        .collect();
    let references = references(case, &ran, about);
    let rule = match &case.truth {
        Truth::Twin(scene, image) => {
            let twins = runs(scene, &reference_methods()[..3], case.step, about);
            let twins: Vec<_> = twins.iter().map(|(m, rows)| (*m, image_of(rows, image))).collect();
            errors(twins.iter().map(|(m, rows)| (*m, &rows[..])), &references, case.size)
        }
        _ => {
            let completed = ran.iter().filter_map(|(method, ran)| Some((*method, ran.rows()?)));
            errors(completed, &references, case.size)
        }
    };
    ran.into_iter()
        .map(|(method, ran)| (method, verdict(case, (method, ran), &references, &rule)))
        .collect()
}

fn verdict(
    case: &Case,
    (method, ran): (&'static str, Ran),
    references: &[Reference],
    rule: &[(&'static str, f64)],
) -> Verdict {
    let (rows, energy) = match ran {
        Ran::Broken(why) => return Verdict::Wrong(why),
        Ran::Stopped { code, time } => return Verdict::Stopped(code, time),
        Ran::Completed { violation, .. } if matches!(case.truth, Truth::Invariants) => {
            return match violation <= MOST_VIOLATION * case.size {
                true => Verdict::Kept,
                false => Verdict::Wrong(format!("the joints are open by {violation:e} m")),
            };
        }
        Ran::Completed { rows, energy, .. } => (rows, energy),
    };
    let Some(reference) = of_another(references, method) else { return Verdict::Unjudged };
    let is_twin = matches!(case.truth, Truth::Twin(..));
    // a formulation that controls its steps takes shorter ones, so its error is not that of the rule at this step
    let is_steered = |f: &str| FormulationKind::of_name(f).is_some_and(|f| f.row().energy_rule);
    let is_other = |other: &str| !is_steered(other) && (is_twin || other != method);
    let others = rule.iter().filter(|(other, _)| is_other(other)).map(|(_, e)| *e);
    let Some(of_rule) = lower_median(others.collect()) else { return Verdict::Unjudged };
    let error = error(&rows, &reference.rows, case.size);
    let allowed = TIMES * of_rule + ROUNDING[usize::from(case.options.is_single)];
    if error > allowed && error > TIMES * at_smaller(case, method, references) {
        if is_of_the_rule(case, method, error, &reference.rows) {
            return Verdict::Apart(error);
        }
        Verdict::Wrong(format!("off by {error:.2e} of the size, where {allowed:.2e} are allowed"))
    } else if error.max(energy) > COARSE {
        Verdict::Coarse(error.max(energy))
    } else {
        Verdict::Right(error)
    }
}

/// Largest error of the others at slightly smaller steps. Where it is larger, their errors at the step were small by chance. At another
/// step a contact or a break occurs at another part of the step, on which the error of the rule depends.
fn at_smaller(case: &Case, method: &str, references: &[Reference]) -> f64 {
    let others: Vec<&'static str> =
        reference_methods().into_iter().filter(|m| *m != method).collect();
    let off = |share: f64| {
        let rows = runs_with(&case.scene, &others, share * case.step, case.options);
        let errors = errors(rows.iter().map(|(m, rows)| (*m, &rows[..])), references, case.size);
        lower_median(errors.into_iter().map(|(_, e)| e).collect()).unwrap_or(0.0)
    };
    SMALLER.into_iter().map(off).filter(|e| e.is_finite()).fold(0.0, f64::max)
}

/// True if an error is that of a rule of second order. Such an error decreases with the square of the step. An error of a motion on another
/// branch, or of an iteration that ended early, does not.
fn is_of_the_rule(case: &Case, method: &str, error: f64, reference: &[Row]) -> bool {
    if error >= COARSE {
        return is_of_the_rule_later(case, method, error, reference);
    }
    let at = |finer: f64| {
        let fine = at_part(case, method, finer)?;
        Some((finer, self::error(&fine, reference, case.size)))
    };
    // a run with a tenth of the step may stop where the run with the full step did not; then a third of the step is used
    let fine = [FINER, THIRD].into_iter().find_map(at);
    fine.is_some_and(|(finer, fine)| is_square(error / fine, finer))
}

/// True if an error of the size of the motion is that of a rule of second order. Such an error decreases by no law at this step, but with
/// the square of the step from a tenth of it on. Its limit must be the reference, up to the reference's error with steps of a tenth.
fn is_of_the_rule_later(case: &Case, method: &str, error: f64, reference: &[Row]) -> bool {
    let finer = [FINER, FINER * THIRD, FINER * THIRD * THIRD];
    let [Some(tenth), Some(finer), Some(finest)] = finer.map(|f| at_part(case, method, f)) else {
        return false;
    };
    let off = |rows: &[Row], from: &[Row]| self::error(rows, from, case.size);
    let (coarse, fine) = (off(&tenth, &finest), off(&finer, &finest));
    error > FINER * coarse
        && is_square(coarse / fine, THIRD)
        && off(&finest, reference) < ORDER * coarse
}

/// Rows of a method with the step divided by `finer`.
fn at_part(case: &Case, method: &str, finer: f64) -> Option<Rows> {
    match run(&case.scene, method, case.step / finer, case.options) {
        Ran::Completed { rows, .. } => Some(rows),
        _ => None,
    }
}

/// True if a quotient of errors is the square of the quotient of steps, up to the factor `ORDER`.
fn is_square(errors: f64, steps: f64) -> bool {
    let square = steps * steps;
    errors > square / ORDER && errors < square * ORDER
}

/// The first reference that another method gave.
fn of_another<'a>(references: &'a [Reference], method: &str) -> Option<&'a Reference> {
    references.iter().find(|reference| reference.method != Some(method))
}

/// Finds the references of a case. Formulations give two, so that each method has a reference from another one.
fn references(
    case: &Case,
    ran: &[(&'static str, Ran)],
    about: &mut dyn FnMut(&str),
) -> Vec<Reference> {
    let fine = case.step / FINER;
    match &case.truth {
        Truth::Invariants => Vec::new(),
        Truth::Closed(form) => {
            let times = ran.iter().filter_map(|(_, ran)| ran.rows()).flatten().map(|(t, _)| *t);
            let mut times: Vec<f64> = times.collect();
            times.sort_by(f64::total_cmp);
            times.dedup_by(|a, b| a.to_bits() == b.to_bits());
            let rows = times.into_iter().map(|t| (t, form(t))).collect();
            vec![Reference { method: None, rows }]
        }
        Truth::Extrapolated => {
            let found = runs(&case.scene, &[EXTRAPOLATED], case.step, about);
            found.into_iter().map(|(_, rows)| Reference { method: None, rows }).collect()
        }
        Truth::Twin(scene, image) => agreeing(scene, fine, case.size, about)
            .into_iter()
            .map(|(_, rows)| Reference { method: None, rows: image_of(&rows, image) })
            .collect(),
        Truth::Others => agreeing(&case.scene, fine, case.size, about)
            .into_iter()
            .map(|(method, rows)| Reference { method: Some(method), rows })
            .collect(),
    }
}

/// Rows of two formulations that agree: the first two, or the two of all whose difference is smallest. If only one run was completed, its
/// rows.
fn agreeing(
    scene: &str,
    step: f64,
    size: f64,
    about: &mut dyn FnMut(&str),
) -> Vec<(&'static str, Rows)> {
    let mut found: Vec<(&'static str, Rows)> = Vec::new();
    let methods = reference_methods();
    for &method in &methods {
        found.extend(runs(scene, &[method], step, about));
        let apart = |a: &[Row], b: &[Row]| error(a, b, size);
        let nearest = pairs(found.len())
            .map(|(i, j)| (apart(&found[i].1, &found[j].1), i, j))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((apart, i, j)) = nearest else { continue };
        let is_last = methods.last() == Some(&method);
        if apart <= AGREEMENT || (is_last && apart <= COARSE) {
            let second = found.swap_remove(j);
            return vec![found.swap_remove(i), second];
        }
    }
    if found.len() == 1 { found } else { Vec::new() }
}

/// All pairs (i, j) with i < j < n.
fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |j| (0..j).map(move |i| (i, j)))
}

/// Rows of the methods whose runs with these options are completed.
fn runs_with(
    scene: &str,
    methods: &[&'static str],
    step: f64,
    options: Options,
) -> Vec<(&'static str, Rows)> {
    let one = |&method: &&'static str| match run(scene, method, step, options) {
        Ran::Completed { rows, .. } => Some((method, rows)),
        _ => None,
    };
    methods.iter().filter_map(one).collect()
}

/// Rows of the methods whose runs are completed.
fn runs(
    scene: &str,
    methods: &[&'static str],
    step: f64,
    about: &mut dyn FnMut(&str),
) -> Vec<(&'static str, Rows)> {
    let one = |&method: &&'static str| {
        about(&format!("reference by {method}"));
        runs_with(scene, &[method], step, Options::default()).pop()
    };
    methods.iter().filter_map(one).collect()
}

/// Error of each method against the first reference of another method.
fn errors<'a>(
    ran: impl Iterator<Item = (&'static str, &'a [Row])>,
    references: &[Reference],
    size: f64,
) -> Vec<(&'static str, f64)> {
    let one = |(method, rows): (&'static str, &[Row])| {
        Some((method, error(rows, &of_another(references, method)?.rows, size)))
    };
    ran.filter_map(one).collect()
}

/// The largest difference of a point in rows of the same time, relative to the size. Rows without a reference are skipped, but the last row
/// needs one.
fn error(rows: &[Row], reference: &[Row], size: f64) -> f64 {
    let end = rows.last().map_or(0.0, |(t, _)| *t);
    // times in single precision have seven digits
    let near = 3e-7 * end;
    let (mut k, mut most) = (0, f64::INFINITY);
    for (t, row) in rows {
        while k + 1 < reference.len() && reference[k].0 < t - near {
            k += 1;
        }
        let Some((at, right)) = reference.get(k).filter(|(at, _)| (at - t).abs() <= near) else {
            continue;
        };
        let squares = row.iter().zip(right).map(|(a, b)| (a - b) * (a - b));
        let off = squares.sum::<f64>().sqrt() / size;
        most = if most.is_finite() { most.max(off) } else { off };
        if *at >= end - near {
            return most;
        }
    }
    f64::INFINITY
}

fn image_of(rows: &[Row], image: &Image) -> Rows {
    rows.iter().map(|(t, row)| (*t, image.of(row))).collect()
}

/// Median of numbers; of an even number of them the lower of the middle two.
fn lower_median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    (!numbers.is_empty()).then(|| numbers[(numbers.len() - 1) / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_those_of_rows_of_the_same_time_and_the_end_must_be_there() {
        let row = |t: f64, x: f64| (t, vec![x, 0.0]);
        let right = [row(0.0, 0.0), row(0.1, 1.0), row(0.2, 2.0)];
        let near = |rows: &[Row], expected: f64| {
            let found = error(rows, &right, 2.0);
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        };
        near(&[row(0.0, 0.0), row(0.15, 9.0), row(0.2, 2.5)], 0.25);
        near(&[row(0.0, 0.8), row(0.2, 2.5)], 0.4);
        assert!(error(&[row(0.0, 0.0), row(0.19, 2.0)], &right, 2.0).is_infinite());
        assert_eq!(lower_median(vec![3.0, 1.0, 2.0, 4.0]), Some(2.0));
        assert_eq!(lower_median(Vec::new()), None);
    }
}
