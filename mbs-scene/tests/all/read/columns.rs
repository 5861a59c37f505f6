//! Tables from columns of a CSV file: rows, units, and errors with line and column of the file.

use super::includes::Folder;
use mbs_core::scene::*;
use mbs_scene::{SceneFile, to_toml};

/// A scene with a prismatic joint that is guided, pushed and measured by tables. The table of a road comes last.
fn scene(guide: &str, effect: &str, curve: &str) -> String {
    format!(
        "[scene]\ndimension = 2\nduration = 4\n\
        [[body]]\nname = \"cart\"\nmass = 2\ncenter = [0, 1]\ninertia = 0.1\n\
        [[body]]\nname = \"block\"\nmass = 2\ncenter = [0, 2]\ninertia = 0.1\n\
        [[joint]]\nname = \"slide\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"cart\"]\naxis = [1, 0]\nat = [0, 1]\n\
        [[joint]]\nname = \"way\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"block\"]\naxis = [1, 0]\nat = [0, 2]\n\
        [[guide]]\njoint = \"slide\"\ntable = {guide}\ninterpolation = \"monotone\"\nends = \"level\"\n\
        [[effect]]\nname = \"push\"\nkind = \"force\"\nbody = \"block\"\nat = [0, 2]\ntable = {effect}\n\
        [[signal]]\nname = \"clock\"\nkind = \"table\"\ntable = {guide}\n\
        [[signal]]\nname = \"force\"\nkind = \"curve\"\nof = \"clock\"\ntable = {curve}\n\
        [road]\nkind = \"table\"\npoints = {curve}\n"
    )
}

const GUIDE: &str = "{ file = \"data/stroke.csv\", columns = [\"time\", \"stroke\"] }";
const FORCE: &str =
    "{ file = \"force.csv\", columns = [\"t\", \"Fx\", \"Fy\"], units = [\"s\", \"kN\", \"N\"] }";
const CURVE: &str = "{ file = \"force.csv\", columns = [\"t\", \"Fx\"] }";
const STROKES: &str =
    "# measured\nindex,stroke [mm],\"time [ms]\"\n0,0,0\n\n1, 25 ,500\n2,1e2,2000\n";
const FORCES: &str = "\u{feff}t;Fx;Fy\r\n0;1.5;-2\r\n1;2.5;-3";

fn folder(name: &str, strokes: &str, forces: &str, text: &str) -> Folder {
    let folder =
        Folder::new(&format!("columns-{name}"), &[("force.csv", forces), ("x.toml", text)]);
    folder.add("data", "stroke.csv", strokes);
    folder
}

#[test]
fn columns_of_a_file_are_the_rows_that_they_say() {
    let folder = folder("rows", STROKES, FORCES, &scene(GUIDE, FORCE, CURVE));
    let file = folder.read("x.toml").expect("a scene");
    let found = file.scene::<f64>().expect("a scene");
    let written = scene(
        "[[0, 0], [0.5, 0.025], [2, 0.1]]",
        "[[0, 1500, -2], [1, 2500, -3]]",
        "[[0, 1.5], [1, 2.5]]",
    );
    let expected = SceneFile::parse(&written, "x.toml").and_then(|file| file.scene::<f64>());
    assert_eq!(Ok(&found), expected.as_ref());
    let again = to_toml(&file.numbers().expect("a scene")).expect("no code");
    let again = SceneFile::parse(&again, "x.toml").and_then(|file| file.scene::<f64>());
    assert_eq!(Ok(found), again);
    let files: Vec<&str> = file.files().collect();
    assert_eq!(files.len(), 3, "each file once: {files:?}");
}

#[test]
fn the_text_of_a_scene_has_that_of_its_tables() {
    let text = scene(GUIDE, FORCE, CURVE);
    let whole = |name: &str, forces: &str| {
        folder(name, STROKES, forces, &text).read("x.toml").expect("a scene").whole_text()
    };
    assert_ne!(whole("one", FORCES), whole("two", &FORCES.replace("2.5", "2.25")));
}

/// The error of a scene with other CSV files or another guide.
fn refusal(name: &str, (strokes, forces): (&str, &str), guide: &str) -> String {
    folder(name, strokes, forces, &scene(guide, FORCE, CURVE)).refusal("x.toml")
}

#[test]
fn bad_rows_are_refused_with_their_line_and_column() {
    for (name, from, to, expected) in [
        (
            "word",
            "25 ",
            "2,5 ",
            "data/stroke.csv:5:1: the row has 4 cells, but the first row has 3",
        ),
        ("text", "1e2", "fast", "data/stroke.csv:6:3: `fast` is no number"),
        ("empty", ",2000", ",", "data/stroke.csv:6:7: the cell is empty"),
        ("inf", "1e2", "inf", "data/stroke.csv:6:3: `inf` is no number"),
        (
            "short",
            "2,1e2,2000",
            "2",
            "data/stroke.csv:6:1: the row has 1 cells, but the first row has 3",
        ),
        ("unit", "[mm]", "[parsec]", "data/stroke.csv:2:7: `parsec` is no unit"),
        ("force", "[mm]", "[kN]", "data/stroke.csv:3:3: `0 kN` is a force"),
        ("twice", "index", "stroke", "data/stroke.csv:2:8: there is another column `stroke`"),
        (
            "order",
            "500",
            "2500",
            "data/stroke.csv:6:1: `table` has times that do not increase at row 3",
        ),
    ] {
        let found = refusal(name, (&STROKES.replacen(from, to, 1), FORCES), GUIDE);
        assert!(found.starts_with(expected), "{name}: {found}");
        assert!(found.contains("for the table at x.toml:28"), "{name}: {found}");
    }
}

#[test]
fn what_a_scene_says_of_a_file_is_refused_at_its_place() {
    let of = |more: &str| {
        format!("{{ file = \"data/stroke.csv\", columns = [\"time\", \"stroke\"]{more} }}")
    };
    for (name, guide, expected) in [
        (
            "none",
            GUIDE.replace("stroke.csv", "stroke.txt"),
            "x.toml:28:18: cannot read the table `data/stroke.txt`: there is no such file",
        ),
        (
            "folder",
            GUIDE.replace("data/stroke.csv", "data"),
            "x.toml:28:18: cannot read the table `data`: it is no file",
        ),
        (
            "column",
            GUIDE.replace("\"time\"", "\"tome\""),
            "x.toml:28:48: `data/stroke.csv` has no column `tome`",
        ),
        ("count", of(", units = [\"s\"]"), "x.toml:28:75: expected 2 entries, found 1"),
        (
            "differs",
            of(", units = [\"s\", \"mm\"]"),
            "x.toml:28:76: the unit is `s`, but the file has `ms`",
        ),
        ("key", of(", unit = \"s\""), "x.toml:28:67: unknown key `unit`"),
        (
            "columns",
            "{ file = \"data/stroke.csv\" }".to_owned(),
            "x.toml:28:9: `columns` is missing",
        ),
    ] {
        let found = refusal(name, (STROKES, FORCES), &guide);
        assert!(found.starts_with(expected), "{name}: {found}");
    }
    let same = of(", units = [\"ms\", \"mm\"]");
    let folder = folder("same", STROKES, FORCES, &scene(&same, FORCE, CURVE));
    assert!(folder.read("x.toml").and_then(|file| file.scene::<f64>()).is_ok());
    let found = refusal("no rows", (STROKES.split_once("0,0").expect("rows").0, FORCES), GUIDE);
    assert!(found.starts_with("x.toml:28:18: `data/stroke.csv` has no rows"), "{found}");
    let alone = SceneFile::parse(&scene(GUIDE, FORCE, CURVE), "x.toml").unwrap_err().to_string();
    assert_eq!(
        alone,
        "x.toml:28:18: a text that is no file lies in no folder, and has no tables in files"
    );
}

#[test]
fn a_file_that_is_included_has_its_tables_in_its_own_folder() {
    let part = "[[signal]]\nname = \"stroke\"\nkind = \"table\"\ntable = { file = \"stroke.csv\", columns = [\"time\", \"stroke\"] }\n";
    let text = "[scene]\ndimension = 2\nduration = 4\n[[include]]\nfile = \"data/part.toml\"\nprefix = \"left.\"\n";
    let folder = folder("included", STROKES, FORCES, text);
    folder.add("data", "part.toml", part);
    let scene = folder.read("x.toml").and_then(|file| file.scene::<f64>()).expect("a scene");
    let SignalKind::Table { rows, .. } = &scene.signals[0].kind else { panic!("a table") };
    assert_eq!(*rows, [[0.0, 0.0], [0.5, 0.025], [2.0, 0.1]]);
}
