//! Runs: order, energy, singular positions.

mod support;

use mbs_recursive::{Planar, Spatial, rk4_step, rk54_step};
use support::{Run, file};

#[test]
fn figures() {
    for name in ["double-pendulum", "slider-crank", "guided-four-bar", "four-bar", "two-four-bars", "andrews"] {
        let t = if name == "andrews" { 0.03 } else { 10.0 };
        for n in [300, 1000, 3000] {
            let mut run = Run::<Planar>::new::<2>(&file(name));
            let (start, mut worst) = (run.invariant(), 0.0_f64);
            for i in 0..n {
                if let Err(e) = rk4_step(&run.model, t / f64::from(n), &run.options, &mut run.state, &mut run.workspace) {
                    println!("{name} stopped {i} {e:?}"); break;
                }
                worst = worst.max((run.invariant() - start).abs());
            }
            println!("{name} rk4 {n}: {worst:e} {:?}", run.state.z);
        }
        for error in [1e-4, 1e-6, 1e-8,1e-10] {
            let mut run = Run::<Planar>::new::<2>(&file(name));
            run.options.error = error;
            let (start, mut worst, mut steps, mut rej) = (run.invariant(), 0.0_f64, 0, 0);
            let n = 10;
            for i in 0..n {
                match rk54_step(&run.model, t / f64::from(n), &run.options, &mut run.state, &mut run.workspace) {
                    Err(e) => { println!("{name} stopped {i} {e:?}"); break; }
                    Ok(r) => { steps += r.steps; rej += r.rejected; }
                }
                worst = worst.max((run.invariant() - start).abs());
            }
            println!("{name} rk54 {error}: {worst:e} steps {steps} rej {rej} {:?}", run.state.z);
        }
    }
    for name in ["spatial-four-bar", "spatial-chain-20", "spinning-top", "free-body", "rssr", "tree-30"] {
        for n in [1000,2000] {
            let mut run = Run::<Spatial>::new::<3>(&file(name));
            let (start, mut worst) = (run.invariant(), 0.0_f64);
            for i in 0..n {
                if let Err(e) = rk4_step(&run.model, 2.0 / f64::from(n), &run.options, &mut run.state, &mut run.workspace) {
                    println!("{name} stopped {i} {e:?}"); break;
                }
                worst = worst.max((run.invariant() - start).abs());
            }
            println!("{name} rk4 {n}: {worst:e}");
        }
        for (dt, n) in [(1e-2, 100), (1e-3, 1000)] {
            let mut run = Run::<Spatial>::new::<3>(&file(name));
            println!("{name} {dt}: {:?} rank {:?} of {} in {}", run.drift(dt, n), run.model.rank(&run.state, &mut run.workspace), run.model.n_rows(), run.model.n_coordinates());
        }
    }
}
