//! Taking common factors out: a sum of products becomes products of shorter sums.
//!
//! A greedy choice takes the rectangle of terms ([`super::rectangle`]) that saves most operations, then does the same with
//! both factors and with the remaining terms. [Brayton et al. 1982, kernels of a sum of products]

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, View};
use crate::polynomial::{Budget, Polynomial};
use crate::value::Number;

use super::content::content;
use super::expand::Opening;
use super::rectangle::{Rectangle, RectangleSearch};
use super::ring::Ring;

/// Limits of one call.
const BUDGET: Budget = Budget::new(100_000, 5_000_000);
/// Sums of more terms are not tried as squares.
const SQUARE_SEARCH: usize = 64;
/// The most levels of factors within factors: bounds the recursion.
const DEEPEST: usize = 40;

impl Graph {
    /// Take common factors, including integers, out of sums at every level; nothing is multiplied out.
    ///
    /// # Errors
    /// If the expression has too many terms.
    pub fn factor_terms(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let flat = graph.with_flat_sums(id)?;
            graph.inside_out(flat, Self::push_enclosed_or_factors, &mut |graph, part| {
                let mut ring = Ring::new(graph, BUDGET);
                let polynomial = ring.polynomial(part, Opening::Sums)?;
                let number = polynomial.numeric_content().abs();
                if polynomial.len() < 2 || !number.is_integer() || number.is_one() {
                    return ring.factored(&polynomial);
                }
                let rest = ring.factored(&polynomial.scaled(&number.recip()?))?;
                let number = ring.graph.number(&number);
                ring.product_of(&[number, rest])
            })
        })
    }
}

impl Ring<'_> {
    /// The node of a polynomial with common factors taken out.
    pub(super) fn factored(&mut self, polynomial: &Polynomial) -> Result<Id, Error> {
        self.factored_below(polynomial, DEEPEST)
    }

    fn factored_below(&mut self, polynomial: &Polynomial, depth: usize) -> Result<Id, Error> {
        if polynomial.len() < 2 || depth == 0 {
            return self.node_of(polynomial);
        }
        let (monomial, factor, rest) = content(polynomial)?;
        let sum = self.known_factored_sum(rest, depth)?;
        let content = self.node_of(&Polynomial::term(monomial, factor))?;
        self.product_of(&[content, sum])
    }

    /// The node of a sum without a factor common to all terms.
    ///
    /// A sum that was met before costs the same work again, so that no result depends on what is remembered.
    fn known_factored_sum(&mut self, sum: Polynomial, depth: usize) -> Result<Id, Error> {
        let sum = (sum, depth);
        if let Some(&(node, work)) = self.factored.get(&sum) {
            self.budget.spend(work)?;
            return Ok(node);
        }
        let left = self.budget.left();
        let node = self.factored_sum(&sum.0, depth)?;
        self.factored.insert(sum, (node, left - self.budget.left()));
        Ok(node)
    }

    fn factored_sum(&mut self, polynomial: &Polynomial, depth: usize) -> Result<Id, Error> {
        if let Some((root, negative)) = self.square_root(polynomial) {
            let root = self.factored_below(&root, depth - 1)?;
            let square = self.graph.pow_number(root, &Number::integer(2))?;
            return Ok(if negative { self.graph.neg(square) } else { square });
        }
        let mut search = RectangleSearch::new(polynomial);
        let mut parts = Vec::new();
        while let Some(Rectangle { rows, columns, terms, .. }) = search.best(&mut self.budget)? {
            self.budget.spend(terms.len())?;
            search.remove(&terms);
            let rows = self.factored_below(&rows, depth - 1)?;
            let columns = self.factored_below(&columns, depth - 1)?;
            parts.push(self.product_of(&[rows, columns])?);
        }
        parts.push(self.node_of(&search.rest())?);
        Ok(self.sum_of(&parts))
    }

    fn square_root(&mut self, polynomial: &Polynomial) -> Option<(Polynomial, bool)> {
        if !(3..=SQUARE_SEARCH).contains(&polynomial.len()) {
            return None;
        }
        let (_, leading) = polynomial.iter().next_back()?;
        let negative = leading.is_negative();
        let sign = Number::integer(if negative { -1 } else { 1 });
        let root = polynomial.clone().scaled(&sign).square_root(&mut self.budget)?;
        Some((root, negative))
    }

    /// A product that opens the products among its factors.
    pub(super) fn product_of(&mut self, parts: &[Id]) -> Result<Id, Error> {
        let mut factors = Vec::new();
        for &part in parts {
            let (coefficient, node) = self.graph.split_multiple(NumberId::ONE, part);
            factors.push((self.graph.number_node(coefficient), NumberId::ONE));
            match self.graph.view(node) {
                View::Product(inner) => factors.extend(inner.iter()),
                _ => factors.push((node, NumberId::ONE)),
            }
        }
        self.graph.product(&factors)
    }

    /// A sum that opens the sums among its terms.
    pub(super) fn sum_of(&mut self, parts: &[Id]) -> Id {
        let mut terms = Vec::new();
        for &part in parts {
            let (outer, node) = self.graph.split_multiple(NumberId::ONE, part);
            match self.graph.view(node) {
                View::Sum(inner) => {
                    let inner: Vec<_> = inner.iter().collect();
                    for (coefficient, id) in inner {
                        let product = self.graph.get_number(outer).mul(self.graph.get_number(coefficient));
                        terms.push((self.graph.number_id(&product), id));
                    }
                }
                _ => terms.push((outer, node)),
            }
        }
        self.graph.sum(&terms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    fn symbols<const N: usize>(g: &mut Graph, names: [&str; N]) -> [Id; N] {
        names.map(|name| g.symbol(name, Assumption::Real))
    }

    #[test]
    fn a_product_of_sums_is_found_again() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d, e] = symbols(g, ["a", "b", "c", "d", "e"]);
        let (left, right) = (g.add(a, b), g.sub(c, d));
        let product = g.mul(left, right)?;
        let sum = g.add(product, e);
        let expanded = g.expand(sum)?;
        assert!(g.cost(&[expanded]).total() > g.cost(&[sum]).total());
        let factored = g.factor_terms(expanded)?;
        assert_eq!(g.cost(&[factored]), g.cost(&[sum]));
        assert!(g.equal(factored, sum));
        Ok(())
    }

    #[test]
    fn squares_are_found_again() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c] = symbols(g, ["a", "b", "c"]);
        let two = g.number_id(&Number::integer(2));
        let sum = g.sum(&[(NumberId::ONE, a), (two, b), (NumberId::MINUS_ONE, c)]);
        let square = g.product(&[(sum, two), (a, NumberId::ONE)])?;
        let expanded = g.expand(square)?;
        assert_eq!(g.factor_terms(expanded)?, square);
        Ok(())
    }

    #[test]
    fn closed_sums_are_common_factors_and_are_factored_themselves() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d] = symbols(g, ["a", "b", "c", "d"]);
        let (ab, ac) = (g.mul(a, b)?, g.mul(a, c)?);
        let sum = g.add(ab, ac);
        let (x, y) = (g.mul(sum, d)?, g.mul(sum, b)?);
        let long = g.add(x, y);
        let factored = g.factor_terms(long)?;
        assert!(g.equal(factored, long));
        assert_eq!(g.cost(&[factored]).total(), 4);
        Ok(())
    }
}
