//! Command `mbs compare SCENE`: CPU time and true error of methods over a range of steps.

use crate::bar::{bar, ticks};
use crate::plot::{is_picture, work_precision};
use crate::refusal::Refusal;
use crate::say::{say, warn};
use crate::scene::SceneArgument;
use crate::status::STOPPED;
use crate::{files, input, signals};
use clap::Args;
use indicatif::ProgressBar;
use mbs::folder::{Folder, WriteError, id};
use mbs::{FORMULATIONS, FormulationKind, PRECISIONS, Precision};
use mbs_report::comparison_page;
use mbs_study::compare::results::{Comparison, Status, write_comparison};
use mbs_study::compare::{CompareError, Earlier, JournalError, Request, Watch, compare};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Number of timings of each run with `--quick` [-]. Chosen, not tuned.
const QUICK_REPEATS: u32 = 2;
/// CPU time of all runs together with `--quick` [s].
const QUICK_BUDGET: f64 = 5.0;

/// Arguments of `mbs compare`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(crate) scene: SceneArgument,
    /// Formulations, such as index-3,recursive. Default: all.
    #[arg(long, value_name = "F,..", value_delimiter = ',')]
    formulation: Vec<String>,
    /// Precisions: f64, f32, dd (32 digits, the slowest). Default: f64,f32.
    #[arg(long, value_name = "P,..", value_delimiter = ',')]
    precision: Vec<String>,
    /// Steps [s]. Default: from 10 times the scene's step down to 1/32 of it, within the budget.
    #[arg(long, value_name = "H,..", value_delimiter = ',', allow_hyphen_values = true)]
    steps: Vec<f64>,
    /// Tolerances of controlled steps. Default: from 1e-3 to 1e-10, within the budget.
    #[arg(long, value_name = "E,..", value_delimiter = ',', allow_hyphen_values = true)]
    tolerances: Vec<f64>,
    /// Errors at which methods are ranked, relative to each output's range. Default: 1e-2,1e-4,1e-6.
    #[arg(long, value_name = "E,..", value_delimiter = ',', allow_hyphen_values = true)]
    error: Vec<f64>,
    /// Duration [s]. Default: the scene's.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    duration: Option<f64>,
    /// A first look in seconds: f64, runs of 5 s together, two timings of each, no maps.
    #[arg(long, conflicts_with_all = ["repeats", "budget", "no_maps"])]
    quick: bool,
    /// Least number of timings of each run; more where they differ.
    #[arg(long, value_name = "N", default_value_t = Request::default().repeats)]
    repeats: u32,
    /// Largest CPU time of a run [s].
    #[arg(long, value_name = "S", default_value_t = Request::default().time_limit, allow_hyphen_values = true)]
    time_limit: f64,
    /// CPU time of all runs together [s], approximately. It limits how far default steps are refined.
    #[arg(long, value_name = "S", default_value_t = Request::default().budget, allow_hyphen_values = true)]
    budget: f64,
    /// Reference table with the columns of run.csv. Default: references/NAME.csv beside the scene NAME.toml, else runs that are not under test.
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Leave out the convergence maps over step and penalty.
    #[arg(long)]
    no_maps: bool,
    /// Also choose by measurement at each error, as `mbs run --error` does, and compare the choice with the best method.
    #[arg(long)]
    choice: bool,
    /// Directory for compare.csv, compare.json, compare.html and the journal of finished runs; created if missing. Default: no files.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Picture of the work-precision diagram (.svg, .pdf). Default: none.
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
    /// Resume: keep the runs that an earlier start left in the directory.
    #[arg(long, requires = "out", conflicts_with = "restart")]
    resume: bool,
    /// Discard the runs that an earlier start left in the directory.
    #[arg(long, requires = "out")]
    restart: bool,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn request(&self) -> Result<Request, Refusal> {
        let plain = Request::default();
        // the first of FORMULATIONS is `auto`, which is not compared
        let formulation =
            |name: &String| named("formulation", name, &FORMULATIONS[1..], &FormulationKind::ALL);
        let precision = |name: &String| named("precision", name, &PRECISIONS, &Precision::ALL);
        let given = self.precision.iter().map(precision).collect::<Result<_, _>>()?;
        let precisions = match self.quick {
            true if self.precision.is_empty() => vec![Precision::F64],
            _ => given,
        };
        Ok(Request {
            formulations: self.formulation.iter().map(formulation).collect::<Result<_, _>>()?,
            precisions,
            steps: self.steps.clone(),
            tolerances: self.tolerances.clone(),
            errors: if self.error.is_empty() { plain.errors.clone() } else { self.error.clone() },
            duration: self.duration,
            repeats: if self.quick { QUICK_REPEATS } else { self.repeats },
            time_limit: self.time_limit,
            budget: if self.quick { QUICK_BUDGET } else { self.budget },
            maps: !(self.no_maps || self.quick),
            choices: self.choice,
            ..plain
        })
    }

    /// Precisions that the comparison needs; none if its arguments will be refused.
    pub(crate) fn precisions(&self) -> Vec<Precision> {
        let has_table = self.table().is_ok_and(|table| table.is_some());
        self.request().map_or(Vec::new(), |request| request.needed_precisions(has_table))
    }

    /// Returns the name and the text of the reference table: the given one, or the one beside the scene.
    fn table(&self) -> Result<Option<(String, String)>, Refusal> {
        let name = self.scene.with_extension("csv");
        let folder = self.scene.parent().unwrap_or(Path::new("")).join("references");
        let beside = folder.join(name.file_name().unwrap_or_default());
        let path = match &self.reference {
            Some(path) => path.clone(),
            None if beside.is_file() => beside,
            None => return Ok(None),
        };
        let text = String::from_utf8(input::read(&path, "CSV file")?).map_err(|_| {
            let message = format!("cannot read `{}`: it is not UTF-8 text", path.display());
            Refusal::new("file-unreadable", message, "give a CSV file")
        })?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Some((name, text)))
    }

    fn earlier(&self) -> Earlier {
        match (self.resume, self.restart) {
            (true, _) => Earlier::Resume,
            (_, true) => Earlier::Restart,
            _ => Earlier::Refuse,
        }
    }

    /// The command line that repeats the comparison.
    fn command(&self) -> String {
        let plain = Request::default();
        let join =
            |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let list = |numbers: &[f64]| (!numbers.is_empty()).then(|| join(numbers));
        let words = |words: &[String]| (!words.is_empty()).then(|| words.join(","));
        let unusual = |x: f64, usual: f64| (x.total_cmp(&usual).is_ne()).then(|| x.to_string());
        let options = [
            ("formulation", words(&self.formulation)),
            ("precision", words(&self.precision)),
            ("steps", list(&self.steps)),
            ("tolerances", list(&self.tolerances)),
            ("error", list(&self.error)),
            ("duration", self.duration.map(|x| x.to_string())),
            ("repeats", (self.repeats != plain.repeats).then(|| self.repeats.to_string())),
            ("time-limit", unusual(self.time_limit, plain.time_limit)),
            ("budget", unusual(self.budget, plain.budget)),
            ("reference", self.reference.as_ref().map(|path| path.display().to_string())),
        ];
        let scene = self.scene.line();
        let command = files::command_line(&format!("compare {scene}"), &options);
        let switches = [(self.no_maps, " --no-maps"), (self.choice, " --choice")];
        switches.into_iter().filter(|(is, _)| *is).fold(command, |text, (_, switch)| text + switch)
    }
}

fn named<U: Copy>(
    key: &str,
    name: &str,
    names: &[&'static str],
    values: &[U],
) -> Result<U, Refusal> {
    let place = names.iter().position(|n| *n == name);
    place.and_then(|i| values.get(i).copied()).ok_or_else(|| {
        let hint = mbs::scene_file::nearest_name(name, names, "built are");
        Refusal::new("settings-refused", format!("unknown {key} `{name}`"), hint)
    })
}

/// Runs the command `mbs compare`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match run(arguments) {
        Ok((comparison, written)) => write_results(&comparison, written, arguments),
        Err(refusal) => refusal.report(),
    }
}

/// Files of a comparison.
const FILES: [&str; 4] = ["compare.csv", "compare.json", "compare.html", "compare.journal"];

/// Makes the comparison of the arguments. Returns it with the folder for its results and their id.
fn run(arguments: &Arguments) -> Result<(Comparison, Option<(Folder, String)>), Refusal> {
    let request = Request { interrupt: signals::heeded(), ..arguments.request()? };
    if let Some(path) = arguments.figure.as_ref().filter(|path| !is_picture(ending(path))) {
        let message = format!("`{}` is no name of a picture", path.display());
        return Err(Refusal::new("usage", message, "give a file that ends with .svg or .pdf"));
    }
    let document = arguments.scene.document()?;
    let table = arguments.table()?;
    let folder = arguments.out.as_ref().map(|out| files::folder(out, &FILES)).transpose()?;
    let mut bar = Bar::new(arguments.json);
    let table = table.as_ref().map(|(name, text)| (name.as_str(), text.as_str()));
    let place = (arguments.out.as_deref(), arguments.earlier());
    let comparison = compare(&document, &request, table, place, &mut bar);
    bar.bar.finish_and_clear();
    let mut comparison = comparison.map_err(|error| refusal(&error, folder.is_some()))?;
    let written =
        folder.map(|folder| (folder, id(&[&document.whole_text(), &arguments.command()])));
    let origin = &mut comparison.provenance;
    origin.command = arguments.command();
    origin.version = format!("mbs {}", env!("CARGO_PKG_VERSION"));
    origin.commit = commit();
    origin.build = build();
    origin.cpu = files::processor();
    Ok((comparison, written))
}

/// The refusal of a comparison, or the message of an interrupted one. With a directory, finished runs are in the journal.
fn refusal(error: &CompareError, has_journal: bool) -> Refusal {
    let hint = error.hint();
    match error {
        CompareError::Read(read) => Refusal::scene(read),
        CompareError::Journal(JournalError::Interrupted) => {
            let hint = match has_journal {
                true => "the runs that were finished are kept: continue with --resume",
                false => "with --out DIR finished runs are kept, and --resume continues from them",
            };
            Refusal::interrupted(error, hint)
        }
        CompareError::Journal(JournalError::Io(_)) => {
            Refusal::new("out-unwritable", error, hint).stopped()
        }
        CompareError::Journal(_) => Refusal::new("journal-refused", error, hint),
        CompareError::Unfinished => Refusal::new("run-unfinished", error, hint),
        CompareError::Table(_) => Refusal::new("table-refused", error, hint),
        CompareError::NoReference(_) => Refusal::new("no-reference", error, hint),
        _ => Refusal::new("settings-refused", error, hint),
    }
}

/// The extension of a file's name.
fn ending(path: &Path) -> &str {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default()
}

/// The commit, from the environment variable at build time or at run time.
fn commit() -> String {
    let built = option_env!("MBS_COMMIT").map(str::to_owned);
    built.or_else(|| std::env::var("MBS_COMMIT").ok()).unwrap_or_default()
}

/// Profile and vector instructions of this build.
fn build() -> String {
    let profile = if cfg!(debug_assertions) { "with debug assertions" } else { "release" };
    let wide = match (cfg!(target_feature = "avx512f"), cfg!(target_feature = "avx2")) {
        (true, _) => "AVX-512",
        (_, true) => "AVX2",
        _ => "no wider vectors than the target's baseline",
    };
    format!("{profile}; {}; {wide}", std::env::consts::ARCH)
}

/// Writes the files, then prints JSON or tables. A run that stops is a result. The exit status is that of a stopped run if no run was
/// completed.
fn write_results(
    comparison: &Comparison,
    written: Option<(Folder, String)>,
    arguments: &Arguments,
) -> ExitCode {
    let mut runs = comparison.methods.iter().flat_map(|method| &method.runs);
    let is_any = runs.any(|run| run.status == Status::Completed);
    let mut status = if is_any { ExitCode::SUCCESS } else { ExitCode::from(STOPPED) };
    let (object, mut wrote) = (comparison.to_json(), String::new());
    if let Some(path) = &arguments.figure {
        let drawn = work_precision(comparison, ending(path));
        match drawn.and_then(|bytes| files::write(path, &bytes, None)) {
            Ok(()) => wrote += &format!("\nwrote {}\n", path.display()),
            Err(refusal) => {
                refusal.warn();
                status = ExitCode::from(STOPPED);
            }
        }
    }
    if let Some((folder, id)) = &written {
        let written = write_files((comparison, &object), folder, id);
        if Refusal::unless_lost(written, &mut status).is_some() {
            let out = folder.path().display();
            wrote += &format!("\nwrote compare.csv, compare.json and compare.html to {out}\n");
        }
    }
    let text = if arguments.json {
        object
    } else {
        mbs_report::compare::report(comparison).text() + &wrote
    };
    say(&text, status)
}

fn write_files(
    (comparison, object): (&Comparison, &str),
    folder: &Folder,
    id: &str,
) -> Result<String, WriteError> {
    let mut part = folder.begin(id)?;
    part.table("compare.csv", |sink| write_comparison(sink, comparison))?;
    part.page("compare.html", &comparison_page(comparison))?;
    part.finish("compare.json", object)
}

/// A progress bar on a terminal. Without a terminal only the plan is printed, and with JSON nothing.
struct Bar {
    bar: ProgressBar,
    is_quiet: bool,
}

/// Number of steps of the progress bar.
const TICKS: u64 = 1000;

impl Bar {
    fn new(is_quiet: bool) -> Self {
        Self { bar: bar(TICKS, is_quiet, "{wide_bar} {percent:>3} %  {msg}"), is_quiet }
    }
}

impl Watch for Bar {
    fn plan(&mut self, text: &str) {
        if !self.is_quiet {
            self.bar.suspend(|| warn(text));
        }
    }

    fn doing(&mut self, share: f64, doing: &str) {
        self.bar.set_position(ticks(share, TICKS));
        self.bar.set_message(doing.to_owned());
    }
}
