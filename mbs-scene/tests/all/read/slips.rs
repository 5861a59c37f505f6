//! Mistakes that beginners make in a scene, with the expected messages.

use super::*;

const SCENE: &str = "[scene]\ndimension = 2\nduration = 1.0\n";
const BODY: &str = "[[body]]\nname = \"B\"\nmass = 1.0\npoint = [1.0, 0.0]\n";
const JOINT: &str =
    "[[joint]]\nkind = \"revolute\"\nname = \"A\"\nbodies = [\"ground\", \"B\"]\nat = [0.0, 0.0]\n";

#[test]
fn slips_of_a_first_scene_are_answered_with_what_to_write() {
    for (rest, hint) in [
        ("[[point]]\nname = \"p\"\nat = [\"380 mm\"]\n", "two numbers in the plane"),
        ("[gravity]\ny = -9.81\n", "gravity is a key of [scene]"),
        ("[world]\n", "\"ground\""),
        (
            "[[guide]]\nbody = \"A\"\nsignals = [\"s\"]\n",
            "a guide moves a joint: write `joint = \"A\"`",
        ),
        ("[[body]]\nname = \"ground\"\n", "choose another name"),
        ("[[include]]\nfile = \"none.toml\"\n", "folder"),
        ("[parameters]\nx = 2,5\n", "write 2.5"),
    ] {
        let text = format!("{SCENE}{BODY}{JOINT}{rest}");
        let read = SceneFile::parse(&text, "s.toml").and_then(|file| file.numbers());
        let shown = read.expect_err(rest).render();
        assert!(shown.contains(hint) && !shown.contains("os error"), "{rest}: {shown}");
    }
    let missing = mbs_scene::TriangleMesh::read("none.stl".as_ref()).expect_err("no file");
    assert_eq!(missing.to_string(), "there is no such file");
}
