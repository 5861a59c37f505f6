//! Keys of the table `[[signal]]`.

use super::coupling::{CURVE_WAYS, curve, measure};
use super::guide::interpolation;
use super::table::{Key, KeyTable, kinds, listed, may, need};
use super::value::KeyValue::{Flag, Name, Number, Of, RowsOrFile, Some, SomeNumbers, Text, Word};
use super::value::Referent;

pub(super) fn tables() -> Vec<KeyTable> {
    let name = need("name", Name, "", "Name, by which others refer to it.");
    let (functions, others) = (functions(), of_signals());
    let [lag, integral, pid] = states();
    let all = [
        ("constant", of("The same at all times.", vec![number("value", "Value.")])),
        ("table", table()),
    ];
    let last = [
        ("input", input()),
        ("measure", measured()),
        ("lag", lag),
        ("integral", integral),
        ("pid", pid),
    ];
    let name = [name];
    [
        kinds("signal", &name, all),
        kinds("signal", &name, functions),
        kinds("signal", &name, others),
        kinds("signal", &name, last),
    ]
    .concat()
}

fn of(meaning: &str, keys: Vec<Key>) -> KeyTable {
    listed("signal", meaning, keys)
}

fn number(name: &'static str, meaning: &str) -> Key {
    need(name, Number, "", meaning)
}

fn zero(name: &'static str, meaning: &str) -> Key {
    may(name, Number, "", "0", meaning)
}

fn one() -> Key {
    need("of", Of(Referent::Signal), "", "The signal.")
}

/// Kinds of signals that are functions of time.
fn functions() -> [(&'static str, KeyTable); 4] {
    let wave = || {
        vec![
            number("amplitude", "Amplitude."),
            need("frequency", Number, "Hz", "Frequency."),
            may("phase", Number, "rad", "0", "Phase at t = 0."),
            zero("offset", "Mean value."),
        ]
    };
    let mut chirp = wave();
    chirp.extend([
        need("to_frequency", Number, "Hz", "Frequency at the end."),
        need("duration", Number, "s", "Time in which the frequency changes; it then stays."),
    ]);
    [
        ("sine", of("offset + amplitude sin(2 pi frequency t + phase).", wave())),
        ("chirp", of("A sine whose frequency goes from one to another, and stays.", chirp)),
        ("ramp", ramp()),
        ("step", step()),
    ]
}

/// Kinds of signals that are made of other signals.
fn of_signals() -> [(&'static str, KeyTable); 5] {
    let several = || need("of", Some(Referent::Signal), "", "The signals.");
    let factors = may("factors", SomeNumbers, "", "ones", "A factor for each.");
    let mut of_curve = vec![one()];
    of_curve.extend(curve("Rows `[x, f]`.", &CURVE_WAYS));
    let limits = || vec![one(), number("lower", "Lower limit."), number("upper", "Upper limit.")];
    let ratio = "What limits leave of a signal, as a ratio: the signal within limits by the signal. It is one where that is zero.";
    [
        ("sum", of("A sum of signals with factors.", vec![several(), factors])),
        ("product", of("A product of signals.", vec![several()])),
        ("curve", of("A table or a polynomial of a signal.", of_curve)),
        ("clamp", of("A signal within limits.", limits())),
        ("limit-ratio", of(ratio, limits())),
    ]
}

fn input() -> KeyTable {
    of(
        "Set by its name between steps, or by `mbs run --inputs`.",
        vec![
            zero("value", "Value at the start."),
            may("unit", Text, "", "none", "Unit, for tables and plots."),
        ],
    )
}

fn measured() -> KeyTable {
    let mut keys = measure("`\"swing\"`");
    let words = Word(vec!["value", "rate"]);
    keys.push(may("quantity", words, "", "value", "The coordinate or length, or its rate."));
    of("A coordinate of a joint, turns counted, or a length; or its rate.", keys)
}

/// Signals with a state.
fn states() -> [KeyTable; 3] {
    let open = |name, meaning| may(name, Number, "", "none", meaning);
    let start = || zero("value", "Value at the start.");
    let lag = vec![one(), need("time", Number, "s", "Time constant."), start()];
    let limits = [open("lower", "Lower limit."), open("upper", "Upper limit.")];
    let integral = [vec![one()], limits.to_vec(), vec![start()]].concat();
    [
        of("Follows a signal with a delay of first order: time x' = s - x.", lag),
        of("The integral of a signal over time, between limits.", integral),
        pid(),
    ]
}

fn table() -> KeyTable {
    listed(
        "signal",
        "Through the rows of a table, held outside.",
        vec![
            need("table", RowsOrFile, "s, value", "Rows `[time, value]`."),
            interpolation(vec!["spline", "monotone", "linear", "hold"]),
            may("periodic", Flag, "", "false", "Whether the table repeats."),
            may(
                "ends",
                Word(vec!["natural", "level"]),
                "",
                "natural",
                "Ends of a spline or of `monotone`: without curvature, or at rest.",
            ),
        ],
    )
}

fn ramp() -> KeyTable {
    listed(
        "signal",
        "rate (t - start) from `start` to `end`; zero before, held after.",
        vec![
            need("rate", Number, "1/s", "Rate."),
            may("start", Number, "s", "0", "Begin."),
            may("end", Number, "s", "never", "End."),
            may("rounding", Number, "s", "0", "Time over which each corner is rounded."),
        ],
    )
}

fn step() -> KeyTable {
    listed(
        "signal",
        "From one value to another: a jump, or smooth within `rise`.",
        vec![
            may("from", Number, "", "0", "Value before."),
            need("to", Number, "", "Value after."),
            may("at", Number, "s", "0", "When it begins."),
            may("rise", Number, "s", "0", "Time that it takes."),
        ],
    )
}

fn pid() -> KeyTable {
    let gain = |name, meaning| may(name, Number, "", "0", meaning);
    listed(
        "signal",
        "A controller: p e + i (integral of e) + d e', with e = target - measured.",
        vec![
            need("target", Of(Referent::Signal), "", "What is asked for."),
            need("measured", Of(Referent::Signal), "", "What there is."),
            gain("p", "Gain of the difference."),
            gain("i", "Gain of its integral."),
            gain("d", "Gain of its rate."),
            may(
                "limit",
                Number,
                "",
                "none",
                "Largest value in both senses; the integral then stops.",
            ),
        ],
    )
}
