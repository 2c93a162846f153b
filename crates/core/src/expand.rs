//! Products over sums, and sines and cosines of sums: from nodes to polynomials.

use num_integer::Integer;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::Error;
use crate::function::Function;
use crate::graph::Graph;
use crate::node::{Id, View};
use crate::number::Number;
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::ring::{Ring, single_power};

/// What becomes part of the polynomial; each includes the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Opening {
    /// Sums in sums; sums in products stay atoms.
    Sums,
    /// Products and powers of sums.
    Products,
    /// Sines, cosines and tangents of sums and multiples.
    Angles,
}

/// Limits of what a user may ask for.
const BUDGET: Budget = Budget::new(200_000, 5_000_000);
/// Angles that are larger multiples of their unit stay closed.
const LARGEST_MULTIPLE: i64 = 8;
/// Exponents beyond this stay closed.
const LARGEST_EXPONENT: i64 = 1 << 30;

impl Graph {
    /// Multiply products and powers of sums out, also in arguments and denominators.
    ///
    /// # Errors
    /// When the result would have too many terms.
    pub fn expand(&mut self, id: Id) -> Result<Id, Error> {
        self.expand_to(id, Opening::Products)
    }

    /// Like [`Self::expand`], and sines and cosines of sums and multiples become those of single angles.
    ///
    /// # Errors
    /// When the result would have too many terms.
    pub fn expand_trig(&mut self, id: Id) -> Result<Id, Error> {
        self.expand_to(id, Opening::Angles)
    }

    fn expand_to(&mut self, id: Id, opening: Opening) -> Result<Id, Error> {
        self.choose_form(|graph| {
            graph.inside_out(id, Self::push_enclosed, &mut |graph, part| {
                let mut ring = Ring::new(graph, BUDGET);
                let polynomial = ring.polynomial(part, opening)?;
                ring.to_node(&polynomial)
            })
        })
    }

    /// Work outside of the derivation in progress: a rewrite keeps the form that it makes.
    pub(crate) fn choose_form<T>(&mut self, rewrite: impl FnOnce(&mut Self) -> T) -> T {
        let classes = self.leave();
        let result = rewrite(self);
        if let Some(classes) = classes {
            self.enter(classes);
        }
        result
    }

    /// Rewrite the parts that `find` names from the innermost outward, the root last.
    pub(crate) fn inside_out(
        &mut self,
        root: Id,
        find: impl Fn(&Self, Id, &mut FxHashSet<Id>),
        rewrite: &mut impl FnMut(&mut Self, Id) -> Result<Id, Error>,
    ) -> Result<Id, Error> {
        let order = self.post_order(&[root]);
        let mut enclosed: FxHashSet<Id> = FxHashSet::default();
        enclosed.insert(root);
        for &id in &order {
            find(self, id, &mut enclosed);
        }
        let mut map: FxHashMap<Id, Id> = FxHashMap::default();
        for id in order {
            let children = self.children(id);
            let changed = children.iter().any(|child| map.get(child) != Some(child));
            let lookup = |_: &Self, child: Id| map.get(&child).copied().unwrap_or(child);
            let mut new = if changed { self.rebuild(id, &lookup)? } else { id };
            if enclosed.contains(&id) && !children.is_empty() {
                new = rewrite(self, new)?;
            }
            map.insert(id, new);
        }
        Ok(map.get(&root).copied().unwrap_or(root))
    }

    /// The children of a node that no polynomial reaches: arguments, divisors, radicands.
    pub(crate) fn push_enclosed(&self, id: Id, out: &mut FxHashSet<Id>) {
        match self.view(id) {
            View::Function(_, args) | View::Application { args, .. } => out.extend(args.iter()),
            View::Product(factors) => {
                let is_natural = |e| {
                    let e: &Number = self.get_number(e);
                    e.is_integer() && !e.is_negative()
                };
                out.extend(factors.iter().filter(|&(_, e)| !is_natural(e)).map(|(base, _)| base));
            }
            _ => {}
        }
    }

    /// Also the sums among the factors of a product.
    pub(crate) fn push_enclosed_or_factors(&self, id: Id, out: &mut FxHashSet<Id>) {
        self.push_enclosed(id, out);
        if let View::Product(factors) = self.view(id) {
            out.extend(factors.iter().map(|(base, _)| base));
        }
    }
}

/// The state of one conversion.
struct Expansion {
    opening: Opening,
    /// Nodes that stay closed.
    leaves: FxHashSet<Id>,
    memo: FxHashMap<Id, Polynomial>,
    /// How often a node will still be asked for: the last one takes it.
    uses: FxHashMap<Id, u32>,
    /// Atomic angle -> the largest angle of which all its multiples are whole ones.
    units: FxHashMap<Monomial, Number>,
}

impl Ring<'_> {
    /// The polynomial of a node.
    pub(crate) fn polynomial(&mut self, root: Id, opening: Opening) -> Result<Polynomial, Error> {
        self.polynomial_over(root, opening, FxHashSet::default())
    }

    /// The polynomial of a node in which the given nodes stay closed.
    pub(crate) fn polynomial_over(
        &mut self,
        root: Id,
        opening: Opening,
        leaves: FxHashSet<Id>,
    ) -> Result<Polynomial, Error> {
        let (memo, uses, units) = (FxHashMap::default(), FxHashMap::default(), FxHashMap::default());
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
            return match self.graph.view(id) {
                View::Function(shape @ (Function::Sin | Function::Cos | Function::Tan), args)
                    if state.opening == Opening::Angles && !state.leaves.contains(&id) =>
                {
                    let argument = args.get(0);
                    self.expand_wave(id, shape, argument, &state.units)
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

    /// The polynomial of a child; the last one who asks takes it without a copy.
    fn operand(&mut self, id: Id, state: &mut Expansion) -> Result<Polynomial, Error> {
        let left = state.uses.get(&id).copied().unwrap_or(1);
        if left <= 1 {
            return Ok(state.memo.remove(&id).unwrap_or_default());
        }
        state.uses.insert(id, left - 1);
        let polynomial = state.memo.get(&id).cloned().unwrap_or_default();
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
        let Some((num, den)) = exponent.to_small().filter(|(n, _)| n.abs() < LARGEST_EXPONENT) else {
            let power = self.graph.pow_number(base, exponent)?;
            return Ok(self.leaf(power));
        };
        if den != 1 {
            return self.root_power(base, num, den);
        }
        if polynomial.len() > 1 && num > 0 && state.opening >= Opening::Products {
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
        self.roots.entry(atom).or_insert((base, den));
        let one = Polynomial::constant(Number::integer(1));
        self.times(&Polynomial::term(Monomial::power(atom, num), Number::integer(1)), &one)
    }

    /// For each atomic angle, the greatest common divisor of its multiples.
    fn find_units(&mut self, order: &[Id], units: &mut FxHashMap<Monomial, Number>) -> Result<(), Error> {
        for &id in order {
            let View::Function(Function::Sin | Function::Cos | Function::Tan, args) = self.graph.view(id)
            else {
                continue;
            };
            let argument = args.get(0);
            for (monomial, coefficient) in self.angle(argument)?.iter() {
                let unit = match units.get(monomial) {
                    Some(known) => common_unit(known, coefficient),
                    None => coefficient.abs(),
                };
                units.insert(monomial.clone(), unit);
            }
        }
        Ok(())
    }

    /// sin, cos or tan of a sum of multiples of units, by the addition theorems.
    fn expand_wave(
        &mut self,
        id: Id,
        shape: Function,
        argument: Id,
        units: &FxHashMap<Monomial, Number>,
    ) -> Result<Polynomial, Error> {
        let mut multiples = Vec::new();
        for (monomial, coefficient) in self.angle(argument)?.iter() {
            let unit = units.get(monomial).cloned().unwrap_or_else(|| coefficient.abs());
            let Some(n) = coefficient.mul(&unit.recip()?).to_i64() else { return Ok(self.leaf(id)) };
            if n.abs() > LARGEST_MULTIPLE || coefficient.is_decimal() {
                return Ok(self.leaf(id));
            }
            multiples.push((Polynomial::term(monomial.clone(), unit), n));
        }
        let mut cos = Polynomial::constant(Number::integer(1));
        let mut sin = Polynomial::default();
        for (angle, n) in multiples {
            let c = self.wave_of(Function::Cos, &angle)?;
            let s = self.wave_of(Function::Sin, &angle)?.scaled(&Number::integer(n.signum()));
            for _ in 0..n.abs() {
                (cos, sin) = self.rotate((&cos, &sin), (&c, &s))?;
            }
        }
        match (shape, cos.single().is_some()) {
            (Function::Sin, _) => Ok(sin),
            (Function::Cos, _) => Ok(cos),
            (_, false) => Ok(self.leaf(id)),
            (_, true) => {
                let (monomial, factor) = single_power(&cos, -1)?;
                Ok(sin.shifted(&monomial, &factor))
            }
        }
    }

    /// The cosine and the sine of the sum of two angles.
    fn rotate(
        &mut self,
        (c1, s1): (&Polynomial, &Polynomial),
        (c2, s2): (&Polynomial, &Polynomial),
    ) -> Result<(Polynomial, Polynomial), Error> {
        let mut cos = self.times(c1, c2)?;
        cos.add_scaled(&self.times(s1, s2)?, &Number::integer(-1));
        let mut sin = self.times(s1, c2)?;
        sin.add_scaled(&self.times(c1, s2)?, &Number::integer(1));
        Ok((cos, sin))
    }
}

/// The largest number of which both are whole multiples.
fn common_unit(a: &Number, b: &Number) -> Number {
    let num = (a.numerator() * b.denominator()).gcd(&(b.numerator() * a.denominator()));
    Number::from_big(num, a.denominator() * b.denominator()).unwrap_or_else(|_| a.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::{Assumption, NumberId};

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

    #[test]
    fn roots_multiply_to_their_radicand() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, _] = symbols(g);
        let root = g.sqrt(a)?;
        let (plus, minus) = (g.add(root, b), g.sub(root, b));
        let product = g.mul(plus, minus)?;
        let square = g.mul(b, b)?;
        let expected = g.sub(a, square);
        assert_eq!(g.expand(product)?, expected);
        Ok(())
    }

    #[test]
    fn angles_open_to_their_common_unit() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, _] = symbols(g);
        let (half, three) = (g.number_id(&Number::rational(1, 2)), g.number_id(&Number::integer(3)));
        let angle = g.sum(&[(half, a), (NumberId::MINUS_ONE, b)]);
        let cosine = g.apply(Function::Cos, &[angle])?;
        let multiple = g.scale(three, a);
        let sine = g.apply(Function::Sin, &[multiple])?;
        let sum = g.add(cosine, sine);
        let expanded = g.expand_trig(sum)?;
        assert!(g.equal(sum, expanded));
        let unit = g.scale(half, a);
        for node in g.post_order(&[expanded]) {
            if let View::Function(_, args) = g.view(node) {
                assert!(args.get(0) == unit || args.get(0) == b);
            }
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
