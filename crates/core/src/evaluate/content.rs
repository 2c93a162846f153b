//! The numeric content of a node: the positive rational by which it is a multiple of something without content.
//!
//! A prime number may be no square in a lane. So that |67 x| = 67 |x| and sqrt(67 x) = sqrt(67) sqrt(x) hold there, signs
//! and roots are taken of what is left without the content. The power of a prime q in the content is found by value, so
//! that it does not depend on the form: it is the usual power of q in the values of the node at points of the q-adic
//! integers, where variables and functions are drawn, and signs are those of a lane.

use num_bigint::BigInt;
use num_integer::Integer;
use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Graph, Id, NumberId, View};
use crate::value::{Adics, Field, Number, PARTS, prime_factors};

use super::adic_value::{AdicPoint, POINTS};
use super::integer_point::Rationals;

/// Larger sums and products have no content.
const SEARCH: usize = 4096;

impl Graph {
    /// The content of a node, without the primes that are squares in a field; `None` if it is one.
    pub(super) fn numeric_content(&self, id: Id, f: &Field) -> Option<Number> {
        let least = f.least_non_square();
        if let Some(known) = self.lanes.borrow().content(id, least) {
            return known.clone();
        }
        let content = self.content_of(&[(1, id)], least);
        self.lanes.borrow_mut().insert_content(id, least, content.clone());
        content
    }

    /// The content of a - b, likewise.
    pub(super) fn content_of_difference(&self, a: Id, b: Id, f: &Field) -> Option<Number> {
        let least = f.least_non_square();
        if let Some(known) = self.lanes.borrow().content_of_difference(a, b, least) {
            return known.clone();
        }
        let content = self.content_of(&[(1, a), (-1, b)], least);
        self.lanes.borrow_mut().insert_content_of_difference(a, b, least, content.clone());
        content
    }

    /// The content that two nodes have in common; `None` if it is one.
    pub(super) fn common_content(&self, a: Id, b: Id, f: &Field) -> Option<Number> {
        let [a, b] = [a, b].map(|id| self.numeric_content(id, f).unwrap_or_else(|| Number::integer(1)));
        let denominator = a.denominator().lcm(&b.denominator());
        let whole = |number: &Number| number.numerator() * (&denominator / number.denominator());
        Number::from_big(whole(&a).gcd(&whole(&b)), denominator).ok().filter(|content| !content.is_one())
    }

    /// The content of a sum of multiples, of primes from the least one up.
    fn content_of(&self, terms: &[(i64, Id)], least: u64) -> Option<Number> {
        let order = self.open_parts(terms);
        let contents = self.primes_of(terms, &order, least).into_iter().map(|prime| {
            let power = self.valuation(terms, &order, &prime);
            (Number::whole(prime), power)
        });
        let content = contents.fold(Number::integer(1), |product, (prime, power)| {
            prime.powi(power).map_or_else(|_| product.clone(), |factor| product.mul(&factor))
        });
        (!content.is_one()).then_some(content)
    }

    /// The nodes from whose values the q-adic values of terms are found, parts first; none if there are too many.
    fn open_parts(&self, terms: &[(i64, Id)]) -> Vec<Id> {
        let (mut order, mut seen) = (Vec::new(), rustc_hash::FxHashSet::default());
        let mut stack: Vec<(Id, bool)> = terms.iter().rev().map(|&(_, id)| (id, false)).collect();
        let mut parts = Vec::new();
        while let Some((id, expanded)) = stack.pop() {
            if expanded {
                order.push(id);
            } else if seen.insert(id) {
                if seen.len() > SEARCH {
                    return Vec::new();
                }
                stack.push((id, true));
                parts.clear();
                self.push_adic_parts(id, &mut parts);
                stack.extend(parts.iter().rev().map(|&part| (part, false)));
            }
        }
        order
    }

    /// The primes from the least one up that the content may hold: those of the numbers in the nodes, and those that two
    /// values at points of integers have in common, because sums make new ones.
    fn primes_of(&self, terms: &[(i64, Id)], nodes: &[Id], least: u64) -> BTreeSet<BigInt> {
        let mut numbers: BTreeSet<u32> = BTreeSet::new();
        let (mut sums, mut bases) = (Vec::new(), Vec::new());
        let mut note = |number: NumberId| {
            if !self.get_number(number).abs().is_one() {
                numbers.insert(number.0);
            }
        };
        for &id in nodes {
            match self.view(id) {
                View::Number(number) | View::Scale(number, _) => note(number),
                View::Sum(terms) => {
                    sums.push(id);
                    terms.iter().for_each(|(number, _)| note(number));
                }
                _ => bases.extend(self.adic_bases(id)),
            }
        }
        if numbers.is_empty() && bases.is_empty() && terms.len() == 1 {
            return BTreeSet::new();
        }
        let literals = numbers.into_iter().map(|number| self.get_number(NumberId(number)).clone());
        let all =
            literals.chain(bases).chain(self.shared_numbers(terms, &sums)).filter(|number| !number.is_zero());
        let primes = all.flat_map(|number| prime_factors(&number.abs()).into_keys());
        primes.filter(|prime| *prime >= least.into()).collect()
    }

    /// What the values of nodes at two points of integers have in common, in numerators and in denominators.
    fn shared_numbers(&self, terms: &[(i64, Id)], nodes: &[Id]) -> Vec<Number> {
        let roots: Vec<Id> = terms.iter().map(|&(_, id)| id).collect();
        let Some([first, second]) = self.at_two_points(&roots) else { return Vec::new() };
        let of_terms = |values: &Rationals| {
            terms.iter().try_fold(Number::integer(0), |sum, &(factor, id)| {
                Some(sum.add(&values.guess(id)?.mul(&Number::integer(factor))))
            })
        };
        let pairs = nodes.iter().map(|&id| first.guess(id).zip(second.guess(id)));
        let shared = pairs.chain([of_terms(&first).zip(of_terms(&second))]).flatten().map(|(a, b)| {
            let common = |a: BigInt, b: BigInt| Number::whole(a.gcd(&b));
            [common(a.numerator(), b.numerator()), common(a.denominator(), b.denominator())]
        });
        shared.flatten().collect()
    }

    /// The power of a prime in the content of a sum of multiples.
    fn valuation(&self, terms: &[(i64, Id)], order: &[Id], prime: &BigInt) -> i64 {
        let adics = Adics::new(prime);
        let at = |point: u16| {
            let values = self.adic_values(order, &AdicPoint { adics: &adics, number: point });
            let sum = terms.iter().fold(Adics::zero(), |sum, (factor, id)| {
                adics.add(&sum, &adics.mul(&adics.number(&(*factor).into(), 0), &values[id]))
            });
            sum.leading().map(|leading| leading.valuation)
        };
        let most_frequent = |points: std::ops::Range<u16>| {
            let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
            for valuation in points.filter_map(at) {
                *counts.entry(valuation).or_default() += 1;
            }
            counts.into_iter().max_by_key(|&(_, count)| count).map(|(valuation, _)| valuation)
        };
        let found = most_frequent(0..POINTS).or_else(|| most_frequent(POINTS..2 * POINTS));
        found.map_or(0, |valuation| valuation.div_euclid(PARTS))
    }
}
