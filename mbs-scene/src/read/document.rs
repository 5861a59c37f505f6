//! A scene file as read, before the scalar of the run is known.

use super::columns;
use super::include;
use super::syntax;
use super::texts::Texts;
use super::tree::{self, Item, Member, Node, Span};
use super::{Place, ReadError, ReadFault};
use std::path::Path;

/// A scene file: syntax tree, texts and name. Numbers are decimal text. The tree also has the parts of included files.
#[derive(Debug, Clone, Default)]
pub struct SceneFile {
    pub(crate) texts: Texts,
    pub(super) root: Vec<Member>,
}

impl SceneFile {
    /// Reads the text of a scene file; `file` is the name in messages. The text is JSON when it begins with `{` or when the file's name
    /// ends with `.json`. Otherwise it is TOML.
    ///
    /// # Errors
    /// [`ReadFault::Syntax`] when the text is not valid, and [`ReadFault::Include`] when it includes a file: a text alone has no folder.
    /// The entries of the text are checked later, by [`Self::scene`].
    pub fn parse(text: &str, file: &str) -> Result<Self, ReadError> {
        Self::parsed(text, file, None)
    }

    /// Reads the text of a scene file in a folder, with the files that it includes; see [`Self::parse`].
    ///
    /// # Errors
    /// The errors of [`Self::parse`], and those of the included files.
    pub fn parse_in(text: &str, file: &str, folder: &Path) -> Result<Self, ReadError> {
        Self::parsed(text, file, Some(folder))
    }

    /// Reads a text whose includes lie in a folder; `None`: includes are refused.
    fn parsed(text: &str, file: &str, folder: Option<&Path>) -> Result<Self, ReadError> {
        let mut texts = Texts::new(file, text, folder.map(Path::to_owned));
        let root = syntax::read(&texts, 0)?;
        let mut root = include::resolve(&mut texts, root, folder)?;
        columns::resolve(&mut texts, &mut root)?;
        Ok(Self { texts, root })
    }

    /// Reads the bytes of a scene file.
    ///
    /// # Errors
    /// [`ReadFault::NotUtf8`] with the place of the first invalid byte, and the errors of [`Self::parse`].
    pub fn from_bytes(bytes: &[u8], file: &str) -> Result<Self, ReadError> {
        Self::parse(utf8(bytes, file)?, file)
    }

    /// Reads the bytes of a scene file in a folder, with the files that it includes.
    ///
    /// # Errors
    /// The errors of [`Self::from_bytes`] and [`Self::parse_in`].
    pub fn from_bytes_in(bytes: &[u8], file: &str, folder: &Path) -> Result<Self, ReadError> {
        Self::parse_in(utf8(bytes, file)?, file, folder)
    }

    /// Name of the file that the caller gave to [`Self::parse`].
    #[must_use]
    pub fn file(&self) -> &str {
        &self.texts.main().name
    }

    /// The text of the file, without included files and without values of a command line: see [`Self::whole_text`].
    #[must_use]
    pub fn text(&self) -> &str {
        &self.texts.main().text
    }

    /// All texts of the scene, one after the other. Two scenes with equal texts are equal.
    #[must_use]
    pub fn whole_text(&self) -> String {
        let texts = self.texts.list().iter().map(|text| text.text.as_str());
        texts.collect::<Vec<_>>().join("\n")
    }

    /// Names of the files of the scene, as in messages: the scene file, then the files that it includes.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.texts.list().iter().filter(|text| text.is_file).map(|text| text.name.as_str())
    }

    pub(crate) fn error(&self, span: &Span, fault: ReadFault) -> ReadError {
        self.texts.error(span, fault)
    }

    /// Number of entries of a list of tables.
    pub(crate) fn count(&self, key: &str) -> usize {
        match self.top(key) {
            Some(Item { node: Node::List(items), .. }) => items.len(),
            _ => 0,
        }
    }

    /// The tree of the file, for paths into it.
    pub(crate) fn root(&self) -> &[Member] {
        &self.root
    }

    pub(crate) fn root_mut(&mut self) -> &mut [Member] {
        &mut self.root
    }

    pub(crate) fn top(&self, key: &str) -> Option<&Item> {
        tree::find(&self.root, key)
    }
}

fn utf8<'a>(bytes: &'a [u8], file: &str) -> Result<&'a str, ReadError> {
    core::str::from_utf8(bytes).map_err(|error| {
        let good = error.valid_up_to();
        let text = String::from_utf8_lossy(bytes);
        ReadError::new(file, Place::of(&text, &(good..good)), ReadFault::NotUtf8)
    })
}
