//! Roots: the factors that may leave them, and their values at the random point.
//!
//! A root of a symbolic argument has an opaque value: `sqrt(x**2)` must not become `x`. Square factors of numbers leave
//! the root, and so do positive symbols.

use crate::error::Error;
use crate::graph::{Assumption, Flags, Function, Graph, Id, Kind, View};
use crate::value::{Element, Key, Number, exact_root, radical_value};

use super::collector::Collector;

impl Graph {
    /// Whether no symbol below may be complex.
    pub(super) fn is_real(&self, id: Id) -> bool {
        !self.flags(id).has(Flags::COMPLEX)
    }

    /// Whether the node is positive by the assumptions about its symbols.
    pub(super) fn is_positive(&self, id: Id) -> bool {
        match self.view(id) {
            View::Number(number) => !self.get_number(number).is_negative() && id != Id::ZERO,
            View::Pi | View::Symbol(_, Assumption::Positive) => true,
            View::Function(Function::Exp | Function::Cosh, _) => self.is_real(id),
            View::Scale(number, child) => {
                !self.get_number(number).is_negative()
                    && matches!(self.kind(child), Kind::Symbol(Assumption::Positive) | Kind::Pi)
            }
            View::Product(factors) => factors.iter().all(|(base, _)| {
                matches!(self.kind(base), Kind::Symbol(Assumption::Positive) | Kind::Pi)
                    || matches!(self.view(base), View::Number(n) if !self.get_number(n).is_negative())
            }),
            _ => false,
        }
    }

    pub(super) fn collect_number(
        &mut self,
        out: &mut Collector,
        number: &Number,
        exponent: &Number,
    ) -> Result<(), Error> {
        if let Some(n) = exponent.to_i64() {
            out.coefficient = out.coefficient.mul(&number.powi(n)?);
            return Ok(());
        }
        if number.is_one() {
            return Ok(());
        }
        if number.is_negative() {
            return Err(Error::Domain { function: "the root", argument: number.to_string() });
        }
        let Some((num, den)) = exponent.to_small() else {
            return Err(Error::NumberTooLarge(format!("{number}**({exponent})")));
        };
        let whole = num.div_euclid(den);
        out.coefficient = out.coefficient.mul(&number.powi(whole)?);
        let fraction = Number::rational(num.rem_euclid(den), den);
        if den == 2 {
            out.radicand = Some(out.radicand.as_ref().map_or_else(|| number.clone(), |r| r.mul(number)));
        } else if let Some(root) = exact_root(number, den) {
            out.coefficient = out.coefficient.mul(&root.powi(num.rem_euclid(den))?);
        } else {
            let base = self.number(number);
            out.push(self, base, &fraction);
        }
        Ok(())
    }

    /// The value of base ** exponent at the random point.
    pub(super) fn power_value(&self, base: Id, exponent: &Number) -> Element {
        if exponent.is_integer() {
            return self.value(base).power(exponent);
        }
        if self.is_positive(base) && matches!(self.kind(base), Kind::Symbol(_)) {
            return self.value(base).pow_rational(exponent);
        }
        let whole = exponent.floor();
        let fraction = exponent.sub(&whole);
        let integral = self.value(base).power(&whole);
        if let Some(number) = self.as_number(base)
            && fraction == Number::rational(1, 2)
        {
            return integral * radical_value(number);
        }
        let key = Key::new("root").element(self.value(base));
        integral * Element::draw_exponential(&key).pow_rational(&fraction)
    }
}
