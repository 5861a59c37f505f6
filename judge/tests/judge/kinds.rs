//! Kinds of the product, each in a small scene that moves. Every quantity of the scene must agree with the judge.
//!
//! The tables of the product list the kinds. The scenes are the examples of the manual, and those of `kinds.toml`.

use crate::channels;
use judge::trial::{self, compare};
use mbs::core::effects::EFFECTS;
use mbs::core::outputs::{QUANTITIES, QuantityRow};
use mbs::core::scene::{JOINTS, Scene};
use mbs::scene_file::keys::{Base, tables};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Kinds that the judge does not support. The list may only get shorter.
const NOT_DERIVED: &[&str] = &[];

/// Headers of the manual whose kinds are listed here by name. Joints, effects and quantities are listed by their tables.
const BY_NAME: [&str; 4] = ["coupling", "rolling", "signal", "road"];

/// Largest difference of a channel, relative to its size [-]: the integration errors of both sides are smaller.
const CLOSE: f64 = 1e-9;

/// Method of the product: order 8 with fixed steps.
const METHOD: trial::Way = ["recursive", "rk853"];
/// Number of the product's steps per step of a scene.
const SHARE: u32 = 20;
/// Number of steps of a scene.
const STEPS: u32 = 5;
/// Step of a scene [s]. It is short, since fixed steps may cross kinks.
const STEP: f64 = 4e-4;
/// Step of a scene with a signal [s]. Signals of the manual change within 0.6 s, at ends of the product's steps.
const SIGNAL_STEP: f64 = 0.125;

/// Examples of the manual that are left out, since their geometry is not that of the machine. The second wheel of the differential is
/// carried by the first, and the product's effort is that on both wheels. The nut of the screw slides across the screw's axis.
const LEFT_OUT: [&str; 2] = ["coupling differential", "coupling screw"];

/// A small scene for one kind.
struct Small {
    /// Kind that the scene is made for.
    of: String,
    /// Text of the example of the manual, with its start and channels.
    text: String,
    /// Step of the scene [s].
    step: f64,
}

/// The title of a quantity: its object and its name.
fn title(row: &QuantityRow) -> String {
    format!("quantity {:?} {}", row.target, row.name)
}

/// All kinds of the tables of the product.
fn kinds() -> BTreeSet<String> {
    let mut all: BTreeSet<String> =
        JOINTS.iter().map(|form| format!("joint {}", form.name)).collect();
    let effects = EFFECTS.iter().filter(|row| !row.names.is_empty());
    all.extend(effects.map(|row| format!("effect {}", row.module)));
    all.extend(QUANTITIES.iter().map(title));
    for table in tables().iter().filter(|table| BY_NAME.contains(&table.header)) {
        all.extend(table.kind.map(|kind| format!("{} {kind}", table.header)));
    }
    all
}

/// The base scene by its name in `kinds.toml`.
fn base(name: &str) -> Base {
    match name {
        "planar" => Base::Planar,
        "spatial" => Base::Spatial,
        "planar bodies" => Base::PlanarBodies,
        "spatial bodies" => Base::SpatialBodies,
        other => panic!("no base {other}"),
    }
}

/// The examples of the manual and the scenes of `kinds.toml`; the product reads them all.
fn scenes() -> Vec<Result<Small, String>> {
    let headers = ["joint", "guide", "coupling", "rolling", "signal", "effect", "road", "output"];
    let examples = tables().iter().filter(|table| headers.contains(&table.header));
    let mut list: Vec<(String, Base, String)> = Vec::new();
    for table in examples {
        let of = format!("{} {}", table.header, table.kind.unwrap_or("several"));
        let example = table.example.filter(|_| !LEFT_OUT.contains(&of.as_str()));
        list.extend(example.map(|example| (of, example.base, example.text.to_owned())));
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/kinds.toml");
    let own = std::fs::read_to_string(path).expect("the scenes are there");
    for block in own.split("\n#: ").skip(1) {
        let (head, text) = block.split_once('\n').expect("a block has a head");
        let (of, name) = head.split_once(", ").expect("a head names its base");
        list.push((of.to_owned(), base(name), text.to_owned()));
    }
    list.into_iter().map(|(of, base, text)| small(of, base, &text)).collect()
}

/// A scene with its start and the channels of all quantities.
fn small(of: String, base: Base, example: &str) -> Result<Small, String> {
    let step = if of.starts_with("signal") { SIGNAL_STEP } else { STEP };
    let duration = format!("duration = {:?}", step * f64::from(STEPS));
    let text = base.text().replace("duration = 0.01", &duration) + "\n" + example + "\n";
    let scene = trial::document(&text).map_err(|e| format!("{of}: {e}"))?;
    let text = text + &start(&scene, example);
    let scene = trial::document(&text).map_err(|e| format!("{of}: {e}"))?;
    let text = text + &channels::of(&scene);
    Ok(Small { of, text, step })
}

/// The start of a scene: values and rates of joints, or of the first joint alone if there is a coupling, and rotations of bodies without a
/// joint.
fn start(scene: &Scene<f64>, example: &str) -> String {
    let mut text = String::new();
    if example.contains("[[initial]]") {
        return text;
    }
    let n_held = match (scene.guides.is_empty(), scene.couplings.is_empty()) {
        (false, _) => 0,
        (_, false) => 1,
        _ => scene.joints.len(),
    };
    for (i, joint) in scene.joints.iter().take(n_held).enumerate() {
        let n = joint.kind.n_coordinates(scene.dimension);
        let numbers = |first: f64, by: f64| -> String {
            let list: Vec<f64> = (0..n).map(|k| first + by * (k + i) as f64).collect();
            if let [one] = list.as_slice() { format!("{one:?}") } else { format!("{list:?}") }
        };
        if n > 0 {
            let (value, rate) = (numbers(0.3, -0.2), numbers(0.8, -0.5));
            let _ = writeln!(
                text,
                "[[initial]]\njoint = \"{}\"\nvalue = {value}\nrate = {rate}",
                joint.name
            );
        }
    }
    let holds = |b: usize| {
        let of = |joint: &mbs::core::scene::Joint<f64>| {
            joint.bodies.contains(&mbs::core::scene::BodyId::Body(b))
        };
        scene.joints.iter().any(of)
    };
    for (b, body) in scene.bodies.iter().enumerate().filter(|(b, _)| !holds(*b)) {
        let planar = scene.dimension.count() == 2;
        let turn = 0.6 - 0.2 * b as f64;
        let turn = if planar { format!("{turn:?}") } else { format!("[0.1, {turn:?}, 0.3]") };
        let _ = writeln!(text, "[[initial]]\nbody = \"{}\"\nangular_velocity = {turn}", body.name);
    }
    text
}

/// The kinds that a scene has.
fn kinds_in(text: &str) -> BTreeSet<String> {
    let scene = trial::document(text).expect("read before");
    let mut found: BTreeSet<String> = BTreeSet::new();
    found.extend(scene.joints.iter().map(|joint| format!("joint {}", joint.kind.name())));
    found.extend(scene.effects.iter().map(|e| format!("effect {}", e.kind.row().module)));
    found.extend(scene.outputs.iter().map(|output| title(output.quantity.row())));
    let mut header = "";
    for line in text.lines() {
        if let Some(name) = line.strip_prefix('[') {
            header = name.trim_matches(['[', ']']);
        } else if let Some(kind) = line.strip_prefix("kind = ") {
            found.insert(format!("{header} {}", kind.trim_matches('"')));
        }
    }
    found
}

/// Runs a scene on both sides. Returns the channel with the largest difference.
fn run(small: &Small) -> Result<Option<String>, String> {
    let judged = trial::judge(&small.text, small.step, STEPS)?;
    let product = trial::product(&small.text)?;
    let rows = match trial::rows(&product, METHOD, (small.step, STEPS), SHARE) {
        Ok(rows) => rows,
        Err(verdict) => return Ok(Some(format!("{verdict:?}"))),
    };
    Ok(compare::worst(&judged, &rows, CLOSE))
}

#[test]
fn every_kind_of_the_tables_moves_as_the_judge_says_but_what_is_listed() {
    let (mut derived, mut refused) = (BTreeSet::new(), BTreeMap::new());
    let mut wrong = Vec::new();
    let scenes = scenes();
    for small in &scenes {
        let small = match small {
            Ok(small) => small,
            Err(why) => {
                wrong.push(why.clone());
                continue;
            }
        };
        match run(small) {
            Ok(None) => derived.extend(kinds_in(&small.text)),
            Ok(Some(what)) => wrong.push(format!("{}: {what}", small.of)),
            Err(why) => _ = refused.insert(small.of.clone(), why),
        }
    }
    let kinds = kinds();
    let missing: Vec<&String> = kinds
        .iter()
        .filter(|kind| !derived.contains(*kind) || refused.contains_key(*kind))
        .collect();
    crate::say(&format!(
        "{} scenes, {} kinds, {} not derived",
        scenes.len(),
        kinds.len(),
        missing.len()
    ));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(missing, NOT_DERIVED, "{refused:?}");
}
