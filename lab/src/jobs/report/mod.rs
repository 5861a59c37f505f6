//! The job `cargo xtask report`: makes every page of measurements in one folder, with an index of the commands that make each page.

mod compared;
mod drawing;
mod index;

use crate::chart::picture::picture;
use crate::mbs::{self, Mbs};
use crate::page::figure;
use crate::{bench, step_experiments, tables};
use index::{Entry, Index};
use std::path::Path;
use std::time::Instant;
use xtask::{pages, process};

/// Makes all pages under `target/report`, one after the other.
///
/// # Errors
///
/// The reason why something cannot be run, or outcomes that differ from the lists.
pub(crate) fn report(quick: bool) -> Result<(), String> {
    let folder = process::target_dir().join("report");
    let mut index = Index::new(quick);

    let clock = Instant::now();
    let made = tables::run(quick, &tables::own())?;
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
        compare(&mbs, page, (&folder, quick), &mut index)?;
    }

    let clock = Instant::now();
    let made = step_experiments::run(quick, &[])?;
    let [claims, hold] = made.claims;
    let remark = format!("{hold} of {claims} claims hold; the page says which do not.");
    index.add_page(&folder, &made.html, Entry::new(&index::STEPS, remark, clock, Vec::new()))?;

    let clock = Instant::now();
    let html = bench::run(&bench::Asked { threads: None, quick, scenes: Vec::new() })?;
    let remark = "Times of this machine, at the load that the page names.".to_owned();
    index.add_page(&folder, &html, Entry::new(&index::BENCH, remark, clock, Vec::new()))?;

    let mut surprises = index.surprises();
    if let Some(browser) = pages::browser() {
        let looked = index.files().map(|file| pages::look(browser, &folder.join(file)));
        surprises.extend(looked.filter_map(Result::err));
    }
    tables::listed(&surprises)
}

/// Compares all methods on a scene, and makes its page and its figure.
fn compare(
    mbs: &Mbs,
    page: &index::Page,
    (folder, quick): (&Path, bool),
    index: &mut Index,
) -> Result<(), String> {
    let clock = Instant::now();
    process::progress(page.command);
    let out = folder.join(page.file);
    let out = out.parent().unwrap_or(folder);
    mbs.compare(&mbs::scene(page.scene), out, quick.then_some("20"))?;
    let comparison = compared::read(out)?;
    let chart = drawing::chart(&comparison);
    let drawing = picture(&chart)?;
    process::write(&out.join("work-precision.svg"), drawing.as_bytes())?;
    let judged = compared::judge(page.scene, &comparison);
    let [completed, stopped] = judged.counts;
    let remark = format!("{completed} runs were completed, {stopped} stopped; the page says why.");
    // with less work the ranges of steps are shorter, so listed stops may not occur
    let surprises = if quick { Vec::new() } else { judged.surprises };
    let figure = figure(&chart, "CPU time over error.")?;
    index.add(folder, Entry::new(page, remark, clock, surprises).with_picture(figure))
}
