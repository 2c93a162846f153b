//! Polynomials in chosen variables: their coefficients, and sums ordered by them.

use rustc_hash::FxHashSet;
use std::collections::BTreeMap;

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, View};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::expand::Opening;
use super::ring::Ring;

const BUDGET: Budget = Budget::new(200_000, 5_000_000);

/// The kinds of atoms that a sum may be collected by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Acceleration,
    Speed,
    Parameter,
    Wave,
}

impl Graph {
    /// The sum of powers of the variables times their coefficients; parts without them stay unchanged.
    ///
    /// # Errors
    /// If the result would have too many terms.
    pub fn collect(&mut self, id: Id, variables: &[Id]) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let mut ring = Ring::new(graph, BUDGET);
            ring.opens_all = true;
            let groups = ring.grouped_by_variables(id, variables)?;
            let mut parts = Vec::new();
            for (monomial, coefficient) in groups {
                let coefficient = ring.sum_of_terms(&coefficient)?;
                let power = ring.node_of(&Polynomial::term(monomial, Number::integer(1)))?;
                parts.push(ring.product_of(&[power, coefficient])?);
            }
            let collected = ring.sum_of(&parts);
            // Products of roots may have merged into what has another value in some lanes (docs/values.md).
            Ok(if graph.same(collected, id) { collected } else { id })
        })
    }

    /// The coefficient of variable ** n, where the variable may be a power or a product itself: that of `x**2` is found
    /// among the powers of `x`.
    ///
    /// # Errors
    /// If the expression has too many terms in the variable.
    pub fn coeff(&mut self, id: Id, variable: Id, n: i64) -> Result<Id, Error> {
        let (_, node) = self.split_multiple(NumberId::ONE, variable);
        let bases: Vec<Id> = match self.view(node) {
            View::Product(factors) => factors.iter().map(|(base, _)| base).collect(),
            _ => vec![node],
        };
        self.choose_form(|graph| {
            let mut ring = Ring::new(graph, BUDGET);
            ring.opens_all = true;
            let mut closed = ring.graph.free_of(id, &bases);
            closed.extend(&bases);
            let power = ring.polynomial_over(variable, Opening::Products, closed.clone())?;
            let (monomial, factor) = super::ring::single_power(&power, n)?;
            let (one, _) = super::ring::single_power(&power, 1)?;
            let polynomial = ring.polynomial_over(id, Opening::Products, closed)?;
            let groups = grouped(&polynomial, |atom| one.exponent(atom) != 0);
            let mut coefficient = Polynomial::default();
            for (key, cofactor) in groups {
                if n != 0 && key == monomial {
                    coefficient = cofactor;
                } else if n == 0 && !is_power_of(&key, &one) {
                    for (rest, number) in cofactor.iter() {
                        coefficient.add_term(key.times(rest), number);
                    }
                }
            }
            ring.sum_of_terms(&coefficient.scaled(&factor.recip()?))
        })
    }

    /// How often a coordinate is differentiated, or all coordinates of a sum.
    pub(super) fn rate_order(&self, id: Id) -> Option<u32> {
        let order = |id: Id| match self.view(id) {
            View::TimeFunction(_, order, _) => Some(order),
            _ => None,
        };
        match self.view(id) {
            View::Sum(terms) => {
                let mut orders = terms.iter().map(|(_, term)| order(term));
                let first = orders.next().flatten()?;
                orders.all(|other| other == Some(first)).then_some(first)
            }
            _ => order(id),
        }
    }

    /// The nodes at or below `root` that do not depend on the variables, and the variables.
    fn free_of(&self, root: Id, variables: &[Id]) -> FxHashSet<Id> {
        let is_variable = |id: Id| variables.iter().any(|&v| self.equal(v, id));
        let mut depends: FxHashSet<Id> = FxHashSet::default();
        let mut closed: FxHashSet<Id> = FxHashSet::default();
        for id in self.post_order(&[root]) {
            if is_variable(id) {
                depends.insert(id);
                closed.insert(id);
            } else if self.children(id).iter().any(|child| depends.contains(child)) {
                depends.insert(id);
            } else {
                closed.insert(id);
            }
        }
        closed
    }
}

impl Ring<'_> {
    fn grouped_by_variables(
        &mut self,
        id: Id,
        variables: &[Id],
    ) -> Result<BTreeMap<Monomial, Polynomial>, Error> {
        let closed = self.graph.free_of(id, variables);
        let atoms: Vec<u32> = variables.iter().map(|&variable| self.atom(variable).0).collect();
        let polynomial = self.polynomial_over(id, Opening::Products, closed)?;
        Ok(grouped(&polynomial, |atom| atoms.contains(&atom)))
    }

    /// The sum of terms; closed sums among them are opened.
    fn sum_of_terms(&mut self, polynomial: &Polynomial) -> Result<Id, Error> {
        let mut parts = Vec::new();
        for (monomial, coefficient) in polynomial.iter() {
            parts.push(self.node_of(&Polynomial::term(monomial.clone(), coefficient.clone()))?);
        }
        Ok(self.sum_of(&parts))
    }

    pub(super) fn is_kind(&self, atom: u32, kind: Kind) -> bool {
        match kind {
            Kind::Wave => self.wave(atom).is_some(),
            Kind::Acceleration => self.graph.rate_order(self.node(atom)).is_some_and(|order| order > 1),
            Kind::Speed => self.graph.rate_order(self.node(atom)) == Some(1),
            Kind::Parameter => matches!(self.graph.view(self.node(atom)), View::Symbol(..)),
        }
    }

    /// Collect by each kind of atoms in turn, and take common factors out of the last coefficients.
    pub(crate) fn collected(&mut self, polynomial: &Polynomial, kinds: &[Kind]) -> Result<Id, Error> {
        let Some((&kind, others)) = kinds.split_first() else { return self.factored(polynomial) };
        let groups = grouped(polynomial, |atom| self.is_kind(atom, kind));
        let mut parts = Vec::new();
        for (multiplier, cofactor) in merged(groups)? {
            let cofactor = self.collected(&cofactor, others)?;
            let multiplier = self.factored(&multiplier)?;
            parts.push(self.product_of(&[multiplier, cofactor])?);
        }
        Ok(self.sum_of(&parts))
    }
}

/// Whether a monomial is a power of another one.
fn is_power_of(monomial: &Monomial, base: &Monomial) -> bool {
    let Some(&(atom, exponent)) = base.factors().first() else { return false };
    let n = monomial.exponent(atom) / exponent;
    n != 0 && base.pow(n) == *monomial
}

/// The cofactors of the monomials in the picked atoms.
pub(super) fn grouped(polynomial: &Polynomial, pick: impl Fn(u32) -> bool) -> BTreeMap<Monomial, Polynomial> {
    let mut groups: BTreeMap<Monomial, Polynomial> = BTreeMap::new();
    for (monomial, coefficient) in polynomial.iter() {
        let (picked, rest) = monomial.split(&pick);
        groups.entry(picked).or_default().add_term(rest, coefficient);
    }
    groups
}

/// Group monomials with proportional cofactors, as (sum of monomials, cofactor).
fn merged(groups: BTreeMap<Monomial, Polynomial>) -> Result<Vec<(Polynomial, Polynomial)>, Error> {
    let mut merged: Vec<(Polynomial, Polynomial)> = Vec::new();
    for (monomial, cofactor) in groups {
        let factor = proportion(&cofactor);
        let cofactor = cofactor.scaled(&factor.recip()?);
        match merged.iter_mut().find(|(_, known)| *known == cofactor) {
            Some((sum, _)) => sum.add_term(monomial, &factor),
            None => merged.push((Polynomial::term(monomial, factor), cofactor)),
        }
    }
    Ok(merged)
}

/// The numeric factor by which proportional cofactors differ; without it, integers stay integers.
fn proportion(cofactor: &Polynomial) -> Number {
    if cofactor.iter().any(|(_, c)| c.is_decimal()) {
        return cofactor.iter().next_back().map_or(Number::integer(1), |(_, c)| c.clone());
    }
    cofactor.numeric_content()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Function};

    #[test]
    fn coefficients_rebuild_the_expression() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, x] = ["a", "b", "c", "x"].map(|name| g.symbol(name, Assumption::Real));
        let (sum, other) = (g.add(a, x), g.sub(b, x));
        let closed = g.add(b, c);
        let product = g.product(&[(sum, NumberId::ONE), (other, NumberId::ONE), (closed, NumberId::ONE)])?;
        let mut rebuilt = Id::ZERO;
        for n in 0..=2 {
            let coefficient = g.coeff(product, x, n)?;
            assert!(!g.post_order(&[coefficient]).contains(&x));
            let power = g.pow_number(x, &Number::integer(n))?;
            let term = g.mul(coefficient, power)?;
            rebuilt = g.add(rebuilt, term);
        }
        assert!(g.equal(rebuilt, product));
        assert_eq!(g.coeff(product, x, 3)?, Id::ZERO);
        let square = g.coeff(product, x, 2)?;
        assert_eq!(square, g.neg(closed));
        Ok(())
    }

    #[test]
    fn what_has_no_variable_stays_closed() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, x] = ["a", "b", "c", "x"].map(|name| g.symbol(name, Assumption::Real));
        let square = {
            let sum = g.add(a, b);
            g.pow_number(sum, &Number::integer(2))?
        };
        let (first, second) = (g.mul(square, x)?, g.mul(c, x)?);
        let sine = g.apply(Function::Sin, &[x])?;
        let sum = g.add(first, second);
        let sum = g.add(sum, sine);
        let collected = g.collect(sum, &[x])?;
        assert!(g.equal(sum, collected));
        assert!(g.post_order(&[collected]).contains(&square));
        assert!(matches!(g.view(collected), View::Sum(terms) if terms.len() == 2));
        Ok(())
    }
}
