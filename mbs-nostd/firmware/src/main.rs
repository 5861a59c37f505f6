//! A run of a model on an emulated Cortex-M. The program prints the lines of `run`, and the stack that was used:
//!
//! ```text
//! m STACK     bytes of stack that were used
//! ```

#![no_std]
#![no_main]

mod model;
mod run;
mod stack;
mod timer;

use core::fmt::Write;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hio};

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
    let clock = || {
        let spent = timer.since(last) * timer::INSTRUCTIONS_PER_TICK;
        last = timer.now();
        spent
    };
    run::run(&mut out, clock)?;
    writeln!(out, "m {}", stack::used()).ok()
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}
