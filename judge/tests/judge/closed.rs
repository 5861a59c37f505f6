//! Motions with a closed form, or with values computed by other programs.

use crate::{channel, mechanism, run, scene};
use judge::vector::norm;

/// Error after roughly a thousand steps, each with a tolerance of 1e-12 [-].
const CLOSE: f64 = 1e-9;

fn near(found: f64, right: f64, tolerance: f64) {
    assert!((found - right).abs() <= tolerance * (1.0 + right.abs()), "{found}, but {right}");
}

/// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
fn quarter_period(k: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    for _ in 0..30 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * core::f64::consts::PI / a
}

#[test]
fn pendulum_has_the_period_of_the_elliptic_integral() {
    let text = |dimension: &str, gravity: &str, at: &str, to: &str, axis: &str| {
        format!(
            "[scene]\ndimension = {dimension}\ngravity = {gravity}\nduration = 1.0\n[[body]]\nname = \"rod\"\nmass = 2.0\n\
             rod = {{ from = {at}, to = {to} }}\n[[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"rod\"]\n\
             at = {at}\n{axis}\n"
        )
    };
    // released level, 90 degrees from the lowest position: k = sin 45 degrees; uniform rod of 1 m: w0² = 3 g / 2 l
    let period = 4.0 * quarter_period(0.5_f64.sqrt()) / (1.5 * 9.81_f64).sqrt();
    for text in [
        text("2", "[0.0, -9.81]", "[0.0, 0.0]", "[1.0, 0.0]", ""),
        text(
            "3",
            "[0.0, 0.0, -9.81]",
            "[0.0, 0.0, 0.0]",
            "[1.0, 0.0, 0.0]",
            "axis = [0.0, -1.0, 0.0]",
        ),
    ] {
        let m = mechanism(&text);
        let half = run(&m, 0.5 * period);
        near(channel(&m, &half, "pivot")[0], -core::f64::consts::PI, CLOSE);
        let whole = run(&m, period);
        near(channel(&m, &whole, "pivot")[0], 0.0, CLOSE);
    }
}

#[test]
fn a_start_partly_given_is_the_least_change() {
    // reference values by two independent programs
    let m = scene("mbs/tests/field/18-start-of-a-millimetre-pendulum.toml");
    let start = m.start().expect("it starts");
    near(channel(&m, &start, "p_rate")[0], -2.678571, 1e-6);
    // with q given, p is -0.1417805 and -0.4361786 by an independent program, for every size
    for (q, p) in [(0.5, -0.1417805), (1.5, -0.4361786)] {
        for size in [1e-3, 1.0, 100.0] {
            let at = |x: f64| x * size;
            let m = mechanism(&format!(
                "[scene]\ndimension = 2\nduration = 1.0\n\
                 [[body]]\nname = \"a\"\nmass = 1.0\ncenter = [{:?}, {:?}]\ninertia = {:?}\n\
                 [[body]]\nname = \"b\"\nmass = 1.0\ncenter = [{:?}, {:?}]\ninertia = {:?}\n\
                 [[joint]]\nname = \"p\"\nkind = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\n\
                 [[joint]]\nname = \"q\"\nkind = \"revolute\"\nbodies = [\"a\", \"b\"]\nat = [{:?}, 0.0]\n\
                 [[initial]]\njoint = \"q\"\nvalue = {q:?}\n",
                at(0.5),
                at(0.1),
                0.08 * size * size,
                at(1.3),
                at(-0.4),
                0.05 * size * size,
                at(1.0)
            ));
            let start = m.start().expect("it starts");
            near(channel(&m, &start, "p")[0], p, 1e-7);
        }
    }
    let m = scene("mbs/tests/field/18-start-in-f32.toml");
    let start = m.start().expect("it starts");
    near(channel(&m, &start, "j0_rate")[0], -0.825236, 1e-6);
    near(channel(&m, &start, "j1_rate")[0], 2.093675, 1e-6);
}

#[test]
fn a_torque_turns_a_free_body_and_the_rotation_of_a_cylindrical_joint() {
    let m = scene("mbs/tests/field/17-torque-on-planar-free-joint.toml");
    near(run(&m, 0.6).frames[0].w[2], 8.4, CLOSE);
    let m = scene("mbs/tests/field/17-torque-on-reversed-cylindrical.toml");
    let end = run(&m, m.scene.duration);
    let joint = m
        .scene
        .joints
        .iter()
        .position(|j| j.kind == judge::scene::Kind::Cylindrical)
        .expect("there");
    let rates = m.show(&end, judge::scene::Quantity::Rate(joint));
    near(rates[0], 1.661124909, 1e-8);
    near(rates[1], 5.317300217, 1e-8);
}

#[test]
fn a_light_wrist_meets_the_values_of_another_program() {
    let m = scene("mbs/tests/field/09-light-wrist.toml");
    let end = run(&m, 1.0);
    let value = |name: &str| {
        let j = m.scene.joints.iter().position(|j| j.name == name).expect("there");
        m.show(&end, judge::scene::Quantity::Value(j))[0]
    };
    near(value("joint1"), 4.236464485, 1e-8);
    near(value("joint4"), -0.859316134, 1e-8);
    near(value("joint6"), -2.659858416, 1e-8);
    near(value("finger_joint1"), 6.052611540, 1e-8);
}

#[test]
fn two_guided_bars_have_the_reactions_of_the_field() {
    let m = scene("mbs/tests/field/01-guided-two.toml");
    let moved = m.evaluate(&run(&m, 1.0));
    near(moved.reactions[0][0], -27.4375, 1e-4);
    near(moved.reactions[0][1], 19.6200, 1e-4);
    near(moved.reactions[0][5], 19.62, 1e-4);
    near(moved.reactions[1][5], 4.905, 1e-4);
}

#[test]
fn a_top_keeps_its_angular_momenta_and_nods_as_its_energy_says() {
    let m = scene("scenes/spinning-top.toml");
    let momenta = |state: &judge::State| {
        let f = &state.frames[0];
        let turn = judge::vector::rotation(f.q);
        let body = &m.scene.bodies[0];
        let inertia = judge::vector::product(
            &judge::vector::product(&turn, &body.inertia),
            &judge::vector::transpose(&turn),
        );
        let spin = judge::vector::add(
            judge::vector::times(&inertia, f.w),
            judge::vector::scale(body.mass, judge::vector::cross(f.r, f.v)),
        );
        [spin[2], judge::vector::dot(spin, judge::vector::unit(f.r))]
    };
    let (start, end) = (m.start().expect("it starts"), run(&m, 2.0));
    let ([z0, a0], [z1, a1]) = (momenta(&start), momenta(&end));
    near(z1, z0, CLOSE);
    near(a1, a0, CLOSE);
    near(m.invariant(&end), m.invariant(&start), CLOSE);
    near(norm(end.frames[0].r), 0.1, CLOSE);
}

#[test]
fn a_free_body_turns_over_with_its_momentum_and_energy_kept() {
    let m = scene("scenes/free-body.toml");
    let end = run(&m, 10.0);
    let f = &end.frames[0];
    let turn = judge::vector::rotation(f.q);
    let local = judge::vector::transposed_times(&turn, f.w);
    let momentum = judge::vector::times(&turn, [local[0], 2.0 * local[1], 2.5 * local[2]]);
    for (found, right) in momentum.into_iter().zip([0.01, 10.0, -0.025]) {
        near(found, right, CLOSE);
    }
    near(m.invariant(&end), 25.000175 + 0.025, CLOSE);
    near(f.r[0], 1.0, CLOSE);
}

#[test]
fn an_rssr_linkage_closes_as_two_circles_and_a_rod_do() {
    let m = scene("scenes/rssr.toml");
    let end = run(&m, 1.0);
    let (a, b) = (channel(&m, &end, "crank-angle")[0], channel(&m, &end, "rocker-angle")[0]);
    let b = b + 0.4_f64.atan2(0.3);
    let gap = [0.7 - 0.15 * a.sin(), 0.4 + 0.5 * b.cos(), 0.5 * b.sin() - 0.15 * a.cos()];
    near(gap.iter().map(|x| x * x).sum(), 1.0425, CLOSE);
    near(m.invariant(&end), m.invariant(&m.start().expect("it starts")), CLOSE);
}

#[test]
fn a_guided_crank_slider_follows_its_crank() {
    let text = "[scene]\ndimension = 2\nduration = 2.0\ngravity = [0.0, -9.81]\n\
        [[body]]\nname = \"crank\"\nmass = 1.0\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\n\
        [[body]]\nname = \"rod\"\nmass = 1.0\nrod = { from = [1.0, 0.0], to = [4.0, 0.0] }\n\
        [[body]]\nname = \"slider\"\nmass = 2.0\ncenter = [4.0, 0.0]\ninertia = 0.1\n\
        [[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"crank\"]\nat = [0.0, 0.0]\n\
        [[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"crank\", \"rod\"]\nat = [1.0, 0.0]\n\
        [[joint]]\nname = \"c\"\nkind = \"revolute\"\nbodies = [\"rod\", \"slider\"]\nat = [4.0, 0.0]\n\
        [[joint]]\nname = \"d\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"slider\"]\nat = [4.0, 0.0]\naxis = [1.0, 0.0]\n\
        [[guide]]\njoint = \"a\"\nramp = { rate = 3.0 }\n";
    let m = mechanism(text);
    let end = run(&m, 1.7);
    let angle = 3.0 * 1.7_f64;
    near(channel(&m, &end, "a")[0], angle, CLOSE);
    let place = angle.cos() + (9.0 - angle.sin() * angle.sin()).sqrt();
    near(channel(&m, &end, "d")[0], place - 4.0, CLOSE);
}

#[test]
fn a_level_table_goes_from_rest_to_rest() {
    // two rows: 3 s² − 2 s³ of the difference; four rows: through each row, with end rates of zero
    let two = judge::scene::Spline::level(&[[1.0, 0.0], [3.0, 0.6]]);
    for i in 0..10 {
        let s = 0.1 * f64::from(i);
        near(two.at(1.0 + 2.0 * s)[0], 0.6 * s * s * (3.0 - 2.0 * s), CLOSE);
    }
    let points = [[-1.0, 0.2], [0.5, -0.3], [1.0, 0.1], [4.0, 0.5]];
    let four = judge::scene::Spline::level(&points);
    for [t, x] in points {
        near(four.at(t - 1e-12)[0], x, CLOSE);
    }
    near(four.at(-1.0)[1], 0.0, CLOSE);
    near(four.at(4.0 - 1e-12)[1], 0.0, CLOSE);
    near(four.at(0.5 - 1e-9)[2], four.at(0.5 + 1e-9)[2], 1e-6);
}
