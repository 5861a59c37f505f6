//! Reference of the errors: a run by a method that is not compared, in two accuracies, checked by another formulation.

use super::ladder::Instants;
use super::table::ReferenceTable;
use crate::compare::results::{CrossCheck, OutputScale, Reference, output_scales, row_distance};
use mbs::record::Channel;
use mbs_scene::format::significant;

/// Smallest ratio of the smallest ranked error to the uncertainty of the reference at an instant that counts as well known [-]. Chosen, not
/// tuned.
const KNOWN: f64 = 3.0;
/// Smallest fraction of the instants that is compared, even if they are not well known [-]. Chosen, not tuned.
const LEAST_SHARE: f64 = 0.1;
/// Largest difference at which a formulation agrees with the reference, in units of their uncertainty [-]. Chosen, not tuned.
const AGREES: f64 = 3.0;
/// Difference from two formulations that refutes a table, in units of the uncertainty of all [-]. Chosen, not tuned.
const REFUTED: f64 = 10.0;
/// Largest uncertainty of a check, relative to the outputs' ranges [-]. A less certain check shows nothing. Chosen, not tuned.
const MAX_CHECK_UNCERTAINTY: f64 = 1e-2;

/// Rows at the instants after the start.
pub(super) type Rows = Vec<Vec<f64>>;

/// Solution with an estimate of its accuracy: rows, and less accurate rows by the same method.
#[derive(Debug, Clone)]
pub struct RunPair {
    /// Name of the method.
    pub method: String,
    /// Rows of the accurate solution.
    pub rows: Rows,
    /// The less accurate rows.
    pub coarse: Rows,
}

impl RunPair {
    /// Extrapolates a method of second order from three runs, each with half the step of the run before. With step h and result y(h):
    ///
    /// ```text
    /// y = (4 y(h/2) − y(h)) / 3
    /// ```
    pub fn richardson(method: String, [long, half, quarter]: [&Rows; 3]) -> Self {
        let of = |long: &Rows, short: &Rows| -> Rows {
            let row = |(a, b): (&Vec<f64>, &Vec<f64>)| {
                a.iter().zip(b).map(|(a, b)| b + (b - a) / 3.0).collect()
            };
            long.iter().zip(short).map(row).collect()
        };
        Self { method, rows: of(half, quarter), coarse: of(long, half) }
    }
}

/// The reference as the comparison uses it.
#[derive(Debug, Clone)]
pub struct Known {
    /// Rows at the instants, if they are known.
    pub(super) rows: Vec<Option<Vec<f64>>>,
    pub(super) scales: Vec<OutputScale>,
    /// Report on the reference in the results.
    pub report: Reference,
    /// Notes on what is doubtful in the reference.
    pub notes: Vec<String>,
    /// True if the reference is a table that two agreeing formulations refute.
    pub is_refuted: bool,
}

impl Known {
    /// Makes the reference from a table. Columns that the table does not have are not compared.
    pub fn of_table(
        table: ReferenceTable,
        name: &str,
        (channels, length): (&[Channel], f64),
    ) -> Self {
        let given: Rows = table.rows.iter().flatten().cloned().collect();
        let mut scales = output_scales(channels, &given, length);
        let (mut uncertainty, mut notes) = (0.0_f64, Vec::new());
        for scale in &mut scales {
            scale.columns.retain(|&c| table.has[c]);
            match scale.scale {
                Some(size) if !scale.columns.is_empty() => {
                    let digits = scale.columns.iter().map(|&c| table.digits[c]);
                    uncertainty = uncertainty.max(digits.fold(0.0, f64::max) / size);
                }
                _ => scale.scale = None,
            }
        }
        let missing = table.rows.iter().filter(|row| row.is_none()).count();
        if missing > 0 {
            let of = table.rows.len();
            notes.push(format!("the table has {} of the {of} instants", of - missing));
        }
        let report = Reference {
            kind: "table".to_owned(),
            method: format!("table {name}, {} rows", given.len()),
            uncertainty,
            ..Reference::default()
        };
        Self { rows: table.rows, scales, report, notes, is_refuted: false }
    }

    /// Compares a table with two solutions by different formulations. The table is verified if both agree with it, within the uncertainty of
    /// all three. It is refuted if both agree with each other and differ from it by more than [`REFUTED`].
    pub fn verify(&mut self, name: &str, pairs: &[RunPair], instants: &Instants) {
        let [a, b, ..] = pairs else {
            let note = "the reference is NOT verified: it is taken as given, since no two formulations run the scene to the end";
            self.notes.push(note.to_owned());
            return;
        };
        let distance = |x: &[f64], y: &[f64]| row_distance(&self.scales, x, y)[0];
        let (mut apart, mut largest, mut is_near) = (0.0_f64, 0.0_f64, true);
        let mut seen = 0;
        let mut miss: Option<(usize, f64)> = None;
        for (k, row) in self.rows.iter().enumerate() {
            let of = |rows: &Rows| rows.get(k).cloned();
            let all = (of(&a.rows), of(&a.coarse), of(&b.rows), of(&b.coarse));
            let (Some(best), Some(coarse), Some(other), Some(rough)) = all else { break };
            for (x, y) in [(&best, &coarse), (&other, &rough), (&best, &other)] {
                apart = apart.max(distance(x, y));
            }
            // after this instant the motion is not known well enough, for instance because it is chaotic
            if !(apart <= MAX_CHECK_UNCERTAINTY) {
                break;
            }
            let Some(row) = row else { continue };
            let d = distance(row, &best);
            let expected = self.report.uncertainty + apart;
            (seen, largest) = (seen + 1, largest.max(d));
            is_near &= d <= AGREES * expected;
            if d > REFUTED * expected && miss.is_none_or(|(_, most)| d > most) {
                miss = Some((k, d));
            }
        }
        self.report.cross_check = Some(CrossCheck::new(&a.method, largest, apart));
        self.report.is_verified = seen > 0 && is_near;
        self.is_refuted = miss.is_some();
        if let Some((k, _)) = miss {
            let note = format!(
                "the reference is NOT verified: {} and {} agree to {apart:.1e}, and differ from {name} by {} at {} s; no method is \
                 compared with it",
                a.method,
                b.method,
                self.largest_miss(k, &a.rows[k]),
                significant(instants.time(k + 1))
            );
            self.notes.push(note);
        } else if !self.report.is_verified {
            self.notes.push(doubt(self.report.cross_check.as_ref()));
        }
    }

    /// Returns the largest distance of a row from the table, as text with its unit and output.
    fn largest_miss(&self, k: usize, row: &[f64]) -> String {
        let Some(known) = &self.rows[k] else { return String::new() };
        let each = self.scales.iter().flat_map(|scale| {
            let size = scale.scale.unwrap_or(f64::INFINITY);
            scale.columns.iter().map(move |&c| (scale, c, size))
        });
        let share = |c: usize, size: f64| (known[c] - row[c]).abs() / size;
        let worst = each.max_by(|a, b| share(a.1, a.2).total_cmp(&share(b.1, b.2)));
        let Some((scale, c, _)) = worst else { return String::new() };
        let far = mbs_scene::format::few((known[c] - row[c]).abs());
        format!("{far} {} of `{}`", scale.unit, scale.output)
    }

    /// Makes the reference from runs. `check` is a solution by another formulation, and `least` the smallest error of the ranking.
    pub fn of_runs(
        best: &RunPair,
        check: Option<&RunPair>,
        (channels, length): (&[Channel], f64),
        (instants, least): (&Instants, f64),
    ) -> Self {
        let all = best.rows.len();
        let scales = output_scales(channels, &best.rows, length);
        let parted = distances(&scales, &best.rows, &best.coarse);
        let n = known(&parted, least / KNOWN);
        // output scales are ranges over the compared instants only
        let scales =
            if n < all { output_scales(channels, &best.rows[..n], length) } else { scales };
        let rows = &best.rows[..n];
        let largest = |other: &Rows| {
            distances(&scales, rows, &other[..n.min(other.len())]).last().copied().unwrap_or(0.0)
        };
        // rows are stored in `f64`, even if the run has more digits
        let uncertainty = largest(&best.coarse).max(f64::EPSILON);
        let mut notes = Vec::new();
        let cross_check = check.map(|check| {
            let (n, m) = (n.min(check.rows.len()), n.min(check.coarse.len()));
            let apart = distances(&scales, &check.rows[..n], &check.coarse[..m]);
            let uncertainty = apart.last().copied().unwrap_or(f64::INFINITY);
            CrossCheck::new(&check.method, largest(&check.rows), uncertainty)
        });
        let is_verified = cross_check.as_ref().is_some_and(|check| {
            let larger = check.own_uncertainty.max(uncertainty);
            check.own_uncertainty <= MAX_CHECK_UNCERTAINTY && check.difference <= AGREES * larger
        });
        if !is_verified {
            notes.push(doubt(cross_check.as_ref()));
        }
        let known_until = (n < all).then(|| instants.time(n));
        if let Some(t) = known_until {
            notes.push(format!(
                "the two runs of the reference part: after {} s they are further apart than a third of the least error ranked; \
                 compared is what comes before",
                significant(t)
            ));
        }
        let report = Reference {
            kind: "computed".to_owned(),
            method: best.method.clone(),
            uncertainty,
            cross_check,
            known_until,
            is_verified,
        };
        let rows = rows.iter().cloned().map(Some).collect();
        Self { rows, scales, report, notes, is_refuted: false }
    }

    /// Largest error and root mean square of the errors of rows at the same instants. `None` if rows are missing or not finite.
    pub fn errors(&self, rows: &[Vec<f64>]) -> Option<[f64; 2]> {
        if rows.len() < self.rows.len() {
            return None;
        }
        let (mut largest, mut squares, mut n) = (0.0_f64, 0.0, 0);
        for (known, row) in self.rows.iter().zip(rows) {
            let Some(known) = known else { continue };
            let [most, rms] = row_distance(&self.scales, known, row);
            if !most.is_finite() {
                return None;
            }
            largest = largest.max(most);
            squares += rms * rms;
            n += 1;
        }
        Some([largest, (squares / n.max(1) as f64).sqrt()])
    }
}

fn doubt(check: Option<&CrossCheck>) -> String {
    match check {
        None => "the reference is NOT verified: no other formulation runs the scene to the end"
            .to_owned(),
        Some(check) if check.own_uncertainty > MAX_CHECK_UNCERTAINTY => format!(
            "the reference is NOT verified: the check itself has an uncertainty of {:.1e}",
            check.own_uncertainty
        ),
        Some(check) => format!(
            "the reference is NOT verified: {} is {:.1e} away, more than the uncertainty of both",
            check.method, check.difference
        ),
    }
}

/// Returns for each instant the largest distance of two runs up to it.
fn distances(scales: &[OutputScale], a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<f64> {
    let mut largest = 0.0_f64;
    let distances = a.iter().zip(b).map(|(a, b)| {
        let [d, _] = row_distance(scales, a, b);
        largest = if d.is_nan() { f64::INFINITY } else { largest.max(d) };
        largest
    });
    distances.collect()
}

/// Returns the number of instants that are compared: those before the distance of the two runs exceeds `bound`. At least a tenth of all
/// instants is compared; the bound is raised for them if necessary.
fn known(parted: &[f64], bound: f64) -> usize {
    let all = parted.len();
    let within = |bound: f64| parted.iter().take_while(|d| **d <= bound).count();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of a count"
    )]
    let least = ((all as f64 * LEAST_SHARE).ceil() as usize).max(1);
    let mut bound = bound;
    while within(bound) < least && bound < 1.0 {
        bound *= 10.0;
    }
    within(bound).max(least.min(all))
}
