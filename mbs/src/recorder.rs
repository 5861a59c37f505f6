//! What is kept of a run: rows of channels, energies, violations and counts, thinned to a bounded number; maxima over every
//! step.

use mbs_scene::{
    Channel, ChannelSeries, EnergySeries, EnergySummary, IterationSeries, ViolationSeries,
    ViolationSummary,
};

/// Rows kept at most (and one more for the end).
pub(crate) const MOST_ROWS: u64 = 10_000;

/// What one step left behind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepMark {
    pub(crate) t: f64,
    /// Kinetic energy, potential energy, work.
    pub(crate) energies: [f64; 3],
    pub(crate) violation: [f64; 3],
    pub(crate) iterations: u32,
}

/// Series and maxima of a run.
#[derive(Debug)]
pub(crate) struct Recorder {
    pub(crate) channels: Vec<Channel>,
    /// Row times and all components, row by row.
    pub(crate) times: Vec<f64>,
    pub(crate) rows: Vec<f64>,
    n_columns: usize,
    every: u64,
    initial: f64,
    energy: EnergySeries,
    violation: ViolationSeries,
    iterations: IterationSeries,
    max_error: f64,
    last_error: f64,
    max_violation: [f64; 3],
    /// Largest values since the last row, so that thinning hides no peak.
    recent: [f64; 3],
    recent_iterations: u32,
    max_kinetic: f64,
    gross_work: f64,
    last_work: f64,
}

impl Recorder {
    /// For a run of `n_steps`, starting from the given energies.
    pub(crate) fn new(channels: Vec<Channel>, n_steps: u64, energies: [f64; 3]) -> Self {
        let n_columns = channels.iter().map(|c| c.components.len()).sum();
        Self {
            channels,
            times: Vec::new(),
            rows: Vec::new(),
            n_columns,
            every: n_steps.div_ceil(MOST_ROWS).max(1),
            initial: energies[0] + energies[1],
            energy: EnergySeries::default(),
            violation: ViolationSeries::default(),
            iterations: IterationSeries::default(),
            max_error: 0.0,
            last_error: 0.0,
            max_violation: [0.0; 3],
            recent: [0.0; 3],
            recent_iterations: 0,
            max_kinetic: energies[0],
            gross_work: 0.0,
            last_work: 0.0,
        }
    }

    /// How many rows a full run will have.
    pub(crate) fn n_rows(&self, n_steps: u64) -> usize {
        usize::try_from(n_steps / self.every).unwrap_or(usize::MAX).saturating_add(2)
    }

    /// Is step `k` (0: the start) kept as a row?
    pub(crate) fn keeps(&self, k: u64) -> bool {
        k.is_multiple_of(self.every)
    }

    /// Takes the maxima of a step.
    pub(crate) fn mark(&mut self, step: &StepMark) {
        let [kinetic, potential, work] = step.energies;
        self.last_error = (kinetic + potential - work - self.initial).abs();
        if !(self.last_error <= self.max_error) {
            self.max_error = self.last_error;
        }
        for (i, &v) in step.violation.iter().enumerate() {
            self.max_violation[i] = self.max_violation[i].max(v);
            self.recent[i] = self.recent[i].max(v);
        }
        self.recent_iterations = self.recent_iterations.max(step.iterations);
        self.max_kinetic = self.max_kinetic.max(kinetic);
        self.gross_work += (work - self.last_work).abs();
        self.last_work = work;
    }

    /// The energy turned over so far, and the present error of the invariant [J].
    pub(crate) fn turnover(&self) -> (f64, f64) {
        (self.max_kinetic + self.gross_work, self.last_error)
    }

    /// Keeps a row; `values` are all components of all channels.
    pub(crate) fn keep(&mut self, step: &StepMark, values: &[f64]) {
        let [kinetic, potential, work] = step.energies;
        self.times.push(step.t);
        self.rows.extend_from_slice(values);
        self.energy.times.push(step.t);
        self.energy.kinetic.push(kinetic);
        self.energy.potential.push(potential);
        self.energy.invariant_error.push(kinetic + potential - work - self.initial);
        self.violation.times.push(step.t);
        self.violation.position.push(self.recent[0]);
        self.violation.velocity.push(self.recent[1]);
        self.violation.acceleration.push(self.recent[2]);
        if step.iterations > 0 {
            self.iterations.times.push(step.t);
            self.iterations.counts.push(self.recent_iterations);
        }
        self.recent = [0.0; 3];
        self.recent_iterations = 0;
    }

    pub(crate) fn energy_summary(&self) -> EnergySummary {
        EnergySummary {
            initial: self.initial,
            max_error: self.max_error,
            final_error: self.last_error,
            turned_over: self.turnover().0,
        }
    }

    pub(crate) fn violation_summary(&self) -> ViolationSummary {
        let [position, velocity, acceleration] = self.max_violation;
        ViolationSummary { position, velocity, acceleration }
    }

    /// The last row by channels.
    pub(crate) fn last(&self) -> Vec<(String, Vec<f64>)> {
        let start = self.rows.len().saturating_sub(self.n_columns);
        let mut row = self.rows[start..].iter().copied();
        let channels = self.channels.iter();
        channels
            .map(|c| (c.name.clone(), row.by_ref().take(c.components.len()).collect()))
            .collect()
    }

    /// All rows as time and components.
    pub(crate) fn table(&self) -> impl Iterator<Item = (f64, &[f64])> {
        let n = self.n_columns;
        self.times.iter().enumerate().map(move |(i, &t)| (t, &self.rows[i * n..(i + 1) * n]))
    }

    pub(crate) fn series(&self) -> Vec<ChannelSeries> {
        let mut first = 0;
        let of_channel = |channel: &Channel| {
            let values = (0..channel.components.len()).map(|c| {
                let column = first + c;
                self.table().map(|(_, row)| row[column]).collect()
            });
            let series = ChannelSeries {
                channel: channel.clone(),
                times: self.times.clone(),
                values: values.collect(),
            };
            first += channel.components.len();
            series
        };
        self.channels.iter().map(of_channel).collect()
    }

    pub(crate) fn page_series(&self) -> (EnergySeries, ViolationSeries, IterationSeries) {
        (self.energy.clone(), self.violation.clone(), self.iterations.clone())
    }
}
