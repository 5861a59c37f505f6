//! Andrews' squeezing mechanism up to 0.03 s by explicit methods with error control, for large to small tolerances.

use crate::clock::time_of;
use crate::line::{Failure, print_line};
use crate::space::in_space;
use mbs_core::model::Owner;
use mbs_core::scene::Scene;
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeMethod, TreeModel, TreeState, Workspace};
use mbs_scene::SceneFile;
use std::hint::black_box;

const SCENE: &str = include_str!("../../../../scenes/andrews.toml");

/// Length of the run [s].
const END: f64 = 0.03;
/// First step tried [s], the same as in the peers' programs.
const FIRST: f64 = 1e-7;

/// Joints of the seven angles in the scene, with the angles at the start and at the end [rad].
const ANGLES: [(&str, f64, f64); 7] = [
    ("crank-pivot", -0.061_713_890_014_276_5, 15.810_771_195_153_707),
    ("crank-pin", 0.0, -15.756_371_058_411_84),
    ("spring-arm-pivot", 0.455_279_819_163_070_4, 0.040_822_240_119_645_8),
    ("upper-knee", 0.222_668_390_165_885_88, -0.534_730_116_342_079_6),
    ("upper-arm-pivot", 0.487_364_979_543_842_55, 0.524_409_965_879_954_1),
    ("lower-knee", -0.222_668_390_165_885_88, 0.534_730_116_342_079_6),
    ("lower-arm-pivot", 1.230_547_444_549_821_2, 1.048_080_741_041_938),
];

/// Methods that control their steps by an error tolerance.
const METHODS: [(&str, TreeMethod); 3] = [
    ("rk54", TreeMethod::Rk54),
    ("rk853", TreeMethod::Rk853),
    ("extrapolation", TreeMethod::Extrapolation),
];

/// Times three methods in the plane and in space, each at its tolerances. The printed value is the number of correct digits.
pub(crate) fn andrews(seconds: f64) -> Result<(), Failure> {
    let scene = SceneFile::parse(SCENE, "andrews.toml").and_then(|document| document.scene());
    let scene: Scene<f64> = scene.map_err(|e| e.render())?;
    runs::<Planar>("planar", &scene, seconds)?;
    runs::<Spatial>("spatial", &in_space(&scene)?, seconds)
}

fn runs<S: Space<f64>>(space: &str, scene: &Scene<f64>, seconds: f64) -> Result<(), Failure> {
    let model = TreeModel::<f64, S>::new(scene)?;
    let mut start = TreeState::at_rest(&model);
    model.settle(&mut start, &mut Workspace::new(&model))?;
    let seats = seats(scene, &model)?;
    for (name, method) in METHODS {
        for i in 0..=20 {
            let error = 10_f64.powf(-2.0 - 0.5 * f64::from(i));
            let options = Options { error, first_step: Some(FIRST), ..Options::default() };
            let mut state = start.clone();
            let mut run = || {
                state.copy_from(&start);
                // the workspace is new for each run, as the solvers of the peers are
                model.step(method, END, &options, &mut state, &mut Workspace::new(&model))
            };
            if let Err(why) = run() {
                eprintln!("{space} {name} {error:.1e}: {why}");
                continue;
            }
            let time = time_of(seconds, |_| {
                black_box(run().is_ok());
            });
            let digits = digits(&seats, &state);
            print_line(&format!("{space} {name} {error:.1e}"), time, digits, "digits");
        }
    }
    Ok(())
}

/// Indices of the seven angles among the coordinates.
fn seats<S: Space<f64>>(
    scene: &Scene<f64>,
    model: &TreeModel<f64, S>,
) -> Result<[usize; 7], Failure> {
    let mut seats = [0; 7];
    for (seat, (name, _, _)) in seats.iter_mut().zip(ANGLES) {
        let is_named = |&freedom: &usize| match model.owner_of_unknown(freedom) {
            Owner::Joint(joint) => scene.joints[joint].name == name,
            _ => false,
        };
        let found = (0..model.n_freedoms()).find(is_named);
        *seat = found.ok_or_else(|| format!("{name} is cut"))?;
    }
    Ok(seats)
}

/// Number of correct digits: -log10 of the largest relative error of the seven angles.
fn digits(seats: &[usize; 7], state: &TreeState<f64>) -> f64 {
    let error = |(&seat, (_, start, end)): (&usize, (&str, f64, f64))| {
        ((start + state.z[seat] - end) / end).abs()
    };
    -seats.iter().zip(ANGLES).map(error).fold(0.0, f64::max).log10()
}
