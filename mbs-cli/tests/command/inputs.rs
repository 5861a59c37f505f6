//! `mbs run --inputs`: a table that inputs follow.

use crate::{run, status, text, written};

/// A wheel with a motor, whose torque is given by the text `course`.
fn wheel(course: &str) -> String {
    format!(
        "[scene]\nname = \"wheel\"\ndimension = 2\nduration = 0.3\n\
         [[body]]\nname = \"wheel\"\nmass = 1\ncenter = [0, 0]\ninertia = 2\n\
         [[joint]]\nname = \"axle\"\nkind = \"revolute\"\nbodies = [\"ground\", \"wheel\"]\nat = [0, 0]\n\
         [[effect]]\nname = \"motor\"\nkind = \"torque\"\njoint = \"axle\"\n{course}\n"
    )
}

#[test]
fn a_run_with_inputs_of_a_file_is_the_run_with_their_table() {
    let csv = written("motor.csv", "t,motor\n0.05,0\n0.1,3.5\n0.25,-1\n");
    let inline = written("inline.toml", &wheel("table = [[0.05, 0], [0.1, 3.5], [0.25, -1]]"));
    let driven = written("driven.toml", &wheel("value = 2\ninput = true"));
    let signal = "signal = \"motor\"\n[[signal]]\nname = \"motor\"\nkind = \"input\"";
    let by_signal = written("by-signal.toml", &wheel(signal));
    let rows = |name: &str, arguments: &[&str]| {
        let out = format!("{}/inputs-{name}", env!("CARGO_TARGET_TMPDIR"));
        let all = [arguments, &["--out", &out, "--no-estimate"]].concat();
        let output = run("run", &all);
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        std::fs::read_to_string(format!("{out}/run.csv")).expect("its rows")
    };
    let expected = rows("inline", &[&inline]);
    assert!(expected.lines().count() > 100);
    assert_eq!(rows("driven", &[&driven, "--inputs", &csv]), expected);
    assert_eq!(rows("by-signal", &[&by_signal, "--inputs", &csv]), expected);
    assert_ne!(rows("held", &[&driven]), expected);
}

#[test]
fn a_table_of_inputs_is_refused_at_its_place() {
    let driven = written("refused.toml", &wheel("value = 2\ninput = true"));
    let csv = written("refused.csv", "t,motor\n0.05,0\n0.1,fast\n");
    let output = run("run", &[&driven, "--inputs", &csv]);
    let said = text(&output.stderr);
    assert!(status(&output) == 1 && output.stdout.is_empty(), "{said}");
    assert!(said.contains("refused.csv:3:5: `fast` is not a finite number"), "{said}");
    assert!(said.contains("3 | 0.1,fast") && said.contains("hint: "), "{said}");
}
