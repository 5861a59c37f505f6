//! Lock of a directory: a file in the directory that the operating system locks. The system releases the lock when the process ends, for
//! any reason.

use super::error::FolderError;
use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::Path;

/// Name of the locked file, which contains the number of the process.
const LOCK: &str = ".lock";

/// Locks an existing directory.
pub(super) fn take(folder: &Path) -> Result<File, FolderError> {
    let path = folder.join(LOCK);
    loop {
        let mut options = File::options();
        let opened = options.read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = match opened {
            // Another process created the directory, used it, and removed it again. So it is created here.
            Err(error) if error.kind() == ErrorKind::NotFound && !folder.exists() => {
                fs::create_dir_all(folder)?;
                continue;
            }
            opened => opened?,
        };
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(FolderError::Busy(process(&mut file))),
            // On a file system without locks the directory is used without a lock.
            Err(TryLockError::Error(_)) | Ok(()) => {}
        }
        // Another process may have removed the lock file after it was opened here. Then the loop tries again.
        if is_at(&file, &path) {
            // The number of the process only informs a reader, so an error is ignored.
            let _ = name(&mut file);
            return Ok(file);
        }
    }
}

/// Removes the lock file; the caller holds its lock.
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

/// True if the open file still has this path in the directory.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |data: fs::Metadata| (data.dev(), data.ino());
    let both = file.metadata().and_then(|open| Ok((place(open), place(fs::metadata(path)?))));
    both.is_ok_and(|(open, there)| open == there)
}

/// Always true here, because these operating systems do not let an open file lose its name.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}
