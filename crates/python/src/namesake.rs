//! Notices of different variables that have one name.

use pyo3::prelude::*;
use symbody_core::Id;

use crate::convert::operands;
use crate::session::with_forms;

/// Warn, at the user's line, of variables that occur in none of the expressions although others with their names do.
pub fn notice_namesakes(py: Python<'_>, place: &str, roots: &[Id], sought: &[Id]) -> PyResult<()> {
    let roles = ("in the expression", "given");
    let Some(text) = with_forms(|graph| graph.explain_absent(roots, sought, roles)) else {
        return Ok(());
    };
    py.import("symbody.errors")?.call_method1("notify", (format!("{place}: {text}"),)).map(|_| ())
}

/// Explain how variables that are needed differ from given ones with the same names; empty if there are none.
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

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(namesakes, module)?)
}
