//! Integers of an unramified extension of the q-adic numbers, to a few digits.
//!
//! A polynomial of random q-adic integers is a multiple of q by chance, once in q times. In an extension of the degree d
//! this happens once in q^d times. Its members are polynomials modulo
//! one of the degree d that has no factors modulo q.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Pow, ToPrimitive};
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex};

use super::coefficient::{Coefficient, WORD};
use super::key::Key;
use super::radical::is_prime;

/// The digits of an integer: those of a word, but not more than 12 and not fewer than 6.
const DIGITS: std::ops::RangeInclusive<u32> = 6..=12;

/// The digits where so many cancel that these do not tell what is left.
const MANY_DIGITS: u32 = 60;

/// The elements of the residue field are more than two to this power.
const BITS: u32 = 18;

/// The degrees, but for that of [`WITH_ROOTS`].
const DEGREES: [usize; 9] = [1, 2, 3, 5, 7, 11, 13, 17, 19];

/// The degree in which all units among the q-adic integers have square roots and cube roots.
const WITH_ROOTS: usize = 6;

/// The coefficients of a polynomial, as many as the degree of the extension.
pub(super) type Integral<C> = Vec<C>;

pub(crate) struct Unramified<C> {
    pub(super) prime: C,
    pub(super) digits: u32,
    pub(super) modulus: C,
    pub(super) degree: usize,
    /// The coefficients of the polynomial from the constant up, but for x^d and zeros below it.
    low: Vec<C>,
    /// For some primes p what has the largest power of p as its order among the residues; each is found once.
    pub(super) generators: Mutex<BTreeMap<u64, Integral<C>>>,
}

/// The extension for a prime, with coefficients in words if they fit.
#[derive(Clone)]
pub(crate) enum Extension {
    Words(Arc<Unramified<u64>>),
    Long(Arc<Unramified<BigInt>>),
}

/// What was found for a prime, in the least degree or with roots.
type Known<E> = LazyLock<Mutex<BTreeMap<(BigInt, bool), E>>>;

static KNOWN: Known<Extension> = LazyLock::new(Mutex::default);

static KNOWN_WITH_MANY_DIGITS: Known<Arc<Unramified<BigInt>>> = LazyLock::new(Mutex::default);

impl Extension {
    /// The extension for a prime, and whether all units among the q-adic integers are to have square roots and cube roots;
    /// it is found once. What has no known factors may be a product of primes, for which there is no such extension.
    pub(crate) fn of_prime(prime: &BigInt, with_roots: bool) -> Self {
        let with_roots = with_roots && is_certain(prime);
        let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        known.entry((prime.clone(), with_roots)).or_insert_with(|| Self::find(prime, with_roots)).clone()
    }

    fn find(prime: &BigInt, with_roots: bool) -> Self {
        let is_word = |digits: &u32| Pow::pow(prime, *digits).bits() <= WORD;
        match DIGITS.rev().find(is_word) {
            Some(digits) => Self::Words(Unramified::find(prime, digits, with_roots).into()),
            None => Self::Long(Unramified::find(prime, *DIGITS.start(), with_roots).into()),
        }
    }
}

impl Unramified<BigInt> {
    /// The extension for a prime, to many digits; it is found once.
    pub(crate) fn with_many_digits(prime: &BigInt, with_roots: bool) -> Arc<Self> {
        let with_roots = with_roots && is_certain(prime);
        let mut known = KNOWN_WITH_MANY_DIGITS.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let find = || Self::find(prime, MANY_DIGITS, with_roots).into();
        known.entry((prime.clone(), with_roots)).or_insert_with(find).clone()
    }
}

impl<C: Coefficient> Unramified<C> {
    fn find(prime: &BigInt, digits: u32, with_roots: bool) -> Self {
        let is_enough = |degree: &usize| Pow::pow(prime, *degree).bits() > BITS.into();
        let least = || DEGREES.into_iter().find(is_enough).expect("2^19 is enough");
        let degree = if with_roots { WITH_ROOTS } else { least() };
        let q = C::below_modulus(prime);
        let with = |modulus: &C, low| Self {
            prime: q.clone(),
            digits,
            modulus: modulus.clone(),
            degree,
            low,
            generators: Mutex::default(),
        };
        let modulus = num_traits::pow(q.clone(), digits as usize);
        if degree == 1 {
            return with(&modulus, Vec::new());
        }
        // x^d + x + c and further: x^6 + c has factors for all c where 3 doesn't divide q - 1
        let polynomials = (0u32..).map(|number| digits_of(&(prime + number), prime));
        let low = |digits: Vec<BigInt>| digits.iter().map(C::below_modulus).collect();
        let mut fields = polynomials.map(|digits| with(&q, low(digits))).filter(Self::is_field);
        Self { modulus, ..fields.next().expect("some polynomial of each degree has no factors") }
    }

    /// Whether the polynomial has no factors modulo the prime: x^(q^d) = x, and x^(q^k) - x is a unit for each d/k that is
    /// a prime [Rabin 1980].
    fn is_field(&self) -> bool {
        let mut x = vec![C::zero(); self.degree];
        x[1] = C::one();
        let prime = self.whole_prime();
        let mut images = vec![x.clone()];
        for k in 0..self.degree {
            images.push(self.power(&images[k], &prime));
        }
        let order = Pow::pow(prime, self.degree) - 1;
        let is_unit = |k: usize| {
            let difference = self.sum(&images[k], &x, &self.minus_one());
            Self::is_one(&self.power(&difference, &order))
        };
        let mut parts = DEGREES[1..].iter().filter(|part| self.degree.is_multiple_of(**part));
        images[self.degree] == x && parts.all(|part| is_unit(self.degree / part))
    }

    pub(super) fn whole_prime(&self) -> BigInt {
        self.prime.to_big()
    }

    pub(super) fn integer(&self, integer: &BigInt) -> Integral<C> {
        self.constant(C::below_modulus(&integer.mod_floor(&self.modulus.to_big())))
    }

    pub(super) fn constant(&self, number: C) -> Integral<C> {
        let mut coefficients = vec![C::zero(); self.degree];
        coefficients[0] = number;
        coefficients
    }

    pub(super) fn is_zero(integral: &Integral<C>) -> bool {
        integral.iter().all(C::is_zero)
    }

    pub(super) fn is_one(integral: &Integral<C>) -> bool {
        integral[0].is_one() && integral[1..].iter().all(C::is_zero)
    }

    /// A quotient by the prime, if it is integral.
    pub(super) fn divided(&self, integral: &Integral<C>) -> Option<Integral<C>> {
        let pairs = integral.iter().map(|coefficient| coefficient.div_rem(&self.prime));
        pairs.map(|(quotient, rest)| rest.is_zero().then_some(quotient)).collect()
    }

    /// a + q^digits b
    pub(super) fn add(&self, a: &Integral<C>, b: &Integral<C>, digits: u32) -> Integral<C> {
        let digits = digits.min(self.digits);
        self.sum(
            a,
            b,
            &if digits == 0 { C::one() } else { num_traits::pow(self.prime.clone(), digits as usize) },
        )
    }

    /// a + factor b
    pub(super) fn sum(&self, a: &Integral<C>, b: &Integral<C>, factor: &C) -> Integral<C> {
        a.iter().zip(b).map(|(a, b)| C::sum(a, b, factor, &self.modulus)).collect()
    }

    pub(super) fn mul(&self, a: &Integral<C>, b: &Integral<C>) -> Integral<C> {
        C::product(a, b, &self.low, &self.modulus)
    }

    pub(super) fn power(&self, base: &Integral<C>, exponent: &BigInt) -> Integral<C> {
        if self.degree == 1 {
            return self.constant(base[0].power(exponent, &self.modulus));
        }
        (0..exponent.bits()).rev().fold(self.constant(C::one()), |power, bit| {
            let square = self.mul(&power, &power);
            if exponent.bit(bit) { self.mul(&square, base) } else { square }
        })
    }

    /// The reciprocal of a unit: modulo the prime by Fermat's theorem, then by Newton's iteration.
    pub(super) fn inverse(&self, unit: &Integral<C>) -> Integral<C> {
        if unit[1..].iter().all(C::is_zero) {
            return self.constant(unit[0].reciprocal(&self.modulus));
        }
        let start = self.inverse_of_residue(&self.residue(unit));
        (0..self.newton_steps()).fold(start, |inverse, _| self.improved_inverse(unit, &inverse))
    }

    /// The steps of Newton's iteration, each of which doubles the digits.
    pub(super) fn newton_steps(&self) -> u32 {
        self.digits.next_power_of_two().trailing_zeros()
    }

    pub(super) fn inverse_of_residue(&self, unit: &Integral<C>) -> Integral<C> {
        if unit[1..].iter().all(C::is_zero) {
            return self.constant(unit[0].reciprocal(&self.prime));
        }
        let order = Pow::pow(self.whole_prime(), self.degree) - 2;
        self.residues().power(unit, &order)
    }

    /// A reciprocal to twice as many digits: x (2 - u x).
    pub(super) fn improved_inverse(&self, unit: &Integral<C>, inverse: &Integral<C>) -> Integral<C> {
        let two = self.constant(C::two() % self.modulus.clone());
        self.mul(inverse, &self.sum(&two, &self.mul(unit, inverse), &self.minus_one()))
    }

    pub(super) fn minus_one(&self) -> C {
        self.modulus.clone() - C::one()
    }

    pub(super) fn residue(&self, integral: &Integral<C>) -> Integral<C> {
        integral.iter().map(|coefficient| coefficient.mod_floor(&self.prime)).collect()
    }

    /// The field of the residues modulo the prime.
    pub(super) fn residues(&self) -> Self {
        Self {
            prime: self.prime.clone(),
            modulus: self.prime.clone(),
            low: self.low.clone(),
            generators: Mutex::default(),
            ..*self
        }
    }

    /// A unit drawn for a key.
    pub(super) fn draw(&self, key: &Key) -> Integral<C> {
        let coefficient = |k: usize| {
            let salts = (k as u64 * C::DRAWN)..((k as u64 + 1) * C::DRAWN);
            C::from_words(salts.map(|salt| key.draw_word(salt)).collect(), &self.modulus)
        };
        let mut drawn: Integral<C> = (0..self.degree).map(coefficient).collect();
        if self.divided(&drawn).is_some() {
            drawn[0] = drawn[0].clone() + C::one();
        }
        drawn
    }
}

/// Whether a number is a prime, if it is a word.
fn is_certain(prime: &BigInt) -> bool {
    prime.to_u64().is_some_and(is_prime)
}

/// The digits of a number, the lowest first.
fn digits_of(number: &BigInt, base: &BigInt) -> Vec<BigInt> {
    let mut number = number.clone();
    let mut digits = Vec::new();
    while number != BigInt::ZERO {
        let (rest, digit) = number.div_rem(base);
        digits.push(digit);
        number = rest;
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coefficients of primes up to 1021 are words.
    const PRIMES: [u32; 13] = [2, 3, 5, 7, 11, 13, 37, 61, 67, 109, 509, 1009, 1_000_003];

    fn for_each_prime(word: impl Fn(&Unramified<u64>), long: impl Fn(&Unramified<BigInt>)) {
        for prime in PRIMES {
            match Extension::of_prime(&prime.into(), false) {
                Extension::Words(field) => word(&field),
                Extension::Long(field) => long(&field),
            }
        }
    }

    #[test]
    fn there_are_extensions_of_each_prime() {
        let primes = (2..2000u64).chain([61_681, 5_070_368_732_417, 18_446_744_073_709_551_557]);
        for prime in primes.filter(|&number| is_prime(number)) {
            for (with_roots, least) in [(false, 1), (true, WITH_ROOTS)] {
                let degree = match Extension::of_prime(&prime.into(), with_roots) {
                    Extension::Words(ring) => ring.degree,
                    Extension::Long(ring) => ring.degree,
                };
                assert!(degree >= least, "{prime}: {degree}");
            }
        }
    }

    fn units_have_reciprocals<C: Coefficient>(field: &Unramified<C>) {
        for seed in 0..20 {
            let unit = field.draw(&Key::new("unit").word(seed));
            assert!(Unramified::is_one(&field.mul(&unit, &field.inverse(&unit))), "{}", field.whole_prime());
        }
    }

    #[test]
    fn units_have_reciprocals_for_all_sizes_of_primes() {
        for_each_prime(units_have_reciprocals, units_have_reciprocals);
    }

    #[test]
    fn products_of_words_are_products() {
        for prime in [2, 7, 37, 109] {
            let Extension::Words(field) = Extension::of_prime(&prime.into(), false) else {
                panic!("{prime} needs more than words");
            };
            let long = Unramified::<BigInt>::find(&prime.into(), field.digits, false);
            let [a, b] = ["a", "b"].map(|name| field.draw(&Key::new(name)));
            let to_long =
                |integral: &Integral<u64>| integral.iter().map(Coefficient::to_big).collect::<Vec<_>>();
            assert_eq!(to_long(&field.mul(&a, &b)), long.mul(&to_long(&a), &to_long(&b)), "{prime}");
            assert_eq!(to_long(&field.inverse(&a)), long.inverse(&to_long(&a)), "{prime}");
        }
    }

    #[test]
    fn the_residues_of_units_have_reciprocals_that_are_no_powers_of_others() {
        // A product of two factors would have zero divisors: every residue but zero is a unit here.
        let Extension::Words(field) = Extension::of_prime(&7.into(), false) else {
            panic!("7 needs more than words")
        };
        for low in 0..7 {
            for high in 1..7 {
                let mut element = field.integer(&low.into());
                element[1] = high;
                assert!(Unramified::is_one(&field.mul(&element, &field.inverse(&element))));
            }
        }
    }
}
