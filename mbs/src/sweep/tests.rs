//! What becomes of members that fail in ways no scene can ask for.

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
    let scene = Document::parse(SCENE, "scene.toml").expect("TOML");
    let sweep = Document::parse(SWEEP, "sweep.toml").expect("TOML");
    Study::new(scene, &sweep, &Overrides::default()).expect("a good sweep")
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
            study.member(i)
        };
        let report = study.run_jobs(&out, NonZeroUsize::new(threads), true, &mut (), job);
        let report = report.expect("the directory can be written");
        assert_eq!((report.completed, report.failures.len()), (5, 1));
        let (count, first, message) = &report.failures["panicked"];
        assert_eq!((*count, *first), (1, 3));
        assert_eq!(message, "panicked: member three, \"broken\", in two lines");
        let again = study.run(&out, None, false, &mut ()).expect("the journal is good");
        assert_eq!((again.resumed, again.completed), (6, 5), "the journal has it too");
    }
    let _ = std::fs::remove_dir_all(&out);
}

#[test]
fn two_processes_do_not_share_a_directory() {
    let study = study();
    let out = scratch("busy");
    std::fs::create_dir_all(&out).expect("a directory of our own");
    let shape = (study.columns.len(), study.n_members());
    let held = Journal::open(&out, &study.head, shape, false).expect("the first one");
    let second = study.run(&out, None, true, &mut ());
    assert!(matches!(second, Err(SweepError::Journal(JournalError::Busy))), "{second:?}");
    drop(held);
    assert_eq!(study.run(&out, None, false, &mut ()).expect("free again").completed, 6);
    let _ = std::fs::remove_dir_all(&out);
}
