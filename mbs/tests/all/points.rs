//! Point masses against elliptic integrals, closed forms and independent equations of motion, in every formulation, in the plane and in
//! space.

mod closed_forms;
mod motions;
mod tiny;

use crate::common::oracle::{self, Rows, TRAPEZOIDAL, Way, last};

const GRAVITY: f64 = 9.81;

/// Rows of a run of a scene.
fn run(text: &str, way: Way, step: f64, duration: f64) -> Rows {
    oracle::run(text, way, (step, duration))
}

fn head(dimension: usize, gravity: &str) -> String {
    format!(
        "[scene]\nname = \"p\"\ndimension = {dimension}\nduration = 10.0\ngravity = {gravity}\n"
    )
}

fn list(x: &[f64]) -> String {
    format!("{x:?}")
}

fn point(name: &str, mass: f64, at: &[f64]) -> String {
    format!("[[body]]\nname = \"{name}\"\nmass = {mass:?}\npoint = {}\n", list(at))
}

fn distance(bodies: [&str; 2], from: &[f64], to: &[f64]) -> String {
    let [a, b] = bodies;
    format!(
        "[[joint]]\nname = \"{a}-{b}\"\nkind = \"distance\"\nbodies = {bodies:?}\npoints = [{}, {}]\n",
        list(from),
        list(to)
    )
}

fn velocity(body: &str, at: &[f64], v: &[f64]) -> String {
    let (at, v) = (list(at), list(v));
    format!("[[initial]]\nbody = \"{body}\"\nat = {at}\nvelocity = {v}\n")
}

/// Text of an output of a body's point.
fn output(body: &str, at: &[f64], quantity: &str) -> String {
    let at = list(at);
    format!(
        "[[output]]\nname = \"{body}-{quantity}\"\nbody = \"{body}\"\nat = {at}\nquantity = \"{quantity}\"\n"
    )
}

/// Largest difference of the first numbers of the last row from the expected ones.
fn apart(rows: &Rows, right: &[f64]) -> f64 {
    last(rows).iter().zip(right).fold(0.0, |a, (x, y)| a.max((x - y).abs()))
}

/// Asserts the values at the end. A method of high order has an error of `digits`. The trapezoidal rule has an error of at most `error` at
/// `step`, which falls with the square of the step.
fn check(text: &str, duration: f64, (step, error): (f64, f64), (right, digits): (&[f64], f64)) {
    let exact = apart(&run(text, Way("recursive", "rk853"), step, duration), right);
    assert!(exact < digits, "rk853: {exact:e}");
    for formulation in TRAPEZOIDAL {
        let way = Way(formulation, "trapezoidal");
        let [coarse, fine] =
            [1.0, 0.5].map(|part| apart(&run(text, way, step * part, duration), right));
        println!("{formulation}: {coarse:.2e}, {fine:.2e}");
        assert!(coarse < error, "{formulation}: {coarse:e}");
        let ratio = coarse / fine;
        assert!((3.6..4.4).contains(&ratio), "{formulation}: {coarse:e} over {fine:e}: {ratio}");
    }
}

/// Classical Runge-Kutta method of fourth order, with `n` steps.
fn rk4<const N: usize>(
    slope: impl Fn(&[f64; N]) -> [f64; N],
    start: [f64; N],
    (duration, n): (f64, u32),
) -> [f64; N] {
    let h = duration / f64::from(n);
    let add = |x: &[f64; N], k: &[f64; N], h: f64| core::array::from_fn(|i| x[i] + h * k[i]);
    (0..n).fold(start, |x, _| {
        let a = slope(&x);
        let b = slope(&add(&x, &a, 0.5 * h));
        let c = slope(&add(&x, &b, 0.5 * h));
        let d = slope(&add(&x, &c, h));
        let mean = core::array::from_fn(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        add(&x, &mean, h)
    })
}
