//! Lines of output.

use serde_json::Value;

/// One line of output.
#[allow(clippy::print_stdout, reason = "the lines are what is asked for")]
pub(crate) fn say(line: &Value) {
    println!("{line}");
}

/// Adds keys to a line; one that is there already keeps its value.
pub(crate) fn merge<const N: usize>(line: &mut Value, more: [Value; N]) {
    for more in more {
        let (Value::Object(line), Value::Object(more)) = (&mut *line, more) else { continue };
        for (key, value) in more {
            line.entry(key).or_insert(value);
        }
    }
}
