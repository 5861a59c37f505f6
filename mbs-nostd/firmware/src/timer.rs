//! Instruction count by the system timer. The emulator runs one instruction in a nanosecond of emulated time, and the timer ticks at 25 MHz
//! of emulated time.

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{Peripherals, SYST};

/// Number of instructions in a tick, with `-icount shift=0` on boards of 25 MHz.
pub const INSTRUCTIONS_PER_TICK: u32 = 40;

/// Largest value of the counter, which has 24 bits.
const MASK: u32 = 0x00ff_ffff;

/// Access to the system timer after its start.
#[derive(Debug)]
pub struct Timer(());

impl Timer {
    /// Starts the system timer.
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

    /// Returns the counter, which counts down.
    pub fn now(&self) -> u32 {
        SYST::get_current()
    }

    /// Returns the number of ticks since the counter was `before`. It is correct for up to 671 million instructions.
    pub fn since(&self, before: u32) -> u32 {
        before.wrapping_sub(self.now()) & MASK
    }
}
