//! Numbers in messages and tables, in as many digits as one reads.

use mbs_core::control::Limit;
use mbs_scene::format::significant;

/// Three significant digits: the size is what matters.
#[must_use]
pub fn few(x: f64) -> String {
    rounded(x, 3)
}

pub(crate) fn rounded(x: f64, digits: usize) -> String {
    significant(format!("{x:.*e}", digits - 1).parse().unwrap_or(x))
}

/// What kept a step from being longer, as it stands in files.
pub(crate) fn limit_name(limit: Limit) -> &'static str {
    match limit {
        Limit::Largest => "max",
        Limit::Energy => "energy",
        Limit::Error => "error",
        Limit::Event => "event",
        Limit::Contact => "contact",
        Limit::Failure => "failure",
    }
}

/// All of them.
pub(crate) fn limit_names() -> [&'static str; 6] {
    [Limit::Largest, Limit::Energy, Limit::Error, Limit::Event, Limit::Contact, Limit::Failure]
        .map(limit_name)
}

/// A time span for a table.
#[must_use]
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{s:.2} s"),
        s if s >= 1e-3 => format!("{:.2} ms", s * 1e3),
        s => format!("{:.1} us", s * 1e6),
    }
}
