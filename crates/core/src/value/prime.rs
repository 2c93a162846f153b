//! Arithmetic modulo a prime, in Montgomery form [Montgomery 1985].
//!
//! All primes here are 3 mod 4, so that -1 is no square: of the two roots of a square, exactly one is a square itself.

use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

use super::number::Number;

const RESIDUE: &str = "a residue is between zero and its modulus, a word";

/// A prime below 2^63 with the constants of its Montgomery form. Elements are words in that form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prime {
    pub p: u64,
    /// -p^-1 mod 2^64, for Montgomery multiplication.
    neg_inverse: u64,
    /// 2^64 mod p (the Montgomery form of one) and 2^128 mod p.
    pub one: u64,
    r2: u64,
}

impl Prime {
    #[expect(clippy::cast_possible_truncation, reason = "remainders by a word are below it")]
    pub(super) const fn new(p: u64) -> Self {
        let mut inverse: u64 = 1;
        let mut i = 0;
        while i < 6 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
            i += 1;
        }
        let one = ((1u128 << 64) % p as u128) as u64;
        let r2 = (one as u128 * one as u128 % p as u128) as u64;
        Self { p, neg_inverse: inverse.wrapping_neg(), one, r2 }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "Montgomery's m is a remainder by 2^64, and u is below 2 p"
    )]
    const fn reduce(&self, t: u128) -> u64 {
        let m = (t as u64).wrapping_mul(self.neg_inverse);
        let u = ((t + m as u128 * self.p as u128) >> 64) as u64;
        if u >= self.p { u - self.p } else { u }
    }

    pub(super) const fn mul(&self, a: u64, b: u64) -> u64 {
        self.reduce(a as u128 * b as u128)
    }

    pub(super) const fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    pub(super) const fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    pub(super) const fn neg(&self, a: u64) -> u64 {
        self.sub(0, a)
    }

    pub(super) fn pow(&self, mut base: u64, mut exponent: u64) -> u64 {
        let mut result = self.one;
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(result, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        result
    }

    /// The reciprocal; zero stays zero.
    pub(super) fn inverse(&self, a: u64) -> u64 {
        self.pow(a, self.p - 2)
    }

    pub(super) fn half(&self, a: u64) -> u64 {
        let (half, odd) = (a >> 1, a & 1);
        if odd == 1 { half + (self.p >> 1) + 1 } else { half }
    }

    /// Whether an element is a square (zero is): its quadratic character, as Jacobi's symbol.
    pub(super) fn is_square(&self, a: u64) -> bool {
        // The Montgomery factor 2^64 is a square, so the form itself may be tested.
        let (mut a, mut n, mut positive) = (a, self.p, true);
        if a == 0 {
            return true;
        }
        while a != 0 {
            let zeros = a.trailing_zeros();
            a >>= zeros;
            if zeros & 1 == 1 && (n & 7 == 3 || n & 7 == 5) {
                positive = !positive;
            }
            if a & 3 == 3 && n & 3 == 3 {
                positive = !positive;
            }
            (a, n) = (n % a, a);
        }
        positive
    }

    /// The root of a square that is a square itself.
    pub(super) fn root(&self, square: u64) -> u64 {
        self.pow(square, self.p.div_ceil(4))
    }

    /// The image of an integer that is not negative.
    pub(super) const fn natural(&self, value: u64) -> u64 {
        self.mul(value % self.p, self.r2)
    }

    /// The integer between zero and the prime of which an element is the image.
    pub(super) fn residue(&self, element: u64) -> u64 {
        self.reduce(u128::from(element))
    }

    /// The numerator and the denominator, not larger than a bound, of a rational with this image, if there is one.
    ///
    /// Rational reconstruction [Wang 1981]: Euclid's algorithm on (p, a) stopped half way. The denominators grow, so it
    /// ends early for nearly all elements.
    pub(super) fn simple_fraction(&self, element: u64, largest: u32) -> Option<(i64, i64)> {
        let largest = u64::from(largest);
        let (mut r0, mut r1) = (self.p, self.residue(element));
        let (mut t0, mut t1, mut negative) = (0u64, 1u64, false);
        while r1 > largest {
            let q = r0 / r1;
            (r0, r1) = (r1, r0 - q * r1);
            (t0, t1) = (t1, t0 + q * t1);
            negative = !negative;
            if t1 > largest {
                return None;
            }
        }
        let (num, den) = (i64::try_from(r1).ok()?, i64::try_from(t1).ok()?);
        Some((if negative { -num } else { num }, den))
    }

    /// Whether an element is the image of num/den.
    pub(super) fn is_fraction(&self, element: u64, num: i64, den: i64) -> bool {
        self.mul(element, self.whole(den)) == self.whole(num)
    }

    fn whole(&self, value: i64) -> u64 {
        let element = self.natural(value.unsigned_abs());
        if value < 0 { self.neg(element) } else { element }
    }

    fn integer(&self, value: &BigInt) -> u64 {
        let magnitude = (value.abs() % self.p).to_u64().expect(RESIDUE);
        let element = self.natural(magnitude);
        if value.is_negative() { self.neg(element) } else { element }
    }

    /// The image of an exact number. Its denominator is not a multiple of the prime.
    pub(super) fn number(&self, value: &Number) -> u64 {
        match value.to_small() {
            Some((num, den)) => {
                let element = self.whole(num);
                if den == 1 { element } else { self.mul(element, self.inverse(self.whole(den))) }
            }
            None => {
                self.mul(self.integer(&value.numerator()), self.inverse(self.integer(&value.denominator())))
            }
        }
    }
}

/// num / den modulo any odd number that shares no factor with den; `None` if they share one.
pub(super) fn fraction_modulo(value: &Number, order: u64) -> Option<u64> {
    let modulo_big = |big: &BigInt| {
        let rest = big % order;
        let rest = if rest.is_negative() { rest + order } else { rest };
        rest.to_u64().expect(RESIDUE)
    };
    let modulo = |small: i64| {
        let rest = small.unsigned_abs() % order;
        if small < 0 && rest > 0 { order - rest } else { rest }
    };
    let (num, den) = match value.to_small() {
        Some((num, den)) => (modulo(num), modulo(den)),
        None => (modulo_big(&value.numerator()), modulo_big(&value.denominator())),
    };
    if value.is_integer() {
        return Some(num);
    }
    inverse_modulo(den, order).map(|inverse| mul_mod(num, inverse, order))
}

/// The reciprocal modulo any number, by Euclid's algorithm.
fn inverse_modulo(value: u64, modulus: u64) -> Option<u64> {
    let word = |value: u64| i64::try_from(value).expect("moduli are below 2^63");
    let (mut r0, mut r1) = (word(modulus), word(value));
    let (mut t0, mut t1) = (0i64, 1i64);
    while r1 != 0 {
        let q = r0 / r1;
        (r0, r1) = (r1, r0 - q * r1);
        (t0, t1) = (t1, t0 - q * t1);
    }
    let inverse = t0.rem_euclid(word(modulus)).unsigned_abs();
    (r0 == 1).then_some(inverse)
}

#[expect(clippy::cast_possible_truncation, reason = "a remainder by a word is below it")]
pub(super) fn mul_mod(a: u64, b: u64, m: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(m)) as u64
}
