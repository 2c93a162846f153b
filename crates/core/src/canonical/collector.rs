//! The parts of a product under construction: numbers, roots of numbers, and powers of distinct bases.

use num_bigint::BigInt;
use std::collections::BTreeMap;

use crate::graph::{Graph, Id};
use crate::value::{Number, prime_factors};

/// The parts of a product while it is collected.
pub(super) struct Collector {
    pub(crate) coefficient: Number,
    pub(crate) factors: Vec<(Id, Number)>,
    /// The prime factors of numbers under roots, with the sums of their exponents.
    pub(crate) primes: BTreeMap<BigInt, Number>,
}

impl Collector {
    pub(crate) fn new(factors: Vec<(Id, Number)>) -> Self {
        Self { coefficient: Number::integer(1), factors, primes: BTreeMap::new() }
    }

    /// Multiply by the power of a positive number, prime by prime.
    pub(crate) fn push_power_of_number(&mut self, number: &Number, exponent: &Number) {
        self.coefficient =
            self.coefficient.with_decimal(self.coefficient.is_decimal() || number.is_decimal());
        for (prime, count) in prime_factors(number) {
            let total = self.primes.entry(prime).or_insert_with(|| Number::integer(0));
            *total = total.add(&exponent.mul(&Number::integer(count)));
        }
    }

    /// Multiply by base ** exponent; if a base with the same or the opposite value is present, add the exponent to
    /// its own.
    pub(crate) fn push(&mut self, graph: &Graph, base: Id, exponent: &Number) {
        for (position, (known, total)) in self.factors.iter_mut().enumerate() {
            let same = graph.same(*known, base);
            let opposite = !same && exponent.is_integer() && graph.opposite_values(*known, base);
            if !(same || opposite) {
                continue;
            }
            if opposite && !exponent.is_even() {
                self.coefficient = self.coefficient.neg();
            }
            *total = total.add(exponent);
            if total.is_zero() {
                self.factors.remove(position);
            }
            return;
        }
        self.factors.push((base, exponent.clone()));
    }
}
