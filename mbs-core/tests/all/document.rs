//! Documents that are written from tables in the code.

/// Asserts that a document has the expected text, or writes it if MBS_WRITE_DOCS is set.
pub(crate) fn written(path: &str, (text, expected): (&str, &str)) {
    if std::env::var_os("MBS_WRITE_DOCS").is_some() {
        std::fs::write(path, expected).expect("the document");
    } else {
        assert!(
            text == expected,
            "run this test with MBS_WRITE_DOCS=1, and look at the difference"
        );
    }
}
