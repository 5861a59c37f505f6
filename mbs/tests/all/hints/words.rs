//! Hints on words of other programs and textbooks.

use super::Row;
use super::row;
use super::scenes::{GUIDED, PLANAR, SPATIAL};

/// Hints on words of other programs.
#[allow(clippy::too_many_lines, reason = "a table")]
pub(super) fn rows() -> Vec<Row> {
    const KIND: &str = "name = \"elbow\"\nkind = \"revolute\"";
    const HINGE: &str = "did you mean `revolute`?";
    vec![
        row(
            PLANAR,
            &[(KIND, "name = \"elbow\"\nkind = \"hinge\"")],
            ["`hinge`", HINGE],
            &[("hinge", "revolute")],
        ),
        row(
            PLANAR,
            &[(KIND, "name = \"elbow\"\nkind = \"pin\"")],
            ["`pin`", HINGE],
            &[("kind = \"pin\"", "kind = \"revolute\"")],
        ),
        row(
            PLANAR,
            &[(KIND, "name = \"elbow\"\nkind = \"revolut\"")],
            ["`revolut`", HINGE],
            &[("revolut\"", "revolute\"")],
        ),
        row(
            SPATIAL,
            &[("\"weld\"", "\"ball\"")],
            ["`ball`", "`spherical`"],
            &[("ball", "spherical")],
        ),
        row(SPATIAL, &[("\"weld\"", "\"fixed\"")], ["`fixed`", "`weld`"], &[("fixed", "weld")]),
        row(
            GUIDED,
            &[("\"prismatic\"", "\"slider\"")],
            ["`slider`", "`prismatic`"],
            &[("slider", "prismatic")],
        ),
        row(
            PLANAR,
            &[("[\"ground\", \"crank\"]", "[\"world\", \"crank\"]")],
            ["`world`", "`ground`"],
            &[("world", "ground")],
        ),
        row(
            PLANAR,
            &[("[\"ground\", \"crank\"]", "[\"base\", \"crank\"]")],
            ["`base`", "`ground`"],
            &[("base", "ground")],
        ),
        row(
            PLANAR,
            &[(KIND, "name = \"elbow\"\nkind = \"motor\"")],
            ["`motor`", "add `[[guide]]` with its `joint`"],
            &[
                ("\"motor\"", "\"revolute\""),
                (
                    "[[initial]]\njoint = \"elbow\"\nrate = 0.5",
                    "[[guide]]\njoint = \"elbow\"\nramp = { rate = 1.0 }",
                ),
            ],
        ),
        row(
            PLANAR,
            &[("kind = \"torque\"", "kind = \"motor\"")],
            ["`motor`", "`kind = \"torque\"` with `joint`"],
            &[("\"motor\"", "\"torque\"")],
        ),
        row(
            PLANAR,
            &[(
                "[[effect]]\nname = \"load\"\nkind = \"torque\"\njoint = \"pin\"\ntable = [[0.0, 0.0], [1.0, 2.0]]",
                "[[motor]]\njoint = \"pin\"\nspeed = 1.0",
            )],
            ["unknown key `motor`", "a motor is a `[[guide]]` with its `joint`"],
            &[(
                "[[motor]]\njoint = \"pin\"\nspeed = 1.0",
                "[[guide]]\njoint = \"pin\"\nramp = { rate = 1.0 }",
            )],
        ),
        row(
            PLANAR,
            &[(KIND, "name = \"elbow\"\nkind = \"gear\"")],
            ["`gear`", "that is a `[[coupling]]` of joints: `kind = \"gear\"`"],
            &[
                ("\"gear\"", "\"revolute\""),
                (
                    "[[initial]]\njoint = \"elbow\"\nrate = 0.5",
                    "[[coupling]]\nkind = \"gear\"\njoints = [\"pin\", \"elbow\"]\nteeth = [3, 1]",
                ),
            ],
        ),
        row(
            PLANAR,
            &[("kind = \"torque\"\njoint = \"pin\"", "kind = \"belt\"\njoint = \"pin\"")],
            ["`belt`", "that is a `[[coupling]]` of joints: `kind = \"gear\"`, \"belt\""],
            &[
                ("kind = \"belt\"", "kind = \"torque\""),
                (
                    "[[initial]]\njoint = \"elbow\"\nrate = 0.5",
                    "[[coupling]]\nkind = \"belt\"\njoints = [\"pin\", \"elbow\"]\nradii = [0.2, 0.1]",
                ),
            ],
        ),
        row(
            PLANAR,
            &[("\"spring-damper\"", "\"spring\"")],
            ["`spring`", "`spring-damper`"],
            &[("kind = \"spring\"", "kind = \"spring-damper\"")],
        ),
        row(
            PLANAR,
            &[("stiffness = 100.0", "k = 100.0")],
            ["`k`", "`stiffness`"],
            &[("k = 100.0", "stiffness = 100.0")],
        ),
        row(
            PLANAR,
            &[("free_length = 0.8", "l0 = 0.8")],
            ["`l0`", "`free_length`"],
            &[("l0", "free_length")],
        ),
        row(
            PLANAR,
            &[("at = [1.0, 0.0]", "pos = [1.0, 0.0]")],
            ["`pos`", "`at`"],
            &[("pos = ", "at = ")],
        ),
        row(PLANAR, &[("center = ", "com = ")], ["`com`", "`center`"], &[("com = ", "center = ")]),
        row(
            PLANAR,
            &[("duration = ", "t_end = ")],
            ["`t_end`", "`duration`"],
            &[("t_end", "duration")],
        ),
        row(
            PLANAR,
            &[("[[output]]", "[[sensor]]")],
            ["`sensor`", "`output`"],
            &[("sensor", "output")],
        ),
        row(
            PLANAR,
            &[("[[joint]]\nname = \"elbow\"", "[[joint]]\nnam = \"elbow\"")],
            ["`nam`", "`name`"],
            &[("nam =", "name =")],
        ),
        row(
            SPATIAL,
            &[("quantity = \"value\"", "quantity = \"force\"")],
            ["`force`", "`reaction`"],
            &[("\"force\"", "\"reaction\"")],
        ),
        row(
            SPATIAL,
            &[("quantity = \"value\"", "quantity = \"angle\"")],
            ["`angle`", "`value`"],
            &[("\"angle\"", "\"value\"")],
        ),
        row(
            PLANAR,
            &[("bodies = [\"crank\", \"arm\"]", "parent = \"crank\"\nchild = \"arm\"")],
            ["`parent`", "write both in one list"],
            &[("parent = \"crank\"\nchild = \"arm\"", "bodies = [\"crank\", \"arm\"]")],
        ),
        row(
            GUIDED,
            &[("[0.5, 0.3]]", "[0.5, 0.3]]\nends = \"flat\"")],
            ["unknown ends", "natural, level"],
            &[("flat", "level")],
        ),
        row(
            PLANAR,
            &[("[solver]", "[solver]\nintegrator = \"rk45\"\n")],
            ["unknown integrator `rk45`", "did you mean `rk54`?"],
            &[("rk45", "rk54")],
        ),
    ]
}
