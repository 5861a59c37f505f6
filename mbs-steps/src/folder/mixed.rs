//! Detection of files that do not belong to the same results.

use crate::fingerprint::Fingerprint;
use serde_json::{Map, Value};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Names of the JSON objects that list other files, each with the name of its HTML page.
const OBJECTS: [[&str; 2]; 4] = [
    ["run.json", "run.html"],
    ["compare.json", "compare.html"],
    ["explain.json", "explain.html"],
    ["doctor.json", "doctor.html"],
];

/// Returns the name of the first file that does not belong to the results of its JSON object, and the name of that object.
pub(super) fn find(folder: &Path) -> Option<[String; 2]> {
    OBJECTS.into_iter().find_map(|[object, page]| {
        let value = read(&folder.join(object))?;
        let texts = |key: &str| value.get(key).and_then(Value::as_object).cloned();
        let other = match (texts("files"), texts("checksums")) {
            (Some(files), Some(checksums)) => other_table(folder, &files, &checksums),
            _ => None,
        };
        let id = value.get("id").and_then(Value::as_str).unwrap_or_default();
        let is_other = || std::fs::read_to_string(folder.join(page)).is_ok_and(|t| !t.contains(id));
        let other = other.or_else(|| is_other().then(|| page.to_owned()))?;
        Some([other, object.to_owned()])
    })
}

/// The names of the tables that a JSON object lists.
pub(super) fn listed(object: &Path) -> Vec<String> {
    let files = read(object).and_then(|value| value.get("files")?.as_object().cloned());
    // A name that contains a path is not a table of the results.
    let is_ours = |name: &String| Path::new(name).file_name().is_some_and(|file| file == &**name);
    files
        .into_iter()
        .flat_map(|files| files.keys().cloned().collect::<Vec<_>>())
        .filter(is_ours)
        .collect()
}

fn read(object: &Path) -> Option<Value> {
    serde_json::from_slice(&std::fs::read(object).ok()?).ok()
}

fn other_table(
    folder: &Path,
    files: &Map<String, Value>,
    checksums: &Map<String, Value>,
) -> Option<String> {
    files.iter().find_map(|(name, bytes)| {
        let listed = checksums.get(name).and_then(Value::as_str)?;
        let is_same = sum(&folder.join(name))
            .is_some_and(|(n, sum)| bytes.as_u64() == Some(n) && format!("{sum:016x}") == listed);
        (!is_same).then(|| name.clone())
    })
}

/// Size and checksum of a file.
fn sum(path: &Path) -> Option<(u64, u64)> {
    let mut file = File::open(path).ok()?;
    let (mut n, mut sum, mut buffer) = (0, Fingerprint::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut buffer).ok()? {
            0 => return Some((n, sum.get())),
            read => {
                n += read as u64;
                sum.add(&buffer[..read]);
            }
        }
    }
}
