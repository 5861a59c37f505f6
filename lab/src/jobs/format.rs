//! Formats of numbers and sentences for a terminal and for a page.

use std::fmt::Write;

/// An error with two digits.
pub(crate) fn error(x: f64) -> String {
    format!("{x:.1e}")
}

/// A step in the shortest exponential form.
pub(crate) fn step(x: f64) -> String {
    format!("{x:e}")
}

/// A time with two or three digits [s].
pub(crate) fn seconds(x: f64) -> String {
    let digits = if x < 0.01 {
        4
    } else if x < 1.0 {
        3
    } else if x < 100.0 {
        1
    } else {
        0
    };
    format!("{x:.digits$}")
}

/// A time with three digits and its unit.
pub(crate) fn time(seconds: f64) -> String {
    let (number, unit) = match seconds {
        x if x < 1e-6 => (x * 1e9, "ns"),
        x if x < 1e-3 => (x * 1e6, "µs"),
        x if x < 1.0 => (x * 1e3, "ms"),
        x => (x, "s"),
    };
    let digits = if number < 10.0 { 2 } else { usize::from(number < 100.0) };
    format!("{number:.digits$} {unit}")
}

/// A ratio with two or three digits.
pub(crate) fn ratio(x: f64) -> String {
    match x {
        x if !(1e-3..1e4).contains(&x) => error(x),
        x if x < 0.1 => format!("{x:.3}"),
        x if x < 10.0 => format!("{x:.2}"),
        x if x < 100.0 => format!("{x:.1}"),
        x => format!("{x:.0}"),
    }
}

/// Two ends of a range of ratios; only one if both have the same text.
pub(crate) fn ratios([low, high]: [f64; 2]) -> String {
    let ends = [low, high].map(ratio);
    if ends[0] == ends[1] {
        format!("{} times", ends[0])
    } else {
        format!("{} to {} times", ends[0], ends[1])
    }
}

/// The least and the largest of numbers; `None` without numbers.
pub(crate) fn span(numbers: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let ends = numbers.into_iter().fold(ends, |[low, high], x| [low.min(x), high.max(x)]);
    (ends[0] <= ends[1]).then_some(ends)
}

/// A table as Markdown.
pub(crate) fn markdown(
    head: &[impl AsRef<str>],
    rows: impl IntoIterator<Item = Vec<String>>,
) -> String {
    let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        // writing to a string cannot fail
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// A table as CSV: its head and its records.
///
/// # Errors
///
/// The message of the writer.
pub(crate) fn csv(
    head: &str,
    records: impl IntoIterator<Item = Vec<String>>,
) -> Result<Vec<u8>, String> {
    let mut out = csv::Writer::from_writer(Vec::new());
    let head = head.split(',').map(str::to_owned).collect();
    for record in [head].into_iter().chain(records) {
        out.write_record(record).map_err(|e| e.to_string())?;
    }
    out.into_inner().map_err(|e| e.to_string())
}

/// Width of a page of text, in characters.
pub(crate) const PAGE: usize = 100;

/// Adds words in lines that fit the page, with a margin at their left.
pub(crate) fn paragraph(text: &mut String, margin: usize, words: &str) {
    let mut line = String::new();
    for word in words.split_whitespace() {
        if !line.is_empty() && margin + line.len() + 1 + word.len() > PAGE {
            let _ = writeln!(text, "{:margin$}{line}", "");
            line.clear();
        }
        let gap = if line.is_empty() { "" } else { " " };
        let _ = write!(line, "{gap}{word}");
    }
    let _ = writeln!(text, "{:margin$}{line}", "");
}

/// Escapes text for HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_two_or_three_digits() {
        assert_eq!(
            [0.00312, 0.0423, 17.2, 1003.0].map(seconds),
            ["0.0031", "0.042", "17.2", "1003"]
        );
        assert_eq!([5e-2, 1e-6].map(step), ["5e-2", "1e-6"]);
    }

    #[test]
    fn ratios_keep_two_or_three_digits() {
        let texts = [0.0432, 0.2345, 3.1378, 42.42, 1234.5, 1e-5].map(ratio);
        assert_eq!(texts, ["0.043", "0.23", "3.14", "42.4", "1234", "1.0e-5"]);
        assert_eq!([[0.5, 2.0], [1.001, 1.002]].map(ratios), ["0.50 to 2.00 times", "1.00 times"]);
    }

    #[test]
    fn a_paragraph_keeps_to_the_page() {
        let mut text = String::new();
        paragraph(&mut text, 4, &"word ".repeat(60));
        assert!(text.lines().count() == 4 && text.lines().all(|line| line.len() <= PAGE));
    }
}
