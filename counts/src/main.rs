//! Steps of small scenes, for a counter of instructions: `cargo xtask counts` runs this under callgrind.
//!
//! Every case prints its name and makes one call of [`measured`]; nothing else of it is counted. Arguments: the number of steps,
//! then names of cases (`none`, `bumper off`); none: all cases.

mod effects;
mod scenes;

use mbs_augmented::{Options, Workspace, index3};
use mbs_core::dense::Dense;
use mbs_core::natural::{ModelError, NaturalModel};
use mbs_core::scene::{Dimension, Scene};
use mbs_core::start::assemble;
use mbs_recursive::{Planar, Spatial, TreeModel, space::Space};
use std::error::Error;
use std::process::ExitCode;

/// Steps made before counting [-], and their length [s].
const WARM_UP: usize = 3;
const STEP: f64 = 1e-3;

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let steps = args.next().and_then(|n| n.parse().ok()).unwrap_or(1);
    let wanted: Vec<_> = args.collect();
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        for (name, scene) in scenes::cases(dimension) {
            if !(wanted.is_empty() || wanted.contains(&name)) {
                continue;
            }
            let result = match dimension {
                Dimension::Planar => run::<2>(&scene, &format!("planar {name}"), steps),
                Dimension::Spatial => run::<3>(&scene, &format!("spatial {name}"), steps),
            };
            if let Err(error) = result {
                eprintln!("{name}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Runs a scene in every formulation; a scene that asks for an effect that is not compiled is passed over.
fn run<const D: usize>(scene: &Scene<f64>, name: &str, steps: usize) -> Result<(), Box<dyn Error>> {
    scene.check()?;
    let model = match NaturalModel::<f64, D>::new(scene) {
        Err(ModelError::LeftOut { .. }) => return Ok(()),
        model => model?,
    };
    index_3(scene, &model, name, steps)?;
    match D {
        2 => recursive::<D, Planar>(scene, &model, name, steps),
        _ => recursive::<D, Spatial>(scene, &model, name, steps),
    }
}

/// Steps of index-3 augmented Lagrangian.
fn index_3<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    name: &str,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let mut solver = Dense::new(model);
    let mut state = assemble(scene, model, |p| Dense::new(p), &mut solver)?.state;
    let mut workspace = Workspace::new(model, solver);
    let (options, dt) = (Options::index3(), (STEP, model.length()));
    count(&format!("index-3 {name}"), steps, || {
        index3::step(model, dt, &options, &mut state, &mut workspace)
    })
}

/// Steps of the recursive formulation.
fn recursive<const D: usize, S: Space<f64>>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    name: &str,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let natural = assemble(scene, model, |p| Dense::new(p), &mut Dense::new(model))?.state;
    let tree = TreeModel::<f64, S>::new(scene)?;
    let mut workspace = mbs_recursive::Workspace::new(&tree);
    let mut state = tree.start(scene, model, &natural)?;
    let options = mbs_recursive::Options::default();
    count(&format!("recursive {name}"), steps, || {
        mbs_recursive::step(&tree, STEP, &options, &mut state, &mut workspace)
    })
}

/// Warms up, prints the name and counts.
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

/// The steps that are counted.
#[inline(never)]
fn measured<R, E>(steps: usize, step: &mut impl FnMut() -> Result<R, E>) -> Result<(), E> {
    for _ in 0..steps {
        step()?;
    }
    Ok(())
}
