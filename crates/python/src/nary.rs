//! Sums and products of many expressions, each made in one call.

use pyo3::prelude::*;
use symbody_core::NumberId;

use crate::convert::operands;
use crate::expr::Expr;
use crate::session::long_with_graph;

/// The sum of expressions.
#[pyfunction]
fn sum_of(py: Python<'_>, terms: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let terms: Vec<_> = operands(terms, "sum")?.into_iter().map(|id| (NumberId::ONE, id)).collect();
    long_with_graph(py, |graph| Ok(graph.sum(&terms))).map(Expr)
}

/// The product of expressions.
#[pyfunction]
fn product_of(py: Python<'_>, factors: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let factors: Vec<_> = operands(factors, "product")?.into_iter().map(|id| (id, NumberId::ONE)).collect();
    long_with_graph(py, |graph| graph.product(&factors)).map(Expr)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(sum_of, module)?)?;
    module.add_function(wrap_pyfunction!(product_of, module)?)
}
