//! The rules for the text of this repository. They are a test program of their own, so that the check can run them separately.

mod tidy;
