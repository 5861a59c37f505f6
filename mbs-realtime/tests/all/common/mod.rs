//! A scripted clock, and work of scripted durations that advances the clock.

use core::cell::Cell;
use core::ops::ControlFlow;
use mbs_realtime::{Clock, Task, Work};
use std::rc::Rc;
use std::time::Duration;

pub(crate) fn ms(n: u64) -> Duration {
    Duration::from_millis(n)
}

pub(crate) fn us(n: u64) -> Duration {
    Duration::from_micros(n)
}

/// Returns the instants at these times [ms].
pub(crate) fn at(times: &[u64]) -> Vec<Duration> {
    times.iter().map(|&t| ms(t)).collect()
}

/// A clock that the scripted work advances.
#[derive(Debug)]
pub(crate) struct ScriptedClock {
    time: Rc<Cell<Duration>>,
    /// Delay with which a sleeper wakes up.
    pub(crate) oversleeps: Duration,
}

impl Clock for ScriptedClock {
    fn now(&self) -> Duration {
        self.time.get()
    }

    fn sleep(&mut self, time: Duration) {
        self.time.set(self.time.get() + time + self.oversleeps);
    }

    fn pause(&mut self) {
        self.time.set(self.time.get() + us(1));
    }
}

/// Work that takes the scripted durations, and records the times of its calls.
#[derive(Debug)]
pub(crate) struct Script {
    time: Rc<Cell<Duration>>,
    durations: Vec<Duration>,
    pub(crate) fails_at: Option<u64>,
    pub(crate) stops_at: Option<u64>,
    pub(crate) begins: Vec<Duration>,
    pub(crate) levels: Vec<usize>,
    pub(crate) published: Vec<(u64, Duration)>,
}

impl Script {
    pub(crate) fn new(durations: Vec<Duration>) -> Self {
        let n = durations.len();
        Self {
            time: Rc::default(),
            durations,
            fails_at: None,
            stops_at: None,
            begins: Vec::with_capacity(n),
            levels: Vec::with_capacity(n),
            published: Vec::with_capacity(n),
        }
    }

    /// Returns the clock that this work advances.
    pub(crate) fn clock(&self) -> ScriptedClock {
        ScriptedClock { time: self.time.clone(), oversleeps: Duration::ZERO }
    }
}

impl Work for Script {
    type Error = &'static str;

    fn step(&mut self, task: Task) -> Result<ControlFlow<()>, Self::Error> {
        if self.fails_at == Some(task.index) {
            return Err("broken");
        }
        self.begins.push(self.time.get());
        self.levels.push(task.level);
        let takes = self.durations[usize::try_from(task.index).expect("a small number")];
        self.time.set(self.time.get() + takes);
        let is_last = self.stops_at == Some(task.index);
        Ok(if is_last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    fn publish(&mut self, task: Task) {
        self.published.push((task.index, self.time.get()));
    }
}
