//! Fingerprints: values in the two hash lanes at once.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Zero;
use std::ops::{Add, Mul, Neg, Sub};

use super::lanes::LANES;
use super::number::Number;
use super::prime::Prime;

const PRIMES: [Prime; 2] = [Prime::new(LANES[0][0]), Prime::new(LANES[1][0])];

/// An element of the fields of both hash lanes, in Montgomery form: the fingerprint of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Element([u64; 2]);

impl Element {
    /// The value of 0.
    pub const ZERO: Self = Self([0, 0]);
    /// The value of 1.
    pub const ONE: Self = Self([PRIMES[0].one, PRIMES[1].one]);

    #[inline]
    fn zip(self, other: Self, op: impl Fn(&Prime, u64, u64) -> u64) -> Self {
        Self([op(&PRIMES[0], self.0[0], other.0[0]), op(&PRIMES[1], self.0[1], other.0[1])])
    }

    /// Whether the value is zero at both points.
    #[inline]
    #[must_use]
    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    /// Whether the value vanishes at one of the two points (it then has no reciprocal).
    #[must_use]
    pub const fn is_singular(self) -> bool {
        self.0[0] == 0 || self.0[1] == 0
    }

    /// The reciprocal; zero stays zero.
    #[must_use]
    pub fn inverse(self) -> Self {
        self.zip(self, |prime, a, _| prime.inverse(a))
    }

    /// A power with an integer exponent (negative: of the reciprocal).
    #[must_use]
    pub fn powi(self, exponent: i64) -> Self {
        let base = if exponent < 0 { self.inverse() } else { self };
        let n = exponent.unsigned_abs();
        base.zip(base, |prime, a, _| prime.pow(a, n))
    }

    /// The simple rational with this value at both points, if there is one.
    #[must_use]
    pub fn to_simple_rational(self) -> Option<Number> {
        const LARGEST: u32 = 1 << 30;
        let (num, den) = PRIMES[0].simple_fraction(self.0[0], LARGEST)?;
        PRIMES[1].is_fraction(self.0[1], num, den).then(|| Number::rational(num, den))
    }

    /// A rational with this value whose numerator and denominator are short together: that before the largest quotient of
    /// Euclid's algorithm [Monagan 2004]. It is right if there is one of about 100 bits, and any number if not.
    pub(crate) fn to_rational_of_short_form(self) -> Option<Number> {
        let (modulus, residue) = self.residue_of_both()?;
        let (mut r0, mut r1) = (modulus, residue);
        let (mut t0, mut t1) = (BigInt::from(0), BigInt::from(1));
        let mut best: Option<(BigInt, BigInt, BigInt)> = None;
        while !r1.is_zero() {
            let quotient = &r0 / &r1;
            if best.as_ref().is_none_or(|(largest, ..)| quotient > *largest) {
                best = Some((quotient.clone(), r1.clone(), t1.clone()));
            }
            (r0, r1) = (r1.clone(), r0 - &quotient * r1);
            (t0, t1) = (t1.clone(), t0 - quotient * t1);
        }
        let (_, num, den) = best?;
        Number::from_big(num, den).ok()
    }

    /// The product of both primes, and the number below it with both residues.
    fn residue_of_both(self) -> Option<(BigInt, BigInt)> {
        let [(p, a), (q, b)] =
            [0, 1].map(|k| (BigInt::from(PRIMES[k].p), BigInt::from(PRIMES[k].residue(self.0[k]))));
        let steps = ((b - &a) * p.modinv(&q)?).mod_floor(&q);
        let residue = a + &p * steps;
        Some((p * q, residue))
    }

    /// The rational with numerator and denominator below 2^45 that has this value, which has about 2^126 others to choose from.
    pub(crate) fn to_likely_rational(self) -> Option<Number> {
        const LARGEST: u128 = 1 << 45;
        let (mut r0, mut r1) = self.word_of_both();
        let (mut t0, mut t1, mut negative) = (0u128, 1u128, false);
        while r1 >= LARGEST {
            let quotient = r0 / r1;
            (r0, r1) = (r1, r0 - quotient * r1);
            (t0, t1) = (t1, t0 + quotient * t1);
            negative = !negative;
            if t1 >= LARGEST {
                return None;
            }
        }
        let (num, den) = (i64::try_from(r1).ok()?, i64::try_from(t1).ok()?);
        Some(Number::rational(if negative { -num } else { num }, den))
    }

    /// The product of both primes, which has less than 127 bits, and the number below it with both residues.
    fn word_of_both(self) -> (u128, u128) {
        let [p, q] = &PRIMES;
        let a = p.residue(self.0[0]);
        let difference = q.sub(self.0[1], q.natural(a % q.p));
        let steps = q.residue(q.mul(difference, q.inverse(q.natural(p.p % q.p))));
        (u128::from(p.p) * u128::from(q.p), u128::from(a) + u128::from(p.p) * u128::from(steps))
    }

    /// Return the value or its opposite, whichever represents both, and whether the sign was changed.
    #[inline]
    #[must_use]
    pub fn unsigned(self) -> (Self, bool) {
        let opposite = self.neg();
        if opposite.0 < self.0 { (opposite, true) } else { (self, false) }
    }

    /// The image of an exact number.
    #[must_use]
    pub fn from_number(value: &Number) -> Self {
        Self([PRIMES[0].number(value), PRIMES[1].number(value)])
    }

    pub(crate) const fn from_words(words: [u64; 2]) -> Self {
        Self(words)
    }

    /// The raw words, for hashing, ordering and keys.
    #[must_use]
    pub const fn words(self) -> [u64; 2] {
        self.0
    }
}

impl Add for Element {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(other, Prime::add)
    }
}

impl Sub for Element {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip(other, Prime::sub)
    }
}

impl Mul for Element {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.zip(other, Prime::mul)
    }
}

impl Neg for Element {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::ZERO - self
    }
}
