//! A run with several threads gives the same bits as with one.

use crate::common;

use crate::common::{SCENES, scene};
use mbs::core::scene::{Dimension, Scene};
use mbs::scene_file::{Family, SceneFile, generate};
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};

/// Scenes of vehicles in the repository, and scenes with inputs of every kind.
const OTHERS: [&str; 8] = [
    "iltis-suspension",
    "iltis-suspension-stiff",
    "iltis-stairs",
    "iltis-jump",
    "iltis-slalom",
    "quarter-car",
    "hammer-blow",
    "n-four-bar-40",
];

/// Bits of state, multipliers and energies at each of `steps` steps, until the run stops.
fn bits(scene: &Scene<f64>, formulation: &str, threads: usize, steps: usize) -> Vec<u64> {
    match scene.dimension {
        Dimension::Planar => bits_in::<2>(scene, formulation, threads, steps),
        Dimension::Spatial => bits_in::<3>(scene, formulation, threads, steps),
    }
}

fn bits_in<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    threads: usize,
    steps: usize,
) -> Vec<u64> {
    let formulation = Some(formulation.to_owned());
    let overrides = Method { formulation, threads: Some(threads), ..Method::default() };
    let settings = ResolvedMethod::new(scene, &overrides).expect("the settings are built");
    let mut simulation = Simulation::<f64, D>::new(scene, &settings).expect("the scene assembles");
    let mut told = Vec::new();
    for _ in 0..steps {
        let report = simulation.step(settings.step);
        let s = simulation.state();
        for numbers in [&s.q[..], &s.v, &s.a, &s.reaction, &simulation.energies()] {
            told.extend(numbers.iter().map(|x| x.to_bits()));
        }
        if report.is_err() {
            break;
        }
    }
    assert!(told.len() > 10);
    told
}

fn assert_same(name: &str, scene: &Scene<f64>, formulation: &str, steps: usize) {
    let one = bits(scene, formulation, 1, steps);
    for threads in [2, 3, 8] {
        let many = bits(scene, formulation, threads, steps);
        assert!(one == many, "{name}, {formulation}, {threads} threads");
    }
}

#[test]
fn scenes_of_the_repository_have_the_same_bits_for_1_2_3_and_8_threads() {
    for name in SCENES.iter().chain(&OTHERS) {
        let scene = scene(name);
        for formulation in ["index-3", "index-1", "multi-index", "classical"] {
            assert_same(name, &scene, formulation, 20);
        }
    }
}

#[test]
fn large_scenes_that_are_cut_have_the_same_bits_for_1_2_3_and_8_threads() {
    let path = common::path("iltis-stairs");
    let vehicle =
        SceneFile::from_bytes(&std::fs::read(path).expect("a scene"), "iltis").expect("read");
    for (family, formulation) in [
        (Family::Chain { bodies: 300 }, "index-3"),
        (Family::Tree { bodies: 511 }, "index-3"),
        (Family::Tree { bodies: 255 }, "index-1"),
        (Family::FourBars { loops: 150 }, "index-3"),
        (Family::Net { rows: 12, columns: 12 }, "index-3"),
        (Family::Net { rows: 8, columns: 8 }, "index-1"),
        (Family::Chain { bodies: 300 }, "classical"),
        (Family::Tree { bodies: 255 }, "classical"),
        (Family::Convoy { vehicle: &vehicle, count: 4, spacing: 10.0 }, "classical"),
        (Family::Convoy { vehicle: &vehicle, count: 6, spacing: 10.0 }, "index-3"),
        (Family::Convoy { vehicle: &vehicle, count: 4, spacing: 10.0 }, "multi-index"),
    ] {
        let text = generate(&family, "test").expect("generated");
        let scene =
            SceneFile::parse(&text, "generated.toml").expect("parsed").scene().expect("sound");
        assert_same(
            &format!("{family:?}").chars().take(40).collect::<String>(),
            &scene,
            formulation,
            5,
        );
    }
}
