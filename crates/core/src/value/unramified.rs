//! Integers of an unramified extension of the q-adic numbers, to a few digits.
//!
//! A polynomial of random q-adic integers is a multiple of q by chance, once in q times. In an extension of the degree d
//! this happens once in q^d times. Its members are polynomials modulo
//! one of the degree d that has no factors modulo q.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Pow;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use super::coefficient::{Coefficient, WORD};
use super::key::Key;

/// The digits of an integer: those of a word, but not more than 12 and not fewer than 6.
const DIGITS: std::ops::RangeInclusive<u32> = 6..=12;

/// The digits where so many cancel that these do not tell what is left.
const MANY_DIGITS: u32 = 60;

/// The elements of the residue field are more than two to this power.
const BITS: u32 = 18;

/// Degrees, which are primes, so that it is easy to see whether a polynomial has factors.
const DEGREES: [usize; 9] = [1, 2, 3, 5, 7, 11, 13, 17, 19];

/// The coefficients of a polynomial, as many as the degree of the extension.
pub(super) type Integral<C> = Vec<C>;

pub(crate) struct Unramified<C> {
    pub(super) prime: C,
    pub(super) digits: u32,
    modulus: C,
    degree: usize,
    /// The coefficients of the polynomial from the constant up, but for x^d and zeros below it.
    low: Vec<C>,
    /// What has the largest power of two as its order in the residue field; it is found once.
    generator: OnceLock<Integral<C>>,
}

/// The extension for a prime, with coefficients in words if they fit.
#[derive(Clone)]
pub(crate) enum Extension {
    Words(Arc<Unramified<u64>>),
    Long(Arc<Unramified<BigInt>>),
}

static KNOWN: LazyLock<Mutex<BTreeMap<BigInt, Extension>>> = LazyLock::new(Mutex::default);

static KNOWN_WITH_MANY_DIGITS: LazyLock<Mutex<BTreeMap<BigInt, Arc<Unramified<BigInt>>>>> =
    LazyLock::new(Mutex::default);

impl Extension {
    /// The extension for a prime; it is found once.
    pub(crate) fn of_prime(prime: &BigInt) -> Self {
        let mut known = KNOWN.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        known.entry(prime.clone()).or_insert_with(|| Self::find(prime)).clone()
    }

    fn find(prime: &BigInt) -> Self {
        let is_word = |digits: &u32| Pow::pow(prime, *digits).bits() <= WORD;
        match DIGITS.rev().find(is_word) {
            Some(digits) => Self::Words(Unramified::find(prime, digits).into()),
            None => Self::Long(Unramified::find(prime, *DIGITS.start()).into()),
        }
    }
}

impl Unramified<BigInt> {
    /// The extension for a prime, to many digits; it is found once.
    pub(crate) fn with_many_digits(prime: &BigInt) -> Arc<Self> {
        let mut known = KNOWN_WITH_MANY_DIGITS.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let find = || Self::find(prime, MANY_DIGITS).into();
        known.entry(prime.clone()).or_insert_with(find).clone()
    }
}

impl<C: Coefficient> Unramified<C> {
    fn find(prime: &BigInt, digits: u32) -> Self {
        let is_enough = |degree: &usize| Pow::pow(prime, *degree).bits() > BITS.into();
        let degree = DEGREES.into_iter().find(is_enough).expect("2^19 is enough");
        let q = C::below_modulus(prime);
        let with = |modulus: &C, low| Self {
            prime: q.clone(),
            digits,
            modulus: modulus.clone(),
            degree,
            low,
            generator: OnceLock::new(),
        };
        let modulus = num_traits::pow(q.clone(), digits as usize);
        if degree == 1 {
            return with(&modulus, Vec::new());
        }
        let polynomials = (1u32..).map(|number| digits_of(&number.into(), prime));
        let low = |digits: Vec<BigInt>| digits.iter().map(C::below_modulus).collect();
        let mut fields = polynomials.map(|digits| with(&q, low(digits))).filter(Self::is_field);
        Self { modulus, ..fields.next().expect("some polynomial of each degree has no factors") }
    }

    /// Whether the polynomial has no factors modulo the prime: those of a prime degree are linear if x^(q^d) = x.
    fn is_field(&self) -> bool {
        let mut x = vec![C::zero(); self.degree];
        x[1] = C::one();
        let prime = self.whole_prime();
        let mut image = self.power(&x, &prime);
        if image == x {
            return false;
        }
        for _ in 1..self.degree {
            image = self.power(&image, &prime);
        }
        image == x
    }

    pub(super) fn whole_prime(&self) -> BigInt {
        self.prime.to_big()
    }

    pub(super) fn integer(&self, integer: &BigInt) -> Integral<C> {
        self.constant(C::below_modulus(&integer.mod_floor(&self.modulus.to_big())))
    }

    fn constant(&self, number: C) -> Integral<C> {
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
    fn sum(&self, a: &Integral<C>, b: &Integral<C>, factor: &C) -> Integral<C> {
        a.iter().zip(b).map(|(a, b)| C::sum(a, b, factor, &self.modulus)).collect()
    }

    pub(super) fn mul(&self, a: &Integral<C>, b: &Integral<C>) -> Integral<C> {
        C::product(a, b, &self.low, &self.modulus)
    }

    fn power(&self, base: &Integral<C>, exponent: &BigInt) -> Integral<C> {
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

    fn inverse_of_residue(&self, unit: &Integral<C>) -> Integral<C> {
        let order = Pow::pow(self.whole_prime(), self.degree) - 2;
        self.residues().power(unit, &order)
    }

    /// A reciprocal to twice as many digits: x (2 - u x).
    fn improved_inverse(&self, unit: &Integral<C>, inverse: &Integral<C>) -> Integral<C> {
        let two = self.constant(C::two() % self.modulus.clone());
        self.mul(inverse, &self.sum(&two, &self.mul(unit, inverse), &self.minus_one()))
    }

    fn minus_one(&self) -> C {
        self.modulus.clone() - C::one()
    }

    /// One of the two square roots of a unit, if it has any: modulo the prime [Tonelli & Shanks; Cohen 1993, sec. 1.5.1],
    /// then by Newton's iteration, r - (r^2 - u)/(2 r), together with that for the reciprocal of r.
    pub(super) fn square_root(&self, unit: &Integral<C>) -> Option<Integral<C>> {
        if self.prime.is_even() {
            return None;
        }
        let start = self.root_of_residue(&self.residue(unit))?;
        let inverse = self.inverse_of_residue(&start);
        let minus_half = self.minus_one() / C::two();
        let (root, _) = (0..self.newton_steps()).fold((start, inverse), |(root, inverse), _| {
            let error = self.sum(&self.mul(&root, &root), unit, &self.minus_one());
            let root = self.sum(&root, &self.mul(&error, &inverse), &minus_half);
            let inverse = self.improved_inverse(&root, &inverse);
            (root, inverse)
        });
        Some(root)
    }

    fn residue(&self, integral: &Integral<C>) -> Integral<C> {
        integral.iter().map(|coefficient| coefficient.mod_floor(&self.prime)).collect()
    }

    /// The field of the residues modulo the prime.
    fn residues(&self) -> Self {
        Self {
            prime: self.prime.clone(),
            modulus: self.prime.clone(),
            low: self.low.clone(),
            generator: OnceLock::new(),
            ..*self
        }
    }

    fn root_of_residue(&self, square: &Integral<C>) -> Option<Integral<C>> {
        let field = self.residues();
        let one = field.constant(C::one());
        let order: BigInt = Pow::pow(self.whole_prime(), self.degree) - 1;
        let twos = order.trailing_zeros().unwrap_or(0);
        let odd: BigInt = &order >> twos;
        // root^2 = square * rest, where the order of rest is a power of two that becomes smaller.
        let half_power = field.power(square, &(&odd >> 1));
        let mut root = field.mul(square, &half_power);
        let mut rest = field.mul(&root, &half_power);
        if field.power(&rest, &(BigInt::from(1) << (twos - 1))) != one {
            return None;
        }
        let generator = self.generator.get_or_init(|| field.find_generator(&odd, twos));
        for level in (0..twos - 1).rev() {
            if field.power(&rest, &(BigInt::from(1) << level)) != one {
                let factor = field.power(generator, &(BigInt::from(1) << (twos - 2 - level)));
                root = field.mul(&root, &factor);
                rest = field.mul(&rest, &field.mul(&factor, &factor));
            }
        }
        Some(root)
    }

    /// What is no square, to the power of the odd part of the order.
    fn find_generator(&self, odd: &BigInt, twos: u64) -> Integral<C> {
        let one = self.constant(C::one());
        let candidates = (0u64..).map(|salt| self.draw(&Key::new("no square").word(salt)));
        let mut powers = candidates.map(|candidate| self.power(&candidate, odd));
        let half_order = BigInt::from(1) << (twos - 1);
        powers.find(|power| self.power(power, &half_order) != one).expect("half of all units are no squares")
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
            match Extension::of_prime(&prime.into()) {
                Extension::Words(field) => word(&field),
                Extension::Long(field) => long(&field),
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

    fn squares_have_roots<C: Coefficient>(field: &Unramified<C>) {
        if field.prime.is_even() {
            return;
        }
        let mut squares = 0;
        for seed in 0..20 {
            let unit = field.draw(&Key::new("unit").word(seed));
            let square = field.mul(&unit, &unit);
            let root = field.square_root(&square).expect("a square has a root");
            assert!(field.mul(&root, &root) == square, "{}", field.whole_prime());
            squares += usize::from(field.square_root(&unit).is_some());
        }
        assert!(
            (1..20).contains(&squares),
            "{squares} of 20 drawn units are squares for {}",
            field.whole_prime()
        );
    }

    #[test]
    fn squares_have_roots_for_all_sizes_of_primes() {
        for_each_prime(squares_have_roots, squares_have_roots);
    }

    #[test]
    fn products_of_words_are_products() {
        for prime in [2, 7, 37, 109] {
            let Extension::Words(field) = Extension::of_prime(&prime.into()) else {
                panic!("{prime} needs more than words");
            };
            let long = Unramified::<BigInt>::find(&prime.into(), field.digits);
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
        let Extension::Words(field) = Extension::of_prime(&7.into()) else {
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
