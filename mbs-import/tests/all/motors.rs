//! Motors for joints without an actuator in the file.

use mbs_import::{FindingKind, ImportOptions, import};

const ARM: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="fore"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><limit effort="50" lower="-1" upper="1"/></joint>
  <joint name="elbow" type="prismatic"><parent link="upper"/><child link="fore"/><limit effort="0" lower="-1" upper="1"/></joint>
</robot>"#;

#[test]
fn a_motor_is_an_input_within_the_effort_of_its_joint() {
    let options = ImportOptions { motors: true, ..ImportOptions::default() };
    let model = import(ARM.as_bytes(), "arm.urdf", &options).expect("a sound model");
    assert_eq!(model.sizes.inputs, 2);
    let limited = "name = \"shoulder.motor limited\"\nkind = \"clamp\"\nof = \"shoulder.motor\"\nlower = -50.0\nupper = 50.0\n";
    assert!(model.text.contains(limited));
    // The force on a slide is not limited: some exporters write an effort of zero for an unknown one.
    assert!(
        model
            .text
            .contains("joint = \"elbow\"\ncoordinate = \"slide\"\nsignal = \"elbow.motor\"\n")
    );
    let noted: Vec<_> =
        model.findings.iter().filter(|found| found.kind == FindingKind::Noted).collect();
    assert_eq!(noted.len(), 1);
    assert_eq!(noted[0].element, "joint[elbow]");
    assert_eq!(
        import(ARM.as_bytes(), "arm.urdf", &ImportOptions::default()).expect("sound").sizes.inputs,
        0
    );
}

#[test]
fn an_option_that_the_format_does_not_have_is_refused() {
    let options = ImportOptions { key: Some("home".into()), ..ImportOptions::default() };
    let refused = import(ARM.as_bytes(), "arm.urdf", &options).expect_err("a URDF has no keyframe");
    assert!(
        refused.to_string().contains("`key` is no option of a file in URDF"),
        "{}",
        refused.fault()
    );
}

#[test]
fn limits_of_a_fixed_joint_are_no_loss() {
    let fixed = ARM.replace("type=\"prismatic\"", "type=\"fixed\"");
    let model = import(fixed.as_bytes(), "arm.urdf", &ImportOptions::default()).expect("sound");
    let ignored = |found: &&mbs_import::ModelFinding| found.kind == FindingKind::Ignored;
    assert_eq!(model.findings.iter().filter(ignored).count(), 0);
}
