//! Signals that depend on the motion: controllers, engine curves and lags, against closed forms in every formulation.

use crate::common::oracle::{TRAPEZOIDAL, Way, rows};
use crate::common::{cross, dot};
use mbs::core::outputs::Quantity;
use mbs::core::scene::{BodyId, Output};
use mbs::scene_file::SceneFile;
use mbs::{Modes, Place, Search};
use mbs_testkit::scene;

/// Integrators in relative coordinates whose error is smaller than all tolerances of these tests.
const ACCURATE: [&str; 3] = ["rk4", "rk853", "radau5"];

/// Scene of a wheel of 2 kg m^2 on an axle: planar, or in space about an oblique axis.
fn wheel(dimension: usize, rest: &str) -> String {
    let (point, inertia, axis) = if dimension == 2 {
        ("[0.0, 0.0]", "2.0", "")
    } else {
        ("[0.0, 0.0, 0.0]", "[2.0, 2.0, 2.0, 0.0, 0.0, 0.0]", "axis = [0.48, 0.6, 0.64]\n")
    };
    format!(
        "[scene]\ndimension = {dimension}\nduration = 1.0\ngravity = {point}\n\
        [[body]]\nname = \"wheel\"\nmass = 1.0\ncenter = {point}\ninertia = {inertia}\n\
        [[joint]]\nname = \"axle\"\nkind = \"revolute\"\nbodies = [\"ground\", \"wheel\"]\nat = {point}\n{axis}\
        [[signal]]\nname = \"angle\"\nkind = \"measure\"\njoint = \"axle\"\n\
        [[signal]]\nname = \"speed\"\nkind = \"measure\"\njoint = \"axle\"\nquantity = \"rate\"\n\
        [[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"asked\"\n\
        [[output]]\nname = \"angle\"\njoint = \"axle\"\nquantity = \"value\"\n\
        [[output]]\nname = \"speed\"\njoint = \"axle\"\nquantity = \"rate\"\n{rest}"
    )
}

/// Last row of a run of a scene.
fn end(text: &str, way: Way, step: f64, duration: f64) -> Vec<f64> {
    let steps = (duration / step).round() as usize;
    let rows = rows(&scene(text), way, (step, duration), steps);
    let rows = rows.unwrap_or_else(|e| panic!("{way:?}: {e}"));
    rows.last().expect("a row").1.to_vec()
}

/// Asserts the first output at the end. Its error must fall to a quarter at half the step in each formulation, and must be small with accurate
/// integrators.
fn meets(text: &str, (duration, right): (f64, f64), allowed: f64) {
    for formulation in TRAPEZOIDAL {
        let way = Way(formulation, "trapezoidal");
        let [coarse, fine] =
            [2e-3, 1e-3].map(|step| (end(text, way, step, duration)[0] - right).abs());
        assert!(fine < allowed, "{formulation}: off by {fine:e}");
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.15, "{formulation}: {coarse:e}, {fine:e}, order {order}");
    }
    for integrator in ACCURATE {
        let found = end(text, Way("recursive", integrator), 1e-3, duration)[0];
        assert!((found - right).abs() < 2e-9, "{integrator}: {found:.12}, not {right:.12}");
    }
}

const SERVO: &str = "[[signal]]\nname = \"target\"\nkind = \"constant\"\nvalue = 1.0\n\
    [[signal]]\nname = \"asked\"\nkind = \"pid\"\ntarget = \"target\"\nmeasured = \"angle\"\n\
    p = 40.0\ni = 30.0\nd = 6.0\n[[initial]]\njoint = \"axle\"\nvalue = 0.0\nrate = 0.0\n";

#[test]
fn a_servo_turns_its_wheel_as_its_third_order_equation_says() {
    // 2 w''' + 6 w'' + 40 w' + 30 w = 0 for w = angle - 1, solved by its three roots; the number is that of the document on machine elements
    for dimension in [2, 3] {
        meets(&wheel(dimension, SERVO), (1.0, 1.327_874_856), 1e-4);
    }
}

/// Text of the signal `asked` of a kind, with other signals that it needs.
fn asked(kind: &str, others: &str) -> String {
    format!("[[signal]]\nname = \"asked\"\nkind = {kind}\n{others}")
}

/// Text of a constant signal.
fn constant(name: &str, value: f64) -> String {
    format!("[[signal]]\nname = \"{name}\"\nkind = \"constant\"\nvalue = {value:?}\n")
}

#[test]
fn an_engine_whose_torque_falls_with_its_speed_runs_up_as_an_exponential() {
    // half of the torque 12 - 4 w acts on 2 kg m^2: rate w = 3 (1 - e^-t), angle 3 (t - 1 + e^-t)
    let curve = "[[signal]]\nname = \"full\"\nkind = \"curve\"\nof = \"speed\"\ncoefficients = [12.0, -4.0]\n";
    let others = format!("{curve}{}", constant("throttle", 0.5));
    let text = wheel(3, &asked("\"product\"\nof = [\"throttle\", \"full\"]", &others));
    meets(&text, (1.0, 3.0 * (-1.0_f64).exp()), 1e-5);
}

#[test]
fn a_late_torque_follows_its_command_with_its_time() {
    // 4 N m act with a lag of T = 0.2 s on 2 kg m^2, which gives the angle t^2 - 2 T t + 2 T^2 (1 - e^(-t/T))
    let text = wheel(2, &asked("\"lag\"\nof = \"command\"\ntime = 0.2", &constant("command", 4.0)));
    let t = 0.2_f64;
    meets(&text, (1.0, 1.0 - 2.0 * t + 2.0 * t * t * (1.0 - (-5.0_f64).exp())), 1e-5);
}

#[test]
fn a_controller_counts_the_turns_of_what_it_measures() {
    // 2 w'' + 6 w' + 40 w = 0 from w = -10 rad, which is more than a revolution: 1.6 revolutions on the way
    let pid = "\"pid\"\ntarget = \"target\"\nmeasured = \"angle\"\np = 40.0\nd = 6.0";
    let text = wheel(3, &asked(pid, &constant("target", 10.0)));
    let w = 17.75_f64.sqrt();
    let left = (-1.5_f64).exp() * (w.cos() + 1.5 / w * w.sin());
    meets(&text, (1.0, 10.0 * (1.0 - left)), 1e-3);
}

#[test]
fn an_integral_stops_at_its_limit_and_comes_back_at_once() {
    // the integral of 8 reaches its limit of 4 N m at 0.5 s, and acts on 2 kg m^2; from 0.75 s it is the integral of -8
    let command = "[[signal]]\nname = \"command\"\nkind = \"table\"\ninterpolation = \"hold\"\ntable = [[0.0, 8.0], [0.75, -8.0]]\n";
    let kind = "\"integral\"\nof = \"command\"\nlower = -1.0\nupper = 4.0";
    let text = wheel(2, &asked(kind, command));
    // the angle is 4 t^3/6 up to 0.5 s; then the torque is constant; then the torque falls, which adds -4 t^3/6
    let (w1, a1) = (0.5, 0.5 / 6.0);
    let (w2, a2) = (w1 + 2.0 * 0.25, a1 + w1 * 0.25 + 0.25 * 0.25);
    let right = a2 + w2 * 0.25 + 0.25 * 0.25 - 4.0 / 6.0 * 0.25_f64.powi(3);
    for formulation in TRAPEZOIDAL {
        let found = end(&text, Way(formulation, "trapezoidal"), 1e-3, 1.0)[0];
        // the command jumps within a step of 1 ms, which gives an error of 8 (N m/s) 1 ms 0.25 s / 2 / 2 kg m^2
        assert!((found - right).abs() < 1e-3, "{formulation}: {found}, not {right}");
    }
}

/// Angle after `duration` [s] of a wheel under a controller of p 40, i 30, d 6 with a limit. Independent equations are integrated by RK4 with
/// 20 us. `stops` means that the integral is held at the limit.
fn limited(limit: f64, stops: bool, duration: f64) -> f64 {
    let rates = |_, [angle, speed, sum]: [f64; 3]| {
        let (e, rate) = (1.0 - angle, -speed);
        let wanted = 40.0 * e + 30.0 * sum + 6.0 * rate;
        let is_over = wanted.abs() > limit;
        let given = wanted.clamp(-limit, limit);
        [speed, given / 2.0, if stops && is_over && e * wanted > 0.0 { 0.0 } else { e }]
    };
    rk4(rates, [0.0; 3], (duration, 2e-5))[0]
}

#[test]
fn a_controller_at_its_limit_does_not_wind_up() {
    let text = wheel(2, &SERVO.replace("d = 6.0", "d = 6.0\nlimit = 3.0"));
    let [right, wound_up] = [true, false].map(|stops| limited(3.0, stops, 2.0));
    assert!(wound_up > right + 0.05, "{wound_up} and {right} are told apart");
    for formulation in TRAPEZOIDAL {
        let found = end(&text, Way(formulation, "trapezoidal"), 1e-3, 2.0)[0];
        // the torque leaves the limit within a step
        assert!((found - right).abs() < 1e-4, "{formulation}: {found}, not {right}");
    }
}

#[test]
fn signals_that_nothing_can_follow_are_refused_at_their_place() {
    let guide = "[[guide]]\njoint = \"axle\"\nsignal = \"asked\"\n";
    let start = "[[initial]]";
    let cases = [
        (SERVO.replace(start, &format!("{guide}{start}")), "`angle` follows the motion"),
        (SERVO.replace("measured = \"angle\"", "measured = \"speed\""), "needs the rate"),
        (SERVO.replace("target = \"target\"", "target = \"asked\""), "`asked` needs `asked`"),
        (SERVO.replace("target = \"target\"", "target = \"goal\""), "unknown signal `goal`"),
        (SERVO.replace("d = 6.0", "d = 6.0\nlimit = 0.0"), "limit"),
        (SERVO.replace("d = 6.0", "filter = 6.0"), "filter"),
    ];
    for (rest, message) in cases {
        let text = wheel(2, &rest);
        let error = SceneFile::parse(&text, "scene.toml").and_then(|file| file.scene::<f64>());
        let error = error.map(|_| ()).expect_err(message).to_string();
        assert!(error.contains(message), "{message}: {error}");
    }
}

#[test]
fn a_stiff_controller_converges_where_its_damping_outweighs_the_inertia() {
    // half of the derivative gain d times the step h is five times the inertia; the target rises over 0.1 s
    let servo = SERVO
        .replace("p = 40.0\ni = 30.0\nd = 6.0", "p = 1e6\nd = 2e4")
        .replace("kind = \"constant\"\nvalue = 1.0", "kind = \"step\"\nto = 1.0\nrise = 0.1");
    let target = |t: f64| {
        let s = t / 0.1;
        let rate = 30.0 * s * s * (1.0 - s) * (1.0 - s) / 0.1;
        (s * s * s * (10.0 - s * (15.0 - 6.0 * s)), rate)
    };
    let rates = |t: f64, [angle, speed]: [f64; 2]| {
        let (wanted, rate) = target(t);
        [speed, 0.5 * (1e6 * (wanted - angle) + 2e4 * (rate - speed))]
    };
    let right = rk4(rates, [0.0; 2], (0.08, 1e-5))[0];
    for dimension in [2, 3] {
        for formulation in TRAPEZOIDAL {
            let way = Way(formulation, "trapezoidal");
            let found = end(&wheel(dimension, &servo), way, 1e-3, 0.08)[0];
            // position of the target after 80 of its 100 steps; errors are (h/T)^2 with the step h and the rise time T
            assert!((found - right).abs() < 1e-4, "{formulation}: {found}, not {right}");
        }
    }
}

/// Integrates over a duration with fixed steps by the classical Runge-Kutta method.
fn rk4<const N: usize>(
    rates: impl Fn(f64, [f64; N]) -> [f64; N],
    mut y: [f64; N],
    (duration, h): (f64, f64),
) -> [f64; N] {
    let add = |y: [f64; N], k: [f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    for n in 0..(duration / h).round() as u32 {
        let t = h * f64::from(n);
        let k1 = rates(t, y);
        let k2 = rates(t + 0.5 * h, add(y, k1, 0.5 * h));
        let k3 = rates(t + 0.5 * h, add(y, k2, 0.5 * h));
        let k4 = rates(t + h, add(y, k3, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    y
}

/// Scene of two spatial rods on skew axes. The torque on the first depends on the rotation of the second.
fn crossed() -> String {
    let rod = |name: &str, center: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 2.0\ncenter = {center}\n\
            inertia = [0.2, 0.25, 0.3, 0.01, 0.02, 0.0]\n"
        )
    };
    format!(
        "[scene]\ndimension = 3\nduration = 1.0\n{}{}\
        [[joint]]\nname = \"axle\"\nkind = \"revolute\"\nbodies = [\"ground\", \"one\"]\nat = [0.0, 0.0, 0.0]\naxis = [0.48, 0.6, 0.64]\n\
        [[joint]]\nname = \"pin\"\nkind = \"cylindrical\"\nbodies = [\"two\", \"one\"]\nat = [0.8, 0.0, 0.0]\naxis = [0.0, 0.6, 0.8]\n\
        [[effect]]\nname = \"hold\"\nkind = \"spring-damper\"\nbodies = [\"one\", \"two\"]\npoints = [[0.8, 0.0, 0.0], [0.8, 0.3, 0.4]]\n\
        stiffness = 400.0\ndamping = 3.0\nfree_length = 0.5\n\
        [[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"asked\"\n\
        [[signal]]\nname = \"turn\"\nkind = \"measure\"\njoint = \"pin\"\ncoordinate = \"turn\"\n\
        [[signal]]\nname = \"speed\"\nkind = \"measure\"\njoint = \"axle\"\nquantity = \"rate\"\n\
        [[signal]]\nname = \"late\"\nkind = \"lag\"\nof = \"turn\"\ntime = 0.05\n\
        [[signal]]\nname = \"asked\"\nkind = \"sum\"\nof = [\"late\", \"speed\"]\nfactors = [-3.0, -0.5]\n\
        [[initial]]\njoint = \"pin\"\nrate = [0.0, 14.0]\n\
        [[output]]\nname = \"angle\"\njoint = \"axle\"\nquantity = \"value\"\n\
        [[output]]\nname = \"given\"\neffect = \"motor\"\nquantity = \"force\"\n\
        [[output]]\nname = \"asked\"\nsignal = \"asked\"\n\
        [[output]]\nname = \"turn\"\nsignal = \"turn\"\n\
        [[output]]\nname = \"pin\"\njoint = \"pin\"\nquantity = \"value\"\n\
        [[output]]\nname = \"power\"\neffect = \"motor\"\nquantity = \"power\"\n\
        [[output]]\nname = \"rate\"\njoint = \"axle\"\nquantity = \"rate\"\n",
        rod("one", "[0.4, 0.0, 0.0]"),
        rod("two", "[0.8, 0.1, 0.3]"),
    )
}

#[test]
fn what_a_motor_gives_is_its_signal_and_turns_are_counted_in_every_formulation() {
    let text = crossed();
    let right = end(&text, Way("recursive", "rk853"), 1e-3, 1.0);
    assert!(right[3].abs() > 7.0, "more than a turn: {right:?}");
    for formulation in TRAPEZOIDAL {
        let way = Way(formulation, "trapezoidal");
        let [coarse, fine] = [1e-3, 5e-4].map(|step| end(&text, way, step, 1.0));
        let [asked, turn] = [fine[2], fine[3]];
        assert!((fine[1] + asked).abs() < 1e-12 * asked.abs(), "{formulation}: {fine:?}");
        // column 5 is the value of the joint, from its slide and its rotation
        assert!((turn - fine[5]).abs() < 1e-9, "{formulation}: {fine:?}");
        let (power, rate) = (fine[6], fine[7]);
        assert!((power - asked * rate).abs() < 1e-9 * power.abs(), "{formulation}: {fine:?}");
        for k in [0, 2, 3] {
            let [before, after] = [coarse[k] - right[k], fine[k] - right[k]].map(f64::abs);
            let order = (before / after).log2();
            assert!(after < 1e-3, "{formulation}, {k}: {after:e}");
            assert!((order - 2.0).abs() < 0.2, "{formulation}, {k}: {before:e}, {after:e}");
        }
    }
}

#[test]
fn the_modes_of_a_servo_are_the_roots_of_its_cubic() {
    let servo = SERVO.replace("value = 0.0\nrate = 0.0", "value = 1.0\nrate = 0.0");
    for dimension in [2, 3] {
        let scene = scene(&wheel(dimension, &servo));
        let modes = Modes::new(&scene, Place::Initial, Search::default()).expect("modes");
        // the eigenvalues are roots of 2 s^3 + 6 s^2 + 40 s + 30 = 0
        let right = [(-0.823_851, 0.0), (-1.088_075, 4.125_927)];
        assert_eq!(modes.modes.len(), right.len(), "{:?}", modes.modes);
        for (mode, (real, imaginary)) in modes.modes.iter().zip(right) {
            let off = (mode.real - real).abs().max((mode.imaginary - imaginary).abs());
            assert!(off < 1e-6, "{mode:?}");
        }
    }
}

#[test]
fn the_servo_arm_ends_at_its_targets_with_the_torques_of_its_weight() {
    let mut scene = mbs_testkit::file("servo-arm");
    let targets = [0.4, 0.3, -0.5, 0.6, 0.5, -0.8];
    scene.outputs.truncate(6);
    let (bodies, n) = (scene.bodies.clone(), scene.bodies.len());
    // the outputs are each body's centre, the point of its joint, and a point a metre further on the joint's axis
    let axes = [
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
    ];
    for (k, body) in bodies.iter().enumerate() {
        let at = scene.joints[k].points[1];
        let further = std::array::from_fn(|i| at[i] + axes[k][i]);
        for (name, at) in [("centre", body.center), ("joint", at), ("axis", further)] {
            let quantity = Quantity::Position { body: BodyId::Body(k), at };
            scene.outputs.push(Output::new(quantity).named(&format!("{name}-{k}")));
        }
    }
    let joints: Vec<_> = (0..n).collect();
    for &k in &joints {
        let signal =
            scene.signals.iter().position(|s| s.name == format!("servo-{}", scene.joints[k].name));
        let signal = mbs::core::scene::SignalId::new(signal.expect("a servo"));
        let quantity = Quantity::SignalValue { signal };
        scene.outputs.push(Output::new(quantity).named(&format!("torque-{k}")));
    }
    for formulation in ["index-3", "recursive"] {
        let rows = rows(&scene, Way(formulation, "trapezoidal"), (2e-3, 6.0), 3000);
        let rows = rows.unwrap_or_else(|e| panic!("{formulation}: {e}"));
        let row = &rows.last().expect("a row").1;
        let point = |body: usize, k: usize| -> [f64; 3] {
            std::array::from_fn(|i| row[n + 9 * body + 3 * k + i])
        };
        for k in joints.iter().copied() {
            assert!((row[k] - targets[k]).abs() < 1e-6, "{formulation}, {k}: {}", row[k]);
            let (place, further) = (point(k, 1), point(k, 2));
            let axis: [f64; 3] = std::array::from_fn(|i| further[i] - place[i]);
            let moment: f64 = (k..n)
                .map(|body| {
                    let arm = std::array::from_fn(|i| point(body, 0)[i] - place[i]);
                    let moment = cross(arm, [0.0, 0.0, -9.81 * bodies[body].mass]);
                    dot(axis, moment)
                })
                .sum();
            let torque = row[n + 9 * n + k];
            // the tolerance is the rest of the motion after six seconds
            assert!((torque + moment).abs() < 1e-3, "{formulation}, {k}: {torque}, {moment}");
        }
    }
}

#[test]
fn an_equilibrium_is_one_of_integrals_and_lags_too() {
    // a torque of 5 N m acts on the wheel: at the target the integral alone balances it
    let push = "[[effect]]\nname = \"push\"\nkind = \"torque\"\njoint = \"axle\"\nsignal = \"late\"\n\
        [[signal]]\nname = \"late\"\nkind = \"lag\"\nof = \"five\"\ntime = 0.3\n\
        [[signal]]\nname = \"five\"\nkind = \"constant\"\nvalue = 5.0\n\
        [[output]]\nname = \"asked\"\nsignal = \"asked\"\n";
    for dimension in [2, 3] {
        let text = wheel(dimension, &format!("{SERVO}{push}"));
        let text = text.replace("duration = 1.0", "duration = 1.0\nstart = \"equilibrium\"");
        for formulation in TRAPEZOIDAL {
            let row = end(&text, Way(formulation, "trapezoidal"), 1e-2, 1.0);
            let off = [row[0] - 1.0, row[1], row[2] + 5.0].map(f64::abs);
            // the search ends at the rounding of its differences
            assert!(off.iter().all(|off| *off < 1e-8), "{dimension}, {formulation}: {row:?}");
        }
    }
    // without an integral the proportional controller yields like a spring: 5 / 40 rad
    for i in ["", "i = 0.0\n"] {
        let servo = SERVO.replace("i = 30.0\n", i);
        let text = wheel(2, &format!("{servo}{push}"));
        let text = text.replace("duration = 1.0", "duration = 1.0\nstart = \"equilibrium\"");
        for formulation in TRAPEZOIDAL {
            let row = end(&text, Way(formulation, "trapezoidal"), 1e-2, 1.0);
            let off = [row[0] - 1.125, row[1], row[2] + 5.0].map(f64::abs);
            assert!(off.iter().all(|off| *off < 1e-8), "{formulation}: {row:?}");
        }
    }
    // an integral of a constant that no motion changes has no equilibrium
    let ramp = asked("\"integral\"\nof = \"five\"", &constant("five", 5.0));
    let text = wheel(
        2,
        &format!(
            "{ramp}[[effect]]\nkind = \"torsion-spring\"\njoint = \"axle\"\nstiffness = 9.0\n"
        ),
    );
    let text = text.replace("duration = 1.0", "duration = 1.0\nstart = \"equilibrium\"");
    let error = rows(&scene(&text), Way("index-3", "trapezoidal"), (1e-2, 1.0), 1);
    let error = error.expect_err("no rest").to_string();
    assert!(error.contains("does not come to rest"), "{error}");
}

/// Wheel with a pin, its angle, and a line from a fixed point over the pin to another fixed point.
struct Line {
    /// Position of the pin at angle zero, and after a quarter revolution [m].
    pin: [[f64; 3]; 2],
    ends: [[f64; 3]; 2],
}

impl Line {
    /// Length of the line at an angle [m], and its derivative with respect to the angle [m/rad].
    fn at(&self, angle: f64) -> [f64; 2] {
        let (sine, cosine) = angle.sin_cos();
        let [x, y] = self.pin;
        let place = [0, 1, 2].map(|i| cosine * x[i] + sine * y[i]);
        let turning = [0, 1, 2].map(|i| cosine * y[i] - sine * x[i]);
        self.ends.iter().fold([0.0; 2], |[length, growth], end| {
            let gap = [0, 1, 2].map(|i| place[i] - end[i]);
            let part = dot(gap, gap).sqrt();
            [length + part, growth + dot(gap, turning) / part]
        })
    }

    /// Angle after `duration` [s] from 0.4 rad and 1 rad/s, by small Runge-Kutta steps. The tension is -90 (L - 1.5) - 4 L', the inertia 2 kg
    /// m^2.
    fn angle_after(&self, duration: f64) -> f64 {
        let rate = |[angle, w]: [f64; 2]| {
            let [length, growth] = self.at(angle);
            [w, (-90.0 * (length - 1.5) - 4.0 * growth * w) / 2.0]
        };
        let (n, mut x) = (20_000, [0.4, 1.0]);
        let h = duration / f64::from(n);
        for _ in 0..n {
            let go = |k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
            let a = rate(x);
            let b = rate(go(a, 0.5 * h));
            let c = rate(go(b, 0.5 * h));
            let d = rate(go(c, h));
            x = [0, 1].map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        x[0]
    }
}

#[test]
fn a_torque_by_the_length_of_a_line_turns_its_wheel_as_the_equation_of_its_angle_says() {
    for dimension in [2, 3] {
        let (pin, ends) = if dimension == 2 {
            let pin = [[0.3, 0.0, 0.0], [0.0, 0.3, 0.0]];
            (pin, [[0.9, 0.2, 0.0], [-0.1, 0.8, 0.0]])
        } else {
            // the pin moves in a plane perpendicular to the axle
            let pin = [[0.24, 0.0, -0.18], [-0.108, 0.24, -0.144]];
            (pin, [[0.9, 0.2, 0.3], [-0.1, 0.8, -0.2]])
        };
        let place = |x: [f64; 3]| format!("{:?}", &x[..dimension]);
        let points = format!(
            "points = [{{ body = \"ground\", at = {} }}, {{ body = \"wheel\", at = {} }}, {{ body = \"ground\", at = {} }}]\n",
            place(ends[0]),
            place(pin[0]),
            place(ends[1])
        );
        let line = format!(
            "[[signal]]\nname = \"length\"\nkind = \"measure\"\n{points}\
             [[signal]]\nname = \"growth\"\nkind = \"measure\"\nquantity = \"rate\"\n{points}\
             {}[[initial]]\njoint = \"axle\"\nvalue = 0.4\nrate = 1.0\n\
             [[output]]\nname = \"length\"\nsignal = \"length\"\n",
            constant("rest", 135.0)
        );
        let sum = "\"sum\"\nof = [\"length\", \"growth\", \"rest\"]\nfactors = [-90.0, -4.0, 1.0]";
        let text = wheel(dimension, &asked(sum, &line));
        let line = Line { pin, ends };
        let right = line.angle_after(1.0);
        meets(&text, (1.0, right), 1e-4);
        let found = end(&text, Way("recursive", "rk853"), 1e-3, 1.0);
        assert!((found[2] - line.at(right)[0]).abs() < 2e-9, "{}", found[2]);
    }
}

#[test]
fn the_swing_of_a_ball_is_measured_by_each_formulation() {
    // a ball with equal moments of inertia turns about (0.48, 0.6, 0.64), perpendicular to the axis of the swing
    let text = "[scene]\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, 0.0]\n\
        [[body]]\nname = \"ball\"\nmass = 1.0\ncenter = [0.0, 0.0, 0.0]\ninertia = [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]\n\
        [[joint]]\nname = \"socket\"\nkind = \"spherical\"\nbodies = [\"ground\", \"ball\"]\nat = [0.0, 0.0, 0.0]\n\
        [[initial]]\nbody = \"ball\"\nangular_velocity = [0.96, 1.2, 1.28]\n\
        [[signal]]\nname = \"swing\"\nkind = \"measure\"\njoint = \"socket\"\ncoordinate = \"swing\"\naxis = [0.8, 0.0, -0.6]\n\
        [[signal]]\nname = \"speed\"\nkind = \"measure\"\njoint = \"socket\"\ncoordinate = \"swing\"\naxis = [0.8, 0.0, -0.6]\nquantity = \"rate\"\n\
        [[output]]\nname = \"swing\"\nsignal = \"swing\"\n[[output]]\nname = \"speed\"\nsignal = \"speed\"\n";
    for formulation in TRAPEZOIDAL {
        let found = end(text, Way(formulation, "trapezoidal"), 1e-3, 1.0);
        assert!((found[0] - 2.0).abs() < 1e-6, "{formulation}: {}", found[0]);
        assert!((found[1] - 2.0).abs() < 1e-6, "{formulation}: {}", found[1]);
    }
    let twist = text.replace("\"swing\"\naxis", "\"twist\"\naxis");
    let refused = SceneFile::parse(&twist, "t").and_then(|file| file.scene::<f64>().map(|_| ()));
    let message = refused.expect_err("it has no value everywhere").to_string();
    let says = "`coordinate` has no value where the swing is half a turn";
    assert!(message.contains(says), "{message}");
}
