//! Included files: their elements replace the `include` element.

use crate::beside::{Included, find};
use crate::context::Context;
use crate::element::Element;
use crate::source::Read;
use std::path::Path;

/// Replaces the `include` elements by the elements of other files.
pub(crate) fn include(root: &mut Element, context: &mut Context<'_>) -> Read<()> {
    Includer { context, included: Included::default() }.inside(root)
}

struct Includer<'a, 'c> {
    context: &'a mut Context<'c>,
    included: Included,
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

    /// The elements of an included file. Its path is relative to the folder of the first file, or else to the folder of the including file.
    fn file(&mut self, include: &Element) -> Read<Vec<Element>> {
        let file = include.need("file")?;
        let name = Path::new(file.value.trim());
        let path = find(file, name, self.included.folder(), self.context)?;
        let mut root = self.included.open(file, path, include.at, self.context)?;
        self.inside(&mut root)?;
        self.included.close();
        Ok(root.children)
    }
}
