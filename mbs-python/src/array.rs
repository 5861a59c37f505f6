//! Arrays in and out: one state or many in one call.

use crate::error::usage;
use numpy::{IntoPyArray, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

/// Numbers of an argument, in the order of rows: a copy, since another thread may write into the array while these are used.
#[derive(Debug)]
pub(crate) struct Numbers {
    data: Vec<f64>,
    shape: Vec<usize>,
}

impl Numbers {
    /// Takes an argument of Python: doubles in the order of rows as they are; anything else is converted, or refused where `strict`.
    pub(crate) fn new(value: &Bound<'_, PyAny>, name: &str, strict: bool) -> PyResult<Self> {
        // arrays of other classes may mean more than their numbers
        if value.is_exact_instance_of::<PyUntypedArray>()
            && let Ok(array) = value.cast::<PyArrayDyn<f64>>()
            && array.is_c_contiguous()
            && is_aligned(array)
        {
            return Self::copied(array);
        }
        if strict {
            let message = format!("{name} is no array of float64 in the order of rows (C)");
            return Err(PyTypeError::new_err(message));
        }
        let py = value.py();
        let converted = converted(value).map_err(|error| {
            let refuses = error.is_instance_of::<PyTypeError>(py);
            if !refuses && !error.is_instance_of::<PyValueError>(py) {
                // an interrupt, say
                return error;
            }
            let message = format!("{name} is no array of numbers: {}", error.value(py));
            usage(py, "wrong-type", &message, "give numbers", name)
        })?;
        Self::copied(&converted)
    }

    /// Refuses an infinite number or none.
    pub(crate) fn check_finite(&self, py: Python<'_>, name: &str) -> PyResult<()> {
        let Some(mut place) = self.data.iter().position(|x| !x.is_finite()) else { return Ok(()) };
        let mut places = Vec::new();
        for n in self.shape.iter().rev() {
            places.insert(0, (place % n).to_string());
            place /= n;
        }
        let message = format!("{name}[{}] is not finite", places.join(", "));
        Err(usage(py, "not-finite", &message, "give finite numbers", name))
    }

    pub(crate) fn into_data(self) -> Vec<f64> {
        self.data
    }

    fn copied(array: &Bound<'_, PyArrayDyn<f64>>) -> PyResult<Self> {
        Ok(Self { data: array.to_vec()?, shape: array.shape().to_vec() })
    }

    pub(crate) fn shape(&self) -> &[usize] {
        &self.shape
    }

    pub(crate) fn slice(&self) -> &[f64] {
        &self.data
    }

    /// The numbers of an argument with exactly `n` of them.
    pub(crate) fn row(value: &Bound<'_, PyAny>, name: &str, n: usize) -> PyResult<Vec<f64>> {
        let numbers = Self::new(value, name, false)?;
        if numbers.shape() != [n] {
            return Err(wrong_shape(value.py(), name, numbers.shape(), &format!("({n},)")));
        }
        numbers.check_finite(value.py(), name)?;
        Ok(numbers.into_data())
    }
}

/// Kinds of numpy whose values are real numbers: truths, integers with and without sign, floats.
const REAL: [char; 4] = ['b', 'i', 'u', 'f'];

/// Do its numbers stand where numbers may?
fn is_aligned(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    array.data().is_aligned()
}

/// The argument as doubles in the order of rows.
fn converted<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    static CONVERT: PyOnceLock<[Py<PyAny>; 2]> = PyOnceLock::new();
    let py = value.py();
    let [convert, is_masked] = CONVERT.get_or_try_init(py, || {
        let numpy = py.import("numpy")?;
        let is_masked = numpy.getattr("ma")?.getattr("is_masked")?;
        Ok::<_, PyErr>([numpy.getattr("asarray")?.unbind(), is_masked.unbind()])
    })?;
    if value.hasattr("mask")? && is_masked.bind(py).call1((value,))?.is_truthy()? {
        return Err(PyTypeError::new_err("some of it is masked"));
    }
    let options = PyDict::new(py);
    options.set_item("order", "C")?;
    let array = convert.bind(py).call((value,), Some(&options))?;
    let dtype = array.getattr("dtype")?;
    let kind: char = dtype.getattr("kind")?.extract()?;
    if !REAL.contains(&kind) {
        return Err(PyTypeError::new_err(format!("it is of {dtype}")));
    }
    let array = convert.bind(py).call((array, numpy::dtype::<f64>(py)), Some(&options))?;
    let array = array.cast_into::<PyArrayDyn<f64>>()?;
    if is_aligned(&array) {
        return Ok(array);
    }
    Ok(array.call_method0("copy")?.cast_into::<PyArrayDyn<f64>>()?)
}

/// A refusal of a shape.
pub(crate) fn wrong_shape(py: Python<'_>, name: &str, found: &[usize], expected: &str) -> PyErr {
    let found: Vec<String> = found.iter().map(usize::to_string).collect();
    let found = match &found[..] {
        [one] => format!("({one},)"),
        all => format!("({})", all.join(", ")),
    };
    let message = format!("{name} has the shape {found}, and {expected} is expected");
    let hint = "`nq`, `nv` and `nu` of the mechanism are the numbers of a state";
    usage(py, "wrong-shape", &message, hint, name)
}

/// Arguments of one state or of k states each.
#[derive(Debug)]
pub(crate) struct States {
    arguments: Vec<(Numbers, usize, bool)>,
    /// Number of the states; `None`: one, without a dimension of its own.
    k: Option<usize>,
}

impl States {
    /// Takes arguments with their names and numbers of a state.
    pub(crate) fn new(
        arguments: &[(&Bound<'_, PyAny>, &str, usize)],
        strict: bool,
    ) -> PyResult<Self> {
        let (mut taken, mut k) = (Vec::new(), None);
        for (value, name, n) in arguments {
            let numbers = Numbers::new(value, name, strict)?;
            let many = match *numbers.shape() {
                [found] if found == *n => None,
                [rows, found] if found == *n => Some(rows),
                _ => {
                    let expected = format!("({n},) or (k, {n})");
                    return Err(wrong_shape(value.py(), name, numbers.shape(), &expected));
                }
            };
            if let (Some(rows), Some(before)) = (many, k)
                && rows != before
            {
                let expected = format!("({before}, {n})");
                return Err(wrong_shape(value.py(), name, numbers.shape(), &expected));
            }
            k = many.or(k);
            taken.push((numbers, *n, many.is_some()));
        }
        Ok(Self { arguments: taken, k })
    }

    /// Number of states.
    pub(crate) fn len(&self) -> usize {
        self.k.unwrap_or(1)
    }

    /// Is there a dimension of states?
    pub(crate) fn k(&self) -> Option<usize> {
        self.k
    }

    /// Refuses the first argument that has an infinite number or none.
    pub(crate) fn check_finite(&self, py: Python<'_>, names: &[&str]) -> PyResult<()> {
        let mut named = self.arguments.iter().zip(names);
        named.try_for_each(|((numbers, ..), name)| numbers.check_finite(py, name))
    }

    /// All arguments, to be read without the interpreter.
    pub(crate) fn rows(&self) -> Rows<'_> {
        Rows(self.arguments.iter().map(|(x, n, many)| (x.slice(), *n, *many)).collect())
    }
}

/// The numbers of some states.
#[derive(Debug)]
pub(crate) struct Rows<'a>(Vec<(&'a [f64], usize, bool)>);

impl Rows<'_> {
    /// Argument `i` of state `k`.
    pub(crate) fn get(&self, i: usize, k: usize) -> &[f64] {
        let (numbers, n, many) = self.0[i];
        if many { &numbers[k * n..][..n] } else { numbers }
    }
}

/// An array of a shape that owns its numbers.
pub(crate) fn array<'py>(
    py: Python<'py>,
    data: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let array = data.into_pyarray(py);
    if shape.len() == 1 {
        return Ok(array.into_any());
    }
    Ok(array.reshape(shape.to_vec())?.into_any())
}

/// An array of numbers in a row.
pub(crate) fn vector<'py>(py: Python<'py>, data: &[f64]) -> Bound<'py, PyAny> {
    numpy::PyArray1::from_slice(py, data).into_any()
}

/// A point of three numbers; in the plane of two as well.
pub(crate) fn point(at: &Bound<'_, PyAny>, dimension: usize) -> PyResult<[f64; 3]> {
    let numbers = Numbers::new(at, "at", false)?;
    numbers.check_finite(at.py(), "at")?;
    let is_row = numbers.shape().len() == 1;
    match *numbers.slice() {
        [x, y] if is_row && dimension == 2 => Ok([x, y, 0.0]),
        [x, y, z] if is_row => Ok([x, y, z]),
        _ => {
            let expected = if dimension == 2 { "(2,) or (3,)" } else { "(3,)" };
            Err(wrong_shape(at.py(), "at", numbers.shape(), expected))
        }
    }
}

/// A count as an argument: a negative number is refused.
pub(crate) fn count(py: Python<'_>, name: &str, number: i64) -> PyResult<usize> {
    usize::try_from(number).map_err(|_| {
        let message = format!("{name} is {number}");
        usage(py, "no-count", &message, "give a whole number, zero or more", name)
    })
}
