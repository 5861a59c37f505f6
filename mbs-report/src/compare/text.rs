//! A comparison as tables, for the terminal and the page.

use crate::report::{Report, Section, row};
use mbs::record::Provenance;
use mbs_scene::format::{rounded, significant};
use mbs_study::compare::results::{Comparison, MethodRuns, RankLevel, RunEntry, Status};

/// Largest number of failures of a method that are listed in the terminal [-]. Chosen, not tuned.
const MOST_SETTINGS: usize = 4;

/// Returns the tables of a comparison.
#[must_use]
pub fn report(comparison: &Comparison) -> Report {
    Tables(comparison).report()
}

/// Tables of a comparison, for the terminal and for the page.
pub(super) struct Tables<'a>(pub(super) &'a Comparison);

impl Tables<'_> {
    fn report(&self) -> Report {
        let mut sections = vec![self.basis()];
        sections.extend(self.levels());
        sections.extend(self.choices());
        sections.push(self.by_method());
        sections.extend(self.failures());
        sections.push(self.all_runs());
        let origin = &self.0.provenance;
        let provenance = Provenance {
            command: origin.command.clone(),
            version: origin.version.clone(),
            cpu: origin.cpu.clone(),
            ..Provenance::default()
        };
        Report { title: self.title(), sections, provenance, ..Report::default() }
    }

    pub(super) fn title(&self) -> String {
        format!("{}: methods compared", self.0.scene)
    }

    /// Returns the reason why no rank is reliable, if there is one.
    pub(super) fn unverified(&self) -> Option<String> {
        let notes = self.0.notes.join("; ");
        (!self.0.reference.is_verified).then(|| format!("The reference is not verified. {notes}"))
    }

    /// Returns the tables of ranks, one for each error.
    pub(super) fn levels(&self) -> Vec<Section> {
        self.0.ranking.iter().map(Self::level).collect()
    }

    /// Returns the table of the methods and the reference that are compared.
    pub(super) fn basis(&self) -> Section {
        let r = &self.0.reference;
        let [compared, whole] = [self.0.compared, self.0.duration].map(significant);
        let interval = significant(rounded(self.0.interval, 4));
        let error = format!(
            "largest over the outputs at {} instants, one every {interval} s, each output in its scale",
            self.0.instants
        );
        let mut rows = vec![
            row("compared", format!("the first {compared} s of {whole} s")),
            row("error", error),
        ];
        let scale = |s: &mbs_study::compare::results::OutputScale| match s.scale {
            Some(size) => format!("{} {} {}", s.output, short(size), s.unit),
            None => format!("{} stands still and is left out", s.output),
        };
        let scales: Vec<String> = self.0.outputs.iter().map(scale).collect();
        rows.push(row("scales", scales.join("; ")));
        rows.push(row("reference", r.method.clone()));
        rows.push(row(
            "its uncertainty",
            format!("{:.1e}: errors below {:.1e} are marked *", r.uncertainty, self.0.floor()),
        ));
        if let Some(check) = &r.cross_check {
            rows.push(row(
                "beside it",
                format!(
                    "{}: {:.1e} away, with an uncertainty of {:.1e}",
                    check.method, check.difference, check.own_uncertainty
                ),
            ));
        }
        let verified = if r.is_verified { "yes" } else { "NO: see the notes" };
        rows.push(row("verified", verified.to_owned()));
        rows.push(row(
            "time",
            format!(
                "CPU time of the steps with the energy watched, nothing recorded; least of {} fresh starts or more, interleaved",
                self.0.repeats
            ),
        ));
        rows.extend(self.0.notes.iter().map(|note| row("note", note.clone())));
        Section::new("What is compared", &[], rows)
    }

    fn level(level: &RankLevel) -> Section {
        let title = format!("Fastest at an error of {:.0e}", level.error);
        let row = |r: &mbs_study::compare::results::Rank| {
            vec![
                r.rank.to_string(),
                r.name.clone(),
                seconds(r.seconds),
                format!("{:.0} %", 100.0 * r.noise),
                r.method.clone(),
            ]
        };
        let mut ranks: Vec<_> = level.ranks.iter().collect();
        ranks.sort_by(|a, b| a.rank.cmp(&b.rank).then(a.seconds.total_cmp(&b.seconds)));
        let mut rows: Vec<Vec<String>> = ranks.into_iter().map(row).collect();
        rows.extend(
            level
                .not_reached
                .iter()
                .map(|name| vec!["-".to_owned(), name.clone(), "not reached".to_owned()]),
        );
        let caption = match &level.note {
            Some(note) => format!("Not ranked: {note}."),
            None => format!(
                "Equal ranks: no more than {} times the fastest of the rank, or no more than the noise.",
                level.apart
            ),
        };
        let head = ["rank", "formulation, integrator", "CPU time", "noise", "by"];
        Section { caption, ..Section::new(&title, &head, rows) }
    }

    pub(super) fn by_method(&self) -> Section {
        let levels = self.0.ranking.iter().map(|level| format!("{:.0e}", level.error));
        let row = |m: &MethodRuns| {
            let count = |status| m.runs.iter().filter(|r| r.status == status).count().to_string();
            let fit = m.fit.clone().unwrap_or_default();
            let order =
                fit.order.map_or("-".to_owned(), |p| format!("{p:.2} ({} runs)", fit.points));
            let rounding = fit.rounding_below.map_or("-".to_owned(), |h| format!("{} s", short(h)));
            let mut row = vec![m.name.clone()];
            row.extend([Status::Completed, Status::Failed, Status::NotRun].map(count));
            row.extend([order, rounding]);
            row.extend(m.at_error.iter().map(|t| t.map_or("-".to_owned(), seconds)));
            row
        };
        let head = ["method", "completed", "failed", "not run", "order", "rounding below"];
        let rows = self.0.methods.iter().map(row).collect();
        let mut section = Section::new("Methods", &head, rows);
        section.head.extend(levels);
        section.caption = "Order: slope of the error against the mean step, over the runs on one line. Last columns: CPU time at that error."
            .to_owned();
        section
    }

    /// Returns the table of failures with their reasons. Failures of a method with the same reason are in one row.
    pub(super) fn failures(&self) -> Option<Section> {
        let mut rows: Vec<Vec<String>> = Vec::new();
        for method in &self.0.methods {
            let mut reasons: Vec<(String, Vec<String>)> = Vec::new();
            for run in method.runs.iter().filter(|run| run.status == Status::Failed) {
                let (code, text) = reason(run);
                match reasons.iter_mut().find(|(of, _)| *of == code) {
                    Some((_, settings)) => settings.push(text),
                    None => reasons.push((code, vec![text])),
                }
            }
            for (code, texts) in reasons {
                let more = texts.len().saturating_sub(MOST_SETTINGS);
                let mut listed = texts[..texts.len().min(MOST_SETTINGS)].join("; ");
                if more > 0 {
                    listed += &format!("; and {more} more");
                }
                rows.push(vec![method.name.clone(), code, listed]);
            }
        }
        let head = ["method", "reason", "step or tolerance: where it stopped"];
        (!rows.is_empty()).then(|| Section::new("Failures", &head, rows))
    }

    /// Returns the table of the methods that `auto` chooses.
    pub(super) fn choices(&self) -> Option<Section> {
        let time = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), seconds);
        let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1e}"));
        let row = |c: &mbs_study::compare::results::JudgedChoice| {
            vec![
                format!("{:.0e}", c.error),
                format!("{}, {}", c.method, short(c.setting)),
                number(c.true_error),
                time(c.cpu_seconds),
                time(c.best_seconds),
                c.best_method.clone().unwrap_or_default(),
                c.over_best.map_or_else(|| "-".to_owned(), |x| format!("{x:.2}")),
                time(Some(c.pilot_seconds)),
                c.stopped.join("; "),
            ]
        };
        let head = [
            "required error",
            "chosen, step or tolerance",
            "its error",
            "CPU time",
            "the best",
            "which is",
            "over the best",
            "pilot",
            "stopped before",
        ];
        let rows: Vec<_> = self.0.choices.iter().map(row).collect();
        (!rows.is_empty()).then(|| Section::new("Choice by measurement", &head, rows))
    }

    pub(super) fn all_runs(&self) -> Section {
        let head = [
            "method",
            "step or tolerance",
            "error",
            "rms",
            "CPU time",
            "steps",
            "iterations a step",
            "p50",
            "p99",
            "slowest step",
        ];
        let mut rows = Vec::new();
        for method in &self.0.methods {
            rows.extend(method.runs.iter().map(|run| run_row(method, run)));
        }
        Section { is_detail: true, ..Section::new("All runs", &head, rows) }
    }
}

fn run_row(method: &MethodRuns, run: &RunEntry) -> Vec<String> {
    let mut row = vec![method.name.clone(), short(run.setting)];
    match run.status {
        Status::NotRun => row.push(format!("not run: {}", run.not_run.clone().unwrap_or_default())),
        Status::Failed => row.push(reason(run).0),
        Status::Completed => {
            let mark = if run.is_below_reference { " *" } else { "" };
            let number = |x: Option<f64>| x.map_or("-".to_owned(), |x| format!("{x:.2e}"));
            row.push(number(run.error) + mark);
            row.push(number(run.error_rms));
            row.push(run.cpu_least.map_or("-".to_owned(), seconds));
            row.push(run.steps.to_string());
            row.push(format!("{:.2}", per_step(run)));
            let times = run.step_times.clone().unwrap_or_default();
            row.extend([times.p50, times.p99, times.max].map(seconds));
        }
    }
    row
}

#[allow(clippy::cast_precision_loss, reason = "a mean for reading")]
pub(super) fn per_step(run: &RunEntry) -> f64 {
    run.iterations as f64 / run.steps.max(1) as f64
}

/// Returns the code of a failure, with its joint or body and its time.
pub(super) fn reason(run: &RunEntry) -> (String, String) {
    let Some(e) = &run.failure else { return ("failed".to_owned(), short(run.setting)) };
    let owner = e.joint.as_ref().map(|j| format!(" at joint `{j}`"));
    let owner =
        owner.or_else(|| e.body.as_ref().map(|b| format!(" at body `{b}`"))).unwrap_or_default();
    let place =
        format!("{} from t = {} s{owner}", short(run.setting), significant(rounded(e.time, 4)));
    (format!("{}: {}", e.code, e.message), place)
}

/// Returns a number as text with three digits.
pub(super) fn short(x: f64) -> String {
    significant(rounded(x, 3))
}

/// Formats a time in a suitable unit.
pub(super) fn seconds(t: f64) -> String {
    let (size, unit) = match t {
        t if t >= 1.0 => (t, "s"),
        t if t >= 1e-3 => (t * 1e3, "ms"),
        t if t >= 1e-6 => (t * 1e6, "us"),
        t => (t * 1e9, "ns"),
    };
    format!("{} {unit}", significant(rounded(size, 3)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_a_unit_that_suits_them() {
        let texts = [2.5, 0.012_345, 3.0e-6, 4.2e-8].map(seconds);
        assert_eq!(texts, ["2.5 s", "12.3 ms", "3 us", "42 ns"]);
    }
}
