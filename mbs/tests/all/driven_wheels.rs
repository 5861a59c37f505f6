//! Driven and braked wheels, against closed forms in every formulation.

use crate::common::oracle::{TRAPEZOIDAL, Way, rows};
use mbs_testkit::scene;

/// Radius [m], height of the hub [m] and radial stiffness [N/m]: with a deflection of 20 mm the wheel carries 4 kN.
const TIRE: [f64; 3] = [0.32, 0.3, 2e5];
const LOAD: f64 = 4000.0;
/// Mass of car and wheel [kg], and the wheel's inertia [kg m^2].
const MASSES: [f64; 3] = [380.0, 20.0, 1.1];

/// Scene of a car on a rail along x, with its wheel pressed on the road: planar, or in space with y as the wheel's axis.
fn car(dimension: usize, slip: &str, speed: f64, rate: f64, rest: &str) -> String {
    let [radius, height, stiffness] = TIRE;
    let [car, wheel, inertia] = MASSES;
    let (hub, along, axis, inertias) = if dimension == 2 {
        (
            format!("[0.0, {height}]"),
            "[1.0, 0.0]",
            String::new(),
            ["1.0".into(), format!("{inertia:?}")],
        )
    } else {
        (
            format!("[0.0, 0.0, {height}]"),
            "[1.0, 0.0, 0.0]",
            "axis = [0.0, 1.0, 0.0]\n".to_owned(),
            [
                "[1.0, 1.0, 1.0, 0.0, 0.0, 0.0]".into(),
                format!("[0.7, {inertia:?}, 0.7, 0.0, 0.0, 0.0]"),
            ],
        )
    };
    let [inertia_of_car, inertia_of_wheel] = &inertias;
    format!(
        "[scene]\nname = \"car\"\ndimension = {dimension}\nduration = 4.0\n\
        [[body]]\nname = \"car\"\nmass = {car:?}\ncenter = {hub}\ninertia = {inertia_of_car}\n\
        [[body]]\nname = \"wheel\"\nmass = {wheel:?}\ncenter = {hub}\ninertia = {inertia_of_wheel}\n\
        [[joint]]\nname = \"rail\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"car\"]\nat = {hub}\naxis = {along}\n\
        [[joint]]\nname = \"hub\"\nkind = \"revolute\"\nbodies = [\"car\", \"wheel\"]\nat = {hub}\n{axis}\
        [[effect]]\nkind = \"tire\"\nbody = \"car\"\ncenter = {hub}\nradius = {radius:?}\n\
        stiffness = {stiffness:?}\nspin = \"hub\"\nlongitudinal = {slip}\n\
        [[initial]]\njoint = \"rail\"\nrate = {speed:?}\n[[initial]]\njoint = \"hub\"\nrate = {rate:?}\n\
        [[output]]\nname = \"x\"\njoint = \"rail\"\nquantity = \"value\"\n\
        [[output]]\nname = \"v\"\njoint = \"rail\"\nquantity = \"rate\"\n\
        [[output]]\nname = \"w\"\njoint = \"hub\"\nquantity = \"rate\"\n{rest}"
    )
}

/// Last row of a run by each formulation.
fn ends(text: &str, step: f64, duration: f64) -> Vec<(Way, Vec<f64>)> {
    let run = |formulation| {
        let way = Way(formulation, "trapezoidal");
        let rows = rows(&scene(text), way, (step, duration), 1000);
        let rows = rows.unwrap_or_else(|e| panic!("{way:?}: {e}"));
        (way, rows.last().expect("a row").1.to_vec())
    };
    TRAPEZOIDAL.map(run).to_vec()
}

/// Fraction of the largest friction force at the normalised slip r: 1 - (1 - r/3)^3 up to r = 3.
fn share(r: f64) -> f64 {
    if r < 3.0 { 1.0 - (1.0 - r / 3.0).powi(3) } else { 1.0 }
}

#[test]
fn locked_wheels_stop_where_friction_and_the_slip_near_rest_say() {
    let (friction, stiffness, from) = (0.8, 6e4, 10.0);
    let brake = "[[effect]]\nname = \"brake\"\nkind = \"friction\"\njoint = \"hub\"\ncoulomb = 2000.0\nsignal = \"pedal\"\n\
        [[signal]]\nname = \"pedal\"\nkind = \"constant\"\nvalue = 1.0\n";
    let slip = format!("{{ stiffness = {stiffness:?}, friction = {friction:?} }}");
    let most = friction * LOAD;
    let mass = MASSES[0] + MASSES[1];
    // the distance x is the integral of v / a(v) over the speed v, with a = force / mass, by the midpoint rule; its error is 1e-8 m
    let force = |v: f64| most * share(stiffness * v / v.hypot(0.1) / most);
    let n = 400_000;
    let h = from / f64::from(n);
    let x: f64 = (0..n).map(|i| (f64::from(i) + 0.5) * h).map(|v| mass * v / force(v) * h).sum();
    // with full friction up to the end, the braking distance would be v^2 mass / (2 most)
    assert!((x - 6.25).abs() < 2e-3 && x > 6.25, "{x}");
    for dimension in [2, 3] {
        let text = car(dimension, &slip, from, 0.0, brake);
        for (way, row) in ends(&text, 1e-3, 3.0) {
            // the limit covers the error of the step, and the brake's slip: 1e-3 rad/s times the radius
            assert!((row[0] - x).abs() < 1e-3, "{dimension}, {way:?}: {row:?}, not {x}");
            assert!(row[1].abs() < 1e-3, "{dimension}, {way:?}: {row:?}");
        }
    }
}

#[test]
fn a_torque_on_a_wheel_with_stiff_slip_drives_the_car() {
    let (torque, from) = (180.0, 5.0);
    let drive = format!("[[effect]]\nkind = \"torque\"\njoint = \"hub\"\nvalue = {torque:?}\n");
    let [radius, ..] = TIRE;
    let (mass, inertia) = (MASSES[0] + MASSES[1], MASSES[2]);
    let a = torque * radius / (mass * radius * radius + inertia);
    for dimension in [2, 3] {
        // a wheel that rolls to +x turns backward about z, and forward about y
        let sign = if dimension == 2 { -1.0 } else { 1.0 };
        let drive = drive.replace("180.0", &format!("{:?}", sign * torque));
        let slip = "{ stiffness = 4e7, friction = 0.8 }";
        let text = car(dimension, slip, from, sign * from / radius, &drive);
        for (way, row) in ends(&text, 1e-3, 1.0) {
            // the slip is force over stiffness, 2e-5 of 5 m/s
            let v = from + a;
            assert!((row[1] - v).abs() < 2e-5 * v, "{dimension}, {way:?}: {row:?}, not {v}");
            assert!((sign * row[2] * radius - v).abs() < 5e-5 * v, "{dimension}, {way:?}: {row:?}");
        }
    }
}

#[test]
fn a_brake_by_a_signal_slows_a_wheel_by_its_impulse() {
    // a wheel of 1.1 kg m^2 at 40 rad/s; 10 N m times a ramp of the pedal over a second give 5 N m s
    let text = "[scene]\nname = \"b\"\ndimension = 2\nduration = 1.0\n\
        [[body]]\nname = \"w\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 1.1\n\
        [[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"w\"]\nat = [0.0, 0.0]\n\
        [[effect]]\nkind = \"friction\"\njoint = \"a\"\ncoulomb = 10.0\nTABLE\n\
        [[initial]]\njoint = \"a\"\nrate = 40.0\n\
        [[output]]\nname = \"rate\"\njoint = \"a\"\nquantity = \"rate\"\n";
    let tables = [
        ("table = [[0.0, 0.0], [1.0, 1.0]]", 5.0),
        // a negative signal counts as zero
        ("table = [[0.0, -1.0], [0.5, -1.0], [0.5000001, 1.0], [1.0, 1.0]]", 5.0),
        ("value = 0.5", 5.0),
        ("value = -1.0", 0.0),
    ];
    for (table, impulse) in tables {
        for (way, row) in ends(&text.replace("TABLE", table), 1e-3, 1.0) {
            let rate = 40.0 - impulse / 1.1;
            // the tolerance is the impulse of a jump within a step of 1 ms
            assert!((row[0] - rate).abs() < 1e-2, "{table}, {way:?}: {row:?}, not {rate}");
        }
    }
}

/// Time [s], position of the car [m] and its speed [m/s] in `drive-and-brake`; the scene explains them.
const REFERENCE: [(f64, [f64; 3]); 4] = [
    (2.0, [2.382_934_017, 0.539_398_417, 3.762_536_568]),
    (4.0, [15.054_902_573, 0.539_398_947, 7.531_235_032]),
    (5.0, [20.245_176_341, 0.539_398_993, 2.338_545_690]),
    (6.0, [20.716_675_344, 0.539_397_975, -0.006_871_324]),
];

/// Largest difference from the reference at its times.
fn away(formulation: &'static str, integrator: &'static str, step: f64) -> f64 {
    let scene = mbs_testkit::file("drive-and-brake");
    let rows =
        rows(&scene, Way(formulation, integrator), (step, 6.0), (0.5 / step).round() as usize)
            .unwrap_or_else(|e| panic!("{formulation} {integrator}: {e}"));
    let of = |(time, reference): &(f64, [f64; 3])| {
        let row = rows.iter().find(|(t, _)| (t - time).abs() < 1e-9).expect("a row");
        let [x, y, speed] = [row.1[0], row.1[1], row.1[2]];
        [x - reference[0], y - reference[1], speed - reference[2]].map(f64::abs)
    };
    REFERENCE.iter().flat_map(of).fold(0.0, f64::max)
}

#[test]
fn a_car_that_drives_and_brakes_follows_equations_derived_apart_with_order_2() {
    // the limit covers the digits of the reference and the error of the step control
    let error = away("recursive", "radau5", 1e-3);
    assert!(error < 5e-8, "{error}");
    for formulation in TRAPEZOIDAL {
        let [coarse, fine] = [1e-3, 5e-4].map(|step| away(formulation, "trapezoidal", step));
        // natural coordinates rotate directions, whose errors at 25 rad/s are a hundred times those of angles
        assert!(coarse < 5e-5, "{formulation}: {coarse}");
        assert!((3.6..4.4).contains(&(coarse / fine)), "{formulation}: {coarse} {fine}");
    }
}
