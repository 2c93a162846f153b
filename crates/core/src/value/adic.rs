//! The q-adic numbers to a few digits, with roots of q: how often a prime q divides a value.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;
use std::cell::Cell;
use std::cmp::Ordering;
use std::sync::Arc;

use super::coefficient::Coefficient;
use super::key::Key;
use super::number::Number;
use super::unramified::{Integral, Unramified};

/// More terms than these lowest ones are not kept: the leading one is what is asked for.
const MOST_TERMS: usize = 64;

/// A term q^valuation * unit of a q-adic number. Valuations are fractions where q has roots.
#[derive(Clone)]
pub(crate) struct Term<C> {
    pub(crate) valuation: Number,
    unit: Integral<C>,
}

/// A number of the q-adic numbers with roots of q: terms whose valuations differ by fractions, none for zero.
#[derive(Clone)]
pub(crate) struct Adic<C>(Vec<Term<C>>);

impl<C: Coefficient> Adic<C> {
    /// The term of the lowest power of q.
    pub(crate) fn leading(&self) -> Option<&Term<C>> {
        self.0.iter().min_by(|a, b| a.valuation.compare(&b.valuation))
    }
}

/// The q-adic numbers of a prime, and an extension of these, to a relative precision.
pub(crate) struct Adics<C> {
    ring: Arc<Unramified<C>>,
    /// Whether so many digits of a sum have cancelled that it counts as zero.
    lost: Cell<bool>,
}

impl<C: Coefficient> Adics<C> {
    pub(crate) fn new(ring: Arc<Unramified<C>>) -> Self {
        Self { ring, lost: Cell::new(false) }
    }

    /// Whether a sum has counted as zero because so many of its digits have cancelled, and then no more.
    pub(crate) fn take_lost(&self) -> bool {
        self.lost.take()
    }

    pub(crate) fn prime(&self) -> Number {
        Number::whole(self.ring.whole_prime())
    }

    /// Whether roots of odd degree are looked for. With a prime of many digits, which may be a product, this takes long.
    pub(crate) fn has_odd_roots(&self) -> bool {
        self.ring.whole_prime().bits() <= 64
    }

    pub(crate) fn zero() -> Adic<C> {
        Adic(Vec::new())
    }

    /// An integer; what is zero to the precision is zero.
    pub(crate) fn integer(&self, integer: &BigInt) -> Adic<C> {
        self.multiple(integer, Number::integer(0))
    }

    /// The number q^valuation * integer.
    fn multiple(&self, integer: &BigInt, valuation: Number) -> Adic<C> {
        Adic(self.term(self.ring.integer(integer), valuation).into_iter().collect())
    }

    fn term(&self, mut unit: Integral<C>, valuation: Number) -> Option<Term<C>> {
        if Unramified::is_zero(&unit) {
            return None;
        }
        let mut powers = 0;
        while let Some(quotient) = self.ring.divided(&unit) {
            unit = quotient;
            powers += 1;
        }
        let valuation = if powers == 0 { valuation } else { valuation.add(&Number::integer(powers)) };
        Some(Term { valuation, unit })
    }

    pub(crate) fn rational(&self, number: &Number) -> Adic<C> {
        if number.is_zero() {
            return Self::zero();
        }
        // Both may have more digits than the precision.
        let prime = self.ring.whole_prime();
        let split = |mut integer: BigInt| {
            let mut valuation = 0;
            while integer.is_multiple_of(&prime) {
                integer /= &prime;
                valuation += 1;
            }
            self.multiple(&integer, Number::integer(valuation))
        };
        self.mul(&split(number.numerator()), &self.inverse(&split(number.denominator())))
    }

    pub(crate) fn add(&self, a: &Adic<C>, b: &Adic<C>) -> Adic<C> {
        let mut sum = a.0.clone();
        for term in &b.0 {
            let is_alike = |known: &Term<C>| known.valuation.sub(&term.valuation).is_integer();
            match sum.iter().position(is_alike) {
                Some(k) => {
                    let known = sum.swap_remove(k);
                    sum.extend(self.sum_of_terms(&known, term));
                }
                None => sum.push(term.clone()),
            }
        }
        if sum.len() > MOST_TERMS {
            sum.sort_by(|a, b| a.valuation.compare(&b.valuation));
            sum.truncate(MOST_TERMS);
        }
        Adic(sum)
    }

    fn sum_of_terms(&self, a: &Term<C>, b: &Term<C>) -> Option<Term<C>> {
        let is_ordered = a.valuation.compare(&b.valuation) != Ordering::Greater;
        let (low, high) = if is_ordered { (a, b) } else { (b, a) };
        let digits =
            high.valuation.sub(&low.valuation).to_i64().and_then(|digits| u32::try_from(digits).ok());
        let sum = self.ring.add(&low.unit, &high.unit, digits.unwrap_or(u32::MAX));
        // What is left of a sum in which half of the digits cancel may be what earlier sums have left undecided.
        let half = Number::integer((self.ring.digits / 2).into());
        let is_decided = |sum: &Term<C>| sum.valuation.sub(&low.valuation).compare(&half).is_lt();
        let sum = self.term(sum, low.valuation.clone()).filter(is_decided);
        if sum.is_none() {
            self.lost.set(true);
        }
        sum
    }

    pub(crate) fn mul(&self, a: &Adic<C>, b: &Adic<C>) -> Adic<C> {
        let mut product = Self::zero();
        for x in &a.0 {
            for y in &b.0 {
                let term = self.term(self.ring.mul(&x.unit, &y.unit), x.valuation.add(&y.valuation));
                product = self.add(&product, &Adic(term.into_iter().collect()));
            }
        }
        product
    }

    /// The reciprocal, by Newton's iteration from that of the leading term; zero stays zero.
    ///
    /// There are two digits to a power of sqrt(q), so that it takes one step more. The digits of the error cancel.
    fn inverse(&self, a: &Adic<C>) -> Adic<C> {
        let lost = self.lost.get();
        let reciprocal = |term: &Term<C>| self.term(self.ring.inverse(&term.unit), term.valuation.neg());
        let leading = a.leading().and_then(reciprocal);
        let mut inverse = Adic(leading.into_iter().collect());
        if a.0.len() > 1 {
            let two = self.integer(&2.into());
            let minus_one = self.integer(&(-1).into());
            for _ in 0..=self.ring.newton_steps() {
                let error = self.add(&two, &self.mul(&minus_one, &self.mul(a, &inverse)));
                inverse = self.mul(&inverse, &error);
            }
        }
        self.lost.set(lost);
        inverse
    }

    pub(crate) fn power(&self, base: &Adic<C>, exponent: i64) -> Adic<C> {
        let mut square = if exponent < 0 { self.inverse(base) } else { base.clone() };
        let (mut power, mut rest) = (self.integer(&BigInt::one()), exponent.unsigned_abs());
        while rest > 0 {
            if rest & 1 == 1 {
                power = self.mul(&power, &square);
            }
            square = self.mul(&square, &square);
            rest >>= 1;
        }
        power
    }

    /// A root, if there is one: 1 of 1, and otherwise the one that a number chooses.
    pub(crate) fn root(&self, radicand: &Adic<C>, degree: u64, choice: u32) -> Option<Adic<C>> {
        let [Term { valuation, unit }] = &radicand.0[..] else { return None };
        let valuation = valuation.mul(&Number::from_big(BigInt::one(), degree.into()).ok()?);
        let is_one = Unramified::is_one(unit);
        let unit = if is_one { unit.clone() } else { self.ring.root(unit, degree, choice)? };
        Some(Adic(vec![Term { valuation, unit }]))
    }

    /// A rational power that is drawn, but for that of 1, for the key of the base without the power of the prime that the argument of `key` is.
    pub(crate) fn drawn_power(
        &self,
        base: &Adic<C>,
        exponent: &Number,
        key: impl Fn(&Number) -> Key,
    ) -> Adic<C> {
        let Some(leading) = base.leading() else { return Self::zero() };
        let power = self.multiple(&BigInt::one(), leading.valuation.mul(exponent));
        if base.0.len() == 1 && Unramified::is_one(&leading.unit) {
            return power;
        }
        self.mul(&power, &self.draw(&key(&leading.valuation.floor())))
    }

    /// A unit drawn for a key.
    pub(crate) fn draw(&self, key: &Key) -> Adic<C> {
        Adic(self.term(self.ring.draw(key), Number::integer(0)).into_iter().collect())
    }
}
