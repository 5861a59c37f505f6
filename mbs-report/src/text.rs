//! Texts in HTML: templates with marks, and characters that have a meaning there.

/// Puts parts in the places of their marks, which stand in this order. One pass, so that what they contain is never taken for a
/// mark.
pub(crate) fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let mut out = String::new();
    let mut rest = template;
    for (mark, part) in parts {
        if let Some((before, after)) = rest.split_once(mark) {
            out += before;
            out += part;
            rest = after;
        }
    }
    out + rest
}

pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
