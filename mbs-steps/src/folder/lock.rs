//! The lock on a directory: a file in it, locked by the system, which lets go of it when the process ends, however it ends.

use super::error::FolderError;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::Path;

/// The file that is locked, with the number of the process in it.
const LOCK: &str = ".lock";

/// Takes the lock of a directory that is there.
pub(super) fn take(folder: &Path) -> Result<File, FolderError> {
    let path = folder.join(LOCK);
    loop {
        let mut options = File::options();
        let opened = options.read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = match opened {
            // another process has removed what it had made
            Err(error) if error.kind() == ErrorKind::NotFound && !folder.exists() => {
                fs::create_dir_all(folder)?;
                continue;
            }
            opened => opened?,
        };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(FolderError::Busy(process(&mut file))),
            // a file system without locks has none to lose
            Err(TryLockError::Error(_)) | Ok(()) => {}
        }
        // Who had it may have removed it since it was opened.
        if is_at(&file, &path) {
            // Whom it names is of use to a reader alone.
            let _ = name(&mut file);
            return Ok(file);
        }
    }
}

/// Removes the lock file; its lock is held by the caller.
pub(super) fn remove(folder: &Path) {
    let _ = fs::remove_file(folder.join(LOCK));
}

fn name(file: &mut File) -> io::Result<()> {
    file.set_len(0)?;
    file.rewind()?;
    writeln!(file, "{}", std::process::id())
}

fn process(file: &mut File) -> Option<u32> {
    let mut text = String::new();
    file.take(20).read_to_string(&mut text).ok()?;
    text.trim().parse().ok()
}

/// Is the file the one that has that name now?
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |data: fs::Metadata| (data.dev(), data.ino());
    let both = file.metadata().and_then(|open| Ok((place(open), place(fs::metadata(path)?))));
    both.is_ok_and(|(open, there)| open == there)
}

/// Elsewhere a file that is open keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}
