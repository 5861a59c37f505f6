//! Findings of the doctor in scenes with and without faults. No time is asserted.

mod motion;

use mbs::core::outputs::Reactions;
use mbs::core::scene::{Dimension, Scene};
use mbs::typed::Simulation;
use mbs::{Method, ResolvedMethod};
use mbs_study::doctor::{Checkup, Effort, Severity, examine};
use mbs_testkit::{random, retell};

/// Effort with few positions along the motion.
const LITTLE: Effort = Effort { positions: 20, seconds: 60.0 };

fn checkup(scene: &Scene<f64>, effort: &Effort) -> Checkup {
    let settings = ResolvedMethod::new(scene, &Method::default()).expect("the defaults are built");
    examine(scene, &settings, effort)
}

fn codes(checkup: &Checkup) -> Vec<&'static str> {
    checkup.findings.iter().map(|f| f.code).collect()
}

fn finding<'a>(checkup: &'a Checkup, code: &str) -> &'a mbs_study::doctor::Finding {
    let found = checkup.findings.iter().find(|f| f.code == code);
    found.unwrap_or_else(|| panic!("no {code} in {:?}", codes(checkup)))
}

/// Planar pendulum with given gravity, length and inertia, and further text.
fn pendulum(gravity: &str, length: f64, inertia: &str, more: &str) -> Scene<f64> {
    mbs_testkit::scene(&format!(
        "[scene]\nname = \"pendulum\"\ndimension = 2\nduration = 0.1\ngravity = {gravity}\n\
         [[body]]\nname = \"bob\"\nmass = 1.0\ncenter = [{length}, 0.0]\ninertia = {inertia}\n\
         [[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"bob\"]\nat = [0.0, 0.0]\n{more}\n"
    ))
}

const SCENES: [&str; 12] = [
    "andrews",
    "four-bar",
    "guided-four-bar",
    "iltis-links",
    "iltis-suspension",
    "n-four-bar-10",
    "rssr",
    "six-joint-arm",
    "slider-crank",
    "spatial-chain-20",
    "spatial-four-bar",
    "tree-30",
];

#[test]
fn both_levels_count_the_same_freedoms_and_natural_coordinates_hide_redundancies_only() {
    let still = Effort { positions: 0, ..LITTLE };
    for name in SCENES {
        let c = checkup(&mbs_testkit::file(name), &still);
        let [rows, columns, rank] = c.joint_level.sizes;
        let [coordinates, constraints, natural_rank] = c.natural.expect("it starts");
        assert_eq!(columns - rank, coordinates - natural_rank, "{name}");
        assert!(rows - rank >= constraints - natural_rank, "{name}");
        assert!(c.worst() < Some(Severity::Fault), "{name}: {:?}", c.findings);
    }
}

#[test]
fn reactions_are_unique_where_the_balance_of_the_bodies_says_so() {
    fn compare<const D: usize>(scene: &Scene<f64>) {
        let settings =
            ResolvedMethod::new(scene, &Method::default()).expect("the defaults are built");
        let simulation = Simulation::<f64, D>::new(scene, &settings).expect("it starts");
        let mut reactions = Reactions::new(scene, simulation.model()).expect("small");
        reactions.update(simulation.state());
        let c = examine(scene, &settings, &Effort { positions: 0, ..LITTLE });
        for (joint, unique) in c.unique.iter().enumerate() {
            let all = unique.iter().all(|x| *x);
            assert_eq!(all, reactions.is_unique(joint), "{}: {}", scene.name, c.joints[joint]);
        }
    }
    for name in SCENES {
        let scene = mbs_testkit::file(name);
        match scene.dimension {
            Dimension::Planar => compare::<2>(&scene),
            Dimension::Spatial => compare::<3>(&scene),
        }
    }
    for seed in 1..=20 {
        compare::<2>(&random::loops(seed, Dimension::Planar, 8, 3));
        compare::<3>(&random::loops(seed, Dimension::Spatial, 6, 3));
    }
}

#[test]
fn sound_random_mechanisms_have_no_finding_about_their_joints() {
    for seed in 1..=5 {
        for (dimension, n) in [(Dimension::Planar, 8), (Dimension::Spatial, 6)] {
            let c = checkup(&random::sound(seed, dimension, n), &LITTLE);
            let is_told = |code: &&str| {
                [
                    "dependent-set",
                    "almost-dependent",
                    "singular-start",
                    "uncertain-rank",
                    "freedoms-differ",
                ]
                .contains(code)
            };
            assert!(!codes(&c).iter().any(is_told), "{}: {:?}", c.scene, c.findings);
            assert!(c.worst() < Some(Severity::Fault), "{}: {:?}", c.scene, c.findings);
            assert!(c.methods.is_empty() && c.unique.iter().flatten().all(|x| *x), "{}", c.scene);
        }
    }
}

#[test]
fn a_flat_parallelogram_that_one_held_value_leads_away_may_fold() {
    let head = "name = \"flat\"\ngravity = [0.0, -9.8]\n";
    let drawn = mbs_testkit::scenes::flat_four_bar(head, [0.5, 2.0, 2.5], [0.0, 1.0, 3.0, 2.0]);
    let flat = drawn + "[[initial]]\njoint = \"O\"\nvalue = 0.5\n";
    let still = Effort { positions: 0, ..LITTLE };
    let c = checkup(&mbs_testkit::scene(&flat), &still);
    let told = finding(&c, "singular-reference");
    assert_eq!((told.severity, &told.joints[..]), (Severity::Doubt, &[0, 1, 2, 3][..]));
    let held = "[[initial]]\njoint = \"B\"\nvalue = 0.5\n".to_owned();
    // a guide prescribes the value of its joint, too
    let guided = "[[guide]]\njoint = \"B\"\ntable = [[0.0, 0.5], [1.0, 0.6]]\n".to_owned();
    for second in [held, guided] {
        let c = checkup(&mbs_testkit::scene(&(flat.clone() + &second)), &still);
        assert!(!codes(&c).contains(&"singular-reference"), "{second}: {:?}", c.findings);
    }
}

#[test]
fn the_spatial_four_bar_is_reported_with_all_its_joints_its_remedy_and_who_runs_it() {
    let scene = mbs_testkit::file("spatial-four-bar");
    let c = checkup(&scene, &LITTLE);
    let told = finding(&c, "dependent-set");
    assert_eq!((told.joints.len(), told.severity), (4, Severity::Doubt));
    for joint in &c.joints {
        assert!(told.message.contains(joint.as_str()), "{joint}: {}", told.message);
    }
    assert!(
        told.remedy.contains("spherical") && told.remedy.contains("cylindrical"),
        "{}",
        told.remedy
    );
    assert!(finding(&c, "hidden-by-sharing").message.contains("2 redundant equations of 3"));
    let refused = c.methods.iter().filter(|m| m.error.is_some()).map(|m| m.formulation);
    assert_eq!(refused.collect::<Vec<_>>(), ["classical"]);
    // the remedy is applied to the scene: no finding remains
    let mut mended = scene.clone();
    let cure = c.joint_level.sets[0].remedy.as_ref().expect("there is one");
    for change in &cure.changes {
        let joint = &mut mended.joints[change.joint];
        joint.kind = change.kind;
        joint.axes[1] = change.axis;
        if change.kind == mbs::core::scene::JointKind::Spherical {
            joint.axes = [None; 2];
        }
    }
    let mended = checkup(&mended, &LITTLE);
    assert_eq!(mended.dof(), 1);
    assert!(
        mended.joint_level.sets.is_empty() && mended.methods.is_empty(),
        "{:?}",
        mended.findings
    );
}

#[test]
fn a_checkup_does_not_depend_on_axes_or_the_order_of_bodies() {
    let scene = mbs_testkit::file("spatial-four-bar");
    let c = checkup(&scene, &LITTLE);
    for other in [retell::turn_scene(&scene), retell::reorder(&scene)] {
        let o = checkup(&other, &LITTLE);
        assert_eq!(codes(&o), codes(&c));
        let joints = |c: &Checkup| c.findings.iter().map(|f| f.joints.clone()).collect::<Vec<_>>();
        assert_eq!(joints(&o), joints(&c));
        // decompositions differ by rounding
        assert!((o.joint_level.least - c.joint_level.least).abs() < 1e-9);
        let turns = |c: &Checkup| -> Vec<f64> {
            c.loops.iter().flat_map(|l| &l.corners).map(|x| x.turn).collect()
        };
        assert!(turns(&o).iter().zip(turns(&c)).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

#[test]
fn four_bars_in_a_chain_pass_their_singular_position_where_it_is() {
    // two four-bar linkages of equal bars move like a pendulum, and are singular when all bars are in a line
    let scene = mbs_testkit::file("two-four-bars");
    let c = checkup(&scene, &Effort { positions: 400, seconds: 60.0 });
    let told = finding(&c, "passes-singular-position");
    let near = &c.motion.as_ref().expect("watched").nearest[0];
    assert_eq!(near.passages.len(), 10, "as the scene says: {near:?}");
    assert!(near.sigma < 1e-3 && told.message.contains("10 times"), "{}", told.message);
    assert_eq!(told.joints, near.joints);
    // a simulation confirms the time: the cranks, vertical in the reference configuration, are then horizontal
    let settings = ResolvedMethod::new(&scene, &Method::default()).expect("the defaults are built");
    let mut simulation = Simulation::<f64, 2>::new(&scene, &settings).expect("it starts");
    while simulation.state().t < near.passages[0] {
        simulation.advance(settings.step).expect("a step");
    }
    let crank = simulation.model().motion(&scene, 0, simulation.state());
    let upright = crank.rotation[(0, 0)].abs();
    // the crank deviates by at most the motion of two steps: one step because the simulation ends after the passage, and one for the error of
    // the cubic, whose samples are 25 steps apart
    let off = 2.0 * settings.step * crank.omega[2].abs();
    assert!(off > 0.0 && upright < off, "{upright} {off}");
}

#[test]
fn motions_without_mass_and_unlike_masses_are_reported() {
    let spinning = pendulum("[0.0, -9.81]", 0.0, "0.0", "");
    let c = checkup(&spinning, &Effort { positions: 0, ..LITTLE });
    assert_eq!(finding(&c, "massless-motion").bodies, [0]);
    let held = pendulum("[0.0, -9.81]", 1.0, "0.0", "");
    assert!(!codes(&checkup(&held, &LITTLE)).contains(&"massless-motion"), "its mass moves");
    let mut light = mbs_testkit::file("double-pendulum");
    light.bodies[1].mass *= 1e-8;
    let mut c = checkup(&light, &LITTLE);
    assert!(codes(&c).contains(&"mass-ratio"), "{:?}", codes(&c));
    light.bodies[1].mass *= 1e8;
    c = checkup(&light, &LITTLE);
    assert!(!codes(&c).contains(&"mass-ratio"));
}

#[test]
fn units_are_doubted_where_the_evidence_is_strong() {
    let still = Effort { positions: 0, ..LITTLE };
    let told = |scene: &Scene<f64>| codes(&checkup(scene, &still));
    let sound = pendulum("[0.0, -9.81]", 1.0, "0.1", "");
    assert_eq!(told(&sound), Vec::<&str>::new());
    assert!(told(&pendulum("[0.0, -9810.0]", 1.0, "0.1", "")).contains(&"gravity-unit"));
    assert!(told(&pendulum("[0.0, -9.81]", 1.0, "1e5", "")).contains(&"inertia-unit"));
    assert!(told(&pendulum("[0.0, -9.81]", 1000.0, "1e4", "")).contains(&"size-or-mass-unit"));
    let degrees = "[[initial]]\njoint = \"pivot\"\nvalue = 45.0";
    let c = checkup(&pendulum("[0.0, -9.81]", 1.0, "0.1", degrees), &still);
    assert!(finding(&c, "angle-unit").remedy.contains("0.785"), "{:?}", c.findings);
    for name in SCENES {
        let c = checkup(&mbs_testkit::file(name), &still);
        assert!(c.findings.iter().all(|f| f.topic != mbs_study::doctor::Topic::Units), "{name}");
    }
}

#[test]
fn a_rolling_disc_has_the_freedoms_that_both_countings_give_and_is_held() {
    let c = checkup(&mbs_testkit::file("rolling-disc"), &Effort { positions: 0, ..LITTLE });
    let is_wrong = |code: &&str| ["freedoms-differ", "free-body"].contains(code);
    assert!(!codes(&c).iter().any(is_wrong), "{:?}", c.findings);
}
