//! The table of counts and bounds in docs/PROFILES.md.

use super::counts::Counted;
use crate::process::{self, root};
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// Marks at the beginning and at the end of the table.
const MARKS: [&str; 2] = ["<!-- lines:begin -->\n", "<!-- lines:end -->"];
const HEAD: &str =
    "| crate | first command | bound | all precisions | bound |\n|---|---|---|---|---|\n";

/// Counts and bounds of a crate, in thousands of lines, for the first command and for all precisions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Row {
    counts: [u64; 2],
    /// Bounds of the lines; `None`: the crate is not in the table.
    bounds: Option<[u64; 2]>,
}

/// A row for each crate.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Table(BTreeMap<String, Row>);

fn path() -> PathBuf {
    root().join("docs/PROFILES.md")
}

/// The text before the table, the table, and the text after it.
fn parts(text: &str) -> Result<[&str; 3], String> {
    let missing = || format!("docs/PROFILES.md lacks its mark {}", MARKS[0].trim());
    let (before, rest) = text.split_once(MARKS[0]).ok_or_else(missing)?;
    let (table, after) = rest.split_once(MARKS[1]).ok_or_else(missing)?;
    Ok([before, table, after])
}

impl Table {
    /// The table of docs/PROFILES.md.
    pub(super) fn read() -> Result<Self, String> {
        let text = fs::read_to_string(path()).map_err(|e| format!("docs/PROFILES.md: {e}"))?;
        Self::parse(parts(&text)?[1])
    }

    /// The rows of a text.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let mut rows = BTreeMap::new();
        for line in text.lines().filter(|line| line.starts_with("| mbs")) {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let numbers: Option<Vec<u64>> = cells[1..].iter().map(|n| n.parse().ok()).collect();
            let Some([first, bound, all, bound_of_all]) =
                numbers.as_deref().and_then(|n| <[u64; 4]>::try_from(n).ok())
            else {
                return Err(format!("docs/PROFILES.md: `{line}` has no four numbers"));
            };
            let row = Row { counts: [first, all], bounds: Some([bound, bound_of_all]) };
            rows.insert(cells[0].to_owned(), row);
        }
        Ok(Self(rows))
    }

    /// Replaces the counts; the bounds do not change.
    pub(super) fn take(&mut self, counted: &Counted) {
        self.0.values_mut().for_each(|row| row.counts = [0; 2]);
        for (i, counts) in counted.iter().enumerate() {
            for (name, counts) in counts {
                let row = self.0.entry(name.replace('_', "-")).or_default();
                row.counts[i] = counts.lines.div_ceil(1000);
            }
        }
    }

    /// Faults: crates above their bound, and crates without a bound.
    pub(super) fn faults(&self) -> Vec<String> {
        let fault = |(name, row): (&String, &Row)| match row.bounds {
            None => Some(format!("{name} has no bound of lines in docs/PROFILES.md")),
            Some(bounds) if row.counts.iter().zip(bounds).any(|(n, bound)| *n > bound) => {
                Some(format!(
                    "{name} has {:?} thousand lines (first command, all precisions); its bounds in docs/PROFILES.md are {bounds:?}. What \
                     compiles more? Raise the bound by hand where it is worth its time",
                    row.counts
                ))
            }
            Some(_) => None,
        };
        self.0.iter().filter_map(fault).collect()
    }

    /// The table as Markdown, with sums.
    pub(super) fn text(&self) -> String {
        let mut text = HEAD.to_owned();
        let mut sums = [0; 4];
        for (name, row) in &self.0 {
            let [first, all] = row.counts;
            let [bound, bound_of_all] = row.bounds.unwrap_or_default();
            let numbers = [first, bound, all, bound_of_all];
            sums.iter_mut().zip(numbers).for_each(|(sum, n)| *sum += n);
            text += &format!("| {name} | {first} | {bound} | {all} | {bound_of_all} |\n");
        }
        text + &format!("| all | {} | {} | {} | {} |\n", sums[0], sums[1], sums[2], sums[3])
    }

    /// Writes the table into docs/PROFILES.md.
    pub(super) fn write(&self) -> Result<(), String> {
        let text = fs::read_to_string(path()).map_err(|e| format!("docs/PROFILES.md: {e}"))?;
        let [before, _, after] = parts(&text)?;
        let text = format!("{before}{}{}{}{after}", MARKS[0], self.text(), MARKS[1]);
        process::write(&path(), text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_as_it_is_written() {
        let text = format!(
            "{HEAD}| mbs-core | 801 | 820 | 1551 | 1600 |\n| all | 801 | 820 | 1551 | 1600 |\n"
        );
        assert_eq!(Table::parse(&text).expect("a table").text(), text);
        assert!(Table::parse("| mbs-core | 801 | x |\n").is_err());
    }
}
