//! Derivatives and substitution of many expressions at once.

use pyo3::prelude::*;
use pyo3::types::{PyFrozenSet, PyTuple};
use symbody_core::Id;

use crate::convert::{mistake, operand, operands, optional};
use crate::expr::{leaves, tuple};
use crate::session::{raise, with_forms, with_graph};

/// The items of a mapping or of a sequence of pairs.
pub fn pairs(mapping: &Bound<'_, PyAny>) -> PyResult<Vec<(Id, Id)>> {
    let expected = "a mapping of expressions to expressions, such as {x: 1}";
    let items = if mapping.hasattr("items")? { mapping.call_method0("items")? } else { mapping.clone() };
    let Ok(items) = items.try_iter() else {
        return Err(mistake(mapping, "subs", expected));
    };
    items
        .map(|item| {
            let item = item?;
            let Ok((key, value)) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() else {
                return Err(mistake(&item, "subs", expected));
            };
            let place = || key.str().map(|name| format!("subs: the replacement of {name}"));
            let id = operand(&key, "subs")?;
            match optional(&value)? {
                Some(value) => Ok((id, value)),
                None => Ok((id, operand(&value, &place()?)?)),
            }
        })
        .collect()
}

/// What is to be replaced.
pub fn keys(pairs: &[(Id, Id)]) -> Vec<Id> {
    pairs.iter().map(|pair| pair.0).collect()
}

/// Several expressions with every key of the mapping replaced by its value, all at once.
#[pyfunction]
fn substitute<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    mapping: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let (roots, pairs) = (operands(expressions, "subs")?, pairs(mapping)?);
    notice_namesakes(py, "subs", &roots, &keys(&pairs))?;
    let replaced = raise(py, with_forms(|graph| graph.substitute(&roots, &pairs)))?;
    tuple(py, replaced)
}

/// Warn of variables that occur in none of the expressions, where others of their names do, at the user's line.
pub fn notice_namesakes(py: Python<'_>, place: &str, roots: &[Id], sought: &[Id]) -> PyResult<()> {
    let roles = ("in the expression", "given");
    let Some(text) = with_forms(|graph| graph.explain_absent(roots, sought, roles)) else {
        return Ok(());
    };
    py.import("symbody.errors")?.call_method1("notify", (format!("{place}: {text}"),)).map(|_| ())
}

/// How variables that are needed differ from those of the same names that are given; nothing if none do.
#[pyfunction]
fn namesakes(
    needed: &Bound<'_, PyAny>,
    given: &Bound<'_, PyAny>,
    roles: (String, String),
) -> PyResult<String> {
    let (needed, given) = (operands(needed, "namesakes")?, operands(given, "namesakes")?);
    let text = with_forms(|graph| graph.explain_namesakes(&needed, &given, (&roles.0, &roles.1)));
    Ok(text.unwrap_or_default())
}

/// The derivatives of several expressions with respect to one variable.
#[pyfunction]
fn diff_all<'py>(
    py: Python<'py>,
    expressions: &Bound<'py, PyAny>,
    variable: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let (roots, variable) = (operands(expressions, "diff")?, operand(variable, "diff, variable")?);
    notice_namesakes(py, "diff", &roots, &[variable])?;
    tuple(py, raise(py, with_graph(|graph| graph.diff_all(&roots, variable)))?)
}

/// The total time derivatives of several expressions.
#[pyfunction]
fn time_derivatives<'py>(py: Python<'py>, expressions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyTuple>> {
    let roots = operands(expressions, "time_derivative")?;
    tuple(py, raise(py, with_graph(|graph| graph.time_derivatives(&roots)))?)
}

/// The leaves of several expressions, found in one walk.
#[pyfunction]
fn free_symbols<'py>(py: Python<'py>, expressions: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyFrozenSet>> {
    leaves(py, &operands(expressions, "free_symbols")?)
}

/// The derivatives of one expression with respect to many variables.
#[pyfunction]
fn gradient<'py>(
    py: Python<'py>,
    expression: &Bound<'py, PyAny>,
    variables: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyTuple>> {
    let root = operand(expression, "gradient, expression")?;
    let variables = operands(variables, "gradient, variables")?;
    notice_namesakes(py, "gradient", &[root], &variables)?;
    tuple(py, raise(py, with_graph(|graph| graph.gradient(root, &variables)))?)
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
    let rows = raise(py, with_graph(|graph| graph.jacobian(&roots, &variables)))?;
    rows.into_iter().map(|row| tuple(py, row)).collect()
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(namesakes, module)?)?;
    module.add_function(wrap_pyfunction!(substitute, module)?)?;
    module.add_function(wrap_pyfunction!(diff_all, module)?)?;
    module.add_function(wrap_pyfunction!(free_symbols, module)?)?;
    module.add_function(wrap_pyfunction!(time_derivatives, module)?)?;
    module.add_function(wrap_pyfunction!(gradient, module)?)?;
    module.add_function(wrap_pyfunction!(jacobian, module)?)
}
