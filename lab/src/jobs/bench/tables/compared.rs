//! Comparison with faer's sparse Cholesky, other orders of elimination, and the report's processors.

use super::super::measured::{Measured, number, ratio, speed_up, times};
use super::super::papers;
use super::costs::over;
use super::numbers::{average, by_size, count, span, time};
use crate::lab::section::Section;
use serde_json::Value;

/// Section on assembly, factorisation and solution by our solver and by faer.
pub(super) fn faer(measured: &Measured) -> Section {
    let mut section = Section::new("F", "Assemble, factor and solve once: ours and faer's");
    let head = [
        "scene, after steps",
        "ours",
        "faer, simplicial",
        "faer, supernodal",
        "ours / faer",
        "with blocks",
        "difference",
    ];
    let (mut rows, mut ratios, mut whole) = (Vec::new(), Vec::new(), Vec::new());
    for scene in by_size(measured) {
        for line in &scene.faer {
            let name = format!("{}, {:.0}", scene.name, number(line, "after").unwrap_or(0.0));
            let given = &line["given"];
            let (Some(times), Some(ratio), Some(with_blocks)) =
                (times(given), ratio(given), ratio(line))
            else {
                rows.push(vec![name, line["reason"].as_str().unwrap_or("not measured").to_owned()]);
                continue;
            };
            ratios.push(ratio);
            whole.push(with_blocks);
            let difference = number(line, "difference").map(crate::format::error);
            let mut row = vec![name];
            row.extend(times.map(time));
            row.extend([format!("{ratio:.2}"), format!("{with_blocks:.2}")]);
            row.extend(difference);
            rows.push(row);
        }
    }
    section.table(&head, rows);
    let faster = ratios.iter().filter(|ratio| **ratio < 1.0).count();
    let range = |ratios: &[f64]| span(ratios.iter().copied()).unwrap_or([f64::NAN; 2]);
    let ([low, high], [least, most]) = (range(&ratios), range(&whole));
    section.words(if ratios.is_empty() {
        "No system was measured.".to_owned()
    } else {
        format!(
            "The matrix of an index-3 step, summed from the same blocks of its elements, factored and solved once, interleaved in one run; \
             the ratio is to the faster of faer's two ways. Ours takes {low:.2} to {high:.2} times as long, and is the faster one in \
             {faster} of {} systems. With blocks: both write the blocks of their elements as well, each time, as a step does; then it \
             is {least:.2} to {most:.2} times. The solutions differ by their share of the largest number.",
            ratios.len()
        )
    });
    section
}

/// Section on the cost of orders of elimination with one thread.
pub(super) fn orders(measured: &Measured) -> Section {
    let mut section = Section::new("O", "Price of an order of elimination, one thread, index-3");
    let head = ["scene, order", "flops", "tasks", "parallelism", "step", "over the best serial"];
    let (mut rows, mut dearest) = (Vec::new(), None::<(f64, String)>);
    for scene in by_size(measured) {
        let best = scene.serial("index-3").and_then(|lane| lane.seconds);
        let least = scene.order("minimum-degree").and_then(|order| order["flops"].as_u64());
        let is_other = |order: &Value| order["flops"].as_u64() != least;
        if !scene.orders.iter().any(is_other) {
            continue;
        }
        for order in &scene.orders {
            let name = order["order"].as_str().unwrap_or_default();
            let mut lanes = scene.lanes.iter().filter(|lane| !lane.clocked && lane.threads == 1);
            let lane = lanes.find(|lane| lane.formulation == "index-3" && lane.order == name);
            let seconds = lane.and_then(|lane| lane.seconds);
            if name != "minimum-degree"
                && let Some(price) = seconds.zip(best).map(|(seconds, best)| seconds / best)
                && dearest.as_ref().is_none_or(|(most, _)| price > *most)
            {
                dearest = Some((price, format!("{} by {name}", scene.name)));
            }
            rows.push(vec![
                format!("{}, {name}", scene.name),
                count(number(order, "flops")),
                count(number(order, "tasks")),
                average(number(order, "parallelism")),
                seconds.map(time).unwrap_or_default(),
                over(seconds, best),
            ]);
        }
    }
    section.table(&head, rows);
    section.words(match dearest {
        None => "No other order was measured.".to_owned(),
        Some((price, what)) => format!(
            "Orders that leave work for many cost more with one thread: {price:.2} times the best serial step at most ({what}). A run \
             chooses one that costs at most a tenth more than minimum degree; scenes where both are the same are left out."
        ),
    });
    section
}

/// Section with the report's tables on processors.
pub(super) fn report(measured: &Measured) -> Section {
    let mut section = Section::new("R", "The report's processors, and ours");
    section.heading("T6: reduction of CPU time, vehicle over ramp and stairs [%] (report, Table IV; publication 3, Table II)");
    let stairs = measured.scenes.iter().find(|scene| scene.name == "iltis-stairs");
    let gain = |formulation: &str, threads: usize| {
        let scene = stairs?;
        let serial = scene.serial(formulation)?.seconds?;
        match threads {
            1 => Some(0.0),
            // the recursive formulation has no thread teams
            _ if formulation == "recursive" => Some(0.0),
            n => Some(
                100.0
                    * (1.0 - 1.0 / speed_up(serial, scene.lane(formulation, "crew", n)?.seconds?)),
            ),
        }
    };
    let head = [
        "processors",
        "augm. Lagr., report",
        "index-3",
        "classical, report",
        "classical",
        "recursive, report",
        "recursive",
    ];
    let most = measured.threads.iter().copied().max().unwrap_or(1).max(4);
    let rows = (1..=most).filter(|n| *n <= 4 || measured.threads.contains(n)).map(|n| {
        let mut row = vec![n.to_string()];
        for method in &papers::REDUCTIONS {
            let printed = method.reductions.get(n - 1);
            row.push(printed.map(|x| format!("{x:.1}")).unwrap_or_default());
            row.push(gain(method.ours, n).map(|x| format!("{x:.1}")).unwrap_or_default());
        }
        row
    });
    section.table(&head, rows.collect());
    section.words(
        "The report's are of a SUN SPARCstation 20 with four HyperSPARC of 100 MHz, ours of index-3 and classical of a crew against the \
         best serial step (negative: slower). Our recursive formulation has no teams: more processors gain it nothing. An empty \
         cell was not measured.",
    );
    section.heading("T7: CPU time of 10 s of motion [s], augmented Lagrangian, two processors (report, Table V)");
    let rows = papers::TIMES.iter().map(|(name, scene, printed)| {
        let ours = |team: &str, threads: usize| {
            let scene = measured.scenes.iter().find(|s| s.name == *scene)?;
            let seconds = scene.lane("index-3", team, threads)?.seconds?;
            Some(time(10.0 / scene.size("step")? * seconds))
        };
        let ours = [("crew", 2), ("alone", 1)].map(|(team, n)| ours(team, n).unwrap_or_default());
        let [two, one] = ours;
        vec![format!("{name}: {scene}"), format!("{printed:.0} s"), two, one]
    });
    section.table(&["simulation", "report, two", "ours, two", "ours, one"], rows.collect());
    section.words(
        "The report's machine is an ALPHA AXP 4000 with two processors of 466 MHz. The dimensions of its roads are lost: ours are \
         chosen anew, the step is the largest that it found workable. Ours are the median step times the number of steps.",
    );
    section
}
