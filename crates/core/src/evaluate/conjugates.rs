//! The rational part of values that hold roots of numbers, such as the 1 in 1 + sqrt(13).
//!
//! At a point of integers the length sqrt(x^2 + y^2) is a root such as sqrt(13). Roots of different primes are linearly
//! independent over the rational numbers [Besicovitch 1940], so the rational part of a value is the mean of its conjugates,
//! in which each q^(1/n) of a prime q is multiplied by a root e^(2 pi i k/n) of one. Like the value, it is additive, and
//! it is that of every form. A root inside a root has no rational part here. The product of the conjugates, the norm, is
//! rational as well: a prime in the content of a value divides it.

use num_bigint::BigInt;
use num_integer::Integer;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

use crate::graph::{Flags, Graph, Id, View};
use crate::value::{Element, FieldId, Number, Quadratic, fingerprint, likely_number, prime_factors};

/// The most conjugates of a value.
const MOST_CONJUGATES: i64 = 64;

/// The lanes from whose values a norm is found: it has many digits, being a product.
const LANES_FOR_NORMS: usize = 32;

type Powers = BTreeMap<BigInt, i64>;

/// The roots below a node at a point of integers.
pub(super) struct Radicals {
    /// The prime factors of the radicands, with -1 for what is negative.
    radicands: FxHashMap<Id, Powers>,
    /// The least n such that the roots of a prime are powers of one of degree n.
    degrees: Vec<(BigInt, i64)>,
}

/// One of the conjugations: by which part of 1/n of a turn the root of each prime is multiplied.
pub(super) struct Conjugation<'a> {
    radicals: &'a Radicals,
    turns: FxHashMap<&'a BigInt, i64>,
}

impl Radicals {
    /// How many conjugations there are.
    pub(super) fn count(&self) -> usize {
        self.conjugations().count()
    }

    /// All conjugations.
    pub(super) fn conjugations(&self) -> impl Iterator<Item = Conjugation<'_>> {
        let count = self.degrees.iter().map(|(_, degree)| degree).product();
        (0..count).map(|mut number: i64| {
            let mut turns = FxHashMap::default();
            for (prime, degree) in &self.degrees {
                turns.insert(prime, number % degree);
                number /= degree;
            }
            Conjugation { radicals: self, turns }
        })
    }
}

impl Conjugation<'_> {
    /// By which part of a turn this power of a node is multiplied.
    pub(super) fn turn_of(&self, base: Id, exponent: &Number) -> Number {
        let powers = self.radicals.radicands.get(&base).into_iter().flatten();
        powers.fold(Number::integer(0), |sum, (prime, &count)| {
            let turns = self.turns.get(prime).copied().unwrap_or(0);
            sum.add(&exponent.mul(&Number::integer(turns * count)))
        })
    }
}

impl Graph {
    /// The roots among nodes whose values are known where they are rational, if all are those of rational numbers and have few conjugates.
    pub(super) fn radicals(&self, order: &[Id], value: impl Fn(Id) -> Option<Number>) -> Option<Radicals> {
        let (mut radicands, mut degrees) = (FxHashMap::default(), BTreeMap::new());
        for &id in
            order.iter().filter(|&&id| self.flags(id).has(Flags::BRANCH) || self.holds_root_of_number(id))
        {
            let View::Product(factors) = self.view(id) else { continue };
            for (base, exponent) in factors.iter() {
                let exponent = self.get_number(exponent);
                if exponent.is_integer() {
                    continue;
                }
                let base = self.representative(base);
                let powers = match radicands.remove(&base) {
                    Some(known) => known,
                    None => powers_of(&value(base)?),
                };
                for (prime, &count) in &powers {
                    let degree = exponent.mul(&Number::integer(count)).to_small()?.1;
                    let known = degrees.entry(prime.clone()).or_insert(1i64);
                    *known = known.lcm(&degree);
                }
                radicands.insert(base, powers);
            }
        }
        degrees.retain(|_, degree| *degree > 1);
        let count = degrees.values().try_fold(1i64, |count, degree| count.checked_mul(*degree))?;
        let degrees: Vec<_> = degrees.into_iter().collect();
        (count > 1 && count <= MOST_CONJUGATES).then_some(Radicals { radicands, degrees })
    }

    pub(super) fn holds_root_of_number(&self, id: Id) -> bool {
        matches!(self.view(id), View::Product(factors) if factors.iter().any(|(base, _)| self.as_number(base).is_some()))
    }
}

/// The mean of the conjugates of a value that a point of integers has in a field, if that is rational.
pub(super) fn mean_of_conjugates(
    radicals: &Radicals,
    value: impl Fn(&Conjugation<'_>, FieldId) -> Option<Quadratic>,
) -> Option<Number> {
    let mean = |field: FieldId| {
        let f = field.field();
        let (mut sum, mut count) = (f.number(&Number::integer(0)), 0);
        for conjugation in radicals.conjugations() {
            sum = f.add(&sum, &value(&conjugation, field)?);
            count += 1;
        }
        Some(f.mul(&f.number(&Number::rational(1, count)), &sum))
    };
    let [first, second] = FieldId::HASH.map(mean);
    rational(fingerprint([&first?, &second?]))
}

/// The product of the conjugates of a value that a point of integers has in a field.
pub(super) fn norm_of_conjugates(
    radicals: &Radicals,
    value: impl Fn(&Conjugation<'_>, FieldId) -> Option<Quadratic>,
) -> Option<Number> {
    let norm = |field: FieldId| {
        let f = field.field();
        radicals
            .conjugations()
            .try_fold(f.one(), |product, conjugation| Some(f.mul(&product, &value(&conjugation, field)?)))
    };
    let [first, second] = FieldId::HASH.map(norm);
    rational(fingerprint([&first?, &second?])).or_else(|| {
        let fields = FieldId::others(0).take(LANES_FOR_NORMS);
        let norms: Option<Vec<_>> = fields.map(|field| Some((field, norm(field)?))).collect();
        likely_number(norms?.into_iter())
    })
}

/// The rational number that has a value, if that is not too large.
pub(super) fn rational(element: Element) -> Option<Number> {
    element.to_simple_rational().or_else(|| element.to_likely_rational())
}

/// The prime factors of a number, with -1 for a negative one.
fn powers_of(number: &Number) -> Powers {
    let mut powers = if number.is_zero() { Powers::new() } else { prime_factors(&number.abs()) };
    if number.is_negative() {
        powers.insert((-1).into(), 1);
    }
    powers
}
