//! Reads the tree of a text, in TOML or JSON.

use super::texts::Texts;
use super::tree::{self, Member};
use super::{ReadError, ReadFault, json};
use std::path::Path;

/// The tree of the text that begins at byte `start`.
pub(super) fn read(texts: &Texts, start: usize) -> Result<Vec<Member>, ReadError> {
    let text = texts.of(&(start..start));
    let is_json = match Path::new(&text.name).extension().and_then(|ending| ending.to_str()) {
        Some("json") => true,
        Some("toml") => false,
        _ => text.text.trim_start().starts_with('{'),
    };
    let (format, tree) = match is_json {
        true => ("JSON", json::parse(&text.text)),
        false => ("TOML", tree::parse(&text.text)),
    };
    match tree {
        Ok(mut root) => {
            root.iter_mut().for_each(|member| member.move_spans(&|byte| start + byte));
            Ok(root)
        }
        Err((message, span)) => {
            let span = start + span.start..start + span.end;
            let line = texts.place(&span).1.text;
            Err(texts.error(&span, ReadFault::Syntax { format, message, line }))
        }
    }
}
