//! From nodes to polynomials: products of sums, and sines, cosines and tangents of sums, are multiplied out.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::graph::{Function, Graph, Id, View};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::addition_theorem::{CIRCULAR, update_units, waves_of};
use super::ring::{Ring, single_power};

/// The nodes that become part of the polynomial; each choice includes the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Opening {
    /// Sums in sums; sums in products stay atoms.
    Sums,
    /// Products and powers of sums.
    Products,
    /// Sines, cosines and tangents of sums and multiples; the hyperbolic ones as well if a user requests it.
    Angles,
}

const EXPANDED: &str = "the parts of a node are expanded before it, and kept for all that ask for them";

/// The most terms of an expansion that a user requests, and the limit of its work.
const TERMS: usize = 200_000;
const BUDGET: Budget = Budget::new(TERMS, 5_000_000);
/// With angles the parts of an expression share the budget, because angles within angles make each part far larger than
/// the one inside it. This much work for a part is free, so that an expression may have many parts.
const FREE: usize = 1000;
/// Exponents from this one on stay closed, unless a user requests the expansion.
const LARGEST_EXPONENT: u64 = 257;

impl Graph {
    /// Multiply products and powers of sums out, also in arguments and denominators.
    ///
    /// # Errors
    /// If the result would have too many terms.
    pub fn expand(&mut self, id: Id) -> Result<Id, Error> {
        self.expand_to(id, Opening::Products)
    }

    /// Like [`Self::expand`], and sines, cosines and tangents of sums and of integer multiples, circular and hyperbolic,
    /// become those of single angles.
    ///
    /// # Errors
    /// If the result would have too many terms.
    pub fn expand_trig(&mut self, id: Id) -> Result<Id, Error> {
        self.expand_to(id, Opening::Angles)
    }

    fn expand_to(&mut self, id: Id, opening: Opening) -> Result<Id, Error> {
        let mut budget = BUDGET;
        self.choose_form(|graph| {
            graph.inside_out(id, Self::push_enclosed, &mut |graph, part| {
                if opening < Opening::Angles {
                    budget = BUDGET;
                }
                budget.return_work(FREE);
                let mut ring = Ring::new(graph, budget);
                ring.opens_all = true;
                let polynomial = ring.polynomial(part, opening)?;
                if opening == Opening::Angles {
                    // Each factor is handled twice: the node is made, and its value is compared with that of the part.
                    ring.budget.spend(2 * polynomial.factor_count())?;
                }
                budget = ring.budget;
                ring.node_of(&polynomial)
            })
        })
    }
}

/// The state of one conversion.
struct Expansion {
    opening: Opening,
    /// Nodes that stay closed.
    leaves: FxHashSet<Id>,
    memo: FxHashMap<Id, Polynomial>,
    /// How often the polynomial of a node will still be used; the last use takes it.
    uses: FxHashMap<Id, u32>,
    /// Atomic angle -> the largest angle of which all its multiples are integer multiples, for each kind of waves.
    units: [FxHashMap<Monomial, Number>; 2],
}

impl Ring<'_> {
    /// The polynomial of a node.
    pub(crate) fn polynomial(&mut self, root: Id, opening: Opening) -> Result<Polynomial, Error> {
        self.polynomial_over(root, opening, FxHashSet::default())
    }

    /// The polynomial of a node in which the given nodes stay closed.
    pub(super) fn polynomial_over(
        &mut self,
        root: Id,
        opening: Opening,
        leaves: FxHashSet<Id>,
    ) -> Result<Polynomial, Error> {
        let (memo, units) = (FxHashMap::default(), Default::default());
        let uses = FxHashMap::from_iter([(root, 1)]);
        let mut state = Expansion { opening, leaves, memo, uses, units };
        let order = self.opened_nodes(root, &state.leaves)?;
        for &id in &order {
            if self.is_opened(id, &state.leaves) {
                for child in self.graph.children(id) {
                    *state.uses.entry(child).or_default() += 1;
                }
            }
        }
        if opening == Opening::Angles {
            self.find_units(&order, &mut state.units)?;
        }
        for id in order {
            let polynomial = self.expand_node(id, &mut state)?;
            state.memo.insert(id, polynomial);
        }
        self.operand(root, &mut state)
    }

    /// The argument of a sine or cosine as a sum of atoms.
    pub(crate) fn angle(&mut self, argument: Id) -> Result<Polynomial, Error> {
        if let Some(known) = self.angles.get(&argument) {
            return Ok(known.clone());
        }
        let angle = self.polynomial(argument, Opening::Products)?;
        self.angles.insert(argument, angle.clone());
        Ok(angle)
    }

    /// For each atomic angle, find the largest angle of which all its multiples are integer multiples.
    fn find_units(&mut self, order: &[Id], units: &mut [FxHashMap<Monomial, Number>]) -> Result<(), Error> {
        for &id in order {
            if let Some((_, argument, place)) = self.opened_wave(id) {
                update_units(&mut units[place], &self.angle(argument)?, self.opens_all);
            }
        }
        Ok(())
    }

    /// The function of a wave that may be opened, its argument, and its kind.
    fn opened_wave(&self, id: Id) -> Option<(Function, Id, usize)> {
        let View::Function(shape, args) = self.graph.view(id) else { return None };
        let place = waves_of(shape).filter(|&place| place == CIRCULAR || self.opens_all)?;
        Some((shape, args.get(0), place))
    }

    fn is_opened(&self, id: Id, leaves: &FxHashSet<Id>) -> bool {
        let compound = matches!(self.graph.view(id), View::Sum(_) | View::Product(_) | View::Scale(..));
        compound && !leaves.contains(&id)
    }

    /// The nodes that the polynomial is made of, children first.
    fn opened_nodes(&mut self, root: Id, leaves: &FxHashSet<Id>) -> Result<Vec<Id>, Error> {
        let mut order = Vec::new();
        let mut seen: FxHashSet<Id> = FxHashSet::default();
        let mut stack = vec![(root, false)];
        while let Some((id, done)) = stack.pop() {
            if done {
                order.push(id);
            } else if seen.insert(id) {
                self.budget.spend(1)?;
                stack.push((id, true));
                if self.is_opened(id, leaves) {
                    stack.extend(self.graph.children(id).into_iter().rev().map(|child| (child, false)));
                }
            }
        }
        Ok(order)
    }

    fn expand_node(&mut self, id: Id, state: &mut Expansion) -> Result<Polynomial, Error> {
        if !self.is_opened(id, &state.leaves) {
            return match self.opened_wave(id) {
                Some((shape, argument, place))
                    if state.opening == Opening::Angles && !state.leaves.contains(&id) =>
                {
                    let angle = self.angle(argument)?;
                    self.expand_wave(id, shape, &angle, &state.units[place])
                }
                _ => Ok(self.leaf(id)),
            };
        }
        match self.graph.view(id) {
            View::Scale(factor, child) => {
                let factor = self.graph.get_number(factor).clone();
                Ok(self.operand(child, state)?.scaled(&factor))
            }
            View::Sum(terms) => {
                let terms: Vec<_> =
                    terms.iter().map(|(c, node)| (self.graph.get_number(c).clone(), node)).collect();
                self.expand_sum(&terms, state)
            }
            View::Product(factors) => {
                let factors: Vec<_> =
                    factors.iter().map(|(base, e)| (base, self.graph.get_number(e).clone())).collect();
                let mut product = Polynomial::constant(Number::integer(1));
                for (base, exponent) in factors {
                    let power = self.expand_power(base, &exponent, state)?;
                    product = self.times(&product, &power)?;
                }
                Ok(product)
            }
            _ => Ok(self.leaf(id)),
        }
    }

    /// The polynomial of a child; the last use takes it without a copy.
    fn operand(&mut self, id: Id, state: &mut Expansion) -> Result<Polynomial, Error> {
        let left = state.uses[&id];
        if left <= 1 {
            return Ok(state.memo.remove(&id).expect(EXPANDED));
        }
        state.uses.insert(id, left - 1);
        let polynomial = state.memo.get(&id).expect(EXPANDED).clone();
        self.budget.spend(polynomial.len())?;
        Ok(polynomial)
    }

    /// Add the smaller polynomials to the largest, so that a chain of sums takes linear time.
    fn expand_sum(&mut self, terms: &[(Number, Id)], state: &mut Expansion) -> Result<Polynomial, Error> {
        let mut largest = Polynomial::default();
        for (factor, node) in terms {
            let mut part = self.operand(*node, state)?;
            if !factor.is_one() {
                self.budget.spend(part.len())?;
                part = part.scaled(factor);
            }
            if part.len() > largest.len() {
                std::mem::swap(&mut part, &mut largest);
            }
            self.budget.spend(part.len())?;
            largest.add_scaled(&part, &Number::integer(1));
        }
        Ok(largest)
    }

    fn expand_power(
        &mut self,
        base: Id,
        exponent: &Number,
        state: &mut Expansion,
    ) -> Result<Polynomial, Error> {
        let polynomial = self.operand(base, state)?;
        let is_opened = polynomial.len() > 1 && state.opening >= Opening::Products;
        if self.opens_all && is_opened && exponent.is_integer() && !exponent.is_negative() {
            let n = exponent.to_i64().map_or(u64::MAX, i64::unsigned_abs);
            return self.power(&polynomial, n);
        }
        let Some((num, den)) = exponent.to_small().filter(|(n, _)| n.unsigned_abs() < LARGEST_EXPONENT)
        else {
            let power = self.graph.pow_number(base, exponent)?;
            return Ok(self.leaf(power));
        };
        if den != 1 {
            return self.root_power(base, num, den);
        }
        if is_opened && num > 0 {
            return self.power(&polynomial, num.unsigned_abs());
        }
        let closed = self.closed(&polynomial)?;
        let (monomial, coefficient) = single_power(&closed, num)?;
        Ok(Polynomial::term(monomial, coefficient))
    }

    /// base ** (num / den): a power of the atom base ** (1 / den).
    fn root_power(&mut self, base: Id, num: i64, den: i64) -> Result<Polynomial, Error> {
        let root = self.graph.pow_number(base, &Number::rational(1, den))?;
        let is_plain = matches!(self.graph.view(root), View::Product(factors) if factors.len() == 1);
        if !is_plain {
            let power = self.graph.pow_number(base, &Number::rational(num, den))?;
            return Ok(self.leaf(power));
        }
        let (atom, opposite) = self.atom(root);
        if opposite {
            return Ok(self.leaf(root));
        }
        self.add_root(atom, base, den);
        let one = Polynomial::constant(Number::integer(1));
        self.times(&Polynomial::term(Monomial::power(atom, num), Number::integer(1)), &one)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, NumberId};

    fn symbols(g: &mut Graph) -> [Id; 3] {
        ["a", "b", "c"].map(|name| g.symbol(name, Assumption::Real))
    }

    #[test]
    fn a_square_has_three_terms_and_a_cancelled_one_none() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c] = symbols(g);
        let sum = g.add(a, b);
        let square = g.pow_number(sum, &Number::integer(2))?;
        let expanded = g.expand(square)?;
        assert!(matches!(g.view(expanded), View::Sum(terms) if terms.len() == 3));
        assert!(g.equal(square, expanded));
        let inside = g.mul(square, c)?;
        let sine = g.apply(Function::Sin, &[inside])?;
        let expanded = g.expand(sine)?;
        let View::Function(Function::Sin, args) = g.view(expanded) else { panic!("no sine") };
        assert!(matches!(g.view(args.get(0)), View::Sum(terms) if terms.len() == 3));
        Ok(())
    }

    /// (sqrt(a) + b) (sqrt(a) - b) is a - b^2, also for an a that is not known to be positive.
    #[test]
    fn roots_multiply_to_their_radicand() -> Result<(), Error> {
        let g = &mut Graph::new();
        for assumption in [Assumption::Positive, Assumption::Real] {
            let [a, b] = ["a", "b"].map(|name| g.symbol(name, assumption));
            let root = g.sqrt(a)?;
            let (plus, minus) = (g.add(root, b), g.sub(root, b));
            let product = g.mul(plus, minus)?;
            let square = g.mul(b, b)?;
            let expected = g.sub(a, square);
            assert!(g.equal(product, expected));
            assert_eq!(g.expand(product)?, expected);
        }
        Ok(())
    }

    #[test]
    fn a_deep_chain_of_sums_takes_linear_time() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, _] = symbols(g);
        let mut chain = a;
        for level in 0..100_000 {
            let x = g.symbol(&format!("x{}", level % 1000), Assumption::Real);
            let term = if level % 2 == 0 { g.mul(x, b)? } else { x };
            chain = g.add(chain, term);
        }
        let expanded = g.expand(chain)?;
        assert!(g.equal(chain, expanded));
        assert!(matches!(g.view(expanded), View::Sum(terms) if terms.len() == 1001));
        Ok(())
    }

    /// The work is near the number of terms of the result, which the limits count.
    #[test]
    fn large_powers_are_multiplied_out() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c] = symbols(g);
        let two = g.add(a, b);
        let four = g.add(c, Id::ONE);
        let four = g.add(two, four);
        for (base, exponent, expected) in [(two, 300, 301), (two, 5000, 5001), (four, 40, 12341)] {
            let power = g.pow_number(base, &Number::integer(exponent))?;
            let expanded = g.expand(power)?;
            let View::Sum(terms) = g.view(expanded) else { panic!("no sum") };
            assert_eq!(terms.len(), expected);
            assert!(g.equal(power, expanded));
        }
        let power = g.pow_number(four, &Number::integer(60))?;
        let expanded = g.expand(power)?;
        assert!(g.equal(power, expanded)); // 39 711 terms, in two levels
        for exponent in [200_000, 1_000_000_000_000, i64::MAX] {
            let power = g.pow_number(two, &Number::integer(exponent))?;
            assert!(matches!(g.expand(power), Err(Error::Limit { .. })));
        }
        Ok(())
    }

    #[test]
    fn too_many_terms_are_an_error() -> Result<(), Error> {
        let g = &mut Graph::new();
        let names = (0..12).map(|i| format!("x{i}"));
        let terms: Vec<_> = names.map(|name| (NumberId::ONE, g.symbol(&name, Assumption::Real))).collect();
        let sum = g.sum(&terms);
        let power = g.pow_number(sum, &Number::integer(30))?;
        assert!(matches!(g.expand(power), Err(Error::Limit { .. })));
        Ok(())
    }
}
