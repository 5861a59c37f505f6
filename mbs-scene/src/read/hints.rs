//! Words of other programs and textbooks, each with the word of the scene format.
//!
//! A hint holds for certain places: its `among` is one of the words or keys that are allowed there.

/// A hint for unknown words, which replaces the suggestion of the nearest name.
#[derive(Debug)]
pub struct Hint {
    /// A word that is allowed wherever the hint holds.
    pub among: &'static str,
    /// Unknown words with this hint, in small letters and with hyphens.
    pub words: &'static [&'static str],
    /// Advice on what to write; when it is empty, the advice is `among`.
    hint: &'static str,
}

const fn means(among: &'static str, words: &'static [&'static str]) -> Hint {
    Hint { among, words, hint: "" }
}

const fn says(among: &'static str, words: &'static [&'static str], hint: &'static str) -> Hint {
    Hint { among, words, hint }
}

const DRIVES: &[&str] = &["motor", "drive", "servo", "engine", "rotary-motor", "linear-motor"];
const RATIOS: &[&str] = &[
    "gear",
    "gears",
    "gear-pair",
    "belt",
    "chain-drive",
    "pulley",
    "rack",
    "rack-and-pinion",
    "screw",
];

const COUPLES: &str = "that is a `[[coupling]]` of joints: `kind = \"gear\"`, \"belt\", \"rack\" or \"screw\", with the `joints` that it couples";

/// All hints; when several hold, the first is used.
pub const HINTS: &[Hint] = &[
    // kinds of joints
    says(
        "revolute",
        DRIVES,
        "a motor acts on a joint: add `[[guide]]` with its `joint` for a given motion, or `[[effect]]` with `kind = \"torque\"` and the \
         `joint` for a given moment",
    ),
    says("revolute", RATIOS, COUPLES),
    says(
        "revolute",
        &["spring", "damper", "spring-damper", "bushing", "bumper", "contact"],
        "that is an effect: `[[effect]]` with `kind = \"spring-damper\"`, \"bushing\" or \"bumper\"",
    ),
    means("revolute", &["hinge", "pin", "pivot", "rotary", "rotation", "rotational", "bearing"]),
    says(
        "spherical",
        &["ball", "ball-joint", "ball-and-socket", "socket", "sphere"],
        "did you mean `spherical`? In the plane it is a `revolute` joint",
    ),
    means(
        "prismatic",
        &["slider", "sliding", "slide", "translational", "translation", "linear", "rail"],
    ),
    means("weld", &["fixed", "rigid", "fix", "clamp", "lock", "glue"]),
    means("universal", &["cardan", "hooke", "hookes-joint", "u-joint"]),
    means("distance", &["rod", "link", "massless-link", "string"]),
    means("free", &["floating", "six-dof", "6dof", "none"]),
    // kinds of effects
    says(
        "torque",
        DRIVES,
        "a given moment is `kind = \"torque\"` with `joint` or `body`; a given motion is a `[[guide]]` with the `joint`",
    ),
    says("torque", RATIOS, COUPLES),
    says(
        "torque",
        &["gravity", "weight"],
        "gravity is a key of [scene]: `gravity = [0.0, -9.81]`, with three numbers in space",
    ),
    says(
        "torque",
        &["contact", "collision"],
        "two points that meet are `kind = \"bumper\"`, the end of a joint's way is `kind = \"limit\"`; bodies have no surfaces yet",
    ),
    means("torque", &["moment", "couple"]),
    means(
        "spring-damper",
        &["spring", "damper", "shock", "shock-absorber", "strut", "linear-spring", "dashpot"],
    ),
    means(
        "torsion-spring",
        &[
            "torsional-spring",
            "rotational-spring",
            "spiral-spring",
            "rotary-spring",
            "torsion-damper",
            "rotational-damper",
        ],
    ),
    means("limit", &["stop", "end-stop", "endstop", "joint-limit"]),
    means("aero-drag", &["drag", "air", "wind", "air-resistance"]),
    means("tire", &["tyre", "wheel"]),
    says(
        "torque",
        &["ball-spring", "spherical-spring"],
        "a spring of a ball joint is `kind = \"bushing\"` at its place, with `stiffness = [0, 0, 0, k, k, k]`",
    ),
    means("force", &["load", "point-force", "thrust"]),
    means("actuator", &["cylinder", "hydraulic-cylinder", "ram"]),
    // kinds of couplings
    means("differential", &["planetary", "planetary-gear", "planetary-set", "epicyclic"]),
    means("belt", &["chain", "chain-drive", "pulley", "timing-belt"]),
    means("rope", &["cable", "tendon", "string", "winch", "hoist"]),
    means("rack", &["rack-and-pinion"]),
    means("screw", &["lead-screw", "ball-screw", "spindle"]),
    // bodies
    means(
        "ground",
        &[
            "world",
            "base",
            "earth",
            "frame",
            "fixed",
            "fixed-frame",
            "wall",
            "origin",
            "environment",
        ],
    ),
    // quantities
    says(
        "effort",
        &["torque", "moment", "motor-torque", "motor-moment", "drive-torque"],
        "the moment or force of a joint's motor is `effort`; `reaction` is all that the joint carries",
    ),
    means("reaction", &["force", "torque", "moment", "load", "reactions", "forces"]),
    means("value", &["angle", "position", "displacement", "coordinate", "travel"]),
    means("rate", &["speed", "velocity", "angular-velocity", "omega"]),
    means("position", &["place", "displacement", "value", "coordinates"]),
    means("velocity", &["speed", "rate"]),
    // tables
    says(
        "scene",
        &["gravity"],
        "gravity is a key of [scene]: `gravity = [0.0, -9.81]`, with three numbers in space",
    ),
    says(
        "scene",
        &["world", "ground", "earth", "fixed-frame"],
        "the fixed world is always there: name it `\"ground\"` wherever a body stands",
    ),
    says(
        "effect",
        &["motor", "drive", "servo", "engine", "motors"],
        "a motor is a `[[guide]]` with its `joint` for a given motion, or an `[[effect]]` with `kind = \"torque\"` and the `joint` for a \
         given moment",
    ),
    says(
        "effect",
        &[
            "spring", "damper", "force", "torque", "actuator", "friction", "tire", "bushing",
            "springs", "forces",
        ],
        "add `[[effect]]` with a `kind`, such as \"spring-damper\", \"force\", \"torque\" or \"friction\"",
    ),
    says(
        "joint",
        &["gear", "gears", "belt", "screw", "rack", "cam", "rope", "couplings"],
        "add `[[coupling]]` with a `kind`, such as \"gear\", \"belt\", \"rack\", \"screw\", \"cam\" or \"rope\"",
    ),
    means("joint", &["hinge", "constraint", "constraints", "connection", "weld", "revolute"]),
    means("body", &["link", "part", "rod", "mass", "rigid-body"]),
    means("output", &["sensor", "measure", "measurement", "probe", "result", "results", "channel"]),
    means("solver", &["simulation", "settings", "options", "integrator"]),
    means("initial", &["start", "state", "initial-condition", "initial-conditions"]),
    // keys
    says(
        "signals",
        &["speed", "rate", "velocity", "angular-velocity", "omega", "rpm"],
        "a constant speed is `ramp = { rate = 10.0 }`, in rad/s or m/s; `\"60 rpm\"` is a rate too",
    ),
    means("stiffness", &["k", "spring-constant", "spring-rate", "rate"]),
    means("damping", &["c", "d", "damping-coefficient", "damper"]),
    means("free_length", &["l0", "length", "rest-length", "natural-length", "unstretched-length"]),
    means("at", &["pos", "position", "point", "place", "location", "origin", "anchor"]),
    means("center", &["com", "cog", "cg", "center-of-mass", "centre-of-mass"]),
    means("inertia", &["moment-of-inertia", "i", "izz", "inertia-tensor"]),
    says(
        "bodies",
        &[
            "body1", "body2", "body-1", "body-2", "parent", "child", "from", "to", "body-a",
            "body-b",
        ],
        "write both in one list: `bodies = [\"ground\", \"...\"]`; the second moves against the first",
    ),
    means("duration", &["time", "t-end", "tend", "end-time", "stop-time", "simulation-time"]),
    // integrators and formulations
    means("rk54", &["rk45", "dopri5", "dopri", "ode45"]),
    means("rk853", &["rk8", "dop853", "dopri8"]),
    means("radau5", &["radau", "radau-iia", "bdf", "ode15s"]),
    means("gbs", &["bulirsch-stoer", "odex", "extrapolation"]),
    means("trapezoidal", &["trapezoid", "implicit", "crank-nicolson"]),
    means("hht", &["hht-alpha"]),
    means("recursive", &["relative", "articulated", "featherstone", "joint-coordinates"]),
    means("index-3", &["index3", "augmented", "natural"]),
];

/// The hint for a word that is not among the allowed ones, if there is a hint for it.
pub fn of_word<S: AsRef<str>>(found: &str, known: &[S]) -> Option<String> {
    let word = found.trim().to_lowercase().replace(['_', ' '], "-");
    let is_known = |among: &str| known.iter().any(|name| name.as_ref() == among);
    let hint =
        HINTS.iter().find(|hint| hint.words.contains(&word.as_str()) && is_known(hint.among))?;
    if hint.hint.is_empty() {
        return Some(format!("did you mean `{}`?", hint.among));
    }
    Some(hint.hint.to_owned())
}
