//! Rows and statistics of a run, read from its folder or taken from its outcome.

use crate::run::Outcome;
use core::fmt::{self, Display, Formatter};
use mbs_core::outputs::in_radians;
use serde_json::Value;
use std::path::Path;

/// Files of a run in its folder.
const FILES: [&str; 2] = ["run.csv", "run.json"];

/// A column of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ResultColumn {
    /// Name in the header of the file.
    pub name: String,
    /// Name of its channel.
    pub channel: String,
    /// Unit of the column; empty if it is unknown.
    pub unit: String,
    /// Value in each row.
    pub values: Vec<f64>,
    /// Largest magnitude of the values. It covers every step if the run has recorded it in its statistics, and otherwise the rows.
    pub peak: f64,
    /// Root mean square over time. Like `peak`, it covers every step if the statistics have it, and otherwise the rows.
    pub rms: f64,
}

/// The rows of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ResultTable {
    /// Name of the scene; empty if it is unknown.
    pub scene: String,
    /// Times of the rows [s], increasing.
    pub times: Vec<f64>,
    /// Columns of the run.
    pub columns: Vec<ResultColumn>,
}

/// Reason why results cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnreadableResults {
    /// The file that is missing or malformed.
    pub file: String,
    /// Fault of the file, as a message.
    pub message: String,
}

impl Display for UnreadableResults {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "cannot read `{}`: {}", self.file, self.message)
    }
}

impl core::error::Error for UnreadableResults {}

impl ResultTable {
    /// Reads the folder that `mbs run --out` has written.
    ///
    /// # Errors
    /// [`UnreadableResults`] names the file that is missing or malformed.
    pub fn open(folder: &Path) -> Result<Self, UnreadableResults> {
        let [rows, object] = FILES.map(|file| {
            let path = folder.join(file);
            let fault =
                |message: String| UnreadableResults { file: path.display().to_string(), message };
            let bytes = std::fs::read(&path).map_err(|error| fault(error.to_string()));
            (bytes, path.display().to_string())
        });
        let fault = |file: &str, message: String| UnreadableResults { file: file.into(), message };
        let object_bytes = object.0?;
        let summary: Value = serde_json::from_slice(&object_bytes)
            .map_err(|error| fault(&object.1, error.to_string()))?;
        Self::parse(&rows.0?, &summary).map_err(|message| fault(&rows.1, message))
    }

    /// Takes the rows and statistics of a run that has ended.
    ///
    /// # Errors
    /// [`UnreadableResults`] for a run without rows.
    pub fn of_outcome(outcome: &Outcome) -> Result<Self, UnreadableResults> {
        let fault = |message: String| UnreadableResults { file: FILES[0].into(), message };
        let mut rows = Vec::new();
        outcome.write_csv(&mut rows).map_err(|error| fault(error.to_string()))?;
        let summary = serde_json::to_value(&outcome.summary);
        let summary = summary.map_err(|error| fault(error.to_string()))?;
        Self::parse(&rows, &summary).map_err(fault)
    }

    /// Parses rows in CSV, and takes the statistics from the run's JSON object.
    fn parse(rows: &[u8], summary: &Value) -> Result<Self, String> {
        let mut reader = csv::Reader::from_reader(rows);
        let header = reader.headers().map_err(|error| error.to_string())?.clone();
        if header.get(0) != Some("t") {
            return Err("its first column is not `t`".to_owned());
        }
        let named = |name: &str| ResultColumn {
            name: name.to_owned(),
            channel: name.to_owned(),
            ..ResultColumn::default()
        };
        let mut columns: Vec<_> = header.iter().skip(1).map(named).collect();
        let mut times = Vec::new();
        for (i, record) in reader.records().enumerate() {
            let record = record.map_err(|error| error.to_string())?;
            if i == 0 && record.get(0) == Some("s") {
                // this line contains the units
                continue;
            }
            let mut numbers = record.iter().map(str::parse::<f64>);
            let mut number = || {
                let number = numbers.next().and_then(Result::ok).filter(|x| x.is_finite());
                number.ok_or_else(|| format!("line {} is no row of finite numbers", i + 2))
            };
            let t = number()?;
            if times.last().is_some_and(|last| *last >= t) {
                return Err(format!("its times do not grow in line {}", i + 2));
            }
            times.push(t);
            columns.iter_mut().try_for_each(|column| number().map(|x| column.values.push(x)))?;
        }
        if times.is_empty() {
            return Err("it has no row".to_owned());
        }
        for column in &mut columns {
            column.peak = column.values.iter().fold(0.0, |peak: f64, x| peak.max(x.abs()));
            column.rms = root_mean_square(&times, &column.values);
        }
        let scene = summary["scene"].as_str().unwrap_or_default().to_owned();
        let mut table = Self { scene, times, columns };
        let channels = summary["channels"].as_array();
        channels.into_iter().flatten().for_each(|channel| table.take(channel));
        Ok(table)
    }

    /// Takes units and statistics from the JSON object of a channel.
    fn take(&mut self, channel: &Value) {
        let name = channel["name"].as_str().unwrap_or_default();
        let labels = channel["components"].as_array().into_iter().flatten();
        for (i, label) in labels.enumerate() {
            let column = match label.as_str() {
                Some("") | None => name.to_owned(),
                Some(label) => format!("{name}.{label}"),
            };
            let Some(column) = self.columns.iter_mut().find(|x| x.name == column) else { continue };
            column.channel = name.to_owned();
            column.unit = channel["units"][i].as_str().unwrap_or_default().to_owned();
            let number = |key: &str| channel[key][i].as_f64();
            if let (Some(min), Some(max), Some(rms)) = (number("min"), number("max"), number("rms"))
            {
                (column.peak, column.rms) = (min.abs().max(max.abs()), rms);
            }
        }
    }

    /// Converts columns to the units of another table where one table has degrees and the other has radians.
    pub fn in_units_of(&mut self, other: &Self) {
        for column in &mut self.columns {
            let Some(same) = other.column(&column.name) else { continue };
            let [(own, from), (required, to)] = [&column.unit, &same.unit].map(|x| in_radians(x));
            if own != required || from.total_cmp(&to).is_eq() {
                continue;
            }
            let numbers = column.values.iter_mut().chain([&mut column.peak, &mut column.rms]);
            numbers.for_each(|x| *x *= to / from);
            column.unit.clone_from(&same.unit);
        }
    }

    /// A column by its name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&ResultColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// Time of the last row [s].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }
}

/// Root mean square over time, by the trapezoidal rule. For a single row it is the magnitude.
fn root_mean_square(times: &[f64], values: &[f64]) -> f64 {
    let square = |x: &[f64]| (x[0] * x[0] + x[1] * x[1]) / 2.0;
    let parts = times.windows(2).zip(values.windows(2));
    let whole: f64 = parts.map(|(t, x)| (t[1] - t[0]) * square(x)).sum();
    let time = times[times.len() - 1] - times[0];
    if time > 0.0 { (whole / time).sqrt() } else { values[0].abs() }
}
