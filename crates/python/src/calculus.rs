//! Derivatives and substitution of many expressions at once.

use pyo3::prelude::*;
use pyo3::types::{PyFrozenSet, PyTuple};

use crate::convert::{keys, operand, operands, pairs};
use crate::expr::{leaves, tuple};
use crate::namesake::notice_namesakes;
use crate::session::{long_with_forms, long_with_graph, raise_at, with_forms};

/// Several expressions with every key of the mapping replaced by its value, all at once.
#[pyfunction]
fn substitute<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    mapping: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let (roots, pairs) = (operands(expressions, "subs")?, pairs(mapping)?);
    notice_namesakes(py, "subs", &roots, &keys(&pairs))?;
    let replaced = long_with_forms(py, |graph| graph.substitute(&roots, &pairs))?;
    tuple(py, replaced)
}

/// The derivatives of several expressions with respect to one variable: total ones with respect to t.
#[pyfunction]
fn diff_all<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    variable: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let (roots, variable) = (operands(expressions, "diff")?, operand(variable, "diff, variable")?);
    notice_namesakes(py, "diff", &roots, &[variable])?;
    tuple(py, long_with_graph(py, |graph| graph.diff_all(&roots, variable))?)
}

/// The partial derivatives of several expressions with respect to one variable, t included.
#[pyfunction]
fn partial_derivatives<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    variable: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let place = "partial_derivative";
    let roots = operands(expressions, "partial_derivative, expression")?;
    let variable = operand(variable, "partial_derivative, variable")?;
    notice_namesakes(py, place, &roots, &[variable])?;
    tuple(py, long_with_graph(py, |graph| graph.partial_derivatives(&roots, variable))?)
}

/// The total time derivatives of several expressions.
#[pyfunction]
fn time_derivatives<'py>(py: Python<'py>, expressions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyTuple>> {
    let roots = operands(expressions, "time_derivative")?;
    tuple(py, long_with_graph(py, |graph| graph.time_derivatives(&roots))?)
}

/// The leaves of several expressions, found in one walk.
#[pyfunction]
fn free_symbols<'py>(py: Python<'py>, expressions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyFrozenSet>> {
    leaves(py, &operands(expressions, "free_symbols")?)
}

/// The partial derivatives of one expression with respect to many variables.
#[pyfunction]
fn gradient<'py>(
    py: Python<'py>,
    expression: &Bound<'py, PyAny>,
    variables: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let root = operand(expression, "gradient, expression")?;
    let variables = operands(variables, "gradient, variables")?;
    notice_namesakes(py, "gradient", &[root], &variables)?;
    raise_at(py, "gradient", with_forms(|graph| graph.check_unambiguous(&[root], &variables)))?;
    tuple(py, long_with_graph(py, |graph| graph.gradient(root, &variables))?)
}

/// The rows of the Jacobian of expressions with respect to variables.
#[pyfunction]
fn jacobian<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    variables: &Bound<'py, PyAny>,
) -> PyResult<Vec<Bound<'py, PyTuple>>> {
    let roots = operands(expressions, "jacobian, expressions")?;
    let variables = operands(variables, "jacobian, variables")?;
    notice_namesakes(py, "jacobian", &roots, &variables)?;
    raise_at(py, "jacobian", with_forms(|graph| graph.check_unambiguous(&roots, &variables)))?;
    let rows = long_with_graph(py, |graph| graph.jacobian(&roots, &variables))?;
    rows.into_iter().map(|row| tuple(py, row)).collect()
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(substitute, module)?)?;
    module.add_function(wrap_pyfunction!(diff_all, module)?)?;
    module.add_function(wrap_pyfunction!(partial_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(free_symbols, module)?)?;
    module.add_function(wrap_pyfunction!(time_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(gradient, module)?)?;
    module.add_function(wrap_pyfunction!(jacobian, module)?)
}
