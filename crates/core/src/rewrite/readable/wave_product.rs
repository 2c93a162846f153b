//! Sums of two waves, and waves of double angles, as products of waves: `cos(x + y) + cos(x - y) = 2 cos(x) cos(y)`.

use crate::error::Error;
use crate::graph::Function;
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use crate::rewrite::ring::Ring;

/// The most terms of a sum that is searched for pairs.
const TERMS: usize = 24;

/// f(a) + sign f(b) = factor g((a + b)/2) h((a - b)/2): f, sign, factor, g, h.
const THEOREMS: [(Function, i64, i64, Function, Function); 4] = [
    (Function::Cos, 1, 2, Function::Cos, Function::Cos),
    (Function::Cos, -1, -2, Function::Sin, Function::Sin),
    (Function::Sin, 1, 2, Function::Sin, Function::Cos),
    (Function::Sin, -1, 2, Function::Cos, Function::Sin),
];

/// A term with one wave: what multiplies the wave, its function and its angle.
struct Wave {
    rest: Monomial,
    coefficient: Number,
    shape: Function,
    angle: Polynomial,
}

impl Ring<'_> {
    /// The polynomial with products for pairs of waves that half the sum and half the difference of their angles give.
    /// None if there is no such pair.
    pub(super) fn with_wave_products(
        &mut self,
        polynomial: &Polynomial,
    ) -> Result<Option<Polynomial>, Error> {
        if polynomial.len() < 2 || polynomial.len() > TERMS {
            return Ok(None);
        }
        let terms: Vec<_> = polynomial.iter().map(|(m, c)| (m.clone(), c.clone())).collect();
        let mut made = Polynomial::default();
        let mut taken = vec![false; terms.len()];
        for first in 0..terms.len() {
            for second in first + 1..terms.len() {
                if taken[first] || taken[second] {
                    continue;
                }
                if let Some(product) = self.wave_product(&terms[first], &terms[second])? {
                    made.add_scaled(&product, &Number::integer(1));
                    (taken[first], taken[second]) = (true, true);
                }
            }
        }
        if !taken.contains(&true) {
            return Ok(None);
        }
        for ((monomial, coefficient), _) in terms.into_iter().zip(taken).filter(|(_, taken)| !taken) {
            made.add_term(monomial, &coefficient);
        }
        Ok(Some(made))
    }

    fn wave_product(
        &mut self,
        (first, c): &(Monomial, Number),
        (second, d): &(Monomial, Number),
    ) -> Result<Option<Polynomial>, Error> {
        let sign = if c.same_value(d) { 1 } else { -1 };
        if sign == -1 && !c.same_value(&d.neg()) {
            return Ok(None);
        }
        let (Some(a), Some(b)) = (self.single_wave(first, c)?, self.single_wave(second, d)?) else {
            return Ok(None);
        };
        let theorem = THEOREMS.iter().find(|theorem| theorem.0 == a.shape && theorem.1 == sign);
        let (Some(&(_, _, factor, g, h)), true) = (theorem, a.rest == b.rest && a.shape == b.shape) else {
            return Ok(None);
        };
        let half = |sign: i64| {
            let mut sum = a.angle.clone();
            sum.add_scaled(&b.angle, &Number::integer(sign));
            sum.scaled(&Number::rational(1, 2))
        };
        let (sum, difference) = (half(1), half(-1));
        if !is_whole(&sum) || !is_whole(&difference) {
            return Ok(None);
        }
        let (g, h) = (self.wave_of(g, &sum)?, self.wave_of(h, &difference)?);
        let product = self.times(&g, &h)?;
        Ok(Some(product.shifted(&a.rest, &a.coefficient.mul(&Number::integer(factor)))))
    }

    fn single_wave(&mut self, monomial: &Monomial, coefficient: &Number) -> Result<Option<Wave>, Error> {
        let (waves, rest) = monomial.split(|atom| self.wave(atom).is_some());
        let &[(atom, 1)] = waves.factors() else { return Ok(None) };
        let Some((shape, argument)) = self.wave(atom) else { return Ok(None) };
        let angle = self.angle(argument)?;
        Ok(Some(Wave { rest, coefficient: coefficient.clone(), shape, angle }))
    }

    /// The polynomial with waves of the half of angles that are twice a sum of angles: `sin(2 x - 2 y)` becomes
    /// `2 sin(x - y) cos(x - y)`. None if there are none.
    pub(super) fn with_half_angles(&mut self, polynomial: &Polynomial) -> Result<Option<Polynomial>, Error> {
        let mut made = Polynomial::default();
        for (monomial, coefficient) in polynomial.iter() {
            let wave = self.single_wave(monomial, coefficient)?;
            let Some(wave) = wave.filter(|wave| wave.angle.len() > 1) else {
                made.add_term(monomial.clone(), coefficient);
                continue;
            };
            let half = wave.angle.scaled(&Number::rational(1, 2));
            if !is_whole(&half) {
                made.add_term(monomial.clone(), coefficient);
                continue;
            }
            let (sin, cos) = (self.wave_of(Function::Sin, &half)?, self.wave_of(Function::Cos, &half)?);
            let product = if wave.shape == Function::Sin {
                self.times(&sin, &cos)?.scaled(&Number::integer(2))
            } else {
                let mut difference = self.times(&cos, &cos)?;
                difference.add_scaled(&self.times(&sin, &sin)?, &Number::integer(-1));
                difference
            };
            made.add_scaled(&product.shifted(&wave.rest, coefficient), &Number::integer(1));
        }
        Ok((made != *polynomial).then_some(made))
    }
}

/// Whether an angle is a sum of whole multiples.
fn is_whole(angle: &Polynomial) -> bool {
    angle.iter().all(|(_, coefficient)| coefficient.is_integer())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Graph, NumberId};
    use crate::polynomial::Budget;
    use crate::rewrite::expand::Opening;

    #[test]
    fn sums_and_double_angles_become_products() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [x, y, m] = ["x", "y", "m"].map(|name| g.symbol(name, Assumption::Real));
        let (sum, difference) = (g.add(x, y), g.sub(x, y));
        let two = g.number_id(&Number::integer(2));
        let twice = g.scale(two, difference);
        for shape in [Function::Sin, Function::Cos] {
            let (a, b) = (g.apply(shape, &[sum])?, g.apply(shape, &[difference])?);
            let (a, b) = (g.mul(m, a)?, g.mul(m, b)?);
            let double = g.apply(shape, &[twice])?;
            for sign in [NumberId::ONE, NumberId::MINUS_ONE] {
                let pair = g.sum(&[(NumberId::ONE, a), (sign, b)]);
                let mut ring = Ring::new(g, Budget::new(100, 1000));
                let polynomial = ring.polynomial(pair, Opening::Products)?;
                let product = ring.with_wave_products(&polynomial)?.expect("a pair is found");
                assert_eq!(product.len(), 1);
                let node = ring.node_of(&product)?;
                assert!(g.equal(node, pair));
            }
            let mut ring = Ring::new(g, Budget::new(100, 1000));
            let polynomial = ring.polynomial(double, Opening::Products)?;
            let halved = ring.with_half_angles(&polynomial)?.expect("the angle is halved");
            let node = ring.node_of(&halved)?;
            assert!(g.equal(node, double));
        }
        Ok(())
    }
}
