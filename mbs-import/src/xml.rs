//! Reader of XML that keeps the place of every element and attribute.

use crate::element::{Attribute, Element};
use crate::source::{Fault, Origin, Read};
use roxmltree::{Document, Node, ParsingOptions, TextPos};

/// Largest number of elements, attributes and texts of a file [-]. Each takes about a hundred bytes.
const MOST_NODES: u32 = 1_000_000;
/// Largest depth of elements [-], since later walks are recursive. Published models have a depth of at most 40.
const MOST_LEVELS: usize = 512;
/// Largest number of namespace prefixes that a file may use without a declaration [-].
const MOST_PREFIXES: usize = 64;

/// Text for the XML parser: leading bytes of the file are removed, and declarations of prefixes are inserted.
struct Edited {
    text: String,
    /// Number of bytes of the file before the text.
    skipped: usize,
    /// Byte at which declarations are inserted, and their length.
    inserted: (usize, usize),
    source: u16,
}

/// Parses the text with the index `source`, and returns its root element.
pub(crate) fn read(text: &str, source: u16) -> Read<Element> {
    let trimmed = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    let skipped = text.len() - trimmed.len();
    let at = after_root_name(trimmed);
    let mut edited = Edited { text: trimmed.to_owned(), skipped, inserted: (at, 0), source };
    for _ in 0..MOST_PREFIXES {
        let options = ParsingOptions {
            allow_dtd: false,
            nodes_limit: MOST_NODES,
            ..ParsingOptions::default()
        };
        match Document::parse_with_options(&edited.text, options) {
            Ok(document) => return edited.tree(document.root_element()),
            Err(roxmltree::Error::UnknownNamespace(prefix, _)) if at > 0 => {
                let declaration = format!(" xmlns:{prefix}=\"{prefix}\"");
                edited.text.insert_str(at, &declaration);
                edited.inserted.1 += declaration.len();
            }
            Err(error) => return Err(edited.refusal(&error)),
        }
    }
    Err(Fault::new(
        Origin::start_of(source),
        format!("more than {MOST_PREFIXES} prefixes of names are not declared"),
        "declare them in the root element: xmlns:NAME=\"...\"",
    ))
}

/// The byte after the name of the root element; 0 when there is none.
fn after_root_name(text: &str) -> usize {
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        let open = at + found;
        let rest = &text[open + 1..];
        let skip_to = |end: &str| rest.find(end).map_or(text.len(), |i| open + 1 + i + end.len());
        at = if rest.starts_with("!--") {
            skip_to("-->")
        } else if rest.starts_with(['?', '!']) {
            skip_to(">")
        } else {
            let name = rest.find(|c: char| c.is_whitespace() || c == '>' || c == '/');
            return name.map_or(0, |n| open + 1 + n);
        };
    }
    0
}

impl Edited {
    /// The place in the file of a range of the edited text.
    fn origin(&self, range: std::ops::Range<usize>) -> Origin {
        let (at, length) = self.inserted;
        let back = |x: usize| {
            let before = if x <= at { x } else { at.max(x.saturating_sub(length)) };
            u32::try_from(before + self.skipped).unwrap_or(u32::MAX)
        };
        Origin { source: self.source, start: back(range.start), end: back(range.end) }
    }

    /// The byte of a line and a column, both from 1.
    fn byte(&self, pos: TextPos) -> usize {
        let line =
            self.text.split_inclusive('\n').take(pos.row as usize - 1).map(str::len).sum::<usize>();
        let column = self.text[line..].char_indices().nth(pos.col as usize - 1);
        column.map_or(self.text.len(), |(i, _)| line + i)
    }

    fn refusal(&self, error: &roxmltree::Error) -> Fault {
        let byte = match error {
            // The missing end tag is reported at the end of the text, not at the place of the parser.
            roxmltree::Error::UnclosedRootNode => self.text.trim_end().len(),
            _ => self.byte(error.pos()),
        };
        let at = self.origin(byte..byte + 1);
        match error {
            roxmltree::Error::DtdDetected => Fault::new(
                at,
                "document types and entities are not read",
                "delete the `<!DOCTYPE ...>`, and write what its entities stand for",
            ),
            roxmltree::Error::NodesLimitReached => Fault::new(
                Origin::start_of(self.source),
                format!("more than {MOST_NODES} elements and attributes"),
                "give a model, or a part of it, in a smaller file",
            ),
            other => {
                // The parser's message ends with its own place, which does not account for the insertions.
                let text = other.to_string();
                let message =
                    text.rsplit_once(" at ").map_or(text.as_str(), |(message, _)| message);
                Fault::new(
                    at,
                    format!("not XML: {message}"),
                    "give a file that an XML reader takes",
                )
            }
        }
    }

    /// Converts the elements without recursion, since a file can have very deep elements.
    fn tree(&self, root: Node<'_, '_>) -> Read<Element> {
        let mut open = vec![self.element(root)];
        let mut walk = vec![root.children()];
        loop {
            let next = walk.last_mut().and_then(Iterator::next);
            match next {
                Some(node) if node.is_element() => {
                    let element = self.element(node);
                    if walk.len() == MOST_LEVELS {
                        let message =
                            format!("elements within elements, more than {MOST_LEVELS} deep");
                        return Err(Fault::new(
                            element.at,
                            message,
                            "give a model: those have about ten levels",
                        ));
                    }
                    open.push(element);
                    walk.push(node.children());
                }
                Some(node) => {
                    if let (Some(element), Some(text)) =
                        (open.last_mut(), node.text().filter(|_| node.is_text()))
                    {
                        element.text.push_str(text);
                    }
                }
                None => {
                    walk.pop();
                    let done = open.pop();
                    match (done, open.last_mut()) {
                        (Some(done), Some(outer)) => outer.children.push(done),
                        (Some(done), None) => return Ok(done),
                        (None, _) => unreachable!("an element is open for every walk"),
                    }
                }
            }
        }
    }

    fn element(&self, node: Node<'_, '_>) -> Element {
        let start = node.range().start;
        let tag = node.tag_name();
        let name = self.full_name(node, tag.namespace(), tag.name());
        let at = self.origin(start..start + 1 + name.len());
        let attributes = node.attributes().map(|attribute| {
            let name = self.full_name(node, attribute.namespace(), attribute.name());
            Attribute::new(name, attribute.value().to_owned(), self.origin(attribute.range()))
        });
        Element::new(name, at, attributes.collect())
    }

    fn full_name(&self, node: Node<'_, '_>, space: Option<&str>, name: &str) -> String {
        let prefix = space.and_then(|space| node.lookup_prefix(space));
        prefix.map_or_else(|| name.to_owned(), |prefix| format!("{prefix}:{name}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Sources;

    fn refused(text: &str) -> (usize, usize, String) {
        let mut sources = Sources::default();
        let source = sources.add("x", text, None);
        let fault = read(text, source).expect_err("refused");
        let place = sources.place(fault.at);
        (place.line, place.column, fault.message)
    }

    #[test]
    fn undeclared_prefixes_are_read_and_places_stay_those_of_the_file() {
        let text = "\u{feff}\n  <robot name='a'><drake:joint x:type='b'/>\n<link></robot>";
        assert_eq!(refused(text), (3, 7, "not XML: expected 'link' tag, not 'robot'".into()));
        let root = read(&text.replace("<link>", ""), 0).expect("read");
        assert_eq!(root.children[0].name, "drake:joint");
        assert_eq!(root.children[0].attribute("x:type").map(|a| a.value.as_str()), Some("b"));
        assert_eq!(root.children[0].at.start, 3 + 1 + 2 + 16);
    }

    #[test]
    fn entities_and_endless_levels_are_refused_with_their_place() {
        let bomb = "<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'c'>]><robot>&b;</robot>";
        assert_eq!(refused(bomb).2, "document types and entities are not read");
        let deep = format!("{}{}", "<a>".repeat(100_000), "</a>".repeat(100_000));
        assert_eq!(
            refused(&deep),
            (1, 1 + 3 * MOST_LEVELS, "elements within elements, more than 512 deep".into())
        );
    }
}
