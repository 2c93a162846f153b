//! Python bindings of the expression core: translation only, no mathematics.

mod calculus;
mod convert;
mod expr;
mod leaves;
mod nary;
mod print;
mod rewrite;
mod session;
mod tape;
mod vector;

use pyo3::prelude::*;

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<expr::Expr>()?;
    session::register(module)?;
    leaves::register(module)?;
    nary::register(module)?;
    calculus::register(module)?;
    print::register(module)?;
    rewrite::register(module)?;
    tape::register(module)?;
    vector::register(module)
}
