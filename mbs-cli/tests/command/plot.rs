//! Tests of `mbs plot`: pictures and tables of runs, and refusals.

use super::{plain, run, scene, status, text};
use std::path::Path;

/// Draws the slider-crank into a file with this name. Returns its text.
fn plotted(name: &str, arguments: &[&str]) -> String {
    String::from_utf8(drawn(name, arguments)).expect("text")
}

/// Draws the slider-crank into a file with this name. Returns its bytes.
fn drawn(name: &str, arguments: &[&str]) -> Vec<u8> {
    let out = plain(Path::new(env!("CARGO_TARGET_TMPDIR")).join(name));
    let scene = scene("slider-crank");
    let output = run("plot", &[&[scene.as_str(), "--out", &out], arguments].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    std::fs::read(out).expect("it was written")
}

#[test]
fn a_picture_has_a_panel_for_each_column_with_its_unit() {
    let svg = plotted("plot-all.svg", &[]);
    assert!(svg.starts_with("<svg") && svg.contains("t [s]"));
    let one = plotted("plot-one.svg", &["--channel", "crank-angle"]);
    assert_eq!(one.matches("t [s]").count(), 1);
    assert!(one.contains("crank-angle [rad]"));
}

#[test]
fn a_pdf_has_its_texts_as_text_and_a_table_of_its_objects() {
    let bytes = drawn("plot-one.pdf", &["--channel", "crank-angle"]);
    let pdf = String::from_utf8_lossy(&bytes);
    assert!(pdf.starts_with("%PDF-1.7") && pdf.ends_with("%%EOF"));
    for text in ["(t [s]) Tj", "(crank-angle [rad]) Tj", "/Helvetica"] {
        assert!(pdf.contains(text), "{text}");
    }
    // each object of the PDF is at the offset that its table contains
    let at = |from: usize| core::str::from_utf8(&bytes[from..]).unwrap_or_default();
    let line = |text: &str| text.lines().next().unwrap_or_default().to_owned();
    let start = pdf.rsplit("startxref\n").next().and_then(|x| line(x).parse::<usize>().ok());
    let table = at(start.expect("the place of the table"));
    assert!(table.starts_with("xref\n0 6\n"), "{table}");
    for (i, entry) in table.lines().skip(2).take(6).enumerate().skip(1) {
        let offset: usize = entry[..10].parse().expect("ten digits");
        assert!(at(offset).starts_with(&format!("{i} 0 obj")), "{entry}");
    }
}

#[test]
fn runs_over_each_other_are_named_and_a_table_has_the_rows_of_both() {
    let twice = scene("slider-crank");
    let svg = plotted("plot-two.svg", &[&twice, "--channel", "crank-angle"]);
    assert_eq!(svg.matches("slider-crank").count(), 2, "two runs in the legend");
    let one = plotted("plot-one.csv", &[]).lines().count();
    let two = plotted("plot-two.csv", &[&twice]);
    assert!(two.starts_with("run,t,"));
    assert_eq!(two.lines().count(), 2 * one - 1);
}

#[test]
fn one_column_is_drawn_over_another() {
    let csv = plotted("plot-names.csv", &[]);
    let names: Vec<&str> = csv.lines().next().expect("a header").split(',').skip(2).collect();
    let svg = plotted("plot-xy.svg", &["--xy", names[0], names[1], "--log"]);
    assert!(svg.contains(names[0]) && svg.contains(names[1]) && !svg.contains("t [s]"));
}

#[test]
fn a_page_has_a_panel_for_each_column_and_stands_alone() {
    let html = plotted("plot-page.html", &[]);
    let columns =
        plotted("plot-columns.csv", &[]).lines().next().expect("a header").split(',').count() - 2;
    assert_eq!(html.matches("data-panel=").count(), columns);
    for word in ["http:", "https:", "src=", "@import"] {
        assert!(!html.replace("http://www.w3.org/2000/svg", "").contains(word), "{word}");
    }
}

#[test]
fn a_vector_is_no_axis() {
    let scene = scene("double-pendulum");
    let arguments = [&scene, "--out", "none.html", "--xy", "tip.x", "tip"];
    let output = run("plot", &arguments);
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).contains("name one of"), "{}", text(&output.stderr));
}

#[test]
fn other_endings_and_unknown_channels_are_refused() {
    let scene = scene("slider-crank");
    for (arguments, why) in [
        (&["--out", "picture.bmp"][..], ".svg, .pdf or .csv"),
        (&["--out", "none.svg", "--channel", "crank-angel"], "name one of: crank-angle"),
    ] {
        let output = run("plot", &[&[scene.as_str()], arguments].concat());
        assert_eq!(status(&output), 1);
        assert!(text(&output.stderr).contains(why), "{}", text(&output.stderr));
    }
}
