//! The class `Expr`: a node of the graph as a Python object, alone and in collections. `methods` gives it its
//! behaviour.

use pyo3::prelude::*;
use pyo3::types::{PyFrozenSet, PyTuple};
use symbody_core::{Id, View};

use crate::session::long_with_forms;

/// An immutable expression. Comparison is by value: equal mathematics is equal.
///
/// Numbers, `symbols` and `functions_of_time` are expressions, and so is what operators and functions make of them.
///
/// >>> from symbody import cos, sin, symbols
/// >>> x, y = symbols("x y")
/// >>> (x + y)**2 == x**2 + 2*x*y + y**2, sin(x)**2 + cos(x)**2
/// (True, 1)
#[pyclass(frozen, module = "symbody", name = "Expr")]
#[derive(Clone, Copy)]
pub struct Expr(pub Id);

/// Any Python object, as an argument.
pub type Object<'py> = Bound<'py, PyAny>;

/// A Python tuple of expressions, as a result.
pub type Tuple<'py> = PyResult<Bound<'py, PyTuple>>;

/// The symbols, functions of time and their derivatives in several expressions.
pub fn leaves<'py>(py: Python<'py>, roots: &[Id]) -> PyResult<Bound<'py, PyFrozenSet>> {
    let variables = long_with_forms(py, |graph| {
        let mut variables = graph.variables(roots);
        variables.retain(|&id| !matches!(graph.view(id), View::Application { .. }));
        Ok(variables)
    })?;
    PyFrozenSet::new(py, variables.into_iter().map(|id| Py::new(py, Expr(id))).collect::<PyResult<Vec<_>>>()?)
}

/// The ids as a Python tuple of expressions.
pub fn tuple(py: Python<'_>, ids: impl IntoIterator<Item = Id>) -> Tuple<'_> {
    // Large results are mostly zeros, which share one object.
    let zero = Py::new(py, Expr(Id::ZERO))?;
    let object = |id| if id == Id::ZERO { Ok(zero.clone_ref(py)) } else { Py::new(py, Expr(id)) };
    let items: Vec<Py<Expr>> = ids.into_iter().map(object).collect::<PyResult<_>>()?;
    PyTuple::new(py, items)
}
