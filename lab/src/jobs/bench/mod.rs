//! The job `cargo xtask bench`: measures the cost of a step in each formulation and scene, and the speedup by threads.

mod machine;
mod measured;
mod papers;
mod program;
mod rows;
mod tables;
mod threads;

use crate::lab::section::{self, Section};
pub(crate) use machine::Machine;
pub(crate) use machine::{cores, processor};
use measured::{Measured, Scene};
use program::Program;
use serde_json::Value;
use std::time::Duration;
pub(crate) use threads::Threads;
use xtask::process;

/// The scenes that are measured by default: those of this repository, then generated ones of increasing size.
const SCENES: [&str; 14] = [
    "double-pendulum",
    "andrews",
    "spatial-chain-20",
    "tree-30",
    "iltis-stairs",
    "iltis-jump",
    "chain-100",
    "net-100",
    "chain-1000",
    "n-four-bar-1000",
    "net-1000",
    "convoy-100",
    "tree-4095",
    "chain-10000",
];
/// Arguments of cargo that build only the measuring program.
pub(crate) const RUNNER: [&str; 7] =
    ["--package", "lab", "--bin", "runner", "--no-default-features", "--features", "faer"];
/// The largest scenes, which `--quick` leaves out.
const LARGEST: [&str; 4] = ["net-1000", "convoy-100", "tree-4095", "chain-10000"];

/// Options of the job.
#[derive(Debug, Clone)]
pub(crate) struct Asked {
    /// Sizes of thread teams. Default: from one to the number of cores.
    pub(crate) threads: Option<Threads>,
    /// True if the largest scenes are left out and all others get less time.
    pub(crate) quick: bool,
    /// Names of the scenes to measure; if the list is empty, the default ones.
    pub(crate) scenes: Vec<String>,
}

/// Builds the program, measures the scenes one after the other, and writes text, JSON and HTML under `target/bench`.
///
/// # Errors
///
/// The reason why something cannot be run.
#[allow(clippy::print_stdout, reason = "the tables are what is asked for")]
pub(crate) fn run(asked: &Asked) -> Result<String, String> {
    let measured = measure(asked)?;
    let sections = tables::sections(&measured);
    let (remark, mut text) = (tables::remark(&measured), String::new());
    crate::format::paragraph(&mut text, 0, &remark);
    println!("{text}\n{}", section::text(&sections));
    let folder = process::target_dir().join("bench");
    let json = format!("{:#}\n", rows::json(&measured));
    process::write(&folder.join("bench.json"), json.as_bytes())?;
    let page = section::page("What a step costs, and what threads gain", &remark, &sections);
    process::write(&folder.join("bench.html"), page.as_bytes())?;
    Ok(page)
}

/// The report's tables on processors, T6 and T7, measured on the vehicle only.
///
/// # Errors
///
/// The reason why something cannot be run.
pub(crate) fn processors(quick: bool) -> Result<Section, String> {
    let scenes = papers::TIMES.iter().map(|(_, scene, _)| (*scene).to_owned()).collect();
    Ok(tables::processors(&measure(&Asked { threads: None, quick, scenes })?))
}

/// Builds the program and measures the scenes one after the other.
fn measure(asked: &Asked) -> Result<Measured, String> {
    // the load is read before this job loads the machine itself
    let machine = Machine::now();
    let threads = asked.threads.clone().unwrap_or_else(|| Threads::up_to(machine.cores));
    let program = built(&threads, asked.quick)?;

    let listed = program.run(&["formulations"], Duration::from_secs(60))?;
    let forks = program.run(&["forks"], Duration::from_secs(60))?;
    let name = |line: &Value| line["name"].as_str().unwrap_or_default().to_owned();
    let formulations = listed.iter().map(name).collect();
    // formulations whose solver and phases the bench measures, and those with the steps of `mbs run`
    let (own, others): (Vec<_>, Vec<_>) = listed.iter().partition(|line| line["own"] == true);
    let [own, others] = [own, others].map(|lines| lines.into_iter().map(name).collect::<Vec<_>>());
    let threads = threads.sizes().to_vec();
    let mut measured = Measured { machine, threads, formulations, forks, scenes: Vec::new() };
    for name in selected(asked) {
        measured.scenes.push(scene(&program, &name, (&own.join(","), &others))?);
    }
    measured.machine.end();
    process::progress("");
    Ok(measured)
}

/// Builds the measuring program.
///
/// # Errors
///
/// The message of cargo.
pub(crate) fn built(threads: &Threads, quick: bool) -> Result<Program, String> {
    let mut build = process::cargo();
    build.args(["build", "--quiet", "--profile", "dist"]).args(RUNNER);
    process::run(build.current_dir(process::root()))?;
    Ok(Program {
        path: process::target_dir().join("dist").join("runner"),
        threads: threads.listed(),
        seconds: if quick { "0.5" } else { "2" },
    })
}

/// The scenes that are requested. Unknown names are refused by the program later.
fn selected(asked: &Asked) -> Vec<String> {
    if !asked.scenes.is_empty() {
        return asked.scenes.clone();
    }
    let is_wanted = |name: &&str| !asked.quick || !LARGEST.contains(name);
    SCENES.into_iter().filter(is_wanted).map(str::to_owned).collect()
}

/// Measures one scene in all formulations. A formulation that may take too long has a process of its own.
fn scene(program: &Program, name: &str, (own, others): (&str, &[String])) -> Result<Scene, String> {
    process::progress(&format!("{name} {own}"));
    let mut scene = Scene::new(name);
    scene.read(&program.run(&[name, own], Duration::from_secs(300))?)?;
    for formulation in others {
        process::progress(&format!("{name} {formulation}"));
        match program.run(&[name, formulation], Duration::from_secs(30)) {
            Ok(lines) => scene.read(&lines)?,
            Err(why) => scene.refuse(formulation, &why),
        }
    }
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quick_leaves_out_the_largest_scenes() {
        let asked = |quick, scenes: &[&str]| {
            let scenes = scenes.iter().map(|&name| name.to_owned()).collect();
            selected(&Asked { threads: None, quick, scenes })
        };
        assert_eq!(asked(false, &[]).len(), SCENES.len());
        assert!(LARGEST.iter().all(|name| !asked(true, &[]).contains(&(*name).to_owned())));
        assert_eq!(asked(true, &["chain-300"]), ["chain-300"]);
    }
}
