//! Operation counts and the rewrites of forms.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use symbody_core::{Error, Graph, Id};

use crate::convert::Operand;
use crate::expr::{Expr, ids};
use crate::session::{raise, with_forms};

/// Additions, multiplications, divisions and functions of expressions, on the graph or as trees.
#[pyfunction]
fn cost(expressions: &Bound<'_, PyAny>, tree: bool) -> PyResult<(u64, u64, u64, u64)> {
    let roots = ids(expressions)?;
    let cost = with_forms(|graph| if tree { graph.tree_cost(&roots) } else { graph.cost(&roots) });
    Ok((cost.additions, cost.multiplications, cost.divisions, cost.functions))
}

/// A rewrite without further arguments, by name.
#[pyfunction]
fn rewrite(py: Python<'_>, name: &str, expression: Operand) -> PyResult<Expr> {
    let rewrite: fn(&mut Graph, Id) -> Result<Id, Error> = match name {
        "expand" => Graph::expand,
        "expand_trig" => Graph::expand_trig,
        "factor_terms" => Graph::factor_terms,
        "combine_trig" => Graph::combine_trig,
        "simplify" => Graph::simplify,
        _ => return Err(PyValueError::new_err(format!("{name} is not a rewrite"))),
    };
    raise(py, with_forms(|graph| rewrite(graph, expression.0))).map(Expr)
}

/// The expression as a polynomial in the variables.
#[pyfunction]
fn collect(py: Python<'_>, expression: Operand, variables: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let variables = ids(variables)?;
    raise(py, with_forms(|graph| graph.collect(expression.0, &variables))).map(Expr)
}

/// The coefficient of a power of a variable.
#[pyfunction]
fn coeff(py: Python<'_>, expression: Operand, variable: Operand, n: i64) -> PyResult<Expr> {
    raise(py, with_forms(|graph| graph.coeff(expression.0, variable.0, n))).map(Expr)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(cost, module)?)?;
    module.add_function(wrap_pyfunction!(rewrite, module)?)?;
    module.add_function(wrap_pyfunction!(collect, module)?)?;
    module.add_function(wrap_pyfunction!(coeff, module)?)
}
