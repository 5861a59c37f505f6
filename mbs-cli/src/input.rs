//! Reading of files, and the messages when they cannot be read.

use crate::model;
use crate::refusal::Refusal;
use crate::say::{plain, warn};
use mbs::models::{ImportOptions, is_model, scene_file};
use mbs::scene_file::{SceneFile, nearest_name};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Largest size of a file that is read without `--big`, in bytes. Chosen, not tuned.
const MOST_BYTES: u64 = 64 << 20;
/// Largest number of values in a file that is read without `--big`: each takes 150 bytes of memory, even if its text is short.
const MOST_VALUES: usize = 8_000_000;
/// True if files of any size are read. The command line sets it once.
static IS_BIG: AtomicBool = AtomicBool::new(false);

/// Allows files of any size from now on.
pub(crate) fn read_big() {
    IS_BIG.store(true, Ordering::Relaxed);
}

/// True if a path means standard input.
pub(crate) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Reads a file of the kind `what`. A model is converted with the given options. Otherwise returns the refusal.
pub(crate) fn document(
    path: &Path,
    what: &str,
    (options, geometry_alone): (Option<ImportOptions>, bool),
) -> Result<SceneFile, Refusal> {
    let bytes = read(path, what)?;
    // each value has a comma or an equals sign next to it, so their number bounds that of the values
    let values = bytes.iter().filter(|byte| matches!(byte, b',' | b'=')).count();
    if values > MOST_VALUES && !IS_BIG.load(Ordering::Relaxed) {
        return Err(too_large(
            path,
            &format!("has more than {} million values", MOST_VALUES / 1_000_000),
        ));
    }
    let name = name(path);
    if options.is_some() && !is_model(&bytes) {
        let message = format!("`{name}` is no model, and `--import` is for models");
        return Err(Refusal::new("usage", message, "leave out --import"));
    }
    let folder = if is_standard(path) { None } else { path.parent() };
    let folder = folder.unwrap_or(Path::new("")).to_owned();
    let options = match options {
        Some(options) => ImportOptions { folder: Some(folder), ..options },
        None => ImportOptions::in_folder(folder),
    };
    let options = ImportOptions { geometry_alone, ..options };
    let document = scene_file(&bytes, &name, &options);
    let (document, imported) = document.map_err(|error| {
        let code = if is_model(&bytes) { "model-refused" } else { "scene-refused" };
        Refusal::read(code, &error)
    })?;
    if let Some(model) = imported {
        warn(&model::note(&name, &model));
    }
    Ok(document)
}

/// The name of a file in messages.
pub(crate) fn name(path: &Path) -> String {
    if is_standard(path) { "standard input".to_owned() } else { path.display().to_string() }
}

/// The bytes of a file of the kind `what`; otherwise the refusal.
pub(crate) fn read(path: &Path, what: &str) -> Result<Vec<u8>, Refusal> {
    let bytes = bytes(path).map_err(|error| unreadable(path, what, &error))?;
    bytes.ok_or_else(|| too_large(path, &format!("is larger than {} MiB", MOST_BYTES >> 20)))
}

fn too_large(path: &Path, why: &str) -> Refusal {
    let hint = "write --big to read it nevertheless: it may take eighty times its size in memory";
    Refusal::new("too-large", format!("`{}` {why}", path.display()), hint)
}

/// The bytes of a file; `None` if it is too large.
fn bytes(path: &Path) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    let is_big = IS_BIG.load(Ordering::Relaxed);
    let mut source: Box<dyn Read> = if is_standard(path) {
        Box::new(io::stdin().lock())
    } else {
        let file = File::open(path)?;
        if !is_big && file.metadata()?.len() > MOST_BYTES {
            return Ok(None);
        }
        Box::new(file)
    };
    if is_big {
        return source.read_to_end(&mut bytes).map(|_| Some(bytes));
    }
    // a device reports no size and may be endless
    source.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= MOST_BYTES).then_some(bytes))
}

/// The names of files in the folder of a path that have the same extension.
fn files_like(path: &Path) -> Vec<String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let Ok(entries) = std::fs::read_dir(folder.unwrap_or(Path::new("."))) else {
        return Vec::new();
    };
    let files = entries.filter_map(Result::ok).map(|entry| entry.path());
    let Some(ending) = path.extension() else { return Vec::new() };
    let like = files.filter(|file| file.is_file() && file.extension() == Some(ending));
    let mut names: Vec<String> = like.map(|file| name_of(&file)).collect();
    names.sort();
    names
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The refusal of a file that cannot be read.
fn unreadable(path: &Path, what: &str, error: &io::Error) -> Refusal {
    // a sweep file has one of the extensions of scene files too
    let is_scene = ["scene file", "sweep file"].contains(&what);
    let with_ending = Some(path.with_extension("toml")).filter(|file| is_scene && file.is_file());
    let hint = if path.is_dir() {
        format!("that is a directory; give a {what} in it")
    } else if path.exists() {
        format!("give a {what} that this user may read")
    } else if let Some(file) = with_ending {
        format!("did you mean `{}`?", file.display())
    } else {
        let near = nearest_name(&name_of(path), &files_like(path), "files there");
        let model = if what == "scene file" { ", or is a model" } else { "" };
        let ending =
            if is_scene { format!("; it ends with .toml or .json{model}") } else { String::new() };
        let usual = format!("give the path of a {what}{ending}");
        if near.starts_with("did you mean") { near } else { usual }
    };
    let message = format!("cannot read `{}`: {}", path.display(), plain(error));
    Refusal::new("file-unreadable", message, hint)
}
