//! The Bombardier Iltis: static equilibrium against the published one, runs in three formulations against each other, energy.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

mod common;

use mbs::core::scene::{Output, Quantity};
use mbs::{Overrides, Settings, Still};

/// A number of the published equilibrium (Robotran model of UCLouvain), held to 1e-3 of itself.
fn published(what: &str, ours: f64, theirs: f64) {
    println!("{what}: {ours:.6}, published {theirs}");
    assert!((ours / theirs - 1.0).abs() < 1e-3, "{what}: {ours}, published {theirs}");
}

#[test]
fn static_equilibrium_is_the_published_one() {
    let still = Still::new::<3>(&common::scene("iltis-equilibrium")).expect("it rests");
    let find = |list: &[(mbs::scene_file::Channel, Vec<f64>)], name: &str| {
        let found = list.iter().find(|(channel, _)| channel.name == name);
        found.unwrap_or_else(|| panic!("no {name}")).1.clone()
    };
    let chassis = find(&still.outputs, "chassis");
    published("height of the chassis [m]", chassis[2], 0.562_917);
    // The nose is a point 1 m ahead of the centre of mass.
    let nose = find(&still.outputs, "nose");
    published("pitch [deg]", (chassis[2] - nose[2]).asin().to_degrees(), 0.1465);
    for (side, force) in [("front", 1408.51), ("rear", 1335.52)] {
        let reaction = find(&still.reactions, &format!("leaf-link-{side}-left"));
        let axial = reaction[1].hypot(reaction[2]);
        published(&format!("axial force of the {side} leaf link [N]"), axial, force);
    }
}

/// Chassis position and vertical acceleration over a run, and the energy error as a share of the energy turned over.
fn run(name: &str, formulation: &str, (step, duration): (f64, f64)) -> (Vec<[f64; 4]>, f64) {
    let mut scene = common::scene(name);
    let at = scene.bodies[0].center;
    let output = |name: &str, quantity| Output { name: name.into(), quantity };
    scene.outputs = vec![
        output("place", Quantity::Position { body: 0, at }),
        output("acceleration", Quantity::Acceleration { body: 0, at }),
    ];
    let overrides = Overrides {
        formulation: Some(formulation.to_owned()),
        step: Some(step),
        duration: Some(duration),
        ..Overrides::default()
    };
    let settings = Settings::new(&scene, &overrides).expect("the settings are built");
    let outcome = mbs::run::<f64, 3>(&scene, &settings, &mut ());
    assert!(outcome.error.is_none(), "{name} in {formulation}: {:?}", outcome.error);
    let energy = &outcome.summary.energy;
    let rows = outcome.rows().iter().map(|(_, row)| [row[0], row[1], row[2], row[5]]).collect();
    (rows, energy.max_error / energy.turned_over)
}

/// The largest difference of places [m] and of vertical accelerations [m/s^2] at common times.
fn apart(a: &[[f64; 4]], b: &[[f64; 4]]) -> [f64; 2] {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold([0.0_f64; 2], |[place, acceleration], (x, y)| {
        let d = (0..3).fold(0.0_f64, |d, i| d.max((x[i] - y[i]).abs()));
        [place.max(d), acceleration.max((x[3] - y[3]).abs())]
    })
}

/// A run in three formulations at two steps: they agree, and agree better at half the step.
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
        // In other coordinates the rule's own error of second order differs; in the same ones only the iteration does.
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

/// At a step as long as the report's, a run in relative coordinates is as near to the motion as one of index-3.
fn reaches(name: &str, (step, duration): (f64, f64)) {
    let (exact, _) = run(name, "index-3", (step / 16.0, duration));
    let [augmented, recursive] = ["index-3", "recursive"].map(|formulation| {
        let (rows, energy) = run(name, formulation, (step, duration));
        // Long records keep one instant in so many.
        let common = (exact.len() - 1) / (rows.len() - 1);
        let exact: Vec<_> = exact.iter().step_by(common).copied().collect();
        (apart(&exact, &rows)[0], energy)
    });
    println!(
        "{name} at {step} s (m, share of energy): index-3 {augmented:?}, recursive {recursive:?}"
    );
    // The same rule in other coordinates: errors of the same size, not the same.
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
        let overrides =
            Overrides { formulation: Some("recursive".to_owned()), ..Overrides::default() };
        let settings = Settings::new(&scene, &overrides).expect("the settings are built");
        let outcome = mbs::run::<f64, 3>(&scene, &settings, &mut ());
        assert!(outcome.error.is_none(), "{name}: {:?}", outcome.error);
        let rows = outcome.rows();
        let velocity = &rows[rows.len() - 1].1[3..6];
        println!("{name}: {velocity:?}");
        // Places of order one, rounded to 2e-16 m, in steps of 1e-3 s.
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
            // Order 1 or better: a quarter of the step.
            assert!(fine < 0.25 * coarse, "{name}, {formulation}: {coarse:e} {fine:e}");
        }
    }
}
