//! Table of a sweep in Parquet: one row group, plain encoding, null for values without a measurement.

use super::table::{Columns, Kind};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::{ParquetError, Result};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::Arc;

/// Writes rows of texts in the data types of their columns.
pub(super) fn write(
    sink: impl Write + Send,
    columns: &Columns,
    rows: &BTreeMap<usize, Vec<String>>,
) -> io::Result<()> {
    write_rows(sink, columns, rows).map_err(io::Error::other)
}

fn write_rows(
    sink: impl Write + Send,
    columns: &Columns,
    rows: &BTreeMap<usize, Vec<String>>,
) -> Result<()> {
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(sink, schema(columns)?, properties)?;
    let mut group = writer.next_row_group()?;
    let mut index = 0;
    while let Some(mut column) = group.next_column()? {
        let cells: Vec<&str> = rows.values().map(|row| row[index].as_str()).collect();
        // an empty cell is a missing value, except in a column of texts
        let is_there = |cell: &str| !cell.is_empty() || columns.kind(index) == Kind::Text;
        let levels: Vec<i16> = cells.iter().map(|cell| i16::from(is_there(cell))).collect();
        let levels = Some(&levels[..]);
        match column.untyped() {
            ColumnWriter::Int64ColumnWriter(c) => c.write_batch(&parsed(&cells), levels, None)?,
            ColumnWriter::DoubleColumnWriter(c) => c.write_batch(&parsed(&cells), levels, None)?,
            ColumnWriter::BoolColumnWriter(c) => c.write_batch(&parsed(&cells), levels, None)?,
            ColumnWriter::ByteArrayColumnWriter(c) => {
                let texts: Vec<ByteArray> = cells.iter().map(|&cell| cell.into()).collect();
                c.write_batch(&texts, levels, None)?
            }
            _ => return Err(ParquetError::NYI("a column of another type".to_owned())),
        };
        column.close()?;
        index += 1;
    }
    group.close()?;
    writer.close().map(drop)
}

/// Parses the values of cells that are not empty.
fn parsed<T: core::str::FromStr>(cells: &[&str]) -> Vec<T> {
    cells.iter().filter(|cell| !cell.is_empty()).filter_map(|cell| cell.parse().ok()).collect()
}

fn schema(columns: &Columns) -> Result<Arc<Type>> {
    let field = |(i, name): (usize, &String)| {
        let (physical, logical) = match columns.kind(i) {
            Kind::Count => (Physical::INT64, None),
            Kind::Number => (Physical::DOUBLE, None),
            Kind::Flag => (Physical::BOOLEAN, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(name, physical).with_logical_type(logical);
        field.with_repetition(Repetition::OPTIONAL).build().map(Arc::new)
    };
    let fields: Result<Vec<_>> = columns.header().iter().enumerate().map(field).collect();
    Type::group_type_builder("sweep").with_fields(fields?).build().map(Arc::new)
}
