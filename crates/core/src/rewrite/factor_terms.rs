//! Taking common factors out: a sum of products becomes products of shorter sums.
//!
//! Rectangles: if the terms hold y q for every y of a set Y and every q of a set Q, they are (sum of Y) times (sum of
//! Q). A greedy choice takes the rectangle that saves most operations, then does the same with both factors and with
//! the remaining terms. [Brayton et al. 1982, kernels of a sum of products]

use std::collections::BTreeMap;

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, View};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::expand::Opening;
use super::ring::Ring;

/// Limits of one call.
const BUDGET: Budget = Budget::new(100_000, 5_000_000);
/// Sums of more terms are searched for common atoms only.
const RECTANGLE_SEARCH: usize = 256;
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

/// The terms y q of a sum, for y in `rows` and q in `columns`.
struct Rectangle {
    rows: Polynomial,
    columns: Polynomial,
    saving: i64,
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
        let sum = self.factored_sum(&rest, depth)?;
        let content = self.node_of(&Polynomial::term(monomial, factor))?;
        self.product_of(&[content, sum])
    }

    /// A sum without a factor common to all terms.
    fn factored_sum(&mut self, polynomial: &Polynomial, depth: usize) -> Result<Id, Error> {
        if let Some((root, negative)) = self.square_root(polynomial) {
            let root = self.factored_below(&root, depth - 1)?;
            let square = self.graph.pow_number(root, &Number::integer(2))?;
            return Ok(if negative { self.graph.neg(square) } else { square });
        }
        let mut rest = polynomial.clone();
        let mut parts = Vec::new();
        while let Some(rectangle) = self.best_rectangle(&rest)? {
            let Rectangle { rows, columns, .. } = rectangle;
            let covered = self.times(&rows, &columns)?;
            rest.add_scaled(&covered, &Number::integer(-1));
            let rows = self.factored_below(&rows, depth - 1)?;
            let columns = self.factored_below(&columns, depth - 1)?;
            parts.push(self.product_of(&[rows, columns])?);
        }
        parts.push(self.node_of(&rest)?);
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

    /// The rectangle that saves most; among equal ones, that of the smallest atom.
    fn best_rectangle(&mut self, polynomial: &Polynomial) -> Result<Option<Rectangle>, Error> {
        let mut counts: BTreeMap<(u32, i64), usize> = BTreeMap::new();
        for (monomial, _) in polynomial.iter() {
            for &factor in monomial.factors() {
                *counts.entry(factor).or_default() += 1;
            }
        }
        self.budget.spend(polynomial.len())?;
        let mut best: Option<Rectangle> = None;
        if polynomial.len() > RECTANGLE_SEARCH {
            let most = counts.values().max().copied().unwrap_or(0);
            counts.retain(|_, count| *count == most);
        }
        for ((atom, exponent), count) in counts {
            if count < 2 {
                continue;
            }
            let rectangle = self.rectangle_of(polynomial, atom, exponent)?;
            if rectangle.saving > best.as_ref().map_or(0, |known| known.saving) {
                best = Some(rectangle);
            }
        }
        Ok(best)
    }

    /// The rectangle whose columns are the cofactors of a power of an atom.
    fn rectangle_of(
        &mut self,
        polynomial: &Polynomial,
        atom: u32,
        exponent: i64,
    ) -> Result<Rectangle, Error> {
        let mut holders = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter() {
            if monomial.exponent(atom) == exponent {
                holders.add_term(monomial.clone(), coefficient);
            }
        }
        let (monomial, factor, columns) = content(&holders)?;
        let mut rows = Polynomial::term(monomial.clone(), factor);
        if polynomial.len() <= RECTANGLE_SEARCH {
            self.extend_rows(polynomial, &columns, &mut rows)?;
        }
        let saving = product_cost(polynomial, &rows, &columns)?;
        Ok(Rectangle { rows, columns, saving })
    }

    /// Find the other monomials whose products with all columns are terms of the polynomial.
    fn extend_rows(
        &mut self,
        polynomial: &Polynomial,
        columns: &Polynomial,
        rows: &mut Polynomial,
    ) -> Result<(), Error> {
        let Some((lead, lead_factor)) = columns.iter().next_back() else { return Ok(()) };
        let mut covered = rows.times(columns, &mut self.budget)?;
        for (monomial, coefficient) in polynomial.iter() {
            self.budget.spend(1)?;
            if covered.coefficient(monomial).is_some() {
                continue;
            }
            let row = monomial.over(lead);
            let factor = coefficient.mul(&lead_factor.recip()?);
            let is_row = columns.iter().all(|(column, c)| {
                let term = row.times(column);
                covered.coefficient(&term).is_none()
                    && polynomial.coefficient(&term).is_some_and(|known| known.same_value(&factor.mul(c)))
            });
            if is_row {
                covered.add_scaled(&columns.shifted(&row, &factor), &Number::integer(1));
                rows.add_term(row, &factor);
            }
        }
        Ok(())
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

/// The common monomial, a common numeric factor where that saves multiplications, and the rest.
pub(crate) fn content(polynomial: &Polynomial) -> Result<(Monomial, Number, Polynomial), Error> {
    let monomial = common_monomial(polynomial);
    let factor = common_factor(polynomial);
    let rest = polynomial.shifted(&monomial.pow(-1), &factor.recip()?);
    Ok((monomial, factor, rest))
}

/// The powers that all terms share; an atom with positive and negative exponents has none.
pub(crate) fn common_monomial(polynomial: &Polynomial) -> Monomial {
    let mut common = Monomial::default();
    let Some((first, _)) = polynomial.iter().next() else { return common };
    for &(atom, _) in first.factors() {
        let exponents = || polynomial.iter().map(|(m, _)| m.exponent(atom));
        let lowest = exponents().min().expect("the atom is one of the first term");
        if lowest > 0 || exponents().all(|exponent| exponent < 0) {
            common = common.times(&Monomial::power(atom, lowest));
        }
    }
    common
}

/// The magnitude that most coefficients share, if one multiplication by it saves two or more; otherwise 1.
/// A magnitude that leaves integers is taken even if it saves nothing.
fn common_factor(polynomial: &Polynomial) -> Number {
    let one = Number::integer(1);
    let mut candidates: Vec<Number> = Vec::new();
    for (_, coefficient) in polynomial.iter() {
        let magnitude = coefficient.abs();
        if !magnitude.is_one() && !candidates.iter().any(|known| known.same_value(&magnitude)) {
            candidates.push(magnitude);
        }
        if candidates.len() > 8 {
            return one;
        }
    }
    let multiplications = |factor: &Number| {
        let not_unit = |c: &Number| !c.abs().same_value(factor);
        polynomial.iter().filter(|&(m, c)| not_unit(c) && !m.is_one()).count()
    };
    let whole = polynomial.numeric_content().abs();
    if !whole.is_integer() && !candidates.iter().any(|known| known.same_value(&whole)) {
        candidates.push(whole);
    }
    let fractions = |factor: &Number| {
        let over = |c: &Number| factor.recip().is_ok_and(|f| !c.is_decimal() && !c.mul(&f).is_integer());
        polynomial.iter().filter(|(_, c)| over(c)).count()
    };
    let mut best = (multiplications(&one), fractions(&one), one);
    for candidate in candidates {
        let order = (multiplications(&candidate) + 1, fractions(&candidate));
        if order < (best.0, best.1) {
            best = (order.0, order.1, candidate);
        }
    }
    best.2
}

/// The multiplications of a term, and the operations that a rectangle saves.
fn term_cost(monomial: &Monomial, coefficient: &Number) -> i64 {
    let powers: i64 =
        monomial.factors().iter().map(|&(_, e)| 1 + i64::from(e.unsigned_abs().max(1).ilog2())).sum();
    let numeric = i64::from(!coefficient.abs().is_one() && !monomial.is_one());
    (powers - 1).max(0) + numeric
}

fn product_cost(all: &Polynomial, rows: &Polynomial, columns: &Polynomial) -> Result<i64, Error> {
    let cost = |p: &Polynomial| p.iter().map(|(m, c)| term_cost(m, c) + 1).sum::<i64>() - 1;
    let mut budget = Budget::new(usize::MAX, usize::MAX);
    let covered = rows.times(columns, &mut budget)?;
    debug_assert!(covered.len() <= all.len());
    let is_one = |p: &Polynomial| p.single().is_some_and(|(m, c)| m.is_one() && c.abs().is_one());
    let joining = i64::from(!is_one(rows) && !is_one(columns));
    Ok(cost(&covered) - cost(rows) - cost(columns) - joining)
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
