//! Tables of the report: their methods with their steps, and the published entries.

/// Published entry for one method and one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Printed {
    /// Error, and CPU time [s] if it is published.
    Numbers(f64, Option<f64>),
    /// Entry with a CPU time [s] alone.
    Time(f64),
    /// Entry "No convergent." in place of numbers.
    NoConvergence,
    /// Entry "Wrong results" in place of numbers.
    Wrong,
    /// Entry "Does not work" in place of numbers.
    DoesNotWork,
    /// The table has no such entry.
    Nothing,
}

/// A method of a table: the options of our runs, and the report's row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Method {
    /// Name of the method in our tables.
    pub(crate) name: &'static str,
    /// `--formulation` of `mbs run`.
    pub(crate) formulation: &'static str,
    /// Further arguments of `mbs run`.
    pub(crate) arguments: &'static [&'static str],
    /// Name of the report's row; empty if there is none.
    pub(crate) printed_name: &'static str,
    /// Steps [s], if they differ from those of the table; otherwise empty.
    pub(crate) dt: &'static [f64],
    /// The report's entries, one for each of its steps. Further steps are run without a published entry.
    pub(crate) printed: &'static [Printed],
}

impl Method {
    /// The arguments of `mbs run`, without scene and step.
    pub(crate) fn options(&self) -> Vec<&'static str> {
        let formulation = ["--formulation", self.formulation];
        formulation.iter().chain(self.arguments).copied().collect()
    }
}

/// A channel whose value at the end is known from another source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reference {
    /// Name of the channel.
    pub(crate) channel: &'static str,
    /// Label of the distance from the reference, with its unit.
    pub(crate) label: &'static str,
    /// Components of the channel at the end.
    pub(crate) value: &'static [f64],
}

/// A channel whose history is drawn: for each method with its first step, and for the first method with its last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct History {
    /// Column of the channel in the CSV of a run.
    pub(crate) column: &'static str,
    /// Label of the history, with its unit.
    pub(crate) label: &'static str,
    /// Factor by which a number of the column is multiplied.
    pub(crate) scale: f64,
}

/// One table of the report.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table {
    /// Short name of the table.
    pub(crate) name: &'static str,
    /// Title of the table.
    pub(crate) title: &'static str,
    /// Source where the table is printed.
    pub(crate) source: &'static str,
    /// The scene, by its file.
    pub(crate) scene: &'static str,
    /// Simulated time of each run [s].
    pub(crate) duration: f64,
    /// Step sizes of the table [s].
    pub(crate) dt: &'static [f64],
    /// Methods of the table.
    pub(crate) methods: &'static [Method],
    /// Channel whose value at the end is known.
    pub(crate) reference: Option<Reference>,
    /// A history to be drawn.
    pub(crate) history: Option<History>,
    /// Sizes of the report's models, by the formulation.
    pub(crate) sizes: &'static [(&'static str, &'static str)],
    /// Note for the reader of the table.
    pub(crate) note: &'static str,
}

impl Table {
    /// Lists all entries: methods, and their steps.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (&'static Method, f64)> {
        let dt = self.dt;
        self.methods.iter().flat_map(move |method| {
            let dt = if method.dt.is_empty() { dt } else { method.dt };
            dt.iter().map(move |&step| (method, step))
        })
    }

    /// True if this is the first method at its smallest step.
    pub(crate) fn is_finest(&self, method: &Method, step: f64) -> bool {
        let last = self.entries().take_while(|(m, _)| m.name == self.methods[0].name).last();
        last.is_some_and(|(m, dt)| m.name == method.name && dt.to_bits() == step.to_bits())
    }

    /// True if the history of this entry is drawn. Drawn are the finest entry, and every method of the report with its first step.
    pub(crate) fn draws(&self, method: &Method, step: f64) -> bool {
        let is_first = method.dt.first().is_some_and(|dt| dt.to_bits() == step.to_bits());
        let is_printed = !method.printed.is_empty() && method.arguments.is_empty();
        (is_first && is_printed) || self.is_finest(method, step)
    }

    /// Number of steps of a run.
    pub(crate) fn steps(&self, step: f64) -> f64 {
        (self.duration / step).ceil()
    }

    /// Returns the published entry for a method and a step of this table.
    pub(crate) fn printed(&self, method: &Method, step: f64) -> Printed {
        let dt = if method.dt.is_empty() { self.dt } else { method.dt };
        let place = dt.iter().position(|dt| dt.to_bits() == step.to_bits());
        place.and_then(|i| method.printed.get(i)).copied().unwrap_or(Printed::Nothing)
    }
}

/// Makes an entry of an error and a time, as published.
pub(super) const fn n(error: f64, seconds: f64) -> Printed {
    Printed::Numbers(error, Some(seconds))
}

/// Method of ours without a published row.
pub(super) const CLASSICAL: Method = method("classical", "", &[]);

/// Makes a method from the name of its formulation.
pub(super) const fn method(
    formulation: &'static str,
    printed_name: &'static str,
    printed: &'static [Printed],
) -> Method {
    Method { name: formulation, formulation, arguments: &[], printed_name, dt: &[], printed }
}

/// Makes an index-3 method with the report's fixed penalty.
pub(super) const fn fixed(printed_name: &'static str, printed: &'static [Printed]) -> Method {
    let arguments = &["--penalty", "1e7"];
    Method { name: "index-3, alpha = 1e7", arguments, ..method("index-3", printed_name, printed) }
}
