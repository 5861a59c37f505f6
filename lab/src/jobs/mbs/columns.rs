//! Columns of the CSV files of a run.

use std::path::Path;

/// Reads columns by their names. An empty cell gives no number.
///
/// # Errors
///
/// The missing column or number.
pub(crate) fn read<const N: usize>(
    file: &Path,
    names: [&str; N],
) -> Result<Vec<[Option<f64>; N]>, String> {
    let place = |why: String| format!("{}: {why}", file.display());
    let mut reader = csv::Reader::from_path(file).map_err(|e| place(e.to_string()))?;
    let header = reader.headers().map_err(|e| place(e.to_string()))?.clone();
    let mut columns = [0; N];
    for (column, name) in columns.iter_mut().zip(names) {
        let found = header.iter().position(|n| n == name);
        *column = found.ok_or_else(|| place(format!("no column `{name}`")))?;
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| place(e.to_string()))?;
        let mut row = [None; N];
        for (cell, &column) in row.iter_mut().zip(&columns) {
            let text = record.get(column).unwrap_or_default();
            let number = text.parse().map_err(|_| place(no_number(rows.len())));
            *cell = if text.is_empty() { None } else { Some(number?) };
        }
        rows.push(row);
    }
    Ok(rows)
}

/// The history of one column, as points (time, value).
///
/// # Errors
///
/// The missing column or number.
pub(crate) fn history(file: &Path, column: &str) -> Result<Vec<[f64; 2]>, String> {
    let rows = read(file, ["t", column])?;
    let point = |(i, [t, x]): (usize, [Option<f64>; 2])| {
        t.zip(x).map(|(t, x)| [t, x]).ok_or_else(|| format!("{}: {}", file.display(), no_number(i)))
    };
    rows.into_iter().enumerate().map(point).collect::<Result<_, String>>()
}

fn no_number(row: usize) -> String {
    format!("no number in row {}", row + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_read_by_name_and_their_absence_is_reported() {
        let file = std::env::temp_dir().join(format!("mbs-columns-{}.csv", std::process::id()));
        std::fs::write(&file, "t,a.x,a.z\n0,1,2\n0.5,,-4\n").unwrap();
        let (z, x, b) = (history(&file, "a.z"), history(&file, "a.x"), history(&file, "b"));
        let both = read(&file, ["a.z", "a.x"]);
        std::fs::remove_file(&file).unwrap();
        assert_eq!(z.unwrap(), [[0.0, 2.0], [0.5, -4.0]]);
        assert!(x.unwrap_err().contains("no number in row 2"));
        assert!(b.unwrap_err().contains("`b`"));
        assert_eq!(both.unwrap(), [[Some(2.0), Some(1.0)], [Some(-4.0), None]]);
    }
}
