//! Expressions as text.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use symbody_core::{Format, Listing};

use crate::expr::ids;
use crate::session::with_forms;

/// Expressions printed together: the named intermediate quantities, if any, and the results.
#[pyfunction]
fn listing(expressions: &Bound<'_, PyAny>, format: &str) -> PyResult<(Vec<(String, String)>, Vec<String>)> {
    let roots = ids(expressions)?;
    let format = match format {
        "text" => Format::Text,
        "latex" => Format::Latex,
        "maple" => Format::Maple,
        _ => {
            return Err(PyValueError::new_err(format!(
                "{format} is no format; expected text, latex or maple"
            )));
        }
    };
    let Listing { definitions, results } = with_forms(|graph| graph.listing(&roots, format));
    Ok((definitions, results))
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(listing, module)?)
}
