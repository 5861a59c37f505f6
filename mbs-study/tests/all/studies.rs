//! Studies of a mechanism in code give the results of those of its file.

use mbs::{Body, Error, FormulationKind, GROUND, Joint, Mechanism, Method, Precision, Run, run};
use mbs_study::{Compare, Sweep, compare, sweep};

fn pendulum() -> Mechanism {
    let mut m = Mechanism::planar("pendulum");
    m.set_gravity([0.0, -9.81]).set_duration(0.2);
    let bob = m.add(Body::planar([1.0, 0.0], 1.0, 0.1).named("bob"));
    m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
    m
}

#[test]
fn the_runs_of_a_sweep_are_those_of_the_mechanism_with_each_number() {
    let m = pendulum();
    let method = Method::new(FormulationKind::Recursive);
    let lengths = [0.5, 1.0, 1.5];
    let masses = [1.0, 2.0];
    let of = Sweep::grid().vary("body.bob.center.0", lengths).vary("body.bob.mass", masses);
    let one = sweep(&m, &of.clone().method(method.clone()).threads(1)).expect("it runs");
    let two = sweep(&m, &of.method(method.clone()).threads(2)).expect("it runs");
    assert_eq!((one.len(), one.failures().count()), (6, 0));
    let angles = one.column("pivot").expect("an output");
    assert_eq!(Some(&angles), two.column("pivot").as_ref());
    for (k, angle) in angles.into_iter().enumerate() {
        let mut m = m.clone();
        m.set("body.bob.center.0", lengths[k / 2]).expect("a path");
        m.set("body.bob.mass", masses[k % 2]).expect("a path");
        let result = run(&m, &Run::new().method(method.clone())).expect("it runs");
        assert_eq!(result.table().column("pivot").and_then(<[f64]>::last), Some(&angle), "{k}");
    }
}

#[test]
fn a_sweep_says_what_it_refuses_and_which_runs_fail() {
    let m = pendulum();
    let refused = |sweep_: Sweep| sweep(&m, &sweep_).expect_err("it is refused");
    let error = refused(Sweep::grid().vary("body.bib.mass", [1.0]));
    assert!(error.to_string().contains("bib"), "{error}");
    assert!(error.hint().is_some_and(|hint| hint.contains("bob")), "{error}");
    let error = refused(Sweep::grid().vary("body.bob.mass", [-1.0]));
    assert_eq!((error.code(), error.place()), ("scene-refused", None), "{error}");
    assert!(error.to_string().starts_with("`body.bob.mass`: the scene refuses -1.0"), "{error}");
    // the first member has neither mass nor inertia: only this run fails
    let of = Sweep::zip().vary("body.bob.mass", [0.0, 1.0]).vary("body.bob.inertia", [0.0, 0.1]);
    let runs = sweep(&m, &of).expect("it runs");
    let failures: Vec<_> = runs.failures().map(|(member, code, _)| (member, code)).collect();
    assert_eq!(failures, [(0, "no-inertia")]);
    let angles = runs.column("pivot").expect("an output");
    assert!(angles[0].is_nan() && angles[1] < 0.0, "{angles:?}");
    let mut table = Vec::new();
    runs.write_csv(&mut table).expect("memory");
    assert!(table.starts_with(b"member,body.bob.mass,body.bob.inertia,completed"));
    // numbers of the result are those of the table; texts and missing values are NaN
    let table = String::from_utf8(table).expect("text");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (header, rows) = (lines.next().expect("a header"), lines.collect::<Vec<_>>());
    assert_eq!((header.len(), rows.len()), (runs.names().len(), 2));
    for (i, name) in header.iter().enumerate() {
        let numbers = runs.column(name).expect("a column");
        let cells = rows.iter().map(|row| row[i].parse().unwrap_or(f64::NAN));
        assert!(cells.zip(&numbers).all(|(cell, x)| cell.total_cmp(x).is_eq()), "{name}");
    }
}

#[test]
fn a_sweep_of_a_file_shows_the_place_of_its_fault_there() {
    let path = std::env::temp_dir().join(format!("mbs-studies-{}.toml", std::process::id()));
    let swept = |text: &str, vary: fn(Sweep) -> Sweep| {
        std::fs::write(&path, text).expect("a file");
        let read = Sweep::read(&path).expect("TOML");
        std::fs::remove_file(&path).expect("the file");
        sweep(&pendulum(), &vary(read))
    };
    let masses = "[[vary]]\npath = 'body.bob.mass'\nvalues = [1, -2]\n";
    let error = swept(masses, |sweep| sweep).expect_err("a negative mass");
    let text = error.to_string();
    assert_eq!(error.place().map(|place| (place.line, place.column)), Some((3, 14)), "{text}");
    assert!(text.contains("mbs-studies-") && text.contains(":3:14: "), "{text}");
    let more = |sweep: Sweep| sweep.vary("scene.duration", [0.1, 0.2]);
    let runs = swept(&masses.replace("-2", "2"), more).expect("it runs");
    assert_eq!(runs.column("end_time"), Some(vec![0.1, 0.2, 0.1, 0.2]));
    assert_eq!(runs.column("body.bob.mass"), Some(vec![1.0, 1.0, 2.0, 2.0]));
}

#[test]
fn the_duration_of_a_run_outlives_its_method() {
    // the table has a row for each step of 1 ms
    let m = pendulum();
    let rows = |options: &Run| run(&m, options).expect("it runs").table().len();
    assert_eq!(rows(&Run::new().duration(0.1).method(Method::default())), 101);
    assert_eq!(rows(&Run::new().method(Method::default()).duration(0.1)), 101);
    let of_method = Method { duration: Some(0.05), ..Method::default() };
    assert_eq!(rows(&Run::new().duration(0.1).method(of_method)), 51);
    assert_eq!(rows(&Run::new()), 201);
}

#[test]
fn numbers_that_are_none_are_refused_by_their_path() {
    let mut m = pendulum();
    for bad in [f64::NAN, f64::INFINITY] {
        let error = m.set("body.bob.mass", bad).expect_err("no number");
        assert_eq!((error.code(), m.get("body.bob.mass")), ("not-finite", Ok(1.0)));
        let error = sweep(&m, &Sweep::grid().vary("body.bob.mass", [1.0, bad]));
        let error = error.expect_err("no number");
        assert_eq!((error.code(), error.place()), ("not-finite", None));
        assert!(error.to_string().contains("body.bob.mass"), "{error}");
    }
    // the message names the file only once
    let error =
        Mechanism::parse("[scene]\nname = \"p\"\ndimension = 2\ngravty = 1").expect_err("no key");
    let text = mbs::SimulationError::from(error).to_string();
    assert!(text.starts_with("scene:4:1: "), "{text}");
}

#[test]
fn a_comparison_in_code_ranks_the_methods_that_were_asked_for() {
    let options = Compare {
        formulations: vec![FormulationKind::Index3, FormulationKind::Recursive],
        precisions: vec![Precision::F64],
        steps: vec![1e-2, 5e-3],
        tolerances: vec![1e-4],
        repeats: 2,
        maps: false,
        ..Compare::default()
    };
    let found = compare(&pendulum(), &options).expect("a reference runs");
    assert!(found.methods.iter().any(|m| m.formulation == "index-3"), "{:?}", found.methods);
    assert!(found.methods.iter().any(|m| m.formulation == "recursive"));
    assert!(found.methods.iter().all(|m| !m.runs.is_empty()));
    let error =
        compare(&pendulum(), &Compare { steps: vec![1.0], ..options }).expect_err("too long");
    assert_eq!(error.code(), "settings-refused");
}
