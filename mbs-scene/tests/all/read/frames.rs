//! Tests of `[[frame]]`: named places on bodies, and refused entries.

use super::*;

const ARM: &str = "\
[scene]
dimension = 3
duration = 1.0

[[body]]
name = \"arm\"
mass = 1.0
center = [1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]

[[frame]]
name = \"tool\"
body = \"arm\"
at = [2.0, 0.0, 0.5]
axes = [[0, 1, 0], [0, 0, 1]]

[[frame]]
name = \"bench\"
body = \"ground\"
at = [0.0, 0.0, 1.0]
";

fn scene(rest: &str) -> Result<Scene<Number>, ReadError> {
    SceneFile::parse(&format!("{ARM}{rest}"), "test.toml")?.numbers()
}

#[test]
fn a_frame_stands_for_its_body_and_gives_the_place() {
    let frames = "[[output]]\nname = \"p\"\nbody = \"tool\"\nrelative_to = \"bench\"\nquantity = \"position\"\n\
                  [[effect]]\nkind = \"force\"\nbody = \"tool\"\nvalue = [0, 0, 1]\n\
                  [[output]]\nname = \"q\"\nbody = \"tool\"\nat = [2, 0, 0]\nquantity = \"position\"\n";
    let bodies = "[[output]]\nname = \"p\"\nbody = \"arm\"\nat = [2, 0, 0.5]\nrelative_to = \"ground\"\nquantity = \"position\"\n\
                  [[effect]]\nkind = \"force\"\nbody = \"arm\"\nat = [2, 0, 0.5]\nvalue = [0, 0, 1]\n\
                  [[output]]\nname = \"q\"\nbody = \"arm\"\nat = [2, 0, 0]\nquantity = \"position\"\n";
    let [one, other] =
        [frames, bodies].map(|rest| scene(rest).unwrap_or_else(|e| panic!("{}", e.render())));
    assert_eq!((one.outputs, one.effects), (other.outputs, other.effects));
    assert_eq!(one.frames[0].axes.as_ref().map(|axes| axes[0][1].to_f64()), Some(1.0));
}

#[test]
fn a_frame_of_its_bodys_name_is_the_place_that_stands_for_the_body() {
    let own = "[[frame]]\nname = \"arm\"\nbody = \"arm\"\nat = [0.5, 0.25, 0]\n";
    let output = |rest: &str| {
        format!("{own}[[output]]\nname = \"p\"\nbody = \"arm\"\nquantity = \"position\"\n{rest}")
    };
    let [one, other] = ["", "at = [0.5, 0.25, 0]"]
        .map(|rest| scene(&output(rest)).unwrap_or_else(|e| panic!("{}", e.render())));
    assert_eq!(one.outputs, other.outputs);
}

#[test]
fn frames_are_written_as_they_are_read() {
    let scene = scene("").unwrap_or_else(|e| panic!("{}", e.render()));
    let text = to_toml(&scene).expect("no code");
    let again = SceneFile::parse(&text, "test.toml").and_then(|file| file.numbers());
    assert_eq!(again.unwrap_or_else(|e| panic!("{}\n{text}", e.render())).frames, scene.frames);
}

#[test]
fn frames_that_cannot_be_meant_are_refused_at_their_place() {
    let refused = |rest: &str| {
        let whole = SceneFile::parse(&format!("{ARM}{rest}"), "test.toml").expect("TOML");
        let error = whole.scene::<f64>().expect_err(rest);
        format!("{}: {}", error.place().line, error.fault())
    };
    let frame = |keys: &str| format!("[[frame]]\n{keys}\n");
    let of = |name: &str, body: &str| {
        frame(&format!("name = \"{name}\"\nbody = \"{body}\"\nat = [0, 0, 0]"))
    };
    let other = "22: `name` is the name of body 1, on which it is not";
    assert_eq!(refused(&of("arm", "ground")), other);
    assert_eq!(refused(&of("tool", "arm")), "22: this name is already that of frame 1");
    assert_eq!(refused(&of("tip", "tool")), "23: unknown body `tool`");
    assert_eq!(refused(&frame("name = \"tip\"\nbody = \"arm\"")), "21: `at` is missing");
    let parallel = "name = \"tip\"\nbody = \"arm\"\nat = [0, 0, 0]\naxes = [[1, 0, 0], [-1, 0, 0]]";
    assert_eq!(refused(&frame(parallel)), "25: `axes` is parallel to the other axis");
}
