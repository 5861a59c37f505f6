//! Members that fail for reasons outside the scene, and their rows. The rows are given here; nothing is run.

use mbs::Method;
use mbs::scene_file::{SceneFile, SceneSweep};
use mbs_study::inside::{Journal, MemberValues, whole_rows};
use mbs_study::sweep::{JournalError, PartsError, Row, Study, SweepError, SweepPart, SweepTask};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

const SCENE: &str = r#"
[scene]
dimension = 2
duration = 0.1
gravity = [0.0, -9.81]
[[body]]
name = "bob"
mass = 1.0
center = [1.0, 0.0]
inertia = 0.0
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "bob"]
at = [0.0, 0.0]
[solver]
step = 0.01
"#;
const SWEEP: &str = "[[vary]]\npath = 'body.bob.mass'\nfrom = 1\nto = 6\ncount = 6\n";

fn files() -> [SceneFile; 2] {
    let scene = SceneFile::parse(SCENE, "scene.toml").expect("TOML");
    [scene, SceneFile::parse(SWEEP, "sweep.toml").expect("TOML")]
}

fn study() -> Study {
    let [scene, sweep] = files();
    Study::new(scene, &sweep.into(), &Method::default()).expect("a good sweep")
}

/// Row of a member that completed.
fn completed(member: usize) -> Row {
    let [scene, sweep] = files();
    let sweep = SceneSweep::new(&sweep.into(), &scene, &[]).expect("a good sweep");
    let (end_time, steps, energy, violation) = (0.1, 10, 1e-9, [1e-12; 3]);
    let measured = MemberValues { end_time, steps, energy, violation, outputs: Vec::new() };
    let values = sweep.values(member).map(str::to_owned).collect();
    Row { member, values, failure: None, measured: Some(measured), cpu_seconds: 1e-4 }
}

/// Task of all members, in a directory.
fn all(out: &Path) -> SweepTask<'_> {
    SweepTask { out, threads: None, anew: false, part: None }
}

/// An empty directory for one test.
fn scratch(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("mbs-sweep-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    path
}

#[test]
fn a_panic_is_a_failed_member_and_leaves_the_others() {
    let study = study();
    let out = scratch("panic");
    for threads in [1, 2] {
        let job = |i| {
            assert!(i != 2, "member three, \"broken\",\nin two lines");
            completed(i)
        };
        let report = study.run_jobs(
            &SweepTask { threads: NonZeroUsize::new(threads), anew: true, ..all(&out) },
            &mut (),
            job,
        );
        let report = report.expect("the directory can be written");
        assert_eq!((report.completed, report.failures.len()), (5, 1));
        let (count, first, message) = &report.failures["panicked"];
        assert_eq!((*count, *first), (1, 3));
        assert_eq!(message, "panicked: member three, \"broken\", in two lines");
        let again = study.run_jobs(&all(&out), &mut (), |i| panic!("{i} runs again"));
        let again = again.expect("the journal is good");
        assert_eq!((again.resumed, again.completed), (6, 5), "the journal has it too");
    }
    let _ = std::fs::remove_dir_all(&out);
}

#[test]
fn rows_without_all_their_cells_are_left_out() {
    let lines = ["2,a,b", "1,x,z", "3,a", "9,a,b", "x,a,b", "\u{0}", "0,a,b"];
    let lines = lines.map(|line| line.split(',').map(str::to_owned).collect()).to_vec();
    let rows = whole_rows(lines, 3, 3);
    assert_eq!(rows.keys().copied().collect::<Vec<_>>(), [0, 1]);
    assert_eq!(rows[&0], ["1", "x", "z"]);
}

#[test]
fn two_processes_do_not_share_a_directory() {
    let study = study();
    let out = scratch("busy");
    std::fs::create_dir_all(&out).expect("a directory of our own");
    let held = Journal::open(&out, &study.head, false).expect("the first one");
    let second = study
        .run_jobs(&SweepTask { anew: true, ..all(&out) }, &mut (), |i| panic!("{i} runs beside"));
    assert!(matches!(second, Err(SweepError::Journal(JournalError::Busy(_)))), "{second:?}");
    drop(held);
    let third = study.run_jobs(&all(&out), &mut (), completed);
    assert_eq!(third.expect("free again").completed, 6);
    let _ = std::fs::remove_dir_all(&out);
}

#[test]
fn parts_are_joined_to_the_table_of_one_run_and_what_lacks_is_named() {
    let study = study();
    let whole = scratch("whole");
    let job = completed;
    let report = study.run_jobs(&all(&whole), &mut (), job).expect("the directory is ours");
    let table = |out: &Path| std::fs::read_to_string(out.join("table.csv")).expect("a table");
    // the last number of parts exceeds the number of members
    for of in [1, 2, 4, 7] {
        let out = scratch("parts");
        let run = |number: usize, job: &(dyn Fn(usize) -> Row + Sync)| {
            let part = Some(format!("{number}/{of}").parse().expect("a part"));
            study.run_jobs(&SweepTask { part, ..all(&out) }, &mut (), job)
        };
        for number in (1..=of).rev() {
            let part = run(number, &job).expect("the directory is ours");
            assert_eq!(part.members, (6 + of - number) / of, "{number} of {of}");
            assert!(part.tables.is_empty() && !out.join("table.csv").exists());
            let again = run(number, &|i| panic!("{i} runs again")).expect("the journal is good");
            assert_eq!(again.resumed, part.members);
        }
        let joined = study.join(&out).expect("all parts are there");
        assert_eq!((joined.rows, table(&out)), (report.rows.clone(), table(&whole)));
        // an incomplete line counts as a missing member
        let last = out.join(format!("part-1-of-{of}.journal"));
        let bytes = std::fs::read(&last).expect("a journal");
        std::fs::write(&last, &bytes[..bytes.len() - 3]).expect("the directory is ours");
        let lacks = study.join(&out).expect_err("a member lacks").to_string();
        assert!(lacks.starts_with(&format!("part 1/{of} lacks 1 of ")), "{lacks}");
        std::fs::remove_dir_all(&out).expect("it is there");
    }
    // parts without members need not have run
    let out = scratch("many");
    for number in 1..=6 {
        let part = Some(format!("{number}/1000000000000").parse().expect("a part"));
        study.run_jobs(&SweepTask { part, ..all(&out) }, &mut (), job).expect("it is ours");
    }
    assert_eq!(study.join(&out).expect("all members are there").rows, report.rows);
    std::fs::remove_dir_all(&out).expect("it is there");
    std::fs::remove_dir_all(&whole).expect("it is there");
}

#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let study = study();
    let out = scratch("foreign");
    std::fs::create_dir_all(&out).expect("a directory of our own");
    assert!(matches!(study.join(&out), Err(SweepError::Parts(PartsError::None))));
    let run = |part: &str| {
        let part = Some(part.parse().expect("a part"));
        study.run_jobs(&SweepTask { part, ..all(&out) }, &mut (), completed)
    };
    run("1/2").expect("the directory is ours");
    run("2/3").expect("the directory is ours");
    let counts = study.join(&out).expect_err("two counts").to_string();
    assert_eq!(counts, "part 1/2 is of 2 parts, and part 2/3 of 3");
    std::fs::remove_file(out.join("part-2-of-3.journal")).expect("it is there");
    // the journal of the first part gets the name of the journal of the second part
    std::fs::copy(out.join("part-1-of-2.journal"), out.join("part-2-of-2.journal")).expect("ours");
    for foreign in [study.join(&out).map(drop), run("2/2").map(drop)] {
        let why = foreign.expect_err("it is of another part").to_string();
        assert_eq!(why, "`part-2-of-2.journal` has member 1, which is of another part");
    }
    std::fs::write(out.join("part-2-of-2.journal"), "my diary\n").expect("ours");
    let why = study.join(&out).expect_err("no journal").to_string();
    assert_eq!(why, "`part-2-of-2.journal` in the directory is not the journal of a sweep");
    for text in ["0/2", "3/2", "1", "1/0", "a/b", "1/2/3"] {
        assert!(text.parse::<SweepPart>().is_err(), "{text}");
    }
    std::fs::remove_dir_all(&out).expect("it is there");
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_has_the_rows_of_the_table_with_their_types() {
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::Field;
    let study = study();
    let out = scratch("parquet");
    let job = |i| match i {
        2 => Row::failed(i, vec!["3".to_owned()], "bad", "x"),
        _ => completed(i),
    };
    let report = study.run_jobs(&all(&out), &mut (), job).expect("the directory is ours");
    let file = std::fs::File::open(&report.tables[1]).expect("the second table");
    let reader = SerializedFileReader::new(file).expect("a Parquet file");
    let rows: Vec<_> =
        reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), 6);
    let cells = |row: usize| -> Vec<(String, Field)> {
        rows[row].get_column_iter().map(|(name, field)| (name.clone(), field.clone())).collect()
    };
    let names: Vec<String> = cells(0).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, study.columns().header());
    assert_eq!(cells(1)[0].1, Field::Long(2));
    assert_eq!(cells(1)[1].1, Field::Double(2.0));
    assert_eq!(cells(1)[2].1, Field::Bool(true));
    assert_eq!(cells(2)[3].1, Field::Str("bad".to_owned()));
    assert_eq!(cells(2)[5].1, Field::Null, "what was not measured");
    let _ = std::fs::remove_dir_all(&out);
}
