//! Tests of `[[shape]]`: shapes for pictures, and refused entries.

use super::*;

const SPACE: &str = "\
[scene]
dimension = 3
duration = 1.0

[[body]]
name = \"b\"
mass = 1.0
center = [1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]

[[point]]
name = \"p\"
at = [1.0, 2.0, 3.0]

[[shape]]
body = \"b\"
";

fn scene(shape: &str) -> Result<Scene<f64>, ReadError> {
    SceneFile::parse(&format!("{SPACE}{shape}\n"), "test.toml")?.scene()
}

#[test]
fn forms_are_read_with_points_units_and_colours() {
    let of =
        |shape: &str| scene(shape).unwrap_or_else(|e| panic!("{}", e.render())).shapes.remove(0);
    let shape =
        of("sphere = { center = \"p\", radius = \"20 mm\" }\ncolour = \"#10ff02\"\nopacity = 0.5");
    assert_eq!(shape.form, ShapeKind::Sphere { center: [1.0, 2.0, 3.0], radius: 0.02 });
    assert_eq!((shape.name.as_str(), shape.body), ("shape-1", BodyId::Body(0)));
    assert_eq!((shape.colour, shape.opacity, shape.is_visual), (Some([16, 255, 2]), 0.5, true));
    let shape = of(
        "box = { center = [0, 0, 0], size = [1, 2, 3], axes = [[0, 1, 0], [0, 0, 2]] }\nvisual = false",
    );
    let axes = Some([[0.0, 1.0, 0.0], [0.0, 0.0, 2.0]]);
    assert_eq!(shape.form, ShapeKind::Box { center: [0.0; 3], size: [1.0, 2.0, 3.0], axes });
    assert!(!shape.is_visual);
    let shape = of("capsule = { from = [0, 0, 0], to = \"p\", radius = 1 }\ncolour = \"steel\"");
    assert_eq!(shape.form.key(), "capsule");
}

#[test]
fn a_mesh_names_its_file_from_the_folder_of_the_scene() {
    let text = format!("{SPACE}mesh = {{ file = \"parts/a.stl\", at = \"p\", scale = 0.001 }}\n");
    let folder = std::path::Path::new("/somewhere");
    let file = SceneFile::parse_in(&text, "test.toml", folder).expect("TOML");
    let scene = file.numbers().unwrap_or_else(|e| panic!("{}", e.render()));
    let again = to_toml(&scene).expect("no code");
    for text in [&text, &again] {
        let file = SceneFile::parse_in(text, "test.toml", folder).expect("TOML");
        let shape = file.scene::<f64>().expect("a scene").shapes.remove(0);
        let ShapeKind::Mesh { file, at, axes, scale } = shape.form else { panic!("{shape:?}") };
        assert_eq!(file, "/somewhere/parts/a.stl");
        assert_eq!((at, axes, scale), ([1.0, 2.0, 3.0], None, [0.001; 3]));
    }
    // A text that is not a file has no folder, so the path stays relative.
    let ShapeKind::Mesh { file, .. } = scene_of_text(&text).shapes.remove(0).form else {
        panic!("a mesh")
    };
    assert_eq!(file, "parts/a.stl");
}

fn scene_of_text(text: &str) -> Scene<f64> {
    SceneFile::parse(text, "test.toml").and_then(|file| file.scene()).expect("a scene")
}

#[test]
fn shapes_are_written_as_they_are_read() {
    let file = SceneFile::parse(
        &format!(
            "{SPACE}name = \"s\"\ncylinder = {{ from = \"p\", to = [0, 0, 0], radius = 1 }}\ncolour = \"red\"\n"
        ),
        "test.toml",
    );
    let scene = file.and_then(|file| file.numbers()).unwrap_or_else(|e| panic!("{}", e.render()));
    let text = to_toml(&scene).expect("no code");
    let again = SceneFile::parse(&text, "test.toml").and_then(|file| file.numbers());
    let again = again.unwrap_or_else(|e| panic!("{}\n{text}", e.render()));
    assert_eq!(again.shapes, scene.shapes);
}

#[test]
fn what_is_no_shape_is_refused_at_its_place() {
    let cases = [
        ("", "`box, sphere, capsule, cylinder, disc, polygon or mesh` is missing", 15),
        (
            "sphere = { center = \"p\", radius = 1 }\nbox = { center = \"p\", size = [1, 1, 1] }",
            "both `box` and `sphere` are given",
            17,
        ),
        ("sphere = { center = \"p\", radius = 0 }", "`sphere` must be larger than zero", 17),
        ("sphere = { center = \"p\" }", "`radius` is missing", 17),
        ("disc = { center = [0, 0], radius = 1 }", "`disc` has no meaning here", 17),
        ("box = { center = \"p\", size = [1, 1] }", "expected 3 entries, found 2", 17),
        (
            "box = { center = \"p\", size = [1, 1, 1], axes = [[1, 0, 0], [2, 0, 0]] }",
            "parallel",
            17,
        ),
        ("capsule = { from = \"p\", to = \"p\", radius = 1 }", "same place", 17),
        (
            "sphere = { center = \"p\", radius = 1 }\nopacity = 2",
            "`opacity` must be from 0 to 1, but is 2",
            18,
        ),
        ("sphere = { center = \"p\", radius = 1 }\ncolour = \"stel\"", "unknown colour `stel`", 18),
        ("sphere = { center = \"p\", radius = 1 }\ncolour = \"#12é45\"", "unknown colour", 18),
        ("mesh = { file = \"a.stl\", scale = [1, 2] }", "expected 3 entries, found 2", 17),
        ("mesh = { file = \"a.stl\", scale = 0 }", "`mesh` must be larger than zero", 17),
        ("mesh = { at = \"p\" }", "`file` is missing", 17),
        ("sphere = { center = \"p\", radius = 1 }\ncolor = \"red\"", "unknown key `color`", 18),
    ];
    for (shape, message, line) in cases {
        let error = scene(shape).expect_err(message);
        assert!(error.render().contains(message), "{message}: {}", error.render());
        assert_eq!(error.place().line, line, "{}", error.render());
    }
}
