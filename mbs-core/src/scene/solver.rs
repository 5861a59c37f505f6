//! The settings of a method, a row each, and the scene's wishes for them.
//!
//! Reader, writer, checks, manual, checkpoints, command line and Python go through the rows. A new setting is a row and a field of
//! [`SolverTable`] here, and a field of `Method` and `ResolvedMethod` in `mbs-steps/src/settings.rs`.

use super::setting::{NotASetting, Setting, SettingForm, SettingSlot, SettingValue};
use alloc::string::String;
use alloc::vec::Vec;

/// A row with what most have.
const ROW: Setting = Setting {
    name: "",
    path: "",
    options: &[],
    form: SettingForm::Positive,
    letter: "",
    unit: "",
    default: "",
    takers: "",
    meaning: "",
    more: &[],
};

/// All settings, in the order of the help; those of the table `[solver]` in the order of that table.
pub const SETTINGS: [Setting; 14] = [
    Setting {
        name: "formulation",
        path: "solver.formulation",
        form: SettingForm::Word(&[
            "auto",
            "index-1",
            "index-3",
            "multi-index",
            "classical",
            "state-space",
            "recursive",
        ]),
        letter: "F",
        default: "auto",
        meaning: "Formulation of the equations of motion.",
        ..ROW
    },
    Setting {
        name: "integrator",
        path: "solver.integrator",
        form: SettingForm::Word(&[
            "trapezoidal",
            "newmark",
            "generalised-alpha",
            "hht",
            "rk4",
            "rk54",
            "rk853",
            "gbs",
            "radau5",
        ]),
        letter: "I",
        default: "trapezoidal",
        meaning: "Integrator of the equations of motion.",
        more: &[
            "Formulation recursive alone has rk4, rk54, rk853 (order 8) and gbs (extrapolation, for reference runs).",
            "radau5, also of recursive alone, is implicit and of order 5, for stiff effects; give it a longer `step_max`.",
        ],
        ..ROW
    },
    Setting {
        name: "step",
        path: "solver.step",
        letter: "H",
        unit: "s",
        default: "1e-3",
        meaning: "Length of a step; of the first one where lengths are controlled.",
        ..ROW
    },
    Setting {
        name: "step_max",
        path: "solver.step_max",
        options: &["step-max"],
        letter: "H",
        unit: "s",
        default: "as `step`",
        takers: "steps of controlled length, and by rk54, rk853, gbs and radau5",
        meaning: "Longest step, and the distance of recorded rows.",
        ..ROW
    },
    Setting {
        name: "tolerance",
        path: "solver.tolerance",
        letter: "E",
        default: "1e-10",
        meaning: "Tolerance of the iterations, relative to the displacement by accelerations in a step.",
        more: &[
            "With rk54, rk853, gbs and radau5 it is the error of each step, relative to the size of each coordinate.",
            "The default is then 1e-8, with gbs 2e-10. The errors of the steps add up.",
        ],
        ..ROW
    },
    Setting {
        name: "penalty",
        path: "solver.penalty",
        letter: "A",
        unit: "N/m; index-1: kg",
        default: "by the masses and the step",
        takers: "all formulations but state-space",
        meaning: "Fixed penalty of the augmented Lagrangian, the printed alpha.",
        more: &[
            "In classical it is a regularisation of 1/alpha, in recursive it gives the report's closing forces.",
            "Both take it of the command line alone, and have neither by default.",
        ],
        ..ROW
    },
    Setting {
        name: "step_control",
        path: "solver.step_control",
        options: &["step-control"],
        form: SettingForm::Word(&[
            "fixed",
            "energy",
            "energy-printed",
            "error",
            "both",
            "energy-published",
        ]),
        letter: "C",
        default: "by its tolerances, energy in multi-index, else fixed",
        takers: "the implicit one-step integrators",
        meaning: "Rule for the length of steps.",
        more: &[
            "energy: by the change of the energy invariant; energy-printed: the same as publication 2 prints it.",
            "error: by an estimate of the local error; both: by the shorter of the two steps.",
            "energy-published is the same as energy-printed. A tolerance on the command line chooses its rule.",
        ],
        ..ROW
    },
    Setting {
        name: "energy_tolerance",
        path: "solver.energy_tolerance",
        options: &["energy-tolerance"],
        form: SettingForm::Descending,
        letter: "U,L",
        default: "[1e-5, 1e-7]",
        takers: "the step controls energy, energy-printed and both",
        meaning: "Limits U and L of the invariant's change in a step, relative to the energy that moves.",
        more: &[
            "A step that changes it by more than U is repeated with a shorter length.",
            "Below L the next step is longer, up to `step_max`.",
        ],
        ..ROW
    },
    Setting {
        name: "error_tolerance",
        path: "solver.error_tolerance",
        options: &["error-tolerance"],
        letter: "E",
        default: "1e-6",
        takers: "the step controls error and both",
        meaning: "Tolerance of the estimated local error of a step, relative to the scene's length.",
        ..ROW
    },
    Setting {
        name: "events",
        path: "solver.locate_events",
        options: &["events", "locate-events"],
        form: SettingForm::Flag,
        letter: "WORD",
        default: "true",
        takers: "the step controls energy, energy-printed, error and both",
        meaning: "Whether steps end where contacts begin or end, and at kinks of the road and of signals.",
        ..ROW
    },
    Setting {
        name: "energy_alarm",
        path: "solver.energy_alarm",
        options: &["energy-alarm"],
        letter: "RATIO",
        default: "0.1",
        meaning: "Largest error of the energy invariant, relative to the exchanged energy; beyond it the run stops.",
        ..ROW
    },
    Setting {
        name: "duration",
        path: "scene.duration",
        letter: "T",
        unit: "s",
        meaning: "Duration of the run.",
        ..ROW
    },
    Setting {
        name: "precision",
        form: SettingForm::Word(&["f32", "f64", "dd"]),
        letter: "P",
        default: "f64",
        meaning: "Precision of the numbers.",
        more: &["dd has pairs of doubles, 32 digits, for reference runs."],
        ..ROW
    },
    Setting {
        name: "threads",
        form: SettingForm::Count,
        letter: "N",
        default: "1",
        takers: "index-3, index-1, multi-index and classical",
        meaning: "Threads that share the work of a step.",
        more: &[
            "Results are the same to the last bit. Threads save time above some hundred bodies.",
        ],
        ..ROW
    },
];

impl Setting {
    /// Returns the setting of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|row| row.name == name)
    }

    /// Returns the settings that a table of scene files has, with their keys in it.
    pub fn of_table(table: &str) -> impl Iterator<Item = (&'static str, &'static Self)> {
        SETTINGS.iter().filter_map(move |row| {
            let (header, key) = row.path.split_once('.')?;
            (header == table).then_some((key, row))
        })
    }
}

/// The `[solver]` table: all optional; the command line overrides.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SolverTable<T> {
    /// Formulation of the equations of motion.
    pub formulation: Option<String>,
    /// Integrator of the equations of motion.
    pub integrator: Option<String>,
    /// Length of a step; of the first one where lengths are controlled [s].
    pub step: Option<T>,
    /// Longest step, and the distance of recorded rows [s].
    pub step_max: Option<T>,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step.
    pub tolerance: Option<T>,
    /// Fixed penalty of the augmented Lagrangian, the printed alpha [N/m; index-1: kg].
    pub penalty: Option<T>,
    /// Rule for the length of steps.
    pub step_control: Option<String>,
    /// Limits U and L of the invariant's change in a step, relative to the energy that moves.
    pub energy_tolerance: Option<[T; 2]>,
    /// Tolerance of the estimated local error of a step, relative to the scene's length.
    pub error_tolerance: Option<T>,
    /// Whether steps end where contacts begin or end, and at kinks of the road and of signals.
    pub locate_events: Option<bool>,
    /// Largest error of the energy invariant, relative to the exchanged energy; beyond it the run stops.
    pub energy_alarm: Option<T>,
    /// Further keys accepted by the reader and not used yet.
    pub unused: Vec<String>,
}

impl<T> SolverTable<T> {
    /// Field of a key; nothing for a key that the table does not have.
    pub fn slot(&mut self, key: &str) -> Option<SettingSlot<'_, T>> {
        Some(match key {
            "formulation" => SettingSlot::Word(&mut self.formulation),
            "integrator" => SettingSlot::Word(&mut self.integrator),
            "step" => SettingSlot::Number(&mut self.step),
            "step_max" => SettingSlot::Number(&mut self.step_max),
            "tolerance" => SettingSlot::Number(&mut self.tolerance),
            "penalty" => SettingSlot::Number(&mut self.penalty),
            "step_control" => SettingSlot::Word(&mut self.step_control),
            "energy_tolerance" => SettingSlot::Pair(&mut self.energy_tolerance),
            "error_tolerance" => SettingSlot::Number(&mut self.error_tolerance),
            "locate_events" => SettingSlot::Flag(&mut self.locate_events),
            "energy_alarm" => SettingSlot::Number(&mut self.energy_alarm),
            _ => return None,
        })
    }

    /// Value at a key, where it is written. Cost: a copy of the table.
    pub fn value(&self, key: &str) -> Option<SettingValue<T>>
    where
        T: Clone,
    {
        self.clone().slot(key)?.take()
    }

    /// Sets the value at a key.
    ///
    /// # Errors
    /// [`NotASetting`] for a key that the table does not have, and for a value of another form.
    pub fn set(&mut self, key: &str, value: SettingValue<T>) -> Result<(), NotASetting> {
        self.slot(key).ok_or(NotASetting)?.set(value)
    }

    /// Returns the table with every number as `f` gives it.
    pub(crate) fn map<U: Default>(&self, f: &mut impl FnMut(&T) -> U) -> SolverTable<U>
    where
        T: Clone,
    {
        let mut table = SolverTable { unused: self.unused.clone(), ..SolverTable::default() };
        for (key, _) in Setting::of_table("solver") {
            if let (Some(value), Some(slot)) = (self.value(key), table.slot(key)) {
                // both tables have the same forms
                let _ = slot.set(value.map(&mut |x| f(&x)));
            }
        }
        table
    }
}
