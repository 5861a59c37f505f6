//! Assignments `PATH=VALUE` of a command line, which replace or add values of a scene.

use super::fields::Read;
use super::sweep::path::{self, PathPart};
use super::texts::Text;
use super::tree::{self, Item, Member, Node, Span};
use super::{ReadFault, SceneFile, SweepFault};
use crate::keys::{self, FILE, KeyTable, KeyValue, Standing};

/// The name of an assignment's text in messages.
const NAME: &str = "--set";

impl SceneFile {
    /// The scene with another value at a path. Paths are those of sweeps: `body.rod.mass=2`, `parameter.k=36 kN/m`, `point.ball[2]=0.3`.
    /// The value is read as TOML; when it is not valid TOML, it is a text, such as a word or an expression. A key that the table may have
    /// is added.
    ///
    /// ```
    /// # let text = "[scene]\ndimension = 2\nduration = 1.0\n";
    /// let scene = mbs_scene::SceneFile::parse(text, "empty.toml")?;
    /// let longer = scene.with_set("scene.duration=2 min")?;
    /// assert_eq!(longer.scene::<f64>()?.duration, 120.0);
    /// # Ok::<(), mbs_scene::ReadError>(())
    /// ```
    ///
    /// # Errors
    /// A path that leads to no value, or a key that the format does not have, with the place in the assignment.
    pub fn with_set(&self, assignment: &str) -> Read<Self> {
        let mut file = self.clone();
        let start = file.note(assignment);
        let whole = start..start + assignment.len();
        let refused = |file: &Self, fault| Err(file.error(&whole, ReadFault::Sweep(fault)));
        let Some(at) = sign(assignment) else {
            return refused(&file, SweepFault::PathSyntax("`=` and a value are missing"));
        };
        let (path, value) = (&assignment[..at], &assignment[at + 1..]);
        let parts = match path::parse(path) {
            Ok(parts) => parts,
            Err(problem) => return refused(&file, SweepFault::PathSyntax(problem)),
        };
        let item = read(value, start + at + 1);
        let path_span = start..start + at;
        match path::found(&file.root, &parts) {
            Ok(address) => {
                if let Some(old) = path::item_mut(&mut file.root, &address) {
                    *old = item;
                }
            }
            Err(fault) => file.insert(&parts, item, &path_span, fault)?,
        }
        Ok(file)
    }

    /// Adds a text of a command line to the texts of the scene; returns the byte at which it begins.
    pub(super) fn note(&mut self, text: &str) -> usize {
        self.texts.add(Text { name: NAME.to_owned(), text: text.to_owned(), ..Text::default() })
    }

    /// Adds a key to a table that may have it. Otherwise returns the fault of its path.
    fn insert(
        &mut self,
        parts: &[PathPart],
        item: Item,
        span: &Span,
        fault: SweepFault,
    ) -> Read<()> {
        let refused = |file: &Self, fault| Err(file.error(span, ReadFault::Sweep(fault)));
        let [outer @ .., PathPart::Key(key)] = parts else { return refused(self, fault) };
        let [PathPart::Key(table), ..] = outer else { return refused(self, fault) };
        if outer.len() == 1 && self.top(table).is_none() && is_once(table) {
            let node = Node::Table(Vec::new());
            let item = Item { span: span.clone(), node };
            self.root.push(Member { key: table.clone(), key_span: span.clone(), item });
        }
        let Ok(address) = path::found(&self.root, outer) else { return refused(self, fault) };
        let tables = tables_at(outer);
        let kind = path::item(&self.root, &address).and_then(|item| item.text_at("kind"));
        let of_kind = kind.map_or(&[][..], |kind| keys::of_kind(tables, kind));
        let tables = if of_kind.is_empty() { tables } else { of_kind };
        let mut known: Vec<&'static str> = Vec::new();
        for key in tables.iter().flat_map(|table| &table.keys) {
            if !known.contains(&key.name) {
                known.push(key.name);
            }
        }
        match path::item_mut(&mut self.root, &address).map(|item| &mut item.node) {
            Some(Node::Table(members)) if known.contains(&key.as_str()) => {
                members.push(Member { key: key.clone(), key_span: span.clone(), item });
                Ok(())
            }
            Some(Node::Table(_)) if !known.is_empty() => {
                let key = key.clone();
                Err(self.error(span, ReadFault::UnknownKey { key, known }))
            }
            _ => refused(self, fault),
        }
    }
}

/// Position of the first `=` outside quotes.
fn sign(text: &str) -> Option<usize> {
    let mut quote = None;
    text.char_indices().find_map(|(i, c)| {
        match (quote, c) {
            (None, '=') => return Some(i),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
        None
    })
}

/// The value of a text that begins at byte `at` of the texts.
fn read(value: &str, at: usize) -> Item {
    /// Key that is put before the value, so that it can be read as TOML.
    const KEY: &str = "v=";
    let toml = tree::parse(&format!("{KEY}{value}")).ok();
    if let Some(Ok([mut member])) = toml.map(<[Member; 1]>::try_from) {
        member.item.move_spans(&|byte| byte + at - KEY.len());
        return member.item;
    }
    let text = value.trim();
    let start = at + value.len() - value.trim_start().len();
    Item { span: start..start + text.len(), node: Node::Text(text.to_owned()) }
}

/// True if the scene file may have the table only once.
fn is_once(table: &str) -> bool {
    let is_of_file = keys::of(FILE).iter().any(|file| file.key(table).is_some());
    is_of_file && keys::of(table).iter().any(|table| table.standing == Standing::Once)
}

/// The key tables of the table to which a path leads.
fn tables_at(parts: &[PathPart]) -> &'static [KeyTable] {
    let [PathPart::Key(table), rest @ ..] = parts else { return &[] };
    let mut tables = keys::of(table);
    let is_list = tables.first().is_some_and(|table| table.standing == Standing::Listed);
    // The first part after a list is the name or the index of an entry. It is skipped, since a name may equal the name of a key.
    for part in rest.iter().skip(usize::from(is_list)) {
        let PathPart::Key(name) = part else { continue };
        let key = tables.iter().find_map(|table| table.key(name));
        if let Some(
            KeyValue::Table(header)
            | KeyValue::Tables(header)
            | KeyValue::TableOrTables(header)
            | KeyValue::PlacesOrTables(header),
        ) = key.map(|key| &key.value)
        {
            tables = keys::of(header);
        }
    }
    tables
}
