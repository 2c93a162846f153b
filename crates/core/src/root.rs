//! Roots: what may leave them, and their values at the random point.
//!
//! A root of a symbolic argument is an opaque value: `sqrt(x**2)` must not become `x`. Numbers leave their
//! square factors outside; positive symbols leave as they are.

use crate::collector::Collector;
use crate::error::Error;
use crate::field::{Element, Key};
use crate::function::Function;
use crate::graph::Graph;
use crate::node::{Assumption, Flags, Id, Kind, View};
use crate::number::Number;

const POSITIVE: &str = "the denominator of a number is positive";

impl Graph {
    /// Whether no symbol below may be complex.
    pub(crate) fn is_real(&self, id: Id) -> bool {
        !self.flags(id).has(Flags::COMPLEX)
    }

    /// Whether the node is positive by what the user promised.
    pub(crate) fn is_positive(&self, id: Id) -> bool {
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

    pub(crate) fn collect_number(
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
    pub(crate) fn power_value(&self, base: Id, exponent: &Number) -> Element {
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

/// number = outside^2 * inside, with a square-free integer inside as far as trial division tells.
pub(crate) fn square_part(number: &Number) -> (Number, Number) {
    let decimal = number.is_decimal();
    let mut inside = number.numerator() * number.denominator();
    let mut outside = num_bigint::BigInt::from(1);
    for q in 2u32..2000 {
        let square = num_bigint::BigInt::from(q) * q;
        if square > inside {
            break;
        }
        while (&inside % &square).bits() == 0 {
            inside /= &square;
            outside *= q;
        }
    }
    let root = inside.sqrt();
    if &root * &root == inside {
        outside *= root;
        inside = num_bigint::BigInt::from(1);
    }
    let outside = Number::from_big(outside, number.denominator()).expect(POSITIVE);
    (outside.with_decimal(decimal), Number::whole(inside))
}

/// The exact root of a number, if it has one.
fn exact_root(number: &Number, degree: i64) -> Option<Number> {
    let degree = u32::try_from(degree).ok()?;
    let (num, den) = (number.numerator().nth_root(degree), number.denominator().nth_root(degree));
    let root = Number::from_big(num, den).ok()?.with_decimal(number.is_decimal());
    root.powi(i64::from(degree)).ok()?.same_value(number).then_some(root)
}

/// The value of sqrt(number): the product of the roots of its primes.
fn radical_value(number: &Number) -> Element {
    if number.is_zero() {
        return Element::ZERO; // which every prime divides, as often as one tries
    }
    let mut rest = number.numerator() * number.denominator();
    let mut value = Element::from_number(&Number::from_big(1.into(), number.denominator()).expect(POSITIVE));
    for q in 2u32..2000 {
        while (&rest % q).bits() == 0 {
            rest /= q;
            value = value * crate::angle::prime_root(q);
        }
    }
    if rest == num_bigint::BigInt::from(1) {
        return value;
    }
    value * crate::angle::free_root(&Number::whole(rest))
}
