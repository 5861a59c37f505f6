//! One column of the grades. Each method has a letter, the number on which it is based, and the runs of that number.

use super::ladder::{self, Ladder};
use super::letter::{Letter, mean, over_best, worst};
use super::printed::{METHODS, Method};
use crate::lab::{Lab, Run};

/// A letter with its basis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cell {
    pub(crate) letter: Letter,
    /// Ratio to the number of the best method, or the number on which the letter is based; `None` if the method fails.
    pub(crate) ratio: Option<f64>,
    /// Words on the count, for columns without runs.
    pub(crate) counted: String,
    /// Runs on which the letter is based.
    pub(crate) runs: Vec<Run>,
}

/// A column: its name, the rule in words, and a cell for each of [`METHODS`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) rule: String,
    pub(crate) cells: Vec<Cell>,
}

/// Rule that combines the ratios of several scenes into one.
pub(crate) type Joined = fn(&[Option<f64>]) -> Option<f64>;

/// Numbers of each method in each scene, and the runs; smaller numbers are better.
type Given = Vec<(Vec<Option<f64>>, Vec<Run>)>;

/// Cells from the numbers of the methods. Each number is divided by the best one in its scene, then the ratios of all scenes are combined.
fn graded(given: Given, floor: f64, joined: Joined, limits: [f64; 3]) -> Vec<Cell> {
    let scenes = given.first().map_or(0, |(numbers, _)| numbers.len());
    let beside: Vec<Vec<Option<f64>>> = (0..scenes)
        .map(|s| over_best(&given.iter().map(|(numbers, _)| numbers[s]).collect::<Vec<_>>(), floor))
        .collect();
    let cell = |(m, (_, runs)): (usize, (Vec<Option<f64>>, Vec<Run>))| {
        let ratio = joined(&beside.iter().map(|scene| scene[m]).collect::<Vec<_>>());
        Cell { letter: Letter::of_ratio(ratio, limits), ratio, counted: String::new(), runs }
    };
    given.into_iter().enumerate().map(cell).collect()
}

/// Collects for each method a number from each ladder, and all runs.
fn over_ladders(
    ladders: &[Ladder],
    number: impl Fn(&Ladder, &Method) -> Result<(Option<f64>, Vec<Run>), String>,
) -> Result<Given, String> {
    let of = |method: &Method| {
        let mut given = (Vec::new(), Vec::new());
        for ladder in ladders {
            let (number, runs) = number(ladder, method)?;
            given.0.push(number);
            given.1.extend(runs);
        }
        Ok(given)
    };
    METHODS.iter().map(of).collect()
}

/// Limits of the letters A, B and C for times and lines [-]: each is twice the one before.
const TIMES: [f64; 3] = [2.0, 4.0, 8.0];
/// Limits of the letters for errors at one step [-]: each is ten times the one before.
const ERRORS: [f64; 3] = [10.0, 100.0, 1000.0];
/// Limits of the letters for numbers of runs that are useless while those of another method are useful.
const FEWER: [f64; 3] = [1.0, 2.0, 3.0];
/// Energy error at which times are compared, relative to the exchanged energy [-].
const LEVEL: f64 = 1e-4;
/// Largest energy error of a useful run, relative to the exchanged energy [-].
const USEFUL: f64 = 1e-2;
/// Relative energy errors below this count as equal, since they are rounding errors [-].
const ROUNDING: f64 = 1e-10;

/// Column of the CPU time at a required accuracy, over scenes.
pub(crate) fn speed(
    lab: &Lab<'_>,
    name: &'static str,
    ladders: &[Ladder],
) -> Result<Column, String> {
    let given = over_ladders(ladders, |ladder, method| {
        let runs = ladder::descend(lab, ladder, method, LEVEL, true)?;
        Ok((ladder::price(&runs, LEVEL), runs))
    })?;
    Ok(Column {
        name,
        rule: format!(
            "CPU time at which the energy error is {LEVEL:e} of the energy turned over, between the steps of a ladder; over that \
             of the fastest method, geometric mean over {}. A up to 2, B up to 4, C up to 8 times; F where a scene is not run so \
             accurately.",
            scenes(ladders)
        ),
        cells: graded(given, 0.0, mean, TIMES),
    })
}

/// Column of the energy error at given steps.
pub(crate) fn accuracy(
    lab: &Lab<'_>,
    name: &'static str,
    ladders: &[Ladder],
) -> Result<Column, String> {
    let given = over_ladders(ladders, |ladder, method| {
        let Some(&step) = ladder.steps.first() else { return Err("a ladder has no step".into()) };
        let run = ladder::run(lab, &ladder.case(method, step), false)?;
        Ok((ladder::share(&run).filter(|share| *share <= 0.1), vec![run]))
    })?;
    let steps: Vec<_> = ladders
        .iter()
        .filter_map(|l| Some(format!("{} at {:e} s", l.scene, l.steps.first()?)))
        .collect();
    Ok(Column {
        name,
        rule: format!(
            "Energy error over that of the most accurate method, the worst of {}; below {ROUNDING:e} of the energy turned over all \
             are equal. A up to 10, B up to 100, C up to 1000 times; F where a run stops, or is wrong by more than a tenth of \
             the energy.",
            steps.join(", ")
        ),
        cells: graded(given, ROUNDING, worst, ERRORS),
    })
}

/// Column of the number of steps of a ladder at which a run is useful.
pub(crate) fn condition(
    lab: &Lab<'_>,
    name: &'static str,
    ladders: &[Ladder],
) -> Result<Column, String> {
    let given = over_ladders(ladders, |ladder, method| {
        let runs =
            ladder.steps.iter().map(|&step| ladder::run(lab, &ladder.case(method, step), false));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let useful = runs.iter().filter(|run| is_useful(run)).count();
        #[allow(clippy::cast_precision_loss, reason = "some steps")]
        Ok(((useful > 0).then_some(useful as f64), runs))
    })?;
    Ok(Column {
        name,
        rule: format!(
            "At how many steps of a ladder of half decades the run ends with an energy error of at most {USEFUL:e} of the energy \
             turned over, beside the method with the most of them, the worst of {}. A at most one less, B two, C three, D more; F \
             at none.",
            scenes(ladders)
        ),
        cells: missing(given),
    })
}

/// Cells from numbers of useful runs: the best number of a scene less the method's own.
fn missing(given: Given) -> Vec<Cell> {
    let scenes = given.first().map_or(0, |(useful, _)| useful.len());
    let best: Vec<f64> = (0..scenes)
        .map(|s| given.iter().filter_map(|(useful, _)| useful[s]).fold(0.0, f64::max))
        .collect();
    let cell = |(useful, runs): (Vec<Option<f64>>, Vec<Run>)| {
        let less: Vec<_> =
            useful.iter().zip(&best).map(|(useful, best)| useful.map(|n| best - n)).collect();
        let ratio = worst(&less);
        let n = runs.iter().filter(|run| is_useful(run)).count();
        let counted = format!("{n} of {}", runs.len());
        Cell { letter: Letter::of_ratio(ratio, FEWER), ratio, counted, runs }
    };
    given.into_iter().map(cell).collect()
}

/// True if a run is useful: it was completed, with a small energy error.
fn is_useful(run: &Run) -> bool {
    ladder::share(run).is_some_and(|share| share <= USEFUL)
}

/// Column of counted numbers: `(number, text)` for each method.
pub(crate) fn easiness(counts: &[(usize, String)]) -> Column {
    #[allow(clippy::cast_precision_loss, reason = "some thousand lines")]
    let numbers: Vec<_> = counts.iter().map(|(n, _)| Some(*n as f64)).collect();
    let cells = over_best(&numbers, 0.0).into_iter().zip(counts).map(|(ratio, (_, text))| Cell {
        letter: Letter::of_ratio(ratio, TIMES),
        ratio,
        counted: text.clone(),
        runs: Vec::new(),
    });
    Column {
        name: "easiness of implementation",
        rule: "Lines of code of the crate, without tests and comments, over the fewest. A up to 2, B up to 4, C up to 8 times."
            .to_owned(),
        cells: cells.collect(),
    }
}

/// Column on searches of a graph, from the file of each method that has one.
pub(crate) fn graphs(files: &[Option<String>]) -> Column {
    let cell = |file: &Option<String>| Cell {
        letter: if file.is_some() { Letter::D } else { Letter::A },
        ratio: None,
        counted: file.clone().unwrap_or_else(|| "none".to_owned()),
        runs: Vec::new(),
    };
    Column {
        name: "free from graph methods",
        rule: "A where no file of the crate searches a graph, D where one does.".to_owned(),
        cells: files.iter().map(cell).collect(),
    }
}

fn scenes(ladders: &[Ladder]) -> String {
    let name = |l: &Ladder| {
        format!("{}{}", l.scene, if l.appended.is_empty() { "" } else { " with a joint twice" })
    };
    ladders.iter().map(name).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_method_with_fewer_useful_runs_is_graded_by_how_many() {
        let some = |n: &[f64]| n.iter().map(|&n| Some(n)).collect::<Vec<_>>();
        let given: Given = vec![
            (some(&[6.0, 4.0]), vec![]),
            (some(&[5.0, 4.0]), vec![]),
            (some(&[6.0, 2.0]), vec![]),
            (some(&[2.0, 4.0]), vec![]),
            (vec![Some(6.0), None], vec![]),
        ];
        let letters: Vec<_> = missing(given).iter().map(|cell| cell.letter).collect();
        assert_eq!(letters, [Letter::A, Letter::A, Letter::B, Letter::D, Letter::F]);
    }

    #[test]
    fn a_method_that_fails_in_one_scene_fails_in_the_column() {
        let given: Given = vec![
            (vec![Some(1.0), Some(3.0)], vec![]),
            (vec![Some(5.0), Some(1.0)], vec![]),
            (vec![None, Some(1.0)], vec![]),
        ];
        let letters: Vec<_> = graded(given, 0.0, worst, TIMES).iter().map(|c| c.letter).collect();
        assert_eq!(letters, [Letter::B, Letter::C, Letter::F]);
    }
}
