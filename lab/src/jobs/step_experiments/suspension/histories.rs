//! Steps, energy errors and the height of the wheel over time: Figures 6 and 7 of the report.

use super::super::draw::{INDEX_1, INDEX_3, MULTI, line, over_time, steps};
use super::super::fit::span;
use crate::chart::{Chart, Kind};
use crate::format::error;
use crate::lab::case::size;
use crate::lab::record::Record;
use crate::lab::section::Section;

/// Step of the report's run in index 1 [s].
pub(super) const FINE: f64 = 5e-4;

/// Step of the report's run in index 3, and the largest one of the variable run [s].
pub(super) const COARSE: f64 = 1e-2;

/// Time interval in which the wheel is on the bump [s].
const BUMP: [f64; 2] = [3.0, 3.2];

/// Draws steps, energy errors and the height of the wheel over time.
pub(super) fn draw(records: [Option<Record>; 3], section: &mut Section) {
    let [coarse, variable, fine] = records.map(Option::unwrap_or_default);
    let end = [&coarse, &variable, &fine]
        .iter()
        .flat_map(|r| r.steps.last())
        .map(|s| s.t)
        .fold(0.0, f64::max);
    let level = |name: &str, style, step| line(name, style, vec![[0.0, step], [end, step]]);
    let mut series =
        vec![level("index-3, fixed", INDEX_3, COARSE), level("index-1, fixed", INDEX_1, FINE)];
    series.extend(steps(&variable, "multi-index", MULTI));
    shaded(over_time("step [s]", Kind::Log, series), &shortest(&variable), section);

    let named = [
        (&coarse, "index-3, fixed", INDEX_3),
        (&fine, "index-1, fixed", INDEX_1),
        (&variable, "multi-index", MULTI),
    ];
    let of_energy = named.map(|(record, name, style)| {
        line(name, style, record.points(|step| step.energy_error.abs()))
    });
    let chart = over_time("energy error, absolute [J]", Kind::Log, of_energy.to_vec());
    shaded(chart, &largest_change(&variable), section);

    let heights = named.map(|(record, name, style)| {
        line(name, style, record.channels.first().cloned().unwrap_or_default())
    });
    let chart = over_time("height of the wheel's centre [m]", Kind::Linear, heights.to_vec());
    shaded(chart, &apart(&coarse, &fine), section);
}

fn shaded(mut chart: Chart, caption: &str, section: &mut Section) {
    chart.shade = Some(BUMP);
    section.figure(&chart, &format!("{caption} The bump is shaded."));
}

/// True if the time is within the interval on the bump.
fn is_on_bump(t: f64) -> bool {
    BUMP[0] < t && t <= BUMP[1]
}

/// Sentence on the times at which the steps of the controlled run are short.
fn shortest(record: &Record) -> String {
    let steps = |on: bool| record.steps.iter().filter(move |s| is_on_bump(s.t) == on);
    let spans = [true, false].map(|on| span(steps(on).map(|s| s.step)));
    let [Some([on_least, on_most]), Some([off_least, off_most])] = spans else {
        return "The variable run left no steps.".into();
    };
    let (n, n_1) = (record.steps.len(), record.steps.iter().filter(|s| s.is_index_1).count());
    let on_1 = steps(true).filter(|s| s.is_index_1).count();
    format!(
        "Steps over time. On the bump the variable run takes steps of {} to {} s, elsewhere of {} to {} s; {n_1} of its {n} recorded \
        steps are in index 1, {on_1} of them on the bump.",
        size(on_least),
        size(on_most),
        size(off_least),
        size(off_most)
    )
}

/// Caption with the fraction of the controlled run's energy changes that occur on the bump.
fn largest_change(record: &Record) -> String {
    let sum = |steps: &mut dyn Iterator<Item = f64>| steps.sum::<f64>();
    let all = sum(&mut record.steps.iter().map(|s| s.energy_change.abs()));
    let on =
        sum(&mut record.steps.iter().filter(|s| is_on_bump(s.t)).map(|s| s.energy_change.abs()));
    let caption = "Energy error over time.".to_owned();
    if all > 0.0 {
        format!(
            "{caption} Of all changes of the energy in the variable run, {} are made on the bump.",
            percent(on / all)
        )
    } else {
        caption
    }
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// Caption with the largest difference of the heights of two runs [m].
fn apart(a: &Record, b: &Record) -> String {
    let (Some(a), Some(b)) = (a.channels.first(), b.channels.first()) else {
        return "Height of the wheel.".into();
    };
    let distance = a.iter().filter_map(|[t, z]| {
        let i = b.partition_point(|p| p[0] < t - 1e-9);
        b.get(i).filter(|p| (p[0] - t).abs() < 1e-6).map(|p| (p[1] - z).abs())
    });
    let most = span(distance).map_or(String::new(), |[_, most]| {
        format!(" The coarse fixed step is off the fine one by up to {} m.", error(most))
    });
    format!("Height of the wheel over time.{most}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::record::Step;

    /// A record whose steps are short, and in index 1, only at 3.1 s.
    fn record() -> Record {
        let step = |t: f64| {
            let is_index_1 = (t - 3.1).abs() < 1e-9;
            let (step, energy_change) = if is_index_1 { (1e-5, 3e-6) } else { (1e-2, 1e-6) };
            Step { t, step, is_index_1, energy_error: 0.0, energy_change, penalty_energy: 0.0 }
        };
        let channels = vec![vec![[1.0, 0.3], [3.1, 0.4]]];
        Record { steps: [1.0, 3.1].map(step).to_vec(), channels }
    }

    #[test]
    fn captions_say_where_steps_are_short_and_where_energy_changes() {
        let caption = shortest(&record());
        assert!(
            caption.contains("steps of 1e-5 to 1e-5 s, elsewhere of 1e-2 to 1e-2 s"),
            "{caption}"
        );
        assert!(
            caption.contains("1 of its 2 recorded steps are in index 1, 1 of them on the bump")
        );
        assert!(largest_change(&record()).contains("75 %"));
    }

    #[test]
    fn heights_are_compared_where_both_runs_have_them() {
        let mut other = record();
        other.channels = vec![vec![[1.0, 0.3], [2.0, 9.0], [3.1, 0.41]]];
        assert!(apart(&record(), &other).contains("up to 1.0e-2 m"));
    }
}
