//! Rows of a run as a table: one contiguous array for each named column.

use crate::checkpoint::{Head, write_rows};
use crate::record::Channel;
use std::io;

/// Time and the components of all outputs, at each recorded instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    time: Vec<f64>,
    names: Vec<String>,
    units: Vec<String>,
    columns: Vec<Vec<f64>>,
    channels: Vec<Channel>,
}

impl Table {
    pub(super) fn new(channels: &[Channel], rows: &[(f64, Vec<f64>)]) -> Self {
        let names: Vec<String> = channels.iter().flat_map(Channel::columns).collect();
        let units = channels.iter().flat_map(|channel| &channel.components);
        let column = |k| rows.iter().map(|(_, row)| row[k]).collect();
        Self {
            time: rows.iter().map(|(t, _)| *t).collect(),
            units: units.map(|component| component.unit.clone()).collect(),
            columns: (0..names.len()).map(column).collect(),
            names,
            channels: channels.to_vec(),
        }
    }

    /// Instants of the rows [s].
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Names of the columns, without that of time: `elbow`, `tip.x`.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Units of the columns.
    #[must_use]
    pub fn units(&self) -> &[String] {
        &self.units
    }

    /// The values of a column, one for each instant.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.names.iter().position(|n| n == name)?;
        self.columns.get(place).map(Vec::as_slice)
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// True if the table has no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// Writes the table as `mbs run` writes `run.csv`: a line of names, then a line for each instant.
    ///
    /// # Errors
    /// Errors of the writer `sink`.
    pub fn write_csv(&self, sink: impl io::Write) -> io::Result<()> {
        let rows: Vec<Vec<f64>> = (0..self.len())
            .map(|i| self.columns.iter().map(|column| column[i]).collect())
            .collect();
        let table = self.time.iter().zip(&rows).map(|(t, row)| (*t, &row[..]));
        write_rows((sink, &self.channels), Head::Names, table, core::iter::empty())
    }
}
