//! The table of statistics at the end of a run: a row for each component of each output, and for the magnitude of each vector.

use mbs::record::ChannelSummary;

/// Largest number of rows without `--all`: the summary with these fits on a screen. Chosen, not tuned.
const MAX_ROWS: usize = 20;
/// Largest number of characters of a name. With it the table fits into a hundred columns.
const NAME_WIDTH: usize = 24;
/// Number of characters of a unit beside a name of full width.
const UNIT_WIDTH: usize = 6;
/// Number of characters of a component's label: `Fx`, `|F|`, `abs`.
const LABEL_WIDTH: usize = 3;
/// Number of characters of a number with the blank before it: six digits and an exponent.
const NUMBER_WIDTH: usize = 11;
/// Number of characters of a time with the blank before it: five digits.
const TIME_WIDTH: usize = 9;
/// Least magnitude that is written without an exponent. Chosen, not tuned.
const MIN_PLAIN: f64 = 1e-3;
/// Least magnitude that is written with an exponent. Chosen, not tuned.
const MAX_PLAIN: f64 = 1e5;

/// The lines of the table; an empty list if there are no channels.
pub(crate) fn lines(channels: &[ChannelSummary], is_all: bool) -> Vec<String> {
    let rows: Vec<_> = channels.iter().flat_map(of_channel).collect();
    let shown = &rows[..if is_all { rows.len() } else { rows.len().min(MAX_ROWS) }];
    if shown.is_empty() {
        return Vec::new();
    }
    let widest = |of: fn(&Row<'_>) -> usize| shown.iter().map(of).max().unwrap_or(0);
    let unit = widest(|row| row.unit.chars().count()).max("unit".len());
    let most = NAME_WIDTH.saturating_sub(unit.saturating_sub(UNIT_WIDTH));
    let name = widest(|row| row.name.chars().count()).min(most);
    let widths = [name, unit];
    let head = ["min", "at [s]", "max", "at [s]", "RMS", "end"].map(str::to_owned);
    let mut lines = vec![line(("", "", "unit"), &head, widths)];
    lines.extend(shown.iter().map(|row| {
        let name = shortened(row.name, name);
        line((&name, &row.label, row.unit), &row.numbers, widths)
    }));
    let left = rows.len() - shown.len();
    if left > 0 {
        lines.push(format!("  {left} more with --all"));
    }
    lines
}

/// Row of the table of statistics, as texts.
struct Row<'a> {
    name: &'a str,
    label: String,
    unit: &'a str,
    numbers: [String; 6],
}

fn of_channel(channel: &ChannelSummary) -> impl Iterator<Item = Row<'_>> {
    let one = |i: usize| Row {
        name: if i == 0 { &channel.name } else { "" },
        label: match channel.components[i].as_str() {
            magnitude @ ("F" | "M") => format!("|{magnitude}|"),
            label => label.to_owned(),
        },
        unit: &channel.units[i],
        numbers: [
            number(channel.min[i]),
            time(channel.at_min[i]),
            number(channel.max[i]),
            time(channel.at_max[i]),
            number(channel.rms[i]),
            number(channel.end[i]),
        ],
    };
    (0..channel.components.len()).map(one)
}

fn line(
    (name, label, unit): (&str, &str, &str),
    numbers: &[String; 6],
    [n, u]: [usize; 2],
) -> String {
    let mut line = format!("  {name:<n$} {label:<LABEL_WIDTH$} {unit:<u$}");
    for (i, number) in numbers.iter().enumerate() {
        let width = if i == 1 || i == 3 { TIME_WIDTH } else { NUMBER_WIDTH };
        line += &format!("{number:>width$}");
    }
    line
}

/// A name shortened to `most` characters.
fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    name.chars().take(most.saturating_sub(1)).chain(['…']).collect()
}

/// A number with six digits. A negative zero has no minus sign.
pub(crate) fn number(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(MIN_PLAIN..MAX_PLAIN).contains(&size) {
        let text = format!("{x:.3e}");
        // an exponent of three digits leaves room for one decimal fewer
        return if text.len() < NUMBER_WIDTH { text } else { format!("{x:.2e}") };
    }
    #[allow(clippy::cast_possible_truncation, reason = "between -3 and 4")]
    let digits = size.log10().floor() as i32;
    let decimals = usize::try_from(5 - digits).unwrap_or(0).min(6);
    format!("{x:.decimals$}")
}

/// A time with four decimals, or in exponential form if it is at least 10,000 s.
pub(crate) fn time(t: f64) -> String {
    if t < MAX_PLAIN / 10.0 { format!("{t:.4}") } else { format!("{t:.2e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Width of a terminal into which the table must fit, in columns.
    const MAX_COLUMNS: usize = 100;

    fn channel(name: &str, unit: &str, x: f64) -> ChannelSummary {
        let components: Vec<String> = ["Fx", "Fy", "F"].map(Into::into).into();
        let [all, times] = [vec![x; 3], vec![9999.99994; 3]];
        ChannelSummary {
            name: name.into(),
            units: vec![unit.into(); 3],
            components,
            min: all.clone(),
            at_min: times.clone(),
            max: all.clone(),
            at_max: times,
            rms: all.clone(),
            end: all,
            ..ChannelSummary::default()
        }
    }

    #[test]
    fn the_table_fits_into_a_hundred_columns_and_numbers_never_touch() {
        let name = "ein Gelenk mit einem sehr langen Namen";
        for x in [-1.234_567_89e-100, -99_999.949, -0.001_234_567, 1.0e300, f64::NAN] {
            for unit in ["N", "kg m^2/s"] {
                for line in lines(&[channel(name, unit, x)], true) {
                    assert!(line.chars().count() <= MAX_COLUMNS, "{line}");
                    let numbers = line.split_whitespace().rev().take(6).count();
                    assert_eq!(numbers, 6, "{line}");
                    assert!(line.contains("at [s]") || line.contains(&format!(" {} ", number(x))));
                }
            }
        }
    }

    #[test]
    fn twenty_rows_are_shown_and_the_rest_is_counted() {
        let channels: Vec<_> = (0..10).map(|i| channel(&i.to_string(), "N", 1.0)).collect();
        let few = lines(&channels, false);
        assert_eq!((few.len(), few.last().map(String::as_str)), (22, Some("  10 more with --all")));
        assert_eq!(lines(&channels, true).len(), 31);
    }

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (20.220_59, "20.2206"),
            (-0.102_68, "-0.102680"),
            (0.0, "0"),
            (-0.0, "0"),
            (1.0e-9, "1.000e-9"),
            (99_999.4, "99999.4"),
            (1.0e5, "1.000e5"),
        ];
        for (x, expected) in cases {
            assert_eq!(number(x), expected);
        }
    }
}
