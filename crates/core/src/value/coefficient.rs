//! Numbers modulo a power of a prime: in words where sums of their products fit into two words, and of any length otherwise.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

/// A number from zero to below a modulus.
pub(crate) trait Coefficient: Integer + Clone + Send + Sync + 'static {
    /// Words of 32 bits from which one is drawn.
    const DRAWN: u64;

    fn two() -> Self {
        Self::one() + Self::one()
    }

    /// A number that is known to lie below the modulus.
    fn below_modulus(number: &BigInt) -> Self;

    fn to_big(&self) -> BigInt;

    fn from_words(words: Vec<u32>, modulus: &Self) -> Self;

    /// (a + b factor) mod m
    fn sum(a: &Self, b: &Self, factor: &Self, modulus: &Self) -> Self;

    /// The reciprocal; zero if there is none.
    fn reciprocal(&self, modulus: &Self) -> Self;

    fn power(&self, exponent: &BigInt, modulus: &Self) -> Self;

    /// The product of two polynomials of a degree below d modulo x^d + `low`.
    fn product(a: &[Self], b: &[Self], low: &[Self], modulus: &Self) -> Vec<Self>;
}

/// The bits of a modulus for which a word of 128 bits holds sums of as many products as there are.
pub(super) const WORD: u64 = 60;

/// The coefficients of a product of polynomials of a degree below 19.
const PRODUCT: usize = 2 * 19 - 1;

/// A remainder: most sums fit into one word, where it is found many times faster.
fn remainder(number: u128, modulus: u64) -> u64 {
    match u64::try_from(number) {
        Ok(number) => number % modulus,
        Err(_) => u64::try_from(number % u128::from(modulus)).expect("below the modulus"),
    }
}

fn times(a: u64, b: u64) -> u128 {
    u128::from(a) * u128::from(b)
}

impl Coefficient for u64 {
    const DRAWN: u64 = 4;

    fn below_modulus(number: &BigInt) -> Self {
        number.to_u64().expect("a number below a modulus of a word")
    }

    fn to_big(&self) -> BigInt {
        (*self).into()
    }

    fn from_words(words: Vec<u32>, modulus: &Self) -> Self {
        remainder(words.iter().fold(0, |number, word| number << 32 | u128::from(*word)), *modulus)
    }

    fn sum(a: &Self, b: &Self, factor: &Self, modulus: &Self) -> Self {
        remainder(u128::from(*a) + times(*b, *factor), *modulus)
    }

    fn reciprocal(&self, modulus: &Self) -> Self {
        let [number, modulus] = [*self, *modulus].map(i64::try_from);
        let modulus = modulus.unwrap_or(i64::MAX);
        let gcd = number.unwrap_or_default().extended_gcd(&modulus);
        if gcd.gcd == 1 { gcd.x.mod_floor(&modulus).unsigned_abs() } else { 0 }
    }

    fn power(&self, exponent: &BigInt, modulus: &Self) -> Self {
        let times = |a, b| remainder(times(a, b), *modulus);
        (0..exponent.bits()).rev().fold(1, |power, bit| {
            let square = times(power, power);
            if exponent.bit(bit) { times(square, *self) } else { square }
        })
    }

    fn product(a: &[Self], b: &[Self], low: &[Self], modulus: &Self) -> Vec<Self> {
        let degree = a.len();
        let mut product = [0u128; PRODUCT];
        for (i, a) in a.iter().enumerate().filter(|(_, a)| **a != 0) {
            for (sum, b) in product[i..].iter_mut().zip(b) {
                *sum += times(*a, *b);
            }
        }
        for k in (degree..2 * degree - 1).rev() {
            let top = remainder(product[k], *modulus);
            for (sum, low) in product[k - degree..].iter_mut().zip(low) {
                *sum += times(top, modulus - low);
            }
        }
        product[..degree].iter().map(|sum| remainder(*sum, *modulus)).collect()
    }
}

impl Coefficient for BigInt {
    const DRAWN: u64 = 16;

    fn below_modulus(number: &BigInt) -> Self {
        number.clone()
    }

    fn to_big(&self) -> BigInt {
        self.clone()
    }

    fn from_words(words: Vec<u32>, modulus: &Self) -> Self {
        Self::from(BigUint::new(words)).mod_floor(modulus)
    }

    fn sum(a: &Self, b: &Self, factor: &Self, modulus: &Self) -> Self {
        let b = if factor.is_one() { b.clone() } else { b * factor };
        (a + b).mod_floor(modulus)
    }

    fn reciprocal(&self, modulus: &Self) -> Self {
        self.modinv(modulus).unwrap_or_default()
    }

    fn power(&self, exponent: &BigInt, modulus: &Self) -> Self {
        self.modpow(exponent, modulus)
    }

    fn product(a: &[Self], b: &[Self], low: &[Self], modulus: &Self) -> Vec<Self> {
        let degree = a.len();
        let mut product = vec![Self::zero(); 2 * degree - 1];
        for (i, a) in a.iter().enumerate() {
            for (j, b) in b.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        for k in (degree..product.len()).rev() {
            let top = product.pop().unwrap_or_default() % modulus;
            for (coefficient, low) in product[k - degree..].iter_mut().zip(low) {
                *coefficient -= &top * low;
            }
        }
        product.iter().map(|coefficient| coefficient.mod_floor(modulus)).collect()
    }
}
