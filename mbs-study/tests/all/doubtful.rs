//! Doubtful input: it is reported or refused, with a remedy.

use mbs::core::scene::{Inertia, Scene};
use mbs::scene_file::SceneFile;
use mbs::{Method, ResolvedMethod, SettingsError};
use mbs_study::doctor::{Checkup, Effort, Severity, examine};
use mbs_testkit::repository::{field, read, text, tilted};

/// Effort without a run: all findings of these tests concern the start.
const STILL: Effort = Effort { positions: 0, seconds: 60.0 };
/// Largest difference of two independent computations of a motion [m or rad]. The reference is given to this precision. The runs use a rule of
/// second order with steps of 0.1 ms.
const CLOSE: f64 = 1e-5;

fn checkup(scene: &Scene<f64>) -> Checkup {
    let settings = ResolvedMethod::new(scene, &Method::default()).expect("the defaults are built");
    examine(scene, &settings, &STILL)
}

/// Messages of the doctor about places, with the names in them.
fn places(scene: &Scene<f64>) -> Vec<String> {
    let found = checkup(scene).findings;
    found.into_iter().filter(|f| f.topic.name() == "places").map(|f| f.message).collect()
}

#[test]
fn ends_that_miss_the_place_they_belong_to_are_named_with_their_distance() {
    let rod = places(&field("12-rod-end-off-its-joint"));
    assert_eq!(rod, ["the end of rod `crank` is 10 mm from joint `A`: intended as one point?"]);
    let spring = places(&field("12-spring-end-off-its-point"));
    assert_eq!(spring, ["the end of `spring` is 8 mm from joint `eye`: intended as one point?"]);
}

#[test]
fn ends_that_meet_their_place_or_are_intended_elsewhere_are_not_named() {
    let rod = text("12-rod-end-off-its-joint");
    let changed = |from: &str, to: &str| {
        assert!(rod.contains(from));
        places(&read(&rod.replace(from, to), "changed"))
    };
    let end = "to = [0.05, 0.0966]";
    assert_eq!(changed(end, "to = [0.05, 0.0866]"), [""; 0], "to the last digit");
    assert_eq!(changed(end, "to = [0.0625, 0.10825]"), [""; 0], "a fifth longer: it overhangs");
    assert_eq!(changed(end, "to = [0.05, 0.08660001]").len(), 1, "a slip of a digit");
    // a crank of 5 mm in a mechanism of 0.4 m: both of its ends are near both of its joints, and coincide with them
    let tiny = rod.replace(end, "to = [0.003, 0.004]").replace("[0.05, 0.0866]", "[0.003, 0.004]");
    assert_eq!(places(&read(&tiny, "tiny")), [""; 0]);
    let spring = text("12-spring-end-off-its-point");
    let moved =
        |to: &str| places(&read(&spring.replace("[[0.4, 0.0], ", &format!("[{to}, ")), "moved"));
    assert_eq!(moved("[0.408, 0.0]"), [""; 0]);
    assert_eq!(moved("[0.38, 0.0]"), [""; 0], "28 mm of half a metre");
}

#[test]
fn effects_that_share_a_place_are_named_where_one_of_them_was_moved() {
    let spring = text("12-spring-end-off-its-point");
    let damper = "[[effect]]\nname = \"damper\"\nkind = \"spring-damper\"\nbodies = [\"lever\", \"ground\"]\n\
                  points = [[0.3, 0.0], [0.4, 0.35]]\ndamping = 5.0\n";
    let apart = spring.replace("[[0.4, 0.0], ", "[[0.306, 0.0], ") + damper;
    let told = places(&read(&apart, "apart"));
    assert_eq!(
        told,
        ["the end of `spring` is 6 mm from the end of `damper`: intended as one point?"]
    );
    // a rod whose end coincides with the end of its spring, 6 mm from the joint of both
    let attached = text("12-rod-end-off-its-joint").replace("0.0966", "0.0926")
        + "[[effect]]\nname = \"strut\"\nkind = \"spring-damper\"\nbodies = [\"crank\", \"ground\"]\n\
           points = [[0.05, 0.0926], [0.5, 0.0]]\ndamping = 5.0\n";
    assert_eq!(places(&read(&attached, "attached")).len(), 2, "the rod and the strut");
    // neither the spring nor the damper ends at the end of the rod
    let both = spring.clone() + &damper.replace("[0.3, 0.0]", "[0.4, 0.0]");
    assert_eq!(places(&read(&both, "both")).len(), 2);
}

#[test]
fn places_that_are_counted_from_the_body_are_reported() {
    let text = "[scene]\ndimension = 2\nduration = 0.1\n\
        [[body]]\nname = \"cart\"\nmass = 1.0\ncenter = [5.0, 0.0]\ninertia = 0.02\n\
        [[joint]]\nname = \"rail\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"cart\"]\nat = [5.0, 0.0]\naxis = [1.0, 0.0]\n\
        [[effect]]\nname = \"spring\"\nkind = \"spring-damper\"\nbodies = [\"cart\", \"ground\"]\n\
        points = [[0.1, 0.0], [7.0, 0.0]]\nstiffness = 10.0\nfree_length = 1.0\n";
    let found = checkup(&read(text, "counted from the cart")).findings;
    let told = found.iter().find(|f| f.code == "place-off-body").expect("it is told");
    assert!(
        told.message.contains("`spring`") && told.message.contains("4.9 m"),
        "{}",
        told.message
    );
    assert!(told.remedy.ends_with("[5.1, 0]"), "{}", told.remedy);
    let right = text.replace("[[0.1, 0.0], ", "[[5.1, 0.0], ");
    assert_eq!(places(&read(&right, "right")), [""; 0]);
}

#[test]
fn no_scene_has_a_place_that_is_doubtful() {
    // the check includes all scenes of the repository
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");
    let mut n = 0;
    for entry in std::fs::read_dir(folder).expect("the scenes") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let name = path.display().to_string();
        let scene = read(&std::fs::read_to_string(&path).expect("a scene"), &name);
        if scene.bodies.len() > 50 {
            continue;
        }
        n += 1;
        assert_eq!(places(&scene), [""; 0], "{name}");
    }
    assert!(n > 20, "{n}");
}

#[test]
fn a_part_that_no_body_can_have_is_a_note_where_what_it_is_welded_to_can() {
    let scene = field("16-dummy-inertia-on-a-weld");
    let found = checkup(&scene);
    let notes: Vec<_> = found.findings.iter().map(|f| (f.severity, f.code)).collect();
    assert!(notes.contains(&(Severity::Note, "part-inertia")), "{notes:?}");
    assert_eq!(found.worst(), Some(Severity::Note));
    // welded bodies are one body: its free fall is that of the scene without the frame
    let outcome = mbs::typed::run::<f64, 3>(
        &scene,
        &ResolvedMethod::new(&scene, &Method::default()).unwrap(),
        &mut (),
    );
    assert!(outcome.error.is_none());
    let alone = text("16-dummy-inertia-on-a-weld").replace("\"weld\"", "\"spherical\"");
    let document = SceneFile::parse(&alone, "alone").expect("a scene file");
    assert!(document.scene::<f64>().is_err(), "as a body of its own it is refused");
    let mut massless = scene;
    massless.bodies[1].mass = 0.0;
    massless.bodies[1].inertia = Inertia::Spatial([1e-6, 1e-6, 1e-6, 0.0, 0.0, 0.0]);
    let told = checkup(&massless).findings;
    assert!(told.iter().any(|f| f.message.contains("inertia and no mass")));
    assert!(told.iter().all(|f| f.code != "no-mass"), "the lump has mass: {told:?}");
}

#[test]
fn a_table_that_ends_on_a_slope_within_the_run_is_refused_at_its_row_and_runs_with_level_ends() {
    let text = text("20-guide-table-ends-on-a-slope");
    let document = SceneFile::parse(&text, "table.toml").expect("a scene file");
    let scene: Scene<f64> = document.scene().expect("a scene");
    let error = ResolvedMethod::new(&scene, &Method::default()).unwrap_err();
    let SettingsError::Scene(fault) = error else { panic!("{error}") };
    let told = document.meaning(fault);
    // the error names the third row of the table
    assert_eq!((told.place().line, told.place().column), (34, 35));
    assert!(
        told.to_string().contains("ends at 0.5 s, within the run, with a rate of 0.900"),
        "{told}"
    );
    assert!(told.hint().contains("ends = \"level\""));
    // a run up to the end of the table is accepted, and so is a run with the hint's remedy
    let short = Method { duration: Some(0.5), ..Method::default() };
    assert!(ResolvedMethod::new(&scene, &short).is_ok());
    let level = text.replace("[0.5, 0.3]]", "[0.5, 0.3]]\nends = \"level\"");
    let scene = read(&level, "level");
    let run = |formulation: &str, step: f64| {
        let formulation = Some(formulation.to_owned());
        let overrides = Method { formulation, step: Some(step), ..Method::default() };
        let settings = ResolvedMethod::new(&scene, &overrides).expect("it is taken");
        let outcome = mbs::typed::run::<f64, 2>(&scene, &settings, &mut ());
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        let outputs = outcome.summary.outputs.0;
        let of = |name: &str| outputs.iter().find(|(n, _)| n == name).expect("an output").1[0];
        [of("p_value"), of("p_rate"), of("r_value")]
    };
    let [value, rate, r] = run("index-3", 1e-4);
    assert!((value - 0.3).abs() < 1e-12 && rate.abs() < 1e-9, "{value} {rate}");
    // the reference is the same motion by an integrator of order 8 in relative coordinates
    assert!((r + 0.349_771_266).abs() < CLOSE, "{r}");
}

#[test]
fn the_doctor_names_the_axis_that_is_off() {
    let effort = Effort { positions: 0, seconds: 1.0 };
    for (angle, code, severity) in
        [(1e-7, "axis-off", Severity::Note), (1e-4, "almost-dependent", Severity::Fault)]
    {
        let scene = tilted(angle);
        let settings = ResolvedMethod::new(&scene, &Method::default()).expect("settings");
        let checkup = examine(&scene, &settings, &effort);
        let found = checkup.findings.iter().find(|f| f.code == code && f.severity == severity);
        let found = found.unwrap_or_else(|| panic!("{angle:e}: {:?}", checkup.findings));
        assert_eq!(found.joints, [2], "{angle:e}");
    }
}

#[test]
fn point_masses_are_no_doubt() {
    // one point mass hangs on a string, another one is part of a spatial body
    let text = "[scene]\nname = \"p\"\ndimension = 3\nduration = 0.1\ngravity = [0.0, 0.0, -9.81]\n\
                [[body]]\nname = \"far\"\nmass = 1.0\npoint = [1.0, 0.2, -0.5]\n\
                [[body]]\nname = \"ball\"\nmass = 0.5\npoint = [0.5, 0.2, 0.1]\n\
                [[body]]\nname = \"arm\"\nmass = 2.0\ncenter = [0.2, 0.1, 0.0]\ninertia = [0.1, 0.12, 0.13, 0.0, 0.01, 0.0]\n\
                [[joint]]\nname = \"pivot\"\nkind = \"spherical\"\nbodies = [\"ground\", \"arm\"]\nat = [0.0, 0.0, 0.0]\n\
                [[joint]]\nname = \"held\"\nkind = \"spherical\"\nbodies = [\"arm\", \"ball\"]\nat = [0.5, 0.2, 0.1]\n\
                [[joint]]\nname = \"string\"\nkind = \"distance\"\nbodies = [\"ball\", \"far\"]\npoints = [[0.5, 0.2, 0.1], [1.0, 0.2, -0.5]]\n";
    let found = checkup(&mbs_testkit::scene(text));
    // the ball joint has three degrees of freedom, and the point on a string two
    let [_, columns, rank] = found.joint_level.sizes;
    let [coordinates, _, natural_rank] = found.natural.expect("it starts");
    assert_eq!((columns - rank, coordinates - natural_rank), (5, 5));
    assert!(found.worst() < Some(Severity::Doubt), "{:?}", found.findings);
}
