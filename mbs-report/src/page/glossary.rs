//! Glossary terms of a page, from the text of the glossary. A test checks that docs/GLOSSARY.md has the same text.

use crate::text::escape;
use core::fmt::Write;

/// Glossary as Markdown: one paragraph for each term, with the term in bold at its beginning.
const GLOSSARY: &str = include_str!("glossary.md");

/// Writes the glossary terms that occur in a part of a page as a folded list. Writes nothing if no term occurs.
pub(super) fn write_used(body: &str, out: &mut String) {
    let text = plain(body);
    let paragraphs = GLOSSARY.split("\n\n").filter_map(|paragraph| {
        let (term, meaning) = paragraph.trim().strip_prefix("**")?.split_once("**")?;
        let is_used = names(paragraph).any(|name| has_word(&text, &name));
        is_used.then_some((term.trim_end_matches('.'), meaning.trim()))
    });
    let mut terms = String::new();
    for (term, meaning) in paragraphs {
        // writing to a String cannot fail
        let _ = writeln!(terms, "<dt>{}</dt><dd>{}</dd>", escape(term), inline(meaning));
    }
    if !terms.is_empty() {
        let _ = writeln!(
            out,
            "<details class=\"card\"><summary>Glossary</summary><dl class=\"terms\">\n{terms}</dl></details>"
        );
    }
}

/// Returns the words that a paragraph explains: all bold ones, in lower case.
fn names(paragraph: &str) -> impl Iterator<Item = String> {
    let bold = paragraph.split("**").skip(1).step_by(2);
    let names = bold.flat_map(|names| names.trim_end_matches('.').split(", "));
    names.map(|name| name.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase())
}

/// Returns the text between the tags of a page, in lower case.
fn plain(html: &str) -> String {
    let pieces = html.split('<').map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text));
    pieces.collect::<Vec<_>>().join(" ").to_lowercase()
}

/// True if a text contains a word or its plural.
fn has_word(text: &str, word: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '-');
    text.match_indices(word).any(|(at, _)| {
        let after = &text[at + word.len()..];
        let after = after.strip_prefix('s').unwrap_or(after);
        !is_letter(text[..at].chars().next_back()) && !is_letter(after.chars().next())
    })
}

/// Converts a paragraph to HTML: bold words, code, and the text of links (the linked files are not part of a page).
fn inline(paragraph: &str) -> String {
    let mut text = String::new();
    for (i, piece) in paragraph.split('[').enumerate() {
        match piece.split_once("](").and_then(|(name, rest)| Some((name, rest.split_once(')')?.1)))
        {
            Some((name, rest)) if i > 0 => text += &format!("{name}{rest}"),
            _ => text += piece,
        }
    }
    let mut html = escape(&text.replace('\n', " "));
    for (mark, [open, close]) in [("**", ["<b>", "</b>"]), ("`", ["<code>", "</code>"])] {
        let pieces: Vec<_> = html.split(mark).collect();
        let joined = pieces.iter().enumerate().map(|(i, piece)| match i {
            0 => (*piece).to_owned(),
            i if i % 2 == 1 => format!("{open}{piece}"),
            _ => format!("{close}{piece}"),
        });
        html = joined.collect();
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_glossary_of_the_documents_is_that_of_pages() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/GLOSSARY.md");
        if std::env::var_os("MBS_WRITE_DOCS").is_some() {
            std::fs::write(path, GLOSSARY).expect("it is written");
        }
        let document = std::fs::read_to_string(path).expect("it is there");
        assert!(document == GLOSSARY, "MBS_WRITE_DOCS=1 writes it from src/page/glossary.md");
    }

    #[test]
    fn a_page_has_the_terms_that_it_uses_and_no_others() {
        let used = |body: &str| {
            let mut out = String::new();
            write_used(body, &mut out);
            out
        };
        let found = used("<td class=\"guide\">Redundant constraints</td> by <b>index-3</b>");
        for term in ["Constraints", "Redundant", "index-3, index-1"] {
            assert!(found.contains(&format!("<dt>{term}</dt>")), "{term}: {found}");
        }
        // words in class names and parts of words do not count
        assert_eq!(found.matches("<dt>").count(), 3, "{found}");
        assert!(!found.contains("**") && !found.contains('`') && !found.contains(".md"));
        assert_eq!(used("<p>nothing of it</p>"), "");
        // the whole glossary has at most six kilobytes
        assert!(used(&inline(GLOSSARY)).len() < 6000, "{}", used(&inline(GLOSSARY)).len());
    }
}
