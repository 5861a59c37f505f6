//! Worlds of SDF: joints and frames of the world, static models, included URDFs. Expected values are closed forms, unless a program is
//! named.

use crate::pendulum::{TOLERANCE, acceleration, close, model, scene_of, whole};
use mbs_core::scene::EffectKind;
use mbs_import::{ImportOptions, import};
use std::path::Path;

/// Acceleration of a rod of 1 kg on a pin [rad/s²]: g m l / (I + m l²) with l = 0.3 m, I = 0.02 kg m².
const SWING: f64 = 9.81 * 0.3 / 0.11;

const INERTIAL: &str = "<inertial><pose>0.3 0 0 0 0 0</pose><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial>";
const PIN: &str = "<joint name='pin' type='revolute'><parent>base</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis></joint>";

fn link(name: &str, pose: &str) -> String {
    format!("<link name='{name}'><pose>{pose}</pose>{INERTIAL}</link>")
}

fn bolt(child: &str) -> String {
    format!("<joint name='bolt' type='fixed'><parent>world</parent><child>{child}</child></joint>")
}

/// A model of a base and a rod on a pin, without its `model` element.
fn arm() -> String {
    link("base", "0 0 0 0 0 0") + &link("rod", "0 0 1 0 0 0") + PIN
}

fn world(inside: &str) -> String {
    format!(
        "<sdf version='1.10'><world name='w'><gravity>0 0 -9.81</gravity>{inside}</world></sdf>"
    )
}

#[track_caller]
fn swings(inside: &str, joint: &str, expected: f64) {
    let scene = whole(&world(inside), "world.sdf");
    assert_eq!(scene.joints.len(), 1);
    close(acceleration(&scene, joint), expected, TOLERANCE, joint);
}

#[test]
fn a_joint_of_the_world_holds_a_model_and_moves_one_against_the_other() {
    swings(&format!("<model name='m'>{}</model>{}", arm(), bolt("m::base")), "pin", SWING);
    // The model's name stands for the model's frame.
    swings(&format!("<model name='m'>{}</model>{}", arm(), bolt("m")), "pin", SWING);
    let two = |joint: &str| {
        let (base, rod) = (link("base", "0 0 0 0 0 0"), link("rod", "0 0 0 0 0 0"));
        format!(
            "<model name='a'>{base}{}</model><model name='b'><pose>0.5 0 1 0.2 0 0</pose>{rod}</model>{joint}",
            bolt("base")
        )
    };
    let hinge = "<joint name='hinge' type='revolute'><parent>a::base</parent><child>b::rod</child><axis><xyz>0 1 0</xyz></axis></joint>";
    swings(&two(hinge), "hinge", SWING * 0.2_f64.cos());
    let slide = hinge.replace("revolute", "prismatic").replace("0 1 0", "0 0 1");
    swings(&two(&slide), "hinge", -9.81 * 0.2_f64.cos());
}

#[test]
fn frames_of_the_world_place_models_joints_and_axes() {
    let shelf = "<frame name='shelf'><pose>0 0 2 0.5 0 0</pose></frame>";
    let on = |frame: &str| {
        format!("<model name='m'><pose relative_to='{frame}'/>{}{}</model>", arm(), bolt("base"))
    };
    swings(&(shelf.to_owned() + &on("shelf")), "pin", SWING * 0.5_f64.cos());
    // A frame relative to a frame that is defined after it, and the frame of another model.
    let far = "<frame name='far' attached_to='shelf'><pose>0 0 1 0.3 0 0</pose></frame>";
    swings(&format!("{}{far}{shelf}", on("far")), "pin", SWING * 0.8_f64.cos());
    let stone = "<model name='stone'><static>true</static><pose>1 0 0 0.7 0 0</pose><link name='l'/></model>";
    swings(&(stone.to_owned() + &on("stone")), "m::pin", SWING * 0.7_f64.cos());
    // The joint of the world is in a frame attached to a link, and its axis is in another frame.
    let inside = format!(
        "{shelf}<frame name='hook' attached_to='a::base'><pose>0 0 0.1 0 0 0</pose></frame><model name='a'>{}{}</model><model name='b'>{}</model>\
         <joint name='j' type='revolute'><pose relative_to='hook'/><parent>hook</parent><child>b</child><axis><xyz expressed_in='shelf'>0 1 0</xyz></axis></joint>",
        link("base", "0 0 0 0 0 0"),
        bolt("base"),
        link("rod", "0 0 0.1 0 0 0"),
    );
    // The axis is (0, cos, sin) of 0.5 rad. The inertia about both axes across the rod is I = 0.02 + 0.09.
    swings(&inside, "j", SWING * 0.5_f64.cos());
}

#[test]
fn the_world_and_its_only_model_may_have_the_same_names() {
    let text = world(&format!(
        "<frame name='rod'><pose>0 0 1 0 0 0</pose></frame><model name='m'><pose relative_to='rod'/>{}</model>{}",
        arm(),
        "<joint name='pin' type='prismatic'><parent>world</parent><child>m::base</child><axis><xyz>0 0 1</xyz></axis></joint>"
    ));
    let scene = whole(&text, "world.sdf");
    let names: Vec<_> = scene.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["pin", "world::pin"]);
    assert!(scene.frames.iter().any(|frame| frame.name == "world::rod"));
}

#[test]
fn links_and_frames_called_ground_have_other_names_in_the_scene() {
    let text = format!(
        "<frame name='ground'><pose>0 0 3 0 0 0</pose></frame><model name='m'>{}{}</model>",
        arm().replace("base", "ground"),
        bolt("ground")
    );
    swings(&text, "pin", SWING);
    let scene = whole(&world(&text), "world.sdf");
    for name in ["ground-link", "ground-frame"] {
        assert!(scene.frames.iter().any(|frame| frame.name == name), "{name}");
    }
}

#[test]
fn a_name_that_stands_for_ground_may_be_taken() {
    let urdf = PART.replace("\"rod\"", "\"ground\"").replace("\"base\"", "\"ground-link\"");
    close(acceleration(&whole(&urdf, "part.urdf"), "pin"), SWING, TOLERANCE, "URDF");
    let arm = arm().replace("base", "ground").replace("'rod'", "'ground-link'");
    let arm = arm.replace(">rod<", ">ground-link<");
    swings(&format!("<model name='m'>{arm}{}</model>", bolt("ground")), "pin", SWING);
}

#[test]
fn what_is_in_a_static_model_does_nothing() {
    let screw = "<joint name='s' type='screw'><parent>base</parent><child>rod</child><axis><xyz>0 0 1</xyz></axis></joint>";
    let follows = PIN.replace("</axis>", "<mimic joint='pin'><multiplier>2</multiplier></mimic><dynamics><damping>1</damping></dynamics></axis>");
    for inside in [
        arm(),
        link("base", "0 0 0 0 0 0") + &link("rod", "0 0 1 0 0 0") + screw + &follows,
        // One link has neither an inertia nor gravity. The other has an automatic inertia, but no shape to compute it from.
        format!(
            "<link name='base'><gravity>false</gravity></link><link name='rod'><inertial auto='true'/></link>{PIN}"
        ),
        format!("<model name='inner'>{}</model>", arm()),
        arm() + "<drake:joint name='x'/>",
    ] {
        let text = format!(
            "<model name='s'><static>true</static>{inside}</model><model name='m'>{}{}</model>",
            arm(),
            bolt("base")
        );
        swings(&text, "m::pin", SWING);
    }
    // A rod on a static model can move.
    let text = format!(
        "<model name='s'><static>1</static>{}</model><model name='m'>{}</model>\
         <joint name='j' type='revolute'><parent>s::base</parent><child>m::rod</child><axis><xyz>0 1 0</xyz></axis></joint>",
        link("base", "0 0 0 0 0 0"),
        link("rod", "0 0 1 0 0 0"),
    );
    swings(&text, "j", SWING);
}

#[test]
fn the_default_of_an_axis_is_z_of_the_joint() {
    let text = |kind: &str, axis: &str| {
        let body = link("rod", "0 0 1 0.3 0 0");
        format!(
            "<model name='m'>{body}<joint name='j' type='{kind}'><parent>world</parent><child>rod</child>{axis}</joint></model>"
        )
    };
    let range = "<axis><limit><effort>2</effort></limit></axis>";
    swings(&text("prismatic", range), "j", -9.81 * 0.3_f64.cos());
    swings(&text("revolute", "<axis/>"), "j", -SWING * 0.3_f64.sin());
    // Before version 1.5, axes were in the frame of the model.
    let old = world(&text("prismatic", "<axis/>")).replace("1.10", "1.4");
    close(acceleration(&whole(&old, "old.sdf"), "j"), -9.81, TOLERANCE, "1.4");
}

#[test]
fn a_joint_of_old_files_may_have_the_name_of_a_link() {
    let text = world(&format!("<model name='m'>{}{}</model>", arm(), bolt("base")));
    let text = text.replace("name='pin'", "name='rod'").replace("1.10", "1.6");
    close(acceleration(&whole(&text, "old.sdf"), "rod"), SWING, TOLERANCE, "rod");
}

/// A base and a rod on a pin, as a URDF.
const PART: &str = r#"<robot name="part"><link name="base"/>
<link name="rod"><inertial><origin xyz="0.3 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02"/></inertial></link>
<joint name="pin" type="continuous"><parent link="base"/><child link="rod"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/></joint></robot>"#;

/// Writes the URDF into a folder, and returns options that read it.
fn beside(folder: &str, part: &str) -> ImportOptions {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("part.urdf"), part).expect("a file");
    ImportOptions { folder: Some(folder), ..ImportOptions::default() }
}

#[test]
fn a_urdf_stands_in_a_world_as_a_model_would() {
    let options = beside("urdf-in-sdf", PART);
    let include = |inside: &str| format!("<include><uri>part.urdf</uri>{inside}</include>");
    let swings = |inside: &str, joint: &str, expected: f64| {
        let model = model(&world(inside), "world.sdf", &options);
        assert_eq!(model.findings, []);
        close(acceleration(&scene_of(&model), joint), expected, TOLERANCE, inside);
    };
    swings(&(include("") + &bolt("part::base")), "pin", SWING);
    swings(&(include("<name>p</name>") + &bolt("p::base")), "pin", SWING);
    // The cases are a pose of the model, a pose of a frame in the model, and a model around it.
    let posed = "<name>p</name><pose>0 3 0 0.4 0 0</pose>";
    swings(&(include(posed) + &bolt("p")), "pin", SWING * 0.4_f64.cos());
    let placed = "<name>p</name><pose>0 3 0 0.4 0 0</pose><placement_frame>rod</placement_frame>";
    swings(&(include(placed) + &bolt("p")), "pin", SWING * 0.4_f64.cos());
    let outer = format!(
        "<model name='o'><pose>0 0 0 0.1 0 0</pose>{}{}</model>",
        include(posed),
        bolt("p::base")
    );
    swings(&outer, "p::pin", SWING * 0.5_f64.cos());
    // Two copies of the model, of which one is static.
    let second = include("<name>q</name><static>true</static>");
    swings(&(include("<name>p</name>") + &bolt("p::base") + &second), "p::pin", SWING);
    let merged = include("").replace("<include>", "<include merge='true'>");
    let refused = import(
        format!("<sdf version='1.10'><model name='m'>{merged}</model></sdf>").as_bytes(),
        "m.sdf",
        &options,
    );
    assert_eq!(refused.expect_err("refused").fault().to_string(), "a URDF that is merged");
}

#[test]
fn a_urdf_in_a_world_keeps_its_followers_inputs_and_findings() {
    let part = PART.replace(
        "</robot>",
        r#"<link name="tip"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
<joint name="second" type="continuous"><parent link="rod"/><child link="tip"/><mimic joint="pin"/></joint>
<transmission name="t"><joint name="pin"><hardwareInterface>EffortJointInterface</hardwareInterface></joint></transmission>
<gazebo/></robot>"#,
    );
    let options = beside("urdf-with-laws", &part);
    let text = "<include><uri>part.urdf</uri></include><model name='other'><static>true</static><link name='l'/></model>";
    let model = model(&world(text), "world.sdf", &options);
    assert_eq!((model.sizes.couplings, model.sizes.inputs), (1, 1));
    assert!(
        model.text.contains("name = \"part::pin effort\"")
            && model.text.contains("name = \"part::second mimic\"")
    );
    let found: Vec<_> = model.findings.iter().map(|finding| finding.element.as_str()).collect();
    assert_eq!(found, ["robot[part]/gazebo"]);
    // The root link of the URDF is the first body of the base.
    assert!(model.text.contains("bodies = [\"ground\", \"part::base\"]"), "{}", model.text);
}

#[test]
fn the_world_of_a_urdf_need_not_be_declared() {
    let text = PART.replace(r#"<link name="base"/>"#, "").replace("\"base\"", "\"world\"");
    close(acceleration(&whole(&text, "part.urdf"), "pin"), SWING, TOLERANCE, "pin");
    let options =
        ImportOptions { base: Some(mbs_import::BaseKind::Free), ..ImportOptions::default() };
    let refused = import(text.as_bytes(), "part.urdf", &options).expect_err("refused");
    assert!(refused.fault().to_string().contains("it is the ground, and cannot be free"));
    // Frames of Drake, on a link and on the ground.
    let frames = r#"<frame name="hand" link="rod" xyz="0.5 0 0" rpy="0 0 1"/><frame name="wall" link="world" xyz="0 2 0"/></robot>"#;
    let scene = whole(&text.replace("</robot>", frames), "part.urdf");
    let at = |name: &str| scene.frames.iter().find(|frame| frame.name == name).map(|x| x.at);
    assert_eq!([at("hand"), at("wall")], [Some([0.5, 0.0, 1.0]), Some([0.0, 2.0, 0.0])]);
    // The world cannot be the child link of a joint: `world` is then an unknown name.
    let text = PART.replace("child link=\"rod\"", "child link=\"world\"");
    let refused = import(text.as_bytes(), "part.urdf", &ImportOptions::default());
    assert_eq!(refused.expect_err("refused").fault().to_string(), "unknown link `world`");
}

#[test]
fn a_limit_that_leaves_no_range_is_said() {
    for (limit, says) in [
        (r#"effort="8" velocity="3""#, "neither `lower` nor `upper`: no range is taken"),
        (r#"lower="0" upper="0""#, "`lower` 0 is not below `upper` 0: no range is taken"),
        (r#"lower="0.5""#, "`lower` 0.5 is not below `upper` 0: no range is taken"),
        (r#"lower="-1""#, "ends without stiffness"),
    ] {
        let joint = format!("type=\"revolute\"><limit {limit}/>");
        let text = PART.replace("type=\"continuous\">", &joint);
        let model = model(&text, "part.urdf", &ImportOptions::default());
        let [finding] = &model.findings[..] else { panic!("{:?}", model.findings) };
        assert!(finding.says.starts_with(says), "{limit}: {}", finding.says);
        assert_eq!(model.text.contains("range = "), says.starts_with("ends"), "{limit}");
    }
    for (limit, says) in [
        ("<lower>0</lower><upper>0</upper>", "`lower` 0 is not below `upper` 0: no range is taken"),
        ("<upper>0.5</upper>", "one end alone: no range is taken"),
        ("<lower>-1</lower><upper>inf</upper>", "one end alone: no range is taken"),
    ] {
        let pin = PIN.replace("</axis>", &format!("<limit>{limit}</limit></axis>"));
        let arm = link("base", "0 0 0 0 0 0") + &link("rod", "0 0 1 0 0 0") + &pin;
        let text = world(&format!("<model name='m'>{arm}{}</model>", bolt("base")));
        let model = model(&text, "m.sdf", &ImportOptions::default());
        let [finding] = &model.findings[..] else { panic!("{:?}", model.findings) };
        assert!(finding.says.starts_with(says), "{limit}: {}", finding.says);
    }
}

#[test]
fn damping_of_a_ball_is_a_moment_against_its_turn_as_in_drake() {
    let joint = |dynamics: &str| {
        format!(
            r#"<sdf version="1.9"><model name="m"><link name="b"><pose>0.1 0 0 0 0 0</pose></link><joint name="j" type="ball"><parent>world</parent><child>b</child><axis><dynamics>{dynamics}</dynamics></axis></joint></model></sdf>"#
        )
    };
    let read =
        |dynamics: &str| import(joint(dynamics).as_bytes(), "m.sdf", &ImportOptions::default());
    // Four dampers of d / 8 at the corners of a tetrahedron with 1 m coordinates give a moment of d.
    let scene = scene_of(&read("<damping>0.8</damping>").expect("it is read"));
    assert_eq!(scene.effects.len(), 4);
    for effect in &scene.effects {
        let EffectKind::Bushing(bushing) = &effect.kind else { panic!("{effect:?}") };
        let right = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0];
        for (found, right) in bushing.damping.iter().zip(right) {
            close(*found, right, TOLERANCE, "damping");
        }
    }
    let listed = read("<friction>0.2</friction><spring_stiffness>3</spring_stiffness>");
    let listed = listed.expect("it is read").findings;
    let of_ball = listed.iter().filter(|finding| finding.says.contains("of a ball does not act"));
    assert_eq!(of_ball.count(), 2, "{listed:?}");
    assert!(read("<damping>-1</damping>").is_err());
}
