//! Scratch.
mod common;
use common::*;
use mbs_classical::{Options, Stabilisation};
use mbs_core::model::Model;
use mbs_core::start::assemble;
use mbs_sparse::Multifrontal;

fn augmented<const D: usize>(
    scene: &mbs_core::scene::Scene<f64>,
    dt: f64,
    n: usize,
) -> Vec<[f64; 3]> {
    let run = Run::<f64, D>::new(scene, Index::Three);
    let analyse = mbs_sparse::Options::default();
    let mut solver = Multifrontal::analyse(&run.model, analyse);
    let start =
        assemble(scene, &run.model, |p| Multifrontal::analyse(p, analyse), &mut solver).unwrap();
    let mut state = start.state;
    let mut w = mbs_augmented::Workspace::new(&run.model, solver);
    for _ in 0..n {
        mbs_augmented::index3::step(
            &run.model,
            (dt, run.model.length()),
            &mbs_augmented::Options::index3(),
            &mut state,
            &mut w,
        )
        .unwrap();
    }
    centres(scene, &run.model, &state)
}

#[test]
fn explore() {
    let sc = scene::<f64>(TWO_FOUR_BARS);
    for dt in [0.02, 0.01] {
        let n = (10.0_f64 / dt).round() as usize;
        let a = augmented::<2>(&sc, dt, n);
        let run = Run::<f64, 2>::new(&sc, Index::Three).steps(dt, n);
        println!("{dt}: {:e} {:?}", distance(&a, &run.points()), a[0]);
    }
    for (alpha, t) in
        [(0.0, 10.0), (0.0, 20.0), (0.0, 50.0), (5.0, 50.0), (20.0, 50.0), (50.0, 50.0)]
    {
        let mut run = Run::<f64, 2>::new(&scene(SIMPLE), Index::One);
        run.options.stabilisation = if alpha > 0.0 {
            Stabilisation::Baumgarte { alpha, beta: alpha }
        } else {
            Stabilisation::None
        };
        let start = run.invariant();
        let mut r = [0.0_f64; 3];
        let mut e = 0.0_f64;
        for _ in 0..(t / 1e-2) as usize {
            let x = run.step(1e-2).unwrap();
            for k in 0..3 {
                r[k] = r[k].max(x.violation[k]);
            }
            e = e.max((run.invariant() - start).abs());
        }
        println!("simple {alpha} {t}: {r:?} {e:.2e}");
    }
    for dt in [1e-3, 5e-3] {
        for st in [
            Stabilisation::None,
            Stabilisation::Baumgarte { alpha: 5.0, beta: 5.0 },
            Stabilisation::Baumgarte { alpha: 20.0, beta: 20.0 },
            Stabilisation::Baumgarte { alpha: 100.0, beta: 100.0 },
            Stabilisation::Projection,
        ] {
            let mut run = Run::<f64, 2>::new(&scene(DOUBLE), Index::One);
            run.options = Options { stabilisation: st, ..Options::index1() };
            let start = run.invariant();
            let (mut phi, mut phid, mut energy): (f64, f64, f64) = (0.0, 0.0, 0.0);
            let mut err = None;
            for _ in 0..(10.0 / dt) as usize {
                match run.step(dt) {
                    Ok(r) => {
                        phi = phi.max(r.violation[0]);
                        phid = phid.max(r.violation[1]);
                    }
                    Err(e) => {
                        err = Some((run.state.t, e));
                        break;
                    }
                }
                energy = energy.max((run.invariant() - start).abs());
            }
            println!("{dt} {st:?}: phi {phi:.2e} phid {phid:.2e} dE {energy:.2e} {err:?}");
        }
    }
    for (name, text) in [("slider", SLIDER), ("double", DOUBLE), ("guided", GUIDED)] {
        let sc = scene::<f64>(text);
        let a = augmented::<2>(&sc, 1e-3, 300);
        for (reg, tol) in [
            (None, 1e-10),
            (None, 1e-13),
            (Some(1e-6), 1e-10),
            (Some(1e-6), 1e-13),
            (Some(1e-8), 1e-10),
        ] {
            let mut run = Run::<f64, 2>::new(&sc, Index::Three);
            run.options.regularisation = reg;
            run.options.tolerance = tol;
            let run = run.steps(1e-3, 300);
            println!("{name} {reg:?} {tol}: {:e}", distance(&a, &run.points()));
        }
    }
    for reg in [1e-6, 1e-7, 1e-8, 1e-9] {
        let sc = scene::<f64>(REDUNDANT);
        let a = augmented::<3>(&sc, 1e-3, 300);
        let mut run = Run::<f64, 3>::new(&sc, Index::Three);
        run.options.regularisation = Some(reg);
        let run = run.steps(1e-3, 300);
        println!(
            "redundant {reg}: {:e} lambda {:.1e}",
            distance(&a, &run.points()),
            run.state.lambda.iter().fold(0.0_f64, |m, x| m.max(x.abs()))
        );
    }
    let run = Run::<f64, 3>::new(&scene(REDUNDANT), Index::Three);
    println!(
        "{:?}",
        (0..run.model.n_constraints())
            .map(|r| Model::<f64>::owner_of_row(&run.model, r))
            .collect::<Vec<_>>()
    );
    let run = Run::<f64, 2>::new(&scene(SIMPLE), Index::Three);
    println!("{:?} {:?} {:?}", run.state.q, run.state.v, 0);
}
