//! Malformed files: each is refused at its place, in less than a second, without a panic.

use mbs_import::{FindingKind, ImportOptions, import};

const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="lower"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><mimic joint="shoulder"/></joint>
</robot>
"#;

fn refused(text: &str) -> String {
    match import(text.as_bytes(), "arm.urdf", &ImportOptions::default()) {
        Ok(model) => panic!("read as\n{}", model.text),
        Err(error) => format!("{}:{}: {}", error.place().line, error.place().column, error.fault()),
    }
}

#[test]
fn what_cannot_be_meant_is_refused_at_its_place() {
    assert!(import(ARM.as_bytes(), "arm.urdf", &ImportOptions::default()).is_ok());
    for (found, instead, message) in [
        ("\"lower\"/>", "\"lover\"/>", "7:70: unknown link `lover`"),
        ("\"shoulder\"/></joint>", "\"sholder\"/></joint>", "7:91: unknown joint `sholder`"),
        (
            "<link name=\"base\"/>",
            "<link name=\"base\"/><link name=\"upper\"/>",
            "4:3: a second link `upper`",
        ),
        ("value=\"1\"", "value=\"1,5\"", "4:38: `1,5` in `value` is not a finite number"),
        ("value=\"1\"", "value=\"nan\"", "4:38: `nan` in `value` is not a finite number"),
        ("value=\"1\"", "value=\"1e999\"", "4:38: `1e999` in `value` is not a finite number"),
        ("value=\"1\"", "value=\"0x10\"", "4:38: `0x10` in `value` is not a finite number"),
        ("value=\"1\"", "value=\"-1\"", "4:38: the mass is below zero"),
        ("0 1 0", "0 0 0", "6:92: the axis has no direction"),
        ("0 1 0", "0 1", "6:92: `xyz` has 2 numbers"),
        (
            "ixx=\"1\"",
            "ixx=\"9\"",
            "4:3: link `upper`, with all that is fixed to it, has principal moments [1.0, 1.0, 9.0], which no body has",
        ),
        ("continuous", "hinge", "6:26: unknown type of joint `hinge`"),
        (
            "<parent link=\"base\"/>",
            "<parent link=\"lower\"/>",
            "6:3: links are each other's parents in a circle: `lower`, `upper`",
        ),
        (
            "joint=\"shoulder\"",
            "joint=\"elbow\"",
            "7:3: joints mimic each other in a circle: `elbow`",
        ),
        ("robot", "robots", "2:1: the root element is `robots`"),
        ("</robot>", "", "7:117: not XML: the root node was opened but never closed"),
    ] {
        // For the word `robot`, both tags of the root element are replaced.
        let all = found == "robot";
        let text = if all { ARM.replace(found, instead) } else { ARM.replacen(found, instead, 1) };
        assert_eq!(refused(&text), message, "{found} -> {instead}");
    }
    let macros = r#"<robot xmlns:xacro="http://x" name="a"><xacro:macro name="b"/></robot>"#;
    assert_eq!(refused(macros), "1:1: a file of macros: it has elements `xacro:...`");
    assert!(
        import(b"\xff\xfe<\0", "a", &ImportOptions::default())
            .is_err_and(|e| e.fault().to_string() == "not UTF-8 text")
    );
    for usd in [&b"#usda 1.0\n()"[..], b"PXR-USDC\0\x08\xff"] {
        let error = import(usd, "robot.usd", &ImportOptions::default()).expect_err("refused");
        assert!(mbs_import::is_model(usd) && error.render().contains("export the robot as URDF"));
    }
}

#[test]
fn a_model_of_another_file_is_found_or_refused_with_the_chain() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../lab/models/conventions");
    let with = |uri: &str, no_outside: bool| {
        let text = format!(
            "<sdf version=\"1.9\"><model name=\"m\">\n<include><uri>{uri}</uri></include></model></sdf>"
        );
        let folder = Some(folder.join("sdf_part"));
        let options = ImportOptions { folder, no_outside, ..ImportOptions::default() };
        import(text.as_bytes(), "m.sdf", &options)
            .map(|model| model.text.contains("name = \"part::two\""))
            .map_err(|error| {
                let error = error.render();
                error.lines().next().unwrap_or_default().to_owned()
            })
    };
    // The folder of `model.config`, by its path and by the search in parent folders.
    for uri in ["../sdf_part", "model://sdf_part", "part.sdf", "file://part.sdf"] {
        assert_eq!(with(uri, false), Ok(true), "{uri}");
    }
    for (uri, message) in [
        ("https://a/b", "m.sdf:2:10: models are not fetched by `https://`"),
        ("model://none", "m.sdf:2:10: there is no model `model://none`"),
        ("../ref.xml", "m.sdf:2:10: the root element of `../ref.xml` is `mujoco`"),
    ] {
        assert_eq!(with(uri, false), Err(message.to_owned()));
    }
    let outside = with("../sdf_fixed.sdf", true).expect_err("outside");
    assert!(outside.contains("lies outside"), "{outside}");
    let temporary = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let light = "<sdf version=\"1.9\"><light name=\"sun\" type=\"point\"/></sdf>";
    std::fs::write(temporary.join("sun.sdf"), light).expect("a folder");
    let world = "<sdf version=\"1.9\"><world name=\"w\"><include><uri>sun.sdf</uri></include><model name=\"m\"><link name=\"l\"/></model></world></sdf>";
    let options = ImportOptions { folder: Some(temporary.to_owned()), ..ImportOptions::default() };
    let model = import(world.as_bytes(), "w.sdf", &options).expect("a light is for the eye");
    assert!(model.findings.iter().any(|x| x.kind == FindingKind::Appearance));
    let own = "<sdf version=\"1.9\"><model name=\"m\"><include><uri>own.sdf</uri></include></model></sdf>";
    std::fs::write(temporary.join("own.sdf"), own).expect("a folder");
    let error = import(own.as_bytes(), "own.sdf", &options).expect_err("a circle");
    assert!(error.fault().to_string().starts_with("`own.sdf` includes itself"), "{error:?}");
}

#[test]
fn every_element_that_nobody_reads_is_told_with_its_place() {
    let text = ARM.replacen("<mass value", "<weight/><mass unit=\"kg\" value", 1);
    let model = import(text.as_bytes(), "arm.urdf", &ImportOptions::default()).expect("read");
    let told: Vec<_> =
        model.findings.iter().map(|x| (x.kind, x.line, x.column, x.element.as_str())).collect();
    let ignored = FindingKind::Ignored;
    assert_eq!(
        told,
        [
            (ignored, 4, 32, "robot[arm]/link[upper]/inertial/weight"),
            (ignored, 4, 47, "robot[arm]/link[upper]/inertial/mass@unit")
        ]
    );
}

/// Damages a text in one place, at random.
fn damaged(bytes: &[u8], dice: &mut mbs_scene::Dice) -> Vec<u8> {
    let mut text = bytes.to_vec();
    let at = dice.below(text.len());
    match dice.below(4) {
        0 => text[at] = u8::try_from(dice.below(256)).unwrap_or(0),
        1 => drop(text.drain(at..(at + dice.below(40)).min(bytes.len()))),
        2 => text.splice(at..at, bytes[at / 2..at].iter().copied()).for_each(drop),
        // In the last case, another number replaces a number.
        _ => {
            let digits = ["-1", "0", "1e300", "nan", "7 7 7", ""];
            let end = (at + 1 + dice.below(3)).min(bytes.len());
            text.splice(at..end, dice.one_of(&digits).bytes()).for_each(drop);
        }
    }
    text
}

#[test]
fn damaged_files_of_all_formats_never_panic() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../lab/models/conventions");
    let mut dice = mbs_scene::Dice::new(17);
    let (mut read, mut refused) = (0, 0);
    for entry in std::fs::read_dir(folder).expect("a folder of this repository").flatten() {
        let name = entry.path();
        let ending = name.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if !matches!(ending, "urdf" | "xml" | "sdf") {
            continue;
        }
        let bytes = std::fs::read(&name).expect("a file of this repository");
        for _ in 0..40 {
            match import(&damaged(&bytes, &mut dice), "model", &ImportOptions::default()) {
                Ok(_) => read += 1,
                Err(error) => {
                    assert!(error.place().line > 0 && !error.hint().is_empty());
                    refused += 1;
                }
            }
        }
    }
    // Many damaged texts are read, and many are refused.
    assert!(read > 300 && refused > 1000, "{read} {refused}");
}
