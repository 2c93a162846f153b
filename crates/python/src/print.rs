//! Expressions as text.

use pyo3::prelude::*;
use symbody_core::{Format, Listing, Usage};

use crate::convert::operands;
use crate::session::{argument_error, long_with_forms};

/// Names, and the expressions that they stand for.
type Definitions = Vec<(String, String)>;

/// Expressions printed together: the named intermediate quantities, if any, and the results; those of equations with
/// the names of their functions of time in order, of the speeds among these, and of the parameters that their model subtracts.
#[pyfunction]
#[pyo3(signature = (expressions, notation, equations=None))]
fn listing(
    expressions: &Bound<'_, PyAny>,
    notation: &str,
    equations: Option<(Vec<String>, Vec<String>, Vec<String>)>,
) -> PyResult<(Definitions, Vec<String>)> {
    let roots = operands(expressions, "listing")?;
    let format = match notation {
        "text" => Format::Text,
        "latex" => Format::Latex,
        "maple" => Format::Maple,
        _ => {
            return Err(argument_error(
                expressions.py(),
                format!("listing: {notation} is not a notation; expected text, latex or maple"),
            ));
        }
    };
    let usage = equations.map(|(functions, speeds, subtracted)| Usage::new(&functions, &speeds, subtracted));
    let Listing { definitions, results } = long_with_forms(expressions.py(), |graph| {
        Ok(match &usage {
            Some(usage) => graph.listing_of_equations(&roots, format, usage),
            None => graph.listing(&roots, format),
        })
    })?;
    Ok((definitions, results))
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(listing, module)?)
}
