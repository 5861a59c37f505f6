//! Elastic ropes over points, slack and taut, against independent equations, and stops where a part vanishes, in every formulation.

use crate::common::oracle::{WAYS, Way, agree_in_the_limit, outputs_of, rows, run};
use mbs::{Body, Effect, Error, FormulationKind, GROUND, Joint, Mechanism, Method, Run};
use mbs_testkit::scene;

/// Masses on both ends [kg].
const MASSES: [f64; 2] = [3.0, 2.0];
/// Stiffness [N/m] and damping [N s/m] of the rope.
const LAW: [f64; 2] = [2000.0, 8.0];
/// Slack of the rope in the reference configuration [m].
const SLACK: f64 = 0.05;
const GRAVITY: f64 = 9.81;

/// Scene of two masses on vertical slides below two points of the ground, 1 m apart. The second mass is `below` its point [m].
fn atwood(below: f64, rest: &str) -> String {
    let mut text = format!(
        "[scene]\nname = \"a\"\ndimension = 2\nduration = 2.0\ngravity = [0.0, -{GRAVITY:?}]\n"
    );
    for (i, (mass, depth)) in MASSES.iter().zip([2.0, below]).enumerate() {
        let at = format!("[{i}.0, {:?}]", 1.0 - depth);
        text += &format!(
            "[[body]]\nname = \"b{i}\"\nmass = {mass:?}\ncenter = {at}\ninertia = 0.1\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"b{i}\"]\nat = {at}\naxis = [0.0, 1.0]\n\
             [[output]]\nname = \"way-{i}\"\njoint = \"j{i}\"\nquantity = \"value\"\n\
             [[output]]\nname = \"rate-{i}\"\njoint = \"j{i}\"\nquantity = \"rate\"\n"
        );
    }
    text + rest
}

/// Text of the line from the first mass over both points to the second.
fn line(below: f64) -> String {
    format!(
        "points = [{{ body = \"b0\", at = [0.0, -1.0] }}, {{ body = \"ground\", at = [0.0, 1.0] }}, \
         {{ body = \"ground\", at = [1.0, 1.0] }}, {{ body = \"b1\", at = [1.0, {:?}] }}]\n",
        1.0 - below
    )
}

/// Tension of the rope from its stretch and its rate. The damper acts gradually over the first millimetre.
fn tension(stretch: f64, rate: f64) -> f64 {
    if stretch <= 0.0 {
        return 0.0;
    }
    let r = (stretch / 1e-3).min(1.0);
    (LAW[0] * stretch + LAW[1] * r * r * (3.0 - 2.0 * r) * rate).max(0.0)
}

/// Displacements and rates of both masses, from two independent equations by the classical Runge-Kutta method.
fn ode(duration: f64, slack: f64) -> [f64; 4] {
    let slope = |[y0, y1, v0, v1]: [f64; 4]| {
        let f = tension(-y0 - y1 - slack, -v0 - v1);
        [v0, v1, f / MASSES[0] - GRAVITY, f / MASSES[1] - GRAVITY]
    };
    let n = 200_000;
    let h = duration / f64::from(n);
    let add = |x: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| x[i] + h * k[i]);
    (0..n).fold([0.0; 4], |x, _| {
        let a = slope(x);
        let b = slope(add(x, a, 0.5 * h));
        let c = slope(add(x, b, 0.5 * h));
        let d = slope(add(x, c, h));
        let mean = core::array::from_fn(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        add(x, mean, h)
    })
}

/// Error of displacements of a metre with steps of 0.1 ms [m]: corners of the law, and (w h)^2 of the oscillation at 40 rad/s.
const ROUGH: f64 = 2e-5;

#[test]
fn two_masses_on_an_elastic_rope_fall_slack_and_are_caught() {
    let rope = format!(
        "[[effect]]\nname = \"e\"\nkind = \"spring-damper\"\n{}stiffness = {:?}\ndamping = {:?}\npulls_only = true\nfree_length = {:?}\n{}",
        line(3.0),
        LAW[0],
        LAW[1],
        2.0 + 1.0 + 3.0 + SLACK,
        outputs_of("e").replace("power", "contact")
    );
    let (text, duration) = (atwood(3.0, &rope), 0.6);
    let expected = ode(duration, SLACK);
    for way in WAYS {
        let rows = run(&text, way, (1e-4, duration));
        for (t, row) in &rows {
            let [y0, y1, v0, v1] = [row[0], row[2], row[1], row[3]];
            // columns 4 and 5 are the total length of the rope and its rate
            assert!((row[4] - (6.0 - y0 - y1)).abs() < 1e-11, "{way:?}, {t}: {row:?}");
            assert!((row[5] + v0 + v1).abs() < 1e-9, "{way:?}, {t}: {row:?}");
            let stretch = row[4] - 6.0 - SLACK;
            let force = tension(stretch, row[5]);
            assert!((row[6] - force).abs() < 1e-6, "{way:?}, {t}: {row:?} {force}");
            let energy = 0.5 * LAW[0] * stretch.max(0.0) * stretch.max(0.0);
            assert!((row[7] - energy).abs() < 1e-6, "{way:?}, {t}: {row:?} {energy}");
            assert_eq!(row[8] > 0.5, stretch > 0.0, "{way:?}, {t}: {row:?}");
            if stretch < 0.0 && *t < 0.07 {
                // both masses fall freely until the rope is taut at sqrt(0.05 / 9.81) s
                assert!((y0 + 0.5 * GRAVITY * t * t).abs() < 1e-9, "{way:?}, {t}: {row:?}");
            }
        }
        let taut = rows.iter().filter(|(_, row)| row[8] > 0.5).count();
        assert!(taut > 1000 && taut < rows.len() - 1000, "{way:?}: {taut} of {}", rows.len());
        let end = &rows.last().expect("a row").1;
        for (i, expected) in [expected[0], expected[2], expected[1], expected[3]].iter().enumerate()
        {
            let most = if i % 2 == 0 { ROUGH } else { 100.0 * ROUGH };
            assert!((end[i] - expected).abs() < most, "{way:?}, {i}: {} {expected}", end[i]);
        }
    }
}

#[test]
fn a_taut_rope_over_two_points_oscillates_about_the_motion_of_a_rigid_one() {
    // the stretch e has the equation e'' = 2 g - w^2 e, from rest without stretch
    let mobility = MASSES.iter().map(|m| 1.0 / m).sum::<f64>();
    let omega = (LAW[0] * mobility).sqrt();
    let rope = format!(
        "[[effect]]\nname = \"e\"\nkind = \"spring-damper\"\n{}stiffness = {:?}\n{}",
        line(3.0),
        LAW[0],
        outputs_of("e")
    );
    let text = atwood(3.0, &rope);
    for way in WAYS {
        for (t, row) in run(&text, way, (1e-4, 0.5)).iter().step_by(100) {
            let e = 2.0 * GRAVITY / (omega * omega) * (1.0 - (omega * t).cos());
            assert!((row[4] - 6.0 - e).abs() < ROUGH, "{way:?}, {t}: {} {e}", row[4]);
            // the first mass is displaced by -g t^2/2 plus k/m times the double integral of e
            let twice = 2.0 * GRAVITY / (omega * omega)
                * (0.5 * t * t - (1.0 - (omega * t).cos()) / (omega * omega));
            let y = -0.5 * GRAVITY * t * t + LAW[0] / MASSES[0] * twice;
            assert!((row[0] - y).abs() < ROUGH, "{way:?}, {t}: {} {y}", row[0]);
        }
    }
}

#[test]
fn a_polynomial_and_a_given_force_act_along_lines_too() {
    let duration = 0.4;
    // 50 N along the rope raise the lighter mass
    let winch =
        format!("[[effect]]\nname = \"e\"\nkind = \"actuator\"\n{}value = -25.0\n", line(3.0));
    let spring = format!(
        "[[effect]]\nname = \"e\"\nkind = \"polynomial-spring\"\n{}coefficients = [[0.0, 9.0, -{:?}, {:?}]]\n",
        line(3.0),
        6.0 * LAW[0],
        LAW[0]
    );
    let linear = format!(
        "[[effect]]\nname = \"e\"\nkind = \"spring-damper\"\n{}stiffness = {:?}\nfree_length = 6.0\n",
        line(3.0),
        LAW[0]
    );
    for way in WAYS {
        let rows = run(&atwood(3.0, &winch), way, (1e-3, duration));
        let end = &rows.last().expect("a row").1;
        for (i, mass) in MASSES.iter().enumerate() {
            let way_of_mass = 0.5 * (25.0 / mass - GRAVITY) * duration * duration;
            assert!((end[2 * i] - way_of_mass).abs() < 1e-9, "{way:?}: {end:?} {way_of_mass}");
        }
        let [one, other] =
            [&spring, &linear].map(|rope| run(&atwood(3.0, rope), way, (1e-3, duration)));
        for (a, b) in one.iter().zip(&other) {
            let error = a.1.iter().zip(&b.1).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1e-8, "{way:?}, {}: {error}", a.0);
        }
    }
}

#[test]
fn a_part_that_is_passed_stops_a_taut_rope_by_name_and_not_a_slack_one() {
    // the lighter mass is pulled to its point, whatever the rate of the other rope
    for (way, slack) in WAYS.iter().flat_map(|way| [(*way, false), (*way, true)]) {
        let rope = format!(
            "[[effect]]\nname = \"hoist\"\nkind = \"spring-damper\"\n{}stiffness = 50000.0\npulls_only = true\nfree_length = {:?}\n",
            line(0.5),
            if slack { 9.0 } else { 3.5 }
        );
        // the masses move as on an inextensible rope, by given forces
        let lift =
            "[[effect]]\nkind = \"force\"\nbody = \"b1\"\nat = [1.0, 0.5]\nvalue = [0.0, 50.0]\n";
        let text = atwood(0.5, &format!("{rope}{}", if slack { lift } else { "" }));
        let duration = if slack { 0.4 } else { 1.0 };
        let result = rows(&scene(&text), way, (1e-3, duration), 1);
        match (slack, result) {
            (true, Ok(rows)) => {
                let end = rows.last().expect("a row").1[2];
                assert!((end - 0.5 * (25.0 - GRAVITY) * 0.16).abs() < 1e-6, "{way:?}: {end}");
            }
            (false, Err(stop)) => {
                assert_eq!(stop.code(), "rope-collapsed", "{way:?}: {stop}");
            }
            (_, result) => panic!("{way:?}, slack {slack}: {:?}", result.map(|rows| rows.len())),
        }
    }
}

#[test]
fn the_message_names_effect_part_and_bodies() {
    let mut m = Mechanism::planar("atwood");
    m.set_gravity([0.0, -GRAVITY]).set_duration(2.0);
    let [heavy, light] = [([0.0, -1.0], MASSES[0]), ([1.0, 0.5], MASSES[1])]
        .map(|(at, mass)| m.add(Body::planar(at, mass, 0.1)));
    for (body, at, name) in [(heavy, [0.0, -1.0], "down"), (light, [1.0, 0.5], "up")] {
        m.add(Joint::prismatic([GROUND, body], at).along([0.0, 1.0]).named(name));
    }
    let points =
        [(heavy, [0.0, -1.0]), (GROUND, [0.0, 1.0]), (GROUND, [1.0, 1.0]), (light, [1.0, 0.5])];
    m.add(Effect::rope(points, 50_000.0, 0.0).named("hoist"));
    for kind in FormulationKind::listed() {
        let method = Method { step: Some(1e-3), ..Method::new(kind) };
        let result = mbs::run(&m, &Run::new().method(method)).expect("it starts");
        let stop = result.stop().unwrap_or_else(|| panic!("{} does not stop", kind.name()));
        assert_eq!(stop.code(), "rope-collapsed", "{}: {stop}", kind.name());
        let message = stop.to_string();
        for part in ["`hoist`", "from `ground` to `body-2`", "part 3", "no length left"] {
            assert!(message.contains(part), "{}: {message}", kind.name());
        }
    }
}

/// Scene of a spatial crane: a load on a rope over a trolley's point and a sheave, with a winch that pulls the rope in. Its laws are smooth
/// while the stay is taut.
fn crane() -> String {
    let body = |name: &str, at: [f64; 3], mass: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {at:?}\ninertia = [0.3, 0.26, 0.35, 0.02, 0.01, 0.03]\n"
        )
    };
    let joint = |name: &str, kind: &str, second: &str, at: [f64; 3], axis: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"{kind}\"\nbodies = [\"ground\", \"{second}\"]\nat = {at:?}\n{axis}\
             [[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"rate\"\n"
        )
    };
    [
        "[scene]\nname = \"crane\"\ndimension = 3\nduration = 0.4\ngravity = [0.0, 0.0, -9.81]\n".to_owned(),
        body("trolley", [0.0, 0.1, 3.0], 4.0),
        body("load", [0.3, 0.2, 1.0], 3.0),
        body("winch", [-1.0, 0.0, 2.5], 1.0),
        joint("rail", "prismatic", "trolley", [0.0, 0.0, 3.0], "axis = [1.0, 0.2, 0.1]\n"),
        joint("way", "free", "load", [0.3, 0.2, 1.0], ""),
        joint("drum", "revolute", "winch", [-1.0, 0.0, 2.5], "axis = [0.1, 1.0, 0.2]\n"),
        "[[effect]]\nname = \"rope\"\nkind = \"spring-damper\"\nstiffness = 100.0\ndamping = 5.0\nfree_value = -0.25\n\
         terms = [{ points = [{ body = \"load\", at = [0.35, 0.2, 1.1] }, { body = \"trolley\", at = [0.1, 0.0, 2.9] }, { body = \"ground\", at = [-0.9, 0.1, 2.9] }] }, { joint = \"drum\", factor = 0.2 }]\n"
            .to_owned(),
        "[[effect]]\nname = \"stay\"\nkind = \"spring-damper\"\npulls_only = true\nstiffness = 30.0\nfree_length = 2.5\n\
         points = [{ body = \"load\", at = [0.2, 0.1, 0.9] }, { body = \"winch\", at = [-1.0, 0.1, 2.4] }, { body = \"trolley\", at = [0.0, 0.1, 3.1] }]\n"
            .to_owned(),
        "[[initial]]\nbody = \"load\"\nangular_velocity = [0.3, -0.2, 0.4]\n".to_owned(),
        outputs_of("rope"),
        outputs_of("stay").replace("power", "contact"),
    ]
    .concat()
}

#[test]
fn natural_and_relative_coordinates_agree_on_ropes_to_eight_digits() {
    for way in [Way("index-3", "trapezoidal"), Way("recursive", "trapezoidal")] {
        agree_in_the_limit(&scene(&crane()), way, (1e-3, 0.2, 40), 1e-8, |row| {
            assert!(row[row.len() - 1] > 0.5, "taut: {row:?}");
        });
    }
}
