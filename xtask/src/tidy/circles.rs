//! The files of a crate import one way: none needs, over others, what needs itself.

use super::{name, read};
use crate::process::root;
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemUse, Macro, UseTree, Visibility};
use toml::Table;

/// The segments of a path.
type Segments = Vec<String>;

/// What a name stands for in a module.
enum Name {
    Module(usize),
    Item,
    Import(Segments),
}

/// A module: its file, its names, and the paths that its code has, each with its line.
struct Module {
    file: usize,
    parent: Option<usize>,
    names: Vec<(String, Name)>,
    globs: Vec<Segments>,
    paths: Vec<(usize, Segments)>,
}

/// The modules of one crate, without tests.
#[derive(Default)]
struct Crate {
    files: Vec<String>,
    modules: Vec<Module>,
    macros: BTreeMap<String, usize>,
}

/// What a path leads to: a module, an item in a file, or (not listed) another crate.
#[derive(Clone, Copy, PartialEq)]
enum Target {
    Module(usize),
    File(usize),
}

/// The lines and names for which one file needs another.
type Edges = BTreeMap<(usize, usize), BTreeSet<(usize, String)>>;

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let tokens = attribute.meta.require_list().map(|list| list.tokens.to_string());
        attribute.path().is_ident("cfg")
            && tokens.is_ok_and(|t| t.contains("test") && !t.contains("not"))
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(i) => &i.attrs,
        Item::Enum(i) => &i.attrs,
        Item::Fn(i) => &i.attrs,
        Item::Impl(i) => &i.attrs,
        Item::Mod(i) => &i.attrs,
        Item::Static(i) => &i.attrs,
        Item::Struct(i) => &i.attrs,
        Item::Use(i) => &i.attrs,
        _ => &[],
    }
}

fn defined(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(i) => i.ident.to_string(),
        Item::Enum(i) => i.ident.to_string(),
        Item::Fn(i) => i.sig.ident.to_string(),
        Item::Macro(i) => i.ident.as_ref()?.to_string(),
        Item::Static(i) => i.ident.to_string(),
        Item::Struct(i) => i.ident.to_string(),
        Item::Trait(i) => i.ident.to_string(),
        Item::Type(i) => i.ident.to_string(),
        Item::Union(i) => i.ident.to_string(),
        _ => return None,
    })
}

impl Crate {
    fn new(root: &Path, read: &dyn Fn(&Path) -> Option<String>) -> Self {
        let mut all = Self::default();
        let folder = root.parent().expect("a file is in a folder");
        all.add_file(root, folder, None, read);
        all
    }

    fn add_file(
        &mut self,
        path: &Path,
        folder: &Path,
        parent: Option<usize>,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> usize {
        let text = read(path).unwrap_or_else(|| panic!("{} is missing", path.display()));
        let file = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        self.files.push(name(path));
        self.add_module(&file.items, self.files.len() - 1, folder, parent, read)
    }

    /// Adds a module of items in a file; the files of its children are in `folder`.
    fn add_module(
        &mut self,
        items: &[Item],
        file: usize,
        folder: &Path,
        parent: Option<usize>,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> usize {
        let at = self.modules.len();
        let (names, globs, paths) = (Vec::new(), Vec::new(), Vec::new());
        self.modules.push(Module { file, parent, names, globs, paths });
        let is_kept = |item: &&Item| !is_test(attributes(item));
        let has_children = items.iter().any(|item| matches!(item, Item::Mod(_)) && is_kept(&item));
        for item in items.iter().filter(is_kept) {
            if let Item::Mod(child) = item {
                let name = child.ident.to_string();
                let below = folder.join(&name);
                let index = match &child.content {
                    _ if name == "tests" => continue,
                    Some((_, items)) => self.add_module(items, file, &below, Some(at), read),
                    None => {
                        let beside = folder.join(format!("{name}.rs"));
                        let own = read(&beside).map_or_else(|| below.join("mod.rs"), |_| beside);
                        self.add_file(&own, &below, Some(at), read)
                    }
                };
                self.modules[at].names.push((name, Name::Module(index)));
                continue;
            }
            if let Some(name) = defined(item) {
                if matches!(item, Item::Macro(_)) {
                    self.macros.insert(name.clone(), file);
                }
                self.modules[at].names.push((name, Name::Item));
            }
            Reader { module: &mut self.modules[at], has_children }.visit_item(item);
        }
        at
    }

    /// What a path leads to, seen from a module; `seen` stops imports that lead back to themselves.
    fn resolve(
        &self,
        from: usize,
        path: &[String],
        seen: &mut Vec<(usize, String)>,
    ) -> Vec<Target> {
        let mut at = vec![Target::Module(from)];
        for (i, segment) in path.iter().enumerate() {
            at = at
                .iter()
                .flat_map(|target| match (*target, segment.as_str()) {
                    (Target::File(file), _) => vec![Target::File(file)],
                    (Target::Module(_), "crate") => vec![Target::Module(0)],
                    (Target::Module(module), "self") => vec![Target::Module(module)],
                    (Target::Module(module), "super") => {
                        self.modules[module].parent.map(Target::Module).into_iter().collect()
                    }
                    (Target::Module(module), name) => {
                        self.find(module, name, i > 0 && i + 1 == path.len(), seen)
                    }
                })
                .collect();
            // Only a module has what the next segment names, unless it is of a type.
            let is_module = |target: &Target| matches!(target, Target::Module(_));
            if i + 1 < path.len() && at.iter().any(is_module) {
                at.retain(is_module);
            }
        }
        at
    }

    /// What a name in a module stands for. A name that a reached module does not show is made there by a macro.
    fn find(
        &self,
        module: usize,
        name: &str,
        is_last: bool,
        seen: &mut Vec<(usize, String)>,
    ) -> Vec<Target> {
        let key = (module, name.to_owned());
        if seen.contains(&key) {
            return Vec::new();
        }
        seen.push(key);
        let it = &self.modules[module];
        let mut found = Vec::new();
        for (_, what) in it.names.iter().filter(|(own, _)| own == name) {
            match what {
                Name::Module(child) => found.push(Target::Module(*child)),
                Name::Item => found.push(Target::File(it.file)),
                Name::Import(path) => found.extend(self.resolve(module, path, seen)),
            }
        }
        // An import brings no second module of a name.
        let own = it.names.iter().find_map(|(own, what)| match what {
            Name::Module(child) if own == name => Some(Target::Module(*child)),
            _ => None,
        });
        found.retain(|target| {
            own.is_none() || matches!(target, Target::File(_)) || Some(*target) == own
        });
        let is_listed = it.names.iter().any(|(own, _)| own == name);
        let mut is_foreign = false;
        if !is_listed {
            for glob in &it.globs {
                let targets = self.resolve(module, glob, &mut seen.clone());
                is_foreign |= !targets.iter().any(|t| matches!(t, Target::Module(_)));
                for target in targets {
                    if let Target::Module(other) = target {
                        found.extend(self.find(other, name, false, seen));
                    }
                }
            }
            if found.is_empty() && is_last && !is_foreign {
                found.push(Target::File(it.file));
            }
        }
        seen.pop();
        found
    }

    fn edges(&self) -> Edges {
        let mut edges = Edges::new();
        for (at, module) in self.modules.iter().enumerate() {
            for (line, path) in &module.paths {
                let mut targets = self.resolve(at, path, &mut Vec::new());
                if let (true, [single]) = (targets.is_empty(), path.as_slice()) {
                    targets.extend(
                        single
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

    /// The circles: for each, its files, and its edges as lines of text.
    fn circles(&self) -> Vec<(usize, Vec<String>)> {
        let (edges, n) = (self.edges(), self.files.len());
        let mut reach = vec![vec![false; n]; n];
        for (from, to) in edges.keys() {
            reach[*from][*to] = true;
        }
        for k in 0..n {
            for i in 0..n {
                for j in 0..n {
                    reach[i][j] |= reach[i][k] && reach[k][j];
                }
            }
        }
        let together = |i: usize, j: usize| reach[i][j] && reach[j][i];
        let firsts = (0..n).filter(|i| together(*i, *i) && !(0..*i).any(|j| together(*i, j)));
        firsts
            .map(|first| {
                let size = (0..n).filter(|j| together(first, *j)).count();
                let inside = edges
                    .iter()
                    .filter(|((from, to), _)| together(first, *from) && together(first, *to));
                let lines = inside.map(|((from, to), places)| {
                    let places: Vec<_> =
                        places.iter().map(|(line, name)| format!("{line} `{name}`")).collect();
                    format!(
                        "{} needs {}: line {}",
                        self.files[*from],
                        self.files[*to],
                        places.join(", ")
                    )
                });
                (size, lines.collect())
            })
            .collect()
    }
}

/// Reads what one module imports and the paths in its code.
struct Reader<'a> {
    module: &'a mut Module,
    has_children: bool,
}

impl Reader<'_> {
    fn import(&mut self, tree: &UseTree, before: &[String], is_shown_on: bool) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        let (ident, path, seen_as) = match tree {
            UseTree::Path(path) => return self.import(&path.tree, &with(&path.ident), is_shown_on),
            UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.import(tree, before, is_shown_on));
                return;
            }
            UseTree::Glob(_) => return self.module.globs.push(before.to_vec()),
            UseTree::Rename(rename) => {
                (&rename.ident, with(&rename.ident), rename.rename.to_string())
            }
            UseTree::Name(name) => (&name.ident, with(&name.ident), name.ident.to_string()),
        };
        let is_self = ident == "self";
        let path = if is_self { before.to_vec() } else { path };
        let seen_as =
            if is_self && seen_as == "self" { before.last().cloned() } else { Some(seen_as) };
        if !is_shown_on {
            self.module.paths.push((ident.span().start().line, path.clone()));
        }
        // An import of the very name, such as of a macro to show it on, leads nowhere else.
        if let Some(seen_as) = seen_as.filter(|name| path != [name.clone()]) {
            self.module.names.push((seen_as, Name::Import(path)));
        }
    }

    /// Paths in the tokens of a macro.
    fn tokens(&mut self, tokens: TokenStream) {
        let (mut path, mut line, mut is_joined, mut after) = (Vec::new(), 0, false, ' ');
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if !is_joined {
                        self.push(line, &mut path);
                        line = ident.span().start().line;
                    }
                    if after != '.' && after != '\'' {
                        path.push(ident.to_string());
                    }
                    (is_joined, after) = (false, ' ');
                }
                TokenTree::Punct(punct) => {
                    is_joined = punct.as_char() == ':' && after == ':';
                    after = punct.as_char();
                    if after != ':' {
                        self.push(line, &mut path);
                    }
                }
                TokenTree::Group(group) => {
                    self.push(line, &mut path);
                    self.tokens(group.stream());
                    (is_joined, after) = (false, ' ');
                }
                TokenTree::Literal(_) => after = ' ',
            }
        }
        self.push(line, &mut path);
    }

    fn push(&mut self, line: usize, path: &mut Segments) {
        if !path.is_empty() {
            self.module.paths.push((line, std::mem::take(path)));
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_visibility(&mut self, _: &'ast Visibility) {}

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let is_shown_on = !matches!(item.vis, Visibility::Inherited);
        if item.leading_colon.is_none() {
            self.import(&item.tree, &[], is_shown_on);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let line = path.segments[0].ident.span().start().line;
        let mut segments = path.segments.iter().map(|s| s.ident.to_string()).collect();
        if path.leading_colon.is_none() {
            self.push(line, &mut segments);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, item: &'ast Macro) {
        let line = item.path.segments[0].ident.span().start().line;
        let mut path: Segments = item.path.segments.iter().map(|s| s.ident.to_string()).collect();
        if let [single] = path.as_mut_slice() {
            single.push('!');
        }
        self.push(line, &mut path);
        self.tokens(item.tokens.clone());
    }
}

/// The first files of the programs and libraries of the workspace.
fn roots() -> Vec<PathBuf> {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let members = manifest["workspace"]["members"].as_array().expect("a workspace has members");
    let members = members.iter().map(|member| root().join(member.as_str().expect("a path")));
    let files =
        members.flat_map(|m| ["src/lib.rs", "src/main.rs", "lab/main.rs"].map(|f| m.join(f)));
    files.filter(|file| file.is_file()).collect()
}

/// What still has circles.
const KNOWN: [&str; 7] = [
    "bench/src/lib.rs",
    "gauntlet/src/lib.rs",
    "judge/src/lib.rs",
    "mbs-augmented/src/lib.rs",
    "mbs/src/lib.rs",
    "xtask/lab/main.rs",
    "xtask/src/lib.rs",
];

#[test]
fn the_files_of_a_crate_import_one_way() {
    let text = |path: &Path| std::fs::read_to_string(path).ok();
    let mut findings = Vec::new();
    for root in roots() {
        let all = Crate::new(&root, &text);
        for (size, lines) in all.circles() {
            if std::env::var("ALL").is_ok() || !KNOWN.contains(&name(&root).as_str()) {
                findings.push(format!(
                    "{}: {size} files\n    {}",
                    name(&root),
                    lines.join("\n    ")
                ));
            }
        }
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
        let circles = Crate::new(Path::new("lib.rs"), &text).circles();
        circles.into_iter().map(|(size, _)| size).collect()
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
