//! Effects: every kind is read to the intended data, and an invalid one is refused at its place.

use super::{read, refused, spoil};
use mbs_core::scene::*;

/// A cart on a prismatic joint in the plane.
pub(super) const CART: &str = r#"[scene]
dimension = 2
duration = 1
start = "equilibrium"
[[body]]
name = "cart"
mass = 2
center = [1, 0]
inertia = 0.1
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "cart"]
at = [1, 0]
axis = [1, 0]
[[effect]]
kind = "limit"
joint = "slide"
lower = -0.2
upper = 0.3
stiffness = 1e5
[[effect]]
kind = "friction"
joint = "slide"
coulomb = 2
[[effect]]
kind = "friction"
joint = "slide"
coulomb = 2
static = 3
stribeck = 0.1
viscous = 0.5
regularisation = 0.01
[[effect]]
kind = "actuator"
bodies = ["ground", "cart"]
points = [[0, 0], [1, 0]]
table = [[0, 0], [1, 50]]
[[effect]]
kind = "bushing"
bodies = ["ground", "cart"]
at = [1, 0]
stiffness = [1e4, 2e4, 30]
damping = [1, 2, 3]
[[effect]]
kind = "tire"
body = "cart"
center = [1, 0]
radius = 0.4
stiffness = 2e5
rolling_resistance = 0.01
"#;

/// A car of one body in space.
pub(super) const CAR: &str = r#"[scene]
dimension = 3
duration = 1
[[body]]
name = "car"
mass = 1000
center = [0, 0, 0.6]
inertia = [130, 1620, 1670, 0, 0, 0]
[[effect]]
kind = "bumper"
bodies = ["ground", "car"]
points = [[0, 0, 0], [0, 0, 0.6]]
stiffness = 1e7
clearance = 0.07
[[effect]]
kind = "polynomial-spring"
bodies = ["car", "ground"]
points = [[0, 0, 0.6], [0, 0, 0.6]]
direction = [0, 0, 2]
coefficients = [[0, 0.1, -5457.712, 35906]]
[[effect]]
kind = "polynomial-damper"
bodies = ["ground", "car"]
points = [[0, 0, 0], [0, 0, 0.6]]
coefficients = [
  [-2.0, -0.2, -416.42, 1844.3],
  [-0.20, 0.21, 0, 9945.627, 33955.72, -59832.25, -395651],
  [0.21, 2.0, 1919.1638, 1634.727],
]
[[effect]]
kind = "bushing"
bodies = ["ground", "car"]
at = [0, 0, 0.6]
stiffness = [1, 2, 3, 4, 5, 6]
[[effect]]
kind = "aero-drag"
body = "car"
at = [0, 0, 0.8]
area_coefficient = 1.1
[[effect]]
kind = "speed-hold"
body = "car"
direction = [1, 0, 0]
speed = 5
gain = 1e4
limit = 8e3
[[effect]]
kind = "tire"
body = "car"
center = [0.97, 0.615, 0.356]
axis = [0, 1, 0]
radius = 0.364325
stiffness = 460000
damping = 100
side = "calspan"
[[effect]]
kind = "tire"
body = "car"
center = [0.97, -0.615, 0.356]
axis = [0, 1, 0]
radius = 0.3638
stiffness = 460000
side = "calspan"
coefficients = { a = [1, 2, 3, 4, 5], omega = 0.9, b = [6, 7, 8], skid = 1.5, trail = [-9, 9] }
[road]
features = [
  { kind = "flat", height = -0.1 },
  { kind = "ramp", start = 10, length = 5, height = 1 },
  { kind = "stairs", start = 30, tread = 1.5, riser = 0.5, height = -0.125, count = 3 },
  { kind = "bump", start = 50, length = 1, amplitude = 0.05 },
  { kind = "bump", start = 60, length = 5, height = -0.2, shape = "cosine" },
  { kind = "table", points = [[70, 0], [75, 0.1], [80, 0]] },
]
speed = 5
"#;

fn kinds(text: &str) -> Vec<EffectKind<f64>> {
    read(text).expect("a scene").effects.into_iter().map(|effect| effect.kind).collect()
}

#[test]
fn effects_of_joints_have_their_defaults() {
    let scene = read(CART).unwrap();
    assert_eq!(scene.start, Start::Equilibrium);
    assert_eq!(scene.road, Road::default());
    let kinds = kinds(CART);
    let limit = EffectKind::Limit(Limit {
        joint: JointId::new(0),
        coordinate: None,
        range: false,
        lower: -0.2,
        upper: 0.3,
        stiffness: 1e5,
        damping: 0.0,
    });
    assert_eq!(kinds[0], limit);
    let friction = |numbers: [f64; 5]| {
        let [coulomb, r#static, stribeck, viscous, regularisation] = numbers;
        EffectKind::Friction(Friction {
            joint: JointId::new(0),
            coordinate: None,
            coulomb,
            r#static,
            stribeck,
            viscous,
            regularisation,
            factor: Signal::Constant([1.0, 0.0, 0.0]),
        })
    };
    assert_eq!(kinds[1], friction([2.0, 2.0, 0.01, 0.0, 1e-3]));
    assert_eq!(kinds[2], friction([2.0, 3.0, 0.1, 0.5, 0.01]));
}

#[test]
fn effects_in_the_plane_have_three_directions_and_no_axis() {
    let kinds = kinds(CART);
    let bodies = [BodyId::Ground, BodyId::Body(0)];
    let points = [[0.0; 3], [1.0, 0.0, 0.0]];
    let course = Signal::Table(vec![(0.0, [0.0; 3]), (1.0, [50.0, 0.0, 0.0])]);
    assert_eq!(kinds[3], EffectKind::Actuator(Actuator { bodies, points, course }));
    let bushing = EffectKind::Bushing(Bushing {
        bodies,
        at: [1.0, 0.0, 0.0],
        stiffness: [1e4, 2e4, 0.0, 0.0, 0.0, 30.0],
        damping: [1.0, 2.0, 0.0, 0.0, 0.0, 3.0],
    });
    assert_eq!(kinds[4], bushing);
    let tire = EffectKind::Tire(Tire {
        body: BodyId::Body(0),
        center: [1.0, 0.0, 0.0],
        axis: None,
        radius: 0.4,
        stiffness: 2e5,
        damping: 0.0,
        rolling_resistance: 0.01,
        side: None,
        spin: None,
        longitudinal: None,
    });
    assert_eq!(kinds[5], tire);
}

#[test]
fn effects_along_a_line_read_points_and_pieces() {
    let kinds = kinds(CAR);
    let bodies = [BodyId::Ground, BodyId::Body(0)];
    let points = [[0.0; 3], [0.0, 0.0, 0.6]];
    let bumper = EffectKind::Bumper(Bumper {
        bodies,
        points,
        stiffness: 1e7,
        damping: 0.0,
        clearance: 0.07,
    });
    assert_eq!(kinds[0], bumper);
    let piece = |lower, upper, coefficients: &[f64]| PolynomialPiece {
        lower,
        upper,
        coefficients: coefficients.to_vec(),
    };
    let spring = EffectKind::Polynomial(Polynomial {
        bodies: [bodies[1], bodies[0]],
        points: [points[1]; 2],
        direction: Some([0.0, 0.0, 2.0]),
        of_rate: false,
        pieces: vec![piece(0.0, 0.1, &[-5457.712, 35906.0])],
    });
    assert_eq!(kinds[1], spring);
    let damper = EffectKind::Polynomial(Polynomial {
        bodies,
        points,
        direction: None,
        of_rate: true,
        pieces: vec![
            piece(-2.0, -0.2, &[-416.42, 1844.3]),
            piece(-0.2, 0.21, &[0.0, 9945.627, 33955.72, -59832.25, -395_651.0]),
            piece(0.21, 2.0, &[1919.1638, 1634.727]),
        ],
    });
    assert_eq!(kinds[2], damper);
}

#[test]
fn effects_of_a_car_read_with_their_defaults() {
    let kinds = kinds(CAR);
    let EffectKind::Bushing(Bushing { stiffness, damping, .. }) = kinds[3] else { panic!() };
    assert_eq!((stiffness, damping), ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [0.0; 6]));
    let drag = EffectKind::AeroDrag(AeroDrag {
        body: BodyId::Body(0),
        at: [0.0, 0.0, 0.8],
        area_coefficient: 1.1,
        density: 1.2,
    });
    assert_eq!(kinds[4], drag);
    let hold = EffectKind::SpeedHold(SpeedHold {
        body: BodyId::Body(0),
        direction: [1.0, 0.0, 0.0],
        speed: 5.0,
        gain: 1e4,
        limit: 8e3,
    });
    assert_eq!(kinds[5], hold);
    let EffectKind::Tire(Tire { damping, axis, side, .. }) = &kinds[6] else { panic!() };
    let iltis = CalspanCoefficients::iltis();
    assert_eq!((*damping, *axis, *side), (100.0, Some([0.0, 1.0, 0.0]), Some(iltis)));
    let EffectKind::Tire(Tire { side, .. }) = &kinds[7] else { panic!() };
    let given = CalspanCoefficients {
        a: [1.0, 2.0, 3.0, 4.0, 5.0],
        omega: 0.9,
        b: [6.0, 7.0, 8.0],
        skid: 1.5,
        trail: [-9.0, 9.0],
    };
    assert_eq!(*side, Some(given));
}

#[test]
fn wrong_keys_of_effects_are_refused_with_the_right_ones() {
    let e = spoil(CART, "lower = -0.2", "lowr = -0.2");
    refused(&e, "19:1", "unknown key `lowr`", "did you mean `lower`?");
    let e = spoil(CART, "viscous = 0.5", "damping = 0.5");
    refused(&e, "32:1", "`damping` has no meaning here", "coulomb, static, stribeck, viscous");
    let e = spoil(CART, "kind = \"limit\"", "kind = \"limits\"");
    refused(&e, "17:8", "unknown kind `limits`", "did you mean `limit`?");
    let e = spoil(CART, "start = \"equilibrium\"", "start = \"rest\"");
    refused(&e, "4:9", "unknown start `rest`", "choices: initial, equilibrium");
    let e = spoil(CAR, "clearance = 0.07\n", "");
    refused(&e, "9:1", "`clearance` is missing", "add `clearance`");
    let e = spoil(CAR, "omega = 0.9, ", "");
    refused(&e, "64:16", "`omega` is missing", "add `omega`");
    let e = spoil(CAR, "skid = 1.5", "skit = 1.5");
    refused(&e, "64:67", "unknown key `skit`", "did you mean `skid`?");
    let e = spoil(CAR, "100\nside = \"calspan\"", "100\nside = \"magic\"");
    refused(&e, "55:8", "unknown side `magic`", "choices: none, calspan");
    let e = spoil(CAR, "side = \"calspan\"\ncoefficients", "coefficients");
    refused(&e, "56:1", "`side = \"calspan\"` is missing", "add");
    let e = spoil(CART, "table = [[0, 0], [1, 50]]", "table = [[0, 0], [1, 50]]\nvalue = 1");
    refused(&e, "38:9", "both `value` and `table` are given", "keep one");
}

/// A car with a wheel on a hub, and the tire under it.
const DRIVEN: &str = r#"[scene]
dimension = 3
duration = 1
[[body]]
name = "car"
mass = 1000
center = [0, 0, 0.6]
inertia = [130, 1620, 1670, 0, 0, 0]
[[body]]
name = "wheel"
mass = 20
center = [0, 0, 0.3]
inertia = [0.6, 1, 0.6, 0, 0, 0]
[[joint]]
name = "ride"
kind = "prismatic"
bodies = ["ground", "car"]
at = [0, 0, 0.6]
axis = [1, 0, 0]
[[joint]]
name = "hub"
kind = "revolute"
bodies = ["wheel", "car"]
at = [0, 0, 0.3]
axis = [0, 1, 0]
[[effect]]
kind = "tire"
body = "car"
center = [0, 0, 0.3]
radius = 0.32
stiffness = 2e5
spin = "hub"
longitudinal = { stiffness = 6e4, friction = 0.8 }
[[effect]]
kind = "friction"
joint = "hub"
coulomb = 900
signal = "pedal"
[[signal]]
name = "pedal"
kind = "constant"
value = 0.5
"#;

#[test]
fn a_driven_tire_has_its_joint_and_its_slip_and_a_brake_its_signal() {
    let kinds = kinds(DRIVEN);
    let EffectKind::Tire(Tire { axis, spin, longitudinal, .. }) = &kinds[0] else { panic!() };
    let slip = LongitudinalSlip { stiffness: 6e4, friction: 0.8 };
    assert_eq!((*axis, *spin, *longitudinal), (None, Some(JointId::new(1)), Some(slip)));
    let EffectKind::Friction(Friction { factor, .. }) = &kinds[1] else { panic!() };
    assert_eq!(*factor, Signal::from(SignalId::new(0)));
}

#[test]
fn a_wheel_that_cannot_spin_as_the_scene_says_is_refused_at_its_place() {
    let e = spoil(DRIVEN, "friction = 0.8", "frictoin = 0.8");
    refused(&e, "33:35", "unknown key `frictoin`", "did you mean `friction`?");
    let e = spoil(DRIVEN, "friction = 0.8 }", "friction = 0 }");
    refused(&e, "33:16", "`longitudinal` must be larger than zero, but is 0", "larger than zero");
    let e = spoil(DRIVEN, "longitudinal = {", "axis = [0, 0, 1]\nlongitudinal = {");
    refused(&e, "32:8", "`spin` turns about another axis than the tire's", "leave `axis` out");
    let e = spoil(DRIVEN, "spin = \"hub\"", "spin = \"ride\"");
    let words = "`spin` is a joint with 0 rotations; exactly one is needed";
    refused(&e, "32:8", words, "use a revolute");
    let e = spoil(DRIVEN, "spin = \"hub\"", "spin = \"hup\"");
    refused(&e, "32:8", "unknown joint `hup`", "did you mean `hub`?");
    let e = spoil(DRIVEN, "longitudinal = { stiffness = 6e4, friction = 0.8 }\n", "");
    refused(&e, "32:8", "`spin` has no meaning here", "remove it");
    let e = spoil(DRIVEN, "bodies = [\"wheel\", \"car\"]", "bodies = [\"wheel\", \"ground\"]");
    refused(&e, "32:8", "`spin` does not join the tire's body to a wheel", "turns on `body`");
    let e = spoil(DRIVEN, "spin = \"hub\"\n", "");
    refused(&e, "26:1", "`axis` is missing", "add");
}

/// A body on a cylindrical joint, in space.
const SHAFT: &str = r#"[scene]
dimension = 3
duration = 1
[[body]]
name = "a"
mass = 1
center = [0, 0, 0]
inertia = [1, 1, 1, 0, 0, 0]
[[joint]]
name = "j"
kind = "cylindrical"
bodies = ["ground", "a"]
at = [0, 0, 0]
axis = [0, 0, 1]
[[effect]]
kind = "limit"
joint = "j"
coordinate = "slide"
lower = -1
upper = 1
stiffness = 10
"#;

#[test]
fn effects_name_a_coordinate_of_a_joint_that_has_several() {
    let coordinate = |text: &str| match &kinds(text)[0] {
        EffectKind::Limit(Limit { coordinate, .. }) => *coordinate,
        EffectKind::TorsionSpring(TorsionSpring { coordinate, .. }) => *coordinate,
        kind => panic!("{kind:?}"),
    };
    let with = |to: &str| SHAFT.replace("coordinate = \"slide\"\n", to);
    assert_eq!(coordinate(SHAFT), Some(0));
    assert_eq!(coordinate(&with("coordinate = \"turn\"\n")), Some(1));
    assert_eq!(coordinate(&with("coordinate = 1\n")), Some(1));
    // The default of `coordinate` is the only rotation of the joint.
    let turn = with("").replace("\"limit\"", "\"torsion-spring\"");
    let turn = turn.replace("lower = -1\nupper = 1\n", "");
    assert_eq!(coordinate(&turn), None);

    let spoil = |to: &str| spoil(SHAFT, "coordinate = \"slide\"\n", to);
    let several = "`coordinate` is missing: the joint has `slide`, `turn`";
    refused(&spoil(""), "15:1", several, "write one of these names");
    let number = "`coordinate` is 2, but the joint has `slide`, `turn`";
    refused(&spoil("coordinate = 2\n"), "18:14", number, "write one of these names");
    let e = spoil("coordinate = \"slid\"\n");
    refused(&e, "18:14", "unknown coordinate `slid`", "did you mean `slide`?");
    let e = spoil("coordinate = \"first\"\n");
    refused(&e, "18:14", "unknown coordinate `first`", "choices: slide, turn");
    let e = spoil("coordinate = -1\n");
    refused(&e, "18:14", "expected a coordinate's name, or its number from 0, found a number", "");
    let ball = SHAFT.replace("\"cylindrical\"", "\"pin-in-slot\"");
    let ball = ball.replace("coordinate = \"slide\"", "coordinate = 2");
    let e = read(&ball).unwrap_err();
    refused(
        &e,
        "18:14",
        "`coordinate` is a component of a rotation, not an angle",
        "turns about axes",
    );
    let weld = SHAFT.replace("\"cylindrical\"", "\"weld\"").replace("axis = [0, 0, 1]\n", "");
    let e = read(&weld.replace("coordinate = \"slide\"", "coordinate = 0")).unwrap_err();
    refused(&e, "16:9", "`joint` is a joint without coordinates", "name another joint");
}

#[test]
fn wrong_numbers_of_effects_are_refused_at_the_number() {
    let e = spoil(CART, "lower = -0.2", "lower = 0.4");
    refused(&e, "19:9", "`lower` is 0.4, which is not below the upper end 0.3", "below");
    let e = spoil(CART, "static = 3", "static = 1");
    let message = "`static` is 1, which is less than the Coulomb friction 2";
    refused(&e, "30:10", message, "leave `static` out");
    let e = spoil(CART, "regularisation = 0.01", "regularisation = 0");
    let message = "`regularisation` must be larger than zero, but is 0";
    refused(&e, "33:18", message, "larger than zero");
    let e = spoil(CART, "[1e4, 2e4, 30]", "[1e4, 2e4, 0, 0, 0, 30]");
    refused(&e, "43:13", "expected 3 entries, found 6", "write 3");
    let e = spoil(CART, "[1, 2, 3]", "[1, -2, 3]");
    refused(&e, "44:11", "`damping` must not be negative, but is -2", "zero or more");
    let e = spoil(CART, "radius = 0.4", "radius = 0");
    refused(&e, "49:10", "`radius` must be larger than zero, but is 0", "larger than zero");
    let e = spoil(CART, "radius = 0.4", "radius = 0.4\nside = \"calspan\"");
    refused(&e, "50:8", "`side` needs a spatial scene", "dimension = 3");
    let e = spoil(CAR, "direction = [0, 0, 2]", "direction = [0, 0, 0.0]");
    refused(&e, "19:13", "`direction` has no direction: all components are zero", "not zero");
    let e = spoil(CAR, "[0.21, 2.0, 1919.1638", "[0.22, 2.0, 1919.1638");
    let message = "`coefficients` has a gap or an overlap before piece 3";
    refused(&e, "28:3", message, "begin each where the one before ends");
    let e = spoil(CAR, "[0, 0.1, -5457.712, 35906]", "[0.1, 0, -5457.712, 35906]");
    refused(&e, "20:17", "`coefficients` has no range in piece 1", "lower first");
    let e = spoil(CAR, "[0, 0.1, -5457.712, 35906]", "[0, 0.1]");
    refused(&e, "20:17", "`coefficients` has 0 coefficients in piece 1", "one to eight");
    let e = spoil(CAR, "[0, 0.1, -5457.712, 35906]", "[0]");
    refused(&e, "20:17", "expected 3 entries, found 1", "write 3");
    let e = spoil(CAR, "limit = 8e3", "limit = -8e3");
    refused(&e, "46:9", "`limit` must be larger than zero, but is -8000", "larger than zero");
    let e = spoil(CAR, "a = [1, 2, 3, 4, 5]", "a = [1, 2, 0, 4, 5]");
    let message = "`coefficients` needs A0, A2, omega, B3 and skid above zero, and A4 not zero";
    refused(&e, "64:16", message, "check the order");
    let e = spoil(CAR, "axis = [0, 1, 0]\nradius = 0.3638\n", "radius = 0.3638\n");
    refused(&e, "56:1", "`axis` is missing", "add it");
}
