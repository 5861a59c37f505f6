//! Comparison of methods by their cost and error on one scene, against a reference that is not under test. It takes every formulation,
//! integrator, control and precision over a range of steps or tolerances.
//!
//! Runs are recorded first, with their errors, then timed interleaved. Which runs are made follows from counts, not from a clock, so
//! that two comparisons make the same ones. Each result is in the journal before the next run begins.

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

/// Request of a comparison. Empty lists mean all there are, or the usual ones.
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
    /// Length of the runs [s]; left out, the scene's.
    pub duration: Option<f64>,
    /// Least number of timings of each run. `≥ 2`.
    pub repeats: u32,
    /// CPU time of a run at most [s].
    pub time_limit: f64,
    /// Work of all runs together, roughly [s]; it decides how far steps are refined where none are given.
    pub budget: f64,
    /// Are the convergence maps wanted?
    pub maps: bool,
    /// Is the choice by measurement to be made at each error, and compared with all methods?
    pub choices: bool,
    /// Interrupt that ends the comparison from outside.
    pub interrupt: Interrupt,
}

/// Ratio of the budget of all runs to that of the convergence maps [-]. Chosen, not tuned.
const MAP_BUDGETS: f64 = 10.0;
/// Place of the convergence maps in the progress bar [-].
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
    /// Precisions that the comparison runs in: those of its methods, and pairs of doubles where runs are the reference.
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

/// A comparison that cannot be made.
#[derive(Debug)]
#[non_exhaustive]
pub enum CompareError {
    /// The scene is refused, with its place in the file, or cannot be had in one of the precisions.
    Read(PrecisionError),
    /// The journal cannot be used.
    Journal(JournalError),
    /// The directory has runs of an earlier start, which must not be lost.
    Unfinished,
    /// The reference table cannot be used.
    Table(TableError),
    /// No method that could serve as a reference runs the scene to its end; why the last one stopped.
    NoReference(String),
    /// A number that must be positive and finite.
    NotPositive(&'static str),
    /// A step that is longer than the run: both [s].
    StepTooLong(f64, f64),
    /// Runs are to be timed this often, which says nothing of how far times differ.
    Repeats(u32),
}

/// Called as results come; does nothing by default.
pub trait Watch {
    /// Called once, before the first run, with what will be done.
    fn plan(&mut self, text: &str) {
        let _ = text;
    }

    /// This fraction of the work is done, from 0 to 1; `doing` says what is next.
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
    /// The scene's own step [s].
    of_scene: f64,
    duration: f64,
    instants: Instants,
    /// Work of one run at most, where settings are not given [s, nominal].
    most_work: f64,
}

/// Compares the methods on a scene. Runs are kept in the journal of `out`; without a directory they are lost with the process.
/// `table` is the name and text of a reference table.
///
/// Provenance is left to the caller, but for the hash of the scene.
///
/// # Errors
/// A scene, table or journal that cannot be used; a scene without a reference. Runs that fail are results.
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
        // nothing is ranked by a table that no method comes near
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

/// Reads the text of a reference table for a scene, at the instants of a comparison as usual.
///
/// # Errors
/// [`TableError`] where it cannot be used.
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
        // a recorded run, the repeats, and about as many where the ranking is decided; the settings before the last take about as
        // much as it does
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

    /// Returns in words what the comparison is going to do.
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

    /// Coordinates and constraints in natural coordinates, roughly: before a model is built.
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
