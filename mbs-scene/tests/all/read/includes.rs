//! Tests of `[[include]]`: parts of other files with their prefix, and refused files.

use super::*;
use mbs_scene::SweepSource;
use std::fs;
use std::path::PathBuf;

/// A temporary folder, which is removed when the value is dropped.
pub(super) struct Folder(PathBuf);

impl Folder {
    pub(super) fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let path = std::env::temp_dir().join(format!("mbs-includes-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder");
        for (name, text) in files {
            fs::write(path.join(name), text).expect("a file");
        }
        Self(path)
    }

    pub(super) fn add(&self, folder: &str, name: &str, text: &str) {
        let folder = self.0.join(folder);
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join(name), text).expect("a file");
    }

    pub(super) fn read(&self, name: &str) -> Result<SceneFile, ReadError> {
        SceneFile::read(self.0.join(name))
    }

    pub(super) fn refusal(&self, name: &str) -> String {
        let error = self.read(name).and_then(|file| file.scene::<f64>()).expect_err(name);
        error.render().replace(&format!("{}/", self.0.display()), "")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

const HEAD: &str = "[scene]\ndimension = 3\nduration = 1.0\n[parameters]\nheight = 0.5\n";
const CHASSIS: &str = "[[body]]\nname = \"chassis\"\nmass = 1.0\npoint = [0, 0, 0]\n";
const CORNER: &str = "\
[parameters]
x = 1.0
twice = \"2*x + height\"
[[point]]
name = \"hub\"
at = [\"x\", \"twice\", 0]
[[body]]
name = \"wheel\"
mass = 2.0
point = \"hub\"
[[effect]]
name = \"strut\"
kind = \"spring-damper\"
bodies = [\"chassis\", \"wheel\"]
points = [[0, 0, 0], \"hub\"]
stiffness = \"1 kN/m\"
damping = 1.0
free_length = 1.0
[[output]]
name = \"load\"
effect = \"strut\"
quantity = \"force\"
";
const TAIL: &str = "[[body]]\nname = \"last\"\nmass = 3.0\npoint = [0, 0, 1]\n";

fn include(file: &str, rest: &str) -> String {
    format!("[[include]]\nfile = \"{file}\"\n{rest}\n")
}

#[test]
fn parts_stand_where_they_are_included_with_their_prefix_and_parameters() {
    let includes = include("corner.toml", "prefix = \"left \"")
        + &include("corner.toml", "prefix = \"right \"\nset = { x = \"2*height\" }");
    let main = format!("{HEAD}{CHASSIS}{includes}{TAIL}");
    let folder = Folder::new("parts", &[("main.toml", &main), ("corner.toml", CORNER)]);
    let file = folder.read("main.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    let scene = file.scene::<f64>().unwrap_or_else(|e| panic!("{}", e.render()));
    let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["chassis", "left wheel", "right wheel", "last"]);
    assert_eq!(scene.bodies[1].center, [1.0, 2.5, 0.0]);
    assert_eq!(scene.bodies[2].center, [1.0, 2.5, 0.0]);
    assert_eq!(scene.outputs[1].name, "right load");
    // The tree with included parts equals that of a file with the parts written out.
    let corner = |name: &str| {
        CORNER
            .replace("\"wheel", &format!("\"{name} wheel"))
            .replace("\"hub", &format!("\"{name} hub"))
            .replace("\"strut", &format!("\"{name} strut"))
            .replace("\"load", &format!("\"{name} load"))
    };
    let parts = |name: &str| {
        corner(name).split_once("[[point]]").map(|(_, rest)| format!("[[point]]{rest}")).unwrap()
    };
    let head = HEAD.replace("[parameters]\n", "[parameters]\nx = 1.0\ntwice = \"2*x + height\"\n");
    let flat = format!("{head}{CHASSIS}{}{}{TAIL}", parts("left"), parts("right"));
    let flat = SceneFile::parse(&flat, "main.toml").and_then(|file| file.numbers());
    assert_eq!(file.numbers().unwrap(), flat.unwrap_or_else(|e| panic!("{}", e.render())));
    assert_eq!(file.files().count(), 3);
}

#[test]
fn includes_nest_and_look_names_up_outwards() {
    let corner = format!("{}{CORNER}", include("hub.json", "prefix = \"inner \""));
    let hub = r#"{ "body": [{ "name": "cap", "mass": "height", "point": { "of": "hub", "plus": [0, 0, "x"] } }],
                   "joint": [{ "name": "rod", "kind": "distance", "bodies": ["cap", "wheel"], "points": [{ "of": "hub", "plus": [0, 0, "x"] }, "hub"] }] }"#;
    let main = format!("{HEAD}{CHASSIS}{}", include("corner.toml", "prefix = \"left \""));
    let files = [("main.toml", &main[..]), ("corner.toml", &corner), ("hub.json", hub)];
    let folder = Folder::new("nest", &files);
    let file = folder.read("main.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    let scene = file.scene::<f64>().unwrap_or_else(|e| panic!("{}", e.render()));
    let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["chassis", "left inner cap", "left wheel"]);
    assert_eq!((scene.bodies[1].mass, scene.bodies[1].center), (0.5, [1.0, 2.5, 1.0]));
    assert_eq!(scene.joints[0].name, "left inner rod");
    // Paths of sweeps also name included parts.
    assert_eq!(file.number("parameter.\"left x\"").expect("a number").to_f64(), 1.0);
    let scene = file.with_set("parameter.\"left x\"=2").and_then(|file| file.scene::<f64>());
    assert_eq!(scene.expect("a scene").bodies[2].center, [2.0, 4.5, 0.0]);
    let number = 7.0.into();
    let set = file.with_number("body.\"left wheel\".mass", &number).expect("a path");
    assert_eq!(set.scene::<f64>().expect("a scene").bodies[2].mass, 7.0);
    assert_ne!(set.whole_text(), file.whole_text());
}

#[test]
fn refusals_in_included_files_name_both_files() {
    let bad = CORNER.replace("\"2*x + height\"", "\"2*y\"");
    let main = format!("{HEAD}{CHASSIS}{}", include("bad.toml", "prefix = \"left \""));
    let folder = Folder::new("refused", &[("main.toml", &main), ("bad.toml", &bad)]);
    let text = folder.refusal("main.toml");
    assert!(text.starts_with("bad.toml:3:12: `y` is no parameter"), "{text}");
    assert!(
        text.contains("hint: ") && text.ends_with("included from main.toml:10 as \"left \"\n"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_included_is_refused_at_its_place() {
    let files = [
        ("ring.toml", include("ring2.toml", "")),
        ("ring2.toml", include("ring.toml", "")),
        ("whole.toml", "[solver]\nstep = 1e-3\n".to_owned()),
        ("corner.toml", CORNER.to_owned()),
        ("broken.toml", "[[body]\n".to_owned()),
        ("odd.toml", "[[bdy]]\nname = \"b\"\n".to_owned()),
    ];
    let files: Vec<_> = files.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let folder = Folder::new("cases", &files);
    let cases = [
        (include("none.toml", ""), "main.toml:7:8: cannot include `none.toml`"),
        (include("../", ""), "it is no file"),
        (
            include("ring.toml", ""),
            "ring2.toml:2:8: files that include one another: ring.toml -> ring2.toml -> ring.toml",
        ),
        (include("main.toml", ""), "files that include one another: main.toml -> main.toml"),
        (include("whole.toml", ""), "whole.toml:1:2: an included file has no [solver]"),
        (include("broken.toml", ""), "broken.toml:1:"),
        (include("odd.toml", "prefix = \"a\""), "odd.toml:1:3: unknown key `bdy`"),
        (
            include("corner.toml", "set = { y = 1 }"),
            "main.toml:8:9: `corner.toml` has no parameter `y`",
        ),
        (include("corner.toml", "set = 3"), "main.toml:8:7: expected a table of parameters"),
        (include("corner.toml", "prefx = \"a\""), "main.toml:8:1: unknown key `prefx`"),
        (
            include("corner.toml", "") + &include("corner.toml", ""),
            "there is another parameter `x`",
        ),
        ("[include]\nfile = \"a\"\n".to_owned(), "expected a list of tables"),
    ];
    for (includes, message) in cases {
        fs::write(folder.0.join("main.toml"), format!("{HEAD}{includes}{CHASSIS}"))
            .expect("a file");
        let text = folder.refusal("main.toml");
        assert!(text.contains(message), "{text}");
    }
    let alone = SceneFile::parse(&include("corner.toml", ""), "text").expect_err("no folder");
    assert!(alone.render().contains("lies in no folder"), "{}", alone.render());
}

#[test]
fn a_sweep_is_another_one_where_a_file_that_it_includes_has_changed() {
    let whole = include("part.toml", "");
    let part = |values| format!("[[vary]]\npath = 'scene.duration'\nvalues = [{values}]\n");
    let folder = Folder::new(
        "sweep",
        &[("sweep.toml", whole.as_str()), ("part.toml", part("1, 2").as_str())],
    );
    let text = || SweepSource::from(folder.read("sweep.toml").expect("a sweep")).text();
    let before = text();
    assert_eq!(before, text());
    folder.add("", "part.toml", &part("1, 3"));
    assert_ne!(before, text());
}
