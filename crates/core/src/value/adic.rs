//! The q-adic numbers to a few digits, with roots of q: how often a prime q divides a value.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, Zero};

use super::key::Key;
use super::number::Number;

/// The digits of a number.
const DIGITS: u32 = 12;

/// A sum in which so many digits cancel is zero: what is left of it may be what earlier sums have left undecided.
const CANCELLED: i64 = 6;

/// The steps of Newton's iteration: each doubles the digits, of which there are two to a power of sqrt q.
const NEWTON: usize = 5;

/// Valuations are counted in parts of one, because those of roots are fractions.
pub(crate) const PARTS: i64 = 2520;

/// A term q^(valuation/PARTS) * unit of a q-adic number.
#[derive(Clone)]
pub(crate) struct Term {
    pub(crate) valuation: i64,
    unit: BigInt,
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

/// The q-adic numbers of a prime to a relative precision.
pub(crate) struct Adics {
    prime: BigInt,
    modulus: BigInt,
}

impl Adics {
    pub(crate) fn new(prime: &BigInt) -> Self {
        Self { prime: prime.clone(), modulus: num_traits::Pow::pow(prime, DIGITS) }
    }

    pub(crate) fn zero() -> Adic {
        Adic(Vec::new())
    }

    /// The number q^(valuation/PARTS) * integer; what is zero to the precision is zero.
    pub(crate) fn number(&self, integer: &BigInt, valuation: i64) -> Adic {
        Adic(self.term(integer, valuation).into_iter().collect())
    }

    fn term(&self, integer: &BigInt, mut valuation: i64) -> Option<Term> {
        let mut unit = integer.mod_floor(&self.modulus);
        if unit.is_zero() {
            return None;
        }
        while unit.is_multiple_of(&self.prime) {
            unit /= &self.prime;
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
            while integer.is_multiple_of(&self.prime) {
                integer /= &self.prime;
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
        let digits = (high.valuation - low.valuation) / PARTS;
        let shift = u32::try_from(digits).unwrap_or(u32::MAX).min(DIGITS);
        let shifted = &high.unit * num_traits::Pow::pow(&self.prime, shift);
        let sum = self.term(&(&low.unit + shifted), low.valuation)?;
        (sum.valuation - low.valuation < CANCELLED * PARTS).then_some(sum)
    }

    pub(crate) fn mul(&self, a: &Adic, b: &Adic) -> Adic {
        let mut product = Self::zero();
        for x in &a.0 {
            for y in &b.0 {
                let term = self.number(&(&x.unit * &y.unit), x.valuation + y.valuation);
                product = self.add(&product, &term);
            }
        }
        product
    }

    /// The reciprocal, by Newton's iteration from that of the leading term; zero stays zero.
    fn inverse(&self, a: &Adic) -> Adic {
        let leading = a.leading().and_then(|term| {
            self.term(&term.unit.modinv(&self.modulus).unwrap_or_default(), -term.valuation)
        });
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

    /// A rational power; the root of the unit is drawn, but for that of 1.
    pub(crate) fn rational_power(&self, base: &Adic, exponent: &Number, key: impl Fn() -> Key) -> Adic {
        if let Some(n) = exponent.to_i64() {
            return self.power(base, n);
        }
        let (num, den) = exponent.to_small().unwrap_or((0, 1));
        let Some(leading) = base.leading() else { return Self::zero() };
        let power = self.number(&BigInt::one(), leading.valuation.saturating_mul(num) / den);
        if base.0.len() == 1 && leading.unit.is_one() {
            return power;
        }
        self.mul(&power, &self.draw(&key()))
    }

    /// A unit drawn for a key.
    pub(crate) fn draw(&self, key: &Key) -> Adic {
        let words: Vec<u32> = (0..16).map(|salt| key.draw_word(salt)).collect();
        let drawn = BigInt::from(BigUint::new(words)).mod_floor(&self.modulus);
        let unit = if drawn.is_multiple_of(&self.prime) { drawn + 1 } else { drawn };
        self.number(&unit, 0)
    }
}
