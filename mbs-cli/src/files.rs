//! Scenes in, result files out, and what to say when that fails.

use crate::input::read;
use crate::refusal::Refusal;
use crate::say::warn;
use crate::scene::SceneArgument;
use mbs::core::scene::{Entry, Scene};
use mbs::folder::{Folder, WriteError, id, write_file};
use mbs::record::{PilotReport, Provenance};
use mbs::scene_file::format::significant;
use mbs::scene_file::{ReadError, SceneFile};
use mbs::{
    Error as _, INTERRUPTED, InputTable, InputTableError, Mechanism, Method, ResolvedMethod,
    SettingsError, SimulationError,
};
use std::path::Path;
use std::process::ExitCode;

/// Scene, settings and folder of results with which a command that runs a scene begins.
pub(crate) struct Begun {
    pub(crate) mechanism: Mechanism,
    /// Scene file of the mechanism.
    pub(crate) document: SceneFile,
    pub(crate) scene: Scene<f64>,
    pub(crate) settings: ResolvedMethod,
    /// Folder of the results; `None`: no files are written.
    pub(crate) folder: Option<Folder>,
}

/// Reads a scene, settles how it is run, and takes the place of its results, since what cannot be written should not be computed; else the
/// refusal.
pub(crate) fn begin(
    scene: &SceneArgument,
    overrides: &Method,
    (out, files): (Option<&Path>, &[&str]),
) -> Result<Begun, Refusal> {
    let document = scene.document()?;
    let mechanism = Mechanism::of_file(document.clone());
    let mechanism = mechanism.map_err(|error| Refusal::read("scene-refused", &error))?;
    let scene = mechanism.resolve().map_err(|error| refused(&error, &document))?;
    let settings = ResolvedMethod::new(&scene, overrides)
        .and_then(|settings| settings.check_step(&scene, overrides).map(|()| settings))
        .map_err(|e| refusal(&e, &document))?;
    let folder = out.map(|out| folder(out, files)).transpose()?;
    Ok(Begun { mechanism, document, scene, settings, folder })
}

/// The table of a file that inputs follow; else the refusal.
pub(crate) fn input_table(file: &Path) -> Result<InputTable, Refusal> {
    Ok(InputTable::csv(&read(file, "table of inputs")?, &file.display().to_string()))
}

/// The refusal of a run, with its place where it has one.
pub(crate) fn refused(error: &SimulationError, document: &SceneFile) -> Refusal {
    if let Some(error) = error.cause::<ReadError>() {
        return Refusal::read("scene-refused", error);
    }
    if let Some(error) = error.cause::<SettingsError>() {
        return refusal(error, document);
    }
    let refusal = Refusal::new(error.code(), error.message(), error.hint().unwrap_or_default());
    match error.cause::<InputTableError>() {
        Some(InputTableError::Table { file, place, .. }) => refusal.at(file, place.clone()),
        _ if error.code() == INTERRUPTED => refusal.stopped(),
        _ => refusal,
    }
}

/// Takes a directory for results in these files; else the refusal.
pub(crate) fn folder(out: &Path, files: &[&str]) -> Result<Folder, Refusal> {
    let folder = Folder::open(out, files).map_err(|error| Refusal::folder(out, &error))?;
    warn_of_mixed(out);
    Ok(folder)
}

/// Warns of files in a directory that do not belong to its results.
pub(crate) fn warn_of_mixed(folder: &Path) {
    if let Some([file, object]) = Folder::mixed(folder) {
        warn(&format!(
            "warning: `{file}` in `{}` does not belong to the results of `{object}`: it was changed, or a process was killed between two \
             files",
            folder.display()
        ));
    }
}

/// Writes a file that is named alone, unless it is the one that was read; else the refusal.
pub(crate) fn write(path: &Path, bytes: &[u8], input: Option<&Path>) -> Result<(), Refusal> {
    let place = |path: &Path| path.canonicalize().ok();
    if input.is_some_and(|input| place(input).is_some() && place(input) == place(path)) {
        let message = format!("`{}` is the scene that is read", path.display());
        return Err(Refusal::new("out-unwritable", message, "give another file"));
    }
    write_file(path, bytes).map_err(|error| Refusal::unwritable(&error))
}

/// A refusal of settings, with its place when the scene asks for them.
pub(crate) fn refusal(error: &SettingsError, document: &SceneFile) -> Refusal {
    let refusal = Refusal::settings(error);
    match error {
        SettingsError::NotBuilt { key, from_scene: true, .. } => {
            let (file, place) = document.place(Entry::Solver, key);
            refusal.at(file, place)
        }
        SettingsError::Scene(error) => Refusal::read("scene-refused", &document.meaning(*error)),
        _ => refusal,
    }
}

/// The id of results of a scene that was run with these settings.
pub(crate) fn results_id(document: &SceneFile, settings: &ResolvedMethod) -> String {
    // what a pilot measured differs from time to time, and threads change no bit
    let same = ResolvedMethod { choice: None, threads: 1, ..settings.clone() };
    id(&[&document.whole_text(), &format!("{same:?}")])
}

/// Replaces an object and its page in the directory, where there is one; gives the object as it is there, and what to say of it.
pub(crate) fn write_report(
    begun: &Begun,
    name: &str,
    (object, report): (String, &mbs_report::Report),
    status: &mut ExitCode,
) -> (String, String) {
    let Some(folder) = &begun.folder else { return (object, String::new()) };
    let [json, html] = ["json", "html"].map(|ending| format!("{name}.{ending}"));
    let write = || {
        let mut part = folder.begin(&results_id(&begun.document, &begun.settings))?;
        part.page(&html, &report.page())?;
        part.finish(&json, &object)
    };
    let out = folder.path().display();
    match Refusal::unless_lost(write(), status) {
        Some(whole) => (whole, format!("\nwrote {json} and {html} to {out}\n")),
        None => (object, String::new()),
    }
}

/// A command line with the options that were given.
pub(crate) fn command_line(begin: &str, options: &[(&str, Option<String>)]) -> String {
    let given = options.iter().filter_map(|(key, value)| Some((key, value.as_ref()?)));
    given.fold(format!("mbs {begin}"), |line, (key, value)| {
        line + format!(" --{key} {value}").trim_end()
    })
}

/// How a result was made: the command with the options that were given.
pub(crate) fn provenance(
    (command, scene): (&str, &SceneArgument),
    options: &[(&str, Option<String>)],
    settings: &ResolvedMethod,
) -> Provenance {
    Provenance {
        command: command_line(&format!("{command} {}", scene.line()), options),
        precision: settings.precision.name().to_owned(),
        formulation: settings.formulation.name().to_owned(),
        integrator: settings.integrator.name().to_owned(),
        step: format!("{} s", significant(settings.step)),
        version: format!("mbs {}", env!("CARGO_PKG_VERSION")),
        cpu: processor(),
    }
}

/// The processor's name, where the system reports it.
pub(crate) fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find(|l| l.starts_with("model name"));
    line.and_then(|l| l.split_once(':')).map(|(_, name)| name.trim().to_owned()).unwrap_or_default()
}

/// The evidence of a choice, as an object and as a table.
pub(crate) fn write_choice(
    part: &mut mbs::folder::Part<'_>,
    choice: &PilotReport,
) -> Result<(), WriteError> {
    let text = serde_json::to_string_pretty(choice).unwrap_or_default();
    part.table("choice.json", |sink| writeln!(sink, "{text}"))?;
    part.table("choice.csv", |sink| mbs::record::write_choice(sink, choice))
}
