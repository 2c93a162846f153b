//! The numeric content of a node: the powers of prime numbers by which it is a multiple of something without content.
//!
//! A prime number may be no square in a lane. So that |67 x| = 67 |x| and sqrt(67 x) = sqrt(67) sqrt(x) hold there, signs
//! and roots are taken of what is left without the content. Where it is none, 7^(1/3) is negative, so that cubed it is 7,
//! and exponents in the content are rational: sqrt(7^(2/3) x) = 7^(1/3) sqrt(x). The power of a prime q in the content is found by value, so
//! that it does not depend on the form: it is the usual power of q in the values of the node at points of the q-adic
//! integers, where variables and functions are drawn, and signs are those of a lane.

use num_bigint::BigInt;
use num_integer::Integer;
use std::collections::BTreeSet;

use crate::graph::{Combination, Content, Graph, Id, NumberId, View};
use crate::value::{Adics, Coefficient, Extension, Field, Number, Unramified, coprime_factors};

use super::adic_point::{AdicPoint, POINTS, TRIALS};
use super::integer_point::{Rationals, is_long};

/// Larger sums and products have no content.
const SEARCH: usize = 4096;

impl Graph {
    /// The content of a node, without the primes that are squares in a field; `None` if it is one.
    pub(super) fn numeric_content(&self, id: Id, f: &Field) -> Option<Content> {
        self.content_of(Combination::node(self.representative_up_to_sign(id).0), f)
    }

    /// The content of a combination of nodes, likewise.
    pub(super) fn content_of(&self, of: Combination, f: &Field) -> Option<Content> {
        let least = f.least_non_square();
        if let Some(known) = self.lanes.borrow().content(of, least) {
            return known.clone();
        }
        let content = self.find_content(of, least);
        self.lanes.borrow_mut().insert_content(of, least, content.clone());
        content
    }

    /// The content of primes from the least one up.
    fn find_content(&self, of: Combination, least: u64) -> Option<Content> {
        let order = self.open_parts(of);
        not_one(self.primes_of(of, &order, least).into_iter().map(|prime| {
            let exponent = self.valuation(of, &order, &prime);
            (prime, exponent)
        }))
    }

    /// The rational number in the content of a node: that of the whole powers.
    pub(super) fn rational_content(&self, id: Id, f: &Field) -> Number {
        self.numeric_content(id, f).iter().flat_map(|content| content.iter()).fold(
            Number::integer(1),
            |product, (prime, exponent)| {
                let power = exponent.floor().to_i64().and_then(|n| Number::whole(prime.clone()).powi(n).ok());
                power.map_or_else(|| product.clone(), |power| product.mul(&power))
            },
        )
    }

    /// The nodes from whose values the q-adic values of a combination are found, parts first; none if there are too
    /// many.
    fn open_parts(&self, of: Combination) -> Vec<Id> {
        let (mut order, mut seen) = (Vec::new(), rustc_hash::FxHashSet::default());
        let mut stack: Vec<(Id, bool)> = of.nodes().rev().map(|id| (id, false)).collect();
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
    fn primes_of(&self, of: Combination, nodes: &[Id], least: u64) -> BTreeSet<BigInt> {
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
        if numbers.is_empty() && bases.is_empty() && of.is_node() {
            return BTreeSet::new();
        }
        let literals: Vec<Number> =
            numbers.into_iter().map(|number| self.get_number(NumberId(number)).clone()).collect();
        let roots: Vec<Id> = of.nodes().collect();
        let are_long = literals.iter().chain(&bases).any(is_long);
        let pairs = self.at_pairs_of_points(&roots, are_long);
        let shared = pairs.iter().flatten().flat_map(|pair| shared_at(pair, of, &sums));
        let is_rational =
            |pair: &[Rationals; 2]| pair.iter().all(|at| number_of(of, |id| at.get(id)).is_some());
        let norms =
            if pairs.iter().flatten().all(is_rational) { None } else { self.norms_at_pair_of_points(of) };
        let all = literals
            .iter()
            .cloned()
            .chain(bases)
            .chain(shared)
            .chain(norms.iter().flat_map(in_common))
            .filter(|number| !number.is_zero());
        let primes = coprime_factors(all.map(|number| number.abs()));
        let common =
            pairs.filter(|_| self.is_polynomial(nodes)).and_then(|[pair, _]| common_value(&pair, of));
        let may_divide = |prime: &BigInt| {
            let divides = |number: &BigInt| number.is_multiple_of(prime);
            common.as_ref().is_none_or(divides)
                || literals.iter().any(|number| divides(&number.denominator()))
        };
        primes.into_iter().filter(|prime| *prime >= least.into() && may_divide(prime)).collect()
    }

    /// Whether nodes hold variables in sums, products and powers alone, so that their values at integers are polynomials.
    fn is_polynomial(&self, nodes: &[Id]) -> bool {
        nodes.iter().all(|&id| match self.view(id) {
            View::Product(factors) => factors.iter().all(|(_, exponent)| {
                let exponent = self.get_number(exponent);
                exponent.is_integer() && !exponent.is_negative()
            }),
            View::Function(..) => false,
            _ => true,
        })
    }

    /// The power of a prime in the content of a combination. Where digits cancel, as in (1/q**9 + x)**2 - (1/q**9 - x)**2, it
    /// takes more of them, and where there are roots of numbers, it takes an extension that has these.
    fn valuation(&self, of: Combination, order: &[Id], prime: &BigInt) -> Number {
        let with_roots = order.iter().any(|&id| self.holds_root_of_number(id));
        let (found, is_lost) = match Extension::of_prime(prime, with_roots) {
            Extension::Words(ring) => self.valuation_in(of, order, &Adics::new(ring)),
            Extension::Long(ring) => self.valuation_in(of, order, &Adics::new(ring)),
        };
        if !is_lost {
            return found;
        }
        self.valuation_in(of, order, &Adics::new(Unramified::with_many_digits(prime, with_roots))).0
    }

    /// The power, and whether digits were lost.
    fn valuation_in<C: Coefficient>(
        &self,
        of: Combination,
        order: &[Id],
        adics: &Adics<C>,
    ) -> (Number, bool) {
        let usual = |first: u16| {
            usual((first..first + POINTS).filter_map(|point| self.valuation_at(of, order, adics, point)))
        };
        let found = usual(0).or_else(|| usual(POINTS)).unwrap_or_else(|| Number::integer(0));
        (found, adics.take_lost())
    }

    /// The power of the prime in a combination at a point, where that is not zero and nothing has a pole.
    fn valuation_at<C: Coefficient>(
        &self,
        of: Combination,
        order: &[Id],
        adics: &Adics<C>,
        point: u16,
    ) -> Option<Number> {
        let mut first = None;
        for trial in 0..TRIALS {
            let at = AdicPoint::new(adics, point, trial);
            let values = self.adic_values(order, &at);
            if at.has_pole() {
                return None;
            }
            let value = of.value(
                |id| values.get(&id).cloned(),
                |value| adics.mul(&value, &value),
                |a, sign, b| adics.add(&a, &adics.mul(&adics.integer(&sign.into()), &b)),
            );
            let valuation = value?.leading().map(|leading| leading.valuation.clone());
            if !at.misses_roots() {
                return valuation;
            }
            if trial == 0 {
                first = valuation;
            }
            if !at.is_to_be_drawn_again() {
                break;
            }
        }
        first
    }
}

/// What the power of a prime is at most of some points: that of the first two if they agree, and else the median of an odd
/// number of them.
///
/// It is the same at all points, but by a rare chance, and where it depends on signs and on the choice between opposite
/// roots. The median of a multiple is that of the multiples, and that of a reciprocal is the opposite one.
fn usual(mut found: impl Iterator<Item = Number>) -> Option<Number> {
    let first = found.next()?;
    let Some(second) = found.next() else { return Some(first) };
    if first == second {
        return Some(first);
    }
    let mut all: Vec<_> = [first, second].into_iter().chain(found).collect();
    all.truncate((all.len() - 1) | 1);
    all.sort_by(Number::compare);
    Some(all.swap_remove(all.len() / 2))
}

/// The greatest common divisor of the values of a polynomial at two points of integers, if they are not too large: a prime
/// that is in no denominator of the polynomial is in its content only if it divides this number.
fn common_value(points: &[Rationals; 2], of: Combination) -> Option<BigInt> {
    let [first, second] = points;
    let at = |values: &Rationals| number_of(of, |id| values.get(id));
    Some(at(first)?.numerator().gcd(&at(second)?.numerator()))
}

/// The combination of the numbers that nodes are.
fn number_of(of: Combination, number: impl Fn(Id) -> Option<Number>) -> Option<Number> {
    of.value(number, |value| value.mul(&value), |a, sign, b| a.add(&Number::integer(sign).mul(&b)))
}

/// What the values of nodes at two points have in common.
fn shared_at([first, second]: &[Rationals; 2], of: Combination, nodes: &[Id]) -> Vec<Number> {
    let of_combination = |values: &Rationals| number_of(of, |id| values.guess(id));
    let pairs = nodes.iter().map(|&id| first.guess(id).zip(second.guess(id)));
    let shared = pairs.chain([of_combination(first).zip(of_combination(second))]).flatten();
    shared.flat_map(|(a, b)| in_common(&[a, b])).collect()
}

/// The common factors of two numbers above and below the line.
fn in_common([a, b]: &[Number; 2]) -> [Number; 2] {
    let common = |a: BigInt, b: BigInt| Number::whole(a.gcd(&b));
    [common(a.numerator(), b.numerator()), common(a.denominator(), b.denominator())]
}

fn not_one(powers: impl Iterator<Item = (BigInt, Number)>) -> Option<Content> {
    let content: Content = powers.filter(|(_, exponent)| !exponent.is_zero()).collect();
    (!content.is_empty()).then_some(content)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::{Assumption, Function};

    /// The content of primes from 61 up.
    fn content(g: &Graph, id: Id) -> Vec<(BigInt, Number)> {
        g.find_content(Combination::node(id), 61).iter().flat_map(|content| content.to_vec()).collect()
    }

    /// The difference of the squares of b + a and b - a, by 4: the product of both, in another form.
    fn product_by_squares(g: &mut Graph, a: Id, b: Id) -> Result<Id, Error> {
        let two = Number::integer(2);
        let squares = [g.add(b, a), g.sub(b, a)].map(|base| g.pow_number(base, &two));
        let [plus, minus] = squares;
        let difference = g.sub(plus?, minus?);
        let quarter = g.number_id(&Number::rational(1, 4));
        Ok(g.scale(quarter, difference))
    }

    #[test]
    fn a_sum_with_a_root_of_a_number_holds_the_primes_that_it_makes() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (two, cube_root) = (g.integer(2), Number::rational(1, 3));
        let root = g.pow_number(two, &cube_root)?;
        let twice = product_by_squares(g, root, two)?;
        let terms = [(3, 1, twice), (67, 109, root)];
        let terms = terms.map(|(over, under, node)| (g.number_id(&Number::rational(over, under)), node));
        let sum = g.sum(&terms); // (6 + 67/109) root
        let expected = [(103, 1), (109, -1)].map(|(prime, power)| (prime.into(), Number::integer(power)));
        assert_eq!(content(g, sum), expected);
        Ok(())
    }

    #[test]
    fn a_content_is_found_though_many_digits_cancel() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let factor = g.number_id(&Number::rational(1, 67));
        let small = g.scale(factor, x);
        let power = g.pow_number(small, &Number::integer(9))?;
        let less = g.sub(power, Id::ONE);
        let product = product_by_squares(g, less, x)?;
        assert_eq!(content(g, product), [(67.into(), Number::integer(-9))]);
        Ok(())
    }

    #[test]
    fn sines_of_an_angle_and_of_its_half_have_one_content() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Real);
        let half = g.number_id(&Number::rational(1, 2));
        let half = g.scale(half, x);
        let (sine, cosine) = (g.apply(Function::Sin, &[half])?, g.apply(Function::Cos, &[half])?);
        let product = g.mul(sine, cosine)?;
        let (sine, number) = (g.apply(Function::Sin, &[x])?, g.integer(67));
        // ((67 + sin(x))**2 - (67 - 2*sin(x/2)*cos(x/2))**2)/4
        let two = g.number_id(&Number::integer(2));
        let (plus, twice) = (g.add(number, sine), g.scale(two, product));
        let minus = g.sub(number, twice);
        let [plus, minus] = [plus, minus].map(|base| g.pow_number(base, &Number::integer(2)));
        let difference = g.sub(plus?, minus?);
        assert_eq!(content(g, difference), [(67.into(), Number::integer(1))]);
        Ok(())
    }

    #[test]
    fn powers_of_a_root_of_odd_degree_cancel() -> Result<(), Error> {
        let g = &mut Graph::new();
        let x = g.symbol("x", Assumption::Positive);
        let two = g.integer(2);
        for (radicand, (over, under), power) in [
            (two, (1, 3), 3),
            (two, (5, 3), 3),
            (x, (1, 3), 3),
            (x, (1, 6), 6),
            (x, (1, 7), 2),
            (x, (3, 7), 7),
        ] {
            // (root + 67 y)^n - root^n is a multiple of 67
            let root = g.pow_number(radicand, &Number::rational(over, under))?;
            let (y, number) = (g.symbol("y", Assumption::Real), g.number_id(&Number::integer(67)));
            let multiple = g.scale(number, y);
            let base = g.add(root, multiple);
            let power = Number::integer(power);
            let (whole, cancelled) = (g.pow_number(base, &power)?, g.pow_number(root, &power)?);
            let difference = g.sub(whole, cancelled);
            let found = content(g, difference);
            assert_eq!(found, [(67.into(), Number::integer(1))], "{over}/{under} to the power {power}");
        }
        Ok(())
    }

    /// The primes from 37 up that the content of a sum of multiples of x and y may hold.
    fn primes_of_sum(x: Number, y: Number) -> Vec<BigInt> {
        let g = &mut Graph::new();
        let terms = [("x", x), ("y", y)].map(|(name, factor)| {
            let symbol = g.symbol(name, Assumption::Real);
            (g.number_id(&factor), symbol)
        });
        let sum = g.sum(&terms);
        let of = Combination::node(sum);
        g.primes_of(of, &g.open_parts(of), 37).into_iter().collect()
    }

    #[test]
    fn a_prime_that_does_not_divide_the_values_of_a_polynomial_is_left_out() {
        let whole = Number::integer;
        assert_eq!(primes_of_sum(whole(37 * 41), whole(43)), []);
        assert_eq!(primes_of_sum(whole(67 * 41), whole(67 * 43)), [67.into()]);
        assert_eq!(primes_of_sum(Number::rational(41, 67), whole(43)), [67.into()]);
    }
}
