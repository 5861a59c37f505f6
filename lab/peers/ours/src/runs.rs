//! Complete runs of the repository's scenes with a fixed step, by each method. Seconds are CPU time of the steps alone.

use crate::line::{Failure, print_line};
use crate::space::in_space;
use cpu_time::ProcessTime;
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};
use mbs_core::scene::Scene;
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeMethod, TreeModel, Workspace};
use mbs_scene::SceneFile;
use std::f64::consts::FRAC_PI_2;

/// Formulations and integrators of the runs that simulate as `mbs run` does.
const METHODS: [[&str; 2]; 4] = [
    ["recursive", "trapezoidal"],
    ["recursive", "rk4"],
    ["index-3", "trapezoidal"],
    ["state-space", "trapezoidal"],
];

/// The scenes of the runs. Those of four-bars have the x of the first crank's end after 10 s [m].
const DOUBLE_PENDULUM: &str = include_str!("../../../../scenes/double-pendulum.toml");
const TWO: (&str, f64) =
    (include_str!("../../../../scenes/two-four-bars.toml"), 0.328_458_111_540_815_4);
const FORTY: (&str, f64) =
    (include_str!("../../../../scenes/n-four-bar-40.toml"), 0.180_512_226_686_728_4);

/// Quantity by which a run is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Judge {
    /// Largest error of the energy [J].
    Energy,
    /// Position of the first crank's end in x [m].
    CrankEnd,
}

impl Judge {
    fn reference(self) -> &'static str {
        if self == Self::Energy { "zero" } else { "exact" }
    }
}

/// Runs the double pendulum. The value is the largest error of the energy [J].
pub(crate) fn double_pendulum(dt: f64) -> Result<(), Failure> {
    runs(DOUBLE_PENDULUM, dt, Judge::Energy)
}

/// Runs two or forty four-bars. The value is the position of the first crank's end in x [m].
pub(crate) fn four_bars(n: usize, dt: f64) -> Result<(), Failure> {
    let (text, exact) = match n {
        2 => TWO,
        40 => FORTY,
        _ => return Err("there are scenes of 2 and of 40 four-bars".into()),
    };
    print_line("reference", 0.0, exact, "exact");
    runs(text, dt, Judge::CrankEnd)
}

/// Runs a scene by every method. A method that stops is reported and has no line.
fn runs(text: &str, dt: f64, judge: Judge) -> Result<(), Failure> {
    let scene = SceneFile::parse(text, "scene").and_then(|document| document.scene());
    let scene: Scene<f64> = scene.map_err(|e| e.render())?;
    let n = (scene.duration / dt).round() as usize;
    let spatial = in_space(&scene)?;
    for (is_explicit, integrator) in [(false, "trapezoidal"), (true, "rk4")] {
        let planar =
            |is_watched| kernel::<Planar, 2>(&scene, (dt, n), is_explicit, (judge, is_watched));
        print_run(&format!("planar kernel {integrator}"), judge, planar);
        let spatial =
            |is_watched| kernel::<Spatial, 3>(&spatial, (dt, n), is_explicit, (judge, is_watched));
        print_run(&format!("spatial kernel {integrator}"), judge, spatial);
    }
    for method in METHODS {
        let run = |is_watched| simulated::<2>(&scene, (dt, n), method, (judge, is_watched));
        print_run(&format!("planar {}", method.join(" ")), judge, run);
    }
    let method = METHODS[2];
    let run = |is_watched| simulated::<3>(&spatial, (dt, n), method, (judge, is_watched));
    print_run(&format!("spatial {}", method.join(" ")), judge, run);
    Ok(())
}

/// Times a run without evaluating its motion, then evaluates the motion of a second run.
fn print_run(name: &str, judge: Judge, run: impl Fn(bool) -> Result<[f64; 2], Failure>) {
    let timed = run(false).and_then(|[seconds, value]| match judge {
        Judge::Energy => Ok((seconds, run(true)?[1])),
        Judge::CrankEnd => Ok((seconds, value)),
    });
    match timed {
        Ok((seconds, value)) => print_line(name, seconds, value, judge.reference()),
        Err(why) => eprintln!("{name}: {why}"),
    }
}

/// Simulates the scene by the steps of mbs-recursive alone. Returns the CPU time of the steps [s], and the quantity that `judge` names.
fn kernel<S: Space<f64>, const D: usize>(
    scene: &Scene<f64>,
    (dt, n): (f64, usize),
    is_explicit: bool,
    (judge, is_watched): (Judge, bool),
) -> Result<[f64; 2], Failure> {
    let model = TreeModel::<f64, S>::new(scene)?;
    let (options, mut workspace) = (Options::default(), Workspace::new(&model));
    let start = assembled::<D>(scene, dt, METHODS[0])?;
    let mut state = model.start(scene, start.model(), start.state())?;
    let start: f64 = model.energies(&state, &mut workspace).iter().sum();
    let method = if is_explicit { TreeMethod::Rk4 } else { TreeMethod::Trapezoidal };
    let (clock, mut worst) = (ProcessTime::now(), 0.0_f64);
    for _ in 0..n {
        model.step(method, dt, &options, &mut state, &mut workspace)?;
        if is_watched && judge == Judge::Energy {
            let energy: f64 = model.energies(&state, &mut workspace).iter().sum();
            worst = worst.max((energy - start).abs());
        }
    }
    let seconds = clock.elapsed().as_secs_f64();
    // the first coordinate is the angle of the first crank, which is zero when the crank points upwards
    let value = if judge == Judge::Energy { worst } else { (FRAC_PI_2 + state.z[0]).cos() };
    Ok([seconds, value])
}

/// A simulation at its assembled start, with the options of a run.
fn assembled<const D: usize>(
    scene: &Scene<f64>,
    dt: f64,
    [formulation, integrator]: [&str; 2],
) -> Result<Simulation<f64, D>, Failure> {
    let asked = Method {
        formulation: Some(formulation.to_owned()),
        integrator: Some(integrator.to_owned()),
        step: Some(dt),
        ..Method::default()
    };
    Ok(Simulation::new(scene, &ResolvedMethod::new(scene, &asked)?)?)
}

/// Simulates the scene as `mbs run` does. Returns the CPU time of the steps [s], and the quantity that `judge` names.
fn simulated<const D: usize>(
    scene: &Scene<f64>,
    (dt, n): (f64, usize),
    method: [&str; 2],
    (judge, is_watched): (Judge, bool),
) -> Result<[f64; 2], Failure> {
    let mut simulation = assembled::<D>(scene, dt, method)?;
    let start: f64 = simulation.initial_energies().iter().sum();
    let (clock, mut worst) = (ProcessTime::now(), 0.0_f64);
    for _ in 0..n {
        simulation.step(dt)?;
        if is_watched && judge == Judge::Energy {
            let [kinetic, potential, work] = simulation.energies();
            worst = worst.max((kinetic + potential - work - start).abs());
        }
    }
    let seconds = clock.elapsed().as_secs_f64();
    // the first body is a crank with one end at the origin, so that its end is at twice its centre
    let center = simulation.model().motion(scene, 0, simulation.state());
    let value = if judge == Judge::Energy { worst } else { 2.0 * center.position[0] };
    Ok([seconds, value])
}
