//! Matrices given row by row, and linear systems.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use symbody_core::Matrix;

use crate::convert::operands;
use crate::expr::{Expr, tuple};
use crate::namesake::notice_namesakes;
use crate::session::{raise, with_graph};

/// The product of a rows x inner and an inner x columns matrix.
#[pyfunction]
fn matrix_product<'py>(
    py: Python<'py>,
    rows: usize,
    inner: usize,
    columns: usize,
    a: &Bound<'py, PyAny>,
    b: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let a = raise(py, Matrix::new(rows, inner, operands(a, "Matrix")?))?;
    let b = raise(py, Matrix::new(inner, columns, operands(b, "Matrix")?))?;
    let product = raise(py, with_graph(|graph| graph.matrix_product(&a, &b)))?;
    tuple(py, product.entries().iter().copied())
}

/// The rank of a matrix.
#[pyfunction]
fn matrix_rank(py: Python<'_>, rows: usize, columns: usize, entries: &Bound<'_, PyAny>) -> PyResult<usize> {
    let matrix = raise(py, Matrix::new(rows, columns, operands(entries, "Matrix")?))?;
    Ok(with_graph(|graph| graph.matrix_rank(&matrix)))
}

/// The determinant of an n x n matrix.
#[pyfunction]
fn determinant(py: Python<'_>, n: usize, entries: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let matrix = raise(py, Matrix::new(n, n, operands(entries, "Matrix")?))?;
    raise(py, with_graph(|graph| graph.determinant(&matrix))).map(Expr)
}

/// The inverse of an n x n matrix.
#[pyfunction]
fn inverse<'py>(py: Python<'py>, n: usize, entries: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyTuple>> {
    let matrix = raise(py, Matrix::new(n, n, operands(entries, "Matrix")?))?;
    let inverse = raise(py, with_graph(|graph| graph.inverse(&matrix)))?;
    tuple(py, inverse.entries().iter().copied())
}

/// The values of the unknowns that make the linear equations zero.
#[pyfunction]
fn solve<'py>(
    py: Python<'py>,
    equations: &Bound<'py, PyAny>,
    unknowns: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let equations = operands(equations, "solve, equations")?;
    let unknowns = operands(unknowns, "solve, unknowns")?;
    notice_namesakes(py, "solve", &equations, &unknowns)?;
    tuple(py, raise(py, with_graph(|graph| graph.solve(&equations, &unknowns)))?)
}

/// The solution of A x = b, A given row by row: solved at run time, by pivoting.
#[pyfunction]
fn linear_solve<'py>(
    py: Python<'py>,
    matrix: &Bound<'py, PyAny>,
    right: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let matrix = operands(matrix, "linear_solve, matrix")?;
    let right = operands(right, "linear_solve, right side")?;
    tuple(py, raise(py, with_graph(|graph| graph.linear_solve(&matrix, &right)))?)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(matrix_product, module)?)?;
    module.add_function(wrap_pyfunction!(matrix_rank, module)?)?;
    module.add_function(wrap_pyfunction!(determinant, module)?)?;
    module.add_function(wrap_pyfunction!(inverse, module)?)?;
    module.add_function(wrap_pyfunction!(linear_solve, module)?)?;
    module.add_function(wrap_pyfunction!(solve, module)?)
}
