//! Monotone tables, whose values stay between those of their rows, in every formulation: a cam with dwells, a buffer, a guide.

use crate::common::oracle::{TRAPEZOIDAL, Way, run};
use mbs::scene_file::SceneFile;
use mbs::typed::Simulation;
use mbs::{CheckpointError, FormulationKind, Mechanism, Method, ResolvedMethod, Run};
use mbs_testkit::scene;

/// Number of rows of a cam's table in a revolution [-].
const N_ROWS: u32 = 6;

/// Scene of a shaft of 0.02 kg m^2 at 10 rad/s, whose cam lifts a follower of 0.5 kg on a spring. Rows are 60 degrees apart, with lifts in
/// mm.
fn cam(lifts: [f64; 7], way: &str) -> String {
    let row = |(i, lift): (u32, &f64)| {
        format!(
            "[{:?}, {:?}]",
            f64::from(i) * core::f64::consts::TAU / f64::from(N_ROWS),
            lift * 1e-3
        )
    };
    let table: Vec<String> = (0..).zip(&lifts).map(row).collect();
    format!(
        "[scene]\ndimension = 2\nduration = 0.8\ngravity = [0.0, 0.0]\n\
        [[body]]\nname = \"cam\"\nmass = 2.0\ncenter = [0.0, 0.0]\ninertia = 0.02\n\
        [[body]]\nname = \"follower\"\nmass = 0.5\ncenter = [0.0, 0.1]\ninertia = 1.0e-4\n\
        [[joint]]\nname = \"shaft\"\nkind = \"revolute\"\nbodies = [\"ground\", \"cam\"]\nat = [0.0, 0.0]\n\
        [[joint]]\nname = \"slide\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"follower\"]\nat = [0.0, 0.1]\naxis = [0.0, 1.0]\n\
        [[coupling]]\nname = \"lift\"\nkind = \"cam\"\njoints = [\"shaft\", \"slide\"]\ntable = [{}]\n{way}periodic = true\n\
        [[initial]]\njoint = \"shaft\"\nvalue = 0.0\nrate = 10.0\n\
        [[effect]]\nname = \"spring\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"follower\"]\n\
        points = [[0.0, 1.1], [0.0, 0.1]]\nstiffness = 2000.0\nfree_length = 1.0\n\
        [[output]]\nname = \"lift\"\njoint = \"slide\"\nquantity = \"value\"\n\
        [[output]]\nname = \"turn\"\njoint = \"shaft\"\nquantity = \"value\"\n",
        table.join(", ")
    )
}

const LIFTS: [f64; 7] = [0.0, 0.0, 10.0, 10.0, 0.0, 0.0, 0.0];
const MONOTONE: &str = "interpolation = \"monotone\"\n";

fn column(text: &str, way: Way, step: f64, output: usize) -> Vec<f64> {
    let duration = scene(text).duration;
    run(text, way, (step, duration)).iter().map(|row| row.1[output]).collect()
}

fn range(values: &[f64]) -> [f64; 2] {
    let of = |f: fn(f64, f64) -> f64, start| values.iter().copied().fold(start, f);
    [of(f64::min, f64::MAX), of(f64::max, f64::MIN)]
}

#[test]
fn a_monotone_cam_lifts_within_its_rows_in_every_formulation_with_order_two() {
    let text = cam(LIFTS, MONOTONE);
    let exact = column(&text, Way("recursive", "rk853"), 1e-4, 1);
    let right = *exact.last().expect("a row");
    for formulation in TRAPEZOIDAL {
        let way = Way(formulation, "trapezoidal");
        let [low, high] = range(&column(&text, way, 1e-3, 0));
        // only the allowed violation of positions remains
        assert!(low > -1e-9 && high < 0.01 + 1e-9, "{formulation}: {low:e} {high}");
        let error = |step| (column(&text, way, step, 1).last().expect("a row") - right).abs();
        let [coarse, fine] = [2e-3, 5e-4].map(error);
        let order = (coarse / fine).log2() / 2.0;
        assert!((1.9..2.1).contains(&order), "{formulation}: {coarse:e} {fine:e}, order {order}");
    }
    let [low, high] = range(&column(&cam(LIFTS, ""), Way("recursive", "rk853"), 1e-3, 0));
    assert!(low < -1e-3 && high > 0.0119, "a spline: {low} {high}");
}

/// Scene of a slide that is guided over the travel of a buffer. The buffer's force is a curve of the measured travel.
fn buffer(way: &str) -> String {
    format!(
        "[scene]\ndimension = 2\nduration = 1.0\ngravity = [0.0, 0.0]\n\
        [[body]]\nname = \"rod\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n\
        [[joint]]\nname = \"travel\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"rod\"]\nat = [0.0, 0.0]\naxis = [1.0, 0.0]\n\
        [[guide]]\njoint = \"travel\"\ntable = [[0.0, 0.0], [1.0, 0.12]]\n{MONOTONE}ends = \"level\"\n\
        [[signal]]\nname = \"travel\"\nkind = \"measure\"\njoint = \"travel\"\n\
        [[signal]]\nname = \"force\"\nkind = \"curve\"\nof = \"travel\"\n{way}\
        table = [[0.0, 100e3], [0.002, 80e3], [0.007, 20e3], [0.012, 0.0], [0.12, 0.0]]\n\
        [[effect]]\nname = \"buffer\"\nkind = \"torque\"\njoint = \"travel\"\nsignal = \"force\"\n\
        [[output]]\nname = \"force\"\neffect = \"buffer\"\nquantity = \"force\"\n\
        [[output]]\nname = \"travel\"\njoint = \"travel\"\nquantity = \"value\"\n"
    )
}

#[test]
fn a_buffer_by_a_monotone_curve_never_pulls_in_every_formulation() {
    for formulation in TRAPEZOIDAL {
        // `force` is the range of the force of the first body on the second; the output has the opposite sign
        let force = |way: &str| {
            let all = column(&buffer(way), Way(formulation, "trapezoidal"), 1e-3, 0);
            range(&all.iter().map(|x| -x).collect::<Vec<_>>())
        };
        let [low, high] = force(MONOTONE);
        assert!(low >= 0.0 && (high - 100e3).abs() < 1e-6, "{formulation}: {low} {high}");
        let [low, _] = force("interpolation = \"linear\"\n");
        assert!(low >= 0.0, "{formulation}: {low}");
        let [low, _] = force("");
        assert!((-33e3..-31e3).contains(&low), "{formulation}: a spline, {low}");
    }
}

/// A guide moves from 0 to 0.12 m in a second, at rest at both ends. The table has two rows, so the spline is 3 s^2 - 2 s^3 and no row limits
/// it.
#[test]
fn a_guide_by_a_monotone_table_stays_between_its_rows() {
    let stays = |table: &str, (low, high): (f64, f64)| {
        let text = buffer("").replace("table = [[0.0, 0.0], [1.0, 0.12]]", table);
        assert_ne!(text, buffer(""));
        for formulation in TRAPEZOIDAL {
            let travel = column(&text, Way(formulation, "trapezoidal"), 1e-3, 1);
            let found = range(&travel);
            assert!(found[0] > low - 1e-12 && found[1] < high + 1e-12, "{formulation}: {found:?}");
        }
    };
    stays("table = [[0.0, 0.0], [0.4, 0.0], [0.5, 0.12], [1.0, 0.12]]", (0.0, 0.12));
    stays(
        "table = [[0.0, 0.0], [0.3, 0.05], [0.5, -0.02], [0.6, 0.12], [1.0, 0.11]]",
        (-0.02, 0.12),
    );
}

/// Notes of a run of 0.1 s.
fn notes(text: &str, kind: FormulationKind) -> Vec<String> {
    let m = Mechanism::parse(text).expect("a scene");
    let method = Method { step: Some(1e-3), duration: Some(0.1), ..Method::new(kind) };
    mbs::run(&m, &Run::new().method(method)).expect("it runs").notes().to_vec()
}

/// Scene of a shaft at 2 rad/s, whose cam lifts or lowers a follower of 2 kg on a vertical slide, or rotates it.
fn held(curve: &str, follower: &str) -> String {
    format!(
        "[scene]\ndimension = 2\nduration = 0.5\ngravity = [0.0, -9.81]\n\
        [[body]]\nname = \"cam\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.02\n\
        [[body]]\nname = \"follower\"\nmass = 2.0\ncenter = [0.0, 0.1]\ninertia = 3.0\n\
        [[joint]]\nname = \"shaft\"\nkind = \"revolute\"\nbodies = [\"ground\", \"cam\"]\nat = [0.0, 0.0]\n\
        [[joint]]\nname = \"follower\"\nbodies = [\"ground\", \"follower\"]\nat = [0.0, 0.1]\n{follower}\n\
        [[guide]]\njoint = \"shaft\"\nramp = {{ rate = 2.0 }}\n\
        [[coupling]]\nname = \"lift\"\nkind = \"cam\"\njoints = [\"shaft\", \"follower\"]\n{curve}\n"
    )
}

#[test]
fn a_cam_that_would_have_to_pull_is_noted_with_its_time_and_force() {
    let slide = "kind = \"prismatic\"\naxis = [0.0, 1.0]";
    // x'' = -12 m/s^2 exceeds gravity, 9.81 m/s^2, by 4.38 N on 2 kg; with x'' = -8 m/s^2 the cam pushes
    let falls = |x: f64| format!("coefficients = [0.0, 0.0, {:?}]", -0.5 * x / 4.0);
    let level = "table = [[-1.0, 0.0], [0.0, 0.0], [1.0, -0.001], [2.0, -0.001]]\ninterpolation = \"monotone\"";
    for kind in FormulationKind::listed() {
        let noted = |curve: &str, follower: &str| notes(&held(curve, follower), kind);
        assert_eq!(noted(&falls(8.0), slide), [""; 0], "{}", kind.name());
        let found = noted(&falls(12.0), slide);
        let text = |force: &str| {
            format!(
                "the cam `lift` pulls at t = 0 s, by up to {force}: what may lift off is a `limit` with this sum as its `terms`"
            )
        };
        assert_eq!(found, [text("4.38 N")], "{}", kind.name());
        // the follower has 3 kg m^2 about its centre
        let found = noted(&falls(12.0), "kind = \"revolute\"");
        assert_eq!(found, [text("36 N m")], "{}", kind.name());
        // a cam that acts from above carries the weight, so it pulls
        let found = noted(level, slide);
        assert!(found.len() == 1 && found[0].contains("pulls at t = 0 s"), "{found:?}");
    }
}

#[test]
fn a_spline_that_leaves_its_rows_is_noted_with_its_table_and_its_key() {
    let kind = FormulationKind::listed().next().expect("one is there");
    let found = notes(&cam(LIFTS, ""), kind);
    let text = "the spline of `table` of coupling `lift` goes to f = 0.0120";
    let of_table = found.iter().filter(|note| note.contains("spline"));
    let of_table: Vec<_> = of_table.collect();
    assert!(of_table.len() == 1 && of_table[0].starts_with(text), "{found:?}");
    assert!(of_table[0].ends_with("give it `interpolation = \"monotone\"`"), "{found:?}");
    let none = notes(&cam(LIFTS, MONOTONE), kind);
    assert!(none.iter().all(|note| !note.contains("spline")), "{none:?}");
}

#[test]
fn a_checkpoint_knows_the_rows_of_a_file() {
    let folder = std::env::temp_dir().join(format!("mbs-tables-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
    let rows = "table = { file = \"force.csv\", columns = [\"x\", \"f\"] }\n";
    let (head, tail) = buffer(MONOTONE).split_once("table = [[0.0, 100e3]").map_or_else(
        || panic!("a table"),
        |(head, tail)| (head.to_owned(), tail.split_once('\n').expect("a line").1.to_owned()),
    );
    file("buffer.toml", &format!("{head}{rows}{tail}"));
    let read = |forces: &str| {
        file("force.csv", forces);
        let file = SceneFile::read(folder.join("buffer.toml")).expect("a scene");
        (file.scene::<f64>().expect("a scene"), file.whole_text())
    };
    let forces = "x [mm],f [kN]\n0,100\n2,80\n7,20\n12,0\n120,0\n";
    let (one, text) = read(forces);
    let (same, _) = read(&forces.replace(",20", ", 20.0"));
    let (other, changed) = read(&forces.replace("20", "21"));
    std::fs::remove_dir_all(&folder).expect("it was there");
    assert_eq!(one.signals, scene(&buffer(MONOTONE)).signals);
    assert_ne!(text, changed);
    let settings = ResolvedMethod::new(&one, &Method::default()).expect("good settings");
    let start = |scene| Simulation::<f64, 2>::new(scene, &settings).expect("it starts");
    let mut bytes = Vec::new();
    start(&one).save((&one, &settings), &mut bytes).expect("memory");
    assert!(start(&same).restore((&same, &settings), &bytes[..]).is_ok());
    match start(&other).restore((&other, &settings), &bytes[..]) {
        Err(CheckpointError::Scene(parts)) => assert_eq!(parts, ["[[signal]]"]),
        found => panic!("{found:?}"),
    }
}
