//! Members of sweeps, and the place of each error.

use mbs_core::scene::Number;
use mbs_scene::{
    ReadError, ReadFault, SceneFile, SceneSweep, SweepFault, SweepRefusal, SweepSource,
};

const SCENE: &str = r#"[scene]
name = "one"
dimension = 2
gravity = [0.0, -9.81]
duration = 1.0

[[body]]
name = "upper rod"
rod = { from = [0.0, 0.0], to = [1.0, 0.0] }
mass = 1.0

[[body]]
name = "lower"
rod = { from = [1.0, 0.0], to = [2.0, 0.0] }
mass = 2.0

[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "upper rod"]
at = [0.0, 0.0]

[[joint]]
name = "elbow"
kind = "revolute"
bodies = ["upper rod", "lower"]
at = [1.0, 0.0]

[[initial]]
joint = "pivot"
value = 0.0

[[initial]]
joint = "pivot"
rate = 0.0

[[effect]]
kind = "torsion-spring"
joint = "pivot"
stiffness = 10.0

[road]
kind = "stairs"
start = 1.0
tread = 1.0
riser = 0.2
height = 0.1
count = 3
"#;

fn scene() -> SceneFile {
    SceneFile::parse(SCENE, "scene.toml").expect("the scene is TOML")
}

fn file(text: &str) -> SweepSource {
    SceneFile::parse(text, "sweep.toml").expect("the sweep is TOML").into()
}

/// Applies a sweep to the scene and tries its values.
fn laid_out(source: &SweepSource) -> Result<SceneSweep, SweepRefusal> {
    let sweep = SceneSweep::new(source, &scene(), &["member".to_owned()])?;
    sweep.check(&scene(), |_| Ok(()))?;
    Ok(sweep)
}

fn read(text: &str) -> Result<SceneSweep, ReadError> {
    laid_out(&file(text)).map_err(|refusal| match refusal {
        SweepRefusal::File(error) => error,
        SweepRefusal::Numbers { .. } => panic!("{refusal:?}"),
    })
}

fn members(text: &str) -> Vec<Vec<String>> {
    values(&read(text).unwrap_or_else(|error| panic!("{}", error.render())))
}

/// The values of all parameters, member by member.
fn values(sweep: &SceneSweep) -> Vec<Vec<String>> {
    (0..sweep.n_members()).map(|i| sweep.values(i).map(str::to_owned).collect()).collect()
}

/// A table `[[vary]]` of a path, with further lines.
fn vary(path: &str, more: &str) -> String {
    format!("[[vary]]\npath = '{path}'\n{more}\n")
}

#[test]
fn a_grid_has_each_value_with_each_and_the_last_parameter_changes_fastest() {
    let text = vary("body.lower.mass", "values = [1, 2.50]")
        + &vary("scene.gravity[1]", "from = -10\nto = 0\ncount = 3");
    let expected =
        [["1", "-10"], ["1", "-5"], ["1", "0"], ["2.50", "-10"], ["2.50", "-5"], ["2.50", "0"]];
    assert_eq!(members(&text), expected);
}

#[test]
fn zip_pairs_values_one_to_one() {
    let text = "[sweep]\ncombine = 'zip'\n".to_owned()
        + &vary("body.lower.mass", "values = [1.0, 2.0, 3.0]")
        + &vary("scene.duration", "from = 1\nto = 2\nstep = 0.5");
    assert_eq!(members(&text), [["1.0", "1"], ["2.0", "1.5"], ["3.0", "2"]]);
}

#[test]
fn a_latin_hypercube_has_one_sample_in_each_stratum_of_each_parameter() {
    // Number of samples, and of equal intervals of each range.
    const N: usize = 64;
    let text = format!("[sweep]\ncombine = 'latin-hypercube'\nsamples = {N}\nseed = 5\n")
        + &vary("body.lower.mass", &format!("from = 1\nto = {}", N + 1))
        + &vary("scene.duration", &format!("from = {}\nto = 1", N + 1));
    let samples = members(&text);
    assert_eq!(samples, members(&text), "the same seed gives the same numbers");
    assert_ne!(samples, members(&text.replace("seed = 5", "seed = 6")));
    for parameter in 0..2 {
        let stratum = |row: &Vec<String>| row[parameter].parse::<f64>().unwrap().floor() as usize;
        let mut strata: Vec<usize> = samples.iter().map(stratum).collect();
        strata.sort_unstable();
        assert!(strata.into_iter().eq(1..=N));
    }
}

#[test]
fn members_replace_the_numbers_of_the_scene_and_nothing_else() {
    let text = vary("body.\"upper rod\".mass", "values = [3.5]\nalso = 'body.lower.mass'")
        + &vary("initial[1].rate", "values = [0.25]")
        + &vary("effect.effect-1.stiffness", "values = [77]");
    let sweep = read(&text).expect("a good sweep");
    let changed = sweep.member(&scene(), 0).scene::<f64>().expect("a good scene");
    let mut expected = scene().scene::<f64>().expect("a good scene");
    expected.bodies[0].mass = 3.5;
    expected.bodies[1].mass = 3.5;
    let text = SCENE.replace("rate = 0.0", "rate = 0.25").replace("= 10.0", "= 77");
    let other = SceneFile::parse(&text, "scene.toml").unwrap().scene::<f64>().unwrap();
    (expected.initials, expected.effects) = (other.initials, other.effects);
    assert_eq!(changed, expected);
}

#[test]
fn hard_points_shift_together_and_shifts_add() {
    let text = vary(
        "body.\"upper rod\".rod.to[0]",
        "values = [1.25]\nshift = ['joint.elbow.at[0]', 'body.lower.rod.from[0]', 'body.lower.rod.to[0]']",
    ) + &vary("body.lower.rod.to[0]", "values = [2.5]\nname = 'reach'");
    let member = read(&text).expect("a good sweep").member(&scene(), 0);
    let expected = SCENE
        .replace("to = [1.0, 0.0]", "to = [1.25, 0.0]")
        .replace("at = [1.0, 0.0]", "at = [1.25, 0.0]")
        .replace("from = [1.0, 0.0]", "from = [1.25, 0.0]")
        .replace("to = [2.0, 0.0]", "to = [2.75, 0.0]");
    let expected = SceneFile::parse(&expected, "scene.toml").unwrap();
    assert_eq!(member.scene::<f64>().unwrap(), expected.scene::<f64>().unwrap());
}

#[test]
fn what_only_a_member_can_show_is_no_refusal() {
    // The two values are valid together. One value alone would break a rule of the scene, for example that a rod must have a length.
    let text = "[sweep]\ncombine = 'zip'\n".to_owned()
        + &vary("body.lower.rod.from[0]", "values = [2.0]\nshift = 'joint.elbow.at[0]'")
        + &vary("body.lower.rod.to[0]", "values = [3.0]");
    let sweep = read(&text).expect("the values fit together");
    assert!(sweep.member(&scene(), 0).scene::<f64>().is_ok());
}

/// A refused case: the text of the file, the text at the place of the error, and a word each of message and hint.
type Case = (String, &'static str, &'static str, &'static str);

/// Reads each case, and compares place, message and hint of its error.
fn refuse(cases: Vec<Case>) {
    for (text, place, message, hint) in cases {
        let error = read(&text).expect_err(&text);
        let at = error.place();
        let found: String = at.text.chars().skip(at.column - 1).take(at.width).collect();
        let rendered = error.render();
        assert!(place.is_empty() || found == place, "{found}\n{rendered}");
        assert!(error.to_string().contains(message), "{message}\n{rendered}");
        assert!(error.hint().contains(hint), "{hint}\n{rendered}");
        assert_eq!(error.file(), "sweep.toml");
    }
}

#[test]
fn wrong_paths_are_refused_with_place_and_hint() {
    refuse(vec![
        (String::new(), "", "nothing to vary", "[[vary]]"),
        ("[swep]\n".to_owned(), "swep", "unknown key", "did you mean `sweep`"),
        (vary("bodi.lower.mass", "values = [1]"), "'bodi.lower.mass'", "no table `bodi`", "`body`"),
        (vary("body.lowr.mass", "values = [1]"), "'body.lowr.mass'", "called `lowr`", "`lower`"),
        (
            vary("body.lower.maß", "values = [1]"),
            "'body.lower.maß'",
            "no key `maß`",
            "keys: name, rod, mass; a key left out",
        ),
        (vary("body.lower", "values = [1]"), "'body.lower'", "is a table", "body.lower.name"),
        (vary("body[7].mass", "values = [1]"), "'body[7].mass'", "2 entries", "[0] to [1]"),
        (vary("scene.gravity", "values = [1]"), "'scene.gravity'", "is a list", "scene.gravity[1]"),
        (
            vary("scene.duration.x", "values = [1]"),
            "'scene.duration.x'",
            "a number",
            "end the path",
        ),
        (vary("scene.name", "values = [1]"), "'scene.name'", "a text", "name a number"),
        (
            vary("scene.dimension", "values = [3]"),
            "'scene.dimension'",
            "dimension",
            "a scene for each",
        ),
        (
            vary("initial.pivot.rate", "values = [1]"),
            "'initial.pivot.rate'",
            "2 entries",
            "initial[0] or initial[1]",
        ),
        (
            vary("body lower mass", "values = [1]"),
            "'body lower mass'",
            "no path",
            "body.crank.mass",
        ),
    ]);
}

#[test]
fn wrong_values_are_refused_with_place_and_hint() {
    let mass = |more| vary("body.lower.mass", more);
    refuse(vec![
        (mass(""), "", "nothing to vary", "`from`"),
        (mass("values = []"), "[]", "nothing to vary", "`values`"),
        (mass("values = [1, 'x']"), "x", "`x` is no parameter", "write a number"),
        (mass("values = [1.0, -2.5]"), "-2.5", "refuses -2.5 as `body.lower.mass`", "zero or more"),
        (mass("values = [1.0, inf]"), "inf", "not a finite number", "finite"),
        (mass("values = [1]\nfrom = 1"), "from", "no meaning here", "remove it"),
        (mass("from = -1\nto = 1\ncount = 5"), "-1", "refuses -1", "zero or more"),
        (mass("from = 1\nto = 2"), "", "`count or step` is missing", "add"),
        (mass("from = 1\nto = 2\ncount = 1"), "1", "ends where it begins", "different"),
        (mass("from = 1\nto = 2\ncount = 2.5"), "2.5", "does not count", "whole"),
        (mass("from = 1\nto = 1.0\ncount = 2"), "1.0", "ends where it begins", "values"),
        (mass("from = 1\nto = 2\nstep = -0.1"), "-0.1", "no step of this length", "sign"),
        (mass("from = 1\nto = 2\nstep = 1e-9"), "1e-9", "more than", "fewer"),
        (mass("from = 0\nto = 2\ncount = 3\nscale = 'log'"), "0", "above zero", "positive"),
        (mass("from = 1\nto = 2\ncount = 3\nscale = 'lg'"), "'lg'", "unknown scale", "`log`"),
        (mass("from = 1\nto = 2\ncount = 3\nstep = 1"), "1", "both", "keep one"),
    ]);
}

#[test]
fn wrong_combinations_are_refused_with_place_and_hint() {
    let mass = |more| vary("body.lower.mass", more);
    let latin =
        |head: &str, more| format!("[sweep]\ncombine = 'latin-hypercube'\n{head}\n") + &mass(more);
    refuse(vec![
        (latin("samples = 4", "from = 1\nto = 2"), "", "`seed` is missing", "add"),
        (latin("samples = 4\nseed = -1", "from = 1\nto = 2"), "-1", "no seed", "from 0"),
        (latin("samples = 4\nseed = 1", "values = [1]"), "[1]", "`values` has no meaning", "from"),
        (
            latin("samples = 4\nseed = 1", "from = 1\nto = 2\ncount = 3"),
            "count",
            "no meaning",
            "remove",
        ),
        ("[sweep]\nseed = 1\n".to_owned() + &mass("values = [1]"), "seed", "no meaning", "remove"),
        (
            mass("values = [1]") + &mass("values = [2]"),
            "'body.lower.mass'",
            "another column",
            "`name`",
        ),
        (
            mass("values = [1]") + &mass("values = [2]\nname = 'm'"),
            "'body.lower.mass'",
            "already set",
            "shift",
        ),
        (mass("values = [1]\nname = 'member'"), "'member'", "another column", "`name`"),
        (
            "[sweep]\ncombine = 'zip'\n".to_owned()
                + &mass("values = [1]")
                + &vary("scene.duration", "values = [1, 2]"),
            "'scene.duration'",
            "here are 2",
            "as many",
        ),
        (
            mass("from = 1\nto = 2\ncount = 2000")
                + &vary("scene.duration", "from = 1\nto = 2\ncount = 2000"),
            "'scene.duration'",
            "4000000 members",
            "hypercube",
        ),
        (vary("road.count", "values = [1, 2.5]"), "2.5", "does not count", "whole number"),
        (vary("road.count", "from = 1\nto = 4\ncount = 3"), "4", "refuses 2.5", "whole number"),
    ]);
}

#[test]
fn a_refusal_has_its_type() {
    let error = read(&vary("body.lower.mass", "values = [-1]")).expect_err("a negative mass");
    assert!(matches!(error.fault(), ReadFault::Sweep(SweepFault::Refused { .. })));
}

#[test]
fn what_the_settings_refuse_is_refused_too_and_varied_paths_are_known() {
    let scene = SceneFile::parse(&format!("{SCENE}[solver]\nstep = 1e-3\n"), "scene.toml").unwrap();
    let text = vary("solver.step", "values = [1e-3, 2.0]");
    let sweep = SceneSweep::new(&file(&text), &scene, &[]).expect("the path is there");
    let error = sweep.check(&scene, |scene| match scene.solver.step {
        Some(step) if step > 1.0 => Err(("not so".to_owned(), "shorter".to_owned())),
        _ => Ok(()),
    });
    let Err(SweepRefusal::File(error)) = error else { panic!("{error:?}") };
    assert_eq!(error.hint(), "shorter");
    assert!(sweep.varies(&scene, "solver.step") && !sweep.varies(&scene, "scene.duration"));
}

/// Adds numbers of code to a sweep.
fn numbers(mut sweep: SweepSource, varied: &[(&str, &[f64])]) -> SweepSource {
    for (path, values) in varied {
        sweep.vary(path, values.iter().map(|&x| Number::from(x)).collect());
    }
    sweep
}

#[test]
fn numbers_of_code_make_the_members_of_their_text() {
    let varied: [(&str, &[f64]); 2] =
        [("body.lower.mass", &[1.0, 2.5e-7]), ("scene.gravity[1]", &[-10.0, 1e16])];
    let text =
        vary(varied[0].0, "values = [1.0, 2.5e-7]") + &vary(varied[1].0, "values = [-10.0, 1e16]");
    for (head, source) in
        [("", SweepSource::grid()), ("[sweep]\ncombine = 'zip'\n", SweepSource::zip())]
    {
        let text = head.to_owned() + &text;
        let sweep = laid_out(&numbers(source, &varied)).expect("a good sweep");
        assert_eq!(values(&sweep), members(&text));
        let last = sweep.n_members() - 1;
        let of_text = read(&text).expect("a good sweep").member(&scene(), last);
        let scene = sweep.member(&scene(), last).scene::<f64>();
        assert_eq!(scene.expect("a scene"), of_text.scene::<f64>().expect("a scene"));
        assert_eq!(sweep.names().collect::<Vec<_>>(), varied.map(|(path, _)| path));
    }
    // All digits of a number remain.
    let mut long = SweepSource::grid();
    let digits = "1.00000000000000000000000001";
    long.vary("body.lower.mass", Number::from_decimal(digits).into_iter().collect());
    assert_eq!(values(&laid_out(&long).expect("a good sweep")), [[digits]]);
}

#[test]
fn code_varies_more_than_a_file_does() {
    let of_file = file(
        &("[sweep]\ncombine = 'zip'\n".to_owned() + &vary("scene.duration", "values = [1, 2]")),
    );
    let sweep = numbers(of_file.clone(), &[("body.lower.mass", &[3.0, 4.0])]);
    let both = laid_out(&sweep).expect("a good sweep");
    assert_eq!(values(&both), [["1", "3.0"], ["2", "4.0"]]);
    assert!(sweep != of_file && sweep.text().starts_with(&of_file.text()));
    // A file may have no `[[vary]]` when code gives the parameters.
    let sweep = numbers(file("[sweep]\ncombine = 'zip'\n"), &[("body.lower.mass", &[3.0, 4.0])]);
    assert_eq!(values(&laid_out(&sweep).expect("a good sweep")), [["3.0"], ["4.0"]]);
}

/// Paths of a sweep, each with its values.
type Lists<'a> = Vec<(&'a str, &'a [f64])>;

#[test]
fn numbers_of_code_are_refused_with_their_path() {
    let latin = "[sweep]\ncombine = 'latin-hypercube'\nsamples = 2\nseed = 1\n".to_owned()
        + &vary("scene.duration", "from = 1\nto = 2");
    let mass = "body.lower.mass";
    let one: &[f64] = &[1.0];
    let lists: [(SweepSource, Lists<'_>, &str, &str); 9] = [
        (SweepSource::grid(), vec![], "", "nothing to vary"),
        (SweepSource::grid(), vec![(mass, &[])], mass, "nothing to vary"),
        (SweepSource::grid(), vec![("body.lowr.mass", one)], "body.lowr.mass", "called `lowr`"),
        (
            SweepSource::grid(),
            vec![(mass, &[1.0, -2.5])],
            mass,
            "refuses -2.5 as `body.lower.mass`",
        ),
        (SweepSource::grid(), vec![(mass, one), (mass, one)], mass, "another column"),
        (
            SweepSource::grid(),
            vec![(mass, one), ("body[1].mass", one)],
            "body[1].mass",
            "already set by `body.lower.mass`",
        ),
        (
            SweepSource::zip(),
            vec![(mass, one), ("scene.duration", &[1.0, 2.0])],
            "scene.duration",
            "here are 2",
        ),
        (
            file(&vary(mass, "values = [1]\nname = 'm'")),
            vec![(mass, one)],
            mass,
            "already set by `m`",
        ),
        (file(&latin), vec![(mass, one)], mass, "samples ranges"),
    ];
    for (source, varied, at, message) in lists {
        let refusal = laid_out(&numbers(source, &varied)).expect_err(message);
        let SweepRefusal::Numbers { path, fault } = refusal else { panic!("{refusal:?}") };
        assert_eq!(path, at, "{fault}");
        assert!(fault.to_string().contains(message) && !fault.hint().is_empty(), "{fault}");
    }
}
