//! Mutated texts of scenes: numbers, words and lines are replaced, moved, doubled or copied from another text.

use mbs::scene_file::Dice;

/// Numbers that programs often handle wrongly.
const NUMBERS: [&str; 24] = [
    "0.0",
    "-0.0",
    "1.0",
    "-1.0",
    "1e-300",
    "-1e-300",
    "5e-324",
    "1e300",
    "-1e300",
    "1e308",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "1e-16",
    "1e16",
    "0",
    "-1",
    "9223372036854775807",
    "99999999999999999999",
    "1e-8",
    "1e8",
    "3.141592653589793",
    "0x10",
];
/// Largest number of mutations of a text. Chosen, not tuned.
const MAX_MUTATIONS: usize = 4;

/// Applies a few mutations to a text. Lines may come from the corpus.
#[must_use]
pub(crate) fn mutated(text: &str, corpus: &[String], dice: &mut Dice) -> String {
    let mut text = text.to_owned();
    for _ in 0..=dice.below(MAX_MUTATIONS) {
        text = match dice.below(8) {
            0..=3 => number(&text, dice),
            4 => word(&text, dice),
            5 => character(&text, dice),
            6 => lines(&text, dice),
            _ => borrowed(&text, corpus, dice),
        };
    }
    text
}

/// Positions of the pieces of a text whose characters pass a test, as ranges of bytes.
fn pieces(text: &str, is_part: impl Fn(char) -> bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut begin = None;
    for (i, c) in text.char_indices().chain([(text.len(), '\n')]) {
        match (is_part(c), begin) {
            (true, None) => begin = Some(i),
            (false, Some(from)) => {
                found.push((from, i));
                begin = None;
            }
            _ => {}
        }
    }
    found
}

fn replaced(text: &str, (from, to): (usize, usize), by: &str) -> String {
    [&text[..from], by, &text[to..]].concat()
}

/// Replaces one number by a difficult one, or by the same number scaled, negated or changed slightly.
fn number(text: &str, dice: &mut Dice) -> String {
    let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let mut places = pieces(text, is_part);
    places.retain(|&(from, to)| text[from..to].parse::<f64>().is_ok());
    if places.is_empty() {
        return text.to_owned();
    }
    let place = *dice.one_of(&places);
    let was = text[place.0..place.1].parse::<f64>().unwrap_or_default();
    let by = match dice.below(6) {
        0 | 1 => (*dice.one_of(&NUMBERS)).to_owned(),
        2 => format!("{:e}", -was),
        3 => format!("{:e}", was * 10_f64.powf(dice.between(-9.0, 9.0))),
        4 => format!("{:e}", was * (1.0 + dice.between(-1e-9, 1e-9))),
        _ => {
            let other = *dice.one_of(&places);
            text[other.0..other.1].to_owned()
        }
    };
    replaced(text, place, &by)
}

/// Replaces one word by another word of the text.
fn word(text: &str, dice: &mut Dice) -> String {
    let places = pieces(text, |c| c.is_ascii_alphabetic() || c == '-' || c == '_');
    if places.is_empty() {
        return text.to_owned();
    }
    let (place, other) = (*dice.one_of(&places), *dice.one_of(&places));
    replaced(text, place, &text[other.0..other.1])
}

/// Removes, doubles or replaces one character.
fn character(text: &str, dice: &mut Dice) -> String {
    let places: Vec<(usize, char)> = text.char_indices().collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let &(at, c) = dice.one_of(&places);
    let by = match dice.below(3) {
        0 => String::new(),
        1 => format!("{c}{c}"),
        _ => {
            dice.one_of(&['[', ']', '"', '=', ',', '\n', '{', '}', '#', 'é', '\0', '-']).to_string()
        }
    };
    replaced(text, (at, at + c.len_utf8()), &by)
}

/// Removes or doubles one line, or exchanges it with another.
fn lines(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return text.to_owned();
    }
    let (a, b) = (dice.below(lines.len()), dice.below(lines.len()));
    match dice.below(3) {
        0 => drop(lines.remove(a)),
        1 => lines.insert(b, lines[a]),
        _ => lines.swap(a, b),
    }
    lines.join("\n") + "\n"
}

/// Appends a table of another text.
fn borrowed(text: &str, corpus: &[String], dice: &mut Dice) -> String {
    if corpus.is_empty() {
        return text.to_owned();
    }
    let other = dice.one_of(corpus);
    let tables: Vec<usize> = other.match_indices("\n[").map(|(i, _)| i + 1).collect();
    if tables.is_empty() {
        return text.to_owned();
    }
    let from = *dice.one_of(&tables);
    let to = tables.into_iter().find(|&i| i > from).unwrap_or(other.len());
    format!("{text}\n{}", &other[from..to])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_the_same_text_and_another_seed_another() {
        let corpus = vec!["[scene]\nname = \"x\"\n\n[[body]]\nmass = 1.5\n".to_owned()];
        let text = |seed| mutated(&corpus[0], &corpus, &mut Dice::new(seed));
        assert_eq!(text(7), text(7));
        let different = (0..50).filter(|&seed| text(seed) != corpus[0]).count();
        assert!(different > 40, "{different} of 50");
    }

    #[test]
    fn mutations_leave_no_text_that_is_none() {
        // characters of several bytes must not be cut
        let corpus = vec!["name = \"é ü ∂\"\nx = [1.0, -2e3]\n".to_owned(), String::new()];
        for seed in 0..2000 {
            let mut dice = Dice::new(seed);
            let text = dice.one_of(&corpus).clone();
            let _ = mutated(&text, &corpus, &mut dice);
        }
    }
}
