//! Verdicts counted by property, family, method and step.

use serde_json::Value;
use std::collections::BTreeMap;

/// Counts of a method's verdicts.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Tally {
    /// Runs with constant energy and an error like that of the trapezoidal rule.
    pub(super) right: usize,
    /// Runs with an error like that of the trapezoidal rule, where the rule itself has a large error at the step.
    pub(super) coarse: usize,
    /// Runs with a larger error, which decreases with the square of the step.
    pub(super) apart: usize,
    /// Completed runs without a reference.
    pub(super) unjudged: usize,
    pub(super) wrong: usize,
    /// Runs that stopped with a typed error, by its code.
    pub(super) stopped: BTreeMap<String, usize>,
    /// Numbers of runs and of typed errors by step, in 1e-9 s.
    pub(super) steps: BTreeMap<u64, [usize; 2]>,
}

/// A run with a wrong result, and the reason.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wrong {
    pub(super) family: String,
    pub(super) seed: u64,
    pub(super) method: String,
    pub(super) step: f64,
    pub(super) why: String,
}

/// Tallies of all families, with wrong runs and faults.
#[derive(Debug, Default)]
pub(super) struct Tallies {
    /// Methods in the order of the columns.
    pub(super) methods: Vec<String>,
    /// Rows of the table: property, family, and a tally for each method.
    pub(super) families: Vec<(String, String, Vec<Tally>)>,
    pub(super) wrong: Vec<Wrong>,
    /// Cases that ended their process.
    pub(super) faults: Vec<String>,
    pub(super) cases: usize,
}

impl Tally {
    /// Adds a verdict on a run with a step [s].
    fn take(&mut self, verdict: &Value, step: f64) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "steps of 1e-9 to 1 s"
        )]
        let by_step = self.steps.entry((step * 1e9).round() as u64).or_default();
        by_step[0] += 1;
        match verdict["is"].as_str() {
            Some("right" | "kept") => self.right += 1,
            Some("coarse") => self.coarse += 1,
            Some("apart") => self.apart += 1,
            Some("unjudged") => self.unjudged += 1,
            Some("stopped") => {
                by_step[1] += 1;
                let code = verdict["code"].as_str().unwrap_or("?");
                *self.stopped.entry(code.to_owned()).or_default() += 1;
            }
            _ => self.wrong += 1,
        }
    }

    /// Adds the counts of another tally.
    pub(super) fn add(&mut self, other: &Self) {
        self.right += other.right;
        self.coarse += other.coarse;
        self.apart += other.apart;
        self.unjudged += other.unjudged;
        self.wrong += other.wrong;
        for (code, n) in &other.stopped {
            *self.stopped.entry(code.clone()).or_default() += n;
        }
        for (step, [runs, stops]) in &other.steps {
            let mine = self.steps.entry(*step).or_default();
            *mine = [mine[0] + runs, mine[1] + stops];
        }
    }

    /// Number of all runs.
    pub(super) fn runs(&self) -> usize {
        self.right + self.coarse + self.apart + self.unjudged + self.wrong + self.stops()
    }

    /// Number of runs with a typed error.
    pub(super) fn stops(&self) -> usize {
        self.stopped.values().sum()
    }

    /// The largest step up to which no run stopped [s]; `None` if some stopped at the smallest step.
    pub(super) fn largest_step(&self) -> Option<f64> {
        let sound = self.steps.iter().take_while(|(_, [_, stops])| *stops == 0).last();
        #[allow(clippy::cast_precision_loss, reason = "up to 1e9")]
        sound.map(|(step, _)| *step as f64 / 1e9)
    }

    /// Writes a cell: pass, the largest step, the fraction of typed errors with their most frequent code, wrong results.
    pub(super) fn cell(&self) -> String {
        if self.runs() == 0 {
            return String::new();
        }
        if self.wrong > 0 {
            return format!("{} WRONG of {}", self.wrong, self.runs());
        }
        let most = self.stopped.iter().max_by_key(|(_, n)| **n);
        let Some((code, _)) = most else { return "pass".to_owned() };
        #[allow(clippy::cast_precision_loss, reason = "some thousands")]
        let share = 100.0 * self.stops() as f64 / self.runs() as f64;
        let share = if share < 1.0 { "< 1".to_owned() } else { format!("{share:.0}") };
        match self.largest_step() {
            Some(step) => format!("to {step:e} s; {share} % stop: {code}"),
            None if self.stops() == self.runs() => format!("all stop: {code}"),
            None => format!("{share} % stop: {code}"),
        }
    }
}

impl Tallies {
    /// Counts the lines of all workers.
    pub(super) fn of(lines: &[Value]) -> Self {
        let mut all = Self::default();
        for line in lines {
            all.cases += 1;
            if let Some(fault) = line["fault"].as_str() {
                all.faults.push(format!("case {}: {fault}", line["number"]));
                continue;
            }
            if let (true, Some(methods)) = (all.methods.is_empty(), line["methods"].as_array()) {
                let names = methods.iter().filter_map(Value::as_str);
                all.methods = names.map(str::to_owned).collect();
            }
            all.take(line);
        }
        all.wrong.sort_by(|a, b| (&a.family, a.seed).cmp(&(&b.family, b.seed)));
        all
    }

    fn take(&mut self, line: &Value) {
        let text = |key: &str| line[key].as_str().unwrap_or_default().to_owned();
        let (property, family) = (text("property"), text("family"));
        let step = line["step"].as_f64().unwrap_or(0.0);
        let at = self.families.iter().position(|(_, name, _)| *name == family);
        let at = at.unwrap_or_else(|| {
            let tallies = vec![Tally::default(); self.methods.len()];
            self.families.push((property, family.clone(), tallies));
            self.families.len() - 1
        });
        for (tally, method) in self.families[at].2.iter_mut().zip(&self.methods) {
            let verdict = &line["verdicts"][method];
            tally.take(verdict, step);
            if let Some(why) = verdict["why"].as_str() {
                self.wrong.push(Wrong {
                    family: family.clone(),
                    seed: line["seed"].as_u64().unwrap_or(0),
                    method: method.to_owned(),
                    step,
                    why: why.to_owned(),
                });
            }
        }
    }

    /// Tallies by property, in the order of the families.
    pub(super) fn properties(&self) -> Vec<(String, Vec<Tally>)> {
        let mut rows: Vec<(String, Vec<Tally>)> = Vec::new();
        for (property, _, tallies) in &self.families {
            match rows.iter_mut().find(|(name, _)| name == property) {
                Some((_, sums)) => sums.iter_mut().zip(tallies).for_each(|(sum, t)| sum.add(t)),
                None => rows.push((property.clone(), tallies.clone())),
            }
        }
        rows
    }

    /// Sums the tallies of all families and methods.
    pub(super) fn sum(&self) -> Tally {
        let mut sum = Tally::default();
        self.families.iter().flat_map(|(_, _, tallies)| tallies).for_each(|tally| sum.add(tally));
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_cell_says_pass_the_largest_step_the_error_or_what_is_wrong() {
        let mut tally = Tally::default();
        assert_eq!(tally.cell(), "");
        let right = json!({ "is": "right", "error": 1e-4 });
        let stopped = json!({ "is": "stopped", "code": "rank-lost", "time": 0.5 });
        for step in [1e-4, 1e-3, 1e-2] {
            tally.take(&right, step);
        }
        assert_eq!(tally.cell(), "pass");
        tally.take(&stopped, 1e-2);
        assert_eq!(tally.cell(), "to 1e-3 s; 25 % stop: rank-lost");
        tally.take(&stopped, 1e-4);
        assert_eq!(tally.cell(), "40 % stop: rank-lost");
        tally.take(&json!({ "is": "wrong", "why": "a panic" }), 1e-4);
        assert_eq!(tally.cell(), "1 WRONG of 6");
    }

    #[test]
    fn families_of_a_property_are_added_and_faults_are_kept() {
        let methods = ["index-3", "classical"];
        let line = |family: &str, seed: u64| {
            let all: serde_json::Map<_, _> =
                methods.map(|m| (m.to_owned(), json!({ "is": "right" }))).into_iter().collect();
            json!({ "family": family, "property": "p", "seed": seed, "step": 1e-3, "methods": methods, "verdicts": all })
        };
        let fault = json!({ "number": 9, "fault": "index-3 hung for 1 s" });
        let all = Tallies::of(&[line("a", 0), line("b", 0), line("a", 1), fault]);
        assert_eq!((all.cases, all.families.len(), all.properties().len()), (4, 2, 1));
        assert_eq!(all.properties()[0].1[0].right, 3);
        assert_eq!(all.faults, ["case 9: index-3 hung for 1 s"]);
        assert_eq!(all.sum().runs(), 3 * methods.len());
    }
}
