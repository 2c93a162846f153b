//! The cost of evaluating an expression: operations counted once per node of the shared graph, or as a tree.

use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::AddAssign;

use super::function::Function;
use super::node::{Factors, Id, NumberId, Terms, View};
use super::table::Graph;

/// Operation counts. Constants cost nothing: they are folded before the first evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Additions, subtractions and lone negations.
    pub additions: u64,
    /// Products; an integer power counts as its repeated squaring.
    pub multiplications: u64,
    /// Divisions; all divisors of one product share one.
    pub divisions: u64,
    /// Functions and roots.
    pub functions: u64,
}

impl Cost {
    /// The number of all operations.
    #[must_use]
    pub const fn total(self) -> u64 {
        self.additions
            .saturating_add(self.multiplications)
            .saturating_add(self.divisions)
            .saturating_add(self.functions)
    }
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.additions = self.additions.saturating_add(other.additions);
        self.multiplications = self.multiplications.saturating_add(other.multiplications);
        self.divisions = self.divisions.saturating_add(other.divisions);
        self.functions = self.functions.saturating_add(other.functions);
    }
}

impl Graph {
    /// The operations that evaluate the roots together, each node once.
    #[must_use]
    pub fn cost(&self, roots: &[Id]) -> Cost {
        let mut total = Cost::default();
        for cost in self.cost_by_level(roots) {
            total += cost;
        }
        total
    }

    /// The same by what the operations depend on: parameters alone, time and positions, speeds, or accelerations.
    #[must_use]
    pub fn cost_by_level(&self, roots: &[Id]) -> [Cost; 4] {
        let order = self.post_order_where(roots, |id| !self.is_constant(id));
        let mut count = Count::shared(self, roots, &order);
        let mut costs = [Cost::default(); 4];
        for &id in &order {
            costs[usize::from(self.flags(id).level())] += count.of_node(id);
        }
        costs
    }

    /// The operations that evaluate the roots as they are written: shared parts count at each use.
    #[must_use]
    pub fn tree_cost(&self, roots: &[Id]) -> Cost {
        let mut known: FxHashMap<Id, Cost> = FxHashMap::default();
        let mut children = Vec::new();
        // Constants are not visited: they cost nothing.
        for id in self.post_order_where(roots, |id| !self.is_constant(id)) {
            let mut cost = Count::tree(self).of_node(id);
            children.clear();
            self.push_children(id, &mut children);
            for child in &children {
                cost += known.get(child).copied().unwrap_or_default();
            }
            known.insert(id, cost);
        }
        let mut total = Cost::default();
        for root in roots {
            total += known.get(root).copied().unwrap_or_default();
        }
        total
    }
}

/// The state of a count: the uses of each node, and the powers that are known.
struct Count<'g> {
    graph: &'g Graph,
    /// Uses of each node; `None` when every use has its own copy.
    uses: Option<FxHashMap<Id, u32>>,
    /// Powers counted so far: products share them as they share nodes.
    powers: FxHashSet<(Id, NumberId)>,
    /// Matrices factorised so far: the systems that have one share it.
    matrices: FxHashSet<Vec<Id>>,
}

impl<'g> Count<'g> {
    fn tree(graph: &'g Graph) -> Self {
        Self { graph, uses: None, powers: FxHashSet::default(), matrices: FxHashSet::default() }
    }

    fn shared(graph: &'g Graph, roots: &[Id], order: &[Id]) -> Self {
        let mut uses: FxHashMap<Id, u32> = FxHashMap::default();
        let mut children = roots.to_vec();
        for &id in order {
            graph.push_children(id, &mut children);
        }
        for child in children {
            *uses.entry(child).or_default() += 1;
        }
        Self { graph, uses: Some(uses), powers: FxHashSet::default(), matrices: FxHashSet::default() }
    }

    fn used_once(&self, id: Id) -> bool {
        self.uses.as_ref().is_none_or(|uses| uses.get(&id) == Some(&1))
    }

    /// The cost of a node over its children.
    fn of_node(&mut self, id: Id) -> Cost {
        match self.graph.view(id) {
            View::Sum(terms) => self.of_sum(terms),
            View::Product(factors) => self.of_product(factors),
            View::Scale(factor, child) => self.of_multiple(factor, child),
            View::Function(function, args) => {
                let functions = match function {
                    Function::Min | Function::Max => args.len() as u64 - 1,
                    Function::Piecewise => args.len() as u64 / 2,
                    _ => 1,
                };
                Cost { functions, ..Cost::default() }
            }
            View::Application { .. } => Cost { functions: 1, ..Cost::default() },
            View::LinearSystem { matrix, right } => {
                let mut cost = solving(right.len());
                if self.uses.is_none() || self.matrices.insert(matrix.iter().collect()) {
                    cost += factoring(right.len());
                }
                cost
            }
            View::Solution(..)
            | View::Number(_)
            | View::Pi
            | View::Time
            | View::Symbol(..)
            | View::TimeFunction(..) => Cost::default(),
        }
    }

    fn of_sum(&self, terms: Terms<'_>) -> Cost {
        let varying = || terms.iter().filter(|&(_, node)| !self.graph.is_constant(node));
        let constant = usize::from(varying().count() < terms.len());
        let multiplications = varying().filter(|&(c, node)| !self.is_free_factor(c, node)).count();
        Cost {
            additions: (varying().count() + constant - 1) as u64,
            multiplications: multiplications as u64,
            ..Cost::default()
        }
    }

    fn of_multiple(&self, factor: NumberId, child: Id) -> Cost {
        if self.graph.get_number(factor).is_minus_one() {
            let additions = u64::from(!self.takes_sign(child));
            return Cost { additions, ..Cost::default() };
        }
        Cost { multiplications: u64::from(!self.is_free_factor(factor, child)), ..Cost::default() }
    }

    /// Whether a numeric factor costs no multiplication: it is a sign, or merges into a constant of the node.
    fn is_free_factor(&self, factor: NumberId, node: Id) -> bool {
        self.graph.get_number(factor).abs().is_one() || self.has_free_constant(node)
    }

    /// Whether the node is a product with a constant factor, or a bare reciprocal, whose numerator may be any number.
    fn has_free_constant(&self, node: Id) -> bool {
        let View::Product(factors) = self.graph.view(node) else { return false };
        let is_divisor = |e: NumberId| self.graph.get_number(e).is_negative();
        self.used_once(node)
            && (factors.iter().any(|(base, _)| self.graph.is_constant(base))
                || factors.iter().all(|(_, e)| is_divisor(e)))
    }

    /// Whether the node may be computed with the opposite sign at no cost.
    fn takes_sign(&self, node: Id) -> bool {
        if !self.used_once(node) {
            return false;
        }
        match self.graph.view(node) {
            View::Sum(terms) => terms.iter().any(|(c, _)| !self.graph.get_number(c).is_one()),
            View::Product(factors) => {
                let is_odd = |e: NumberId| self.graph.get_number(e).to_i64().is_some_and(|n| n % 2 != 0);
                let flips = |base: Id| {
                    self.used_once(base)
                        && matches!(self.graph.view(base), View::Sum(terms)
                            if terms.iter().any(|(c, _)| !self.graph.get_number(c).is_one()))
                };
                self.has_free_constant(node) || factors.iter().any(|(base, e)| is_odd(e) && flips(base))
            }
            _ => false,
        }
    }

    fn of_product(&mut self, factors: Factors<'_>) -> Cost {
        let mut cost = Cost::default();
        let (mut above, mut below, mut constant) = (0u64, 0u64, false);
        for (base, exponent) in factors.iter() {
            if self.graph.is_constant(base) {
                constant = true;
                continue;
            }
            if self.graph.get_number(exponent).is_negative() {
                below += 1;
            } else {
                above += 1;
            }
            if self.uses.is_none() || self.powers.insert((base, exponent)) {
                cost += self.of_power(exponent);
            }
        }
        above += u64::from(constant);
        cost.multiplications += above.saturating_sub(1) + below.saturating_sub(1);
        cost.divisions += u64::from(below > 0);
        cost
    }

    /// The cost of the power itself, without the division of a negative one.
    fn of_power(&self, exponent: NumberId) -> Cost {
        let Some((num, den)) = self.graph.get_number(exponent).to_small() else {
            return Cost { functions: 1, ..Cost::default() };
        };
        match den {
            1 => Cost { multiplications: repeated_squaring(num), ..Cost::default() },
            2 => Cost { multiplications: repeated_squaring(num), functions: 1, ..Cost::default() },
            _ => Cost { functions: 1, ..Cost::default() },
        }
    }
}

/// The operations of an elimination: a reciprocal, a column of multipliers and an update for each pivot.
pub(crate) const fn factoring(n: usize) -> Cost {
    let n = n as u64;
    let (multipliers, updates) = (n * (n - 1) / 2, n * (n - 1) * (2 * n - 1) / 6);
    Cost { additions: updates, multiplications: multipliers + updates, divisions: n, functions: 0 }
}

/// The operations of two substitutions.
pub(crate) const fn solving(n: usize) -> Cost {
    let n = n as u64;
    Cost { additions: n * (n - 1), multiplications: n * n, divisions: 0, functions: 0 }
}

/// Multiplications in x**n by repeated squaring.
fn repeated_squaring(n: i64) -> u64 {
    let n = n.unsigned_abs();
    u64::from(n.checked_ilog2().unwrap_or(0) + n.count_ones().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::graph::node::Assumption;
    use crate::value::Number;

    fn symbols(g: &mut Graph) -> [Id; 3] {
        ["a", "b", "c"].map(|name| g.symbol(name, Assumption::Real))
    }

    fn counts(cost: Cost) -> [u64; 4] {
        [cost.additions, cost.multiplications, cost.divisions, cost.functions]
    }

    #[test]
    fn sums_count_their_signs_as_subtractions() {
        let g = &mut Graph::new();
        let [a, b, c] = symbols(g);
        let two = g.number_id(&Number::integer(2));
        let sum = g.sum(&[(NumberId::ONE, a), (NumberId::MINUS_ONE, b), (two, c), (two, Id::ONE)]);
        assert_eq!(counts(g.cost(&[sum])), [3, 1, 0, 0]);
        let opposite = g.neg(sum);
        assert_eq!(g.cost(&[opposite]), g.cost(&[sum]));
        let opposite = g.neg(a);
        assert_eq!(counts(g.cost(&[opposite])), [1, 0, 0, 0]);
        assert_eq!(g.cost(&[sum, opposite]).additions, 4);
    }

    #[test]
    fn powers_are_squared_and_divisors_share_a_division() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c] = symbols(g);
        let seventh = g.pow_number(a, &Number::integer(7))?;
        assert_eq!(counts(g.cost(&[seventh])), [0, 4, 0, 0]);
        let n = |g: &mut Graph, n| g.number_id(&Number::integer(n));
        let (minus_two, minus_one) = (n(g, -2), n(g, -1));
        let quotient = g.product(&[(a, NumberId::ONE), (b, minus_two), (c, minus_one)])?;
        assert_eq!(counts(g.cost(&[quotient])), [0, 2, 1, 0]);
        let reciprocal = g.div(Id::ONE, a)?;
        let two = n(g, 2);
        let twice = g.scale(two, reciprocal);
        assert_eq!(counts(g.cost(&[twice])), [0, 0, 1, 0]);
        assert_eq!(counts(g.cost(&[twice, reciprocal])), [0, 1, 1, 0]);
        Ok(())
    }

    #[test]
    fn shared_nodes_count_once_and_constants_not_at_all() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, _] = symbols(g);
        let sine = g.apply(Function::Sin, &[a])?;
        let square = g.mul(sine, sine)?;
        let sum = g.add(square, sine);
        let both = g.mul(sum, sine)?;
        assert_eq!(counts(g.cost(&[both])), [1, 2, 0, 1]);
        assert_eq!(counts(g.tree_cost(&[both])), [1, 2, 0, 3]);
        let three = g.integer(3);
        let root = g.sqrt(three)?;
        let constant = g.add(root, Id::ONE);
        assert_eq!(g.cost(&[constant]).total(), 0);
        let product = g.mul(constant, b)?;
        assert_eq!(counts(g.cost(&[product])), [0, 1, 0, 0]);
        Ok(())
    }

    #[test]
    fn a_tree_of_doubled_sums_saturates() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [mut a, b, _] = symbols(g);
        for _ in 0..200 {
            let sine = g.apply(Function::Sin, &[a])?;
            let product = g.mul(sine, a)?;
            a = g.add(product, b);
        }
        assert_eq!(g.cost(&[a]).total(), 600);
        assert_eq!(g.tree_cost(&[a]).total(), u64::MAX);
        Ok(())
    }
}
