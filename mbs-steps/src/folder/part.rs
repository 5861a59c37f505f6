//! Files that are written into a temporary directory, and renamed when they are complete.

use super::mixed::listed;
use super::{Folder, PART};
use crate::fingerprint::Fingerprint;
use core::fmt::{self, Display, Formatter};
use serde_json::{Map, Value};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Results that are not complete yet. If the value is dropped, their files are removed.
#[derive(Debug)]
pub struct Part<'a> {
    folder: &'a Folder,
    /// Identifier of these results.
    id: String,
    /// Names of the written files, in the order in which they were written.
    names: Vec<String>,
    /// Sizes of the tables by name, and checksums of the tables by name.
    sums: [Map<String, Value>; 2],
}

/// A file that could not be written.
#[derive(Debug)]
pub struct WriteError {
    /// Path of the file.
    pub path: PathBuf,
    /// Number of bytes written before the error.
    pub bytes: u64,
    /// Error that ended the writing.
    pub error: io::Error,
}

impl Folder {
    /// Begins new results, and removes incomplete results of an earlier process. The JSON object and the page contain the identifier `id`.
    ///
    /// # Errors
    /// [`WriteError`] if the directory cannot be written.
    pub fn begin(&self, id: &str) -> Result<Part<'_>, WriteError> {
        let path = self.path.join(PART);
        clear(&path);
        // Another program may have removed the directory after it was opened.
        match fs::create_dir_all(&path) {
            Ok(()) => {
                let (id, names, sums) = (id.to_owned(), Vec::new(), Default::default());
                Ok(Part { folder: self, id, names, sums })
            }
            Err(error) => Err(WriteError { path, bytes: 0, error }),
        }
    }
}

impl Part<'_> {
    /// Writes a table of the results.
    ///
    /// # Errors
    /// [`WriteError`] if the file cannot be written.
    pub fn table(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let (bytes, sum) = self.write(name, write)?;
        self.sums[0].insert(name.to_owned(), bytes.into());
        self.sums[1].insert(name.to_owned(), format!("{sum:016x}").into());
        Ok(())
    }

    /// Writes an HTML page, with the identifier of the results at its end.
    ///
    /// # Errors
    /// [`WriteError`] if the file cannot be written.
    pub fn page(&mut self, name: &str, text: &str) -> Result<(), WriteError> {
        let end = format!("<!-- results {} -->", self.id);
        self.write(name, |sink| writeln!(sink, "{}\n{end}", text.trim_end())).map(drop)
    }

    /// Writes the JSON object, and renames all files to their final names. The object also gets the identifier of the results, and the
    /// sizes and checksums of the tables. Returns the text of the object.
    ///
    /// # Errors
    /// [`WriteError`]; the old results are unchanged then, unless a rename failed.
    pub fn finish(mut self, name: &str, object: &str) -> Result<String, WriteError> {
        let text = self.sealed(object);
        self.write(name, |sink| writeln!(sink, "{text}"))?;
        let (folder, part) = (self.folder.path(), self.folder.path().join(PART));
        let before = listed(&folder.join(name));
        for name in &self.names {
            let (from, to) = (part.join(name), folder.join(name));
            fs::rename(from, &to).map_err(|error| WriteError { path: to, bytes: 0, error })?;
        }
        // Tables of the old results are removed if the new results have no table of that name.
        for old in before.into_iter().filter(|old| !self.names.contains(old)) {
            let _ = fs::remove_file(folder.join(old));
        }
        sync(folder);
        Ok(text)
    }

    /// Adds the identifier, sizes and checksums to the text of a JSON object.
    fn sealed(&self, object: &str) -> String {
        let Some(inner) = object.trim_end().strip_suffix('}') else { return object.to_owned() };
        let [files, checksums] = self.sums.clone().map(Value::Object);
        let inner = inner.trim_end();
        let id = &self.id;
        let comma = if inner.ends_with('{') { "" } else { "," };
        format!(
            "{inner}{comma}\n  \"id\": \"{id}\",\n  \"files\": {files},\n  \"checksums\": {checksums}\n}}"
        )
    }

    /// Writes and syncs a file of the results; returns its size and checksum.
    fn write(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(u64, u64), WriteError> {
        let path = self.folder.path().join(PART).join(name);
        let done = written(&path, write)?;
        self.names.push(name.to_owned());
        Ok(done)
    }
}

impl Drop for Part<'_> {
    fn drop(&mut self) {
        clear(&self.folder.path().join(PART));
    }
}

/// Replaces a file by complete new content. A path that is no regular file, such as a pipe, is written directly.
///
/// # Errors
/// [`WriteError`]; the file is unchanged then.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    // A symbolic link remains a link; its target is replaced.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let all = |sink: &mut dyn Write| sink.write_all(bytes);
    if fs::metadata(&place).is_ok_and(|data| !data.is_file()) {
        return written(&place, all).map(drop);
    }
    let mut beside = place.as_os_str().to_owned();
    beside.push(format!(".{}.part", std::process::id()));
    let beside = PathBuf::from(beside);
    let done = written(&beside, all).map_err(|error| WriteError { path: path.to_owned(), ..error });
    let renamed = done.and_then(|_| {
        let error = |error| WriteError { path: path.to_owned(), bytes: 0, error };
        fs::rename(&beside, &place).map_err(error)
    });
    if renamed.is_err() {
        let _ = fs::remove_file(&beside);
    }
    renamed
}

/// Replaces a file in a directory of results by complete new content. The new bytes are first written into [`PART`]. After a kill or a
/// crash the file has either all old bytes or all new bytes.
///
/// # Errors
/// [`WriteError`] with the path of the file.
pub fn write_whole(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
    let (part, path) = (folder.join(PART), folder.join(name));
    let beside = part.join(name);
    // If the directory cannot be created, the write below fails and reports the error.
    let _ = fs::create_dir_all(&part);
    let done = written(&beside, |sink| sink.write_all(bytes)).and_then(|_| {
        let error = |error| WriteError { path, bytes: 0, error };
        fs::rename(&beside, folder.join(name)).map_err(error)
    });
    if done.is_err() {
        let _ = fs::remove_file(&beside);
    }
    sync(folder);
    done
}

/// Writes and syncs a file; returns its size and checksum.
fn written(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(u64, u64), WriteError> {
    let failed = |bytes, error| WriteError { path: path.to_owned(), bytes, error };
    let file = File::create(path).map_err(|error| failed(0, error))?;
    let mut sink = BufWriter::new(Summed { file, bytes: 0, sum: Fingerprint::new() });
    let done = write(&mut sink).and_then(|()| sink.flush());
    let (Summed { file, bytes, sum }, _) = sink.into_parts();
    // Only regular files can be synced.
    let is_file = file.metadata().is_ok_and(|data| data.is_file());
    let done = done.and_then(|()| if is_file { file.sync_all() } else { Ok(()) });
    done.map(|()| (bytes, sum.get())).map_err(|error| failed(bytes, error))
}

/// Writer to a file that counts the bytes and computes their checksum.
struct Summed {
    file: File,
    bytes: u64,
    sum: Fingerprint,
}

impl Write for Summed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = self.file.write(bytes)?;
        self.bytes += n as u64;
        self.sum.add(&bytes[..n]);
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Removes the directory of incomplete results, or a file with its name.
fn clear(part: &Path) {
    let _ = if part.is_dir() { fs::remove_dir_all(part) } else { fs::remove_file(part) };
}

/// Syncs a directory, so that renamed files survive a crash. Errors are ignored, because some systems cannot sync directories.
fn sync(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

impl Display for WriteError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (path, error) = (self.path.display(), self.error.to_string());
        // The message of the operating system is written without its error number.
        let words = error.split(" (os error").next().unwrap_or_default().to_lowercase();
        write!(f, "cannot write to `{path}`: {words}")?;
        if self.bytes > 0 { write!(f, " after {} bytes", self.bytes) } else { Ok(()) }
    }
}

impl core::error::Error for WriteError {}
