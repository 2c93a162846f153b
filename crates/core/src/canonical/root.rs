//! Roots: the factors that may leave them.
//!
//! `sqrt(x**2)` is `Abs(x)`, never `x`. Square factors of numbers leave the root, and so do positive symbols. No rule
//! here changes a value: that of a root depends on the value of its argument alone (see `evaluate`).

use crate::error::Error;
use crate::graph::{Assumption, Flags, Function, Graph, Id, Kind, View};
use crate::value::Number;

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
            View::Function(Function::Exp, args) => self.is_real(id) && !self.may_be_negative(args.get(0)),
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

    /// Move the powers of primes to the coefficient and the factors: exponents lie in [0, 1), and those of 1/2 share
    /// square roots of numbers that can be factored again.
    pub(super) fn settle_primes(&mut self, out: &mut Collector) {
        if out.primes.is_empty() {
            return;
        }
        let mut radicands: Vec<Number> = Vec::new();
        for (prime, exponent) in std::mem::take(&mut out.primes) {
            let prime = Number::whole(prime);
            let whole = exponent.floor();
            let power = whole.to_i64().and_then(|n| prime.powi(n).ok());
            out.coefficient =
                out.coefficient.mul(&power.expect("a prime factor of a number that is not too large"));
            let fraction = exponent.sub(&whole);
            if fraction == Number::rational(1, 2) {
                match radicands.last_mut().filter(|known| fits_word(&known.mul(&prime))) {
                    Some(known) => *known = known.mul(&prime),
                    None => radicands.push(prime),
                }
            } else if !fraction.is_zero() {
                out.factors.push((self.number(&prime), fraction));
            }
        }
        for radicand in radicands {
            out.factors.push((self.number(&radicand), Number::rational(1, 2)));
        }
    }
}

/// Whether an integer is so short that all of its prime factors are found.
fn fits_word(number: &Number) -> bool {
    number.numerator().bits() <= u64::BITS.into()
}

/// Multiply by a power of a number.
///
/// # Errors
/// If an even root of a negative number is taken, or the power is too large.
pub(super) fn collect_number(out: &mut Collector, number: &Number, exponent: &Number) -> Result<(), Error> {
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
    let too_large = || Error::NumberTooLarge(format!("{number}**({exponent})"));
    let whole = exponent.floor().to_i64().ok_or_else(too_large)?;
    out.coefficient = out.coefficient.mul(&number.powi(whole)?);
    out.push_power_of_number(number, &exponent.sub(&Number::integer(whole)));
    Ok(())
}
