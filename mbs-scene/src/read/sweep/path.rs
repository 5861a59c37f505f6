//! Paths to numbers of a scene: `table`, name or index of the entry, keys and indices.
//!
//! ```text
//! scene.gravity[1]                          a table, a key, an index from 0
//! body.crank.mass                           an entry by its name
//! effect."front left spring".stiffness      in quotes where a name has other characters than letters, digits, - and _
//! initial.pivot.rate                        [[initial]] and [[guide]] by the name of their joint or body
//! effect[2].points[0][1]                    an entry by its place in the file, from 0
//! joint.tie-rod.points.0.2                  indices with dots
//! parameter.length, point.ball[2]           a parameter, and a coordinate of a point
//! ```

use super::SweepFault;
use crate::read::SceneFile;
use crate::read::tree::{Item, Member, Node, Span};

/// Address of a number in the tree: the indices of the children from the root on.
pub(in crate::read) type Address = Vec<usize>;

/// A part of a path: a key or an index.
#[derive(Debug, Clone, PartialEq)]
pub enum PathPart {
    /// The name of a table, of an entry or of a key.
    Key(String),
    /// An index in a list, from 0.
    Index(usize),
}

impl PathPart {
    /// The index in a list, from `[2]` or `.2`.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Index(i) => Some(*i),
            Self::Key(key) => key.parse().ok(),
        }
    }
}

/// The address of the number that a path names. A text with an expression counts as a number.
pub(in crate::read) fn address(scene: &SceneFile, path: &str) -> Result<Address, SweepFault> {
    let parts = parse(path).map_err(SweepFault::PathSyntax)?;
    let (walk, item) = walked(scene.root(), &parts)?;
    match &item.node {
        Node::Number(_) if walk.at == "scene.dimension" => Err(SweepFault::Fixed),
        Node::Number(_) => Ok(walk.address),
        Node::Text(_) if scene.number_at(&walk.address).is_some() => Ok(walk.address),
        _ => Err(walk.not_a_number(item)),
    }
}

/// The address of the value that the parts of a path name, of any type.
pub(in crate::read) fn found(root: &[Member], parts: &[PathPart]) -> Result<Address, SweepFault> {
    Ok(walked(root, parts)?.0.address)
}

fn walked<'a>(root: &'a [Member], parts: &[PathPart]) -> Result<(Walk, &'a Item), SweepFault> {
    let mut walk = Walk { address: Vec::new(), at: String::new() };
    let mut parts = parts.iter();
    let Some(PathPart::Key(table)) = parts.next() else {
        return Err(SweepFault::PathSyntax("it begins with the name of a table"));
    };
    let table = if table == "parameter" { "parameters" } else { table };
    let mut item = walk.key(root, table)?;
    let mut is_entry = matches!(item.node, Node::List(_));
    for part in parts {
        if let (true, Node::Table(members), PathPart::Index(_)) =
            (table == "point", &item.node, part)
        {
            item = walk.key(members, "at")?;
        }
        item = match (&item.node, part) {
            (Node::List(items), PathPart::Key(name)) if is_entry => {
                walk.entry(items, table, name)?
            }
            (Node::List(items), part) if part.index().is_some() => {
                walk.index(items, part.index().unwrap_or_default())?
            }
            (Node::Table(members), PathPart::Key(key)) => walk.key(members, key)?,
            _ => return Err(walk.not_a_number(item)),
        };
        is_entry = false;
    }
    Ok((walk, item))
}

/// The bytes of the value at an address, in the texts of the scene.
pub(in crate::read) fn span(root: &[Member], address: &[usize]) -> Option<Span> {
    Some(item(root, address)?.span.clone())
}

/// The value at an address, for reading.
pub(in crate::read) fn item<'a>(root: &'a [Member], address: &[usize]) -> Option<&'a Item> {
    let (first, rest) = address.split_first()?;
    let mut item = &root.get(*first)?.item;
    for &i in rest {
        item = match &item.node {
            Node::List(items) => items.get(i)?,
            Node::Table(members) => &members.get(i)?.item,
            _ => return None,
        };
    }
    Some(item)
}

/// Replaces the text of the number at an address.
pub(in crate::read) fn replace(root: &mut [Member], address: &[usize], number: String) {
    if let Some(item) = item_mut(root, address) {
        item.node = Node::Number(number);
    }
}

/// The value at an address, for changing.
pub(in crate::read) fn item_mut<'a>(
    root: &'a mut [Member],
    address: &[usize],
) -> Option<&'a mut Item> {
    let (first, rest) = address.split_first()?;
    let mut item = &mut root.get_mut(*first)?.item;
    for &i in rest {
        item = match &mut item.node {
            Node::List(items) => items.get_mut(i)?,
            Node::Table(members) => &mut members.get_mut(i)?.item,
            _ => return None,
        };
    }
    Some(item)
}

/// The parts of a path, in order.
///
/// # Errors
/// Message that says what is wrong, as a clause.
pub fn parse(path: &str) -> Result<Vec<PathPart>, &'static str> {
    let mut parts = Vec::new();
    let mut rest = path.trim();
    loop {
        let (key, after) = word(rest)?;
        parts.push(PathPart::Key(key));
        rest = after;
        while let Some(inside) = rest.strip_prefix('[') {
            let (digits, after) = inside.split_once(']').ok_or("a bracket is not closed")?;
            let index = digits.trim().parse().map_err(|_| "a bracket holds an index from 0")?;
            parts.push(PathPart::Index(index));
            rest = after;
        }
        match rest.strip_prefix('.') {
            Some(after) => rest = after,
            None if rest.is_empty() => return Ok(parts),
            None => return Err("a dot or a bracket is missing"),
        }
    }
}

/// A word with or without quotes, and the text after it.
fn word(text: &str) -> Result<(String, &str), &'static str> {
    for quote in ['"', '\''] {
        if let Some(inside) = text.strip_prefix(quote) {
            let (word, rest) = inside.split_once(quote).ok_or("a quote is not closed")?;
            return Ok((word.to_owned(), rest));
        }
    }
    let is_bare = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    let end = text.find(|c| !is_bare(c)).unwrap_or(text.len());
    match end {
        0 => Err("a word is missing; names with other characters stand in quotes"),
        _ => Ok((text[..end].to_owned(), &text[end..])),
    }
}

/// A walk along a path: the address found so far, and its text.
struct Walk {
    address: Address,
    at: String,
}

impl Walk {
    fn key<'a>(&mut self, members: &'a [Member], key: &str) -> Result<&'a Item, SweepFault> {
        let Some(i) = members.iter().position(|member| member.key == key) else {
            let known = members.iter().map(|member| member.key.clone()).collect();
            return Err(SweepFault::NoKey { at: self.at.clone(), key: key.to_owned(), known });
        };
        self.address.push(i);
        let dot = if self.at.is_empty() { "" } else { "." };
        self.at += &format!("{dot}{key}");
        Ok(&members[i].item)
    }

    fn index<'a>(&mut self, items: &'a [Item], index: usize) -> Result<&'a Item, SweepFault> {
        let Some(item) = items.get(index) else {
            return Err(SweepFault::NoIndex { at: self.at.clone(), index, count: items.len() });
        };
        self.address.push(index);
        self.at += &format!("[{index}]");
        Ok(item)
    }

    fn entry<'a>(
        &mut self,
        items: &'a [Item],
        table: &str,
        name: &str,
    ) -> Result<&'a Item, SweepFault> {
        let names: Vec<String> =
            items.iter().enumerate().map(|(i, e)| called(e, table, i)).collect();
        let entries: Vec<usize> = (0..items.len()).filter(|&i| names[i] == name).collect();
        let table = table.to_owned();
        match entries[..] {
            [i] => {
                self.address.push(i);
                self.at += &format!(".{name}");
                Ok(&items[i])
            }
            [] => Err(SweepFault::NoEntry { table, name: name.to_owned(), known: names }),
            _ => Err(SweepFault::Ambiguous { table, entries }),
        }
    }

    /// The fault of a path that leads to something other than a number, with advice on how to continue it.
    fn not_a_number(&self, item: &Item) -> SweepFault {
        let at = &self.at;
        let advice = match &item.node {
            Node::List(items) => match items.len() {
                0 => "name another place".to_owned(),
                n => format!("add an index, from {at}[0] to {at}[{}]", n - 1),
            },
            Node::Table(members) => match members.first() {
                Some(member) => format!("add a key, such as {at}.{}", member.key),
                None => "name another place".to_owned(),
            },
            Node::Number(_) => format!("end the path at {at}"),
            _ => "name a number".to_owned(),
        };
        SweepFault::NotANumber { at: at.clone(), found: item.node.description(), advice }
    }
}

/// Name of an entry in a path: the entry's own name, or for `[[initial]]` and `[[guide]]` the name of the joint or body. An entry without a
/// name is numbered, as in the scene's outputs.
fn called(item: &Item, table: &str, index: usize) -> String {
    let keys: &[&str] =
        if matches!(table, "initial" | "guide") { &["joint", "body"] } else { &["name"] };
    let name = keys.iter().find_map(|key| item.text_at(key));
    name.map_or_else(|| format!("{table}-{}", index + 1), str::to_owned)
}
