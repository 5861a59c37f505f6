//! Command `mbs inspect MODEL`: accelerations, efforts, matrices and frames of a mechanism at a state.

use crate::refusal::Refusal;
use crate::say::say;
use crate::scene::SceneArgument;
use clap::Args;
use mbs::scene_file::nearest_name;
use mbs::{
    Error, FrameMotion, InitialCondition, JointId, Matrix, Mechanism, Method, Number, ReadError,
    Tree, TreeError, TreeErrorKind,
};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const STATUS: &str = "\
Example: mbs inspect arm.toml --joint shoulder=0.4,1.2 --what accelerations,mass-matrix
Bodies, joints and gravity count; springs, motors and friction do not. Rows of matrices are those of `rows`.
Exit status:
  0  computed
  1  the scene, the state or the usage was refused";

/// Quantities that can be requested.
const QUANTITIES: [&str; 11] = [
    "accelerations",
    "efforts",
    "gravity",
    "bias",
    "mass-matrix",
    "loops",
    "momentum",
    "frames",
    "centers",
    "jacobians",
    "derivatives",
];
/// Quantities that do not need masses.
const GEOMETRY: [&str; 2] = ["frames", "jacobians"];
/// Number of quantities that are computed by default: the first ones. Of the others, centers follow from frames, jacobians and derivatives
/// are large, and derivatives exist for open trees only.
const DEFAULT: usize = 8;

/// Arguments of `mbs inspect`.
#[derive(Debug, Args)]
#[command(after_help = STATUS)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArgument,
    /// State, JSON: {"joints": {NAME: {"value": X, "rate": X, "effort": X}}, "base": {..}}. Default: the start of the scene.
    ///
    /// Each is a number or a list; `base` is the only free joint.
    ///
    /// What it leaves out stays as it is drawn, or follows a loop.
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// Value of a joint with one coordinate, and its rate; may be repeated. Default: the start of the scene.
    ///
    /// Other joints stay as they are drawn, or follow a loop.
    #[arg(long, value_name = "NAME=VALUE[,RATE]", allow_hyphen_values = true)]
    joint: Vec<String>,
    /// Quantities that are computed, with commas between them. Default: all but the last three.
    ///
    /// They are accelerations, efforts (that keep all rates), gravity, bias, mass-matrix, loops, momentum, frames, centers, jacobians and derivatives.
    ///
    /// A body without a frame of its name has its centre of mass as one; centers are those of all bodies.
    ///
    /// jacobians are those of all frames, derivatives those of the accelerations.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    what: Vec<String>,
    /// Print one JSON object on standard output and nothing else.
    #[arg(long)]
    json: bool,
}

/// Runs the command `mbs inspect`.
pub(crate) fn main(arguments: &Arguments) -> ExitCode {
    match inspected(arguments) {
        Ok(object) if arguments.json => say(&object.to_string(), ExitCode::SUCCESS),
        Ok(object) => say(&text(&object), ExitCode::SUCCESS),
        Err(refusal) => refusal.report(),
    }
}

/// Given value, rate and effort of a joint.
struct Given {
    name: String,
    value: Option<Vec<f64>>,
    rate: Option<Vec<f64>>,
    effort: Option<Vec<f64>>,
}

fn inspected(arguments: &Arguments) -> Result<Value, Refusal> {
    for word in &arguments.what {
        if !QUANTITIES.contains(&word.as_str()) {
            let hint = nearest_name(word, &QUANTITIES, "quantities");
            return Err(Refusal::new("usage", format!("`--what {word}`: no such quantity"), hint));
        }
    }
    let is_of_geometry = |word: &String| GEOMETRY.contains(&word.as_str());
    let is_geometry = !arguments.what.is_empty() && arguments.what.iter().all(is_of_geometry);
    let file = arguments.scene.document_for(is_geometry)?;
    let name = file.file().to_owned();
    let unread = |error: ReadError| Refusal::read("scene-refused", &error);
    let mut mechanism = Mechanism::of_file(file).map_err(unread)?;
    let given = given(arguments, &mechanism)?;
    if !given.is_empty() {
        // the given state replaces the start of the scene completely, since single values of that start might contradict it
        mechanism.clear_initial_conditions();
        begin(&mut mechanism, &given)?;
    }
    let mut tree = mechanism.tree().map_err(|error| refused(&error))?;
    if tree.inertia_fault().is_some() {
        start(&mechanism.with_fictitious_masses(), &mut tree)?;
    } else {
        start(&mechanism, &mut tree)?;
    }
    let (rows, efforts) = rows(&mechanism, &tree, &given)?;
    let is_default =
        |word: &str| arguments.what.is_empty() && QUANTITIES[..DEFAULT].contains(&word);
    let is_asked = |word: &str| is_default(word) || arguments.what.iter().any(|x| x == word);
    let mut object = Map::new();
    object.insert("model".into(), json!(name));
    object.insert("rows".into(), json!(rows));
    object.insert("q".into(), json!(tree.coordinates()));
    object.insert("v".into(), json!(tree.velocities()));
    for word in QUANTITIES.into_iter().filter(|word| is_asked(word)) {
        let value =
            quantity(word, &mut tree, &efforts).map_err(|error| uncomputed(word, &error))?;
        if !is_finite(&value) {
            let message = format!("{word} at this state are no finite numbers");
            let hint = "give smaller efforts and rates";
            return Err(Refusal::new("state-refused", message, hint));
        }
        object.insert(word.replace('-', "_"), value);
    }
    Ok(Value::Object(object))
}

/// Sets a tree to the start of a mechanism.
fn start(mechanism: &Mechanism, tree: &mut Tree) -> Result<(), Refusal> {
    let simulation = mechanism.simulate(&Method::default()).map_err(|error| refused(&error))?;
    tree.follow(&simulation).map_err(|error| refused(&error))
}

/// The refusal of a quantity that cannot be computed.
fn uncomputed(word: &str, error: &TreeError) -> Refusal {
    let hint = error.hint().unwrap_or_default();
    let hint = match error.kind {
        TreeErrorKind::NoInertia(_) => format!("{hint}: --what frames,jacobians"),
        _ => hint,
    };
    let whose = error.body().map(|body| format!(" (body `{body}`)")).unwrap_or_default();
    Refusal::new("state-refused", format!("{word}{whose}: {error}"), hint)
}

fn quantity(word: &str, tree: &mut Tree, efforts: &[f64]) -> Result<Value, TreeError> {
    Ok(match word {
        "accelerations" => json!(tree.forward_dynamics(efforts)?),
        "efforts" => json!(tree.inverse_dynamics(&vec![0.0; efforts.len()])?),
        "gravity" => json!(tree.gravity_forces()),
        "bias" => json!(tree.bias_forces()),
        "mass-matrix" => matrix(tree.mass_matrix()),
        "loops" => matrix(tree.loop_jacobian()),
        "momentum" => {
            let (center, momentum) = (tree.center_of_mass(), tree.momentum());
            json!({
                "center_of_mass": center.position, "velocity": center.velocity,
                "linear": momentum.linear, "angular": momentum.angular,
            })
        }
        "jacobians" => jacobians(tree),
        "derivatives" => {
            let slopes = tree.forward_dynamics_derivatives(efforts)?;
            json!({
                "q": matrix(&slopes.q), "v": matrix(&slopes.v), "effort": matrix(&slopes.effort),
            })
        }
        "centers" => frames(tree.centers()),
        _ => frames(tree.frames()),
    })
}

fn jacobians(tree: &mut Tree) -> Value {
    let names: Vec<String> = tree.frames().map(|(name, _)| name.to_owned()).collect();
    let of = |name: &String| {
        let (body, at) = tree.frame_place(name).ok()?;
        Some((name.clone(), matrix(tree.jacobian_at(body, at))))
    };
    names.iter().filter_map(of).collect::<Map<_, _>>().into()
}

fn frames<'a>(all: impl Iterator<Item = (&'a str, FrameMotion)>) -> Value {
    let value = |frame: FrameMotion| {
        json!({
            "position": frame.position, "rotation": frame.rotation,
            "velocity": frame.velocity, "angular_velocity": frame.angular_velocity,
        })
    };
    all.map(|(name, frame)| (name.to_owned(), value(frame))).collect::<Map<_, _>>().into()
}

fn matrix(matrix: &Matrix) -> Value {
    json!((0..matrix.rows).map(|i| matrix.row(i)).collect::<Vec<_>>())
}

/// Reads the given state of joints. Values of the command line take precedence over those of the state file.
fn given(arguments: &Arguments, mechanism: &Mechanism) -> Result<Vec<Given>, Refusal> {
    let mut all = match &arguments.state {
        Some(path) => of_file(path, mechanism)?,
        None => Vec::new(),
    };
    for text in &arguments.joint {
        let parsed = text.rsplit_once('=').and_then(|(name, numbers)| {
            let numbers: Option<Vec<f64>> = numbers
                .split(',')
                .map(|x| x.trim().parse().ok().filter(|x: &f64| x.is_finite()))
                .collect();
            match numbers?[..] {
                [value] => Some((name, value, None)),
                [value, rate] => Some((name, value, Some(vec![rate]))),
                _ => None,
            }
        });
        let Some((name, value, rate)) = parsed else {
            let message = format!("`--joint {text}`: no name with a value and a rate");
            return Err(Refusal::new(
                "usage",
                message,
                "write --joint NAME=VALUE or --joint NAME=VALUE,RATE",
            ));
        };
        // values of the command line take precedence over those of the file
        let value = Some(vec![value]);
        match all.iter_mut().find(|given: &&mut Given| given.name == name) {
            Some(given) => (given.value, given.rate) = (value, rate.or(given.rate.take())),
            None => all.push(Given { name: name.to_owned(), value, rate, effort: None }),
        }
    }
    Ok(all)
}

/// Reads the given state of joints from a state file.
fn of_file(path: &Path, mechanism: &Mechanism) -> Result<Vec<Given>, Refusal> {
    let mut all = Vec::new();
    let bytes = crate::input::read(path, "state file")?;
    let refused = |why: String| {
        let hint = "write {\"joints\": {\"NAME\": {\"value\": 0.4, \"rate\": 0}}}";
        Refusal::new("state-refused", format!("`{}`: {why}", path.display()), hint)
    };
    let state: Value =
        serde_json::from_slice(&bytes).map_err(|error| refused(error.to_string()))?;
    let (joints, base) = (state.get("joints"), state.get("base"));
    if joints.is_none() && base.is_none() {
        return Err(refused("no object `joints`, and no `base`".to_owned()));
    }
    let known = state.as_object().into_iter().flat_map(Map::keys);
    if let Some(key) = known.into_iter().find(|key| !["joints", "base"].contains(&key.as_str())) {
        return Err(refused(format!("unknown key `{key}` beside `joints` and `base`")));
    }
    let joints = joints.map(|joints| {
        joints.as_object().ok_or_else(|| refused("`joints` is no object".to_owned()))
    });
    let mut entries: Vec<(String, &Value)> = match joints.transpose()? {
        Some(joints) => joints.iter().map(|(name, entry)| (name.clone(), entry)).collect(),
        None => Vec::new(),
    };
    if let Some(base) = base {
        let name = base_joint(mechanism).map_err(&refused)?;
        if entries.iter().any(|(known, _)| *known == name) {
            return Err(refused(format!("`base` is `{name}`, which stands under `joints` too")));
        }
        entries.push((name, base));
    }
    for (name, entry) in &entries {
        let keys = entry.as_object().ok_or_else(|| refused(format!("`{name}` is no object")))?;
        let unknown = keys.keys().find(|key| !["value", "rate", "effort"].contains(&key.as_str()));
        if let Some(key) = unknown {
            return Err(refused(format!("unknown key `{key}` of `{name}`")));
        }
        let numbers = |key: &str| {
            numbers(entry.get(key)).map_err(|()| {
                refused(format!("`{key}` of `{name}` is no number and no list of them"))
            })
        };
        let (value, rate, effort) = (numbers("value")?, numbers("rate")?, numbers("effort")?);
        all.push(Given { name: name.clone(), value, rate, effort });
    }
    Ok(all)
}

/// The only free joint of a mechanism.
fn base_joint(mechanism: &Mechanism) -> Result<String, String> {
    let is_free = |joint: &JointId| mechanism.part(*joint).kind.is_free();
    let mut free = mechanism.ids::<JointId>().filter(is_free);
    match (free.next(), free.next()) {
        (Some(joint), None) => Ok(mechanism.name(joint).to_owned()),
        (None, _) => Err("`base` is the only free joint, and the mechanism has none".to_owned()),
        _ => Err("`base` is the only free joint, and the mechanism has several: write them under `joints`".to_owned()),
    }
}

/// A number or a list of numbers, as a list.
fn numbers(value: Option<&Value>) -> Result<Option<Vec<f64>>, ()> {
    match value {
        None | Some(Value::Null) => Ok(None),
        Some(Value::Number(x)) => x.as_f64().map(|x| Some(vec![x])).ok_or(()),
        Some(Value::Array(list)) => {
            list.iter().map(Value::as_f64).collect::<Option<_>>().map(Some).ok_or(())
        }
        Some(_) => Err(()),
    }
}

/// Sets the joints to the given state. Some joints have no given value, and no constraint connects them to other joints. Such a joint is
/// held at its drawn position without velocity. Otherwise it would take part in the motion of the given joints.
fn begin(mechanism: &mut Mechanism, given: &[Given]) -> Result<(), Refusal> {
    for given in given {
        mechanism.find::<JointId>(&given.name).map_err(|error| {
            Refusal::new("state-refused", error.to_string(), error.hint().unwrap_or_default())
        })?;
    }
    let mut tree = mechanism.tree().map_err(|error| refused(&error))?;
    let rows = rows_aside(&mut tree).map_err(|error| refused(&error))?;
    let is_tied = |column: usize| (0..rows.rows).any(|row| rows[(row, column)] != 0.0);
    let joints: Vec<JointId> = mechanism.ids::<JointId>().collect();
    for joint in joints {
        let own = given.iter().find(|given| given.name == mechanism.name(joint));
        let range = tree.coordinates_of(joint).map(|range| range.v).ok().filter(|v| !v.is_empty());
        let held = range.clone().filter(|v| !v.clone().any(is_tied)).map(|v| vec![0.0; v.len()]);
        let [value, rate] = [
            ("value", own.and_then(|own| own.value.clone())),
            ("rate", own.and_then(|own| own.rate.clone())),
        ]
        .map(|(key, numbers)| match (&range, numbers) {
            (Some(v), Some(numbers)) if numbers.len() != v.len() => {
                let name = mechanism.name(joint);
                let message = format!("`{key}` of `{name}` has {} numbers", numbers.len());
                Err(Refusal::new("state-refused", message, format!("write {}", v.len())))
            }
            (_, numbers) => Ok(numbers.or_else(|| held.clone())),
        });
        let decimal = |list: Option<Vec<f64>>| {
            list.map(|list| list.into_iter().map(Number::from).collect::<Vec<_>>())
        };
        let (value, rate) = (decimal(value?), decimal(rate?));
        if value.is_some() || rate.is_some() {
            mechanism.add(InitialCondition::joint(joint, value, rate));
        }
    }
    Ok(())
}

/// The rows of closed loops at a position close to the drawn one. A mechanism may be drawn in a singular position, where rows do not show
/// all the joints that they connect.
fn rows_aside(tree: &mut Tree) -> Result<Matrix, TreeError> {
    // different steps for all joints, so that the new position is not singular
    let step: Vec<f64> =
        (1..).take(tree.velocities().len()).map(|i: u32| f64::from(i).sin()).collect();
    let mut aside = tree.coordinates().to_vec();
    tree.integrate(tree.coordinates(), &step, &mut aside)?;
    tree.set(&aside, &vec![0.0; step.len()])?;
    Ok(tree.loop_jacobian().clone())
}

/// True if all numbers of a JSON value are finite. A number that is not finite is written as null.
fn is_finite(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::Array(list) => list.iter().all(is_finite),
        Value::Object(object) => object.values().all(is_finite),
        _ => true,
    }
}

/// Returns the joint and the number of each row, and the efforts along all rows.
fn rows(
    mechanism: &Mechanism,
    tree: &Tree,
    given: &[Given],
) -> Result<(Vec<Value>, Vec<f64>), Refusal> {
    let mut rows = vec![json!({ "joint": null }); tree.velocities().len()];
    let mut efforts = vec![0.0; rows.len()];
    for joint in mechanism.ids::<JointId>() {
        let Ok(range) = tree.coordinates_of(joint) else { continue };
        let name = mechanism.name(joint);
        for (number, row) in range.v.clone().enumerate() {
            rows[row] = json!({ "joint": name, "number": number });
        }
        let effort =
            given.iter().find(|given| given.name == name).and_then(|given| given.effort.as_ref());
        let Some(effort) = effort else { continue };
        if effort.len() != range.v.len() {
            let message = format!("`effort` of `{name}` has {} numbers", effort.len());
            return Err(Refusal::new("state-refused", message, format!("write {}", range.v.len())));
        }
        efforts[range.v].copy_from_slice(effort);
    }
    Ok((rows, efforts))
}

/// The refusal of a state that does not exist, or at which nothing can be computed.
fn refused(error: &impl Error) -> Refusal {
    // the text of some errors contains their hint at the end
    let text = error.to_string();
    let message = text.split("\nhint: ").next().unwrap_or_default();
    Refusal::new("state-refused", message, error.hint().unwrap_or_default())
}

/// A matrix with its name as text; empty for a matrix without rows.
fn matrix_text(name: &str, rows: &Value) -> String {
    let rows = rows.as_array().map(Vec::as_slice).unwrap_or_default();
    let mut out = if rows.is_empty() { String::new() } else { format!("\n{name}\n") };
    for row in rows {
        out += &(numbers_text(row) + "\n");
    }
    out
}

/// The numbers of a list as text.
fn numbers_text(list: &Value) -> String {
    let numbers = list.as_array().into_iter().flatten();
    numbers.map(|x| format!("{:>13.6}", x.as_f64().unwrap_or(f64::NAN))).collect()
}

/// Returns the results as text for people: a line for each row, then the other requested quantities.
fn text(object: &Value) -> String {
    let list = |key: &str| object[key].as_array().cloned().unwrap_or_default();
    // quaternions have more coordinates in q than rows
    let columns = ["q", "v", "accelerations", "efforts", "gravity", "bias"];
    let n = list("rows").len();
    let there: Vec<&str> =
        columns.into_iter().filter(|key| object[key].is_array() && list(key).len() == n).collect();
    let mut out = format!("{:<4}{:<28}", "row", "joint");
    out += &there.iter().map(|key| format!("{key:>15}")).collect::<String>();
    out.push('\n');
    for (i, row) in list("rows").iter().enumerate() {
        let name = row["joint"].as_str().unwrap_or("a free body");
        out += &format!("{i:<4}{name:<28}");
        for key in &there {
            out += &format!("{:>15.6}", object[key][i].as_f64().unwrap_or(f64::NAN));
        }
        out.push('\n');
    }
    let mut matrices: Vec<(String, &Value)> = Vec::new();
    for (key, name) in [("mass_matrix", "mass matrix"), ("loops", "loops")] {
        matrices.push((name.to_owned(), &object[key]));
    }
    for (key, name) in [("jacobians", "jacobian of"), ("derivatives", "accelerations by")] {
        let all = object[key].as_object().into_iter().flatten();
        matrices.extend(all.map(|(of, value)| (format!("{name} {of}"), value)));
    }
    for (name, rows) in &matrices {
        out += &matrix_text(name, rows);
    }
    if let Some(momentum) = object["momentum"].as_object() {
        out.push('\n');
        for (key, value) in momentum {
            out += &format!("{:<32}{}\n", key.replace('_', " "), numbers_text(value));
        }
    }
    for (key, title) in [("frames", "frame"), ("centers", "centre of mass")] {
        let Some(places) = object[key].as_object() else { continue };
        out += &format!("\n{title:<32}{:>13}{:>13}{:>13}\n", 'x', 'y', 'z');
        for (name, place) in places {
            out += &format!("{name:<32}{}\n", numbers_text(&place["position"]));
        }
    }
    out
}
