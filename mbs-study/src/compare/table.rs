//! Reference from a table, for instance of a closed-form solution: a CSV file with times and outputs, like `run.csv`.

use super::ladder::Instants;
use core::fmt::{self, Display, Formatter};
use mbs::record::Channel;

/// Largest difference between the time of a row and its instant, relative to the run [-]: decimal numbers are rounded. Chosen, not tuned.
const SAME_TIME: f64 = 1e-9;

/// Reason why a reference table cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// Text that cannot be read or is not CSV.
    Unreadable(String),
    /// First column whose name is not `t`.
    NoTime,
    /// Table without a column that is an output of the scene.
    NoOutput,
    /// Table without rows.
    Empty,
    /// Column that is no output of the scene, and the names of all outputs.
    UnknownColumn(String, Vec<String>),
    /// Cell that is no finite number: line and column name.
    NotANumber(u64, String),
    /// Line whose time is not later than that of the line before.
    Order(u64),
    /// Time before the start or after the end of the run: line, time and duration, as texts.
    Beyond(u64, String, String),
    /// Table without a time that is one of the instants: the distance of the instants, as text.
    NoInstant(String),
}

/// Reference table: its values at the instants, and the precision of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceTable {
    /// Values of all columns at each instant that the table has; NaN in columns that it does not have.
    pub rows: Vec<Option<Vec<f64>>>,
    /// Half a unit of the last digit of each column, as root mean square over the rows.
    pub digits: Vec<f64>,
    /// True for each column that the table has.
    pub has: Vec<bool>,
}

/// Reads a table for the outputs of a scene at some instants. Its times may extend to the end of the scene's run [s].
///
/// # Errors
/// [`TableError`] with the line or column that cannot be used.
pub fn read(
    text: &str,
    channels: &[Channel],
    (instants, duration): (&Instants, f64),
) -> Result<ReferenceTable, TableError> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let unreadable = |error: csv::Error| TableError::Unreadable(error.to_string());
    let header = reader.headers().map_err(unreadable)?.clone();
    if header.get(0) != Some("t") {
        return Err(TableError::NoTime);
    }
    let columns: Vec<String> = channels.iter().flat_map(Channel::columns).collect();
    let place: Vec<Option<usize>> =
        columns.iter().map(|name| header.iter().position(|cell| cell == name)).collect();
    if place.iter().all(Option::is_none) {
        return Err(TableError::NoOutput);
    }
    if let Some(cell) = header.iter().skip(1).find(|cell| !columns.iter().any(|c| c == cell)) {
        return Err(TableError::UnknownColumn(cell.to_owned(), columns));
    }
    let mut table = ReferenceTable {
        rows: vec![None; instants.count],
        digits: vec![0.0; columns.len()],
        has: place.iter().map(Option::is_some).collect(),
    };
    let (mut last, mut given) = (f64::NEG_INFINITY, 0.0);
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |i: usize| {
            let cell = record.get(i).unwrap_or_default();
            let name = header.get(i).unwrap_or_default().to_owned();
            let value = cell.parse::<f64>().ok().filter(|x| x.is_finite());
            value.map(|x| (x, cell)).ok_or(TableError::NotANumber(line, name))
        };
        let t = number(0)?.0;
        if t <= last {
            return Err(TableError::Order(line));
        }
        let end = duration.max(instants.time(instants.count));
        if t < 0.0 || t > end * (1.0 + SAME_TIME) {
            let [t, end] = [t, end].map(mbs_scene::format::significant);
            return Err(TableError::Beyond(line, t, end));
        }
        last = t;
        let (mut row, mut halves) = (vec![f64::NAN; columns.len()], vec![0.0; columns.len()]);
        for (c, i) in place.iter().enumerate() {
            let Some(i) = *i else { continue };
            let (value, cell) = number(i)?;
            row[c] = value;
            halves[c] = half_unit(cell);
        }
        let Some(k) = instant(t, instants) else { continue };
        given += 1.0;
        table.digits.iter_mut().zip(&halves).for_each(|(sum, half)| *sum += half * half);
        table.rows[k] = Some(row);
    }
    if last < 0.0 {
        return Err(TableError::Empty);
    }
    if table.rows.iter().all(Option::is_none) {
        return Err(TableError::NoInstant(mbs_scene::format::significant(instants.interval)));
    }
    table.digits.iter_mut().for_each(|sum| *sum = (*sum / given).sqrt());
    Ok(table)
}

/// Index of the instant at time `t` [s]; 0 is the first instant after the start.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be in range"
)]
fn instant(t: f64, instants: &Instants) -> Option<usize> {
    let k = (t / instants.interval).round();
    if !(k >= 1.0 && k <= instants.count as f64) {
        return None;
    }
    let end = instants.time(instants.count);
    ((t - k * instants.interval).abs() <= SAME_TIME * end).then_some(k as usize - 1)
}

/// Half a unit of the last digit of a decimal number.
fn half_unit(text: &str) -> f64 {
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let after_point = digits.split_once('.').map_or(0, |(_, after)| after.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    0.5 * 10_f64.powi(exponent - i32::try_from(after_point).unwrap_or(i32::MAX))
}

impl TableError {
    /// Returns a hint at what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        let hint = match self {
            Self::UnknownColumn(name, known) => {
                let suggestion = mbs_scene::nearest_name(name, known, "outputs");
                return format!("{suggestion}; or leave the column out");
            }
            Self::NoInstant(_) => {
                "give rows at those times; the last instant is the end of the run"
            }
            Self::Order(_) => "sort the rows by time and keep one row per time",
            Self::Beyond(..) => {
                "leave out what is not of the run, or give the scene a longer duration"
            }
            Self::NotANumber(..) => "write a finite decimal number, or leave the row out",
            _ => {
                "write it as run.csv: `t`, then outputs as `name` or `name.x`, a row for each time"
            }
        };
        hint.to_owned()
    }
}

impl Display for TableError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(why) => write!(f, "the reference table cannot be read: {why}"),
            Self::NoTime => write!(f, "the first column of the reference table is not `t`"),
            Self::NoOutput => write!(f, "the reference table has none of the scene's outputs"),
            Self::NotANumber(line, column) => {
                write!(
                    f,
                    "line {line} of the reference table has no finite number in column `{column}`"
                )
            }
            Self::Empty => write!(f, "the reference table has no rows"),
            Self::UnknownColumn(name, _) => {
                write!(f, "line 1 of the reference table: `{name}` is no output of the scene")
            }
            Self::Order(line) => {
                write!(f, "line {line} of the reference table is not later than the line before")
            }
            Self::Beyond(line, t, end) => {
                write!(
                    f,
                    "line {line} of the reference table is at {t} s, and the run is from 0 to {end} s"
                )
            }
            Self::NoInstant(interval) => write!(
                f,
                "no time of the reference table is an instant of the comparison, a multiple of {interval} s"
            ),
        }
    }
}

impl core::error::Error for TableError {}
