//! Masses of SDF links from their collision shapes. Expected values are closed forms, or from Drake 1.51.1.

use crate::pendulum::{TOLERANCE, close, model, scene_of, ten};
use mbs_import::{ImportOptions, import};
use std::path::Path;

fn sdf(inertial: &str, collisions: &str) -> String {
    format!(
        "<sdf version='1.11'><model name='m'><link name='b'>{inertial}{collisions}</link></model></sdf>"
    )
}

fn collision(pose: &str, density: &str, form: &str) -> String {
    format!(
        "<collision name='c'><pose>{pose}</pose>{density}<geometry>{form}</geometry></collision>"
    )
}

const PANEL: &str = "<box><size>0.8 2 0.04</size></box>";
const AUTO: &str = "<inertial auto='true'><density>600</density></inertial>";

/// Compares the ten numbers of the link in a text. Contact is the only part that the import may leave out.
#[track_caller]
fn agrees(text: &str, expected: [f64; 10], tolerance: f64) {
    let model = model(text, "m.sdf", &ImportOptions::default());
    assert!(model.findings.iter().all(|x| x.element.ends_with("collision[c]")));
    for (found, expected) in ten(&scene_of(&model), "b").into_iter().zip(expected) {
        close(found, expected, tolerance, text);
    }
}

#[test]
fn masses_of_links_follow_from_their_forms_of_collision() {
    let flap = collision("0.4 0 0 0 0 0", "", PANEL);
    let expected = [38.4, 0.4, 0.0, 0.0, 12.80512, 2.05312, 14.848, 0.0, 0.0, 0.0];
    agrees(&sdf(AUTO, &flap), expected, TOLERANCE);
    // One shape has its own density, the other has the density of the link. The mass in the file scales both.
    let own = collision("0 0 0 0 0 0", "<density>100</density>", PANEL);
    let two = own + &collision("1 0 0 0 0 0", "", PANEL);
    let [xx, yy, zz] = [14.939306666666662, 7.8810209523809505, 22.80838095238095];
    let whole = [44.8, 6.0 / 7.0, 0.0, 0.0, xx, yy, zz, 0.0, 0.0, 0.0];
    agrees(&sdf(AUTO, &two), whole, TOLERANCE);
    let scaled = "<inertial auto='1'><mass>7</mass><density>600</density></inertial>";
    let share = |i: usize| if (1..4).contains(&i) { 1.0 } else { 7.0 / 44.8 };
    let expected = core::array::from_fn(|i| whole[i] * share(i));
    agrees(&sdf(scaled, &two), expected, TOLERANCE);
}

#[test]
fn masses_of_all_forms_are_those_of_the_other_program() {
    // Shapes of 1000 kg/m^3, rotated and moved: values of Drake 1.51.1.
    for line in [
        "<box><size>0.8 2 0.04</size></box> 64 0.4 0 0 20.148052521658215 4.954215921928711 24.408131556413082 4.6874302288132785 -1.7996582953955185 1.207321262386035",
        "<sphere><radius>0.3</radius></sphere> 113.09733552923252 0.4 0 0 4.071504079052372 4.071504079052371 4.071504079052371 0 0 0",
        "<cylinder><radius>0.1</radius><length>0.5</length></cylinder> 15.707963267948967 0.4 0 0 0.3527891490819734 0.3661258147505846 0.09266313834480489 0.002323874636372859 0.010378597238374216 -0.0613191752633837",
        "<capsule><radius>0.1</radius><length>0.5</length></capsule> 19.89675347273536 0.4 0 0 0.6936571576873889 0.722755337327996 0.12610949789720438 0.005070271933904417 0.022644212156452834 -0.13378729148374627",
        "<ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid> 25.132741228718345 0.4 0 0 0.6228672757182739 0.5149611516757115 0.2696050814142428 0.04292081157463806 0.00038078271217882424 -0.08156498237580626",
        "<cone><radius>0.2</radius><length>0.6</length></cone> 25.132741228718345 0.3672474 0.00554355 -0.14627555 0.4811015489031697 0.48983100279535163 0.3108372509661139 0.001521081580171342 0.006793263646935849 -0.04013618744512382",
    ] {
        let (form, numbers) = line.split_once("> ").expect("a form and its numbers");
        let numbers: Vec<f64> = numbers.split(' ').map(|x| x.parse().expect("number")).collect();
        let expected: [f64; 10] = numbers.try_into().expect("ten numbers");
        // Drake's centre of the cone has eight digits.
        let tolerance = if form.starts_with("<cone") { 1.0e-8 } else { TOLERANCE };
        let form = format!("{form}>");
        let turned = |density: &str| collision("0.4 0 0 0.1 0.2 0.3", density, &form);
        let other = "<inertial auto='true'><density>7</density></inertial>";
        agrees(&sdf(other, &turned("<density>1000</density>")), expected, tolerance);
        // Without a density, the shape has the format's default density, which is 1000 kg/m^3 too.
        agrees(&sdf("<inertial auto='true'/>", &turned("")), expected, tolerance);
    }
}

#[test]
fn the_mass_of_a_link_follows_from_a_mesh() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mesh-of-collision");
    std::fs::create_dir_all(&folder).expect("a folder");
    let corner = "v 0 0 0\nv 0.4 0 0\nv 0 0.3 0\nv 0 0 0.2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    std::fs::write(folder.join("t.obj"), corner).expect("a file");
    std::fs::write(folder.join("open.obj"), corner.replace("f 1 4 3\n", "")).expect("a file");
    let options = ImportOptions { folder: Some(folder), ..ImportOptions::default() };
    let text = |file: &str, scale: &str| {
        let form = format!("<mesh><uri>{file}</uri><scale>{scale}</scale></mesh>");
        sdf("<inertial auto='true'/>", &collision("0 0 0 0 0 0", "<density>500</density>", &form))
    };
    // The tetrahedron has a sixth of the volume of its box.
    for (scale, mass, x) in [("1 1 1", 2.0, 0.1), ("-1 2 3", 12.0, -0.1)] {
        let found = ten(&scene_of(&model(&text("t.obj", scale), "m.sdf", &options)), "b");
        close(found[0], mass, TOLERANCE, scale);
        close(found[1], x, TOLERANCE, scale);
    }
    for (file, says) in
        [("open.obj", "open at the edge"), ("none.obj", "there is no mesh `none.obj`")]
    {
        let error = import(text(file, "1 1 1").as_bytes(), "m.sdf", &options).expect_err("refused");
        assert!(error.fault().to_string().contains(says), "{error:?}");
    }
}

#[test]
fn forms_from_which_no_mass_follows_are_refused() {
    let auto = "<inertial auto='true'/>";
    let ball = "<sphere><radius>0.1</radius></sphere>";
    for (text, says) in [
        (sdf(auto, ""), "auto=\"true\", and the link has no <collision>"),
        (
            sdf(auto, &collision("", "", "<plane/>")),
            "a mass follows from this collision, and a `plane` has none",
        ),
        (sdf(auto, &collision("", "<density>-1</density>", ball)), "the density is below zero"),
        (
            sdf(auto, &collision("", "", "<sphere><radius>0</radius></sphere>")),
            "a `sphere` without volume",
        ),
        (
            sdf(
                "<inertial auto='true'><mass>1</mass></inertial>",
                &collision("", "<density>0</density>", ball),
            ),
            "the forms of collision have no mass that could be scaled",
        ),
    ] {
        let error =
            import(text.as_bytes(), "m.sdf", &ImportOptions::default()).expect_err("refused");
        assert_eq!(error.fault().to_string(), says);
    }
    // Values written beside auto="true" are reported as ignored.
    let written =
        "<inertial auto='true'><pose>1 0 0 0 0 0</pose><inertia><ixx>9</ixx></inertia></inertial>";
    let model = model(&sdf(written, &collision("", "", ball)), "m.sdf", &ImportOptions::default());
    let found: Vec<_> =
        model.findings.iter().map(|x| x.element.rsplit('/').next().unwrap_or("")).collect();
    assert_eq!(found, ["pose", "inertia", "collision[c]"]);
}
