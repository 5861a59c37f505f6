//! Command `mbs generate FAMILY`: a large scene of a family.

use crate::files;
use crate::refusal::Refusal;
use crate::say::{out, warn};
use crate::status::STOPPED;
use clap::{Args, ValueEnum};
use mbs::scene_file::{Family, GenerateError, generate};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `mbs generate`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Family of scenes.
    family: Word,
    /// Bodies of a chain or tree, four-bar linkages, vehicles of a convoy; of a net the bodies approximately.
    #[arg(long, value_name = "N")]
    count: Option<usize>,
    /// Meshes of a net from front to back, with --columns in place of --count.
    #[arg(long, value_name = "R", requires = "columns", conflicts_with = "count")]
    rows: Option<usize>,
    /// Meshes of a net from left to right, with --rows.
    #[arg(long, value_name = "C", requires = "rows")]
    columns: Option<usize>,
    /// Scene of one vehicle of a convoy.
    #[arg(long, value_name = "SCENE")]
    of: Option<PathBuf>,
    /// Distance from one vehicle of a convoy to the next [m]. Default: 8.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    spacing: Option<f64>,
    /// File to write. Default: standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Names of the families on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Word {
    /// Spatial chain hung at one end.
    Chain,
    /// Binary tree of bars.
    Tree,
    /// Planar four-bar linkages side by side.
    NFourBar,
    /// Rope net hung at its corners.
    Net,
    /// Copies of a vehicle on one road.
    Convoy,
}

/// Default distance between vehicles [m]: twice the length of a car.
const SPACING: f64 = 8.0;

/// Runs the command `mbs generate`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    let text = match text(arguments) {
        Ok(text) => text,
        Err(refusal) => return refusal.report(),
    };
    let Some(file) = &arguments.output else {
        return match out(&text) {
            Ok(()) => ExitCode::SUCCESS,
            Err(why) => {
                warn(&why);
                ExitCode::from(STOPPED)
            }
        };
    };
    match files::write(file, text.as_bytes(), arguments.of.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(refusal) => refusal.report(),
    }
}

/// The text of the scene, or the refusal.
fn text(arguments: &Arguments) -> Result<String, Refusal> {
    let command = arguments.command();
    let make = |family: Family<'_>| generate(&family, &command).map_err(|error| refusal(&error));
    let missing = |what: &str, hint: &str| Err(Refusal::new("generate-refused", what, hint));
    if let Some(option) = arguments.stranger() {
        let family = arguments.word();
        return missing(&format!("{option} says nothing of a {family}"), "leave it out");
    }
    if let (Some(rows), Some(columns)) = (arguments.rows, arguments.columns) {
        return make(Family::Net { rows, columns });
    }
    let Some(count) = arguments.count else {
        return missing("--count is missing", "say how many, such as --count 100");
    };
    match arguments.family {
        Word::Chain => make(Family::Chain { bodies: count }),
        Word::Tree => make(Family::Tree { bodies: count }),
        Word::NFourBar => make(Family::FourBars { loops: count }),
        Word::Net if count == 0 => make(Family::Net { rows: 0, columns: 0 }),
        Word::Net => make(Family::net_of(count)),
        Word::Convoy => {
            let Some(of) = &arguments.of else {
                let hint = "give the scene of one vehicle, such as --of scenes/iltis-stairs.toml";
                return missing("a convoy needs --of", hint);
            };
            let vehicle = crate::scene::SceneArgument::new(of, &[]).read()?.document;
            let spacing = arguments.spacing.unwrap_or(SPACING);
            make(Family::Convoy { vehicle: &vehicle, count, spacing })
        }
    }
}

impl Arguments {
    fn word(&self) -> String {
        self.family.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
    }

    /// The first given option that the family does not use.
    fn stranger(&self) -> Option<&'static str> {
        let (is_net, is_convoy) = (self.family == Word::Net, self.family == Word::Convoy);
        let options = [
            (self.rows.is_some() && !is_net, "--rows"),
            (self.of.is_some() && !is_convoy, "--of"),
            (self.spacing.is_some() && !is_convoy, "--spacing"),
        ];
        options.into_iter().find(|(is_strange, _)| *is_strange).map(|(_, name)| name)
    }

    /// The command line that makes the same scene again.
    fn command(&self) -> String {
        let options = [
            ("count", self.count.map(|n| n.to_string())),
            ("rows", self.rows.map(|n| n.to_string())),
            ("columns", self.columns.map(|n| n.to_string())),
            ("of", self.of.as_ref().map(|file| file.display().to_string())),
            ("spacing", self.spacing.map(|x| x.to_string())),
        ];
        files::command_line(&format!("generate {}", self.word()), &options)
    }
}

fn refusal(error: &GenerateError) -> Refusal {
    Refusal::new("generate-refused", error, error.hint())
}
