//! Costs of a step: its total time, its work, and the times of its phases.

use super::super::measured::{Lane, Measured, Scene, number};
use super::numbers::{average, by_size, count, percent, ratio, span, time};
use crate::chart::{Chart, Look, Series};
use crate::lab::section::Section;

/// Section with the seconds per step with one thread, in each formulation.
pub(super) fn steps(measured: &Measured) -> Section {
    let mut section = Section::new("S", "Time of a step, one thread");
    let mut head = vec!["scene"];
    head.extend(measured.formulations.iter().map(String::as_str));
    head.push("dt");
    let (mut rows, mut spread, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for scene in by_size(measured) {
        let mut row = vec![scene.name.clone()];
        for formulation in &measured.formulations {
            let lane = scene.serial(formulation);
            row.push(lane.and_then(|lane| lane.seconds).map_or("–".to_owned(), time));
            if let Some(lane) = lane {
                spread.push(details(scene, lane));
                let reason = lane.reason.as_ref();
                refused.extend(
                    reason.map(|why| vec![format!("{}, {formulation}", scene.name), why.clone()]),
                );
            }
        }
        row.push(scene.size("step").map(time).unwrap_or_default());
        rows.push(row);
    }
    section.table(&head, rows);
    section.words(fastest(measured));
    section.figure(
        &chart(measured),
        "Time of a step over the unknowns in natural coordinates; one thread.",
    );
    section.behind(
        "quartiles and work",
        &[
            "scene, formulation",
            "median",
            "quartiles",
            "iterations",
            "factorisations",
            "solves",
            "motion / time",
        ],
        spread,
    );
    if !refused.is_empty() {
        section.heading("What was not measured");
        section.table(&["scene, formulation", "why", ""], refused);
        section.words("A dash above has its reason here: the formulation refuses the scene, or takes too long for it.");
    }
    section
}

/// Median, quartiles and work of a lane, or the reason why there are none.
fn details(scene: &Scene, lane: &Lane) -> Vec<String> {
    let name = format!("{}, {}", scene.name, lane.formulation);
    let (Some(seconds), quartiles) = (lane.seconds, &lane.line["quartiles"]) else {
        return vec![name, lane.reason.clone().unwrap_or_default()];
    };
    let ends = [0, 1].map(|i| quartiles[i].as_f64().map(time).unwrap_or_default());
    let work = ["iterations", "factorizations", "solves"].map(|key| average(lane.work(key)));
    let [iterations, factorisations, solves] = work;
    let speed = scene.size("step").map(|dt| dt / seconds);
    let speed = speed.map(|x| if x < 10.0 { format!("{x:.2}") } else { count(Some(x)) });
    vec![
        name,
        time(seconds),
        ends.join(" to "),
        iterations,
        factorisations,
        solves,
        speed.unwrap_or_default(),
    ]
}

/// Sentence with the number of scenes in which each formulation is fastest.
fn fastest(measured: &Measured) -> String {
    let mut wins = vec![0; measured.formulations.len()];
    for scene in &measured.scenes {
        let time = |name: &str| scene.serial(name).and_then(|lane| lane.seconds);
        let time = |name: &String| time(name).unwrap_or(f64::INFINITY);
        let times: Vec<f64> = measured.formulations.iter().map(time).collect();
        let least = times.iter().copied().fold(f64::INFINITY, f64::min);
        if let Some(at) = times.iter().position(|&t| t <= least && t.is_finite()) {
            wins[at] += 1;
        }
    }
    let counts = measured.formulations.iter().zip(wins).filter(|(_, n)| *n > 0);
    let counts: Vec<_> = counts.map(|(name, n)| format!("{name} in {n}")).collect();
    format!(
        "The cheapest step, of those that could be measured: {} of {} scenes. How accurate a step is, is in the tables on accuracy.",
        counts.join(", "),
        measured.scenes.len()
    )
}

fn chart(measured: &Measured) -> Chart {
    let series = measured.formulations.iter().enumerate().map(|(style, name)| {
        let point = |scene: &&Scene| Some([scene.size("unknowns")?, scene.serial(name)?.seconds?]);
        let scenes = by_size(measured);
        let points = scenes.iter().filter_map(point).collect();
        Series::new(name, style, Look::Dots, points)
    });
    Chart::log_log("unknowns", "time of a step [s]", series.collect())
}

/// Section with the sizes of scenes, and exact counts of a factorisation.
pub(super) fn counts(measured: &Measured) -> Section {
    let mut section = Section::new("C", "Counts of a scene and of one factorisation, index-3");
    let head = [
        "scene",
        "bodies",
        "unknowns",
        "rows",
        "elements",
        "iterations",
        "factorisations",
        "solves",
    ];
    let rows = by_size(measured).into_iter().map(|scene| {
        let mut row = vec![scene.name.clone()];
        row.extend(["bodies", "unknowns", "rows", "elements"].map(|key| count(scene.size(key))));
        let work = |key: &str| average(scene.serial("index-3").and_then(|lane| lane.work(key)));
        row.extend(["iterations", "factorizations", "solves"].map(work));
        row
    });
    section.table(&head, rows.collect());
    section.words("Sizes in natural coordinates, and the work of one step on the mean over the steps that were measured.");
    let head = ["scene", "fronts", "largest front", "flops", "entries", "tasks", "parallelism"];
    let rows = by_size(measured).into_iter().map(|scene| {
        let of_order = |key: &str| scene.order("chosen").and_then(|order| number(order, key));
        let mut row = vec![scene.name.clone()];
        let keys = ["fronts", "largest_front", "flops", "entries", "tasks"];
        row.extend(keys.map(|key| count(of_order(key))));
        row.push(average(of_order("parallelism")));
        row
    });
    section.table(&head, rows.collect());
    let alone = measured.scenes.iter().filter(|scene| {
        let tasks = scene.order("chosen").and_then(|order| number(order, "tasks"));
        tasks.is_some_and(|n| n < 1.5)
    });
    section.words(format!(
        "Exact counts in the order that a run chooses. Parallelism is the time of all fronts over that of the longest way through them: \
         no team gains more from factorisations. In {} of {} scenes the fronts are one task, and a factorisation is not shared at all.",
        alone.count(),
        measured.scenes.len()
    ));
    section
}

/// Phases: keys in the lines, and headings in the table.
const PHASES: [(&str, &str); 8] = [
    ("evaluation", "evaluate"),
    ("forces", "forces"),
    ("bias", "bias"),
    ("residuals", "residuals"),
    ("factorisation", "assemble + factor"),
    ("solves", "solves"),
    ("products", "J x"),
    ("rest", "vectors, rest"),
];

/// Section with the fraction of each phase in an index-3 step, for each number of threads.
pub(super) fn phases(measured: &Measured) -> Section {
    let mut section = Section::new("P", "Phases of an index-3 step");
    let names = PHASES.map(|(_, name)| name);
    let head = [&["scene, threads"][..], &names, &["after last evaluation", "clock adds"]].concat();
    let (mut rows, mut added, mut after, mut largest) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let mut n_serial = 0;
    for scene in by_size(measured) {
        for &threads in &measured.threads {
            let Some(lane) = scene.clocked("index-3", threads) else { continue };
            let Some(step) = number(&lane.line, "step").filter(|x| *x > 0.0) else { continue };
            let share = |key: &str| lane.line["phases"][key].as_f64().unwrap_or(0.0) / step;
            // with a team, the time of the clock is smaller than the scatter of the measurements
            let overhead = overhead(scene, lane).filter(|_| threads == 1);
            let late = number(&lane.line, "after_evaluation").unwrap_or(0.0) / step;
            if threads == 1 {
                n_serial += 1;
                after.push(late);
                let factor = share("factorisation");
                largest += usize::from(PHASES.iter().all(|(key, _)| share(key) <= factor));
                added.extend(overhead);
            }
            let mut row = vec![format!("{}, {threads}", scene.name)];
            row.extend(PHASES.map(|(key, _)| percent(share(key))));
            row.extend([percent(late), overhead.map(percent).unwrap_or_default()]);
            rows.push(row);
        }
    }
    section.table(&head, rows);
    let between = |shares: &[f64]| {
        span(shares.iter().copied())
            .map_or("-".to_owned(), |[a, b]| format!("{} to {}", percent(a), percent(b)))
    };
    section.words(format!(
        "With one thread, assembling and factoring is the largest phase in {largest} of {n_serial} scenes. What comes after the last \
         evaluation of the iteration, the projections of velocities and accelerations above all, is {} of the step. Shares are of \
         the mean step with clocks; these add {} to the median step (negative: less than what the machine scatters by), most where \
         a step is but some microseconds long.",
        between(&after),
        between(&added)
    ));
    section
}

/// Time that the clock adds to a step, relative to the step.
fn overhead(scene: &Scene, lane: &Lane) -> Option<f64> {
    let plain = scene.lane(&lane.formulation, &lane.team, lane.threads)?.seconds?;
    Some(lane.seconds? / plain - 1.0)
}

/// A ratio of two times, for a row.
pub(super) fn over(a: Option<f64>, b: Option<f64>) -> String {
    ratio(a.zip(b).map(|(a, b)| a / b))
}
