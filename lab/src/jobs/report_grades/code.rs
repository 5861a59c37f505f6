//! Counts in sources: lines of code of a formulation, and whether it searches a graph.

use std::fs;
use std::path::Path;
use xtask::process;

/// Counts in the sources of a crate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Counted {
    /// Lines of code, without tests, comments and empty lines.
    pub(crate) lines: usize,
    /// The file that searches a graph, if there is one.
    pub(crate) graph: Option<String>,
}

/// Counts the sources of a crate of this workspace.
///
/// # Errors
///
/// The file that cannot be read.
pub(crate) fn count(package: &str) -> Result<Counted, String> {
    let mut counted = Counted { lines: 0, graph: None };
    folder(&process::root().join(package).join("src"), &mut counted)?;
    Ok(counted)
}

/// Adds the files of a folder.
fn folder(path: &Path, counted: &mut Counted) -> Result<(), String> {
    let say = |e| format!("{}: {e}", path.display());
    let mut entries =
        fs::read_dir(path).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(say)?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let (path, name) = (entry.path(), entry.file_name());
        let name = name.to_string_lossy();
        if path.is_dir() {
            if name != "tests" {
                folder(&path, counted)?;
            }
        } else if name.ends_with(".rs") && name != "tests.rs" {
            counted.lines += lines(&fs::read_to_string(&path).map_err(say)?);
            if name == "graph.rs" {
                counted.graph = Some(name.into_owned());
            }
        }
    }
    Ok(())
}

/// Number of lines of code before the tests, which are at the end of a file.
fn lines(text: &str) -> usize {
    let mut lines = text.lines().map(str::trim);
    let mut count = 0;
    while let Some(line) = lines.next() {
        if line == "#[cfg(test)]" {
            // a module of tests in a file of its own is skipped; otherwise the tests follow
            match lines.next() {
                Some(line) if line.ends_with(';') => continue,
                _ => break,
            }
        }
        count += usize::from(!line.is_empty() && !line.starts_with("//"));
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_empty_lines_and_tests_are_no_code() {
        let text = "//! Doc.\n\nuse core::fmt;\n/// Doc.\nfn f() {\n    // why\n}\n#[cfg(test)]\nmod tests {}\n";
        assert_eq!(lines(text), 3);
        assert_eq!(lines("mod a;\n#[cfg(test)]\nmod tests;\nmod b;\n"), 2);
    }

    #[test]
    fn the_recursive_formulation_alone_searches_a_graph() {
        let graph = |package| count(package).unwrap().graph;
        assert_eq!(graph("mbs-recursive").as_deref(), Some("graph.rs"));
        let others = ["mbs-augmented", "mbs-classical", "mbs-statespace"];
        assert_eq!(others.map(graph), [None, None, None]);
        assert!(others.map(|package| count(package).unwrap().lines).iter().all(|&n| n > 300));
    }
}
