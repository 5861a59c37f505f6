//! Shapes for pictures: meshes are found, have paths relative to the scene's folder, and are at the poses of the file.

use mbs_import::{FindingKind, ImportOptions, import};
use std::path::{Path, PathBuf};

/// A folder for one test, with a package `parts` that has one mesh.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    for part in ["parts/meshes", "robots/arm", "scenes"] {
        std::fs::create_dir_all(folder.join(part)).expect("a folder");
    }
    let mesh = folder.join("parts/meshes/link.STL");
    std::fs::write(mesh, "solid\nendsolid\n").expect("a file");
    folder
}

/// The lines of meshes in the scene, and the messages about elements for pictures that are not drawn.
fn drawn(text: &str, options: &ImportOptions) -> (Vec<String>, Vec<String>) {
    let model = import(text.as_bytes(), "model", options).expect("a model");
    model.scene_file("model").and_then(|file| file.scene::<f64>()).expect("a scene");
    let lines = model.text.lines().filter(|line| line.starts_with("mesh = "));
    let for_the_eye = |f: &&mbs_import::ModelFinding| f.kind == FindingKind::Appearance;
    let says = model.findings.iter().filter(for_the_eye).map(|finding| finding.says.clone());
    (lines.map(str::to_owned).collect(), says.collect())
}

const LINK: &str = r#"<robot name="r"><link name="a"><visual><origin xyz="0 0 1"/><geometry>MESH</geometry></visual>
<collision><geometry><sphere radius="0.5"/></geometry></collision></link></robot>"#;

#[test]
fn a_package_is_found_upwards_from_the_model_and_where_a_user_says() {
    let home = folder("mesh-urdf");
    let options = |folder: &str| ImportOptions {
        folder: Some(home.join(folder)),
        scene_folder: Some(home.join("scenes")),
        ..ImportOptions::default()
    };
    let urdf =
        |mesh: &str| LINK.replace("MESH", &format!("<mesh filename=\"{mesh}\" scale=\"1 1 -2\"/>"));
    let line = r#"mesh = { file = "../parts/meshes/link.STL", at = [0.0, 0.0, 1.0], scale = [1.0, 1.0, -2.0] }"#;
    let found = vec![line.to_owned()];
    for (mesh, folder) in [
        ("package://parts/meshes/link.STL", "robots/arm"),
        ("package:///parts/meshes/link.STL", "parts/meshes"),
        ("../parts/meshes/link.STL", "scenes"),
    ] {
        assert_eq!(drawn(&urdf(mesh), &options(folder)), (found.clone(), vec![]), "{mesh}");
    }
    let away = urdf("package://other/meshes/link.STL");
    let (lines, says) = drawn(&away, &options("scenes"));
    assert!(lines.is_empty() && says[0].contains("--package other=FOLDER; forms of contact"));
    for told in [
        ImportOptions { packages: vec![("other".into(), home.join("parts"))], ..options("scenes") },
        ImportOptions { package_path: vec![home.join("x"), home.clone()], ..options("scenes") },
    ] {
        let text = if told.packages.is_empty() {
            urdf("package://parts/meshes/link.STL")
        } else {
            away.clone()
        };
        assert_eq!(drawn(&text, &told), (found.clone(), vec![]));
    }
    let inside = ImportOptions { no_outside: true, ..options("robots/arm") };
    assert!(drawn(&urdf("package://parts/meshes/link.STL"), &inside).0.is_empty());
}

#[test]
fn a_mesh_that_is_not_read_is_no_reason_to_refuse_a_model() {
    let home = folder("mesh-wrong");
    let options = ImportOptions { folder: Some(home), ..ImportOptions::default() };
    for (mesh, word) in [
        ("<mesh filename=\"a.dae\"/>", "`.dae`"),
        ("<mesh filename=\"none.stl\"/>", "not found"),
        ("<mesh/>", "without a file"),
        ("<mesh filename=\"parts/meshes/link.STL\" scale=\"x\"/>", "scale"),
        ("<mesh filename=\"http://a/b.stl\"/>", "http://"),
    ] {
        let text = LINK.replace("MESH", mesh);
        let (lines, says) = drawn(&text, &options);
        assert!(lines.is_empty() && says.len() == 1 && says[0].contains(word), "{says:?}");
        // The collision shape is drawn instead.
        assert!(says[0].ends_with("stand in"), "{says:?}");
        let model = import(text.as_bytes(), "model", &options).expect("a model");
        assert!(model.text.contains("sphere = { center = [0.0, 0.0, 0.0], radius = 0.5 }"));
    }
}

#[test]
fn it_is_said_which_package_would_have_given_a_form() {
    let home = folder("mesh-contact");
    let options = ImportOptions { folder: Some(home), ..ImportOptions::default() };
    let text = LINK.replace("MESH", "<mesh filename=\"a.dae\"/>");
    let text = text.replace("<sphere radius=\"0.5\"/>", "<mesh filename=\"package://p/a.stl\"/>");
    let (lines, says) = drawn(&text, &options);
    assert!(lines.is_empty(), "{lines:?}");
    assert!(says[0].contains("`.dae`") && says[0].ends_with("--package p=FOLDER"), "{says:?}");
}

#[test]
fn meshes_of_mjcf_and_sdf_stand_where_their_files_say() {
    let home = folder("mesh-others");
    let options = ImportOptions { folder: Some(home), ..ImportOptions::default() };
    let mjcf = r#"<mujoco><compiler meshdir="parts/meshes"/>
<asset><mesh name="u" file="link.STL" scale="2 2 2" refpos="0 0 1" refquat="1 0 0 1"/></asset>
<worldbody><body name="b"><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
<geom type="mesh" mesh="u" pos="0 0 3"/></body></worldbody></mujoco>"#;
    // Position 3 + 2 Rᵗ (0 - 1 z). The quaternion rotates by a right angle about z, and its inverse turns x to -y.
    let line = r#"mesh = { file = "parts/meshes/link.STL", at = [0.0, 0.0, 1.0], axes = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]], scale = 2.0 }"#;
    let (lines, says) = drawn(mjcf, &options);
    assert!(says.is_empty(), "{says:?}");
    assert_eq!(rounded(&lines[0]), line);
    let sdf = r#"<sdf version="1.7"><model name="m"><static>true</static><link name="a"><pose>1 0 0 0 0 0</pose>
<visual name="v"><geometry><mesh><uri>model://parts/meshes/link.STL</uri><scale>3 3 3</scale></mesh></geometry></visual></link></model></sdf>"#;
    let line = r#"mesh = { file = "parts/meshes/link.STL", at = [1.0, 0.0, 0.0], scale = 3.0 }"#;
    let (lines, says) = drawn(sdf, &options);
    assert_eq!((lines[0].as_str(), says), (line, vec![]));
}

/// A line of the scene with its numbers rounded to nine decimals.
fn rounded(line: &str) -> String {
    let number = |word: &str| match word.parse::<f64>() {
        Ok(x) => format!("{:?}", (x * 1e9).round() / 1e9 + 0.0),
        Err(_) => word.to_owned(),
    };
    let parts = line.split_inclusive(['[', ']', ',', ' ']);
    let parts = parts.map(|part| {
        let end = part.trim_end_matches(['[', ']', ',', ' ']).len();
        number(&part[..end]) + &part[end..]
    });
    parts.collect()
}
