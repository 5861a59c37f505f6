//! A scene file as read, before the precision of the run is known.

use crate::read::tree::{self, Item, Member, Node, Span};
use crate::read::{Place, ReadError, ReadFault};

/// A scene file: syntax tree, text and name. Numbers are decimal text.
#[derive(Debug, Clone, Default)]
pub struct SceneFile {
    pub(super) file: String,
    pub(super) text: String,
    pub(super) root: Vec<Member>,
}

impl SceneFile {
    /// Reads the text of a scene file; `file` is the name that messages show.
    ///
    /// # Errors
    /// [`ReadFault::Syntax`] when the text is not TOML. What the text means is read by [`Self::scene`].
    pub fn parse(text: &str, file: &str) -> Result<Self, ReadError> {
        match tree::parse(text) {
            Ok(root) => Ok(Self { file: file.to_owned(), text: text.to_owned(), root }),
            Err((message, span)) => {
                let place = Place::of(text, &span);
                let fault = ReadFault::Syntax { message, line: place.text.clone() };
                Err(ReadError::new(file, place, fault))
            }
        }
    }

    /// Reads the bytes of a scene file.
    ///
    /// # Errors
    /// [`ReadFault::NotUtf8`] with the place of the first bad byte, and those of [`Self::parse`].
    pub fn from_bytes(bytes: &[u8], file: &str) -> Result<Self, ReadError> {
        match core::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text, file),
            Err(error) => {
                let good = error.valid_up_to();
                let text = String::from_utf8_lossy(bytes);
                let place = Place::of(&text, &(good..good));
                Err(ReadError::new(file, place, ReadFault::NotUtf8))
            }
        }
    }

    /// The file as it was named to [`Self::parse`].
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The text of the file.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn error(&self, span: &Span, fault: ReadFault) -> ReadError {
        ReadError::new(&self.file, Place::of(&self.text, span), fault)
    }

    /// Entries of a list of tables.
    pub(crate) fn count(&self, key: &str) -> usize {
        match self.top(key) {
            Some(Item { node: Node::List(items), .. }) => items.len(),
            _ => 0,
        }
    }

    /// The tree, for paths into it.
    pub(crate) fn root(&self) -> &[Member] {
        &self.root
    }

    pub(crate) fn root_mut(&mut self) -> &mut [Member] {
        &mut self.root
    }

    pub(crate) fn top(&self, key: &str) -> Option<&Item> {
        self.root.iter().find(|member| member.key == key).map(|member| &member.item)
    }
}
