//! Benchmark of one factorisation with assembly and solution, by our solver and by faer's sparse Cholesky. Counts are printed before times.
//!
//! ```text
//! ours:    residual f = sum f_e,  T = sum T_e = L D L^T,  x = T^-1 f
//! faer:    slot map: T = sum T_e into one sparse matrix;   numeric: permute, L D L^T or L L^T, x = T^-1 f
//! ```

#![allow(missing_docs, reason = "the harness makes undocumented functions")]
#![allow(clippy::print_stdout, reason = "the counts are part of the report")]

#[path = "../../../mbs-sparse/tests/all/common/mod.rs"]
mod common;
#[path = "../../src/runner/bench/faer_rival.rs"]
mod faer_rival;

use common::{Saddle, Sum};
use criterion::{Criterion, criterion_group, criterion_main};
use faer_rival::Rival;
use mbs_sparse::{
    BlockSource, Indefinite, Multifrontal, Options, Pivoting, SpdSolver, SymmetricSolver,
};
use std::hint::black_box;
use std::time::Duration;

fn cases() -> Vec<(&'static str, Sum)> {
    let four = Sum::random(4, vec![vec![0, 1], vec![0, 1, 2, 3]], 1);
    let six = Sum::random(6, vec![vec![0, 1, 2, 3], vec![2, 3, 4, 5], vec![0, 1]], 1);
    vec![
        ("tiny_4", four),
        ("tiny_6", six),
        ("chain_20", Sum::chain(20, 12, 6)),
        ("chain_270", Sum::chain(270, 12, 6)),
        ("chain_2700", Sum::chain(2700, 12, 6)),
        ("star_4x6", Sum::star(4, 6)),
        ("star_4x67", Sum::star(4, 67)),
        ("star_16x169", Sum::star(16, 169)),
        ("star_100x27", Sum::star(100, 27)),
    ]
}

fn ours(c: &mut Criterion, name: &str, label: &str, sum: &Sum, options: Options) {
    let mut solver = Multifrontal::<f64>::analyse(sum, options);
    let (mut x, mut scratch) = (vec![0.0; sum.n], vec![0.0; solver.n_scratch()]);
    if label == "ours" {
        println!("{name}: {:?}", solver.counters());
    }
    let mut group = c.benchmark_group(name);
    group.bench_function(label, |b| {
        b.iter(|| {
            let sum = black_box(sum);
            solver.assemble(sum, &mut x);
            solver.factor(sum).expect("positive definite");
            solver.solve(&mut x, &mut scratch);
            black_box(&mut x);
        });
    });
    if label == "ours" {
        group.bench_function("ours/factor", |b| b.iter(|| solver.factor(black_box(sum))));
        group.bench_function("ours/solve", |b| {
            b.iter(|| solver.solve(black_box(&mut x), &mut scratch));
        });
        group.bench_function("ours/write_blocks", |b| {
            let mut block = vec![0.0_f64; 144];
            b.iter(|| {
                for (e, clique) in sum.cliques.iter().enumerate() {
                    let k = clique.len();
                    black_box(sum).write_block(e, &mut block[..k * (k + 1) / 2]);
                    black_box(&mut block);
                }
            });
        });
    }
    group.finish();
}

fn faer(c: &mut Criterion, name: &str, sum: &Sum) {
    let mut group = c.benchmark_group(name);
    let mut rival = Rival::analyse(sum);
    rival.assemble(sum, sum);
    group.bench_function("faer/assemble", |b| b.iter(|| rival.assemble(black_box(sum), sum)));
    let rhs = vec![1.0; sum.n];
    let mut x = rhs.clone();
    group.bench_function("faer/factor_and_solve", |b| {
        b.iter(|| {
            x.copy_from_slice(&rhs);
            rival.factor_and_solve(black_box(&mut x));
        });
    });
    group.finish();
}

/// Saddle systems: chains of elements of 12 coordinates, 6 shared, with 5 rows each.
fn saddles(c: &mut Criterion) {
    for length in [1, 20, 270, 2700] {
        let saddle = Saddle::chain((length, 12, 6), 5, 3);
        let mut solver = Indefinite::<f64>::analyse(&saddle, Options::default());
        let n = saddle.sum.n;
        let (mut x, mut scratch) = (vec![0.0; n], vec![0.0; solver.n_scratch()]);
        solver.factor(&saddle).expect("regular");
        println!("saddle_{length}: {:?} {:?}", solver.counters(), solver.delays());
        let mut group = c.benchmark_group(format!("saddle_{length}"));
        group.bench_function("factor", |b| b.iter(|| solver.factor(black_box(&saddle))));
        group.bench_function("solve", |b| {
            b.iter(|| solver.solve(black_box(&mut x), &mut scratch));
        });
        group.finish();
    }
}

fn all(c: &mut Criterion) {
    saddles(c);
    let pivoted = Options { pivoting: Pivoting::Diagonal, ..Options::default() };
    for (name, sum) in cases() {
        ours(c, name, "ours", &sum, Options::default());
        ours(c, name, "ours/pivoted", &sum, pivoted);
        faer(c, name, &sum);
    }
}

criterion_group! {
    name = factor;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .without_plots();
    targets = all
}
criterion_main!(factor);
