//! Sums in sums, opened: a rewrite starts from the terms of a sum, and not from the order in which they were added.

use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, View};

impl Graph {
    /// The expression with the terms of sums that occur once, inside another sum, as terms of that sum: `(a + b) + c`
    /// and `(a + c) + b` become one node. A sum that occurs again stays closed, so that it is still shared.
    ///
    /// # Errors
    /// If a part cannot be rebuilt.
    pub(super) fn with_flat_sums(&mut self, root: Id) -> Result<Id, Error> {
        let order = self.post_order(&[root]);
        let mut uses: FxHashMap<Id, u32> = FxHashMap::default();
        for &id in &order {
            for child in self.children(id) {
                *uses.entry(child).or_default() += 1;
            }
        }
        let mut map: FxHashMap<Id, Id> = FxHashMap::default();
        for id in order {
            let flat = match self.view(id) {
                View::Sum(terms) => {
                    let terms: Vec<_> = terms.iter().map(|(c, node)| (c, map[&node], uses[&node])).collect();
                    self.flat_sum(&terms)
                }
                _ if self.children(id).iter().any(|child| map[child] != *child) => {
                    self.rebuild(id, &|_: &Self, child: Id| map[&child])?
                }
                _ => id,
            };
            map.insert(id, if self.same(flat, id) { flat } else { id });
        }
        Ok(map[&root])
    }

    /// The sum of terms that are used so often; those that are sums used once are opened, up to their sign.
    fn flat_sum(&mut self, terms: &[(NumberId, Id, u32)]) -> Id {
        let mut flat = Vec::new();
        for &(coefficient, node, uses) in terms {
            let (factor, inner) = self.split_multiple(coefficient, node);
            match self.view(inner) {
                View::Sum(inner) if uses == 1 && self.get_number(factor).abs().is_one() => {
                    let is_negative = factor == NumberId::MINUS_ONE;
                    let inner: Vec<_> = inner.iter().collect();
                    for (c, node) in inner {
                        flat.push((if is_negative { self.negated(c) } else { c }, node));
                    }
                }
                _ => flat.push((factor, inner)),
            }
        }
        self.sum(&flat)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    fn symbols(g: &mut Graph) -> [Id; 4] {
        ["a", "b", "c", "d"].map(|name| g.symbol(name, Assumption::Real))
    }

    #[test]
    fn the_order_of_addition_does_not_show() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d] = symbols(g);
        let product = g.mul(c, d)?;
        let orders = [[a, b, product, d], [d, product, a, b], [b, d, a, product]];
        let mut forms = Vec::new();
        for order in orders {
            let sum = order[1..].iter().fold(order[0], |sum, &term| g.sub(sum, term));
            let opposite = order[1..].iter().fold(order[0], |sum, &term| g.add(sum, term));
            let total = g.mul(sum, opposite)?;
            let flat = g.with_flat_sums(total)?;
            assert!(g.equal(flat, total));
            let first = g.with_flat_sums(opposite)?;
            forms.push(first);
        }
        assert!(forms.iter().all(|&form| form == forms[0]));
        Ok(())
    }

    #[test]
    fn shared_sums_stay_shared() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d] = symbols(g);
        let shared = g.add(a, b);
        let (left, right) = (g.add(shared, c), g.add(shared, d));
        let product = g.mul(left, right)?;
        let flat = g.with_flat_sums(product)?;
        assert_eq!(g.cost(&[flat]), g.cost(&[product]));
        Ok(())
    }
}
