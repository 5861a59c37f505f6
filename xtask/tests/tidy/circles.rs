//! The files of a crate import one way: none needs, over others, what needs itself.
//!
//! An import counts for the file that defines the name, through all re-exports, which are no imports themselves. Left out are tests,
//! what macros define, and modules that a macro declares, as the kinds of effect. A name that a module does not show counts for its file.

use super::{name, read};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use toml::Table;
use xtask::process::root;

/// Words that are followed by the name of an item.
const ITEMS: [&str; 8] = ["const", "enum", "fn", "static", "struct", "trait", "type", "union"];

/// Meaning of a name in a module.
enum Name {
    Module(usize),
    Item,
    Import(Vec<String>),
}

/// A module: its file, its names, and the paths that its code has, each with its line.
struct Module {
    file: usize,
    parent: Option<usize>,
    names: Vec<(String, Name)>,
    globs: Vec<Vec<String>>,
    paths: Vec<(usize, Vec<String>)>,
}

/// Module or file that a path leads to; nothing of another crate.
#[derive(Clone, Copy, PartialEq)]
enum Target {
    Module(usize),
    File(usize),
}

/// The modules of one program or library, and the file of each macro.
struct Crate<'a> {
    read: &'a dyn Fn(&Path) -> Option<String>,
    files: Vec<String>,
    modules: Vec<Module>,
    macros: BTreeMap<String, usize>,
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
        let text = (self.read)(path).unwrap_or_else(|| panic!("{} is missing", path.display()));
        let tokens: TokenStream = text.parse().expect("a file is Rust");
        self.files.push(name(path));
        self.add_module(tokens, self.files.len() - 1, folder, parent)
    }

    /// Adds a module of items in a file; the files of its children are in `folder`.
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
            if !was_test {
                self.add_item(at, (item, end), was_shown, folder);
            }
        }
        at
    }

    /// Adds an item of module `at`, which ends at a place in its tokens.
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
            ("mod", Some(child)) if child == "tests" => {}
            ("mod", Some(child)) => {
                let below = folder.join(&child);
                let index = if let Some(TokenTree::Group(group)) = item.get(2) {
                    self.add_module(group.stream(), file, &below, Some(at))
                } else {
                    let beside = folder.join(format!("{child}.rs"));
                    let own = (self.read)(&beside).map_or_else(|| below.join("mod.rs"), |_| beside);
                    self.add_file(&own, &below, Some(at))
                };
                self.modules[at].names.push((child, Name::Module(index)));
            }
            ("use", _) => self.modules[at].import(&item[1..end], &[], is_shown),
            ("macro_rules", _) => {
                let own = ident(item.get(2)).unwrap_or_default();
                self.macros.insert(own.clone(), file);
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

    /// Targets of a path, seen from a module; `seen` stops imports that lead back to themselves.
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
            // A module has what the next segment names, where there is one.
            let is_module = |target: &Target| matches!(target, Target::Module(_));
            if !is_last && at.iter().any(is_module) {
                at.retain(is_module);
            }
        }
        at
    }

    /// Targets of a name in a module; `is_made`: a name that it does not show is made there by a macro.
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
                Name::Import(path) => found.extend(
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

    /// For each two files the lines and names for which one needs the other.
    fn edges(&self) -> BTreeMap<(usize, usize), BTreeSet<(usize, String)>> {
        let mut edges: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
        for (at, module) in self.modules.iter().enumerate() {
            for (line, path) in &module.paths {
                let mut targets = self.resolve(at, path, &[]);
                if targets.is_empty() && path.len() == 1 {
                    targets.extend(
                        path[0]
                            .strip_suffix('!')
                            .and_then(|m| self.macros.get(m))
                            .map(|f| Target::File(*f)),
                    );
                }
                for target in targets {
                    if let Target::File(file) = target
                        && file != module.file
                    {
                        edges
                            .entry((module.file, file))
                            .or_default()
                            .insert((*line, path.join("::")));
                    }
                }
            }
        }
        edges
    }

    /// The circles: for each its files, and its edges as lines of text.
    fn circles(&self) -> Vec<(Vec<&str>, Vec<String>)> {
        let (edges, n) = (self.edges(), self.files.len());
        let mut reach = vec![vec![false; n]; n];
        edges.keys().for_each(|(from, to)| reach[*from][*to] = true);
        for k in 0..n {
            let through = reach[k].clone();
            for row in reach.iter_mut().filter(|row| row[k]) {
                row.iter_mut().zip(&through).for_each(|(to, also)| *to |= also);
            }
        }
        let together = |i: usize, j: usize| reach[i][j] && reach[j][i];
        let firsts = (0..n).filter(|i| together(*i, *i) && !(0..*i).any(|j| together(*i, j)));
        let circle = |first: usize| {
            let inside = |i: usize| together(first, i);
            let edges = edges.iter().filter(|((from, to), _)| inside(*from) && inside(*to));
            let lines = edges.map(|((from, to), places)| {
                let places: Vec<_> =
                    places.iter().map(|(line, name)| format!("{line} `{name}`")).collect();
                format!(
                    "{} needs {}: line {}",
                    self.files[*from],
                    self.files[*to],
                    places.join(", ")
                )
            });
            (
                (0..n).filter(|i| inside(*i)).map(|i| self.files[i].as_str()).collect(),
                lines.collect(),
            )
        };
        firsts.map(circle).collect()
    }
}

impl Module {
    /// Takes a tree of imports; those that are shown on are no needs.
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
            self.paths.push((line, path.clone()));
        }
        // An import of the very name, such as of a macro to show it on, leads nowhere else.
        if path != [seen_as.clone()] {
            self.names.push((seen_as, Name::Import(path)));
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
                    let is_call = matches!(tokens.get(i + 2), Some(TokenTree::Group(_)));
                    if path.len() == 1 && is_call && is_punct(tokens.get(i + 1), '!') {
                        path[0].push('!');
                    }
                    self.paths.push((line(token), path));
                }
                _ => {}
            }
            i += 1;
        }
    }
}

/// The circles of a program or library by its first file.
fn circles_of(
    first: &Path,
    read: &dyn Fn(&Path) -> Option<String>,
) -> Vec<(Vec<String>, Vec<String>)> {
    let mut all = Crate { read, files: Vec::new(), modules: Vec::new(), macros: BTreeMap::new() };
    all.add_file(first, first.parent().expect("a file is in a folder"), None);
    let owned = |files: Vec<&str>| files.into_iter().map(str::to_owned).collect();
    all.circles().into_iter().map(|(files, edges)| (owned(files), edges)).collect()
}

/// The first files of the programs and libraries of the workspace: those of the manifests, and the usual ones.
fn firsts() -> Vec<PathBuf> {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let members = manifest["workspace"]["members"].as_array().expect("a workspace has members");
    let files = members.iter().flat_map(|member| {
        let folder = root().join(member.as_str().expect("a path"));
        let manifest: Table = read(folder.join("Cargo.toml")).parse().expect("TOML");
        let programs = manifest.get("bin").and_then(|bins| bins.as_array());
        let all = programs.into_iter().flatten().chain(manifest.get("lib"));
        let paths = all.filter_map(|one| Some(one.get("path")?.as_str()?.to_owned()));
        let usual = ["src/lib.rs", "src/main.rs"].map(str::to_owned);
        paths.chain(usual).map(|file| folder.join(file)).collect::<BTreeSet<_>>()
    });
    files.filter(|file| file.is_file()).collect()
}

#[test]
fn the_files_of_a_crate_import_one_way() {
    let text = |path: &Path| std::fs::read_to_string(path).ok();
    let mut findings = Vec::new();
    for (files, edges) in firsts().iter().flat_map(|first| circles_of(first, &text)) {
        findings.push(format!("{} files\n    {}", files.len(), edges.join("\n    ")));
    }
    super::report(
        "No circle of imports in a crate: move what two files need below both",
        &findings,
    );
}

#[test]
fn a_circle_by_a_name_shown_on_is_found_and_a_chain_is_none() {
    let sizes = |sources: &[(&str, &str)]| -> Vec<usize> {
        let text = |path: &Path| {
            let found = sources.iter().find(|(name, _)| path == Path::new(name));
            found.map(|(_, text)| (*text).to_owned())
        };
        circles_of(Path::new("lib.rs"), &text).iter().map(|(files, _)| files.len()).collect()
    };
    let lib = ("lib.rs", "mod low; mod laws; mod user; pub use low::Low;");
    let laws = ("laws/mod.rs", "mod force; pub use force::Force;");
    let force = ("laws/force.rs", "pub struct Force(crate::Low);");
    let user = (
        "user.rs",
        "use crate::laws::Force; pub fn of(x: &Force) -> f64 { helper!(crate::low::f(x)) }",
    );
    let chain = ("low.rs", "pub struct Low; #[cfg(test)] mod tests { use crate::user::of; }");
    assert_eq!(sizes(&[lib, laws, force, user, chain]).len(), 0);
    let circle = ("low.rs", "use super::user; pub struct Low; fn f() { user::of() }");
    assert_eq!(sizes(&[lib, laws, force, user, circle]), [3]);
    let by_glob = ("low.rs", "use crate::laws::*; pub struct Low(Box<Force>);");
    assert_eq!(sizes(&[lib, laws, force, user, by_glob]), [2]);
    let by_macro =
        ("low.rs", "pub struct Low; fn f() { assert!(x.y, \"{}\", crate::user::of(1)) }");
    assert_eq!(sizes(&[lib, laws, force, user, by_macro]), [3]);
    let parent = ("laws/mod.rs", "mod force; pub use force::Force; pub fn f() -> Force { Force }");
    let child = ("laws/force.rs", "pub struct Force; fn f() { super::f() }");
    assert_eq!(sizes(&[lib, parent, child, user, chain]), [2]);
}
