//! Texts in HTML: templates with marks, and escaping of special characters.

/// Replaces marks in a template by texts. The marks must occur in this order. The function makes one pass, so that a mark within an
/// inserted text is not replaced.
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
