//! Eigenvalues of linearised mechanisms compared with closed forms.

use crate::common::Case;
use mbs_linear::{Instant, LinearError};

/// Allowed relative difference [-]. Differences of fourth order at 1e-4 leave rounding errors alone, about 1e-11 of these frequencies. The
/// requirement is 1e-8.
const SAME: f64 = 1e-9;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * b.abs().max(1.0)
}

fn scene(dimension: usize, gravity: &str, rest: &str) -> String {
    format!("[scene]\ndimension = {dimension}\ngravity = {gravity}\nduration = 1.0\n\n{rest}")
}

const BOB: &str = r#"
[[body]]
name = "bob"
mass = 3.0
center = [0.0, -0.7]
inertia = 0.0
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "bob"]
at = [0.0, 0.0]
"#;

#[test]
fn a_pendulum_has_the_frequency_root_g_over_l() {
    let mut case = Case::<2>::new(&scene(2, "[0.0, -9.81]", BOB));
    case.settle().expect("it hangs");
    let values = case.eigenvalues(Instant::Rest);
    assert_eq!(values.len(), 1);
    assert!(values[0].0.abs() < SAME && near(values[0].1, f64::sqrt(9.81 / 0.7)), "{values:?}");
}

#[test]
fn an_upright_pendulum_falls_at_the_same_rate() {
    let mut case = Case::<2>::new(&scene(2, "[0.0, 9.81]", BOB));
    let found = case.settle().expect("it is balanced");
    assert_eq!(found.unstable, 1);
    let (values, w) = (case.eigenvalues(Instant::Rest), f64::sqrt(9.81 / 0.7));
    assert!(values.len() == 2 && values.iter().all(|x| x.1 == 0.0), "{values:?}");
    assert!(near(values[0].0.abs(), w) && near(values[0].0 + values[1].0, 0.0), "{values:?}");
}

/// Returns a double pendulum, rotated by `turn` [rad], with the bodies in either order.
fn double(turn: f64, is_reversed: bool) -> String {
    let at = |y: f64| format!("[{}, {}]", -y * turn.sin(), y * turn.cos());
    let body = |name: &str, y| {
        format!("[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = {}\ninertia = 0.0\n\n", at(y))
    };
    let joint = |a: &str, b: &str, y| {
        format!(
            "[[joint]]\nname = \"{a}{b}\"\nkind = \"revolute\"\nbodies = [\"{a}\", \"{b}\"]\nat = {}\n\n",
            at(y)
        )
    };
    let g = format!("[{}, {}]", 9.81 * turn.sin(), -9.81 * turn.cos());
    let (a, b) = (body("a", -1.0), body("b", -2.0));
    let (p, q) = (joint("ground", "a", 0.0), joint("b", "a", -1.0));
    let rest = if is_reversed { [b, a, q, p] } else { [a, b, p, q] };
    scene(2, &g, &rest.concat())
}

#[test]
fn a_double_pendulum_has_its_two_frequencies_however_it_is_turned_and_described() {
    // Equal bobs and bars: omega^2 = (2 -+ sqrt 2) g / l.
    for (turn, is_reversed) in [(0.0, false), (0.0, true), (1.1, false), (2.7, true)] {
        let mut case = Case::<2>::new(&double(turn, is_reversed));
        case.settle().expect("it hangs");
        let values = case.eigenvalues(Instant::Rest);
        assert_eq!(values.len(), 2);
        for (value, sign) in values.iter().zip([-1.0, 1.0]) {
            let w = ((2.0 + sign * f64::sqrt(2.0)) * 9.81).sqrt();
            assert!(value.0.abs() < SAME && near(value.1, w), "{turn} {is_reversed}: {values:?}");
        }
    }
}

/// Returns a mass on a spring and a damper along y.
fn sprung(stiffness: f64, damping: f64) -> String {
    scene(
        2,
        "[0.0, -9.81]",
        &format!(
            "[[body]]\nname = \"m\"\nmass = 2.0\ncenter = [0.0, -1.0]\ninertia = 0.1\n\n\
             [[joint]]\nname = \"slide\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"m\"]\nat = [0.0, 0.0]\naxis = [0.0, 1.0]\n\n\
             [[effect]]\nname = \"s\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"m\"]\npoints = [[0.0, 0.0], [0.0, -1.0]]\n\
             stiffness = {stiffness}\ndamping = {damping}\nfree_length = 1.0\n"
        ),
    )
}

#[test]
fn spring_mass_and_damper_below_and_above_critical_damping() {
    for (k, c) in [(800.0, 0.0), (800.0, 12.0), (800.0, 100.0), (0.5, 0.01)] {
        let mut case = Case::<2>::new(&sprung(k, c));
        case.settle().unwrap_or_else(|e| panic!("{k} {c}: {e}"));
        let values = case.eigenvalues(Instant::Rest);
        let (w2, d) = (k / 2.0, c / 4.0);
        if d * d < w2 {
            assert!(near(values[0].0, -d) && near(values[0].1, (w2 - d * d).sqrt()), "{values:?}");
        } else {
            let root = (d * d - w2).sqrt();
            assert!(near(values[0].0, -d + root) && near(values[1].0, -d - root), "{values:?}");
        }
    }
}

#[test]
fn a_thin_rod_on_a_spring_beside_its_line_swings_as_its_energy_says() {
    // The spring holds the rod horizontal. It is attached 0.1 m above the rod's axis, at a direction without mass, which transmits its
    // force.
    // V'' = k l'^2 + F l'',   l' = -1/2,   l l'' = 0.1^2 + 0.5^2 + 0.9 0.1 - l'^2,   I = m/3
    let (m, k, g) = (6.0_f64, 1000.0, 9.81);
    let force = m * g;
    let rod = format!(
        r#"
[[body]]
name = "rod"
mass = {m}
rod = {{ from = [0.0, 0.0, 0.0], to = [0.0, 1.0, 0.0] }}
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "rod"]
at = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[effect]]
kind = "spring-damper"
bodies = ["rod", "ground"]
points = [[0.0, 0.5, 0.1], [0.0, 0.5, 1.0]]
stiffness = {k}
damping = 0.0
free_length = {}
"#,
        0.9 - force / k
    );
    let mut case = Case::<3>::new(&scene(3, &format!("[0.0, 0.0, -{g}]"), &rod));
    let found = case.settle().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((found.unstable, found.neutral), (0, 0));
    let values = case.eigenvalues(Instant::Rest);
    let w = ((k * 0.25 + force * (0.35 - 0.25) / 0.9) / (m / 3.0)).sqrt();
    assert!(values.len() == 1 && near(values[0].1, w), "{values:?} for {w}");
}

#[test]
fn a_hanging_parallelogram_is_one_pendulum() {
    // Cranks and coupler of 1 m and 1 kg hanging down: I phi'' = -g (1/2 + 1/2 + 1) phi, I = 1/3 + 1/3 + 1.
    let text = include_str!("../../../scenes/four-bar.toml").replace("[0.0, -9.81]", "[0.0, 9.81]");
    let mut case = Case::<2>::new(&text);
    let found = case.settle().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((found.unstable, found.neutral), (0, 0));
    let values = case.eigenvalues(Instant::Rest);
    assert_eq!(values.len(), 1, "one freedom in a closed loop");
    assert!(near(values[0].1, f64::sqrt(2.0 * 9.81 / (5.0 / 3.0))), "{values:?}");
}

#[test]
fn a_four_bar_held_by_a_spring_is_the_pendulum_done_by_hand() {
    // The parallelogram above, with its cranks at the angle a from +x. A torsion spring k at the first pivot is relaxed at a = pi/2:
    // V = 2 g sin a + k (a - pi/2)^2 / 2,  equilibrium 2 g cos a + k (a - pi/2) = 0,  I omega^2 = k - 2 g sin a.
    // With k = 30 > 2 g the upright position is stable. Gravity along x tilts it and adds 2 g_x cos a to V.
    let (k, g, gx) = (30.0, 9.81, 3.0);
    let text =
        include_str!("../../../scenes/four-bar.toml").replace("[0.0, -9.81]", "[-3.0, -9.81]");
    let text = format!(
        "{text}\n[[effect]]\nname = \"s\"\nkind = \"torsion-spring\"\njoint = \"pivot-0\"\nstiffness = {k}\ndamping = 0.0\n"
    );
    let mut case = Case::<2>::new(&text);
    let found = case.settle().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((found.unstable, found.neutral), (0, 0));
    let mut a = core::f64::consts::FRAC_PI_2;
    for _ in 0..50 {
        let slope = 2.0 * g * a.cos() - 2.0 * gx * a.sin() + k * (a - core::f64::consts::FRAC_PI_2);
        a -= slope / (k - 2.0 * g * a.sin() - 2.0 * gx * a.cos());
    }
    let tip = case.point(0, [0.0, 1.0, 0.0]);
    assert!((tip[0] - a.cos()).abs() < 1e-10 && (tip[1] - a.sin()).abs() < 1e-10, "{tip:?} {a}");
    let w = ((k - 2.0 * g * a.sin() - 2.0 * gx * a.cos()) / (5.0 / 3.0)).sqrt();
    let values = case.eigenvalues(Instant::Rest);
    assert!(values.len() == 1 && near(values[0].1, w), "{values:?} {w}");
}

#[test]
fn a_spherical_pendulum_swings_twice_and_a_free_body_not_at_all() {
    let rod = r#"
[[body]]
name = "rod"
mass = 2.0
center = [0.0, 0.0, -0.5]
inertia = [0.4, 0.3, 0.2, 0.0, 0.0, 0.0]
[[joint]]
name = "ball"
kind = "spherical"
bodies = ["ground", "rod"]
at = [0.0, 0.0, 0.0]
"#;
    let mut case = Case::<3>::new(&scene(3, "[0.0, 0.0, -9.81]", rod));
    let found = case.settle().expect("it hangs");
    // Moments of inertia about the ball joint have + m l^2; the rotation about the vertical is neutral.
    assert_eq!((found.unstable, found.neutral), (0, 1));
    let values = case.eigenvalues(Instant::Rest);
    let swings: Vec<f64> = values.iter().map(|x| x.1).filter(|w| *w > 1e-2).collect();
    let wanted = [0.4, 0.3].map(|i: f64| f64::sqrt(2.0 * 9.81 * 0.5 / (i + 0.5)));
    assert!(swings.len() == 2 && swings.iter().zip(wanted).all(|(a, b)| near(*a, b)), "{values:?}");
}

/// A cart of 5 kg on a rail at 20 m/s, with a bob of 2 kg on a bar of 0.7 m.
const CART: &str = r#"
[[body]]
name = "cart"
mass = 5.0
center = [0.0, 0.0]
inertia = 0.1
[[body]]
name = "bob"
mass = 2.0
center = [0.0, -0.7]
inertia = 0.0
[[joint]]
name = "rail"
kind = "prismatic"
bodies = ["ground", "cart"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["cart", "bob"]
at = [0.0, 0.0]
[[initial]]
joint = "rail"
rate = 20.0
[[initial]]
joint = "pivot"
rate = 0.0
"#;

#[test]
fn a_cart_that_drives_has_the_modes_of_one_that_stands() {
    let w = f64::sqrt((1.0 + 2.0 / 5.0) * 9.81 / 0.7);
    for instant in [Instant::Motion, Instant::Rest] {
        let mut case = Case::<2>::new(&scene(2, "[0.0, -9.81]", CART));
        if instant == Instant::Rest {
            let found = case.settle().expect("it hangs");
            assert_eq!((found.unstable, found.neutral), (0, 1));
        }
        let linear = case.linear(instant).expect("it is regular");
        assert!(linear.turning < 1e-12, "nothing turns: {}", linear.turning);
        let values = case.eigenvalues(instant);
        let last = values.last().expect("there are modes");
        assert!(last.0.abs() < SAME && near(last.1, w), "{instant:?}: {values:?}");
        // Along the rail the eigenvalue is zero twice. The computed values are rounding errors, and `noise` is an upper bound of them.
        let zero = (1e3 * linear.noise).sqrt();
        assert!(zero < 1e-2 * w, "{zero}");
        assert!(values[..values.len() - 1].iter().all(|x| x.0.hypot(x.1) < zero), "{values:?}");
    }
}

#[test]
fn a_mechanism_that_turns_says_that_its_eigenvalues_hold_for_an_instant() {
    let turning = format!("{BOB}\n[[initial]]\njoint = \"pivot\"\nrate = 3.0\n");
    let mut case = Case::<2>::new(&scene(2, "[0.0, -9.81]", &turning));
    let linear = case.linear(Instant::Motion).expect("it is regular");
    // A constraint row keeps the bar's unit vector at unit length: its centripetal acceleration is the square of the rate.
    assert!((linear.turning - 9.0).abs() < 1e-9, "centripetal: {}", linear.turning);
}

#[test]
fn a_singular_position_has_no_linearisation() {
    // The parallelogram is flat. There its two branches cross, and a motion in most tangent directions violates the constraints.
    let text = include_str!("../../../scenes/four-bar.toml")
        .replace("[0.0, 1.0]", "[1.0, 0.0]")
        .replace("[1.0, 1.0]", "[2.0, 0.0]")
        .replace("value = 0.0\nrate = -1.0", "value = 0.0");
    let mut case = Case::<2>::new(&text);
    let error = case.linear(Instant::Motion).map(|linear| linear.n_freedoms);
    let is_refused =
        matches!(error, Err(LinearError::Singular { .. } | LinearError::NotClosed { .. }));
    assert!(is_refused, "{error:?}");
}

/// Returns two bobs on bars of different lengths, joined by a horizontal coupler without mass.
fn coupled([m1, l1]: [f64; 2], [m2, l2]: [f64; 2]) -> String {
    let bob = |name: &str, x: f64, m: f64| {
        format!("[[body]]\nname = \"{name}\"\nmass = {m}\ncenter = [{x}, 0.0]\ninertia = 0.0\n\n")
    };
    let pin = |name: &str, a: &str, b: &str, x: f64, y: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = [\"{a}\", \"{b}\"]\nat = [{x}, {y}]\n\n"
        )
    };
    let parts = [
        bob("a", 0.0, m1),
        bob("b", 2.0, m2),
        "[[body]]\nname = \"coupler\"\nmass = 0.0\ncenter = [1.0, 0.0]\ninertia = 0.0\n\n".into(),
        pin("left", "ground", "a", 0.0, l1),
        pin("right", "ground", "b", 2.0, l2),
        pin("one", "a", "coupler", 0.0, 0.0),
        pin("two", "coupler", "b", 2.0, 0.0),
    ];
    scene(2, "[0.0, -9.81]", &parts.concat())
}

#[test]
fn bobs_joined_by_a_massless_coupler_swing_with_their_common_frequency() {
    // The coupler carries no vertical force: (m1 + m2) x'' = -(m1 g / l1 + m2 g / l2) x.
    for (a, b) in [([1.0, 0.5], [3.0, 1.5]), ([1e-3, 1.0], [50.0, 0.3])] {
        let mut case = Case::<2>::new(&coupled(a, b));
        case.settle().unwrap_or_else(|e| panic!("{e}"));
        let values = case.eigenvalues(Instant::Rest);
        let w = (9.81 * (a[0] / a[1] + b[0] / b[1]) / (a[0] + b[0])).sqrt();
        assert_eq!(values.len(), 1);
        assert!(values[0].0.abs() < SAME && near(values[0].1, w), "{values:?} {w}");
    }
}
