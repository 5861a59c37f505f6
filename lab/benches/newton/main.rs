//! Benchmark of one Newton iteration of index-3 and its parts, of faer on the same tangent, and of complete steps. Counts are printed
//! before times.
//!
//! ```text
//! newton:   phi, J by increments (advance),   T = sum T_e = L D L^T (factor, assembly included),
//!           f = M a + J^T mu - Q (residual),   d = T^-1 f (solve),   dq, q, v, a, lambda follow
//! faer:     T already assembled; numeric factorisation and solution
//! ```

#![allow(missing_docs, reason = "the harness makes undocumented functions")]
#![allow(clippy::print_stdout, reason = "the counts are part of the report")]

#[path = "../../src/runner/bench/faer_rival.rs"]
mod faer_rival;
mod iteration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use faer_rival::Rival;
use iteration::Iteration;
use mbs_augmented::{Options, StepReport, Workspace, index1, index3};
use mbs_core::Cliques;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Dimension;
use mbs_core::start::assemble;
use mbs_core::step::Step;
use mbs_scene::SceneFile;
use mbs_sparse::Multifrontal;
use std::hint::black_box;
use std::time::Duration;

const SCENES: [(&str, &str); 3] = [
    ("double-pendulum", include_str!("../../../scenes/double-pendulum.toml")),
    ("two-four-bars", include_str!("../../../scenes/two-four-bars.toml")),
    ("spatial-chain-20", include_str!("../../../scenes/spatial-chain-20.toml")),
];
/// Length of the steps [s].
const DT: f64 = 1e-3;
/// Number of steps over which counts are averaged: one second of motion.
const N_COUNTED: u32 = 1000;
/// Number of steps before the benchmarks begin, so that they are not at the special configuration of the start.
const N_BEFORE: u32 = 200;

type OneStep<const D: usize> = fn(
    &NaturalModel<f64, D>,
    &mut State<f64>,
    &mut Workspace<f64, Multifrontal<f64>>,
) -> StepReport<f64>;

fn step3<const D: usize>(
    model: &NaturalModel<f64, D>,
    s: &mut State<f64>,
    w: &mut Workspace<f64, Multifrontal<f64>>,
) -> StepReport<f64> {
    index3::step(model, Step { dt: DT, length: model.length() }, &Options::index3(), s, w)
        .expect("step")
}

fn step1<const D: usize>(
    model: &NaturalModel<f64, D>,
    s: &mut State<f64>,
    w: &mut Workspace<f64, Multifrontal<f64>>,
) -> StepReport<f64> {
    index1::step(model, Step { dt: DT, length: model.length() }, &Options::index1(), s, w)
        .expect("step")
}

/// The state after some steps.
fn advanced<const D: usize>(
    model: &NaturalModel<f64, D>,
    start: &State<f64>,
    n_steps: u32,
    step: OneStep<D>,
) -> (State<f64>, [f64; 3]) {
    let (mut s, mut w) = (start.clone(), workspace(model));
    let mut counts = [0.0; 3];
    for _ in 0..n_steps {
        let report = step(model, &mut s, &mut w);
        let of_step = [report.iterations, report.factorizations, report.solves];
        for (sum, count) in counts.iter_mut().zip(of_step) {
            *sum += f64::from(count) / f64::from(n_steps);
        }
    }
    (s, counts)
}

fn workspace<const D: usize>(model: &NaturalModel<f64, D>) -> Workspace<f64, Multifrontal<f64>> {
    Workspace::new(model, Multifrontal::analyse(model, mbs_sparse::Options::default()))
}

fn all(c: &mut Criterion) {
    for (name, text) in SCENES {
        let document = SceneFile::parse(text, name).expect("scene");
        let dimension = document.scene::<f64>().expect("scene").dimension;
        match dimension {
            Dimension::Planar => scene::<2>(c, name, &document),
            Dimension::Spatial => scene::<3>(c, name, &document),
        }
    }
}

fn scene<const D: usize>(c: &mut Criterion, name: &str, document: &SceneFile) {
    let scene = document.scene::<f64>().expect("scene");
    let model = NaturalModel::<f64, D>::new(&scene).expect("model");
    let mut solver = Multifrontal::analyse(&model, mbs_sparse::Options::default());
    let counters = solver.counters();
    let options = mbs_sparse::Options::default();
    let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, options), &mut solver)
        .expect("start")
        .state;
    let rival = Rival::analyse(&model);
    let (n, m, e) = (model.n_unknowns(), model.n_constraints(), model.n_elements());
    println!("{name}: n {n}, m {m}, elements {e}, {counters:?}, faer L {}", rival.n_entries());
    for (index, step) in [("index-3", step3::<D> as OneStep<D>), ("index-1", step1::<D>)] {
        let [iterations, factorizations, solves] = advanced(&model, &start, N_COUNTED, step).1;
        println!(
            "{name}: {index}, {N_COUNTED} steps of {DT} s: {iterations:.3} iterations, \
             {factorizations:.3} factorisations, {solves:.3} solves a step"
        );
    }
    let (state, _) = advanced(&model, &start, N_BEFORE, step3::<D>);
    let mut group = c.benchmark_group(name);
    newton(&mut group, &model, &state, solver);
    faer(&mut group, &model, &state, rival);
    for (index, step) in [("step/index3", step3::<D> as OneStep<D>), ("step/index1", step1::<D>)] {
        let (mut s, mut w) = (state.clone(), workspace(&model));
        // Every timed step begins at the same state, with a workspace that other steps have used.
        step(&model, &mut s, &mut w);
        let from = s.clone();
        group.bench_function(index, |b| {
            b.iter(|| {
                s.copy_from(&from);
                step(&model, &mut s, &mut w)
            });
        });
    }
    group.finish();
}

fn newton<const D: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
    solver: Multifrontal<f64>,
) {
    let mut it = Iteration::new(model, state, solver);
    let size = it.newton();
    assert!(size < 1e-2, "the first correction is small: {size}");
    group.bench_function("newton", |b| b.iter(|| black_box(&mut it).newton()));
    group.bench_function("newton/advance", |b| b.iter(|| black_box(&mut it).advance()));
    group.bench_function("newton/factor", |b| b.iter(|| black_box(&mut it).factor()));
    group.bench_function("newton/residual", |b| b.iter(|| black_box(&mut it).residual()));
    let rhs = it.f.clone();
    group.bench_function("newton/solve", |b| {
        b.iter(|| {
            it.f.copy_from_slice(&rhs);
            black_box(&mut it).solve();
        });
    });
    it.f.fill(0.0);
    group.bench_function("newton/update", |b| b.iter(|| black_box(&mut it).update()));
}

fn faer<const D: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
    mut rival: Rival,
) {
    let solver = Multifrontal::analyse(model, mbs_sparse::Options::default());
    let mut it = Iteration::new(model, state, solver);
    it.advance();
    it.residual();
    let rhs = it.f.clone();
    rival.assemble(model, &it.system());
    let mut x = rhs.clone();
    rival.factor_and_solve(&mut x);
    it.factor();
    it.solve();
    let largest = x.iter().zip(&it.f).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
    println!("largest difference to faer's solution: {largest:.1e}");
    group.bench_function("faer/assemble", |b| {
        b.iter(|| rival.assemble(model, &black_box(&mut it).system()));
    });
    group.bench_function("faer/factor_and_solve", |b| {
        b.iter(|| {
            x.copy_from_slice(&rhs);
            rival.factor_and_solve(black_box(&mut x));
        });
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .without_plots();
    targets = all
}
criterion_main!(benches);
