//! A mechanism with one effect of each kind: an arm on a hinge, a slider on the arm, and two free bodies.

use crate::scene;
use mbs_core::effects::{EFFECTS, Places, Row};
use mbs_core::scene::{
    Actuator, AeroDrag, BodyId, Bumper, Bushing, CalspanCoefficients, Dimension, Effect,
    EffectKind, Friction, JointId, Limit, LineSpring, LongitudinalSlip, Polynomial,
    PolynomialPiece, RoadFeature, Scene, Signal, SpeedHold, Tire,
};

const SPATIAL: &str = r#"
[scene]
name = "effects"
dimension = 3
gravity = [0.0, 0.0, -9.81]
duration = 1.0
[[body]]
name = "arm"
mass = 2.0
center = [0.5, 0.2, 0.8]
inertia = [0.3, 0.35, 0.4, 0.02, 0.01, -0.02]
[[body]]
name = "slider"
mass = 1.5
center = [0.9, 0.1, 1.0]
inertia = [0.2, 0.25, 0.3, 0.01, 0.02, 0.01]
[[body]]
name = "left"
mass = 2.5
center = [0.1, -0.3, 0.9]
inertia = [0.4, 0.5, 0.45, 0.03, 0.0, 0.02]
[[body]]
name = "right"
mass = 1.8
center = [1.2, 0.6, 1.4]
inertia = [0.3, 0.4, 0.35, 0.0, 0.01, 0.0]
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.1, 0.1, 0.7]
axis = [0.2, 1.0, 0.3]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["arm", "slider"]
at = [0.7, 0.1, 0.9]
axis = [1.0, 0.2, -0.3]
"#;

const PLANAR: &str = r#"
[scene]
name = "effects"
dimension = 2
gravity = [0.0, -9.81]
duration = 1.0
[[body]]
name = "arm"
mass = 2.0
center = [0.5, 0.8]
inertia = 0.3
[[body]]
name = "slider"
mass = 1.5
center = [0.9, 1.0]
inertia = 0.2
[[body]]
name = "left"
mass = 2.5
center = [0.1, 0.9]
inertia = 0.4
[[body]]
name = "right"
mass = 1.8
center = [1.2, 1.4]
inertia = 0.3
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.1, 0.7]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["arm", "slider"]
at = [0.7, 0.9]
axis = [1.0, 0.2]
"#;

const BODIES: [BodyId; 2] = [BodyId::Body(2), BodyId::Body(3)];

/// Creates the mechanism without effects. The road below it rises and moves towards it.
fn bare(dimension: Dimension) -> Scene<f64> {
    let mut scene = scene(if dimension == Dimension::Planar { PLANAR } else { SPATIAL });
    let rise = RoadFeature::Rise { start: -3.0, length: 6.0, height: 1.0, rounding: 1.0 };
    let bump = RoadFeature::Bump { start: -2.0, length: 8.0, amplitude: 0.05 };
    scene.road.left = vec![rise];
    scene.road.right = vec![scene.road.left[0].clone(), bump];
    scene.road.speed = 0.7;
    scene
}

/// Creates the mechanism with one effect.
#[must_use]
pub fn with(dimension: Dimension, kind: EffectKind<f64>) -> Scene<f64> {
    let mut scene = bare(dimension);
    scene.effects.push(Effect { name: "effect".into(), enabled: true, kind });
    scene
}

/// Returns a point in space; in a plane its depth is zero.
fn place(dimension: Dimension, [x, y, z]: [f64; 3]) -> [f64; 3] {
    if dimension == Dimension::Planar { [x, z, 0.0] } else { [x, y, z] }
}

/// Returns two points on the free bodies.
fn points(dimension: Dimension) -> [[f64; 3]; 2] {
    [[0.2, -0.1, 1.0], [1.0, 0.5, 1.3]].map(|x| place(dimension, x))
}

fn piece(lower: f64, upper: f64, coefficients: &[f64]) -> PolynomialPiece<f64> {
    PolynomialPiece { lower, upper, coefficients: coefficients.to_vec() }
}

fn polynomial(dimension: Dimension, direction: Option<[f64; 3]>, of_rate: bool) -> EffectKind<f64> {
    // The spring pulls at its reference length of about a metre; the damper has a corner.
    let pieces = if of_rate {
        vec![piece(-9.0, 0.1, &[0.0, 30.0, -0.4]), piece(0.1, 9.0, &[0.995, 20.0, 0.1])]
    } else {
        vec![piece(-3.0, 0.5, &[-2.0, 4.0]), piece(0.5, 4.0, &[-4.0, 6.0, 0.0, 8.0])]
    };
    let direction = direction.map(|d| place(dimension, d));
    EffectKind::Polynomial(Polynomial {
        bodies: BODIES,
        points: points(dimension),
        direction,
        of_rate,
        pieces,
    })
}

/// Creates a rope over both free bodies that pulls above a length [m].
fn rope(dimension: Dimension, free_length: f64) -> EffectKind<f64> {
    let [first, second] = points(dimension);
    let middle = place(dimension, [0.7, 0.1, 0.8]);
    let points = vec![(BODIES[0], first), (BODIES[1], middle), (BODIES[1], second)];
    let free_length = Some(free_length);
    let (stiffness, damping, pulls_only) = (150.0, 3.0, true);
    EffectKind::LineSpring(LineSpring { points, stiffness, damping, free_length, pulls_only })
}

/// Creates a bumper that begins to push after a clearance [m].
fn bumper(dimension: Dimension, clearance: f64) -> EffectKind<f64> {
    let (bodies, points) = (BODIES, points(dimension));
    EffectKind::Bumper(Bumper { bodies, points, stiffness: 150.0, damping: 3.0, clearance })
}

/// Creates a bushing between the free bodies.
#[must_use]
pub fn bushing(dimension: Dimension, damping: f64) -> EffectKind<f64> {
    let damping = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3].map(|c| c * damping);
    let stiffness = [50.0, 60.0, 70.0, 5.0, 6.0, 7.0];
    EffectKind::Bushing(Bushing { bodies: BODIES, at: points(dimension)[0], stiffness, damping })
}

/// Creates stops of a joint.
fn limit(joint: JointId, lower: f64, upper: f64) -> EffectKind<f64> {
    EffectKind::Limit(Limit {
        joint,
        coordinate: None,
        range: false,
        lower,
        upper,
        stiffness: 40.0,
        damping: 2.0,
    })
}

fn friction(joint: JointId) -> EffectKind<f64> {
    let (coulomb, r#static, stribeck) = (1.0, 1.2, 0.2);
    let (viscous, regularisation) = (0.3, 0.1);
    EffectKind::Friction(Friction {
        joint,
        coordinate: None,
        coulomb,
        r#static,
        stribeck,
        viscous,
        regularisation,
        factor: Signal::Constant([1.0, 0.0, 0.0]),
    })
}

/// Creates a speed control of the first free body.
fn speed_hold(dimension: Dimension) -> EffectKind<f64> {
    let direction = place(dimension, [1.0, 0.1, -0.2]);
    EffectKind::SpeedHold(SpeedHold {
        body: BODIES[0],
        direction,
        speed: 1.2,
        gain: 8.0,
        limit: 5.0,
    })
}

/// Creates a tire that is pressed into the road by 0.1 m. With `rolls` the tire has rolling resistance, and in space also a side force.
#[must_use]
pub fn tire(dimension: Dimension, rolls: bool) -> EffectKind<f64> {
    let is_spatial = dimension == Dimension::Spatial;
    // Coefficients of a tire for 60 N instead of 6 kN.
    let iltis = CalspanCoefficients::<f64>::iltis();
    let [a0, a1, a2, a3, a4] = iltis.a;
    let side = CalspanCoefficients {
        a: [a0 * 0.01, a1, a2 * 0.01, a3, a4 * 0.01],
        b: [iltis.b[0] * 100.0, iltis.b[1], iltis.b[2] * 1e4],
        trail: iltis.trail.map(|x| x * 100.0),
        ..iltis
    };
    EffectKind::Tire(Tire {
        body: BODIES[0],
        center: place(dimension, [0.05, -0.2, 0.9]),
        axis: is_spatial.then_some([0.05, 1.0, 0.1]),
        radius: 0.5,
        stiffness: 200.0,
        damping: 5.0,
        rolling_resistance: if rolls { 0.1 } else { 0.0 },
        side: (rolls && is_spatial).then_some(side),
        spin: None,
        longitudinal: None,
    })
}

/// Creates a rolling tire with a longitudinal slip force. The tire slips, because its body does not rotate like a wheel.
fn driven(dimension: Dimension) -> EffectKind<f64> {
    let mut kind = tire(dimension, true);
    if let EffectKind::Tire(tire) = &mut kind {
        tire.longitudinal = Some(LongitudinalSlip { stiffness: 90.0, friction: 0.7 });
    }
    kind
}

/// Creates friction that is scaled by a table over time.
fn brake(joint: JointId) -> EffectKind<f64> {
    let mut kind = friction(joint);
    if let EffectKind::Friction(friction) = &mut kind {
        friction.factor = Signal::Table(vec![(0.0, [0.5, 0.0, 0.0]), (1.0, [2.5, 0.0, 0.0])]);
    }
    kind
}

/// Returns every kind of effect, with a description.
#[must_use]
pub fn every(dimension: Dimension) -> Vec<(&'static str, EffectKind<f64>)> {
    let course = Signal::Table(vec![(0.0, [3.0, 0.0, 0.0]), (1.0, [-8.0, 0.0, 0.0])]);
    let (bodies, ends) = (BODIES, points(dimension));
    let direction = Some([0.8, 0.3, 0.4]);
    let drag = EffectKind::AeroDrag(AeroDrag {
        body: BODIES[1],
        at: ends[1],
        area_coefficient: 2.0,
        density: 1.2,
    });
    let mut all = vec![
        ("actuator", EffectKind::Actuator(Actuator { bodies, points: ends, course })),
        ("spring by a polynomial", polynomial(dimension, None, false)),
        ("damper by a polynomial", polynomial(dimension, None, true)),
        ("spring along a direction", polynomial(dimension, direction, false)),
        ("damper along a direction", polynomial(dimension, direction, true)),
        ("bumper out of contact", bumper(dimension, 5.0)),
        ("bumper in contact", bumper(dimension, -0.4)),
        ("bushing", bushing(dimension, 1.0)),
        ("limits of a hinge", limit(JointId::new(0), -0.01, 0.01)),
        ("limits of a slide", limit(JointId::new(1), -0.01, 0.01)),
        ("limits that are far", limit(JointId::new(0), -9.0, 9.0)),
        ("friction of a hinge", friction(JointId::new(0))),
        ("friction of a slide", friction(JointId::new(1))),
        ("drag", drag),
        ("speed hold", speed_hold(dimension)),
        ("tire that is a spring", tire(dimension, false)),
        ("tire that rolls", tire(dimension, true)),
        ("tire that is driven", driven(dimension)),
        ("brake by a table", brake(JointId::new(0))),
        ("rope that is taut", rope(dimension, 0.5)),
        ("rope that is slack", rope(dimension, 9.0)),
    ];
    all.extend(examples(dimension, &all));
    all
}

/// Returns examples of effects. Each has a feature that no effect in `all` has.
fn examples(
    dimension: Dimension,
    all: &[(&str, EffectKind<f64>)],
) -> Vec<(&'static str, EffectKind<f64>)> {
    let ends = points(dimension);
    let places =
        Places { pair: (BODIES, ends), body: (BODIES[1], ends[1]), joint: JointId::new(0) };
    let is_missing =
        |row: &Row| row.feature.is_some() && !all.iter().any(|(_, kind)| kind.row() == row);
    let missing = EFFECTS.iter().enumerate().filter(|(_, row)| is_missing(row));
    missing.filter_map(|(i, row)| Some((row.module, EffectKind::example(i, &places)?))).collect()
}
