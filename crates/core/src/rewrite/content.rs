//! What all terms of a sum have in common: a monomial and a number.

use crate::error::Error;
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

/// The common monomial, a common numeric factor where that saves multiplications, and the rest.
pub(crate) fn content(polynomial: &Polynomial) -> Result<(Monomial, Number, Polynomial), Error> {
    let monomial = common_monomial(polynomial);
    let factor = common_factor(polynomial);
    let rest = polynomial.shifted(&monomial.pow(-1), &factor.recip()?);
    Ok((monomial, factor, rest))
}

/// The powers that all terms share; an atom with positive and negative exponents has none.
pub(crate) fn common_monomial(polynomial: &Polynomial) -> Monomial {
    let mut monomials = polynomial.iter().map(|(monomial, _)| monomial);
    let Some(first) = monomials.next() else { return Monomial::default() };
    let mut ranges: Vec<(u32, i64, i64)> = first.factors().iter().map(|&(atom, e)| (atom, e, e)).collect();
    for monomial in monomials {
        ranges.retain_mut(|(atom, lowest, highest)| {
            let exponent = monomial.exponent(*atom);
            (*lowest, *highest) = (exponent.min(*lowest), exponent.max(*highest));
            *lowest > 0 || *highest < 0
        });
        if ranges.is_empty() {
            break;
        }
    }
    Monomial::of(ranges.into_iter().map(|(atom, lowest, _)| (atom, lowest)).collect())
}

/// The magnitude that most coefficients share, if one multiplication by it saves two or more; otherwise 1.
/// A magnitude that leaves integers is taken even if it saves nothing; one that leaves a quotient of a decimal, such as
/// 4.1/0.63, never.
fn common_factor(polynomial: &Polynomial) -> Number {
    let one = Number::integer(1);
    let mut candidates: Vec<Number> = Vec::new();
    for (_, coefficient) in polynomial.iter() {
        let magnitude = coefficient.abs();
        if !magnitude.is_one() && !candidates.iter().any(|known| known.same_value(&magnitude)) {
            candidates.push(magnitude);
        }
        if candidates.len() > 8 {
            return one;
        }
    }
    if candidates.is_empty() {
        return one;
    }
    let multiplications = |factor: &Number| {
        let not_unit = |c: &Number| !c.abs().same_value(factor);
        polynomial.iter().filter(|&(m, c)| not_unit(c) && !m.is_one()).count()
    };
    let whole = polynomial.numeric_content().abs();
    if !whole.is_integer() && !candidates.iter().any(|known| known.same_value(&whole)) {
        candidates.push(whole);
    }
    let fractions = |factor: &Number| {
        let over = |c: &Number| factor.recip().is_ok_and(|f| !c.is_decimal() && !c.mul(&f).is_integer());
        polynomial.iter().filter(|(_, c)| over(c)).count()
    };
    let stays_printable = |factor: &Number| {
        let is_printable = |c: &Number| c.decimal_over_integer().is_none();
        let quotient = |c: &Number| factor.recip().map_or_else(|_| c.clone(), |f| c.mul(&f));
        polynomial.iter().all(|(_, c)| is_printable(&quotient(c)) || !is_printable(c))
    };
    let mut best = (multiplications(&one), fractions(&one), one);
    for candidate in candidates.into_iter().filter(stays_printable) {
        let order = (multiplications(&candidate) + 1, fractions(&candidate));
        if order < (best.0, best.1) {
            best = (order.0, order.1, candidate);
        }
    }
    best.2
}
