//! The trapezoidal rule in double-double: without rounding its error is a series in the step, which extrapolation takes away.
#![allow(clippy::print_stdout, reason = "what is measured is shown with --nocapture")]

use mbs_augmented::{Options, Penalty, Workspace, index3};
use mbs_core::Real;
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Measures;
use mbs_core::real::DoubleDouble as Pair;
use mbs_core::scene::Scene;
use mbs_core::start::assemble;
use mbs_sparse::Multifrontal;

fn pair(text: &str) -> Pair {
    Pair::from_decimal(text).expect("a number")
}

/// A scene of the repository with 32 digits.
fn scene(name: &str) -> Scene<Pair> {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the scene is there");
    let document = mbs_scene::Document::parse(&text, name).unwrap_or_else(|e| panic!("{e:?}"));
    document.scene().unwrap_or_else(|e| panic!("{e:?}"))
}

/// The first outputs of a scene after `n` steps of index-3 over `duration` [s].
fn end(scene: &Scene<Pair>, duration: Pair, n: u32) -> [Pair; 2] {
    let model = NaturalModel::<Pair, 2>::new(scene).expect("a model");
    let analyse = mbs_sparse::Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let mut state: State<Pair> = start.expect("a start").state;
    let mut workspace = Workspace::new(&model, solver);
    // Large enough that the position decides, not the penalty, what a step near a singular position does.
    let options = Options {
        penalty: Penalty::Scaled(Pair::from_f64(1e10)),
        adaptive_penalty: false,
        ..Options::index3()
    };
    let step = (duration / Pair::from_f64(f64::from(n)), model.length());
    let mut iterations = 0;
    let mut violation = Pair::ZERO;
    for k in 0..n {
        let report = index3::step(&model, step, &options, &mut state, &mut workspace)
            .unwrap_or_else(|e| panic!("step {k} of {n}: {e}"));
        iterations += report.iterations;
        violation = violation.max(report.violation[0]);
    }
    println!("{n} steps, {iterations} iterations, violation {violation:.1e}");
    let mut measures = Measures::new(scene, &model).expect("channels");
    let mut out = vec![Pair::ZERO; measures.n_components()];
    measures.write(&state, |_| [Pair::ZERO; 6], &mut out);
    [out[0], out[1]]
}

/// Extrapolates values of runs in n steps to steps of no length, where the error is a series in all powers of 1/n.
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

/// At 1 s the cranks have passed their singular position once. No run has a step that ends next to it: what that step leaves
/// undecided would be seen in the 15th digit.
#[test]
fn extrapolated_index_3_has_the_digits_of_the_elliptic_functions_on_two_four_bars() {
    let scene = scene("two-four-bars");
    let counts = [100, 200, 300, 400, 500, 600, 700, 800, 900, 1000];
    let ends = counts.map(|n| (n, end(&scene, Pair::ONE, n)));
    for (i, text) in ["-.19502030194943509364", "-.9807992056621738326"].into_iter().enumerate() {
        let got = extrapolated(&ends.map(|(n, end)| (n, end[i])));
        let off = (got - pair(text)).abs();
        println!("{got} is off by {off:.1e} from {text}");
        // The last but two of the digits given, 20 and 19.
        assert!(off <= pair(["1e-18", "1e-17"][i]), "{got} is off by {off:.1e} from {text}");
    }
}
