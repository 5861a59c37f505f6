//! The trapezoidal rule in double-double. Without rounding, its error is a power series in the step, which extrapolation removes.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

use mbs_augmented::{Options, Penalty, Workspace, index3};
use mbs_core::Real;
use mbs_core::outputs::Measures;
use mbs_core::real::DoubleDouble as Pair;
use mbs_core::scene::{Output, Quantity, Scene};
use mbs_core::step::Step;
use mbs_testkit::{file_in, solver, start_in};

fn pair(text: &str) -> Pair {
    Pair::from_decimal(text).expect("a number")
}

/// Position and velocity of the first crank's end at each of the `times` [s], in steps of 1/n s of index-3.
fn ends(scene: &Scene<Pair>, times: &[u32], n: u32) -> Vec<[Pair; 4]> {
    let (model, mut state) = start_in::<Pair, 2>(scene);
    let mut workspace = Workspace::new(&model, solver(&model));
    // The penalty is so large that it does not affect a step that ends close to a singular position.
    let options = Options {
        penalty: Penalty::Scaled(Pair::from_f64(1e10)),
        adaptive_penalty: false,
        ..Options::index3()
    };
    let step = Step { dt: Pair::ONE / Pair::from_f64(f64::from(n)), length: model.length() };
    let mut measures = Measures::new(scene, &model).expect("channels");
    let mut out = vec![Pair::ZERO; measures.n_components()];
    let mut violation = Pair::ZERO;
    let mut ends = Vec::new();
    let last = times.last().expect("a time");
    for k in 1..=n * last {
        let report = index3::step(&model, step, &options, &mut state, &mut workspace)
            .unwrap_or_else(|e| panic!("step {k} of 1/{n} s: {e}"));
        violation = violation.max(report.violation[0]);
        if times.iter().any(|&t| k == n * t) {
            measures.write(&state, None, &mut out).expect("no turn is lost");
            let &[x, y, .., vx, vy] = &out[..] else { panic!("position first, velocity last") };
            ends.push([x, y, vx, vy]);
        }
    }
    println!("steps of 1/{n} s: violation {violation:.1e}");
    assert!(violation < pair("1e-27"), "a step of 1/{n} s ends next to a singular position");
    ends
}

/// Extrapolates values of runs with n steps to zero step length, for an error that is a series in all powers of 1/n.
fn extrapolated(values: &[(u32, Pair)]) -> Pair {
    let mut row: Vec<Pair> = Vec::new();
    for (j, &(n, value)) in values.iter().enumerate() {
        let mut now = value;
        for l in 0..j {
            let [many, few] = [n, values[j - 1 - l].0].map(f64::from);
            let next = now + (now - row[l]) * Pair::from_f64(few) / Pair::from_f64(many - few);
            row[l] = now;
            now = next;
        }
        row.push(now);
    }
    row.pop().expect("a value")
}

/// Exact position [m] and velocity [m/s] of the first crank's end at a time [s], by elliptic functions, while all cranks are parallel. Each
/// exact value comes after the allowed error of the extrapolated value.
type Exact = (u32, [(&'static str, &'static str); 4]);

/// Compares extrapolated runs with the exact values. `counts` are the numbers of steps per second.
fn hold(counts: &[u32], exact: &[Exact]) {
    let mut scene = file_in("two-four-bars");
    let Quantity::Position { body, at } = scene.outputs[0].quantity else { panic!("a position") };
    let velocity = Quantity::Velocity { body, at };
    scene.outputs.push(Output::new(velocity).named("crank-end-velocity"));
    let times: Vec<u32> = exact.iter().map(|(t, _)| *t).collect();
    let runs: Vec<_> = counts.iter().map(|&n| (n, ends(&scene, &times, n))).collect();
    for (place, (t, values)) in exact.iter().enumerate() {
        for (i, (digits, text)) in values.iter().enumerate() {
            let column: Vec<_> = runs.iter().map(|(n, ends)| (*n, ends[place][i])).collect();
            let got = extrapolated(&column);
            let off = (got - pair(text)).abs();
            println!("{t} s: {got} is off by {off:.1e} from {text}");
            assert!(off <= pair(digits), "{t} s: {got} is off by {off:.1e} from {text}");
        }
    }
}

/// At 1 s the cranks have passed their singular position once. None of the runs has a step that ends close to that position. After such a
/// step the result would be undetermined in the 15th digit.
#[test]
fn extrapolated_index_3_has_the_digits_of_the_elliptic_functions_on_two_four_bars() {
    let exact = [
        // The exact values have 20 and 19 digits. The limits compare all digits except the last two.
        ("1e-18", "-.19502030194943509364"),
        ("1e-17", "-.9807992056621738326"),
        ("1e-17", "-6.6766780368811580662"),
        ("1e-17", "1.3275783251604872139"),
    ];
    hold(&[100, 200, 300, 400, 500, 600, 700, 800, 900, 1000], &[(1, exact)]);
}

/// After 10 s the cranks have passed ten singular positions. Runs with 300 and 700 steps per second are left out, because some of their
/// steps end close to a singular position. The remaining step lengths are similar, so that extrapolation multiplies the rounding error of
/// each run by 2e6. The remaining terms of the series also grow with time.
#[test]
fn extrapolated_index_3_has_15_digits_after_ten_singular_positions() {
    let at_5 = [
        ("1e-15", "-.81131046100510741219"),
        ("1e-15", "-.58461554534897554768"),
        ("1e-15", "-3.5691173971932091857"),
        ("1e-15", "4.9531051713133269734"),
    ];
    let at_10 = [
        ("1e-15", ".32845811154081537865"),
        ("1e-15", ".94451853817860096216"),
        ("1e-15", "1.4230514702069441233"),
        ("1e-15", "-.49486884548704295899"),
    ];
    let counts = [200, 250, 350, 400, 450, 500, 550, 600, 650, 750, 800, 850];
    hold(&counts, &[(5, at_5), (10, at_10)]);
}
