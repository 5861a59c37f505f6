//! Command `mbs sweep SCENE SWEEP`: many runs of a scene with varied numbers, into one table.

use crate::bar::bar;
use crate::diff::label;
use crate::method::{MethodArguments, OfSweep};
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::scene::SceneArgument;
use crate::status::STOPPED;
use crate::{files, input, signals};
use clap::Args;
use indicatif::ProgressBar;
use mbs::scene_file::SceneFile;
use mbs::scene_file::format::counted;
use mbs::{Method, words};
use mbs_report::sweep_page;
use mbs_study::sweep::{
    PartsError, Report, Study, StudyError, SweepError, SweepPart, SweepTask, Watch,
};
use serde_json::json;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `mbs sweep`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) scene: SceneArgument,
    /// Sweep file (TOML): the numbers to vary, and how; docs/SWEEPS.md lists its keys.
    sweep: PathBuf,
    /// Runs at the same time. Default: one for each processor.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Directory for the table and the journal of finished runs. Default: the sweep file's name without its ending, in the current directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write sweep.html too: each result over each parameter, and a table of the members.
    #[arg(long)]
    page: bool,
    /// With --page: members whose outputs are drawn over time, spread over the sweep; they run once more. At most 24. Default: none.
    #[arg(long, value_name = "N", requires = "page", value_parser = clap::value_parser!(u32).range(1..=24))]
    traces: Option<u32>,
    /// Members K, K + N, ... alone; their journal in the directory is for --join. Default: all members.
    #[arg(long, value_name = "K/N", conflicts_with_all = ["page", "join"])]
    part: Option<SweepPart>,
    /// Write the table of the parts that --part left in the directory.
    #[arg(long, conflicts_with_all = ["threads", "restart"])]
    join: bool,
    /// Discard the runs that an earlier start left in the directory.
    #[arg(long)]
    restart: bool,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    pub(crate) method: MethodArguments<OfSweep>,
}

impl Arguments {
    /// Returns the directory of the results: the given one, or one with the name of the sweep file.
    fn out(&self) -> PathBuf {
        let of_sweep = || PathBuf::from(self.sweep.file_stem().unwrap_or("sweep".as_ref()));
        self.out.clone().unwrap_or_else(of_sweep)
    }
}

/// Runs the command `mbs sweep`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match run(arguments) {
        Ok((report, out)) => write_results(&report, &out, arguments),
        Err(refusal) => refusal.report(),
    }
}

fn run(arguments: &Arguments) -> Result<(Report, PathBuf), Refusal> {
    let document = arguments.scene.read()?.document;
    let sweep = input::document(&arguments.sweep, "sweep file", (None, false))?;
    let overrides = Method { interrupt: signals::heeded(), ..arguments.method.given.clone() };
    let study = Study::new(document.clone(), &sweep.into(), &overrides);
    let study = study.map_err(|error| refused(&error, &document))?;
    let out = arguments.out();
    let &Arguments { part, threads, restart: anew, .. } = arguments;
    let files = ["table.csv", "table.parquet", PAGE, "sweep.journal"];
    // parts run in one directory at the same time, each with a journal of its own
    let _folder = part.is_none().then(|| files::folder(&out, &files)).transpose()?;
    let n_members = part.map_or(study.n_members(), |part| part.members(study.n_members()).len());
    let mut bar = Bar::new(n_members, arguments.json);
    let report = match arguments.join {
        true => study.join(&out),
        false => study.run(&SweepTask { out: &out, threads, anew, part }, &mut bar),
    };
    bar.0.finish_and_clear();
    let report = report.map_err(|error| not_run(&error, &out))?;
    if arguments.page {
        write_page(&study, &report, &out, arguments)?;
    }
    Ok((report, out))
}

/// The page of a sweep in its directory.
const PAGE: &str = "sweep.html";

fn write_page(
    study: &Study,
    report: &Report,
    out: &Path,
    arguments: &Arguments,
) -> Result<(), Refusal> {
    let n = study.n_members();
    let wanted = usize::try_from(arguments.traces.unwrap_or(0)).unwrap_or(n).min(n);
    let spread = (0..wanted).map(|i| i * (n - 1) / (wanted - 1).max(1));
    let rows = spread.filter_map(|i| Some((format!("member {}", i + 1), study.member_rows(i)?)));
    let (scene, sweep) = (arguments.scene.display(), arguments.sweep.display());
    let command = format!("mbs sweep {scene} {sweep} --page");
    let title = format!("{}: {} members", label(&arguments.sweep), n);
    let traces: Vec<_> = rows.collect();
    let page = sweep_page((&title, &command), study.columns(), report, &traces);
    files::write(&out.join(PAGE), page.as_bytes(), None).map_err(Refusal::stopped)
}

fn refused(error: &StudyError, scene: &SceneFile) -> Refusal {
    match error {
        StudyError::Read(error) => Refusal::read("sweep-refused", error),
        StudyError::Settings(error) => files::refusal(error, scene),
        other => {
            Refusal::new("sweep-refused", other, "leave the option out, or do not vary the number")
        }
    }
}

fn not_run(error: &SweepError, out: &Path) -> Refusal {
    let place = out.display();
    match error {
        SweepError::Write(error) => Refusal::lost(error),
        SweepError::Parts(error) => {
            let refusal =
                Refusal::new("parts-refused", format!("`{place}`: {error}"), error.hint());
            // finished members are in the journal
            if matches!(error, PartsError::Unfinished(_)) { refusal.stopped() } else { refusal }
        }
        SweepError::Interrupted(_) => {
            Refusal::interrupted(error, "the same command continues with the others")
        }
        SweepError::Journal(error) => {
            Refusal::new("journal-refused", format!("`{place}`: {error}"), error.hint())
        }
        other => Refusal::new("settings-refused", other, "write a smaller number"),
    }
}

/// Prints JSON or text. The exit status says whether all members were completed.
fn write_results(report: &Report, out: &Path, arguments: &Arguments) -> ExitCode {
    let text = match arguments.json {
        true => json(report, arguments),
        false => text(report, out, arguments),
    };
    let is_run = report.resumed < report.members;
    let asked = arguments.threads.filter(|_| is_run).map_or(0, NonZeroUsize::get);
    if let Some(note) = words::few_threads(asked, report.threads) {
        warn(&format!("note: {note}"));
    }
    if let Some(error) = &report.lost {
        Refusal::lost(error).warn();
    }
    let is_whole = report.failures.is_empty() && report.lost.is_none();
    say(&text, if is_whole { ExitCode::SUCCESS } else { ExitCode::from(STOPPED) })
}

fn json(report: &Report, arguments: &Arguments) -> String {
    let failures = report.failures.iter();
    let failed: serde_json::Map<_, _> =
        failures.map(|(code, (count, ..))| (code.clone(), json!(count))).collect();
    let tables: Vec<_> = report.tables.iter().map(|path| path.display().to_string()).collect();
    json!({
        "scene": arguments.scene.display().to_string(),
        "sweep": arguments.sweep.display().to_string(),
        "members": report.members,
        "completed": report.completed,
        "failed": failed,
        "resumed": report.resumed,
        "threads": report.threads,
        "wall_seconds": report.wall_seconds,
        "cpu_seconds": report.cpu_seconds,
        "table": tables.first(),
        "tables": tables,
    })
    .to_string()
}

fn text(report: &Report, out: &Path, arguments: &Arguments) -> String {
    let part = arguments.part.map(|part| format!("part {part}: ")).unwrap_or_default();
    let members = counted(report.members, "member");
    let mut text = format!("{part}{} of {members} completed\n", report.completed);
    if report.resumed > 0 && !arguments.join {
        text += &format!("  {} finished by an earlier start\n", counted(report.resumed, "member"));
    }
    for (code, (count, first, message)) in &report.failures {
        text +=
            &format!("  {} ended in {code}, first {first}: {message}\n", counted(*count, "member"));
    }
    if report.resumed < report.members {
        let (wall, cpu) = (report.wall_seconds, report.cpu_seconds);
        let share = if wall > 0.0 { cpu / wall } else { 0.0 };
        text += &format!(
            "  {} in all, {} of CPU time on {}: {share:.2} at a time\n",
            words::duration(wall),
            words::duration(cpu),
            counted(report.threads, "thread"),
        );
    }
    let tables = report.tables.iter().filter_map(|path| path.file_name()?.to_str());
    let names: Vec<_> = tables.chain(arguments.page.then_some(PAGE)).collect();
    if !names.is_empty() {
        text += &format!("wrote {} to {}\n", names.join(" and "), out.display());
    }
    if arguments.part.is_some() {
        let (scene, sweep) = (arguments.scene.display(), arguments.sweep.display());
        text += &format!(
            "the table of all parts: mbs sweep {scene} {sweep} --join --out {}\n",
            out.display()
        );
    }
    text
}

/// A progress bar on a terminal; hidden without a terminal.
struct Bar(ProgressBar);

impl Bar {
    fn new(members: usize, is_quiet: bool) -> Self {
        Self(bar(members as u64, is_quiet, "{wide_bar} {pos} of {len}{msg}  {eta} left"))
    }
}

impl Watch for Bar {
    fn finished(&mut self, done: usize, failed: usize, _: usize) {
        self.0.set_position(done as u64);
        if failed > 0 {
            self.0.set_message(format!(", {failed} failed"));
        }
    }
}
