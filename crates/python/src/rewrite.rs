//! Operation counts and the rewrites of forms.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use symbody_core::{Error, Graph, Id};

use crate::convert::{mistake, operand, operands};
use crate::expr::{Expr, Object, Tuple, tuple};
use crate::namesake::notice_namesakes;
use crate::session::{long_with_forms, long_with_graph};

/// Additions, multiplications, divisions and functions of expressions: on the graph by what they depend on
/// (parameters alone, time and positions, speeds, accelerations), or as trees in one sum.
#[pyfunction]
fn cost(py: Python<'_>, expressions: &Bound<'_, PyAny>, tree: bool) -> PyResult<Vec<(u64, u64, u64, u64)>> {
    let roots = operands(expressions, "cost")?;
    let costs = long_with_forms(py, |graph| {
        Ok(if tree { vec![graph.tree_cost(&roots)] } else { graph.cost_by_level(&roots).to_vec() })
    })?;
    Ok(costs
        .iter()
        .map(|cost| (cost.additions, cost.multiplications, cost.divisions, cost.functions))
        .collect())
}

/// A rewrite without further arguments, by name.
#[pyfunction]
fn rewrite(py: Python<'_>, name: &str, expression: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let rewrite: fn(&mut Graph, Id) -> Result<Id, Error> = match name {
        "expand" => Graph::expand,
        "expand_trig" => Graph::expand_trig,
        "factor_terms" => Graph::factor_terms,
        "combine_trig" => Graph::combine_trig,
        "simplify" => Graph::simplify,
        "readable" => Graph::readable,
        "textbook_form" => Graph::textbook_form,
        "parameters_outside" => Graph::parameters_outside,
        _ => return Err(PyValueError::new_err(format!("{name} is not a rewrite"))),
    };
    let root = operand(expression, name)?;
    long_with_forms(py, |graph| rewrite(graph, root)).map(Expr)
}

/// The expression as a polynomial in the variables.
#[pyfunction]
fn collect(py: Python<'_>, expression: &Bound<'_, PyAny>, variables: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let root = operand(expression, "collect, expression")?;
    let variables = operands(variables, "collect, variables")?;
    notice_namesakes(py, "collect", &[root], &variables)?;
    long_with_forms(py, |graph| graph.collect(root, &variables)).map(Expr)
}

/// The coefficient of a power of a variable.
#[pyfunction]
fn coeff(
    py: Python<'_>,
    expression: &Bound<'_, PyAny>,
    variable: &Bound<'_, PyAny>,
    n: &Bound<'_, PyAny>,
) -> PyResult<Expr> {
    let (root, variable) = (operand(expression, "coeff, expression")?, operand(variable, "coeff, variable")?);
    notice_namesakes(py, "coeff", &[root], &[variable])?;
    let n = n.extract().map_err(|_| mistake(n, "coeff, n", "a whole number"))?;
    long_with_forms(py, |graph| graph.coeff(root, variable, n)).map(Expr)
}

/// Expressions in forms whose sums share common parts, if these take fewer operations beside the others.
#[pyfunction]
fn with_shared_sums<'py>(py: Python<'py>, expressions: &Object<'py>, others: &Object<'py>) -> Tuple<'py> {
    let roots = operands(expressions, "with_shared_sums, expressions")?;
    let others = operands(others, "with_shared_sums, others")?;
    tuple(py, long_with_forms(py, |graph| Ok(graph.with_shared_sums(&roots, &others)))?)
}

/// The common factor of expressions that depends on parameters alone, and then each of them without it.
#[pyfunction]
fn common_parameters<'py>(py: Python<'py>, expressions: &Object<'py>) -> Tuple<'py> {
    let roots = operands(expressions, "common_parameters")?;
    let parts = long_with_graph(py, |graph| {
        let (factor, rests) = graph.common_parameters(&roots)?;
        Ok([vec![factor], rests].concat())
    })?;
    tuple(py, parts)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(cost, module)?)?;
    module.add_function(wrap_pyfunction!(rewrite, module)?)?;
    module.add_function(wrap_pyfunction!(collect, module)?)?;
    module.add_function(wrap_pyfunction!(coeff, module)?)?;
    module.add_function(wrap_pyfunction!(with_shared_sums, module)?)?;
    module.add_function(wrap_pyfunction!(common_parameters, module)?)
}
