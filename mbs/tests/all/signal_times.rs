//! Jumps and corners of signals: controlled steps end at them. Closed forms give the motion.

use crate::common::oracle::last;
use mbs::core::scene::Scene;
use mbs::{FormulationKind, IntegratorKind, Method, Outcome, StepRule};
use mbs_testkit::scene;

/// Methods that control the error of their steps.
fn methods() -> impl Iterator<Item = Method> {
    use IntegratorKind::{Extrapolation, Radau5, Rk54, Rk853, Trapezoidal};
    let natural = ["index-3", "index-1", "classical", "state-space"];
    let natural =
        natural.map(|name| Method { formulation: Some(name.to_owned()), ..Method::default() });
    let of = |i| Method::new(FormulationKind::Recursive).integrator(i);
    let relative = [Trapezoidal, Rk54, Rk853, Extrapolation, Radau5].map(of);
    natural.into_iter().chain(relative).map(|method| {
        let has_rows = has_rows_of_its_own(&method);
        if has_rows { method.step(0.2) } else { method.control(StepRule::Error) }
    })
}

/// True if the integrator controls its steps itself, within the interval between two rows.
fn has_rows_of_its_own(method: &Method) -> bool {
    method.integrator.as_deref().is_some_and(|i| i != "trapezoidal")
}

fn name(method: &Method) -> String {
    format!("{:?} {:?}", method.formulation, method.integrator)
}

/// Scene of a wheel of 2 kg m^2, with or without a spring, and a torque that follows a signal.
fn wheel(stiffness: f64, duration: f64, signal: &str) -> Scene<f64> {
    scene(&format!(
        "[scene]\nname = \"s\"\ndimension = 2\nduration = {duration:?}\n\
         [[body]]\nname = \"b\"\nmass = 2.0\ncenter = [0.0, 0.0]\ninertia = 2.0\n\
         [[joint]]\nname = \"x\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [0.0, 0.0]\n\
         [[signal]]\nname = \"push\"\n{signal}\n\
         [[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"x\"\nsignal = \"push\"\n\
         [[effect]]\nname = \"spring\"\nkind = \"torsion-spring\"\njoint = \"x\"\nstiffness = {stiffness:?}\ndamping = 0.0\n\
         [[output]]\nname = \"v\"\njoint = \"x\"\nquantity = \"value\"\n\
         [[output]]\nname = \"r\"\njoint = \"x\"\nquantity = \"rate\"\n"
    ))
}

fn run(scene: &Scene<f64>, method: &Method) -> Outcome {
    let outcome = crate::common::run(scene, method);
    assert!(outcome.error.is_none(), "{}: {:?}", name(method), outcome.error);
    outcome
}

/// The larger error of value and rate at the end.
fn error(outcome: &Outcome, right: [f64; 2]) -> f64 {
    let end = last(outcome.rows());
    (end[0] - right[0]).abs().max((end[1] - right[1]).abs())
}

#[test]
fn a_jump_of_a_force_costs_no_accuracy_and_fewer_rejected_steps() {
    // from 0.3123 s on, the equation is 2 x'' = 5 - 50 x, so x = 0.1 (1 - cos 5 s) with the time s since then
    let (at, duration) = (0.3123, 1.0);
    let signal = format!("kind = \"step\"\nto = 5.0\nat = {at:?}");
    let scene = wheel(50.0, duration, &signal);
    let turn = 5.0 * (duration - at);
    let right = [0.1 * (1.0 - turn.cos()), 0.5 * turn.sin()];
    for method in methods() {
        let method = if has_rows_of_its_own(&method) {
            Method { tolerance: Some(1e-7), ..method }
        } else {
            Method { error_tolerance: Some(1e-7), ..method }
        };
        let [with, without] = [true, false]
            .map(|events| run(&scene, &Method { events: Some(events), ..method.clone() }));
        let errors = [&with, &without].map(|outcome| error(outcome, right));
        let rejected = [&with, &without]
            .map(|outcome| outcome.summary.control.as_ref().map_or(0, |c| c.rejected));
        println!("{}: {errors:?}, {rejected:?}", name(&method));
        // the limit covers a tolerance of 1e-7 of the scene's length for each of some hundred trapezoidal steps
        assert!(errors[0] < 1e-4 && errors[0] < 1.1 * errors[1] + 1e-9, "{errors:?}");
        assert!(rejected[0] <= rejected[1], "{}: {rejected:?}", name(&method));
        // a row is at the jump if rows are at the controlled steps
        let is_there =
            has_rows_of_its_own(&method) || with.rows().iter().any(|(t, _)| (t - at).abs() < 1e-12);
        assert!(is_there, "{}", name(&method));
    }
}

#[test]
fn a_square_wave_is_met_to_rounding_by_every_method() {
    // 2 x'' = +-4, alternating every 0.05 s: each piece is a parabola, which all methods integrate exactly
    let signal = "kind = \"table\"\ninterpolation = \"hold\"\nperiodic = true\ntable = [[0.0, 4.0], [0.05, -4.0], [0.1, 4.0]]";
    let scene = wheel(0.0, 0.93, signal);
    let (mut right, h) = ([0.0, 0.0], 0.01);
    for k in 0..93 {
        let a = if k / 5 % 2 == 0 { 2.0 } else { -2.0 };
        right = [right[0] + h * right[1] + 0.5 * h * h * a, right[1] + h * a];
    }
    for method in methods() {
        let found = error(&run(&scene, &method), right);
        println!("{}: {found:.1e}", name(&method));
        // each of 18 jumps is passed with a delay of 32 roundings of its time, and steps are solved to 1e-10
        assert!(found < 1e-9, "{}: {found:e}", name(&method));
    }
}

#[test]
fn corners_of_a_force_cost_no_accuracy() {
    // the torque is a triangle from 0.2 s over 0.4137 s to 0.9 s, so x''' is constant in each piece
    let rows = [[0.2, 0.0], [0.4137, 6.0], [0.9, 0.0]];
    let signal = format!("kind = \"table\"\ninterpolation = \"linear\"\ntable = {rows:?}");
    let scene = wheel(0.0, 1.0, &signal);
    let (mut t, mut right) = (0.0, [0.0, 0.0, 0.0]);
    for (end, slope) in [
        (0.2, 0.0),
        (0.4137, 6.0 / 2.0 / (0.4137 - 0.2)),
        (0.9, -6.0 / 2.0 / (0.9 - 0.4137)),
        (1.0, 0.0),
    ] {
        let h: f64 = end - t;
        let [x, v, a] = right;
        right = [
            x + h * v + h * h * (0.5 * a + h * slope / 6.0),
            v + h * (a + 0.5 * h * slope),
            a + h * slope,
        ];
        t = end;
    }
    for method in methods() {
        let outcome = run(&scene, &method);
        for row in &rows {
            let is_there = has_rows_of_its_own(&method)
                || outcome.rows().iter().any(|(t, _)| (t - row[0]).abs() < 1e-12);
            assert!(is_there, "{}: {row:?}", name(&method));
        }
        let found = error(&outcome, [right[0], right[1]]);
        println!("{}: {found:.1e}", name(&method));
        // methods of order three and more are exact
        let is_low = method.integrator.as_deref().is_none_or(|i| i == "trapezoidal");
        assert!(found < if is_low { 1e-4 } else { 1e-10 }, "{}: {found:e}", name(&method));
    }
}

#[test]
fn fixed_steps_pass_jumps_with_the_same_bits_whatever_events_say() {
    let scene = wheel(50.0, 0.5, "kind = \"step\"\nto = 5.0\nat = 0.3123");
    for formulation in ["index-3", "recursive"] {
        let rows = [true, false].map(|events| {
            let formulation = Some(formulation.to_owned());
            let method = Method { formulation, events: Some(events), ..Method::default() };
            run(&scene, &method).rows().to_vec()
        });
        assert!(rows[0] == rows[1], "{formulation}");
    }
}
