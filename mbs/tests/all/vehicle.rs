//! The Bombardier Iltis: static equilibrium against the published one, comparison of runs in three formulations, and energy.

use crate::common;

use mbs::core::actions::{Action, Actions};
use mbs::core::laws::body::{BodyLaw, BodyMotion, WrenchesLaw};
use mbs::core::laws::{road::height, road_contact::road_contact};
use mbs::core::model::State;
use mbs::core::natural::NaturalModel;
use mbs::core::scene::{BodyId, Output, Quantity, Scene};
use mbs::{Method, StaticEquilibrium};
use std::collections::BTreeMap;

/// Asserts a number of the published equilibrium (Robotran model of UCLouvain) to a relative 1e-3.
fn published(what: &str, ours: f64, theirs: f64) {
    println!("{what}: {ours:.6}, published {theirs}");
    assert!((ours / theirs - 1.0).abs() < 1e-3, "{what}: {ours}, published {theirs}");
}

#[test]
fn static_equilibrium_is_the_published_one() {
    let still = StaticEquilibrium::new(&common::scene("iltis-equilibrium"), mbs::Search::Down)
        .expect("it rests");
    let find = |list: &[(mbs::record::Channel, Vec<f64>)], name: &str| {
        let found = list.iter().find(|(channel, _)| channel.name == name);
        found.unwrap_or_else(|| panic!("no {name}")).1.clone()
    };
    let chassis = find(&still.outputs, "chassis");
    published("height of the chassis [m]", chassis[2], 0.562_917);
    // the nose is a point 1 m ahead of the centre of mass
    let nose = find(&still.outputs, "nose");
    published("pitch [deg]", (chassis[2] - nose[2]).asin().to_degrees(), 0.1465);
    for (side, force) in [("front", 1408.51), ("rear", 1335.52)] {
        let reaction = find(&still.reactions, &format!("leaf-link-{side}-left"));
        let axial = reaction[1].hypot(reaction[2]);
        published(&format!("axial force of the {side} leaf link [N]"), axial, force);
    }
}

/// Forces of the spring elements [N], positive in tension, and loads of the tires [N], for a vehicle at rest.
fn forces(
    scene: &Scene<f64>,
    state: &[f64],
    model: &NaturalModel<f64, 3>,
) -> BTreeMap<String, f64> {
    let Actions { list, tables, .. } = Actions::new(scene).expect("every law is built");
    let law_inputs = tables.law_inputs(&[]);
    let place = |(body, at): (BodyId, [f64; 3])| model.point(body, at).value(state);
    let force = |action: &Action<f64>| match action {
        Action::Length { ends: [first, second], law } => {
            law.evaluate((place(*second) - place(*first)).norm(), 0.0, &law_inputs).tension
        }
        Action::Along { ends: [first, second], direction, offset, law, .. } => {
            let along = model.direction(first.0, *direction).value(state);
            let distance = (place(*second) - place(*first)).dot(&along) - offset;
            law.evaluate(distance, 0.0, &law_inputs).tension
        }
        Action::BodyLoad { at: (body, at), axis, law: BodyLaw::Tire(tire) } => {
            let motion = BodyMotion {
                position: place((BodyId::Body(*body), *at)).into(),
                axis: model.direction(BodyId::Body(*body), *axis).value(state).into(),
                velocity: [0.0; 3],
                spin: [0.0; 3],
            };
            let mut actions = vec![Default::default(); tire.n_actions()];
            tire.evaluate(&motion, &law_inputs, &mut actions);
            -actions[0].measure.tension
        }
        other => panic!("no force of {other:?}"),
    };
    list.iter()
        .map(|(effect, action)| (scene.effects[*effect].name.clone(), force(action)))
        .collect()
}

#[test]
fn nominal_forces_and_those_of_the_equilibrium_are_the_published_ones() {
    let scene = common::scene("iltis-equilibrium");
    let model = NaturalModel::<f64, 3>::new(&scene).expect("the scene has a model");
    let mut state = State::at_rest(&model);
    // nominal values are those of Frik, Leister and Schwartz, which the model of UCLouvain quotes and confirms; equilibrium values are those
    // of that model
    let nominal =
        [("leaf", [-2728.86; 2]), ("damper-spring", [-128.03; 2]), ("tire", [3829.50, 3593.52])];
    let at_rest = [
        ("leaf", [-3068.62, -2885.51]),
        ("damper-spring", [-335.29, -241.64]),
        ("tire", [3831.31, 3591.91]),
    ];
    for (what, wanted) in [("nominal", nominal), ("equilibrium", at_rest)] {
        if what == "equilibrium" {
            mbs::find_equilibrium(&scene, &model, mbs::Search::Down, &mut state).expect("it rests");
        }
        let found = forces(&scene, &state.q, &model);
        for (element, both) in wanted {
            for (axle, wanted) in ["front", "rear"].into_iter().zip(both) {
                for side in ["left", "right"] {
                    let name = format!("{element}-{axle}-{side}");
                    published(&format!("{what}: {name} [N]"), found[&name], wanted);
                }
            }
        }
    }
}

/// Relative difference from the reference [-]. The two programs define the slip of a tire at different points (0.02 % of the lateral
/// displacement), and the effect of camber on its load differently. The reference has four to seven digits.
const REFERENCE: f64 = 1e-3;

/// State after 5 s: x, y, yaw, roll, yaw rate, v_x, v_y of the chassis (Robotran model of UCLouvain).
const RAMP_STEERS: [(&str, [f64; 7]); 3] = [
    (
        "iltis-ramp-steer-10",
        [49.29088, -6.754062, -0.290895, -0.0057392, -0.06253012, 9.556278, -2.868697],
    ),
    (
        "iltis-ramp-steer-20",
        [97.41250, -17.33649, -0.4006217, -0.01612108, -0.08564136, 18.36862, -7.516234],
    ),
    (
        "iltis-ramp-steer-30",
        [145.9981, -25.37493, -0.4055022, -0.02442894, -0.08484078, 27.51252, -11.06744],
    ),
];

#[test]
fn steering_ramps_end_where_those_of_an_independent_program_do() {
    for (name, reference) in RAMP_STEERS {
        let mut scene = common::scene(name);
        let at = [scene.bodies[0].center, [1.0, 0.0, 0.57], [0.0, 1.0, 0.57]];
        let place = |at| Quantity::Position { body: BodyId::Body(0), at };
        let speed = |at| Quantity::Velocity { body: BodyId::Body(0), at };
        let quantities = at.map(place).into_iter().chain(at.map(speed));
        scene.outputs = quantities
            .enumerate()
            .map(|(i, quantity)| Output::new(quantity).named(&format!("{i}")))
            .collect();
        for formulation in ["index-3", "recursive"] {
            let outcome = common::run_in(&scene, formulation, None);
            let (_, row) = outcome.rows().last().expect("there are rows");
            let vector = |i: usize| [row[3 * i], row[3 * i + 1], row[3 * i + 2]];
            let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
            let [center, nose, flank, v, v_nose, v_flank] = [0, 1, 2, 3, 4, 5].map(vector);
            let (x, y) = (minus(nose, center), minus(flank, center));
            let (x_t, y_t) = (minus(v_nose, v), minus(v_flank, v));
            let z = common::cross(x, y);
            // the rotation is by pitch about y, then roll about x, then yaw about z
            let yaw_rate = (x_t[1] * y[1] - x[1] * y_t[1]) / (x[1] * x[1] + y[1] * y[1]);
            let ours = [center[0], center[1], x[1].atan2(y[1]), -z[1].asin(), yaw_rate, v[0], v[1]];
            for (k, (ours, theirs)) in ours.iter().zip(reference).enumerate() {
                let off = ours / theirs - 1.0;
                println!(
                    "{name} {formulation}, number {k}: {ours:.7}, {off:+.1e} of the reference"
                );
                assert!(
                    off.abs() < REFERENCE,
                    "{name} {formulation}, number {k}: {ours}, {theirs}"
                );
            }
        }
    }
}

/// Position and vertical acceleration of the chassis over a run, and the energy error relative to the exchanged energy.
fn run(name: &str, formulation: &str, (step, duration): (f64, f64)) -> (Vec<[f64; 4]>, f64) {
    let mut scene = common::scene(name);
    let at = scene.bodies[0].center;
    let output = |name: &str, quantity| Output::new(quantity).named(name);
    scene.outputs = vec![
        output("place", Quantity::Position { body: BodyId::Body(0), at }),
        output("acceleration", Quantity::Acceleration { body: BodyId::Body(0), at }),
    ];
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        step: Some(step),
        duration: Some(duration),
        // errors of the iterations add up over thousands of steps, so the tolerance is a hundredth of the default
        tolerance: Some(1e-12),
        ..Method::default()
    };
    let outcome = common::run(&scene, &overrides);
    assert!(outcome.error.is_none(), "{name} in {formulation}: {:?}", outcome.error);
    let energy = &outcome.summary.energy;
    let rows = outcome.rows().iter().map(|(_, row)| [row[0], row[1], row[2], row[5]]).collect();
    (rows, energy.max_error / energy.turned_over)
}

/// Largest difference of positions [m] and of vertical accelerations [m/s^2] at common times.
fn apart(a: &[[f64; 4]], b: &[[f64; 4]]) -> [f64; 2] {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold([0.0_f64; 2], |[place, acceleration], (x, y)| {
        let d = (0..3).fold(0.0_f64, |d, i| d.max((x[i] - y[i]).abs()));
        [place.max(d), acceleration.max((x[3] - y[3]).abs())]
    })
}

/// Asserts that a run in three formulations agrees at two steps, and better at the smaller one.
fn agree(name: &str, duration: f64) {
    let differences = |step: f64| {
        let (reference, _) = run(name, "index-3", (step, duration));
        ["classical", "recursive"]
            .map(|formulation| apart(&reference, &run(name, formulation, (step, duration)).0))
    };
    let (coarse, fine) = (differences(4e-3), differences(2e-3));
    for (what, coarse, fine) in
        [("classical", coarse[0], fine[0]), ("recursive", coarse[1], fine[1])]
    {
        println!("{name} {what}: {coarse:?} at 4e-3, {fine:?} at 2e-3 (m, m/s^2)");
        // in other coordinates the rule's error of second order differs; in the same coordinates only the iteration differs
        assert!(fine[0] < 1e-3, "{name} {what}: {fine:?}");
        assert!(fine[0] < 0.5 * coarse[0] || fine[0] < 1e-6, "{name} {what}: {coarse:?} {fine:?}");
        assert!(fine[1] < 0.6 * coarse[1] || fine[1] < 1e-2, "{name} {what}: {coarse:?} {fine:?}");
    }
}

#[test]
fn formulations_agree_on_the_jump() {
    agree("iltis-jump", 6.0);
}

#[test]
fn formulations_agree_on_the_slalom() {
    agree("iltis-slalom", 4.0);
}

#[test]
fn formulations_agree_on_the_ramp_of_the_stairs() {
    agree("iltis-stairs", 5.0);
}

/// The vehicle, its road and its motion are symmetric. Only rounding, 1e-16 of the wheels' forces in each of hundreds of steps, moves it off
/// its plane by nanometres. A projection that is not orthogonal in the mass metric would add an error that grows to centimetres.
#[test]
fn a_vehicle_that_is_the_same_on_both_sides_stays_in_its_plane() {
    for name in ["iltis-stairs", "iltis-jump", "iltis-stairs-stiff"] {
        let scene = common::scene(name);
        let index3 = common::by("index-3");
        let outcome = common::run(&scene, &index3);
        assert!(outcome.error.is_none(), "{name}: {:?}", outcome.error);
        let off = outcome.rows().iter().fold(0.0_f64, |off, (_, row)| off.max(row[1].abs()));
        println!("{name}: {off:.1e} m off its plane");
        assert!(off < 1e-6, "{name}: {off:e} m off its plane");
    }
}

/// Asserts that with the report's step, a run in relative coordinates is as accurate as one of index-3.
fn reaches(name: &str, (step, duration): (f64, f64)) {
    let (exact, _) = run(name, "index-3", (step / 16.0, duration));
    let [augmented, recursive] = ["index-3", "recursive"].map(|formulation| {
        let (rows, energy) = run(name, formulation, (step, duration));
        // long runs record only one of several instants
        let common = (exact.len() - 1) / (rows.len() - 1);
        let exact: Vec<_> = exact.iter().step_by(common).copied().collect();
        (apart(&exact, &rows)[0], energy)
    });
    println!(
        "{name} at {step} s (m, share of energy): index-3 {augmented:?}, recursive {recursive:?}"
    );
    // the same rule in other coordinates has errors of the same size
    assert!(recursive.0 < 2.0 * augmented.0, "{name}: {augmented:?} {recursive:?} m");
    assert!(recursive.1 < 2.0 * augmented.1, "{name}: {augmented:?} {recursive:?} of the energy");
}

#[test]
fn relative_coordinates_take_the_report_s_steps() {
    reaches("iltis-stairs", (0.0175, 9.94));
    reaches("iltis-jump", (0.03, 9.9));
    reaches("iltis-slalom", (0.025, 10.0));
    reaches("iltis-stairs-stiff", (0.005, 6.0));
}

#[test]
fn suspensions_that_come_to_rest_are_stepped_to_the_end() {
    for name in ["iltis-suspension", "iltis-suspension-halved", "iltis-suspension-stiff"] {
        let scene = common::scene(name);
        let overrides = common::by("recursive");
        let outcome = common::run(&scene, &overrides);
        assert!(outcome.error.is_none(), "{name}: {:?}", outcome.error);
        let rows = outcome.rows();
        let velocity = &rows[rows.len() - 1].1[3..6];
        println!("{name}: {velocity:?}");
        // positions of order one are rounded to 2e-16 m; divided by steps of 1e-3 s, this gives velocities below 1e-12 m/s
        assert!(velocity.iter().all(|v| v.abs() < 1e-12), "{name}: {velocity:?}");
    }
}

#[test]
fn energy_is_kept_to_a_thousandth_of_what_is_turned_over_and_better_at_smaller_steps() {
    for name in ["iltis-stairs", "iltis-jump", "iltis-slalom"] {
        for formulation in ["index-3", "recursive"] {
            let [coarse, fine] = [4e-3, 1e-3].map(|step| run(name, formulation, (step, 10.0)).1);
            println!("{name}, {formulation}: {coarse:.1e} at 4e-3, {fine:.1e} at 1e-3");
            assert!(fine < 1e-3, "{name}, {formulation}: {fine:e}");
            // an order of at least 1 reduces the error to a quarter at a quarter of the step
            assert!(fine < 0.25 * coarse, "{name}, {formulation}: {coarse:e} {fine:e}");
        }
    }
}

/// Distance of the road's points in the search for the nearest [m]. The smallest distance is then too large by a few 1e-8 m at most.
const SEARCHED: f64 = 1e-4;

#[test]
fn wheels_stand_on_the_nearest_point_of_every_stair() {
    for name in ["iltis-stairs", "iltis-stairs-stiff"] {
        let actions = Actions::new(&common::scene(name)).expect("the scene has effects");
        let road = actions.list.iter().find_map(|(_, action)| match action {
            Action::BodyLoad { law: BodyLaw::Tire(tire), .. } => Some(tire.road),
            _ => None,
        });
        let road = road.expect("the vehicle has tires");
        let law_inputs = actions.tables.law_inputs(&[]);
        // the wheel is tried on the ramp and on the five stairs behind it: pressed in, just in contact, or slightly above
        for i in 0..=2600 {
            let x = 5.5 + 0.01 * f64::from(i);
            let h = height(road, &law_inputs, x);
            let steep = h.slope.hypot(1.0);
            for distance in [0.30, 0.36, 0.45] {
                let center = [x - distance * h.slope / steep, h.value + distance / steep];
                let found = road_contact(road, &law_inputs, center).distance;
                assert!((found - distance).abs() < 1e-12, "{name}, {x}: {found}, not {distance}");
                let near = (-5000..=5000).step_by(if i % 20 == 0 { 1 } else { 5000 }).map(|k| {
                    let u = x + SEARCHED * f64::from(k);
                    (center[0] - u).hypot(center[1] - height(road, &law_inputs, u).value)
                });
                let searched = near.fold(f64::INFINITY, f64::min);
                assert!(found < searched + 1e-12, "{name}, {x}: {found}, there is {searched}");
            }
        }
    }
}
