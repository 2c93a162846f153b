//! The associative law within a derivation: factors that change rarely are multiplied first.
//!
//! l (cos q q') becomes (l cos q) q': the product of a parameter and a position serves every speed, in
//! derivatives and in code that is split by how often its parts change.

use crate::graph::{Graph, Id, NumberId, View};

type Factor = (Id, NumberId);

impl Graph {
    /// Move the rarely changing factors of a fresh product to a factor that changes rarely.
    pub(crate) fn associate(&mut self, factors: Vec<Factor>) -> Vec<Factor> {
        let [(a, NumberId::ONE), (b, NumberId::ONE)] = factors[..] else { return factors };
        let (rare, product) = if self.level(a) < self.level(b) { (a, b) } else { (b, a) };
        if self.level(rare) == self.level(product)
            || !self.is_fresh_product(product)
            || self.is_constant(rare)
        {
            return factors;
        }
        let View::Product(inner) = self.view(product) else { return factors };
        let (high, low): (Vec<Factor>, Vec<Factor>) =
            inner.iter().partition(|&(base, _)| self.level(base) == self.level(product));
        if low.is_empty() {
            return factors;
        }
        let low: Vec<Factor> = std::iter::once((rare, NumberId::ONE)).chain(low).collect();
        let Ok(low) = self.product(&low) else { return factors };
        std::iter::once((low, NumberId::ONE)).chain(high).collect()
    }

    fn level(&self, id: Id) -> u8 {
        self.flags(id).level()
    }
}
