//! Sparse polynomials over numbered atoms, with exact coefficients; exponents may be negative.

use num_bigint::BigInt;
use num_integer::Integer;
use std::collections::BTreeMap;

use crate::error::Error;
use crate::interrupt::tick;
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

    /// Count up to so much of the work so far as not done.
    pub(crate) const fn return_work(&mut self, work: usize) {
        self.spent = self.spent.saturating_sub(work);
    }

    /// The remaining work.
    pub(crate) const fn left(&self) -> usize {
        self.work.saturating_sub(self.spent)
    }

    fn admit(&self, polynomial: &Polynomial) -> Result<(), Error> {
        self.admit_terms(polynomial.len())
    }

    fn admit_terms(&self, found: usize) -> Result<(), Error> {
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

    /// The sum of terms with different monomials, and without zeros.
    pub(crate) fn of_terms(terms: impl Iterator<Item = (Monomial, Number)>) -> Self {
        Self(terms.collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// The powers of atoms in all terms together.
    pub(crate) fn factor_count(&self) -> usize {
        self.0.keys().map(|monomial| monomial.factors().len()).sum()
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
        tick();
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
        if monomial.is_one() && factor.is_one() && !factor.is_decimal() {
            return self.clone();
        }
        Self(self.0.iter().map(|(m, c)| (m.times(monomial), c.mul(factor))).collect())
    }

    pub(crate) fn times(&self, other: &Self, budget: &mut Budget) -> Result<Self, Error> {
        let words = words_of(self.largest_bits().saturating_add(other.largest_bits()));
        budget.spend(self.len().saturating_mul(other.len()).saturating_mul(words))?;
        let mut product = Self::default();
        for (monomial, coefficient) in &self.0 {
            for (m, c) in &other.0 {
                product.add_term(monomial.times(m), &coefficient.mul(c));
            }
            budget.admit(&product)?;
        }
        Ok(product)
    }

    /// A natural power, by the binomial theorem: the sum of `C(n, k) t**(n - k) r**k` for a term t and the rest r, whose
    /// powers are built up. The work is near the number of terms of the result, times those of r.
    pub(crate) fn pow(&self, n: u64, budget: &mut Budget) -> Result<Self, Error> {
        let n = usize::try_from(n).unwrap_or(usize::MAX);
        let Some((lead, factor)) = self.leading().filter(|_| self.len() > 1 && n > 1) else {
            return self.small_power(n);
        };
        // A root of multiplicity n, other than zero, needs n + 1 terms [Hajos].
        budget.admit_terms(n.saturating_add(1))?;
        let words = self.words_of_power(n);
        let mut factors = vec![Number::integer(1), factor.clone()];
        while factors.len() <= n {
            budget.spend(words)?;
            factors.push(factors[factors.len() - 1].mul(factor));
        }
        let mut rest = self.clone();
        rest.0.remove(lead);
        let mut power = Self::constant(Number::integer(1));
        let (mut result, mut binomial) = (Self::default(), BigInt::from(1));
        for k in 0..=n {
            budget.spend(power.len().saturating_mul(words))?;
            let multiple = factors[n - k].mul(&Number::whole(binomial.clone()));
            let monomial = lead.pow(exponent(n - k));
            for (m, c) in &power.0 {
                result.add_term(monomial.times(m), &c.mul(&multiple));
            }
            budget.admit(&result)?;
            if k < n {
                power = power.times(&rest, budget)?;
                binomial = binomial * (n - k) / (k + 1);
            }
        }
        Ok(result)
    }

    /// A power that is one term, or the polynomial itself.
    fn small_power(&self, n: usize) -> Result<Self, Error> {
        match (self.single(), n) {
            (_, 0) => Ok(Self::constant(Number::integer(1))),
            (Some((monomial, coefficient)), _) => {
                let n = exponent(n);
                Ok(Self::term(monomial.pow(n), coefficient.powi(n)?))
            }
            _ => Ok(self.clone()),
        }
    }

    /// A bound on the words of a coefficient of the n-th power.
    fn words_of_power(&self, n: usize) -> usize {
        let of_factor = self.largest_bits().saturating_add((self.len() - 1).ilog2() as usize + 1);
        words_of(n.saturating_mul(of_factor))
    }

    /// The most bits of a numerator or denominator.
    fn largest_bits(&self) -> usize {
        let bits = |number: &Number| match number.to_small() {
            Some((above, below)) => (above.unsigned_abs() | below.unsigned_abs()).ilog2().into(),
            None => number.numerator().bits().max(number.denominator().bits()) - 1,
        };
        usize::try_from(self.0.values().map(bits).max().unwrap_or_default()).unwrap_or(usize::MAX)
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
        if let Some((above, below)) = self.small_content() {
            let is_negative = self.leading().is_some_and(|(_, coefficient)| coefficient.is_negative());
            return Number::rational(if is_negative { -above } else { above }, below);
        }
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

    /// The same without its sign, as numerator and denominator, if all numbers are small and exact.
    fn small_content(&self) -> Option<(i64, i64)> {
        let (mut above, mut below) = (0_i64, 1_i64);
        for coefficient in self.0.values() {
            let (numerator, denominator) = coefficient.to_small().filter(|_| !coefficient.is_decimal())?;
            above = above.gcd(&numerator.checked_abs()?);
            below = (below / below.gcd(&denominator)).checked_mul(denominator)?;
        }
        (above != 0).then_some((above, below))
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

/// A word has 256 bits, so that the coefficients of usual powers count as one.
fn words_of(bits: usize) -> usize {
    bits / 256 + 1
}

fn exponent(n: usize) -> i64 {
    i64::try_from(n).expect("a budget of terms bounds the exponents of sums")
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
            sum.add_term(Monomial::of(factors.to_vec()), &Number::integer(*coefficient));
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
    fn a_power_is_a_repeated_product() -> Result<(), Error> {
        let sums = [
            polynomial(&[(3, &[(0, 2)]), (-1, &[(1, 1)]), (2, &[(2, -1)])]),
            polynomial(&[(1, &[(0, 1)]), (1, &[(0, 2)]), (1, &[]), (-2, &[(0, -3)])]),
            polynomial(&[(-5, &[(0, 1), (1, 3)])]),
            polynomial(&[]),
        ];
        for sum in sums {
            let mut product = Polynomial::constant(Number::integer(1));
            for n in 0..7 {
                assert_eq!(sum.pow(n, &mut Budget::new(1000, 100_000))?, product);
                product = product.times(&sum, &mut Budget::new(1000, 100_000))?;
            }
        }
        Ok(())
    }

    /// A dense power in one atom, a sparse one in four, and coefficients of many digits.
    #[test]
    fn the_work_of_a_power_is_near_its_terms() -> Result<(), Error> {
        let dense = polynomial(&[(1, &[]), (1, &[(0, 1)]), (1, &[(0, 2)])]);
        assert_eq!(dense.pow(200, &mut Budget::new(401, 1_000_000))?.len(), 401);
        let four = polynomial(&[(1, &[(0, 1)]), (1, &[(1, 1)]), (1, &[(2, 1)]), (1, &[(3, 1)])]);
        let mut budget = Budget::new(39_711, 1_000_000);
        assert_eq!(four.pow(60, &mut budget)?.len(), 39_711);
        let two = polynomial(&[(1, &[(0, 1)]), (1, &[(1, 1)])]);
        for n in [200_000, u64::MAX] {
            assert!(matches!(two.pow(n, &mut Budget::new(200_000, 5_000_000)), Err(Error::Limit { .. })));
        }
        Ok(())
    }

    /// The digits of coefficients are work, too, in single products as in powers.
    #[test]
    fn long_coefficients_are_work() -> Result<(), Error> {
        let mut sum = polynomial(&[(1, &[(0, 1)]), (1, &[])]);
        assert!(sum.times(&sum, &mut budget()).is_ok());
        sum.add_term(Monomial::of(vec![(0, 1)]), &Number::integer(3).powi(100_000)?);
        assert!(matches!(sum.times(&sum, &mut budget()), Err(Error::Limit { .. })));
        assert!(matches!(sum.pow(2, &mut budget()), Err(Error::Limit { .. })));
        Ok(())
    }

    #[test]
    fn limits_stop_a_power() {
        let sum = polynomial(&[(1, &[(0, 1)]), (1, &[(1, 1)]), (1, &[(2, 1)])]);
        assert!(matches!(sum.pow(50, &mut budget()), Err(Error::Limit { .. })));
    }
}
