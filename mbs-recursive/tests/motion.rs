//! Runs: order, energy, singular positions.

mod support;

use mbs_recursive::{Planar, Spatial};
use support::{Run, file};

#[test]
fn figures() {
    for (inside, reg) in [(false,6e-11),(true,6e-10),(true,1e-8)] {
 for (dt, n) in [(1e-2, 1000), (1e-3, 10_000), (1e-4, 100_000), (1e-5,1_000_000)] {
        let mut run = Run::<Planar>::new::<2>(&file("two-four-bars"));
         run.options.regularisation=reg; let start = run.invariant();
        let mut worst = 0.0_f64;
        for i in 0..n {
            if let Err(e) = run.step(dt) {
                println!("two-four-bars {dt}: stopped at {i} {e:?}");
                break;
            }
            worst = worst.max((run.invariant() - start).abs());
        }
        println!("two-four-bars {inside} {reg:e} {dt}: {worst} t {} z {:?}", run.state.t, run.state.z);
    }
}
    for (dt, n) in [(1e-2, 1000), (1e-3, 10_000), (1e-4, 100_000)] {
        let mut run = Run::<Planar>::new::<2>(&file("double-pendulum"));
        println!("double pendulum {dt}: {:?}", run.drift(dt, n));
    }
    for name in ["slider-crank", "guided-four-bar", "n-four-bar-10"] {
        for (dt, n) in [(1e-2, 1000), (1e-3, 10_000)] {
            let mut run = Run::<Planar>::new::<2>(&file(name));
            println!("{name} {dt}: {:?}", run.drift(dt, n));
        }
    }
    for name in ["spatial-four-bar", "spatial-chain-20", "spinning-top", "free-body"] {
        for (dt, n) in [(1e-2, 100), (1e-3, 1000)] {
            let mut run = Run::<Spatial>::new::<3>(&file(name));
            println!("{name} {dt}: {:?}", run.drift(dt, n));
        }
    }
}
