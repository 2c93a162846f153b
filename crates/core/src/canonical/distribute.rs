//! The distributive law within a derivation: u a + u b becomes u (a + b) where that saves a multiplication.
//!
//! Only products that nothing else uses are taken apart. So each running sum of a chain (of masses, of composite
//! inertias) takes one multiplication instead of one per body.

use crate::error::Error;
use crate::graph::{Graph, Id, LONGEST, NumberId, View};

/// Longer sums are left as they are.
const SEARCH: usize = 24;

const FRESH: &str = "a fresh product is a product";

type Term = (NumberId, Id);
type Factor = (Id, NumberId);

impl Graph {
    /// Take common factors out of the fresh products among the terms, the most frequent factor first.
    pub(super) fn factor_fresh_products(&mut self, mut terms: Vec<Term>) -> Vec<Term> {
        while terms.len() >= 2 && terms.len() <= SEARCH.min(LONGEST) {
            let Some(factor) = self.most_shared_factor(&terms) else { break };
            let (with, mut rest): (Vec<Term>, Vec<Term>) = terms
                .iter()
                .copied()
                .partition(|&(_, id)| self.is_fresh_product(id) && self.has_factor(id, factor));
            let cofactors = with.iter().map(|&(c, id)| Ok((c, self.without_factor(id, factor)?)));
            let Ok(cofactors) = cofactors.collect::<Result<Vec<Term>, Error>>() else { break };
            let sum = self.sum(&cofactors);
            let Ok(product) = self.product(&[factor, (sum, NumberId::ONE)]) else { break };
            rest.push((NumberId::ONE, product));
            terms = self.merge_terms(rest);
        }
        terms
    }

    /// If all terms have one coefficient up to sign: that number, and the terms without it.
    ///
    /// 2 a - 2 b becomes 2 (a - b).
    pub(super) fn split_content(&mut self, terms: &[Term]) -> Option<(NumberId, Vec<Term>)> {
        let [(first, _), _, ..] = *terms else { return None };
        let content = self.get_number(first).abs();
        if content.is_one()
            || terms.iter().any(|&(c, id)| id == Id::ONE || self.get_number(c).abs() != content)
        {
            return None;
        }
        let sign = |c| if self.get_number(c).is_negative() { NumberId::MINUS_ONE } else { NumberId::ONE };
        let bare = terms.iter().map(|&(c, id)| (sign(c), id)).collect();
        Some((self.number_id(&content), bare))
    }

    /// The factor that occurs in most of the fresh products, and in at least two; ties are broken by value.
    fn most_shared_factor(&self, terms: &[Term]) -> Option<Factor> {
        let mut counted: Vec<(Factor, usize)> = Vec::new();
        for &(_, id) in terms {
            if !self.is_fresh_product(id) {
                continue;
            }
            let View::Product(factors) = self.view(id) else { continue };
            for factor in factors.iter() {
                match counted.iter_mut().find(|(known, _)| *known == factor) {
                    Some((_, count)) => *count += 1,
                    None => counted.push((factor, 1)),
                }
            }
        }
        let (factor, count) = counted
            .into_iter()
            .max_by_key(|&((id, _), count)| (count, !self.is_constant(id), self.value(id)))?;
        (count >= 2).then_some(factor)
    }

    fn has_factor(&self, product: Id, factor: Factor) -> bool {
        match self.view(product) {
            View::Product(factors) => factors.iter().any(|known| known == factor),
            _ => false,
        }
    }

    fn without_factor(&mut self, product: Id, factor: Factor) -> Result<Id, Error> {
        let View::Product(factors) = self.view(product) else { unreachable!("{FRESH}") };
        let rest: Vec<_> = factors.iter().filter(|&known| known != factor).collect();
        self.product(&rest)
    }
}
