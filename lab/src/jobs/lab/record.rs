//! The files of a run: its steps, and channels over time.

use crate::mbs::columns;
use std::path::Path;

/// Columns of the file of steps.
const COLUMNS: [&str; 6] =
    ["t", "step", "index", "energy_error", "energy_change", "penalty_energy"];

/// One recorded step of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    /// End of the step [s].
    pub(crate) t: f64,
    /// Length of the step [s].
    pub(crate) step: f64,
    /// True if the step was made in index 1.
    pub(crate) is_index_1: bool,
    /// Error of the energy balance at the end of the step [J].
    pub(crate) energy_error: f64,
    /// Change of the energy balance within the step [J].
    pub(crate) energy_change: f64,
    /// Energy of the penalty system [J].
    pub(crate) penalty_energy: f64,
}

/// Record of a run: its steps and channels.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Record {
    /// Steps of the run, as recorded.
    pub(crate) steps: Vec<Step>,
    /// The requested channels, as points (time, value).
    pub(crate) channels: Vec<Vec<[f64; 2]>>,
}

impl Record {
    /// Reads the steps and some channels of a run.
    ///
    /// # Errors
    ///
    /// The missing file or column.
    pub(crate) fn read(folder: &Path, channels: &[&str]) -> Result<Self, String> {
        let (file, run) = (folder.join("steps.csv"), folder.join("run.csv"));
        // the file exists only if steps were recorded
        let rows = if file.is_file() { columns::read(&file, COLUMNS)? } else { Vec::new() };
        let steps = rows.into_iter().filter_map(step).collect();
        let channels = channels.iter().map(|column| columns::history(&run, column));
        Ok(Self { steps, channels: channels.collect::<Result<_, _>>()? })
    }

    /// Points (end of the step, number of the step).
    pub(crate) fn points(&self, number: impl Fn(&Step) -> f64) -> Vec<[f64; 2]> {
        self.steps.iter().map(|step| [step.t, number(step)]).collect()
    }
}

/// Reads a row; `None` for the row of a start, which has no step.
fn step([t, step, index, error, change, penalty]: [Option<f64>; 6]) -> Option<Step> {
    Some(Step {
        t: t?,
        step: step.filter(|&step| step > 0.0)?,
        is_index_1: index.is_some_and(|index| index < 2.0),
        energy_error: error?,
        energy_change: change.unwrap_or(0.0),
        penalty_energy: penalty.unwrap_or(0.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn steps_and_channels_are_read() {
        let folder = std::env::temp_dir().join(format!("mbs-record-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let steps = "t,step,index,iterations,rejected,energy_error,energy_change,penalty_energy,error_estimate,limit\n\
            1e-3,1e-3,3,4,0,1e-6,1e-6,2e-9,,energy\n1.5e-3,5e-4,1,5,2,2e-6,1e-6,,1e-7,\n";
        fs::write(folder.join("steps.csv"), steps).unwrap();
        fs::write(folder.join("run.csv"), "t,wheel.z\n0,0.4\n1e-3,0.5\n").unwrap();
        let record = Record::read(&folder, &["wheel.z"]);
        let lacking = Record::read(&folder, &["wheel.w"]);
        fs::remove_dir_all(&folder).unwrap();
        let record = record.unwrap();
        assert_eq!(record.points(|s| s.step), [[1e-3, 1e-3], [1.5e-3, 5e-4]]);
        assert_eq!(record.steps.iter().map(|s| s.is_index_1).collect::<Vec<_>>(), [false, true]);
        assert_eq!(record.channels, [[[0.0, 0.4], [1e-3, 0.5]]]);
        assert!(lacking.unwrap_err().contains("wheel.w"));
    }
}
