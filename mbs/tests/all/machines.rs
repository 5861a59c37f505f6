//! Random machines move the same way in any description: exchanged bodies of joints, reversed axes, another order, rotated, in millimetres.

use crate::common::{run, run_in};
use mbs::{Method, Outcome};
use mbs_testkit::machines::kinds::{COUPLED, KINDS, machine};
use mbs_testkit::machines::{Ways, Wording};
use mbs_testkit::{Random, scene};

/// Ways to describe a machine differently, and all of them together.
const WAYS: [(&str, Ways); 6] = {
    let drawn =
        Ways { swaps: false, reverses: false, shuffles: false, turns: false, millimetres: false };
    [
        ("swapped", Ways { swaps: true, ..drawn }),
        ("reversed", Ways { reverses: true, ..drawn }),
        ("shuffled", Ways { shuffles: true, ..drawn }),
        ("turned", Ways { turns: true, ..drawn }),
        ("in millimetres", Ways { millimetres: true, ..drawn }),
        ("all", Ways { millimetres: true, ..Ways::ALL }),
    ]
};

/// Vectors of a run's rows in the original description: positions in metres, and angular velocities.
fn drawn(outcome: &Outcome, wording: &Wording, what: &str) -> Vec<Vec<[f64; 3]>> {
    assert_eq!(outcome.error, None, "{what}");
    let vectors = |row: &[f64]| {
        let three = row.chunks_exact(3).enumerate();
        let scaled = three.map(|(k, x)| {
            let size = if k % 2 == 0 { wording.metre } else { 1.0 };
            wording.back([x[0] / size, x[1] / size, x[2] / size])
        });
        scaled.collect()
    };
    outcome.rows().iter().map(|(_, row)| vectors(row)).collect()
}

/// Largest difference of two runs, relative to the ranges of the outputs.
fn apart(one: &[Vec<[f64; 3]>], other: &[Vec<[f64; 3]>]) -> f64 {
    assert_eq!(one.len(), other.len());
    let n = one[0].len();
    let size = |of: &dyn Fn(usize) -> [f64; 3]| {
        (0..one.len())
            .map(|row| of(row).iter().map(|x| x * x).sum::<f64>().sqrt())
            .fold(0.0, f64::max)
    };
    let ranges: Vec<f64> = (0..n)
        .map(|k| size(&|row| core::array::from_fn(|i| one[row][k][i] - one[0][k][i])))
        .collect();
    // outputs with a small range are compared relative to the largest range of their kind
    let most = |k: usize| (0..n).filter(|j| j % 2 == k % 2).map(|j| ranges[j]).fold(0.0, f64::max);
    let relative = (0..n).map(|k| {
        let off = size(&|row| core::array::from_fn(|i| one[row][k][i] - other[row][k][i]));
        off / ranges[k].max(1e-3 * most(k))
    });
    relative.fold(0.0, f64::max)
}

/// Largest difference between descriptions of random machines by a method. `each` machines of each of the first `kinds` kinds are run.
fn differ(
    (each, kinds): (usize, usize),
    method: &dyn Fn(&mbs::core::scene::Scene<f64>) -> Outcome,
) -> f64 {
    let mut worst = 0.0_f64;
    for seed in 0..(each * kinds) as u64 {
        let mut random = Random::new(1000 + seed);
        let machine = machine(&mut random, seed as usize % kinds);
        let mut moves = |ways: Ways, what: &str| {
            let wording = Wording::new(&mut random, &machine, ways);
            let text = wording.moving(&machine, seed);
            drawn(&method(&scene(&text)), &wording, &format!("{} {what}\n{text}", machine.what))
        };
        let plain = moves(Ways::default(), "as drawn");
        for (what, ways) in WAYS {
            let off = apart(&plain, &moves(ways, what));
            println!("{seed} {} {what}: {off:.1e}", machine.what);
            worst = worst.max(off);
        }
    }
    worst
}

#[test]
fn machines_move_as_they_are_drawn_in_whatever_words() {
    let method = |formulation: &str, integrator: &str, tolerance| Method {
        formulation: Some(formulation.to_owned()),
        integrator: Some(integrator.to_owned()),
        step_max: Some(0.01),
        tolerance,
        ..Method::default()
    };
    let exact = method("recursive", "rk853", Some(1e-11));
    let worst = differ((30, KINDS), &|scene| run(scene, &exact));
    assert!(worst < 1e-9, "{worst:e} of a range");
}

/// Descriptions agree over 100 steps. In index-1 the slip of wheels is limited by the largest violation, in which lengths and directions are
/// compared. Over 200 steps, a wheel on a plank in millimetres differs by 1.8e-6 of a range.
#[test]
fn every_formulation_steps_alike_in_whatever_words() {
    for formulation in mbs::FormulationKind::ALL.map(mbs::FormulationKind::name) {
        // rows of rolling wheels depend on those of their joints, or constrain velocities only
        let refuses = ["classical", "state-space"].contains(&formulation);
        let kinds = if refuses { COUPLED } else { KINDS };
        let worst = differ((1, kinds), &|scene| {
            let mut scene = scene.clone();
            scene.duration = 0.1;
            run_in(&scene, formulation, Some(1e-3))
        });
        println!("{formulation}: {worst:e}");
        assert!(worst < 1e-6, "{formulation}: {worst:e} of a range");
    }
}
