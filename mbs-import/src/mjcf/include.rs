//! Files that a file includes: their elements stand where the `include` stood.

use super::path;
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::source::{Fault, MOST_BYTES, Read};
use crate::xml;
use std::path::{Path, PathBuf};

/// Files that include each other, one in the other.
const MAX_DEPTH: usize = 32;
/// Files that a model includes in all.
const MAX_FILES: usize = 1_000;

/// Puts the elements of other files in the places of `include` elements.
pub(crate) fn include(root: &mut Element, context: &mut Context<'_>) -> Read<()> {
    let mut includer =
        Includer { context, chain: Vec::new(), folders: Vec::new(), files: 0, bytes: 0 };
    includer.inside(root)
}

struct Includer<'a, 'c> {
    context: &'a mut Context<'c>,
    /// The files that are open now.
    chain: Vec<PathBuf>,
    /// Their folders.
    folders: Vec<PathBuf>,
    files: usize,
    bytes: u64,
}

impl Includer<'_, '_> {
    fn inside(&mut self, element: &mut Element) -> Read<()> {
        for mut child in std::mem::take(&mut element.children) {
            if child.name == "include" {
                element.children.extend(self.file(&child)?);
            } else {
                self.inside(&mut child)?;
                element.children.push(child);
            }
        }
        Ok(())
    }

    /// The elements of an included file.
    fn file(&mut self, include: &Element) -> Read<Vec<Element>> {
        let file = include.need("file")?;
        let path = self.path(file)?;
        if self.chain.contains(&path) {
            let names: Vec<_> = self.chain.iter().map(|path| path.display().to_string()).collect();
            let message = format!("`{}` includes itself: {}", file.value, names.join(" includes "));
            return Err(file.fault(message, "leave out one of these includes"));
        }
        self.files += 1;
        if self.chain.len() == MAX_DEPTH || self.files > MAX_FILES {
            let message =
                format!("more than {MAX_DEPTH} files in each other, or {MAX_FILES} files in all");
            return Err(file.fault(message, "put the elements into fewer files"));
        }
        let text = self.text(&path, file)?;
        let source = self.context.sources.add(&path.display().to_string(), &text, Some(include.at));
        let mut root = xml::read(&text, source)?;
        self.folders.push(path.parent().unwrap_or(Path::new("")).to_owned());
        self.chain.push(path);
        self.inside(&mut root)?;
        self.chain.pop();
        self.folders.pop();
        Ok(root.children)
    }

    /// Where a file is: looked for from the first file's folder, then from that of the file that includes it.
    fn path(&self, file: &Attribute) -> Read<PathBuf> {
        let last: Vec<&Path> = self.folders.last().map(PathBuf::as_path).into_iter().collect();
        path::find(file, Path::new(file.value.trim()), &last, self.context)
    }

    fn text(&mut self, path: &Path, file: &Attribute) -> Read<String> {
        let fault = |message: String, hint: &str| -> Fault { file.fault(message, hint) };
        let unread = |error: std::io::Error| {
            fault(format!("`{}` cannot be read: {error}", file.value), "give it to be read")
        };
        self.bytes += std::fs::metadata(path).map_err(unread)?.len();
        if self.bytes > MOST_BYTES as u64 {
            let message = format!("included files have more than {} MB", MOST_BYTES >> 20);
            return Err(fault(message, "give a smaller model"));
        }
        let bytes = std::fs::read(path).map_err(unread)?;
        String::from_utf8(bytes).map_err(|_| {
            fault(format!("`{}` is not UTF-8 text", file.value), "save the file as UTF-8")
        })
    }
}
