//! Reads `[[include]]`: the parts of other files are added to the tree of a scene.
//!
//! The names of an included file get a prefix, and so do the references to them. A name that the included file does not define is looked up
//! in the file that includes it. The parts of an included file are inserted at the place of its `[[include]]`.

use super::ReadFault;
use super::error::{ExpressionFault, Read};
use super::fields::Context;
use super::names::Names;
use super::nearest::nearest_name;
use super::prefix::Prefix;
use super::texts::{Text, Texts};
use super::tree::{Item, Member, Node, Span};
use super::values::Values;
use crate::keys::{self, FILE, KeyValue};
use std::collections::HashMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Largest depth of files that include one another [-]. Chosen, not tuned.
const MAX_DEPTH: usize = 8;
/// Largest total length of the texts of a scene with included files [bytes]. Chosen, not tuned.
const MOST_BYTES: usize = 64 << 20;
/// Largest number of files of a scene [-], each counted as often as it is included. Chosen, not tuned.
const MOST_FILES: usize = 10_000;

/// The tree of a scene with the files that it includes. Their paths are relative to `folder`.
pub(super) fn resolve(
    texts: &mut Texts,
    root: Vec<Member>,
    folder: Option<&Path>,
) -> Read<Vec<Member>> {
    let Some(member) = root.iter().find(|member| member.key == "include") else {
        return Ok(root);
    };
    let Some(folder) = folder else {
        let hint = "write the parts themselves, or read the scene from its file";
        let message = "a text that is no file lies in no folder, and includes nothing".to_owned();
        let fault = ReadFault::Include(ExpressionFault { message, hint: hint.to_owned() });
        return Err(texts.error(&member.item.span, fault));
    };
    let chain = Path::new(&texts.main().name).canonicalize().into_iter().collect();
    Includes { texts, chain }.expanded(root, folder)
}

/// Reader of the included files, at any depth.
struct Includes<'a> {
    texts: &'a mut Texts,
    /// Paths of the files from the scene file to the one that is read, as the system names them.
    chain: Vec<PathBuf>,
}

/// An entry `[[include]]` of a file.
struct Include {
    file: String,
    file_span: Span,
    prefix: String,
    set: Vec<Member>,
    /// Bytes of the whole entry.
    span: Span,
}

impl Includes<'_> {
    /// The tree of a file in a folder, with all its included files.
    fn expanded(&mut self, mut root: Vec<Member>, folder: &Path) -> Read<Vec<Member>> {
        let Some(at) = root.iter().position(|member| member.key == "include") else {
            return Ok(root);
        };
        let list = root.remove(at).item;
        let includes = self.entries(&list)?;
        let mut merge = Merge { root, before: HashMap::new() };
        for include in includes {
            let parts = self.parts(&include, folder)?;
            for member in parts {
                merge
                    .add(member, include.span.start)
                    .or_else(|(span, fault)| self.fault(&span, fault))?;
            }
        }
        Ok(merge.root)
    }

    fn fault<R>(&self, span: &Span, fault: ReadFault) -> Read<R> {
        Err(self.texts.error(span, fault))
    }

    fn refused<R>(&self, span: &Span, message: String, hint: &str) -> Read<R> {
        let hint = hint.to_owned();
        self.fault(span, ReadFault::Include(ExpressionFault { message, hint }))
    }

    /// Reads the entries of the list `[[include]]`.
    fn entries(&self, list: &Item) -> Read<Vec<Include>> {
        let values = Values::none(self.texts);
        let names = Names::default();
        let context = Context::of_file(self.texts, &values, &names);
        let form = "a list of tables, each under a header in double brackets: [[include]]";
        let read = |item| {
            let fields = context.table(item, "a table: [[include]]", "include")?;
            let file = fields.need("file")?;
            let prefix = fields.get("prefix").map_or(Ok(""), |item| context.text(item))?;
            let set = match fields.get("set").map(|item| (&item.node, item)) {
                None => Vec::new(),
                Some((Node::Table(members), _)) => members.clone(),
                Some((_, item)) => {
                    let expected = "a table of parameters: { length = 0.4 }";
                    let found = item.node.description();
                    return context.fault(&item.span, ReadFault::WrongType { expected, found });
                }
            };
            Ok(Include {
                file: context.text(file)?.to_owned(),
                file_span: file.span.clone(),
                prefix: prefix.to_owned(),
                set,
                span: item.span.clone(),
            })
        };
        context.list(list, form)?.iter().map(read).collect()
    }

    /// The tree of an included file: with its own includes, new values of its parameters, and its prefix.
    fn parts(&mut self, include: &Include, folder: &Path) -> Read<Vec<Member>> {
        let path = folder.join(&include.file);
        let place = self.enter(&path, include)?;
        let text = self.read(&path, include)?;
        let outer = &self.texts.of(&include.span).prefix;
        let prefix = format!("{outer}{}", include.prefix);
        let by = Some(include.span.clone());
        let name = path.display().to_string();
        let home = path.parent().unwrap_or(folder).to_owned();
        let folder = Some(home.clone());
        let text = Text { name, text, prefix, by, is_file: true, folder, ..Text::default() };
        let start = self.texts.add(text);
        let root = super::syntax::read(self.texts, start)?;
        self.refuse_whole(&root)?;
        self.chain.push(place);
        let mut root = self.expanded(root, &home)?;
        self.chain.pop();
        self.set(&mut root, &include.set, &include.file)?;
        Prefix::new(&include.prefix, &root).put(&mut root);
        Ok(root)
    }

    /// The system's path of a file. Refuses a file that cannot be found, or that includes itself.
    fn enter(&self, path: &Path, include: &Include) -> Read<PathBuf> {
        let unreadable = |problem: String| {
            let message = format!("cannot include `{}`: {problem}", path.display());
            let hint = "give the path from the folder of the file that includes it";
            self.refused(&include.file_span, message, hint)
        };
        let place = match path.canonicalize() {
            Ok(place) if place.is_file() => place,
            Ok(_) => return unreadable("it is no file".to_owned()),
            Err(error) => return unreadable(plain(&error)),
        };
        if let Some(i) = self.chain.iter().position(|other| *other == place) {
            let names = self.chain[i..].iter().chain([&place]).map(|path| name_of(path));
            let ring = names.collect::<Vec<_>>().join(" -> ");
            let message = format!("files that include one another: {ring}");
            return self.refused(&include.file_span, message, "leave one of them out");
        }
        if self.chain.len() > MAX_DEPTH || self.texts.list().len() >= MOST_FILES {
            let message = if self.chain.len() > MAX_DEPTH {
                format!("more than {MAX_DEPTH} files in one another")
            } else {
                format!("more than {MOST_FILES} files")
            };
            return self.refused(&include.file_span, message, "write some of them into one file");
        }
        Ok(place)
    }

    fn read(&self, path: &Path, include: &Include) -> Read<String> {
        let left = MOST_BYTES.saturating_sub(self.texts.len());
        let mut bytes = Vec::new();
        let read = std::fs::File::open(path)
            .and_then(|file| file.take(left as u64 + 1).read_to_end(&mut bytes));
        if let Err(error) = read {
            let message = format!("cannot include `{}`: {}", path.display(), plain(&error));
            return self.refused(&include.file_span, message, "give a file that can be read");
        }
        if bytes.len() > left {
            let message = format!("more than {} MiB with the included files", MOST_BYTES >> 20);
            return self.refused(&include.file_span, message, "include smaller files, or fewer");
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(text),
            Err(_) => {
                let message = format!("`{}` is not UTF-8 text", path.display());
                self.refused(&include.file_span, message, "save it as UTF-8")
            }
        }
    }

    /// Refuses tables that a scene has only once, such as `[scene]`, in an included file.
    fn refuse_whole(&self, root: &[Member]) -> Read<()> {
        let is_whole = |key: &str| {
            let key = keys::of(FILE).iter().find_map(|table| table.key(key));
            key.is_some_and(|key| matches!(key.value, KeyValue::Table(_)))
        };
        match root.iter().find(|member| is_whole(&member.key)) {
            None => Ok(()),
            Some(member) => {
                let message = format!("an included file has no [{}]", member.key);
                let hint = "write it in the file that is run";
                self.refused(&member.key_span, message, hint)
            }
        }
    }

    /// Gives new values to parameters of an included file.
    fn set(&self, root: &mut [Member], set: &[Member], file: &str) -> Read<()> {
        let mut own: Vec<&mut Member> = Vec::new();
        for member in root.iter_mut().filter(|member| member.key == "parameters") {
            if let Node::Table(members) = &mut member.item.node {
                own.extend(members.iter_mut());
            }
        }
        for new in set {
            let Some(old) = own.iter_mut().find(|old| old.key == new.key) else {
                let known: Vec<&str> = own.iter().map(|member| member.key.as_str()).collect();
                let message = format!("`{file}` has no parameter `{}`", new.key);
                let hint = match known.is_empty() {
                    true => "give it [parameters] with that name".to_owned(),
                    false => nearest_name(&new.key, &known, "parameters"),
                };
                return self.refused(&new.key_span, message, &hint);
            };
            old.item = new.item.clone();
        }
        Ok(())
    }
}

/// Returns in words why the system cannot read a file.
pub(super) fn plain(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "it may not be read".to_owned(),
        _ => error.to_string(),
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// A tree to which parts of included files are added.
struct Merge {
    root: Vec<Member>,
    /// Number of entries of included files that were added to each list.
    before: HashMap<String, usize>,
}

impl Merge {
    /// Adds a list or the parameters of an included file to the tree; `at` is the byte of the `[[include]]`.
    fn add(&mut self, part: Member, at: usize) -> Result<(), (Span, ReadFault)> {
        let Some(own) = self.root.iter_mut().find(|member| member.key == part.key) else {
            let n = if let Node::List(items) = &part.item.node { items.len() } else { 0 };
            self.before.insert(part.key.clone(), n);
            self.root.push(part);
            return Ok(());
        };
        match (&mut own.item.node, part.item.node) {
            (Node::List(own), Node::List(items)) => {
                let n = self.before.entry(part.key).or_default();
                // The bytes of included files are counted from the end of the file itself.
                let first = *n + own.iter().filter(|item| item.span.start < at).count();
                *n += items.len();
                own.splice(first..first, items);
                Ok(())
            }
            (Node::Table(own), Node::Table(members)) => {
                for member in members {
                    if own.iter().any(|other| other.key == member.key) {
                        let message = format!("there is another parameter `{}`", member.key);
                        let hint =
                            "give it another name, or the included file a `prefix`".to_owned();
                        let fault = ReadFault::Include(ExpressionFault { message, hint });
                        return Err((member.key_span, fault));
                    }
                    own.push(member);
                }
                Ok(())
            }
            (own, found) => {
                let (expected, found) = (own.description(), found.description());
                Err((part.item.span, ReadFault::WrongType { expected, found }))
            }
        }
    }
}
