//! The imports of a crate as edges between its files. A name leads to the file that defines it, through all re-exports.
//!
//! A re-export is not an import. Tests and definitions made by macros are left out. A file that no file declares as a module counts as
//! declared by a macro, as the kinds of effect are. It is read with the others. A name that a module does not define leads to the module's
//! file.

use super::name;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Keywords before the name of an item.
const ITEMS: [&str; 8] = ["const", "enum", "fn", "static", "struct", "trait", "type", "union"];

/// Meaning of a name in a module.
enum Name {
    Module(usize),
    Item,
    Import { path: Vec<String>, is_shown: bool },
}

/// A path in code, with its line. `is_call` is true for a macro that is called.
struct Need {
    line: usize,
    path: Vec<String>,
    is_call: bool,
}

/// A module: its file, its names, and the paths in its code.
struct Module {
    file: usize,
    parent: Option<usize>,
    names: Vec<(String, Name)>,
    globs: Vec<Vec<String>>,
    paths: Vec<Need>,
}

/// Module or file to which a path leads. Paths into other crates have no target.
#[derive(Clone, Copy, PartialEq)]
enum Target {
    Module(usize),
    File(usize),
}

/// Source of the files of a crate: the disk, or texts of a test.
pub(super) trait Sources {
    /// Returns the text of a file; `None` if there is no such file.
    fn text(&self, path: &Path) -> Option<String>;

    /// Returns the entries of a folder, in order.
    fn entries(&self, folder: &Path) -> Vec<PathBuf>;
}

/// The lines and names by which one file needs another.
pub(super) type Places = BTreeSet<(usize, String)>;

/// The files of one program or library, as paths from the root of the repository, with the imports between each two of them.
pub(super) struct Imports {
    pub files: Vec<String>,
    pub edges: BTreeMap<(usize, usize), Places>,
}

impl Imports {
    /// Reads the program or library that begins with this file.
    pub(super) fn read(first: &Path, sources: &dyn Sources) -> Self {
        let (files, modules, macros) = (Vec::new(), Vec::new(), Vec::new());
        let mut all = Crate { sources, files, modules, macros };
        all.add_file(first, first.parent().expect("a file is in a folder"), None);
        Self { edges: all.edges(), files: all.files }
    }
}

/// The modules of one program or library, and the file of each macro.
struct Crate<'a> {
    sources: &'a dyn Sources,
    files: Vec<String>,
    modules: Vec<Module>,
    macros: Vec<(String, usize)>,
}

fn ident(token: Option<&TokenTree>) -> Option<String> {
    if let Some(TokenTree::Ident(ident)) = token { Some(ident.to_string()) } else { None }
}

fn is_punct(token: Option<&TokenTree>, c: char) -> bool {
    matches!(token, Some(TokenTree::Punct(p)) if p.as_char() == c)
}

fn line(token: &TokenTree) -> usize {
    token.span().start().line
}

impl Crate<'_> {
    fn add_file(&mut self, path: &Path, folder: &Path, parent: Option<usize>) -> usize {
        let text =
            self.sources.text(path).unwrap_or_else(|| panic!("{} is missing", path.display()));
        let tokens: TokenStream = text.parse().expect("a file is Rust");
        self.files.push(name(path));
        self.add_module(tokens, self.files.len() - 1, folder, parent)
    }

    /// Adds a module of items in a file. The files of its children are in `folder`.
    fn add_module(
        &mut self,
        tokens: TokenStream,
        file: usize,
        folder: &Path,
        parent: Option<usize>,
    ) -> usize {
        let at = self.modules.len();
        let (names, globs, paths) = (Vec::new(), Vec::new(), Vec::new());
        self.modules.push(Module { file, parent, names, globs, paths });
        let mut tests = Vec::new();
        let tokens: Vec<_> = tokens.into_iter().collect();
        let (mut rest, mut is_test, mut is_shown) = (&tokens[..], false, false);
        while let Some(token) = rest.first() {
            let word = ident(Some(token)).unwrap_or_default();
            let is_end = |t: &TokenTree| match t {
                TokenTree::Group(group) => word != "use" && group.delimiter() == Delimiter::Brace,
                other => is_punct(Some(other), ';'),
            };
            let end = rest.iter().position(is_end).unwrap_or(rest.len() - 1);
            if is_punct(Some(token), '#') {
                let text = rest[1..3].iter().map(ToString::to_string).collect::<String>();
                is_test |= text.contains("cfg") && (text.contains("test") || text.contains("doc"));
                rest = &rest[if is_punct(rest.get(1), '!') { 3 } else { 2 }..];
                continue;
            }
            if word == "pub" {
                is_shown = true;
                rest =
                    &rest[if matches!(rest.get(1), Some(TokenTree::Group(_))) { 2 } else { 1 }..];
                continue;
            }
            let (was_test, was_shown) =
                (std::mem::take(&mut is_test), std::mem::take(&mut is_shown));
            let (item, after) = rest.split_at(end + 1);
            rest = after;
            if was_test || word == "mod" && ident(item.get(1)).as_deref() == Some("tests") {
                tests.extend(ident(item.get(1)));
            } else {
                self.add_item(at, (item, end), was_shown, folder);
            }
        }
        if parent.is_some() {
            self.add_made(at, folder, &tests);
        }
        at
    }

    /// Adds the modules of a folder that a macro declares: those that no item declares.
    fn add_made(&mut self, at: usize, folder: &Path, tests: &[String]) {
        for entry in self.sources.entries(folder) {
            let child = entry.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let is_file = entry.extension().is_some();
            let is_own = child == "mod"
                || is_file && entry.extension().is_none_or(|ending| ending != "rs")
                || tests.contains(&child);
            let file = if is_file { entry } else { entry.join("mod.rs") };
            let is_declared = self.modules[at]
                .names
                .iter()
                .any(|(name, what)| matches!(what, Name::Module(_)) && *name == child);
            if is_own || is_declared || self.sources.text(&file).is_none() {
                continue;
            }
            let index = self.add_file(&file, &folder.join(&child), Some(at));
            self.modules[at].names.push((child, Name::Module(index)));
        }
    }

    /// Adds an item of module `at`. Returns the place in its tokens where it ends.
    fn add_item(
        &mut self,
        at: usize,
        (item, end): (&[TokenTree], usize),
        is_shown: bool,
        folder: &Path,
    ) {
        let file = self.modules[at].file;
        let (word, next) = (ident(item.first()).unwrap_or_default(), ident(item.get(1)));
        match (word.as_str(), next) {
            ("mod", Some(child)) => {
                let below = folder.join(&child);
                let index = if let Some(TokenTree::Group(group)) = item.get(2) {
                    self.add_module(group.stream(), file, &below, Some(at))
                } else {
                    let beside = folder.join(format!("{child}.rs"));
                    let own =
                        self.sources.text(&beside).map_or_else(|| below.join("mod.rs"), |_| beside);
                    self.add_file(&own, &below, Some(at))
                };
                self.modules[at].names.push((child, Name::Module(index)));
            }
            ("use", _) => self.modules[at].import(&item[1..end], &[], is_shown),
            ("macro_rules", _) => {
                let own = ident(item.get(2)).unwrap_or_default();
                self.macros.push((own.clone(), file));
                self.modules[at].names.push((own, Name::Item));
                self.modules[at].code(&item[3..]);
            }
            _ => {
                let is_item =
                    |t: &TokenTree| ident(Some(t)).is_some_and(|w| ITEMS.contains(&w.as_str()));
                let heads = item.iter().take_while(|t| ident(Some(t)).is_some_and(|w| w != "impl"));
                if let Some(own) = heads.take(5).zip(&item[1..]).filter(|(t, _)| is_item(t)).last()
                {
                    self.modules[at].names.push((own.1.to_string(), Name::Item));
                }
                self.modules[at].code(item);
            }
        }
    }

    /// Targets of a path, seen from a module. `seen` stops circular imports.
    fn resolve(&self, from: usize, path: &[String], seen: &[(usize, String)]) -> Vec<Target> {
        let mut at = vec![Target::Module(from)];
        for (i, segment) in path.iter().enumerate() {
            let is_last = i + 1 == path.len();
            let step = |target: &Target| match (*target, segment.as_str()) {
                (Target::Module(_), "crate") => vec![Target::Module(0)],
                (Target::Module(_) | Target::File(_), "self") | (Target::File(_), _) => {
                    vec![*target]
                }
                (Target::Module(m), "super") => {
                    self.modules[m].parent.map(Target::Module).into_iter().collect()
                }
                (Target::Module(m), name) => self.find(m, name, i > 0 && is_last, seen),
            };
            at = at.iter().flat_map(step).collect();
            // if there is a next segment, only modules can contain it
            let is_module = |target: &Target| matches!(target, Target::Module(_));
            if !is_last && at.iter().any(is_module) {
                at.retain(is_module);
            }
        }
        at
    }

    /// Targets of a name in a module. With `is_made`, a name that is not defined there counts as made by a macro.
    fn find(
        &self,
        module: usize,
        name: &str,
        is_made: bool,
        seen: &[(usize, String)],
    ) -> Vec<Target> {
        let key = (module, name.to_owned());
        if seen.contains(&key) {
            return Vec::new();
        }
        let (seen, it) = ([seen, &[key]].concat(), &self.modules[module]);
        let named = || it.names.iter().filter(|(own, _)| own == name).map(|(_, what)| what);
        let child =
            named().find_map(|what| if let Name::Module(m) = what { Some(*m) } else { None });
        let mut found: Vec<_> = child.map(Target::Module).into_iter().collect();
        for what in named() {
            match what {
                Name::Module(_) => {}
                Name::Item => found.push(Target::File(it.file)),
                Name::Import { path, .. } => found.extend(
                    self.resolve(module, path, &seen)
                        .into_iter()
                        .filter(|t| child.is_none() || matches!(t, Target::File(_))),
                ),
            }
        }
        if named().next().is_some() {
            return found;
        }
        let mut is_foreign = false;
        for glob in &it.globs {
            let target = self
                .resolve(module, glob, &seen)
                .into_iter()
                .find_map(|t| if let Target::Module(m) = t { Some(m) } else { None });
            match target {
                Some(other) => found.extend(self.find(other, name, false, &seen)),
                None => is_foreign = true,
            }
        }
        if found.is_empty() && is_made && !is_foreign {
            found.push(Target::File(it.file));
        }
        found
    }

    /// True if a path begins with an item that its module imports. Such a path counts at the import.
    fn is_imported(&self, at: usize, need: &Need) -> bool {
        let is_own = |(own, what): &(String, Name)| {
            need.path.first() == Some(own) && matches!(what, Name::Import { is_shown: false, .. })
        };
        let is_module = |target: &Target| matches!(target, Target::Module(_));
        self.modules[at].names.iter().any(is_own)
            && (need.path.len() == 1
                || !self.resolve(at, &need.path[..1], &[]).iter().any(is_module))
    }

    /// Files to which a path in code leads; for a call, the files that define the macro.
    fn files_of(&self, at: usize, need: &Need) -> Vec<usize> {
        let found = self.resolve(at, &need.path, &[]).into_iter();
        let mut files: Vec<_> = found
            .filter_map(|t| if let Target::File(file) = t { Some(file) } else { None })
            .collect();
        if need.is_call {
            let named = || self.macros.iter().filter(|(name, _)| Some(name) == need.path.last());
            files.retain(|file| named().any(|(_, of)| of == file));
            if files.is_empty() && need.path.len() == 1 {
                files.extend(named().next_back().map(|(_, file)| *file));
            }
        }
        files
    }

    /// The lines and names by which one file needs another, for each two files.
    fn edges(&self) -> BTreeMap<(usize, usize), Places> {
        let mut edges: BTreeMap<_, Places> = BTreeMap::new();
        for (at, module) in self.modules.iter().enumerate() {
            for need in module.paths.iter().filter(|need| !self.is_imported(at, need)) {
                for file in self.files_of(at, need) {
                    if file != module.file {
                        let place = (need.line, need.path.join("::"));
                        edges.entry((module.file, file)).or_default().insert(place);
                    }
                }
            }
        }
        edges
    }
}

impl Module {
    /// Adds a tree of imports. Re-exports are not needs of the file.
    fn import(&mut self, tokens: &[TokenTree], before: &[String], is_shown: bool) {
        let mut path = before.to_vec();
        for (i, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => {
                    let inner: Vec<_> = group.stream().into_iter().collect();
                    inner
                        .split(|t| is_punct(Some(t), ','))
                        .for_each(|one| self.import(one, &path, is_shown));
                    return;
                }
                TokenTree::Punct(p) if p.as_char() == '*' => return self.globs.push(path),
                TokenTree::Ident(word) if word == "as" => {
                    return self.bind(line(token), path, tokens[i + 1].to_string(), is_shown);
                }
                TokenTree::Ident(word) => path.push(word.to_string()),
                _ => {}
            }
        }
        if let Some(token) = tokens.first() {
            path.pop_if(|last| last == "self" && !before.is_empty());
            let seen_as = path.last().cloned().unwrap_or_default();
            self.bind(line(token), path, seen_as, is_shown);
        }
    }

    fn bind(&mut self, line: usize, path: Vec<String>, seen_as: String, is_shown: bool) {
        if !is_shown {
            self.paths.push(Need { line, path: path.clone(), is_call: false });
        }
        // an import of a name under the same path, such as a macro's re-export, leads to no other place
        if path != [seen_as.clone()] {
            self.names.push((seen_as, Name::Import { path, is_shown }));
        }
    }

    /// Collects the paths in code.
    fn code(&mut self, tokens: &[TokenTree]) {
        let mut i = 0;
        while i < tokens.len() {
            let (word, before) =
                (ident(tokens.get(i)), i.checked_sub(1).and_then(|b| tokens.get(b)));
            let joins = |i: usize| is_punct(tokens.get(i), ':') && is_punct(tokens.get(i + 1), ':');
            match (&tokens[i], word) {
                (TokenTree::Group(_), _) if is_punct(before, '#') => {}
                (TokenTree::Group(group), _) => {
                    self.code(&group.stream().into_iter().collect::<Vec<_>>())
                }
                (_, Some(word)) if word == "use" => {
                    let end = (i..tokens.len())
                        .find(|j| is_punct(tokens.get(*j), ';'))
                        .unwrap_or(tokens.len());
                    self.import(&tokens[(i + 1).min(end)..end], &[], false);
                    i = end;
                }
                (token, Some(word))
                    if !['.', '\'', ':']
                        .iter()
                        .any(|c| is_punct(before, *c) && (*c != ':' || i >= 2 && joins(i - 2))) =>
                {
                    let mut path = vec![word];
                    while joins(i + 1)
                        && let Some(next) = ident(tokens.get(i + 3))
                    {
                        path.push(next);
                        i += 3;
                    }
                    let is_call = is_punct(tokens.get(i + 1), '!')
                        && matches!(tokens.get(i + 2), Some(TokenTree::Group(_)));
                    self.paths.push(Need { line: line(token), path, is_call });
                }
                _ => {}
            }
            i += 1;
        }
    }
}
