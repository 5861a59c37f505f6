//! Writing of scenes: reading the text gives an equal scene, with all digits of every scalar.

use mbs_core::Real;
use mbs_core::outputs::QUANTITIES;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{Number, Scene};
use mbs_scene::{SceneFile, to_toml};
use std::path::PathBuf;

/// Every valid scene file of the workspace, with its name.
fn scenes() -> Vec<(String, Scene<Number>)> {
    let folders = ["../scenes", "../mbs/tests/field"].map(PathBuf::from);
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("a folder"));
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).ok()?;
        let scene = SceneFile::parse(&text, "x.toml").ok()?.numbers().ok()?;
        Some((path.display().to_string(), scene))
    };
    let toml = files.map(|file| file.expect("a file").path());
    toml.filter(|path| path.extension().is_some_and(|e| e == "toml")).filter_map(read).collect()
}

fn again(scene: &Scene<Number>) -> Scene<Number> {
    let text = to_toml(scene).expect("no code in it");
    match SceneFile::parse(&text, "again.toml").and_then(|file| file.numbers()) {
        Ok(scene) => scene,
        Err(error) => panic!("{}", error.render()),
    }
}

/// A text of all numbers of a scene in a scalar, for comparison.
fn bits<T: Real>(scene: &Scene<Number>) -> String {
    format!("{:?}", scene.resolve::<T>())
}

#[test]
fn every_scene_reads_back_as_it_was_written_in_all_precisions() {
    let scenes = scenes();
    assert!(scenes.len() > 60, "{} scenes", scenes.len());
    for (name, scene) in &scenes {
        let again = again(scene);
        assert_eq!(&again, scene, "{name}");
        assert_eq!(bits::<f32>(&again), bits::<f32>(scene), "{name}");
        assert_eq!(bits::<f64>(&again), bits::<f64>(scene), "{name}");
        assert_eq!(bits::<DoubleDouble>(&again), bits::<DoubleDouble>(scene), "{name}");
    }
}

#[test]
fn every_quantity_of_the_table_reads_back_as_it_was_written() {
    for row in QUANTITIES {
        let key = |key: &&str| match *key {
            "at" => "at = [1, 2, 3]\n".to_owned(),
            "origin" => "origin = [4, 5, 6]\n".to_owned(),
            "side" => "side = \"right\"\n".to_owned(),
            "up" => "up = [0, 1, 0]\n".to_owned(),
            "forward" => "forward = [0, 0, 1]\n".to_owned(),
            "axis" => "axis = [1, 0, 0.1]\n".to_owned(),
            owner => format!("{owner} = \"one\"\n"),
        };
        let keys: String = row.target.keys().iter().map(key).collect();
        let text = format!(
            "[scene]\ndimension = 3\nduration = 1\n[[body]]\nname = \"one\"\nmass = 1\ncenter = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
             [[joint]]\nname = \"one\"\nkind = \"free\"\nbodies = [\"ground\", \"one\"]\nat = [0, 0, 0]\n\
             [[coupling]]\nname = \"one\"\nkind = \"linear\"\nterms = [{{ joint = \"one\", coordinate = 0, factor = 1 }}]\n\
             [[rolling]]\nname = \"one\"\nkind = \"ball\"\nbody = \"one\"\ncenter = [0, 0, 0]\nradius = 1\n\
             [[effect]]\nname = \"one\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"one\"]\npoints = [[0, 0, 0], [1, 0, 0]]\n\
             [[signal]]\nname = \"one\"\nkind = \"constant\"\nvalue = 1\n\
             [[output]]\nname = \"x\"\n{keys}quantity = \"{}\"\n",
            row.name
        );
        let scene = SceneFile::parse(&text, "x").and_then(|file| file.numbers()).expect("a scene");
        assert_eq!(scene.outputs[0].quantity.row(), row);
        assert_eq!(again(&scene), scene, "{}", row.name);
    }
}

#[test]
fn magnitudes_and_outputs_of_all_are_kept() {
    let text = "[scene]\ndimension = 2\nduration = 1\noutputs = \"all\"\n[[body]]\nname = \"b\"\nmass = 1\ncenter = [0, 0]\n\
                inertia = 1\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [0, 0]\n\
                [[output]]\nname = \"p\"\nbody = \"b\"\nat = [1, 0]\nmagnitude = true\n";
    let scene = SceneFile::parse(text, "x").and_then(|file| file.numbers()).expect("a scene");
    let found: Vec<_> = scene.outputs.iter().map(|x| (x.name.as_str(), x.magnitude)).collect();
    assert_eq!(found, [("p", true), ("j", false), ("j rate", false), ("j reaction", false)]);
    assert_eq!(again(&scene), scene);
}

#[test]
fn thirty_two_digits_are_kept() {
    let text = "[scene]\ndimension = 2\nduration = 0.33333333333333333333333333333333\n\
                gravity = [1e-3, -9.80665000000000000000000001]\n";
    let scene = SceneFile::parse(text, "x").and_then(|file| file.numbers()).expect("a scene");
    let third = again(&scene).resolve::<DoubleDouble>().expect("a scene").duration;
    assert_eq!(third, DoubleDouble::from_decimal("0.33333333333333333333333333333333").unwrap());
    assert_ne!(Number::from(1.0 / 3.0), scene.duration);
}
