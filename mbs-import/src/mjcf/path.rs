//! Files beside the model.

use crate::context::Context;
use crate::element::Attribute;
use crate::source::Read;
use std::path::{Path, PathBuf};

/// The file whose place an attribute says, from the first of the folders in which it is; the first one is that of the model.
pub(super) fn find(
    file: &Attribute,
    name: &Path,
    folders: &[&Path],
    context: &Context<'_>,
) -> Read<PathBuf> {
    let Some(home) = &context.options.folder else {
        let hint = "give the model as a file, or put what is in the other file here";
        return Err(file.fault("this text has no folder, from which it could read files", hint));
    };
    let all = core::iter::once(home.as_path()).chain(folders.iter().copied());
    let found = all.map(|folder| folder.join(name)).find(|path| path.is_file());
    let found = found.and_then(|path| path.canonicalize().ok()).ok_or_else(|| {
        let message = format!("there is no file `{}`", home.join(name).display());
        file.fault(message, "give its place from the folder of the first file")
    })?;
    let home = if home.as_os_str().is_empty() { Path::new(".") } else { home };
    let is_inside = home.canonicalize().is_ok_and(|home| found.starts_with(home));
    if context.options.no_outside && !is_inside {
        let message = format!("`{}` lies outside of the folder of the first file", file.value);
        return Err(file.fault(message, "leave out --no-outside where you trust the file"));
    }
    Ok(found)
}
