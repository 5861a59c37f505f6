//! What becomes of members that fail in ways no scene can ask for. Members are given here, and not run: mbs/tests/all/sweep.rs
//! runs them.

use super::member::MemberValues;
use super::*;

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

fn study() -> Study {
    let scene = SceneFile::parse(SCENE, "scene.toml").expect("TOML");
    let sweep = SceneFile::parse(SWEEP, "sweep.toml").expect("TOML");
    Study::new(scene, &sweep, &Method::default()).expect("a good sweep")
}

/// A member that was completed.
fn completed(study: &Study, member: usize) -> Row {
    let (end_time, steps, energy, violation) = (0.1, 10, 1e-9, [1e-12; 3]);
    let measured = MemberValues { end_time, steps, energy, violation, outputs: Vec::new() };
    let values = study.sweep.values(member).map(str::to_owned).collect();
    Row { member, values, failure: None, measured: Some(measured), cpu_seconds: 1e-4 }
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
            completed(&study, i)
        };
        let report = study.run_jobs(&out, NonZeroUsize::new(threads), true, &mut (), job);
        let report = report.expect("the directory can be written");
        assert_eq!((report.completed, report.failures.len()), (5, 1));
        let (count, first, message) = &report.failures["panicked"];
        assert_eq!((*count, *first), (1, 3));
        assert_eq!(message, "panicked: member three, \"broken\", in two lines");
        let again = study.run_jobs(&out, None, false, &mut (), |i| panic!("{i} runs again"));
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
    let second = study.run_jobs(&out, None, true, &mut (), |i| panic!("{i} runs beside"));
    assert!(matches!(second, Err(SweepError::Journal(JournalError::Busy(_)))), "{second:?}");
    drop(held);
    let third = study.run_jobs(&out, None, false, &mut (), |i| completed(&study, i));
    assert_eq!(third.expect("free again").completed, 6);
    let _ = std::fs::remove_dir_all(&out);
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
        _ => completed(&study, i),
    };
    let report = study.run_jobs(&out, None, false, &mut (), job).expect("the directory is ours");
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
