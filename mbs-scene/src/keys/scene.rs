//! `[scene]`, `[solver]`, and the file itself.

use super::table::{Key, KeyTable, inside, may, need, once};
use super::value::KeyValue;
use super::value::KeyValue::{Flag, Number, Numbers, Text, Vector, Word};

/// The header of the file itself, whose keys are the tables.
pub(crate) const FILE: &str = "scene file";

pub(super) fn tables() -> Vec<KeyTable> {
    let listed = |name, meaning| may(name, KeyValue::Tables(name), "", "none", meaning);
    let file = inside(
        FILE,
        "The tables of a scene file.",
        vec![
            need("scene", KeyValue::Table("scene"), "", "The scene as a whole."),
            listed("include", "Parts of other files."),
            listed("point", "Places by name."),
            listed("body", "Bodies."),
            listed("joint", "Joints between two bodies."),
            listed("initial", "Values and rates at the start."),
            listed("guide", "Prescribed motions."),
            listed("coupling", "Gears, racks, screws, belts, cams and ropes."),
            listed("rolling", "What rolls without slipping, and blades."),
            listed("signal", "Numbers over time, by name."),
            listed("frame", "Named places on bodies."),
            listed("shape", "Forms for pictures."),
            listed("effect", "Springs, dampers, forces, tires, friction and stops."),
            may("road", KeyValue::Table("road"), "", "level, at height 0", "The road under tires."),
            may(
                "parameters",
                KeyValue::Parameters,
                "",
                "none",
                "Numbers by name, for expressions.",
            ),
            may("solver", KeyValue::Table("solver"), "", "all defaults", "Method and steps."),
            listed("output", "Channels of the results; without one, each joint's coordinates."),
        ],
    );
    let parameters = "Numbers by name: each is a number, or an expression of others. A text stands wherever a number does.";
    vec![
        file,
        once("scene", "The scene as a whole.", keys()),
        once("parameters", parameters, Vec::new()),
    ]
}

fn keys() -> Vec<Key> {
    vec![
        may("name", Text, "", "the file's name", "Name of the scene in results."),
        need("dimension", Word(vec!["2", "3"]), "", "2: planar, x and y. 3: spatial."),
        may("gravity", Vector, "m/s^2", "no gravity", "Gravity, a vector."),
        need("duration", Number, "s", "End of the run."),
        may(
            "start",
            Word(vec!["initial", "equilibrium", "equilibrium-near"]),
            "",
            "initial",
            "Start from the initial conditions, from a static equilibrium, or from the one next to the reference configuration.",
        ),
        may(
            "outputs",
            Word(vec!["all"]),
            "",
            "those of `[[output]]`",
            "`all` adds values, rates and reactions of all joints, and forces of all effects.",
        ),
    ]
}

/// Formulations, as the solver's table and the command line name them.
const FORMULATIONS: [&str; 7] =
    ["auto", "index-1", "index-3", "multi-index", "classical", "state-space", "recursive"];

/// Integrators, as the solver's table and the command line name them.
const INTEGRATORS: [&str; 9] =
    ["trapezoidal", "newmark", "generalised-alpha", "hht", "rk4", "rk54", "rk853", "gbs", "radau5"];

/// Controls of the step, as the solver's table and the command line name them; the last is another name of the third.
const STEP_CONTROLS: [&str; 6] =
    ["fixed", "energy", "energy-printed", "error", "both", "energy-published"];

/// Keys of the table `[solver]`.
pub(super) fn solver() -> Vec<KeyTable> {
    let keys = [methods(), steps()].concat();
    vec![once("solver", "Method and steps. The command line overrides each key.", keys)]
}

fn methods() -> Vec<Key> {
    let [formulations, integrators] = [Word(FORMULATIONS.to_vec()), Word(INTEGRATORS.to_vec())];
    let newton = "Newton tolerance, relative to the displacement per step.";
    let penalty = "Penalty factor of the augmented Lagrangian.";
    let alarm =
        "A run stops where the energy balance is off by this ratio of the energy that moves.";
    vec![
        may("formulation", formulations, "", "auto", "Formulation."),
        may("integrator", integrators, "", "trapezoidal", "Integrator."),
        may("tolerance", Number, "", "1e-10", newton),
        may("penalty", Number, "N/m; index-1: kg", "by the masses and the step", penalty),
        may("energy_alarm", Number, "", "0.1", alarm),
    ]
}

fn steps() -> Vec<Key> {
    let control =
        "What chooses the step: nothing, the energy balance, an estimate of the error, or both.";
    let by = "`error` beside `error_tolerance`, else `fixed`";
    let energy = "Bounds [U, L] of the change of the energy balance in a step, relative to the energy that moves.";
    let error = "Error of a step by its estimate, relative to the scene's length.";
    let events = "Whether steps end where contacts begin and end.";
    vec![
        may("step", Number, "s", "1e-3", "Step; of variable steps the first one."),
        may("step_max", Number, "s", "`step`", "Largest step of variable steps."),
        may("step_control", Word(STEP_CONTROLS.to_vec()), "", by, control),
        may("energy_tolerance", Numbers(2), "", "[1e-5, 1e-7]", energy),
        may("error_tolerance", Number, "", "1e-6", error),
        may("locate_events", Flag, "", "`true` for variable steps", events),
    ]
}
