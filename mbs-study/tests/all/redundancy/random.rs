//! Random mechanisms: none of the regular ones has a finding, and every duplicated part of the others is found.

use super::support::{Build, GROUND, diagnosis, four_bar, sets};
use mbs_core::scene::{Dimension, Scene};
use mbs_study::redundancy::{Linkage, Nature, UNCERTAIN};
use mbs_testkit::{random, retell};

/// Two hundred mechanisms whose equations are independent by counting.
fn sound() -> impl Iterator<Item = Scene<f64>> {
    let both = [(Dimension::Planar, 10), (Dimension::Spatial, 8)];
    both.into_iter().flat_map(|(d, n)| (1..=100).map(move |seed| random::sound(seed, d, n)))
}

#[test]
fn nothing_depends_in_two_hundred_sound_mechanisms() {
    let (mut n_loops, mut n_checked) = (0, 0);
    for scene in sound() {
        let d = diagnosis(&scene);
        assert!(d.sets.is_empty(), "{}: {:?}", scene.name, d.sets);
        assert!(d.gap > UNCERTAIN, "{}: {}", scene.name, d.gap);
        n_loops += scene.joints.len() - scene.bodies.len();
        n_checked += 1;
    }
    assert_eq!(n_checked, 200);
    assert!(n_loops >= 150, "mechanisms without loops show little: {n_loops}");
}

#[test]
fn a_doubled_joint_and_its_copy_are_the_set_in_each_of_them() {
    for (i, mut scene) in sound().enumerate() {
        let joint = (7 * i) % scene.joints.len();
        let mut twin = scene.joints[joint].clone();
        twin.name = "twin".to_owned();
        scene.joints.push(twin);
        let rows = Linkage::new(&scene).n_rows(joint);
        let found = sets(&diagnosis(&scene));
        let members = vec![joint, scene.joints.len() - 1];
        assert_eq!(found.len(), 1, "{}: {found:?}", scene.name);
        assert_eq!((&found[0].0, found[0].1), (&members, rows), "{}", scene.name);
        assert_eq!(found[0].2, Nature::Structural, "{}", scene.name);
    }
}

#[test]
fn two_joints_doubled_are_two_sets_wherever_they_stand() {
    for (i, mut scene) in sound().enumerate().step_by(5) {
        let n = scene.joints.len();
        let [a, b] = [(3 * i) % n, (3 * i + 1 + i % (n - 1)) % n];
        if a == b {
            continue;
        }
        for (name, joint) in [("twin-a", a), ("twin-b", b)] {
            let mut twin = scene.joints[joint].clone();
            twin.name = name.to_owned();
            scene.joints.push(twin);
        }
        let mut expected = vec![vec![a, n], vec![b, n + 1]];
        expected.sort();
        let found: Vec<Vec<usize>> = sets(&diagnosis(&scene)).into_iter().map(|s| s.0).collect();
        assert_eq!(found, expected, "{}", scene.name);
    }
}

#[test]
fn a_doubled_coupler_names_its_four_pins_and_not_the_cranks() {
    let mut b = Build::planar();
    four_bar(&mut b, 0.0);
    let [from, to] = [1, 2].map(|j| b.0.joints[j].points[0]);
    let twin = b.bar(from, to);
    let [crank, rocker] = [0, 2].map(mbs_core::scene::BodyId::Body);
    b.pin(crank, twin, from);
    b.pin(twin, rocker, to);
    b.pin(GROUND, twin, from);
    // the last pin holds the crank's end to the ground, which gives a structure; without it the set consists of the two couplers
    let pinned = sets(&diagnosis(&b.0));
    b.0.joints.pop();
    assert_eq!(sets(&diagnosis(&b.0)), [(vec![1, 2, 4, 5], 1, Nature::Structural)]);
    let named: Vec<usize> = pinned.iter().flat_map(|s| s.0.clone()).collect();
    assert!([0, 1, 2, 4, 5, 6].iter().all(|j| named.contains(j)), "{pinned:?}");
}

#[test]
fn a_doubled_joint_is_found_whatever_the_axes_and_the_order_of_bodies() {
    for (i, mut scene) in sound().enumerate().step_by(8) {
        let joint = (5 * i) % scene.joints.len();
        let mut twin = scene.joints[joint].clone();
        twin.name = "twin".to_owned();
        scene.joints.push(twin);
        let expected = diagnosis(&scene);
        let turned = match scene.dimension {
            Dimension::Planar => retell::turn_by(&scene, retell::turned_in_plane),
            Dimension::Spatial => retell::turn_scene(&scene),
        };
        for other in [turned, retell::reorder(&scene)] {
            let found = diagnosis(&other);
            assert_eq!(sets(&found), sets(&expected), "{}", scene.name);
            let open = |d: &mbs_study::redundancy::Diagnosis| -> Vec<[usize; 3]> {
                d.sets[0].members.iter().map(|m| m.open).collect()
            };
            assert_eq!(open(&found), open(&expected), "{}", scene.name);
        }
    }
}
