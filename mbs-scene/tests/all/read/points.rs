//! Point masses: they are read with a place alone, and written as they were read. A key that needs an orientation is refused at its place.

use super::{read, read_back, refused};
use mbs_core::scene::*;

/// A point on a distance joint and an arm on a revolute joint, in space. Tests append entries, from line 28 on.
const SPACE: &str = r#"[scene]
dimension = 3
duration = 1.0
[[body]]
name = "ball"
mass = 1.5
point = [0.5, 0.0, -0.25]
[[body]]
name = "arm"
mass = 1.0
center = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 2.0]
[[joint]]
name = "string"
kind = "distance"
bodies = ["arm", "ball"]
points = [[0.5, 0.0, 0.0], [0.5, 0.0, -0.25]]
[[joint]]
name = "way"
kind = "free"
bodies = ["ground", "ball"]
"#;

/// A point mass in the plane, on an arm. Tests append entries, from line 23 on.
const PLANE: &str = r#"[scene]
dimension = 2
duration = 1.0
[[body]]
name = "ball"
mass = 1.5
point = [0.5, -0.25]
[[body]]
name = "arm"
mass = 1.0
center = [0.0, 0.0]
inertia = 1.0
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.0, 0.0]
[[joint]]
name = "pin"
kind = "revolute"
bodies = ["arm", "ball"]
at = [0.5, -0.25]
"#;

const TURNS: &str = "`ball` is a point: it has no orientation";
const OFF: &str = "`ball` is a point: this place is 2.500000e-1 m off it";

/// Entries that are refused in the spatial scene, each with its text, place and message.
const IN_SPACE: &[[&str; 3]] = &[
    [
        "[[joint]]\nname = \"x\"\nkind = \"revolute\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\naxis = [0, 1, 1]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"universal\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\naxes = [[0, 1, 1], [1, 0, 0]]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"prismatic\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\naxis = [0, 1, 1]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"cylindrical\"\nbodies = [\"ball\", \"arm\"]\nat = [0.5, 0, -0.25]\naxis = [0, 1, 1]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"planar\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\naxis = [0, 1, 1]\ndirection = [1, 0, 0]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"pin-in-slot\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\naxis = [0, 1, 1]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"weld\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"distance\"\nbodies = [\"ball\", \"arm\"]\npoints = [[0.5, 0, -0.25], [0, 0, 0]]\naxis = [0, 1, 1]",
        "30:8",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"free\"\nbodies = [\"ball\", \"arm\"]\nat = [0.5, 0, -0.25]",
        "31:10",
        TURNS,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"spherical\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, 0]",
        "32:6",
        OFF,
    ],
    [
        "[[joint]]\nname = \"x\"\nkind = \"distance\"\nbodies = [\"arm\", \"ball\"]\npoints = [[0, 0, 0], [0.5, 0, 0]]",
        "32:10",
        OFF,
    ],
    ["[[effect]]\nkind = \"torque\"\nbody = \"ball\"\nvalue = [0, 0, 1]", "30:8", TURNS],
    [
        "[[effect]]\nkind = \"force\"\nbody = \"ball\"\nat = [0.5, 0, -0.25]\nvalue = [0, 0, 1]\nframe = \"body\"",
        "30:8",
        TURNS,
    ],
    [
        "[[effect]]\nkind = \"force\"\nbody = \"ball\"\nat = [0.5, 0, 0]\nvalue = [0, 0, 1]",
        "31:6",
        OFF,
    ],
    [
        "[[effect]]\nkind = \"spring-damper\"\nbodies = [\"arm\", \"ball\"]\npoints = [[0, 0, 0], [0.5, 0, 0]]\nstiffness = 1\nfree_length = 1",
        "31:10",
        OFF,
    ],
    [
        "[[effect]]\nkind = \"bushing\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0, -0.25]\nstiffness = [1, 1, 1, 1, 0, 0]",
        "30:10",
        TURNS,
    ],
    [
        "[[effect]]\nkind = \"bushing\"\nbodies = [\"ball\", \"arm\"]\nat = [0.5, 0, -0.25]\nstiffness = [1, 1, 1, 0, 0, 0]",
        "30:10",
        TURNS,
    ],
    [
        "[[effect]]\nkind = \"polynomial-spring\"\nbodies = [\"ball\", \"arm\"]\npoints = [[0.5, 0, -0.25], [0, 0, 0]]\ncoefficients = [[0, 1, 1]]\ndirection = [1, 0, 0]",
        "30:10",
        TURNS,
    ],
    [
        "[[effect]]\nkind = \"speed-hold\"\nbody = \"ball\"\ndirection = [1, 0, 0]\nspeed = 1\ngain = 1\nlimit = 1",
        "30:8",
        TURNS,
    ],
    [
        "[[effect]]\nkind = \"tire\"\nbody = \"ball\"\ncenter = [0.5, 0, -0.25]\naxis = [0, 1, 0]\nradius = 0.3\nstiffness = 1e5",
        "30:8",
        TURNS,
    ],
    [
        "[[rolling]]\nname = \"x\"\nkind = \"ball\"\nbody = \"ball\"\ncenter = [0.5, 0, -0.25]\nradius = 0.3\nplane = { point = [0, 0, -0.55], normal = [0, 0, 1] }",
        "31:8",
        TURNS,
    ],
    ["[[initial]]\nbody = \"ball\"\nangular_velocity = [0, 0, 1]", "30:20", TURNS],
    ["[[initial]]\nbody = \"ball\"\nat = [0.5, 0, 0]\nvelocity = [0, 0, 1]", "30:6", OFF],
    ["[[output]]\nname = \"o\"\nbody = \"ball\"\nquantity = \"orientation\"", "30:8", TURNS],
    ["[[output]]\nname = \"o\"\nbody = \"ball\"\nquantity = \"angular-velocity\"", "30:8", TURNS],
    [
        "[[output]]\nname = \"o\"\nbody = \"ball\"\nquantity = \"angular-acceleration\"",
        "30:8",
        TURNS,
    ],
    [
        "[[output]]\nname = \"o\"\nbody = \"arm\"\nrelative_to = \"ball\"\nquantity = \"angular-velocity\"",
        "31:15",
        TURNS,
    ],
    [
        "[[output]]\nname = \"o\"\nbody = \"arm\"\nat = [0, 0, 0]\nrelative_to = \"ball\"\nquantity = \"position\"",
        "32:15",
        TURNS,
    ],
    [
        "[[output]]\nname = \"o\"\nbody = \"ball\"\nat = [0.5, 0, 0]\nquantity = \"position\"",
        "31:6",
        OFF,
    ],
    [
        "[[initial]]\njoint = \"way\"\nvalue = [0, 0, 0, 0, 0, 0]",
        "30:9",
        "`value` needs 3 numbers, but has 6",
    ],
];

/// Entries that are refused in the planar scene, with their place. They ask for the angle of the pin, which a point does not have.
const IN_THE_PLANE: &[[&str; 2]] = &[
    ["[[initial]]\njoint = \"pin\"\nvalue = 0.1", "24:9"],
    ["[[guide]]\njoint = \"pin\"\nramp = { rate = 1.0 }", "24:9"],
    ["[[output]]\nname = \"o\"\njoint = \"pin\"\nquantity = \"value\"", "25:9"],
    ["[[output]]\nname = \"o\"\njoint = \"pin\"\nquantity = \"rate\"", "25:9"],
    ["[[effect]]\nkind = \"torque\"\njoint = \"pin\"\nvalue = 1.0", "25:9"],
    ["[[effect]]\nkind = \"torsion-spring\"\njoint = \"pin\"\nstiffness = 1.0", "25:9"],
    ["[[effect]]\nkind = \"friction\"\njoint = \"pin\"\ncoulomb = 1.0", "25:9"],
    ["[[effect]]\nkind = \"rotor\"\njoint = \"pin\"\ninertia = 1.0\nratio = 2.0", "25:9"],
    ["[[effect]]\nkind = \"limit\"\njoint = \"pin\"\nlower = 0\nupper = 1\nstiffness = 1", "25:9"],
    [
        "[[coupling]]\nname = \"c\"\nkind = \"gear\"\njoints = [\"hinge\", \"pin\"]\nratio = 2.0",
        "23:1",
    ],
    ["[[signal]]\nname = \"s\"\nkind = \"measure\"\njoint = \"pin\"\nquantity = \"value\"", "26:9"],
];

#[test]
fn what_a_point_has_not_is_refused_at_its_place() {
    for [entry, place, message] in IN_SPACE {
        let text = format!("{SPACE}{entry}\n");
        let hint = if *message == TURNS { "takes" } else { "" };
        refused(&read(&text).expect_err(entry), place, message, hint);
    }
    for [entry, place] in IN_THE_PLANE {
        let text = format!("{PLANE}{entry}\n");
        refused(&read(&text).expect_err(entry), place, TURNS, "takes");
    }
    let both = SPACE.replace("mass = 1.5\n", "mass = 1.5\ncenter = [0, 0, 0]\n");
    refused(&read(&both).unwrap_err(), "7:10", "both `point` and `center` are given", "keep one");
    let planar = PLANE.replace("point = [0.5, -0.25]", "point = [0.5, -0.25, 0.5]");
    let message = "`point` leaves the plane of a planar scene by 0.5";
    refused(&read(&planar).unwrap_err(), "7:9", message, "x-y plane");
    let none = SPACE.replace("point = [0.5, 0.0, -0.25]\n", "center = [0.5, 0.0, -0.25]\n");
    refused(&read(&none).unwrap_err(), "4:1", "`inertia` is missing", "a point mass has `point");
}

#[test]
fn a_point_reads_back_with_what_it_takes() {
    let rest = r#"[[effect]]
kind = "spring-damper"
bodies = ["ground", "ball"]
points = [[0, 0, 1], [0.5, 0, -0.25]]
stiffness = 1
free_length = 1
[[effect]]
kind = "bushing"
bodies = ["arm", "ball"]
at = [0.5, 0, -0.25]
stiffness = [1, 1, 1, 0, 0, 0]
[[effect]]
kind = "torsion-spring"
joint = "way"
coordinate = "z"
stiffness = 2
[[effect]]
kind = "aero-drag"
body = "ball"
at = [0.5, 0, -0.25]
area_coefficient = 0.1
density = 1.2
[[initial]]
joint = "way"
value = [0.1, 0.2, 0.3]
rate = [1, 2, 3]
[[output]]
name = "value"
joint = "way"
quantity = "value"
[[output]]
name = "reaction"
joint = "string"
quantity = "reaction"
[[output]]
name = "energy"
body = "ball"
quantity = "kinetic-energy"
"#;
    let scene = read_back(&format!("{SPACE}{rest}"));
    assert!(scene.bodies[0].is_point() && scene.bodies[0].center == [0.5, 0.0, -0.25]);
    let way = &scene.joints[2];
    assert_eq!((way.kind, way.points[0]), (JointKind::FreePoint, [0.5, 0.0, -0.25]));
    assert_eq!(way.kind.n_coordinates(Dimension::Spatial), 3);
    let planar = read_back(PLANE);
    // The pin has no angle, so it has no output.
    let names: Vec<_> = planar.channels().into_iter().map(|output| output.name).collect();
    assert_eq!(names, ["hinge"]);
}
