//! Inputs and outputs of a linearisation compared with closed forms.

use crate::common::Case;
use mbs_core::model::State;
use mbs_linear::{Instant, Linear, LinearOptions, LinearPorts, Ports, linearise_ports};

/// Allowed relative difference [-]. Differences of fourth order at 1e-4 leave rounding errors alone, about 1e-11 of these numbers.
const SAME: f64 = 1e-9;

fn assert_near(name: &str, found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= SAME * expected.abs().max(1.0),
        "{name}: {found}, not {expected}"
    );
}

fn linearised<const D: usize>(
    case: &mut Case<D>,
    instant: Instant,
    inputs: &[usize],
    measure: impl Fn(&State<f64>) -> Vec<f64>,
) -> (Linear<f64>, LinearPorts<f64>) {
    let mut outputs = |s: &State<f64>| Ok(measure(s));
    let ports = Ports { inputs, outputs: &mut outputs, coordinates: None };
    let how = (instant, &LinearOptions::default());
    linearise_ports(&case.model, how, &case.state, &mut case.w, ports).expect("regular")
}

/// A mass of 2 kg on a spring and a damper along x, with a force along x as an input.
const PUSHED: &str = r#"
[scene]
dimension = 2
duration = 1.0
[[body]]
name = "m"
mass = 2.0
center = [1.0, 0.0]
inertia = 0.1
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "m"]
at = [1.0, 0.0]
axis = [1.0, 0.0]
[[effect]]
name = "spring"
kind = "spring-damper"
bodies = ["ground", "m"]
points = [[0.0, 0.0], [1.0, 0.0]]
stiffness = 50.0
damping = 3.0
free_length = 1.0
[[effect]]
name = "push"
kind = "force"
body = "m"
at = [1.0, 0.0]
value = [0.0, 0.0]
input = true
"#;

#[test]
fn a_force_on_a_sprung_mass_accelerates_it_by_its_inverse_mass() {
    let mut case = Case::<2>::new(PUSHED);
    let measure = |s: &State<f64>| vec![s.q[0], s.v[0], s.a[0]];
    let (linear, ports) = linearised(&mut case, Instant::Rest, &[0, 1], measure);
    assert_eq!((linear.n_freedoms, ports.values.len()), (1, 3));
    let to_x = ports.outputs[0];
    // z = x sqrt(m), and x'' = -k/m x - c/m x' + u/m; nothing moves orthogonal to the slide
    assert_near("dx/dz", to_x.abs(), 0.5_f64.sqrt());
    assert_near("dx''/dz", ports.outputs[2], -25.0 * to_x);
    assert_near("dx'/dz'", ports.outputs[4], to_x);
    assert_near("dx''/dz'", ports.outputs[5], -1.5 * to_x);
    assert_near("dz''/du", ports.forces[0], 0.5 / to_x);
    assert_near("across", ports.forces[1], 0.0);
    for (k, expected) in [0.0, 0.0, 0.5, 0.0, 0.0, 0.0].into_iter().enumerate() {
        assert_near("D", ports.feedthrough[k], expected);
    }
    assert_eq!(ports.input_matrix(1), [0.0, ports.forces[0], 0.0, ports.forces[1]]);
    // the linearised motion is the same as without ports
    assert_eq!(case.linear(Instant::Rest), Ok(linear));
}

/// A cart of 2 kg that a guide moves along x, with a bob of 3 kg at 0.7 m below the cart.
const GUIDED: &str = r#"
[scene]
dimension = 2
gravity = [0.0, -9.81]
duration = 1.0
[[body]]
name = "cart"
mass = 2.0
center = [0.0, 0.0]
inertia = 0.1
[[body]]
name = "bob"
mass = 3.0
center = [0.0, -0.7]
inertia = 0.0
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "cart"]
at = [0.0, 0.0]
axis = [1.0, 0.0]
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["cart", "bob"]
at = [0.0, 0.0]
[[guide]]
joint = "slide"
input = { value = 0.0, rate = 0.0, acceleration = 0.0 }
"#;

#[test]
fn a_guided_cart_swings_its_bob_by_its_acceleration_alone() {
    let mut case = Case::<2>::new(GUIDED);
    let [cart, bob] = [(0, [0.0, 0.0, 0.0]), (1, [0.0, -0.7, 0.0])]
        .map(|(body, at)| case.model.point(mbs_core::scene::BodyId::Body(body), at));
    let measure = |s: &State<f64>| {
        vec![
            cart.value(&s.q)[0],
            bob.value(&s.q)[0] - cart.value(&s.q)[0],
            cart.rate(&s.v)[0],
            bob.rate(&s.v)[0] - cart.rate(&s.v)[0],
            cart.rate(&s.a)[0],
            bob.rate(&s.a)[0] - cart.rate(&s.a)[0],
        ]
    };
    for instant in [Instant::Rest, Instant::Motion] {
        let (linear, ports) = linearised(&mut case, instant, &[0, 1, 2], measure);
        assert_eq!(linear.n_freedoms, 1);
        // y = C (z, z') + D u, with x the position of the bob relative to the cart: x'' = -g/l x - u''
        let x = |column: &[f64]| [column[1], column[3], column[5]];
        let [by_z, by_rate] = [&ports.outputs[..6], &ports.outputs[6..]].map(x);
        for k in 0..3 {
            let of_cart = &ports.feedthrough[6 * k..][..6];
            for (j, expected) in [0, 2, 4].into_iter().zip([0, 1, 2]) {
                assert_near("cart", of_cart[j], if k == expected { 1.0 } else { 0.0 });
            }
            let [place, rate, acceleration] = x(of_cart);
            // the effects of z and z' on position and rate are subtracted
            let (z, z_t) = (place / by_z[0], (rate - by_z[1] * place / by_z[0]) / by_rate[1]);
            let left = acceleration - by_z[2] * z - by_rate[2] * z_t;
            assert_near("x'' by u", left, if k == 2 { -1.0 } else { 0.0 });
        }
        assert_near("x'' by x", by_z[2] / by_z[0], -9.81 / 0.7);
    }
}
