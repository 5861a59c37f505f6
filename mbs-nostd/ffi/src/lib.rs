//! mbs-nostd for programs in C; `include/mbs.h` says what each function does.
//!
//! This is the file that handles pointers. Callers promise by the header: a solver pointer is one that `mbs_init` gave and
//! whose memory is still there, and no two calls use it at once. Arrays are as long as they say. Null is looked for.

#![no_std]

use core::ffi::{c_int, c_void};
use mbs_nostd::{Bounds, InputError, Solver, Spatial, StateError, Tables, Unwatched};

#[cfg(feature = "single")]
type Scalar = f32;
#[cfg(not(feature = "single"))]
type Scalar = f64;

/// Room for a vehicle of about twenty bodies: change the numbers to fit a model, and build again.
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

/// What lives in the caller's memory.
#[allow(non_camel_case_types, reason = "the name in C")]
#[derive(Debug)]
pub struct mbs_solver {
    model: Model,
    solver: Room,
}

/// `mbs_report` of the header.
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

/// `mbs_state_report` of the header.
#[allow(non_camel_case_types, reason = "the name in C")]
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct mbs_state_report {
    evaluations: u32,
    responses: u32,
    moved: Scalar,
    violation: [Scalar; 3],
}

/// Says whether there is time for more.
type Watch = Option<unsafe extern "C" fn(*mut c_void) -> c_int>;

/// Bytes of a solver.
#[unsafe(no_mangle)]
pub extern "C" fn mbs_size() -> usize {
    size_of::<mbs_solver>()
}

/// Alignment of a solver.
#[unsafe(no_mangle)]
pub extern "C" fn mbs_align() -> usize {
    align_of::<mbs_solver>()
}

/// Reads a model into memory.
///
/// # Safety
/// `memory` has `size` bytes, `model` has `n`; nothing else uses `memory` while the solver is used.
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
    // SAFETY: the caller gave `n` bytes, and not null.
    let bytes = unsafe { core::slice::from_raw_parts(model, n) };
    let Ok(model) = Model::read(bytes) else { return MODEL };
    let Ok(room) = Room::new(&model.model()) else { return MODEL };
    // SAFETY: `place` is aligned and has room; `solver` is a place for a pointer.
    unsafe {
        place.write(mbs_solver { model, solver: room });
        solver.write(place);
    }
    OK
}

/// What became of a value that was to be set.
fn status(done: Result<(), InputError>) -> c_int {
    match done {
        Ok(()) => OK,
        Err(InputError::NotFinite { .. }) => NOT_FINITE,
        Err(_) => NO_INPUT,
    }
}

/// Writes a guide's motion.
///
/// # Safety
/// `solver` is one that `mbs_init` gave; `motion` has three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_guide(
    solver: *mut mbs_solver,
    guide: usize,
    motion: *const [Scalar; 3],
) -> c_int {
    // SAFETY: null is looked for; else as the caller promises.
    let (Some(own), Some(motion)) = (unsafe { solver.as_mut() }, unsafe { motion.as_ref() }) else {
        return NULL;
    };
    status(own.solver.set_guide(guide, *motion))
}

/// Writes a course's vector.
///
/// # Safety
/// As for [`mbs_set_guide`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_input(
    solver: *mut mbs_solver,
    course: usize,
    value: *const [Scalar; 3],
) -> c_int {
    // SAFETY: null is looked for; else as the caller promises.
    let (Some(own), Some(value)) = (unsafe { solver.as_mut() }, unsafe { value.as_ref() }) else {
        return NULL;
    };
    status(own.solver.set_input(course, *value))
}

/// Says how much work a step may be.
///
/// # Safety
/// `solver` is one that `mbs_init` gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_bounds(
    solver: *mut mbs_solver,
    evaluations: u32,
    sweeps: u32,
    projections: u32,
) -> c_int {
    // SAFETY: null is looked for; else as the caller promises.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    own.solver.bounds = Bounds { evaluations, sweeps, projections };
    OK
}

/// Makes a step.
///
/// # Safety
/// `solver` is one that `mbs_init` gave; `report` is null or a place for one; `watch` may be called with `context`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_step(
    solver: *mut mbs_solver,
    dt: Scalar,
    watch: Watch,
    context: *mut c_void,
    report: *mut mbs_report,
) -> c_int {
    // SAFETY: null is looked for; else as the caller promises.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    let model = own.model.model();
    let done = match watch {
        None => own.solver.step(&model, dt, &mut Unwatched),
        Some(watch) => {
            // SAFETY: the caller lets it be called.
            let mut has_time = || unsafe { watch(context) } != 0;
            own.solver.step(&model, dt, &mut has_time)
        }
    };
    let Ok(done) = done else { return STOPPED };
    // SAFETY: null is looked for; else a place for a report.
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

/// The code of a state that is refused.
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
/// `solver` is one that `mbs_init` gave; `z` and `v` are aligned, have as many numbers as they say, and stand outside the solver's memory;
/// `report` is null or a place for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_set_state(
    solver: *mut mbs_solver,
    z: *const Scalar,
    n_z: usize,
    v: *const Scalar,
    n_v: usize,
    report: *mut mbs_state_report,
) -> c_int {
    // SAFETY: null is looked for; else as the caller promises.
    let Some(own) = (unsafe { solver.as_mut() }) else { return NULL };
    if z.is_null() || v.is_null() {
        return NULL;
    }
    if (n_z, n_v) != (own.solver.coordinates().len(), own.solver.velocities().len()) {
        return LENGTH;
    }
    // SAFETY: not null, and the caller gave as many numbers, which the model has.
    let (z, v) =
        unsafe { (core::slice::from_raw_parts(z, n_z), core::slice::from_raw_parts(v, n_v)) };
    let done = match own.solver.set_state(&own.model.model(), z, v) {
        Ok(done) => done,
        Err(error) => return refused(&error),
    };
    // SAFETY: null is looked for; else a place for a report.
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

/// Copies numbers out.
///
/// # Safety
/// `to` is null or has `n` places.
unsafe fn copy(from: &[Scalar], to: *mut Scalar, n: usize) -> usize {
    if !to.is_null() {
        for (i, x) in from.iter().take(n).enumerate() {
            // SAFETY: `i < n`.
            unsafe { to.add(i).write(*x) };
        }
    }
    from.len()
}

/// Copies the point that positions are counted from.
///
/// # Safety
/// As for [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_base(solver: *const mbs_solver, to: *mut Scalar, n: usize) -> usize {
    // SAFETY: null is looked for; else as the caller promises.
    let Some(own) = (unsafe { solver.as_ref() }) else { return 0 };
    let base = own.model.model().model().mechanism.base;
    // SAFETY: as the caller promises.
    unsafe { copy(&[base[0], base[1], base[2]], to, n) }
}

/// Copies the coordinates.
///
/// # Safety
/// `solver` is one that `mbs_init` gave; `to` is null or has `n` places.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_coordinates(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: null is looked for; else as the caller promises.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.coordinates(), to, n)) }
}

/// Copies the velocities.
///
/// # Safety
/// As for [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_velocities(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: null is looked for; else as the caller promises.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.velocities(), to, n)) }
}

/// Copies the accelerations.
///
/// # Safety
/// As for [`mbs_coordinates`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_accelerations(
    solver: *const mbs_solver,
    to: *mut Scalar,
    n: usize,
) -> usize {
    // SAFETY: null is looked for; else as the caller promises.
    unsafe { solver.as_ref().map_or(0, |own| copy(own.solver.accelerations(), to, n)) }
}

/// The time [s].
///
/// # Safety
/// `solver` is null or one that `mbs_init` gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mbs_time(solver: *const mbs_solver) -> Scalar {
    // SAFETY: null is looked for; else as the caller promises.
    unsafe { solver.as_ref() }.map_or(0.0, |own| own.solver.time())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
