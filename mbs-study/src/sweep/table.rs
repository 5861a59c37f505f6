//! Table of a sweep: its columns, and rows as texts.

use super::member::Row;
use mbs::record::Channel;
use mbs_scene::format::shortest;
use std::collections::BTreeMap;
use std::io;

/// Failed members by error code: their number, and the first of them with its message. Members count from 1.
pub type Failures = BTreeMap<String, (usize, usize, String)>;

/// Columns of a table: `member`, the varied numbers, the status of the run, the channels, and `cpu_seconds`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Columns {
    header: Vec<String>,
    n_parameters: usize,
}

/// Kind of the values in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(not(feature = "parquet"), allow(dead_code, reason = "CSV has no types"))]
pub(super) enum Kind {
    Count,
    Number,
    Flag,
    Text,
}

const MEMBER: &str = "member";
const LAST: &str = "cpu_seconds";
/// Columns between the varied numbers and the channels.
const RUN: [(&str, Kind); 9] = [
    ("completed", Kind::Flag),
    ("error", Kind::Text),
    ("message", Kind::Text),
    ("end_time", Kind::Number),
    ("steps", Kind::Count),
    ("energy_max_error", Kind::Number),
    ("violation_position", Kind::Number),
    ("violation_velocity", Kind::Number),
    ("violation_acceleration", Kind::Number),
];

/// Cell of a row with its type.
#[derive(Debug, Clone, Copy)]
enum Cell<'a> {
    Count(u64),
    Number(f64),
    /// Decimal text of a varied number.
    Decimal(&'a str),
    Flag(bool),
    Text(&'a str),
    /// Cell without a value, because nothing was measured.
    Empty,
}

impl Cell<'_> {
    fn text(&self) -> String {
        match *self {
            Self::Count(count) => count.to_string(),
            Self::Number(number) => shortest(number),
            Self::Decimal(text) => text.to_owned(),
            Self::Flag(flag) => flag.to_string(),
            Self::Text(text) => text.replace(char::is_control, " "),
            Self::Empty => String::new(),
        }
    }

    fn number(&self) -> f64 {
        match *self {
            Self::Count(count) => count as f64,
            Self::Number(number) => number,
            Self::Decimal(text) => text.parse().unwrap_or(f64::NAN),
            Self::Flag(_) | Self::Text(_) | Self::Empty => f64::NAN,
        }
    }
}

impl Columns {
    /// Makes the columns of a scene's channels, without varied numbers.
    pub(super) fn new(channels: &[Channel]) -> Self {
        let mut header = vec![MEMBER.to_owned()];
        header.extend(RUN.map(|(name, _)| name.to_owned()));
        for column in channels.iter().flat_map(Channel::columns) {
            header.extend([format!("{column}.min"), format!("{column}.max")]);
            header.insert(header.len() - 2, column);
        }
        header.push(LAST.to_owned());
        Self { header, n_parameters: 0 }
    }

    /// Names that columns already have.
    pub(super) fn taken(&self) -> &[String] {
        &self.header
    }

    pub(super) fn with_parameters<'a>(mut self, names: impl Iterator<Item = &'a str>) -> Self {
        let names: Vec<String> = names.map(str::to_owned).collect();
        self.n_parameters = names.len();
        self.header.splice(1..1, names);
        self
    }

    /// The names of the columns.
    #[must_use]
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// Returns the indices of the channels' columns. Each channel has three columns, for its last, smallest and largest value; the index is
    /// that of the first.
    pub fn channels(&self) -> impl Iterator<Item = usize> + '_ {
        (1 + self.n_parameters + RUN.len()..self.header.len() - 1).step_by(3)
    }

    /// Indices of the columns of varied numbers.
    #[must_use]
    pub fn parameters(&self) -> core::ops::Range<usize> {
        1..1 + self.n_parameters
    }

    /// Index of the column with the error code.
    #[must_use]
    pub fn code(&self) -> usize {
        self.n_parameters + 2
    }

    pub(super) fn len(&self) -> usize {
        self.header.len()
    }

    #[cfg(feature = "parquet")]
    pub(super) fn kind(&self, column: usize) -> Kind {
        let of_run = column.checked_sub(1 + self.n_parameters).and_then(|i| RUN.get(i));
        match of_run {
            Some((_, kind)) => *kind,
            None if column == 0 => Kind::Count,
            None => Kind::Number,
        }
    }

    /// Returns the texts of a row for journal and table. Cells without a measurement are empty. Members count from 1.
    #[must_use]
    pub fn cells(&self, row: &Row) -> Vec<String> {
        self.cells_of(row).iter().map(Cell::text).collect()
    }

    /// Returns the numbers of a row, one for each column; NaN for texts and missing values.
    pub(crate) fn numbers(&self, row: &Row) -> Vec<f64> {
        self.cells_of(row).iter().map(Cell::number).collect()
    }

    /// The cells of a row, one for each column.
    fn cells_of<'a>(&self, row: &'a Row) -> Vec<Cell<'a>> {
        let mut cells = vec![Cell::Count(row.member as u64 + 1)];
        cells.extend(row.values.iter().map(|value| Cell::Decimal(value)));
        let failure = row.failure.as_ref();
        let (code, message) = failure.map_or(("", ""), |(code, message)| (code, message));
        cells.extend([Cell::Flag(failure.is_none()), Cell::Text(code), Cell::Text(message)]);
        if let Some(measured) = &row.measured {
            cells.extend([Cell::Number(measured.end_time), Cell::Count(measured.steps)]);
            let sizes = [measured.energy].into_iter().chain(measured.violation);
            let numbers = sizes.chain(measured.outputs.iter().flatten().copied());
            cells.extend(numbers.map(Cell::Number));
        }
        cells.resize(self.len() - 1, Cell::Empty);
        cells.push(Cell::Number(row.cpu_seconds));
        cells
    }

    /// True if the run of a row was completed.
    pub(super) fn is_completed(&self, cells: &[String]) -> bool {
        cells.get(self.n_parameters + 1).is_some_and(|cell| cell == "true")
    }

    /// Returns the failed rows by error code.
    pub(super) fn failures<'a>(&self, rows: impl Iterator<Item = &'a Vec<String>>) -> Failures {
        let mut failures = Failures::new();
        for row in rows.filter(|row| !self.is_completed(row)) {
            let cell = |i: usize| row.get(i).cloned().unwrap_or_default();
            let first = (0, cell(0).parse().unwrap_or_default(), cell(self.n_parameters + 3));
            failures.entry(cell(self.n_parameters + 2)).or_insert(first).0 += 1;
        }
        failures
    }

    /// Writes header and rows as CSV.
    pub(crate) fn write_csv<'a>(
        &self,
        sink: impl io::Write,
        rows: impl Iterator<Item = &'a Vec<String>>,
    ) -> io::Result<()> {
        let mut out = csv::Writer::from_writer(sink);
        out.write_record(&self.header)?;
        for row in rows {
            out.write_record(row)?;
        }
        out.flush()
    }
}
