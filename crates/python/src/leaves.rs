//! Constructors of leaves and functions: symbols, functions of time, constants, applications.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use symbody_core::{Assumption, Function, Graph};

use crate::convert::{operand, operands};
use crate::expr::Expr;
use crate::session::{long_with_graph, raise, with_graph};

/// The symbol with a name.
#[pyfunction]
#[pyo3(signature = (name, *, positive = false, real = true, small = false))]
fn symbol(name: &str, positive: bool, real: bool, small: bool) -> Expr {
    let assumption = match (positive, real) {
        _ if small => Assumption::Small,
        (true, _) => Assumption::Positive,
        (false, true) => Assumption::Real,
        (false, false) => Assumption::None,
    };
    Expr(with_graph(|graph| graph.symbol(name, assumption)))
}

/// The function of time `name`, differentiated `order` times.
#[pyfunction]
#[pyo3(signature = (name, order = 0, *, small = false))]
fn time_function(py: Python<'_>, name: &str, order: u32, small: bool) -> PyResult<Expr> {
    let make = if small { Graph::small_time_function } else { Graph::time_function };
    raise(py, with_graph(|graph| make(graph, name, order))).map(Expr)
}

/// The undefined function `name` of arguments, differentiated `orders[i]` times by argument i.
#[pyfunction]
#[pyo3(signature = (name, args, orders = None))]
fn application(
    py: Python<'_>,
    name: &str,
    args: &Bound<'_, PyAny>,
    orders: Option<Vec<u32>>,
) -> PyResult<Expr> {
    let args = operands(args, name)?;
    let orders = orders.unwrap_or_else(|| vec![0; args.len()]);
    if orders.len() != args.len() {
        return Err(PyValueError::new_err(format!(
            "{name}: {} orders of differentiation for {} arguments",
            orders.len(),
            args.len()
        )));
    }
    raise(py, with_graph(|graph| graph.application(name, &args, &orders))).map(Expr)
}

/// A function of the table, by name.
#[pyfunction]
fn apply(py: Python<'_>, name: &str, args: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let args = operands(args, name)?;
    let Some(function) = Function::by_name(name) else {
        return Err(PyValueError::new_err(format!("{name} is not a function of the table")));
    };
    long_with_graph(py, |graph| graph.apply(function, &args)).map(Expr)
}

/// The square root.
#[pyfunction]
fn sqrt(py: Python<'_>, value: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let root = operand(value, "sqrt")?;
    long_with_graph(py, |graph| graph.sqrt(root)).map(Expr)
}

/// The independent variable t.
#[pyfunction]
fn time() -> Expr {
    Expr(with_graph(Graph::time))
}

/// The circle constant.
#[pyfunction]
fn pi() -> Expr {
    Expr(with_graph(Graph::pi))
}

/// The names of the functions of the table.
#[pyfunction]
fn function_names() -> Vec<&'static str> {
    Function::all().map(Function::name).collect()
}

/// The number of a Python value as an expression; `place` names the argument in the error.
#[pyfunction]
#[pyo3(signature = (value, place = ""))]
fn number(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Expr> {
    operand(value, place).map(Expr)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(symbol, module)?)?;
    module.add_function(wrap_pyfunction!(time_function, module)?)?;
    module.add_function(wrap_pyfunction!(application, module)?)?;
    module.add_function(wrap_pyfunction!(apply, module)?)?;
    module.add_function(wrap_pyfunction!(sqrt, module)?)?;
    module.add_function(wrap_pyfunction!(time, module)?)?;
    module.add_function(wrap_pyfunction!(pi, module)?)?;
    module.add_function(wrap_pyfunction!(function_names, module)?)?;
    module.add_function(wrap_pyfunction!(number, module)?)
}
