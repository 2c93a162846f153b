//! Angles: the numbers in them, and decimals that stand for multiples of pi.

use pyo3::prelude::*;

use crate::convert::operand;
use crate::expr::Expr;
use crate::session::with_graph;

/// The angle with each decimal that stands for a multiple of pi replaced by that multiple.
#[pyfunction]
#[pyo3(signature = (value, place = ""))]
fn angle(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Expr> {
    let angle = operand(value, place)?;
    Ok(Expr(with_graph(|graph| graph.angle(angle))))
}

/// The argument of a sine: like `angle`, but a single number stays unchanged.
#[pyfunction]
fn angle_beside_others(value: &Bound<'_, PyAny>, place: &str) -> PyResult<Expr> {
    let argument = operand(value, place)?;
    Ok(Expr(with_graph(|graph| graph.angle_beside_others(argument))))
}

/// The rational number in an angle, in radians, without the multiple of pi.
#[pyfunction]
fn radians(angle: &Bound<'_, PyAny>) -> PyResult<Expr> {
    let angle = operand(angle, "radians")?;
    Ok(Expr(with_graph(|graph| {
        let number = graph.radians(angle);
        graph.number(&number)
    })))
}

/// The multiple k/n of pi with the least n that is within a tolerance of an angle.
#[pyfunction]
fn multiple_of_pi(angle: f64, tolerance: f64) -> Option<(i64, i64)> {
    symbody_core::multiple_of_pi(angle, tolerance)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(angle, module)?)?;
    module.add_function(wrap_pyfunction!(angle_beside_others, module)?)?;
    module.add_function(wrap_pyfunction!(radians, module)?)?;
    module.add_function(wrap_pyfunction!(multiple_of_pi, module)?)
}
