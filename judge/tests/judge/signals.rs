//! Signals, tables and sums with closed forms.

use crate::{channel, mechanism, run};

/// Tolerance of values with a closed form, by steps to 1e-12 [-].
const CLOSE: f64 = 1e-9;

fn near(what: &str, found: f64, right: f64) {
    let off = (found - right).abs();
    assert!(off <= CLOSE * (1.0 + right.abs()), "{what}: {found}, but {right}");
}

/// A body of 2 kg that slides along x without gravity, with further text of a scene.
fn slide(more: &str) -> String {
    format!(
        "[scene]\ndimension = 2\nduration = 1.0\n[[body]]\nname = \"block\"\nmass = 2.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n\
         [[joint]]\nname = \"rail\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"block\"]\nat = [0.0, 0.0]\naxis = [1.0, 0.0]\n{more}"
    )
}

fn signal(name: &str, rest: &str) -> String {
    format!(
        "[[signal]]\nname = \"{name}\"\n{rest}\n[[output]]\nname = \"{name}\"\nsignal = \"{name}\"\n"
    )
}

#[test]
fn a_controller_moves_a_block_as_its_poles_say() {
    let text = slide(
        &[
            signal("place", "kind = \"measure\"\njoint = \"rail\""),
            signal("asked", "kind = \"constant\"\nvalue = 0.0"),
            signal("servo", "kind = \"pid\"\ntarget = \"asked\"\nmeasured = \"place\"\np = 18.0\nd = 4.0"),
            "[[effect]]\nkind = \"torque\"\njoint = \"rail\"\nsignal = \"servo\"\n\
             [[initial]]\njoint = \"rail\"\nvalue = 1.0\nrate = -1.0\n[[output]]\nname = \"x\"\njoint = \"rail\"\n"
                .to_owned(),
        ]
        .concat(),
    );
    let m = mechanism(&text);
    let end = run(&m, 1.0);
    // solution of x'' + 2 x' + 9 x = 0: e^-t (cos w t + (x'(0) + x(0))/w sin w t), w = sqrt 8
    let w = 8.0_f64.sqrt();
    near("block", channel(&m, &end, "x")[0], (-1.0_f64).exp() * w.cos());
}

#[test]
fn lags_integrals_and_limits_follow_time() {
    let text = slide(
        &[
            signal("one", "kind = \"constant\"\nvalue = 1.0"),
            signal("behind", "kind = \"lag\"\nof = \"one\"\ntime = 0.25\nvalue = 0.5"),
            signal("way", "kind = \"integral\"\nof = \"behind\"\nupper = 0.4"),
            signal("held", "kind = \"clamp\"\nof = \"behind\"\nlower = 0.0\nupper = 0.9"),
            signal("twice", "kind = \"sum\"\nof = [\"behind\", \"one\"]\nfactors = [2.0, -1.0]"),
            signal("square", "kind = \"product\"\nof = [\"behind\", \"behind\"]"),
            signal("left", "kind = \"limit-ratio\"\nof = \"behind\"\nlower = -0.1\nupper = 0.2"),
            signal("curve", "kind = \"curve\"\nof = \"behind\"\ncoefficients = [1.0, 0.0, 3.0]"),
        ]
        .concat(),
    );
    let m = mechanism(&text);
    let (half, end) = (run(&m, 0.5), run(&m, 1.0));
    let lag = |t: f64| 1.0 - 0.5 * (-4.0 * t).exp();
    near("lag", channel(&m, &end, "behind")[0], lag(1.0));
    let way = 0.5 - 0.125 * (1.0 - (-2.0_f64).exp());
    near("integral", channel(&m, &half, "way")[0], way);
    // the time at which a limit is reached is known to the length of a step
    assert!((channel(&m, &end, "way")[0] - 0.4).abs() < 1e-3);
    near("clamp", channel(&m, &end, "held")[0], 0.9);
    near("sum", channel(&m, &end, "twice")[0], 2.0 * lag(1.0) - 1.0);
    near("product", channel(&m, &end, "square")[0], lag(1.0) * lag(1.0));
    near("limit-ratio", channel(&m, &end, "left")[0], 0.2 / lag(1.0));
    near("curve", channel(&m, &end, "curve")[0], 1.0 + 3.0 * lag(1.0) * lag(1.0));
}

#[test]
fn tables_go_through_their_rows_as_their_interpolation_says() {
    let rows = "[[0.0, 1.0], [1.0, 3.0], [2.0, 2.0]]";
    let table = |how: &str| format!("kind = \"table\"\ntable = {rows}\n{how}");
    let text = slide(
        &[
            signal("linear", &table("interpolation = \"linear\"")),
            signal("hold", &table("interpolation = \"hold\"")),
            signal("spline", &table("")),
            signal("again", &table("interpolation = \"hold\"\nperiodic = true")),
        ]
        .concat(),
    );
    let m = mechanism(&text);
    let at = |t: f64| {
        let mut state = m.start().expect("it starts");
        state.t = t;
        ["linear", "hold", "spline", "again"].map(|name| channel(&m, &state, name)[0])
    };
    // natural spline of three rows: M₁ = 3 (s₁ - s₀)/(h₀ + h₁) with chord slopes 2 and -1, M₁ = -4.5
    let spline = 2.0 - 4.5 * (0.125 - 0.5) / 6.0;
    let right = [2.0, 1.0, spline, 1.0];
    at(0.5).into_iter().zip(right).for_each(|(found, right)| near("at half", found, right));
    near("a jump", at(1.0)[1], 3.0);
    near("held", at(5.0)[0], 2.0);
    near("the second period", at(3.5)[3], 3.0);
}

#[test]
fn a_jump_of_a_force_ends_a_step() {
    let text = slide(
        &[
            signal("push", "kind = \"step\"\nto = 4.0\nat = 0.3"),
            "[[effect]]\nkind = \"torque\"\njoint = \"rail\"\nsignal = \"push\"\n[[output]]\nname = \"x\"\njoint = \"rail\"\n"
                .to_owned(),
        ]
        .concat(),
    );
    let m = mechanism(&text);
    near("block", channel(&m, &run(&m, 1.0), "x")[0], 0.49);
}

#[test]
fn a_twist_of_a_ball_is_a_signal() {
    // input 63 of `mbs/tests/field`; the arm rotates about its own axis at 2 rad/s
    let text = "[scene]\ndimension = 3\ngravity = [0.0, 0.0, -9.81]\nduration = 0.2\n\
        [[body]]\nname = \"arm\"\nmass = 1.0\ncenter = [0.0, 0.0, -0.4]\ninertia = [0.05, 0.06, 0.01, 0.0, 0.0, 0.0]\n\
        [[joint]]\nname = \"shoulder\"\nkind = \"spherical\"\nbodies = [\"ground\", \"arm\"]\nat = [0.0, 0.0, 0.0]\n\
        [[initial]]\njoint = \"shoulder\"\nvalue = [0.0, 0.0, 0.0]\nrate = [0.0, 0.0, 2.0]\n\
        [[signal]]\nname = \"twist\"\nkind = \"measure\"\njoint = \"shoulder\"\ncoordinate = \"twist\"\naxis = [0.0, 0.0, 1.0]\n\
        [[output]]\nname = \"twist\"\nsignal = \"twist\"\n";
    let m = mechanism(text);
    near("twist", channel(&m, &run(&m, 0.2), "twist")[0], 0.4);
}
