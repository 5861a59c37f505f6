//! Tests of `mbs generate`.

use crate::{run, scene, status, text};
use mbs::scene_file::{Family, generate};

/// Runs `mbs generate` with arguments. Returns exit status, standard output, standard error.
fn command(arguments: &[&str]) -> (i32, String, String) {
    let output = run("generate", arguments);
    (status(&output), text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_command_writes_to_standard_output_or_to_a_file_and_names_itself() {
    let (status, text, _) = command(&["net", "--rows", "2", "--columns", "3"]);
    assert_eq!(status, 0);
    assert!(text.contains("# Made by `mbs generate net --rows 2 --columns 3`."), "{text}");
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("generated-chain.toml");
    let path = file.to_str().expect("a path of letters");
    let (status, text, _) = command(&["chain", "--count", "3", "-o", path]);
    assert_eq!((status, text.as_str()), (0, ""));
    let written = std::fs::read_to_string(&file).expect("it was written");
    let expected = generate(&Family::Chain { bodies: 3 }, "mbs generate chain --count 3");
    assert_eq!(Ok(written), expected);
}

#[test]
fn the_command_refuses_with_status_1_and_a_hint() {
    let pendulum = scene("double-pendulum");
    for (arguments, word) in [
        (&["chain"][..], "--count is missing"),
        (&["chain", "--count", "0"], "at least 1"),
        (&["net", "--count", "0"], "at least 2"),
        (&["convoy", "--count", "3"], "needs --of"),
        (&["convoy", "--count", "3", "--of", &pendulum], "no tire"),
        (&["convoy", "--count", "3", "--of", "nowhere.toml"], "cannot read"),
        (&["tree", "--count", "3", "--spacing", "8"], "--spacing says nothing of a tree"),
        (&["chain", "--count", "3", "-o", "/no/such/directory/x.toml"], "cannot write"),
    ] {
        let (status, text, error) = command(arguments);
        assert_eq!((status, text.as_str()), (1, ""), "{arguments:?}");
        assert!(error.contains(word) && error.contains("hint: "), "{arguments:?}: {error}");
    }
}
