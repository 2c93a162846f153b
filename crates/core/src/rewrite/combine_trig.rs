//! Products and powers of sines and cosines as sines and cosines of sums (product-to-sum formulas).

use crate::error::Error;
use crate::graph::{Function, Graph, Id};
use crate::polynomial::{Budget, Monomial, Polynomial};
use crate::value::Number;

use super::expand::Opening;
use super::ring::Ring;

const BUDGET: Budget = Budget::new(100_000, 2_000_000);
/// Products with more factors than this stay unchanged, because each factor doubles the terms.
const MOST_FACTORS: u64 = 12;
/// To make the node of a wave takes about fifty times the work of a term.
const WAVE_WORK: usize = 50;

impl Graph {
    /// Write products and powers of sines and cosines as sums of sines and cosines.
    ///
    /// # Errors
    /// If the result would have too many terms.
    pub fn combine_trig(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            graph.inside_out(id, Self::push_enclosed, &mut |graph, part| {
                let mut ring = Ring::new(graph, BUDGET);
                let polynomial = ring.polynomial(part, Opening::Products)?;
                let combined = ring.combined(&polynomial)?;
                ring.node_of(&combined)
            })
        })
    }
}

/// A wave: coefficient, sine or cosine, angle.
type Wave = (Number, Function, Polynomial);

type Signed = (i64, Function);

/// f(a) g(b) = (p(a - b) + q(a + b)) / 2: f, g, then p and q with their signs.
const PRODUCTS: [((Function, Function), [Signed; 2]); 4] = [
    ((Function::Cos, Function::Cos), [(1, Function::Cos), (1, Function::Cos)]),
    ((Function::Sin, Function::Sin), [(1, Function::Cos), (-1, Function::Cos)]),
    ((Function::Sin, Function::Cos), [(1, Function::Sin), (1, Function::Sin)]),
    ((Function::Cos, Function::Sin), [(-1, Function::Sin), (1, Function::Sin)]),
];

impl Ring<'_> {
    /// Every product of waves as a sum of waves.
    pub(super) fn combined(&mut self, polynomial: &Polynomial) -> Result<Polynomial, Error> {
        let mut result = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter() {
            let is_wave = |atom: u32| self.wave(atom).is_some() && monomial.exponent(atom) > 0;
            let (waves, rest) = monomial.split(is_wave);
            let term = if (2..=MOST_FACTORS).contains(&waves.degree()) {
                let sum = self.sum_of_waves(&waves)?;
                sum.shifted(&rest, coefficient)
            } else {
                Polynomial::term(monomial.clone(), coefficient.clone())
            };
            self.budget.spend(term.len())?;
            result.add_scaled(&term, &Number::integer(1));
        }
        Ok(result)
    }

    /// A product of waves as a sum of waves. One that was met before costs the same work again, so that no result depends
    /// on what is remembered.
    fn sum_of_waves(&mut self, product: &Monomial) -> Result<Polynomial, Error> {
        if let Some((sum, work)) = self.sums_of_waves.get(product) {
            self.budget.spend(*work)?;
            return Ok(sum.clone());
        }
        for &(atom, _) in product.factors() {
            if let Some((_, argument)) = self.wave(atom) {
                self.angle(argument)?; // opened once for all products
            }
        }
        let left = self.budget.left();
        let sum = self.new_sum_of_waves(product)?;
        self.sums_of_waves.insert(product.clone(), (sum.clone(), left - self.budget.left()));
        Ok(sum)
    }

    fn new_sum_of_waves(&mut self, product: &Monomial) -> Result<Polynomial, Error> {
        let mut waves: Vec<Wave> = vec![(Number::integer(1), Function::Cos, Polynomial::default())];
        for &(atom, exponent) in product.factors() {
            let Some((shape, argument)) = self.wave(atom) else { continue };
            let angle = self.angle(argument)?;
            for _ in 0..exponent {
                self.budget.spend(waves.len() * WAVE_WORK)?;
                waves = multiplied(&waves, shape, &angle);
            }
        }
        let mut sum = Polynomial::default();
        for (coefficient, shape, angle) in waves {
            sum.add_scaled(&self.wave_of(shape, &angle)?, &coefficient);
        }
        Ok(sum)
    }
}

/// A sum of waves times another wave, with like waves merged.
fn multiplied(waves: &[Wave], shape: Function, angle: &Polynomial) -> Vec<Wave> {
    let half = Number::rational(1, 2);
    let mut products: Vec<Wave> = Vec::new();
    for (coefficient, first, known) in waves {
        let rule = PRODUCTS.iter().find(|(shapes, _)| *shapes == (*first, shape));
        let Some(&(_, [difference, sum])) = rule else { continue };
        for ((sign, product), step) in [(difference, -1), (sum, 1)] {
            let mut total = known.clone();
            total.add_scaled(angle, &Number::integer(step));
            let coefficient = coefficient.mul(&half).mul(&Number::integer(sign));
            match products.iter_mut().find(|(_, f, a)| *f == product && *a == total) {
                Some((sum, _, _)) => *sum = sum.add(&coefficient),
                None => products.push((coefficient, product, total)),
            }
        }
    }
    products.retain(|(coefficient, _, _)| !coefficient.is_zero());
    products
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, NumberId, View};

    #[test]
    fn a_planar_chain_shows_the_difference_of_its_angles() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, k] = ["a", "b", "k"].map(|name| g.symbol(name, Assumption::Real));
        let mut wave = |f, x| g.apply(f, &[x]);
        let (ca, sa) = (wave(Function::Cos, a)?, wave(Function::Sin, a)?);
        let (cb, sb) = (wave(Function::Cos, b)?, wave(Function::Sin, b)?);
        let first = g.product(&[(k, NumberId::ONE), (ca, NumberId::ONE), (cb, NumberId::ONE)])?;
        let second = g.product(&[(k, NumberId::ONE), (sa, NumberId::ONE), (sb, NumberId::ONE)])?;
        let sum = g.add(first, second);
        let difference = g.sub(a, b);
        let cosine = g.apply(Function::Cos, &[difference])?;
        assert_eq!(g.combine_trig(sum)?, g.mul(k, cosine)?);
        Ok(())
    }

    #[test]
    fn powers_become_multiples_of_the_angle() -> Result<(), Error> {
        let g = &mut Graph::new();
        let a = g.symbol("a", Assumption::Real);
        let (sin, cos) = (g.apply(Function::Sin, &[a])?, g.apply(Function::Cos, &[a])?);
        let (three, four) = (g.number_id(&Number::integer(3)), g.number_id(&Number::integer(4)));
        let product = g.product(&[(sin, three), (cos, four)])?;
        let combined = g.combine_trig(product)?;
        assert!(g.equal(product, combined));
        for node in g.post_order(&[combined]) {
            assert!(!matches!(g.view(node), View::Product(_)));
        }
        Ok(())
    }
}
