//! Sparse polynomials over numbered atoms, with exact coefficients; exponents may be negative.

use num_bigint::BigInt;
use num_integer::Integer;
use std::collections::BTreeMap;

use crate::error::Error;
use crate::value::Number;

use super::monomial::Monomial;

/// The work that an operation may still do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    /// The most terms of one polynomial.
    terms: usize,
    /// The terms that may still be handled.
    work: usize,
    spent: usize,
}

impl Budget {
    pub(crate) const fn new(terms: usize, work: usize) -> Self {
        Self { terms, work, spent: 0 }
    }

    /// Use up `work`, or return the error that the limit is reached.
    pub(crate) fn spend(&mut self, work: usize) -> Result<(), Error> {
        self.spent = self.spent.saturating_add(work);
        if self.spent > self.work {
            return Err(Error::Limit { what: OPERATIONS, limit: self.work, found: self.spent });
        }
        Ok(())
    }

    /// The remaining work.
    pub(crate) const fn left(&self) -> usize {
        self.work.saturating_sub(self.spent)
    }

    fn admit(&self, polynomial: &Polynomial) -> Result<(), Error> {
        let found = polynomial.len();
        if found > self.terms {
            return Err(Error::Limit { what: TERMS, limit: self.terms, found });
        }
        Ok(())
    }
}

const TERMS: &str = "terms of an expanded expression";
const OPERATIONS: &str = "terms handled while expanding an expression";

/// A sum of monomials with coefficients other than zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Polynomial(BTreeMap<Monomial, Number>);

impl Polynomial {
    pub(crate) fn constant(value: Number) -> Self {
        Self::term(Monomial::default(), value)
    }

    pub(crate) fn term(monomial: Monomial, coefficient: Number) -> Self {
        if coefficient.is_zero() { Self::default() } else { Self(BTreeMap::from([(monomial, coefficient)])) }
    }

    pub(crate) fn atom(atom: u32) -> Self {
        Self::term(Monomial::power(atom, 1), Number::integer(1))
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Number)> + ExactSizeIterator {
        self.0.iter()
    }

    /// The term, if there is exactly one.
    pub(crate) fn single(&self) -> Option<(&Monomial, &Number)> {
        if self.len() == 1 { self.0.first_key_value() } else { None }
    }

    pub(crate) fn coefficient(&self, monomial: &Monomial) -> Option<&Number> {
        self.0.get(monomial)
    }

    /// The atoms that occur, in ascending order.
    pub(crate) fn atoms(&self) -> Vec<u32> {
        let mut atoms: Vec<u32> =
            self.0.keys().flat_map(|m| m.factors().iter().map(|&(atom, _)| atom)).collect();
        atoms.sort_unstable();
        atoms.dedup();
        atoms
    }

    pub(crate) fn add_term(&mut self, monomial: Monomial, coefficient: &Number) {
        use std::collections::btree_map::Entry;
        match self.0.entry(monomial) {
            Entry::Vacant(entry) => {
                if !coefficient.is_zero() {
                    entry.insert(coefficient.clone());
                }
            }
            Entry::Occupied(mut entry) => {
                let sum = entry.get().add(coefficient);
                if sum.is_zero() {
                    entry.remove();
                } else {
                    entry.insert(sum);
                }
            }
        }
    }

    pub(crate) fn add_scaled(&mut self, other: &Self, factor: &Number) {
        for (monomial, coefficient) in &other.0 {
            self.add_term(monomial.clone(), &coefficient.mul(factor));
        }
    }

    pub(crate) fn scaled(mut self, factor: &Number) -> Self {
        if factor.is_zero() {
            return Self::default();
        }
        if !factor.is_one() {
            for coefficient in self.0.values_mut() {
                *coefficient = coefficient.mul(factor);
            }
        }
        self
    }

    /// The product with a single term.
    pub(crate) fn shifted(&self, monomial: &Monomial, factor: &Number) -> Self {
        Self(self.0.iter().map(|(m, c)| (m.times(monomial), c.mul(factor))).collect())
    }

    pub(crate) fn times(&self, other: &Self, budget: &mut Budget) -> Result<Self, Error> {
        budget.spend(self.len().saturating_mul(other.len()))?;
        let mut product = Self::default();
        for (monomial, coefficient) in &self.0 {
            for (m, c) in &other.0 {
                product.add_term(monomial.times(m), &coefficient.mul(c));
            }
            budget.admit(&product)?;
        }
        Ok(product)
    }

    pub(crate) fn pow(&self, n: u64, budget: &mut Budget) -> Result<Self, Error> {
        let mut power = Self::constant(Number::integer(1));
        for bit in (0..u64::BITS - n.leading_zeros()).rev() {
            power = power.times(&power, budget)?;
            if n >> bit & 1 == 1 {
                power = power.times(self, budget)?;
            }
        }
        Ok(power)
    }

    /// The largest monomial that divides all terms and leaves no negative exponents.
    pub(crate) fn lowest_powers(&self) -> Monomial {
        let lowest =
            |atom: u32| self.0.keys().map(|m| m.exponent(atom)).min().expect("an atom occurs in a term");
        self.atoms()
            .into_iter()
            .fold(Monomial::default(), |floor, atom| floor.times(&Monomial::power(atom, lowest(atom))))
    }

    /// The number that leaves integers without a common divisor, signed so that the last one is positive:
    /// the common divisor of the numerators over the common multiple of the denominators. One for decimals.
    pub(crate) fn numeric_content(&self) -> Number {
        let (mut above, mut below) = (BigInt::from(0), BigInt::from(1));
        for coefficient in self.0.values() {
            if coefficient.is_decimal() {
                return Number::integer(1);
            }
            above = above.gcd(&coefficient.numerator());
            below = below.lcm(&coefficient.denominator());
        }
        if self.leading().is_some_and(|(_, coefficient)| coefficient.is_negative()) {
            above = -above;
        }
        if above == BigInt::from(0) {
            return Number::integer(1); // of no terms
        }
        Number::from_big(above, below).expect("a common multiple of denominators is positive")
    }

    fn leading(&self) -> Option<(&Monomial, &Number)> {
        self.0.last_key_value()
    }

    /// self / divisor, if that is a polynomial.
    pub(crate) fn divide_exactly(&self, divisor: &Self, budget: &mut Budget) -> Option<Self> {
        let (above, below) = (self.lowest_powers(), divisor.lowest_powers());
        let one = Number::integer(1);
        let mut rest = self.shifted(&above.pow(-1), &one);
        let divisor = divisor.shifted(&below.pow(-1), &one);
        let (lead, factor) = divisor.leading()?;
        let mut quotient = Self::default();
        while let Some((monomial, coefficient)) = rest.leading() {
            budget.spend(divisor.len()).ok()?;
            let (monomial, coefficient) = (monomial.over(lead), coefficient.mul(&factor.recip().ok()?));
            if !monomial.is_natural() {
                return None;
            }
            rest.add_scaled(&divisor.shifted(&monomial, &one), &coefficient.neg());
            quotient.add_term(monomial, &coefficient);
        }
        Some(quotient.shifted(&above.over(&below), &one))
    }

    /// The square root with a positive leading coefficient, if it is a polynomial.
    pub(crate) fn square_root(&self, budget: &mut Budget) -> Option<Self> {
        let (monomial, coefficient) = self.leading()?;
        let lead = monomial.halved()?;
        let factor = rational_root(coefficient)?;
        let half = factor.mul(&Number::integer(2)).recip().ok()?;
        let mut root = Self::term(lead.clone(), factor);
        let mut rest = self.clone();
        rest.add_scaled(&root.times(&root, budget).ok()?, &Number::integer(-1));
        while let Some((monomial, coefficient)) = rest.leading() {
            budget.spend(root.len()).ok()?;
            if 2 * root.len() > self.len() + 1 {
                return None;
            }
            let next = Self::term(monomial.over(&lead), coefficient.mul(&half));
            // (r + n)^2 - r^2 = 2 r n + n^2
            rest.add_scaled(&root.times(&next, budget).ok()?, &Number::integer(-2));
            rest.add_scaled(&next.times(&next, budget).ok()?, &Number::integer(-1));
            root.add_scaled(&next, &Number::integer(1));
        }
        Some(root)
    }
}

fn rational_root(number: &Number) -> Option<Number> {
    if number.is_negative() {
        return None;
    }
    let root = Number::from_big(number.numerator().sqrt(), number.denominator().sqrt()).ok()?;
    root.mul(&root).same_value(number).then(|| root.with_decimal(number.is_decimal()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget() -> Budget {
        Budget::new(100, 1000)
    }

    fn polynomial(terms: &[(i64, &[(u32, i64)])]) -> Polynomial {
        let mut sum = Polynomial::default();
        for (coefficient, factors) in terms {
            sum.add_term(Monomial::of(factors), &Number::integer(*coefficient));
        }
        sum
    }

    #[test]
    fn quotients_and_roots_undo_products() -> Result<(), Error> {
        let a = polynomial(&[(3, &[(0, 2)]), (-1, &[(1, 1)]), (2, &[(2, -1)])]);
        let b = polynomial(&[(1, &[(0, 1)]), (5, &[(1, 2), (2, 1)]), (7, &[])]);
        let product = a.times(&b, &mut budget())?;
        assert_eq!(product.divide_exactly(&a, &mut budget()), Some(b.clone()));
        assert_eq!(product.divide_exactly(&b, &mut budget()), Some(a));
        let square = b.pow(2, &mut budget())?;
        assert_eq!(square.square_root(&mut budget()), Some(b.clone()));
        let mut near = square;
        near.add_term(Monomial::default(), &Number::integer(1));
        assert_eq!(near.square_root(&mut budget()), None);
        assert_eq!(near.divide_exactly(&b, &mut budget()), None);
        Ok(())
    }

    #[test]
    fn limits_stop_a_power() {
        let sum = polynomial(&[(1, &[(0, 1)]), (1, &[(1, 1)]), (1, &[(2, 1)])]);
        assert!(matches!(sum.pow(50, &mut budget()), Err(Error::Limit { .. })));
    }
}
