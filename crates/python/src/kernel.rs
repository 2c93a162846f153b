//! The solution of linear systems for compiled code: addresses of C functions, and what they have to tell.

#![allow(
    unsafe_code,
    reason = "compiled code hands over the addresses of its arrays; their lengths follow from the number of rows"
)]

use std::collections::BTreeSet;
use std::slice;
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use symbody_core::{factorization, positive_definite};

/// A system, by its tag, and its equations that follow from others.
type Deficiency = (i64, Vec<usize>);

/// What was found since it was last asked for, by all threads.
static DEFICIENCIES: Mutex<BTreeSet<Deficiency>> = Mutex::new(BTreeSet::new());

/// Factorise the matrix of n rows at `work`; remember under the tag which equations follow from others.
unsafe extern "C" fn factor(n: i64, work: *mut f64, tag: i64) {
    let n = usize::try_from(n).unwrap_or(0);
    let work = unsafe { slice::from_raw_parts_mut(work, factorization::workspace(n)) };
    if !positive_definite::factor(n, work) && factorization::factor(n, work) > 0 {
        let deficiency = (tag, factorization::dependent(n, work).collect());
        DEFICIENCIES.lock().unwrap_or_else(PoisonError::into_inner).insert(deficiency);
    }
}

/// Solve for the right side at `x` with a factorised matrix.
unsafe extern "C" fn solve(n: i64, work: *const f64, x: *mut f64) {
    let n = usize::try_from(n).unwrap_or(0);
    let work = unsafe { slice::from_raw_parts(work, factorization::workspace(n)) };
    let x = unsafe { slice::from_raw_parts_mut(x, n) };
    if !positive_definite::solve(n, work, x) {
        factorization::solve(n, work, x);
    }
}

/// The address of a C function: `factor(n, work, tag)` or `solve(n, work, x)`, with 64-bit integers.
#[pyfunction]
fn kernel_address(name: &str) -> PyResult<usize> {
    match name {
        "factor" => Ok(factor as *const () as usize),
        "solve" => Ok(solve as *const () as usize),
        _ => Err(PyKeyError::new_err(name.to_owned())),
    }
}

/// How many doubles a matrix with so many rows and its factorisation take.
#[pyfunction]
fn kernel_workspace(rows: usize) -> usize {
    factorization::workspace(rows)
}

/// The equations that followed from others since the last call, for each tag.
#[pyfunction]
fn take_deficiencies() -> Vec<Deficiency> {
    std::mem::take(&mut *DEFICIENCIES.lock().unwrap_or_else(PoisonError::into_inner)).into_iter().collect()
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(kernel_address, module)?)?;
    module.add_function(wrap_pyfunction!(kernel_workspace, module)?)?;
    module.add_function(wrap_pyfunction!(take_deficiencies, module)?)
}
