//! The rules for the text of this repository: a program of tests by itself, which the check runs apart from the others.

mod tidy;
