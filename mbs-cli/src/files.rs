//! Scene files in, result files out, and what to say when that fails.

use mbs::core::scene::{Entry, Scene};
use mbs::scene_file::{Choice, Document, Provenance, readable};
use mbs::{Overrides, Settings, SettingsError};
use std::path::Path;

/// Reads a scene file and its scene; else the refusal.
pub(crate) fn scene(path: &Path) -> Result<(Document, Scene<f64>), String> {
    let document = document(path, "scene file")?;
    let scene = document.scene::<f64>().map_err(|error| error.render())?;
    Ok((document, scene))
}

/// What a command that runs a scene begins with: reads it, settles how it is run, and tries the place of its results, since what
/// cannot be written should not be computed; else the refusal.
pub(crate) fn begin(
    path: &Path,
    overrides: &Overrides,
    (out, first): (Option<&Path>, &str),
) -> Result<(Document, Scene<f64>, Settings), String> {
    let (document, scene) = scene(path)?;
    let settings = Settings::new(&scene, overrides)
        .and_then(|settings| settings.check_step(&scene, overrides).map(|()| settings));
    let settings = settings.map_err(|e| refusal(&e, &document))?;
    if let Some(out) = out {
        prepare(out, first).map_err(|error| unwritable(out, &error))?;
    }
    Ok((document, scene, settings))
}

/// Reads a file of a kind that is called `what`; else the refusal.
pub(crate) fn document(path: &Path, what: &str) -> Result<Document, String> {
    let bytes = std::fs::read(path).map_err(|error| unreadable(path, what, &error))?;
    let document = Document::from_bytes(&bytes, &path.display().to_string());
    document.map_err(|error| error.render())
}

/// A refusal of settings, with its place when the scene asks for them.
pub(crate) fn refusal(error: &SettingsError, document: &Document) -> String {
    match error {
        SettingsError::NotBuilt { key, from_scene: true, .. } => {
            let place = document.place(Entry::Solver, key);
            place.render(document.file(), &error.to_string(), &error.hint())
        }
        SettingsError::Scene(error) => document.meaning(*error).render(),
        _ => format!("error: {error}\nhint: {}", error.hint()),
    }
}

/// Makes the directory and tries to write a file of it.
pub(crate) fn prepare(out: &Path, file: &str) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    std::fs::File::create(out.join(file)).map(drop)
}

/// How a result was made: the command with the options that were given.
pub(crate) fn provenance(
    (command, scene): (&str, &Path),
    options: &[(&str, Option<String>)],
    settings: &Settings,
) -> Provenance {
    let mut command = format!("mbs {command} {}", scene.display());
    for (key, value) in options {
        if let Some(value) = value {
            command.push_str(format!(" --{key} {value}").trim_end());
        }
    }
    Provenance {
        command,
        precision: settings.precision.name().to_owned(),
        formulation: settings.formulation.name().to_owned(),
        integrator: settings.integrator.name().to_owned(),
        step: format!("{} s", readable(settings.step)),
        version: format!("mbs {}", env!("CARGO_PKG_VERSION")),
        cpu: processor(),
    }
}

/// The processor's name, where the system tells it.
pub(crate) fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find(|l| l.starts_with("model name"));
    line.and_then(|l| l.split_once(':')).map(|(_, name)| name.trim().to_owned()).unwrap_or_default()
}

/// The message for a file that cannot be read.
fn unreadable(path: &Path, what: &str, error: &std::io::Error) -> String {
    let with_ending = path.with_extension("toml");
    let hint = if path.is_dir() {
        format!("that is a directory; give a {what} in it")
    } else if with_ending.is_file() {
        format!("did you mean `{}`?", with_ending.display())
    } else {
        format!("give the path of a {what}; it ends with .toml")
    };
    format!("error: cannot read `{}`: {}\nhint: {hint}", path.display(), plain(error))
}

/// The evidence of a choice, as an object and as a table.
pub(crate) fn write_choice(out: &Path, choice: &Choice) -> std::io::Result<()> {
    let text = serde_json::to_string_pretty(choice).unwrap_or_default();
    std::fs::write(out.join("choice.json"), text + "\n")?;
    mbs::scene_file::write_choice(std::fs::File::create(out.join("choice.csv"))?, choice)
}

/// The message for a directory that cannot be written.
pub(crate) fn unwritable(out: &Path, error: &std::io::Error) -> String {
    let (out, error) = (out.display(), plain(error));
    format!(
        "error: cannot write to `{out}`: {error}\nhint: give a directory that can be made or written with --out"
    )
}

/// The message for a file that cannot be written.
pub(crate) fn unwritable_file(file: &Path, error: &std::io::Error) -> String {
    let (file, error) = (file.display(), plain(error));
    format!(
        "error: cannot write to `{file}`: {error}\nhint: give a file in a directory that is there"
    )
}

/// The system's words without the number of the error.
fn plain(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}
