//! The run of the firmware on the host. This program defines a panic handler. If the standard library were linked by mistake, its panic
//! handler would be the second one, which is a compile error.

#![no_std]
#![no_main]

#[path = "../../src/model.rs"]
mod model;
#[path = "../../src/run.rs"]
mod run;

use core::ffi::{c_int, c_void};
use core::fmt::{self, Write};
use mbs_nostd::table::LinkKind;
use mbs_nostd::{Bounds, operation_bound};

#[link(name = "c")]
unsafe extern "C" {
    fn write(file: c_int, bytes: *const c_void, n: usize) -> isize;
    fn abort() -> !;
}

/// Writer to the standard output.
struct Out;

impl fmt::Write for Out {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        // SAFETY: `write` of the C library reads `n` bytes, and the text has `n` bytes.
        let n = unsafe { write(1, text.as_ptr().cast(), text.len()) };
        if usize::try_from(n) == Ok(text.len()) { Ok(()) } else { Err(fmt::Error) }
    }
}

/// Writes the kind of each coordinate: m for a slide, r for an angle, q for one of the four numbers of a quaternion.
fn write_units() -> fmt::Result {
    write!(Out, "u")?;
    // Link 0 is the ground.
    for link in model::MODEL.mechanism.links.iter().skip(1) {
        Out.write_str(match link.kind {
            LinkKind::Revolute => " r",
            LinkKind::Prismatic => " m",
            LinkKind::Ball => " q q q q",
            LinkKind::Free if is_planar(link.kind) => " r m m",
            LinkKind::Free => " q q q q m m m",
            LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => "",
        })?;
    }
    writeln!(Out)
}

/// True if the free link is planar and has three coordinates.
fn is_planar(free: LinkKind) -> bool {
    free.n_coordinates::<model::Scalar, model::Axes>() == 3
}

/// Entry point that the C library calls.
#[unsafe(no_mangle)]
pub extern "C" fn main() -> c_int {
    let bound = operation_bound::step(&model::MODEL, Bounds::default());
    let is_double = size_of::<model::Scalar>() == 8;
    let is_sent =
        writeln!(Out, "b {}", bound.instructions(is_double)).is_ok() && write_units().is_ok();
    c_int::from(!is_sent || run::run(&mut Out, || 0).is_none())
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: `abort` has no preconditions.
    unsafe { abort() }
}
