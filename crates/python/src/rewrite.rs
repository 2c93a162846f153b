//! Operation counts and the rewrites of forms.

use pyo3::prelude::*;

use crate::expr::ids;
use crate::session::with_forms;

/// Additions, multiplications, divisions and functions of expressions, on the graph or as trees.
#[pyfunction]
fn cost(expressions: &Bound<'_, PyAny>, tree: bool) -> PyResult<(u64, u64, u64, u64)> {
    let roots = ids(expressions)?;
    let cost = with_forms(|graph| if tree { graph.tree_cost(&roots) } else { graph.cost(&roots) });
    Ok((cost.additions, cost.multiplications, cost.divisions, cost.functions))
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(cost, module)?)
}
