//! A whole run: from a scene to its summary, rows and page.

use crate::channels::Channels;
use crate::figure::Figure;
use crate::recorder::{Recorder, StepMark};
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::stop::{Names, StopError};
use crate::tree::{InSpace, Plane};
use crate::words::{notes, stop_text, summary_rows};
use core::time::Duration;
use cpu_time::ProcessTime;
use mbs_core::Real;
use mbs_core::outputs::{self, Contacts};
use mbs_core::scene::{EffectKind, Scene};
use mbs_core::step::StepReport;
use mbs_scene::{Channel, Contact, CsvWriter, Outputs, Provenance, RunRecord, RunSummary};
use std::io;
use std::time::Instant;

/// Share of the energy turned over that the invariant may be off by.
const ENERGY_ALARM: f64 = 0.1;
/// Steps in a row, or less at the end of a run, that it may be off by more: the first steps from rest turn little over, and
/// their error may be large beside that and small beside what follows.
const PATIENCE: u32 = 10;

/// Called now and then with the time reached; does nothing by default.
pub trait Progress {
    /// Time reached [s].
    fn reached(&mut self, t: f64) {
        let _ = t;
    }
}

impl Progress for () {}

/// What a run gives.
#[derive(Debug)]
pub struct Outcome {
    /// The JSON object.
    pub summary: RunSummary,
    /// Why it stopped early.
    pub error: Option<StopError>,
    record: RunRecord,
    channels: Vec<Channel>,
    table: Vec<(f64, Vec<f64>)>,
}

impl Outcome {
    /// Writes the rows as CSV.
    ///
    /// # Errors
    /// Those of the sink.
    pub fn write_csv(&self, sink: impl io::Write) -> io::Result<()> {
        let mut csv = CsvWriter::new(sink, &self.channels)?;
        for (t, row) in &self.table {
            csv.row(*t, row)?;
        }
        csv.finish()
    }

    /// The page, with how the run was made.
    #[must_use]
    pub fn page(&self, provenance: Provenance) -> String {
        let record = RunRecord { provenance, ..self.record.clone() };
        mbs_scene::page(&record)
    }

    /// The rows: time and all components of all channels.
    #[must_use]
    pub fn rows(&self) -> &[(f64, Vec<f64>)] {
        &self.table
    }

    /// What the user should know.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.record.notes
    }
}

/// Runs a checked scene to its end, or to where it stops.
pub fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
    progress: &mut impl Progress,
) -> Outcome
where
    Plane<D>: InSpace<T>,
{
    let names = Names::new(scene);
    let channels = Channel::of_scene(scene);
    let started = Simulation::<T, D>::new(scene, settings);
    let started = started.and_then(|simulation| {
        let measures = Channels::new(scene, simulation.model())?;
        let contacts = Contacts::new(scene, simulation.model());
        Ok((simulation, measures, contacts.map_err(|e| StopError::Start(e.into()))?))
    });
    let (simulation, measures, contacts) = match started {
        Ok(both) => both,
        Err(error) => return not_started(scene, settings, &channels, &names, error),
    };
    let n_steps = settings.n_steps();
    let recorder = Recorder::new(channels, n_steps, simulation.initial_energies());
    let weight = weight(scene) * simulation.model().length().to_f64();
    let figure = Figure::new(scene, simulation.model(), recorder.n_rows(n_steps));
    let mut run = Run {
        scene,
        settings,
        simulation,
        measures,
        contacts,
        recorder,
        figure,
        values: Vec::new(),
        counts: Counts::default(),
        weight,
        reached: 0.0,
        off: 0,
    };
    run.start();
    let cpu = ProcessTime::now();
    let error = run.steps(n_steps, progress).err();
    let cpu = cpu.elapsed();
    run.finish(cpu, error, &names)
}

#[derive(Debug, Default)]
struct Counts {
    steps: u64,
    iterations: u64,
    factorizations: u64,
    worst: Duration,
}

struct Run<'a, T: Real, const D: usize>
where
    Plane<D>: InSpace<T>,
{
    scene: &'a Scene<T>,
    settings: &'a Settings,
    simulation: Simulation<T, D>,
    measures: Channels<T, D>,
    contacts: Contacts<T, D>,
    recorder: Recorder,
    figure: Figure<T, D>,
    values: Vec<f64>,
    counts: Counts,
    /// Weight of all bodies times the scene's length [J].
    weight: f64,
    /// Time reached [s].
    reached: f64,
    /// Steps in a row after which the invariant was off.
    off: u32,
}

impl<T: Real, const D: usize> Run<'_, T, D>
where
    Plane<D>: InSpace<T>,
{
    /// The first row.
    fn start(&mut self) {
        let n = self.recorder.channels.iter().map(|c| c.components.len()).sum();
        self.values = vec![0.0; n];
        let violation = self.simulation.start.residual.map(Real::to_f64);
        let energies = self.simulation.initial_energies();
        let mark = StepMark { t: 0.0, energies, violation, iterations: 0 };
        self.recorder.mark(&mark);
        self.contacts.start(self.simulation.state());
        self.row(&mark, false);
    }

    fn row(&mut self, mark: &StepMark, is_last: bool) {
        let state = self.simulation.state();
        self.measures.write(state, &mut self.values);
        self.figure.offer(mark.t, &state.q, is_last);
        self.recorder.keep(mark, &self.values);
    }

    fn steps(&mut self, n_steps: u64, progress: &mut impl Progress) -> Result<(), StopError> {
        let (h, end) = (self.settings.step_max, self.settings.duration);
        let mut clock = Instant::now();
        for k in 1..=n_steps {
            #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
            let (from, to) = ((k - 1) as f64 * h, if k == n_steps { end } else { k as f64 * h });
            let is_full = k < n_steps || (to - from - h).abs() <= 1e-9 * h * k as f64;
            let dt = if is_full { h } else { to - from };
            let report = match self.simulation.step(T::from_f64(dt)) {
                Ok(report) => report,
                Err(error) => {
                    let stop = self.simulation.explain(error);
                    return self.stop(stop);
                }
            };
            self.simulation.set_time(T::from_f64(to));
            let mark = self.take(to, &report);
            if self.recorder.keeps(k) || k == n_steps {
                self.row(&mark, k == n_steps);
                progress.reached(to);
            }
            let now = Instant::now();
            self.counts.worst = self.counts.worst.max(now - clock);
            clock = now;
            if let Some(stop) = self.alarm(&mark, k == n_steps) {
                return self.stop(stop);
            }
        }
        Ok(())
    }

    /// Keeps the state at which the run stops.
    fn stop(&mut self, stop: StopError) -> Result<(), StopError> {
        let t = self.reached;
        if self.recorder.times.last().is_none_or(|&last| last < t) {
            let energies = self.simulation.energies();
            let mark = StepMark { t, energies, violation: [0.0; 3], iterations: 0 };
            self.row(&mark, true);
        }
        Err(stop)
    }

    /// Counts and maxima of a step.
    fn take(&mut self, t: f64, report: &StepReport<T>) -> StepMark {
        self.counts.steps += u64::from(report.steps);
        self.reached = t;
        self.counts.iterations += u64::from(report.iterations);
        self.counts.factorizations += u64::from(report.factorizations);
        self.measures.track(self.simulation.state());
        self.contacts.watch(self.simulation.state());
        let mark = StepMark {
            t,
            energies: self.simulation.energies(),
            violation: report.violation.map(Real::to_f64),
            iterations: report.iterations,
        };
        self.recorder.mark(&mark);
        mark
    }

    /// Has the invariant drifted too far? Nothing is said while what was turned over is rounding of what is stored.
    fn alarm(&mut self, mark: &StepMark, is_last: bool) -> Option<StopError> {
        let (turned_over, error) = self.recorder.turnover();
        let stored = mark.energies[1].abs() + mark.energies[0];
        let rounding = stored.max(self.weight) * T::EPSILON.to_f64().sqrt();
        let is_off = !(error <= ENERGY_ALARM * turned_over) && !(error <= rounding);
        self.off = if is_off { self.off + 1 } else { 0 };
        let is_stop = self.off >= PATIENCE || (is_off && is_last) || !error.is_finite();
        is_stop.then(|| StopError::Energy {
            error,
            turned_over,
            owner: self.simulation.most_loaded(),
        })
    }

    fn finish(self, cpu: Duration, error: Option<StopError>, names: &Names) -> Outcome {
        let end_time = self.reached;
        let cpu_seconds = cpu.as_secs_f64();
        let [coordinates, constraints, constraint_rank] = self.simulation.sizes();
        let settings = self.settings;
        let summary = RunSummary {
            steps: self.counts.steps,
            completed: error.is_none(),
            error: error.as_ref().map(|e| e.report(end_time, names)),
            end_time,
            cpu_seconds,
            real_time_factor: if cpu_seconds > 0.0 { end_time / cpu_seconds } else { 0.0 },
            worst_step_seconds: self.counts.worst.as_secs_f64(),
            iterations: self.counts.iterations,
            factorizations: self.counts.factorizations,
            energy: self.recorder.energy_summary(),
            violation: self.recorder.violation_summary(),
            outputs: Outputs(self.recorder.last()),
            coordinates,
            constraints,
            constraint_rank,
            dof: coordinates - constraint_rank,
            not_unique: self.measures.not_unique(self.scene),
            contacts: self.contacts.instants().iter().map(|i| contact(self.scene, i)).collect(),
            contacts_left_out: self.contacts.left_out(),
            ..plain_summary(self.scene, settings)
        };
        let (energy, violation, iterations) = self.recorder.page_series();
        let record = RunRecord {
            scene: self.scene.name.clone(),
            channels: self.recorder.series(),
            animation: Some(self.figure.animation),
            energy: Some(energy),
            violation: Some(violation),
            iterations: Some(iterations),
            summary: summary_rows(&summary),
            notes: notes(self.scene, settings, &summary, self.simulation.start.change.to_f64()),
            error: summary.error.as_ref().map(stop_text),
            ..RunRecord::default()
        };
        let table = self.recorder.table().map(|(t, row)| (t, row.to_vec())).collect();
        Outcome { summary, error, record, channels: self.recorder.channels.clone(), table }
    }
}

/// An instant with the effect's name.
fn contact<T: Real>(scene: &Scene<T>, instant: &outputs::Instant) -> Contact {
    let effect = &scene.effects[instant.effect];
    let is_limit = matches!(effect.kind, EffectKind::Limit { .. });
    Contact {
        time: instant.t,
        effect: effect.name.clone(),
        end: is_limit.then_some(["lower", "upper"][instant.end]),
        event: if instant.makes { "made" } else { "broken" },
    }
}

/// Weight of all bodies [N].
fn weight<T: Real>(scene: &Scene<T>) -> f64 {
    let mass: f64 = scene.bodies.iter().map(|body| body.mass.to_f64()).sum();
    let squares = scene.gravity.map_or(0.0, |g| g.iter().map(|x| x.to_f64() * x.to_f64()).sum());
    mass * f64::sqrt(squares)
}

fn plain_summary<T: Real>(scene: &Scene<T>, settings: &Settings) -> RunSummary {
    RunSummary {
        scene: scene.name.clone(),
        formulation: settings.asked.clone(),
        precision: settings.precision.name().to_owned(),
        dimension: scene.dimension.count(),
        step: settings.step,
        chosen: settings.chosen(),
        ..RunSummary::default()
    }
}

fn not_started<T: Real>(
    scene: &Scene<T>,
    settings: &Settings,
    channels: &[Channel],
    names: &Names,
    error: StopError,
) -> Outcome {
    let summary =
        RunSummary { error: Some(error.report(0.0, names)), ..plain_summary(scene, settings) };
    let record = RunRecord {
        scene: scene.name.clone(),
        summary: summary_rows(&summary),
        error: summary.error.as_ref().map(stop_text),
        ..RunRecord::default()
    };
    Outcome { summary, error: Some(error), record, channels: channels.to_vec(), table: Vec::new() }
}
