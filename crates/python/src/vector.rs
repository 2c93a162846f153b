//! Operations on vectors of three components, one call each: calls per component would cost more than the algebra.

use pyo3::prelude::*;
use symbody_core::{Error, Graph, Id, Vector3, vector};

use crate::convert::Operand;
use crate::expr::Expr;
use crate::session::long_with_graph;

type Triple = (Operand, Operand, Operand);
type Result3 = (Expr, Expr, Expr);

fn vector3(v: &Triple) -> Vector3 {
    [v.0.0, v.1.0, v.2.0]
}

fn triple(v: Vector3) -> Result3 {
    (Expr(v[0]), Expr(v[1]), Expr(v[2]))
}

fn compute(py: Python<'_>, work: impl FnMut(&mut Graph) -> Result<Vector3, Error>) -> PyResult<Result3> {
    long_with_graph(py, work).map(triple)
}

/// The sum `a + b`.
#[pyfunction]
fn add3(py: Python<'_>, a: Triple, b: Triple) -> PyResult<Result3> {
    compute(py, |graph| Ok(vector::add(graph, vector3(&a), vector3(&b))))
}

/// The difference `a - b`.
#[pyfunction]
fn sub3(py: Python<'_>, a: Triple, b: Triple) -> PyResult<Result3> {
    compute(py, |graph| Ok(vector::sub(graph, vector3(&a), vector3(&b))))
}

/// The multiple `s a`.
#[pyfunction]
fn scale3(py: Python<'_>, s: Operand, a: Triple) -> PyResult<Result3> {
    compute(py, |graph| vector::scale(graph, s.0, vector3(&a)))
}

/// The scalar product `a . b`.
#[pyfunction]
fn dot3(py: Python<'_>, a: Triple, b: Triple) -> PyResult<Expr> {
    long_with_graph(py, |graph| vector::dot(graph, vector3(&a), vector3(&b))).map(Expr)
}

/// The vector product `a x b`.
#[pyfunction]
fn cross3(py: Python<'_>, a: Triple, b: Triple) -> PyResult<Result3> {
    compute(py, |graph| vector::cross(graph, vector3(&a), vector3(&b)))
}

/// R v for the rotation about axis 0, 1 or 2 by an angle.
#[pyfunction]
fn rotate3(py: Python<'_>, axis: usize, angle: Operand, v: Triple) -> PyResult<Result3> {
    compute(py, |graph| vector::rotate(graph, axis, angle.0, vector3(&v)))
}

/// R^T v for the rotation about axis 0, 1 or 2 by an angle.
#[pyfunction]
fn rotate_back3(py: Python<'_>, axis: usize, angle: Operand, v: Triple) -> PyResult<Result3> {
    compute(py, |graph| vector::rotate_back(graph, axis, angle.0, vector3(&v)))
}

/// M v for the nine entries of M, row by row.
#[pyfunction]
fn matvec3(py: Python<'_>, m: [Operand; 9], v: Triple) -> PyResult<Result3> {
    let m = m.map(|entry| entry.0);
    compute(py, |graph| vector::matrix_times(graph, &m, vector3(&v)))
}

/// M^T v for the nine entries of M, row by row.
#[pyfunction]
fn matvec3_transposed(py: Python<'_>, m: [Operand; 9], v: Triple) -> PyResult<Result3> {
    let m: [Id; 9] = m.map(|entry| entry.0);
    let transposed = [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
    compute(py, |graph| vector::matrix_times(graph, &transposed, vector3(&v)))
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(add3, module)?)?;
    module.add_function(wrap_pyfunction!(sub3, module)?)?;
    module.add_function(wrap_pyfunction!(scale3, module)?)?;
    module.add_function(wrap_pyfunction!(dot3, module)?)?;
    module.add_function(wrap_pyfunction!(cross3, module)?)?;
    module.add_function(wrap_pyfunction!(rotate3, module)?)?;
    module.add_function(wrap_pyfunction!(rotate_back3, module)?)?;
    module.add_function(wrap_pyfunction!(matvec3, module)?)?;
    module.add_function(wrap_pyfunction!(matvec3_transposed, module)?)
}
