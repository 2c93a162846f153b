//! The solution of linear systems for compiled code: addresses of C functions.

#![allow(
    unsafe_code,
    reason = "compiled code hands over the addresses of its arrays; their lengths follow from the number of rows"
)]

use std::slice;

use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use symbody_core::{Deficiency, FACTORIZATION_SOURCE, check_rows, factorization, positive_definite};

use crate::deficiency::note;
use crate::session::raise;

const ROWS: &str = "compiled code gives the number of rows, which is not negative";

/// Factorise the matrix of n rows at `work`.
unsafe extern "C" fn factor(n: i64, work: *mut f64) {
    let n = usize::try_from(n).expect(ROWS);
    let work = unsafe { slice::from_raw_parts_mut(work, factorization::workspace(n)) };
    if !positive_definite::factor(n, work) {
        factorization::factor(n, work);
    }
}

/// Solve for the right side at `x` with a factorised matrix; record a deficiency under the number of the system.
unsafe extern "C" fn solve(n: i64, work: *const f64, x: *mut f64, system: i64) {
    let n = usize::try_from(n).expect(ROWS);
    let work = unsafe { slice::from_raw_parts(work, factorization::workspace(n)) };
    let x = unsafe { slice::from_raw_parts_mut(x, n) };
    if !positive_definite::solve(n, work, x) {
        let system = u32::try_from(system).expect("compiled code numbers its systems by 32 bits");
        note(Deficiency::of(system, n, work, x));
        factorization::solve(n, work, x);
    }
}

/// The address of a C function: `factor(n, work)` or `solve(n, work, x, system)`, with 64-bit integers.
#[pyfunction]
fn kernel_address(name: &str) -> PyResult<usize> {
    match name {
        "factor" => Ok(factor as *const () as usize),
        "solve" => Ok(solve as *const () as usize),
        _ => Err(PyKeyError::new_err(name.to_owned())),
    }
}

/// The number of doubles that a matrix with this many rows and its factorisation take.
#[pyfunction]
fn kernel_workspace(py: Python<'_>, rows: usize) -> PyResult<usize> {
    raise(py, check_rows(rows))?;
    Ok(factorization::workspace(rows))
}

/// The Rust source of the kernel's factorisation, for generated Rust code.
#[pyfunction]
fn kernel_source() -> &'static str {
    FACTORIZATION_SOURCE
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(kernel_address, module)?)?;
    module.add_function(wrap_pyfunction!(kernel_source, module)?)?;
    module.add_function(wrap_pyfunction!(kernel_workspace, module)?)
}
