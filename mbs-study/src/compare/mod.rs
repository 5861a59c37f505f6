//! Comparison of methods by their cost and error on one scene, against a reference by a method that is not compared. It covers every
//! formulation, integrator, step control and precision over a range of steps or tolerances.
//!
//! Runs are recorded first, with their errors, then timed interleaved. Counts decide which runs are made, not a clock, so that two
//! comparisons make the same runs. Each result is written to the journal before the next run begins.

pub(crate) mod clocked;
pub(crate) mod course;
mod judged;
pub(crate) mod ladder;
pub(crate) mod layout;
pub(crate) mod map;
pub(crate) mod method;
mod pass;
pub(crate) mod reference;
pub mod results;
pub(crate) mod rounds;
pub(crate) mod runs;
pub(crate) mod store;
pub(crate) mod table;
mod truth;

pub use crate::journal::JournalError;
pub use store::Earlier;
pub use table::TableError;

use crate::compare::results::{Comparison, ConvergenceMap};
use crate::journal::{Head, Kind, hash};
use core::fmt::{self, Display, Formatter};
use ladder::Instants;
use mbs::inside::{DEFAULT_STEP, is_too_long, not_built_hint, too_long};
use mbs::record::Channel;
use mbs::{FormulationKind, Interrupt, Precision, PrecisionError};
use mbs_core::cluster::scene_length;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;
use mbs_scene::format::significant;
use method::MethodCase;
use pass::Scenes;
use reference::Known;
use std::path::Path;
use store::ResultStore;

/// Request of a comparison. An empty list means all elements, or the usual ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Formulations to compare.
    pub formulations: Vec<FormulationKind>,
    /// Precisions to compare.
    pub precisions: Vec<Precision>,
    /// Lengths of the steps [s].
    pub steps: Vec<f64>,
    /// Tolerances of controlled steps.
    pub tolerances: Vec<f64>,
    /// Errors at which methods are ranked.
    pub errors: Vec<f64>,
    /// Length of the runs [s]. Default: the scene's duration.
    pub duration: Option<f64>,
    /// Smallest number of timings of each run, at least 2.
    pub repeats: u32,
    /// Largest CPU time of a run [s].
    pub time_limit: f64,
    /// Estimated work of all runs together [s]. Without given steps it limits how short steps become.
    pub budget: f64,
    /// True if convergence maps are part of the comparison.
    pub maps: bool,
    /// True if the choice by measurement is made at each error and compared with all methods.
    pub choices: bool,
    /// Interrupt by which the caller ends the comparison.
    pub interrupt: Interrupt,
}

/// Ratio of the budget of all runs to that of the convergence maps [-]. Chosen, not tuned.
const MAP_BUDGETS: f64 = 10.0;
/// Position of the convergence maps in the progress bar, as a fraction of it [-].
const MAPS_DONE: f64 = 0.95;

impl Default for Request {
    fn default() -> Self {
        Self {
            formulations: Vec::new(),
            precisions: Vec::new(),
            steps: Vec::new(),
            tolerances: Vec::new(),
            errors: vec![1e-2, 1e-4, 1e-6],
            duration: None,
            repeats: 5,
            time_limit: 30.0,
            budget: 200.0,
            maps: true,
            choices: false,
            interrupt: Interrupt::default(),
        }
    }
}

impl Request {
    /// Precisions that the comparison needs: those of its methods and that of the reference. Reference runs are in double-double unless a
    /// table is the reference.
    #[must_use]
    pub fn needed_precisions(&self, has_table: bool) -> Vec<Precision> {
        let mut needed: Vec<_> = MethodCase::all(&self.formulations, &self.precisions)
            .iter()
            .map(|method| method.precision)
            .chain([if has_table { Precision::F64 } else { Precision::DoubleDouble }])
            .collect();
        needed.sort_unstable();
        needed.dedup();
        needed
    }
}

/// Reason why a comparison cannot be made.
#[derive(Debug)]
#[non_exhaustive]
pub enum CompareError {
    /// Scene that is refused, with the place in its file, or that cannot be read in one of the precisions.
    Read(PrecisionError),
    /// Journal that cannot be used.
    Journal(JournalError),
    /// Directory with runs of an earlier comparison, which must not be lost.
    Unfinished,
    /// Reference table that cannot be used.
    Table(TableError),
    /// No reference method runs the scene to its end. The text says why the last one stopped.
    NoReference(String),
    /// Number that is not positive and finite, by its name.
    NotPositive(&'static str),
    /// Step that is longer than the run: step and duration [s].
    StepTooLong(f64, f64),
    /// Number of timings that is too small to show how far times differ.
    Repeats(u32),
}

/// Observer of the progress of a comparison; its functions do nothing by default.
pub trait Watch {
    /// Receives a description of the planned work once, before the first run.
    fn plan(&mut self, text: &str) {
        let _ = text;
    }

    /// Receives the fraction of the work that is done, from 0 to 1, and the next job in `doing`.
    fn doing(&mut self, share: f64, doing: &str) {
        let _ = (share, doing);
    }
}

impl Watch for () {}

const KIND: Kind = Kind {
    file: "compare.journal",
    title: "mbs compare journal",
    of: ["a comparison", "another comparison"],
    hashes: &["the scene", "an option", "the reference table"],
};

/// Parts of a comparison: scenes, request, methods and their settings.
struct Study<'a> {
    scenes: &'a Scenes,
    request: &'a Request,
    channels: Vec<Channel>,
    methods: Vec<MethodCase>,
    steps: Vec<f64>,
    tolerances: Vec<f64>,
    /// Step of the scene [s].
    of_scene: f64,
    duration: f64,
    instants: Instants,
    /// Largest nominal time of one run if settings are not given [s].
    most_work: f64,
}

/// Compares the methods on a scene. Runs are stored in the journal of the directory `out`; without a directory they are lost when the process
/// ends. `table` is the name and text of a reference table.
///
/// The caller sets the provenance of the results, except the hash of the scene.
///
/// # Errors
/// A scene, table or journal that cannot be used, or a scene without a reference. Runs that fail are results, not errors.
pub fn compare(
    document: &SceneFile,
    request: &Request,
    table: Option<(&str, &str)>,
    (out, earlier): (Option<&Path>, Earlier),
    watch: &mut impl Watch,
) -> Result<Comparison, CompareError> {
    check(request)?;
    let precisions = request.needed_precisions(table.is_some());
    let mut scenes = Scenes::new(document, &precisions).map_err(CompareError::Read)?;
    scenes.interrupt = request.interrupt.clone();
    let options = format!("{request:?}");
    let head =
        Head::new(KIND, &[&document.whole_text(), &options, table.map_or("", |(_, text)| text)]);
    let mut store = ResultStore::open(out, &head, earlier)?.ok_or(CompareError::Unfinished)?;
    store.interrupt = request.interrupt.clone();
    let study = Study::new(&scenes, request);
    let longest = request.steps.iter().copied().fold(0.0, f64::max);
    if is_too_long(longest, study.duration) {
        return Err(CompareError::StepTooLong(longest, study.duration));
    }
    watch.plan(&study.plan(store.resumed));
    watch.doing(0.0, "reference");
    let known = study.known(table, &mut store)?;
    let scene = &scenes.double;
    let mut comparison = Comparison {
        scene: scene.name.clone(),
        duration: study.duration,
        compared: study.instants.time(known.rows.len()),
        instants: known.rows.len(),
        interval: study.instants.interval,
        repeats: request.repeats,
        outputs: known.scales.clone(),
        reference: known.report.clone(),
        notes: known.notes.clone(),
        ..Comparison::default()
    };
    comparison.provenance.scene_hash = hash(&document.whole_text());
    if known.is_refuted {
        // methods are not ranked by a table that independent formulations refute
        comparison.digest(&[]);
        return Ok(comparison);
    }
    let plan = study.map_plan(&known);
    comparison.methods = study.runs(&known, &mut store, watch)?;
    study.time(&mut comparison, &known, &mut store, watch)?;
    study.choices((&mut comparison, &known), &mut store, watch)?;
    comparison.maps = study.maps(&plan, &known, &mut store, watch)?;
    comparison.digest(&request.errors);
    Ok(comparison)
}

/// Checks the text of a reference table for a scene, at the default instants of a comparison.
///
/// # Errors
/// [`TableError`] if the table cannot be used.
pub fn check_table(scene: &Scene<f64>, text: &str) -> Result<(), TableError> {
    let of_scene = scene.solver.step.unwrap_or(DEFAULT_STEP).min(scene.duration);
    let steps = ladder::steps(&[], of_scene, scene.duration);
    let instants = Instants::new(scene.duration, &steps);
    table::read(text, &Channel::of_scene(scene), (&instants, scene.duration)).map(drop)
}

fn check(request: &Request) -> Result<(), CompareError> {
    let single = [request.time_limit, request.budget, request.duration.unwrap_or(1.0)];
    let lists = [
        ("steps", &request.steps[..]),
        ("tolerances", &request.tolerances),
        ("error", &request.errors),
        ("time-limit, budget and duration", &single),
    ];
    let bad = |numbers: &[f64]| numbers.iter().any(|x| !(*x > 0.0 && x.is_finite()));
    match lists.into_iter().find(|(_, numbers)| bad(numbers)) {
        Some((name, _)) => Err(CompareError::NotPositive(name)),
        None if request.repeats < 2 => Err(CompareError::Repeats(request.repeats)),
        None => Ok(()),
    }
}

impl<'a> Study<'a> {
    fn new(scenes: &'a Scenes, request: &'a Request) -> Self {
        let scene = &scenes.double;
        let duration = request.duration.unwrap_or(scene.duration);
        let of_scene = scene.solver.step.unwrap_or(DEFAULT_STEP).min(duration);
        let methods = MethodCase::all(&request.formulations, &request.precisions);
        let steps = ladder::steps(&request.steps, of_scene, duration);
        let instants = Instants::new(duration, &steps);
        // each run is recorded once, timed `repeats` times, and about as often again if it decides the ranking; all coarser settings of a
        // method take about as much as its last one
        let passes = 2.0 * f64::from(request.repeats) + 1.0;
        let most_work = request.budget / (methods.len().max(1) as f64 * passes * 2.0);
        Self {
            channels: Channel::of_scene(scene),
            tolerances: ladder::tolerances(&request.tolerances),
            scenes,
            request,
            methods,
            steps,
            of_scene,
            duration,
            instants,
            most_work,
        }
    }

    /// Describes in words the runs of the comparison.
    fn plan(&self, resumed: usize) -> String {
        let list = |numbers: &[f64]| {
            let ends = [numbers.first(), numbers.last()].map(|x| x.copied().unwrap_or_default());
            ends.map(significant).join(" to ")
        };
        let mut text = format!(
            "{} methods, steps {} s, tolerances {}, each run timed {} times or more; work for about {:.0} s, runs of at most {:.2} s \
             (nominal) each: what would take longer is listed as not run",
            self.methods.len(),
            list(&self.steps),
            list(&self.tolerances),
            self.request.repeats,
            self.request.budget,
            self.most_work
        );
        if resumed > 0 {
            text += &format!("; {resumed} results of an earlier start are taken over");
        }
        text
    }

    /// Estimated number of coordinates and constraints in natural coordinates, before a model is built.
    fn unknowns(&self) -> usize {
        let of_body = if self.scenes.double.dimension.count() == 2 { 6 } else { 24 };
        of_body * self.scenes.double.bodies.len()
    }

    fn length(&self) -> f64 {
        scene_length(&self.scenes.double)
    }

    fn map_plan(&self, known: &Known) -> Option<map::MapPlan> {
        let has_map = |f: &FormulationKind| f.scene_penalty().is_some() && !f.row().energy_rule;
        let augmented: Vec<FormulationKind> = FormulationKind::listed()
            .filter(|f| has_map(f) && self.methods.iter().any(|m| m.formulation == *f))
            .collect();
        if !self.request.maps || augmented.is_empty() || known.rows.iter().any(Option::is_none) {
            return None;
        }
        let precisions = method::PRECISIONS.into_iter();
        let precisions =
            precisions.filter(|p| self.methods.iter().any(|m| m.precision == *p)).collect();
        let instants = Instants { count: known.rows.len(), ..self.instants };
        let budget = (self.unknowns(), self.request.budget / MAP_BUDGETS);
        let plan = map::MapPlan::new((instants, self.of_scene), (augmented, precisions), budget);
        (!plan.between.is_empty()).then_some(plan)
    }

    fn maps(
        &self,
        plan: &Option<map::MapPlan>,
        known: &Known,
        store: &mut ResultStore,
        watch: &mut impl Watch,
    ) -> Result<Vec<ConvergenceMap>, CompareError> {
        let Some(plan) = plan else { return Ok(Vec::new()) };
        let mut maps = Vec::new();
        for which in plan.which() {
            watch.doing(MAPS_DONE, "convergence maps");
            let map = plan.map(which, |between, penalty| {
                let (formulation, precision) = (which.0.name(), which.1.name());
                let key = format!("map {formulation} {precision} {penalty:e} {between}");
                let (most, at) = (self.request.time_limit, (between, penalty));
                store.get(&key, || plan.cell(self.scenes, known, which, at, most))
            })?;
            maps.push(map);
        }
        Ok(maps)
    }
}

impl CompareError {
    /// Returns a hint at what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Read(PrecisionError::NotBuilt(precision)) => not_built_hint(*precision),
            Self::Read(_) => String::new(),
            Self::Journal(error) => error.hint().to_owned(),
            Self::Unfinished => {
                "continue from them with --resume, throw them away with --restart, or give another directory with --out"
                    .to_owned()
            }
            Self::Table(error) => error.hint(),
            Self::StepTooLong(_, duration) => {
                format!("write steps of {} s at most, or a longer duration", significant(*duration))
            }
            Self::NoReference(_) => {
                "give a table with --reference, a shorter --duration, or a longer --time-limit".to_owned()
            }
            Self::NotPositive(_) => "write numbers larger than zero".to_owned(),
            Self::Repeats(_) => "write --repeats 2 or more".to_owned(),
        }
    }
}

impl Display for CompareError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "{error}"),
            Self::Journal(error) => write!(f, "{error}"),
            Self::Unfinished => write!(f, "the directory has runs of an earlier start"),
            Self::Table(error) => write!(f, "{error}"),
            Self::NoReference(why) => write!(
                f,
                "no method that is accurate enough for a reference runs the scene to its end; the last one: {why}"
            ),
            Self::NotPositive(name) => write!(f, "{name} must be positive and finite"),
            Self::StepTooLong(step, duration) => f.write_str(&too_long(*step, *duration)),
            Self::Repeats(n) => {
                write!(f, "each run must be timed twice at least, but repeats are {n}")
            }
        }
    }
}

impl core::error::Error for CompareError {}

impl From<JournalError> for CompareError {
    fn from(error: JournalError) -> Self {
        Self::Journal(error)
    }
}
