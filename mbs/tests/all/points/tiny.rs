//! Bodies with tiny or no inertia: the start can be assembled, and every formulation moves them.

use crate::common::oracle::{TRAPEZOIDAL, Way, last, rows};
use mbs_testkit::scene;

/// Scene of an arm on three crossed hinges, whose inner bodies have this mass [kg] and inertia [kg m^2]. `held` joints have initial values.
/// With `closed`, a bar on a ball joint at the tip keeps its other end at a distance from the ground.
fn shoulder([mass, inertia]: [f64; 2], held: &[(&str, f64)], closed: bool) -> String {
    let i = format!("[{inertia:?}, {inertia:?}, {inertia:?}, 0.0, 0.0, 0.0]");
    let mut text =
        "[scene]\nname = \"t\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n"
            .to_owned();
    for piece in ["yoke", "cross"] {
        text += &format!(
            "[[body]]\nname = \"{piece}\"\nmass = {mass:?}\ncenter = [0.0, 0.0, 0.0]\ninertia = {i}\n"
        );
    }
    text += "[[body]]\nname = \"arm\"\nmass = 2.0\ncenter = [0.0, 0.0, -0.25]\ninertia = [0.04, 0.04, 0.002, 0.0, 0.001, 0.0]\n";
    let hinges = [
        ("pitch", "ground", "yoke", "[0, 1, 0.1]"),
        ("roll", "yoke", "cross", "[1, 0, 0.2]"),
        ("yaw", "cross", "arm", "[0, 0, 1]"),
    ];
    for (name, first, second, axis) in hinges {
        text += &format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = [\"{first}\", \"{second}\"]\nat = [0.0, 0.0, 0.0]\naxis = {axis}\n"
        );
    }
    if closed {
        text += "[[body]]\nname = \"bar\"\nmass = 0.3\ncenter = [0.5, 0.1, -0.5]\ninertia = [0.003, 0.003, 0.003, 0.0, 0.0, 0.0]\n\
                 [[joint]]\nname = \"tip\"\nkind = \"spherical\"\nbodies = [\"arm\", \"bar\"]\nat = [0.0, 0.0, -0.5]\n\
                 [[joint]]\nname = \"stay\"\nkind = \"distance\"\nbodies = [\"bar\", \"ground\"]\npoints = [[1.0, 0.2, -0.5], [1.5, 0.1, 0.3]]\n";
    }
    for (joint, value) in held {
        text += &format!("[[initial]]\njoint = \"{joint}\"\nvalue = {value:?}\nrate = 0.5\n");
    }
    for (name, ..) in hinges {
        text +=
            &format!("[[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"value\"\n");
    }
    text
}

/// Masses [kg] and inertias [kg m^2] of the inner bodies.
const PIECES: [[f64; 2]; 3] = [[2e-3, 1e-7], [1e-6, 1e-12], [0.0, 0.0]];
const VALUES: [(&str, f64); 3] = [("pitch", 0.8), ("roll", -0.9), ("yaw", 0.3)];
/// Violation of a start, and error of prescribed values [m or rad].
const CLOSED: f64 = 1e-12;

#[test]
fn crossed_hinges_with_all_values_start_and_move_whatever_their_pieces_weigh() {
    for closed in [false, true] {
        let mut ends: Vec<Vec<f64>> = Vec::new();
        for piece in PIECES {
            let scene = scene(&shoulder(piece, &VALUES, closed));
            let (model, state) = mbs_testkit::start::<3>(&scene);
            let mut terms = mbs::core::model::Model::terms(&model);
            mbs::core::model::Model::evaluate(&model, &state.q, &mut terms);
            let gap = terms.phi.iter().fold(0.0_f64, |gap, x| gap.max(x.abs()));
            assert!(gap < CLOSED, "{piece:?}, {closed}: {gap:e}");
            for formulation in TRAPEZOIDAL {
                let rows = rows(&scene, Way(formulation, "trapezoidal"), (1e-3, 0.1), 1);
                let rows = rows.unwrap_or_else(|e| panic!("{formulation}, {piece:?}: {e}"));
                for ((_, value), found) in VALUES.iter().zip(&rows[0].1) {
                    assert!((value - found).abs() < CLOSED, "{formulation}, {piece:?}: {found}");
                }
                ends.push(last(&rows).to_vec());
            }
        }
        // an inner body changes the motion by its fraction of the inertia, and the rules differ by (w h)^2
        for end in &ends {
            for (x, y) in end.iter().zip(&ends[0]) {
                assert!((x - y).abs() < 1e-4, "{closed}: {end:?}, {:?}", ends[0]);
            }
        }
    }
}
