//! Python values as expressions and numbers as Python values.

use num_bigint::BigInt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};
use symbody_core::{Error, Id, Number, quoted};

use crate::expr::Expr;
use crate::session::{argument_error, raise, with_graph};

/// The description of an expression in messages.
const EXPRESSION: &str = "an expression or a number (int, float, Fraction, NumPy scalar)";

/// An argument that may be an expression or a number.
pub struct Operand(pub Id);

impl<'a, 'py> FromPyObject<'a, 'py> for Operand {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match optional(&object)? {
            Some(id) => Ok(Self(id)),
            None => Err(mistake(&object, "", EXPRESSION)),
        }
    }
}

/// The expression of an argument; `place` names the function and the argument in the error.
pub fn operand(object: &Bound<'_, PyAny>, place: &str) -> PyResult<Id> {
    optional(object)?.ok_or_else(|| mistake(object, place, EXPRESSION))
}

/// The expressions of an argument: a sequence of expressions, or a single one.
pub fn operands(sequence: &Bound<'_, PyAny>, place: &str) -> PyResult<Vec<Id>> {
    if let Ok(expr) = sequence.cast::<Expr>() {
        return Ok(vec![expr.get().0]);
    }
    match sequence.try_iter() {
        Ok(items) if !sequence.is_instance_of::<PyString>() => {
            items.map(|item| operand(&item?, place)).collect()
        }
        _ => Err(mistake(sequence, place, "a list of expressions")),
    }
}

/// The pairs of a mapping, or of a sequence of pairs.
pub fn pairs(mapping: &Bound<'_, PyAny>) -> PyResult<Vec<(Id, Id)>> {
    let expected = "a mapping of expressions to expressions, such as {x: 1}";
    let items = if mapping.hasattr("items")? { mapping.call_method0("items")? } else { mapping.clone() };
    let Ok(items) = items.try_iter() else {
        return Err(mistake(mapping, "subs", expected));
    };
    items
        .map(|item| {
            let item = item?;
            let Ok((key, value)) = item.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() else {
                return Err(mistake(&item, "subs", expected));
            };
            let place = || key.str().map(|name| format!("subs: the replacement of {name}"));
            let id = operand(&key, "subs")?;
            match optional(&value)? {
                Some(value) => Ok((id, value)),
                None => Ok((id, operand(&value, &place()?)?)),
            }
        })
        .collect()
}

/// The expressions that a substitution replaces.
pub fn keys(pairs: &[(Id, Id)]) -> Vec<Id> {
    pairs.iter().map(|pair| pair.0).collect()
}

/// The expression of an expression or a number, `None` for anything else; an error for nan and infinity.
pub fn optional(object: &Bound<'_, PyAny>) -> PyResult<Option<Id>> {
    if let Ok(expr) = object.cast::<Expr>() {
        return Ok(Some(expr.get().0));
    }
    Ok(number(object)?.map(|number| with_graph(|graph| graph.number(&number))))
}

/// A Python or `NumPy` number: integers and fractions exactly, doubles as the decimals that print them.
fn number(object: &Bound<'_, PyAny>) -> PyResult<Option<Number>> {
    let py = object.py();
    if object.is_instance_of::<PyBool>() {
        return Ok(None);
    }
    if let Ok(value) = object.cast::<PyFloat>() {
        return raise(py, Number::from_f64(value.extract()?)).map(Some);
    }
    if object.is_instance_of::<PyInt>() {
        return integer(object).map(Some);
    }
    if let (Ok(num), Ok(den)) = (object.getattr("numerator"), object.getattr("denominator")) {
        let num: Result<BigInt, _> = num.extract();
        let den: Result<BigInt, _> = den.extract();
        if let (Ok(num), Ok(den)) = (num, den) {
            return raise(py, Number::from_big(num, den)).map(Some);
        }
    }
    if object.get_type().name()?.to_str()? == "Decimal" {
        return decimal(object).map(Some);
    }
    if object.hasattr("dtype")? && object.getattr("ndim")?.extract::<usize>()? == 0 {
        let plain = object.call_method0("item")?;
        if plain.is_instance_of::<PyFloat>() || plain.is_instance_of::<PyInt>() {
            return number(&plain);
        }
    }
    Ok(None)
}

/// A number of Python's `decimal`, exactly; it prints as a double if that is exact.
fn decimal(object: &Bound<'_, PyAny>) -> PyResult<Number> {
    let py = object.py();
    let rounded: f64 = object.call_method0("__float__")?.extract()?;
    if !object.call_method0("is_finite")?.extract::<bool>()? {
        return raise(py, Number::from_f64(rounded));
    }
    let exponent: i64 = object.call_method0("adjusted")?.extract()?;
    if exponent.abs() > LARGEST_EXPONENT {
        return raise(py, Err(Error::NumberTooLarge(object.str()?.to_string())));
    }
    let (num, den) = object.call_method0("as_integer_ratio")?.extract()?;
    let exact = raise(py, Number::from_big(num, den))?;
    let plain = Number::from_f64(rounded).ok().filter(|plain| plain.same_value(&exact));
    Ok(plain.unwrap_or(exact))
}

/// Larger powers of ten have more digits than expressions allow.
const LARGEST_EXPONENT: i64 = 1_000_000;

fn integer(object: &Bound<'_, PyAny>) -> PyResult<Number> {
    if let Ok(value) = object.extract::<i64>() {
        return Ok(Number::integer(value));
    }
    raise(object.py(), Number::from_big(object.extract()?, 1.into()))
}

/// The error for an argument that is not what is expected: where, what was found, and the remedy.
pub fn mistake(object: &Bound<'_, PyAny>, place: &str, expected: &str) -> PyErr {
    let class = object.get_type();
    let kind = class.name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let article =
        if kind.starts_with(['a', 'e', 'i', 'o', 'u', 'A', 'E', 'I', 'O', 'U']) { "an" } else { "a" };
    let text = object.repr().map_or_else(|_| String::new(), |repr| quoted(&repr.to_string()));
    let text = if object.is_none() { text } else { format!("{text} is {article} {kind}") };
    let place = if place.is_empty() { String::new() } else { format!("{place}: ") };
    argument_error(object.py(), format!("{place}{text}; expected {expected}{}", remedy(object)))
}

/// How to convert the argument into an expression.
fn remedy(object: &Bound<'_, PyAny>) -> &'static str {
    if object.is_instance_of::<PyString>() {
        return "; parse converts it";
    }
    if is_sympy(object) { "; from_sympy converts it" } else { "" }
}

/// Whether an object is one of `SymPy`'s.
pub fn is_sympy(object: &Bound<'_, PyAny>) -> bool {
    let module = object.get_type().module();
    module.is_ok_and(|module| module.to_str().is_ok_and(|name| name.starts_with("sympy.")))
}
