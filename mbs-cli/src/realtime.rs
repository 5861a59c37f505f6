//! Command `mbs run SCENE --realtime`: options of a paced run.

use crate::refusal::Refusal;
use clap::Args;
use mbs::folder::{Part, WriteError};
use mbs::realtime::{Degrade, OVERRUNS, Overrun, Pacing, Recovery};
use mbs::record::{RunSummary, write_overruns};

/// Options of a paced run.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Run at the pace of the clock, one period after the other; see docs/REALTIME.md.
    #[arg(long)]
    pub(crate) realtime: bool,
    /// With --realtime: length of a period [s]. Default: the step.
    ///
    /// It is cut into equal steps that are not longer than the step.
    #[arg(long, value_name = "P", allow_hyphen_values = true, requires = "realtime")]
    period: Option<f64>,
    /// With --realtime: policy for a late period, finish, hold or degrade. Default: finish.
    ///
    /// finish: the next period begins at once, and the delay is made up.
    ///
    /// hold: the outputs wait for the next boundary, and the delay stays.
    ///
    /// degrade: as finish, and the next periods run at a lower level.
    #[arg(long, value_name = "POLICY", value_parser = policy, requires = "realtime")]
    overrun: Option<Overrun>,
    /// With --overrun degrade: effects to leave out, one more at each level; `steps` doubles the step. Default: measured, smallest change of the outputs first.
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "overrun")]
    degrade: Option<Vec<String>>,
    /// With --overrun degrade: periods in time, with 30 % to spare, before one level is restored. Default: 500.
    #[arg(long, value_name = "N", requires = "overrun")]
    quiet: Option<u32>,
    /// With --realtime: busy waiting before each period [s]; earlier the thread sleeps. Default: 1e-4.
    #[arg(long, value_name = "S", allow_hyphen_values = true, requires = "realtime")]
    awake: Option<f64>,
}

impl Arguments {
    /// Returns the requested pacing; `None` if the run is not paced. Otherwise the refusal.
    pub(crate) fn pacing(&self) -> Result<Option<Pacing>, Refusal> {
        let other = Pacing::default();
        let is_laddered = self.degrade.is_some() || self.quiet.is_some();
        if is_laddered && self.overrun != Some(Overrun::Degrade) {
            return Err(Refusal::new(
                "pacing-refused",
                "--degrade and --quiet are for --overrun degrade",
                "leave them out, or write --overrun degrade",
            ));
        }
        Ok(self.realtime.then(|| Pacing {
            period: self.period,
            overrun: self.overrun.unwrap_or(other.overrun),
            degrade: self.degrade.clone().map_or(other.degrade, Degrade::Listed),
            awake: self.awake.unwrap_or(other.awake),
            quiet: Recovery { tasks: self.quiet.unwrap_or(other.quiet.tasks), ..other.quiet },
        }))
    }

    /// The given options, for the page.
    pub(crate) fn options(&self) -> [(&'static str, Option<String>); 6] {
        let policy = self.overrun.and_then(|overrun| {
            OVERRUNS.iter().find(|(_, other)| *other == overrun).map(|(name, _)| (*name).to_owned())
        });
        [
            ("realtime", self.realtime.then(String::new)),
            ("period", self.period.map(|x| x.to_string())),
            ("overrun", policy),
            ("degrade", self.degrade.as_ref().map(|list| list.join(","))),
            ("quiet", self.quiet.map(|n| n.to_string())),
            ("awake", self.awake.map(|x| x.to_string())),
        ]
    }
}

/// Reads `finish`, `hold` or `degrade`.
fn policy(text: &str) -> Result<Overrun, String> {
    let found = OVERRUNS.iter().find(|(name, _)| *name == text).map(|(_, overrun)| *overrun);
    found.ok_or_else(|| "write finish, hold or degrade".to_owned())
}

/// Writes realtime.csv of a paced run.
pub(crate) fn write(part: &mut Part<'_>, summary: &RunSummary) -> Result<(), WriteError> {
    let Some(realtime) = &summary.realtime else { return Ok(()) };
    part.table("realtime.csv", |sink| write_overruns(sink, realtime))
}
