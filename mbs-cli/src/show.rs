//! Options `--open` and `--watch` of `mbs run`.

use crate::line;
use crate::refusal::Refusal;
use crate::say::warn;
use clap::Args;
use mbs::scene_file::format::counted;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// Default directory of the results of a run with `--open` or `--watch`.
const OUT: &str = "out";

/// Arguments of a run whose page is looked at.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Open the page in the system's browser; without a screen, print its path. Directory: --out, else `out`.
    #[arg(long)]
    pub(crate) open: bool,
    /// Run again whenever a file of the scene changes, until Ctrl-C. Directory: --out, else `out`.
    ///
    /// A refusal is shown, and the page of the last good run stays.
    #[arg(long, conflicts_with_all = ["checkpoint", "resume", "restart", "realtime", "json"])]
    pub(crate) watch: bool,
}

impl Arguments {
    /// The directory of the results: the given one, or the default if the run needs one.
    pub(crate) fn out<'a>(&self, given: Option<&'a Path>) -> Option<&'a Path> {
        given.or_else(|| (self.open || self.watch).then(|| Path::new(OUT)))
    }
}

/// Opens a page with the program of the system for this. Prints the path if there is no screen or no such program.
pub(crate) fn open(page: &Path) {
    let page = page.canonicalize().unwrap_or_else(|_| page.to_path_buf());
    if !(has_screen() && is_opened(&page)) {
        warn(&format!("open in a browser: {}", page.display()));
    }
}

/// True if there is a screen, or if this is unknown on the system.
fn has_screen() -> bool {
    let is_known = cfg!(all(unix, not(target_os = "macos")));
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !is_known || ["DISPLAY", "WAYLAND_DISPLAY"].into_iter().any(is_set)
}

/// Lets the system open a page. Returns true if the program of the system started.
fn is_opened(page: &Path) -> bool {
    let program = match std::env::consts::OS {
        "macos" => "open",
        "windows" => "explorer",
        _ => "xdg-open",
    };
    let mut opener = Command::new(program);
    opener.arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    opener.spawn().is_ok()
}

/// Time between two checks of the files [s]: shorter than a change of windows by hand.
const LOOK: Duration = Duration::from_millis(300);

/// Runs this command line without `--watch`, and again each time a file has changed. Ctrl-C ends it.
pub(crate) fn watch(scene: &Path, others: &[&Path], out: Option<&Path>) -> ExitCode {
    if !scene.is_file() {
        let message = format!("`{}` cannot be watched: it is no file", scene.display());
        return Refusal::new("usage", message, "leave --watch out, or give a scene file").report();
    }
    let mut is_open = false;
    loop {
        let seen = times(scene, others);
        let words = line::words();
        let words = words.filter(|word| *word != "--watch" && !(is_open && *word == "--open"));
        let default = out.is_none().then_some(["--out", OUT]);
        match line::again().args(words).args(default.into_iter().flatten()).status() {
            Ok(status) => is_open |= status.success(),
            Err(error) => {
                let message = format!("cannot start: {}", crate::say::plain(&error));
                return Refusal::new("usage", message, "leave --watch out").report();
            }
        }
        warn(&format!("watching {}; Ctrl-C ends it", counted(seen.len(), "file")));
        let mut now = seen.clone();
        loop {
            sleep(LOOK);
            let next = times(scene, others);
            // an editor may write a file in parts: a change counts when it has ended
            if next == now && now != seen {
                break;
            }
            now = next;
        }
    }
}

/// The files of a scene with their size and the time of their last change. These are the scene, the files that it names in quotes, and the
/// files that those files name.
fn times(scene: &Path, others: &[&Path]) -> BTreeMap<PathBuf, Option<(SystemTime, u64)>> {
    let mut found = BTreeMap::new();
    let mut open: Vec<PathBuf> = [scene].iter().chain(others).map(|path| path.into()).collect();
    while let Some(path) = open.pop() {
        let facts = path.metadata().ok();
        let state = facts.as_ref().and_then(|facts| Some((facts.modified().ok()?, facts.len())));
        let is_scene = path.extension().is_some_and(|end| end == "toml" || end == "json");
        if found.insert(path.clone(), state).is_none()
            && is_scene
            && facts.is_some_and(|facts| facts.len() < MAX_READ)
        {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let folder = path.parent().unwrap_or(Path::new(""));
            let named = text
                .split(['"', '\''])
                .filter(|word| word.contains('.'))
                .map(|word| folder.join(word));
            open.extend(named.filter(|path| path.is_file()));
        }
    }
    found
}

/// Longest file that is searched for names of other files [bytes]. Longer scenes are generated, and name no files.
const MAX_READ: u64 = 1 << 20;
