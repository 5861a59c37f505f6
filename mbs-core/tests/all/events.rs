//! Events of prescribed motions: steps end at kinks of laws, such as stops, wheels on roads, and springs in pieces.

mod given;

use given::Given;
use mbs_core::laws::guide::{spline, spline_curvatures};
use mbs_core::laws::road::Feature;
use mbs_core::laws::road_contact::road_contact;
use mbs_core::laws::{LawInputs, Part};

/// Planar scene with one body that slides along x, and starts at zero.
fn slider(effects: &str) -> String {
    format!(
        r#"
[scene]
name = "slider"
dimension = 2
duration = 1.0
[[body]]
name = "mass"
mass = 2.0
center = [0.0, 0.0]
inertia = 0.1
[[joint]]
name = "guide"
kind = "prismatic"
bodies = ["ground", "mass"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
{effects}"#
    )
}

/// Bumper that pushes for x < 0. Its points are two metres apart.
const BUMPER: &str = r#"
[[effect]]
name = "stop"
kind = "bumper"
bodies = ["ground", "mass"]
points = [[-2.0, 0.0], [0.0, 0.0]]
stiffness = 5000.0
clearance = 0.0
"#;

/// Motion x = a sin(w t), which is zero every half period.
fn swing(a: f64, w: f64) -> impl Fn(f64) -> Vec<[[f64; 3]; 2]> {
    move |t: f64| {
        let (sin, cos) = (w * t).sin_cos();
        vec![[[a * sin, 0.0, 0.0], [a * w * cos, 0.0, 0.0]]]
    }
}

/// Allowed error of event times [s]. The band of a gap is 1e-9 of a few metres, and is passed at rates above 0.1 m/s.
const INSTANT: f64 = 1e-7;

#[test]
fn steps_end_at_every_touch_and_parting_of_a_bumper_once() {
    let course = swing(0.4, 2.0);
    for h in [0.3, 0.07, 0.011] {
        let mut given = Given::<f64, 2>::new(&slider(BUMPER), &course);
        // The contact at the start is no event. 20 s are 12.7 half periods.
        let landings = given.run([0.0, 20.0], h);
        assert_eq!(landings.len(), 12, "{h}: {landings:?}");
        for (k, landing) in (1..).zip(&landings) {
            let exact = f64::from(k) * core::f64::consts::PI / 2.0;
            assert!((landing.t - exact).abs() < INSTANT, "{h}: {landing:?} for {exact}");
            assert!(landing.trials <= 4, "{h}: {landing:?}");
        }
    }
}

#[test]
fn single_precision_lands_within_its_own_rounding() {
    let course = swing(0.4, 2.0);
    let mut given = Given::<f32, 2>::new(&slider(BUMPER), &course);
    let landings = given.run([0.0, 5.0], 0.05);
    assert_eq!(landings.len(), 3, "{landings:?}");
    for (k, landing) in (1..).zip(&landings) {
        let exact = f64::from(k) * core::f64::consts::PI / 2.0;
        // 128 roundings of single precision (1e-7) of two metres, at 0.8 m/s.
        assert!((landing.t - exact).abs() < 1e-4, "{landing:?} for {exact}");
    }
}

#[test]
fn a_dip_into_a_bumper_within_one_step_is_found_and_a_touch_within_the_band_is_not() {
    // x = (t - 0.5)^2 - dip
    for (dip, n) in [(1e-2, 2), (1e-6, 2), (1e-10, 0), (-1e-3, 0)] {
        let course = move |t: f64| {
            vec![[[(t - 0.5) * (t - 0.5) - dip, 0.0, 0.0], [2.0 * (t - 0.5), 0.0, 0.0]]]
        };
        let landings = Given::<f64, 2>::new(&slider(BUMPER), &course).run([0.0, 1.0], 1.0);
        assert_eq!(landings.len(), n, "{dip}: {landings:?}");
        for (landing, sign) in landings.iter().zip([-1.0, 1.0]) {
            let exact = 0.5 + sign * f64::max(dip, 0.0).sqrt();
            // The less deep dip has a rate of 2e-3 m/s at its events.
            assert!((landing.t - exact).abs() < 100.0 * INSTANT, "{dip}: {landing:?}");
        }
    }
}

#[test]
fn the_earliest_of_several_ends_a_step_and_the_others_follow() {
    let effects = format!(
        "{BUMPER}{}",
        r#"
[[effect]]
name = "stops"
kind = "limit"
joint = "guide"
lower = -0.2
upper = 0.3
stiffness = 1000.0
[[effect]]
name = "spring"
kind = "polynomial-spring"
bodies = ["ground", "mass"]
points = [[-2.0, 0.0], [0.0, 0.0]]
coefficients = [[1.0, 1.9, 0.0, 100.0], [1.9, 2.25, -190.0, 200.0], [2.25, 3.0, -190.0, 200.0]]
"#
    );
    let course = swing(0.4, -1.0);
    let landings = Given::<f64, 2>::new(&slider(&effects), &course).run([0.0, 6.5], 0.9);
    // Order: kink of the spring and lower stop, both again on the way back, then bumper and upper stop, and both again.
    let expected = [
        (0.25_f64.asin(), 2),
        (0.5_f64.asin(), 1),
        (core::f64::consts::PI - 0.5_f64.asin(), 1),
        (core::f64::consts::PI - 0.25_f64.asin(), 2),
        (core::f64::consts::PI, 0),
        (core::f64::consts::PI + 0.75_f64.asin(), 1),
        (core::f64::consts::TAU - 0.75_f64.asin(), 1),
        (core::f64::consts::TAU, 0),
    ];
    assert_eq!(landings.len(), expected.len(), "{landings:?}");
    for (landing, (t, effect)) in landings.iter().zip(expected) {
        assert!((landing.t - t).abs() < INSTANT && landing.effect == effect, "{landing:?} at {t}");
    }
}

#[test]
fn an_angle_of_a_hinge_meets_its_stops() {
    let text = r#"
[scene]
name = "hinge"
dimension = 2
duration = 1.0
[[body]]
name = "arm"
mass = 2.0
center = [0.0, 0.0]
inertia = 0.1
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.0, 0.0]
[[effect]]
name = "stops"
kind = "limit"
joint = "hinge"
lower = -0.5
upper = 0.5
stiffness = 10.0
"#;
    let course = |t: f64| vec![[[0.0, 0.0, t.sin()], [0.0, 0.0, t.cos()]]];
    let landings = Given::<f64, 2>::new(text, &course).run([0.0, 6.2], 0.4);
    let sixth = core::f64::consts::PI / 6.0;
    assert_eq!(landings.len(), 4, "{landings:?}");
    for (landing, k) in landings.iter().zip([1.0, 5.0, 7.0, 11.0]) {
        assert!((landing.t - k * sixth).abs() < INSTANT, "{landing:?}");
    }
}

/// Points of the table in the road of the tests.
const TABLE: [[f64; 2]; 4] = [[8.0, 0.0], [8.5, 0.05], [9.0, 0.06], [9.5, 0.1]];

/// Scene of a wheel with a radius of 0.5 m at (0, 0.4), on a road with every kind of feature.
fn wheel(speed: f64) -> String {
    format!(
        r#"
[scene]
name = "wheel"
dimension = 2
duration = 1.0
[[body]]
name = "mass"
mass = 20.0
center = [0.0, 0.4]
inertia = 0.5
[road]
speed = {speed:?}
features = [
    {{ kind = "ramp", start = 1.0, length = 2.0, height = 0.2, rounding = 0.5 }},
    {{ kind = "bump", start = 4.0, length = 3.0, amplitude = 0.04 }},
    {{ kind = "table", points = {TABLE:?} }},
]
[[effect]]
name = "tire"
kind = "tire"
body = "mass"
center = [0.0, 0.4]
radius = 0.5
stiffness = 80000.0
"#
    )
}

/// Position x of the contact point of a wheel whose centre is at (x, z) over this road [m].
fn foot_of([x, z]: [f64; 2]) -> f64 {
    let features = [
        Feature::Rise { start: 1.0, length: 2.0, height: 0.2, rounding: 0.5 },
        Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.04 },
    ];
    let law_inputs = LawInputs { features: &features, ..LawInputs::courses(&[]) };
    let at = road_contact(Part { first: 0, n: 2 }, &law_inputs, [x, z]);
    x - at.normal[0] * at.distance
}

/// Height of the wheel's centre and its slope. It rises with the road, so that the wheel stays pressed in.
fn height_at(x: f64) -> [f64; 2] {
    let (sin, cos) = (0.6 * x).sin_cos();
    [0.42 + 0.02 * x + 0.01 * sin, 0.02 + 0.006 * cos]
}

#[test]
fn a_wheel_that_rolls_ends_its_steps_where_its_foot_passes_the_kinks_of_the_road() {
    for (speed, h) in [(0.0, 0.2), (2.0, 0.35), (0.0, 0.9)] {
        // Either the wheel moves over the ground, or the ground moves under it.
        let course = move |t: f64| {
            let x = 2.0 * t;
            let [z, slope] = height_at(x);
            let along = if speed > 0.0 { [0.0, 0.0] } else { [x, 2.0] };
            vec![[[along[0], z, 0.0], [along[1], 2.0 * slope, 0.0]]]
        };
        let landings = Given::<f64, 2>::new(&wheel(speed), &course).run([0.0, 3.8], h);
        let places = [1.0, 1.5, 2.5, 3.0, 4.0, 7.0];
        assert_eq!(landings.len(), places.len(), "{speed} {h}: {landings:?}");
        for (landing, place) in landings.iter().zip(places) {
            let x = 2.0 * landing.t;
            let u = foot_of([x, height_at(x)[0]]);
            assert!((u - place).abs() < 2.0 * INSTANT, "{speed} {h}: {u} for {place}");
            assert!(landing.trials <= 4, "{landing:?}");
        }
    }
}

#[test]
fn a_wheel_passes_the_ends_of_a_table_once_in_a_hollow_and_twice_on_a_crest() {
    let (table, mut curvatures, mut scratch) = (TABLE, [0.0; 4], [0.0; 4]);
    spline_curvatures(&table, &mut curvatures, &mut scratch);
    let [first, last] = [8.0, 9.5].map(|x| spline(&table, &curvatures, x).rate);
    // The ramp has a height of 0.2 m, to which the table adds 0.1 m.
    let z = 0.65;
    let course = move |t: f64| vec![[[7.0 + 2.0 * t, z, 0.0], [2.0, 0.0, 0.0]]];
    let landings = Given::<f64, 2>::new(&wheel(0.0), &course).run([0.1, 2.0], 0.13);
    let expected = [8.0 - (z - 0.2) * (0.5 * first.atan()).tan(), 9.5 - (z - 0.3) * last, 9.5];
    assert!(first > 0.05 && last > 0.05);
    assert_eq!(landings.len(), 3, "{landings:?}");
    for (landing, x) in landings.iter().zip(expected) {
        assert!((7.0 + 2.0 * landing.t - x).abs() < INSTANT, "{landing:?} for {x}");
    }
}

#[test]
fn a_wheel_in_the_air_or_between_kinks_has_no_events() {
    let roll = |from: f64, z: f64| {
        let course = move |t: f64| vec![[[from + 2.0 * t, z, 0.0], [2.0, 0.0, 0.0]]];
        Given::<f64, 2>::new(&wheel(0.0), &course).run([0.0, 0.45], 0.1)
    };
    // Places without events: in the air over the start of the ramp, on level ground, and within the bump.
    assert!(roll(0.5, 0.9).is_empty());
    assert!(roll(-3.0, 0.4).is_empty());
    assert!(roll(5.0, 0.6).is_empty());
    assert!(!roll(0.5, 0.4).is_empty());
}

#[test]
fn a_wheel_that_rolls_back_over_the_kink_it_has_landed_on_does_not_meet_it_twice() {
    // The wheel turns back at x = 1 + dip. The road is level before x = 1, where the ramp begins.
    for (dip, n) in [(0.01, 2), (1e-6, 2), (0.0, 0), (-0.01, 0)] {
        let course = move |t: f64| {
            let s = t - 1.0;
            vec![[[1.0 + dip - s * s, 0.4, 0.0], [-2.0 * s, 0.0, 0.0]]]
        };
        let landings = Given::<f64, 2>::new(&wheel(0.0), &course).run([0.0, 2.0], 0.3);
        assert_eq!(landings.len(), n, "{dip}: {landings:?}");
    }
    // Start at the kink, with a velocity or at rest.
    for v in [-1.0, 0.0, 1.0] {
        let course = move |t: f64| vec![[[1.0 + v * t, 0.4, 0.0], [v, 0.0, 0.0]]];
        let landings = Given::<f64, 2>::new(&wheel(0.0), &course).run([0.0, 0.4], 0.1);
        assert!(landings.is_empty(), "{v}: {landings:?}");
    }
}

#[test]
fn a_state_set_from_outside_is_a_new_beginning() {
    let course = swing(0.4, 2.0);
    let mut given = Given::<f64, 2>::new(&slider(BUMPER), &course);
    given.run([0.0, 0.5], 0.1);
    // The state jumps beyond the event at 1.57 s without a step.
    given.go(2.0);
    given.events.start(&given.state);
    given.go(2.1);
    assert_eq!(given.events.first_event(&given.state), None);
}

#[test]
fn without_stops_tires_or_pieces_there_are_no_events() {
    let course = swing(0.4, 2.0);
    let mut given = Given::<f64, 2>::new(&slider(""), &course);
    assert!(given.run([0.0, 5.0], 0.3).is_empty());
}

#[test]
fn left_and_right_wheels_pass_the_kinks_of_their_own_tracks() {
    let text = r#"
[scene]
name = "axle"
dimension = 3
duration = 1.0
[[body]]
name = "axle"
mass = 20.0
center = [0.0, 0.0, 0.4]
inertia = [0.5, 0.8, 0.5, 0.0, 0.0, 0.0]
[road]
left = [{ kind = "bump", start = 1.0, length = 3.0, amplitude = 0.04 }]
right = [{ kind = "bump", start = 1.4, length = 3.0, amplitude = 0.04 }]
[[effect]]
name = "right"
kind = "tire"
body = "axle"
center = [0.0, -0.6, 0.4]
axis = [0.0, 1.0, 0.0]
radius = 0.5
stiffness = 80000.0
[[effect]]
name = "left"
kind = "tire"
body = "axle"
center = [0.0, 0.6, 0.4]
axis = [0.0, 1.0, 0.0]
radius = 0.5
stiffness = 80000.0
"#;
    let course = |t: f64| vec![[[2.0 * t, 0.45, 0.0], [2.0, 0.0, 0.0]]];
    let landings = Given::<f64, 3>::new(text, &course).run([0.0, 2.5], 0.4);
    let found: Vec<usize> = landings.iter().map(|landing| landing.effect).collect();
    assert_eq!(found, [1, 0, 1, 0]);
    for (landing, place) in landings.iter().zip([1.0, 1.4, 4.0, 4.4]) {
        // The road is level at the ends of a bump, so that the contact point is below the centre.
        assert!((2.0 * landing.t - place).abs() < INSTANT, "{landing:?}");
    }
}

#[test]
fn a_contact_that_starts_with_a_step_too_long_for_it_is_told_with_the_share_that_resolves_it() {
    // A body moves by `way` in 0.1 s, beyond the 0.1 m without contact. By the trapezoidal rule the amplitude falls by 1 / (1 +
    // x^2), with x = w h / 2. The product w h is 0.9 in the fraction 0.45 / x of the step.
    for (way, share) in [(0.02, Some(0.225)), (0.05, Some(0.45)), (0.09, None), (-0.03, Some(0.02))]
    {
        let course = move |t: f64| {
            if t > 0.0 {
                vec![[[-way, 0.0, 0.0], [0.3, 0.0, 0.0]]]
            } else {
                vec![[[0.0; 3], [-1.0, 0.0, 0.0]]]
            }
        };
        let mut given = Given::<f64, 2>::new(&slider(BUMPER), &course);
        given.go(0.1);
        let told = given.events.first_event(&given.state).filter(|crossing| crossing.is_too_stiff);
        match (told, share) {
            (Some(told), Some(share)) => {
                assert!((told.share - share).abs() < 1e-9, "{way}: {told:?}")
            }
            (told, share) => assert_eq!(told.is_some(), share.is_some(), "{way}: {told:?}"),
        }
    }
}

#[test]
fn a_step_ends_at_a_contact_that_holds_what_comes_to_it() {
    // A stop that yields by a micrometre at 1 m/s: trials that end in contact do not show the motion before the contact.
    let course = |t: f64| {
        let (x, rate) = if t < 0.500_001 { (0.5 - t, -1.0) } else { (-1e-6, 0.0) };
        vec![[[x, 0.0, 0.0], [rate, 0.0, 0.0]]]
    };
    let landings = Given::<f64, 2>::new(&slider(BUMPER), &course).run([0.0, 0.9], 0.9);
    assert!(landings.iter().any(|landing| (landing.t - 0.5).abs() < INSTANT), "{landings:?}");
}
