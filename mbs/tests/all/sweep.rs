//! The sweeps of the repository.

use crate::common::path;

#[test]
fn the_sweeps_of_the_repository_fit_their_scenes() {
    for (name, scene_name, members) in [
        ("double-pendulum-lengths", "double-pendulum", 25),
        ("iltis-stairs-vehicles", "iltis-stairs", 200),
    ] {
        let read = |name: &str| {
            let text =
                std::fs::read_to_string(path(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
            mbs::scene_file::Document::parse(&text, name).expect("TOML")
        };
        let (scene, sweep) = (read(scene_name), read(&format!("sweeps/{name}")));
        let study = mbs::sweep::Study::new(scene, &sweep, &mbs::Overrides::default());
        let study = study.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(study.n_members(), members);
        let row = study.member(members - 1);
        assert_eq!(row.failure, None, "{name}");
    }
}
