//! Python values as expressions and numbers as Python values.

use num_bigint::BigInt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt};
use symbody_core::{Id, Number};

use crate::expr::Expr;
use crate::session::{raise, with_graph};

/// An argument that may be an expression or a number.
pub struct Operand(pub Id);

impl<'a, 'py> FromPyObject<'a, 'py> for Operand {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(expr) = object.cast::<Expr>() {
            return Ok(Self(expr.get().0));
        }
        let number = number(&object)?;
        Ok(Self(with_graph(|graph| graph.number(&number))))
    }
}

/// A Python or `NumPy` number: exact integers and fractions, doubles as the decimals that print them.
pub fn number(object: &Bound<'_, PyAny>) -> PyResult<Number> {
    let py = object.py();
    if object.is_instance_of::<PyBool>() {
        return Err(not_a_number(object));
    }
    if let Ok(value) = object.cast::<PyFloat>() {
        return raise(py, Number::from_f64(value.extract()?));
    }
    if object.is_instance_of::<PyInt>() {
        return integer(object);
    }
    if let (Ok(num), Ok(den)) = (object.getattr("numerator"), object.getattr("denominator")) {
        let num: Result<BigInt, _> = num.extract();
        let den: Result<BigInt, _> = den.extract();
        if let (Ok(num), Ok(den)) = (num, den) {
            return raise(py, Number::from_big(num, den));
        }
    }
    if object.hasattr("dtype")? && object.getattr("ndim")?.extract::<usize>()? == 0 {
        let plain = object.call_method0("item")?;
        if plain.is_instance_of::<PyFloat>() || plain.is_instance_of::<PyInt>() {
            return number(&plain);
        }
    }
    Err(not_a_number(object))
}

fn integer(object: &Bound<'_, PyAny>) -> PyResult<Number> {
    if let Ok(value) = object.extract::<i64>() {
        return Ok(Number::integer(value));
    }
    raise(object.py(), Number::from_big(object.extract()?, 1.into()))
}

fn not_a_number(object: &Bound<'_, PyAny>) -> PyErr {
    let kind = object.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let text = object.repr().map_or_else(|_| String::new(), |repr| repr.to_string());
    PyTypeError::new_err(format!(
        "{text} is a {kind}; expected an expression or a number (int, float, Fraction, NumPy scalar)"
    ))
}
