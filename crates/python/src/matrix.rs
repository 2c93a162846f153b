//! Matrices given row by row, and linear systems.

use std::collections::HashMap;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyTuple};
use symbody_core::{Error, Graph, Id, Matrix};

use crate::convert::{operand, operands};
use crate::expr::{Expr, Object, Tuple, tuple};
use crate::namesake::notice_namesakes;
use crate::session::{long_with_graph, raise};

/// The entries of a matrix with this many columns as expressions; equal integers and doubles are converted once.
#[pyfunction]
fn matrix_entries<'py>(py: Python<'py>, entries: &Object<'py>, columns: usize) -> Tuple<'py> {
    let mut known: HashMap<(bool, u64), Py<Expr>> = HashMap::new();
    let mut made: Vec<Py<Expr>> = Vec::with_capacity(entries.len().unwrap_or(0));
    for (position, entry) in entries.try_iter()?.enumerate() {
        let entry = entry?;
        if let Ok(expr) = entry.cast::<Expr>() {
            made.push(expr.clone().unbind());
            continue;
        }
        let key = simple_key(&entry);
        if let Some(expr) = key.and_then(|key| known.get(&key)) {
            made.push(expr.clone_ref(py));
            continue;
        }
        let (row, column) = (position / columns.max(1) + 1, position % columns.max(1) + 1);
        let expr = Py::new(py, Expr(operand(&entry, &format!("Matrix, row {row}, column {column}"))?))?;
        if let Some(key) = key.filter(|_| known.len() < MOST_KNOWN) {
            known.insert(key, expr.clone_ref(py));
        }
        made.push(expr);
    }
    PyTuple::new(py, made)
}

/// The most numbers that are kept while entries are converted.
const MOST_KNOWN: usize = 1024;

/// What identifies a plain integer of 64 bits or a double.
fn simple_key(entry: &Object<'_>) -> Option<(bool, u64)> {
    if entry.is_exact_instance_of::<PyInt>() {
        return entry.extract::<i64>().ok().map(|value| (true, u64::from_ne_bytes(value.to_ne_bytes())));
    }
    let is_double = entry.is_instance_of::<PyFloat>(); // NumPy's too
    is_double.then(|| entry.extract::<f64>().ok().map(|value| (false, value.to_bits()))).flatten()
}

/// An operation on the entries of two matrices, or of a matrix and one number or expression.
#[pyfunction]
fn entrywise<'py>(py: Python<'py>, operation: &str, left: &Object<'py>, right: &Object<'py>) -> Tuple<'py> {
    let operation: fn(&mut Graph, Id, Id) -> Result<Id, Error> = match operation {
        "add" => |graph, a, b| Ok(graph.add(a, b)),
        "sub" => |graph, a, b| Ok(graph.sub(a, b)),
        "mul" => Graph::mul,
        "div" => Graph::div,
        _ => return Err(PyValueError::new_err(format!("{operation} is not an operation on entries"))),
    };
    let (left, right) = (operands(left, "Matrix")?, operands(right, "Matrix")?);
    let others = right.iter().copied().cycle();
    let made: Vec<Id> = long_with_graph(py, |graph| {
        left.iter().zip(others.clone()).map(|(&a, b)| operation(graph, a, b)).collect()
    })?;
    tuple(py, made)
}

/// The opposites of expressions.
#[pyfunction]
fn opposites<'py>(py: Python<'py>, entries: &Object<'py>) -> Tuple<'py> {
    let entries = operands(entries, "Matrix")?;
    let made: Vec<Id> =
        long_with_graph(py, |graph| Ok(entries.iter().map(|&entry| graph.neg(entry)).collect()))?;
    tuple(py, made)
}

/// The product of a rows x inner and an inner x columns matrix.
#[pyfunction]
fn matrix_product<'py>(
    py: Python<'py>,
    rows: usize,
    inner: usize,
    columns: usize,
    a: &Object<'py>,
    b: &Object<'py>,
) -> Tuple<'py> {
    let a = raise(py, Matrix::new(rows, inner, operands(a, "Matrix")?))?;
    let b = raise(py, Matrix::new(inner, columns, operands(b, "Matrix")?))?;
    tuple(py, long_with_graph(py, |graph| Ok(graph.matrix_product(&a, &b)?.entries().to_vec()))?)
}

/// The rank of a matrix.
#[pyfunction]
fn matrix_rank(py: Python<'_>, rows: usize, columns: usize, entries: &Object<'_>) -> PyResult<usize> {
    let matrix = raise(py, Matrix::new(rows, columns, operands(entries, "Matrix")?))?;
    long_with_graph(py, |graph| Ok(graph.matrix_rank(&matrix)))
}

/// The determinant of an n x n matrix.
#[pyfunction]
fn determinant(py: Python<'_>, n: usize, entries: &Object<'_>) -> PyResult<Expr> {
    let matrix = raise(py, Matrix::new(n, n, operands(entries, "Matrix")?))?;
    long_with_graph(py, |graph| graph.determinant(&matrix)).map(Expr)
}

/// The inverse of an n x n matrix.
#[pyfunction]
fn inverse<'py>(py: Python<'py>, n: usize, entries: &Object<'py>) -> Tuple<'py> {
    let matrix = raise(py, Matrix::new(n, n, operands(entries, "Matrix")?))?;
    tuple(py, long_with_graph(py, |graph| Ok(graph.inverse(&matrix)?.entries().to_vec()))?)
}

/// The values of the unknowns that make the linear equations zero.
#[pyfunction]
fn solve<'py>(py: Python<'py>, equations: &Object<'py>, unknowns: &Object<'py>) -> Tuple<'py> {
    let equations = operands(equations, "solve, equations")?;
    let unknowns = operands(unknowns, "solve, unknowns")?;
    notice_namesakes(py, "solve", &equations, &unknowns)?;
    tuple(py, long_with_graph(py, |graph| graph.solve(&equations, &unknowns))?)
}

/// The solution of A x = b, A given row by row: solved at run time, by pivoting.
#[pyfunction]
fn linear_solve<'py>(py: Python<'py>, matrix: &Object<'py>, right: &Object<'py>) -> Tuple<'py> {
    let matrix = operands(matrix, "linear_solve, matrix")?;
    let right = operands(right, "linear_solve, right side")?;
    tuple(py, long_with_graph(py, |graph| graph.linear_solve(&matrix, &right))?)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(entrywise, module)?)?;
    module.add_function(wrap_pyfunction!(opposites, module)?)?;
    module.add_function(wrap_pyfunction!(matrix_entries, module)?)?;
    module.add_function(wrap_pyfunction!(matrix_product, module)?)?;
    module.add_function(wrap_pyfunction!(matrix_rank, module)?)?;
    module.add_function(wrap_pyfunction!(determinant, module)?)?;
    module.add_function(wrap_pyfunction!(inverse, module)?)?;
    module.add_function(wrap_pyfunction!(linear_solve, module)?)?;
    module.add_function(wrap_pyfunction!(solve, module)?)
}
