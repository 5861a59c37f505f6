//! Interface of mbs-nostd for C programs. The header `include/mbs.h` documents each function.
//!
//! Only this file handles pointers. The header states what callers promise: a solver pointer comes from `mbs_init`, and its memory still
//! exists. No two calls use one solver at the same time. Arrays have the lengths that the arguments state. Null pointers are checked here.

#![no_std]

use core::ffi::{c_int, c_void};
use mbs_nostd::{Bounds, InputError, Solver, Spatial, StateError, Tables, Unwatched};

#[cfg(feature = "single")]
type Scalar = f32;
#[cfg(not(feature = "single"))]
type Scalar = f64;

/// Memory for a vehicle of about twenty bodies. Change the numbers to fit a model, and build again.
type Model = Tables<Scalar, Spatial, 24, 16, 40, 96, 40, 64, 32, 96, 64, 32>;
type Room = Solver<Scalar, Spatial, 24, 96, 72, 40, 1024, 1024, 8, 32, 12, 32, 6, 32>;

const OK: c_int = 0;
const NULL: c_int = 1;
const MEMORY: c_int = 2;
const MODEL: c_int = 3;
const NO_INPUT: c_int = 4;
const STOPPED: c_int = 5;
const NOT_FINITE: c_int = 6;
const LENGTH: c_int = 7;
const QUATERNION: c_int = 8;
const OPEN: c_int = 9;

/// A model with its solver, in the memory of the caller.
#[allow(non_camel_case_types, reason = "the name in C")]
#[derive(Debug)]
pub struct mbs_solver {
    model: Model,
    solver: Room,
}

/// Report of a step: `mbs_report` of the header.
#[allow(non_camel_case_types, reason = "the name in C")]
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct mbs_report {
    evaluations: u32,
    projections: u32,
    correction: Scalar,
    violation: [Scalar; 3],
    is_cut_short: u32,
}

/// Report of a state that was set: `mbs_state_report` of the header.
#[allow(non_camel_case_types, reason = "the name in C")]
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct mbs_state_report {
    evaluations: u32,
    responses: u32,
    moved: Scalar,
    violation: [Scalar; 3],
}

/// Callback that returns a number other than zero while time remains for further evaluations or projections.
type Watch = Option<unsafe extern "C" fn(*mut c_void) -> c_int>;

/// Returns the size of a solver in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn mbs_size() -> usize {
    size_of::<mbs_solver>()
}

/// Returns the alignment of a solver in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn mbs_align() -> usize {
    align_of::<mbs_solver>()
}

/// Reads a model and makes its solver in the caller's memory.
///
/// # Safety
/// `memory` has `size` bytes, and `model` has `n` bytes. Nothing else uses `memory` while the solver is in use.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_init(
    memory: *mut c_void,
    size: usize,
    model: *const u8,
    n: usize,
    solver: *mut *mut mbs_solver,
) -> c_int {
    if memory.is_null() || model.is_null() || solver.is_null() {
        return NULL;
    }
    let place: *mut mbs_solver = memory.cast();
    if size < mbs_size() || !place.is_aligned() {
        return MEMORY;
    }
    // SAFETY: the pointer is not null, and the caller gave `n` bytes.
    let bytes = unsafe { core::slice::from_raw_parts(model, n) };
    let Ok(model) = Model::read(bytes) else { return MODEL };
    let Ok(room) = Room::new(&model.model()) else { return MODEL };
    // SAFETY: `place` is aligned and large enough; `solver` is valid for writing a pointer.
    unsafe {
        place.write(mbs_solver { model, solver: room });
        solver.write(place);
    }
    OK
}

/// Returns the status code of the result of setting an input.
fn status(done: Result<(), InputError>) -> c_int {
    match done {
        Ok(()) => OK,
        Err(InputError::NotFinite { .. }) => NOT_FINITE,
        Err(_) => NO_INPUT,
    }
}

/// Sets the motion of a guide.
///
/// # Safety
/// `solver` comes from `mbs_init`; `motion` has three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_guide(
    solver: *mut mbs_solver,
    guide: usize,
    motion: *const [Scalar; 3],
) -> c_int {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let (Some(own), Some(motion)) = (unsafe { solver.as_mut() }, unsafe { motion.as_ref() }) else {
        return NULL;
    };
    status(own.solver.set_guide(guide, *motion))
}

/// Sets the vector of a signal.
///
/// # Safety
/// The caller makes the promises of [`mbs_set_guide`], with `value` in place of `motion`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_input(
    solver: *mut mbs_solver,
    course: usize,
    value: *const [Scalar; 3],
) -> c_int {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let (Some(own), Some(value)) = (unsafe { solver.as_mut() }, unsafe { value.as_ref() }) else {
        return NULL;
    };
    status(own.solver.set_input(course, *value))
}

/// Sets the largest numbers of evaluations, sweeps and projections of a step.
///
/// # Safety
/// `solver` comes from `mbs_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_bounds(
    solver: *mut mbs_solver,
    evaluations: u32,
    sweeps: u32,
    projections: u32,
) -> c_int {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    own.solver.bounds = Bounds { evaluations, sweeps, projections };
    OK
}

/// Advances the model by one step.
///
/// # Safety
/// `solver` comes from `mbs_init`. `report` is null or valid for writing a report. `watch` may be called with `context`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_step(
    solver: *mut mbs_solver,
    dt: Scalar,
    watch: Watch,
    context: *mut c_void,
    report: *mut mbs_report,
) -> c_int {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    let model = own.model.model();
    let done = match watch {
        None => own.solver.step(&model, dt, &mut Unwatched),
        Some(watch) => {
            // SAFETY: the caller allows calls of `watch` with `context`.
            let mut has_time = || unsafe { watch(context) } != 0;
            own.solver.step(&model, dt, &mut has_time)
        }
    };
    let Ok(done) = done else { return STOPPED };
    // SAFETY: a null pointer gives `None`; any other pointer is valid for writing a report, as the caller promised.
    if let Some(report) = unsafe { report.as_mut() } {
        *report = mbs_report {
            evaluations: done.evaluations,
            projections: done.projections,
            correction: done.correction,
            violation: done.violation,
            is_cut_short: u32::from(done.is_cut_short),
        };
    }
    OK
}

/// Returns the status code of a state that was refused.
fn refused(error: &StateError) -> c_int {
    match error {
        StateError::Length { .. } => LENGTH,
        StateError::NotFinite { .. } => NOT_FINITE,
        StateError::Quaternion { .. } => QUATERNION,
        StateError::Open { .. } => OPEN,
        _ => STOPPED,
    }
}

/// Sets coordinates and velocities, and closes the loops.
///
/// # Safety
/// `solver` comes from `mbs_init`. `z` and `v` are aligned, have as many numbers as the arguments state, and do not overlap the solver's
/// memory. `report` is null or valid for writing a report.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_state(
    solver: *mut mbs_solver,
    z: *const Scalar,
    n_z: usize,
    v: *const Scalar,
    n_v: usize,
    report: *mut mbs_state_report,
) -> c_int {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    if z.is_null() || v.is_null() {
        return NULL;
    }
    if (n_z, n_v) != (own.solver.coordinates().len(), own.solver.velocities().len()) {
        return LENGTH;
    }
    // SAFETY: the pointers are not null, and the caller promised arrays of the lengths `n_z` and `n_v`.
    let (z, v) =
        unsafe { (core::slice::from_raw_parts(z, n_z), core::slice::from_raw_parts(v, n_v)) };
    let done = match own.solver.set_state(&own.model.model(), z, v) {
        Ok(done) => done,
        Err(error) => return refused(&error),
    };
    // SAFETY: a null pointer gives `None`; any other pointer is valid for writing a report, as the caller promised.
    if let Some(report) = unsafe { report.as_mut() } {
        *report = mbs_state_report {
            evaluations: done.evaluations,
            responses: done.responses,
            moved: done.moved,
            violation: done.violation,
        };
    }
    OK
}

/// Copies at most `n` numbers to the caller. Returns the number of numbers in `from`.
///
/// # Safety
/// `to` is null or valid for writing `n` numbers.
unsafe fn copy(from: &[Scalar], to: *mut Scalar, n: usize) -> usize {
    if !to.is_null() {
        for (i, x) in from.iter().take(n).enumerate() {
            // SAFETY: `i < n`, and `to` is valid for writing `n` numbers.
            unsafe { to.add(i).write(*x) };
        }
    }
    from.len()
}

/// Copies the point from which positions are measured to the caller, in global axes [m].
///
/// # Safety
/// The caller makes the promises of [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_base(solver: *const mbs_solver, to: *mut Scalar, n: usize) -> usize {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    let Some(own) = (unsafe { solver.as_ref() }) else { return 0 };
    let base = own.model.model().model().mechanism.base;
    // SAFETY: `to` is null or valid for writing `n` numbers, as the caller promised.
    unsafe { copy(&[base[0], base[1], base[2]], to, n) }
}

/// Copies the coordinates to the caller.
///
/// # Safety
/// `solver` comes from `mbs_init`; `to` is null or valid for writing `n` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_coordinates(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.coordinates(), to, n)) }
}

/// Copies the velocities to the caller.
///
/// # Safety
/// The caller makes the promises of [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_velocities(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.velocities(), to, n)) }
}

/// Copies the accelerations to the caller.
///
/// # Safety
/// The caller makes the promises of [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_accelerations(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.accelerations(), to, n)) }
}

/// Returns the time of the solver [s].
///
/// # Safety
/// `solver` is null or comes from `mbs_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_time(solver: *const mbs_solver) -> Scalar {
    // SAFETY: a null pointer gives `None`; any other pointer is valid, as the caller promised.
    unsafe { solver.as_ref() }.map_or(0.0, |own| own.solver.time())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
