//! Signals: they are read to the intended data and written back. Invalid signals are refused at their place.

use super::{refused, spoil};
use mbs_core::scene::*;
use mbs_scene::SceneFile;
use mbs_scene::to_toml;

const SCENE: &str = r#"[scene]
dimension = 2
duration = 4
[[body]]
name = "arm"
mass = 2
center = [1, 0]
inertia = 0.1
[[body]]
name = "cart"
mass = 2
center = [0, 1]
inertia = 0.1
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0, 0]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "cart"]
axis = [1, 0]
at = [0, 1]
[[guide]]
joint = "pivot"
signal = "target"
[[coupling]]
name = "drive"
kind = "linear"
terms = [{ joint = "slide" }]
signal = "both"
[[signal]]
name = "target"
kind = "step"
to = 1.0
at = 0.5
rise = 0.1
[[signal]]
name = "both"
kind = "sum"
of = ["target", "wave"]
factors = [1, -0.5]
[[signal]]
name = "wave"
kind = "sine"
amplitude = 0.1
frequency = 2
offset = 0.3
[[signal]]
name = "held"
kind = "table"
table = [[0, 0], [1, 2], [3, 0]]
interpolation = "hold"
periodic = true
[[signal]]
name = "level"
kind = "table"
table = [[0, 0], [1, 2]]
ends = "level"
[[signal]]
name = "straight"
kind = "table"
table = [[0, 0], [1, 2]]
interpolation = "linear"
[[signal]]
name = "sweep"
kind = "chirp"
amplitude = 1
frequency = 1
to_frequency = 5
duration = 2
[[signal]]
name = "rising"
kind = "ramp"
rate = 2
end = 1.5
[[signal]]
name = "load"
kind = "input"
value = 3
unit = "N"
[[signal]]
name = "gain"
kind = "constant"
value = 2.5
[[signal]]
name = "power"
kind = "product"
of = ["load", "gain", "rising"]
[[signal]]
name = "stop"
kind = "clamp"
of = "power"
lower = -4
upper = 4
[[signal]]
name = "shape"
kind = "curve"
of = "wave"
coefficients = [0, 1, 2]
[[signal]]
name = "cam"
kind = "curve"
of = "wave"
table = [[0, 0], [1, 1], [2, 0]]
periodic = true
[[signal]]
name = "turn"
kind = "measure"
joint = "slide"
[[signal]]
name = "reach"
kind = "measure"
points = [{ body = "arm", at = [1, 0] }, { body = "cart", at = [0, 1] }]
quantity = "rate"
[[signal]]
name = "late"
kind = "lag"
of = "reach"
time = 0.1
value = 0.2
[[signal]]
name = "summed"
kind = "integral"
of = "late"
upper = 3
[[signal]]
name = "asked"
kind = "pid"
target = "summed"
measured = "turn"
p = 2
i = 3
limit = 10
[[effect]]
kind = "force"
body = "arm"
at = [1, 0]
signal = ["stop", "held"]
[[effect]]
kind = "torque"
body = "cart"
signal = "sweep"
[[effect]]
kind = "actuator"
bodies = ["arm", "cart"]
points = [[1, 0], [0, 1]]
signal = "power"
"#;

fn numbers(text: &str) -> Scene<Number> {
    SceneFile::parse(text, "test.toml").and_then(|f| f.numbers()).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn every_kind_of_signal_reads_back_as_it_was_written() {
    let scene = numbers(SCENE);
    scene.resolve::<f64>().expect("a scene that can be meant");
    let text = to_toml(&scene).expect("no code in it");
    assert_eq!(numbers(&text), scene, "{text}");
    let signal = |i| Some(SignalId::new(i));
    assert_eq!(scene.guides[0].law, Motion::Signal(SignalId::new(0)));
    assert_eq!(scene.couplings[0].motion, Some(Motion::Signal(SignalId::new(1))));
    let EffectKind::Force(force) = &scene.effects[0].kind else { panic!("a force") };
    assert_eq!(force.course, Signal::Named([signal(11), signal(3), None]));
    let EffectKind::Actuator(actuator) = &scene.effects[2].kind else { panic!("an actuator") };
    assert_eq!(actuator.course, Signal::Named([signal(10), None, None]));
    let SignalKind::Input { unit, .. } = &scene.signals[8].kind else { panic!("an input") };
    assert_eq!(unit, "N");
}

#[test]
fn signals_that_cannot_be_meant_are_refused_at_their_place() {
    let spoiled = |from: &str, to: &str| spoil(SCENE, from, to);
    let jump = spoiled("rise = 0.1", "rise = 0.0");
    refused(&jump, "27:10", "`target` jumps at 0.5 s", "give it `rise`");
    let of_sum = spoiled("of = [\"target\", \"wave\"]", "of = [\"rising\", \"wave\"]");
    refused(&of_sum, "32:10", "`rising` has a corner at 1.5 s", "give it `rounding`");
    let clamp = spoiled("signal = \"both\"", "signal = \"stop\"");
    refused(&clamp, "32:10", "`load` jumps", "give `input` in place of `signal`");
    let unknown = spoiled("signal = \"target\"", "signal = \"tarqet\"");
    refused(&unknown, "27:10", "unknown signal `tarqet`", "did you mean `target`?");
    let circle = spoiled("of = [\"load\", \"gain\", \"rising\"]", "of = [\"load\", \"stop\"]");
    refused(&circle, "90:6", "`power` needs `stop` needs `power`", "take one of its operands out");
    let count = spoiled("signal = [\"stop\", \"held\"]", "signal = \"stop\"");
    refused(&count, "140:10", "`signal` needs 2 numbers, but has 1", "as many");
    let both = spoiled("signal = \"sweep\"", "signal = \"sweep\"\nvalue = 2");
    let of_both = "both `value` and `signal` are given";
    refused(&both, "144:10", of_both, "keep one of the two");
    let factors = spoiled("factors = [1, -0.5]", "factors = [1]");
    refused(&factors, "43:11", "`factors` needs 2 numbers, but has 1", "as many");
    let ends = spoiled("table = [[0, 0], [1, 2], [3, 0]]", "table = [[0, 0], [3, 1]]");
    refused(&ends, "53:9", "`table` begins with 0 and ends with 1, but is periodic", "end the");
    let kind = spoiled("kind = \"chirp\"", "kind = \"chrip\"");
    refused(&kind, "68:8", "unknown kind `chrip`", "did you mean `chirp`?");
    let name = spoiled("name = \"gain\"", "name = \"load\"");
    refused(&name, "84:8", "this name is already that of signal 9", "its own name");
    let limits = spoiled("lower = -4", "lower = 4");
    refused(&limits, "95:9", "`lower` is 4, which is not below the upper end 4", "below");
    let key = spoiled("end = 1.5", "stop = 1.5");
    refused(&key, "77:1", "unknown key `stop`", "keys");
}

#[test]
fn a_spline_that_a_guide_follows_may_not_end_on_a_slope_within_the_run() {
    let text = SCENE.replacen("signal = \"target\"", "signal = \"straight\"", 1);
    let text = text.replacen("interpolation = \"linear\"\n", "", 1);
    let file = SceneFile::parse(&text, "test.toml").expect("TOML");
    let scene = file.scene::<f64>().expect("smooth within its rows");
    assert!(scene.check_run(1.0).is_ok(), "the run ends with the table");
    let error = file.meaning(scene.check_run(4.0).expect_err("the table ends at 1 s"));
    assert!(error.to_string().starts_with("test.toml:64:18: `table` ends at 1 s"), "{error}");
}
