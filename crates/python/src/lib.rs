//! Python bindings of the expression core: translation only, no mathematics.

#![allow(
    clippy::needless_pass_by_value,
    clippy::trivially_copy_pass_by_ref,
    reason = "PyO3 hands over extracted arguments by value and `self` by reference"
)]

mod angle;
mod calculus;
mod convert;
mod deficiency;
mod expr;
mod expr_methods;
mod integrate;
mod kernel;
mod leaves;
mod matrix;
mod namesake;
mod nary;
mod operators;
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
    angle::register(module)?;
    calculus::register(module)?;
    deficiency::register(module)?;
    integrate::register(module)?;
    kernel::register(module)?;
    matrix::register(module)?;
    namesake::register(module)?;
    print::register(module)?;
    rewrite::register(module)?;
    tape::register(module)?;
    vector::register(module)
}
