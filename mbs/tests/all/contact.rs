//! One-sided contact: bouncing masses and wheels against their exact motion, energies, instants of contact, and a wheel at standstill. With
//! the deflection d [m], the speed v [m/s] and w^2 = k/m:
//!
//! ```text
//! pressed in   d'' = g - w^2 d,   d(0) = 0, d'(0) = v:   d = (g / w^2)(1 - cos w t) + (v / w) sin w t
//! it lasts     w T = 2 (pi - atan(v w / g));   between contacts a parabola
//! ```

use crate::common;
use crate::common::allocations;

use crate::common::Bench;
use mbs::core::outputs::Contacts;
use mbs::core::scene::{Dimension, EffectKind, JointId, Limit, Scene};
use mbs::{Method, Outcome};

/// Formulations that use the trapezoidal rule.
const FORMULATIONS: [&str; 4] = ["index-3", "classical", "state-space", "recursive"];

/// Mass on a vertical slide that touches one one-sided effect.
struct Bounce {
    scene: Scene<f64>,
    gravity: f64,
    /// Square of the frequency in contact [1/s^2].
    stiffness: f64,
    /// Height above the first contact at the start [m], and velocity there [m/s].
    start: [f64; 2],
}

/// A mass of 2 kg on a bumper, planar.
fn bumper(gravity: f64, [height, velocity]: [f64; 2], damping: f64) -> Bounce {
    let scene = mbs_testkit::scene(&format!(
        r#"
[scene]
name = "bumper"
dimension = 2
gravity = [0.0, {:?}]
duration = 1.0
[[body]]
name = "mass"
mass = 2.0
center = [0.0, 1.0]
inertia = 0.1
[[joint]]
name = "guide"
kind = "prismatic"
bodies = ["ground", "mass"]
at = [0.0, 1.0]
axis = [0.0, 1.0]
[[initial]]
joint = "guide"
rate = {velocity:?}
[[effect]]
name = "stop"
kind = "bumper"
bodies = ["ground", "mass"]
points = [[0.0, 0.0], [0.0, 1.0]]
stiffness = 5000.0
damping = {damping:?}
clearance = {height:?}
[[output]]
name = "height"
body = "mass"
at = [0.0, 1.0]
quantity = "position"
[[output]]
name = "velocity"
body = "mass"
at = [0.0, 1.0]
quantity = "velocity"
"#,
        -gravity
    ));
    Bounce { scene, gravity, stiffness: 2500.0, start: [height, velocity] }
}

/// Wheel of 20 kg that falls on level ground, upright in the plane, or leaning by 0.3 rad in space.
fn wheel(dimension: Dimension, height: f64, damping: f64) -> Bounce {
    let (stiffness, radius) = (80_000.0, 0.3);
    let is_planar = dimension == Dimension::Planar;
    let (sin, cos) = if is_planar { (0.0, 1.0) } else { 0.3_f64.sin_cos() };
    let z = radius * cos + height;
    let vector = |up: f64| {
        if is_planar { format!("[0.0, {up:?}]") } else { format!("[0.0, 0.0, {up:?}]") }
    };
    let (gravity, at, axis) = (vector(-9.81), vector(z), vector(1.0));
    let (n, inertia) = if is_planar { (2, "0.5") } else { (3, "[0.5, 0.8, 0.5, 0.0, 0.0, 0.0]") };
    let lean = if is_planar { String::new() } else { format!("axis = [0.0, {cos:?}, {sin:?}]") };
    let scene = mbs_testkit::scene(&format!(
        r#"
[scene]
name = "wheel"
dimension = {n}
gravity = {gravity}
duration = 1.0
[[body]]
name = "mass"
mass = 20.0
center = {at}
inertia = {inertia}
[[joint]]
name = "guide"
kind = "prismatic"
bodies = ["ground", "mass"]
at = {at}
axis = {axis}
[[effect]]
name = "tire"
kind = "tire"
body = "mass"
center = {at}
{lean}
radius = {radius:?}
stiffness = {stiffness:?}
damping = {damping:?}
[[output]]
name = "height"
body = "mass"
at = {at}
quantity = "position"
[[output]]
name = "velocity"
body = "mass"
at = {at}
quantity = "velocity"
"#
    ));
    // the force acts along the normal and the deflection is measured in the disc's plane: both are larger by 1 / cos g, where g is the lean
    let stiffness = stiffness / (20.0 * cos * cos);
    Bounce { scene, gravity: 9.81, stiffness, start: [height, 0.0] }
}

impl Bounce {
    /// Height above the first contact and velocity at a time, and the instants of contact until then.
    fn exact(&self, t: f64) -> ([f64; 2], Vec<f64>) {
        let ([mut height, mut velocity], mut now, mut instants) = (self.start, 0.0, Vec::new());
        let (g, w) = (self.gravity, self.stiffness.sqrt());
        loop {
            // free fall down to the contact
            let fall = if g > 0.0 {
                (velocity + (velocity * velocity + 2.0 * g * height).sqrt()) / g
            } else if velocity < 0.0 {
                -height / velocity
            } else {
                f64::INFINITY
            };
            if now + fall > t {
                let s = t - now;
                return ([height + velocity * s - 0.5 * g * s * s, velocity - g * s], instants);
            }
            now += fall;
            instants.push(now);
            let v = g * fall - velocity;
            let depth = |s: f64| {
                let (sin, cos) = (w * s).sin_cos();
                let d = g / (w * w) * (1.0 - cos) + v / w * sin;
                [d, g / w * sin + v * cos]
            };
            let lasts = 2.0 * (core::f64::consts::PI - (v * w).atan2(g)) / w;
            if now + lasts > t {
                let [d, rate] = depth(t - now);
                return ([-d, -rate], instants);
            }
            now += lasts;
            instants.push(now);
            (height, velocity) = (0.0, v);
        }
    }

    fn run(&self, formulation: &str, step: f64) -> Outcome {
        // this tolerance is below the errors of the rule at the smallest step
        self.run_with(formulation, step, Method { tolerance: Some(1e-13), ..Method::default() })
    }

    fn run_with(&self, formulation: &str, step: f64, overrides: Method) -> Outcome {
        let overrides =
            Method { formulation: Some(formulation.to_owned()), step: Some(step), ..overrides };
        let outcome = common::run(&self.scene, &overrides);
        assert!(outcome.error.is_none(), "{formulation} {step}: {:?}", outcome.error);
        outcome
    }

    /// Largest errors over the run: height [m], and velocity [m/s].
    fn errors(&self, outcome: &Outcome) -> [f64; 2] {
        let n = self.scene.dimension.count();
        let zero = outcome.rows()[0].1[n - 1] - self.start[0];
        outcome.rows().iter().fold([0.0_f64; 2], |[height, velocity], (t, row)| {
            let ([h, v], _) = self.exact(*t);
            [height.max((row[n - 1] - zero - h).abs()), velocity.max((row[2 * n - 1] - v).abs())]
        })
    }

    /// Largest error of the instants of contact [s].
    fn instants(&self, outcome: &Outcome) -> f64 {
        let (_, exact) = self.exact(1.0);
        let told = &outcome.summary.contacts;
        assert_eq!(told.len(), exact.len(), "{told:?} {exact:?}");
        for (i, contact) in told.iter().enumerate() {
            assert_eq!(contact.event, if i % 2 == 0 { "made" } else { "broken" });
        }
        told.iter().zip(&exact).fold(0.0, |most, (a, b)| f64::max(most, (a.time - b).abs()))
    }
}

/// Largest ratio of the errors at a tenth of the step to those at the step, for errors of order two. The ratio is a hundredth, times a factor
/// that depends on the position of the contacts within their steps. A kink of the force at a fraction r of a step gives r (1 - r) of the
/// largest error.
const TENTH: f64 = 0.03;

/// Cases without a damper, with their names.
fn bounces() -> Vec<(&'static str, Bounce)> {
    vec![
        ("thrown against a bumper", bumper(0.0, [0.2, -1.3], 0.0)),
        ("falling on a bumper", bumper(9.81, [0.1, 0.4], 0.0)),
        ("wheel in the plane", wheel(Dimension::Planar, 0.05, 0.0)),
        ("leaning wheel in space", wheel(Dimension::Spatial, 0.05, 0.0)),
    ]
}

#[test]
fn bouncing_masses_follow_sines_and_parabolas_with_an_error_of_order_two() {
    for (what, bounce) in bounces() {
        for formulation in FORMULATIONS {
            let [coarse, fine] = [1e-3, 1e-4].map(|step| bounce.run(formulation, step));
            let (a, b) = (bounce.errors(&coarse), bounce.errors(&fine));
            let (s, t) = (bounce.instants(&coarse), bounce.instants(&fine));
            println!("{what}, {formulation}: {a:?} and {b:?} m, m/s; instants {s:.1e}, {t:.1e} s");
            for k in 0..2 {
                assert!(b[k] < TENTH * a[k], "{what}, {formulation}: {a:?} {b:?}");
            }
            assert!(t < TENTH * s, "{what}, {formulation}: instants {s:e} {t:e}");
        }
    }
}

#[test]
fn contacts_leave_no_energy_behind_but_an_error_of_order_two_of_the_step() {
    for (what, bounce) in bounces().into_iter().chain([
        ("damped bumper", bumper(9.81, [0.1, 0.4], 40.0)),
        ("damped wheel", wheel(Dimension::Spatial, 0.05, 300.0)),
    ]) {
        for formulation in FORMULATIONS {
            let errors = [1e-3, 2.5e-4, 6.25e-5].map(|step| {
                let energy = bounce.run(formulation, step).summary.energy;
                energy.max_error / energy.turned_over
            });
            println!("{what}, {formulation}: {errors:?} of the energy turned over");
            // two quarterings of the step reduce an error of order two to 1 / 256, times a factor that depends on the position of the contacts
            // within their steps
            assert!(errors[2] < 0.02 * errors[0] && errors[2] < 2e-5, "{what}, {formulation}");
        }
    }
}

#[test]
fn a_damper_takes_energy_at_every_bounce_and_gives_none_back() {
    for (what, bounce) in [
        ("bumper", bumper(9.81, [0.1, 0.0], 40.0)),
        ("wheel", wheel(Dimension::Planar, 0.05, 300.0)),
    ] {
        let outcome = bounce.run("index-3", 1e-4);
        let n = bounce.scene.dimension.count();
        let contacts: Vec<f64> = outcome.summary.contacts.iter().map(|c| c.time).collect();
        assert!(contacts.len() >= 5, "{what}: {contacts:?}");
        // `top` is the largest height between two contacts
        let top = |from: f64, to: f64| {
            let rows = outcome.rows().iter().filter(|(t, _)| (from..to).contains(t));
            rows.fold(f64::MIN, |top, (_, row)| top.max(row[n - 1]))
        };
        let mut last = top(0.0, contacts[0]);
        let first = last;
        for flight in contacts[1..].chunks_exact(2) {
            let next = top(flight[0], flight[1]);
            assert!(next < last, "{what}: {next} after {last}");
            last = next;
        }
        println!("{what}: from {first} to {last} m");
        assert!(first - last > 0.01, "{what}");
    }
}

#[test]
fn a_damper_that_fades_in_within_a_step_gives_its_impulse_where_steps_end_at_events() {
    // the damper fades in over a millimetre, which takes three steps at the lowest speed and a fifth of a step at the highest
    let (step, damping, mass) = (1e-3, 400.0, 2.0);
    for rate in [-0.35, -0.7, -0.95, -1.3, -2.1, -5.0] {
        let bounce = bumper(0.0, [0.05, rate], damping);
        let right = bounce.run("index-3", 1e-5);
        let landed = bounce.run_with("multi-index", step, Method::default());
        let velocity = |outcome: &Outcome| outcome.rows().last().map(|(_, row)| row[3]);
        let error = (velocity(&landed).unwrap() - velocity(&right).unwrap()).abs();
        // a force that acts at once, but is evaluated at one end of a step only, has an error of half of its impulse in that step
        let blunder = 0.5 * step * damping * rate.abs() / mass;
        println!("{rate} m/s: {error:.1e} of {blunder:.1e} m/s");
        assert!(
            error < 0.1 * blunder,
            "{rate} m/s: {error:e} m/s, where {blunder:e} is the whole of it"
        );
    }
}

/// Scene of a mass of 400 kg on one wheel, held upright at a constant height. It rolls and slips sideways, is pushed back, and passes
/// standstill.
const STANDSTILL: &str = r#"
[scene]
name = "standstill"
dimension = 3
gravity = [0.0, 0.0, -9.81]
duration = 1.5
[[body]]
name = "mass"
mass = 400.0
center = [0.0, 0.0, 0.35]
inertia = [50.0, 50.0, 50.0, 0.0, 0.0, 0.0]
[[joint]]
name = "level"
kind = "planar"
bodies = ["ground", "mass"]
at = [0.0, 0.0, 0.35]
axis = [0.0, 0.0, 1.0]
direction = [1.0, 0.0, 0.0]
[[initial]]
body = "mass"
at = [0.0, 0.0, 0.35]
velocity = [0.6, 0.3, 0.0]
angular_velocity = [0.0, 0.0, 0.1]
[[effect]]
name = "push"
kind = "force"
body = "mass"
at = [0.0, 0.0, 0.35]
value = [-200.0, 20.0, 0.0]
[[effect]]
name = "tire"
kind = "tire"
body = "mass"
center = [0.0, 0.0, 0.35]
axis = [0.0, 1.0, 0.1]
radius = 0.36
stiffness = 460000.0
rolling_resistance = 0.015
side = "calspan"
[[output]]
name = "place"
body = "mass"
at = [0.0, 0.0, 0.35]
quantity = "position"
[[output]]
name = "nose"
body = "mass"
at = [1.0, 0.0, 0.35]
quantity = "position"
[[output]]
name = "velocity"
body = "mass"
at = [0.0, 0.0, 0.35]
quantity = "velocity"
"#;

#[test]
fn a_wheel_goes_through_standstill_on_a_path_that_does_not_depend_on_the_step() {
    let scene = mbs_testkit::scene(STANDSTILL);
    for formulation in FORMULATIONS {
        let run = |step: f64| {
            let outcome = common::run_in(&scene, formulation, Some(step));
            assert!(outcome.error.is_none(), "{formulation} {step}: {:?}", outcome.error);
            let rows = outcome.rows();
            assert!(rows[0].1[6] > 0.5 && rows[rows.len() - 1].1[6] < -0.1, "it turns back");
            rows[rows.len() - 1].1.clone()
        };
        let [a, b, c] = [4e-4, 2e-4, 1e-4].map(run);
        let apart = |x: &[f64], y: &[f64]| {
            x.iter().zip(y).fold(0.0_f64, |most, (x, y)| most.max((x - y).abs()))
        };
        let (coarse, fine) = (apart(&a, &b), apart(&b, &c));
        println!("{formulation}: {coarse:.1e} and {fine:.1e} m, m/s");
        // an error of order two falls to a quarter at half the step
        assert!(fine < 0.3 * coarse && fine < 1e-5, "{formulation}: {coarse:e} {fine:e}");
    }
}

#[test]
fn a_run_lists_a_thousand_contacts_and_counts_the_others() {
    let mut rattle = bumper(9.81, [1e-4, 0.0], 0.0);
    rattle.scene.duration = 80.0;
    let outcome = rattle.run("index-3", 1e-3);
    let summary = &outcome.summary;
    println!("{} contacts, {} more", summary.contacts.len(), summary.contacts_left_out);
    assert_eq!(summary.contacts.len(), 1000);
    assert!(summary.contacts_left_out > 10);
    assert!(summary.contacts.windows(2).all(|pair| pair[0].time <= pair[1].time));
}

#[test]
fn a_limit_reports_which_end_was_touched_and_watching_allocates_nothing() {
    let mut bounce = bumper(0.0, [0.2, 1.3], 0.0);
    let (stiffness, damping) = (5000.0, 0.0);
    bounce.scene.effects[0].kind = EffectKind::Limit(Limit {
        joint: JointId::new(0),
        coordinate: None,
        range: false,
        lower: -0.05,
        upper: 0.1,
        stiffness,
        damping,
    });
    let outcome = bounce.run("index-3", 1e-4);
    let told = &outcome.summary.contacts;
    assert!(told.len() > 8, "{told:?}");
    for (i, contact) in told.iter().enumerate() {
        let (end, event) = ([Some("upper"), Some("lower")][i / 2 % 2], ["made", "broken"][i % 2]);
        assert_eq!((contact.end, contact.event), (end, event), "{told:?}");
    }
    // the contact begins after 0.1 m at 1.3 m/s; the force at the end of the step shifts it by about w^2 h^3
    assert!((told[0].time - 0.1 / 1.3).abs() < 2500.0 * 1e-12, "{told:?}");

    let mut bench = Bench::<2>::of_scene(&bounce.scene, "index-3", 1e-3);
    let mut contacts =
        Contacts::new(&bounce.scene, bench.simulation.model()).expect("the law is compiled");
    contacts.start(bench.simulation.state());
    let before = allocations::count();
    for k in 1..=500 {
        bench.step().expect("a regular step");
        bench.simulation.set_time(1e-3 * f64::from(k));
        contacts.watch(bench.simulation.state());
    }
    assert_eq!(allocations::count(), before);
    assert!(contacts.instants().len() > 3);
}
