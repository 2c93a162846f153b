//! A point of the q-adic integers, and the roots that values have there.
//!
//! A square root squares to its argument, which half of all units allow, and a cube root cubed is its argument, which a
//! third of all units allow for some primes. So further points are tried where some have no root. If there are many roots,
//! those that are missing are drawn. Of several roots one is drawn, but sqrt(4 u) is twice sqrt(u). Powers of one root
//! agree: an exponent is split into parts whose denominators are powers of 2 and of 3 and a number without these.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;
use std::cell::{Cell, RefCell};

use crate::value::{Adic, Adics, Coefficient, Element, FieldId, Key, Number, Quadratic, ROOT_DEGREES};

use super::node::in_hash_lanes;

/// How many points there are at which arguments are zero. At as many others sines and exponentials are drawn: these serve
/// where a value is zero at all of the first.
pub(super) const POINTS: u16 = 5;

/// How often a point is drawn again if it has no roots of some values.
pub(super) const TRIALS: u16 = 24;

/// If there are more different roots, a point is not drawn again.
const MOST_ROOTS: usize = 4;

/// A point of the q-adic integers of a prime.
pub(super) struct AdicPoint<'a, C> {
    pub(super) adics: &'a Adics<C>,
    number: u16,
    trial: u16,
    /// The roots that are known, with their degrees and the fingerprints of their radicands.
    roots: RefCell<Vec<(u64, Element, Adic<C>)>>,
    misses_roots: Cell<bool>,
    has_pole: Cell<bool>,
}

impl<'a, C: Coefficient> AdicPoint<'a, C> {
    pub(super) fn new(adics: &'a Adics<C>, number: u16, trial: u16) -> Self {
        Self {
            adics,
            number,
            trial,
            roots: RefCell::default(),
            misses_roots: Cell::new(false),
            has_pole: Cell::new(false),
        }
    }

    /// Whether some values had no root here.
    pub(super) fn misses_roots(&self) -> bool {
        self.misses_roots.get()
    }

    /// Whether something has a pole here: what was made of it has no value.
    pub(super) fn has_pole(&self) -> bool {
        self.has_pole.get()
    }

    /// Whether the roots are so few that they may all exist at another point.
    pub(super) fn is_to_be_drawn_again(&self) -> bool {
        self.roots.borrow().len() < MOST_ROOTS
    }

    pub(super) fn has_plain_arguments(&self) -> bool {
        self.number < POINTS
    }

    /// The lane whose signs are those here.
    pub(super) fn lane(&self) -> FieldId {
        FieldId::other(self.number % POINTS)
    }

    pub(super) fn one(&self) -> Adic<C> {
        self.adics.integer(&BigInt::one())
    }

    pub(super) fn key(&self, key: Key) -> Key {
        let key = key.word(self.number.into());
        if self.trial == 0 { key } else { key.word(self.trial.into()) }
    }

    /// The key of what has these values in the hash lanes, or their opposites.
    pub(super) fn key_of(&self, in_field: impl Fn(FieldId) -> Quadratic) -> Key {
        self.key_of_fingerprint(in_hash_lanes(in_field))
    }

    fn key_of_fingerprint(&self, value: Element) -> Key {
        let [first, second] = value.unsigned().0.words();
        self.key(Key::new("digits").word(first).word(second))
    }

    pub(super) fn half(&self, a: &Adic<C>) -> Adic<C> {
        self.adics.mul(&self.adics.rational(&Number::rational(1, 2)), a)
    }

    /// A rational power of a value, which is that of something with these values in the hash lanes.
    pub(super) fn power(
        &self,
        value: &Adic<C>,
        exponent: &Number,
        in_field: impl Fn(FieldId) -> Quadratic,
    ) -> Adic<C> {
        if value.leading().is_none() && exponent.is_negative() {
            self.has_pole.set(true);
        }
        if let Some(count) = exponent.to_i64() {
            return self.adics.power(value, count);
        }
        let Some(parts) = partial_fractions(exponent) else {
            return self.drawn_power(value, exponent, &in_field);
        };
        let powers = parts.iter().map(|part| {
            let root = self.root_of_power(value, part, &in_field);
            self.adics.power(&root, part.times)
        });
        powers.reduce(|product, power| self.adics.mul(&product, &power)).unwrap_or_else(|| self.one())
    }

    /// The root whose degree is a power: that of the root of the degree below.
    fn root_of_power(
        &self,
        value: &Adic<C>,
        degree: &Part,
        in_field: &dyn Fn(FieldId) -> Quadratic,
    ) -> Adic<C> {
        let roots = (1..degree.count).map(|count| part_of_one(degree.base.pow(count)));
        let first = self.root(value, degree.base, in_field);
        roots.fold(first, |root, exponent| {
            let in_field = |field: FieldId| field.field().rational_power(&in_field(field), &exponent);
            self.root(&root, degree.base, &in_field)
        })
    }

    fn root(&self, value: &Adic<C>, degree: i64, in_field: &dyn Fn(FieldId) -> Quadratic) -> Adic<C> {
        let known = self.known_root(value, degree.unsigned_abs(), in_field);
        known.unwrap_or_else(|| self.drawn_power(value, &part_of_one(degree), in_field))
    }

    /// What is drawn for the values of what is left without whole powers of the prime, so that q^2 u has the root that is q
    /// times that of u.
    fn drawn_power(
        &self,
        value: &Adic<C>,
        exponent: &Number,
        in_field: &dyn Fn(FieldId) -> Quadratic,
    ) -> Adic<C> {
        self.adics.drawn_power(value, exponent, |whole| {
            let key = self.key_of(|field| {
                let f = field.field();
                f.mul(&f.power(&f.number(&self.adics.prime()), &whole.neg()), &in_field(field))
            });
            key.text(&exponent.to_string())
        })
    }

    fn known_root(
        &self,
        radicand: &Adic<C>,
        degree: u64,
        in_field: &dyn Fn(FieldId) -> Quadratic,
    ) -> Option<Adic<C>> {
        if degree != 2 && !self.adics.has_odd_roots() {
            return None;
        }
        if !ROOT_DEGREES.contains(&degree) {
            return self.adics.root(radicand, degree, 0);
        }
        let value = in_hash_lanes(in_field);
        let known = self.roots.borrow().iter().find_map(|(known_degree, known, root)| {
            let ratio = (degree == *known_degree).then(|| value * known.inverse())?.to_simple_rational()?;
            Some(self.adics.mul(&self.adics.rational(&rational_root(&ratio, degree)?), root))
        });
        if known.is_some() {
            return known;
        }
        let choice = self.key_of_fingerprint(value).text("root").draw_word(0);
        let root = self.adics.root(radicand, degree, choice);
        match &root {
            Some(root) => self.roots.borrow_mut().push((degree, value, root.clone())),
            None => self.misses_roots.set(true),
        }
        root
    }
}

/// The fraction times/base^count.
struct Part {
    base: i64,
    count: u32,
    times: i64,
}

/// Fractions whose sum a fraction is: the denominators are powers of the degrees of [`ROOT_DEGREES`], and what has no
/// factors in common with these. `None` if a number is too large.
fn partial_fractions(exponent: &Number) -> Option<Vec<Part>> {
    let (over, under) = exponent.to_small()?;
    let powers = powers_in(under);
    let mut rest = i128::from(over);
    let times_of = |(k, (base, count)): (usize, &(i64, u32))| {
        let denominator = i128::from(base.pow(*count));
        let others = i128::from(under) / denominator;
        let times = if k + 1 == powers.len() {
            rest / others
        } else {
            let inverse = others.extended_gcd(&denominator).x.rem_euclid(denominator);
            inverse * rest.rem_euclid(denominator) % denominator
        };
        rest -= times * others;
        Some(Part { base: *base, count: *count, times: i64::try_from(times).ok()? })
    };
    powers.iter().enumerate().map(times_of).collect()
}

/// The powers of the degrees of [`ROOT_DEGREES`] that a number holds, and what is left of it.
fn powers_in(number: i64) -> Vec<(i64, u32)> {
    let mut rest = number;
    let mut power = |base: u64| {
        let base = base.cast_signed();
        let mut count = 0;
        while rest % base == 0 {
            rest /= base;
            count += 1;
        }
        (base, count)
    };
    let mut powers: Vec<_> = ROOT_DEGREES.map(&mut power).into();
    powers.push((rest, 1));
    powers.retain(|(base, count)| *base > 1 && *count > 0);
    powers
}

fn part_of_one(denominator: i64) -> Number {
    Number::rational(1, denominator)
}

/// The root of a positive number, if that is rational.
fn rational_root(radicand: &Number, degree: u64) -> Option<Number> {
    if radicand.is_negative() {
        return None;
    }
    let root = |number: BigInt| number.nth_root(u32::try_from(degree).unwrap_or(u32::MAX));
    let root = Number::from_big(root(radicand.numerator()), root(radicand.denominator())).ok()?;
    root.powi(i64::try_from(degree).ok()?).ok()?.same_value(radicand).then_some(root)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_fractions_add_up() {
        let fractions = [(1, 2), (-3, 2), (5, 6), (-1, 6), (7, 12), (67, 109), (-299, 360), (1, 13 * 98)];
        for fraction in fractions.map(|(over, under)| Number::rational(over, under)) {
            let parts = partial_fractions(&fraction).expect("these are small");
            let value = |part: &Part| Number::rational(part.times, part.base.pow(part.count));
            let sum = parts.iter().map(value).fold(Number::integer(0), |sum, part| sum.add(&part));
            assert!(sum.same_value(&fraction), "{sum} of {} parts for {fraction}", parts.len());
        }
    }
}
