//! Masses computed from shapes and meshes. Expected values are closed forms, or from the program that is named.

use crate::pendulum::{TOLERANCE, acceleration, close, model, scene_of, ten, whole};
use mbs_import::{FindingKind, ImportOptions, import};

/// Tolerance for meshes, since MuJoCo stores their vertices in single precision [-].
const SINGLE: f64 = 1.0e-6;
/// A tetrahedron with one corner at the origin.
const CORNER: &str =
    r#"vertex="0 0 0  0.4 0 0  0 0.3 0  0 0 0.2" face="0 2 1  0 1 3  1 2 3  0 3 2""#;

fn mjcf(mesh: &str, geom: &str, compiler: &str) -> String {
    format!(
        r#"<mujoco><compiler {compiler}/><asset><mesh name="m" {mesh}/></asset><worldbody><body name="b" pos="0 0 1"><joint name="j" axis="0 1 0"/><geom mesh="m" contype="0" {geom}/></body></worldbody></mujoco>"#
    )
}

/// Compares mass, centre and moments; moments are relative to their own size.
#[track_caller]
fn agrees(text: &str, expected: [f64; 10], tolerance: f64) {
    let found = ten(&whole(text, "m.xml"), "b");
    let size = expected[4..].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let scale = if i == 0 {
            expected
        } else if i < 4 {
            1.0
        } else {
            size
        };
        assert!(
            (found - expected).abs() <= tolerance * scale,
            "{i}: {found} for {expected}: {text}"
        );
    }
}

#[test]
fn vertices_without_faces_are_their_hull() {
    // A cube with additional points inside and on its faces and edges: 8 kg, m a²/6.
    let text = mjcf(
        r#"vertex="-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1 0 0 0 1 0 0 1 1 0 0 -1 -1" scale="0.1 0.1 0.1""#,
        r#"type="mesh""#,
        "",
    );
    let moment = 8.0 * 0.04 / 6.0;
    agrees(&text, [8.0, 0.0, 0.0, 1.0, moment, moment, moment, 0.0, 0.0, 0.0], TOLERANCE);
    let text = text.replace("axis=\"0 1 0\"", "axis=\"0 1 0\" pos=\"-0.1 0 0\"");
    close(acceleration(&whole(&text, "m.xml"), "j"), 58.86, TOLERANCE, "cube");
    // The cube with a tip, as a volume and as a shell: values of MuJoCo 4.0.0. The pyramid of height 0.6 m is computed by hand.
    let tip = r#"vertex="-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1 0 0 3" scale=".1 .2 .3""#;
    let volume = [64.0, 0.0, 0.0, 1.1125, 4.854, 4.278, 0.96, 0.0, 0.0, 0.0];
    for inertia in ["", r#" inertia="convex""#, r#" inertia="exact""#, r#" inertia="legacy""#] {
        agrees(&mjcf(&format!("{tip}{inertia}"), r#"type="mesh""#, ""), volume, 1.0e-12);
    }
    let shell = [
        1169.801607618664,
        0.0,
        0.0,
        1.13754538,
        127.73383104762718,
        113.80930992815048,
        28.512596486285094,
        0.0,
        0.0,
        0.0,
    ];
    agrees(&mjcf(&format!(r#"{tip} inertia="shell""#), r#"type="mesh""#, ""), shell, 1.0e-8);
}

#[test]
fn the_hull_of_a_mesh_with_dents_is_asked_for_by_its_inertia() {
    // An L of 2 m and 1 m height: three cubes. Its hull has half a cube more.
    let l = r#"vertex="0 0 0 2 0 0 2 1 0 1 1 0 1 2 0 0 2 0 0 0 1 2 0 1 2 1 1 1 1 1 1 2 1 0 2 1" face="0 2 1 0 3 2 0 4 3 0 5 4 6 7 8 6 8 9 6 9 10 6 10 11 0 1 7 0 7 6 1 2 8 1 8 7 2 3 9 2 9 8 3 4 10 3 10 9 4 5 11 4 11 10 5 0 6 5 6 11""#;
    for (inertia, mass, center) in [("exact", 3000.0, 5.0 / 6.0), ("convex", 3500.0, 19.0 / 21.0)] {
        let text = mjcf(&format!(r#"{l} inertia="{inertia}""#), r#"type="mesh""#, "");
        let found = ten(&whole(&text, "m.xml"), "b");
        close(found[0], mass, TOLERANCE, inertia);
        close(found[1], center, TOLERANCE, inertia);
    }
}

#[test]
fn hulls_that_are_no_bodies_are_refused() {
    for (mesh, says) in [
        (r#"vertex="0 0 0 1 0 0 0 1 0 1 1 0""#, "its vertices are in one plane, and have no hull"),
        (
            r#"vertex="-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 0 0 1" maxhullvert="4""#,
            "a hull with the vertices of `maxhullvert` is not computed",
        ),
    ] {
        let text = mjcf(mesh, r#"type="mesh""#, "");
        let error = import(text.as_bytes(), "m.xml", &ImportOptions::default());
        let fault = error.expect_err("refused").fault().to_string();
        assert_eq!(fault, format!("the mass of this geom follows from a mesh: {says}"));
    }
}

#[test]
fn an_open_surface_is_closed_from_its_centre_and_listed() {
    let open = CORNER.replace("  0 3 2", "");
    let text = mjcf(&format!(r#"{open} inertia="exact""#), r#"type="mesh""#, "");
    let model = model(&text, "m.xml", &ImportOptions::default());
    let acts = model.findings.iter().find(|x| x.kind == FindingKind::Approximated);
    assert!(acts.is_some_and(|x| x.says.starts_with("its surface is open at the edge from 0 0 0")));
    // Values of MuJoCo 4.0.0.
    let found = ten(&scene_of(&model), "b");
    close(found[0], 2.666666852103343, SINGLE, "mass");
    close(found[4], 0.012863284140707002, SINGLE, "moment");
}

#[test]
fn the_shell_of_a_mesh_has_the_area_of_its_triangles() {
    let text = mjcf(&format!(r#"{CORNER} inertia="shell""#), r#"type="mesh" density="5""#, "");
    // Values of MuJoCo 4.0.0.
    let expected = [
        1.040512533135511,
        0.11411204,
        0.08077871,
        1.04744537,
        0.008412628081402007,
        0.012792398902489045,
        0.01601604524513609,
        0.0026861345029148506,
        0.0012852802129148582,
        0.0016966760419810341,
    ];
    agrees(&text, expected, SINGLE);
}

#[test]
fn forms_are_fitted_to_the_inertia_or_the_box_of_a_mesh() {
    // Mass, and moments xx, yy, zz: values of MuJoCo 4.0.0.
    for line in [
        "box false 5.577096406362992 0.027188346717104253 0.04182822425471229 0.052285281351523785",
        "sphere false 3.830945986312027 0.014438130617111097 0.014438130617111097 0.014438130617111099",
        "capsule false 5.386491793431093 0.019954643070144648 0.04615192977254727 0.051054713308416454",
        "cylinder false 4.95467759816728 0.01795864457051242 0.03647381436025026 0.03993890105568364",
        "ellipsoid false 2.9201608497653355 0.008541471030970691 0.013140724203131051 0.016425905578482253",
        "box true 28.677444934043365 0.4171544871398847 0.6227708455832603 0.7795617121864701",
        "sphere true 58.23706207564946 1.3468937819943658 1.3468937819943658 1.3468937819943663",
        "capsule true 34.36821571821729 0.4832112097710822 0.6313825177260423 0.6591125592903527",
        "cylinder true 45.20939123176574 0.7612751243190553 1.1323750550184442 1.201825859258728",
        "ellipsoid true 15.015475054752745 0.13105294722106794 0.19564923133542744 0.24490653480248956",
    ] {
        let words: Vec<_> = line.split(' ').collect();
        let [geom, compiler] = [format!("type='{}'", words[0]), format!("fitaabb='{}'", words[1])];
        let found = ten(&whole(&mjcf(CORNER, &geom, &compiler), "m.xml"), "b");
        for (found, expected) in [0, 4, 5, 6].map(|i| found[i]).into_iter().zip(&words[2..]) {
            let expected: f64 = expected.parse().expect("number");
            assert!((found / expected - 1.0).abs() < SINGLE, "{line}: {found}");
        }
    }
}

#[test]
fn a_form_whose_axes_are_a_choice_is_listed() {
    // A plate of 6 m by 6 m by 2 m, rotated about z.
    let corner = |x: f64, y: f64, z: f64| {
        let (sine, cosine) = 0.5_f64.sin_cos();
        format!("{} {} {z} ", cosine * x - sine * y, sine * x + cosine * y)
    };
    let ends = [-1.0, 1.0];
    let all =
        ends.map(|x| ends.map(|y| ends.map(|z| corner(3.0 * x, 3.0 * y, z)).concat()).concat());
    let mesh = format!(r#"vertex="{}""#, all.concat());
    for (geom, compiler, is_listed) in [
        ("type='box'", "", false),
        ("type='sphere'", "", false),
        ("type='cylinder'", "", true),
        ("type='capsule'", "", true),
        ("type='box'", "fitaabb='true'", true),
    ] {
        let model = model(&mjcf(&mesh, geom, compiler), "m.xml", &ImportOptions::default());
        let found = model.findings.iter().any(|x| x.kind == FindingKind::Approximated);
        assert_eq!(found, is_listed, "{geom} {compiler}");
    }
}

#[test]
fn a_form_that_is_fitted_has_a_mass_a_scale_and_a_shell_of_its_own() {
    let mass = |mesh: &str, geom: &str| ten(&whole(&mjcf(mesh, geom, ""), "m.xml"), "b")[0];
    let own = mass(CORNER, r#"type="box""#);
    close(mass(CORNER, r#"type="box" mass="3""#), 3.0, TOLERANCE, "mass");
    close(mass(CORNER, r#"type="box" fitscale="2""#), 8.0 * own, TOLERANCE, "fitscale");
    // A shell on the box that is fitted to the solid, and a box that is fitted to a shell: values of MuJoCo 4.0.0.
    close(mass(CORNER, r#"type="box" shellinertia="true""#), 208.69343618442605, SINGLE, "shell");
    let shell = format!(r#"{CORNER} inertia="shell""#);
    close(mass(&shell, r#"type="box""#), 11.743565356604618, SINGLE, "box of a shell");
}

#[test]
fn the_shell_of_an_ellipsoid_is_exact() {
    let text = r#"<mujoco><worldbody><body name="b" pos="0 0 1"><joint name="j" axis="1 0 0"/><geom type="ellipsoid" pos="0 0 -0.1" size="0.3 0.2 0.1" density="8" shellinertia="true"/></body></worldbody></mujoco>"#;
    let expected = [3.910572, 0.0, 0.0, 0.9, 0.064162, 0.114219, 0.145905, 0.0, 0.0, 0.0];
    agrees(text, expected, 5.0e-6);
}

#[test]
fn a_mesh_whose_mass_does_not_count_is_for_the_eye() {
    for mesh in [
        CORNER.to_owned() + r#" inertia="shell" refpos="1 0 0" maxhullvert="8""#,
        r#"builtin="sphere" params="2""#.to_owned(),
    ] {
        for (inertial, geom) in [
            (r#"<inertial pos="0.1 0 0" mass="2" diaginertia="0.02 0.02 0.02"/>"#, ""),
            (r#"<geom size="0.1"/>"#, r#"mass="0""#),
        ] {
            let text = mjcf(&mesh, &format!(r#"type="mesh" conaffinity="0" {geom}"#), "");
            let text = text.replace("<geom mesh", &format!("{inertial}<geom mesh"));
            let model = model(&text, "m.xml", &ImportOptions::default());
            let acts = model.findings.iter().find(|x| x.kind != FindingKind::Appearance);
            assert_eq!(acts, None, "{mesh}");
        }
    }
}

#[test]
fn built_in_meshes_of_few_points_are_computed_and_others_are_named() {
    let built_in = |words: &str| mjcf(&format!("builtin={words}"), r#"type="mesh""#, "");
    // Mass and height of the centre: values of MuJoCo 4.0.0; the last one is by hand, for a pyramid on a square.
    for (words, mass, height) in [
        (r#""cone" params="8 0.5""#, 3299.8315890630092, -0.214285714),
        (r#""sphere" params="0""#, 2536.1504726624075, 0.0),
        (r#""sphere" params="1""#, 3658.712126251761, 0.0),
        (r#""sphere" params="2""#, 4047.0446616510244, 0.0),
        (r#""sphere" params="3""#, 4152.740778128605, 0.0),
        (r#""sphere" params="4""#, 4179.738957796405, 0.0),
        (r#""hemisphere" params="2""#, 1785.6405784234898, 0.354278848),
        (r#""cone" params="4 0""#, 4000.0 / 3.0, -0.5),
    ] {
        let found = ten(&whole(&built_in(words), "m.xml"), "b");
        assert!((found[0] / mass - 1.0).abs() < SINGLE, "{words}: {}", found[0]);
        close(found[3], 1.0 + height, SINGLE, words);
    }
    for (words, says) in [
        (r#""wedge" params="4 4 1 1 0""#, "the built-in mesh `wedge` is not computed"),
        (r#""sphere" params="5""#, "`params` of the built-in mesh `sphere` do not fit"),
        (r#""cone" params="2 1""#, "`params` of the built-in mesh `cone` do not fit"),
        (r#""hemisphere""#, "`params` of the built-in mesh `hemisphere` do not fit"),
    ] {
        let error = import(built_in(words).as_bytes(), "m.xml", &ImportOptions::default());
        let shown = error.expect_err("refused").render();
        assert!(shown.contains(says), "{shown}");
    }
    let wedge = built_in(r#""wedge" params="4 4 1 1 0""#);
    let shown = import(wedge.as_bytes(), "m.xml", &ImportOptions::default());
    let shown = shown.expect_err("refused").render();
    for word in ["mj_saveLastXML", "<inertial>", "--massless-meshes"] {
        assert!(shown.contains(word), "{shown}");
    }
    let options = ImportOptions { massless_meshes: true, ..ImportOptions::default() };
    let other = wedge.replace("<geom mesh", r#"<geom size="0.1" contype="0"/><geom mesh"#);
    let says = "a mesh counts as massless (--massless-meshes)";
    assert!(model(&other, "m.xml", &options).findings.iter().any(|x| x.says == says));
}

/// A folder for one test, with these files in it.
fn folder(name: &str, files: &[(&str, &str)]) -> ImportOptions {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    }
    ImportOptions { folder: Some(folder), ..ImportOptions::default() }
}

/// Two tetrahedra, one with a corner at the origin and one 5 m beside it. Lines can be inserted before each, and between the faces of the
/// first.
fn two(first: &str, between: &str, second: &str) -> String {
    format!(
        "{first}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n{between}\nf 2 3 4\nf 1 4 3\n{second}\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n"
    )
}

#[test]
fn of_an_obj_with_several_objects_the_first_has_mass_as_in_mujoco_4() {
    let one = [1.0 / 6.0, 0.25, 0.25, 1.25];
    // The hull has the vertices of both tetrahedra: values of MuJoCo 4.0.0.
    let hull = [2.666666666666667, 2.671875, 0.328125, 1.328125];
    for (first, between, second, inertia, expected) in [
        ("o a", "", "o b", "legacy", one),
        ("g a", "", "g b", "exact", one),
        ("o a", "usemtl c", "o b", "exact", one),
        ("o a", "", "o b", "convex", hull),
    ] {
        let options = folder("objects", &[("two.obj", &two(first, between, second))]);
        let text = mjcf(
            &format!(r#"file="two.obj" inertia="{inertia}""#),
            r#"type="mesh" density="1""#,
            "",
        );
        let found = ten(&scene_of(&model(&text, "m.xml", &options)), "b");
        for (found, expected) in found.iter().zip(expected) {
            close(*found, expected, TOLERANCE, inertia);
        }
    }
}

/// An OBJ file moved by -3 m along x.
fn moved_back(text: &str) -> String {
    let moved = text.lines().map(|line| {
        match line.strip_prefix("v ").and_then(|rest| rest.split_once(' ')) {
            Some((x, rest)) => format!("v {} {rest}\n", x.parse::<f64>().expect("a number") - 3.0),
            None => format!("{line}\n"),
        }
    });
    moved.collect()
}

/// A prism of height 1 m over a regular polygon in a circle of radius 1 m.
fn regular_prism(corners: usize) -> String {
    let vertices = [0, 1].into_iter().flat_map(|z| {
        (0..corners).map(move |i| {
            let (sin, cos) = (core::f64::consts::TAU * i as f64 / corners as f64).sin_cos();
            format!("v {cos} {sin} {z}\n")
        })
    });
    let face = |corners: Vec<usize>| {
        let words: Vec<String> = corners.iter().map(|i| (i + 1).to_string()).collect();
        format!("f {}\n", words.join(" "))
    };
    let ends = [(0..corners).rev().collect(), (corners..2 * corners).collect()];
    let sides = (0..corners).map(|i| {
        let next = (i + 1) % corners;
        vec![i, next, corners + next, corners + i]
    });
    vertices.chain(ends.into_iter().chain(sides).map(face)).collect()
}

#[test]
fn polygons_of_an_obj_are_cut_as_in_mujoco_4() {
    // An L, and a box whose lid is bent at one corner.
    let concave = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\nf 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
    let bent = |lid: &str| {
        format!(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 2\nv 0 1 1\nf 4 3 2 1\nf {lid}\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
        )
    };
    // The lid is divided along its shorter diagonal, which does not pass through the bent corner. A pyramid over half a square is therefore
    // on the box.
    let box_and_pyramid = 1.0 + 1.0 / 6.0;
    for (text, inertia, mass) in [
        (concave.to_owned(), "exact", 3.0),
        (concave.to_owned(), "legacy", 3.0),
        // A polygon is divided by cutting off corner triangles (ears). Here a concave corner is on the edge of a possible ear.
        (
            concave
                .replace("f 6 5 4 3 2 1\n", "f 1 6 5 4 3 2\n")
                .replace("f 7 8 9 10 11 12\n", "f 8 9 10 11 12 7\n"),
            "legacy",
            3.0,
        ),
        (concave.replace("f 6 5 4 3 2 1\n", "f 2 1 6 5 4 3\n"), "legacy", 3.0),
        // The division of a polygon depends on its position relative to the origin. This is the same L, three metres away.
        (moved_back(concave), "exact", 2.825_262_308_313_156),
        (regular_prism(100), "exact", 50.0 * (core::f64::consts::TAU / 100.0).sin()),
        // A polygon with more than 100 corners is left out. The other faces then give 2/3 of the volume, since volumes are computed about the
        // centre of the faces.
        (regular_prism(101), "exact", 101.0 / 3.0 * (core::f64::consts::TAU / 101.0).sin()),
        (bent("5 6 7 8"), "exact", box_and_pyramid),
        (bent("6 7 8 5"), "exact", box_and_pyramid),
    ] {
        let options = folder("polygons", &[("m.obj", &text)]);
        let mesh = format!(r#"file="m.obj" inertia="{inertia}""#);
        let text = mjcf(&mesh, r#"type="mesh" density="1""#, "");
        let found = ten(&scene_of(&model(&text, "m.xml", &options)), "b");
        close(found[0], mass, TOLERANCE, &mesh);
    }
}

#[test]
fn a_mesh_of_an_included_file_may_lie_beside_it() {
    let part = r#"<mujocoinclude><asset><mesh name="t" file="t.obj"/></asset></mujocoinclude>"#;
    let tetrahedron = two("", "", "o b");
    let files = [("sub/part.xml", part), ("sub/t.obj", &tetrahedron)];
    let options = folder("beside", &files);
    let text = r#"<mujoco><compiler meshdir="none"/><include file="sub/part.xml"/><worldbody><body name="b"><joint/><geom type="mesh" mesh="t" density="1"/></body></worldbody></mujoco>"#;
    let found = ten(&scene_of(&model(text, "m.xml", &options)), "b");
    close(found[0], 1.0 / 6.0, TOLERANCE, "beside the included file");
}

#[test]
fn the_least_mass_of_a_body_without_any_is_where_mujoco_4_has_it() {
    // The mass is at the body's place, applied twice: once in the parent's frame and once in its own. Each body has 10 g.
    let text = r#"<mujoco><compiler boundmass="0.01" boundinertia="1e-5"/><option><flag contact="disable"/></option><worldbody><body name="arm" pos="1 0 0"><joint axis="0 1 0"/><geom type="box" contype="0" size=".1 .1 .1" mass="1"/>
<body name="none" pos="0 .5 0"/><body name="one" pos="0 0 .7"><geom type="box" contype="0" size=".1 .1 .1" mass="0" pos=".3 0 0"/></body><frame pos="0 0 -.4"><body name="two" pos="0 0 -.5"/></frame></body></worldbody></mujoco>"#;
    let found = ten(&whole(text, "m.xml"), "arm");
    let place = |own: f64| own * 2.0 * 0.01 / 1.03;
    for (found, expected) in found.iter().zip([1.03, 1.0, place(0.5), place(0.7 - 0.9)]) {
        close(*found, expected, TOLERANCE, "arm");
    }
}
