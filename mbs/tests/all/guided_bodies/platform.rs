//! Guided body alone: its motion is that of the signals, its efforts are those of Newton's and Euler's equations.

use super::kinematics::{
    Matrix, Motion, Sine, Vector, add, cross_of, minus, product, rate, scaled, times, transposed,
};
use super::{Rows, SIX, WAYS, head, off, oracle, output, signals};

/// Mass [kg], centre [m], inertia about the centre [kg m^2], guided point [m], and another point [m].
const MASS: f64 = 20.0;
const CENTER: Vector = [0.02, -0.01, 1.25];
const INERTIA: Matrix = [[1.9, 0.05, 0.02], [0.05, 2.1, -0.03], [0.02, -0.03, 3.6]];
const AT: Vector = [0.3, 0.1, 1.2];
const POINT: Vector = [0.5, -0.2, 1.4];
const GRAVITY: Vector = [1.0, -2.0, -9.81];

/// Relative error of positions and velocities, which the signals determine by projections [-].
const KINEMATICS: f64 = 1e-10;
/// Relative error of accelerations and efforts [-]: the accuracy of the acceleration projection.
const DYNAMICS: f64 = 1e-7;

fn motion() -> Motion {
    let [x, y, z, a, b, c] = SIX;
    Motion { translation: [x, y, z], rotation: [a, b, c] }
}

fn scene() -> String {
    let (sines, names) = signals(&SIX);
    let of = |quantity| output("joint = \"platform\"", "", quantity);
    let point = |quantity| output("body = \"platform\"", &format!("at = {POINT:?}"), quantity);
    let turning = |quantity| output("body = \"platform\"", "", quantity);
    [
        head(3, &format!("{GRAVITY:?}")),
        format!("[[body]]\nname = \"platform\"\nmass = {MASS:?}\ncenter = {CENTER:?}\n"),
        "inertia = [1.9, 2.1, 3.6, 0.05, -0.03, 0.02]\n".into(),
        format!("[[guide]]\nbody = \"platform\"\nat = {AT:?}\nsignals = {names}\n"),
        sines,
        of("value"),
        point("position"),
        point("velocity"),
        turning("angular-velocity"),
        point("acceleration"),
        turning("angular-acceleration"),
        of("effort"),
    ]
    .concat()
}

/// Outputs of the scene, computed by hand.
fn expected(t: f64) -> [Vec<f64>; 7] {
    let m = motion();
    let of = |x: Vector| move |t: f64| add(AT, m.place(minus(x, AT), t));
    let second = |x: Vector| rate(|t| rate(of(x), t), t);
    let (omega, omega_t) = (m.spin(t), rate(|t| m.spin(t), t));
    // the guided point p and the centre c give the efforts F = m (a − g), M = I ω' + ω × I ω + (c − p) × F
    let force = scaled(minus(second(CENTER), GRAVITY), MASS);
    let r = m.rotation_at(t);
    let inertia = product(&product(&r, &INERTIA), &transposed(&r));
    let euler = add(times(&inertia, omega_t), cross_of(omega, times(&inertia, omega)));
    let moment = add(euler, cross_of(minus(of(CENTER)(t), of(AT)(t)), force));
    [
        SIX.map(|sine| sine.at(t)).to_vec(),
        of(POINT)(t).to_vec(),
        rate(of(POINT), t).to_vec(),
        omega.to_vec(),
        second(POINT).to_vec(),
        omega_t.to_vec(),
        [force, moment].concat(),
    ]
}

/// Largest error of each of the seven outputs over a run.
fn errors(rows: &Rows) -> [f64; 7] {
    let mut errors = [0.0; 7];
    for (t, row) in rows.iter().step_by(20) {
        let mut first = 0;
        for (error, expected) in errors.iter_mut().zip(expected(*t)) {
            let found = &row[first..first + expected.len()];
            *error = crate::common::worst(*error, off(found, &expected));
            first += expected.len();
        }
    }
    errors
}

#[test]
fn a_guided_platform_moves_as_its_signals_say_and_asks_for_the_forces_of_newton_and_euler() {
    let text = scene();
    for way in WAYS {
        let errors = errors(&oracle::run(&text, way, (1e-3, 1.0)));
        println!("{way:?}: {errors:?}");
        assert!(errors[..4].iter().all(|e| *e <= KINEMATICS), "{way:?}: {errors:?}");
        assert!(errors[4..].iter().all(|e| *e <= DYNAMICS), "{way:?}: {errors:?}");
    }
}

#[test]
fn a_planar_platform_follows_two_translations_and_an_angle_through_turns() {
    let sines = [Sine([0.3, 0.7, 0.4]), Sine([0.2, 0.9, -0.2]), Sine([9.0, 0.5, 0.1])];
    let (text, names) = signals(&sines);
    let text = [
        head(2, "[1.5, -9.81]"),
        "[[body]]\nname = \"p\"\nmass = 3.0\ncenter = [0.4, 0.1]\ninertia = 0.7\n".into(),
        format!("[[guide]]\nbody = \"p\"\nat = [0.1, 0.2]\nsignals = {names}\n"),
        text,
        output("joint = \"p\"", "", "value"),
        output("joint = \"p\"", "", "effort"),
    ]
    .concat();
    let [x, y, angle] = sines;
    let center = |t: f64| {
        let (s, c) = angle.at(t).sin_cos();
        [x.at(t) + 0.3 * c + 0.1 * s, y.at(t) + 0.3 * s - 0.1 * c]
    };
    for way in WAYS {
        for (t, row) in oracle::run(&text, way, (1e-3, 1.0)).iter().step_by(20) {
            let values = sines.map(|sine| sine.at(*t));
            assert!(off(&row[..3], &values) < KINEMATICS, "{way:?} at {t}: {row:?} {values:?}");
            let a = rate(|t| rate(center, t), *t);
            let [turning] = rate(|t| rate(|t| [angle.at(t)], t), *t);
            let force = [3.0 * (a[0] - 1.5), 3.0 * (a[1] + 9.81)];
            let arm = [center(*t)[0] - values[0], center(*t)[1] - values[1]];
            let moment = 0.7 * turning + arm[0] * force[1] - arm[1] * force[0];
            let efforts = [force[0], force[1], moment];
            assert!(off(&row[3..], &efforts) < DYNAMICS, "{way:?} at {t}: {row:?} {efforts:?}");
        }
    }
}

/// Pendulum on the platform about an oblique axis [m, kg, kg m^2].
const HINGE: Vector = [0.7, 0.3, 1.1];
const AXIS: Vector = [0.48, 0.6, 0.64];
const BOB: Vector = [0.9, 0.1, 0.8];
const BOB_MASS: f64 = 2.0;
const BOB_INERTIA: f64 = 0.05;

/// Angular acceleration of the pendulum. The virtual power of its rate, m (a − g)·u + I ω'·n, is linear in the acceleration. The body has
/// equal inertia about all axes, so that ω × I ω is zero.
fn swing(m: &Motion, t: f64, [angle, speed]: [f64; 2]) -> f64 {
    let residual = |second: f64| {
        let at = |s: f64| angle + speed * (s - t) + 0.5 * second * (s - t) * (s - t);
        let own = |s: f64| super::kinematics::rotation(scaled(AXIS, at(s)));
        let place = |s: f64| m.place(add(minus(HINGE, AT), times(&own(s), minus(BOB, HINGE))), s);
        let turned = |s: f64| product(&m.rotation_at(s), &own(s));
        let spin = |s: f64| super::kinematics::spin_of(turned, s);
        let axis = times(&m.rotation_at(t), AXIS);
        let arm = minus(place(t), m.place(minus(HINGE, AT), t));
        let force = scaled(minus(rate(|s| rate(place, s), t), GRAVITY), BOB_MASS);
        let moment = scaled(rate(spin, t), BOB_INERTIA);
        crate::common::dot(axis, add(cross_of(arm, force), moment))
    };
    let none = residual(0.0);
    -none / (residual(1.0) - none)
}

/// Angle after `duration` [s] by the classical Runge-Kutta method.
fn swung(duration: f64) -> f64 {
    let (m, n) = (motion(), 1000);
    let h = duration / f64::from(n);
    let mut y = [0.3, 0.0];
    for k in 0..n {
        let t = h * f64::from(k);
        let f = |t: f64, y: [f64; 2]| [y[1], swing(&m, t, y)];
        let moved = |d: [f64; 2], h: f64| [y[0] + h * d[0], y[1] + h * d[1]];
        let a = f(t, y);
        let b = f(t + 0.5 * h, moved(a, 0.5 * h));
        let c = f(t + 0.5 * h, moved(b, 0.5 * h));
        let d = f(t + h, moved(c, h));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    y[0]
}

#[test]
fn a_pendulum_on_a_guided_platform_swings_by_its_equation_of_motion_with_errors_of_second_order() {
    let duration = 0.25;
    let i = BOB_INERTIA;
    let text = [
        scene(),
        format!("[[body]]\nname = \"bob\"\nmass = {BOB_MASS:?}\ncenter = {BOB:?}\n"),
        format!("inertia = [{i:?}, {i:?}, {i:?}, 0.0, 0.0, 0.0]\n"),
        "[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nbodies = [\"platform\", \"bob\"]\n"
            .into(),
        format!("at = {HINGE:?}\naxis = {AXIS:?}\n"),
        "[[initial]]\njoint = \"hinge\"\nvalue = 0.3\nrate = 0.0\n".into(),
        output("joint = \"hinge\"", "", "value"),
    ]
    .concat();
    let exact = swung(duration);
    for way in WAYS {
        let error = |step: f64| {
            let rows = oracle::run(&text, way, (step, duration));
            rows.last().and_then(|(_, row)| row.last().copied()).expect("a row") - exact
        };
        let errors = [1e-3, 5e-4, 2.5e-4].map(error);
        println!("{way:?}: {exact} {errors:?}");
        if way.1 == "rk853" {
            // error of the reference, which is of fourth order with 0.25 ms
            assert!(errors[2].abs() < 1e-7, "{errors:?}");
        } else {
            let ratio = errors[1] / errors[2];
            assert!((3.6..4.4).contains(&ratio), "{way:?}: {errors:?}");
            // the platform rotates at up to 60 rad/s
            assert!(errors[2].abs() < 5e-4, "{way:?}: {errors:?}");
        }
    }
}
