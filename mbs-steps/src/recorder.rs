//! Record of a run: rows of channels, energies, violations and counts. The number of rows is bounded. Maxima are computed over all steps.

use crate::checkpoint::tape::{Tape, Walked, holds};
use crate::precision::is_finer;
use crate::record::{
    Channel, ChannelSeries, ChannelSummary, ComponentStatistics, ControlSummary, EnergySeries,
    IterationSeries, StepRow, StepSeries, ViolationSeries, ViolationSummary,
};
use crate::tally::Tallies;
use mbs_core::Real;
use mbs_core::control::Limit;
use mbs_core::real::DoubleDouble;
use mbs_scene::format::full;

/// Largest number of recorded rows, without the row at the end. If the number of steps is unknown at the start, up to twice as many rows
/// are stored. Chosen, not tuned.
pub const MOST_ROWS: u64 = 10_000;

/// Data of one step: time, energies, violations and counts. For several steps that are combined, violations and counts are the largest
/// ones.
#[derive(Debug, Clone, Default)]
pub struct StepMark {
    pub t: f64,
    /// Kinetic energy, potential energy and work [J].
    pub energies: [f64; 3],
    pub violation: [f64; 3],
    pub step: StepRow,
}

impl StepMark {
    /// Returns this mark, combined with the maxima of an earlier mark that became no row.
    fn after(&self, before: &Self) -> Self {
        let violation = core::array::from_fn(|i| self.violation[i].max(before.violation[i]));
        Self { violation, step: self.step.after(&before.step), ..*self }
    }
}

/// Recorder of the series and maxima of a run.
#[derive(Debug)]
pub struct Recorder {
    pub channels: Vec<Channel>,
    /// Marks of the rows, one for each row. The vector `rows` has the components of all channels, row by row.
    marks: Vec<StepMark>,
    rows: Vec<f64>,
    /// Difference between each value and its rounding to `f64`, if the run has more digits than `f64`; else empty.
    rests: Vec<f64>,
    n_columns: usize,
    /// Number of steps per recorded row.
    every: u64,
    initial: f64,
    max_violation: [f64; 3],
    /// Largest values since the last row. They are included in the next row, so that a peak between rows is not lost.
    recent: StepMark,
    keep: RecordRows,
    /// Statistics over every step, independent of the recorded rows.
    tallies: Tallies,
}

/// Choice of the rows of a run that stay in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordRows {
    /// All rows, for files and HTML pages.
    All,
    /// Only the last row, for a study of many runs with one row each.
    Last,
}

impl StepMark {
    /// Writes the mark to a checkpoint, or reads it from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        let Self { t, energies, violation, step } = self;
        tape.float(t)?;
        tape.floats(energies)?;
        tape.floats(violation)?;
        let StepRow { length, index, iterations, rejected, energy_change, .. } = step;
        tape.float(length)?;
        tape.option(index, |tape, index| tape.bytes(core::slice::from_mut(index)))?;
        tape.small(iterations)?;
        tape.small(rejected)?;
        tape.float(energy_change)?;
        tape.float(&mut step.penalty_energy)?;
        tape.option(&mut step.error_estimate, Tape::float)?;
        tape.word_of(&mut step.limit, &Limit::ALL.map(Limit::name))
    }

    /// Smallest number of bytes of a mark in a file. A list is refused if its stated number of marks needs more bytes than the file has.
    const SIZE: usize = 80;
}

impl Recorder {
    /// Writes the record to a checkpoint, or reads it from one. The channels and the choice of rows are not stored.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.list(&mut self.marks, StepMark::SIZE, |tape, mark| mark.walk(tape))?;
        tape.list(&mut self.rows, 8, Tape::float)?;
        tape.list(&mut self.rests, 8, Tape::float)?;
        tape.count(&mut self.every)?;
        tape.float(&mut self.initial)?;
        tape.floats(&mut self.max_violation)?;
        self.recent.walk(tape)?;
        self.tallies.walk(tape)?;
        let (n_marks, n_rows, n_rests) = (self.marks.len(), self.rows.len(), self.rests.len());
        holds(n_marks > 0 && n_marks as u64 <= 2 * MOST_ROWS && self.every > 0)?;
        holds(n_rows == n_marks * self.n_columns && (n_rests == 0 || n_rests == n_rows))
    }

    /// Number of steps per row. It doubles when every second row is removed.
    pub fn thinning(&self) -> u64 {
        self.every
    }

    /// Number of rows so far.
    pub fn n_rows(&self) -> usize {
        self.marks.len()
    }

    /// Creates a recorder for a run of `n_steps` steps (0: unknown). `initial` is the energy invariant at the start [J].
    pub fn new(channels: Vec<Channel>, n_steps: u64, initial: f64, keep: RecordRows) -> Self {
        let n_columns: usize = channels.iter().map(|c| c.components.len()).sum();
        Self {
            tallies: Tallies::new(&channels),
            channels,
            marks: Vec::new(),
            rows: Vec::new(),
            rests: Vec::new(),
            n_columns,
            every: n_steps.div_ceil(MOST_ROWS).max(1),
            initial,
            max_violation: [0.0; 3],
            recent: StepMark::default(),
            keep,
        }
    }

    /// Allocates memory for all rows of a run whose number of steps is known, so that no step allocates.
    pub fn reserve(&mut self, n_steps: u64) {
        let rows = usize::try_from(n_steps.min(MOST_ROWS)).unwrap_or(0) + 3;
        self.marks.reserve(rows);
        self.rows.reserve(rows * self.n_columns);
        self.rests.reserve(rows * self.n_columns);
    }

    /// True if step `k` becomes a row; step 0 is the start.
    pub fn keeps(&self, k: u64) -> bool {
        k.is_multiple_of(self.every)
    }

    /// Updates the maxima with a step.
    pub fn mark(&mut self, step: &StepMark) {
        for (most, &v) in self.max_violation.iter_mut().zip(&step.violation) {
            *most = most.max(v);
        }
        self.recent = step.after(&self.recent);
    }

    /// Sets the time at the end of the last step to `t` [s], because the sum of step lengths has rounding errors.
    pub fn end_at(&mut self, t: f64) {
        self.recent.t = t;
    }

    /// Adds the components of all channels at time `t` [s] to the statistics.
    pub fn measure<T: Real>(&mut self, t: f64, values: &[T]) {
        self.tallies.take(t, values);
    }

    /// Records the row of a step; `values` has the components of all channels.
    pub fn keep<T: Real>(&mut self, step: &StepMark, values: &[T]) {
        // The data of a marked step are already in `recent`. The row at the start and the row at a stop have no marked step.
        let is_marked = self.recent.step.length > 0.0 && self.recent.t >= step.t;
        if self.keep == RecordRows::Last {
            self.marks.clear();
            self.rows.clear();
            self.rests.clear();
        }
        for &value in values {
            let near = value.to_f64();
            self.rows.push(near);
            if is_finer::<T>() {
                self.rests.push((value - T::from_f64(near)).to_f64());
            }
        }
        self.marks.push(if is_marked { self.recent.clone() } else { step.after(&self.recent) });
        self.recent = StepMark::default();
        if self.marks.len() as u64 > 2 * MOST_ROWS {
            self.thin();
        }
    }

    /// Removes every second row, but not the first row.
    fn thin(&mut self) {
        self.every *= 2;
        let n = self.n_columns;
        let kept = (0..self.marks.len()).step_by(2);
        let [rows, rests] = [&self.rows, &self.rests].map(|of| {
            let of_row = |i| of.get(i * n..(i + 1) * n).unwrap_or_default();
            kept.clone().flat_map(of_row).copied().collect()
        });
        let joined = |i: usize| match i {
            0 => self.marks[0].clone(),
            _ => self.marks[i].after(&self.marks[i - 1]),
        };
        let marks = kept.map(joined).collect();
        (self.rows, self.rests, self.marks) = (rows, rests, marks);
    }

    /// Time of the last row.
    pub fn last_time(&self) -> Option<f64> {
        self.marks.last().map(|mark| mark.t)
    }

    pub fn violation_summary(&self) -> ViolationSummary {
        let [position, velocity, acceleration] = self.max_violation;
        ViolationSummary { position, velocity, acceleration }
    }

    /// True if all rows stay in memory.
    pub fn keeps_all(&self) -> bool {
        self.keep == RecordRows::All
    }

    /// Least and greatest value of each component over all steps.
    pub fn ranges(&self) -> Vec<[f64; 2]> {
        self.tallies.ranges()
    }

    /// Components of the last row, as a list of channels with their names.
    pub fn last(&self) -> Vec<(String, Vec<f64>)> {
        let start = self.rows.len().saturating_sub(self.n_columns);
        self.by_channels(self.rows[start..].iter().copied())
    }

    /// Components of the last row with all digits, for runs with more digits than `f64`; else `None`.
    pub fn last_long(&self) -> Option<Vec<(String, Vec<String>)>> {
        let row = self.long_table().last()?;
        Some(self.by_channels(row.into_iter().map(full)))
    }

    fn by_channels<V>(&self, mut row: impl Iterator<Item = V>) -> Vec<(String, Vec<V>)> {
        let channels = self.channels.iter();
        channels
            .map(|c| (c.name.clone(), row.by_ref().take(c.components.len()).collect()))
            .collect()
    }

    /// Components of all rows with all digits; empty for runs without more digits than `f64`.
    pub fn long_table(&self) -> impl Iterator<Item = Vec<DoubleDouble>> {
        let n = self.n_columns.max(1);
        let both = self.rows.chunks(n).zip(self.rests.chunks(n));
        both.map(|(row, rests)| {
            row.iter().zip(rests).map(|(&hi, &lo)| DoubleDouble::from_sum(hi, lo)).collect()
        })
    }

    /// All rows, each as its time [s] and its components.
    pub fn table(&self) -> impl Iterator<Item = (f64, &[f64])> {
        let n = self.n_columns;
        let marks = self.marks.iter().enumerate();
        marks.map(move |(i, mark)| (mark.t, &self.rows[i * n..(i + 1) * n]))
    }

    /// Values of one quantity, one value for each row.
    fn column(&self, of: impl Fn(&StepMark) -> f64) -> Vec<f64> {
        self.marks.iter().map(of).collect()
    }

    pub fn series(&self) -> Vec<ChannelSeries> {
        let mut first = 0;
        let stats = self.tallies.of_channels(&self.channels);
        let of_channel = |(channel, stats): (&Channel, Vec<ComponentStatistics>)| {
            let values = (0..channel.components.len()).map(|c| {
                let column = first + c;
                self.table().map(|(_, row)| row[column]).collect()
            });
            let series = ChannelSeries {
                channel: channel.clone(),
                times: self.column(|mark| mark.t),
                values: values.collect(),
                stats,
            };
            first += channel.components.len();
            series
        };
        self.channels.iter().zip(stats).map(of_channel).collect()
    }

    /// Statistics of each channel as objects for JSON.
    pub fn summaries(&self) -> Vec<ChannelSummary> {
        let stats = self.tallies.of_channels(&self.channels);
        let each = self.channels.iter().zip(&stats);
        each.map(|(channel, stats)| ChannelSummary::new(channel, stats)).collect()
    }

    pub fn energy(&self) -> EnergySeries {
        EnergySeries {
            times: self.column(|mark| mark.t),
            kinetic: self.column(|mark| mark.energies[0]),
            potential: self.column(|mark| mark.energies[1]),
            invariant_error: self.column(|mark| self.error(mark)),
        }
    }

    /// Error of the energy invariant Pi at a row: Pi(t) - Pi(0) [J].
    fn error(&self, mark: &StepMark) -> f64 {
        let [kinetic, potential, work] = mark.energies;
        kinetic + potential - work - self.initial
    }

    pub fn violation(&self) -> ViolationSeries {
        ViolationSeries {
            times: self.column(|mark| mark.t),
            position: self.column(|mark| mark.violation[0]),
            velocity: self.column(|mark| mark.violation[1]),
            acceleration: self.column(|mark| mark.violation[2]),
        }
    }

    /// Marks of the rows that end a step, which are all rows except the row at the start.
    fn steps(&self) -> impl Iterator<Item = &StepMark> {
        self.steps_from(0)
    }

    /// Marks of the rows that end a step, beginning with row `row`.
    fn steps_from(&self, row: usize) -> impl Iterator<Item = &StepMark> {
        let marks = self.marks.iter().skip(row);
        marks.filter(|mark| mark.step.length > 0.0)
    }

    pub fn iterations(&self) -> IterationSeries {
        IterationSeries {
            times: self.steps().map(|mark| mark.t).collect(),
            counts: self.steps().map(|mark| mark.step.iterations).collect(),
        }
    }

    /// Step lengths and counts of the rows, beginning with row `row`.
    pub fn step_series(&self, row: usize, totals: ControlSummary) -> StepSeries {
        StepSeries {
            times: self.steps_from(row).map(|mark| mark.t).collect(),
            energy_errors: self.steps_from(row).map(|mark| self.error(mark)).collect(),
            rows: self.steps_from(row).map(|mark| mark.step.clone()).collect(),
            totals,
        }
    }
}
