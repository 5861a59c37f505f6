//! Rollouts: motions from many starts over threads.

use crate::array::{Numbers, States, array, count, wrong_shape};
use crate::error::{Class, exception, fields, guarded, internal, raised, unknown_name, usage};
use crate::mechanism::Mechanism;
use crate::values;
use crate::watch::{Reached, silent, whole};
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use mbs::parallel::ensemble::Ensemble;
use mbs::{IntegratorKind, Interrupt, Rollout, RolloutEnd, Tree};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

/// The last pool of threads, and its process: a fork has none of its parent's threads.
static POOL: Mutex<Option<(u32, Arc<Ensemble>)>> = Mutex::new(None);

/// The pool of so many threads; zero: one for each processor.
fn pool(py: Python<'_>, threads: usize) -> PyResult<Arc<Ensemble>> {
    let threads = NonZeroUsize::new(threads.min(mbs::parallel::most_threads()));
    let threads = threads.unwrap_or_else(mbs::parallel::ensemble::available);
    let this = std::process::id();
    let last = || POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*last()
        && *process == this
        && pool.threads() == threads
    {
        return Ok(pool.clone());
    }
    let made = Ensemble::new(Some(threads));
    let made = Arc::new(made.map_err(|error| raised(py, &error.into(), Class::Usage))?);
    let before = last().replace((this, made.clone()));
    if let Some((process, pool)) = before
        && process != this
    {
        // its threads are the parent's: to end them here would wait for ever
        core::mem::forget(pool);
    }
    Ok(made)
}

/// The inputs of a batch: none, one row, a row for each step, or rows for each start.
fn inputs(
    py: Python<'_>,
    u: Option<&Bound<'_, PyAny>>,
    (k, nu): (usize, usize),
    steps: Option<usize>,
) -> PyResult<(Option<Numbers>, usize, bool)> {
    let Some(u) = u else {
        let Some(steps) = steps else {
            let message = "nothing says how many steps are to be made";
            return Err(usage(py, "no-count", message, "give u, or steps", "steps"));
        };
        return Ok((None, steps, false));
    };
    let numbers = Numbers::new(u, "u", false)?;
    numbers.check_finite(py, "u")?;
    let (found, many) = match *numbers.shape() {
        [rows, n] if n == nu => (rows, false),
        [starts, rows, n] if n == nu && starts == k => (rows, true),
        _ => {
            let expected = format!("(steps, {nu}) or ({k}, steps, {nu})");
            return Err(wrong_shape(u.py(), "u", numbers.shape(), &expected));
        }
    };
    if let Some(steps) = steps
        && steps != found
    {
        let message = format!("u is of {found} steps, and steps is {steps}");
        return Err(usage(u.py(), "wrong-shape", &message, "leave steps out", "steps"));
    }
    Ok((Some(numbers), found, many))
}

/// Room for k motions, in q and in v, with the numbers of each; nothing where there is none.
fn rooms(k: usize, n_steps: usize, [n_q, n_v]: [usize; 2]) -> Option<([usize; 2], [Vec<f64>; 2])> {
    let size = |n: usize| n_steps.checked_add(1)?.checked_mul(n);
    let room = |n: usize| {
        let (n, mut rows) = (n.checked_mul(k)?, Vec::new());
        rows.try_reserve_exact(n).ok()?;
        rows.resize(n, f64::NAN);
        Some(rows)
    };
    let (q, v) = (size(n_q)?, size(n_v)?);
    Some(([q, v], [room(q)?, room(v)?]))
}

#[pymethods]
impl Mechanism {
    /// Motions from k starts by equal steps of `dt` [s], with all effects; `u` (k, steps, nu), or (steps, nu) for all, is held over each step.
    /// The numbers do not depend on the number of threads; 0: all processors. `client` is a client of Dask, or "ray": starts then go there in
    /// chunks. `f_ext` are forces and moments on frames or bodies, {NAME: (force, moment)} or {NAME: (steps, 6)}, as in `accelerations`.
    #[pyo3(signature = (q, v, u = None, dt = 1e-3, *, steps = None, threads = 0, client = None, integrator = "rk4", f_ext = None))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn rollout<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        u: Option<&Bound<'py, PyAny>>,
        dt: f64,
        steps: Option<i64>,
        threads: i64,
        client: Option<&Bound<'py, PyAny>>,
        integrator: &str,
        f_ext: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let words = elsewhere(py, (steps, client, integrator))?;
        if let Some(f_ext) = f_ext {
            words.set_item("threads", threads)?;
            let rollout = py.import("multibody.external")?.getattr("rollout")?;
            return rollout.call((self.clone(), f_ext, q, v, u, dt), Some(&words));
        }
        let threads = count(py, "threads", threads)?;
        let steps = steps.map(|steps| count(py, "steps", steps)).transpose()?;
        if !(dt > 0.0 && dt.is_finite()) {
            let message = format!("dt is {dt} s");
            return Err(usage(py, "bad-step", &message, "give a number larger than zero", "dt"));
        }
        let kind = kind(py, integrator)?;
        let first = self.first(py)?;
        let (nq, nv) = (first.coordinates().len(), first.velocities().len());
        let states = States::new(&[(q, "q", nq), (v, "v", nv)], false)?;
        states.check_finite(py, &["q", "v"])?;
        let k = states.len();
        let nu = self.shared.inputs.len();
        let given = u;
        let taken = inputs(py, u, (k, nu), steps);
        let (u, n_steps, many) = taken.map_err(|error| self.about_inputs(py, error))?;
        if client.is_some() {
            let rollout = py.import("multibody.parallel")?.getattr("rollout")?;
            return rollout.call((self.clone(), q, v, given, dt), Some(&words));
        }
        let of_all = u.as_ref().map_or(&[][..], Numbers::slice);
        let rows = states.rows();
        let flag = Arc::new(AtomicBool::new(false));
        let interrupt = Interrupt::new(flag.clone());
        let task = |i: usize| Rollout {
            q: rows.get(0, i),
            v: rows.get(1, i),
            inputs: if many { &of_all[i * n_steps * nu..][..n_steps * nu] } else { of_all },
            step: dt,
            n_steps,
            integrator: kind,
            interrupt: Some(&interrupt),
        };
        let Some((sizes, mut all)) = rooms(k, n_steps, [nq, nv]) else {
            let message = format!("{k} motions of {n_steps} steps have no room in memory");
            return Err(usage(py, "too-large", &message, "ask for fewer at a time", "steps"));
        };
        let pool = if threads == 1 || k <= 1 { None } else { Some(pool(py, threads)?) };
        let batch = Batch { first, k, sizes, pool, interrupt: &interrupt };
        let ends = if k.saturating_mul(n_steps) > LONG {
            whole(py, &flag, &silent(&Reached::default()), || batch.motions(&mut all, &task))?
        } else {
            guarded(py, || Ok(py.detach(|| batch.motions(&mut all, &task))))?
        };
        let (errors, ok) = errors(py, &ends.map_err(|message| internal(py, &message))?)?;
        let [all_q, all_v] = all;
        let all_q = array(py, all_q, &[k, n_steps + 1, nq])?;
        let all_v = array(py, all_v, &[k, n_steps + 1, nv])?;
        values::make(py, "Rollout", (all_q, all_v, ok, errors))
    }
}

/// The words of a rollout that another function makes.
fn elsewhere<'py>(
    py: Python<'py>,
    (steps, client, integrator): (Option<i64>, Option<&Bound<'py, PyAny>>, &str),
) -> PyResult<Bound<'py, PyDict>> {
    let words = PyDict::new(py);
    words.set_item("steps", steps)?;
    words.set_item("client", client)?;
    words.set_item("integrator", integrator)?;
    Ok(words)
}

/// The integrator of a name.
fn kind(py: Python<'_>, name: &str) -> PyResult<IntegratorKind> {
    let kind = IntegratorKind::ALL.into_iter().find(|kind| kind.name() == name);
    kind.ok_or_else(|| {
        let named = ("integrator", name);
        unknown_name(py, ["integrator", "integrators"], named, &mbs::INTEGRATORS)
    })
}

/// The errors of motions by their places, and which of them came to their ends.
fn errors<'py>(
    py: Python<'py>,
    ends: &[Option<RolloutEnd>],
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyArray1<bool>>)> {
    let errors = PyDict::new(py);
    for (i, end) in ends.iter().enumerate().filter_map(|(i, end)| Some((i, end.as_ref()?))) {
        let class = if end.steps.is_some() { Class::Stop } else { Class::Start };
        errors.set_item(i, exception(py, class, &fields(&end.error)).value(py))?;
    }
    Ok((errors, PyArray1::from_vec(py, ends.iter().map(Option::is_none).collect())))
}

/// Steps in one call beyond which interrupts are heard [-]: shorter calls end by themselves.
const LONG: usize = 100;

/// Motions to be made.
struct Batch<'a> {
    first: &'a Tree,
    k: usize,
    /// Numbers of a motion in q and in v.
    sizes: [usize; 2],
    /// Pool of threads; without one, the caller's own thread.
    pool: Option<Arc<Ensemble>>,
    interrupt: &'a Interrupt,
}

/// Why each motion ended early, where it did; else the message of a panic.
type Ends = Result<Vec<Option<RolloutEnd>>, String>;

impl Batch<'_> {
    fn motions<'a>(
        &self,
        [all_q, all_v]: &mut [Vec<f64>; 2],
        task: &(impl Fn(usize) -> Rollout<'a> + Sync),
    ) -> Ends {
        let [n_q, n_v] = self.sizes;
        let one = |tree: &mut Tree, i: usize, q: &mut [f64], v: &mut [f64]| {
            // behind an interrupt the rest is not asked for
            (!self.interrupt.is_set()).then(|| tree.rollout(&task(i), q, v).err()).flatten()
        };
        let Some(pool) = &self.pool else {
            let mut tree = self.first.clone();
            let each = |i: usize| {
                let (q, v) = (&mut all_q[n_q * i..][..n_q], &mut all_v[n_v * i..][..n_v]);
                one(&mut tree, i, q, v)
            };
            return Ok((0..self.k).map(each).collect());
        };
        let trees: Mutex<Vec<Tree>> = Mutex::new(Vec::new());
        let jobs: Vec<usize> = (0..self.k).collect();
        let mut ends: Vec<Option<RolloutEnd>> = Vec::new();
        ends.resize_with(self.k, || None);
        let mut panicked = None;
        let job = |i: usize| {
            let spare = || trees.lock().unwrap_or_else(PoisonError::into_inner);
            let tree = spare().pop();
            let mut tree = tree.unwrap_or_else(|| self.first.clone());
            let (mut q, mut v) = (vec![0.0; n_q], vec![0.0; n_v]);
            let end = one(&mut tree, i, &mut q, &mut v);
            spare().push(tree);
            (q, v, end)
        };
        pool.run(&jobs, job, |i, done| {
            match done {
                Ok((q, v, end)) => {
                    all_q[n_q * i..][..n_q].copy_from_slice(&q);
                    all_v[n_v * i..][..n_v].copy_from_slice(&v);
                    ends[i] = end;
                }
                Err(panic) => panicked = Some(panic.message().to_owned()),
            }
            ControlFlow::Continue(())
        });
        panicked.map_or(Ok(ends), Err)
    }
}
