//! The trapezoidal rule in double-double: without rounding its error is a series in the step, which extrapolation takes away.

use mbs_augmented::{Options, Workspace, index3};
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
    let options = Options { tolerance: Pair::from_f64(1e-29), ..Options::index3() };
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

/// Extrapolates values at steps 1/n to no step, of an error that is a series in h^power; each entry is one column more.
fn extrapolated(values: &[(u32, Pair)], power: i32) -> Vec<Pair> {
    let mut row: Vec<Pair> = Vec::new();
    let mut best = Vec::new();
    for (j, &(n, value)) in values.iter().enumerate() {
        let mut now = value;
        for l in 0..j {
            let ratio = f64::from(n).powi(power);
            let other = f64::from(values[j - 1 - l].0).powi(power);
            let share = Pair::from_f64(other) / Pair::from_f64(ratio - other);
            let next = now + (now - row[l]) * share;
            row[l] = now;
            now = next;
        }
        row.push(now);
        best.push(now);
    }
    best
}

#[test]
fn extrapolated_index_3_has_the_digits_of_the_elliptic_functions_on_two_four_bars() {
    let scene = scene("two-four-bars");
    let counts = [50, 100, 150, 200, 250, 300, 350, 400, 450, 500];
    let ends = counts.map(|n| (n, end(&scene, Pair::ONE, n)));
    for (i, text) in ["-.19502030194943509364", "-.9807992056621738326"].into_iter().enumerate() {
        let values = ends.map(|(n, end)| (n, end[i]));
        for power in [1, 2] {
            let errors: Vec<String> = extrapolated(&values, power)
                .iter()
                .map(|&x| format!("{:.1e}", (x - pair(text)).abs()))
                .collect();
            println!("component {i}, power {power}: {errors:?}");
        }
    }
}
