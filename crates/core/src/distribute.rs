//! The distributive law while deriving: u a + u b becomes u (a + b) where that saves a multiplication.
//!
//! Only products that nothing else uses are taken apart. So the running sums of a chain (of masses, of
//! composite inertias) come out as one multiplication each, not one for every body.

use crate::graph::{Graph, LONGEST};
use crate::node::{Id, NumberId, View};

/// Longer sums are left as they are.
const SEARCH: usize = 24;

type Term = (NumberId, Id);

impl Graph {
    /// Take common factors out of the fresh products among the terms, the most frequent factor first.
    pub(crate) fn factor_fresh_products(&mut self, mut terms: Vec<Term>) -> Vec<Term> {
        while terms.len() >= 2 && terms.len() <= SEARCH.min(LONGEST) {
            let Some(factor) = self.most_shared_factor(&terms) else { break };
            let (with, mut rest): (Vec<Term>, Vec<Term>) = terms
                .iter()
                .copied()
                .partition(|&(_, id)| self.is_fresh_product(id) && self.has_factor(id, factor));
            let cofactors: Vec<Term> =
                with.iter().map(|&(c, id)| (c, self.without_factor(id, factor))).collect();
            let sum = self.sum(&cofactors);
            let Ok(product) = self.mul(factor, sum) else { break };
            rest.push((NumberId::ONE, product));
            terms = self.merge_terms(rest);
        }
        terms
    }

    /// The factor that occurs in most of the fresh products, in two at least; ties go by value.
    fn most_shared_factor(&self, terms: &[Term]) -> Option<Id> {
        let mut counted: Vec<(Id, usize)> = Vec::new();
        for &(_, id) in terms {
            if !self.is_fresh_product(id) {
                continue;
            }
            let View::Product(factors) = self.view(id) else { continue };
            for (base, exponent) in factors.iter().filter(|&(_, e)| e == NumberId::ONE) {
                debug_assert_eq!(exponent, NumberId::ONE);
                match counted.iter_mut().find(|(known, _)| *known == base) {
                    Some((_, count)) => *count += 1,
                    None => counted.push((base, 1)),
                }
            }
        }
        let (factor, count) = counted.into_iter().max_by_key(|&(id, count)| (count, self.value(id)))?;
        (count >= 2).then_some(factor)
    }

    fn has_factor(&self, product: Id, factor: Id) -> bool {
        match self.view(product) {
            View::Product(factors) => factors.iter().any(|(base, e)| base == factor && e == NumberId::ONE),
            _ => false,
        }
    }

    fn without_factor(&mut self, product: Id, factor: Id) -> Id {
        let View::Product(factors) = self.view(product) else { return product };
        let rest: Vec<_> = factors.iter().filter(|&(base, e)| (base, e) != (factor, NumberId::ONE)).collect();
        // Taking a factor away divides by nothing.
        self.product(&rest).unwrap_or(product)
    }
}
