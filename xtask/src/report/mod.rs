//! `cargo xtask report`: every page of measurements in one folder, with an index that says how each is made.

mod index;

use crate::{bench, process, steps, tables};
use index::{Entry, Index};
use std::process::ExitCode;
use std::time::Instant;

/// Makes all pages under `target/report`; exit status 1 where something cannot be run, or does not come to what is listed.
pub(crate) fn report(quick: bool) -> ExitCode {
    match run(quick) {
        Ok(surprises) if surprises.is_empty() => ExitCode::SUCCESS,
        Ok(surprises) => {
            eprintln!("cargo xtask report: not what is listed:\n{}", surprises.join("\n"));
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("cargo xtask report: {why}");
            ExitCode::FAILURE
        }
    }
}

/// Makes the pages one after the other, and the index last.
fn run(quick: bool) -> Result<Vec<String>, String> {
    let folder = process::target_dir().join("report");
    let mut index = Index::new(quick);
    let mut add = |file: &str, html: &str, entry: Entry| {
        process::write(&folder.join(file), html.as_bytes())?;
        index.entries.push(entry);
        process::write(&folder.join("index.html"), index.html().as_bytes())
    };

    let clock = Instant::now();
    let made = tables::run(quick, &[])?;
    let remark = match made.surprises.len() {
        0 => format!("{} entries; all that stop are known to.", made.entries),
        n => format!("{} entries; {n} did not come to what is listed.", made.entries),
    };
    add("tables.html", &made.html, Entry::new(&index::TABLES, remark, clock, made.surprises))?;

    let clock = Instant::now();
    let made = steps::run(quick, &[])?;
    let [claims, hold] = made.claims;
    let remark = format!("{hold} of {claims} claims hold; the page says which do not.");
    add("steps.html", &made.html, Entry::new(&index::STEPS, remark, clock, Vec::new()))?;

    let clock = Instant::now();
    let html = bench::run(&bench::Asked { threads: None, quick, scenes: Vec::new() })?;
    let remark = "Times of this machine, at the load that the page names.".to_owned();
    add("bench.html", &html, Entry::new(&index::BENCH, remark, clock, Vec::new()))?;

    Ok(index.surprises())
}
