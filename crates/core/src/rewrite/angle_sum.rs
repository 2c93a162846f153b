//! The addition theorems read backward, where they leave fewer terms: cos a cos b + sin a sin b = cos(a - b).

use crate::error::Error;
use crate::graph::Function;
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use super::ring::Ring;

/// Longer sums stay unchanged.
const LONGEST: usize = 1000;

/// f(a) g(b) + sign f'(a) g'(b) = h(a + step b), where ' exchanges sine and cosine: f, g, sign, h, step.
const THEOREMS: [(Function, Function, i64, Function, i64); 4] = [
    (Function::Cos, Function::Cos, -1, Function::Cos, 1),
    (Function::Cos, Function::Cos, 1, Function::Cos, -1),
    (Function::Sin, Function::Cos, 1, Function::Sin, 1),
    (Function::Sin, Function::Cos, -1, Function::Sin, -1),
];

/// Two atoms of one term, and the waves that they become when they join with their partners.
struct Join {
    /// The product of the two atoms, and of their partners.
    product: Monomial,
    partner: Monomial,
    sign: i64,
    wave: Polynomial,
}

impl Ring<'_> {
    /// Join pairs of terms into waves of sums and differences until no pair is left.
    pub(super) fn join_angles(&mut self, polynomial: &Polynomial) -> Result<Polynomial, Error> {
        let mut result = polynomial.clone();
        if result.len() > LONGEST {
            return Ok(result);
        }
        loop {
            let before = result.len();
            for monomial in result.clone().iter().map(|(monomial, _)| monomial) {
                self.join_term(&mut result, monomial)?;
            }
            if result.len() >= before {
                return Ok(result);
            }
        }
    }

    /// Join one term with its first partner that occurs.
    fn join_term(&mut self, sum: &mut Polynomial, monomial: &Monomial) -> Result<(), Error> {
        let mut waves = Vec::new();
        for &(atom, exponent) in monomial.factors() {
            if let Some((shape, angle)) = self.wave(atom).filter(|_| exponent > 0) {
                waves.push((atom, shape, angle));
            }
        }
        self.budget.spend(1 + waves.len() * waves.len())?;
        for (position, &first) in waves.iter().enumerate() {
            for &second in waves[position + 1..].iter().filter(|second| second.2 != first.2) {
                for (sign, wave, step) in theorems(first.1, second.1) {
                    // sin b cos a is read as sin a' cos b' with the angles exchanged.
                    let swapped = first.1 == Function::Cos && second.1 == Function::Sin;
                    let (a, b) = if swapped { (second, first) } else { (first, second) };
                    let Some(coefficient) = sum.coefficient(monomial).cloned() else { return Ok(()) };
                    let product = Monomial::power(a.0, 1).times(&Monomial::power(b.0, 1));
                    let Some(partner) = self.partner(a.0, b.0)? else { continue };
                    let rest = monomial.over(&product);
                    let expected = coefficient.mul(&Number::integer(sign));
                    let other = rest.times(&partner);
                    if !sum.coefficient(&other).is_some_and(|known| known.same_value(&expected)) {
                        continue;
                    }
                    let mut angle = self.angle(a.2)?;
                    angle.add_scaled(&self.angle(b.2)?, &Number::integer(step));
                    let wave = self.wave_of(wave, &angle)?;
                    let join = Join { product, partner, sign, wave };
                    join.apply(sum, &rest, &coefficient);
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// The product of the partners of two waves: sines for cosines and cosines for sines.
    fn partner(&mut self, a: u32, b: u32) -> Result<Option<Monomial>, Error> {
        let mut product = Monomial::default();
        for atom in [a, b] {
            let Some((partner, opposite)) = self.partner_of(atom)? else { return Ok(None) };
            if opposite || self.wave(partner).is_none() {
                return Ok(None);
            }
            product = product.times(&Monomial::power(partner, 1));
        }
        Ok(Some(product))
    }
}

impl Join {
    fn apply(&self, sum: &mut Polynomial, rest: &Monomial, coefficient: &Number) {
        sum.add_term(rest.times(&self.product), &coefficient.neg());
        sum.add_term(rest.times(&self.partner), &coefficient.mul(&Number::integer(-self.sign)));
        sum.add_scaled(&self.wave.shifted(rest, coefficient), &Number::integer(1));
    }
}

/// The theorems that start with these two shapes in either order.
fn theorems(first: Function, second: Function) -> impl Iterator<Item = (i64, Function, i64)> {
    THEOREMS
        .iter()
        .filter(move |&&(f, g, ..)| (f, g) == (first, second) || (g, f) == (first, second))
        .map(|&(_, _, sign, wave, step)| (sign, wave, step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Graph, Id, NumberId};
    use crate::polynomial::Budget;
    use crate::rewrite::expand::Opening;

    /// Join the expanded waves of a sum of three angles with these signs.
    fn joined(shape: Function, signs: [i64; 3]) -> Result<(), Error> {
        let g = &mut Graph::new();
        let mut terms: Vec<(NumberId, Id)> = Vec::new();
        for (name, sign) in ["a", "b", "c"].iter().zip(signs) {
            let angle = g.symbol(name, Assumption::Real);
            terms.push((g.number_id(&Number::integer(sign)), angle));
        }
        let angle = g.sum(&terms);
        let wave = g.apply(shape, &[angle])?;
        let expanded = g.expand_trig(wave)?;
        assert_ne!(expanded, wave);
        let mut ring = Ring::new(g, Budget::new(100, 1000));
        let polynomial = ring.polynomial(expanded, Opening::Products)?;
        let joined = ring.join_angles(&polynomial)?;
        assert_eq!(ring.node_of(&joined)?, wave);
        Ok(())
    }

    #[test]
    fn sums_of_three_angles_are_joined() -> Result<(), Error> {
        for shape in [Function::Sin, Function::Cos] {
            for signs in [[1, 1, 1], [1, -1, 1], [1, 1, -1], [-1, 1, 1]] {
                joined(shape, signs)?;
            }
        }
        Ok(())
    }
}
