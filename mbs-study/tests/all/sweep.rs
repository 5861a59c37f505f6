//! Sweeps of the repository's files.

mod members;

use mbs::Method;
use mbs::scene_file::SceneFile;
use mbs_study::sweep::{Study, StudyError};
use mbs_testkit::repository::path;

fn read(name: &str) -> SceneFile {
    let text = std::fs::read_to_string(path(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    SceneFile::parse(&text, name).expect("TOML")
}

#[test]
fn a_sweep_in_pairs_of_doubles_is_refused_before_its_members() {
    let (scene, sweep) = (read("double-pendulum"), read("sweeps/double-pendulum-lengths"));
    let overrides = Method { precision: Some("dd".to_owned()), ..Method::default() };
    assert!(matches!(Study::new(scene, &sweep.into(), &overrides), Err(StudyError::Pairs)));
}

#[test]
fn the_sweeps_of_the_repository_fit_their_scenes() {
    for (name, scene_name, members) in [
        ("double-pendulum-lengths", "double-pendulum", 25),
        ("iltis-stairs-vehicles", "iltis-stairs", 200),
    ] {
        let (scene, sweep) = (read(scene_name), read(&format!("sweeps/{name}")));
        let study = Study::new(scene, &sweep.into(), &Method::default());
        let study = study.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(study.n_members(), members);
        let row = study.member(members - 1);
        assert_eq!(row.failure, None, "{name}");
    }
}
