//! The machine of the measurements, and its load by other programs.

use serde_json::{Value, json};
use std::thread::available_parallelism;

/// Cores, processor and load of the machine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Machine {
    pub(crate) cores: usize,
    /// The processor's name, if the system reports it.
    pub(crate) processor: String,
    /// Average number of processes that ran or waited during the last minute, before and after the measurements, if the system reports it.
    pub(crate) load: [Option<f64>; 2],
}

/// Load per core above which other programs disturb the measurements [-].
const BUSY: f64 = 0.2;

impl Machine {
    /// The machine with its load before the measurements.
    pub(crate) fn now() -> Self {
        Self { cores: cores(), processor: processor(), load: [load(), None] }
    }

    /// Stores the load after the measurements.
    pub(crate) fn end(&mut self) {
        self.load[1] = load();
    }

    /// True if the machine was busy before the measurements; `None` if its load is unknown.
    pub(crate) fn is_busy(&self) -> Option<bool> {
        #[allow(clippy::cast_precision_loss, reason = "a number of cores")]
        let cores = self.cores as f64;
        self.load[0].map(|load| load > BUSY * cores)
    }

    /// Describes the machine and its load in a sentence.
    pub(crate) fn sentence(&self) -> String {
        let processor =
            if self.processor.is_empty() { "processor not named" } else { &self.processor };
        let busy = match self.is_busy() {
            Some(true) => {
                "it was busy with other work, so that times are upper bounds, and teams waited for cores that others had"
            }
            Some(false) => "it was idle",
            None => "it does not report whether it was busy",
        };
        format!("Measured on {} cores ({processor}), {}: {busy}.", self.cores, self.load_text())
    }

    /// The load before and after.
    pub(crate) fn load_text(&self) -> String {
        let [before, after] = self.load.map(|x| x.map_or("?".to_owned(), |x| format!("{x:.1}")));
        format!("load average {before} before and {after} after")
    }

    pub(crate) fn json(&self) -> Value {
        json!({
            "cores": self.cores, "processor": self.processor, "load_before": self.load[0],
            "load_after": self.load[1], "busy": self.is_busy(),
        })
    }
}

/// Cores that this process may use.
pub(crate) fn cores() -> usize {
    available_parallelism().map_or(1, usize::from)
}

pub(crate) fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find(|line| line.starts_with("model name"));
    line.and_then(|line| line.split_once(':'))
        .map(|(_, name)| name.trim().to_owned())
        .unwrap_or_default()
}

fn load() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/loadavg").ok()?;
    text.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_reports_whether_it_was_busy() {
        let machine = |load| Machine { cores: 2, processor: String::new(), load: [load, None] };
        assert_eq!(
            [Some(3.0), Some(0.1), None].map(|load| machine(load).is_busy()),
            [Some(true), Some(false), None]
        );
        let sentence = machine(Some(3.0)).sentence();
        assert!(
            sentence.contains("2 cores") && sentence.contains("3.0 before and ? after"),
            "{sentence}"
        );
    }
}
