//! Instructions by the system timer: the emulator runs one in a nanosecond of its time, the timer ticks at 25 MHz.

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{Peripherals, SYST};

/// Instructions in a tick, with `-icount shift=0` on boards of 25 MHz.
pub const INSTRUCTIONS_PER_TICK: u32 = 40;

/// The counter has 24 bits.
const MASK: u32 = 0x00ff_ffff;

/// The running timer.
#[derive(Debug)]
pub struct Timer(());

impl Timer {
    /// Starts it.
    pub fn start() -> Self {
        if let Some(mut peripherals) = Peripherals::take() {
            let timer = &mut peripherals.SYST;
            timer.set_clock_source(SystClkSource::Core);
            timer.set_reload(MASK);
            timer.clear_current();
            timer.enable_counter();
        }
        Self(())
    }

    /// What it stands at: it counts down.
    pub fn now(&self) -> u32 {
        SYST::get_current()
    }

    /// Ticks since it stood at `before`, up to 671 million instructions.
    pub fn since(&self, before: u32) -> u32 {
        before.wrapping_sub(self.now()) & MASK
    }
}
