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
                for k in 0..3 {
                    v[k] = v[k].max(r.violation[k]);
                }
            }
            Err(e) => {
                println!(
                    "{:20} {index:?} {dt:.0e}: step {i} t={:.4}: {e:?}, worst {worst:.1e}",
                    sc.name, run.state.t
                );
                return;
            }
        }
        worst = worst.min(run.w.solver().weakest().ratio);
        delays = delays.max(run.w.solver().delays().delayed);
        if i % 10 == 9 {
            emax = emax.max((run.invariant() - e0).abs());
        }
    }
    let n = n as f64;
    println!(
        "{:20} {index:?} {dt:.0e}: its {:.2} fac {:.2} sol {:.2} worst {worst:.1e} dE max {emax:.3e} end {:.3e} viol {:.0e} {:.0e} {:.0e} delays {delays}",
        sc.name,
        its as f64 / n,
        fac as f64 / n,
        sol as f64 / n,
        run.invariant() - e0,
        v[0],
        v[1],
        v[2]
    );
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
}

#[test]
fn bars() {
    let exact = [0.32845811154081537865 / 2.0, 0.94451853817860096216 / 2.0];
    for index in [Index::Three, Index::One] {
        for reg in [None, Some(1e-8)] {
            for dt in [1e-2_f64, 7e-3, 5e-3, 3e-3, 2e-3, 1.3e-3, 1e-3, 7.7e-4, 5e-4, 2e-4, 1e-4] {
                let sc = scene::<f64>(TWO_FOUR_BARS);
                let mut run = Run::<f64, 2>::new(&sc, index);
                run.options.regularisation = reg;
                let e0 = run.invariant();
                let n = (10.0 / dt).round() as usize;
                let dt = 10.0 / n as f64;
                let (mut worst, mut emax, mut its) = (1.0_f64, 0.0_f64, 0);
                let mut err = None;
                for _ in 0..n {
                    match run.step(dt) {
                        Ok(r) => its += r.iterations,
                        Err(e) => {
                            err = Some(e);
                            break;
                        }
                    }
                    worst = worst.min(run.w.solver().weakest().ratio);
                    emax = emax.max((run.invariant() - e0).abs());
                }
                let p = run.points()[0];
                println!(
                    "{index:?} reg {reg:?} dt {dt:.0e}: t={:.4} its {:.2} worst {worst:.1e} emax {emax:.3e} off {:.2e} {err:?}",
                    run.state.t,
                    f64::from(its) / n as f64,
                    (p[0] - exact[0]).hypot(p[1] - exact[1])
                );
            }
        }
    }
}

#[test]
fn delays() {
    use mbs_classical::{Saddle, Workspace};
    use mbs_core::dense::front::Thresholds;
    use mbs_sparse::Indefinite;
    for growth in [0.05, 0.01, 1e-3, 1e-4, 1e-6] {
        for text in [CHAIN, TOP] {
            let sc = scene::<f64>(text);
            let mut run = Run::<f64, 3>::new(&sc, Index::Three);
            let solver =
                Indefinite::analyse(&Saddle::new(&run.model), mbs_sparse::Options::default())
                    .with_thresholds(Thresholds { growth, ..Thresholds::default() });
            run.w = Workspace::new(&run.model, solver);
            let t = std::time::Instant::now();
            let mut r = None;
            let mut v = 0.0_f64;
            for _ in 0..300 {
                let x = run.step(1e-3).unwrap();
                v = v.max(x.violation[2]);
                r = Some(x);
            }
            println!(
                "{growth}: {} {:?} {:?} {:.1} us/step {v:.1e} worst {:.1e} {:?}",
                sc.name,
                run.w.solver().delays(),
                run.w.solver().counters(),
                t.elapsed().as_secs_f64() / 300.0 * 1e6,
                run.w.solver().weakest().ratio,
                r.unwrap().solves
            );
        }
    }
    let sc = scene::<f64>(CHAIN);
    let run = Run::<f64, 3>::new(&sc, Index::Three);
    let mut solver = mbs_sparse::Multifrontal::analyse(&run.model, mbs_sparse::Options::default());
    println!("{:?}", solver.counters());
    let start = mbs_core::start::assemble(
        &sc,
        &run.model,
        |p| mbs_sparse::Multifrontal::analyse(p, mbs_sparse::Options::default()),
        &mut solver,
    )
    .unwrap();
    let mut s = start.state;
    let mut w = mbs_augmented::Workspace::new(&run.model, solver);
    let t = std::time::Instant::now();
    for _ in 0..300 {
        mbs_augmented::index3::step(
            &run.model,
            (1e-3, run.model.length()),
            &mbs_augmented::Options::index3(),
            &mut s,
            &mut w,
        )
        .unwrap();
    }
    println!("augmented {:.1} us/step", t.elapsed().as_secs_f64() / 300.0 * 1e6);
}
