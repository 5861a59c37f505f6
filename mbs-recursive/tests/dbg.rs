//! Debugging.
mod support;
use mbs_recursive::{Planar, rk54_step, rk4_step};
use support::{Run, file};
#[test]
fn dbg() {
  for name in ["four-bar", "two-four-bars","n-four-bar-10", "n-four-bar-40"] {
    for error in [1e-8,1e-9,1e-10,1e-11] {
    let mut run = Run::<Planar>::new::<2>(&file(name));
    run.options.error = error;
    let start = run.invariant();
    let (mut worst, mut steps, mut rej) = (0.0_f64,0,0);
    for i in 0..10 {
        match rk54_step(&run.model, 1.0, &run.options, &mut run.state, &mut run.workspace) { Err(e) => { println!("{i} {e:?}"); break; } Ok(r) => { steps+=r.steps; rej+=r.rejected; } }
        worst = worst.max((run.invariant() - start).abs());
    }
    println!("{name} {error:e} {worst:e} {steps} {rej} {:?}", run.state.z[0]);
    }
    for (dt,n) in [(1e-2,1000),(1e-3,10000),(1e-4,100_000)] {
    if name.starts_with("n-") && n > 10_000 { continue; }
    for rk in [true,false] {
        let mut run = Run::<Planar>::new::<2>(&file(name));
        let start = run.invariant();
        let (mut worst, mut v) = (0.0_f64,[0.0_f64;3]);
        let mut it=0;
        for i in 0..n {
            let r = if rk { rk4_step(&run.model, dt, &run.options, &mut run.state, &mut run.workspace) } else { run.step(dt) };
            match r { Err(e) => { println!("{i} {e:?}"); break; } Ok(r) => { for k in 0..3 { v[k]=v[k].max(r.violation[k]); } it+=r.iterations; } }
            worst = worst.max((run.invariant() - start).abs());
        }
        println!("{name} rk4 {rk} {dt} {worst:e} {v:?} it {it} {:?}",run.state.z[0]);
    }}
  }
}
