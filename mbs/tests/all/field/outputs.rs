//! Outputs that were wrong where the motion was right.

use super::{field, read, text};
use crate::common::{run, run_in};
use mbs::core::scene::Scene;
use mbs::{FormulationKind, Method, Outcome};

/// Values of the last row.
fn last(outcome: &Outcome) -> &[f64] {
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    &outcome.rows().last().expect("the start is recorded").1
}

/// Efforts on both angles of the cross [N m], and their power [W], at 0.5 s: the equations of mast and dish by another program.
const CROSS: [f64; 3] = [-5.399_044_19, 1.102_128_63, 16.795_604_76];

#[test]
fn efforts_of_a_cross_with_oblique_axes_are_about_its_axes() {
    let scene = field("60-guided-cross");
    let method = Method {
        formulation: Some("recursive".into()),
        integrator: Some("rk853".into()),
        error_tolerance: Some(1e-11),
        ..Method::default()
    };
    let outcome = run(&scene, &method);
    for (found, right) in last(&outcome).iter().zip(CROSS) {
        assert!((found - right).abs() < 1e-6 * right.abs(), "{found}, {right}");
    }
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let [coarse, fine] =
            [1e-3, 5e-4].map(|step| last(&run_in(&scene, formulation, Some(step))).to_vec());
        for ((coarse, fine), right) in coarse.iter().zip(&fine).zip(CROSS) {
            let by_the_rule = 4.0 / 3.0 * (coarse - fine).abs() + 1e-6 * right.abs();
            assert!((coarse - right).abs() < by_the_rule, "{formulation}: {coarse}, {right}");
        }
    }
}

/// What goes through the joint at each instant: its moment times the turn of the dish against the mast [W].
#[test]
fn the_power_of_a_cross_is_its_moment_times_the_turn() {
    let oblique = text("60-guided-cross");
    // any angle of the axes, a right one and a sharp one among them, and the bodies named the other way
    for axes in [
        "[[0.0, 1.0, 0.0], [1.0, 0.4, 0.0]]",
        "[[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]",
        "[[0.3, 1.0, 0.2], [0.1, 0.9, -0.5]]",
    ] {
        for bodies in [r#"["mast", "dish"]"#, r#"["dish", "mast"]"#] {
            let text = oblique.replace("[[0.0, 1.0, 0.0], [1.0, 0.4, 0.0]]", axes);
            let scene: Scene<f64> = read(&text.replace(r#"["mast", "dish"]"#, bodies), "cross");
            let sign = if bodies.starts_with(r#"["mast"#) { 1.0 } else { -1.0 };
            for formulation in FormulationKind::ALL.map(FormulationKind::name) {
                let outcome = run_in(&scene, formulation, Some(1e-3));
                assert!(outcome.error.is_none(), "{formulation}: {:?}", outcome.error);
                for (t, row) in outcome.rows() {
                    let (power, moment, turn) = (row[2], &row[8..11], &row[11..14]);
                    let through: f64 =
                        moment.iter().zip(turn).map(|(m, w)| m * w).sum::<f64>() * sign;
                    assert!(
                        (power - through).abs() < 1e-6 * (1.0 + power.abs()),
                        "{formulation} at {t}: {power}, {through}"
                    );
                }
            }
        }
    }
}
