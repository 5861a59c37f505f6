//! Lines of a scene file, written so that they read back as what was meant.

use core::fmt::Write;

/// A scene file that grows.
#[derive(Debug, Default)]
pub(super) struct Text(pub(super) String);

impl Text {
    /// Starts with the comment that says what the scene is and which command made it, and with its header.
    pub(super) fn new(comment: &str, command: &str) -> Self {
        let mut text = Self::default();
        for line in comment.lines() {
            text.line(format!("# {line}").trim_end());
        }
        // A name of a file may hold anything; a comment ends with its line.
        let command: String =
            command.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
        text.line("#");
        text.line(&format!("# Made by `{command}`."));
        text
    }

    pub(super) fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    /// `[scene]`; duration [s].
    pub(super) fn scene(&mut self, name: &str, dimension: usize, duration: f64) {
        self.table("[scene]");
        self.key("name", &quoted(name));
        self.key("dimension", &dimension.to_string());
        let gravity = [0.0, 0.0, -9.81];
        self.key("gravity", &vector(&gravity[3 - dimension..]));
        self.key("duration", &number(duration));
    }

    /// The header of a table, after an empty line.
    pub(super) fn table(&mut self, header: &str) {
        self.0.push('\n');
        self.line(header);
    }

    /// `key = value`, the value as written.
    pub(super) fn key(&mut self, key: &str, value: &str) {
        // Writing into a String has nothing to fail on.
        let _ = writeln!(self.0, "{key} = {value}");
    }

    /// A uniform slender rod.
    pub(super) fn rod(&mut self, name: &str, [from, to]: [&[f64]; 2], mass: f64) {
        self.table("[[body]]");
        self.key("name", &quoted(name));
        self.key("rod", &format!("{{ from = {}, to = {} }}", vector(from), vector(to)));
        self.key("mass", &number(mass));
    }

    /// A spatial body.
    pub(super) fn body(&mut self, name: &str, mass: f64, center: [f64; 3], inertia: [f64; 6]) {
        self.table("[[body]]");
        self.key("name", &quoted(name));
        self.key("mass", &number(mass));
        self.key("center", &vector(&center));
        self.key("inertia", &vector(&inertia));
    }

    /// A joint at a place, without its axes.
    pub(super) fn joint(&mut self, name: &str, kind: &str, bodies: [&str; 2], at: &[f64]) {
        self.table("[[joint]]");
        self.key("name", &quoted(name));
        self.key("kind", &quoted(kind));
        self.key("bodies", &format!("[{}, {}]", quoted(bodies[0]), quoted(bodies[1])));
        self.key("at", &vector(at));
    }

    /// `[solver]` with a step [s].
    pub(super) fn step(&mut self, step: f64) {
        self.table("[solver]");
        self.key("step", &number(step));
    }

    /// The position of a body's point as a channel.
    pub(super) fn position(&mut self, name: &str, body: &str, at: &[f64]) {
        self.table("[[output]]");
        self.key("name", &quoted(name));
        self.key("body", &quoted(body));
        self.key("at", &vector(at));
        self.key("quantity", &quoted("position"));
    }
}

/// A number of 15 digits: multiples of decimal numbers stay as short as they are meant.
pub(super) fn number(x: f64) -> String {
    let rounded = format!("{x:.14e}").parse().unwrap_or(x);
    // No minus before a zero.
    format!("{:?}", rounded + 0.0)
}

/// Width of a bar over its length.
const SLENDER: f64 = 0.2;

/// Inertia of a uniform square bar of mass m [kg] from end to end [m], about its centre, as scene files have it:
/// It 1 + (Ia - It) u u^T, u along it.
pub(super) fn bar(mass: f64, d: [f64; 3]) -> [f64; 6] {
    let square: f64 = d.iter().map(|x| x * x).sum();
    let width = SLENDER * SLENDER * square;
    let (along, across) = (mass * width / 6.0, mass * (square + width) / 12.0);
    let entry = |i: usize, j: usize| {
        let dyad = (along - across) * d[i] * d[j] / square;
        if i == j { across + dyad } else { dyad }
    };
    [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)]
}

/// A list of numbers.
pub(super) fn vector(x: &[f64]) -> String {
    let numbers: Vec<String> = x.iter().map(|&x| number(x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// A text in quotes.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_decimal_numbers_stay_short() {
        assert_eq!([number(0.2 * 3.0), number(0.97 - 8.0), number(-0.0)], ["0.6", "-7.03", "0.0"]);
        assert_eq!(number(1e-7), "1e-7");
    }

    #[test]
    fn quotes_and_control_characters_in_names_are_escaped() {
        assert_eq!(quoted("a \"b\" \\ \n"), "\"a \\\"b\\\" \\\\ \\u000A\"");
    }
}
