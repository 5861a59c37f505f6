//! Steps of small scenes for an instruction counter: `cargo xtask counts` runs this program under callgrind.
//!
//! The arguments are the number of steps, then effects. Each effect is counted three times: left out, switched off and switched on. A guide
//! is counted only once. `train-N` is a train of N wheels, without and with its gears, in the recursive formulation with a Runge-Kutta
//! method.

mod effects;
mod scenes;
mod trains;

use mbs_augmented::{Options, Workspace, index3};
use mbs_core::dense::Dense;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Dimension, Scene};
use mbs_core::start::assemble;
use mbs_core::step::Step;
use mbs_recursive::{Planar, Spatial, TreeMethod, TreeModel, space::Space};
use std::error::Error;
use std::process::ExitCode;

/// Number of steps before the counted ones [-].
const WARM_UP: usize = 3;
/// Length of a step [s].
const STEP: f64 = 1e-3;

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let steps = args.next().and_then(|n| n.parse().ok()).unwrap_or(1);
    for effect in args {
        if let Some(n) = effect.strip_prefix("train-").and_then(|n| n.parse().ok()) {
            for has_gears in [false, true] {
                if let Err(error) = train(n, has_gears, steps) {
                    eprintln!("{effect}: {error}");
                    return ExitCode::FAILURE;
                }
            }
            continue;
        }
        let switches: &[&str] = if effect == "guide" { &["on"] } else { &["out", "off", "on"] };
        for switch in switches {
            if let Err(error) = run(&effect, switch, steps) {
                eprintln!("{effect} {switch}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Counts the steps with an effect, in the plane and in space.
fn run(effect: &str, switch: &str, steps: usize) -> Result<(), Box<dyn Error>> {
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        let scene = scenes::with(dimension, effect, switch);
        scene.check()?;
        match dimension {
            Dimension::Planar => {
                formulations::<2, Planar>(&scene, &format!("planar {effect} {switch}"), steps)?;
            }
            Dimension::Spatial => {
                formulations::<3, Spatial>(&scene, &format!("spatial {effect} {switch}"), steps)?;
            }
        }
    }
    Ok(())
}

/// Counts the steps of a scene in every formulation.
fn formulations<const D: usize, S: Space<f64>>(
    scene: &Scene<f64>,
    name: &str,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let model = NaturalModel::<f64, D>::new(scene)?;
    index_3(scene, &model, name, steps)?;
    recursive::<D, S>(
        (scene, &model),
        &format!("recursive {name}"),
        (steps, TreeMethod::Trapezoidal),
    )
}

/// Counts steps of the index-3 augmented Lagrangian formulation.
fn index_3<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    name: &str,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let mut solver = Dense::new(model);
    let mut state = assemble(scene, model, |p| Dense::new(p), &mut solver)?.state;
    let mut workspace = Workspace::new(model, solver);
    let (options, step) = (Options::index3(), Step { dt: STEP, length: model.length() });
    count(&format!("index-3 {name}"), steps, || {
        index3::step(model, step, &options, &mut state, &mut workspace)
    })
}

/// Counts steps of the recursive formulation.
fn recursive<const D: usize, S: Space<f64>>(
    (scene, model): (&Scene<f64>, &NaturalModel<f64, D>),
    name: &str,
    (steps, method): (usize, TreeMethod),
) -> Result<(), Box<dyn Error>> {
    let natural = assemble(scene, model, |p| Dense::new(p), &mut Dense::new(model))?.state;
    let tree = TreeModel::<f64, S>::new(scene)?;
    let mut workspace = mbs_recursive::Workspace::new(&tree);
    let mut state = tree.start(scene, model, &natural)?;
    let options = mbs_recursive::Options::default();
    count(name, steps, || tree.step(method, STEP, &options, &mut state, &mut workspace))
}

/// Counts the steps of a train of wheels, without gears or with them.
fn train(n: usize, has_gears: bool, steps: usize) -> Result<(), Box<dyn Error>> {
    let scene = trains::train(n, has_gears);
    scene.check()?;
    let model = NaturalModel::<f64, 2>::new(&scene)?;
    let switch = if has_gears { "on" } else { "out" };
    let name = format!("rk4 planar train-{n} {switch}");
    recursive::<2, Planar>((&scene, &model), &name, (steps, TreeMethod::Rk4))
}

/// Makes the uncounted steps, prints the name, and makes the counted steps.
#[allow(clippy::print_stdout, reason = "the names of the cases are what this program says")]
fn count<R, E: Error + 'static>(
    name: &str,
    steps: usize,
    mut step: impl FnMut() -> Result<R, E>,
) -> Result<(), Box<dyn Error>> {
    for _ in 0..WARM_UP {
        step()?;
    }
    println!("{name}");
    Ok(measured(steps, &mut step)?)
}

/// The counted steps: callgrind counts inside this function.
#[inline(never)]
fn measured<R, E>(steps: usize, step: &mut impl FnMut() -> Result<R, E>) -> Result<(), E> {
    for _ in 0..steps {
        step()?;
    }
    Ok(())
}
