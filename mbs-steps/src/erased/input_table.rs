//! Tables over time that inputs follow. In the scene, each such input is replaced by a table.
//!
//! The first column is `t`, and the other columns have the names of inputs. Values are linear between rows, and constant before the first
//! and after the last row. The motion of a guide or a coupling is the cubic spline through its values.

use super::failure::SimulationError;
use super::inputs::{InputInfo, InputOwner};
use core::fmt::{self, Display, Formatter};
use csv::{ReaderBuilder, StringRecord};
use mbs_core::effects::Value;
use mbs_core::scene::{
    Effect, Interpolation, Motion, Number, Scene, Signal, SignalKind, TableEnds,
};
use mbs_scene::{Place, nearest_name};

/// Table over time that inputs follow, from numbers or from CSV. Its columns have the names of inputs of a mechanism.
///
/// ```
/// use mbs::{InputTable, Mechanism};
/// let m = Mechanism::parse("[scene]\ndimension = 2\nduration = 1\n[[signal]]\nname = \"load\"\nkind = \"input\"\n")?;
/// let table = InputTable::new([0.0, 1.0], [("load", vec![0.0, 2.5])]);
/// assert!(m.following(&table)?.to_toml()?.contains("table = [[0.0, 0.0], [1.0, 2.5]]"));
/// let same = InputTable::csv(b"t,load\n0,0\n1,2.5\n", "load.csv");
/// assert!(m.following(&same)?.to_toml()?.contains("[1.0, 2.5]"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct InputTable(Data);

#[derive(Debug, Clone, PartialEq)]
enum Data {
    Csv { file: String, text: String },
    Numbers { times: Vec<f64>, columns: Vec<(String, Vec<f64>)> },
}

impl InputTable {
    /// Makes a table of times [s] and of columns, each with the name of its input and a value for each time.
    pub fn new<N: Into<String>>(
        times: impl Into<Vec<f64>>,
        columns: impl IntoIterator<Item = (N, Vec<f64>)>,
    ) -> Self {
        let columns = columns.into_iter().map(|(name, values)| (name.into(), values)).collect();
        Self(Data::Numbers { times: times.into(), columns })
    }

    /// Makes a table from the text of a CSV file, whose name appears in errors. The first column is `t`.
    #[must_use]
    pub fn csv(bytes: &[u8], file: &str) -> Self {
        let text = String::from_utf8_lossy(bytes).into_owned();
        Self(Data::Csv { file: file.to_owned(), text })
    }

    /// Replaces inputs of a scene by the columns of the table.
    ///
    /// # Errors
    /// [`InputTableError`] for unknown names, repeated columns, a first column other than `t`, times that do not increase, and fields that
    /// are not numbers.
    pub fn put_into(
        &self,
        scene: &mut Scene<Number>,
        inputs: &[InputInfo],
    ) -> Result<(), InputTableError> {
        let table = match &self.0 {
            Data::Csv { file, text } => Table::read(Source::Csv { file, text }, inputs)?,
            Data::Numbers { times, columns } => Table::of(times, columns, inputs)?,
        };
        for (k, info) in table.columns.iter().enumerate() {
            if table.columns[..k].iter().all(|other| other.owner != info.owner) {
                table.write(scene, info.owner);
            }
        }
        Ok(())
    }
}

/// Error of a table of inputs.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum InputTableError {
    /// Error in a file: name of the file, place in the file, message and hint.
    Table {
        /// Name of the file as given.
        file: String,
        /// Line number, column number and text of the line.
        place: Place,
        /// Message that says what is wrong in the file.
        message: String,
        /// Hint for the user: what to do about the error.
        hint: String,
    },
    /// Error in a table of numbers: the message and the hint.
    Numbers {
        /// Message that says what is wrong in the numbers.
        message: String,
        /// Hint for the user: what to do about the error.
        hint: String,
    },
}

impl InputTableError {
    /// Returns the message of the error, without its place.
    #[must_use]
    pub fn message(&self) -> &str {
        match self {
            Self::Table { message, .. } | Self::Numbers { message, .. } => message,
        }
    }

    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> &str {
        match self {
            Self::Table { hint, .. } | Self::Numbers { hint, .. } => hint,
        }
    }
}

impl Display for InputTableError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table { file, place, message, .. } => {
                write!(f, "{file}:{}:{}: {message}", place.line, place.column)
            }
            Self::Numbers { message, .. } => f.write_str(message),
        }
    }
}

impl core::error::Error for InputTableError {}

impl From<InputTableError> for SimulationError {
    fn from(error: InputTableError) -> Self {
        let hint = error.hint().to_owned();
        Self::new("inputs-refused", error.message(), hint).with_cause(error)
    }
}

/// Source of a table: the text of a file, or numbers.
#[derive(Clone, Copy)]
enum Source<'a> {
    Csv { file: &'a str, text: &'a str },
    Numbers,
}

impl Source<'_> {
    /// Returns an error that refers to a field (counted from 0) of a line (counted from 1).
    fn fault<R>(
        self,
        (line, field): (u64, usize),
        message: String,
        hint: impl Into<String>,
    ) -> Result<R, InputTableError> {
        let hint = hint.into();
        let Self::Csv { file, text } = self else {
            return Err(InputTableError::Numbers { message, hint });
        };
        let line = usize::try_from(line).unwrap_or(usize::MAX).max(1);
        let text = text.lines().nth(line - 1).unwrap_or_default().to_owned();
        // In a line with quotes a comma may belong to a field, so the error refers to the start of the line.
        let field = if text.contains('"') { 0 } else { field };
        let before: usize = text.split(',').take(field).map(|s| s.chars().count() + 1).sum();
        let rest: String = text.chars().skip(before).collect();
        let width = rest.split(',').next().map_or(1, |s| s.chars().count().max(1));
        let place = Place { line, column: before + 1, width, text };
        Err(InputTableError::Table { file: file.to_owned(), place, message, hint })
    }
}

/// Table of inputs after it was read.
struct Table<'a> {
    /// Input that each column belongs to; the first column, which is the time, is not included.
    columns: Vec<&'a InputInfo>,
    /// Time and values of each row of the table.
    rows: Vec<Vec<Number>>,
}

const HINT_TIME: &str = "begin each row with its time [s], later than that of the row before";
const HINT_NUMBER: &str = "write a finite decimal number";

impl<'a> Table<'a> {
    /// Converts a table of numbers.
    fn of(
        times: &[f64],
        columns: &[(String, Vec<f64>)],
        inputs: &'a [InputInfo],
    ) -> Result<Self, InputTableError> {
        let source = Source::Numbers;
        let names = columns.iter().map(|(name, _)| name.as_str());
        let head = head(source, 1, core::iter::once("t").chain(names), inputs)?;
        let all =
            || core::iter::once(("t", times)).chain(columns.iter().map(|(n, v)| (&**n, &**v)));
        for (name, values) in all() {
            if values.len() != times.len() {
                let (n, of) = (values.len(), times.len());
                let message = format!("input `{name}` has {n} values, and `t` {of}");
                return source.fault((1, 0), message, "give one value for each time");
            }
            if let Some(bad) = values.iter().find(|x| !x.is_finite()) {
                let message = format!("`{bad}` of `{name}` is not a finite number");
                return source.fault((1, 0), message, HINT_NUMBER);
            }
        }
        if let Some(pair) = times.windows(2).find(|pair| pair[1] <= pair[0]) {
            return source.fault((1, 0), not_after(&pair[1].to_string()), HINT_TIME);
        }
        if times.is_empty() {
            return source.fault((1, 0), NO_ROW.to_owned(), HINT_TIME);
        }
        let row = |i: usize| all().map(|(_, values)| Number::from(values[i])).collect();
        Ok(Self { columns: head, rows: (0..times.len()).map(row).collect() })
    }

    /// Reads a table from CSV.
    fn read(source: Source<'_>, inputs: &'a [InputInfo]) -> Result<Self, InputTableError> {
        let Source::Csv { text, .. } = source else {
            return source.fault((1, 0), NO_ROW.to_owned(), HINT_TIME);
        };
        let mut reader = ReaderBuilder::new();
        let reader = reader.has_headers(false).flexible(true).trim(csv::Trim::All);
        let mut reader = reader.from_reader(text.as_bytes());
        let (mut columns, mut rows): (Option<Vec<&InputInfo>>, Vec<Vec<Number>>) =
            (None, Vec::new());
        let mut record = StringRecord::new();
        loop {
            let line = reader.position().line();
            match reader.read_record(&mut record) {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => return source.fault((line, 0), error.to_string(), "write CSV"),
            }
            let line = record.position().map_or(line, csv::Position::line);
            let Some(columns) = &columns else {
                columns = Some(head(source, line, record.iter(), inputs)?);
                continue;
            };
            let row = row(source, (line, &record), columns.len() + 1)?;
            let time = |row: &[Number]| row.first().map_or(f64::NAN, Number::to_f64);
            if rows.last().is_some_and(|before| time(&row) <= time(before)) {
                return source.fault((line, 0), not_after(&record[0]), HINT_TIME);
            }
            rows.push(row);
        }
        let n_lines = text.lines().count() as u64;
        match columns {
            Some(columns) if !rows.is_empty() => Ok(Self { columns, rows }),
            _ => source.fault((n_lines, 0), NO_ROW.to_owned(), HINT_TIME),
        }
    }

    /// Returns time and value of an input for each row; `None` if the table has no column for the input.
    fn pairs(&self, info: &InputInfo) -> Option<Vec<[Number; 2]>> {
        let place = self.columns.iter().position(|column| *column == info)?;
        Some(self.rows.iter().map(|row| [row[0].clone(), row[place + 1].clone()]).collect())
    }

    /// Writes all columns that belong to an owner into the scene.
    fn write(&self, scene: &mut Scene<Number>, owner: InputOwner) {
        let own = || self.columns.iter().filter(|column| column.owner == owner);
        let rows = own().next().and_then(|info| self.pairs(info)).unwrap_or_default();
        match owner {
            InputOwner::Effect(effect) => {
                let values: Vec<_> = own().map(|info| (info.component, self.pairs(info))).collect();
                set_effect(&mut scene.effects[effect], &rows, &values);
            }
            InputOwner::Guide(guide) => {
                scene.guides[guide].law = Motion::Table { rows, ends: TableEnds::Natural };
            }
            InputOwner::Coupling { coupling, .. } => {
                let motion = Motion::Table { rows, ends: TableEnds::Natural };
                scene.couplings[coupling].motion = Some(motion);
            }
            InputOwner::Signal(signal) => {
                let interpolation = Interpolation::Linear;
                let kind = SignalKind::Table { rows, interpolation, periodic: false };
                scene.signals[signal].kind = kind;
            }
        }
    }
}

/// Error message for a table without rows.
const NO_ROW: &str = "there is no row of values";

fn not_after(time: &str) -> String {
    format!("the time `{time}` is not after that before it")
}

/// Returns the inputs of the columns, from the names in the header.
fn head<'a, 'n>(
    source: Source<'_>,
    line: u64,
    mut names: impl Iterator<Item = &'n str>,
    inputs: &'a [InputInfo],
) -> Result<Vec<&'a InputInfo>, InputTableError> {
    let first = names.next().unwrap_or("");
    if first != "t" {
        let message = format!("the first column is `{first}`, not `t`");
        return source.fault((line, 0), message, "write the times [s] into a first column `t`");
    }
    let mut columns: Vec<&InputInfo> = Vec::new();
    for (field, name) in names.enumerate() {
        let at = (line, field + 1);
        let mut named = inputs.iter().filter(|input| input.name == name);
        let (Some(info), other) = (named.next(), named.next()) else {
            let known: Vec<_> = inputs.iter().map(|input| input.name.clone()).collect();
            let message = format!("unknown input `{name}`");
            return source.fault(at, message, nearest_name(name, &known, "inputs"));
        };
        if other.is_some() {
            let message = format!("two inputs have the name `{name}`");
            return source.fault(at, message, "rename one of them in the scene");
        }
        if columns.contains(&info) {
            let message = format!("`{name}` has two columns");
            return source.fault(at, message, "keep one of them");
        }
        let is_motion = matches!(info.owner, InputOwner::Guide(_) | InputOwner::Coupling { .. });
        if is_motion && info.component > 0 {
            let message = format!("`{name}` follows from the values of its guide or coupling");
            let hint = "leave this column out: the motion is a spline through the values";
            return source.fault(at, message, hint);
        }
        columns.push(info);
    }
    if columns.is_empty() {
        let message = "there is no input beside `t`".to_owned();
        let known: Vec<_> = inputs.iter().map(|input| input.name.clone()).collect();
        return source.fault((line, 0), message, nearest_name("", &known, "inputs"));
    }
    Ok(columns)
}

/// Parses the numbers of a row.
fn row(
    source: Source<'_>,
    (line, record): (u64, &StringRecord),
    needed: usize,
) -> Result<Vec<Number>, InputTableError> {
    if record.len() != needed {
        let message = format!("expected {needed} numbers, found {}", record.len());
        let last = record.len().min(needed) - 1;
        return source.fault((line, last), message, "write a number for each column");
    }
    let mut row = Vec::with_capacity(needed);
    for (field, text) in record.iter().enumerate() {
        match Number::from_decimal(text).filter(|number| number.to_f64().is_finite()) {
            Some(number) => row.push(number),
            None => {
                let message = format!("`{text}` is not a finite number");
                return source.fault((line, field), message, HINT_NUMBER);
            }
        }
    }
    Ok(row)
}

/// Replaces an effect's input by a table; components without a column keep their initial value.
fn set_effect(
    effect: &mut Effect<Number>,
    times: &[[Number; 2]],
    columns: &[(usize, Option<Vec<[Number; 2]>>)],
) {
    let table = |start: &[Number; 3]| {
        let row = |(i, [t, _]): (usize, &[Number; 2])| {
            let mut value = start.clone();
            for (component, column) in columns {
                if let Some([_, x]) = column.as_ref().and_then(|column| column.get(i)) {
                    value[*component] = x.clone();
                }
            }
            (t.clone(), value)
        };
        Signal::Table(times.iter().enumerate().map(row).collect())
    };
    let values = effect.kind.values().into_iter().map(|value| match value {
        Value::Signal(Signal::Input(start)) => Value::Signal(table(&start)),
        other => other,
    });
    if let Some(kind) = effect.kind.with(values) {
        effect.kind = kind;
    }
}
