//! Integers of an unramified extension of the q-adic numbers, to a few digits.
//!
//! A polynomial of random q-adic integers is a multiple of q by chance, once in q times. In an extension of the degree d
//! this happens once in q^d times. Its members are polynomials modulo
//! one of the degree d that has no factors modulo q.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

use super::key::Key;

/// The digits of an integer: those of a word, but not more than 12 and not fewer than 6.
const DIGITS: std::ops::RangeInclusive<u32> = 6..=12;

/// The bits of a modulus for which sums of products are found without numbers of any length.
const WORD: u64 = 60;

/// The elements of the residue field are more than two to this power.
const BITS: u32 = 18;

/// Degrees, which are primes, so that it is easy to see whether a polynomial has factors.
const DEGREES: [usize; 9] = [1, 2, 3, 5, 7, 11, 13, 17, 19];

/// Newton's iteration doubles the digits: four steps for 12 digits.
const NEWTON: usize = 4;

static KNOWN: LazyLock<Mutex<BTreeMap<BigInt, Arc<Unramified>>>> = LazyLock::new(Mutex::default);

/// The coefficients of a polynomial, as many as the degree of the extension.
pub(super) type Integral = Vec<BigInt>;

pub(super) struct Unramified {
    pub(super) prime: BigInt,
    pub(super) digits: u32,
    modulus: BigInt,
    degree: usize,
    /// The coefficients of the polynomial from the constant up, but for x^d and zeros below it.
    low: Vec<BigInt>,
}

impl Unramified {
    /// The extension for a prime; it is found once.
    pub(super) fn of_prime(prime: &BigInt) -> Arc<Self> {
        let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        Arc::clone(known.entry(prime.clone()).or_insert_with(|| Arc::new(Self::find(prime))))
    }

    fn find(prime: &BigInt) -> Self {
        let is_enough = |degree: &usize| num_traits::Pow::pow(prime, *degree).bits() > BITS.into();
        let degree = DEGREES.into_iter().find(is_enough).expect("2^19 is enough");
        let is_word = |digits: &u32| num_traits::Pow::pow(prime, *digits).bits() <= WORD;
        let digits = DIGITS.rev().find(is_word).unwrap_or(*DIGITS.start());
        let with = |modulus, low| Self { prime: prime.clone(), digits, modulus, degree, low };
        let modulus = num_traits::Pow::pow(prime, digits);
        if degree == 1 {
            return with(modulus, Vec::new());
        }
        let polynomials = (1u32..).map(|number| digits_of(number.into(), prime));
        let mut fields = polynomials.map(|low| with(prime.clone(), low)).filter(Self::is_field);
        Self { modulus, ..fields.next().expect("some polynomial of each degree has no factors") }
    }

    /// Whether the polynomial has no factors modulo the prime: those of a prime degree are linear if x^(q^d) = x.
    fn is_field(&self) -> bool {
        let mut x = vec![BigInt::zero(); self.degree];
        x[1] = BigInt::one();
        let mut image = self.power(&x, &self.prime);
        if image == x {
            return false;
        }
        for _ in 1..self.degree {
            image = self.power(&image, &self.prime);
        }
        image == x
    }

    pub(super) fn integer(&self, integer: &BigInt) -> Integral {
        let mut coefficients = vec![BigInt::zero(); self.degree];
        coefficients[0] = integer.mod_floor(&self.modulus);
        coefficients
    }

    pub(super) fn is_zero(integral: &Integral) -> bool {
        integral.iter().all(Zero::is_zero)
    }

    pub(super) fn is_one(integral: &Integral) -> bool {
        integral[0].is_one() && integral[1..].iter().all(Zero::is_zero)
    }

    /// A quotient by the prime, if it is integral.
    pub(super) fn divided(&self, integral: &Integral) -> Option<Integral> {
        let pairs = integral.iter().map(|coefficient| coefficient.div_rem(&self.prime));
        pairs.map(|(quotient, rest)| rest.is_zero().then_some(quotient)).collect()
    }

    /// a + q^digits b
    pub(super) fn add(&self, a: &Integral, b: &Integral, digits: u32) -> Integral {
        let factor = num_traits::Pow::pow(&self.prime, digits.min(self.digits));
        a.iter().zip(b).map(|(a, b)| (a + b * &factor).mod_floor(&self.modulus)).collect()
    }

    pub(super) fn mul(&self, a: &Integral, b: &Integral) -> Integral {
        match self.modulus.to_u64().filter(|_| self.modulus.bits() <= WORD) {
            Some(modulus) => self.product_of_words(a, b, modulus),
            None => self.product(a, b),
        }
    }

    fn product(&self, a: &Integral, b: &Integral) -> Integral {
        let mut product = vec![BigInt::zero(); 2 * self.degree - 1];
        for (i, a) in a.iter().enumerate() {
            for (j, b) in b.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        for k in (self.degree..product.len()).rev() {
            let top = product.pop().unwrap_or_default() % &self.modulus;
            for (coefficient, low) in product[k - self.degree..].iter_mut().zip(&self.low) {
                *coefficient -= &top * low;
            }
        }
        product.iter().map(|coefficient| coefficient.mod_floor(&self.modulus)).collect()
    }

    /// The same in words of 128 bits, which hold sums of as many products as there are.
    fn product_of_words(&self, a: &Integral, b: &Integral, modulus: u64) -> Integral {
        let modulus = u128::from(modulus);
        let words = |integral: &[BigInt]| -> Vec<u128> {
            integral.iter().map(|coefficient| coefficient.to_u128().unwrap_or_default()).collect()
        };
        let (a, b, low) = (words(a), words(b), words(&self.low));
        let mut product = vec![0u128; 2 * self.degree - 1];
        for (i, a) in a.iter().enumerate().filter(|(_, a)| **a != 0) {
            for (j, b) in b.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        for k in (self.degree..product.len()).rev() {
            let top = product.pop().unwrap_or_default() % modulus;
            for (coefficient, low) in product[k - self.degree..].iter_mut().zip(&low) {
                *coefficient += top * (modulus - low);
            }
        }
        product.into_iter().map(|coefficient| BigInt::from(coefficient % modulus)).collect()
    }

    fn power(&self, base: &Integral, exponent: &BigInt) -> Integral {
        (0..exponent.bits()).rev().fold(self.integer(&BigInt::one()), |power, bit| {
            let square = self.mul(&power, &power);
            if exponent.bit(bit) { self.mul(&square, base) } else { square }
        })
    }

    /// The reciprocal of a unit: modulo the prime by Fermat's theorem, then by Newton's iteration.
    pub(super) fn inverse(&self, unit: &Integral) -> Integral {
        if unit[1..].iter().all(Zero::is_zero) {
            return self.integer(&unit[0].modinv(&self.modulus).unwrap_or_default());
        }
        let residue = self.residues();
        let order = num_traits::Pow::pow(&self.prime, self.degree) - 2;
        let start =
            residue.power(&unit.iter().map(|coefficient| coefficient % &self.prime).collect(), &order);
        (0..NEWTON).fold(start, |inverse, _| {
            let error: Integral = self.mul(unit, &inverse).iter().map(|coefficient| -coefficient).collect();
            self.mul(&inverse, &self.add(&self.integer(&2.into()), &error, 0))
        })
    }

    /// One of the two square roots of a unit, if it has any: modulo the prime [Tonelli & Shanks; Cohen 1993, sec. 1.5.1],
    /// then by Newton's iteration.
    pub(super) fn square_root(&self, unit: &Integral) -> Option<Integral> {
        if self.prime.is_even() {
            return None;
        }
        let residue = self.residues();
        let start =
            residue.root_of_residue(&unit.iter().map(|coefficient| coefficient % &self.prime).collect())?;
        let half = (&self.modulus + 1u32) / 2u32;
        Some((0..NEWTON).fold(start, |root, _| {
            let sum = self.add(&root, &self.mul(unit, &self.inverse(&root)), 0);
            sum.iter().map(|coefficient| coefficient * &half % &self.modulus).collect()
        }))
    }

    /// The field of the residues modulo the prime.
    fn residues(&self) -> Self {
        Self { prime: self.prime.clone(), modulus: self.prime.clone(), low: self.low.clone(), ..*self }
    }

    fn root_of_residue(&self, square: &Integral) -> Option<Integral> {
        let one = self.integer(&BigInt::one());
        let order: BigInt = num_traits::Pow::pow(&self.prime, self.degree) - 1;
        if self.power(square, &(&order / 2u32)) != one {
            return None;
        }
        let twos = order.trailing_zeros().unwrap_or(0);
        let odd: BigInt = &order >> twos;
        let candidates = (0u64..).map(|salt| self.draw(&Key::new("no square").word(salt)));
        let mut generators = candidates.map(|candidate| self.power(&candidate, &odd));
        let half_order = BigInt::one() << (twos - 1);
        let generator = generators.find(|candidate| self.power(candidate, &half_order) != one)?;
        // root^2 = square * rest, where the order of rest is a power of two that becomes smaller.
        let mut root = self.power(square, &((&odd + 1u32) / 2u32));
        let mut rest = self.power(square, &odd);
        for level in (0..twos - 1).rev() {
            if self.power(&rest, &(BigInt::one() << level)) != one {
                let factor = self.power(&generator, &(BigInt::one() << (twos - 2 - level)));
                root = self.mul(&root, &factor);
                rest = self.mul(&rest, &self.mul(&factor, &factor));
            }
        }
        Some(root)
    }

    /// A unit drawn for a key.
    pub(super) fn draw(&self, key: &Key) -> Integral {
        const WORDS: u64 = 16;
        let coefficient = |k: usize| {
            let salts = (k as u64 * WORDS)..((k as u64 + 1) * WORDS);
            BigInt::from(BigUint::new(salts.map(|salt| key.draw_word(salt)).collect()))
                .mod_floor(&self.modulus)
        };
        let mut drawn: Integral = (0..self.degree).map(coefficient).collect();
        if self.divided(&drawn).is_some() {
            drawn[0] += 1;
        }
        drawn
    }
}

/// The digits of a number, the lowest first.
fn digits_of(mut number: BigInt, base: &BigInt) -> Vec<BigInt> {
    let mut digits = Vec::new();
    while !number.is_zero() {
        let (rest, digit) = number.div_rem(base);
        digits.push(digit);
        number = rest;
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_reciprocals_for_all_sizes_of_primes() {
        for prime in [2, 3, 5, 7, 11, 13, 37, 61, 67, 109, 509, 1009, 1_000_003] {
            let field = Unramified::of_prime(&prime.into());
            for seed in 0..20 {
                let unit = field.draw(&Key::new("unit").word(seed));
                assert!(Unramified::is_one(&field.mul(&unit, &field.inverse(&unit))), "{prime}");
            }
        }
    }

    #[test]
    fn squares_have_roots_for_all_sizes_of_primes() {
        for prime in [3, 5, 7, 11, 13, 37, 61, 67, 109, 257, 509, 1_000_003] {
            let field = Unramified::of_prime(&prime.into());
            let mut squares = 0;
            for seed in 0..20 {
                let unit = field.draw(&Key::new("unit").word(seed));
                let square = field.mul(&unit, &unit);
                let root = field.square_root(&square).expect("a square has a root");
                assert_eq!(field.mul(&root, &root), square, "{prime}");
                squares += usize::from(field.square_root(&unit).is_some());
            }
            assert!((1..20).contains(&squares), "{squares} of 20 drawn units are squares for {prime}");
        }
    }

    #[test]
    fn products_of_words_are_products() {
        for prime in [2, 7, 37, 109] {
            let field = Unramified::of_prime(&prime.into());
            let [a, b] = ["a", "b"].map(|name| field.draw(&Key::new(name)));
            assert_eq!(field.mul(&a, &b), field.product(&a, &b), "{prime}");
        }
    }

    #[test]
    fn the_residues_of_units_have_reciprocals_that_are_no_powers_of_others() {
        // A product of two factors would have zero divisors: every residue but zero is a unit here.
        let field = Unramified::of_prime(&7.into());
        for low in 0..7 {
            for high in 1..7 {
                let mut element = field.integer(&low.into());
                element[1] = high.into();
                assert!(Unramified::is_one(&field.mul(&element, &field.inverse(&element))));
            }
        }
    }
}
