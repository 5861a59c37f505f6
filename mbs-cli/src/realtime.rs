//! `mbs run SCENE --realtime`.

use crate::refusal::Refusal;
use clap::Args;
use mbs::core::scene::Scene;
use mbs::folder::{Part, WriteError};
use mbs::realtime::{
    Degrade, OVERRUNS, Overrun, Pacing, PacingError, Recovery, SystemClock, run_document,
};
use mbs::scene_file::{RunSummary, SceneFile, write_overruns};
use mbs::{Outcome, Settings};

/// Options of a paced run.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// At the pace of the clock, one period after the other; docs/REALTIME.md says more.
    #[arg(long)]
    pub(crate) realtime: bool,
    /// With --realtime: time between two boundaries [s]; else the step. It is cut into equal steps that are not longer than the step.
    #[arg(long, value_name = "P", allow_hyphen_values = true, requires = "realtime")]
    period: Option<f64>,
    /// With --realtime, of a late period: finish (the next begins at once, the delay is caught up), hold (its outputs wait for the
    /// next boundary, the delay stays), degrade (finish, and go on with less); else finish.
    #[arg(long, value_name = "POLICY", value_parser = policy, requires = "realtime")]
    overrun: Option<Overrun>,
    /// With --overrun degrade: names of effects, or `steps`, each one more level that leaves it out too; `steps` makes steps twice as
    /// long. Left out: by measurement, what changes the outputs least first.
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "overrun")]
    degrade: Option<Vec<String>>,
    /// With --overrun degrade: periods in time, with three tenths to spare, before a level is taken back; else 500.
    #[arg(long, value_name = "N", requires = "overrun")]
    quiet: Option<u32>,
    /// With --realtime: waits awake for so long before each period, asleep before that [s]; else 1e-4.
    #[arg(long, value_name = "S", allow_hyphen_values = true, requires = "realtime")]
    awake: Option<f64>,
}

impl Arguments {
    /// What is asked for; nothing where the run is not paced; else the refusal.
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

    /// The options that were given, for a page.
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

/// `finish`, `hold` or `degrade`.
fn policy(text: &str) -> Result<Overrun, String> {
    let found = OVERRUNS.iter().find(|(name, _)| *name == text).map(|(_, overrun)| *overrun);
    found.ok_or_else(|| "write finish, hold or degrade".to_owned())
}

/// Runs at the pace of the system's clock; else the refusal.
pub(crate) fn run(
    scene: (&SceneFile, &Scene<f64>),
    settings: &Settings,
    pacing: &Pacing,
) -> Result<Outcome, Refusal> {
    let run = run_document(scene, settings, pacing, &mut SystemClock::new());
    run.map_err(|error| match &error {
        PacingError::Read(error) => Refusal::scene(error),
        error => Refusal::new("pacing-refused", error, error.hint()),
    })
}

/// Writes realtime.csv of a paced run.
pub(crate) fn write(part: &mut Part<'_>, summary: &RunSummary) -> Result<(), WriteError> {
    let Some(realtime) = &summary.realtime else { return Ok(()) };
    part.table("realtime.csv", |sink| write_overruns(sink, realtime))
}
