//! A model as a Rust source file: constant tables, and the type of a solver with exactly these sizes.

use super::collect::{elements, needs};
use crate::check::{Checked, LoadError, MIN_SIDES, Sizes};
use crate::format::{Axes, Record, Source};
use crate::model::Model;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::laws::entry::Entry;
use mbs_recursive::rows::coupled::Couplings;

/// Writes a constant table.
fn table<X: Record>(name: &str, of: &str, list: &[X], to: &mut String) {
    constants((name, of), list, &X::source, to);
}

/// Writes a constant table whose entries are written by `write`.
fn constants<X>(
    (name, of): (&str, &str),
    list: &[X],
    write: &dyn Fn(&X, &mut String),
    to: &mut String,
) {
    to.push_str(&format!("static {name}: [{of}; {}] = [", list.len()));
    for entry in list {
        to.push_str("\n    ");
        write(entry, to);
        to.push(',');
    }
    to.push_str(if list.is_empty() { "];\n" } else { "\n];\n" });
}

/// Returns the value of a field as source.
fn value<X: Record>(x: &X) -> String {
    let mut text = String::new();
    x.source(&mut text);
    text
}

/// Returns the source of a model in single or double precision, to be included as a module of a crate that depends on mbs-nostd. `title`
/// names the scene. Numbers are written with all decimal digits of the model's precision, so that only the compiler rounds them.
///
/// # Errors
/// The errors of [`Checked::new`]. A user-defined law has no source. In its place a word is written that does not compile.
pub fn source<T: Real + Record, S: Axes<T>>(
    model: &Model<'_, T, S>,
    (title, is_single): (&str, bool),
) -> Result<String, LoadError> {
    let checked = Checked::new(model)?;
    let sizes = checked.sizes();
    let m = &model.mechanism;
    let scalar = if is_single { "f32" } else { "f64" };
    let space = if S::DIMENSION == 3 { "Spatial" } else { "Planar" };
    let features = needs(model).join(", ");
    let features = if features.is_empty() { "none".into() } else { features };
    let of_elements = elements(model).join(", ");
    let of_elements = if of_elements.is_empty() {
        String::new()
    } else {
        format!("// Features of mbs-nostd that its machine elements need: {of_elements}.\n")
    };
    let mut to = format!(
        "// {title}, as constant tables for mbs-nostd; written by `mbs export`, not by hand.\n\
         // Features of mbs-core that its effects need: {features}.\n\
         {of_elements}\n\
         use mbs_nostd::table::*;\n\
         \n\
         /// Precision of the tables.\n\
         pub type Scalar = {scalar};\n\
         /// Plane or space.\n\
         pub type Axes = {space};\n\
         /// A solver of just the size of [`MODEL`]: {} links with the ground, {} coordinates, {} freedoms, {} rows of loops.\n\
         pub type ModelSolver = Solver<Scalar, Axes, {}, {}, {}, {}, {}, {}, {}, {}{}>;\n\n",
        sizes.links,
        sizes.coordinates,
        sizes.freedoms,
        sizes.rows,
        sizes.links,
        sizes.coordinates,
        sizes.freedoms,
        sizes.rows,
        sizes.blocks,
        sizes.gains,
        sizes.guides,
        sizes.courses,
        further(&sizes, checked.n_slopes())
    );
    lists(model, &mut to);
    let law_inputs = law_inputs(m.tables, &mut to);
    let signals = signals(model, &mut to);
    let couplings = couplings(&m.loops.couplings, &mut to);
    constant(model, (&law_inputs, &couplings, signals), &mut to);
    Ok(to)
}

/// Returns the optional sizes of a solver, up to the last size that differs from its default.
fn further(sizes: &Sizes, n_slopes: usize) -> String {
    let all = [(sizes.states, 0), (sizes.followed, 0), (sizes.sides, MIN_SIDES), (n_slopes, 0)];
    let last = all.iter().rposition(|(needed, default)| needed != default);
    let written = all.iter().take(last.map_or(0, |last| last + 1));
    written.map(|(needed, _)| format!(", {needed}")).collect()
}

/// Writes the constant that contains all tables.
fn constant<T: Real + Record, S: Axes<T>>(
    model: &Model<'_, T, S>,
    (law_inputs, couplings, [feedback, states]): (&str, &str, [&str; 2]),
    to: &mut String,
) {
    let m = &model.mechanism;
    to.push_str(&format!(
        "/// The model.\n\
         pub static MODEL: Model<'static, Scalar, Axes> = Model {{\n\
         \x20   mechanism: TreeSlices {{\n\
         \x20       links: &LINKS,\n\
         \x20       loops: Loops {{\n\
         \x20           loops: &LOOPS,\n\
         \x20           rows: &ROWS,\n\
         \x20           plan: Plan {{\n\
         \x20               stations: &STATIONS,\n\
         \x20               passes: &PASSES,\n\
         \x20               pairs: &PAIRS,\n\
         \x20               ends: &ENDS,\n\
         \x20               couplings: &COUPLINGS,\n\
         \x20               updates: &UPDATES,\n\
         \x20           }},\n\
         \x20           floor: {},\n\
         \x20           couplings: Couplings {{ n_cut: {}, terms: &TERMS, {couplings} }},\n\
         \x20       }},\n\
         \x20       loads: &LOADS,\n\
         \x20       rotors: &ROTORS,\n\
         \x20       tables: {law_inputs},\n\
         \x20       feedback: {feedback},\n\
         \x20       gravity: {},\n\
         \x20       base: {},\n\
         \x20       length: {},\n\
         \x20       n_coordinates: {},\n\
         \x20       n_freedoms: {},\n\
         \x20   }},\n\
         \x20   prescriptions: Prescriptions {{\n\
         \x20       guides: &GUIDES,\n\
         \x20       courses: &COURSES,\n\
         \x20       knots: (&KNOTS, &CURVATURES),\n\
         \x20       rows: &COURSE_ROWS,\n\
         \x20   }},\n\
         \x20   start: StartState {{ t: {}, z: &Z, v: &V, a: &A, signals: {states} }},\n\
         \x20   rungs: &RUNGS,\n\
         }};\n",
        value(&m.loops.floor),
        m.loops.couplings.n_cut,
        value(&m.gravity),
        value(&m.base),
        value(&m.length),
        m.n_coordinates,
        m.n_freedoms,
        value(&model.start.t),
    ));
}

/// Writes all tables except the tables of laws.
fn lists<T: Real + Record, S: Axes<T>>(model: &Model<'_, T, S>, to: &mut String) {
    let m = &model.mechanism;
    let (plan, laws, begin) = (&m.loops.plan, &model.prescriptions, &model.start);
    table("LINKS", "Link<Scalar, Axes>", m.links, to);
    table("LOOPS", "ClosedLoop<Scalar, Axes>", m.loops.loops, to);
    table("ROWS", "Row<Scalar, Axes>", m.loops.rows, to);
    table("TERMS", "SumTerm<Scalar>", m.loops.couplings.terms, to);
    table("STATIONS", "Station", plan.stations, to);
    table("PASSES", "Pass", plan.passes, to);
    table("PAIRS", "Pair", plan.pairs, to);
    table("ENDS", "End", plan.ends, to);
    table("COUPLINGS", "LoopCoupling", plan.couplings, to);
    table("UPDATES", "Update", plan.updates, to);
    table("LOADS", "Load<Scalar, Axes>", m.loads, to);
    table("ROTORS", "LinkRotor<Scalar>", m.rotors, to);
    table("GUIDES", "Motion<Scalar>", laws.guides, to);
    table("COURSES", "SignalLaw<Scalar>", laws.courses, to);
    table("KNOTS", "[Scalar; 2]", laws.knots.0, to);
    table("CURVATURES", "Scalar", laws.knots.1, to);
    table("COURSE_ROWS", "[Scalar; 4]", laws.rows, to);
    table("RUNGS", "u32", model.rungs, to);
    table("Z", "Scalar", begin.z, to);
    table("V", "Scalar", begin.v, to);
    table("A", "Scalar", begin.a, to);
}

/// Writes the tables of signals, if there are operations on signals. Returns the fields of feedback and start state that refer to these
/// tables.
fn signals<T: Real + Record, S: Axes<T>>(
    model: &Model<'_, T, S>,
    to: &mut String,
) -> [&'static str; 2] {
    let feedback = &model.mechanism.feedback;
    if feedback.steps.is_empty() {
        return ["FeedbackSlices::none()", "&[]"];
    }
    table("OPERATIONS", "FeedbackStep<Scalar>", feedback.steps, to);
    table("MEASURED", "u32", feedback.links, to);
    table("STATES", "[Scalar; 2]", model.start.signals, to);
    [
        "FeedbackSlices { steps: &OPERATIONS, links: &MEASURED, n_states: STATES.len(), signals: &[], ..FeedbackSlices::none() }",
        "&STATES",
    ]
}

/// Writes the tables of curves and lines that are not empty. Returns the fields for all these tables; an empty table has the default.
fn couplings<T: Real + Record, S: Axes<T>>(of: &Couplings<'_, T, S>, to: &mut String) -> String {
    let mut fields = Vec::new();
    if !of.curves.is_empty() {
        table("CURVES", "CurveTable<Scalar>", of.curves, to);
        table("CURVE_KNOTS", "[Scalar; 2]", of.knots, to);
        table("CURVE_NUMBERS", "Scalar", of.numbers, to);
        fields.push("curves: &CURVES, knots: &CURVE_KNOTS, numbers: &CURVE_NUMBERS");
    }
    if !of.points.is_empty() {
        table("POINTS", "LinePoint<Scalar, Axes>", of.points, to);
        table("STARTS", "LinkStart", of.starts, to);
        fields.push("points: &POINTS, starts: &STARTS");
    }
    fields.push("..Couplings::none()");
    fields.join(", ")
}

/// Writes the tables of laws that are not empty. Returns the expression that contains them.
fn law_inputs<T: Real + Record>(
    tables: mbs_core::laws::LawInputs<'_, T>,
    to: &mut String,
) -> String {
    let tables = tables.tables();
    let mut sets = String::new();
    if !tables.pieces.is_empty() {
        entries::<T, _>("PIECES", "Piece<Scalar>", tables.pieces, to);
        sets.push_str("tables.pieces = &PIECES; ");
    }
    if !tables.features.is_empty() {
        entries::<T, _>("FEATURES", "Feature<Scalar>", tables.features, to);
        entries::<T, _>("ROAD_KNOTS", "[Scalar; 2]", tables.knots.0, to);
        entries::<T, _>("ROAD_CURVATURES", "Scalar", tables.knots.1, to);
        sets.push_str(
            "tables.features = &FEATURES; tables.knots = (&ROAD_KNOTS, &ROAD_CURVATURES); ",
        );
    }
    if sets.is_empty() {
        "LawInputs::courses(&[])".into()
    } else {
        format!("{{ let mut tables = LawInputs::courses(&[]); {sets}tables }}")
    }
}

/// Writes a constant table of entries to which laws refer.
fn entries<T: Real + Record, X: Entry<T>>(name: &str, of: &str, list: &[X], to: &mut String) {
    let write = |entry: &X, to: &mut String| {
        entry.numbers(&mut Source(to));
    };
    constants((name, of), list, &write, to);
}
