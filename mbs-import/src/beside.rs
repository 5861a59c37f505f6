//! Files that a model refers to: their paths, and included files with limits on their number.

use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::options::ImportOptions;
use crate::source::{MOST_BYTES, Origin, Read};
use crate::xml;
use std::path::{Path, PathBuf};

/// Largest depth of files that include one another [-].
const MAX_DEPTH: usize = 32;
/// Largest number of files that a model includes [-].
const MAX_FILES: usize = 1_000;

/// The folder of the model, to which the path in an attribute is relative. `hint` is the advice in the error when there is no folder.
pub(crate) fn home<'a>(file: &Attribute, hint: &str, context: &'a Context<'_>) -> Read<&'a Path> {
    context
        .options
        .folder
        .as_deref()
        .ok_or_else(|| file.fault("this text has no folder, from which it could read files", hint))
}

/// The file `name` in the folder of the model if it exists, or else the file `other`.
pub(crate) fn find(
    file: &Attribute,
    name: &Path,
    other: Option<&Path>,
    context: &Context<'_>,
) -> Read<PathBuf> {
    let hint = "give the model as a file, or put what is in the other file here";
    let home = home(file, hint, context)?;
    let all = core::iter::once(home.join(name)).chain(other.map(Path::to_owned));
    let found = first(file, all, context)?;
    found.ok_or_else(|| {
        let message = format!("there is no file `{}`", home.join(name).display());
        file.fault(message, "give its place from the folder of the first file")
    })
}

/// Possible paths of a file that is named in a file of this folder. A package or model is sought in the folder given for it, then in the
/// search path, then in the parent folders.
///
/// The error is a URI scheme that is not supported.
pub(crate) fn places<'a>(
    written: &'a str,
    folder: &Path,
    options: &ImportOptions,
) -> Result<Vec<PathBuf>, &'a str> {
    if let Some((package, rest)) = package(written) {
        return Ok(in_package(package, rest, folder, options));
    }
    match written.split_once("://") {
        None => Ok(vec![folder.join(written)]),
        Some(("file", place)) => Ok(vec![folder.join(place)]),
        Some((scheme, _)) => Err(scheme),
    }
}

/// The package or model of a URI, and the path in it.
pub(crate) fn package(written: &str) -> Option<(&str, &str)> {
    let Some(("package" | "model", rest)) = written.split_once("://") else { return None };
    let rest = rest.trim_start_matches('/');
    Some(rest.split_once('/').unwrap_or((rest, "")))
}

fn in_package(package: &str, rest: &str, folder: &Path, options: &ImportOptions) -> Vec<PathBuf> {
    let given = options.packages.iter().filter(|(name, _)| name == package);
    let given = given.map(|(_, folder)| folder.join(rest));
    let folder = whole(folder);
    let around = options.package_path.iter().map(PathBuf::as_path).chain(folder.ancestors());
    let around = around.flat_map(|folder| {
        let is_it = folder.file_name().is_some_and(|name| name == package);
        let own = is_it.then(|| folder.join(rest));
        [Some(folder.join(package).join(rest)), own].into_iter().flatten()
    });
    given.chain(around).collect()
}

/// The absolute path without links and dots; a path that does not exist is returned unchanged.
pub(crate) fn whole(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

/// The absolute path of the first existing file among some paths.
pub(crate) fn existing(places: impl IntoIterator<Item = PathBuf>) -> Option<PathBuf> {
    places.into_iter().find(|path| path.is_file())?.canonicalize().ok()
}

/// True if a file is outside of the model's folder and the options forbid this. `path` is absolute.
pub(crate) fn is_barred(path: &Path, options: &ImportOptions) -> bool {
    let is_inside = |home: &Path| path.starts_with(whole(home));
    options.no_outside && !options.folder.as_deref().is_some_and(is_inside)
}

/// The absolute path of the first existing file among some paths. A file outside of the allowed folder is an error.
pub(crate) fn first(
    file: &Attribute,
    places: impl IntoIterator<Item = PathBuf>,
    context: &Context<'_>,
) -> Read<Option<PathBuf>> {
    let found = existing(places);
    if found.as_ref().is_some_and(|path| is_barred(path, context.options)) {
        let message = format!("`{}` lies outside of the folder of the first file", file.value);
        return Err(file.fault(message, "leave out --no-outside where you trust the file"));
    }
    Ok(found)
}

/// Included files: those that are open now, and the number of all so far.
#[derive(Debug, Default)]
pub(crate) struct Included {
    chain: Vec<PathBuf>,
    files: usize,
    bytes: u64,
}

impl Included {
    /// Opens the file that an attribute names, and returns its root element.
    pub(crate) fn open(
        &mut self,
        file: &Attribute,
        path: PathBuf,
        by: Origin,
        context: &mut Context<'_>,
    ) -> Read<Element> {
        if self.chain.contains(&path) {
            let names: Vec<_> = self.chain.iter().map(|path| path.display().to_string()).collect();
            let message = format!("`{}` includes itself: {}", file.value, names.join(" includes "));
            return Err(file.fault(message, "leave out one of these includes"));
        }
        self.files += 1;
        if self.chain.len() == MAX_DEPTH || self.files > MAX_FILES {
            let message =
                format!("more than {MAX_DEPTH} files in each other, or {MAX_FILES} files in all");
            return Err(file.fault(message, "put the elements into fewer files"));
        }
        let text = self.text(&path, file)?;
        let source = context.sources.add(&path.display().to_string(), &text, Some(by));
        self.chain.push(path);
        xml::read(&text, source)
    }

    /// Closes the file that was opened last.
    pub(crate) fn close(&mut self) {
        self.chain.pop();
    }

    /// The folder of the open file, if there is one.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.chain.last().and_then(|path| path.parent())
    }

    fn text(&mut self, path: &Path, file: &Attribute) -> Read<String> {
        let unread = |error: std::io::Error| {
            let message = format!("`{}` cannot be read: {error}", file.value);
            file.fault(message, "give it to be read")
        };
        self.bytes += std::fs::metadata(path).map_err(unread)?.len();
        if self.bytes > MOST_BYTES as u64 {
            let message = format!("included files have more than {} MB", MOST_BYTES >> 20);
            return Err(file.fault(message, "give a smaller model"));
        }
        let bytes = std::fs::read(path).map_err(unread)?;
        String::from_utf8(bytes).map_err(|_| {
            file.fault(format!("`{}` is not UTF-8 text", file.value), "save the file as UTF-8")
        })
    }
}
