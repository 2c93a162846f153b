//! Python's operators between expressions: sums, products and powers, comparison, and the hash that agrees with `==`.

use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use symbody_core::{Error, Format, Function, Graph, Id, Number};

use crate::convert::{is_sympy, mistake, optional};
use crate::expr::Expr;
use crate::session::{argument_error, long_with_graph, with_forms};

pub type Binary = fn(&mut Graph, Id, Id) -> Result<Id, Error>;

/// A binary operator: Python's `NotImplemented` for operands that are not expressions, so that vectors and matrices
/// take over. Objects of `SymPy` are an error, because `SymPy` would request the value of a symbol.
pub fn binary(left: &Bound<'_, PyAny>, right: &Bound<'_, PyAny>, operation: Binary) -> PyResult<Py<PyAny>> {
    let py = left.py();
    let (Some(a), Some(b)) = (optional(left)?, optional(right)?) else {
        for other in [left, right] {
            if is_sympy(other) {
                return Err(mistake(other, "arithmetic with expressions", "an expression or a number"));
            }
        }
        return Ok(py.NotImplemented());
    };
    let id = long_with_graph(py, |graph| operation(graph, a, b))?;
    Ok(Expr(id).into_pyobject(py)?.into_any().unbind())
}

/// Operations that can't fail, with the type of those that can.
pub const ADD: Binary = |graph, a, b| Ok(graph.add(a, b));
pub const SUBTRACT: Binary = |graph, a, b| Ok(graph.sub(a, b));

pub fn power(graph: &mut Graph, base: Id, exponent: Id) -> Result<Id, Error> {
    match graph.as_number(exponent).cloned() {
        Some(number) => graph.pow_number(base, &number),
        None => graph.apply(Function::Power, &[base, exponent]),
    }
}

/// The error for a comparison of expressions by order.
pub fn no_order(py: Python<'_>, left: Id, right: Id, op: CompareOp) -> PyErr {
    let sign = match op {
        CompareOp::Lt => "<",
        CompareOp::Le => "<=",
        CompareOp::Gt => ">",
        _ => ">=",
    };
    // Printed together, different variables with one name are told apart.
    let texts = with_forms(|graph| graph.listing(&[left, right], Format::Text));
    let whole = || with_forms(|graph| [left, right].map(|side| graph.to_text(side)).to_vec());
    let texts = if texts.definitions.is_empty() { texts.results } else { whole() };
    let (left, right) = (shortened(&texts[0]), shortened(&texts[1]));
    let message = format!(
        "{left} {sign} {right}: expressions have no order; use Max(a, b) or Min(a, b) to choose one, a positive expression \
         as a condition, as in Piecewise((value, a - b)) for a > b, or float(e) to compare numbers"
    );
    argument_error(py, message)
}

/// The beginning of an expression, for a message.
fn shortened(text: &str) -> String {
    const SHOWN: usize = 40;
    if text.chars().count() <= SHOWN {
        text.to_owned()
    } else {
        format!("{}...", text.chars().take(SHOWN).collect::<String>())
    }
}

/// Python's hash of a rational: num / den modulo the prime 2^61 - 1, with the sign of num.
pub fn rational_hash(number: &Number) -> Option<isize> {
    const PRIME: u128 = (1 << 61) - 1;
    let (num, den) = number.to_small()?;
    let (mut inverse, mut power, mut exponent) = (1, u128::from(den.unsigned_abs()), PRIME - 2);
    while den != 1 && exponent > 0 {
        if exponent & 1 == 1 {
            inverse = inverse * power % PRIME;
        }
        power = power * power % PRIME;
        exponent >>= 1;
    }
    let magnitude = isize::try_from(u128::from(num.unsigned_abs()) % PRIME * inverse % PRIME).ok()?;
    let hash = if num < 0 { -magnitude } else { magnitude };
    Some(if hash == -1 { -2 } else { hash })
}
