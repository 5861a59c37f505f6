//! Rotor inertia against closed forms and equations of motion by hand, in every formulation.

mod arm;
mod closed_forms;
mod joints;
mod states;

use crate::common::oracle::{self, Rows, Way};

fn head(dimension: usize, gravity: &str) -> String {
    format!(
        "[scene]\nname = \"r\"\ndimension = {dimension}\nduration = 10.0\ngravity = {gravity}\n"
    )
}

fn rotor(joint: &str, inertia: f64, ratio: f64) -> String {
    format!(
        "[[effect]]\nname = \"rotor-{joint}\"\nkind = \"rotor\"\njoint = \"{joint}\"\ninertia = {inertia:?}\n\
         ratio = {ratio:?}\n"
    )
}

fn output(joint: &str, quantity: &str) -> String {
    format!(
        "[[output]]\nname = \"{joint}-{quantity}\"\njoint = \"{joint}\"\nquantity = \"{quantity}\"\n"
    )
}

fn initial(joint: &str, value: f64, rate: f64) -> String {
    format!("[[initial]]\njoint = \"{joint}\"\nvalue = {value:?}\nrate = {rate:?}\n")
}

/// Rows of a run by a formulation with the trapezoidal rule.
fn run(text: &str, formulation: &'static str, step: f64, duration: f64) -> Rows {
    oracle::run(text, Way(formulation, "trapezoidal"), (step, duration))
}
