//! Rule for imports: neither those between the files of a crate nor those between its rooms have circles.
//!
//! A room is a file or a folder directly below the crate's first file. The module `imports` defines what counts as an import. Imports from
//! one room to another are an arrow. Arrows that still make a circle are listed in allow.txt, as `up | CRATE: FROM -> TO | COUNT | reason`,
//! with the number of their imports.

use super::imports::{Imports, Sources};
use super::language::{allowed, report_beyond};
use super::{entries, name, read};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use toml::Table;
use xtask::process::root;

/// Imports by pairs of files or rooms: the first of a pair needs the second.
type Arrows<P> = BTreeMap<(usize, usize), P>;

/// For each of `n` nodes, the nodes that it reaches along arrows.
fn reach<P>(n: usize, arrows: &Arrows<P>) -> Vec<Vec<bool>> {
    let mut reach = vec![vec![false; n]; n];
    arrows.keys().for_each(|(from, to)| reach[*from][*to] = true);
    for k in 0..n {
        let through = reach[k].clone();
        for row in reach.iter_mut().filter(|row| row[k]) {
            row.iter_mut().zip(&through).for_each(|(to, also)| *to |= also);
        }
    }
    reach
}

/// The circles among `n` nodes, each as a list of nodes.
fn circles<P>(n: usize, arrows: &Arrows<P>) -> Vec<Vec<usize>> {
    let reach = reach(n, arrows);
    let together = |i: usize, j: usize| reach[i][j] && reach[j][i];
    let firsts = (0..n).filter(|i| together(*i, *i) && !(0..*i).any(|j| together(*i, j)));
    firsts.map(|first| (0..n).filter(|i| together(first, *i)).collect()).collect()
}

/// The circles of files in a program or library. Each has its number of files, and its imports as lines of text.
fn circles_of_files(all: &Imports) -> Vec<(usize, Vec<String>)> {
    let circle = |files: Vec<usize>| {
        let is_in = |(from, to): &(usize, usize)| files.contains(from) && files.contains(to);
        let edges = all.edges.iter().filter(|(ends, _)| is_in(ends));
        let lines = edges.map(|((from, to), places)| {
            let places: Vec<_> =
                places.iter().map(|(line, name)| format!("{line} `{name}`")).collect();
            format!("{} needs {}: line {}", all.files[*from], all.files[*to], places.join(", "))
        });
        (files.len(), lines.collect())
    };
    circles(all.files.len(), &all.edges).into_iter().map(circle).collect()
}

/// The rooms of a program or library, and the arrows between them with each import as `file:line name`.
struct Plan {
    rooms: Vec<String>,
    arrows: Arrows<Vec<String>>,
}

impl Plan {
    fn new(first: &Path, all: &Imports) -> Self {
        let folder = name(first.parent().expect("a file is in a folder"));
        let room = |file: &String| {
            let below = Path::new(file).strip_prefix(&folder).unwrap_or(Path::new(file));
            let room = below.components().next().map(|one| one.as_os_str().to_string_lossy());
            room.unwrap_or_default().trim_end_matches(".rs").to_owned()
        };
        let of_files: Vec<_> = all.files.iter().map(room).collect();
        let rooms: Vec<_> = of_files.iter().cloned().collect::<BTreeSet<_>>().into_iter().collect();
        let number = |file: usize| rooms.binary_search(&of_files[file]).expect("a room");
        let mut arrows: Arrows<Vec<String>> = BTreeMap::new();
        for ((from, to), places) in &all.edges {
            let (ends, file) = ((number(*from), number(*to)), &all.files[*from]);
            if ends.0 != ends.1 {
                let imports = places.iter().map(|(line, path)| format!("{file}:{line} {path}"));
                arrows.entry(ends).or_default().extend(imports);
            }
        }
        Self { rooms, arrows }
    }

    fn arrow(&self, (from, to): (usize, usize)) -> String {
        format!("{} -> {}", self.rooms[from], self.rooms[to])
    }

    /// The circles of rooms, as texts. Each text has the rooms, and the arrows with their imports.
    fn circles(&self) -> Vec<String> {
        let circle = |rooms: Vec<usize>| {
            let names: Vec<_> = rooms.iter().map(|room| self.rooms[*room].as_str()).collect();
            let mut text = format!("{} rooms: {}", rooms.len(), names.join(", "));
            for (ends, imports) in &self.arrows {
                if rooms.contains(&ends.0) && rooms.contains(&ends.1) {
                    let arrow = self.arrow(*ends);
                    let _ = write!(text, "\n    {arrow}\n      {}", imports.join("\n      "));
                }
            }
            text
        };
        circles(self.rooms.len(), &self.arrows).into_iter().map(circle).collect()
    }

    /// Removes the listed arrows. Returns the removed arrows that close a circle, with their imports. An arrow closes a circle if the room
    /// at its end needs the room at its beginning through other rooms.
    fn take_out(&mut self, listed: &BTreeSet<String>) -> BTreeMap<String, Vec<String>> {
        let (taken, kept): (Arrows<_>, Arrows<_>) = std::mem::take(&mut self.arrows)
            .into_iter()
            .partition(|(ends, _)| listed.contains(&self.arrow(*ends)));
        self.arrows = kept;
        let reach = reach(self.rooms.len(), &self.arrows);
        let up = taken.into_iter().filter(|((from, to), _)| reach[*to][*from]);
        up.map(|(ends, imports)| (self.arrow(ends), imports)).collect()
    }

    /// The rooms by floors: a room is above all rooms that it needs. Rooms in circles have no floor.
    fn floors(&self) -> String {
        let names = |rooms: &[usize]| -> String {
            rooms.iter().map(|room| self.rooms[*room].as_str()).collect::<Vec<_>>().join(", ")
        };
        let (mut floors, mut left) = (Vec::new(), (0..self.rooms.len()).collect::<Vec<_>>());
        loop {
            let needs = |room: &usize| {
                self.arrows.keys().any(|(from, to)| from == room && left.contains(to))
            };
            let (above, here): (Vec<_>, Vec<_>) = left.iter().partition(|room| needs(room));
            left = above;
            if here.is_empty() {
                break;
            }
            floors.push(format!("\n    {}: {}", floors.len(), names(&here)));
        }
        let [n, n_floors, arrows] = [self.rooms.len(), floors.len(), self.arrows.len()];
        let rest = names(&left);
        let rest = if rest.is_empty() { rest } else { format!(", not placed: {rest}") };
        format!("{n} rooms, {n_floors} floors, {arrows} arrows{rest}{}", floors.concat())
    }
}

/// The files of the repository.
struct Disk;

impl Sources for Disk {
    fn text(&self, path: &Path) -> Option<String> {
        std::fs::read_to_string(path).ok()
    }

    fn entries(&self, folder: &Path) -> Vec<PathBuf> {
        entries(folder)
    }
}

/// The first files of the programs and libraries in the workspace: those that manifests name, and the default ones.
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

/// The imports of each program or library of the workspace, with its first file.
static ALL: LazyLock<Vec<(PathBuf, Imports)>> = LazyLock::new(|| {
    let read = |first: PathBuf| {
        let all = Imports::read(&first, &Disk);
        (first, all)
    };
    firsts().into_iter().map(read).collect()
});

/// Name of a program or library: its folder without `src`.
fn crate_of(first: &Path) -> String {
    let name = name(first.parent().expect("a file is in a folder")).replace("/src", "");
    if first.ends_with("main.rs") && first.with_file_name("lib.rs").is_file() {
        name + "/main.rs"
    } else {
        name
    }
}

#[test]
fn the_files_of_a_crate_import_one_way() {
    let mut findings = Vec::new();
    for (n, edges) in ALL.iter().flat_map(|(_, all)| circles_of_files(all)) {
        findings.push(format!("{n} files\n    {}", edges.join("\n    ")));
    }
    super::report(
        "No circle of imports in a crate: move what two files need below both",
        &findings,
    );
}

/// Also prints the plan of each crate, which `--nocapture` shows.
#[test]
#[allow(clippy::print_stdout, reason = "the plan is shown with --nocapture")]
fn the_rooms_of_a_crate_import_one_way() {
    let listed: BTreeSet<String> = allowed("up").into_keys().collect();
    let (mut up, mut findings) = (BTreeMap::new(), Vec::new());
    for (first, all) in &*ALL {
        let (own, mut plan) = (crate_of(first), Plan::new(first, all));
        let of_own: BTreeSet<_> = listed
            .iter()
            .filter_map(|arrow| arrow.strip_prefix(&format!("{own}: ")))
            .map(str::to_owned)
            .collect();
        let left = plan.take_out(&of_own);
        up.extend(left.into_iter().map(|(arrow, imports)| (format!("{own}: {arrow}"), imports)));
        println!("{own}: {}", plan.floors());
        let circles = plan.circles();
        if !circles.is_empty() {
            findings.push(format!("{own}: {}\n  {}", plan.floors(), circles.join("\n  ")));
        }
    }
    super::report(
        "No circle of imports between the rooms of a crate: move what two rooms need below both",
        &findings,
    );
    report_beyond("Arrows between rooms that run up", "up", &up);
}

/// A small tree of files, each with its text.
struct Tree<'a>(&'a [(&'a str, &'a str)]);

impl Sources for Tree<'_> {
    fn text(&self, path: &Path) -> Option<String> {
        let found = self.0.iter().find(|(name, _)| path == Path::new(name));
        found.map(|(_, text)| (*text).to_owned())
    }

    fn entries(&self, folder: &Path) -> Vec<PathBuf> {
        let below = |(file, _): &(&str, &str)| {
            let first = Path::new(file).strip_prefix(folder).ok()?.components().next()?;
            Some(folder.join(first))
        };
        self.0.iter().filter_map(below).collect::<BTreeSet<_>>().into_iter().collect()
    }
}

#[test]
fn a_circle_by_a_name_shown_on_is_found_and_a_chain_is_none() {
    let sizes = |sources: &[(&str, &str)]| -> Vec<usize> {
        let found = circles_of_files(&Imports::read(Path::new("lib.rs"), &Tree(sources)));
        found.into_iter().map(|(files, _)| files).collect()
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

#[test]
fn a_module_that_a_macro_declares_is_read() {
    let lib = ("lib.rs", "mod kinds; mod data;");
    let kinds = ("kinds/mod.rs", "mod list; list::list!(kinds); pub use spring::Spring;");
    let list = ("kinds/list.rs", "macro_rules! list { () => { mod spring; } } pub use list;");
    let data = ("data.rs", "use crate::kinds::Spring; pub struct Data(Spring);");
    let spring = ("kinds/spring.rs", "use crate::data::Data; pub struct Spring(Data);");
    let sizes = |sources: &[(&str, &str)]| -> Vec<usize> {
        let found = circles_of_files(&Imports::read(Path::new("lib.rs"), &Tree(sources)));
        found.into_iter().map(|(files, _)| files).collect()
    };
    assert_eq!(sizes(&[lib, kinds, list, data, spring]), [2]);
    let alone = ("kinds/spring.rs", "pub struct Spring;");
    assert_eq!(sizes(&[lib, kinds, list, data, alone]).len(), 0);
}

#[test]
fn a_circle_of_rooms_is_found_with_its_imports_where_files_have_none() {
    let lib = ("lib.rs", "mod low; mod high; pub use high::top;");
    let low = ("low/mod.rs", "pub mod a; mod b; pub use crate::high::top::Top;");
    let a = ("low/a.rs", "pub struct A;");
    let b = ("low/b.rs", "\nuse crate::high::leaf::Leaf; pub struct B(Leaf);");
    let high = ("high/mod.rs", "pub mod top; pub mod leaf;");
    let top = ("high/top.rs", "pub struct Top(crate::low::a::A);");
    let leaf = ("high/leaf.rs", "pub struct Leaf;");
    let sources = [lib, low, a, b, high, top, leaf];
    let first = Path::new("lib.rs");
    let all = Imports::read(first, &Tree(&sources));
    assert_eq!(circles_of_files(&all).len(), 0);
    let mut plan = Plan::new(first, &all);
    let shown = "2 rooms: high, low\n    high -> low\n      high/top.rs:1 crate::low::a::A\n    \
                 low -> high\n      low/b.rs:2 crate::high::leaf::Leaf";
    assert_eq!(plan.circles(), [shown]);
    assert_eq!(plan.floors(), "3 rooms, 1 floors, 2 arrows, not placed: high, low\n    0: lib");
    let listed = ["low -> high", "high -> lib"].map(str::to_owned).into();
    let up = plan.take_out(&listed);
    assert_eq!(
        up.into_iter().map(|(arrow, n)| (arrow, n.len())).collect::<Vec<_>>(),
        [("low -> high".to_owned(), 1)]
    );
    assert_eq!(plan.circles().len(), 0);
    assert_eq!(plan.floors(), "3 rooms, 2 floors, 1 arrows\n    0: lib, low\n    1: high");
}
