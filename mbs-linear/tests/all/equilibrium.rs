//! Equilibria compared with those computed by hand, and the errors of failed searches.

use crate::common::Case;
use core::f64::consts::{FRAC_PI_2, PI};
use mbs_linear::EquilibriumError;

/// Allowed difference, relative to the scene's length [-]. Newton's method ends at machine precision, and these scenes lose few digits.
const CLOSE: f64 = 1e-10;

/// Returns a rod of 1 m and 1 kg on a pivot, rotated by `angle` [rad] from the hanging position.
fn pendulum(angle: f64) -> String {
    format!(
        "[scene]\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n\
         [[body]]\nname = \"rod\"\nrod = {{ from = [0.0, 0.0], to = [0.0, -1.0] }}\nmass = 1.0\n\n\
         [[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"rod\"]\nat = [0.0, 0.0]\n\n\
         [[initial]]\njoint = \"pivot\"\nvalue = {angle}\n"
    )
}

#[test]
fn a_pendulum_finds_its_way_down_from_nearly_everywhere() {
    for angle in [0.0, 0.3, FRAC_PI_2, 2.5, 3.1, PI - 1e-5, -3.0] {
        let mut case = Case::<2>::new(&pendulum(angle));
        let found = case.settle().unwrap_or_else(|e| panic!("{angle}: {e}"));
        let tip = case.point(0, [0.0, -1.0, 0.0]);
        assert!(tip[0].abs() < CLOSE && (tip[1] + 1.0).abs() < CLOSE, "{angle}: {tip:?}");
        assert_eq!((found.unstable, found.neutral), (0, 0), "{angle}");
        assert!(found.relative < 1e-13 && found.violation < 1e-15, "{angle}: {found:?}");
        assert!(found.factorizations < 80, "{angle}: {found:?}");
    }
}

#[test]
fn an_upright_pendulum_stays_and_is_called_unstable() {
    let mut case = Case::<2>::new(&pendulum(PI));
    let found = case.settle().expect("it is balanced");
    assert_eq!(found.unstable, 1);
    assert!(!found.is_stable());
    assert!(case.point(0, [0.0, -1.0, 0.0])[1] > 0.999_999);
}

/// A mass of 2 kg that slides along y on a spring of 300 N/m with a free length of 1 m, and a body that is free along x.
const SPRING: &str = r#"
[scene]
dimension = 2
gravity = [0.0, -9.81]
duration = 1.0

[[body]]
name = "mass"
mass = 2.0
center = [0.0, -1.0]
inertia = 0.1

[[body]]
name = "sledge"
mass = 5.0
center = [3.0, 0.0]
inertia = 0.2

[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "mass"]
at = [0.0, 0.0]
axis = [0.0, 1.0]

[[joint]]
name = "rail"
kind = "prismatic"
bodies = ["ground", "sledge"]
at = [3.0, 0.0]
axis = [1.0, 0.0]

[[effect]]
name = "spring"
kind = "spring-damper"
bodies = ["ground", "mass"]
points = [[0.0, 0.0], [0.0, -1.0]]
stiffness = 300.0
damping = 4.0
free_length = 1.0

[[initial]]
joint = "rail"
value = 0.7
"#;

#[test]
fn a_spring_carries_the_weight_and_a_free_direction_keeps_its_place() {
    let mut case = Case::<2>::new(SPRING);
    let found = case.settle().expect("the spring holds it");
    let sag = 2.0 * 9.81 / 300.0;
    let mass = case.point(0, [0.0, -1.0, 0.0]);
    assert!((mass[1] + 1.0 + sag).abs() < CLOSE, "{mass:?}");
    let sledge = case.point(1, [3.0, 0.0, 0.0]);
    assert!((sledge[0] - 3.7).abs() < CLOSE, "{sledge:?}");
    assert_eq!((found.unstable, found.neutral), (0, 1), "{found:?}");
}

#[test]
fn what_nothing_holds_falls_and_says_so() {
    let text = SPRING.replace("axis = [1.0, 0.0]", "axis = [1.0, 1.0]");
    let mut case = Case::<2>::new(&text);
    let before = case.state.clone();
    let error = case.settle();
    assert!(matches!(error, Err(EquilibriumError::Escapes { .. })), "{error:?}");
    case.state.v.copy_from_slice(&before.v);
    assert_eq!(case.state, before, "a failed search leaves the state alone");
}

#[test]
fn without_forces_everything_is_balanced() {
    let mut case = Case::<3>::new(include_str!("../../../scenes/free-body.toml"));
    let found = case.settle().expect("no force acts");
    assert_eq!((found.unstable, found.neutral, found.iterations), (0, 6, 0));
}

/// Checks that a spatial scene settles to machine precision in a stable equilibrium.
fn hangs(text: &str) {
    let mut case = Case::<3>::new(text);
    let found = case.settle().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found.unstable, 0, "{found:?}");
    assert!(found.relative < 1e-12, "{found:?}");
}

#[test]
fn redundant_joints_do_not_matter() {
    // Four parallel revolute joints in space around a parallelogram: three equations are redundant.
    hangs(include_str!("../../../scenes/spatial-four-bar.toml"));
}

#[test]
fn a_chain_in_space_hangs_down() {
    hangs(include_str!("../../../scenes/spatial-chain-20.toml"));
}

#[test]
fn a_tree_of_springs_settles_where_nothing_grows() {
    // The tangent of the torsion springs in this scene leaves out the rotation of their axes. So the estimate of stability may be wrong.
    // The test therefore checks the eigenvalues of the equations of motion.
    let mut case = Case::<3>::new(include_str!("../../../scenes/tree-30.toml"));
    let found = case.settle().unwrap_or_else(|e| panic!("{e}"));
    assert!(found.relative < 1e-12, "{found:?}");
    let noise = case.linear(mbs_linear::Instant::Rest).expect("it is regular").noise;
    let values = case.eigenvalues(mbs_linear::Instant::Rest);
    let growth = values.iter().fold(0.0, |most: f64, x| most.max(x.0));
    assert!(growth < (1e3 * noise).sqrt(), "{growth} {noise}");
}

#[test]
fn single_precision_balances_to_its_own_rounding() {
    use mbs_core::{dense::Dense, natural::NaturalModel, start::assemble};
    use mbs_linear::{Options, Saddle, Workspace, equilibrium};
    let document = mbs_scene::SceneFile::parse(&pendulum(2.0), "test.toml").expect("it is a scene");
    let scene = document.scene::<f32>().expect("it is a scene");
    let model = NaturalModel::<f32, 2>::new(&scene).expect("it has a model");
    let start = assemble(&scene, &model, |p| Dense::new(p), &mut Dense::new(&model));
    let mut state = start.expect("it assembles").state;
    let mut w = Workspace::new(&model, Dense::new(&Saddle::new(&model)));
    let found = equilibrium(&model, &Options::default(), &mut state, &mut w);
    let found = found.unwrap_or_else(|e| panic!("{e}"));
    assert!(found.relative < 1e-6 && found.unstable == 0, "{found:?}");
    let at = mbs_core::scene::BodyId::Body(0);
    let tip = model.point(at, [0.0, -1.0, 0.0]).value(&state.q);
    // The limit is a thousand times EPSILON [m]: the search ends where the force is a rounding error, and K is of order one.
    assert!(tip[0].abs() < 1e-4, "{tip:?}");
}

/// A block of 5 kg that touches a pad of 20,000 N/m at the start.
const PAD: &str = include_str!("../../../mbs/tests/field/02-pad.toml");
/// A block of 5 kg on the same pad, with a spring of 1 N/m beside it.
const PAD_WITH_SPRING: &str = include_str!("../../../mbs/tests/field/02-pad-with-spring.toml");

#[test]
fn the_search_does_not_go_through_a_stop() {
    for (text, stiffness) in [(PAD, 20_000.0), (PAD_WITH_SPRING, 20_001.0)] {
        for height in [0.0, -0.001, 0.02, 0.5, 30.0] {
            let text = format!("{text}\n[[initial]]\njoint = \"post\"\nvalue = {height}\n");
            let mut case = Case::<2>::new(&text);
            let found = case.settle().unwrap_or_else(|e| panic!("{height}: {e}"));
            let y = case.point(0, [0.0, 0.4, 0.0])[1] - 0.4;
            assert!((y + 5.0 * 9.81 / stiffness).abs() < CLOSE, "{height}: {y}");
            assert!(found.is_stable() && found.neutral == 0);
        }
    }
}

/// A slide in space on one spring without gravity: all forces vanish together, so no other force remains for comparison.
const SLIDE: &str = include_str!("../../../mbs/tests/field/05-slide-on-a-spring.toml");

#[test]
fn a_slide_on_one_spring_rests_where_the_spring_has_its_length() {
    for axis in ["[2.0, 1.0, -2.0]", "[1.0, 0.3, -2.0]", "[-2.0, -1.0, 2.0]"] {
        let mut case = Case::<3>::new(&SLIDE.replace("[2.0, 1.0, -2.0]", axis));
        let found = case.settle().unwrap_or_else(|e| panic!("{axis}: {e}"));
        let place = case.point(0, [0.2, 0.1, -0.2]);
        let length = place.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - 0.28).abs() < CLOSE, "{axis}: {length}");
        assert_eq!((found.unstable, found.neutral), (0, 0), "{axis}: {found:?}");
        assert!(found.relative < 1e-13);
    }
}

#[test]
fn near_the_start_newtons_method_finds_what_no_search_downwards_does() {
    for (angle, place) in [(3.0, 1.0), (0.3, -1.0), (PI, 1.0)] {
        let mut case = Case::<2>::new(&pendulum(angle));
        let found = case.approach().unwrap_or_else(|e| panic!("{angle}: {e}"));
        assert!((case.point(0, [0.0, -1.0, 0.0])[1] - place).abs() < CLOSE, "{angle}");
        assert_eq!(found.unstable, usize::from(place > 0.0), "{angle}");
    }
    for height in [0.0, -0.01, 0.1] {
        let text = format!("{PAD}\n[[initial]]\njoint = \"post\"\nvalue = {height}\n");
        let mut case = Case::<2>::new(&text);
        case.approach().unwrap_or_else(|e| panic!("{height}: {e}"));
        let y = case.point(0, [0.0, 0.4, 0.0])[1] - 0.4;
        assert!((y + 5.0 * 9.81 / 20_000.0).abs() < CLOSE, "{height}: {y}");
    }
    // A block high above the pad has no equilibrium close by.
    let mut case = Case::<2>::new(&format!("{PAD}\n[[initial]]\njoint = \"post\"\nvalue = 3.0\n"));
    assert_eq!(case.approach(), Err(EquilibriumError::NotNear));
}

#[test]
fn the_search_does_not_slip_past_a_stop_beside_its_way() {
    // The pad's point on the ground is 1 mm or 0.1 m beside the block's path, so that the direction of its force changes as the block
    // descends.
    for aside in [0.001, 0.1] {
        for height in [0.0, 0.001, 0.3, 7.0] {
            let text = PAD.replace(
                "points = [[0, 0], [0, 0.4]]",
                &format!("points = [[{aside}, 0], [0, 0.4]]"),
            );
            let text = format!("{text}\n[[initial]]\njoint = \"post\"\nvalue = {height}\n");
            let mut case = Case::<2>::new(&text);
            case.settle().unwrap_or_else(|e| panic!("{aside} {height}: {e}"));
            let y = case.point(0, [0.0, 0.4, 0.0])[1];
            // The fraction y / length of the pad's force acts along the path.
            let (free, length) = (0.4_f64.hypot(aside), y.hypot(aside));
            let carried = 20_000.0 * (free - length) * y / length;
            assert!(y > 0.38 && (carried - 5.0 * 9.81).abs() < 1e-6, "{aside} {height}: {y}");
        }
    }
}
