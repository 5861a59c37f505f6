//! Long work: on a thread of its own, without the interpreter, while this one hears of interrupts and reports progress.

use crate::error::internal;
use core::ops::ControlFlow;
use core::time::Duration;
use mbs_parallel::{apart, beside};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// Time between two looks [s]: an interrupt is to be heard within 0.1 s.
const PERIOD: Duration = Duration::from_millis(50);
/// Looks from one report of progress to the next: at most ten reports a second.
const LOOKS: u32 = 2;

/// How far some work is: two numbers, of which the second is the whole.
#[derive(Debug, Default)]
pub(crate) struct Reached([AtomicU64; 2]);

impl Reached {
    pub(crate) fn set(&self, done: f64, whole: f64) {
        self.0[0].store(done.to_bits(), Ordering::Relaxed);
        self.0[1].store(whole.to_bits(), Ordering::Relaxed);
    }

    fn get(&self) -> [f64; 2] {
        [0, 1].map(|i| f64::from_bits(self.0[i].load(Ordering::Relaxed)))
    }
}

/// Report of progress during work.
#[derive(Debug)]
pub(crate) struct Progress<'a, 'py> {
    /// Called with how far it is, at most ten times a second, and at its end.
    pub(crate) call: Option<&'a Bound<'py, PyAny>>,
    /// Are the numbers counts?
    pub(crate) counts: bool,
    pub(crate) reached: &'a Reached,
}

impl Progress<'_, '_> {
    fn report(&self, py: Python<'_>) -> PyResult<()> {
        let Some(call) = self.call else { return Ok(()) };
        let numbers = self.reached.get();
        if self.counts {
            #[allow(clippy::cast_possible_truncation, reason = "whole numbers")]
            let [done, whole] = numbers.map(|x| x as i64);
            call.clone().into_any().unbind().call1(py, (done, whole))?;
        } else {
            call.clone().into_any().unbind().call1(py, (numbers[0], numbers[1]))?;
        }
        Ok(())
    }
}

/// Does some work, and hears of interrupts while it goes: they set the flag, which ends the work, and are raised behind it. What the work gave
/// comes beside them.
pub(crate) fn watched<R: Send>(
    py: Python<'_>,
    flag: &AtomicBool,
    progress: &Progress<'_, '_>,
    work: impl FnOnce() -> R + Send,
) -> PyResult<(R, Option<PyErr>)> {
    let mut raised: Option<PyErr> = None;
    let mut looks = 0;
    let call = progress.call.map(|call| call.clone().unbind());
    let progress_of = (call.as_ref(), progress.counts, progress.reached);
    let done = py.detach(|| {
        beside(work, PERIOD, || {
            if raised.is_some() {
                return;
            }
            looks += 1;
            let heard = Python::attach(|py| {
                py.check_signals()?;
                let (call, counts, reached) = progress_of;
                let call = call.map(|call| call.bind(py));
                if looks % LOOKS == 0 {
                    return Progress { call, counts, reached }.report(py);
                }
                Ok(())
            });
            if let Err(error) = heard {
                flag.store(true, Ordering::Relaxed);
                raised = Some(error);
            }
        })
    });
    flag.store(false, Ordering::Relaxed);
    let done = done.map_err(|panic| internal(py, panic.message()))?;
    if raised.is_none() {
        // what came after the last look
        raised = py.check_signals().and_then(|()| progress.report(py)).err();
    }
    Ok((done, raised))
}

/// Does some work as `watched` does, where there is no result but a whole one.
pub(crate) fn whole<R: Send>(
    py: Python<'_>,
    flag: &AtomicBool,
    progress: &Progress<'_, '_>,
    work: impl FnOnce() -> R + Send,
) -> PyResult<R> {
    match watched(py, flag, progress, work)? {
        (done, None) => Ok(done),
        (_, Some(error)) => Err(error),
    }
}

/// Does some work that looks at no flag: an interrupt leaves it to itself.
pub(crate) fn left<R: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<R> {
    let mut raised = None;
    let done = py.detach(|| {
        apart(work, PERIOD, || match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                raised = Some(error);
                ControlFlow::Break(())
            }
        })
    });
    let done = done.map_err(|panic| internal(py, panic.message()))?;
    done.ok_or_else(|| raised.unwrap_or_else(|| internal(py, "it was left without a reason")))
}

/// Hears of interrupts in a loop without the interpreter.
#[derive(Debug)]
pub(crate) struct Ear {
    looked: Instant,
    heard: Instant,
    /// Turns from one look at the clock to the next, and those that are left of them.
    stride: u32,
    left: u32,
}

/// Time from one look at the clock to the next [s]: some looks to a period.
const PACE: Duration = Duration::from_millis(10);
/// Most turns from one look to the next [-]: a look then costs a turn less than a nanosecond, and turns may get slower by far.
const MOST_TURNS: u32 = 64;

impl Ear {
    pub(crate) fn new() -> Self {
        let now = Instant::now();
        Self { looked: now, heard: now, stride: 1, left: 1 }
    }

    /// Between two turns of the loop; an error is an interrupt, which ends it.
    pub(crate) fn turn(&mut self) -> PyResult<()> {
        self.left -= 1;
        if self.left > 0 {
            return Ok(());
        }
        let now = Instant::now();
        let is_early = now - self.looked < PACE;
        self.stride =
            if is_early { (2 * self.stride).min(MOST_TURNS) } else { self.stride.div_ceil(2) };
        (self.looked, self.left) = (now, self.stride);
        if now - self.heard < PERIOD {
            return Ok(());
        }
        self.heard = now;
        Python::attach(|py| py.check_signals())
    }
}

/// No progress to be reported.
pub(crate) fn silent(reached: &Reached) -> Progress<'_, '_> {
    Progress { call: None, counts: false, reached }
}
