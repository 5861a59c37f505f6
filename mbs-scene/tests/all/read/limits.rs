//! Limits of joints: they are read and written. Invalid limits are refused at their place.

use super::{PLANAR, read, refused};
use mbs_core::scene::*;
use mbs_scene::{SceneFile, to_toml};

/// The planar scene with further lines in its first joint; the first of them is line 23.
fn with(lines: &str) -> String {
    PLANAR
        .replace("at = [0.0, 0.0]\n\n[[joint]]", &format!("at = [0.0, 0.0]\n{lines}\n\n[[joint]]"))
}

#[test]
fn range_effort_and_rate_of_a_joint_are_read_and_written() {
    let text = with("range = [-0.5, 1.25]\neffort_limit = 40.0\nvelocity_limit = 3.5");
    let scene = read(&text).unwrap();
    let limits = JointLimits { range: Some([-0.5, 1.25]), effort: Some(40.0), velocity: Some(3.5) };
    assert_eq!(scene.joints[0].limits, limits);
    assert_eq!(scene.joints[1].limits, JointLimits::NONE);
    let numbers = SceneFile::parse(&text, "x").unwrap().numbers().unwrap();
    assert_eq!(read(&to_toml(&numbers).unwrap()).unwrap(), scene);
    // The joint built in code has the same limits.
    let bodies = [GROUND, BodyId::Body(0)];
    let built = Joint::revolute(bodies, [0.0, 0.0]).range(-0.5, 1.25).effort_limit(40.0);
    assert_eq!(built.velocity_limit(3.5).limits, numbers.joints[0].limits);
}

#[test]
fn limits_that_mean_nothing_are_refused_at_their_numbers() {
    let refusal = |lines: &str| read(&with(lines)).expect_err(lines);
    let e = refusal("range = [1.0, 0.5]");
    let order = "`range` has its lower end 1 not below its upper end 0.5";
    refused(&e, "23:9", order, "[lower, upper]");
    assert!(e.render().contains("range = [1.0, 0.5]\n"), "{}", e.render());
    assert!(e.render().contains("^^^^^^^^^^"), "{}", e.render());
    let e = refusal("range = [0.5, 0.5]");
    refused(&e, "23:9", "`range` has its lower end 0.5 not below its upper end 0.5", "lower end");
    let e = refusal("range = [0.5]");
    refused(&e, "23:9", "expected 2 entries, found 1", "write 2");
    let e = refusal("range = 0.5");
    refused(&e, "23:9", "expected a list of two numbers: [lower, upper], found a number", "write");
    let e = refusal("range = [0.0, inf]");
    refused(&e, "23:15", "`inf` is not a finite number", "finite decimal");
    let e = refusal("velocity_limit = 0.0");
    refused(&e, "23:18", "`velocity_limit` must be larger than zero, but is 0", "larger than zero");
    let e = refusal("effort_limit = -1.0");
    refused(&e, "23:16", "`effort_limit` must be larger than zero, but is -1", "larger than zero");
    let e = refusal("limits = [0, 1]");
    assert!(e.to_string().contains("unknown key `limits`"), "{e}");
}

#[test]
fn limits_are_of_joints_with_one_coordinate() {
    let free = with("range = [0.0, 1.0]").replacen("kind = \"revolute\"", "kind = \"free\"", 1);
    let e = read(&free).expect_err("three coordinates");
    let message = "`range` is a joint with 3 coordinates; exactly one is needed";
    refused(&e, "23:9", message, "revolute or prismatic");
}

#[test]
fn stops_need_a_range_and_a_mass_or_their_numbers() {
    let first = PLANAR.lines().count() + 1;
    let refusal = |lines: &str| {
        let text = format!("{PLANAR}[[effect]]\nkind = \"limit\"\n{lines}\n");
        read(&text).expect_err(lines)
    };
    let e = refusal("joint = \"pivot\"\nrange = true");
    let place = format!("{}:9", first + 3);
    refused(&e, &place, "`range` is that of the joint, which has none", "to the joint");
    let e = refusal("joint = \"elbow\"\nlower = -1.0\nupper = 1.0");
    let message = "`stiffness` is left out, but does not follow from the scene: the coordinate moves no mass of its own";
    refused(&e, &format!("{first}:1"), message, "write `stiffness` and `damping`");
    let e = refusal("joint = \"pivot\"\nupper = 1.0");
    refused(&e, &format!("{first}:1"), "`lower` is missing", "add `lower`");
}
