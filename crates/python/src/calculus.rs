//! Derivatives and substitution of many expressions at once.

use pyo3::prelude::*;
use pyo3::types::{PyFrozenSet, PyTuple};
use symbody_core::{Error, Graph, Id};

use crate::convert::{keys, operand, operands, pairs};
use crate::expr::{Object, Tuple, leaves, tuple};
use crate::namesake::notice_namesakes;
use crate::session::{long_with_forms, long_with_graph, raise_at, with_forms};

/// Several expressions with every key of the mapping replaced by its value, all at once.
#[pyfunction]
fn substitute<'py>(py: Python<'py>, expressions: &Object<'py>, mapping: &Object<'py>) -> Tuple<'py> {
    let (roots, pairs) = (operands(expressions, "subs")?, pairs(mapping)?);
    notice_namesakes(py, "subs", &roots, &keys(&pairs))?;
    let replaced = long_with_forms(py, |graph| graph.substitute(&roots, &pairs))?;
    tuple(py, long_with_graph(py, |_| Ok(replaced.clone()))?)
}

/// The derivatives of several expressions with respect to one variable: total ones with respect to t.
#[pyfunction]
fn diff_all<'py>(py: Python<'py>, expressions: &Object<'py>, variable: &Object<'py>) -> Tuple<'py> {
    derivatives(py, ["diff", "diff"], expressions, variable, Graph::diff_all)
}

/// The partial derivatives of several expressions with respect to one variable, t included.
#[pyfunction]
fn partial_derivatives<'py>(
    py: Python<'py>,
    expressions: &Object<'py>,
    variable: &Object<'py>,
) -> Tuple<'py> {
    let places = ["partial_derivative", "partial_derivative, expression"];
    derivatives(py, places, expressions, variable, Graph::partial_derivatives)
}

type Derive = fn(&mut Graph, &[Id], Id) -> Result<Vec<Id>, Error>;

/// The derivatives of expressions of some kind. The names are those of the function, and of its first argument.
fn derivatives<'py>(
    py: Python<'py>,
    [place, argument]: [&str; 2],
    expressions: &Object<'py>,
    variable: &Object<'py>,
    derive: Derive,
) -> Tuple<'py> {
    let roots = operands(expressions, argument)?;
    let variable = operand(variable, &format!("{place}, variable"))?;
    notice_namesakes(py, place, &roots, &[variable])?;
    tuple(py, long_with_graph(py, |graph| derive(graph, &roots, variable))?)
}

/// The total time derivatives of several expressions.
#[pyfunction]
fn time_derivatives<'py>(py: Python<'py>, expressions: &Object<'py>) -> Tuple<'py> {
    let roots = operands(expressions, "time_derivative")?;
    tuple(py, long_with_graph(py, |graph| graph.time_derivatives(&roots))?)
}

/// Several expressions without the terms beyond an order in variables: those that are marked as small, or those given.
#[pyfunction]
#[pyo3(signature = (expressions, order, variables = None))]
fn truncate<'py>(
    py: Python<'py>,
    expressions: &Object<'py>,
    order: u32,
    variables: Option<&Object<'py>>,
) -> Tuple<'py> {
    let roots = operands(expressions, "taylor")?;
    let variables = variables.map(|given| operands(given, "taylor, variables")).transpose()?;
    tuple(py, long_with_graph(py, |graph| graph.truncate(&roots, variables.as_deref(), order))?)
}

/// Whether one of the expressions contains a variable that is marked as small.
#[pyfunction]
fn contain_small(expressions: &Object<'_>) -> PyResult<bool> {
    let roots = operands(expressions, "taylor")?;
    Ok(with_forms(|graph| roots.iter().any(|&id| graph.contains_small(id))))
}

/// The leaves of several expressions, found in one walk.
#[pyfunction]
fn free_symbols<'py>(py: Python<'py>, expressions: &Object<'py>) -> PyResult<Bound<'py, PyFrozenSet>> {
    leaves(py, &operands(expressions, "free_symbols")?)
}

/// The leaves of several expressions on which no value of them depends, or those for which it seems so in two lanes.
#[pyfunction]
fn idle_symbols<'py>(py: Python<'py>, expressions: &Object<'py>, surely: bool) -> Tuple<'py> {
    let roots = operands(expressions, "idle_symbols")?;
    let find = if surely { Graph::idle_variables } else { Graph::seemingly_idle_variables };
    tuple(py, long_with_forms(py, |graph| Ok(find(graph, &roots)))?)
}

/// The expressions in forms without such leaves, made outside any derivation, or in that of this thread.
#[pyfunction]
fn without_idle_symbols<'py>(py: Python<'py>, expressions: &Object<'py>, deriving: bool) -> Tuple<'py> {
    let roots = operands(expressions, "without_idle_symbols")?;
    let rewrite = |graph: &mut Graph| Ok(graph.without_idle_variables(&roots));
    tuple(py, if deriving { long_with_graph(py, rewrite) } else { long_with_forms(py, rewrite) }?)
}

/// The partial derivatives of one expression with respect to many variables.
#[pyfunction]
fn gradient<'py>(py: Python<'py>, expression: &Object<'py>, variables: &Object<'py>) -> Tuple<'py> {
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
    expressions: &Object<'py>,
    variables: &Object<'py>,
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
    module.add_function(wrap_pyfunction!(truncate, module)?)?;
    module.add_function(wrap_pyfunction!(contain_small, module)?)?;
    module.add_function(wrap_pyfunction!(idle_symbols, module)?)?;
    module.add_function(wrap_pyfunction!(without_idle_symbols, module)?)?;
    module.add_function(wrap_pyfunction!(jacobian, module)?)
}
