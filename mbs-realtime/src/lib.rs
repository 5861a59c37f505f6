#![doc = include_str!("../README.md")]

mod clock;
mod ladder;
mod log;
mod pacer;
mod report;
mod sample;

pub use clock::{Clock, SystemClock, wait_until};
pub use ladder::Recovery;
pub use log::{Action, Entry};
pub use pacer::{Overrun, Pace, PaceError, Pacer, Task, Work};
pub use report::{Margin, Report, Spread};
pub use sample::nearest_rank;
