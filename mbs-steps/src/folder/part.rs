//! Files that are written beside their places, and renamed when they are whole.

use super::mixed::listed;
use super::{Folder, PART};
use crate::fingerprint::Fingerprint;
use core::fmt::{self, Display, Formatter};
use serde_json::{Map, Value};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Results that are not whole yet. Dropped, they are thrown away.
#[derive(Debug)]
pub struct Part<'a> {
    folder: &'a Folder,
    /// Id of these results.
    id: String,
    /// Names of what is written, in this order.
    names: Vec<String>,
    /// Sizes and checksums of the tables.
    sums: [Map<String, Value>; 2],
}

/// A file that could not be written.
#[derive(Debug)]
pub struct WriteError {
    /// Path of the file.
    pub path: PathBuf,
    /// Bytes of it that were written.
    pub bytes: u64,
    /// Error that ended the writing.
    pub error: io::Error,
}

impl Folder {
    /// Begins new results, and removes what an earlier start has left of others. The id of the results is in the JSON object and in the page.
    ///
    /// # Errors
    /// [`WriteError`] where nothing can be written.
    pub fn begin(&self, id: &str) -> Result<Part<'_>, WriteError> {
        let path = self.path.join(PART);
        clear(&path);
        // somebody may have removed all of it meanwhile
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
    /// [`WriteError`]
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

    /// Writes a page, with the id of the results at its end.
    ///
    /// # Errors
    /// [`WriteError`]
    pub fn page(&mut self, name: &str, text: &str) -> Result<(), WriteError> {
        let end = format!("<!-- results {} -->", self.id);
        self.write(name, |sink| writeln!(sink, "{}\n{end}", text.trim_end())).map(drop)
    }

    /// Writes the JSON object, with the id of the results, and with sizes and checksums of the tables so far, and puts everything into
    /// its place. Gives the text of the object.
    ///
    /// # Errors
    /// [`WriteError`]; the results are then those that were there, unless they could not be renamed.
    pub fn finish(mut self, name: &str, object: &str) -> Result<String, WriteError> {
        let text = self.sealed(object);
        self.write(name, |sink| writeln!(sink, "{text}"))?;
        let (folder, part) = (self.folder.path(), self.folder.path().join(PART));
        let before = listed(&folder.join(name));
        for name in &self.names {
            let (from, to) = (part.join(name), folder.join(name));
            fs::rename(from, &to).map_err(|error| WriteError { path: to, bytes: 0, error })?;
        }
        // tables of the results before that these have not
        for old in before.into_iter().filter(|old| !self.names.contains(old)) {
            let _ = fs::remove_file(folder.join(old));
        }
        sync(folder);
        Ok(text)
    }

    /// An object with what else its file has.
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

    /// Writes and syncs a file; its size and checksum.
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

/// Replaces a file of the user's by another that is whole, or writes into what is no file: a pipe, say.
///
/// # Errors
/// [`WriteError`]; the file is then as it was.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    // a link stays one
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

/// Replaces a file of a directory that one process writes by another that is whole: after a kill or a crash it has the old bytes or the new
/// ones. Until then they are in [`PART`].
///
/// # Errors
/// [`WriteError`] with the path.
pub fn write_whole(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
    let (part, path) = (folder.join(PART), folder.join(name));
    let beside = part.join(name);
    // where it cannot be made nothing can be written in it
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

/// Writes and syncs a file; its size and checksum.
fn written(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(u64, u64), WriteError> {
    let failed = |bytes, error| WriteError { path: path.to_owned(), bytes, error };
    let file = File::create(path).map_err(|error| failed(0, error))?;
    let mut sink = BufWriter::new(Summed { file, bytes: 0, sum: Fingerprint::new() });
    let done = write(&mut sink).and_then(|()| sink.flush());
    let (Summed { file, bytes, sum }, _) = sink.into_parts();
    // what is no file has nothing to sync
    let is_file = file.metadata().is_ok_and(|data| data.is_file());
    let done = done.and_then(|()| if is_file { file.sync_all() } else { Ok(()) });
    done.map(|()| (bytes, sum.get())).map_err(|error| failed(bytes, error))
}

/// A file whose bytes are counted and summed.
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

/// Removes what was not finished; a file of that name too.
fn clear(part: &Path) {
    let _ = if part.is_dir() { fs::remove_dir_all(part) } else { fs::remove_file(part) };
}

/// Names are in the directory; where directories cannot be synced there is nothing more to do.
fn sync(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

impl Display for WriteError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (path, error) = (self.path.display(), self.error.to_string());
        // the system's words without their number
        let words = error.split(" (os error").next().unwrap_or_default().to_lowercase();
        write!(f, "cannot write to `{path}`: {words}")?;
        if self.bytes > 0 { write!(f, " after {} bytes", self.bytes) } else { Ok(()) }
    }
}

impl core::error::Error for WriteError {}
