//! Results of a run in its folder: a file has its old or its new content, and one process has the folder at a time.

use mbs::folder::*;
use std::fs;
use std::io;
use std::path::PathBuf;

fn scratch(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("mbs-folder-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    path
}

fn put(folder: &Folder, row: &str) -> Result<String, WriteError> {
    let mut part = folder.begin("id-1")?;
    part.table("run.csv", |sink| sink.write_all(row.as_bytes()))?;
    part.page("run.html", "<p>3 steps</p>\n")?;
    part.finish("run.json", "{\n  \"steps\": 3\n}")
}

#[test]
fn a_directory_is_one_writers_and_leaves_nothing_of_the_lock() {
    let path = scratch("lock").join("a/b");
    let folder = Folder::open(&path, &[]).unwrap();
    let busy = Folder::open(&path, &[]).unwrap_err();
    assert!(matches!(busy, FolderError::Busy(Some(n)) if n == std::process::id()), "{busy}");
    put(&folder, "1\n").unwrap();
    drop(folder);
    let mut names: Vec<_> = fs::read_dir(&path).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["run.csv", "run.html", "run.json"]);
    drop(Folder::open(&path, &[]).unwrap());
    // a folder that was created without results is removed
    let none = scratch("none");
    drop(Folder::open(&none.join("deep"), &[]).unwrap());
    assert!(!none.exists());
    fs::remove_dir_all(scratch("lock")).unwrap_or_default();
}

#[test]
fn what_cannot_be_finished_leaves_the_results_before() {
    let path = scratch("old");
    let folder = Folder::open(&path, &["run.csv"]).unwrap();
    let text = put(&folder, "old\n").unwrap();
    assert_eq!(fs::read_to_string(path.join("run.json")).unwrap(), text + "\n");
    let mut part = folder.begin("id-1").unwrap();
    let full = |sink: &mut dyn io::Write| {
        sink.write_all(b"new\n").and(Err(io::Error::other("no space left on device")))
    };
    let error = part.table("run.csv", full).unwrap_err();
    assert!(error.to_string().contains("run.csv") && error.to_string().contains("no space left"));
    drop(part);
    assert_eq!(fs::read_to_string(path.join("run.csv")).unwrap(), "old\n");
    assert!(!path.join(PART).exists());
    // a killed process releases the folder too; a file or directory that it left does not stop another process
    fs::write(path.join(PART), "left").unwrap();
    put(&folder, "new\n").unwrap();
    assert_eq!(fs::read_to_string(path.join("run.csv")).unwrap(), "new\n");
    drop(folder);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_mixture_is_found_and_stale_tables_go_with_their_results() {
    let path = scratch("mixed");
    let folder = Folder::open(&path, &[]).unwrap();
    let mut part = folder.begin("id-0").unwrap();
    part.table("run.csv", |sink| sink.write_all(b"1\n")).unwrap();
    part.table("realtime.csv", |sink| sink.write_all(b"2\n")).unwrap();
    part.finish("run.json", "{}").unwrap_or_default();
    assert_eq!(Folder::mixed(&path), None);
    put(&folder, "3\n").unwrap();
    assert!(!path.join("realtime.csv").exists());
    assert_eq!(Folder::mixed(&path), None);
    fs::write(path.join("run.csv"), "4\n").unwrap();
    assert_eq!(Folder::mixed(&path), Some(["run.csv", "run.json"].map(str::to_owned)));
    put(&folder, "3\n").unwrap();
    fs::write(path.join("run.html"), "<p>id-2</p>").unwrap();
    assert_eq!(Folder::mixed(&path), Some(["run.html", "run.json"].map(str::to_owned)));
    drop(folder);
    fs::remove_dir_all(path).unwrap();
}

#[test]
fn a_file_for_the_directory_and_a_directory_for_a_file_are_refused() {
    let path = scratch("kinds");
    fs::create_dir_all(path.join("run.csv")).unwrap();
    let taken = Folder::open(&path, &["run.csv"]).unwrap_err();
    assert!(matches!(&taken, FolderError::Taken(at) if at.ends_with("run.csv")), "{taken}");
    fs::write(path.join("file"), "").unwrap();
    assert!(matches!(Folder::open(&path.join("file"), &[]), Err(FolderError::IsFile)));
    assert!(matches!(Folder::open(&path.join("file/deep"), &[]), Err(FolderError::Io(_))));
    fs::remove_dir_all(path).unwrap();
}
