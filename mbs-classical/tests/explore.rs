//! Scratch.
mod common;
use common::*;
use mbs_core::SymmetricSolver;

fn go<const D: usize>(text: &str, index: Index, dt: f64, end: f64) {
    let sc = scene::<f64>(text);
    let mut run = Run::<f64, D>::new(&sc, index);
    let e0 = run.invariant();
    let n = (end / dt).round() as usize;
    let (mut its, mut fac, mut sol, mut worst, mut v) = (0, 0, 0, 1.0_f64, [0.0_f64; 3]);
    let (mut emax, mut delays) = (0.0_f64, 0);
    for i in 0..n {
        match run.step(dt) {
            Ok(r) => {
                its += r.iterations;
                fac += r.factorizations;
                sol += r.solves;
                for k in 0..3 { v[k] = v[k].max(r.violation[k]); }
            }
            Err(e) => {
                println!("{:20} {index:?} {dt:.0e}: step {i} t={:.4}: {e:?}, worst {worst:.1e}", sc.name, run.state.t);
                return;
            }
        }
        worst = worst.min(run.w.solver().weakest().ratio);
        delays = delays.max(run.w.solver().delays().delayed);
        if i % 10 == 9 { emax = emax.max((run.invariant() - e0).abs()); }
    }
    let n = n as f64;
    println!("{:20} {index:?} {dt:.0e}: its {:.2} fac {:.2} sol {:.2} worst {worst:.1e} dE max {emax:.3e} end {:.3e} viol {:.0e} {:.0e} {:.0e} delays {delays}",
        sc.name, its as f64 / n, fac as f64 / n, sol as f64 / n, run.invariant() - e0, v[0], v[1], v[2]);
}

#[test]
fn explore() {
    for index in [Index::Three, Index::One] {
        for dt in [1e-2, 1e-3] {
            go::<2>(SIMPLE, index, dt, 2.0);
            go::<2>(DOUBLE, index, dt, 10.0);
            go::<2>(TWO_FOUR_BARS, index, dt, 10.0);
            go::<3>(CHAIN, index, dt, 1.0);
            go::<3>(REDUNDANT, index, dt, 1.0);
            go::<3>(TOP, index, dt, 1.0);
            go::<3>(FREE, index, dt, 1.0);
            go::<2>(GUIDED, index, dt, 2.0);
            go::<2>(SLIDER, index, dt, 2.0);
            go::<2>(N_FOUR_BAR, index, dt, 2.0);
        }
    }
    go::<2>(DOUBLE, Index::Three, 1e-4, 10.0);
    go::<2>(TWO_FOUR_BARS, Index::Three, 1e-4, 10.0);
}
