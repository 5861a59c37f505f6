//! Commands `mbs equilibrium SCENE` and `mbs modes SCENE`.

use crate::files::folder;
use crate::refusal::Refusal;
use crate::run::stopped;
use crate::say::{say, warn};
use crate::scene::{CheckedScene, SceneArgument};
use crate::status::STOPPED;
use crate::table::fixed;
use clap::{Args, ValueEnum};
use mbs::core::scene::Scene;
use mbs::folder::{Folder, WriteError, id};
use mbs::record::Channel;
use mbs::scene_file::SceneFile;
use mbs::scene_file::format::counted;
use mbs::{LeftOut, Names, Place, Search, StaticEquilibrium, StopError, words};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

/// What both commands know.
#[derive(Debug, Args)]
pub(crate) struct Common {
    #[command(flatten)]
    scene: SceneArgument,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
    /// Directory for the same JSON object as a file, equilibrium.json or modes.json; created if missing. Default: no file.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Find the equilibrium near the start, stable or not, by Newton's method. Default: a search down to a stable one.
    #[arg(long)]
    near: bool,
}

impl Common {
    fn search(&self) -> Search {
        if self.near { Search::Near } else { Search::Down }
    }
}

/// Arguments of `mbs equilibrium`.
#[derive(Debug, Args)]
pub(crate) struct Equilibrium {
    #[command(flatten)]
    common: Common,
}

/// Arguments of `mbs modes`.
#[derive(Debug, Args)]
pub(crate) struct Modes {
    #[command(flatten)]
    common: Common,
    /// State to linearise about: the equilibrium at rest, the initial state, or the equilibrium with the initial velocities (moving).
    #[arg(long, value_enum, default_value_t = At::Equilibrium)]
    at: At,
    /// Eigenvalues of the instant where the state is no steady motion: they say nothing of what grows.
    #[arg(long)]
    frozen: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum At {
    Equilibrium,
    Initial,
    Moving,
}

/// Runs the command `mbs equilibrium`.
pub(crate) fn equilibrium(arguments: &Equilibrium) -> ExitCode {
    let search = arguments.common.search();
    let analyse = |scene: &Scene<f64>| {
        StaticEquilibrium::new(scene, search).map(|s| (s.to_json(), still(&s)))
    };
    command(&arguments.common, "equilibrium.json", analyse)
}

/// Runs the command `mbs modes`.
pub(crate) fn modes(arguments: &Modes) -> ExitCode {
    let place = match arguments.at {
        At::Equilibrium => Place::Equilibrium,
        At::Initial => Place::Initial,
        At::Moving => Place::Moving,
    };
    let search = arguments.common.search();
    if place == Place::Initial && search == Search::Near {
        return Refusal::new(
            "settings-refused",
            "--near seeks an equilibrium, and --at initial needs none",
            "leave one of them out",
        )
        .report();
    }
    let by = if arguments.frozen { mbs::Modes::frozen } else { mbs::Modes::new };
    let analysed = |scene: &Scene<f64>| by(scene, place, search);
    let analyse = |scene: &Scene<f64>| analysed(scene).map(|m| (m.to_json(), spectrum(&m)));
    command(&arguments.common, "modes.json", analyse)
}

/// Reads a scene, analyses it, and writes the result as JSON or text.
fn command(
    common: &Common,
    file: &str,
    analyse: impl Fn(&Scene<f64>) -> Result<(Value, String), StopError>,
) -> ExitCode {
    let begun = common.scene.read().and_then(|both| {
        let folder = common.out.as_ref().map(|out| folder(out, &[file])).transpose()?;
        Ok((both, folder))
    });
    let (CheckedScene { document, scene }, folder) = match begun {
        Ok(begun) => begun,
        Err(refusal) => return refusal.report(),
    };
    let result = analyse(&scene);
    let (object, text) = match &result {
        Ok((object, text)) => (object.clone(), text.clone()),
        Err(error) => (failure(&scene, error), String::new()),
    };
    let mut object = object.to_string();
    let mut status = if result.is_ok() { ExitCode::SUCCESS } else { ExitCode::from(STOPPED) };
    if let Some(folder) = &folder {
        let written = write(folder, (file, &object), &document);
        object = Refusal::unless_lost(written, &mut status).unwrap_or(object);
    }
    let status = say(if common.json { &object } else { &text }, status);
    if let Some(error) = result.err().filter(|_| !common.json) {
        warn(&located(&scene, &error, &document));
    }
    status
}

/// Replaces the file with the object in the folder. Returns the object with the id that the file has.
fn write(
    folder: &Folder,
    (file, object): (&str, &str),
    document: &SceneFile,
) -> Result<String, WriteError> {
    folder.begin(&id(&[&document.whole_text(), file]))?.finish(file, object)
}

/// The JSON object of an analysis that could not be made.
fn failure(scene: &Scene<f64>, error: &StopError) -> Value {
    let report = error.report(0.0, &Names::new(scene));
    json!({ "scene": scene.name, "completed": false, "error": report })
}

fn located(scene: &Scene<f64>, error: &StopError, document: &SceneFile) -> String {
    let report = error.report(0.0, &Names::new(scene));
    stopped("no result", &report, error, document)
}

/// An equilibrium as text.
fn still(s: &StaticEquilibrium) -> String {
    let found = &s.found;
    let [coordinates, constraints, rank] = s.sizes;
    let stable = match (s.unstable, s.neutral.unwrap_or(0)) {
        (None, _) => "unknown: it stands in a singular position".to_owned(),
        (Some(0), 0) => "yes".to_owned(),
        (Some(0), n) => format!("yes; nothing holds it in {}", counted(n, "direction")),
        (Some(n), _) => format!("no: {} away from it", grow(n)),
    };
    let mut text = format!("{}: static equilibrium\n", s.scene);
    let rows = [
        (
            "degrees of freedom",
            format!(
                "{} ({coordinates} coordinates, {constraints} constraints of rank {rank})",
                coordinates - rank
            ),
        ),
        ("stable", stable),
        (
            "largest force left",
            format!(
                "{} N, {} of the forces",
                words::size(found.residual),
                words::size(found.relative)
            ),
        ),
        ("largest violation", format!("{} m (or rad)", words::size(found.violation))),
        ("from the start", moved(s)),
        ("search", format!("{} steps, {} factorisations", found.iterations, found.factorizations)),
        ("potential energy", format!("{} J", fixed(s.potential))),
    ];
    // writing into a String cannot fail
    for (label, value) in rows {
        let _ = writeln!(text, "  {label:<24} {value}");
    }
    for (title, channels) in
        [("joints", &s.joints), ("outputs", &s.outputs), ("reactions", &s.reactions)]
    {
        if !channels.is_empty() {
            let _ = writeln!(text, "{title}");
        }
        for (channel, values) in channels {
            let _ = writeln!(text, "  {:<24} {}", channel.name, values_text(channel, values));
        }
    }
    leave_out("this analysis", &s.left_out, &mut text);
    for joint in &s.not_unique {
        let _ = writeln!(text, "note: {}", words::not_unique(joint));
    }
    text
}

/// Largest displacement and rotation of a body between the start and the equilibrium, as text.
fn moved(s: &StaticEquilibrium) -> String {
    let Some([way, turn]) = &s.moved else { return "no body".to_owned() };
    let part = |size: f64, unit: &str, body: &str| {
        if size > 0.0 {
            format!("{} {unit} (`{body}`)", words::few(size))
        } else {
            format!("0 {unit}")
        }
    };
    format!("{}, {}", part(way.size, "m", &way.body), part(turn.size, "rad", &turn.body))
}

/// Appends a note on the effects that the analysis leaves out.
fn leave_out(from: &str, left_out: &[LeftOut], text: &mut String) {
    if left_out.is_empty() {
        return;
    }
    let parts: Vec<_> = left_out.iter().map(|l| format!("{} of `{}`", l.part, l.name)).collect();
    // writing into a String cannot fail
    let _ = writeln!(text, "note: left out of {from}: {}", parts.join(", "));
}

/// Values of a channel with their units, as text.
fn values_text(channel: &Channel, values: &[f64]) -> String {
    let parts = channel.components.iter().zip(values).map(|(component, x)| {
        let label = if component.label.parse::<u32>().is_ok() { "" } else { &component.label };
        let space = if label.is_empty() { "" } else { " " };
        format!("{label}{space}{} {}", fixed(*x), component.unit)
    });
    parts.collect::<Vec<_>>().join("  ")
}

/// Eigenvalues as a table.
fn spectrum(m: &mbs::Modes) -> String {
    let stable = match (&m.unsteady, m.is_stable()) {
        (Some(_), _) => "at an instant",
        (None, true) => "stable",
        (None, false) => "unstable",
    };
    let mut text = format!(
        "{}: {} about its {}, {stable}\n",
        m.scene,
        counted(m.dof, "degree of freedom"),
        match m.place {
            Place::Equilibrium => "equilibrium",
            Place::Initial => "start",
            Place::Moving => "equilibrium in motion",
        }
    );
    // writing into a String cannot fail
    let _ = writeln!(
        text,
        "{:>16} {:>16} {:>14} {:>14} {:>10}",
        "real [1/s]", "imag. [rad/s]", "frequency [Hz]", "undamped [Hz]", "damping"
    );
    for mode in &m.modes {
        let damping = mode.damping_ratio().map_or("neutral".to_owned(), damped);
        let _ = writeln!(
            text,
            "{:>16.9} {:>16.9} {:>14.9} {:>14.9} {damping:>10}",
            mode.real,
            mode.imaginary,
            mode.frequency(),
            mode.undamped_frequency(),
        );
    }
    // a moving state is linearised with all effects; only the search of its equilibrium leaves some out
    let is_moving = m.place == Place::Moving;
    let from = if is_moving { "the search of the equilibrium alone" } else { "this analysis" };
    leave_out(from, &m.left_out, &mut text);
    if let Some(unsteady) = &m.unsteady {
        let _ = writeln!(text, "note: {unsteady}; they hold for an instant");
    }
    text
}

/// A damping ratio as text. A negative zero has no minus sign.
fn damped(ratio: f64) -> String {
    let text = format!("{ratio:.6}");
    if text == "-0.000000" { "0.000000".to_owned() } else { text }
}

fn grow(n: usize) -> String {
    if n == 1 { "1 mode leads".to_owned() } else { format!("{n} modes lead") }
}
