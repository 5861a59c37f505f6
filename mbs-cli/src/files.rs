//! Reading of scenes, writing of result files, and the messages when these fail.

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

/// Scene, settings and result folder of a command that runs a scene.
pub(crate) struct Begun {
    pub(crate) mechanism: Mechanism,
    /// Scene file of the mechanism.
    pub(crate) document: SceneFile,
    pub(crate) scene: Scene<f64>,
    pub(crate) settings: ResolvedMethod,
    /// Folder of the results; `None` if no files are written.
    pub(crate) folder: Option<Folder>,
}

/// Reads a scene, determines the settings of the run, and opens the folder of the results. The folder is opened before the run, so that no
/// run is lost because its results cannot be written. Otherwise returns the refusal.
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

/// The table of inputs in a file; otherwise the refusal.
pub(crate) fn input_table(file: &Path) -> Result<InputTable, Refusal> {
    Ok(InputTable::csv(&read(file, "table of inputs")?, &file.display().to_string()))
}

/// The refusal of a run, with its place in the scene file if it has one.
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

/// Opens a directory for result files with these names; otherwise returns the refusal.
pub(crate) fn folder(out: &Path, files: &[&str]) -> Result<Folder, Refusal> {
    let folder = Folder::open(out, files).map_err(|error| Refusal::folder(out, &error))?;
    warn_of_mixed(out);
    Ok(folder)
}

/// Warns of files in a directory that belong to other results.
pub(crate) fn warn_of_mixed(folder: &Path) {
    if let Some([file, object]) = Folder::mixed(folder) {
        warn(&format!(
            "warning: `{file}` in `{}` does not belong to the results of `{object}`: it was changed, or a process was killed between two \
             files",
            folder.display()
        ));
    }
}

/// Writes a file that is named on the command line, unless it is the file that was read. Otherwise returns the refusal.
pub(crate) fn write(path: &Path, bytes: &[u8], input: Option<&Path>) -> Result<(), Refusal> {
    let place = |path: &Path| path.canonicalize().ok();
    if input.is_some_and(|input| place(input).is_some() && place(input) == place(path)) {
        let message = format!("`{}` is the scene that is read", path.display());
        return Err(Refusal::new("out-unwritable", message, "give another file"));
    }
    write_file(path, bytes).map_err(|error| Refusal::unwritable(&error))
}

/// A refusal of settings, with its place if the scene contains the setting.
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

/// The id of the results of a scene with these settings.
pub(crate) fn results_id(document: &SceneFile, settings: &ResolvedMethod) -> String {
    // measurements of a pilot differ each time, and the number of threads does not change results
    let same = ResolvedMethod { choice: None, threads: 1, ..settings.clone() };
    id(&[&document.whole_text(), &format!("{same:?}")])
}

/// Replaces a JSON object and its page in the directory, if there is one. Returns the object with the id in its file, and a message.
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

/// Provenance of a result: the command with the given options.
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

/// The processor's name, if the system reports it.
pub(crate) fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find(|l| l.starts_with("model name"));
    line.and_then(|l| l.split_once(':')).map(|(_, name)| name.trim().to_owned()).unwrap_or_default()
}

/// Writes the measurements behind a choice of method, as an object and as a table.
pub(crate) fn write_choice(
    part: &mut mbs::folder::Part<'_>,
    choice: &PilotReport,
) -> Result<(), WriteError> {
    let text = serde_json::to_string_pretty(choice).unwrap_or_default();
    part.table("choice.json", |sink| writeln!(sink, "{text}"))?;
    part.table("choice.csv", |sink| mbs::record::write_choice(sink, choice))
}
