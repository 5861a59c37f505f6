//! Speedup of a step by threads.

use super::super::measured::{Measured, Scene, efficiency, number, speed_up};
use super::numbers::{by_size, percent, ratio, time};
use crate::chart::{Axis, Chart, Kind, Look, Series};
use crate::lab::section::Section;

/// Least ratio of times that the report calls a speedup [-].
const SEEN: f64 = 1.05;
/// Scene of the complete vehicle, which has 168 coordinates in the report.
const VEHICLE: &str = "iltis-stairs";

/// Median time of a team [s], and its speedup against the best serial lane.
fn gain(scene: &Scene, formulation: &str, team: &str, threads: usize) -> Option<(f64, f64)> {
    let serial = scene.serial(formulation)?.seconds?;
    let seconds = scene.lane(formulation, team, threads)?.seconds?;
    Some((seconds, speed_up(serial, seconds)))
}

/// Section with seconds per step, speedup and efficiency of both teams.
pub(super) fn threads(measured: &Measured) -> Section {
    let mut section = Section::new("T", "What threads gain");
    let several: Vec<usize> = measured.threads.iter().copied().filter(|&n| n > 1).collect();
    if several.is_empty() {
        section.words("No teams were measured: ask for more threads, such as --threads 1-4.");
        return section;
    }
    let head = [
        "scene, threads",
        "best serial",
        "crew",
        "speed-up",
        "efficiency",
        "pool",
        "speed-up",
        "efficiency",
    ];
    for formulation in &measured.formulations {
        let mut rows = Vec::new();
        for scene in by_size(measured) {
            for &n in &several {
                let serial = scene.serial(formulation).and_then(|lane| lane.seconds);
                let teams = ["crew", "pool"].map(|team| gain(scene, formulation, team, n));
                if teams == [None; 2] {
                    continue;
                }
                let mut row = vec![format!("{}, {n}", scene.name)];
                row.push(serial.map(time).unwrap_or_default());
                for team in teams {
                    row.push(team.map(|(seconds, _)| time(seconds)).unwrap_or_default());
                    row.push(ratio(team.map(|(_, gain)| gain)));
                    row.push(
                        team.map(|(_, gain)| percent(efficiency(gain, n))).unwrap_or_default(),
                    );
                }
                rows.push(row);
            }
        }
        if !rows.is_empty() {
            section.heading(formulation);
            section.table(&head, rows);
            section.words(verdict(measured, formulation, &several));
        }
    }
    section.figure(
        &chart(measured, &several),
        "Speed-up of an index-3 step by a crew, over the unknowns of the scene; one: as fast as the best serial step.",
    );
    section
}

/// Sentence on the speedups of a table.
fn verdict(measured: &Measured, formulation: &str, several: &[usize]) -> String {
    let mut best: Option<(f64, String)> = None;
    let (mut n_scenes, mut n_without) = (0, 0);
    let mut of_vehicle = None;
    for scene in &measured.scenes {
        let mut most: f64 = 0.0;
        for (team, &n) in
            ["crew", "pool"].iter().flat_map(|team| several.iter().map(move |n| (team, n)))
        {
            let Some((_, gain)) = gain(scene, formulation, team, n) else { continue };
            most = most.max(gain);
            if best.as_ref().is_none_or(|(most, _)| gain > *most) {
                best = Some((gain, format!("{}, {team} of {n}", scene.name)));
            }
        }
        if most > 0.0 {
            n_scenes += 1;
            n_without += usize::from(most < SEEN);
            of_vehicle = if scene.name == VEHICLE { Some(most) } else { of_vehicle };
        }
    }
    let (most, what) = best.unwrap_or_default();
    let mut text = if most < SEEN {
        format!(
            "No scene gains from threads: {most:.2} times as fast as the best serial step at best ({what})."
        )
    } else {
        format!(
            "Most is gained in {what}: {most:.2} times as fast as the best serial step. Threads gain nothing in {n_without} of \
             {n_scenes} scenes."
        )
    };
    text.push_str(&match of_vehicle {
        Some(most) if most < SEEN => format!(
            " The whole vehicle gains nothing from threads ({most:.2} at best): nothing of its step is worth cutting."
        ),
        Some(most) => format!(" The whole vehicle is {most:.2} times as fast at best."),
        None => String::new(),
    });
    if measured.machine.is_busy() == Some(true) {
        text.push_str(" The machine was busy: others had the cores that a team asks for, so gains are not those of a free machine.");
    }
    text
}

fn chart(measured: &Measured, several: &[usize]) -> Chart {
    let series = several.iter().enumerate().map(|(style, &n)| {
        let point = |scene: &&Scene| {
            let (_, gain) = gain(scene, "index-3", "crew", n)?;
            Some([scene.size("unknowns")?, gain])
        };
        let points = by_size(measured).iter().filter_map(point).collect();
        Series::new(format!("{n} threads"), style, Look::Dots, points)
    });
    let x = Axis::new("unknowns", Kind::Log);
    Chart::new(x, Axis::new("speed-up", Kind::FromZero), series.collect())
}

/// Section on the time of empty forks.
pub(super) fn forks(measured: &Measured) -> Section {
    let mut section = Section::new("K", "Time of an empty fork");
    let rows = measured.forks.iter().map(|fork| {
        let team = fork["team"].as_str().unwrap_or_default();
        let threads = number(fork, "threads").unwrap_or(1.0);
        let quartile = |i: usize| fork["quartiles"][i].as_f64().map(time).unwrap_or_default();
        vec![
            format!("{team}, {threads:.0}"),
            number(fork, "seconds").map(time).unwrap_or_default(),
            format!("{} to {}", quartile(0), quartile(1)),
        ]
    });
    section.table(&["team, threads", "median", "quartiles"], rows.collect());
    section.words(
        "Two pieces of no work, joined: what a team asks for each cut where no thread takes the other piece. A task of a factorisation is \
         some hundred times as long at least; what handing a piece over costs shows in the steps above.",
    );
    section
}
