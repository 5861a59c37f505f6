//! An observer of a two-link arm and the closing of a loop, on an emulated Cortex-M7. `ffi/controller/observer.c` makes the same
//! computations in C, and its results have the same bits. Both programs print these lines:
//!
//! ```text
//! o STEP ERROR ERROR      differences of the two angles between the arm and the observer [rad], as hexadecimal bits
//! c MOVED VIOLATION VIOLATION      closing of the loop: largest change, remaining violations of positions and velocities, as bits
//! s STEP COORDINATES      coordinates of the loop after the following steps, as bits
//! n ARM LOOP STEP         numbers of instructions: setting a state of the arm, setting one of the loop, a step of the arm
//! m STACK                 bytes of stack that were used
//! ```

#![no_std]
#![no_main]

#[path = "../stack.rs"]
mod stack;
#[path = "../timer.rs"]
mod timer;

/// Model of the arm: the source file that `mbs export --rust` wrote and MBS_MODEL names.
mod arm {
    include!(env!("MBS_MODEL"));
}

/// Model of the linkage: the source file that `mbs export --rust` wrote and MBS_LOOP names.
mod linkage {
    include!(env!("MBS_LOOP"));
}

use core::fmt::{Arguments, Write};
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};
use mbs_nostd::{Checked, StateError, StateReport, Unwatched};

/// Step of the arm, of the observer and of the linkage [s].
const STEP: f64 = 1e-3;
/// Number of steps of the run [-]: half a second, more than the observer needs to converge.
const STEPS: u32 = 500;
/// Number of steps between two reports [-].
const REPORT_INTERVAL: u32 = 50;
/// Errors of the observer's angles at the start [rad].
const START_ERRORS: [f64; 2] = [0.04, 0.02];
/// Torque of the shoulder's motor, which acts on the arm and on the observer's model [N m].
const TORQUE: f64 = 0.5;
/// Changes of the loop's coordinates and velocities before it is closed [rad, rad/s].
const ASIDE: [f64; 3] = [0.05, -0.025, 0.0125];

/// Decay rate of the observer's error: double root of its characteristic equation [1/s]. After 0.4 s at most the fraction (1 + 8) exp(-8)
/// of the error 0.04 rad remains, which is 0.12 mrad.
const ROOT: f64 = 20.0;

/// Returns the gains of the observer for one step of length h, which are h L1 and h L2 in
///
/// ```text
/// z' = v + L1 (y - z),   v' = f(z, v) + L2 (y - z)
/// ```
///
/// Here y are the measured angles, z and v the observer's angles and velocities. With e = y - z the linearised arm v' = A z + B v gives e''
/// + (L1 - B) e' + (L2 - A - B L1) e = 0. This equation is e'' + 2 r e' + r² e = 0 for
///
/// ```text
/// L1 = 2 r 1 + B,   L2 = r² 1 + A + B L1
/// ```
///
/// For the arm hanging at rest, A = -M⁻¹ K and B = -M⁻¹ D. The links are uniform, with mass m = (2, 1) kg and length l = (0.4, 0.3) m:
///
/// ```text
/// M22 = m2 l2²/3,   M12 = M22 + m2 l1 l2/2,   M11 = m1 l1²/3 + m2 l1² + m2 l1 l2 + M22
/// K22 = K12 = g m2 l2/2,   K11 = g (m1 l1/2 + m2 l1) + K22,   D = diag(0.4, 0.1) N m s
/// ```
fn gains() -> [[[f64; 2]; 2]; 2] {
    let [m1, m2, l1, l2, g] = [2.0, 1.0, 0.4, 0.3, 9.81];
    let m22 = m2 * l2 * l2 / 3.0;
    let m12 = m22 + m2 * l1 * l2 / 2.0;
    let m11 = m1 * l1 * l1 / 3.0 + m2 * l1 * l1 + m2 * l1 * l2 + m22;
    let k22 = g * m2 * l2 / 2.0;
    let k11 = g * (m1 * l1 / 2.0 + m2 * l1) + k22;
    let determinant = m11 * m22 - m12 * m12;
    let inverse = [
        [m22 / determinant, -m12 / determinant],
        [-m12 / determinant, m11 / determinant],
    ];
    let a = minus_product(&inverse, &[[k11, k22], [k22, k22]]);
    let b = minus_product(&inverse, &[[0.4, 0.0], [0.0, 0.1]]);
    let mut first = b;
    first[0][0] += 2.0 * ROOT;
    first[1][1] += 2.0 * ROOT;
    // product -B L1, subtracted below
    let damped = minus_product(&b, &first);
    let mut second = a;
    for i in 0..2 {
        for j in 0..2 {
            second[i][j] -= damped[i][j];
            if i == j {
                second[i][j] += ROOT * ROOT;
            }
            first[i][j] *= STEP;
            second[i][j] *= STEP;
        }
    }
    [first, second]
}

/// Returns the product -x y of two matrices.
fn minus_product(x: &[[f64; 2]; 2], y: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let mut product = [[0.0; 2]; 2];
    for i in 0..2 {
        for j in 0..2 {
            product[i][j] = -(x[i][0] * y[0][j] + x[i][1] * y[1][j]);
        }
    }
    product
}

/// Sets a state of the linkage. A check of the compiled code proves that this function has no path to a panic.
#[unsafe(no_mangle)]
#[inline(never)]
pub fn mbs_set_state(
    solver: &mut linkage::ModelSolver,
    model: &Checked<'_, linkage::Scalar, linkage::Axes>,
    z: &[f64],
    v: &[f64],
) -> Result<StateReport<f64>, StateError> {
    solver.set_state(model, z, v)
}

#[entry]
fn main() -> ! {
    stack::paint();
    let status = match whole() {
        Some(()) => debug::EXIT_SUCCESS,
        None => debug::EXIT_FAILURE,
    };
    debug::exit(status);
    loop {}
}

fn whole() -> Option<()> {
    let mut out = hio::hstdout().ok()?;
    let timer = timer::Timer::start();
    let mut last = timer.now();
    let mut clock = || {
        let spent = timer.since(last) * timer::INSTRUCTIONS_PER_TICK;
        last = timer.now();
        spent
    };
    let [of_arm, of_step] = observe(&mut out, &mut clock)?;
    let of_loop = close(&mut out, &mut clock)?;
    writeln!(out, "n {of_arm} {of_loop} {of_step}").ok()?;
    writeln!(out, "m {}", stack::used()).ok()
}

/// Runs the arm and its observer together. Returns the number of instructions for setting a state, and the number for a step.
fn observe(out: &mut impl Write, clock: &mut impl FnMut() -> u32) -> Option<[u32; 2]> {
    let model = Checked::new(&arm::MODEL).ok()?;
    let mut arm = arm::ModelSolver::new(&model).ok()?;
    let mut observer = arm::ModelSolver::new(&model).ok()?;
    let (mut z, mut v, mut errors) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    z.copy_from_slice(arm.coordinates());
    v.copy_from_slice(arm.velocities());
    for i in 0..2 {
        z[i] -= START_ERRORS[i];
    }
    observer.set_state(&model, &z, &v).ok()?;
    let [first, second] = gains();
    let mut spent = [0; 2];
    for step in 1..=STEPS {
        for solver in [&mut arm, &mut observer] {
            solver.set_input(0, [TORQUE, 0.0, 0.0]).ok()?;
            clock();
            solver.step(&model, STEP, &mut Unwatched).ok()?;
            spent[1] = clock();
        }
        z.copy_from_slice(observer.coordinates());
        v.copy_from_slice(observer.velocities());
        for i in 0..2 {
            errors[i] = arm.coordinates()[i] - z[i];
        }
        if step % REPORT_INTERVAL == 0 {
            write_line(out, format_args!("o {step}"), &errors)?;
        }
        for i in 0..2 {
            z[i] += first[i][0] * errors[0] + first[i][1] * errors[1];
            v[i] += second[i][0] * errors[0] + second[i][1] * errors[1];
        }
        clock();
        observer.set_state(&model, &z, &v).ok()?;
        spent[0] = clock();
    }
    Some(spent)
}

/// Displaces the linkage, closes its loop, continues with steps, and checks that invalid states are refused. Returns the number
/// of instructions for setting the state.
fn close(out: &mut impl Write, clock: &mut impl FnMut() -> u32) -> Option<u32> {
    let model = Checked::new(&linkage::MODEL).ok()?;
    let mut solver = linkage::ModelSolver::new(&model).ok()?;
    let (mut z, mut v) = ([0.0; 3], [0.0; 3]);
    z.copy_from_slice(solver.coordinates());
    v.copy_from_slice(solver.velocities());
    for i in 0..3 {
        z[i] += ASIDE[i];
        v[i] += ASIDE[i];
    }
    clock();
    let report = mbs_set_state(&mut solver, &model, &z, &v).ok()?;
    let spent = clock();
    write_line(
        out,
        format_args!("c"),
        &[report.moved, report.violation[0], report.violation[1]],
    )?;
    z[1] = f64::NAN;
    let refused = mbs_set_state(&mut solver, &model, &z, &v);
    if !matches!(refused, Err(StateError::NotFinite { entry: 1, .. })) {
        return None;
    }
    for step in 1..=STEPS {
        solver.step(&model, STEP, &mut Unwatched).ok()?;
        if step % REPORT_INTERVAL == 0 {
            write_line(out, format_args!("s {step}"), solver.coordinates())?;
        }
    }
    Some(spent)
}

/// Writes a line of numbers as hexadecimal bits.
fn write_line(out: &mut impl Write, what: Arguments<'_>, numbers: &[f64]) -> Option<()> {
    write!(out, "{what}").ok()?;
    for x in numbers {
        write!(out, " {:x}", x.to_bits()).ok()?;
    }
    writeln!(out).ok()
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}
