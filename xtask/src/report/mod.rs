//! `cargo xtask report`: every page of measurements in one folder, with an index that says how each is made.

mod index;

use crate::mbs::{self, Mbs};
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

    let clock = Instant::now();
    let made = tables::run(quick, &[])?;
    let remark = match made.surprises.len() {
        0 => format!("{} entries; all that stop are known to.", made.entries),
        n => format!("{} entries; {n} did not come to what is listed.", made.entries),
    };
    index.add_page(
        &folder,
        &made.html,
        Entry::new(&index::TABLES, remark, clock, made.surprises),
    )?;

    let mbs = Mbs::build()?;
    for page in &index::COMPARED {
        let clock = Instant::now();
        process::progress(page.command);
        let out = folder.join(page.file);
        let out = out.parent().unwrap_or(&folder);
        mbs.compare(&mbs::scene(page.scene), out, if quick { "10" } else { "60" })?;
        let remark = "Time against true error, the ranking, and what failed, with its reason.";
        index.add(&folder, Entry::new(page, remark.to_owned(), clock, Vec::new()))?;
    }

    let clock = Instant::now();
    let made = steps::run(quick, &[])?;
    let [claims, hold] = made.claims;
    let remark = format!("{hold} of {claims} claims hold; the page says which do not.");
    index.add_page(&folder, &made.html, Entry::new(&index::STEPS, remark, clock, Vec::new()))?;

    let clock = Instant::now();
    let html = bench::run(&bench::Asked { threads: None, quick, scenes: Vec::new() })?;
    let remark = "Times of this machine, at the load that the page names.".to_owned();
    index.add_page(&folder, &html, Entry::new(&index::BENCH, remark, clock, Vec::new()))?;

    Ok(index.surprises())
}
