//! Tests of `mbs diff`: folders and scenes, exit status, names of columns that only one run has.

use super::{done, json, plain, run, scene, status, text, written};
use std::path::Path;

/// Makes a folder of results of the slider-crank with this step.
fn folder(name: &str, step: &str) -> String {
    let out = plain(Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("diff-{name}")));
    let scene = scene("slider-crank");
    let arguments = [&scene, "--duration", "0.5", "--step", step, "--no-estimate", "--out", &out];
    assert_eq!(status(&run("run", &arguments)), 0);
    out
}

#[test]
fn a_run_is_within_nothing_of_itself_and_a_coarser_one_is_not() {
    let [fine, coarse] = [folder("fine", "1e-3"), folder("coarse", "2e-3")];
    let same = run("diff", &[&fine, &fine, "--within", "0"]);
    assert_eq!(status(&same), 0, "{}", text(&same.stderr));
    let other = run("diff", &[&fine, &coarse, "--within", "1e-9"]);
    assert_eq!(status(&other), 2);
    // without a limit the exit status is always 0
    assert_eq!(status(&run("diff", &[&fine, &coarse])), 0);
    let shown = text(&other.stdout);
    assert!(shown.lines().all(|line| line.chars().count() <= 100), "{shown}");
    let object = json(&run("diff", &[&fine, &coarse, "--within", "1e-9", "--json"]));
    assert_eq!(object["is_within"], false);
    let columns = object["columns"].as_array().expect("a list");
    let largest = columns.iter().filter_map(|x| x["relative"].as_f64()).fold(0.0, f64::max);
    // the step is 2 ms, and the crank rotates at 25 rad/s: the difference is a few per cent
    assert!(largest > 1e-9 && largest < 0.1, "{object}");
    let wide = (largest * 1.001).to_string();
    assert_eq!(status(&run("diff", &[&fine, &coarse, "--within", &wide])), 0);
}

#[test]
fn the_page_of_a_difference_has_both_lines_their_difference_and_the_peaks() {
    let [fine, coarse] = [folder("page-fine", "1e-3"), folder("page-coarse", "2e-3")];
    let page = plain(Path::new(env!("CARGO_TARGET_TMPDIR")).join("diff.html"));
    let output = run("diff", &[&fine, &coarse, "--within", "1e-9", "--out", &page]);
    assert_eq!(status(&output), 2, "{}", text(&output.stderr));
    let html = std::fs::read_to_string(page).expect("it was written");
    assert!(html.contains("crank-angle: difference") && html.contains("<h2>Peaks</h2>"));
    assert!(html.contains("differ by more than 1e-9"));
    let output = run("diff", &[&fine, &coarse, "--out", "difference.pdf"]);
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).contains(".html"), "{}", text(&output.stderr));
}

#[test]
fn a_folder_and_its_scene_have_the_same_numbers() {
    let text = std::fs::read_to_string(scene("slider-crank")).expect("a scene");
    let file = written("diff-own.toml", &text);
    let out = plain(Path::new(env!("CARGO_TARGET_TMPDIR")).join("diff-own"));
    assert_eq!(status(&run("run", &[&file, "--no-estimate", "--out", &out, "--units"])), 0);
    let object = done(&run("diff", &[&out, &file, "--within", "0", "--json"]));
    assert_eq!(object["is_within"], true);
    assert!(object["columns"].as_array().is_some_and(|list| !list.is_empty()));
    assert_eq!(object["only_a"].as_array().map(Vec::len), Some(0));
}

#[test]
fn channels_of_one_run_alone_are_named_and_unknown_ones_are_refused() {
    let scene = scene("slider-crank");
    let text_of = std::fs::read_to_string(&scene).expect("a scene");
    let more = "\n[[output]]\nname = \"kinetic\"\nquantity = \"kinetic-energy\"\n";
    let own = written("diff-more.toml", &(text_of + more));
    let shown = run("diff", &[&own, &scene]);
    assert!(text(&shown.stdout).contains("in the first run alone: kinetic"), "{shown:?}");
    let refused = run("diff", &[&own, &scene, "--channel", "nothing", "--json"]);
    assert_eq!(
        (status(&refused), &json(&refused)["error"]["code"]),
        (1, &"unknown-channel".into())
    );
    let empty = plain(Path::new(env!("CARGO_TARGET_TMPDIR")).join("diff-empty"));
    std::fs::create_dir_all(&empty).expect("the directory is ours");
    let refused = run("diff", &[&empty, &scene, "--json"]);
    assert_eq!(
        (status(&refused), &json(&refused)["error"]["code"]),
        (1, &"results-unreadable".into())
    );
}
