//! The q-adic numbers to a few digits, with roots of q: how often a prime q divides a value.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;
use std::sync::Arc;

use super::key::Key;
use super::number::Number;
use super::unramified::{Integral, Unramified};

/// The steps of Newton's iteration: each doubles the digits, of which there are two to a power of sqrt q.
const NEWTON: usize = 5;

/// Valuations are counted in parts of one, because those of roots are fractions.
pub(crate) const PARTS: i64 = 2520;

/// A term q^(valuation/PARTS) * unit of a q-adic number.
#[derive(Clone)]
pub(crate) struct Term {
    pub(crate) valuation: i64,
    unit: Integral,
}

/// A number of the q-adic numbers with roots of q: terms whose valuations differ by fractions, none for zero.
#[derive(Clone)]
pub(crate) struct Adic(Vec<Term>);

impl Adic {
    /// The term of the lowest power of q.
    pub(crate) fn leading(&self) -> Option<&Term> {
        self.0.iter().min_by_key(|term| term.valuation)
    }
}

/// The q-adic numbers of a prime, and an extension of these, to a relative precision.
pub(crate) struct Adics {
    ring: Arc<Unramified>,
}

impl Adics {
    pub(crate) fn new(prime: &BigInt) -> Self {
        Self { ring: Unramified::of_prime(prime) }
    }

    pub(crate) fn prime(&self) -> Number {
        Number::whole(self.ring.prime.clone())
    }

    pub(crate) fn zero() -> Adic {
        Adic(Vec::new())
    }

    /// The number q^(valuation/PARTS) * integer; what is zero to the precision is zero.
    pub(crate) fn number(&self, integer: &BigInt, valuation: i64) -> Adic {
        Adic(self.term(self.ring.integer(integer), valuation).into_iter().collect())
    }

    fn term(&self, mut unit: Integral, mut valuation: i64) -> Option<Term> {
        if Unramified::is_zero(&unit) {
            return None;
        }
        while let Some(quotient) = self.ring.divided(&unit) {
            unit = quotient;
            valuation += PARTS;
        }
        Some(Term { valuation, unit })
    }

    pub(crate) fn rational(&self, number: &Number) -> Adic {
        if number.is_zero() {
            return Self::zero();
        }
        // Both may have more digits than the precision.
        let split = |mut integer: BigInt| {
            let mut valuation = 0;
            while integer.is_multiple_of(&self.ring.prime) {
                integer /= &self.ring.prime;
                valuation += PARTS;
            }
            self.number(&integer, valuation)
        };
        self.mul(&split(number.numerator()), &self.inverse(&split(number.denominator())))
    }

    pub(crate) fn add(&self, a: &Adic, b: &Adic) -> Adic {
        let mut sum = a.0.clone();
        for term in &b.0 {
            match sum.iter().position(|known| (known.valuation - term.valuation) % PARTS == 0) {
                Some(k) => {
                    let known = sum.swap_remove(k);
                    sum.extend(self.sum_of_terms(&known, term));
                }
                None => sum.push(term.clone()),
            }
        }
        Adic(sum)
    }

    fn sum_of_terms(&self, a: &Term, b: &Term) -> Option<Term> {
        let (low, high) = if a.valuation <= b.valuation { (a, b) } else { (b, a) };
        let digits = u32::try_from((high.valuation - low.valuation) / PARTS).unwrap_or(u32::MAX);
        let sum = self.term(self.ring.add(&low.unit, &high.unit, digits), low.valuation)?;
        // What is left of a sum in which half of the digits cancel may be what earlier sums have left undecided.
        let cancelled = (sum.valuation - low.valuation) / PARTS;
        (cancelled < i64::from(self.ring.digits / 2)).then_some(sum)
    }

    pub(crate) fn mul(&self, a: &Adic, b: &Adic) -> Adic {
        let mut product = Self::zero();
        for x in &a.0 {
            for y in &b.0 {
                let term = self.term(self.ring.mul(&x.unit, &y.unit), x.valuation + y.valuation);
                product = self.add(&product, &Adic(term.into_iter().collect()));
            }
        }
        product
    }

    /// The reciprocal, by Newton's iteration from that of the leading term; zero stays zero.
    fn inverse(&self, a: &Adic) -> Adic {
        let leading = a.leading().and_then(|term| self.term(self.ring.inverse(&term.unit), -term.valuation));
        let mut inverse = Adic(leading.into_iter().collect());
        if a.0.len() > 1 {
            let two = self.number(&2.into(), 0);
            let minus_one = self.number(&(-1).into(), 0);
            for _ in 0..NEWTON {
                let error = self.add(&two, &self.mul(&minus_one, &self.mul(a, &inverse)));
                inverse = self.mul(&inverse, &error);
            }
        }
        inverse
    }

    pub(crate) fn power(&self, base: &Adic, exponent: i64) -> Adic {
        let mut square = if exponent < 0 { self.inverse(base) } else { base.clone() };
        let (mut power, mut rest) = (self.number(&BigInt::one(), 0), exponent.unsigned_abs());
        while rest > 0 {
            if rest & 1 == 1 {
                power = self.mul(&power, &square);
            }
            square = self.mul(&square, &square);
            rest >>= 1;
        }
        power
    }

    /// A rational power. The root of a unit is drawn, but for that of 1, for the key of the value without the power of
    /// the prime that the argument of `key` is.
    pub(crate) fn rational_power(&self, base: &Adic, exponent: &Number, key: impl Fn(i64) -> Key) -> Adic {
        if let Some(n) = exponent.to_i64() {
            return self.power(base, n);
        }
        let (num, den) = exponent.to_small().unwrap_or((0, 1));
        let Some(leading) = base.leading() else { return Self::zero() };
        let power = self.number(&BigInt::one(), leading.valuation.saturating_mul(num) / den);
        if base.0.len() == 1 && Unramified::is_one(&leading.unit) {
            return power;
        }
        self.mul(&power, &self.draw(&key(leading.valuation.div_euclid(PARTS))))
    }

    /// A unit drawn for a key.
    pub(crate) fn draw(&self, key: &Key) -> Adic {
        Adic(self.term(self.ring.draw(key), 0).into_iter().collect())
    }
}
