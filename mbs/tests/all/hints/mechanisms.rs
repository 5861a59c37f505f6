//! Hints on points, masses, settings, and runs that do not begin or that stop.

use super::Row;
use super::row;
use super::scenes::{GUIDED, LOCKING, PLANAR, SPATIAL};

pub(super) fn rows() -> Vec<Row> {
    let parts = [places(), masses(), points(), settings(), stops()];
    parts.into_iter().flatten().collect()
}

/// Hints on points, axes and joints.
#[allow(clippy::too_many_lines, reason = "a table")]
fn places() -> Vec<Row> {
    vec![
        row(
            PLANAR,
            &[("to = [1.0, 0.0] }", "to = [0.0, 0.0] }")],
            ["both points in the same place", "move one of the two"],
            &[("to = [0.0, 0.0] }", "to = [1.0, 0.0] }")],
        ),
        row(
            PLANAR,
            &[("at = [1.0, 0.0]", "at = [1.0, 0.0, 0.1]")],
            ["leaves the plane", "x-y plane"],
            &[("[1.0, 0.0, 0.1]", "[1.0, 0.0]")],
        ),
        row(
            PLANAR,
            &[("name = \"elbow\"\nkind = \"revolute\"", "name = \"elbow\"\nkind = \"spherical\"")],
            ["needs a spatial scene", "keep to what is planar"],
            &[("spherical", "revolute")],
        ),
        row(
            PLANAR,
            &[("[\"crank\", \"arm\"]", "[\"arm\", \"arm\"]")],
            ["the same body twice", "two different bodies"],
            &[("[\"arm\", \"arm\"]", "[\"crank\", \"arm\"]")],
        ),
        row(
            SPATIAL,
            &[("axis = [0.0, 1.0, 0.0]", "axis = [0.0, 0.0, 0.0]")],
            ["has no direction", "a vector that is not zero"],
            &[("axis = [0.0, 0.0, 0.0]", "axis = [0.0, 1.0, 0.0]")],
        ),
        row(
            SPATIAL,
            &[(
                "kind = \"weld\"\nbodies = [\"arm\", \"tip\"]\nat = [1.0, 0.0, 0.0]",
                "kind = \"universal\"\nbodies = [\"arm\", \"tip\"]\nat = [1.0, 0.0, 0.0]\naxes = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]",
            )],
            ["parallel to the other axis", "a right angle is usual"],
            &[("[[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]", "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]")],
        ),
        row(
            GUIDED,
            &[
                ("joint = \"slide\"\ntable", "joint = \"fixed\"\ntable"),
                (
                    "[[guide]]",
                    "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n[[joint]]\nname = \"fixed\"\nkind = \"weld\"\nbodies = [\"a\", \"b\"]\nat = [0.0, 0.0]\n[[guide]]",
                ),
            ],
            ["0 coordinates; exactly one is needed", "use a revolute or prismatic joint"],
            &[("joint = \"fixed\"\ntable", "joint = \"slide\"\ntable")],
        ),
        row(
            GUIDED,
            &[("[[guide]]", "[[initial]]\njoint = \"slide\"\nvalue = 0.2\n[[guide]]")],
            ["but the guide of the joint starts with 0", "remove the initial entry"],
            &[("[[initial]]\njoint = \"slide\"\nvalue = 0.2\n", "")],
        ),
    ]
}

/// Hints on masses and inertias.
fn masses() -> Vec<Row> {
    vec![
        row(
            SPATIAL,
            &[("inertia = [0.01, 0.1, 0.1,", "inertia = [0.01, 0.1, 0.3,")],
            ["breaks the triangle inequality", "check the moments and products"],
            &[("[0.01, 0.1, 0.3,", "[0.01, 0.1, 0.1,")],
        ),
        row(
            PLANAR,
            &[("inertia = 0.1", "inertia = -0.1")],
            ["negative principal moment", "check the signs"],
            &[("-0.1", "0.1")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = 0.0")],
            ["is not zero, but the body has no mass", "give the body mass"],
            &[("mass = 0.0", "mass = 2.0")],
        ),
        row(
            PLANAR,
            &[("mass = 2.0", "mass = 0.0")],
            ["is not zero, but the body has no mass", "weld it to a body with mass"],
            &[
                ("name = \"elbow\"\nkind = \"revolute\"", "name = \"elbow\"\nkind = \"weld\""),
                ("[[initial]]\njoint = \"elbow\"\nrate = 0.5\n", ""),
            ],
        ),
        // a branch that ends without mass, and a point mass on its joint
        row(
            PLANAR,
            &[
                ("mass = 2.0\ncenter = [1.5, 0.0]\ninertia = 0.1", "mass = 0.0"),
                ("bodies = [\"arm\", \"ground\"]", "bodies = [\"crank\", \"ground\"]"),
            ],
            ["a force would meet no inertia", "give the body mass and inertia"],
            &[("mass = 0.0", "mass = 2.0\ncenter = [1.5, 0.0]\ninertia = 0.1")],
        ),
        row(
            PLANAR,
            &[("center = [1.5, 0.0]\ninertia = 0.1", "center = [1.0, 0.0]\ninertia = 0.0")],
            ["a force would meet no inertia", "weld a point mass to what carries it"],
            &[
                ("name = \"elbow\"\nkind = \"revolute\"", "name = \"elbow\"\nkind = \"weld\""),
                ("[[initial]]\njoint = \"elbow\"\nrate = 0.5\n", ""),
            ],
        ),
        row(
            PLANAR,
            &[("center = [1.5, 0.0]\ninertia = 0.1", "center = [1.0, 0.0]\ninertia = 0.0")],
            ["a force would meet no inertia", "or give it any small inertia"],
            &[("inertia = 0.0", "inertia = 1e-3")],
        ),
    ]
}

/// Hints on points that rotate without inertia, and on nodes without mass.
fn points() -> Vec<Row> {
    vec![
        row(
            PLANAR,
            &[
                ("center = [1.5, 0.0]\ninertia = 0.1", "center = [1.0, 0.0]\ninertia = 0.0"),
                ("points = [[1.5, 0.0], [1.5, 1.0]]", "points = [[1.0, 0.0], [1.0, 1.0]]"),
                ("at = [2.0, 0.0]", "at = [1.0, 0.0]"),
            ],
            ["a force would meet no inertia", "write a point mass as `point`"],
            &[
                ("center = [1.0, 0.0]\ninertia = 0.0", "point = [1.0, 0.0]"),
                ("[[initial]]\njoint = \"elbow\"\nrate = 0.5\n", ""),
            ],
        ),
        // a massless node between two springs
        row(
            PLANAR,
            &[
                (
                    "mass = 2.0\ncenter = [1.5, 0.0]\ninertia = 0.1",
                    "mass = 0.0\npoint = [1.5, 0.0]",
                ),
                (
                    "[[joint]]\nname = \"elbow\"\nkind = \"revolute\"\nbodies = [\"crank\", \"arm\"]\nat = [1.0, 0.0]\n[[initial]]\njoint = \"elbow\"\nrate = 0.5\n",
                    "[[effect]]\nname = \"second\"\nkind = \"spring-damper\"\nbodies = [\"crank\", \"arm\"]\npoints = [[1.0, 0.0], [1.5, 0.0]]\nstiffness = 100.0\nfree_length = 0.4\n",
                ),
                ("at = [2.0, 0.0]", "at = [1.5, 0.0]"),
            ],
            ["a force would meet no inertia", "m = 4 k h^2"],
            &[("mass = 0.0", "mass = 2e-3")],
        ),
    ]
}

/// Hints on settings that exclude each other.
fn settings() -> Vec<Row> {
    vec![
        row(
            PLANAR,
            &[("step = 1e-3", "step = 1.0")],
            ["the step of 1 s is longer than the run of 0.02 s", "write a step of 0.02 s at most"],
            &[("step = 1.0", "step = 0.01")],
        ),
        row(
            PLANAR,
            &[("step = 1e-3", "step = 1e-300")],
            ["is too short for a run", "write a longer step"],
            &[("1e-300", "1e-3")],
        ),
        row(
            PLANAR,
            &[("step = 1e-3", "step = 1e-3\nintegrator = \"radau5\"\nformulation = \"index-3\"")],
            ["has no `integrator radau5`", "need formulation `recursive`"],
            &[("index-3", "recursive")],
        ),
        row(
            PLANAR,
            &[("step = 1e-3", "step = 1e-3\nenergy_tolerance = [1e-7, 1e-5]")],
            ["not above its lower limit", "write the upper limit first"],
            &[("[1e-7, 1e-5]", "[1e-5, 1e-7]")],
        ),
        row(
            GUIDED,
            &[("duration = 0.3", "duration = 1.0")],
            ["ends at 0.5 s, within the run", "add `ends = \"level\"` beside `table`"],
            &[("[0.5, 0.3]]", "[0.5, 0.3]]\nends = \"level\"")],
        ),
        row(
            GUIDED,
            &[("[[0.0, 0.0], [0.25", "[[0.1, 0.0], [0.25")],
            ["begins at 0.1 s, within the run", "add `ends = \"level\"` beside `table`"],
            &[("[0.5, 0.3]]", "[0.5, 0.3]]\nends = \"level\"")],
        ),
    ]
}

/// Hints on runs that do not begin, or that stop.
fn stops() -> Vec<Row> {
    vec![
        row(
            LOCKING,
            &[("duration = 0.15", "duration = 3.0")],
            ["", "locks or cannot follow its guides: end the run or the guide before"],
            &[("duration = 3.0", "duration = 0.15")],
        ),
        row(
            PLANAR,
            &[("duration = 0.02", "duration = 5.0"), ("step = 1e-3", "step = 0.3")],
            ["the energy is off by", "try a smaller step"],
            &[("step = 0.3", "step = 0.02")],
        ),
        row(
            PLANAR,
            &[("duration = 0.02", "duration = 5.0"), ("step = 1e-3", "step = 0.3")],
            ["the energy is off by", "formulation recursive with integrator radau5"],
            &[("step = 0.3", "step = 0.3\nformulation = \"recursive\"\nintegrator = \"radau5\"")],
        ),
        row(
            LOCKING,
            &[("[[guide]]", "[[initial]]\njoint = \"d\"\nvalue = 2.9\n[[guide]]")],
            ["the mechanism cannot be closed at the start", "or hold fewer values"],
            &[("[[initial]]\njoint = \"d\"\nvalue = 2.9\n", "")],
        ),
        row(
            LOCKING,
            &[("[[guide]]", "[[initial]]\njoint = \"d\"\nrate = 20.0\n[[guide]]")],
            ["the initial velocities contradict the joints", "hold fewer velocities"],
            &[("[[initial]]\njoint = \"d\"\nrate = 20.0\n", "")],
        ),
    ]
}
