//! Modes of scenes about their equilibria.

use super::super::{field, read, text};
use mbs::core::scene::Scene;
use mbs::{Mode, Modes, Place, Search};

/// Relative difference of eigenvalues [-]: differences of fourth order of the equations of motion have eight digits.
const CLOSE: f64 = 1e-8;

fn modes(scene: &Scene<f64>, search: Search) -> Vec<Mode> {
    let found = Modes::new(scene, Place::Equilibrium, search);
    found.unwrap_or_else(|e| panic!("{}: {e}", scene.name)).modes
}

fn is_at(mode: &Mode, real: f64, imaginary: f64) -> bool {
    let size = real.hypot(imaginary);
    (mode.real - real).hypot(mode.imaginary - imaginary) < CLOSE * size
}

#[test]
fn a_block_on_its_pad_bounces_and_a_slide_on_a_spring_swings() {
    let found = modes(&field("02-pad"), Search::Down);
    assert!(found.len() == 1 && is_at(&found[0], 0.0, 63.245_553_203_367_59), "{found:?}");
    let found = modes(&field("05-slide-on-a-spring"), Search::Down);
    assert!(found.len() == 1 && is_at(&found[0], 0.0, 30.0), "{found:?}");
}

#[test]
fn viscous_friction_damps_modes_and_dry_friction_beside_it_is_left_out() {
    let wanted = f64::sqrt(100.0 - 6.25);
    let plain = text("04-modes-viscous-friction");
    for text in [plain.clone(), plain.replace("coulomb = 0.0", "coulomb = 40.0")] {
        let found = modes(&read(&text, "rub"), Search::Down);
        assert!(found.len() == 1 && is_at(&found[0], -2.5, wanted), "{found:?}");
        assert!((found[0].damping_ratio().expect("it moves") - 0.25).abs() < CLOSE);
    }
    let dry = read(&plain.replace("coulomb = 0.0", "coulomb = 40.0"), "dry");
    let found = Modes::new(&dry, Place::Equilibrium, Search::Down).expect("it rests");
    assert_eq!(found.left_out.len(), 1);
    assert_eq!(found.to_json()["left_out"][0]["part"], "dry friction");
}

#[test]
fn near_the_start_an_unstable_place_has_a_mode_that_grows() {
    let pendulum = "[scene]\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\
        [[body]]\nname = \"bob\"\nmass = 1.0\ncenter = [0.0, -1.0]\ninertia = 0.0\n\
        [[joint]]\nname = \"p\"\nkind = \"revolute\"\nbodies = [\"ground\", \"bob\"]\nat = [0.0, 0.0]\n\
        [[initial]]\njoint = \"p\"\nvalue = 3.0\n";
    let found = modes(&read(pendulum, "pendulum"), Search::Near);
    let rate = f64::sqrt(9.81);
    assert_eq!(found.len(), 2);
    assert!(found.iter().any(|m| is_at(m, rate, 0.0) && m.grows()), "{found:?}");
    assert!(found.iter().any(|m| is_at(m, -rate, 0.0)), "{found:?}");
}

/// Cart and pendulum in closed form: 12 kg and the inertia 0.16 kg m² of both wheels move the axle, and 8 kg hang 0.2 m below it.
#[test]
fn a_cart_on_two_wheels_of_one_axle_rests_and_swings() {
    let cart = field("21-cart-on-two-wheels");
    let found = modes(&cart, Search::Down);
    let swing = found.last().expect("it swings");
    assert!(is_at(swing, 0.0, 5.420_572_73), "{found:?}");
    assert!(found[..found.len() - 1].iter().all(|mode| mode.is_neutral), "{found:?}");
    let rest = mbs::StaticEquilibrium::new(&cart, Search::Down).expect("it rests");
    assert_eq!(rest.unstable, Some(0));
}

/// Squares of the frequencies: g over the length of the rope; and 2 · 0.05 · 3 g over 0.05 kg m² of the shaft.
#[test]
fn weights_on_ropes_and_cams_swing_about_their_rests() {
    for (name, right) in
        [("24-weight-on-a-rope", 2.962_149_68), ("24-follower-on-a-cam", 7.672_027_11)]
    {
        let found = modes(&field(name), Search::Down);
        assert!(found.len() == 1 && is_at(&found[0], 0.0, right), "{name}: {found:?}");
    }
}
