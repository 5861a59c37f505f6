//! Test by random scenes: scenes by seed, run by every formulation with its usual integrator, and their verdicts counted.

use super::{Verdict, Way};
use crate::{random, trial};
use mbs::FormulationKind;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The formulations, each with an integrator. Those that control their steps are last.
pub fn methods() -> Vec<Way> {
    let (steered, fixed): (Vec<_>, Vec<_>) =
        FormulationKind::listed().partition(|f| f.row().energy_rule);
    fixed.into_iter().chain(steered).map(|f| [f.name(), "trapezoidal"]).collect()
}

/// Counted results of random scenes.
#[derive(Debug, Default)]
pub struct Tally {
    /// Number of scenes.
    pub scenes: usize,
    /// Scenes that the judge does not run.
    pub unjudged: usize,
    /// Runs that differ or panic.
    pub differences: usize,
    /// Runs of each formulation by verdict.
    pub verdicts: BTreeMap<(String, String), usize>,
    /// Seeds whose runs stop, by formulation and code. Stops are left out where the formulation does not support the scene's rows.
    pub refused: BTreeMap<(String, String), Vec<u64>>,
    /// Scenes that have each kind of joint, of effect, and so on.
    pub kinds: BTreeMap<String, usize>,
}

impl Tally {
    /// Runs a scene in every formulation, or in one. Returns lines on runs that do not agree.
    pub fn add(&mut self, seed: u64, only: Option<&str>) -> String {
        let mut out = String::new();
        let drawn = random::scene(seed);
        self.scenes += 1;
        for kind in random::kinds(&drawn.text) {
            *self.kinds.entry(kind).or_default() += 1;
        }
        let judged = match trial::judge(&drawn.text, drawn.step, drawn.steps) {
            Ok(judged) => judged,
            Err(why) => {
                self.unjudged += 1;
                let _ = writeln!(out, "{seed:5} {why}");
                return out;
            }
        };
        let product = match trial::product(&drawn.text) {
            Ok(product) => product,
            Err(why) => {
                self.unjudged += 1;
                let _ = writeln!(out, "{seed:5} unread: {why}");
                return out;
            }
        };
        for method in methods() {
            if only.is_some_and(|o| o != method[0]) {
                continue;
            }
            let verdict = trial::trial(&judged, &product, method, drawn.step, drawn.steps);
            let (key, line) = self.judge((seed, &drawn, &judged), method, &verdict);
            out.push_str(&line);
            *self.verdicts.entry((method[0].to_owned(), key)).or_default() += 1;
        }
        out
    }

    /// Returns the key under which a verdict is counted, and its line.
    fn judge(
        &mut self,
        (seed, drawn, judged): (u64, &random::Drawn, &trial::Judged),
        method: Way,
        verdict: &Verdict,
    ) -> (String, String) {
        let (of, pivot) = (format!("{seed:5} {:12}", method[0]), judged.least_pivot);
        match verdict {
            Verdict::Agrees => ("agrees".to_owned(), String::new()),
            Verdict::Differs { channel, off, allowed, size, start } => {
                self.differences += 1;
                let (place, key) = if *start {
                    ("at the start", "differs (start)")
                } else {
                    ("", "differs (run)")
                };
                let line = format!(
                    "{of} DIFFERS  {place} {channel}: off {off:.2e}, allowed {allowed:.2e}, size {size:.2e}; least pivot {pivot:.1e}\n"
                );
                (key.to_owned(), line)
            }
            Verdict::Stops { code, time, message } => {
                let place = if *time > 0.0 { "run" } else { "start" };
                // a refusal is right where rows are redundant, and where state-space coordinates would need rows that constrain rates alone
                let rolls = !judged.mechanism.scene.rollings.is_empty();
                let is_right = (code == "rank-lost" && judged.is_redundant)
                    || (code == "velocity-rows" && rolls && method[0] == "state-space");
                let place = if is_right { "right" } else { place };
                if !is_right {
                    let of = (method[0].to_owned(), code.clone());
                    self.refused.entry(of).or_default().push(seed);
                }
                let end = f64::from(drawn.steps) * drawn.step;
                let line = format!(
                    "{of} stops    {code} at {time:.3e} s of {end:.3e}: {message}; least pivot {pivot:.1e}\n"
                );
                (format!("{code} ({place})"), line)
            }
            Verdict::Panics => {
                self.differences += 1;
                ("panics".to_owned(), format!("{of} PANICS\n"))
            }
        }
    }

    /// The counts as a text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "\n{} scenes, {} without a judgement", self.scenes, self.unjudged);
        for ((method, verdict), n) in &self.verdicts {
            let _ = writeln!(out, "{method:12} {verdict:28} {n}");
        }
        for (kind, n) in &self.kinds {
            #[allow(clippy::cast_precision_loss, reason = "a share to show")]
            let share = 100.0 * *n as f64 / self.scenes as f64;
            let _ = writeln!(out, "{kind:28} in {share:.1} % of the scenes");
        }
        out
    }
}
